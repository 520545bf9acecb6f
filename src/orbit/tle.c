#include "orbit/tle.h"

#include "base/constants.h"
#include "base/text.h"
#include "orbit/clock.h"

#include <erfa.h>

#include <ctype.h>
#include <string.h>

/* Columns count from 1, as in descriptions of the format. */
enum { LINE_LENGTH = 69, CHECKSUM_COLUMN = 69 };

/* A line under reading. */
typedef struct tle_line {
    const char *text;
    size_t length; /* without the line end */
    int which;     /* 1 or 2 */
    place where;   /* of its first character */
    glint_error *error;
} tle_line;

/* How a field is written. */
typedef enum field_kind {
    DIGITS,   /* digits, blanks before them for zeros */
    OPTIONAL, /* the same, or blank: 0 */
    FRACTION, /* digits behind a decimal point that is not written */
    FIXED,    /* a number whose decimal point stands in column `point` */
    POWER     /* sign, five digits of a fraction, signed exponent of ten: 12345-4 */
} field_kind;

typedef struct field {
    const char *name;
    int first, last; /* columns */
    field_kind kind;
    int point;
    const char *like; /* an example */
} field;

static const field epoch_year = {"epoch year", 19, 20, DIGITS, 0, "25"};
static const field epoch_day = {"epoch day", 21, 32, FIXED, 24, "206.16725053"};
static const field motion_dot = {"derivative of the mean motion", 34, 43, FIXED, 35, " .00012111"};
static const field motion_dot2 = {
    "second derivative of the mean motion", 45, 52, POWER, 0, " 00000+0"};
static const field drag_term = {"drag term B*", 54, 61, POWER, 0, " 21923-3"};
static const field set_number = {"element set number", 65, 68, OPTIONAL, 0, " 999"};
static const field inclination = {"inclination", 9, 16, FIXED, 12, " 51.6348"};
static const field node = {"right ascension of the node", 18, 25, FIXED, 21, "118.8254"};
static const field eccentricity = {"eccentricity", 27, 33, FRACTION, 0, "0002056"};
static const field perigee = {"argument of perigee", 35, 42, FIXED, 38, "114.0852"};
static const field anomaly = {"mean anomaly", 44, 51, FIXED, 47, "246.0352"};
static const field mean_motion = {"mean motion", 53, 63, FIXED, 55, "15.50079803"};
static const field revolution = {"revolution number", 64, 68, OPTIONAL, 0, "52105"};

static place at_column(const tle_line *l, int column)
{
    place p = l->where;
    p.column = (p.column > 0 ? p.column : 1) + column - 1;
    return p;
}

/* A character as messages may show it. */
static char shown(char c)
{
    return (char)(isprint((unsigned char)c) ? c : '?');
}

enum { FIELD_ROOM = 32 };

static glint_status bad_field(const tle_line *l, const field *f, const char *problem)
{
    char found[FIELD_ROOM];
    const int n = f->last - f->first + 1;
    for (int k = 0; k < n; k++)
        found[k] = shown(l->text[f->first - 1 + k]);
    found[n] = '\0';
    return error_set(l->error, GLINT_INPUT, at_column(l, f->first),
                     "the %s (columns %d to %d of line %d) %s: found '%s', expected the form '%s'; "
                     "get the element set again, or set the columns right",
                     f->name, f->first, f->last, l->which, problem, found, f->like);
}

static bool is_digit(char c)
{
    return c >= '0' && c <= '9';
}

/* Copies the n characters at s to out, which has room for them, with blanks before the first other
 * character turned to zeros. False when all are blank, or one of the rest is not a digit. */
static bool zero_filled(const char *s, int n, char *out)
{
    int k = 0;
    for (; k < n && s[k] == ' '; k++)
        out[k] = '0';
    if (k == n) return false;
    for (; k < n; k++) {
        if (!is_digit(s[k])) return false;
        out[k] = s[k];
    }
    return true;
}

/* Writes the field as a plain decimal number; NULL, or what is wrong with it. */
static const char *normalise_digits(const char *s, int n, field_kind kind, char *out)
{
    const bool blank = strspn(s, " ") >= (size_t)n;
    if (blank && kind == OPTIONAL) {
        strcpy(out, "0");
        return NULL;
    }
    if (blank) return "is blank";
    strcpy(out, kind == FRACTION ? "0." : "");
    char *digits = out + strlen(out);
    if (!zero_filled(s, n, digits)) return "does not consist of digits";
    digits[n] = '\0';
    return NULL;
}

