/* Functions of the caller of a run, which are called at events in the order of data flow; and those of other libraries. */
#include "hybrid.h"

#include <math.h>

void ac_run_functions(ac_instance *i, ac_function *function, double *arguments, double *results) {
    i->function = function, i->arguments = arguments, i->results = results;
}

/* Let what the last call left come out, where outputs are delayed; elsewhere both are one variable. */
static void put_out(ac_instance *i, const ac_call *call) {
    double *discrete = i->c + i->of->switches;
    for (int32_t k = call->result; k < call->result + call->results; k++) {
        const int32_t *place = i->of->result + 2 * k;
        discrete[place[0]] = discrete[place[1]];
    }
}

/* Call what the conditions that fire call. Arguments are values before the event, but for outputs of functions, which have changed. */
int32_t ac_call_functions(ac_instance *i, const double *fires) {
    const ac_unit *u = i->of;
    const ac_tape *t = &u->tape[AC_ARGUMENTS];
    if (!i->function) return AC_OK; /* they keep their results */
    for (int32_t k = 0; k < u->calls; k++) {
        if (fires[u->call[k].guard] > 0) put_out(i, &u->call[k]);
    }
    for (int32_t k = 0; k < u->calls; k++) {
        const ac_call *call = &u->call[k];
        if (!(fires[call->guard] > 0)) continue;
        ac_changed(i);
        const double *w = ac_run(i, AC_ARGUMENTS);
        for (int32_t j = 0; j < t->outputs; j++) i->arguments[j] = w[t->output[j]];
        if (i->function(k, i->now.time)) {
            i->acts[call->guard] = 1;
            return ac_refuse(i, AC_FUNCTION, "a function of the caller fails.");
        }
        for (int32_t j = call->result; j < call->result + call->results; j++) i->c[u->switches + u->result[2 * j + 1]] = i->results[j];
    }
    return AC_OK;
}

void ac_run_externals(ac_instance *i, int32_t count, ac_external *const *external) { i->externals = count, i->external = external; }

/* Tell functions of other libraries where the run stands; return whether one asks for an event. */
static int32_t tell(ac_instance *i, int32_t part, int32_t parts, int32_t *wanted) {
    const int32_t failed = ac_know(i, AC_RATE); /* their last arguments are those of the present */
    for (int32_t k = 0; k < i->externals && !failed; k++) {
        if (part == parts || i->external[k]->parts == parts) *wanted |= i->external[k]->completed(i->external[k], part);
    }
    return failed;
}

/* Tell them of an accepted step, up to an event in it, part by part; an event that one asks for is at its end. */
int32_t ac_complete_step(ac_instance *i) {
    const double time = i->now.time, end = fmin(i->now.event, i->now.to);
    int32_t wanted = 0, parts = 1, failed = AC_OK;
    if (!i->externals) return AC_OK;
    for (int32_t k = 0; k < i->externals; k++) parts = i->external[k]->parts > parts ? i->external[k]->parts : parts;
    for (int32_t part = 1; part <= parts && !failed; part++) {
        ac_stand(i, part < parts ? i->now.from + part * (end - i->now.from) / parts : end);
        failed = tell(i, part, parts, &wanted);
    }
    ac_stand(i, time);
    if (wanted) i->now.next = fmin(i->now.next, end);
    return failed;
}

/* Tell those that follow the step part by part of what has changed at an event. */
int32_t ac_complete_event(ac_instance *i) {
    if (!i->externals) return AC_OK;
    ac_moved(i);
    const int32_t failed = ac_know(i, AC_RATE);
    for (int32_t k = 0; k < i->externals && !failed; k++) {
        if (i->external[k]->parts > 1) (void)i->external[k]->completed(i->external[k], 0);
    }
    ac_changed(i); /* what follows from constants alone may follow from what they keep, too */
    return failed;
}
