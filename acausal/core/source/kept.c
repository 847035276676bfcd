/* Constraints of closed loops: how far they are from a flat position, and which are kept of some that follow from one another.
   Which of them follow from the others changes with the position; as `independent_constraints.py`. */
#include "instance.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define HALVINGS 60    /* of the interval that holds an eigenvalue: to rounding of the largest */
#define UNFIT 0.25    /* how well kept constraints hold the others: below the first others are kept, from the second on ... */
#define FAIRLY 0.5    /* ... they stay where an integration begins, as `simulate` does */

/* Constraints of positions at the present, over the size of each equation: A (m, n), Q as much; how many of them are kept. */
typedef struct {
    int32_t m, n, kept;
    double *A, *Q, *G; /* G: (m, m) and 4 m more */
    int32_t *on, *row;
} held;

/* Reduce a symmetric matrix to tridiagonal form by reflections (Golub and Van Loan 2013, algorithm 8.3.1): diagonal d, squares e of
   what stands beside it. */
static void tridiagonal(double *G, int32_t m, double *d, double *e, double *v, double *w) {
    for (int32_t k = 0; k < m; k++) {
        double length = 0, along = 0;
        for (int32_t a = k + 1; a < m; a++) v[a] = G[a * m + k], length += v[a] * v[a];
        d[k] = G[k * m + k], e[k] = length;
        if (k + 2 >= m || length == v[k + 1] * v[k + 1]) continue;
        v[k + 1] += copysign(sqrt(length), v[k + 1]);
        const double beta = 2 / ac_dot(v + k + 1, v + k + 1, m - k - 1);
        for (int32_t a = k + 1; a < m; a++) w[a] = beta * ac_dot(G + a * m + k + 1, v + k + 1, m - k - 1);
        along = beta / 2 * ac_dot(w + k + 1, v + k + 1, m - k - 1);
        for (int32_t a = k + 1; a < m; a++) w[a] -= along * v[a];
        for (int32_t a = k + 1; a < m; a++) {
            for (int32_t b = k + 1; b < m; b++) G[a * m + b] -= v[a] * w[b] + w[a] * v[b];
        }
    }
}

/* The r-th largest eigenvalue of a symmetric matrix whose eigenvalues are not negative, by bisection with Sturm sequences. */
static double eigenvalue(double *G, int32_t m, int32_t r) {
    double *d = G + m * m, *e = d + m, low = 0, high = 0;
    tridiagonal(G, m, d, e, e + m, e + 2 * m);
    for (int32_t k = 0; k < m; k++) {
        if (!isfinite(d[k])) return NAN;
        high += d[k];
    }
    for (int halving = 0; halving < HALVINGS; halving++) {
        const double middle = low + (high - low) / 2;
        int32_t above = 0;
        double q = 1;
        for (int32_t k = 0; k < m; k++) {
            q = d[k] - middle - (k ? e[k - 1] / q : 0);
            if (q == 0) q = DBL_EPSILON * high + DBL_MIN;
            above += q > 0;
        }
        *(above >= r ? &low : &high) = middle;
    }
    return low;
}

/* Evaluate the constraints of positions; 0 where there are none, or no memory. */
static int32_t hold(ac_instance *i, held *h) {
    const ac_unit *u = i->of;
    const ac_level *l = u->level;
    if (!u->levels) return 0;
    const size_t m = (size_t)l->rows, n = (size_t)l->columns;
    *h = (held){.m = l->rows, .n = l->columns};
    h->A = calloc(m * (2 * n + m + 5) + m + 1, sizeof(double));
    if (!h->A) return 0;
    h->Q = h->A + m * n, h->G = h->Q + m * n;
    double *size = h->G + m * m + 4 * m;
    h->on = (int32_t *)(size + m), h->row = h->on + m;
    h->kept = ac_counting(i, l, h->row);
    for (int32_t a = 0, k = 0; a < h->m; a++) h->on[a] = k < h->kept && h->row[k] == l->row[a] ? ++k : 0;
    ac_constraints(i, l->row, h->m, l->column, h->n, h->A);
    ac_measure(i, l->row, h->m, h->A, h->n, size);
    for (int32_t a = 0; a < h->m; a++) {
        for (int32_t k = 0; k < h->n && size[a] > 0; k++) h->A[a * h->n + k] /= size[a];
    }
    return 1;
}