static const char *normalise_fixed(const char *s, int n, int point, char *out)
{
    int first = (int)strspn(s, " ");
    if (first >= n) return "is blank";
    int length = 0;
    if (s[first] == '-' || s[first] == '+') out[length++] = s[first++];
    if (first > point || s[point] != '.') return "has no decimal point in its column";
    if (first == point) out[length++] = '0';
    for (int k = first; k < n; k++) {
        if (k != point && !is_digit(s[k])) return "is not a number that fills its columns";
        out[length++] = s[k];
    }
    out[length] = '\0';
    return NULL;
}

static const char *normalise_power(const char *s, int n, char *out)
{
    if (strspn(s, " ") >= (size_t)n) return "is blank";
    const char sign = s[0], exponent_sign = s[6];
    if (!strchr(" +-", sign) || !strchr(" +-", exponent_sign) || !is_digit(s[7]))
        return "is not a fraction with an exponent";
    memcpy(out, sign == '-' ? "-0." : "+0.", 3);
    if (!zero_filled(s + 1, 5, out + 3)) return "has something else than digits in it";
    out[8] = 'e';
    out[9] = exponent_sign == '-' ? '-' : '+';
    out[10] = s[7];
    out[11] = '\0';
    return NULL;
}

static glint_status read_field(const tle_line *l, const field *f, double *value)
{
    const char *s = l->text + f->first - 1;
    const int n = f->last - f->first + 1;
    char plain[FIELD_ROOM];
    const char *problem = f->kind == POWER   ? normalise_power(s, n, plain)
                          : f->kind == FIXED ? normalise_fixed(s, n, f->point - f->first, plain)
                                             : normalise_digits(s, n, f->kind, plain);
    if (problem) return bad_field(l, f, problem);
    if (!number_read(plain, strlen(plain), value)) return bad_field(l, f, "is not a number");
    return GLINT_OK;
}

const element_range RANGE_INCLINATION_DEG = {"inclination", 0.0, 180.00005};
const element_range RANGE_NODE_DEG = {"right ascension of the node", 0.0, 360.00005};
const element_range RANGE_PERIGEE_DEG = {"argument of perigee", 0.0, 360.00005};
const element_range RANGE_ANOMALY_DEG = {"mean anomaly", 0.0, 360.00005};
const element_range RANGE_ECCENTRICITY = {"eccentricity", 0.0, 1.0};
const element_range RANGE_MOTION_REV_DAY = {"mean motion", 1e-8, 100.0}; /* rev/day */
static const element_range RANGE_EPOCH_DAY = {"epoch day", 1.0, 367.0};

glint_status element_check(const element_range *range, double value, place where,
                           glint_error *error)
{
    if (value >= range->min && value < range->max) return GLINT_OK;
    return error_set(error, GLINT_INPUT, where, "the %s is %.9g; expected at least %g and below %g",
                     range->name, value, range->min, range->max);
}

/* Reads a field and holds it against its range. */
static glint_status read_within(const tle_line *l, const field *f, const element_range *range,
                                double *value)
{
    const glint_status status = read_field(l, f, value);
    return status ? status : element_check(range, *value, at_column(l, f->first), l->error);
}

static glint_status read_angle(const tle_line *l, const field *f, const element_range *range,
                               double *angle)
{
    double angle_deg;
    const glint_status status = read_within(l, f, range, &angle_deg);
    if (!status) *angle = angle_deg * DEG;
    return status;
}

bool tle_number_read(const char *s, int *value)
{
    static const char letters[] = "ABCDEFGHJKLMNPQRSTUVWXYZ"; /* Alpha-5: no I, no O; A is 10 */
    char digits[5];
    int head = 0;
    const char *letter = s[0] ? strchr(letters, s[0]) : NULL;
    if (letter) {
        head = 10 + (int)(letter - letters);
        if (s[1] == ' ') return false; /* zeros are written out behind a letter */
        digits[0] = '0';
        if (!zero_filled(s + 1, 4, digits + 1)) return false;
    } else if (!zero_filled(s, 5, digits)) {
        return false;
    }
    int tail = 0;
    for (int k = 0; k < 5; k++)
        tail = 10 * tail + (digits[k] - '0');
    *value = head * 10000 + tail;
    return true;
}

