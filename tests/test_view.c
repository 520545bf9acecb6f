/* The satellite at one moment: its pieces against closed forms and the light curve, the picture's
 * axes, and what is drawn. */
#include <glint/glint.h>

#include "base/constants.h"
#include "base/vec.h"
#include "output/colour.h"
#include "scenario_text.h"

#include <cairo.h>

/* Looks; the file and what is asked for must be right. glint_view_free ends it. */
static glint_view *look_at(const char *path, const glint_view_options *options)
{
    glint_view *view;
    glint_errors *errors = glint_errors_new();
    const glint_status status = glint_view_read(path, NULL, 0, options, &view, errors);
    ck_assert_msg(status == GLINT_OK, "%s:%s", path, list_errors(errors));
    glint_errors_free(errors);
    return view;
}

static glint_view *look_at_text(const char *const parts[N_PARTS], enum part part, const char *text,
                                const glint_view_options *options)
{
    const marked_text m = with_part(parts, part, text);
    return look_at(write_file("seen.toml", m.text), options);
}

/* Area of the pieces in that light as they are seen, m^2. */
static double seen_m2(const glint_view *view, glint_view_light light)
{
    size_t n;
    const glint_view_piece *pieces = glint_view_pieces(view, &n);
    double sum = 0;
    for (size_t k = 0; k < n; k++) {
        ck_assert(pieces[k].projected_m2 >= 0);
        if (pieces[k].light == light) sum += pieces[k].projected_m2;
    }
    return sum;
}

/* E_obs / E_sun at 1 au from the pieces: the sum of L / E x projected area / range^2. */
static double flux_ratio_of(const glint_view *view)
{
    size_t n;
    const glint_view_piece *pieces = glint_view_pieces(view, &n);
    const double range_m = glint_view_describe(view)->range_m;
    double sum = 0;
    for (size_t k = 0; k < n; k++) {
        ck_assert(pieces[k].light == GLINT_PIECE_LIT || !(pieces[k].radiance_factor > 0));
        sum += pieces[k].radiance_factor / PI * pieces[k].projected_m2;
    }
    return sum / (range_m * range_m);
}

/* ------------------------------------------------------------------- areas */

/* Physics page, sections 6 and 11. */
START_TEST(test_view_two_plates_add_up_to_the_closed_form)
{
    glint_view *view = look_at(SCENARIO_DIR "/known/two-plates.toml", NULL);
    const double facing = cos(45 * DEG), whole_m2 = 16 * facing;
    const double lit_m2 = (8.845299461620748 + 4) * facing;
    assert_near(seen_m2(view, GLINT_PIECE_LIT), lit_m2, 1e-13);
    /* What is seen is the lower plate's outline: the upper one stands before it. */
    assert_near(seen_m2(view, GLINT_PIECE_SHADOWED), whole_m2 - lit_m2, 1e-13);
    assert_near(seen_m2(view, GLINT_PIECE_TURNED_AWAY), 0, 0);
    assert_near(seen_m2(view, GLINT_PIECE_BACK), 0, 0);
    assert_rel(flux_ratio_of(view), 1.251929862639295e-12, 1e-13);
    const glint_view_scene *scene = glint_view_describe(view);
    ck_assert(scene->has_magnitude);
    assert_near(scene->magnitude, 2.9960500027, 1e-10);
    /* A Lambert plate of 0.5, the Sun 30 deg from its normal. */
    assert_rel(scene->brightest, 0.5 * cos(30 * DEG), 1e-14);
    glint_view_free(view);
}
END_TEST

START_TEST(test_view_cube_adds_up_to_the_closed_form)
{
    glint_view *view = look_at(SCENARIO_DIR "/known/cube.toml", NULL);
    assert_rel(flux_ratio_of(view), 1.697652726313550e-13, 1e-13);
    /* o = (2, -1, 2)/3: three faces of 4 m^2, of which -y has no sunlight. */
    assert_near(seen_m2(view, GLINT_PIECE_LIT), 4 * 4.0 / 3, 1e-13);
    assert_near(seen_m2(view, GLINT_PIECE_TURNED_AWAY), 4 * 1.0 / 3, 1e-13);
    glint_view_free(view);
}
END_TEST

