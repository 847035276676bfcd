/* Locate the first event of a step: event indicators are sampled on the dense output, bracketed where they may change sign, and
   the bracket is narrowed by cubics (Hermite). Values count as positive while nothing changes. */
#include "hybrid.h"

#include <float.h>
#include <math.h>
#include <string.h>

#define SAMPLES 4      /* of a step, beside its start */
#define GOLDEN 0.6180339887498949 /* spreads samples so that no periodic motion stays in step with them */
#define LEVEL 0.01     /* of the tolerance band of an indicator: one that was not as far above 0 has changed where it falls by more */
#define REACH 3.0      /* an indicator may cross what it could at so many times its rate at the ends of an interval */
#define ERROR 3.0      /* error of a cubic, over its estimate */
#define STRAIGHT 1e-8  /* of an interval: in so short a part motions are straight lines to rounding, as their bend is the square of it */
#define ROUNDINGS 4    /* of a time, between which no time is looked for */
#define TRIES 80       /* to narrow a bracket */
#define BESIDE (1. / 3) /* of the shortest interval: how far beside a predicted time the next one is, so that both sides are known, */
#define ASIDE 0.1      /* of the bracket, at most */
#define FURTHER 64.0   /* a point that is not beyond the event by its rounding error is followed by one so many times as far */
#define DEPTH (AC_SLOTS - AC_FIRST_SAMPLES - 4) /* halvings of a sampled interval */
#define MOST 4000      /* samples of a step between those */

/* A sampled time: value, rate and level of each indicator, the level below which it has changed. */
typedef struct {
    double time, *value, *rate, *level;
} sample;

static sample slot(const ac_instance *i, int k) {
    const int32_t m = i->of->watched;
    double *at = i->sampled + (ptrdiff_t)k * 3 * m;
    return (sample){0, at, at + m, at + 2 * m};
}

static void copy(const ac_instance *i, sample *to, const sample *from) {
    to->time = from->time;
    ac_put(to->value, from->value, 3 * i->of->watched);
}

/* Take row r of what was sampled, given what was known at the sample before it. A condition without a value that does not matter stays. */
static int take(ac_instance *i, int32_t r, const sample *before, sample *to) {
    const int32_t m = i->of->watched;
    double *found = i->samples.found + (ptrdiff_t)r * 2 * m;
    to->time = i->samples.time[r];
    for (int32_t k = 0; k < m; k++) {
        const double side = i->truth[k] > 0 ? -1 : 1;
        if (isnan(found[k])) {
            if (ac_matters(i, r, k)) return 0;
            found[k] = side * (1 + LEVEL) * i->width[k], found[m + k] = 0;
        }
        to->value[k] = side * found[k];
        to->rate[k] = isfinite(found[m + k]) ? side * found[m + k] : 0;
        to->level[k] = to->value[k] > LEVEL * i->width[k] || (before && before->level[k] == 0) ? 0 : i->least[k];
    }
    return 1;
}

static int32_t undefined(ac_instance *i, int32_t r) {
    const int32_t nx = ac_states(i), nz = i->of->parts.model.equations.nz;
    ac_put(i->event_y, i->samples.x + (ptrdiff_t)r * nx, nx), ac_put(i->event_y + nx, i->samples.z + (ptrdiff_t)r * nz, nz);
    i->now.time = i->now.undefined = i->samples.time[r];
    i->why = AC_UNDEFINED;
    return ac_fail(i, AC_RETRY, "a condition has no value.");
}

/* Sample one time in the step. */
static int32_t sample_at(ac_instance *i, double time, const sample *before, sample *to) {
    i->samples.time[0] = time;
    ac_sample_step(i, 1);
    const int32_t failed = ac_sample_indicators(i, 1);
    if (failed) return failed;
    return take(i, 0, before, to) ? AC_OK : undefined(i, 0);
}

/* How far the value at m is from the cubic through values and rates at a and b; a quarter of it bounds the error between neighbours. */
static double off(const sample *a, const sample *m, const sample *b, int32_t k) {
    const double h = b->time - a->time, s = (m->time - a->time) / h, da = a->rate[k] * h, db = b->rate[k] * h;
    const double c3 = 2 * a->value[k] - 2 * b->value[k] + da + db, c2 = 3 * (b->value[k] - a->value[k]) - 2 * da - db;
    return fabs(((c3 * s + c2) * s + da) * s + a->value[k] - m->value[k]) / 4;
}

