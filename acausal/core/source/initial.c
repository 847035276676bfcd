/* Values at the start: one square system, followed along the parameters from the solution that the file has. */
#include "instance.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define FIRST 0.0625    /* of the way: the first step */
#define SHORTEST 1e-10  /* of the way, as to a height of 1e9 m: two solutions meet, or there is none beyond */
#define FAR 0.1         /* change of a state over its size in a step: more may lead to another solution */

/* Parameters, and the time, on the way from those of the file to those that are wanted. */
static void stand(ac_instance *i, const double *p, double time, double s) {
    const ac_model *m = &i->of->parts.model;
    for (int32_t k = 0; k < m->equations.np; k++) i->p[k] = s < 1 ? m->p[k] + s * (p[k] - m->p[k]) : p[k];
    i->now.time = s < 1 ? m->time + s * (time - m->time) : time;
    i->prepared = 0;
}

static int differs(const ac_instance *i) {
    const ac_model *m = &i->of->parts.model;
    for (int32_t k = 0; k < m->equations.np; k++) {
        if (i->p[k] != m->p[k] && i->of->role[k] != AC_INNER) return 1;
    }
    return i->now.time != m->time;
}

/* Largest change of a state over its size. */
static double change(const ac_instance *i, const double *x) {
    double most = 0;
    for (int32_t k = 0; k < ac_states(i); k++) {
        most = fmax(most, fabs(i->x[k] - x[k]) / fmax(i->of->nominal[k], fabs(x[k])));
    }
    return most;
}

/* Follow the solution to the parameters p; steps are shortened where states change much. */
static int32_t follow(ac_instance *i, const double *p, double time) {
    const ac_equations *e = &i->of->parts.model.equations;
    const size_t n = (size_t)e->nx + (size_t)e->nz;
    double *kept = i->before; /* the interpolant is not there yet */
    for (double s = 0, step = FIRST; s < 1;) {
        memcpy(kept, i->x, (size_t)e->nx * sizeof *kept);
        memcpy(kept + e->nx, i->z, (size_t)e->nz * sizeof *kept);
        const double to = s + step < 1 ? s + step : 1;
        stand(i, p, time, to);
        const int32_t failed = ac_solve(i, AC_INITIAL);
        const double moved = failed ? INFINITY : change(i, kept);
        if (moved <= FAR) {
            s = to;
            if (moved < 0.25 * FAR) step *= 2;
            continue;
        }
        memcpy(i->x, kept, (size_t)e->nx * sizeof *kept);
        memcpy(i->z, kept + e->nx, (n - (size_t)e->nx) * sizeof *kept);
        step /= 2;
        if (step >= SHORTEST) continue;
        i->now.time = time;
        return ac_fail(i, AC_FAILED, "no start values were found for these parameters.");
    }
    return AC_OK;
}

/* Switches that the clock decides, from the start on. */
static void clock(ac_instance *i) {
    const ac_unit *u = i->of;
    double between;
    const double time = i->now.time;
    i->now.next = ac_next_instant(i, &between);
    i->now.time = between;
    const double *w = ac_run(i, AC_TIMED);
    i->now.time = time;
    for (int32_t k = 0; k < u->tape[AC_TIMED].outputs; k++) {
        i->held[k] = w[u->tape[AC_TIMED].output[k]] > 0.5;
        const int32_t on = u->guard[u->watched + k].on;
        if (on >= 0) i->c[on] = i->held[k];
    }
    i->prepared = 0;
}

static int is_timed(const ac_unit *u, int32_t on) {
    for (int32_t k = u->watched; k < u->watched + u->timed; k++) {
        if (u->guard[k].on == on) return 1;
    }
    return 0;
}

/* Whether a switch or discrete variable does not fit what was found for it. */
static int is_wrong(const ac_instance *i, int32_t k, double found) {
    const ac_unit *u = i->of;
    return !(k < u->switches && is_timed(u, k)) && !(fabs(i->c[k] - found) <= 1e-9 * fabs(found));
}

