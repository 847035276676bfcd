/* Supplied and dissipated energy in a run over planned instants. */
#include "file.h"
#include "rodas.h"
#include "sampler.h"

#include <math.h>

#define PANELS 8 /* of a step, or between two outputs in it: as close as conditions are looked at */

/* Powers and stored energy in some rows; whether all have values. */
static int evaluate(ac_sampler *s, int32_t rows, ac_looks *at) {
    const ac_equations *e = s->of.equations;
    const int32_t length[5] = {e->np, e->nc, e->nx, e->nz, 1}, stride[5] = {0, 0, e->nx, e->nz, 1};
    const double *part[5] = {s->request.p, s->c, at->x, at->z, at->time};
    if (!ac_sampler_settle(s, s->powering, s->of.powering, rows, at)) return 0;
    ac_tape_rows(s->of.energies, s->tape, rows, 5, length, stride, part, s->energies);
    return ac_all_finite(s->energies, 3 * rows);
}

/* Add what the powers supply and dissipate in a part of the last step, which goes from begin to end; whether they have values. */
int ac_sampler_work(ac_sampler *s, double begin, double end, double from, double to) {
    const int32_t nx = s->of.equations->nx, nz = s->of.equations->nz, n = nx + nz, rows = PANELS * AC_NODES;
    const double h = (to - from) / PANELS;
    double weight;
    ac_looks *l = &s->looks, rest = {l->time + 1, l->x + nx, l->z + nz, NULL};
    if (!s->of.energies) return 1;
    for (int32_t k = 0; k < rows; k++) {
        rest.time[k] = from + (k / AC_NODES + ac_lobatto(k % AC_NODES, &weight)) * h;
        const double part = (rest.time[k] - begin) / (end - begin);
        ac_interpolate(n, s->before, s->step_y, s->dense, part, 0, nx, rest.x + k * nx);
        ac_interpolate(n, s->before, s->step_y, s->dense, part, nx, nz, rest.z + k * nz);
    }
    if (!evaluate(s, rows, &rest)) return 0;
    for (int32_t k = 0; k < rows; k++) {
        ac_lobatto(k % AC_NODES, &weight);
        for (int32_t j = 0; j < 2; j++) s->work[j] += weight * h * s->energies[3 * k + j];
    }
    return 1;
}

/* The energy that is stored at the present; whether it has a value. */
int ac_sampler_stored(ac_sampler *s, double *stored) {
    *stored = 0;
    if (!s->of.energies) return 1;
    if (!evaluate(s, 1, &s->now)) return 0;
    *stored = s->energies[2];
    return 1;
}

/* What is stored more after an instant was supplied there, what is stored less was dissipated. */
void ac_sampler_gain(ac_sampler *s, double change) {
    s->work[change < 0] += fabs(change);
}
