/* An instance of a unit: its memory, and what is known at its present point. */
#include "instance.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define SHORTEST 0.004 /* part of the way to a point: nearer, two solutions meet */
#define MOST_STEPS 1e6 /* of one call, unless the setting says otherwise */

int32_t ac_fail(ac_instance *i, int32_t status, const char *text) {
    snprintf(i->message, sizeof i->message, "t = %.9g s: %s", i->now.time, text);
    return status;
}

int32_t ac_refuse_chatter(ac_instance *i) {
    return ac_fail(i, AC_FAILED, "conditions chatter: events follow one another without end.");
}

int32_t ac_refuse(ac_instance *i, int32_t why, const char *text) {
    i->why = why;
    return ac_fail(i, AC_FAILED, text);
}

static size_t most_of(size_t a, size_t b) { return a > b ? a : b; }

/* Lay out the memory; with NULL only measure it. */
static size_t lay_out(ac_instance *i, double *at) {
    const ac_unit *u = i->of;
    const ac_equations *e = &u->parts.model.equations;
    const size_t nx = (size_t)e->nx, nz = (size_t)e->nz, n = nx + nz, np = (size_t)e->np, nc = (size_t)e->nc;
    const size_t watched = (size_t)u->watched, all = n + np + nc + (size_t)u->jumps + 3 * watched + 2;
    const size_t modes = (u->switches ? nx : 0) + (size_t)u->switches + (size_t)u->discretes, moving = (size_t)u->square[AC_MOVING].n;
    size_t longest = most_of(ac_tape_length(e->values), ac_tape_length(e->slopes)), rows = 0, used = 0;
    for (int k = 0; k < AC_ROW_TAPES; k++) rows = most_of(rows, ac_tape_length(&u->row_tape[k]));
    for (int k = 0; k < AC_TAPES; k++) longest = most_of(longest, ac_tape_length(&u->tape[k]));
    for (int k = 0; k < AC_SQUARES; k++) longest = most_of(longest, ac_tape_length(&u->squared[k]));
    struct {
        double **to;
        size_t size;
    } part[] = {
        {&i->x, nx}, {&i->z, nz}, {&i->p, np}, {&i->c, nc}, {&i->truth, watched}, {&i->held, (size_t)u->timed},
        {&i->crossed, watched}, {&i->sure, n}, {&i->looks, 3 * watched}, {&i->least, watched}, {&i->width, watched},
        {&i->peak, watched}, {&i->event_y, n}, {&i->crossing, watched}, {&i->before, n}, {&i->after, n}, {&i->past, u->levels ? AC_PAST * (1 + n) : 0}, {&i->dense, AC_DENSE_ROWS * n}, {&i->past_rate, u->levels ? AC_POINTS * nx : 0}, {&i->rate, nx}, {&i->shown, (size_t)u->shown},
        {&i->guards, 3 * watched}, {&i->work, all}, {&i->other, all}, {&i->flips, (size_t)u->switches + watched + (size_t)u->timed}, {&i->acts, watched + (size_t)u->timed}, {&i->dw, longest}, {&i->values, ac_tape_length(e->values)},
        {&i->step_y, n}, {&i->order, 3 * n + 1}, {&i->sampled, AC_SLOTS * 3 * watched}, {&i->errors, AC_SLOTS * watched},
        {&i->row_w, rows}, {&i->kept, n + nc + 2 * watched}, {&i->round, n + nc + 2 * watched},
        {&i->continuous, 2 * (size_t)u->tape[AC_CONTINUOUS].outputs}, {&i->law_values, 5 * (size_t)u->laws}, {&i->redundant, (size_t)u->laws},
        {&i->mode, 2 * modes}, {&i->search.seen, AC_MODES * modes}, {&i->samples.time, AC_ROWS}, {&i->samples.x, AC_ROWS * nx},
        {&i->samples.z, AC_ROWS * nz}, {&i->samples.found, AC_ROWS * (2 * watched + 3)}, {&i->samples.solution, AC_ROWS * most_of(nz, moving)},
        {&i->samples.scale, 2 * most_of(nz, moving)},
    };
    for (size_t k = 0; k < sizeof part / sizeof *part; k++) {
        if (at) *part[k].to = at + used;
        used += part[k].size;
        if (part[k].to == &i->dense) i->saved = used;
    }
    for (int k = 0; k < AC_TAPES; k++) {
        if (at) i->w[k] = at + used;
        used += ac_tape_length(&u->tape[k]);
    }
    return used;
}

