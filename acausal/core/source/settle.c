/* Algebraic unknowns on their equations, at many places, by Newton's method. */
#include "lu.h"
#include "settle.h"

#include <float.h>
#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#define MOST 30      /* iterations: from far away they converge slowly at first */
#define LOST 1e-6    /* relative error of a solution at most: growth of both factors, see lu.c, and some condition */
#define MOST_DAMPED 100 /* iterations that leave less each: by halves they come from 1 to the width of tanh(1e6 z), and on */
#define HALVINGS 30  /* of a step that leaves more */
#define ROUNDED 1e-5 /* change over the size that does not become less: beside a singular position rounding is that large */
#define LEAST 1e-9   /* of the size of an unknown: what is less may be rounding */
#define LEFT 1e-6    /* of the terms, there: beside a bend more is left */
#define ROUNDINGS 8  /* of each input, by which an equation is asked how far rounding moves it; and by how much more it may */
#define FURTHER 4
#define CREEPS 0.1   /* of the last step: where Newton's steps converge, one is less */

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
    s->w = calloc(length + (size_t)tape->outputs + 5 * (size_t)square->n + (size_t)tape->inputs + 1, sizeof *s->w);
    s->bends = calloc(length, sizeof *s->bends);
    if (!s->lu || !s->w || !s->bends) {
        ac_settler_free(s);
        return NULL;
    }
    mark(tape, square->n, s->bends);
    s->step = s->w + length, s->entries = s->step + square->n;
    s->size = s->step + tape->outputs, s->wide = s->size + square->n, s->terms = s->wide + square->n;
    s->first = s->terms + square->n, s->from = s->first + square->n;
    s->exact = s->from + square->n;
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

/* Terms of each equation in the unknowns, added up. */
static void find_terms(ac_settler *s) {
    const ac_square *q = &s->of;
    const double *input = s->w + q->tape->constants;
    memset(s->terms, 0, (size_t)q->n * sizeof *s->terms);
    for (int32_t k = 0; k < q->n; k++) {
        const double z = fmax(fabs(input[q->unknown[k]]), LEAST * s->size[k]);
        for (int32_t e = q->start[k]; e < q->start[k + 1]; e++) s->terms[q->row[e]] += fabs(s->entries[e]) * z;
    }
}

