/* Decide which set-valued laws (friction) stick at an event, and which slide, from the accelerations that their forces cause
   (Pfeiffer and Glocker 1996). */
#include "hybrid.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define RESPONDS 1e-8     /* response of a rate to its own force, over the sizes of its terms: below it is zero. In slider-cranks it is 0.05
                             to 0.3, and 1e-15 where a joint reverses */
#define INDEPENDENT 1e-8  /* rounding of the response of a rate to other forces, over its terms */
#define ROUNDING (1e3 * DBL_EPSILON) /* rounding of an equation, over its terms: sums of up to 1,000 of them */
#define MOVES 100.0       /* speed over its tolerance at which a law does not rest: events are located to about 1 */

/* Discrete variables of a law. */
enum { MODE, OFFSET, SHARED, SHARE, SLIP, KINDS };

/* Laws at rest that are decided together: m of n. */
typedef struct {
    int32_t n, m;
    int32_t *rest;              /* (m) */
    const double *speed, *rate, *limit, *size, *by_share, *by_unknown, *by_law; /* outputs of the tape */
    double *values;             /* the outputs, in their order */
    double *was, *stated, *z;   /* (n, KINDS) before the event, and as the components state them; the unknowns then */
    double *response;           /* (n, n) of the rates to the shares */
    double *noise, *certain;    /* (n) rounding of the rates; whether they respond to their own shares */
    double *change, *influence; /* (n, nz) of the unknowns by a share; of the equations on a rate */
    double *terms;              /* (nz) */
    double *A, *b, *reached, *share, *sense, *sticks; /* the problem of those that respond, and its solution */
} decision;

static double *variable(const ac_instance *i, int32_t law, int32_t kind) {
    return i->c + i->of->switches + i->of->law[KINDS * law + kind];
}

void ac_read_laws(const ac_instance *i, const double *c, double *found) {
    for (int32_t k = 0; k < KINDS * i->of->laws; k++) found[k] = c[i->of->switches + i->of->law[k]];
}

static void write_laws(ac_instance *i, const double *values) {
    for (int32_t k = 0; k < KINDS * i->of->laws; k++) i->c[i->of->switches + i->of->law[k]] = values[k];
    ac_changed(i);
}

/* Evaluate the laws. */
static void evaluate(ac_instance *i, decision *d) {
    const ac_tape *t = &i->of->tape[AC_LAWS];
    const double *w = ac_run(i, AC_LAWS);
    const int32_t n = d->n;
    for (int32_t k = 0; k < t->outputs; k++) d->values[k] = w[t->output[k]];
    d->speed = d->values, d->rate = d->speed + n, d->limit = d->rate + n, d->size = d->limit + n, d->by_share = d->size + n;
    d->by_unknown = d->by_share + n * n, d->by_law = d->by_unknown + i->of->gradient_start[n];
}

/* Add to `found` the product of the sizes of the entries of a column of the Jacobian of g with x. */
static void add_sizes(ac_instance *i, int32_t column, double x, double *found) {
    const ac_equations *e = &i->of->parts.model.equations;
    for (int32_t k = e->start[column]; k < e->start[column + 1]; k++) {
        if (e->row[k] >= e->nx) found[i->of->equation[e->row[k] - e->nx]] += fabs(i->dw[e->slopes->output[k]] * x);
    }
}

/* Responses of the rates to the shares, G J^-1 S = y'J z with J z = S and y'J = G, and rounding of the rates. The size of a response
   over |y|'|J||z| does not change if rows or columns of J are scaled (Skeel 1979). */