/* Sum modulo 10 of the digits of columns 1 to 68, a minus counting as 1. */
static int checksum(const char *line)
{
    int sum = 0;
    for (int k = 0; k < CHECKSUM_COLUMN - 1; k++)
        sum += is_digit(line[k]) ? line[k] - '0' : line[k] == '-';
    return sum % 10;
}

static glint_status check_sum(const tle_line *l)
{
    const char found = l->text[CHECKSUM_COLUMN - 1];
    const int expected = checksum(l->text);
    if (!is_digit(found) || found - '0' != expected)
        return error_set(l->error, GLINT_INPUT, at_column(l, CHECKSUM_COLUMN),
                         "the checksum of line %d (column 69) is '%c'; its characters give %d: one "
                         "of them was changed or lost; get the element set again",
                         l->which, shown(found), expected);
    const size_t blanks = strspn(l->text + LINE_LENGTH, " \t");
    if (LINE_LENGTH + blanks < l->length)
        return error_set(l->error, GLINT_INPUT, at_column(l, LINE_LENGTH + (int)blanks + 1),
                         "line %d goes on after its checksum in column 69; expected nothing "
                         "there; take the rest away",
                         l->which);
    return GLINT_OK;
}

/* Length, line number, the blank columns between fields, checksum. */
static glint_status check_frame(const tle_line *l, const int *blank_columns, bool check_sums)
{
    const size_t least = check_sums ? LINE_LENGTH : LINE_LENGTH - 1;
    if (l->length < least)
        return error_set(l->error, GLINT_INPUT, at_column(l, (int)l->length + 1),
                         "line %d of the element set has %zu characters; expected %zu: it was cut "
                         "short; get the element set again",
                         l->which, l->length, least);
    if (l->text[0] != '0' + l->which || l->text[1] != ' ')
        return error_set(l->error, GLINT_INPUT, at_column(l, 1),
                         "line %d of an element set begins with '%c%c'; expected '%d '", l->which,
                         shown(l->text[0]), shown(l->text[1]), l->which);
    for (const int *c = blank_columns; *c; c++)
        if (l->text[*c - 1] != ' ')
            return error_set(l->error, GLINT_INPUT, at_column(l, *c),
                             "column %d of line %d is '%c'; expected a blank between two fields: "
                             "the line is shifted or damaged; get the element set again",
                             *c, l->which, shown(l->text[*c - 1]));
    return check_sums ? check_sum(l) : GLINT_OK;
}

static glint_status read_number(const tle_line *l, int *number)
{
    static const field catalogue = {"catalogue number", 3, 7, DIGITS, 0, "25544"};
    if (tle_number_read(l->text + 2, number)) return GLINT_OK;
    return bad_field(l, &catalogue, "is neither five digits nor Alpha-5");
}

/* The international designator, blanks trimmed (blanks inside stay). */
static void read_designator(const tle_line *l, tle *out)
{
    const char *from = l->text + 9, *to = l->text + 17; /* columns 10 to 17 */
    while (from < to && *from == ' ')
        from++;
    while (to > from && to[-1] == ' ')
        to--;
    const size_t n = (size_t)(to - from);
    memcpy(out->designator, from, n);
    out->designator[n] = '\0';
}

/* Classification and ephemeris type. */
static glint_status check_kind(const tle_line *l)
{
    const char classification = l->text[7]; /* column 8 */
    if (classification != ' ' && !isupper((unsigned char)classification))
        return error_set(l->error, GLINT_INPUT, at_column(l, 8),
                         "the classification (column 8 of line 1) is '%c'; expected 'U' or another "
                         "capital letter: the line is shifted or damaged",
                         shown(classification));
    const char type = l->text[62];                                                 /* column 63 */
    if (type == ' ' || type == '0' || type == '2' || type == '3') return GLINT_OK; /* SGP4, SDP4 */
    if (type == '4')
        return error_set(l->error, GLINT_INPUT, at_column(l, 63),
                         "ephemeris type 4: this is an SGP4-XP element set, which SGP4 would "
                         "propagate wrongly; expected type 0; get the SGP4 element set");
    return error_set(l->error, GLINT_INPUT, at_column(l, 63),
                     "ephemeris type '%c' (column 63) is not one of SGP4; expected 0; get the SGP4 "
                     "element set",
                     shown(type));
}

