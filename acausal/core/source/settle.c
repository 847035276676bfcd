/* Algebraic unknowns on their equations, at many places, by Newton's method. */
#include "settle.h"

#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#define MOST 30      /* iterations: from far away they converge slowly at first */
#define ROUNDED 1e-5 /* change over the size that does not become less: beside a singular position rounding is that large */

ac_settler *ac_settler_make(const ac_square *square) {
    ac_settler *s = calloc(1, sizeof *s);
    if (!s) return NULL;
    s->of = *square;
    const ac_tape *tape = square->tape;
    const size_t length = ac_tape_length(tape);
    s->lu = ac_lu_make(square->n, square->start, square->row);
    s->w = calloc(length + (size_t)tape->outputs + 1, sizeof *s->w);
    if (!s->lu || !s->w) {
        ac_settler_free(s);
        return NULL;
    }
    s->step = s->w + length, s->entries = s->step + square->n;
    memcpy(s->w, tape->constant, (size_t)tape->constants * sizeof *s->w);
    return s;
}

void ac_settler_free(ac_settler *s) {
    if (!s) return;
    ac_lu_free(s->lu);
    free(s->w);
    free(s);
}

/* Repeat Newton's step from what stands in w; whether it converged. */
static int32_t settle(ac_settler *s, const double *size, double enough, int64_t *evaluations) {
    const ac_square *q = &s->of;
    const ac_tape *tape = q->tape;
    double *input = s->w + tape->constants, before = INFINITY, last = INFINITY;
    for (int tries = 0; tries < MOST; tries++) {
        ac_tape_run(tape, s->w, tape->early, tape->runs);
        ++*evaluations;
        /* The step stands before the entries of the matrix, as the residuals do among the results. */
        for (int32_t k = 0; k < tape->outputs; k++) s->step[k] = s->w[tape->output[k]];
        if (ac_lu_factor(s->lu, s->entries)) return 0;
        ac_lu_solve(s->lu, s->step);
        double change = 0;
        for (int32_t k = 0; k < q->n; k++) {
            const double part = fabs(s->step[k]) / size[k];
            if (!(part <= change)) change = part; /* nan as well */
        }
        /* What follows through products moves in the second step first. */
        if (!(change < before)) return change <= ROUNDED; /* nan is not */
        for (int32_t k = 0; k < q->n; k++) input[q->unknown[k]] -= s->step[k];
        if (change <= enough) return 1;
        before = last, last = change;
    }
    return 0;
}

/* Solve at many places: inputs as of `ac_tape_rows`, those of the first `early` parts are what the early runs need. `found`: n
   unknowns of each row, `settled`: whether they are those of the equations. Returns the number of evaluations. */
int64_t ac_settle_rows(ac_settler *s, int32_t rows, int32_t parts, int32_t early, const int32_t *length, const int32_t *stride,
                       const double *const *part, const double *size, double enough, double *found, int32_t *settled) {
    const ac_tape *tape = s->of.tape;
    int64_t evaluations = 0;
    for (int32_t i = 0; i < rows; i++) {
        double *input = s->w + tape->constants;
        int32_t fresh = i == 0;
        for (int32_t j = 0; j < parts; j++) {
            const double *from = part[j] + (ptrdiff_t)i * stride[j];
            const size_t bytes = (size_t)length[j] * sizeof *input;
            if (j < early) fresh |= bytes && memcmp(input, from, bytes) != 0;
            if (bytes) memcpy(input, from, bytes);
            input += length[j];
        }
        if (fresh) ac_tape_run(tape, s->w, 0, tape->early);
        settled[i] = settle(s, size, enough, &evaluations);
        for (int32_t k = 0; k < s->of.n; k++) *found++ = s->w[tape->constants + s->of.unknown[k]];
    }
    return evaluations;
}
