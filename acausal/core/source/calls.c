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

/* Tell functions of other libraries that a step without an event is accepted; an event that one asks for is at its end. */
int32_t ac_complete_step(ac_instance *i) {
    const double time = i->now.time;
    int32_t wanted = 0;
    if (!i->externals || isfinite(i->now.event)) return AC_OK;
    ac_stand(i, i->now.to);
    const int32_t failed = ac_know(i, AC_RATE); /* the last arguments are those of the end of the step */
    for (int32_t k = 0; k < i->externals && !failed; k++) wanted |= i->external[k]->completed(i->external[k]);
    ac_stand(i, time);
    if (wanted) i->now.next = fmin(i->now.next, i->now.to);
    return failed;
}
