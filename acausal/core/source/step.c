/* Co-Simulation: steps of the core's method, across communication points where there are no inputs; events within them. */
#include "instance.h"
#include "rodas.h"

#include <float.h>
#include <math.h>
#include <string.h>

#define LOOKS 4         /* parts of a step at whose ends conditions are looked at */
#define LEVEL 0.01      /* of the width: a condition has changed where it is beyond 0 by that */
#define HALVINGS 60     /* of the part in which an event lies, at most */
#define ROUNDINGS 2     /* of its time: within that it is known */
#define AHEAD 100       /* spans of a run: where no stop time is known */
#define RETURN 64       /* steps after which closed loops go back to their constraints, as `simulate` does */
#define CROWDED 1e-9    /* of a run: within that time ... */
#define MOST_CROWDED 100 /* ... so many events are chattering */

/* States and guesses of algebraic unknowns at a time within the last step. */
void ac_stand(ac_instance *i, double time) {
    const int32_t nx = ac_states(i), nz = i->of->parts.model.equations.nz, n = nx + nz;
    const double h = i->now.to - i->now.from, s = h > 0 ? fmin((time - i->now.from) / h, 1) : 1;
    ac_interpolate(n, i->before, i->after, i->dense, s, 0, nx, i->x);
    ac_interpolate(n, i->before, i->after, i->dense, s, nx, nz, i->z);
    i->now.time = time;
    ac_moved(i);
}

/* Begin to integrate from the present, or go on after a step that was kept. */
static int32_t begin(ac_instance *i, double to) {
    const ac_unit *u = i->of;
    const ac_model *m = &u->parts.model;
    const double ahead = isfinite(i->now.stop) && i->now.stop > i->now.time ? i->now.stop : i->now.time + AHEAD * u->span;
    const double horizon = u->inputs ? to : fmax(to, ahead), kept = i->now.first_step;
    const int32_t goes_on = i->now.integrates;
    i->ends[0] = goes_on ? i->now.to : i->now.time;
    if (!goes_on) i->now.end = fmin(horizon, i->now.next);
    i->ends[1] = i->now.end;
    const int damps = i->now.damping > 0;
    const ac_request request = {
        .tolerance = i->now.tolerance, .first_step = kept, .rate = m->rate,
        .size = damps ? u->damped : m->size, .smooth = !damps, .largest = damps, .singular = damps && u->constraints,
        .most = INT64_MAX / 4, .outputs = 1, .time = i->ends, .room = 1,
        .step_time = &i->step_time, .step_y = i->step_y, .step_dense = i->dense,
    };
    const double *y = i->after;
    if (!goes_on) {
        ac_keep(i);
        const int32_t failed = ac_know(i, AC_Z);
        if (failed) return failed;
        memcpy(i->after, i->x, (size_t)ac_states(i) * sizeof *i->x);
        memcpy(i->after + ac_states(i), i->z, (size_t)m->equations.nz * sizeof *i->z);
    }
    ac_rodas_begin(i->rodas, &request, y, y + ac_states(i), i->p, i->c);
    if (goes_on) {
        i->rodas->h = kept;
        i->rodas->begun = 1, i->rodas->pace = i->now.pace;
    }
    if (!goes_on) i->now.looked = i->now.taken = 0;
    i->now.integrates = 1, i->going = 1;
    i->now.to = i->ends[0];
    return AC_OK;
}

/* Go on from where the constraints have the states: errors that lead away from there would add up. */
static void go_back(ac_instance *i) {
    const ac_unit *u = i->of;
    if (!u->constraints || i->now.taken++ < RETURN) return;
    i->now.taken = 1;
    ac_stand(i, i->now.to);
    const double *w = ac_run(i, AC_COORDINATES);
    for (int32_t k = 0; k < u->tape[AC_COORDINATES].outputs; k++) i->after[u->coordinate[k]] = w[u->tape[AC_COORDINATES].output[k]];
    ac_rodas_move(i->rodas, i->after, i->after + ac_states(i));
}

/* One step that is accepted. */
static int32_t advance(ac_instance *i, double *left) {
    static const char *const why[] = {
        "", "", "", "no step is short enough for the tolerance.", "the equations have no solution beyond.",
        "there is not enough memory.",
    };
    const size_t n = (size_t)ac_states(i) + (size_t)i->of->parts.model.equations.nz;
    ac_progress done = {0};
    int32_t end = AC_MORE;
    go_back(i);
    while (end == AC_MORE && !done.kept) {
        if ((*left)-- <= 0) return ac_fail(i, AC_RETRY, "more steps are needed than the setting allows.");
        end = ac_rodas_go(i->rodas, 1, &done);
    }
    if (!done.kept) return ac_fail(i, AC_FAILED, why[end]);
    memcpy(i->before, i->after, n * sizeof *i->before);
    memcpy(i->after, i->step_y, n * sizeof *i->after);
    i->now.from = i->now.to, i->now.to = done.time, i->now.first_step = i->rodas->h, i->now.pace = i->rodas->pace;
    i->now.curved = 1, i->now.event = INFINITY;
    return AC_OK;
}

