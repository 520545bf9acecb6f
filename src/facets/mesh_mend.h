/* mesh_mend.h: what is wrong with a mesh, and what can be done about it; private to this room. */
#ifndef GLINT_FACETS_MESH_MEND_H
#define GLINT_FACETS_MESH_MEND_H

#include "facets/mesh.h"

typedef enum mesh_defect {
    DEFECT_UNUSED,     /* vertices that no face uses; they have no lines */
    DEFECT_DEGENERATE, /* faces without area; always left out */
    DEFECT_DUPLICATE,  /* faces that stand there already, looking the same way */
    DEFECT_REVERSED,   /* faces that look the other way than most of their piece */
    DEFECT_INSIDE_OUT, /* faces of closed pieces that enclose a negative volume */
    DEFECT_CROWDED,    /* edges of more than two faces, but of sheets with faces on both sides */
    DEFECT_OPEN,       /* edges of one face */
    DEFECT_BACKWARD,   /* faces whose normals in the file look the other way */
    N_DEFECTS
} mesh_defect;

enum { DEFECT_EXAMPLES = 3 };

typedef struct mesh_defects {
    int n[N_DEFECTS];
    int line[N_DEFECTS][DEFECT_EXAMPLES]; /* of a face; the first ones of the file, rising; 0:
                                              none is known */
    int n_pieces;                         /* of faces that hang together along edges */
} mesh_defects;

/* What a number of defects is called, as in "3 <words>". */
const char *mesh_defect_words(mesh_defect defect, int n);
/* Counts a defect; the lowest lines are kept as examples, each once. */
void mesh_defect_note(mesh_defects *d, mesh_defect defect, int line);
/* True for defects that repair does something about: DUPLICATE faces are left out, REVERSED and
 * INSIDE_OUT ones turned round. Nothing closes holes. */
bool mesh_defect_is_mended(mesh_defect defect);

/* Makes vertices nearer than same_m (m; above 0) one, leaves degenerate faces out, and looks for
 * the other defects; repair: mends those that can be. Vertices are in m. Errors: GLINT_INPUT when
 * no face is left; GLINT_INTERNAL (memory). */
glint_status mesh_mend(mesh *m, double same_m, bool repair, mesh_defects *out, glint_error *error);

/* The half-edge that runs along the same edge the other way, for each of the 3 n_faces half-edges
 * (3 face + j runs from corner j to the next), or -1. An edge has these two alone; or of its
 * more faces, these two go on in one plane.
 * Errors: GLINT_INTERNAL (memory). */
glint_status mesh_twins(const mesh *m, int *twin, glint_error *error);

#endif
