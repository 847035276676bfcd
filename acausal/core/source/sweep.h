/* Derivatives of a tape along a direction, and their transpose. */
#ifndef ACAUSAL_SWEEP_H
#define ACAUSAL_SWEEP_H

#include "core.h"

void ac_sweep_forward(const ac_tape *tape, const double *w, double *dw);
void ac_sweep_backward(const ac_tape *tape, const double *w, double *dw);

#endif
