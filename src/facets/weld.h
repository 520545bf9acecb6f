/* weld.h: which vertices of a heap of polygons are one and the same corner. */
#ifndef GLINT_FACETS_WELD_H
#define GLINT_FACETS_WELD_H

#include "base/error.h"

#define WELD_SAME_M 1e-9 /* vertices nearer than this are one, m */

/* Gives numbers to n vertices (m; all finite): numbers[k] is k itself, or the number of an earlier
 * vertex that lies within WELD_SAME_M of vertex k. Time: linear in n. Errors: GLINT_INTERNAL
 * (memory). */
glint_status weld_vertices(const double (*vertices)[3], int n, int *numbers, glint_error *error);

/* The same within another distance, above 0 m and such that the largest coordinate is at most 1e16
 * of it. */
glint_status weld_vertices_within(const double (*vertices)[3], int n, double same_m, int *numbers,
                                  glint_error *error);

#endif
