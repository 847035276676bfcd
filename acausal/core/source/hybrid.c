/* The hybrid loop: integrate to the next event, locate it, apply it, restart; across communication points where there are no inputs. */
#include "hybrid.h"

#include <float.h>
#include <math.h>
#include <string.h>

#define AHEAD 100       /* spans of a run: where no stop time is known */
#define RETURN 64       /* steps after which closed loops go back to their constraints, as `simulate` does */
#define CROWDED 1e-9    /* of a run: within that time ... */
#define MOST_CROWDED 100 /* ... so many events are chattering */
#define SNAP 0.01       /* of an output interval: an event that near an output, within its tolerance, is at the output */
#define EARLY 1e-5      /* of a step: an event that comes so early is located again in a shorter step, as the dense output is off by a part
                           of all that moves in the step; not where it is that many rounding errors of the time away, or fewer */
#define ROUNDINGS 1000
#define SHORTER 8       /* times as far as that event */
#define DUE 1e-6        /* of a run: an indicator that falls to 0 within that time may do so now */

/* States and guesses of algebraic unknowns at a time within the last step. */
void ac_stand(ac_instance *i, double time) {
    const int32_t nx = ac_states(i), nz = i->of->parts.model.equations.nz, n = nx + nz, rows = i->stepper->method->rows;
    const double h = i->now.to - i->now.from, s = h > 0 ? fmin((time - i->now.from) / h, 1) : 1;
    ac_interpolate(n, rows, i->before, i->after, i->dense, s, 0, nx, i->x);
    ac_interpolate(n, rows, i->before, i->after, i->dense, s, nx, nz, i->z);
    i->now.time = time;
    ac_moved(i);
}

/* Begin to integrate from the present, or go on after a step that was kept. */
static int32_t begin(ac_instance *i, double to) {
    const ac_unit *u = i->of;
    const ac_model *m = &u->parts.model;
    const double ahead = isfinite(i->now.stop) && i->now.stop > i->now.time ? i->now.stop : i->now.time + AHEAD * u->span;
    const double horizon = u->inputs || !ac_states(i) ? to : fmax(to, ahead);
    const int32_t goes_on = i->now.integrates, damps = i->now.damping > 0;
    i->ends[0] = goes_on ? i->now.to : i->now.time;
    if (!goes_on) i->now.end = fmin(horizon, i->now.next);
    i->ends[1] = fmin(to, i->now.end), i->ends[2] = i->now.end;
    const ac_request request = {
        .tolerance = i->multistep.size ? i->multistep.tolerance : i->now.tolerance,
        .first_step = goes_on ? i->now.first_step : i->now.longer, .rate = m->rate,
        .size = i->multistep.size ? i->multistep.size : damps ? u->damped : m->size,
        .smooth = !damps, .largest = damps, .singular = damps && u->constraints,
        .most = INT64_MAX / 4, .share = 1, .outputs = i->ends[1] < i->ends[2] ? 2 : 1, .time = i->ends, .room = 1,
        .step_time = &i->step_time, .step_y = i->step_y, .step_dense = i->dense, .order = i->multistep.order, .newton = i->multistep.newton,
    };
    const double *y = i->after;
    if (!goes_on) {
        if (i->recorder && i->now.firm > 0 && ac_is_unfit(i)) return AC_EXCHANGE;
        ac_keep(i);
        i->window = (ac_window){.time = i->now.time};
        const int32_t failed = ac_know(i, AC_Z);
        if (failed) return failed;
        memcpy(i->after, i->x, (size_t)ac_states(i) * sizeof *i->x);
        memcpy(i->after + ac_states(i), i->z, (size_t)m->equations.nz * sizeof *i->z);
        i->now.looked = i->now.taken = 0, i->now.last = 0;
    }
    ac_stepper_begin(i->stepper, &request, y, y + ac_states(i), i->p, i->c);
    if (goes_on) {
        i->rodas->h = i->now.first_step;
        i->rodas->begun = 1, i->rodas->pace = i->now.pace;
    }
    i->now.integrates = 1, i->going = 1, i->counts.begun++;
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
    ac_stepper_move(i->stepper, i->after, i->after + ac_states(i));
}

/* Whether one more step may be tried. */
static int may_step(ac_instance *i, double *left) {
    struct ac_recorder *r = i->recorder;
    if (!r) return (*left)-- > 0;
    return r->left-- > 0 && r->since++ < r->run->longest;
}