/* The least singular value that is not 0 everywhere: of all constraints, or of those that are kept. */
static double least(held *h, int kept) {
    int32_t m = 0;
    for (int32_t a = 0; a < h->m; a++) {
        if (h->on[a] || !kept) memcpy(h->Q + m++ * h->n, h->A + a * h->n, (size_t)h->n * sizeof *h->Q);
    }
    for (int32_t a = 0; a < m; a++) {
        for (int32_t b = 0; b < m; b++) h->G[a * m + b] = ac_dot(h->Q + a * h->n, h->Q + b * h->n, h->n);
    }
    return sqrt(fmax(eigenvalue(h->G, m, h->kept), 0));
}

/* Smallest singular value of the constraints of positions, which is 0 in a flat one; infinite where there are none.
   Of constraints that follow from one another it is that of all, of as many as are kept. */
double ac_sharpness(ac_instance *i) {
    held h;
    if (!hold(i, &h)) return INFINITY;
    const double found = h.kept ? least(&h, 0) : INFINITY;
    free(h.A);
    return found;
}

/* Keep as many constraints as before, by pivots: those that cannot be dropped, then the longest beside what is kept. */
static void choose(ac_instance *i, held *h) {
    const ac_unit *u = i->of;
    double *on = i->c + u->switches + u->discretes;
    memcpy(h->Q, h->A, (size_t)h->m * (size_t)h->n * sizeof *h->Q);
    memset(h->on, 0, (size_t)h->m * sizeof *h->on);
    for (int32_t taken = 0; taken < h->kept; taken++) {
        int32_t best = -1, firm = 0;
        double most = -1;
        for (int32_t a = 0; a < h->m; a++) {
            const int32_t stays = u->closure[u->level->row[a]] < 0;
            const double size = sqrt(ac_dot(h->Q + a * h->n, h->Q + a * h->n, h->n));
            if (!h->on[a] && (stays > firm || (stays == firm && size > most))) best = a, firm = stays, most = size;
        }
        double *q = h->Q + best * h->n;
        h->on[best] = 1;
        for (int32_t k = 0; k < h->n && most > 0; k++) q[k] /= most;
        for (int32_t a = 0; a < h->m; a++) {
            const double along = h->on[a] ? 0 : ac_dot(h->Q + a * h->n, q, h->n);
            for (int32_t k = 0; k < h->n; k++) h->Q[a * h->n + k] -= along * q[k];
        }
    }
    for (int32_t a = 0; a < h->m; a++) {
        const int32_t closure = u->closure[u->level->row[a]];
        if (closure >= 0 && (on[closure] > 0) != h->on[a]) on[closure] = h->on[a], ac_changed(i);
    }
}

/* Whether some constraints do not count. */
static int spares(const ac_instance *i) {
    const double *on = i->c + i->of->switches + i->of->discretes;
    for (int32_t k = 0; k < i->of->closures; k++) {
        if (on[k] == 0) return 1;
    }
    return 0;
}

/* How well the kept constraints hold the others: 1 is best, 0 is singular. */
static double conditioning(held *h) {
    if (!h->kept) return 1;
    const double found = least(h, 1) / least(h, 0);
    return found >= 0 ? fmin(found, 1) : 0;
}

/* Whether other constraints are to be kept at the present: with hysteresis, as the best choice may be no better. */
int ac_is_unfit(ac_instance *i) {
    held h;
    if (!spares(i) || !hold(i, &h)) return 0;
    const int found = conditioning(&h) < UNFIT * (i->now.firm < UNFIT ? i->now.firm : 1);
    free(h.A);
    return found;
}

/* Keep others where an integration begins and these hold them badly. */
void ac_keep(ac_instance *i) {
    held h;
    i->now.firm = 0;
    if (!spares(i) || !hold(i, &h)) return;
    if (!i->recorder && conditioning(&h) < FAIRLY) choose(i, &h);
    i->now.firm = conditioning(&h);
    free(h.A);
}