static int32_t find_responses(ac_instance *i, decision *d) {
    const ac_unit *u = i->of;
    const ac_equations *e = &u->parts.model.equations;
    const int32_t n = d->n, nz = e->nz, *gradient = u->gradient_start, *law = u->law_start;
    const int32_t failed = ac_linearise(i);
    if (failed) return failed;
    ac_evaluate(i, e->slopes, i->dw);
    for (int32_t k = 0; k < e->nx + nz; k++) add_sizes(i, k, k < e->nx ? i->x[k] : i->z[k - e->nx], d->terms);
    for (int32_t k = 0; k < n; k++) {
        double *change = d->change + k * nz, *influence = d->influence + k * nz;
        for (int32_t j = law[k]; j < law[k + 1]; j++) change[u->law_row[j]] = -d->by_law[j];
        for (int32_t j = gradient[k]; j < gradient[k + 1]; j++) influence[u->gradient_row[j]] = d->by_unknown[j];
        if (nz) ac_lu_solve(i->settler[AC_ALGEBRAIC]->lu, change), ac_lu_solve_transposed(i->settler[AC_ALGEBRAIC]->lu, influence);
        d->noise[k] = 0;
        for (int32_t j = 0; j < nz; j++) d->noise[k] += fabs(influence[j]) * d->terms[j];
        for (int32_t j = gradient[k]; j < gradient[k + 1]; j++) d->noise[k] += fabs(d->by_unknown[j] * i->z[u->gradient_row[j]]);
        d->noise[k] *= ROUNDING;
    }
    for (int32_t k = 0; k < n; k++) {
        double *own = d->response + k * n, terms = fabs(d->by_share[k * n + k]);
        for (int32_t j = 0; j < n; j++) {
            own[j] = d->by_share[j * n + k];
            for (int32_t a = gradient[k]; a < gradient[k + 1]; a++) own[j] += d->by_unknown[a] * d->change[j * nz + u->gradient_row[a]];
        }
        memset(d->terms, 0, (size_t)nz * sizeof *d->terms);
        for (int32_t j = 0; j < nz; j++) add_sizes(i, e->nx + j, d->change[k * nz + j], d->terms);
        for (int32_t j = 0; j < nz; j++) terms += fabs(d->influence[k * nz + j]) * d->terms[j];
        d->certain[k] = fabs(own[k]) > RESPONDS * terms;
    }
    return ac_all_finite(d->response, n * n) && ac_all_finite(d->noise, n) && ac_all_finite(d->rate, 2 * n) ? AC_OK : AC_RETRY;
}

/* Solve for the shares of the laws at rest that respond to their own force: they come first in `rest`. Returns how many. */
static int32_t find_shares(decision *d) {
    const int32_t n = d->n;
    int32_t answers = 0;
    for (int32_t a = 0; a < d->m; a++) {
        const int32_t k = d->rest[a];
        if (!(d->certain[k] > 0 && -fabs(d->limit[k]) * d->response[k * n + k] > 0)) continue;
        const double reached = d->reached[a];
        d->rest[a] = d->rest[answers], d->rest[answers] = k;
        d->reached[a] = d->reached[answers], d->reached[answers++] = reached;
    }
    for (int32_t a = 0; a < answers; a++) {
        const int32_t k = d->rest[a];
        d->b[a] = fabs(d->limit[k]) * d->rate[k];
        for (int32_t b = 0; b < answers; b++) {
            const int32_t j = d->rest[b];
            d->A[a * answers + b] = -(fabs(d->limit[k]) * d->response[k * n + j] + fabs(d->limit[j]) * d->response[j * n + k]) / 2;
        }
    }
    return ac_shares(answers, d->A, d->b, d->reached, d->share, d->sense, d->sticks) ? -1 : answers;
}

/* Senses of the others, whose speeds follow the rest of the machine. */
static void follow_machine(decision *d, int32_t answers) {
    for (int32_t a = answers; a < d->m; a++) {
        const int32_t k = d->rest[a];
        double rate = d->rate[k], size = 0;
        for (int32_t b = 0; b < answers; b++) {
            const double part = d->response[k * d->n + d->rest[b]] * d->share[b];
            rate += part, size += fabs(part);
        }
        d->share[a] = d->sticks[a] = 0;
        d->sense[a] = fabs(rate) > d->noise[k] + INDEPENDENT * size ? copysign(1, rate) : 0;
    }
}

/* Choose the modes of the laws at rest, at the point without their forces. */
static int32_t choose(ac_instance *i, decision *d) {
    evaluate(i, d);
    const int32_t failed = find_responses(i, d);
    if (failed) return failed;
    const int32_t answers = find_shares(d);
    if (answers < 0) return AC_FAILED;
    follow_machine(d, answers);
    int named = 0;
    for (int32_t k = 0; k < d->n; k++) named |= i->redundant[k] > 0;
    for (int32_t a = 0; a < d->m; a++) {
        const int32_t k = d->rest[a];
        const int rests = d->sense[a] == 0, shared = rests && !(d->sticks[a] > 0);
        if (shared && a < answers && !named) i->redundant[k] = 1;
        *variable(i, k, MODE) = d->sense[a], *variable(i, k, OFFSET) = d->speed[k];
        *variable(i, k, SHARED) = shared, *variable(i, k, SHARE) = shared ? d->share[a] : 0;
        *variable(i, k, SLIP) = rests ? fmax(i->now.tolerance * d->size[k], DBL_MIN) : 0;
    }
    ac_changed(i);
    return AC_OK;
}

