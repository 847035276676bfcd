/* Integrate by Rodas5P. Stages as in E. Hairer, G. Wanner, Solving Ordinary Differential Equations II, IV.7, where
   u_i = sum gamma_ij k_j:
     (M/(h gamma) - J) u_i = F(t + alpha_i h, y + sum a_ij u_j) + M sum (c_ij/h) u_j + h gamma_i F_t,  M = diag(1, 0). */
#include "rodas5p.h"

#include "file.h"
#include "lu.h"
#include "rodas.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define SAFETY 0.9            /* of the step that the error estimate allows, as in Hairer's RODAS */
#define LEAST 0.2             /* change of a step at most, likewise */
#define MOST 6.0
#define AFTER_REFUSAL 0.25    /* of a step whose equations have no value */
#define FIRST 0.01            /* of the way, the first step at most; or to the first output, but for those that are very near */
#define SHORTENED 0.1         /* change of a first step that resolves too little, and how often it is shortened */
#define MOST_SHORTENED 12
#define GRID 1024             /* parts of a power of 2 in which steps are measured */
#define LOST 1e-4             /* of the tolerance, which the factors lose at most */
#define BESIDE 0.5            /* of a step behind which the algebraic unknowns are not near where it leads */
#define SLOWLY 1.5            /* change of some steps after that at most, as the next ones come to the same bend */
#define SOME 4
#define MANY 30               /* steps that may begin beside that bend again */
#define SHORTEST (16 * DBL_EPSILON) /* of the time: below it t + h is rounding */

/* The shortest step at a time, on the way to an end. */
static double shortest(const ac_rodas *r) {
    return fmax(SHORTEST * fmax(fabs(r->s.t), fabs(ac_end(&r->s))), DBL_MIN);
}

static void begin(ac_stepper *s) {
    ac_rodas *r = (ac_rodas *)s;
    r->h = s->request.first_step > shortest(r) ? s->request.first_step : 0; /* one before a break may have been shorter */
    r->pace = (ac_pace){0};
    r->begun = r->sign = r->known = 0;
    r->stale = 1;
    r->factored = 0;
    memset(r->left, 0, (size_t)s->of.nz * sizeof *r->left);
    memset(r->most, 0, (size_t)s->of.nz * sizeof *r->most);
}

static void move(ac_stepper *s) {
    ac_rodas *r = (ac_rodas *)s;
    r->stale = 1;
    r->known = 0;
}

/* Changes of the states over tolerance (size + |x|): their root mean square, or the largest. */
double ac_rodas_norm(const ac_rodas *r, const double *change) {
    double sum = 0, largest = 0;
    for (int32_t k = 0; k < r->s.of.nx; k++) {
        const double most = fmax(fabs(r->s.y[k]), fabs(r->s.next[k]));
        const double part = fabs(change[k]) / (r->s.request.tolerance * (r->s.request.size[k] + most));
        sum += part * part;
        if (part > largest || isnan(part)) largest = part;
    }
    if (r->s.request.largest) return largest;
    return r->s.of.nx ? sqrt(sum / r->s.of.nx) : 0;
}

/* Errors of a step, in b: where it is asked for, without vibrations that it does not resolve. Of one of frequency omega
   (I - h gamma J)^-1 leaves 1 / |1 + i h gamma omega| (Shampine, Hosea 1996). */
static const double *smoothed(ac_rodas *r, const double *change, double h) {
    const int32_t *rate = r->s.request.rate;
    if (!r->s.request.smooth || !rate) return change;
    for (int32_t k = 0; k < r->s.n; k++) r->b[k] = k < r->s.of.nx ? change[k] / (h * GAMMA) : 0;
    ac_lu_solve(r->lu, r->b);
    for (int32_t k = 0; k < r->s.of.nx; k++) {
        if (!rate[k]) r->b[k] = change[k];
    }
    return r->b;
}

/* A step on a grid. Where steps are refused again and again their lengths are chaotic: the last bits of a power or a sine, which
   differ between machines, would lead to other steps soon. */
static double measured(double h) {
    int exponent;
    const double part = frexp(h, &exponent);
    return ldexp(floor(part * GRID) / GRID, exponent);
}

/* Factors of the matrix, with pivots that are chosen where those of now are no longer good: these are kept, as a run like this
   one comes to them again. */
static int32_t factors(ac_rodas *r) {
    ac_lu_lose(r->lu, LOST * r->s.request.tolerance);
    if (ac_lu_again(r->lu, r->matrix)) return 0;
    if (r->s.progress.pivots++) {
        ac_lu **next = &r->kept[r->turn = (r->turn + 1) % KEPT];
        if (!*next) *next = ac_lu_make(r->s.n, r->s.of.start, r->s.of.row);
        if (!*next) return -1;
        r->lu = *next;
        ac_lu_renew(r->lu);
        ac_lu_lose(r->lu, LOST * r->s.request.tolerance);
    }
    return ac_lu_factor(r->lu, r->matrix);
}

