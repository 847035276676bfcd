/* Algebraic unknowns on their equations, at many places, by Newton's method. */
#include "lu.h"
#include "settle.h"

#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#define MOST 30      /* iterations: from far away they converge slowly at first */
#define LOST 1e-6    /* relative error of a solution at most: growth of both factors, see lu.c, and some condition */
#define ROUNDED 1e-5 /* change over the size that does not become less: beside a singular position rounding is that large */

/* Mark the places of a tape on which its outputs from one on depend. */
static void mark(const ac_tape *tape, int32_t from, char *marked) {
    const int32_t own = tape->constants + tape->inputs;
    for (int32_t k = from; k < tape->outputs; k++) marked[tape->output[k]] = 1;
    for (int32_t k = tape->results - 1; k >= 0; k--) {
        if (marked[own + k]) marked[tape->first[k]] = marked[tape->second[k]] = 1;
    }
}

ac_settler *ac_settler_make(const ac_square *square) {
    ac_settler *s = calloc(1, sizeof *s);
    if (!s) return NULL;
    s->of = *square;
    const ac_tape *tape = square->tape;
    const size_t length = ac_tape_length(tape);
    s->lu = ac_lu_make(square->n, square->start, square->row);
    s->w = calloc(length + (size_t)tape->outputs + 3 * (size_t)square->n + 1, sizeof *s->w);
    s->bends = calloc(length, sizeof *s->bends);
    if (!s->lu || !s->w || !s->bends) {
        ac_settler_free(s);
        return NULL;
    }
    mark(tape, square->n, s->bends);
    s->step = s->w + length, s->entries = s->step + square->n;
    s->size = s->step + tape->outputs, s->wide = s->size + square->n, s->terms = s->wide + square->n;
    memcpy(s->w, tape->constant, (size_t)tape->constants * sizeof *s->w);
    return s;
}

/* Forget what was solved: what is found from here on does not depend on it. */
void ac_settler_renew(ac_settler *s) { ac_lu_renew(s->lu); }

/* The least pivot of the factors used last, over the terms that it is the sum of; 0 where there are none. */
double ac_settler_least(const ac_settler *s) { return ac_lu_least(s->lu); }

void ac_settler_free(ac_settler *s) {
    if (!s) return;
    ac_lu_free(s->lu);
    free(s->w), free(s->bends);
    free(s);
}

/* The sizes of the unknowns, but at least what changes an equation by as much as its terms: what is far below is rounding. */
static void widen(ac_settler *s) {
    const ac_square *q = &s->of;
    const double *input = s->w + q->tape->constants;
    memset(s->terms, 0, (size_t)q->n * sizeof *s->terms);
    for (int32_t k = 0; k < q->n; k++) {
        const double z = fabs(input[q->unknown[k]]);
        for (int32_t e = q->start[k]; e < q->start[k + 1]; e++) s->terms[q->row[e]] += fabs(s->entries[e]) * z;
    }
    for (int32_t k = 0; k < q->n; k++) {
        double least = INFINITY;
        for (int32_t e = q->start[k]; e < q->start[k + 1]; e++) {
            const double change = s->terms[q->row[e]] / fabs(s->entries[e]); /* by an entry of 0: infinite, or nan */
            if (change < least) least = change;
        }
        s->wide[k] = least > s->size[k] && isfinite(least) ? least : s->size[k];
    }
}

/* The largest change of an unknown in a step, over its size, nan where one is; and of those on which the Jacobian depends. */
static double change_of(const ac_settler *s, const double *size, double *bent) {
    const char *bends = s->bends + s->of.tape->constants;
    double change = *bent = 0;
    for (int32_t k = 0; k < s->of.n; k++) {
        const double part = fabs(s->step[k]) / size[k];
        if (part > change || isnan(part)) change = part;
        if (bends[s->of.unknown[k]] && part > *bent) *bent = part;
    }
    return change;
}

/* Whether a step is the last one. What is left of the error is what the factors lost, and the product of the changes, in it and
   to where they were made, of the unknowns on which they depend. */
static int32_t is_last(const ac_settler *s, const double *size, double enough, const double *made) {
    double bent;
    const double change = change_of(s, size, &bent), left = enough * enough;
    return (change <= enough || LOST * change <= left) && bent * (made ? *made : bent) <= left;
}

/* Repeat Newton's step from what stands in w; whether it converged. The first factors are kept if two more steps do not need
   better ones. */
static int32_t settle(ac_settler *s, double enough, int64_t *evaluations) {
    const ac_square *q = &s->of;
    const ac_tape *tape = q->tape;
    double *input = s->w + tape->constants, before = INFINITY, last = INFINITY, first = 0, bent;
    const double *made = NULL;
    for (int tries = 0; tries < MOST; tries++) {
        ac_tape_run(tape, s->w, tape->early, tape->runs);
        ++*evaluations;
        /* The step stands before the entries of the matrix, as the residuals do among the results. */
        for (int32_t k = 0; k < (made ? q->n : tape->outputs); k++) s->step[k] = s->w[tape->output[k]];
        if (!made && ac_lu_factor(s->lu, s->entries)) return 0;
        ac_lu_solve(s->lu, s->step);
        const double change = change_of(s, s->size, &bent);
        /* What follows through products moves in the second step first. */
        if (!(change < before)) return change <= ROUNDED; /* nan is not */
        for (int32_t k = 0; k < q->n; k++) input[q->unknown[k]] -= s->step[k];
        if (is_last(s, s->size, enough, made)) return 1;
        if (!tries) {
            first = bent;
            if (first * first * first <= enough * enough) made = &first;
        }
        /* Where more may be left than the factors lose in one step, that is no reason for another one. */
        if (tries || enough * enough >= LOST) {
            widen(s);
            if (is_last(s, s->wide, enough, made)) {
                memcpy(s->size, s->wide, (size_t)q->n * sizeof *s->size); /* for the places that follow */
                return 1;
            }
        }
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
    memcpy(s->size, size, (size_t)s->of.n * sizeof *size);
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
        settled[i] = settle(s, enough, &evaluations);
        for (int32_t k = 0; k < s->of.n; k++) *found++ = s->w[tape->constants + s->of.unknown[k]];
    }
    return evaluations;
}