/* Integrate until a step is accepted; without one the present stays. */
static int32_t advance(ac_instance *i, double *left) {
    static const char *const why[] = {
        "", "", "", "no step is short enough for the tolerance.", "the equations have no solution beyond.",
        "there is not enough memory.", "the tolerance is smaller than rounding errors.",
    };
    const size_t n = (size_t)ac_states(i) + (size_t)i->of->parts.model.equations.nz;
    const ac_progress begun = i->stepper->progress;
    ac_progress done = {0};
    int32_t end = AC_MORE, may = 1;
    go_back(i);
    while (end == AC_MORE && !done.kept && (may = may_step(i, left))) end = ac_stepper_go(i->stepper, 1, &done);
    if (done.steps + done.refused) {
        i->counts.steps += done.steps - begun.steps, i->counts.refused += done.refused - begun.refused;
        i->counts.values += done.values - begun.values, i->counts.factors += done.factors - begun.factors;
    }
    if (!may && i->recorder && i->recorder->left < 0) return AC_PAUSE;
    if (!may) i->why = AC_MANY;
    if (!may) return ac_fail(i, AC_RETRY, "more steps are needed than the setting allows.");
    if (!done.kept) return ac_refuse(i, end, why[end]);
    memcpy(i->before, i->after, n * sizeof *i->before);
    memcpy(i->after, i->step_y, n * sizeof *i->after);
    i->now.from = i->now.to, i->now.to = done.time, i->now.first_step = i->rodas->h, i->now.pace = i->rodas->pace;
    i->now.longer = fmax(i->now.last, i->now.to - i->now.from), i->now.last = i->now.to - i->now.from;
    i->now.curved = 1, i->now.crosses = 0, i->now.event = INFINITY;
    if (i->recorder && !(i->now.damping > 0) && ac_creeps(i, &done)) return ac_refuse(i, AC_SINGULAR, AC_FLAT_TEXT);
    return AC_OK;
}

/* Whether an event comes so early in the first step that a shorter one has to locate it. */
static int is_early(const ac_instance *i) {
    const double h = i->now.to - i->now.from, ahead = i->now.event - i->now.from;
    return !i->now.looked && ahead < EARLY * h && ahead > ROUNDINGS * DBL_EPSILON * fabs(i->now.event);
}

/* Where the equations lead no farther, a condition that is about to hold does so at once: it may switch them. */
static int is_due(ac_instance *i) {
    const int32_t nx = ac_states(i), nz = i->of->parts.model.equations.nz, m = i->of->watched;
    const double *value = i->guards, *rate = i->guards + 2 * m;
    int due = 0;
    if (!m || i->now.blind || i->why == AC_UNDEFINED || ac_indicator_rates(i)) return 0;
    for (int32_t k = 0; k < m; k++) {
        const double side = i->truth[k] > 0 ? -1 : 1, falls = -side * rate[k];
        i->crossing[k] = falls > 0 && side * value[k] <= DUE * falls * i->of->span ? AC_DUE : 0;
        due |= i->crossing[k] > 0;
    }
    if (!due) return 0;
    ac_put(i->event_y, i->x, nx), ac_put(i->event_y + nx, i->z, nz);
    i->now.event = i->now.from = i->now.to = i->now.time, i->now.curved = 1, i->now.integrates = 0, i->now.delay = 0;
    return 1;
}

/* Check an accepted step, and locate the first event in it. */
static int32_t check(ac_instance *i) {
    const double time = i->now.time;
    double shorter = 0;
    int32_t failed = i->now.crosses ? AC_OK : ac_meet_flat(i, &shorter);
    if (!failed && !(shorter > 0) && !i->now.crosses && (failed = ac_refuse_jump(i))) i->why = AC_FOLD;
    if (!failed && !(shorter > 0)) failed = ac_locate(i);
    if (!failed && is_early(i)) shorter = SHORTER * (i->now.event - i->now.from);
    if (!failed && !(shorter > 0) && i->of->levels) {
        ac_stand(i, i->now.to);
        if (ac_is_unfit(i)) i->now.integrates = 0;
    }
    ac_stand(i, time);
    /* Beyond an event equations may have no solution, and conditions no value. */
    if (failed == AC_RETRY && i->now.to - i->now.from > ROUNDINGS * DBL_EPSILON * fabs(time)) {
        shorter = (i->now.to - i->now.from) / 2, failed = AC_OK;
    }
    i->now.looked = !failed && !(shorter > 0);
    if (shorter > 0) i->now.longer = shorter, i->now.event = INFINITY;
    /* A step that could not be checked is not taken. */
    if (failed || shorter > 0) i->now.integrates = i->now.curved = 0;
    return failed;
}