static glint_status read_epoch(const tle_line *l, double epoch_jd[2])
{
    double year, day;
    glint_status status = read_field(l, &epoch_year, &year);
    if (!status) status = read_within(l, &epoch_day, &RANGE_EPOCH_DAY, &day);
    if (status) return status;
    /* Day and fraction apart, so that the fraction keeps all its decimals. */
    const double whole = floor(day);
    char fraction[FIELD_ROOM] = "0";
    const int n = epoch_day.last - epoch_day.point + 1;
    memcpy(fraction + 1, l->text + epoch_day.point - 1, (size_t)n);
    if (!number_read(fraction, (size_t)n + 1, &epoch_jd[1]))
        return bad_field(l, &epoch_day, "is not a number");
    double zero, january_1_mjd;
    eraCal2jd((int)year + (year < 57.0 ? 2000 : 1900), 1, 1, &zero, &january_1_mjd);
    epoch_jd[0] = zero + january_1_mjd + (whole - 1.0);
    /* Element sets count fractions of 86 400 s on every day, quasi-JDs fractions of the day. */
    epoch_jd[1] *= DAY_S / utc_day_length_s(epoch_jd[0]);
    return GLINT_OK;
}

static glint_status read_line1(const tle_line *l, bool check_sums, tle *out)
{
    static const int blanks[] = {9, 18, 33, 44, 53, 62, 64, 0};
    double unused;
    glint_status status = check_frame(l, blanks, check_sums);
    if (!status) status = check_kind(l);
    if (!status) status = read_number(l, &out->number);
    if (!status) status = read_epoch(l, out->epoch_jd);
    if (!status) status = read_field(l, &motion_dot, &out->mean_motion_dot);
    if (!status) status = read_field(l, &motion_dot2, &unused);
    if (!status) status = read_field(l, &drag_term, &out->bstar);
    if (!status) status = read_field(l, &set_number, &unused);
    if (!status) read_designator(l, out);
    return status;
}

static glint_status read_line2(const tle_line *l, bool check_sums, tle *out)
{
    static const int blanks[] = {8, 17, 26, 34, 43, 52, 0};
    int number;
    double rev_per_day, unused;
    glint_status status = check_frame(l, blanks, check_sums);
    if (!status) status = read_number(l, &number);
    if (!status && number != out->number)
        return error_set(l->error, GLINT_INPUT, at_column(l, 3),
                         "line 2 is of satellite %d and line 1 of %d; expected two lines of one "
                         "element set",
                         number, out->number);
    if (!status) status = read_angle(l, &inclination, &RANGE_INCLINATION_DEG, &out->inclination);
    if (!status) status = read_angle(l, &node, &RANGE_NODE_DEG, &out->raan);
    if (!status) status = read_field(l, &eccentricity, &out->eccentricity);
    if (!status) status = read_angle(l, &perigee, &RANGE_PERIGEE_DEG, &out->argument_of_perigee);
    if (!status) status = read_angle(l, &anomaly, &RANGE_ANOMALY_DEG, &out->mean_anomaly);
    if (!status) status = read_within(l, &mean_motion, &RANGE_MOTION_REV_DAY, &rev_per_day);
    if (!status) status = read_field(l, &revolution, &unused);
    if (status) return status;
    out->mean_motion = rev_per_day * TWO_PI / 1440.0; /* rad/min */
    return GLINT_OK;
}

glint_status tle_parse(const char *line1, const char *line2, bool check_sums, place where,
                       const place *where2, tle *out, glint_error *error)
{
    place second = where;
    if (second.line > 0) second.line++;
    if (where2) second = *where2;
    const tle_line first_line = {line1, strcspn(line1, "\r\n"), 1, where, error};
    const tle_line second_line = {line2, strcspn(line2, "\r\n"), 2, second, error};
    tle read = {.where = where};
    glint_status status = read_line1(&first_line, check_sums, &read);
    if (!status) status = read_line2(&second_line, check_sums, &read);
    if (!status) *out = read;
    return status;
}
