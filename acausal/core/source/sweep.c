/* Sweeps over a tape whose values stand in w: A. Griewank, A. Walther, Evaluating Derivatives, 2008, chapter 3. */
#include "sweep.h"

#include <math.h>

#define TWO_OVER_ROOT_PI 1.1283791670955126

/* Derivatives of an operation by its arguments x and y; r is its result. Of one that has a kink, those of a side of it. */
static void slopes(int32_t kind, double x, double y, double r, double *a, double *b) {
    *a = *b = 0;
    switch (kind) {
    case AC_ADD: *a = 1, *b = 1; break;
    case AC_SUB: *a = 1, *b = -1; break;
    case AC_MUL: *a = y, *b = x; break;
    case AC_DIV: *a = 1 / y, *b = -r / y; break;
    case AC_NEG: *a = -1; break;
    case AC_SQ: *a = 2 * x; break;
    case AC_TWICE: *a = 2; break;
    case AC_INV: *a = -r * r; break;
    case AC_SQRT: *a = 0.5 / r; break;
    case AC_SIN: *a = cos(x); break;
    case AC_COS: *a = -sin(x); break;
    case AC_TAN: *a = 1 + r * r; break;
    case AC_ASIN: *a = 1 / sqrt(1 - x * x); break;
    case AC_ACOS: *a = -1 / sqrt(1 - x * x); break;
    case AC_ATAN: *a = 1 / (1 + x * x); break;
    case AC_ATAN2: *a = y / (x * x + y * y), *b = -x / (x * x + y * y); break;
    case AC_EXP: *a = r; break;
    case AC_LOG: *a = 1 / x; break;
    case AC_POW: *a = y == 0 ? 0 : y * pow(x, y - 1), *b = x > 0 ? r * log(x) : 0; break;
    case AC_SINH: *a = cosh(x); break;
    case AC_COSH: *a = sinh(x); break;
    case AC_TANH: *a = 1 - r * r; break;
    case AC_ASINH: *a = 1 / sqrt(1 + x * x); break;
    case AC_ACOSH: *a = 1 / sqrt(x * x - 1); break;
    case AC_ATANH: *a = 1 / (1 - x * x); break;
    case AC_FABS: *a = x < 0 ? -1 : x > 0 ? 1 : 0; break;
    case AC_FMOD: *a = 1, *b = -trunc(x / y); break;
    case AC_REMAINDER: *a = 1, *b = (r - x) / y; break;
    case AC_COPYSIGN: *a = (x < 0) == (r < 0) ? 1 : -1; break;
    case AC_FMIN: *a = !(y < x || isnan(x)), *b = 1 - *a; break;
    case AC_FMAX: *a = !(y > x || isnan(x)), *b = 1 - *a; break;
    case AC_HYPOT: *a = r > 0 ? x / r : 0, *b = r > 0 ? y / r : 0; break;
    case AC_LOG1P: *a = 1 / (1 + x); break;
    case AC_EXPM1: *a = 1 + r; break;
    case AC_ERF: *a = TWO_OVER_ROOT_PI * exp(-x * x); break;
    case AC_IF: *b = x != 0; break;
    case AC_ASSIGN: *a = 1; break;
    default: break; /* steps */
    }
}

/* What an operand adds: one that does not move adds nothing, whatever its factor is. */
static double part(double slope, double change) { return change != 0 ? slope * change : 0; }

/* Changes of all results, dw, from those of constants and inputs at its front. */
void ac_sweep_forward(const ac_tape *t, const double *w, double *dw) {
    const int32_t own = t->constants + t->inputs;
    for (int32_t k = 0, done = 0; k < t->runs; k++) {
        for (const int32_t end = done + t->length[k]; done < end; done++) {
            const int32_t x = t->first[done], y = t->second[done];
            double a, b;
            slopes(t->kind[k], w[x], w[y], w[own + done], &a, &b);
            dw[own + done] = part(a, dw[x]) + part(b, dw[y]);
        }
    }
}

/* What the weights in dw, those of results, come to for constants and inputs; those of results are used up. */
void ac_sweep_backward(const ac_tape *t, const double *w, double *dw) {
    const int32_t own = t->constants + t->inputs;
    int32_t done = t->results;
    for (int32_t k = t->runs - 1; k >= 0; k--) {
        for (const int32_t begin = done - t->length[k]; done > begin;) {
            const int32_t x = t->first[--done], y = t->second[done];
            const double weight = dw[own + done];
            double a, b;
            if (weight == 0) continue;
            slopes(t->kind[k], w[x], w[y], w[own + done], &a, &b);
            dw[own + done] = 0;
            dw[x] += part(a, weight);
            dw[y] += part(b, weight);
        }
    }
}
