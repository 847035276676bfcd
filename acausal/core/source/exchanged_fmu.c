/* An FMU for Model Exchange of another tool, as a function of an event mode, time, states, inputs and parameters. Its values are the
   derivatives of the states, outputs, event indicators, and whether it asks for an event; behind them stand their derivatives, column by column. */
#include "core.h"

#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <string.h>

#define ALIKE DBL_MAX /* an argument that does not matter */
#define OK 1          /* of a status: fmi2Warning and fmi3Warning */

enum { DERIVATIVES = 1, OUTPUTS = 2, INDICATORS = 4, ALL = 7 };

typedef void any(void); /* of version 2 or 3 */
typedef int set_time(void *, double);
typedef int numbers(void *, double *, size_t);
typedef int completed2(void *, int, int *, int *);
typedef int completed3(void *, bool, bool *, bool *);
typedef int reals2(void *, const uint32_t *, size_t, double *);
typedef int reals3(void *, const uint32_t *, size_t, double *, size_t);
typedef int directional2(void *, const uint32_t *, size_t, const uint32_t *, size_t, const double *, double *);
typedef int directional3(void *, const uint32_t *, size_t, const uint32_t *, size_t, const double *, size_t, double *, size_t);

typedef struct {
    ac_external function;
    int32_t version, states, inputs, outputs, indicators;
    int32_t completes, wanted;     /* whether it is told of accepted steps, and has asked for an event */
    int32_t ready, set, known;     /* whether it is in the event mode, at the arguments, and which values are those */
    int32_t (*prepare)(void);      /* bring it into the event mode, with the parameters; 0 where that fails */
    void *instance;
    set_time *set_time;
    numbers *set_states, *get_derivatives, *get_indicators;
    any *set_real, *get_real, *completed, *directional; /* the last NULL where there is none */
    const uint32_t *known_ref;     /* (states + inputs) */
    const uint32_t *unknown_ref;   /* (states + outputs) derivatives and outputs */
    const double *nominal;         /* (states + inputs) */
    double *now, *values, *slopes; /* (arguments), (values), (1 + states + inputs, values) */
    double *before;                /* (values) work */
    int32_t *known_slope;          /* (1 + states + inputs) */
} ac_fmu;

static int32_t values_of(const ac_fmu *f) { return f->states + f->outputs + f->indicators + f->completes; }

static int real(const ac_fmu *f, any *function, const uint32_t *reference, int32_t n, double *value) {
    if (!n) return 1;
    if (f->version == 2) return ((reals2 *)function)(f->instance, reference, (size_t)n, value) <= OK;
    return ((reals3 *)function)(f->instance, reference, (size_t)n, value, (size_t)n) <= OK;
}

/* Set one of the arguments by which it is differentiated: time, a state, an input. */
static int put(ac_fmu *f, int32_t column) {
    if (!column) return f->set_time(f->instance, f->now[1]) <= OK;
    if (column <= f->states) return f->set_states(f->instance, f->now + 2, (size_t)f->states) <= OK;
    return real(f, f->set_real, f->known_ref + column - 1, 1, f->now + 1 + column);
}

/* Get values of some kinds. */
static int get(ac_fmu *f, int32_t kinds, double *to) {
    const size_t nx = (size_t)f->states, nz = (size_t)f->indicators;
    if (f->completes) to[values_of(f) - 1] = 0; /* changes with no argument */
    if ((kinds & DERIVATIVES) && nx && f->get_derivatives(f->instance, to, nx) > OK) return 0;
    if ((kinds & OUTPUTS) && !real(f, f->get_real, f->unknown_ref + nx, f->outputs, to + nx)) return 0;
    return !(kinds & INDICATORS) || !nz || f->get_indicators(f->instance, to + nx + f->outputs, nz) <= OK;
}

/* Know the kind of a value: outputs that depend on fewer arguments than others are asked for before these are known. */
static int know(ac_fmu *f, int32_t number) {
    if (f->completes && number == values_of(f) - 1) return f->values[number] = f->wanted, 1;
    const int32_t kind = number < f->states ? DERIVATIVES : number < f->states + f->outputs ? OUTPUTS : INDICATORS;
    if (!(f->known & kind) && !get(f, kind, f->values)) return 0;
    f->known |= kind;
    return 1;
}

