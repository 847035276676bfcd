/* Linear complementarity problem with bounds for friction forces at rest. */
#include "instance.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define REGULAR 1e-10     /* regularisation of redundant responses, over the responses: well below INDEPENDENT */
#define INDEPENDENT 1e-8  /* Schur complement of a response, over the response, that is zero: rounding of sums of some terms */
#define REACHED 1e-9      /* distance of a force from its limit, over the limit, at which it has reached it */
#define ROUNDING 1e-14    /* of the terms of an acceleration */
#define PATIENCE 10       /* block pivots that do not reduce the number of violations, before single pivots */
#define PIVOTS 50         /* for each law, at most: random problems of 1 to 50 laws take about 1 */
#define SWEEPS 40         /* of rotations at most: ten are usual */

/* Forces and accelerations scaled so that B has diagonal 1; `state`: sign of a force at its bound, else 0. */
typedef struct {
    int32_t n;
    double *B, *c, *bound, *v, *state, *next;
    double *L, *r;          /* Cholesky factor, right-hand side */
    double *X, *V, *x;      /* columns of a least-norm problem, rotations, solution */
    int32_t *free, *some;   /* index sets */
} lcp;

/* Cholesky factor of B + shift for some indices. */
static void factorise(lcp *p, const int32_t *at, int32_t m, double shift) {
    for (int32_t a = 0; a < m; a++) {
        for (int32_t b = 0; b <= a; b++) {
            const double left = p->B[at[a] * p->n + at[b]] + (a == b ? shift : 0) - ac_dot(p->L + a * m, p->L + b * m, b);
            p->L[a * m + b] = a == b ? sqrt(fmax(left, DBL_EPSILON * DBL_EPSILON)) : left / p->L[b * m + b];
        }
    }
}

/* Solve L y = r in place. */
static void substitute(lcp *p, int32_t m) {
    for (int32_t a = 0; a < m; a++) p->r[a] = (p->r[a] - ac_dot(p->L + a * m, p->r, a)) / p->L[a * m + a];
}

/* Forces that are not at a bound, given those that are. */
static void solve_free(lcp *p) {
    int32_t m = 0;
    for (int32_t k = 0; k < p->n; k++) {
        p->v[k] = p->state[k] * p->bound[k];
        if (p->state[k] == 0) p->free[m++] = k;
    }
    for (int32_t a = 0; a < m; a++) p->r[a] = p->c[p->free[a]] - ac_dot(p->B + p->free[a] * p->n, p->v, p->n);
    factorise(p, p->free, m, REGULAR);
    substitute(p, m);
    for (int32_t a = m - 1; a >= 0; a--) {
        p->r[a] /= p->L[a * m + a];
        for (int32_t b = 0; b < a; b++) p->r[b] -= p->L[a * m + b] * p->r[a];
        p->v[p->free[a]] = p->r[a];
    }
}

/* Where a force goes next: to the bound that it exceeds, or off its bound where that has the wrong sign. */
static double next_state(const lcp *p, int32_t k) {
    const double state = p->state[k], *row = p->B + k * p->n;
    if (state == 0) return fabs(p->v[k]) > p->bound[k] ? copysign(1, p->v[k]) : 0;
    double size = fabs(p->c[k]);
    for (int32_t j = 0; j < p->n; j++) size += fabs(row[j] * p->v[j]);
    return state * (p->c[k] - ac_dot(row, p->v, p->n) - REGULAR * p->v[k]) < -ROUNDING * size ? 0 : state;
}

/* Minimise v'(B + REGULAR) v / 2 - c'v within the bounds by block principal pivoting, with single pivots where blocks do not help
   (Judice and Pires 1994). */
static void minimise(lcp *p) {
    int32_t least = p->n + 1, patience = PATIENCE;
    for (int32_t pivots = 0; pivots < PIVOTS * p->n; pivots++) {
        int32_t count = 0, last = -1;
        solve_free(p);
        for (int32_t k = 0; k < p->n; k++) {
            p->next[k] = next_state(p, k);
            if (p->next[k] != p->state[k]) count++, last = k;
        }
        if (!count) break;
        if (count < least) least = count, patience = PATIENCE;
        else patience--;
        for (int32_t k = 0; k < p->n; k++) {
            if (patience >= 0 || k == last) p->state[k] = p->next[k];
        }
    }
    for (int32_t k = 0; k < p->n; k++) {
        if (fabs(p->v[k]) >= (1 - REACHED) * p->bound[k]) p->state[k] = copysign(1, p->v[k]), p->v[k] = p->state[k] * p->bound[k];
        else p->state[k] = 0;
    }
}

