/* Derivatives at the present point: the algebraic unknowns follow from g_z dz = -(g_x dx + g_t dt + g_p dp). */
#include "instance.h"
#include "sweep.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Factors of g_z and all values of its tape, at the present; the algebraic unknowns have to be known. */
int32_t ac_linearise(ac_instance *i) {
    if (i->now.known & AC_FACTORS) return AC_OK;
    const ac_equations *e = &i->of->parts.model.equations;
    ac_settler *s = i->settler[AC_ALGEBRAIC];
    const ac_tape *t = s->of.tape;
    double *input = s->w + t->constants;
    ac_put(input, i->p, e->np), input += e->np;
    ac_put(input, i->c, e->nc), input += e->nc;
    ac_put(input, i->x, e->nx), input += e->nx;
    ac_put(input, i->z, e->nz), input += e->nz;
    *input = i->now.time;
    ac_tape_run(t, s->w, 0, t->runs);
    for (int32_t k = e->nz; k < t->outputs; k++) s->step[k] = s->w[t->output[k]];
    if (e->nz && ac_lu_factor(s->lu, s->entries)) return ac_fail(i, AC_RETRY, "the equations have no unique solution here.");
    i->now.known |= AC_FACTORS;
    return AC_OK;
}

/* Changes of the algebraic unknowns with those of states, time and p; NULL stands for 0. */
static int32_t slopes(ac_instance *i, const double *dx, double dt, const double *dp, double *dz) {
    const ac_equations *e = &i->of->parts.model.equations;
    ac_settler *s = i->settler[AC_ALGEBRAIC];
    const ac_tape *t = s->of.tape;
    const int32_t failed = ac_linearise(i);
    if (failed) return failed;
    memset(i->dw, 0, (size_t)(t->constants + t->inputs) * sizeof *i->dw);
    double *input = i->dw + t->constants;
    ac_put(input, dp, e->np);
    ac_put(input + e->np + e->nc, dx, e->nx);
    input[e->np + e->nc + e->nx + e->nz] = dt;
    ac_sweep_forward(t, s->w, i->dw);
    for (int32_t k = 0; k < e->nz; k++) dz[k] = -i->dw[t->output[k]];
    if (e->nz) ac_lu_solve(s->lu, dz);
    return AC_OK;
}

/* Changes of the outputs of a tape whose values stand in w. */
static void along(ac_instance *i, const ac_tape *tape, const double *w, const double *dx, const double *dz, double dt,
                  const double *dp, double *found) {
    const ac_equations *e = &i->of->parts.model.equations;
    memset(i->dw, 0, (size_t)(tape->constants + tape->inputs) * sizeof *i->dw);
    double *input = i->dw + tape->constants;
    ac_put(input, dx, e->nx);
    ac_put(input + e->nx, dz, e->nz);
    input[e->nx + e->nz] = dt;
    ac_put(input + e->nx + e->nz + 1, dp, e->np);
    ac_sweep_forward(tape, w, i->dw);
    for (int32_t k = 0; k < tape->outputs; k++) found[k] = i->dw[tape->output[k]];
}

/* Find the watched conditions, and their rates along the motion, in the last third of `guards`. */
int32_t ac_indicator_rates(ac_instance *i) {
    const ac_unit *u = i->of;
    const ac_tape *t = &u->tape[AC_GUARDS];
    if (!u->watched) return AC_OK;
    int32_t failed = ac_know(i, AC_RATE | AC_GUARD);
    if (!failed) failed = slopes(i, i->rate, 1, NULL, i->work);
    if (failed) return failed;
    along(i, t, i->w[AC_GUARDS], i->rate, i->work, 1, NULL, i->other);
    double *rate = i->guards + 2 * u->watched;
    for (int32_t k = 0; k < u->watched; k++) rate[k] = isfinite(i->other[k]) ? i->other[k] : 0;
    return AC_OK;
}

/* What unknowns stand in: rates, variables, conditions; the tapes that give them, with values of the present. */
static const ac_tape *tape_of(ac_instance *i, int32_t kind, const double **w) {
    const ac_unit *u = i->of;
    *w = kind == 0 ? i->values : i->w[kind == 1 ? AC_SHOWN : AC_GUARDS];
    return kind == 0 ? u->parts.model.equations.values : &u->tape[kind == 1 ? AC_SHOWN : AC_GUARDS];
}