/* Bring it to the arguments. */
static int stand(ac_fmu *f) {
    const int32_t own = 2 + f->states + f->inputs, all = f->function.arguments;
    double *given = f->function.argument;
    int same = f->ready, moved;
    for (int32_t k = 0; k < all; k++) {
        if (given[k] == ALIKE) given[k] = f->now[k];
        if (isnan(given[k])) return 0;
    }
    same &= given[0] == f->now[0] && !memcmp(given + own, f->now + own, (size_t)(all - own) * sizeof *given);
    if (!same) {
        f->set = 0;
        if (!(f->ready = f->prepare())) return 0;
    }
    moved = !f->set || memcmp(given + 1, f->now + 1, (size_t)(own - 1) * sizeof *given);
    memcpy(f->now, given, (size_t)all * sizeof *given);
    if (!moved) return 1;
    f->known = f->set = 0;
    memset(f->known_slope, 0, (size_t)(own - 1) * sizeof *f->known_slope);
    if (!put(f, 0) || (f->states && !put(f, 1))) return 0;
    if (!real(f, f->set_real, f->known_ref + f->states, f->inputs, f->now + 2 + f->states)) return 0;
    return f->set = 1;
}

/* Derivatives by differences: central ones, by time forward as no earlier time need be allowed. */
static int difference(ac_fmu *f, int32_t column, double *slope) {
    const int32_t m = values_of(f);
    double *now = f->now + 1 + column, at = *now, to[2];
    const double size = fmax(fabs(at), column ? f->nominal[column - 1] : 1), h = (column ? cbrt(DBL_EPSILON) : sqrt(DBL_EPSILON)) * size;
    to[0] = column ? at - h : at, to[1] = at + h;
    *now = to[0];
    int good = put(f, column) && get(f, ALL, f->before);
    *now = to[1];
    good = good && put(f, column) && get(f, ALL, slope);
    for (int32_t k = 0; k < m; k++) slope[k] = (slope[k] - f->before[k]) / (to[1] - to[0]);
    *now = at;
    return put(f, column) && good;
}

static int direct(ac_fmu *f, int32_t column, double *slope) {
    const double one = 1;
    const size_t n = (size_t)(f->states + f->outputs);
    const uint32_t *by = f->known_ref + column - 1;
    if (f->version == 2) return ((directional2 *)f->directional)(f->instance, f->unknown_ref, n, by, 1, &one, slope) <= OK;
    return ((directional3 *)f->directional)(f->instance, f->unknown_ref, n, by, 1, &one, 1, slope, n) <= OK;
}

static int differentiate(ac_fmu *f, int32_t column) {
    double *slope = f->slopes + (size_t)column * (size_t)values_of(f);
    if (f->known_slope[column]) return 1;
    if ((!column || !f->directional || f->indicators) && !difference(f, column, slope)) return 0;
    if (column && f->directional && f->states + f->outputs && !direct(f, column, slope)) return 0;
    return f->known_slope[column] = 1;
}

AC_PUBLIC double ac_fmu_value(ac_external *function, int32_t number) {
    ac_fmu *f = (ac_fmu *)function;
    const int32_t m = values_of(f);
    if (!stand(f)) return NAN;
    if (!m) return 0;
    const int32_t column = number / m - 2;
    if (number < m) return know(f, number) ? f->values[number] : NAN;
    if (column < 0 || column > f->states + f->inputs) return 0; /* event mode and parameters are no variables */
    return differentiate(f, column) ? f->slopes[(size_t)column * (size_t)m + (size_t)(number % m)] : NAN;
}

/* Tell it that the step to its arguments is accepted; return whether it asks for an event, which the last value tells from then on. */
AC_PUBLIC int32_t ac_fmu_completed(ac_external *function, int32_t part) {
    (void)part;
    ac_fmu *f = (ac_fmu *)function;
    if (f->version == 2) {
        int event = 0, end = 0;
        if (((completed2 *)f->completed)(f->instance, 1, &event, &end) > OK) f->ready = 0;
        f->wanted = event || end;
    } else {
        bool event = 0, end = 0;
        if (((completed3 *)f->completed)(f->instance, 1, &event, &end) > OK) f->ready = 0;
        f->wanted = event || end;
    }
    f->known = 0;
    return f->wanted;
}
