/* Supplied and dissipated energy: quadrature of the powers on the dense output of a step. */
#include "instance.h"

#include <math.h>

#define PANELS 8 /* of a step, in each of which a rule of order 6 holds; of a part of a step, as many as it is long */

/* The same where the equations have no unique solution within a short step: powers are taken from its ends. */
static int32_t add_between_ends(ac_instance *i, double from, double to) {
    const double step = i->now.to - i->now.from, part = ((from + to) / 2 - i->now.from) / step;
    i->samples.time[0] = i->now.from, i->samples.time[1] = i->now.to;
    ac_sample_step(i, 2);
    const int32_t failed = ac_sample_energies(i, 2);
    const double *power = i->samples.found;
    for (int32_t j = 0; j < 2 && !failed; j++) i->energy[j] += (to - from) * ((1 - part) * power[j] + part * power[3 + j]);
    return failed;
}

/* Add the integrals of the powers over a part of the last step. */
int32_t ac_add_work(ac_instance *i, double from, double to) {
    const double step = i->now.to - i->now.from, h = to - from;
    if (!i->of->row_tape[AC_ENERGIES].outputs || !(h > 0) || !(step > 0)) return AC_OK;
    if (i->now.crosses) return add_between_ends(i, from, to);
    const int32_t panels = (int32_t)fmax(1, fmin(PANELS, ceil(PANELS * h / step))), rows = panels * AC_NODES;
    double weight;
    for (int32_t k = 0; k < rows; k++) {
        i->samples.time[k] = from + (k / AC_NODES + ac_lobatto(k % AC_NODES, &weight)) * h / panels;
    }
    ac_sample_step(i, rows);
    const int32_t failed = ac_sample_energies(i, rows);
    for (int32_t k = 0; k < rows && !failed; k++) {
        ac_lobatto(k % AC_NODES, &weight);
        for (int32_t j = 0; j < 2; j++) i->energy[j] += weight * h / panels * i->samples.found[3 * k + j];
    }
    return failed;
}

/* The energy that is stored at present. */
int32_t ac_stored_energy(ac_instance *i, double *stored) {
    const ac_equations *e = &i->of->parts.model.equations;
    *stored = 0;
    if (!i->of->row_tape[AC_ENERGIES].outputs) return AC_OK;
    i->samples.time[0] = i->now.time;
    ac_put(i->samples.x, i->x, e->nx), ac_put(i->samples.z, i->z, e->nz);
    const int32_t failed = ac_sample_energies(i, 1);
    if (!failed) *stored = i->samples.found[2];
    return failed;
}

/* What an event adds to the stored energy is supplied, what it takes is dissipated. */
void ac_add_jump(ac_instance *i, double change) { i->energy[change < 0] += fabs(change); }