/* An instance of a unit, which has to stay; NULL without memory. */
ac_instance *ac_instance_make(const ac_unit *unit) {
    ac_instance *i = calloc(1, sizeof *i);
    if (!i) return NULL;
    i->of = unit;
    i->block = calloc(lay_out(i, NULL) + 1, sizeof *i->block);
    i->rodas = ac_rodas_make(&unit->parts.model.equations);
    i->search.place = calloc(3 * (size_t)unit->switches + 1, sizeof *i->search.place);
    i->stepper = (ac_stepper *)i->rodas;
    int good = i->block && i->rodas && i->search.place;
    for (int k = 0; k < AC_SQUARES; k++) {
        i->settler[k] = ac_settler_make(&unit->square[k]);
        good = good && i->settler[k];
    }
    if (!good) {
        ac_instance_free(i);
        return NULL;
    }
    lay_out(i, i->block);
    i->search.order = i->search.place + unit->switches, i->search.chosen = i->search.order + unit->switches;
    for (int32_t k = 0; k < unit->watched; k++) {
        if (unit->guard[k].on >= 0 && i->search.switches < unit->switches) i->search.place[i->search.switches++] = unit->guard[k].on;
    }
    const ac_equations *e = &unit->parts.model.equations;
    const ac_tape *values = e->values;
    memcpy(i->values, values->constant, (size_t)values->constants * sizeof(double));
    for (int k = 0; k < AC_TAPES; k++) {
        memcpy(i->w[k], unit->tape[k].constant, (size_t)unit->tape[k].constants * sizeof(double));
    }
    const ptrdiff_t inputs = (ptrdiff_t)e->nx + e->nz + 1 + e->np + e->nc;
    for (int k = AC_LAWS; k <= AC_CONTINUOUS; k++) ac_put(i->w[k] + unit->tape[k].constants + inputs, unit->nominal, e->nx + e->nz);
    ac_reset(i);
    return i;
}

void ac_instance_free(ac_instance *i) {
    if (!i) return;
    for (int k = 0; k < AC_SQUARES; k++) ac_settler_free(i->settler[k]);
    ac_stepper_free((ac_stepper *)i->rodas), ac_stepper_free(i->idas);
    free(i->search.place);
    free(i->block);
    free(i);
}

void ac_put(double *to, const double *from, int32_t count) {
    if (count && from) memcpy(to, from, (size_t)count * sizeof *to);
}

/* As the file has it. */
void ac_restart(ac_instance *i) {
    const ac_model *m = &i->of->parts.model;
    ac_put(i->x, m->x, m->equations.nx);
    ac_put(i->z, m->z, m->equations.nz);
    ac_put(i->c, m->c, m->equations.nc);
}

/* As it was made. */
int32_t ac_reset(ac_instance *i) {
    const ac_unit *u = i->of;
    const ac_model *m = &u->parts.model;
    memset(i->x, 0, i->saved * sizeof *i->x);
    memset(&i->now, 0, sizeof i->now);
    ac_restart(i);
    ac_put(i->p, m->p, m->equations.np);
    i->now.time = m->time, i->now.stop = NAN, i->now.crowd = -INFINITY, i->now.next = i->now.event = i->now.end = INFINITY;
    i->now.tolerance = u->tolerance, i->now.most = MOST_STEPS;
    i->now.phase = AC_SET_UP;
    for (int k = 0; k < AC_SQUARES; k++) i->settler[k]->lu->ready = 0;
    i->rodas->lu->ready = 0;
    i->prepared = 0, i->going = 0;
    i->message[0] = 0;
    return AC_OK;
}

