/* Values of an instance, read and written by references, and its phases. */
#include "instance.h"

#include <math.h>
#include <string.h>

/* Kinds of references, in their order. */
enum { TIME, STATE, RATE, GIVEN, VARIABLE, INDICATOR, SETTING, NONE };
enum { TOLERANCE, DAMPING, MOST, SETTINGS };

#define HYSTERESIS 1e-3 /* of what a condition may be off: beyond it an indicator changes its sign, so that rounding does not */

/* Factor, 1 or -1, that makes an indicator positive until its condition changes. */
static double side(const ac_instance *i, int32_t guard) { return i->truth[guard] > 0 ? -1 : 1; }

/* Level at which an indicator has changed in Model Exchange: one that is not positive after an event does so where it falls further. */
static double level(const ac_instance *i, int32_t guard) {
    return (i->now.simulates ? 0 : i->least[guard]) - HYSTERESIS * ac_width(i, guard);
}

static int32_t kind_of(const ac_instance *i, uint32_t reference, int32_t *place) {
    const ac_unit *u = i->of;
    const ac_equations *e = &u->parts.model.equations;
    const int32_t count[] = {1, e->nx, e->nx, e->np, u->shown, u->watched, SETTINGS};
    int64_t left = reference;
    for (int32_t kind = 0; kind < NONE; kind++) {
        *place = (int32_t)left;
        if (left < count[kind]) return kind;
        left -= count[kind];
    }
    return NONE;
}

static double *setting(ac_instance *i, int32_t place) {
    return place == TOLERANCE ? &i->now.tolerance : place == DAMPING ? &i->now.damping : &i->now.most;
}

int32_t ac_get(ac_instance *i, const uint32_t *reference, size_t count, double *value) {
    static const int32_t needs[] = {0, 0, AC_RATE, 0, AC_SHOW, AC_GUARD, 0};
    for (size_t k = 0; k < count; k++) {
        int32_t place, failed = 0;
        const int32_t kind = kind_of(i, reference[k], &place);
        if (kind == NONE) return ac_fail(i, AC_REFUSED, "there is no variable of this value reference.");
        if (kind != GIVEN && kind != SETTING && i->now.phase == AC_INITIALISING) failed = ac_initial(i);
        if (!failed && needs[kind]) failed = ac_know(i, needs[kind]);
        if (failed) return failed;
        const double *from[] = {&i->now.time, i->x, i->rate, i->p, i->shown, i->guards};
        value[k] = kind != SETTING ? from[kind][place] : *setting(i, place);
        if (kind == INDICATOR) value[k] -= side(i, place) * level(i, place);
    }
    return AC_OK;
}

/* Whether a setting may have a value. */
static int fits(int32_t place, double value) {
    if (place == TOLERANCE) return value > 0 && value < 1;
    return place == DAMPING ? value == 0 || value == 1 : value >= 1;
}

/* Entry of p behind a reference that may be set now, -1 for a setting, the time or a state itself; -2 where it may not, and why. */
static int32_t entry_of(ac_instance *i, uint32_t reference) {
    const ac_unit *u = i->of;
    const int starting = i->now.phase <= AC_INITIALISING, exchanges = i->now.phase == AC_RUNNING && !i->now.simulates;
    int32_t place;
    const int32_t kind = kind_of(i, reference, &place);
    if ((kind == SETTING && starting) || ((kind == TIME || kind == STATE) && exchanges)) return -1;
    const int32_t entry = kind == GIVEN ? place : kind == STATE && starting ? u->start_of[place] : -1;
    const int32_t role = entry >= 0 ? u->role[entry] : AC_INNER;
    const int open = role == AC_INPUT || role == AC_TUNABLE
        || ((role == AC_FIXED || (role == AC_STARTS && kind == STATE)) && starting);
    if (open) return entry;
    ac_fail(i, AC_REFUSED, role == AC_FIXED ? "a fixed parameter is set before the end of the initialisation."
        : "this variable cannot be set, or not now.");
    return -2;
}