/* Whether an indicator surely stays above its levels between two samples, of which neither is below: a cubic lies in the hull of its
   values and the ends of the thirds of its tangents, a convex function above its tangents. */
static int stays(const ac_instance *i, const sample *a, const sample *b, int32_t k, double error, double range) {
    const double h = b->time - a->time, va = a->value[k] - a->level[k], vb = b->value[k] - b->level[k];
    const double da = h * a->rate[k], db = h * b->rate[k], travel = fmax(fabs(da), fabs(db)), width = i->width[k];
    if (fmin(va, vb) > REACH * travel) return 1;
    if (travel > fmax(range, width)) return 0;
    if (da < 0 && db > 0 && va * db - vb * da + da * db < 0) return 0;
    const double margin = fmin(fmin(va, vb), fmin(va + da / 3, vb - db / 3));
    return margin >= -width && (error <= width || margin >= ERROR * error);
}

/* Where the cubic through two samples falls to 0 from a positive value: Newton's iteration within a bracket. */
static double root(double h, double a, double b, double da, double db) {
    const double c3 = 2 * a - 2 * b + da + db, c2 = 3 * (b - a) - 2 * da - db;
    double low = 0, high = 1, s = 0.5, step = 1;
    if (b >= 0 || !(((c3 + c2) + da) + a < 0)) return h;
    while (fabs(step) > DBL_EPSILON) {
        const double here = ((c3 * s + c2) * s + da) * s + a, slope = (3 * c3 * s + 2 * c2) * s + da;
        if (here == 0) break;
        *(here > 0 ? &low : &high) = s;
        const double next = s - here / slope;
        if (fabs(2 * here) < fabs(step * slope) && low < next && next < high) step = next - s, s = next;
        else step = (high - low) / 2, s = low + step;
    }
    return h * s;
}

/* Where the first of the indicators that are below their levels at b has crossed them since a. */
static double predict(const ac_instance *i, const sample *a, const sample *b) {
    const double h = b->time - a->time;
    double first = h;
    for (int32_t k = 0; k < i->of->watched; k++) {
        if (!(b->value[k] < b->level[k])) continue;
        const double level = b->level[k];
        first = fmin(first, root(h, a->value[k] - level, b->value[k] - level, a->rate[k] * h, b->rate[k] * h));
    }
    return a->time + first;
}

static int crosses(const ac_instance *i, const sample *b) {
    for (int32_t k = 0; k < i->of->watched; k++) {
        if (b->value[k] < b->level[k]) return 1;
    }
    return 0;
}

/* The point at a share of the way from one time to another, which is as near as times can tell, and its indicators. */
static int32_t stand_between(ac_instance *i, double from, double to, double share, const sample *before, sample *found) {
    const int32_t n = ac_states(i) + i->of->parts.model.equations.nz, nx = ac_states(i);
    double *y = i->event_y, *x = i->samples.x, *z = i->samples.z;
    i->samples.time[0] = from, i->samples.time[1] = to;
    ac_sample_step(i, 2);
    for (int32_t k = 0; k < n; k++) {
        const double a = k < nx ? x[k] : z[k - nx], b = k < nx ? x[nx + k] : z[n - nx + k - nx];
        y[k] = a + share * (b - a);
    }
    i->samples.time[0] = from + share * (to - from);
    ac_put(x, y, nx), ac_put(z, y + nx, n - nx);
    const int32_t failed = ac_sample_indicators(i, 1);
    if (failed) return failed;
    ac_put(y + nx, z, n - nx);
    return take(i, 0, before, found) ? AC_OK : undefined(i, 0);
}

/* The event between two times that rounding hardly separates: on the straight line between them, the first point beyond a level. What
   a rounded time leaves of a speed would stay for ever where the new law holds the speed. */
