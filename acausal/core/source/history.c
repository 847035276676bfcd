/* The past of a signal, as a function of the number of a run, a piece, time, the signal at the start, the signal, and a delay. Its values
   are the delayed signal, the time at which the piece ends, and the signal itself; behind them stand their derivatives by time and by
   both signals. A piece ends where the signal jumps; before the first one it has its value at the start. */
#include "core.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define POINTS 5        /* of the polynomial through the past, which has the order of the dense output of a step and more */
#define STEADY 1e-8     /* of the largest value: a smaller change at an event is no jump, but an error of the solver */
#define SLACK 1e3       /* rounding errors of the time by which a step may look beyond the last point */
#define NEVER 1e300     /* end of the last piece: finite, as a condition compares it */

enum { RUN, PIECE, TIME, START, SIGNAL, DELAY, ARGUMENTS };
enum { DELAYED, END, SAME, VALUES };

/* Points of a run, with the first point of the step of each, and the first one of each piece. */
typedef struct {
    int32_t points, room, pieces, most;
    double *time, *value, largest;
    int32_t *step, *first;
} past;

typedef struct {
    ac_external function;
    double argument[ARGUMENTS], time, signal; /* the last ones at which the signal was asked for */
    past *run;
    int32_t runs;
} history;

static int add(past *p, double time, double value, int32_t step, int begins) {
    if (p->points == p->room) {
        const int32_t room = 2 * p->room + 64;
        double *times = realloc(p->time, (size_t)room * sizeof *times);
        if (times) p->time = times;
        double *values = realloc(p->value, (size_t)room * sizeof *values);
        if (values) p->value = values;
        int32_t *steps = realloc(p->step, (size_t)room * sizeof *steps);
        if (steps) p->step = steps;
        if (!times || !values || !steps) return 0;
        p->room = room;
    }
    if (begins && p->pieces == p->most) {
        const int32_t most = 2 * p->most + 8;
        int32_t *first = realloc(p->first, (size_t)most * sizeof *first);
        if (!first) return 0;
        p->first = first, p->most = most;
    }
    if (begins) p->first[p->pieces++] = p->points;
    p->step[p->points] = step, p->time[p->points] = time, p->value[p->points++] = value;
    p->largest = fmax(p->largest, fabs(value));
    return 1;
}

/* Forget what is not before a time: a run may go back. */
static void forget(past *p, double time) {
    while (p->points > 1 && p->time[p->points - 1] > time) p->points--;
    while (p->pieces > 1 && p->first[p->pieces - 1] >= p->points) p->pieces--;
}

/* Value at a time, or derivative there, of the polynomial through the points of its step: steps end where the signal has kinks. */
static double interpolated(const past *p, int32_t piece, double time, int slope) {
    const int32_t begin = p->first[piece], end = piece + 1 < p->pieces ? p->first[piece + 1] : p->points;
    int32_t low = begin, high = end;
    while (high - low > 1) {
        const int32_t middle = low + (high - low) / 2;
        if (p->time[middle] <= time) low = middle;
        else high = middle;
    }
    const int32_t from = p->step[low + 1 < end ? low + 1 : low];
    int32_t n = 1;
    while (n < POINTS && from + n < end && p->step[from + n] == from) n++;
    const double *t = p->time + from;
    double c[POINTS], value, rate = 0;
    memcpy(c, p->value + from, (size_t)n * sizeof *c);
    for (int32_t order = 1; order < n; order++) {
        for (int32_t k = n - 1; k >= order; k--) c[k] = (c[k] - c[k - 1]) / (t[k] - t[k - order]);
    }
    value = c[n - 1];
    for (int32_t k = n - 2; k >= 0; k--) rate = rate * (time - t[k]) + value, value = value * (time - t[k]) + c[k];
    return slope ? rate : value;
}

static const past *past_of(const history *h) {
    const double run = h->argument[RUN];
    return run >= 0 && run < h->runs ? &h->run[(int32_t)run] : NULL;
}

static double delayed(const history *h, int slope) {
    const past *p = past_of(h);
    const double *a = h->argument, time = a[TIME] - a[DELAY], piece = a[PIECE];
    if (!p || (time < p->time[0] && !(piece > 0))) return slope ? 0 : a[START];
    if (isnan(time) || !(piece >= 0 && piece < p->pieces)) return NAN;
    const double last = p->time[p->points - 1];
    return time > last + SLACK * DBL_EPSILON * (fabs(a[TIME]) + a[DELAY]) ? NAN : interpolated(p, (int32_t)piece, time, slope);
}

static double value(ac_external *function, int32_t number) {
    history *h = (history *)function;
    const past *p = past_of(h);
    const int32_t column = number / VALUES - 1, piece = (int32_t)h->argument[PIECE] + 1;
    switch (number % VALUES) {
    case DELAYED:
        if (column < 0 || column == TIME) return delayed(h, column == TIME);
        return column == START && (!p || h->argument[TIME] - h->argument[DELAY] < p->time[0]);
    case END:
        return column >= 0 ? 0 : p && piece < p->pieces ? p->time[p->first[piece]] + h->argument[DELAY] : NEVER;
    default:
        if (column < 0) h->time = h->argument[TIME], h->signal = h->argument[SIGNAL];
        return column < 0 ? h->argument[SIGNAL] : column == SIGNAL;
    }
}

/* Take a point at the end of a part of a step; at an event the signal may jump there. It never asks for an event itself. */
static int32_t completed(ac_external *function, int32_t part) {
    history *h = (history *)function;
    past *p = (past *)past_of(h);
    const double time = h->time, now = h->signal;
    if (!p || !isfinite(now)) return 0;
    forget(p, time);
    const double last = p->time[p->points - 1];
    const int jumps = time <= last && fabs(now - p->value[p->points - 1]) > STEADY * fmax(p->largest, fabs(now));
    if (time > last || jumps) (void)add(p, time, now, part > 1 ? p->step[p->points - 1] : part ? p->points - 1 : p->points, jumps); /* without memory the next step has no value */
    return 0;
}

/* A history of no run; NULL without memory. */
AC_PUBLIC ac_external *ac_history_make(void) {
    history *h = calloc(1, sizeof *h);
    if (!h) return NULL;
    h->function = (ac_external){.count = AC_EXTERNAL, .arguments = ARGUMENTS, .argument = h->argument, .value = value, .completed = completed};
    h->function.parts = POINTS - 1;
    return &h->function;
}

/* Begin a run at a time, with the signal there; return its number, -1 without memory. */
AC_PUBLIC int32_t ac_history_begin(ac_external *function, double time, double signal) {
    history *h = (history *)function;
    past *runs = realloc(h->run, ((size_t)h->runs + 1) * sizeof *runs);
    if (!runs) return -1;
    h->run = runs;
    runs[h->runs] = (past){0};
    if (!add(&runs[h->runs], time, signal, 0, 1)) return -1;
    return h->runs++;
}

AC_PUBLIC void ac_history_free(ac_external *function) {
    history *h = (history *)function;
    for (int32_t k = 0; h && k < h->runs; k++) free(h->run[k].time), free(h->run[k].value), free(h->run[k].step), free(h->run[k].first);
    if (h) free(h->run);
    free(h);
}
