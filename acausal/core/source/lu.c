/* Sparse LU whose pivots are kept while the factors stay small: every factorisation runs through one pattern. */
#include "lu.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define GROWN 1e3 /* entries of L, and of U over those of the matrix, at which pivots are chosen anew: 1e-10 is lost at most */
#define ENOUGH 0.1 /* of the largest entry of its column that a pivot has to have, as in Duff's MA28; all where factors grow */
#define LOST (1 / DBL_EPSILON) /* growth of U at which no digit is left */

/* The larger of two numbers, the first where the other is nan: `fmax` is a call of the library, for each entry. */
static double larger(double most, double x) { return x > most ? x : most; }

/* Factors with the pivots that were chosen; 0 where they are no longer good, or U grows more. */
static int refactor(ac_lu *lu, const double *value, double growth) {
    double *w = lu->work, given = 0, grown = 0;
    for (int32_t k = 0; k < lu->n; k++) {
        const int32_t j = lu->column_of[k];
        for (int32_t e = lu->start[j]; e < lu->start[j + 1]; e++) {
            const double x = value[e] * lu->factor[e];
            w[lu->step[e]] = x;
            given = larger(given, fabs(x));
        }
        for (int32_t e = lu->u_start[k]; e < lu->u_start[k + 1]; e++) {
            const int32_t s = lu->u_row[e];
            const double x = lu->u_rows[lu->u_place[e]] = w[s];
            w[s] = 0;
            grown = larger(grown, fabs(x));
            for (int32_t i = lu->l_start[s]; i < lu->l_start[s + 1]; i++) w[lu->l_row[i]] -= lu->l[i] * x;
        }
        const double pivot = w[k], inverse = lu->inverse[k] = 1 / pivot;
        int good = fabs(pivot) > 0 && isfinite(inverse);
        w[k] = 0;
        grown = larger(grown, fabs(pivot));
        for (int32_t i = lu->l_start[k]; i < lu->l_start[k + 1]; i++) {
            lu->l_rows[lu->l_place[i]] = lu->l[i] = w[lu->l_row[i]] * inverse;
            w[lu->l_row[i]] = 0;
            good &= fabs(lu->l[i]) <= lu->most;
        }
        if (!good) {
            memset(w, 0, (size_t)lu->n * sizeof *w);
            return 0;
        }
    }
    return grown <= growth * given;
}

/* Take memory for matrices of a pattern, given in columns; NULL where there is none. */
ac_lu *ac_lu_make(int32_t n, const int32_t *start, const int32_t *row) {
    ac_lu *lu = calloc(1, sizeof *lu);
    if (!lu) return NULL;
    const size_t size = (size_t)n + 1, entries = (size_t)start[n] + 1;
    lu->n = n, lu->most = GROWN;
    lu->start = malloc((8 * size + 2 * entries) * sizeof *lu->start);
    lu->scale = calloc(3 * size + 2 * entries, sizeof *lu->scale);
    if (!lu->start || !lu->scale) {
        ac_lu_free(lu);
        return NULL;
    }
    lu->row_of = lu->start + size, lu->column_of = lu->row_of + size, lu->step_of = lu->column_of + size;
    lu->l_start = lu->step_of + size, lu->u_start = lu->l_start + size;
    lu->l_in = lu->u_start + size, lu->u_in = lu->l_in + size, lu->row = lu->u_in + size;
    lu->step = lu->row + entries;
    lu->inverse = lu->scale + size, lu->work = lu->inverse + size, lu->factor = lu->work + size;
    lu->given = lu->factor + entries;
    memcpy(lu->start, start, size * sizeof *start);
    memcpy(lu->row, row, (size_t)start[n] * sizeof *row);
    return lu;
}

/* Keep pivots as long as no more than a part is lost, rounding times the growth of both factors, but no less than else. */
void ac_lu_lose(ac_lu *lu, double part) { lu->most = fmax(GROWN, sqrt(part / DBL_EPSILON)); }

/* Factorise with the pivots that were chosen; 0 where there are none, or where they are no longer good. */
int ac_lu_again(ac_lu *lu, const double *value) { return lu->ready = lu->ready && refactor(lu, value, lu->most); }

/* Factorise; takes memory only where pivots are chosen. 0, 1 where the matrix is singular, -1 where there is no memory. */
int32_t ac_lu_factor(ac_lu *lu, const double *value) {
    lu->factored++;
    if (ac_lu_again(lu, value)) return 0;
    lu->chosen++;
    const size_t bytes = (size_t)lu->start[lu->n] * sizeof *value;
    if (!lu->known || memcmp(lu->given, value, bytes)) {
        lu->known = 0;
        int32_t failed = ac_lu_choose(lu, value, ENOUGH);
        if (!failed && !refactor(lu, value, lu->most)) failed = ac_lu_choose(lu, value, 1);
        if (failed) return failed;
        memcpy(lu->given, value, bytes);
        lu->known = 1;
    }
    return (lu->ready = refactor(lu, value, LOST)) ? 0 : 1;
}

