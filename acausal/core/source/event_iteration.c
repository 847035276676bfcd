/* What happens at one instant: switches flip and variables jump until nothing changes. */
#include "instance.h"

#include <math.h>
#include <string.h>

#define SOON 1e-8      /* of the run: what changes sign within that time does so now */
#define MOVES 1e-3     /* of the size in a run: a condition that changes less does not move */
#define ADDED 1e-11    /* of the run, or of a late time: rounding of instants that add up, due + 0.1 again and again */
#define NEAR 1e-12     /* of the time: instants that near are one, and leave no room for an integration */
#define LATE 2e-2      /* of the time, where that is long beside the run */
#define SAME 1e-9      /* of a value, or of a nominal one: rounding of values that are computed in two ways */
#define UNSETTLED_TEXT "conditions switch back and forth at one instant."

double ac_near(const ac_instance *i) { return NEAR * fmax(LATE * fabs(i->now.time), i->of->span); }

/* The next instant that is known, and a time between the present and that. */
double ac_next_instant(ac_instance *i, double *between) {
    const ac_unit *u = i->of;
    const double now = i->now.time, near = ac_near(i);
    double next = INFINITY;
    if (u->instants && !i->now.blind) {
        const double *w = ac_run(i, AC_INSTANTS);
        for (int32_t k = 0; k < u->instants; k++) {
            const double at = w[u->tape[AC_INSTANTS].output[k]];
            if (at > now + near && at < next) next = at;
        }
    }
    *between = isfinite(next) ? now + (next - now) / 2 : now + u->span;
    return next;
}

double ac_width(const ac_instance *i, int32_t guard) {
    const double scale = i->guards[i->of->watched + guard];
    return i->now.tolerance * (scale > 0 && isfinite(scale) ? scale : fmin(i->of->span, 1));
}

/* Whether a watched condition holds from now on: where it is negative; what passes 0 just now counts as passed. */
static int holds(const ac_instance *i, int32_t k, double rate) {
    const double value = i->guards[k], width = ac_width(i, k), change = rate * i->of->span;
    const double rounding = ADDED * fmax(1, LATE * fabs(i->now.time) / i->of->span);
    const int soon = i->crossed[k] > 0 || fabs(value) <= fabs(change) * (i->of->guard[k].clocked ? rounding : SOON);
    const int due = i->errors[i->of->watched + k] > 0;
    if (i->crossed[k] == AC_DUE && (!due || fabs(value - i->errors[k]) <= width)) return due;
    if (fabs(change) > MOVES * width && soon && fabs(value) <= width) return change < 0;
    return value == 0 ? i->truth[k] > 0 : value < 0;
}

/* What one round finds: flips of switches in `on` (of c), conditions that fire in `fires` (of all), and the time by which their instant
   may be off. */
typedef struct {
    double *on, *fires, leeway;
    int32_t changes, flips; /* whether anything changes, and watched switches */
} round_of;

static void note(const ac_unit *u, round_of *r, int32_t guard, int now, int before) {
    const ac_guard *g = &u->guard[guard];
    if (g->on >= 0) {
        if (now == before) return;
        r->on[g->on] = now;
        r->changes = 1;
    } else if (now && !before) {
        r->fires[guard] = 1;
        r->changes = 1;
    }
}

/* What the caller has the clock change. */
static void take_clock(const ac_instance *i, round_of *r) {
    const ac_unit *u = i->of;
    for (int32_t k = 0; k < u->switches; k++) {
        if (i->clock.c[k] != r->on[k]) r->on[k] = i->clock.c[k], r->changes = 1;
    }
    for (int32_t k = 0; k < u->timed; k++) {
        if (i->clock.fires[k] > 0) r->fires[u->watched + k] = r->changes = 1;
    }
}

/* What the clock changes. */
static void look_at_clock(ac_instance *i, round_of *r) {
    const ac_unit *u = i->of;
    const double time = i->now.time;
    double between;
    i->now.next = ac_next_instant(i, &between);
    if (i->clock.c) take_clock(i, r);
    if (!u->tape[AC_TIMED].outputs) return;
    double at_start[2] = {time, between};
    for (int k = i->now.first ? 0 : 1; k < 2; k++) {
        i->now.time = at_start[k];
        const double *w = ac_run(i, AC_TIMED);
        for (int32_t j = 0; j < u->timed; j++) {
            const ac_guard *g = &u->guard[u->watched + j];
            const int now = w[u->tape[AC_TIMED].output[j]] > 0.5;
            /* At the start what holds at that very instant held before, unless it acts there. */
            if (k == 0) i->held[j] = g->on >= 0 ? i->held[j] : now && !g->at_start;
            else {
                note(u, r, u->watched + j, now, i->held[j] > 0);
                if (now != i->held[j]) i->now.longer = 0; /* what the clock changes tells nothing of the steps after it */
                i->held[j] = now;
            }
        }
    }
    i->now.time = time;
}

