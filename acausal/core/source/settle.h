/* What others see of the solution of square systems. */
#ifndef ACAUSAL_SETTLE_H
#define ACAUSAL_SETTLE_H

#include "core.h"

struct ac_settler {
    ac_square of;
    ac_lu *lu;
    double *w, *entries, *step; /* w: all the memory */
};

#endif