const char *ac_message(const ac_instance *i) { return i->message; }
int32_t ac_phase(const ac_instance *i) { return i->now.phase; }
double ac_time(const ac_instance *i) { return i->now.time; }
int32_t ac_states(const ac_instance *i) { return i->of->parts.model.equations.nx; }
int32_t ac_indicators(const ac_instance *i) { return i->of->watched; }

/* Values changed: what followed from them is not known any more. */
void ac_moved(ac_instance *i) { i->now.known = 0; }

/* Parameters or constants changed. */
void ac_changed(ac_instance *i) {
    i->now.known = 0, i->now.integrates = 0, i->now.curved = 0, i->now.sure = 0, i->now.pasts = 0;
    i->prepared = 0;
}

static void exchange(ac_instance *i, double *saved, int back) {
    const ac_equations *e = &i->of->parts.model.equations;
    const int32_t watched = i->of->watched, length[] = {e->nx, e->nz, e->nc, watched, watched};
    double *const part[] = {i->x, i->z, i->c, i->truth, i->crossed};
    for (int k = 0; k < 5; saved += length[k++]) ac_put(back ? part[k] : saved, back ? saved : part[k], length[k]);
}

void ac_save(ac_instance *i, double *saved) { exchange(i, saved, 0); }

void ac_restore(ac_instance *i, double *saved) {
    exchange(i, saved, 1);
    ac_changed(i);
}

/* Evaluate a tape at the present. */
static void evaluate(ac_instance *i, const ac_tape *t, double *w, int32_t bit) {
    const ac_equations *e = &i->of->parts.model.equations;
    double *input = w + t->constants;
    ac_put(input, i->x, e->nx);
    ac_put(input + e->nx, i->z, e->nz);
    input += e->nx + e->nz;
    *input++ = i->now.time;
    if (!(i->prepared & bit)) {
        ac_put(input, i->p, e->np);
        ac_put(input + e->np, i->c, e->nc);
        ac_tape_run(t, w, 0, t->early);
        i->prepared |= bit;
    }
    ac_tape_run(t, w, t->early, t->runs);
}

const double *ac_run(ac_instance *i, int32_t tape) {
    evaluate(i, &i->of->tape[tape], i->w[tape], 1 << tape);
    return i->w[tape];
}

void ac_evaluate(const ac_instance *i, const ac_tape *t, double *w) {
    const ac_equations *e = &i->of->parts.model.equations;
    const int32_t length[] = {e->nx, e->nz, 1, e->np, e->nc};
    const double *const part[] = {i->x, i->z, &i->now.time, i->p, i->c};
    double *input = w + t->constants;
    ac_put(w, t->constant, t->constants);
    for (int k = 0; k < 5; input += length[k++]) ac_put(input, part[k], length[k]);
    ac_tape_run(t, w, 0, t->runs);
}

/* Solve a square system from the present values on. */
int32_t ac_solve(ac_instance *i, int32_t square) {
    const ac_unit *u = i->of;
    const ac_equations *e = &u->parts.model.equations;
    const int32_t lengths[] = {e->np, e->nc, e->nx, e->nz, 1}, stride[] = {0, 0, 0, 0, 0};
    const double *const part[] = {i->p, i->c, i->x, i->z, &i->now.time};
    const int32_t n = u->square[square].n, nx = square == AC_INITIAL ? e->nx : 0;
    double *size = i->other;
    int32_t settled = 1;
    if (!n) return AC_OK;
    for (int32_t k = 0; k < nx; k++) size[k] = fmax(fabs(i->x[k]), u->nominal[k]);
    for (int32_t k = 0; k < e->nz; k++) size[nx + k] = fmax(fabs(i->z[k]), u->size[k]);
    ac_settle_rows(i->settler[square], 1, 5, 2, lengths, stride, part, size, SETTLED, i->work, &settled);
    if (!settled) return AC_RETRY;
    ac_put(i->x, i->work, nx);
    ac_put(i->z, i->work + nx, e->nz);
    return AC_OK;
}

