/* Close loops after a jump: the states change by little, over their sizes, until the constraints hold; as `levenberg_marquardt.py`. */
#include "instance.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define EVALUATIONS 200 /* of a level */
#define ENDS 1e-15      /* relative change of the states at which a level is done */
#define DAMPING 0.1     /* of the first step, over the greatest square of a row, as in Python */
#define ROUNDING 1e-14  /* the least: rows that follow from others leave rounding */
#define PART 0.2        /* of a jump, in nominal values: loops follow in such parts, and so stay in their assembly */
#define PARTS 100
#define CLOSED 1e-9     /* of what sizes of the states change in a constraint, as in Python */

/* One level: residuals r and their matrix A of rows by states over their sizes, both over the sizes of the equations; the same
   where a step h leads; S = A A' + damping, and what solves it. */
typedef struct {
    int32_t m, n;
    const int32_t *row;
    int32_t *column;
    double *A, *r, *size, *S, *y, *h, *before, *B, *q;
} closing;

/* Rows of a level that count: redundant ones do not. Returns how many. */
int32_t ac_counting(const ac_instance *i, const ac_level *l, int32_t *row) {
    const ac_unit *u = i->of;
    const double *on = i->c + u->switches + u->discretes;
    int32_t m = 0;
    for (int32_t k = 0; k < l->rows; k++) {
        if (u->closure[l->row[k]] < 0 || on[u->closure[l->row[k]]] > 0) row[m++] = l->row[k];
    }
    return m;
}

/* Derivatives of m rows by n states over their sizes, at the present; returns the values of the tape. */
const double *ac_constraints(ac_instance *i, const int32_t *row, int32_t m, const int32_t *column, int32_t n, double *A) {
    const ac_unit *u = i->of;
    const double *w = ac_run(i, AC_CLOSING);
    const int32_t *output = u->tape[AC_CLOSING].output;
    memset(A, 0, (size_t)m * (size_t)n * sizeof *A);
    for (int32_t b = 0; b < n; b++) {
        const int32_t j = column[b];
        for (int32_t k = u->close_start[j]; k < u->close_start[j + 1]; k++) {
            for (int32_t a = 0; a < m; a++) {
                if (row[a] == u->close_row[k]) A[a * n + b] = w[output[u->constraints + k]] * u->reach[j];
            }
        }
    }
    return w;
}

double ac_dot(const double *a, const double *b, int32_t n) {
    double sum = 0;
    for (int32_t k = 0; k < n; k++) sum += a[k] * b[k];
    return sum;
}

/* In a flat position, or at a dead centre, one row of an equation may vanish by itself. */
void ac_measure(const ac_instance *i, const int32_t *row, int32_t m, const double *A, int32_t n, double *size) {
    const int32_t *kind = i->of->kind;
    for (int32_t a = 0; a < m; a++) size[a] = sqrt(ac_dot(A + a * n, A + a * n, n));
    for (int32_t a = 0; a < m; a++) {
        for (int32_t b = 0; b < m; b++) size[a] = kind[row[a]] == kind[row[b]] ? fmax(size[a], size[b]) : size[a];
    }
}

/* Evaluate at the present. */
static void fill(ac_instance *i, closing *c) {
    const double *w = ac_constraints(i, c->row, c->m, c->column, c->n, c->A);
    for (int32_t a = 0; a < c->m; a++) {
        c->r[a] = w[i->of->tape[AC_CLOSING].output[c->row[a]]] / c->size[a];
        for (int32_t k = 0; k < c->n; k++) {
            const int32_t j = c->column[k];
            c->A[a * c->n + k] *= i->of->follows[j] / i->of->reach[j] / c->size[a];
        }
    }
}

/* Sizes of the equations; of those that no state changes, that of the largest other. */
static void size_up(ac_instance *i, closing *c) {
    double any = 0;
    for (int32_t a = 0; a < c->m; a++) c->size[a] = 1;
    fill(i, c);
    ac_measure(i, c->row, c->m, c->A, c->n, c->y);
    for (int32_t a = 0; a < c->m; a++) any = fmax(any, c->y[a]);
    for (int32_t a = 0; a < c->m; a++) c->size[a] = c->y[a] > 0 ? c->y[a] : any > 0 ? any : 1;
    fill(i, c);
}

/* The step h = -A'(A A' + damping)^-1 r; 0 where rounding hides it. */
static int step(closing *c, double damping) {
    const int32_t m = c->m, n = c->n;
    for (int32_t a = 0; a < m; a++) {
        for (int32_t b = 0; b <= a; b++) {
            double left = ac_dot(c->A + a * n, c->A + b * n, n) + (a == b ? damping : 0) - ac_dot(c->S + a * m, c->S + b * m, b);
            if (a == b && !(left > 0)) return 0;
            c->S[a * m + b] = a == b ? sqrt(left) : left / c->S[b * m + b];
        }
        c->y[a] = (c->r[a] - ac_dot(c->S + a * m, c->y, a)) / c->S[a * m + a];
    }
    memset(c->h, 0, (size_t)n * sizeof *c->h);
    for (int32_t a = m - 1; a >= 0; a--) {
        c->y[a] /= c->S[a * m + a];
        for (int32_t b = 0; b < a; b++) c->y[b] -= c->S[a * m + b] * c->y[a];
        for (int32_t k = 0; k < n; k++) c->h[k] -= c->A[a * n + k] * c->y[a];
    }
    return 1;
}

static void move(ac_instance *i, const closing *c) {
    for (int32_t k = 0; k < c->n; k++) i->x[c->column[k]] = c->before[k] + c->h[k] * i->of->follows[c->column[k]];
}

