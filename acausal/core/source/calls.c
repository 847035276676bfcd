/* Functions of the caller of a run, which are called at events in the order of data flow. */
#include "hybrid.h"

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