/* Factors of M/(h gamma) - J here. */
int32_t ac_rodas_factorise(ac_rodas *r, double h) {
    const ac_tape *tape = r->s.of.slopes;
    const int32_t entries = r->s.of.start[r->s.n];
    if (r->stale) {
        ac_evaluate_tape(&r->s, tape, r->s.slopes, r->s.y, r->s.t);
        r->s.progress.slopes++;
        r->stale = 0;
    } else if (r->factored == h) {
        return 0;
    }
    r->factored = 0;
    for (int32_t k = 0; k < entries; k++) r->matrix[k] = -r->s.slopes[tape->output[k]];
    for (int32_t k = 0; k < r->s.of.nx; k++) r->matrix[r->s.of.diagonal[k]] += 1 / (h * GAMMA);
    const int32_t failed = factors(r);
    if (!failed) r->factored = h;
    return failed;
}

/* Apply D = I - (I - h gamma J)^-1 five times, by the factors that are there; return the largest of some states, NULL for all,
   over tolerance. Of a mode of eigenvalue l, D leaves the part -h gamma l / (1 - h gamma l): little where a step resolves it, all
   where it does not; its fifth power is as small as the error of a step that resolves it. */
static double unresolved(ac_rodas *r, double *left, const int32_t *some) {
    const int32_t nx = r->s.of.nx;
    for (int power = 0; power < 5; power++) {
        for (int32_t k = 0; k < r->s.n; k++) r->b[k] = k < nx ? left[k] / (r->h * GAMMA) : 0;
        ac_lu_solve(r->lu, r->b);
        for (int32_t k = 0; k < nx; k++) left[k] -= r->b[k];
    }
    double most = 0;
    for (int32_t k = 0; k < nx; k++) {
        const double part = fabs(left[k]) / (r->s.request.tolerance * (r->s.request.size[k] + fabs(r->s.y[k])));
        if ((!some || some[k]) && (part > most || isnan(part))) most = part;
    }
    return most;
}

/* Whether the first step takes to rest what moves: an L-stable method does that to vibrations that it does not resolve, and no
   error test sees it, such as that of a body which has just met a stiff stop. `slope`, NULL for none: derivatives that may set
   vibrations off; times h gamma they are more than what those that it does not resolve come to. */
static int32_t stills(ac_rodas *r, const double *slope) {
    const int32_t nx = r->s.of.nx, *rate = r->s.request.rate;
    double *left = r->stage;
    if (ac_rodas_factorise(r, r->h)) return 0;
    for (int32_t k = 0; k < nx; k++) left[k] = rate && rate[k] ? r->s.y[k] : 0;
    if (rate && unresolved(r, left, rate) > 1) return 1;
    for (int32_t k = 0; slope && k < nx; k++) left[k] = r->h * GAMMA * slope[k];
    return slope && unresolved(r, left, NULL) > 1;
}

/* Values of the equations where a step begins. */
static void find_here(ac_rodas *r) {
    if (!r->known) ac_equations_at(&r->s, r->s.y, r->s.t, r->here);
    r->known = 1;
}

/* Shorten the first step until it resolves what moves; begin with the one that is given, else with a long one. */
static void start(ac_rodas *r) {
    const ac_request *q = &r->s.request;
    const double span = q->time[q->outputs] - r->s.t, output = q->time[q->outputs > 0] - r->s.t;
    const double *slope = NULL;
    if (!(r->h > 0)) {
        r->h = fmin(FIRST * span, fmax(output, FIRST * FIRST * span));
        find_here(r);
        slope = r->here;
    }
    r->h = r->h < span ? measured(r->h) : span;
    for (int tries = 0; tries < MOST_SHORTENED && stills(r, slope); tries++) r->h = measured(SHORTENED * r->h);
    r->begun = 1;
}

/* All stages, and where they lead. */
static void stages(ac_rodas *r, double h) {
    const int32_t n = r->s.n, nx = r->s.of.nx;
    find_here(r);
    for (int32_t i = 0; i < STAGES; i++) {
        double *u = r->u + (size_t)i * (size_t)n;
        memcpy(r->stage, r->s.y, (size_t)n * sizeof *u);
        memset(r->b, 0, (size_t)nx * sizeof *u);
        for (int32_t j = 0; j < i; j++) {
            const double *before = r->u + (size_t)j * (size_t)n, a = A[i][j], c = C[i][j] / h;
            for (int32_t k = 0; k < n; k++) r->stage[k] += a * before[k];
            for (int32_t k = 0; k < nx; k++) r->b[k] += c * before[k];
        }
        if (i) ac_equations_at(&r->s, r->stage, r->s.t + ALPHA[i] * h, u);
        else memcpy(u, r->here, (size_t)n * sizeof *u);
        for (int32_t k = 0; k < nx; k++) u[k] += r->b[k];
        if (r->timely && GAMMAS[i] != 0) {
            const int32_t *slope = r->s.of.slopes->output + r->s.of.start[n];
            for (int32_t k = 0; k < n; k++) u[k] += h * GAMMAS[i] * r->s.slopes[slope[k]];
        }
        ac_lu_solve(r->lu, u);
    }
    /* The last stage starts from y + sum a_8j u_j: the solution is that and u_8, which is the error estimate. */
    const double *last = r->u + (size_t)(STAGES - 1) * (size_t)n;
    for (int32_t k = 0; k < n; k++) r->s.next[k] = r->stage[k] + last[k];
}

