/* Constraints of closed loops: how far they are from a flat position, and which are kept of some that follow from one another.
   Which of them follow from the others changes with the position; as `independent_constraints.py`. */
#include "instance.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define SWEEPS 30     /* of Jacobi's method; a few are enough */
#define ROUNDING 1e-15
#define LARGEST 64    /* constraints of which a decomposition costs less than a step */
#define FAIRLY 0.5    /* how well kept constraints hold the others: below, others are kept, as `simulate` does */

/* Constraints of positions at the present, over the size of each equation: A (m, n), Q as much; how many of them are kept. */
typedef struct {
    int32_t m, n, kept;
    double *A, *Q, *G; /* G: (m, m) */
    int32_t on[LARGEST];
} held;

/* The r-th largest eigenvalue of a symmetric matrix, by Jacobi's method. */
static double eigenvalue(double *G, int32_t m, int32_t r) {
    for (int sweep = 0; sweep < SWEEPS; sweep++) {
        double off = 0;
        for (int32_t a = 0; a < m; a++) {
            for (int32_t b = a + 1; b < m; b++) {
                const double g = G[a * m + b];
                off = fmax(off, fabs(g));
                if (fabs(g) <= ROUNDING) continue;
                const double theta = (G[b * m + b] - G[a * m + a]) / (2 * g);
                const double t = (theta < 0 ? -1 : 1) / (fabs(theta) + sqrt(1 + theta * theta));
                const double c = 1 / sqrt(1 + t * t), s = t * c;
                for (int32_t k = 0; k < m; k++) {
                    const double x = G[k * m + a], y = G[k * m + b];
                    G[k * m + a] = c * x - s * y, G[k * m + b] = s * x + c * y;
                }
                for (int32_t k = 0; k < m; k++) {
                    const double x = G[a * m + k], y = G[b * m + k];
                    G[a * m + k] = c * x - s * y, G[b * m + k] = s * x + c * y;
                }
            }
        }
        if (off <= ROUNDING) break;
    }
    for (int32_t a = 0; a < m; a++) {
        int32_t larger = 0;
        for (int32_t b = 0; b < m; b++) larger += G[b * m + b] > G[a * m + a] || (b < a && G[b * m + b] == G[a * m + a]);
        if (larger == r - 1) return G[a * m + a];
    }
    return NAN;
}

/* Evaluate the constraints of positions; 0 where there are none, too many, or no memory. */
static int32_t hold(ac_instance *i, held *h) {
    const ac_unit *u = i->of;
    const ac_level *l = u->level;
    if (!u->levels || l->rows > LARGEST) return 0;
    const size_t m = (size_t)l->rows, n = (size_t)l->columns;
    *h = (held){.m = l->rows, .n = l->columns};
    h->A = calloc(m * (2 * n + m + 1) + 1, sizeof(double));
    if (!h->A) return 0;
    h->Q = h->A + m * n, h->G = h->Q + m * n;
    double *size = h->G + m * m;
    int32_t row[LARGEST];
    h->kept = ac_counting(i, l, row);
    for (int32_t a = 0, k = 0; a < h->m; a++) h->on[a] = k < h->kept && row[k] == l->row[a] ? ++k : 0;
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

/* Smallest singular value of the constraints of positions, which is 0 in a flat one; infinite where there are none, or too many.
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
    memset(h->on, 0, sizeof h->on);
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

static int unfit(held *h) { return h->kept && !(least(h, 1) >= FAIRLY * least(h, 0)); }

/* Whether other constraints are to be kept at the present. */
int ac_is_unfit(ac_instance *i) {
    held h;
    if (!spares(i) || !hold(i, &h)) return 0;
    const int found = unfit(&h);
    free(h.A);
    return found;
}

/* Keep others where that is so. */
void ac_keep(ac_instance *i) {
    held h;
    if (!spares(i) || !hold(i, &h)) return;
    if (unfit(&h)) choose(i, &h);
    free(h.A);
}

const char *ac_unsolved(const ac_instance *i) {
    return i->of->levels && i->of->level->rows > LARGEST && spares(i)
        ? "the equations have no solution here; which constraints of closed loops are kept is not changed among more than 64."
        : "the equations have no solution here.";
}