/* Set all or nothing. */
int32_t ac_set(ac_instance *i, const uint32_t *reference, size_t count, const double *value) {
    const size_t size = (size_t)i->of->parts.model.equations.np * sizeof *i->p;
    int32_t place;
    for (size_t k = 0; k < count; k++) {
        if (!isfinite(value[k])) return ac_fail(i, AC_REFUSED, "a value is no finite number.");
        if (entry_of(i, reference[k]) == -2) return AC_REFUSED;
        if (kind_of(i, reference[k], &place) == SETTING && !fits(place, value[k])) {
            return ac_fail(i, AC_REFUSED, "a tolerance lies between 0 and 1, damping is 0 or 1, a number of steps is at least 1.");
        }
    }
    int changed = 0, placed = 0;
    if (size) memcpy(i->other, i->p, size);
    for (size_t k = 0; k < count; k++) {
        const int32_t entry = entry_of(i, reference[k]);
        const int32_t kind = kind_of(i, reference[k], &place);
        if (entry < 0 && kind != SETTING) {
            *(kind == TIME ? &i->now.time : i->x + place) = value[k];
            placed |= kind != TIME;
            ac_moved(i);
        } else if (kind == SETTING) {
            *setting(i, place) = value[k];
        } else if (i->p[entry] != value[k]) {
            i->p[entry] = value[k];
            changed = 1;
        }
    }
    if (placed) ac_follow_states(i);
    if (!changed) return AC_OK;
    ac_changed(i);
    i->now.given = i->now.phase > AC_INITIALISING;
    if (i->now.phase <= AC_INITIALISING || !ac_limits(i, 0)) return AC_OK;
    memcpy(i->p, i->other, size);
    ac_changed(i);
    return AC_REFUSED;
}

/* Slopes of inputs by time, from the present on; a value that is set later is that of its time. */
int32_t ac_set_slopes(ac_instance *i, const uint32_t *reference, size_t count, const double *slope) {
    const ac_unit *u = i->of;
    for (size_t k = 0; k < count; k++) {
        int32_t place, input = 0;
        const int32_t kind = kind_of(i, reference[k], &place);
        while (kind == GIVEN && input < u->inputs && u->input[2 * input] != place) input++;
        if (kind != GIVEN || input == u->inputs) return ac_fail(i, AC_REFUSED, "only inputs have slopes.");
        if (!isfinite(slope[k])) return ac_fail(i, AC_REFUSED, "a slope is no finite number.");
        i->p[u->input[2 * input + 1]] = slope[k];
        i->p[u->input[2 * u->inputs]] = i->now.time;
        ac_changed(i);
        i->now.given = 1;
    }
    return AC_OK;
}

/* At a new time inputs are what they have become by their slopes, which end. */
void ac_renew_inputs(ac_instance *i) {
    const ac_unit *u = i->of;
    int moved = 0;
    for (int32_t k = 0; k < u->inputs; k++) {
        double *value = i->p + u->input[2 * k], *slope = i->p + u->input[2 * k + 1];
        if (*slope == 0) continue;
        *value += *slope * (i->now.time - i->p[u->input[2 * u->inputs]]);
        *slope = 0;
        moved = 1;
    }
    if (moved) ac_changed(i);
}

int32_t ac_begin(ac_instance *i, double time, double stop, double tolerance, int32_t simulates) {
    if (!isfinite(time) || (tolerance != 0 && !(tolerance > 0 && tolerance < 1)) || stop <= time) {
        return ac_fail(i, AC_REFUSED, "times are finite, a stop time lies behind the start, a tolerance between 0 and 1.");
    }
    if (i->now.phase != AC_SET_UP) return ac_fail(i, AC_REFUSED, "it has been initialised.");
    i->now.time = time, i->now.stop = stop, i->now.simulates = simulates;
    if (tolerance > 0) i->now.tolerance = tolerance;
    i->now.phase = AC_INITIALISING;
    ac_changed(i);
    return AC_OK;
}

int32_t ac_begun(ac_instance *i) {
    if (i->now.phase != AC_INITIALISING) return ac_fail(i, AC_REFUSED, "it is not being initialised.");
    const int32_t failed = ac_initial(i);
    if (failed) return failed;
    i->now.phase = AC_AT_EVENT, i->now.first = 1;
    return AC_OK;
}

int32_t ac_event(ac_instance *i, ac_happened *found) {
    if (i->now.phase != AC_AT_EVENT) return ac_fail(i, AC_REFUSED, "it is not at an event.");
    return ac_happen(i, found);
}

/* Model Exchange: values of the indicators that `level` and `note_crossings` need, from an event on. */
static int32_t follow_indicators(ac_instance *i, int fresh) {
    if (i->now.simulates || !i->of->watched) return AC_OK;
    const int32_t failed = ac_know(i, AC_GUARD);
    for (int32_t k = 0; k < i->of->watched && !failed; k++) {
        const double value = side(i, k) * i->guards[k];
        if (fresh || value > 0) i->least[k] = fmin(value, 0);
        i->peak[k] = fresh ? value : fmax(i->peak[k], value);
    }
    return failed;
}

/* Model Exchange: which indicators change at an event, and whether they moved by more than their tolerance bands since the last one. */
static int32_t note_crossings(ac_instance *i) {
    if (i->now.simulates || !i->of->watched) return AC_OK;
    const int32_t failed = ac_know(i, AC_GUARD);
    int32_t changes = 0, weak = 1;
    for (int32_t k = 0; k < i->of->watched && !failed; k++) {
        i->crossed[k] = side(i, k) * i->guards[k] <= level(i, k);
        if (i->crossed[k] > 0) changes = 1, weak &= i->peak[k] <= ac_width(i, k);
    }
    if (changes) i->now.weak = weak ? i->now.weak + 1 : 0;
    return i->now.weak > AC_MOST_WEAK ? ac_refuse_chatter(i) : failed;
}

