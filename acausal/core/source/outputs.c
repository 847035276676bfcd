/* What is found within a step: values at outputs, and integrals. */
#include "rodas.h"

#include <math.h>
#include <string.h>

/* Of the interpolant, order 4, see `rodas5p.h`. */
static const double H[3][STAGES] = {
    {25.948786856663858, -2.5579724845846235, 10.433815404888879, -2.3679251022685204, 0.524948541321073, 1.1241088310450404,
     0.4272876194431874, -0.17202221070155493},
    {-9.91568850695171, -0.9689944594115154, 3.0438037242978453, -24.495224566215796, 20.176138334709044, 15.98066361424651,
     -6.789040303419874, -6.710236069923372},
    {11.419903575922262, 2.8879645146136994, 72.92137995996029, 80.12511834622643, -52.072871366152654, -59.78993625266729,
     -0.15582684282751913, 4.883087185713722},
};

/* Some of n values at a part s of a step, from those at its ends and the coefficients of its interpolant. */
void ac_interpolate(int32_t n, const double *before, const double *after, const double *dense, double s, int32_t first,
                    int32_t count, double *y) {
    const double *a = dense, *b = a + n, *c = b + n;
    for (int32_t k = first; k < first + count; k++) {
        *y++ = (1 - s) * before[k] + s * (after[k] + (1 - s) * (a[k] + s * (b[k] + s * c[k])));
    }
}

static void interpolate(const ac_rodas *r, double s, double *y) {
    ac_interpolate(r->n, r->y, r->next, r->dense, s, 0, r->n, y);
}

double ac_lobatto(int k, double *weight) {
    const double at[AC_NODES] = {0, 0.5 - 0.5 / sqrt(5), 0.5 + 0.5 / sqrt(5), 1};
    *weight = k == 0 || k == AC_NODES - 1 ? 1. / 12 : 5. / 12;
    return at[k];
}

/* Integral of the powers over a part of the step, on the interpolant. */
static void gather(ac_rodas *r, double from, double to, double h) {
    const ac_tape *tape = r->of.powers;
    for (int k = 0; k < AC_NODES; k++) {
        double weight;
        const double s = from + ac_lobatto(k, &weight) * (to - from);
        interpolate(r, s, r->stage);
        ac_rodas_evaluate(r, tape, r->powers, r->stage, r->t + s * h);
        for (int32_t j = 0; j < tape->outputs && j < 2; j++) {
            r->gathered[j] += weight * (to - from) * h * r->powers[tape->output[j]];
        }
    }
}

/* Write the outputs that lie in the step, and what was gathered up to them. */
void ac_rodas_write(ac_rodas *r, double h, int last) {
    const ac_request *q = &r->request;
    const size_t nx = (size_t)r->of.nx, nz = (size_t)r->of.nz;
    const int32_t n = r->n;
    int32_t *written = &r->progress.written;
    const int due = *written < q->outputs && (last || q->time[*written + 1] <= r->t + h);
    if (!due && !r->of.powers && !q->step_dense) return;
    for (int32_t j = 0; j < 3; j++) {
        double *d = r->dense + (size_t)j * (size_t)n;
        memset(d, 0, (size_t)n * sizeof *d);
        for (int32_t i = 0; i < STAGES; i++) {
            for (int32_t k = 0; k < n; k++) d[k] += H[j][i] * r->u[(size_t)i * (size_t)n + (size_t)k];
        }
    }
    double from = 0;
    while (*written < q->outputs && (last || q->time[*written + 1] <= r->t + h)) {
        const double s = fmin((q->time[*written + 1] - r->t) / h, 1);
        if (r->of.powers) gather(r, from, s, h);
        from = s;
        if (q->taken) q->taken[*written] = (double)r->progress.steps + s;
        if (q->x) {
            interpolate(r, s, r->stage);
            if (nx) memcpy(q->x + (size_t)*written * nx, r->stage, nx * sizeof(double));
            if (nz) memcpy(q->z + (size_t)*written * nz, r->stage + nx, nz * sizeof(double));
            memcpy(q->integral + 2 * (size_t)*written, r->gathered, sizeof r->gathered);
        }
        ++*written;
    }
    if (r->of.powers && from < 1) gather(r, from, 1, h);
}

/* Keep where a step ended. */
void ac_rodas_keep(ac_rodas *r) {
    const ac_request *q = &r->request;
    const size_t n = (size_t)r->n, k = (size_t)r->progress.kept;
    if (r->progress.kept == q->room) return;
    q->step_time[k] = r->t;
    memcpy(q->step_y + k * n, r->y, n * sizeof(double));
    if (q->step_dense) memcpy(q->step_dense + 3 * k * n, r->dense, 3 * n * sizeof(double));
    r->progress.kept++;
}
