/* fit_toml.c: a fitted material as a table of a model file. */
#include "brdf/fit.h"

/* Length of the UTF-8 character that begins the terminated text s; 0 where there is none. */
static size_t utf8_length(const unsigned char *s)
{
    const size_t n = s[0] < 0x80                   ? 1
                     : s[0] >= 0xc2 && s[0] < 0xe0 ? 2
                     : s[0] >= 0xe0 && s[0] < 0xf0 ? 3
                     : s[0] >= 0xf0 && s[0] < 0xf5 ? 4
                                                   : 0;
    for (size_t k = 1; k < n; k++)
        if ((s[k] & 0xc0) != 0x80) return 0;
    /* longer than need be, halves of pairs, past the last character */
    if (s[0] == 0xe0 && s[1] < 0xa0) return 0;
    if (s[0] == 0xed && s[1] > 0x9f) return 0;
    if (s[0] == 0xf0 && s[1] < 0x90) return 0;
    if (s[0] == 0xf4 && s[1] > 0x8f) return 0;
    return n;
}

/* A basic string of TOML. Bytes that are no UTF-8, as in names of files, become '?'. */
static void add_string(text *out, const char *string)
{
    text_char(out, '"');
    for (const char *c = string; *c;) {
        const unsigned char byte = (unsigned char)*c;
        const size_t n = utf8_length((const unsigned char *)c);
        if (n == 0)
            text_char(out, '?');
        else if (byte < 0x20 || byte == 0x7f)
            text_printf(out, "\\u%04x", byte);
        else {
            if (byte == '"' || byte == '\\') text_char(out, '\\');
            text_append(out, c, n);
        }
        c += n > 0 ? n : 1;
    }
    text_char(out, '"');
}

/* Appends the keys of one lobe, each after `before` and with `after` behind all but the last. */
static void add_keys(const fit_result *r, int lobe, const char *before, const char *after,
                     text *out)
{
    text_printf(out, "%sbrdf = \"%s\"", before, r->form.lobes[lobe]->name);
    for (int k = 0; k < r->n_params; k++) {
        const fit_param *p = &r->params[k];
        if (p->lobe != lobe) continue;
        text_printf(out, "%s%s%s = ", after, before, r->form.lobes[lobe]->params[p->index].name);
        text_double(out, p->value);
    }
}

void fit_result_toml(const fit_result *result, const char *name, const char *source, text *out)
{
    text_printf(out, "[materials.%s]\n", name);
    if (result->form.n_lobes == 1) {
        add_keys(result, 0, "", "\n", out);
        text_char(out, '\n');
    } else {
        text_add(out, "brdf = \"sum\"\nparts = [\n");
        for (int k = 0; k < result->form.n_lobes; k++) {
            text_add(out, "    {");
            add_keys(result, k, " ", ",", out);
            text_add(out, " },\n");
        }
        text_add(out, "]\n");
    }
    text_add(out, "source = ");
    add_string(out, source);
    text_char(out, '\n');
}
