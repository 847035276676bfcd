/* A run that records rows at outputs and after events, in slices. */
#include "hybrid.h"
#include "ida.h"

#include <math.h>
#include <string.h>

/* Choose the stepper, which is made when it is first asked for. */
static int32_t choose(ac_instance *i, const ac_run_method *method) {
    const int32_t multistep = method->method == AC_IDAS;
    if (multistep && !i->idas) i->idas = ac_ida_make(&i->of->parts.model.equations);
    if (multistep && !i->idas) return AC_FAILED;
    if (multistep) ac_stepper_renew(i->idas);
    i->stepper = multistep ? i->idas : &i->rodas->s;
    i->multistep = method->multistep;
    return AC_OK;
}

int32_t ac_run_begin(ac_instance *i, const ac_run_method *method, double time, const double *x, const double *z, const double *p,
                     const double *c, const double *truth) {
    const ac_equations *e = &i->of->parts.model.equations;
    double between;
    ac_reset(i);
    if (choose(i, method)) return AC_FAILED;
    ac_put(i->x, x, e->nx), ac_put(i->z, z, e->nz), ac_put(i->p, p, e->np), ac_put(i->c, c, e->nc);
    ac_put(i->truth, truth, i->of->watched);
    i->now.time = i->now.from = i->now.to = time, i->now.longer = method->step;
    i->now.tolerance = method->tolerance, i->now.damping = method->damps, i->now.simulates = 1, i->now.phase = AC_RUNNING;
    i->now.blind = method->blind;
    i->now.next = ac_next_instant(i, &between);
    i->energy[0] = i->energy[1] = 0;
    memset(&i->counts, 0, sizeof i->counts);
    return AC_OK;
}

static void put_row(ac_instance *i, double time) {
    const ac_equations *e = &i->of->parts.model.equations;
    const ac_run_request *r = i->recorder->run;
    const ptrdiff_t k = i->recorder->state->rows++;
    r->row_time[k] = time;
    ac_put(r->row_x + k * e->nx, i->x, e->nx), ac_put(r->row_z + k * e->nz, i->z, e->nz), ac_put(r->row_c + k * e->nc, i->c, e->nc);
    ac_put(r->row_work + 2 * k, i->energy, 2);
}

/* Whether there is room for what one move may record: an output, an event and the end. */
int ac_is_full(const ac_instance *i) {
    const struct ac_recorder *r = i->recorder;
    return r->state->rows + 3 > r->run->room || r->state->events + 1 > r->run->room;
}

void ac_hold(ac_instance *i) {
    struct ac_recorder *r = i->recorder;
    r->rows = r->state->rows, r->events = r->state->events, r->energy[0] = i->energy[0], r->energy[1] = i->energy[1];
}

void ac_record_event(ac_instance *i, int32_t changed) {
    const ac_equations *e = &i->of->parts.model.equations;
    struct ac_recorder *r = i->recorder;
    r->since = 0;
    if (changed) r->run->event_time[r->state->events++] = i->now.time;
    if (changed && i->now.time < r->output - ac_near(i)) put_row(i, i->now.time);
    ac_put(i->before, i->x, e->nx), ac_put(i->before + e->nx, i->z, e->nz);
    ac_put(i->after, i->before, e->nx + e->nz);
    i->now.from = i->now.to = i->now.time;
    ac_hold(i);
}

void ac_retreat(ac_instance *i) {
    struct ac_recorder *r = i->recorder;
    r->state->rows = r->rows, r->state->events = r->events, i->energy[0] = r->energy[0], i->energy[1] = r->energy[1];
    if (i->now.time > i->now.from) ac_stand(i, i->now.from);
    i->now.integrates = i->now.curved = 0;
}

int32_t ac_run_go(ac_instance *i, const ac_run_request *run, ac_run_state *state) {
    struct ac_recorder recorder = {.run = run, .state = state, .left = run->steps, .since = state->since};
    int32_t failed = AC_OK, event = 0, output = 0, end = AC_RUN_END;
    i->recorder = &recorder, i->now.stop = run->end, i->now.weak = state->weak;
    state->rows = state->events = state->hasty = 0;
    i->why = 0;
    ac_hold(i);
    while (!failed && i->now.time < run->end) {
        while (output < run->outputs && run->time[output] <= i->now.time) output++;
        const int32_t is_output = output < run->outputs && run->time[output] <= run->end;
        const double to = is_output ? run->time[output] : run->end;
        i->now.since = output ? run->time[output - 1] : i->now.time;
        recorder.output = to;
        failed = ac_is_full(i) ? AC_PAUSE : ac_go(i, to, 0, &event);
        /* What happens at the end begins with unknowns that satisfy their equations. */
        if (!failed && to >= run->end) failed = ac_know(i, AC_Z);
        if (!failed) put_row(i, to), recorder.since = 0;
    }
    if (failed == AC_PAUSE) end = ac_is_full(i) ? AC_RUN_FULL : AC_RUN_PAUSED;
    else if (failed == AC_LEAVE) end = AC_RUN_EVENT;
    else if (failed == AC_EXCHANGE) end = AC_RUN_UNFIT;
    else if (failed) end = AC_RUN_DOUBT, ac_retreat(i);
    i->recorder = NULL;
    state->time = i->now.time, state->step = i->now.longer, state->hasty = i->now.hasty, state->weak = i->now.weak;
    state->why = i->why;
    state->supplied = i->energy[0], state->dissipated = i->energy[1];
    state->steps = i->counts.steps, state->refused = i->counts.refused;
    state->factors = i->counts.factors, state->values = i->counts.values, state->evaluations = i->counts.evaluations;
    state->begun = i->counts.begun, state->since = recorder.since;
    return end;
}

int32_t ac_run_happen(ac_instance *i, const double *c, const double *fires, const double *crossed, double *acts, int32_t *why) {
    const ac_unit *u = i->of;
    const int32_t open = ac_laws_are_open(i);
    ac_happened found = {0};
    int32_t failed = AC_OK;
    ac_put(i->crossed, crossed, u->watched);
    i->clock = (ac_clock){c, fires}, i->why = 0;
    if (open) ac_read_laws(i, i->c, i->law_values), failed = ac_decide_laws(i, i->law_values);
    if (!failed) failed = ac_happen(i, &found);
    if (!failed) failed = ac_know(i, AC_Z);
    i->clock = (ac_clock){0};
    ac_put(acts, i->acts, u->watched + u->timed);
    *why = i->why;
    return failed ? -1 : found.changed || open;
}

void ac_run_values(const ac_instance *i, double *x, double *z, double *c, double *truth, double *crossed) {
    const ac_equations *e = &i->of->parts.model.equations;
    ac_put(x, i->x, e->nx), ac_put(z, i->z, e->nz), ac_put(c, i->c, e->nc);
    ac_put(truth, i->truth, i->of->watched), ac_put(crossed, i->crossed, i->of->watched);
}

double ac_run_undefined(const ac_instance *i, double *x, double *z) {
    const ac_equations *e = &i->of->parts.model.equations;
    ac_put(x, i->event_y, e->nx), ac_put(z, i->event_y + e->nx, e->nz);
    return i->now.undefined;
}