/* Choose pivots anew for the next matrix. They follow from its values alone, so that those chosen last do for the same ones. */
void ac_lu_renew(ac_lu *lu) {
    lu->ready = 0;
    lu->chosen = lu->factored = 0;
}

/* Solve A x = b in place: by rows, as a sum is quicker than entries that are changed one after the other. */
void ac_lu_solve(ac_lu *lu, double *b) {
    double *y = lu->work;
    for (int32_t k = 0; k < lu->n; k++) {
        double x = b[lu->row_of[k]] * lu->scale[lu->row_of[k]];
        for (int32_t i = lu->l_in[k]; i < lu->l_in[k + 1]; i++) x -= lu->l_rows[i] * y[lu->l_column[i]];
        y[k] = x;
    }
    for (int32_t k = lu->n - 1; k >= 0; k--) {
        double x = y[k];
        for (int32_t e = lu->u_in[k]; e < lu->u_in[k + 1]; e++) x -= lu->u_rows[e] * y[lu->u_column[e]];
        b[lu->column_of[k]] = y[k] = x * lu->inverse[k];
    }
    memset(y, 0, (size_t)lu->n * sizeof *y);
}

/* Solve A' x = b in place. */
void ac_lu_solve_transposed(ac_lu *lu, double *b) {
    double *y = lu->work;
    for (int32_t k = 0; k < lu->n; k++) {
        double x = b[lu->column_of[k]];
        for (int32_t e = lu->u_start[k]; e < lu->u_start[k + 1]; e++) x -= lu->u_rows[lu->u_place[e]] * y[lu->u_row[e]];
        y[k] = x * lu->inverse[k];
    }
    for (int32_t k = lu->n - 1; k >= 0; k--) {
        for (int32_t i = lu->l_start[k]; i < lu->l_start[k + 1]; i++) y[k] -= lu->l[i] * y[lu->l_row[i]];
    }
    for (int32_t k = 0; k < lu->n; k++) {
        b[lu->row_of[k]] = y[k] * lu->scale[lu->row_of[k]];
        y[k] = 0;
    }
}

/* The least pivot over the terms that it is the sum of, 0 where there are no factors: rounding where the matrix is singular. */
double ac_lu_least(ac_lu *lu) {
    double *column = lu->work, least = lu->ready ? INFINITY : 0;
    for (int32_t k = 0; k < lu->n && lu->ready; k++) {
        const double pivot = fabs(1 / lu->inverse[k]);
        double terms = pivot;
        for (int32_t e = lu->u_start[k]; e < lu->u_start[k + 1]; e++) column[lu->u_row[e]] = lu->u_rows[lu->u_place[e]];
        for (int32_t i = lu->l_in[k]; i < lu->l_in[k + 1]; i++) terms += fabs(lu->l_rows[i] * column[lu->l_column[i]]);
        for (int32_t e = lu->u_start[k]; e < lu->u_start[k + 1]; e++) column[lu->u_row[e]] = 0;
        least = fmin(least, pivot / terms);
    }
    return least;
}

/* Whether a permutation is odd; `seen` is memory for it. */
int32_t ac_is_odd(int32_t n, const int32_t *to, int32_t *seen) {
    int32_t odd = 0;
    memset(seen, 0, (size_t)n * sizeof *seen);
    for (int32_t k = 0; k < n; k++) {
        for (int32_t i = k; !seen[i]; i = to[i]) seen[i] = 1, odd ^= i != k;
    }
    return odd;
}

/* Whether the determinant is negative. */
int ac_lu_is_negative(const ac_lu *lu) {
    int negative = lu->odd;
    for (int32_t k = 0; k < lu->n; k++) negative ^= lu->inverse[k] < 0;
    return negative;
}

/* How often pivots were chosen, factorisations, entries of both factors, and operations of one factorisation. */
void ac_lu_counts(const ac_lu *lu, int64_t counts[4]) {
    counts[0] = lu->chosen, counts[1] = lu->factored;
    counts[2] = lu->ready ? (int64_t)lu->l_start[lu->n] + lu->u_start[lu->n] + lu->n : 0;
    counts[3] = lu->ready ? lu->flops : 0;
}

void ac_lu_free(ac_lu *lu) {
    if (!lu) return;
    free(lu->start), free(lu->scale), free(lu->l), free(lu->l_row);
    free(lu);
}
