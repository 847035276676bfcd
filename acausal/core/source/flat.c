/* Flat positions of closed loops, in which two ways to go on meet: the constraints are not independent there. */
#include "instance.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define SWEEPS 30      /* of Jacobi's method; a few are enough */
#define ROUNDING 1e-15
#define FLAT 1e-3      /* smallest singular value of the constraints over their sizes: nearer, errors choose the way */
#define WORN 0.03      /* the same where the equations cannot be solved any more */
#define LARGEST 64     /* constraints of which a decomposition costs less than a step */

/* Smallest eigenvalue of a symmetric matrix, by Jacobi's method. */
static double smallest(double *G, int32_t m) {
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
    double least = INFINITY;
    for (int32_t a = 0; a < m; a++) least = fmin(least, G[a * m + a]);
    return sqrt(fmax(least, 0));
}

/* Smallest singular value of the constraints of positions, which is 0 in a flat one; infinite where there are none, or too many. */
static double sharpness(ac_instance *i) {
    const ac_unit *u = i->of;
    const ac_level *l = u->level;
    if (!u->levels || l->rows > LARGEST) return INFINITY;
    int32_t row[LARGEST];
    const int32_t m = ac_counting(i, l, row);
    double *A = calloc((size_t)m * ((size_t)l->columns + (size_t)m + 1) + 1, sizeof *A);
    if (!A) return INFINITY;
    double *G = A + (size_t)m * (size_t)l->columns, *length = G + (size_t)m * (size_t)m;
    ac_constraints(i, row, m, l->column, l->columns, A);
    for (int32_t a = 0; a < m; a++) {
        double size = 0;
        for (int32_t b = 0; b < l->columns; b++) size += A[a * l->columns + b] * A[a * l->columns + b];
        length[a] = sqrt(size);
    }
    /* Rows of one equation have one size: in a flat position one of them may vanish by itself. */
    for (int32_t a = 0; a < m; a++) {
        double most = 0;
        for (int32_t b = 0; b < m; b++) most = u->kind[row[a]] == u->kind[row[b]] ? fmax(most, length[b]) : most;
        for (int32_t k = 0; k < l->columns && most > 0; k++) A[a * l->columns + k] /= most;
    }
    for (int32_t a = 0; a < m; a++) {
        for (int32_t b = 0; b < m; b++) {
            for (int32_t k = 0; k < l->columns; k++) G[a * m + b] += A[a * l->columns + k] * A[b * l->columns + k];
        }
    }
    const double found = m ? smallest(G, m) : INFINITY;
    free(A);
    return found;
}

/* Whether the present position is flat, as far as can be told where the equations have no solution. */
int ac_is_flat(ac_instance *i) { return sharpness(i) <= WORN; }

/* States between two points, as a cubic through their values and rates. */
static void between(ac_instance *i, const ac_point *a, const ac_point *b, double s) {
    const double h = b->time - a->time, r = 1 - s;
    for (int32_t k = 0; k < ac_states(i); k++) {
        const double step = b->x[k] - a->x[k];
        i->x[k] = r * a->x[k] + s * b->x[k] + s * r * (r * (h * a->rate[k] - step) + s * (step - h * b->rate[k]));
    }
    i->now.time = a->time + s * h;
}

/* Whether loops pass a flat position between two points, which lie one step apart: the least value is looked for by golden sections. */
int32_t ac_flat(ac_instance *i, const ac_point *a, const ac_point *b) {
    const ac_unit *u = i->of;
    const int32_t nx = ac_states(i);
    if (!u->levels || !(b->time > a->time)) return 0;
    const double part = 0.5 * (sqrt(5) - 1), time = i->now.time;
    double *kept = i->other, from = 0, to = 1, least;
    memcpy(kept, i->x, (size_t)nx * sizeof *kept);
    between(i, a, b, 0);
    const double first = sharpness(i);
    between(i, a, b, 1);
    const double last = sharpness(i);
    between(i, a, b, 0.5);
    const double middle = sharpness(i);
    least = fmin(middle, fmin(first, last));
    /* It falls and rises about linearly: what passes 0 shows in a difference of the ends, or in the middle. */
    if (isfinite(least) && (least <= fabs(first - last) + FLAT || middle < fmin(first, last))) {
        for (int k = 0; k < 24 && least > FLAT; k++) {
            const double s = to - part * (to - from), t = from + part * (to - from);
            between(i, a, b, s);
            const double lower = sharpness(i);
            between(i, a, b, t);
            const double upper = sharpness(i);
            least = fmin(least, fmin(lower, upper));
            if (lower < upper) to = t;
            else from = s;
        }
    }
    memcpy(i->x, kept, (size_t)nx * sizeof *kept);
    i->now.time = time;
    return least <= FLAT;
}

/* In Model Exchange: whether loops passed a flat position since the last point that was kept, which the present follows. */
int32_t ac_completed(ac_instance *i) {
    const size_t size = (size_t)ac_states(i) * sizeof(double);
    if (!i->of->levels || !size) return AC_OK;
    const int32_t failed = ac_know(i, AC_RATE);
    if (failed) return failed;
    const ac_point a = {i->now.from, i->before, i->after}, b = {i->now.time, i->dense, i->rate};
    memcpy(i->dense, i->x, size); /* the search moves x */
    if (i->now.curved && ac_flat(i, &a, &b)) return ac_fail(i, AC_FAILED, AC_FLAT_TEXT);
    memcpy(i->before, i->x, size);
    memcpy(i->after, i->rate, size);
    i->now.from = i->now.time, i->now.curved = 1;
    return AC_OK;
}