static int32_t land(ac_instance *i, const sample *a, const sample *b, sample *found) {
    double share = 1, size = 0;
    for (int32_t k = 0; k < i->of->watched; k++) {
        if (!(b->value[k] < b->level[k])) continue;
        const double change = a->value[k] - b->value[k];
        share = fmin(share, (a->value[k] - b->level[k]) / change);
        size = fmax(size, i->width[k] / change / i->now.tolerance);
    }
    double errors = 1;
    for (int tries = 0; tries <= ROUNDINGS + 1; tries++) {
        const double s = tries > ROUNDINGS ? 1 : fmin(share + DBL_EPSILON * errors, 1);
        const int32_t failed = stand_between(i, a->time, b->time, s, a, found);
        if (failed || crosses(i, found)) return failed;
        errors = tries ? errors * FURTHER : fmax(size, 1);
    }
    return AC_OK;
}

/* Note the event: its time, which indicators changed, and for how long its time is uncertain by the tolerance, with the scales there. */
static void note(ac_instance *i, const sample *at) {
    const int32_t nx = ac_states(i), nz = i->of->parts.model.equations.nz;
    double delay = INFINITY;
    ac_put(i->x, i->event_y, nx), ac_put(i->z, i->event_y + nx, nz);
    i->now.time = at->time;
    ac_moved(i);
    ac_find_scales(i);
    i->now.weak++;
    for (int32_t k = 0; k < i->of->watched; k++) {
        i->crossing[k] = at->value[k] <= 0;
        if (!i->crossing[k]) continue;
        delay = fmin(delay, ac_width(i, k) / fmax(fabs(at->rate[k]), DBL_MIN));
        if (i->peak[k] > i->width[k]) i->now.weak = 0;
    }
    i->now.event = at->time, i->now.delay = delay;
}

/* Narrow an interval at whose end an indicator is below its level. */
static int32_t narrow(ac_instance *i, const sample *first, const sample *last) {
    sample a = slot(i, DEPTH), b = slot(i, DEPTH + 1), m = slot(i, DEPTH + 2);
    copy(i, &a, first), copy(i, &b, last);
    const double shortest = fmax(STRAIGHT * (b.time - a.time), ROUNDINGS * DBL_EPSILON * fabs(b.time));
    double predicted = b.time, widths[2] = {INFINITY, INFINITY};
    for (int tries = 0; tries < TRIES && b.time - a.time > shortest; tries++) {
        const double span = b.time - a.time, before = predicted;
        predicted = predict(i, &a, &b);
        const double aside = fmin(fmax(fabs(predicted - before), BESIDE * shortest), ASIDE * span);
        double time = predicted - a.time < b.time - predicted ? predicted + aside : predicted - aside;
        /* Halve it where two predictions have not. */
        if (span > 0.5 * widths[0] || !(a.time < time && time < b.time)) time = a.time + span / 2;
        widths[0] = widths[1], widths[1] = span;
        const int32_t failed = sample_at(i, time, &a, &m);
        if (failed) return failed;
        copy(i, crosses(i, &m) ? &b : &a, &m);
        if (a.time != m.time) continue;
        for (int32_t k = 0; k < i->of->watched; k++) i->peak[k] = fmax(i->peak[k], a.value[k]);
    }
    const int32_t failed = land(i, &a, &b, &m);
    if (!failed) note(i, &m);
    return failed;
}

/* Find the first event between two samples, with estimates of the errors of cubics between them. */
static int32_t seek(ac_instance *i, const sample *a, const sample *b, const double *error, const double *range, int depth, int *left) {
    const int32_t m = i->of->watched;
    int doubtful = 0;
    for (int32_t k = 0; k < m && !doubtful; k++) {
        /* What rises from below 0 and falls again between the samples changes where it comes back to 0. */
        const int returns = a->level[k] < 0 && a->rate[k] > 0;
        doubtful = b->value[k] < b->level[k] ? returns : !stays(i, a, b, k, error[k], range[k]);
    }
    if (doubtful && depth < DEPTH && b->time - a->time > ROUNDINGS * DBL_EPSILON * fabs(b->time) && (*left)-- > 0) {
        sample half = slot(i, depth);
        double *own = i->errors + (ptrdiff_t)depth * m;
        int32_t failed = sample_at(i, a->time + (b->time - a->time) / 2, a, &half);
        for (int32_t k = 0; k < m && !failed; k++) own[k] = off(a, &half, b, k);
        if (!failed) failed = seek(i, a, &half, own, range, depth + 1, left);
        if (failed || isfinite(i->now.event)) return failed;
        return seek(i, &half, b, own, range, depth + 1, left);
    }
    if (doubtful) i->now.hasty = 1;
    return crosses(i, b) ? narrow(i, a, b) : AC_OK;
}

