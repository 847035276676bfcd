/* Event indicators and powers at many points of a step: the algebraic unknowns that they need are solved for, no others. */
#include "file.h"
#include "instance.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Scale of each algebraic unknown in some rows; values far below the largest may be round-off. */
static void find_scales(const ac_instance *i, int32_t rows, const double *z, double *scale) {
    const int32_t nz = i->of->parts.model.equations.nz;
    double largest = 0;
    for (int32_t k = 0; k < nz; k++) {
        scale[k] = 0;
        for (int32_t r = 0; r < rows; r++) scale[k] = fmax(scale[k], fabs(z[(ptrdiff_t)r * nz + k]));
        largest = fmax(largest, scale[k] / i->of->size[k]);
    }
    for (int32_t k = 0; k < nz; k++) {
        const double declared = i->of->size[k];
        scale[k] = largest > 0 ? fmax(scale[k], NOISE * largest * declared) : declared;
    }
}

/* Inputs of the squares and row tapes at the samples. */
typedef struct {
    int32_t length[6], stride[6];
    const double *part[6];
} row_inputs;

static row_inputs inputs_of(const ac_instance *i, const double *more, int32_t count) {
    const ac_equations *e = &i->of->parts.model.equations;
    const ac_samples *s = &i->samples;
    return (row_inputs){
        {e->np, e->nc, e->nx, e->nz, 1, count}, {0, 0, e->nx, e->nz, 1, more ? count : 0}, {i->p, i->c, s->x, s->z, s->time, more},
    };
}

/* Solve for the algebraic unknowns of a square in some rows; where rounding is more than their own values allow, to their nominal sizes. */
static int32_t solve(ac_instance *i, int32_t square, int32_t rows) {
    const ac_square *q = &i->of->square[square];
    const ac_equations *e = &i->of->parts.model.equations;
    const int32_t first = e->np + e->nc + e->nx;
    ac_samples *s = &i->samples;
    double *scale = s->scale, *own = scale + e->nz;
    if (!q->n) return AC_OK;
    row_inputs in = inputs_of(i, NULL, 0);
    find_scales(i, rows, s->z, scale);
    for (int32_t k = 0; k < q->n; k++) own[k] = scale[q->unknown[k] - first];
    i->counts.evaluations += ac_settle_rows(i->settler[square], rows, 5, 2, in.length, in.stride, in.part, own, SETTLED, s->solution, s->solved);
    for (int32_t k = 0; k < q->n; k++) own[k] = fmax(own[k], i->of->size[q->unknown[k] - first]);
    for (int32_t r = 0; r < rows; r++) {
        double *solution = s->solution + (ptrdiff_t)r * q->n, *z = s->z + (ptrdiff_t)r * e->nz;
        if (!s->solved[r]) {
            in.part[2] = s->x + (ptrdiff_t)r * e->nx, in.part[3] = z, in.part[4] = s->time + r;
            i->counts.evaluations += ac_settle_rows(i->settler[square], 1, 5, 2, in.length, in.stride, in.part, own, SETTLED, solution, s->solved + r);
        }
        if (!s->solved[r]) return ac_fail(i, AC_RETRY, AC_UNSOLVED_TEXT);
        for (int32_t k = 0; k < q->n; k++) z[q->unknown[k] - first] = solution[k];
    }
    return AC_OK;
}

/* States and algebraic unknowns at the times of some samples, which lie in the last step. */
void ac_sample_step(ac_instance *i, int32_t rows) {
    const int32_t nx = ac_states(i), nz = i->of->parts.model.equations.nz, n = nx + nz, dense = i->stepper->method->rows;
    const double h = i->now.to - i->now.from;
    ac_samples *s = &i->samples;
    for (int32_t r = 0; r < rows; r++) {
        const double part = h > 0 ? fmin((s->time[r] - i->now.from) / h, 1) : 1;
        ac_interpolate(n, dense, i->before, i->after, i->dense, part, 0, nx, s->x + (ptrdiff_t)r * nx);
        ac_interpolate(n, dense, i->before, i->after, i->dense, part, nx, nz, s->z + (ptrdiff_t)r * nz);
    }
}

/* Event indicators and their derivatives in some samples: `found` (rows, 2 watched). */
int32_t ac_sample_indicators(ac_instance *i, int32_t rows) {
    const int32_t n = i->of->square[AC_MOVING].n;
    ac_samples *s = &i->samples;
    const int32_t failed = solve(i, AC_INDICATING, rows);
    if (failed) return failed;
    memset(s->scale, 0, (size_t)n * sizeof *s->scale);
    row_inputs in = inputs_of(i, s->scale, n);
    in.stride[5] = 0;
    if (n) {
        /* The equations are linear: one step of Newton's method solves them. */
        double *ones = s->scale + n;
        for (int32_t k = 0; k < n; k++) ones[k] = 1;
        i->counts.evaluations += ac_settle_rows(i->settler[AC_MOVING], rows, 6, 2, in.length, in.stride, in.part, ones, INFINITY, s->solution, s->solved);
        for (int32_t r = 0; r < rows; r++) {
            if (!s->solved[r]) return ac_fail(i, AC_RETRY, AC_UNSOLVED_TEXT);
        }
        in = inputs_of(i, s->solution, n);
    }
    ac_tape_rows(&i->of->row_tape[AC_INDICATORS], i->row_w, rows, 6, in.length, in.stride, in.part, s->found);
    return AC_OK;
}

/* Supplied and dissipated power and stored energy in some samples: `found` (rows, 3). */
int32_t ac_sample_energies(ac_instance *i, int32_t rows) {
    ac_samples *s = &i->samples;
    const int32_t failed = solve(i, AC_POWERING, rows);
    if (failed) return failed;
    const row_inputs in = inputs_of(i, NULL, 0);
    ac_tape_rows(&i->of->row_tape[AC_ENERGIES], i->row_w, rows, 5, in.length, in.stride, in.part, s->found);
    return ac_all_finite(s->found, 3 * rows) ? AC_OK : ac_fail(i, AC_RETRY, "a power has no finite value.");
}

/* Whether any equation depends on a condition at row r of what was sampled; conditions that trigger events always matter. */
int ac_matters(ac_instance *i, int32_t r, int32_t guard) {
    const ac_equations *e = &i->of->parts.model.equations;
    const ac_tape *t = e->values;
    const int32_t on = i->of->guard[guard].on;
    double *w = malloc((ac_tape_length(t) + (size_t)t->outputs) * sizeof *w), *found = w + ac_tape_length(t);
    int different = !w || on < 0;
    if (!different) {
        memcpy(w, t->constant, (size_t)t->constants * sizeof *w);
        double *input = w + t->constants, *c = input + e->nx + e->nz + 1 + e->np;
        ac_put(input, i->samples.x + (ptrdiff_t)r * e->nx, e->nx), ac_put(input + e->nx, i->samples.z + (ptrdiff_t)r * e->nz, e->nz);
        input[e->nx + e->nz] = i->samples.time[r];
        ac_put(c - e->np, i->p, e->np), ac_put(c, i->c, e->nc);
        for (int holds = 0; holds < 2; holds++) {
            c[on] = holds;
            ac_tape_run(t, w, 0, t->runs);
            for (int32_t k = 0; k < t->outputs; k++) {
                const double value = w[t->output[k]];
                different |= holds && value != found[k] && !(isnan(value) && isnan(found[k]));
                found[k] = value;
            }
        }
    }
    free(w);
    return different;
}
