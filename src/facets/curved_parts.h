/* curved_parts.h: what the two files of curved.h share; private to them. */
#ifndef GLINT_FACETS_CURVED_PARTS_H
#define GLINT_FACETS_CURVED_PARTS_H

#include "facets/curved.h"

#define CURVED_ACTIVE 1.0
#define CURVED_OFF 0.004
#define CURVED_FINE 1.6
#define CURVED_NEAR 3.0
#define CURVED_CORE 4.0
#define CURVED_FAR 0.5
#define CURVED_FLAT 0.25

#endif