static void clear(const ac_unit *u, double *conditions) {
    memset(conditions, 0, ((size_t)u->watched + (size_t)u->timed) * sizeof *conditions);
}

/* Of switches whose modes repeat themselves, blame those that change. */
static void blame_cycle(ac_instance *i) {
    const ac_unit *u = i->of;
    const ac_mode_search *s = &i->search;
    if (!s->cycle) return;
    clear(u, i->acts);
    for (int32_t k = 0; k < u->watched; k++) {
        for (int32_t j = 0; j < s->cycling; j++) i->acts[k] += s->order[j] == u->guard[k].on;
    }
}

/* Take the next mode in place of the one that the values imply; until a mode is found that fits, nothing acts. */
static int32_t search_mode(ac_instance *i, const round_of *r) {
    const ac_unit *u = i->of;
    const int32_t n = u->switches + u->discretes, nx = ac_states(i);
    double *mode = i->mode, *current = mode + n + nx;
    ac_put(current, i->c, n), ac_put(current + n, i->x, nx);
    ac_put(mode, current, n + nx), ac_put(mode, r->on, u->switches);
    for (int32_t k = 0; k < u->watched; k++) {
        if (u->guard[k].on >= 0) mode[u->guard[k].on] = i->other[k];
    }
    if (!ac_next_mode(&i->search, current, mode)) {
        blame_cycle(i);
        return ac_refuse(i, AC_UNSETTLED, UNSETTLED_TEXT);
    }
    for (int32_t k = 0; k < u->watched && i->search.cycle; k++) {
        i->other[k] = u->guard[k].on >= 0 ? mode[u->guard[k].on] : i->truth[k];
    }
    return AC_OK;
}

static int32_t look_at_conditions(ac_instance *i, round_of *r, int first) {
    const ac_unit *u = i->of;
    const double *rate = i->guards + 2 * u->watched;
    int32_t failed = ac_indicator_rates(i), fires = 0;
    if (failed) return failed;
    for (int32_t k = 0; k < u->watched; k++) {
        if (first) i->errors[k] = i->guards[k], i->errors[u->watched + k] = !(i->truth[k] > 0);
        i->other[k] = holds(i, k, rate[k]);
        r->flips |= u->guard[k].on >= 0 && i->other[k] != i->truth[k];
        fires |= u->guard[k].on < 0 && i->other[k] > i->truth[k];
    }
    /* What fires in this round makes the next one differ, even if the switches have been there before: a pulse has two edges. */
    if (r->flips && !fires) failed = search_mode(i, r);
    ac_save(i, i->round);
    for (int32_t k = 0; k < u->watched && !failed; k++) {
        i->acts[k] += u->guard[k].on >= 0 && i->other[k] != i->truth[k];
        if (i->other[k] != i->truth[k]) r->leeway = fmax(r->leeway, ac_leeway(i, k));
        note(u, r, k, i->other[k] > 0, i->truth[k] > 0);
        i->truth[k] = i->other[k];
    }
    return failed;
}

/* The condition that fires whose jumps are the next, from one on, in the order of statements; -1 for none. */
static int32_t next_jump(const ac_unit *u, const double *fires, int32_t from) {
    int32_t found = -1;
    for (int32_t k = 0; k < u->watched + u->timed; k++) {
        const ac_guard *g = &u->guard[k];
        if (fires[k] > 0 && g->jumps && g->jump >= from && (found < 0 || g->jump < u->guard[found].jump)) found = k;
    }
    return found;
}

/* Refuse a jump for which conditions are to blame. */
static int32_t refuse_jump(ac_instance *i, int32_t guard, int32_t other, int32_t why, const char *text) {
    clear(i->of, i->acts);
    i->acts[guard] = i->acts[other] = 1;
    return ac_refuse(i, why, text);
}

/* Set a variable that jumps; `by`: 1 + the condition that has set it, or 0. Two statements that set it agree up to rounding, or the run
   ends. */
static int32_t set(ac_instance *i, double *to, double value, double nominal, double *by, int32_t guard) {
    const int32_t other = (int32_t)*by - 1;
    if (!isfinite(value)) return refuse_jump(i, guard, guard, AC_NO_NUMBER, "reinit() gives no finite number.");
    if (other >= 0 && fabs(value - *to) > SAME * fmax(nominal, fmax(fabs(value), fabs(*to)))) {
        return refuse_jump(i, guard, other, AC_CONTRADICTION, "two statements set one variable to different values.");
    }
    *to = value, *by = 1 + guard;
    return AC_OK;
}