/* Memory for both directions: changes of x, p, z, and those of rates, variables, conditions. */
static double *make(const ac_instance *i, double **dx, double **dp, double **dz, double *of[3]) {
    const ac_unit *u = i->of;
    const ac_equations *e = &u->parts.model.equations;
    const size_t n = (size_t)e->nx + (size_t)e->nz;
    double *all = calloc(2 * n + (size_t)e->np + (size_t)u->shown + (size_t)u->watched + 1, sizeof *all);
    *dx = all, *dp = *dx + e->nx, *dz = *dp + e->np;
    of[0] = *dz + e->nz, of[1] = of[0] + n, of[2] = of[1] + u->shown;
    return all;
}

int32_t ac_forward(ac_instance *i, const uint32_t *unknown, size_t unknowns, const uint32_t *known, size_t knowns,
                   const double *seed, double *sensitivity) {
    double dt = 0, *dx, *dp, *dz, *of[3], *all = make(i, &dx, &dp, &dz, of);
    int32_t failed = all ? ac_know(i, AC_RATE | AC_SHOW | AC_GUARD) : ac_fail(i, AC_FAILED, "there is not enough memory.");
    if (!failed) failed = ac_seed(i, known, knowns, &dt, dx, dp, seed, NULL);
    if (!failed) failed = slopes(i, dx, dt, dp, dz);
    for (int32_t kind = 0; kind < 3 && !failed; kind++) {
        const double *w;
        const ac_tape *tape = tape_of(i, kind, &w);
        along(i, tape, w, dx, dz, dt, dp, of[kind]);
    }
    if (!failed) failed = ac_pick(i, unknown, unknowns, of, NULL, sensitivity);
    free(all);
    return failed;
}

/* Weights of the outputs of a tape, taken back to t, x, z and p. */
static void back(ac_instance *i, const ac_tape *t, const double *w, const double *weight, int32_t count, double *dt, double *dx,
                 double *dz, double *dp) {
    const ac_equations *e = &i->of->parts.model.equations;
    memset(i->dw, 0, ac_tape_length(t) * sizeof *i->dw);
    for (int32_t k = 0; k < count; k++) i->dw[t->output[k]] += weight[k];
    ac_sweep_backward(t, w, i->dw);
    const double *input = i->dw + t->constants;
    for (int32_t k = 0; k < e->nx; k++) dx[k] += input[k];
    for (int32_t k = 0; k < e->nz; k++) dz[k] += input[e->nx + k];
    *dt += input[e->nx + e->nz];
    for (int32_t k = 0; k < e->np; k++) dp[k] += input[e->nx + e->nz + 1 + k];
}

int32_t ac_backward(ac_instance *i, const uint32_t *unknown, size_t unknowns, const uint32_t *known, size_t knowns,
                    const double *seed, double *sensitivity) {
    const ac_unit *u = i->of;
    const ac_equations *e = &u->parts.model.equations;
    double dt = 0, *dx, *dp, *dz, *of[3], *all = make(i, &dx, &dp, &dz, of);
    int32_t failed = all ? ac_know(i, AC_RATE | AC_SHOW | AC_GUARD) : ac_fail(i, AC_FAILED, "there is not enough memory.");
    if (!failed) failed = ac_pick(i, unknown, unknowns, of, seed, NULL);
    if (!failed) failed = ac_linearise(i);
    if (!failed) {
        const int32_t count[] = {e->nx, u->shown, u->watched};
        for (int32_t kind = 0; kind < 3; kind++) {
            const double *w;
            const ac_tape *tape = tape_of(i, kind, &w);
            back(i, tape, w, of[kind], count[kind], &dt, dx, dz, dp);
        }
        ac_settler *s = i->settler[AC_ALGEBRAIC];
        const ac_tape *t = s->of.tape;
        if (e->nz) ac_lu_solve_transposed(s->lu, dz);
        memset(i->dw, 0, ac_tape_length(t) * sizeof *i->dw);
        for (int32_t k = 0; k < e->nz; k++) i->dw[t->output[k]] -= dz[k];
        ac_sweep_backward(t, s->w, i->dw);
        const double *input = i->dw + t->constants;
        for (int32_t k = 0; k < e->np; k++) dp[k] += input[k];
        for (int32_t k = 0; k < e->nx; k++) dx[k] += input[e->np + e->nc + k];
        dt += input[e->np + e->nc + e->nx + e->nz];
        failed = ac_seed(i, known, knowns, &dt, dx, dp, NULL, sensitivity);
    }
    free(all);
    return failed;
}
