/* Closed loops cross a singular configuration by extrapolation. There the constraints are not independent and two motions lead on;
   accelerations, which the constraints then leave open, spoil every step that comes near, so that steps shrink with the distance. The
   motion itself is smooth: the polynomial through states and rates of earlier steps leads to the other side, where the loops are closed
   by small changes. */
#include "hybrid.h"

#include <float.h>
#include <math.h>
#include <string.h>

#define CLOSE 0.02   /* smallest singular value of the constraints over their sizes: farther away none is looked for */
#define PARTS 3      /* of a step: points that are kept of it */
#define SPANS 4      /* of the crossing, from one point back to the next */
#define NODES (2 * AC_POINTS)
#define LOWER (NODES - 2) /* nodes of the polynomial that tells the error */
#define ERRS 10      /* tolerances by which that may be off: the polynomial that is taken is two orders better */
#define MOVES 30     /* tolerances by which closing may move a state, which divides errors by that value: of n-four-bar at 1e-4 17 */
#define VANISHES 0.1 /* of that singular value, at the place where it should be 0: else loops pass beside the configuration */

#define SURELY 2     /* times its change in a step: a larger value does not vanish within it */
#define WINDOW 32    /* steps, refused ones too: where they bring less than this part of the most that so many ... */
#define CREEPS 1e-3  /* ... brought loops forward, and more than this part of them is refused, twice in a row, ... */
#define OFTEN 0.15   /* ... unknowns grow without end: of n-four-bar at 1e-7, 19 to 48 % are */
#define ROUNDINGS 1000 /* of the time: a step that passes a singular configuration is not shortened further */

static size_t length_of(const ac_instance *i) { return 1 + (size_t)ac_states(i) + (size_t)i->of->parts.model.equations.nz; }

static double *past(const ac_instance *i, int32_t k) { return i->past + (size_t)k * length_of(i); }

/* Keep some points of the last step, its end among them; of a crossing that alone. */
static void keep_points(ac_instance *i) {
    const ac_equations *e = &i->of->parts.model.equations;
    const int32_t parts = i->now.crosses ? 1 : PARTS;
    const size_t length = length_of(i);
    memmove(i->past + (size_t)parts * length, i->past, (size_t)(AC_PAST - parts) * length * sizeof *i->past);
    for (int32_t k = 0; k < parts; k++) {
        double *to = past(i, k);
        ac_stand(i, i->now.to - k * (i->now.to - i->now.from) / parts);
        *to = i->now.time;
        ac_put(to + 1, i->x, e->nx), ac_put(to + 1 + e->nx, i->z, e->nz);
    }
    i->now.pasts = i->now.pasts + parts < AC_PAST ? i->now.pasts + parts : AC_PAST;
}

/* Newton's polynomial through values and rates of a state at some points; returns by how much it differs from that through one point less. */
static double extrapolated(const double *const point[AC_POINTS], const double *rate, int32_t k, int32_t nx, double time, double *found) {
    double table[NODES], change = 0, product = 1;
    for (int n = 0; n < NODES; n++) table[n] = point[n / 2][1 + k];
    for (int order = 1; order < NODES; order++) {
        for (int n = NODES - 1; n >= order; n--) {
            const double span = *point[n / 2] - *point[(n - order) / 2];
            table[n] = span == 0 ? rate[n / 2 * nx + k] : (table[n] - table[n - 1]) / span;
        }
    }
    *found = 0;
    for (int n = 0; n < NODES; n++) {
        *found += product * table[n];
        if (n >= LOWER) change += product * table[n];
        product *= time - *point[n / 2];
    }
    return change;
}

static double size_of(const ac_instance *i, int32_t k, double value) {
    return (i->now.damping > 0 ? i->of->damped : i->of->parts.model.size)[k] + fabs(value);
}

/* Points so far apart, and the rates there. */
static int32_t choose(ac_instance *i, double span, const double *point[AC_POINTS]) {
    const ac_equations *e = &i->of->parts.model.equations;
    int32_t failed = AC_OK;
    for (int32_t k = 0, from = 0; k < AC_POINTS; k++, from++) {
        while (from < i->now.pasts && *past(i, 0) - *past(i, from) < k * span) from++;
        if (from >= i->now.pasts) return AC_RETRY;
        point[k] = past(i, from);
    }
    for (int32_t k = 0; k < AC_POINTS && !failed; k++) {
        ac_put(i->x, point[k] + 1, e->nx), ac_put(i->z, point[k] + 1 + e->nx, e->nz);
        i->now.time = *point[k];
        ac_moved(i);
        failed = ac_know(i, AC_RATE);
        if (!failed) ac_put(i->past_rate + k * e->nx, i->rate, e->nx);
    }
    ac_put(i->z, point[0] + 1 + e->nx, e->nz);
    return failed;
}

/* Stand at a time on the polynomial through these points; return whether it is exact enough. */
static int stand(ac_instance *i, const double *const point[AC_POINTS], double time) {
    const int32_t nx = ac_states(i);
    i->now.time = time;
    ac_moved(i);
    for (int32_t k = 0; k < nx; k++) {
        const double error = extrapolated(point, i->past_rate, k, nx, time, &i->x[k]);
        if (!(fabs(error) <= ERRS * i->now.tolerance * size_of(i, k, i->x[k]))) return 0;
    }
    return 1;
}