/* Release the laws at rest, and decide on them; those that the equations do not decide stay as the components state them. */
static void decide(ac_instance *i, decision *d) {
    const int32_t nz = i->of->parts.model.equations.nz;
    ac_put(d->z, i->z, nz);
    for (int32_t a = 0; a < d->m; a++) {
        const int32_t k = d->rest[a];
        *variable(i, k, MODE) = *variable(i, k, SHARE) = 0, *variable(i, k, SHARED) = 1;
    }
    ac_changed(i);
    if (!ac_know(i, AC_Z) && !choose(i, d)) return;
    ac_put(i->z, d->z, nz);
    write_laws(i, d->stated);
    for (int32_t k = 0; k < d->n; k++) {
        if (*variable(i, k, MODE) == 0) *variable(i, k, SLIP) = DBL_MIN;
    }
    ac_changed(i);
}

/* Find the laws at rest, and those that have reached their limit. A decision is due where a law comes to rest or leaves it, and where
   redundant laws rest: they take new shares. */
static int is_due(decision *d) {
    int due = 0;
    for (int32_t k = 0; k < d->n; k++) {
        const double *was = d->was + KINDS * k, *now = d->stated + KINDS * k;
        const int rests = now[MODE] == 0, left = was[MODE] == 0 && !rests;
        due |= left || (rests && (was[SHARED] > 0 || now[SLIP] == 0));
        if (!rests && !(left && was[SHARED] == 0)) continue; /* a shared one slips */
        d->reached[d->m] = left ? now[MODE] : fabs(was[SHARE]) == 1 ? was[SHARE] : 0;
        d->rest[d->m++] = k;
    }
    return due && d->m;
}

int ac_laws_are_open(const ac_instance *i) {
    for (int32_t k = 0; k < i->of->laws; k++) {
        if (*variable(i, k, MODE) == 0 && *variable(i, k, SLIP) == 0) return 1;
    }
    return 0;
}

int32_t ac_decide_laws(ac_instance *i, const double *was) {
    const ac_unit *u = i->of;
    const size_t n = (size_t)u->laws, nz = (size_t)u->parts.model.equations.nz, outputs = (size_t)u->tape[AC_LAWS].outputs;
    if (!n) return AC_OK;
    double *memory = calloc(outputs + 2 * KINDS * n + 2 * nz + 2 * n * n + 2 * n * nz + 7 * n, sizeof *memory);
    int32_t *rest = calloc(n, sizeof *rest);
    if (memory && rest) {
        decision d = {.n = u->laws, .rest = rest, .values = memory};
        d.was = d.values + outputs, d.stated = d.was + KINDS * n, d.z = d.stated + KINDS * n, d.terms = d.z + nz;
        d.response = d.terms + nz, d.A = d.response + n * n, d.change = d.A + n * n, d.influence = d.change + n * nz;
        d.noise = d.influence + n * nz, d.certain = d.noise + n, d.b = d.certain + n, d.reached = d.b + n, d.share = d.reached + n;
        d.sense = d.share + n, d.sticks = d.sense + n;
        memcpy(d.was, was, KINDS * n * sizeof *was);
        ac_read_laws(i, i->c, d.stated);
        if (is_due(&d)) decide(i, &d);
    }
    free(memory), free(rest);
    return memory && rest ? AC_OK : ac_fail(i, AC_FAILED, "there is not enough memory.");
}

/* After jumps: let laws slide that rest while their speed is not 0. Prescribed speeds, whose size is 0, do not jump. */
int32_t ac_part_laws(ac_instance *i, int32_t *parted) {
    const ac_tape *t = &i->of->tape[AC_LAWS];
    const int32_t n = i->of->laws, failed = n ? ac_know(i, AC_Z) : AC_OK;
    *parted = 0;
    if (!n || failed) return failed;
    const double *w = ac_run(i, AC_LAWS);
    for (int32_t k = 0; k < n; k++) {
        const double speed = w[t->output[k]], size = w[t->output[3 * n + k]];
        if (*variable(i, k, MODE) != 0 || !(size > 0) || !(fabs(speed) > MOVES * i->now.tolerance * size)) continue;
        *variable(i, k, MODE) = copysign(1, speed);
        *variable(i, k, OFFSET) = *variable(i, k, SHARED) = *variable(i, k, SHARE) = 0;
        *parted = 1;
    }
    if (*parted) ac_changed(i);
    return AC_OK;
}

void ac_redundant_laws(const ac_instance *i, double *redundant) { ac_put(redundant, i->redundant, i->of->laws); }
