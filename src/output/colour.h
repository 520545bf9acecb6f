/* colour.h: colours that can be told apart in print and by people who see colours differently. */
#ifndef GLINT_OUTPUT_COLOUR_H
#define GLINT_OUTPUT_COLOUR_H

/* sRGB, 0 to 1 each. */
typedef struct colour {
    double red, green, blue;
} colour;

/* From Oklab (Ottosson 2020, https://bottosson.github.io/posts/oklab): lightness 0 (black) to 1
 * (white), a towards red, b towards yellow. What lies outside of sRGB is clipped. */
colour colour_oklab(double lightness, double a, double b);

/* A scale for numbers, 0 to 1 (clamped): from dark blue over red to a light yellow. Its lightness
 * rises evenly, so that the order of values is seen without the hues. */
colour colour_scale(double t);

/* Colour k of a set whose members are told apart by everybody: the eight of Okabe and Ito (2008,
 * Color universal design) but black, then lighter and darker ones of the same. */
colour colour_of_set(int k);

/* The colour as it looks in less light: brightness 0 (black) to 1 (as it is). */
colour colour_dim(colour c, double brightness);

#endif