/* Values of the conditions, and their rates, at a time within the step. */
static int32_t look(ac_instance *i, double time, double *found) {
    const int32_t n = i->of->watched;
    ac_stand(i, time);
    const int32_t failed = ac_indicator_rates(i);
    if (failed) return failed;
    ac_put(found, i->guards, n);
    ac_put(found + n, i->guards + 2 * n, n);
    return AC_OK;
}

/* How far a condition is beyond where it changes: positive where it has changed. */
static double beyond(const ac_instance *i, int32_t k, double value) { return i->truth[k] > 0 ? value : -value; }

/* First time in a part of the step at which a condition has changed, given that it has at its end. */
static int32_t bisect(ac_instance *i, int32_t k, double from, double *to, double level) {
    for (int tries = 0; tries < HALVINGS && *to - from > ROUNDINGS * DBL_EPSILON * fabs(*to); tries++) {
        const double middle = from + (*to - from) / 2;
        ac_stand(i, middle);
        const int32_t failed = ac_know(i, AC_GUARD);
        if (failed) return failed;
        *(beyond(i, k, i->guards[k]) > level ? to : &from) = middle;
    }
    return AC_OK;
}

/* A time at which a condition that comes nearer and goes away again is nearest; the end of the part where it stays away. */
static int32_t dip(ac_instance *i, int32_t k, double from, double to, double *at) {
    for (int tries = 0; tries < HALVINGS / 3; tries++) {
        *at = from + (to - from) / 2;
        ac_stand(i, *at);
        const int32_t failed = ac_indicator_rates(i);
        if (failed) return failed;
        if (beyond(i, k, i->guards[k]) > LEVEL * ac_width(i, k)) return AC_OK;
        *(beyond(i, k, i->guards[2 * i->of->watched + k]) > 0 ? &from : &to) = *at;
    }
    *at = INFINITY;
    return AC_OK;
}

/* The first event in a part of the step, infinite for none; values and rates at both ends. */
static int32_t search(ac_instance *i, double from, double to, const double *before, const double *after, double *event) {
    const int32_t n = i->of->watched;
    int32_t failed = AC_OK;
    *event = INFINITY;
    for (int32_t k = 0; k < n && !failed; k++) {
        const double level = LEVEL * ac_width(i, k), v0 = beyond(i, k, before[k]), v1 = beyond(i, k, after[k]);
        const double r0 = beyond(i, k, before[n + k]), r1 = beyond(i, k, after[n + k]), h = to - from;
        double end = v1 > level ? to : INFINITY;
        /* Near and nearing at the first end, leaving at the second: a parabola may be beyond in between. */
        if (!isfinite(end) && r0 > 0 && r1 < 0 && fmax(v0 + 0.5 * h * r0, v1 - 0.5 * h * r1) > 0) failed = dip(i, k, from, to, &end);
        if (failed || !isfinite(end)) continue;
        failed = bisect(i, k, from, &end, v0 > 0 ? level : 0);
        if (!failed && end < *event) *event = end;
    }
    return failed;
}

/* Look for events in the last step. */
static int32_t locate(ac_instance *i) {
    const int32_t n = i->of->watched;
    double *before = i->looks, *after = i->looks + 2 * n, from = i->now.from;
    if (!n) return AC_OK;
    int32_t failed = i->now.looked ? AC_OK : look(i, from, before);
    for (int k = 1; k <= LOOKS && !failed && !isfinite(i->now.event); k++) {
        const double to = k < LOOKS ? i->now.from + k * (i->now.to - i->now.from) / LOOKS : i->now.to;
        failed = look(i, to, after);
        if (!failed) failed = search(i, from, to, before, after, &i->now.event);
        ac_put(before, after, 2 * n);
        from = to;
    }
    return failed;
}

/* Let an event happen at the present. */
static int32_t act(ac_instance *i) {
    ac_happened found;
    if (i->now.time - i->now.crowd > CROWDED * i->of->span) i->now.crowd = i->now.time, i->now.crowded = 0;
    if (++i->now.crowded > MOST_CROWDED) return ac_fail(i, AC_FAILED, "conditions chatter: events follow one another without end.");
    return ac_happen(i, &found);
}