/* The pieces of a satellite with lobes, curved surfaces, wings and shadows give the magnitude that
 * the curve has. */
START_TEST(test_view_pieces_give_the_curve_s_magnitude)
{
    static const char *const satellite =
        "[[component]]\nname = \"bus\"\n"
        "[[component.box]]\nsize_m = [2, 2, 3]\nmaterial = \"foil\"\n"
        "crinkle = { facets_per_side = 6, tilt_rms_deg = 5, seed = 3 }\n"
        "[[component.sphere]]\nradius_m = 0.5\nfacets = 320\ncentre_m = [0, 0, 2.2]\n"
        "material = \"foil\"\n"
        "[[component.dish]]\nradius_m = 0.8\ndepth_m = 0.3\ncentre_m = [1.4, 0, 0]\n"
        "axis = [1, 0, 0]\nmaterial = \"white\"\nback_material = \"foil\"\n"
        "[[component]]\nname = \"wing\"\nhinge = { origin_m = [0, 1, 0], axis = [0, 1, 0], "
        "track = \"sun\", face = [0, 0, 1] }\n"
        "[[component.plate]]\nsize_m = [2, 6]\ncentre_m = [0, 3.5, 0]\nnormal = [0, 0, 1]\n"
        "tangent = [1, 0, 0]\nmaterial = \"white\"\n";
    static const char *const head =
        "[geometry]\nrotate = { axis = [1, 2, 3], step_deg = 30, sun = [1, 1, 1], "
        "observer = [1, 0, 1] }\n[photometry]\nsolar_disc = \"point\"\n"
        "[materials.white]\nbrdf = \"lambert\"\nrho = 0.5\n"
        "[materials.foil]\nbrdf = \"ward-gmd\"\nrho_d = 0.1\nrho_s = 0.7\n"
        "alpha_x = 0.1\nalpha_y = 0.1\n";
    char text[TEXT_SIZE];
    snprintf(text, sizeof text, "%s%s", head, satellite);
    const char *path = write_file("satellite.toml", text);
    int bright = 0;
    for (int row = 0; row < 12; row++) {
        char at[16];
        snprintf(at, sizeof at, "%d", row);
        glint_view *view = look_at(path, &(glint_view_options){.at = at});
        const glint_view_scene *scene = glint_view_describe(view);
        ck_assert_int_eq(scene->row, row);
        if (scene->has_magnitude) {
            assert_near(-26.76 - 2.5 * log10(flux_ratio_of(view)), scene->magnitude, 1e-9);
            bright++;
        }
        glint_view_free(view);
    }
    ck_assert_int_gt(bright, 6);
}
END_TEST

/* ------------------------------------------------------------------ moments */

START_TEST(test_view_time_as_text_and_as_seconds_is_the_same)
{
    const char *path = SCENARIO_DIR "/iss-vienna.toml";
    glint_view *a = look_at(path, &(glint_view_options){.at = "2025-07-24T19:13:10Z"});
    glint_view *b = look_at(path, &(glint_view_options){.at = "190"});
    const glint_view_scene *p = glint_view_describe(a), *q = glint_view_describe(b);
    ck_assert_int_eq(p->utc.minute, 13);
    ck_assert_int_eq(p->utc.second, 10);
    assert_near(p->t_s, 190, 1e-9);
    assert_near(p->magnitude, q->magnitude, 1e-9);
    glint_scenario *s = read_sound_set(path, NULL, 0);
    glint_curve *curve;
    ck_assert_int_eq(glint_curve_open(s, 1, &curve, NULL), GLINT_OK);
    const glint_row *rows;
    size_t n;
    ck_assert_int_eq(glint_curve_next(curve, &rows, &n, NULL), GLINT_OK);
    ck_assert_uint_gt(n, 190);
    assert_near(q->magnitude, rows[190].magnitude[0], 1e-9);
    assert_near(q->range_m, rows[190].range_m, 1e-6);
    assert_near(q->phase_angle_rad, rows[190].phase_angle_rad, 1e-12);
    glint_curve_close(curve);
    glint_scenario_free(s);
    glint_view_free(a);
    glint_view_free(b);
}
END_TEST