/* Solve for the algebraic unknowns along the way from the last point where that was done: importers may jump far. */
static int32_t follow(ac_instance *i) {
    const ac_equations *e = &i->of->parts.model.equations;
    const double time = i->now.time, *x = i->sure;
    double *to = i->order, *z = to + e->nx, s = 0;
    if (!i->now.sure) return AC_RETRY;
    ac_put(to, i->x, e->nx);
    ac_put(i->z, i->sure + e->nx, e->nz);
    int32_t failed = AC_OK;
    for (double step = 0.5; s < 1 && step >= SHORTEST;) {
        const double next = fmin(s + step, 1);
        ac_put(z, i->z, e->nz);
        for (int32_t k = 0; k < e->nx; k++) i->x[k] = next < 1 ? x[k] + next * (to[k] - x[k]) : to[k];
        i->now.time = next < 1 ? i->now.sure_time + next * (time - i->now.sure_time) : time;
        failed = ac_solve(i, AC_ALGEBRAIC);
        if (failed) ac_put(i->z, z, e->nz);
        s = failed ? s : next;
        step *= failed ? 0.5 : 2;
    }
    ac_put(i->x, to, e->nx);
    i->now.time = time;
    return failed;
}

void ac_find_scales(ac_instance *i) {
    const ac_unit *u = i->of;
    const int32_t n = u->parts.model.equations.nx + u->parts.model.equations.nz;
    const double *w = ac_run(i, AC_SCALES);
    double *scale = i->guards + u->watched;
    memset(scale, 0, (size_t)u->watched * sizeof *scale);
    for (int32_t j = 0; j < n; j++) {
        for (int32_t k = u->scale_start[j]; k < u->scale_start[j + 1]; k++) {
            scale[u->scale_row[k]] += fabs(w[u->tape[AC_SCALES].output[k]]) * u->nominal[j];
        }
    }
}

/* Find what is asked for. */
int32_t ac_know(ac_instance *i, int32_t what) {
    const ac_unit *u = i->of;
    const ac_equations *e = &u->parts.model.equations;
    if (!(i->now.known & AC_Z)) {
        if (ac_solve(i, AC_ALGEBRAIC) && follow(i)) return ac_fail(i, AC_RETRY, AC_UNSOLVED_TEXT);
        i->now.known |= AC_Z;
        ac_put(i->sure, i->x, e->nx);
        ac_put(i->sure + e->nx, i->z, e->nz);
        i->now.sure = 1, i->now.sure_time = i->now.time;
    }
    if (what & ~i->now.known & AC_RATE) {
        evaluate(i, e->values, i->values, 1 << AC_TAPES);
        for (int32_t k = 0; k < e->nx; k++) i->rate[k] = i->values[e->values->output[k]];
        if (!ac_all_finite(i->rate, e->nx)) return ac_fail(i, AC_RETRY, "a derivative has no finite value.");
    }
    if (what & ~i->now.known & AC_SHOW) {
        const double *w = ac_run(i, AC_SHOWN);
        for (int32_t k = 0; k < u->shown; k++) i->shown[k] = w[u->tape[AC_SHOWN].output[k]];
    }
    if (what & ~i->now.known & AC_GUARD) {
        const double *w = ac_run(i, AC_GUARDS);
        for (int32_t k = 0; k < u->watched; k++) i->guards[k] = w[u->tape[AC_GUARDS].output[k]];
        ac_find_scales(i);
    }
    i->now.known |= what;
    return AC_OK;
}