/* Let variables jump to what follows from the values before. */
static int32_t jump(ac_instance *i, const round_of *r, int32_t *states) {
    const ac_unit *u = i->of;
    const ac_equations *e = &u->parts.model.equations;
    const ac_tape *t = &u->tape[AC_JUMPS], *own = &u->tape[AC_COORDINATES];
    double *held = i->other, *set_by = i->work, *before = i->order; /* of states and of discrete variables: by which condition */
    int32_t k = next_jump(u, r->fires, 0), jumped = 0;
    const double *w = k < 0 ? NULL : ac_run(i, AC_JUMPS), *projected = k < 0 ? NULL : ac_run(i, AC_COORDINATES);
    int32_t failed = ac_call_functions(i, r->fires);
    if (failed || k < 0) return failed;
    memset(held, 0, (size_t)e->nx * sizeof *held), memset(set_by, 0, (size_t)u->discretes * sizeof *set_by);
    for (int32_t j = 0; j < own->outputs; j++) i->x[u->coordinate[j]] = projected[own->output[j]];
    ac_put(before, i->x, e->nx);
    for (int32_t end; k >= 0; k = next_jump(u, r->fires, end)) {
        end = u->guard[k].jump + u->guard[k].jumps;
        for (int32_t j = u->guard[k].jump; j < end; j++) {
            const int32_t is_state = u->jump[2 * j], to = u->jump[2 * j + 1];
            double *variable = is_state ? i->x + to : i->c + u->switches + to;
            failed = set(i, variable, w[t->output[j]], is_state ? u->nominal[to] : 0, is_state ? held + to : set_by + to, k);
            if (failed) return failed;
            jumped |= is_state;
        }
    }
    *states |= jumped;
    ac_changed(i);
    return jumped && u->constraints ? ac_close(i, held, before) : AC_OK;
}

/* Decide set-valued laws at rest; where jumps give them speeds, they slide, and the others are decided again. */
static int32_t decide(ac_instance *i, const round_of *r) {
    const ac_unit *u = i->of;
    int32_t acts = 0, parted = 0;
    if (!u->laws) return AC_OK;
    ac_read_laws(i, i->round + u->parts.model.equations.nx + u->parts.model.equations.nz, i->law_values);
    int32_t failed = ac_decide_laws(i, i->law_values);
    for (int32_t k = 0; k < u->watched + u->timed; k++) acts |= r->fires[k] > 0;
    if (!failed && acts) failed = ac_part_laws(i, &parted);
    if (failed || !parted) return failed;
    ac_read_laws(i, i->c, i->law_values);
    return ac_decide_laws(i, i->law_values);
}

/* Apply what a round finds. */
static int32_t apply(ac_instance *i, const round_of *r, int32_t *states) {
    int32_t failed = jump(i, r, states);
    if (failed) return failed;
    for (int32_t k = 0; k < i->of->switches; k++) i->c[k] = r->on[k];
    ac_changed(i);
    failed = ac_refuse_discontinuity(i, r->leeway);
    if (!failed) failed = decide(i, r);
    return failed ? failed : ac_know(i, AC_RATE);
}

/* Everything that happens now. */
int32_t ac_happen(ac_instance *i, ac_happened *found) {
    const ac_unit *u = i->of;
    memset(found, 0, sizeof *found);
    int32_t failed = ac_know(i, AC_RATE), round = 0;
    ac_begin_search(i, u->switches + u->discretes + ac_states(i));
    clear(u, i->acts);
    for (; round < AC_MODES && !failed; round++) {
        /* As long as all constants and conditions, behind what the values of conditions and their rates need. */
        round_of r = {.on = i->flips, .fires = i->flips + u->switches};
        for (int32_t k = 0; k < u->switches; k++) r.on[k] = i->c[k];
        clear(u, r.fires);
        if (!round) look_at_clock(i, &r);
        failed = look_at_conditions(i, &r, !round);
        for (int32_t k = 0; k < u->watched + u->timed; k++) i->acts[k] += r.fires[k];
        if (failed || !r.changes) break;
        found->changed = 1;
        failed = apply(i, &r, &found->states);
        /* A mode of the search may have no solution. */
        if (failed && r.flips && i->search.cycle) ac_restore(i, i->round), failed = AC_OK, i->why = 0;
    }
    if (round == AC_MODES) failed = ac_refuse(i, AC_UNSETTLED, UNSETTLED_TEXT);
    if (failed || ac_complete_event(i)) return AC_FAILED;
    double between;
    for (int32_t k = 0; k < u->watched; k++) i->crossed[k] = 0;
    i->now.first = 0;
    i->now.next = ac_next_instant(i, &between);
    found->planned = isfinite(i->now.next);
    found->next = i->now.next;
    return AC_OK;
}