static int32_t at_event(ac_instance *i) {
    const int32_t n = i->of->watched;
    ac_stand(i, i->now.event);
    i->now.event = INFINITY;
    const int32_t failed = ac_know(i, AC_GUARD);
    for (int32_t k = 0; k < n; k++) i->crossed[k] = beyond(i, k, i->guards[k]) > 0;
    i->now.integrates = i->now.curved = 0;
    return failed;
}

/* Whether loops passed a flat position in the last step. */
static int32_t refuse_flat(ac_instance *i) {
    if (!i->of->levels) return AC_OK;
    const int32_t nx = ac_states(i);
    double *rates = i->looks + 4 * i->of->watched;
    int32_t failed = AC_OK;
    if (i->now.looked) ac_put(rates, rates + nx, nx);
    for (int end = i->now.looked ? 1 : 0; end < 2 && !failed; end++) {
        ac_stand(i, end ? i->now.to : i->now.from);
        failed = ac_know(i, AC_RATE);
        if (failed && ac_is_flat(i)) return ac_fail(i, AC_FAILED, AC_FLAT_TEXT);
        memcpy(rates + end * nx, i->rate, (size_t)nx * sizeof *rates);
    }
    const ac_point a = {i->now.from, i->before, rates}, b = {i->now.to, i->after, rates + nx};
    if (failed || !ac_flat(i, &a, &b)) return failed;
    return ac_fail(i, AC_FAILED, AC_FLAT_TEXT);
}

static int32_t go(ac_instance *i, double to, int32_t early, int32_t *event) {
    double left = i->now.most;
    int32_t failed = AC_OK;
    while (!failed && !*event && i->now.time < to - ac_near(i)) {
        const double ahead = i->now.curved ? fmin(i->now.to, i->now.event) : i->now.time;
        if (i->now.time < ahead) {
            if (i->now.event <= to && i->now.event <= i->now.to) {
                failed = at_event(i);
                if (!failed && early) *event = 1;
                else if (!failed) failed = act(i);
            } else {
                ac_stand(i, fmin(to, ahead));
            }
        } else if (i->now.next <= i->now.time + ac_near(i)) {
            i->now.time = i->now.next;
            ac_moved(i);
            i->now.integrates = i->now.curved = 0;
            if (early) *event = 1;
            else failed = act(i);
        } else {
            if (!i->now.integrates || !i->going || i->now.to >= i->now.end) {
                if (i->now.to >= i->now.end) i->now.integrates = 0;
                failed = begin(i, to);
            }
            const double time = i->now.time;
            if (!failed) failed = advance(i, &left);
            if (failed) continue;
            failed = refuse_flat(i);
            if (!failed) failed = ac_refuse_jump(i);
            if (!failed) failed = locate(i);
            if (!failed && i->of->levels) {
                ac_stand(i, i->now.to);
                if (ac_is_unfit(i)) i->now.integrates = 0;
            }
            ac_stand(i, time);
            i->now.looked = !failed;
            /* A step in which nothing could be looked at is not taken. */
            if (failed) i->now.integrates = i->now.curved = 0;
        }
    }
    if (!failed && !*event) {
        i->now.time = to;
        if (i->now.next <= to + ac_near(i)) {
            if (early) *event = 1;
            else failed = act(i);
        }
    }
    return failed;
}

/* Values that were set may change conditions at once, and instants that are known. */
static int32_t happen_by_what_was_given(ac_instance *i) {
    ac_happened found;
    const int32_t any = i->now.given && i->of->watched + i->of->timed;
    i->now.given = 0;
    return any ? ac_happen(i, &found) : AC_OK;
}

/* From the present time to another; with `early`, back at the first event, which is left to the caller. */
int32_t ac_step(ac_instance *i, double to, int32_t early, double *reached, int32_t *event) {
    *event = 0, *reached = i->now.time;
    if (i->now.phase == AC_AT_EVENT) {
        const int32_t failed = ac_leave_event(i);
        if (failed) return failed;
    }
    if (i->now.phase != AC_RUNNING || i->now.failed) return ac_fail(i, AC_REFUSED, "it is not running.");
    if (!(to >= i->now.time) || !isfinite(to)) return ac_fail(i, AC_REFUSED, "a step leads to a later time.");
    int32_t failed = happen_by_what_was_given(i);
    if (!failed) failed = go(i, to, early, event);
    if (!failed) failed = ac_know(i, AC_Z);
    *reached = i->now.time;
    i->now.failed = failed == AC_FAILED;
    if (!failed) ac_renew_inputs(i);
    return failed;
}