int32_t ac_enter_event(ac_instance *i) {
    if (i->now.phase != AC_RUNNING && i->now.phase != AC_AT_EVENT) return ac_fail(i, AC_REFUSED, "it is not running.");
    const int32_t failed = i->now.phase == AC_RUNNING ? note_crossings(i) : AC_OK;
    i->now.phase = AC_AT_EVENT;
    return failed;
}

int32_t ac_leave_event(ac_instance *i) {
    if (i->now.phase != AC_AT_EVENT) return ac_fail(i, AC_REFUSED, "it is not at an event.");
    if (i->now.first) {
        ac_happened found;
        const int32_t failed = ac_happen(i, &found);
        if (failed) return failed;
    }
    i->now.phase = AC_RUNNING;
    return follow_indicators(i, 1);
}

int32_t ac_completed(ac_instance *i) {
    const int32_t failed = follow_indicators(i, 0);
    return failed ? failed : ac_refuse_flat(i);
}

int32_t ac_set_time(ac_instance *i, double time) {
    if (!isfinite(time)) return ac_fail(i, AC_REFUSED, "the time is no finite number.");
    if (i->now.time != time) ac_moved(i);
    i->now.time = time;
    return AC_OK;
}

int32_t ac_set_states(ac_instance *i, const double *x) {
    const int32_t nx = ac_states(i);
    if (!ac_all_finite(x, nx)) return ac_fail(i, AC_RETRY, "a state is no finite number.");
    if (nx && memcmp(i->x, x, (size_t)nx * sizeof *x)) {
        memcpy(i->x, x, (size_t)nx * sizeof *x);
        ac_follow_states(i);
        ac_moved(i);
    }
    return AC_OK;
}

/* What many callers read at once. */
static int32_t read_all(ac_instance *i, uint32_t first, int32_t count, double *value) {
    int32_t failed = 0;
    for (int32_t k = 0; k < count && !failed; k++) {
        const uint32_t reference = first + (uint32_t)k;
        failed = ac_get(i, &reference, 1, value + k);
    }
    return failed;
}

int32_t ac_get_states(ac_instance *i, double *x) { return read_all(i, 1, ac_states(i), x); }

int32_t ac_get_rates(ac_instance *i, double *rate) { return read_all(i, 1 + (uint32_t)ac_states(i), ac_states(i), rate); }

int32_t ac_get_nominals(ac_instance *i, double *nominal) {
    for (int32_t k = 0; k < ac_states(i); k++) nominal[k] = i->of->nominal[k];
    return AC_OK;
}

int32_t ac_get_indicators(ac_instance *i, double *value) {
    const ac_unit *u = i->of;
    const ac_equations *e = &u->parts.model.equations;
    const int64_t first = 1 + 2 * (int64_t)e->nx + e->np + u->shown;
    return read_all(i, (uint32_t)first, u->watched, value);
}

/* Columns of the derivatives: the time, the states, or entries of p that a caller may change. */
static double *known_of(ac_instance *i, uint32_t reference, double *dt, double *dx, double *dp) {
    int32_t place;
    const int32_t kind = kind_of(i, reference, &place);
    return kind == TIME ? dt : kind == STATE ? dx + place : kind == GIVEN ? dp + place : NULL;
}

/* Rows: where the derivative of an unknown stands. */
static double *unknown_of(ac_instance *i, uint32_t reference, double *of[3]) {
    int32_t place;
    const int32_t kind = kind_of(i, reference, &place);
    return kind == RATE ? of[0] + place : kind == VARIABLE ? of[1] + place : kind == INDICATOR ? of[2] + place : NULL;
}

int32_t ac_seed(ac_instance *i, const uint32_t *known, size_t count, double *dt, double *dx, double *dp, const double *seed,
                double *found) {
    for (size_t k = 0; k < count; k++) {
        double *at = known_of(i, known[k], dt, dx, dp);
        if (!at) return ac_fail(i, AC_REFUSED, "derivatives are by the time, states, inputs and parameters.");
        if (seed) *at += seed[k];
        if (found) found[k] = *at;
    }
    return AC_OK;
}

int32_t ac_pick(ac_instance *i, const uint32_t *unknown, size_t count, double *of[3], const double *seed, double *found) {
    for (size_t k = 0; k < count; k++) {
        double *at = unknown_of(i, unknown[k], of);
        if (!at) return ac_fail(i, AC_REFUSED, "derivatives are those of rates, variables and event indicators.");
        if (seed) *at += seed[k];
        if (found) found[k] = *at;
    }
    return AC_OK;
}