/* Find the switches and discrete variables that the values imply; whether they are the present ones. */
static int fits(ac_instance *i, double *found) {
    const ac_unit *u = i->of;
    const double *w = ac_run(i, AC_HEAD);
    int same = 1;
    for (int32_t k = 0; k < u->switches + u->discretes; k++) {
        found[k] = w[u->tape[AC_HEAD].output[k]];
        if (is_wrong(i, k, found[k])) same = 0;
        else found[k] = i->c[k];
    }
    return same;
}

/* Find values at the start with switches and discrete variables that they imply. */
static int32_t search(ac_instance *i) {
    const int32_t n = i->of->switches + i->of->discretes;
    double *mode = i->mode;
    ac_begin_search(i, n);
    for (ac_put(mode, i->c, n); ac_next_mode(&i->search, i->c, mode);) {
        ac_put(i->c, mode, n);
        i->prepared = 0;
        const int32_t failed = ac_solve(i, AC_INITIAL);
        if (failed && !i->search.cycle) return ac_fail(i, failed, "the equations at the start have no solution.");
        if (!failed && fits(i, mode)) return AC_OK;
    }
    return ac_fail(i, AC_FAILED, "no switches fit the values at the start.");
}

/* Refuse parameters beyond their limits and what the model requires of them, or what it requires of variables at the start. */
int32_t ac_limits(ac_instance *i, int at_start) {
    const ac_tape *t = &i->of->tape[AC_LIMITS];
    const double *w = ac_run(i, AC_LIMITS), *bound = i->of->bound;
    const char *said = i->of->limited;
    for (int32_t k = 0; k < t->outputs; k++, bound += 3, said += strlen(said) + 1) {
        const double value = w[t->output[k]];
        const int above = bound[1] > 0, right = above ? value > bound[0] : value >= bound[0];
        if (right || (bound[2] > AC_REQUIRED) != at_start) continue;
        char text[AC_MESSAGE];
        const char *how = above ? "greater than" : "at least";
        if (bound[2] > AC_LIMITED) snprintf(text, sizeof text, "%s", said);
        else snprintf(text, sizeof text, "`%s` is %g; it must be %s %g.", said, value, how, bound[0]);
        return ac_fail(i, AC_REFUSED, text);
    }
    return AC_OK;
}

/* Decide the set-valued laws at rest, and find the values with them. */
static int32_t decide(ac_instance *i) {
    ac_read_laws(i, i->c, i->law_values);
    const int32_t failed = ac_decide_laws(i, i->law_values);
    i->now.known |= AC_FIRST;
    return failed ? failed : ac_know(i, AC_RATE | AC_GUARD);
}

int32_t ac_initial(ac_instance *i) {
    if (i->now.known & AC_FIRST) return AC_OK;
    if (ac_limits(i, 0)) return AC_REFUSED;
    const ac_unit *u = i->of;
    double *p = i->dw; /* the wanted ones, while i->p is on the way */
    const double time = i->now.time;
    int32_t failed = AC_OK;
    memcpy(p, i->p, (size_t)u->parts.model.equations.np * sizeof *p);
    ac_restart(i);
    i->prepared = 0;
    if (differs(i)) failed = follow(i, p, time);
    stand(i, p, time, 1);
    clock(i);
    if (!failed) failed = search(i);
    if (failed) return AC_FAILED;
    if (ac_limits(i, 1)) return AC_REFUSED;
    i->now.known = AC_FIRST;
    failed = ac_know(i, AC_RATE | AC_GUARD);
    if (failed) return AC_FAILED;
    for (int32_t k = 0; k < u->watched; k++) {
        const ac_guard *g = &u->guard[k];
        const double value = i->guards[k];
        i->truth[k] = g->on >= 0 ? i->c[g->on] : !g->at_start && (value < 0 || (value == 0 && g->inclusive));
    }
    return decide(i) ? AC_FAILED : AC_OK;
}
