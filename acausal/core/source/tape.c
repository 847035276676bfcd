/* Evaluate lists of scalar operations. */
#include "core.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

#define EACH(value)                          \
    for (int32_t k = 0; k < n; k++) {        \
        const double x = w[a[k]];            \
        r[k] = (value);                      \
    }                                        \
    break
#define PAIRS(value)                         \
    for (int32_t k = 0; k < n; k++) {        \
        const double x = w[a[k]], y = w[b[k]]; \
        r[k] = (value);                      \
    }                                        \
    break

/* Results of a run never lie where its arguments do not stand before them: in order, one after the other. */
static void run(const ac_tape *t, int32_t kind, int32_t n, const double *w, const int32_t *a, const int32_t *b, double *r) {
    switch (kind) {
    case AC_ADD: PAIRS(x + y);
    case AC_SUB: PAIRS(x - y);
    case AC_MUL: PAIRS(x * y);
    case AC_DIV: PAIRS(x / y);
    case AC_NEG: EACH(-x);
    case AC_SQ: EACH(x * x);
    case AC_TWICE: EACH(2 * x);
    case AC_INV: EACH(1 / x);
    case AC_SQRT: EACH(sqrt(x));
    case AC_SIN: EACH(sin(x));
    case AC_COS: EACH(cos(x));
    case AC_TAN: EACH(tan(x));
    case AC_ASIN: EACH(asin(x));
    case AC_ACOS: EACH(acos(x));
    case AC_ATAN: EACH(atan(x));
    case AC_ATAN2: PAIRS(atan2(x, y));
    case AC_EXP: EACH(exp(x));
    case AC_LOG: EACH(log(x));
    case AC_POW: PAIRS(pow(x, y));
    case AC_SINH: EACH(sinh(x));
    case AC_COSH: EACH(cosh(x));
    case AC_TANH: EACH(tanh(x));
    case AC_ASINH: EACH(asinh(x));
    case AC_ACOSH: EACH(acosh(x));
    case AC_ATANH: EACH(atanh(x));
    case AC_FABS: EACH(fabs(x));
    case AC_SIGN: EACH(x < 0 ? -1 : x > 0 ? 1 : x);
    case AC_FLOOR: EACH(floor(x));
    case AC_CEIL: EACH(ceil(x));
    case AC_FMOD: PAIRS(fmod(x, y));
    case AC_REMAINDER: PAIRS(remainder(x, y));
    case AC_COPYSIGN: PAIRS(copysign(x, y));
    case AC_FMIN: PAIRS(y < x || isnan(x) ? y : x); /* as to zeros, fmin differs between machines */
    case AC_FMAX: PAIRS(y > x || isnan(x) ? y : x);
    case AC_HYPOT: PAIRS(hypot(x, y));
    case AC_LOG1P: EACH(log1p(x));
    case AC_EXPM1: EACH(expm1(x));
    case AC_ERF: EACH(erf(x));
    case AC_LT: PAIRS(x < y);
    case AC_LE: PAIRS(x <= y);
    case AC_EQ: PAIRS(x == y);
    case AC_NE: PAIRS(x != y);
    case AC_NOT: EACH(!(x != 0));
    case AC_AND: PAIRS(x != 0 && y != 0);
    case AC_OR: PAIRS(x != 0 || y != 0);
    case AC_IF: PAIRS(x != 0 ? y : 0);
    case AC_ASSIGN: EACH(x);
    case AC_FIND: PAIRS(ac_find(t->tables, x, y, r[k])); /* from where it was in the evaluation before */
    case AC_LOAD: PAIRS(ac_load(t->tables, x, y));
    case AC_PUT: EACH(x); /* the other argument is the link before */
    case AC_VALUE:
        for (int32_t k = 0; k < n; k++) r[k] = ac_external_value(t, w, a[k], w[b[k]]);
        break;
    default: break;
    }
}

size_t ac_tape_length(const ac_tape *t) { return (size_t)t->constants + (size_t)t->inputs + (size_t)t->results + 1; }

/* Evaluate the runs from one to another; constants and inputs stand in w. */
void ac_tape_run(const ac_tape *t, double *w, int32_t from, int32_t to) {
    int32_t done = 0;
    for (int32_t k = 0; k < from; k++) done += t->length[k];
    for (int32_t k = from; k < to; k++) {
        const int32_t n = t->length[k];
        run(t, t->kind[k], n, w, t->first + done, t->second + done, w + t->constants + t->inputs + done);
        done += n;
    }
}

/* Evaluate at many places: the inputs of row i are part[j] + i stride[j], size[j] numbers each; a stride of 0 keeps them. */
void ac_tape_rows(const ac_tape *t, double *w, int32_t rows, int32_t parts, const int32_t *size, const int32_t *stride,
                  const double *const *part, double *found) {
    memcpy(w, t->constant, (size_t)t->constants * sizeof *w);
    for (int32_t i = 0; i < rows; i++) {
        double *input = w + t->constants;
        for (int32_t j = 0; j < parts; j++) {
            if (size[j] && (!i || stride[j])) memcpy(input, part[j] + (ptrdiff_t)i * stride[j], (size_t)size[j] * sizeof *w);
            input += size[j];
        }
        ac_tape_run(t, w, 0, t->runs);
        for (int32_t k = 0; k < t->outputs; k++) *found++ = w[t->output[k]];
    }
}
