/* Close loops after a jump: the least change of the states, over their sizes, for which the constraints hold. */
#include "instance.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define TRIES 30        /* Gauss-Newton steps of a level */
#define CLOSED 1e-9     /* of what sizes of the states change in a constraint, as in Python */
#define INDEPENDENT 1e-7 /* of a row: less is left where it follows from the others */

/* One level: matrix A of rows by states over their sizes, residuals, and the rows that count. */
typedef struct {
    int32_t m, n;
    int32_t *row, *column;
    double *A, *r, *y, *Q; /* (m, n), (m), (m), (m, n) */
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

static void fill(ac_instance *i, closing *c) {
    const double *w = ac_constraints(i, c->row, c->m, c->column, c->n, c->A);
    for (int32_t a = 0; a < c->m; a++) c->r[a] = w[i->of->tape[AC_CLOSING].output[c->row[a]]];
}

static double dot(const double *a, const double *b, int32_t n) {
    double sum = 0;
    for (int32_t k = 0; k < n; k++) sum += a[k] * b[k];
    return sum;
}

/* The step of least norm with A step = -r, into y of length n: Gram and Schmidt on the rows, twice. */
static void least(closing *c, double *step) {
    memset(step, 0, (size_t)c->n * sizeof *step);
    for (int32_t a = 0; a < c->m; a++) {
        double *q = c->Q + a * c->n;
        const double *row = c->A + a * c->n;
        const double size = sqrt(dot(row, row, c->n));
        memcpy(q, row, (size_t)c->n * sizeof *q);
        c->y[a] = 0;
        for (int twice = 0; twice < 2; twice++) {
            for (int32_t b = 0; b < a; b++) {
                const double *other = c->Q + b * c->n, along = dot(q, other, c->n);
                for (int32_t k = 0; k < c->n; k++) q[k] -= along * other[k];
            }
        }
        const double left = sqrt(dot(q, q, c->n));
        if (!(left > INDEPENDENT * size)) {
            memset(q, 0, (size_t)c->n * sizeof *q);
            continue;
        }
        for (int32_t k = 0; k < c->n; k++) q[k] /= left;
        /* What the steps so far leave of this row's residual goes along its own direction. */
        const double along = (-c->r[a] - dot(row, step, c->n)) / dot(row, q, c->n);
        for (int32_t k = 0; k < c->n; k++) step[k] += along * q[k];
    }
}

/* Largest residual over what sizes of the states change in it. */
static double mismatch(const closing *c) {
    double most = 0, size = 0;
    for (int32_t a = 0; a < c->m; a++) size = fmax(size, sqrt(dot(c->A + a * c->n, c->A + a * c->n, c->n)));
    for (int32_t a = 0; a < c->m; a++) most = fmax(most, fabs(c->r[a]));
    return size > 0 ? most / size : most;
}

static int32_t close_level(ac_instance *i, closing *c, double *step) {
    double before = INFINITY;
    for (int tries = 0; tries < TRIES; tries++) {
        fill(i, c);
        const double now = mismatch(c);
        if (!(now < before) || now == 0) break;
        before = now;
        least(c, step);
        for (int32_t k = 0; k < c->n; k++) i->x[c->column[k]] += step[k] * i->of->reach[c->column[k]];
    }
    fill(i, c);
    return mismatch(c) <= CLOSED ? AC_OK : ac_fail(i, AC_FAILED, "closed loops do not close after a jump.");
}

/* Close all loops; states that are held stay. */
int32_t ac_close(ac_instance *i, const double *held) {
    const ac_unit *u = i->of;
    int32_t failed = AC_OK;
    for (int32_t level = 0; level < u->levels && !failed; level++) {
        const ac_level *l = &u->level[level];
        closing c = {0};
        const size_t size = (size_t)l->rows * (size_t)l->columns;
        double *memory = calloc(2 * size + 2 * (size_t)l->rows + (size_t)l->columns + 1, sizeof *memory);
        int32_t *places = calloc((size_t)l->rows + (size_t)l->columns + 1, sizeof *places);
        if (memory && places) {
            c.row = places, c.column = places + l->rows;
            c.A = memory, c.Q = c.A + size, c.r = c.Q + size, c.y = c.r + l->rows;
            c.m = ac_counting(i, l, c.row);
            for (int32_t k = 0; k < l->columns; k++) {
                if (!held[l->column[k]]) c.column[c.n++] = l->column[k];
            }
            failed = close_level(i, &c, c.y + l->rows);
        } else {
            failed = ac_fail(i, AC_FAILED, "there is not enough memory.");
        }
        free(memory), free(places);
    }
    ac_moved(i);
    return failed;
}
