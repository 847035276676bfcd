/* What the parts of runs over planned instants share. */
#ifndef ACAUSAL_SAMPLER_H
#define ACAUSAL_SAMPLER_H

#include "core.h"

#define LOOKS 64 /* parts of a step at whose ends conditions are looked at, at most */

/* Values at one time or at some: times, states, algebraic unknowns, conditions and their rates. */
typedef struct {
    double *time, *x, *z, *found;
} ac_looks;

struct ac_sampler {
    ac_sampled of;
    ac_rodas *rodas;
    ac_settler *whole, *needed, *moving, *powering;
    double *block;                    /* all the memory, but for the flags */
    int32_t *settled, *risen, *truth; /* (LOOKS + 1), (conditions) positive in this leg, (conditions) before an instant */
    ac_looks now, looks;              /* one row, LOOKS + 1 rows */
    double *c;                        /* constants now */
    double *tape, *size, *sizes, *picked, *rates, *ones; /* tape: of whichever is evaluated */
    double *acted, *width, *coordinates; /* what acts; how far conditions may be off; what is projected */
    double *energies, work[2];        /* (LOOKS + 1, 3) powers and stored energy; supplied and dissipated energy so far */
    double *step_y, *dense, *before;  /* end of a step, its interpolant, its start */
    ac_samples request;
    int64_t evaluations;
};

int ac_sampler_settle(ac_sampler *s, ac_settler *by, const ac_square *q, int32_t rows, ac_looks *at);
int ac_sampler_watch(ac_sampler *s, int32_t rows, ac_looks *at);
int ac_sampler_work(ac_sampler *s, double begin, double end, double from, double to);
int ac_sampler_stored(ac_sampler *s, double *stored);
void ac_sampler_gain(ac_sampler *s, double change);
int ac_sampler_clear(ac_sampler *s, int32_t parts, const int32_t *truth, const double *first);

#endif