/* The coefficients of its interpolant. */
static void interpolate(ac_stepper *s) {
    const ac_rodas *r = (ac_rodas *)s;
    for (int32_t j = 0; j < AC_RODAS_ROWS; j++) {
        double *d = s->last.dense + (size_t)j * (size_t)s->n;
        memset(d, 0, (size_t)s->n * sizeof *d);
        for (int32_t i = 0; i < STAGES; i++) {
            for (int32_t k = 0; k < s->n; k++) d[k] += H[j][i] * r->u[(size_t)i * (size_t)s->n + (size_t)k];
        }
    }
}

/* Try a step. */
static int32_t advance(ac_stepper *s) {
    ac_rodas *r = (ac_rodas *)s;
    if (!r->begun) start(r);
    const double left = ac_step_end(s) - s->t, tried = r->h;
    const int last = r->h >= left * (1 - 1e-10);
    const double h = last ? left : r->h > 0.5 * left ? 0.5 * left : measured(r->h);
    if (!(h > shortest(r))) return r->pace.unsolved ? AC_UNSOLVED : AC_SHORT;
    const int32_t failed = ac_rodas_factorise(r, h);
    if (failed < 0) return AC_MEMORY;
    double error = INFINITY;
    s->progress.factors++;
    if (!failed) {
        stages(r, h);
        if (ac_all_finite(s->next, s->n)) error = ac_rodas_norm(r, smoothed(r, r->u + (size_t)(STAGES - 1) * (size_t)s->n, h));
    }
    r->pace.unsolved = !isfinite(error);
    double change = !r->pace.unsolved ? SAFETY * pow(fmax(error, 1e-10), -0.2) : AFTER_REFUSAL;
    if (error <= 1 && !ac_rodas_follows(r, h)) {
        if (r->pace.refused) ac_rodas_return(r, h);
        r->pace.unsolved = 1, r->pace.slow = SOME, r->pace.bent = MANY;
        error = INFINITY, change = BESIDE;
    }
    if (!(error <= 1)) {
        s->progress.refused++;
        r->pace.refused = 1;
        r->h = h * fmax(LEAST, fmin(change, SAFETY));
        return AC_MORE;
    }
    ac_accept(s, last ? ac_step_end(s) : s->t + h, h);
    double *const before = r->here;
    r->here = r->there, r->there = before;
    r->h = h * fmax(LEAST, fmin(change, r->pace.refused ? 1 : r->pace.slow ? SLOWLY : MOST));
    if (last && s->t < ac_end(s)) r->h = fmax(r->h, tried); /* a kink has cut it */
    r->pace.slow -= r->pace.slow > 0, r->pace.bent -= r->pace.bent > 0;
    r->pace.refused = 0;
    r->stale = 1;
    return AC_DONE;
}

static void renew(ac_stepper *s) {
    ac_rodas *r = (ac_rodas *)s;
    r->lu = r->kept[r->turn = 0];
    ac_lu_renew(r->lu);
}

static void free_factors(ac_stepper *s) {
    for (int k = 0; k < KEPT; k++) ac_lu_free(((ac_rodas *)s)->kept[k]);
}

static const ac_method METHOD = {AC_RODAS_ROWS, 0, begin, advance, interpolate, move, renew, free_factors};

ac_rodas *ac_rodas_make(const ac_equations *equations) {
    ac_rodas *r = calloc(1, sizeof *r);
    if (!r) return NULL;
    const ac_equations *e = equations;
    const size_t n = (size_t)e->nx + (size_t)e->nz + 1, entries = (size_t)e->start[n - 1] + 1;
    double *at = ac_stepper_take(&r->s, &METHOD, e, (STAGES + 7) * n + entries);
    r->lu = r->kept[0] = ac_lu_make(r->s.n, e->start, e->row);
    r->timely = e->slopes->outputs > e->start[r->s.n];
    if (!r->lu || !at) {
        ac_stepper_free(&r->s);
        return NULL;
    }
    r->stage = at, r->b = r->stage + n, r->u = r->b + n, r->here = r->u + STAGES * n, r->there = r->here + n;
    r->left = r->there + n, r->most = r->left + n, r->terms = r->most + n, r->matrix = r->terms + n;
    return r;
}
