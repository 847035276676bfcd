/* What others see of the solution of square systems. */
#ifndef ACAUSAL_SETTLE_H
#define ACAUSAL_SETTLE_H

#include "core.h"

struct ac_settler {
    ac_square of;
    ac_lu *lu;
    char *bends; /* of each place of the tape, whether an entry of the Jacobian depends on it */
    double *w, *entries, *step, *size, *wide, *terms, *first, *from, *exact; /* w: all the memory; first: unknowns as they were given */
};

#endif