START_TEST(test_view_in_the_umbra_nothing_is_lit)
{
    glint_view *view = look_at(SCENARIO_DIR "/starlink-lapalma.toml", NULL);
    const glint_view_scene *scene = glint_view_describe(view);
    assert_near(scene->sunlit_fraction, 0, 0);
    ck_assert(!scene->has_magnitude);
    assert_near(seen_m2(view, GLINT_PIECE_LIT) + seen_m2(view, GLINT_PIECE_SHADOWED), 0, 0);
    ck_assert(seen_m2(view, GLINT_PIECE_TURNED_AWAY) > 0);
    glint_view_free(view);
}
END_TEST

START_TEST(test_view_from_the_sun_all_is_lit)
{
    glint_view *view =
        look_at(SCENARIO_DIR "/iss-vienna.toml", &(glint_view_options){.from = GLINT_FROM_SUN});
    assert_near(seen_m2(view, GLINT_PIECE_SHADOWED), 0, 1e-9);
    assert_near(seen_m2(view, GLINT_PIECE_TURNED_AWAY), 0, 0);
    ck_assert(seen_m2(view, GLINT_PIECE_LIT) > 20);
    ck_assert(!glint_view_describe(view)->has_magnitude);
    glint_view_free(view);
}
END_TEST

/* --------------------------------------------------------------------- axes */

static void assert_axes(const glint_view_scene *scene, const double want[9], double tol)
{
    for (int k = 0; k < 3; k++)
        for (int j = 0; j < 3; j++)
            assert_near(scene->body_axes[k][j], want[3 * k + j], tol);
}

