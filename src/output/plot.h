/* plot.h: pictures drawn by gnuplot, which is a program of its own, found on PATH when it is
 * needed. The script goes to it and the picture comes back through pipes: no shell is asked, and
 * gnuplot is told no file name. */
#ifndef GLINT_OUTPUT_PLOT_H
#define GLINT_OUTPUT_PLOT_H

#include "base/text.h"

/* A picture being made. */
typedef struct plot plot;

/* Begins a picture. path: its suffix, .svg, .png or .pdf, says the kind; as with out_file_open a
 * regular file appears whole or not at all, which is settled by plot_finish. Errors: GLINT_ARGUMENT
 * for another suffix; GLINT_OUTPUT where there is no gnuplot, or no file can be written there. */
glint_status plot_open(const char *path, plot **out, glint_error *error);
/* Draws and puts the file in its place; frees `p` either way.
 * script: n bytes of gnuplot commands with their data in them (blocks "$name << end"). Before them,
 * gnuplot is told the terminal (1200 x 800 px, or 25 x 16.7 cm) and UTF-8; nothing else differs
 * from its defaults. What a user wrote goes through plot_quote. Errors: GLINT_OUTPUT with what
 * gnuplot said, or from writing the file; GLINT_INTERNAL. */
glint_status plot_finish(plot *p, const char *script, size_t n, glint_error *error);
/* Leaves nothing behind. NULL is fine. */
void plot_abandon(plot *p);

/* Seconds of UTC since 1970, without leap seconds: what the axis below counts. */
double plot_utc_s(const glint_utc *utc);
/* Appends what makes the horizontal axis one of UTC, from from_s to to_s of plot_utc_s; `marks` is
 * then what its marks show (set format x marks), and `bottom` the text below it, with the date. */
void plot_time_axis(double from_s, double to_s, text *script);

/* The smallest of 1, 2 and 5 times a power of ten that is not below `least` > 0: a step of marks.
 */
double plot_round_step(double least);

/* Appends a text to a script as a string (an expression that begins with a quote) that gnuplot
 * takes as it is: nothing in it is substituted, it stays on one line, and bytes that are no UTF-8
 * become '?'. Whether '_' and '^' set letters lower or higher is a matter of the command that takes
 * the string (noenhanced). */
void plot_quote(text *script, const char *string);

#endif