/* Integrate one step on the way to a time. */
static int32_t step(ac_instance *i, double to, double *left) {
    int32_t failed = AC_OK;
    if (ac_cross(i)) return check(i);
    if (!i->now.integrates || !i->going || i->now.to >= i->now.end) {
        if (i->now.to >= i->now.end) i->now.integrates = 0;
        failed = begin(i, to);
    }
    if (i->recorder) ac_hold(i);
    if (!failed) failed = advance(i, left);
    if (!failed) failed = check(i);
    if (!failed && i->now.looked) failed = ac_complete_step(i);
    return failed && failed != AC_PAUSE && failed != AC_EXCHANGE && is_due(i) ? AC_OK : failed;
}

/* Move within the last step. */
static int32_t move(ac_instance *i, double to) {
    const int32_t failed = ac_add_work(i, i->now.time, to);
    ac_stand(i, to);
    return failed;
}

/* Whether events follow one another without end. */
static int chatters(ac_instance *i) {
    if (i->now.time - i->now.crowd > CROWDED * i->of->span) i->now.crowd = i->now.time, i->now.crowded = 0;
    return ++i->now.crowded > MOST_CROWDED || i->now.weak > AC_MOST_WEAK;
}

/* Let happen what happens at the present. */
static int32_t iterate(ac_instance *i, int32_t *changed) {
    ac_happened found;
    double before, after;
    int32_t failed = ac_know(i, AC_Z);
    if (!failed) failed = ac_stored_energy(i, &before);
    if (!failed) failed = ac_happen(i, &found);
    if (!failed) failed = ac_stored_energy(i, &after);
    if (!failed) ac_add_jump(i, after - before), *changed = found.changed;
    return failed;
}

/* Let an event happen; a run leaves to its caller what does not succeed, as it was before. */
static int32_t act(ac_instance *i) {
    const int chatter = chatters(i);
    int32_t changed = 0;
    i->now.integrates = i->now.curved = i->now.pasts = 0;
    if (!i->recorder) {
        return chatter ? ac_refuse_chatter(i) : iterate(i, &changed);
    }
    (void)ac_know(i, AC_Z); /* where it fails, so does the iteration */
    ac_save(i, i->kept);
    if (!chatter && !iterate(i, &changed)) {
        ac_record_event(i, changed);
        return AC_OK;
    }
    ac_restore(i, i->kept);
    return AC_LEAVE;
}

/* How far from an output an event is at it: within its tolerance, and a part of the output interval. */
static double snap(const ac_instance *i, double to) { return fmin(i->now.delay, SNAP * (to - i->now.since)); }

/* Stand at the event of the last step, which a near output takes to itself. */
static int32_t at_event(ac_instance *i, double to) {
    const int32_t nx = ac_states(i), nz = i->of->parts.model.equations.nz;
    const double event = i->now.event;
    const int32_t failed = ac_add_work(i, i->now.time, event);
    i->now.time = fabs(to - event) <= snap(i, to) ? to : event;
    ac_put(i->x, i->event_y, nx), ac_put(i->z, i->event_y + nx, nz), ac_put(i->crossed, i->crossing, i->of->watched);
    ac_moved(i);
    i->now.event = INFINITY;
    return failed;
}

/* Go on to a time; with `early`, back at the first event, which is left to the caller. */
int32_t ac_go(ac_instance *i, double to, int32_t early, int32_t *event) {
    double left = i->now.most;
    int32_t failed = AC_OK;
    while (!failed && !*event && i->now.time < to - ac_near(i)) {
        if (i->recorder && ac_is_full(i)) return AC_PAUSE;
        if (i->now.curved && i->now.event <= to + snap(i, to)) {
            failed = at_event(i, to);
        } else if (i->now.curved && i->now.time < i->now.to) {
            failed = move(i, fmin(to, i->now.to));
            continue;
        } else if (i->now.next <= i->now.time + ac_near(i)) {
            i->now.time = i->now.next;
            ac_moved(i);
        } else {
            failed = step(i, to, &left);
            continue;
        }
        if (failed) continue;
        if (i->recorder && i->now.time >= i->recorder->run->end) break; /* what happens there is left to the caller */
        if (early) i->now.integrates = i->now.curved = 0, *event = 1;
        else failed = act(i);
    }
    if (failed || *event) return failed;
    i->now.time = to;
    if (i->now.next > to + ac_near(i) || (i->recorder && to >= i->recorder->run->end)) return AC_OK;
    if (early) *event = 1;
    return early ? AC_OK : act(i);
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
    i->now.since = i->now.time;
    if (!failed) failed = ac_go(i, to, early, event);
    if (!failed) failed = ac_know(i, AC_Z);
    *reached = i->now.time;
    i->now.failed = failed == AC_FAILED;
    if (!failed) ac_renew_inputs(i);
    return failed;
}