/* The sizes of the unknowns, but at least what changes an equation by as much as its terms: what is far below is rounding. */
static void widen(ac_settler *s) {
    const ac_square *q = &s->of;
    find_terms(s);
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

/* The largest residual over the terms of its equation, nan where one is. */
static double left_of(const ac_settler *s) {
    const ac_tape *tape = s->of.tape;
    double most = 0;
    for (int32_t k = 0; k < s->of.n; k++) {
        const double residual = fabs(s->w[tape->output[k]]), part = residual == 0 ? 0 : residual / s->terms[k];
        if (part > most || isnan(part)) most = part;
    }
    return most;
}

/* Whether a step of such changes may be the last one. What is left of the error is what the factors lost, and the product of the
   changes, in it and to where they were made, of the unknowns on which they depend. */
static int is_small(double change, double bent, double enough, const double *made) {
    const double left = enough * enough;
    return (change <= enough || LOST * change <= left) && bent * (made ? *made : bent) <= left;
}

static void run(ac_settler *s, int64_t *evaluations) {
    ac_tape_run(s->of.tape, s->w, s->of.tape->early, s->of.tape->runs);
    ++*evaluations;
}

/* Whether what is left after a step is rounding where it is more than a part of the terms: what some rounding errors of the inputs, as
   they enter the late runs, make of an equation. Where its unknowns are 0, that is all there is. Results are not those of the inputs
   then. */
static int rounds(ac_settler *s, double enough, int64_t *evaluations) {
    const ac_tape *tape = s->of.tape;
    const int32_t n = s->of.n;
    double *input = s->w + tape->constants, *left = s->step, *noise = s->from;
    uint32_t sign = 1;
    int found = 1;
    run(s, evaluations);
    for (int32_t k = 0; k < n; k++) left[k] = s->w[tape->output[k]], noise[k] = 0;
    memcpy(s->exact, input, (size_t)tape->inputs * sizeof *input);
    for (int tries = 0; tries < 2; tries++) {
        for (int32_t k = 0; k < tape->inputs; k++) {
            sign = sign * 1664525u + 1013904223u;
            input[k] = s->exact[k] * (1 + (sign >> 31 ? ROUNDINGS : -ROUNDINGS) * DBL_EPSILON);
        }
        run(s, evaluations);
        for (int32_t k = 0; k < n; k++) noise[k] = fmax(noise[k], fabs(s->w[tape->output[k]] - left[k]));
    }
    for (int32_t k = 0; k < n && found; k++) found = fabs(left[k]) <= fmax(enough * s->terms[k], FURTHER * noise[k]);
    memcpy(input, s->exact, (size_t)tape->inputs * sizeof *input);
    if (!found) run(s, evaluations);
    return found;
}

/* Whether what the equations left before a small step is little, too, or rounding, where that is asked for as the step is not much
   less than the last one: a law may bend within much less than the sizes of unknowns. What is linear holds after it. */
static int holds(ac_settler *s, double enough, double bent, int creeps, int64_t *evaluations) {
    if (bent == 0) return 1;
    find_terms(s);
    return left_of(s) <= enough || (creeps && rounds(s, enough, evaluations));
}

/* Repeat Newton's step from what stands in w; whether it converged. The first factors are kept if two more steps do not need
   better ones. */
static int32_t settle(ac_settler *s, double enough, int64_t *evaluations) {
    const ac_square *q = &s->of;
    const ac_tape *tape = q->tape;
    double *input = s->w + tape->constants, before = INFINITY, last = INFINITY, first = 0, bent;
    const double *made = NULL;
    for (int tries = 0; tries < MOST; tries++) {
        run(s, evaluations);
        /* The step stands before the entries of the matrix, as the residuals do among the results. */
        for (int32_t k = 0; k < (made ? q->n : tape->outputs); k++) s->step[k] = s->w[tape->output[k]];
        if (!made && ac_lu_factor(s->lu, s->entries)) return 0;
        ac_lu_solve(s->lu, s->step);
        const double change = change_of(s, s->size, &bent);
        /* What follows through products moves in the second step first. */
        if (!(change < before)) {
            find_terms(s);
            return change <= ROUNDED && (left_of(s) <= LEFT || rounds(s, LEFT, evaluations)); /* nan is not */
        }
        for (int32_t k = 0; k < q->n; k++) input[q->unknown[k]] -= s->step[k];
        const int small = is_small(change, bent, enough, made), creeps = change > CREEPS * last;
        if (small && holds(s, enough, bent, creeps, evaluations)) return 1;
        if (!tries) {
            first = bent;
            if (first * first * first <= enough * enough) made = &first;
        }
        /* Where more may be left than the factors lose in one step, that is no reason for another one. */
        if (!small && (tries || enough * enough >= LOST)) {
            widen(s);
            double wide;
            const double widened = change_of(s, s->wide, &wide);
            if (is_small(widened, wide, enough, made) && holds(s, enough, bent, creeps, evaluations)) {
                memcpy(s->size, s->wide, (size_t)q->n * sizeof *s->size); /* for the places that follow */
                return 1;
            }
        }
        before = last, last = change;
    }
    return 0;
}

/* Newton's steps from what was given, as much of each as leaves less: where equations bend, whole ones may lead to and fro. */
static int damped(ac_settler *s, double enough, int64_t *evaluations) {
    const ac_square *q = &s->of;
    const ac_tape *tape = q->tape;
    double *input = s->w + tape->constants;
    for (int32_t k = 0; k < q->n; k++) input[q->unknown[k]] = s->first[k];
    run(s, evaluations);
    for (int tries = 0; tries < MOST_DAMPED; tries++) {
        for (int32_t k = 0; k < tape->outputs; k++) s->step[k] = s->w[tape->output[k]];
        for (int32_t k = 0; k < q->n; k++) s->from[k] = input[q->unknown[k]];
        if (ac_lu_factor(s->lu, s->entries)) return 0;
        find_terms(s);
        const double before = left_of(s);
        double part = 1, bent;
        ac_lu_solve(s->lu, s->step);
        const double change = change_of(s, s->size, &bent);
        if (isnan(change)) return 0;
        for (int halvings = 0;; halvings++, part /= 2) {
            if (halvings == HALVINGS) return change <= ROUNDED && (before <= LEFT || rounds(s, LEFT, evaluations));
            for (int32_t k = 0; k < q->n; k++) input[q->unknown[k]] = s->from[k] - part * s->step[k];
            run(s, evaluations);
            if (left_of(s) < before) break;
        }
        if (part == 1 && is_small(change, bent, enough, NULL) && holds(s, enough, bent, 1, evaluations)) return 1;
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
        for (int32_t k = 0; k < s->of.n; k++) s->first[k] = s->w[tape->constants + s->of.unknown[k]];
        settled[i] = settle(s, enough, &evaluations) || damped(s, enough, &evaluations);
        for (int32_t k = 0; k < s->of.n; k++) *found++ = s->w[tape->constants + s->of.unknown[k]];
    }
    return evaluations;
}