/* Times of samples: uneven parts of the step. */
static int32_t spread(ac_instance *i, int32_t parts) {
    double sum = 0, all = 0;
    for (int32_t k = 0; k < parts; k++) all += 0.6 + 0.8 * fmod((i->now.taken + k) * GOLDEN, 1);
    for (int32_t k = 0; k < parts; k++) {
        sum += 0.6 + 0.8 * fmod((i->now.taken + k) * GOLDEN, 1);
        i->samples.time[k] = k + 1 < parts ? i->now.from + sum / all * (i->now.to - i->now.from) : i->now.to;
    }
    return parts;
}

/* Begin to look for events: widths of the tolerance bands, and the levels of what is not positive. */
static int32_t begin(ac_instance *i, sample *start) {
    const int32_t m = i->of->watched;
    ac_stand(i, i->now.from);
    ac_find_scales(i);
    for (int32_t k = 0; k < m; k++) i->width[k] = ac_width(i, k), i->least[k] = 0;
    const int32_t failed = sample_at(i, i->now.from, NULL, start);
    for (int32_t k = 0; k < m && !failed; k++) {
        i->least[k] = fmin(start->value[k], 0) - LEVEL * i->width[k];
        start->level[k] = start->value[k] > LEVEL * i->width[k] ? 0 : i->least[k];
        i->peak[k] = start->value[k];
    }
    return failed;
}

/* Locate the first event of the last step; none leaves `event` infinite. */
int32_t ac_locate(ac_instance *i) {
    const int32_t m = i->of->watched;
    if (!m || i->now.blind) return AC_OK;
    /* Samples of the step stand in order behind the slots of `seek` and `narrow`. */
    const int first = DEPTH + 3;
    sample at[AC_FIRST_SAMPLES + 1];
    at[0] = (sample){i->now.from, i->looks, i->looks + m, i->looks + 2 * m};
    int32_t failed = AC_OK, fresh = !i->now.looked;
    if (fresh) failed = begin(i, &at[0]);
    if (failed) return failed;
    /* Within a crossing the equations may have no unique solution. */
    const int32_t parts = spread(i, i->now.crosses ? 1 : fresh ? AC_FIRST_SAMPLES : SAMPLES);
    ac_sample_step(i, parts);
    failed = ac_sample_indicators(i, parts);
    double *range = i->errors + (ptrdiff_t)DEPTH * m, *error = range + m;
    ac_put(range, at[0].value, m), ac_put(error, at[0].value, m);
    for (int32_t r = 1; r <= parts && !failed; r++) {
        at[r] = slot(i, first + r);
        if (!take(i, r - 1, &at[r - 1], &at[r])) return undefined(i, r - 1);
        for (int32_t k = 0; k < m; k++) range[k] = fmax(range[k], at[r].value[k]), error[k] = fmin(error[k], at[r].value[k]);
    }
    for (int32_t k = 0; k < m; k++) range[k] -= error[k];
    int left = MOST;
    for (int32_t r = 1; r <= parts && !failed && !isfinite(i->now.event); r++) {
        for (int32_t k = 0; k < m; k++) {
            error[k] = fmax(r > 1 ? off(&at[r - 2], &at[r - 1], &at[r], k) : 0, r < parts ? off(&at[r - 1], &at[r], &at[r + 1], k) : 0);
        }
        if (!i->now.crosses) failed = seek(i, &at[r - 1], &at[r], error, range, 0, &left);
        else if (crosses(i, &at[r])) failed = narrow(i, &at[r - 1], &at[r]);
        for (int32_t k = 0; k < m && !isfinite(i->now.event); k++) i->peak[k] = fmax(i->peak[k], at[r].value[k]);
    }
    if (!failed) copy(i, &at[0], &at[parts]);
    return failed;
}