/* Rotate two columns of m numbers by an angle of given tangent. */
static void rotate(double *a, double *b, int32_t m, double tangent) {
    const double cosine = 1 / sqrt(1 + tangent * tangent), sine = cosine * tangent;
    for (int32_t k = 0; k < m; k++) {
        const double x = a[k], y = b[k];
        a[k] = cosine * x - sine * y, b[k] = sine * x + cosine * y;
    }
}

/* Least-norm solution of X x = r for m equations and n unknowns: singular values by Hestenes' rotations of the columns. */
static void least_norm(lcp *p, int32_t m, int32_t n) {
    double most = 0;
    int rotated = 1;
    memset(p->V, 0, (size_t)n * (size_t)n * sizeof *p->V);
    memset(p->x, 0, (size_t)n * sizeof *p->x);
    for (int32_t k = 0; k < n; k++) p->V[k * n + k] = 1, most = fmax(most, ac_dot(p->X + k * m, p->X + k * m, m));
    for (int sweep = 0; sweep < SWEEPS && rotated; sweep++) {
        rotated = 0;
        for (int32_t i = 0; i < n; i++) {
            for (int32_t j = i + 1; j < n; j++) {
                double *a = p->X + i * m, *b = p->X + j * m;
                const double aa = ac_dot(a, a, m), bb = ac_dot(b, b, m), ab = ac_dot(a, b, m);
                if (fmin(aa, bb) <= DBL_EPSILON * DBL_EPSILON * most || fabs(ab) <= DBL_EPSILON * sqrt(aa * bb)) continue;
                const double cotangent = (bb - aa) / (2 * ab), tangent = copysign(1, cotangent) / (fabs(cotangent) + hypot(1, cotangent));
                rotate(a, b, m, tangent), rotate(p->V + i * n, p->V + j * n, n, tangent);
                rotated = 1;
            }
        }
    }
    most = 0;
    for (int32_t k = 0; k < n; k++) most = fmax(most, ac_dot(p->X + k * m, p->X + k * m, m));
    for (int32_t k = 0; k < n; k++) {
        const double square = ac_dot(p->X + k * m, p->X + k * m, m);
        if (!(square > INDEPENDENT * INDEPENDENT * most)) continue;
        const double share = ac_dot(p->X + k * m, p->r, m) / square;
        for (int32_t j = 0; j < n; j++) p->x[j] += share * p->V[k * n + j];
    }
}

/* Whether n forces in `some` of least norm hold m speeds in `free` within their bounds; they are in place then. */
static int settles(lcp *p, double *v, int32_t m, int32_t n) {
    for (int32_t b = 0; b < n; b++) v[p->some[b]] = 0;
    for (int32_t a = 0; a < m; a++) {
        p->r[a] = p->c[p->free[a]] - ac_dot(p->B + p->free[a] * p->n, v, p->n);
        for (int32_t b = 0; b < n; b++) p->X[b * m + a] = p->B[p->free[a] * p->n + p->some[b]];
    }
    least_norm(p, m, n);
    for (int32_t b = 0; b < n; b++) {
        v[p->some[b]] = p->x[b];
        if (!(fabs(p->x[b]) <= p->bound[p->some[b]])) return 0;
    }
    for (int32_t a = 0; a < m; a++) {
        const double *row = p->B + p->free[a] * p->n, c = p->c[p->free[a]];
        double size = fabs(c);
        for (int32_t j = 0; j < p->n; j++) size += fabs(row[j] * v[j]);
        if (!(fabs(c - ac_dot(row, v, p->n)) <= INDEPENDENT * size)) return 0;
    }
    return 1;
}

/* Hold the speeds at rest by forces of least norm; those that have reached a limit stay there if the others can hold the speeds.
   Returns how many forces are in `some`. */
