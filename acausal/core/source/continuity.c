/* Refuse jumps of what is differentiated at an event: a jump has no derivative. */
#include "instance.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#define JUMP 1e-5      /* least jump, over the values and their changes with nominal changes: the error of a located event is less */
#define ROUNDING 1e-11 /* of the terms: scheduled instants are known to that part of the time */
#define MOST (DBL_MAX / 8) /* sums of some values are finite */

static double finite(double x) { return isnan(x) ? 0 : fmin(fmax(x, -MOST), MOST); }

double ac_leeway(const ac_instance *i, int32_t guard) {
    const int32_t watched = i->of->watched;
    const double value = finite(i->guards[guard]), scale = finite(i->guards[watched + guard]);
    const double rate = finite(i->guards[2 * watched + guard]);
    return fmin(i->of->span, (scale + fabs(value) / JUMP) / fmax(fabs(rate), DBL_MIN));
}

/* What is differentiated, with new constants at the point before the round; its changes with nominal changes and in the leeway; the
   size of its terms. */
static void evaluate(ac_instance *i, const double *constants, double leeway, double *found) {
    const ac_unit *u = i->of;
    const ac_equations *e = &u->parts.model.equations;
    const ac_tape *t = &u->tape[AC_CONTINUOUS];
    const int32_t n = e->nx + e->nz;
    double *w = i->w[AC_CONTINUOUS], *input = w + t->constants;
    ac_put(input, i->round, n), input += n;
    *input++ = i->now.time;
    ac_put(input, i->p, e->np), input += e->np;
    ac_put(input, i->round + n, e->nc), input += e->nc;
    input += n;
    ac_put(input, constants, e->nc), input += e->nc;
    *input = leeway;
    ac_tape_run(t, w, 0, t->runs);
    for (int32_t k = 0; k < t->outputs; k++) found[k] = finite(w[t->output[k]]);
}

int32_t ac_refuse_discontinuity(ac_instance *i, double leeway) {
    const ac_unit *u = i->of;
    const int32_t outputs = u->tape[AC_CONTINUOUS].outputs, m = outputs / 3;
    const ac_equations *e = &u->parts.model.equations;
    double *before = i->continuous, *after = before + outputs, worst = 0, jump = 0;
    const char *origin = u->origin, *at = NULL;
    if (!m) return AC_OK;
    evaluate(i, i->round + e->nx + e->nz, leeway, before);
    evaluate(i, i->c, leeway, after);
    for (int32_t k = 0; k < m; k++, origin += strlen(origin) + 1) {
        const double far = fabs(after[k] - before[k]), size = fabs(before[k]) + fabs(after[k]) + before[m + k] + after[m + k];
        const double excess = far - JUMP * size - ROUNDING * (before[2 * m + k] + after[2 * m + k]);
        if (excess > worst) worst = excess, jump = far, at = origin;
    }
    if (!at) return AC_OK;
    char text[AC_MESSAGE];
    snprintf(text, sizeof text, "what is differentiated at %s jumps by %.4g; %s.", at, jump, origin);
    return ac_refuse(i, AC_DISCONTINUOUS, text);
}