/* Stand on the other side, if the polynomial leads there and loops close by little. */
static int32_t stand_beyond(ac_instance *i, double way, double least) {
    const int32_t nx = ac_states(i);
    const double now = *past(i, 0), *point[AC_POINTS];
    double *to = i->order;
    if (choose(i, SPANS * 2 * way, point) || !stand(i, point, now + way) || !(ac_sharpness(i) <= least)) return AC_RETRY;
    if (!stand(i, point, now + 2 * way)) return AC_RETRY;
    ac_put(to, i->x, nx);
    if (ac_close_all(i)) return AC_RETRY;
    for (int32_t k = 0; k < nx; k++) {
        if (!(fabs(i->x[k] - to[k]) <= MOVES * i->now.tolerance * size_of(i, k, to[k]))) return AC_RETRY;
    }
    return ac_know(i, AC_RATE);
}

/* Let the crossing be the last step: states on Hermite's cubic, algebraic unknowns on a straight line. */
static void put_step(ac_instance *i, const double *rate) {
    const ac_equations *e = &i->of->parts.model.equations;
    const int32_t nx = e->nx, n = nx + e->nz;
    const double h = i->now.time - i->now.to;
    ac_put(i->before, i->after, n), ac_put(i->after, i->x, nx), ac_put(i->after + nx, i->z, e->nz);
    memset(i->dense, 0, 3 * (size_t)n * sizeof *i->dense);
    for (int32_t k = 0; k < nx; k++) {
        const double step = i->after[k] - i->before[k];
        i->dense[k] = h * rate[k] - step, i->dense[n + k] = 2 * step - h * (rate[k] + i->rate[k]);
    }
    i->now.from = i->now.to, i->now.to = i->now.time, i->now.last = h;
    i->now.curved = 1, i->now.integrates = 0, i->now.crosses = 1, i->now.event = INFINITY;
}

/* Extrapolate across a singular configuration just beyond the last step; return whether it was crossed, which is then the last step. */
int ac_cross(ac_instance *i) {
    const double time = i->now.time, here = i->now.sharp, there = i->now.sharp_before;
    if (!i->of->levels || i->now.pasts < AC_POINTS || i->now.crosses || !(here < CLOSE && there > here)) return 0;
    const double way = here / (there - here) * (i->now.to - i->now.from);
    const int crosses = time + 2 * way < i->now.end && !stand_beyond(i, way, VANISHES * here);
    if (crosses) {
        i->now.sharp_before = here, i->now.sharp = ac_sharpness(i);
        put_step(i, i->past_rate);
        keep_points(i);
    }
    ac_stand(i, time);
    return crosses;
}

/* Whether steps bring closed loops hardly forward, and many of them are refused. */
int ac_creeps(ac_instance *i, const ac_progress *done) {
    ac_window *w = &i->window;
    const double steps = (double)(done->steps - w->steps), refused = (double)(done->refused - w->refused);
    if (!i->of->levels || steps + refused < WINDOW) return 0;
    const double forward = i->now.to - w->time;
    w->farthest = fmax(w->farthest, forward);
    const int slow = forward < CREEPS * w->farthest && refused > OFTEN * (steps + refused);
    w->steps = done->steps, w->refused = done->refused, w->time = i->now.to, w->slow = slow ? w->slow + 1 : 0;
    return w->slow > 1;
}

static void part_of_step(ac_instance *i, double s) { ac_stand(i, i->now.from + s * (i->now.to - i->now.from)); }

/* Find out whether the last step passed a singular configuration of closed loops, and how far before that a shorter one ends. It is
   looked for where the least singular value is small against its changes in this step and, at the same pace, in the one before. */
int32_t ac_meet_flat(ac_instance *i, double *shorter) {
    const double h = i->now.to - i->now.from;
    *shorter = 0;
    if (!i->of->levels || i->stepper->method->iterates || !(h > 0)) return AC_OK;
    double ends[2] = {i->now.sharp, 0}, where, pace = i->now.sharp_pace;
    if (!i->now.looked) part_of_step(i, 0), ends[0] = ac_sharpness(i), pace = 0;
    part_of_step(i, 1);
    ends[1] = ac_sharpness(i);
    const double change = fmax(fabs(ends[1] - ends[0]), pace * h);
    if (fmin(ends[0], ends[1]) > SURELY * change + CLOSE || !ac_flat(i, part_of_step, ends, &where)) {
        i->now.sharp_before = ends[0], i->now.sharp = ends[1], i->now.sharp_pace = fabs(ends[1] - ends[0]) / h;
        keep_points(i);
        return AC_OK;
    }
    *shorter = where / 2 * h;
    return *shorter > ROUNDINGS * DBL_EPSILON * fabs(i->now.time) ? AC_OK : ac_refuse(i, AC_SINGULAR, AC_FLAT_TEXT);
}