static int32_t hold(lcp *p, const double *reached) {
    double *v = p->next;
    for (int stay = 1; stay >= 0; stay--) {
        int32_t m = 0, n = 0;
        ac_put(v, p->v, p->n);
        for (int32_t k = 0; k < p->n; k++) {
            if (p->state[k] != 0) continue;
            p->free[m++] = k;
            if (stay && reached[k] != 0) v[k] = reached[k] * p->bound[k];
            else p->some[n++] = k;
        }
        if (!settles(p, v, m, n)) continue;
        ac_put(p->v, v, p->n);
        for (int32_t k = 0; k < p->n && stay; k++) {
            if (p->state[k] == 0) p->state[k] = reached[k];
        }
        return n;
    }
    int32_t n = 0;
    for (int32_t k = 0; k < p->n; k++) {
        if (p->state[k] == 0) p->some[n++] = k;
    }
    return n;
}

/* Select an independent subset of n speeds in `some`, in place, by the pivots of a QR factorisation; returns how many they are. */
static int32_t independent(lcp *p, int32_t n) {
    double first = 0;
    for (int32_t a = 0; a < n; a++) {
        for (int32_t b = 0; b < n; b++) p->X[a * n + b] = p->B[p->some[a] * p->n + p->some[b]];
    }
    for (int32_t k = 0; k < n; k++) {
        int32_t best = k;
        for (int32_t j = k; j < n; j++) {
            if (ac_dot(p->X + j * n, p->X + j * n, n) > ac_dot(p->X + best * n, p->X + best * n, n)) best = j;
        }
        double *pivot = p->X + k * n;
        const int32_t index = p->some[best];
        p->some[best] = p->some[k], p->some[k] = index;
        for (int32_t b = 0; b < n; b++) {
            const double x = pivot[b];
            pivot[b] = p->X[best * n + b], p->X[best * n + b] = x;
        }
        const double length = sqrt(ac_dot(pivot, pivot, n));
        if (!k) first = length;
        if (!(length > INDEPENDENT * first)) return k;
        for (int32_t j = k + 1; j < n; j++) {
            const double along = ac_dot(pivot, p->X + j * n, n) / (length * length);
            for (int32_t b = 0; b < n; b++) p->X[j * n + b] -= along * pivot[b];
        }
    }
    return n;
}

static void solve(lcp *p, const double *reached, double *share, double *sense, double *sticks) {
    minimise(p);
    const int32_t m = independent(p, hold(p, reached));
    factorise(p, p->some, m, 0);
    for (int32_t k = 0; k < p->n; k++) {
        sticks[k] = 0;
        for (int32_t a = 0; a < m; a++) {
            p->r[a] = p->B[p->some[a] * p->n + k];
            if (p->some[a] == k) sticks[k] = 1;
        }
        substitute(p, m);
        /* A speed rests with those that stick where its Schur complement is zero. */
        const int rests = sticks[k] > 0 || 1 - ac_dot(p->r, p->r, m) <= INDEPENDENT;
        share[k] = p->v[k] / p->bound[k], sense[k] = rests ? 0 : p->state[k];
    }
}

int32_t ac_shares(int32_t n, const double *A, const double *b, const double *reached, double *share, double *sense, double *sticks) {
    const size_t m = (size_t)n, square = m * m;
    double *memory = calloc(4 * square + 7 * m + 1, sizeof *memory);
    int32_t *places = calloc(2 * m + 1, sizeof *places);
    if (memory && places) {
        lcp p = {.n = n, .B = memory, .free = places, .some = places + m};
        p.L = p.B + square, p.X = p.L + square, p.V = p.X + square, p.c = p.V + square, p.bound = p.c + m, p.v = p.bound + m;
        p.state = p.v + m, p.next = p.state + m, p.r = p.next + m, p.x = p.r + m;
        for (int32_t k = 0; k < n; k++) p.bound[k] = sqrt(A[k * n + k]), p.c[k] = b[k] / p.bound[k];
        for (int32_t k = 0; k < n * n; k++) p.B[k] = A[k] / (p.bound[k / n] * p.bound[k % n]);
        solve(&p, reached, share, sense, sticks);
    }
    free(memory), free(places);
    return memory && places ? AC_OK : AC_FAILED;
}
