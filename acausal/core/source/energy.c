/* Supplied and dissipated energy: quadrature of the powers on the dense output of a step. */
#include "instance.h"

#include <math.h>

#define FEWEST 4      /* panels of a part of a step, in each of which a rule of order 6 holds; then twice as many */
#define MOST 16384    /* where a motion is simple, a step may have thousands of turns */
#define BATCH 8       /* panels that are evaluated at once */
#define CAUTION 300   /* times the error that is expected */
#define FAINT 1e-9    /* of the greater power: the other one, where it is smaller, need not be integrated as exactly */
#define ROUNDED 1e-13 /* of the stored energy: smaller errors do not show in its change */

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

/* Integrals of the powers over a time in so many panels, estimates of their errors, and the largest powers and stored energy. With the cubic c_0 + c_1 t + c_2 t^2 + c_3 t^3
   through the four nodes of a panel, t from -1 to 1, a power of amplitude A has terms of about c_3^2 / (20 A) t^6 and
   c_2^3 / (90 A^2) t^6, of which the rule misses 0.03 of the panel's length. */
static int32_t integrate(ac_instance *i, double from, double h, int32_t panels, double *largest, double *sum, double *error) {
    const double a = 1 / sqrt(5), length = h / panels;
    double weight;
    for (int j = 0; j < 2; j++) sum[j] = error[j] = 0;
    for (int32_t first = 0; first < panels; first += BATCH) {
        const int32_t some = panels - first < BATCH ? panels - first : BATCH, rows = some * AC_NODES;
        for (int32_t k = 0; k < rows; k++) {
            i->samples.time[k] = from + (first + k / AC_NODES + ac_lobatto(k % AC_NODES, &weight)) * length;
        }
        ac_sample_step(i, rows);
        const int32_t failed = ac_sample_energies(i, rows);
        if (failed) return failed;
        for (int j = 0; j < 3; j++) {
            for (int32_t k = 0; k < rows; k++) largest[j] = fmax(largest[j], fabs(i->samples.found[3 * k + j]));
        }
        for (int32_t k = 0; k < some; k++) {
            for (int j = 0; j < 2; j++) {
                const double *p = i->samples.found + 3 * k * AC_NODES + j, A = largest[j];
                const double c2 = fabs(p[0] + p[9] - p[3] - p[6]) / 2 / (1 - a * a);
                const double c3 = fabs(p[9] - p[0] - (p[6] - p[3]) / a) / 2 / (1 - a * a);
                for (int n = 0; n < AC_NODES; n++) ac_lobatto(n, &weight), sum[j] += weight * length * p[3 * n];
                if (A > 0) error[j] += CAUTION * 0.03 * length * fmax(c3 * c3 / (20 * A), c2 * c2 * c2 / (90 * A * A));
            }
        }
    }
    return AC_OK;
}

/* Add the integrals of the powers over a part of the last step, in as many panels as they need. */
int32_t ac_add_work(ac_instance *i, double from, double to) {
    const double step = i->now.to - i->now.from, h = to - from;
    if (!i->of->row_tape[AC_ENERGIES].outputs || !(h > 0) || !(step > 0)) return AC_OK;
    if (i->now.crosses) return add_between_ends(i, from, to);
    double sum[2], error[2], largest[3] = {0, 0, 0};
    for (int32_t panels = FEWEST;; panels *= 2) {
        const int32_t failed = integrate(i, from, h, panels, largest, sum, error);
        if (failed) return failed;
        const double faint = FAINT * fmax(largest[0], largest[1]), rounded = ROUNDED * largest[2];
        int enough = 1;
        for (int j = 0; j < 2; j++) enough &= error[j] <= i->now.tolerance * h * fmax(largest[j], faint) + rounded;
        if (enough || panels >= MOST) break;
    }
    for (int j = 0; j < 2; j++) i->energy[j] += sum[j];
    return AC_OK;
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