START_TEST(test_view_of_a_model_has_body_z_up)
{
    const char *path = SCENARIO_DIR "/models/box-wing.toml";
    const glint_view_options along_x = {.from = GLINT_FROM_DIRECTION,
                                        .from_body = {5, 0, 0},
                                        .has_sun = true,
                                        .sun_body = {0, 2, 0}};
    glint_view *view = look_at(path, &along_x);
    /* From +x, with z up, y runs to the right; and so the Sun is there. */
    const double side[9] = {0, 0, 1, 1, 0, 0, 0, 1, 0}, right[3] = {1, 0, 0};
    assert_axes(glint_view_describe(view), side, 1e-15);
    for (int k = 0; k < 3; k++)
        assert_near(glint_view_describe(view)->sun[k], right[k], 1e-15);
    assert_near(glint_view_describe(view)->phase_angle_rad, PI / 2, 1e-15);
    glint_view_free(view);
    /* From +z, y is up and x to the right. */
    const glint_view_options along_z = {.from = GLINT_FROM_DIRECTION, .from_body = {0, 0, 1}};
    const double top[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    view = look_at(path, &along_z);
    assert_axes(glint_view_describe(view), top, 1e-15);
    glint_view_free(view);
}
END_TEST

/* With the body's axes along those of GCRS, north is up, and the observer looks along his own
 * right ascension and declination. */
START_TEST(test_view_by_an_observer_has_north_up_and_east_left)
{
    glint_view *view =
        look_at_text(SOUND, PART_ATTITUDE,
                     "[attitude]\nlaw = \"inertial\"\nquaternion_wxyz = [1, 0, 0, 0]\n", NULL);
    const glint_view_scene *scene = glint_view_describe(view);
    ck_assert(scene->north_up);
    assert_near(scene->body_axes[2][0], 0, 1e-15); /* north has no part to the side */
    ck_assert(scene->body_axes[2][1] > 0);
    /* East, at the place on the sky where the satellite is: the direction is -z of the picture,
     * north x direction. In the picture's axes that is up x (0, 0, -1) = -x: to the left. */
    double away[3] = {0, 0, -1}, east[3];
    cross3(scene->body_axes[2], away, east);
    ck_assert(east[0] < 0);
    assert_near(east[1], 0, 1e-15);
    /* The picture is no mirror image. */
    double z[3];
    cross3(scene->body_axes[0], scene->body_axes[1], z);
    for (int k = 0; k < 3; k++)
        assert_near(z[k], scene->body_axes[2][k], 1e-15);
    assert_near(scene->sun[2], cos(scene->phase_angle_rad), 1e-15);
    glint_view_free(view);
}
END_TEST

/* ----------------------------------------------------------------- pictures */

/* One red, green or blue byte of a pixel. */
static int channel(cairo_surface_t *image, int x, int y, int shift)
{
    const unsigned char *row =
        cairo_image_surface_get_data(image) + (ptrdiff_t)y * cairo_image_surface_get_stride(image);
    uint32_t pixel;
    memcpy(&pixel, row + 4 * (ptrdiff_t)x, sizeof pixel);
    return (int)(pixel >> shift & 0xff);
}

static void assert_pixel(cairo_surface_t *image, int x, int y, colour c)
{
    const double want[3] = {255 * c.red, 255 * c.green, 255 * c.blue};
    for (int k = 0; k < 3; k++)
        assert_near(channel(image, x, y, 16 - 8 * k), want[k], 1.6); /* 255 steps */
}

static const char *draw_as(const glint_view *view, const char *name, const glint_view_style *style)
{
    const char *path = in_folder(name);
    glint_error error = {0};
    const glint_status status = glint_view_draw(view, style, path, &error);
    ck_assert_msg(status == GLINT_OK, "%s", error.message);
    return path;
}

START_TEST(test_view_pixels_have_the_colours_of_their_pieces)
{
    glint_view *view = look_at(SCENARIO_DIR "/known/two-plates.toml", NULL);
    /* so small that there is the satellite alone, in the middle */
    const glint_view_style style = {.width = 400, .height = 300};
    cairo_surface_t *image =
        cairo_image_surface_create_from_png(draw_as(view, "plates.png", &style));
    ck_assert_int_eq(cairo_image_surface_get_width(image), 400);
    ck_assert_int_eq(cairo_image_surface_get_height(image), 300);
    const colour white = {1, 1, 1};
    const double top = 0.5; /* of the scale: the brightest is 0.433 */
    assert_pixel(image, 2, 2, white);
    /* Seen from -x, body x is up and y to the left; 4 m take 376 px, 94 px/m. The middle of the
     * upper plate is 1 m sin 45 deg above the centre, the middle of the shadow 0.56 m below. */
    const colour lit = colour_scale(0.5 * cos(30 * DEG) / top);
    assert_pixel(image, 200, 150 - 66, lit);
    assert_pixel(image, 200 + 141, 150 + 52, lit); /* beside the shadow */
    for (int k = 0; k < 3; k++)
        assert_near(channel(image, 200, 150 + 52, 8 * k), 125, 8); /* a grey */
    assert_pixel(image, 200, 150 + 145, white);
    cairo_surface_destroy(image);
    glint_view_free(view);
}
END_TEST

START_TEST(test_view_draws_the_same_bytes_again)
{
    glint_view *view = look_at(SCENARIO_DIR "/iss-vienna.toml", NULL);
    static const char *const names[] = {"a.png", "b.png", "a.pdf", "b.pdf"};
    for (int k = 0; k < 4; k += 2) { /* those of SVG are numbered through while a program runs */
        size_t n, m;
        char *a = read_bytes(draw_as(view, names[k], NULL), &n);
        char *b = read_bytes(draw_as(view, names[k + 1], NULL), &m);
        ck_assert_uint_eq(n, m);
        ck_assert_mem_eq(a, b, n);
        free(a);
        free(b);
    }
    glint_view_free(view);
}
END_TEST

START_TEST(test_view_draws_every_colouring_of_every_light)
{
    /* a one-sided plate that throws a shadow on a box, from behind */
    static const char *const text =
        "[[component]]\nname = \"a\"\n[[component.box]]\nsize_m = [1, 1, 1]\nmaterial = \"white\"\n"
        "[[component.plate]]\nsize_m = [1, 1]\ncentre_m = [0.3, 1, 0]\nnormal = [0, -1, 0]\n"
        "tangent = [1, 0, 0]\nmaterial = \"white\"\n[materials.white]\nbrdf = \"lambert\"\n"
        "rho = 0.5\n";
    const glint_view_options options = {.from = GLINT_FROM_DIRECTION,
                                        .from_body = {1, 1, 1},
                                        .has_sun = true,
                                        .sun_body = {0.2, 1, -0.3}};
    glint_view *view = look_at(write_file("model.toml", text), &options);
    for (int light = GLINT_PIECE_LIT; light <= GLINT_PIECE_BACK; light++)
        ck_assert_msg(seen_m2(view, (glint_view_light)light) > 0.01, "light %d", light);
    for (int what = GLINT_COLOUR_BRIGHTNESS; what <= GLINT_COLOUR_LIGHT; what++)
        for (int logarithmic = 0; logarithmic < 2; logarithmic++)
            draw_as(
                view, "any.svg",
                &(glint_view_style){.colour = (glint_view_colour)what, .logarithmic = logarithmic});
    glint_view_free(view);
}
END_TEST

/* A title that is no end, and a picture as small and as wide as may be. */
START_TEST(test_view_draws_at_odd_sizes)
{
    char title[600] = "title = \"";
    for (int k = 0; k < 100; k++)
        strcat(title, "\xc3\xa4"
                      "bc ");
    strcat(title, "\"\n");
    glint_view *view = look_at_text(GIVEN, PART_TOP, title, NULL);
    draw_as(view, "small.png", &(glint_view_style){.width = 200, .height = 200});
    draw_as(view, "wide.png", &(glint_view_style){.width = 4000, .height = 500});
    draw_as(view, "high.svg", &(glint_view_style){.width = 500, .height = 4000});
    glint_view_free(view);
}
END_TEST

/* ------------------------------------------------------------------- colours */

/* IEC 61966-2-1, backwards. */
static double decode(double encoded)
{
    return encoded <= 0.04045 ? encoded / 12.92 : pow((encoded + 0.055) / 1.055, 2.4);
}

/* Lightness of a colour in Oklab (Ottosson 2020): the way back from what the program computes. */
static double colour_lightness(colour c)
{
    const double r = decode(c.red), g = decode(c.green), b = decode(c.blue);
    return 0.2104542553 * cbrt(0.4122214708 * r + 0.5363325363 * g + 0.0514459929 * b) +
           0.7936177850 * cbrt(0.2119034982 * r + 0.6806995451 * g + 0.1073969566 * b) -
           0.0040720468 * cbrt(0.0883024619 * r + 0.2817188376 * g + 0.6299787005 * b);
}

/* CSS Color 4, conversion of sRGB red: oklab(0.62796 0.22486 0.12585). */
START_TEST(test_view_colours_agree_with_css)
{
    const colour red = colour_oklab(0.62796, 0.22486, 0.12585);
    assert_near(red.red, 1, 1e-4);
    assert_near(red.green, 0, 2e-3); /* the encoding is steep near 0 */
    assert_near(red.blue, 0, 2e-3);
    assert_near(colour_lightness((colour){1, 0, 0}), 0.62796, 1e-5);
    assert_near(colour_lightness((colour){1, 1, 1}), 1, 1e-6);
}
END_TEST

START_TEST(test_view_scale_of_colours_has_even_lightness)
{
    for (int k = 0; k <= 100; k++) {
        const double t = k / 100.0;
        const colour c = colour_scale(t);
        assert_near(colour_lightness(c), 0.24 + 0.70 * t, 1e-6);
        if (k > 0) ck_assert(colour_lightness(c) > colour_lightness(colour_scale(t - 0.01)));
    }
}
END_TEST

/* ------------------------------------------------------------------- errors */

static void assert_refused(const char *path, const glint_view_options *options, glint_status wanted,
                           const char *said)
{
    glint_view *view;
    glint_errors *errors = glint_errors_new();
    const glint_status status = glint_view_read(path, NULL, 0, options, &view, errors);
    ck_assert_int_eq(status, wanted);
    ck_assert_ptr_null(view);
    const glint_error *last = glint_errors_get(errors, glint_errors_count(errors) - 1);
    ck_assert_ptr_nonnull(last);
    ck_assert_msg(strstr(last->message, said) != NULL, "'%s' does not say '%s'", last->message,
                  said);
    glint_errors_free(errors);
}

START_TEST(test_view_refuses_what_makes_no_sense)
{
    static const char *const orbit = SCENARIO_DIR "/iss-vienna.toml",
                             *const given = SCENARIO_DIR "/known/two-plates.toml",
                             *const model = SCENARIO_DIR "/models/box-wing.toml";
#define REFUSED(path, said, ...)                                                                   \
    assert_refused(path, &(glint_view_options){__VA_ARGS__}, GLINT_ARGUMENT, said)
    REFUSED(orbit, "is no time; expected UTC", .at = "yesterday");
    REFUSED(orbit, "is no time; expected UTC", .at = "");
    REFUSED(orbit, "expected one from 2025-07-24T19:10:00Z to 2025-07-24T19:17:00Z",
            .at = "2025-07-24T19:18:00Z");
    REFUSED(orbit, "0 to 420 s", .at = "-1");
    REFUSED(orbit, "says where the Sun is", .has_sun = true, .sun_body = {1, 0, 0});
    REFUSED(orbit, "expected one that is finite and not 0", .from = GLINT_FROM_DIRECTION);
    REFUSED(given, "is no row", .at = "1");
    REFUSED(given, "is no row", .at = "0.5");
    REFUSED(given, "is no row", .at = "2025-07-24T19:18:00Z");
    REFUSED(model, "a model has no time", .at = "0");
    REFUSED(model, "expected one that is finite and not 0", .has_sun = true);
    REFUSED(model, "expected one that is finite", .from = GLINT_FROM_DIRECTION,
            .from_body = {1, 0, INFINITY});
#undef REFUSED
    assert_refused("nothere.toml", NULL, GLINT_INPUT, "cannot open");
}
END_TEST

START_TEST(test_view_refuses_pictures_that_it_cannot_draw)
{
    glint_error error = {0};
    const glint_view_style usual = {0}, small = {.width = 199, .height = 500},
                           other = {.format = "gif"}, png = {.format = "png"};
    ck_assert_int_eq(glint_view_draw_check(&usual, "a.gif", &error), GLINT_ARGUMENT);
    ck_assert_int_eq(glint_view_draw_check(&small, "a.png", &error), GLINT_ARGUMENT);
    ck_assert_int_eq(glint_view_draw_check(&other, "a.png", &error), GLINT_ARGUMENT);
    ck_assert_int_eq(glint_view_draw_check(&png, "a.gif", &error), GLINT_OK);
    ck_assert_int_eq(glint_view_draw_check(NULL, "a.PDF", &error), GLINT_OK);
    glint_view *view = look_at(SCENARIO_DIR "/known/cube.toml", NULL);
    char nowhere[512];
    snprintf(nowhere, sizeof nowhere, "%s/no/such/folder/a.png", folder);
    ck_assert_int_eq(glint_view_draw(view, NULL, nowhere, &error), GLINT_OUTPUT);
    ck_assert_int_eq(folder_count(), 0);
    glint_view_free(view);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("view");
    TCase *cases = tcase_create("view");
    tcase_add_checked_fixture(cases, folder_make, folder_remove);
    tcase_set_timeout(cases, 60);
    tcase_add_test(cases, test_view_two_plates_add_up_to_the_closed_form);
    tcase_add_test(cases, test_view_cube_adds_up_to_the_closed_form);
    tcase_add_test(cases, test_view_pieces_give_the_curve_s_magnitude);
    tcase_add_test(cases, test_view_time_as_text_and_as_seconds_is_the_same);
    tcase_add_test(cases, test_view_in_the_umbra_nothing_is_lit);
    tcase_add_test(cases, test_view_from_the_sun_all_is_lit);
    tcase_add_test(cases, test_view_of_a_model_has_body_z_up);
    tcase_add_test(cases, test_view_by_an_observer_has_north_up_and_east_left);
    tcase_add_test(cases, test_view_pixels_have_the_colours_of_their_pieces);
    tcase_add_test(cases, test_view_draws_the_same_bytes_again);
    tcase_add_test(cases, test_view_draws_every_colouring_of_every_light);
    tcase_add_test(cases, test_view_draws_at_odd_sizes);
    tcase_add_test(cases, test_view_colours_agree_with_css);
    tcase_add_test(cases, test_view_scale_of_colours_has_even_lightness);
    tcase_add_test(cases, test_view_refuses_what_makes_no_sense);
    tcase_add_test(cases, test_view_refuses_pictures_that_it_cannot_draw);
    suite_add_tcase(suite, cases);
    return run_suite(suite);
}