/* Levenberg's and Marquardt's iteration (Madsen, Nielsen and Tingleff 2004, algorithm 3.16). */
static int32_t close_level(ac_instance *i, closing *c) {
    const size_t size = (size_t)c->m * (size_t)c->n * sizeof *c->A;
    double damping = 0, growth = 2, most = 0, worst = 0;
    size_up(i, c);
    for (int32_t a = 0; a < c->m; a++) damping = fmax(damping, ac_dot(c->A + a * c->n, c->A + a * c->n, c->n));
    most = damping, damping *= DAMPING;
    for (int tries = 0; tries < EVALUATIONS && most > 0; tries++) {
        const double now = ac_dot(c->r, c->r, c->m);
        double far = 0, long_ = 0, expected = 0;
        for (int32_t k = 0; k < c->n; k++) c->before[k] = i->x[c->column[k]];
        if (!step(c, damping)) {
            damping *= growth, growth *= 2;
            continue;
        }
        for (int32_t k = 0; k < c->n; k++) {
            double slope = 0;
            for (int32_t a = 0; a < c->m; a++) slope += c->A[a * c->n + k] * c->r[a];
            expected += c->h[k] * (damping * c->h[k] - slope);
            far += c->h[k] * c->h[k], long_ += pow(c->before[k] / i->of->follows[c->column[k]], 2);
        }
        if (!(far > ENDS * ENDS * long_)) break;
        memcpy(c->B, c->A, size), memcpy(c->q, c->r, (size_t)c->m * sizeof *c->q);
        move(i, c);
        fill(i, c);
        const double gain = (now - ac_dot(c->r, c->r, c->m)) / expected;
        if (gain > 0) {
            damping = fmax(damping * fmax(1.0 / 3, 1 - pow(2 * gain - 1, 3)), ROUNDING * most), growth = 2;
        } else {
            memset(c->h, 0, (size_t)c->n * sizeof *c->h);
            move(i, c);
            memcpy(c->A, c->B, size), memcpy(c->r, c->q, (size_t)c->m * sizeof *c->q);
            damping *= growth, growth *= 2;
        }
    }
    for (int32_t a = 0; a < c->m; a++) worst = fmax(worst, c->r[a] == c->r[a] ? fabs(c->r[a]) : INFINITY);
    return worst <= CLOSED ? AC_OK : ac_refuse(i, AC_APART, "closed loops do not close after a jump.");
}

/* Coordinates where the states have them, and multipliers 0: from others an iteration may come to other positions. */
void ac_follow_states(ac_instance *i) {
    const ac_unit *u = i->of;
    for (int32_t k = 0; k < u->constraints; k++) i->z[u->multiplier[k]] = 0;
    for (int32_t k = 0; k < u->standing; k++) i->z[u->stands[2 * k]] = i->x[u->stands[2 * k + 1]];
}

/* Close the first levels; states that are held stay. */
static int32_t close_levels(ac_instance *i, const double *held, int32_t levels) {
    const ac_unit *u = i->of;
    int32_t failed = AC_OK;
    for (int32_t level = 0; level < levels && !failed; level++) {
        const ac_level *l = &u->level[level];
        const size_t m = (size_t)l->rows, n = (size_t)l->columns;
        double *memory = calloc(2 * m * n + m * m + 4 * m + 2 * n + 1, sizeof *memory);
        int32_t *places = calloc(n + 1, sizeof *places);
        if (memory && places) {
            closing c = {.m = l->rows, .row = l->row, .column = places, .A = memory};
            c.B = c.A + m * n, c.S = c.B + m * n, c.r = c.S + m * m, c.size = c.r + m, c.y = c.size + m, c.q = c.y + m;
            c.h = c.q + m, c.before = c.h + n;
            for (int32_t k = 0; k < l->columns; k++) {
                if (!held[l->column[k]]) c.column[c.n++] = l->column[k];
            }
            failed = close_level(i, &c);
        } else {
            failed = ac_fail(i, AC_FAILED, "there is not enough memory.");
        }
        free(memory), free(places);
    }
    return failed;
}

/* Close all loops after a jump of the states that are held, from where they were: (2, nx), the second half is overwritten. The
   jump is gone in parts; where loops do not close on the way, at once. */
int32_t ac_close(ac_instance *i, const double *held, double *from) {
    const int32_t nx = ac_states(i);
    double *to = from + nx, far = 0;
    for (int32_t k = 0; k < nx; k++) {
        to[k] = i->x[k];
        if (held[k] > 0) far = fmax(far, fabs(to[k] - from[k]) / i->of->nominal[k]);
    }
    const int32_t parts = (int32_t)fmin(fmax(ceil(far / PART), 1), PARTS);
    int32_t lost = 0;
    for (int32_t part = 1; part < parts && !lost; part++) {
        for (int32_t k = 0; k < nx; k++) {
            if (held[k] > 0) i->x[k] = from[k] + part * (to[k] - from[k]) / parts;
        }
        lost = close_levels(i, held, 1);
    }
    for (int32_t k = 0; k < nx; k++) {
        if (held[k] > 0 || lost) i->x[k] = to[k];
    }
    const int32_t failed = close_levels(i, held, i->of->levels);
    ac_follow_states(i);
    ac_moved(i);
    return failed;
}

/* Close all loops from near. */
int32_t ac_close_all(ac_instance *i) {
    double *held = i->other;
    memset(held, 0, (size_t)ac_states(i) * sizeof *held);
    const int32_t failed = close_levels(i, held, i->of->levels);
    ac_follow_states(i);
    ac_moved(i);
    return failed;
}
