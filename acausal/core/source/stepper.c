/* What all steppers share: the loop over steps, values at outputs, integrals, and steps that are kept. */
#include "stepper.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define SAME (8 * DBL_EPSILON) /* of a time: what rounding makes of the times of kinks */

double *ac_stepper_take(ac_stepper *s, const ac_method *method, const ac_equations *equations, size_t more) {
    const ac_equations *e = &s->of;
    s->method = method, s->of = *equations, s->n = e->nx + e->nz;
    const ac_tape *tapes[] = {e->values, e->slopes, e->powers, e->kinks};
    double **arrays[] = {&s->values, &s->slopes, &s->powers, &s->kinks};
    const int count = sizeof tapes / sizeof *tapes;
    const size_t n = (size_t)s->n + 1;
    size_t length = (3 + (size_t)method->rows) * n + more;
    for (int k = 0; k < count; k++) length += tapes[k] ? ac_tape_length(tapes[k]) : 0;
    double *at = s->block = calloc(length, sizeof *at);
    if (!at) return NULL;
    for (int k = 0; k < count; k++) {
        *arrays[k] = at;
        if (!tapes[k]) continue;
        memcpy(at, tapes[k]->constant, (size_t)tapes[k]->constants * sizeof *at);
        at += ac_tape_length(tapes[k]);
    }
    s->y = at, s->next = s->y + n, s->work = s->next + n, s->last.dense = s->work + n;
    return s->last.dense + (size_t)method->rows * n;
}

void ac_stepper_renew(ac_stepper *s) { s->method->renew(s); }

void ac_stepper_free(ac_stepper *s) {
    if (!s) return;
    s->method->free(s);
    free(s->block);
    free(s);
}

/* Write parameters and constants of a segment, and evaluate what follows from them alone. */
static void prepare(const ac_stepper *s, const ac_tape *tape, double *w, const double *p, const double *c) {
    if (!tape) return;
    double *input = w + tape->constants + s->n + 1;
    if (s->of.np) memcpy(input, p, (size_t)s->of.np * sizeof *w);
    if (s->of.nc) memcpy(input + s->of.np, c, (size_t)s->of.nc * sizeof *w);
    ac_tape_run(tape, w, 0, tape->early);
}

void ac_evaluate_tape(const ac_stepper *s, const ac_tape *tape, double *w, const double *y, double t) {
    memcpy(w + tape->constants, y, (size_t)s->n * sizeof *w);
    w[tape->constants + s->n] = t;
    ac_tape_run(tape, w, tape->early, tape->runs);
}

void ac_equations_at(ac_stepper *s, const double *y, double t, double *found) {
    const ac_tape *tape = s->of.values;
    ac_evaluate_tape(s, tape, s->values, y, t);
    for (int32_t k = 0; k < s->n; k++) found[k] = s->values[tape->output[k]];
    s->progress.values++;
}

/* Find the next kink, at a time that rounding does not bring before it. */
static void find_kink(ac_stepper *s) {
    const ac_tape *tape = s->of.kinks;
    const double near = SAME * fabs(s->t);
    s->kink = INFINITY;
    if (!tape) return;
    ac_evaluate_tape(s, tape, s->kinks, s->y, s->t + near);
    for (int32_t k = 0; k < tape->outputs; k++) {
        const double next = s->kinks[tape->output[k]];
        if (next + near > s->t + near && next + near < s->kink) s->kink = next + near;
    }
}

static void put(ac_stepper *s, const double *x, const double *z) {
    if (s->of.nx) memcpy(s->y, x, (size_t)s->of.nx * sizeof *x);
    if (s->of.nz) memcpy(s->y + s->of.nx, z, (size_t)s->of.nz * sizeof *z);
}

/* Where an integration begins; nothing is computed yet. */
void ac_stepper_begin(ac_stepper *s, const ac_request *request, const double *x, const double *z, const double *p, const double *c) {
    s->request = *request;
    memset(&s->progress, 0, sizeof s->progress);
    put(s, x, z);
    prepare(s, s->of.values, s->values, p, c);
    prepare(s, s->of.slopes, s->slopes, p, c);
    prepare(s, s->of.powers, s->powers, p, c);
    prepare(s, s->of.kinks, s->kinks, p, c);
    s->t = s->progress.time = request->time[0];
    s->gathered[0] = s->gathered[1] = 0;
    s->written_at = 0;
    find_kink(s);
    s->method->begin(s);
}

/* Go on from other values at the time that was reached, near those that were. */
void ac_stepper_move(ac_stepper *s, const double *x, const double *z) {
    put(s, x, z);
    s->method->move(s);
}

/* Take so many steps between two outputs at most from now on. */
void ac_stepper_allow(ac_stepper *s, int64_t most) { s->request.most = most; }

double ac_end(const ac_stepper *s) { return s->request.time[s->request.outputs]; }

double ac_step_end(const ac_stepper *s) { return fmin(ac_end(s), s->kink); }

void ac_accept(ac_stepper *s, double time, double length) {
    double *const before = s->y;
    s->y = s->next, s->next = before;
    s->last.from = s->t, s->last.length = length, s->last.before = before, s->last.after = s->y;
    s->t = time;
    if (s->t >= s->kink) find_kink(s);
}

void ac_interpolate(int32_t n, int32_t rows, const double *before, const double *after, const double *dense, double s, int32_t first,
                    int32_t count, double *y) {
    for (int32_t k = first; k < first + count; k++) {
        double d = dense[(size_t)(rows - 1) * (size_t)n + (size_t)k];
        for (int32_t j = rows - 2; j >= 0; j--) d = dense[(size_t)j * (size_t)n + (size_t)k] + s * d;
        *y++ = (1 - s) * before[k] + s * (after[k] + (1 - s) * d);
    }
}

double ac_lobatto(int k, double *weight) {
    const double at[AC_NODES] = {0, 0.5 - 0.5 / sqrt(5), 0.5 + 0.5 / sqrt(5), 1};
    *weight = k == 0 || k == AC_NODES - 1 ? 1. / 12 : 5. / 12;
    return at[k];
}

static void interpolate(const ac_stepper *s, double part) {
    const ac_last_step *l = &s->last;
    ac_interpolate(s->n, s->method->rows, l->before, l->after, l->dense, part, 0, s->n, s->work);
}

/* Integral of the powers over a part of the last step, on its interpolant. */
static void gather(ac_stepper *s, double from, double to) {
    const ac_tape *tape = s->of.powers;
    for (int k = 0; k < AC_NODES; k++) {
        double weight;
        const double part = from + ac_lobatto(k, &weight) * (to - from);
        interpolate(s, part);
        ac_evaluate_tape(s, tape, s->powers, s->work, s->last.from + part * s->last.length);
        for (int32_t j = 0; j < tape->outputs && j < 2; j++) {
            s->gathered[j] += weight * (to - from) * s->last.length * s->powers[tape->output[j]];
        }
    }
}

/* Write the outputs that lie in the last step, and what was gathered up to them. */
static void write(ac_stepper *s) {
    const ac_request *q = &s->request;
    const size_t nx = (size_t)s->of.nx, nz = (size_t)s->of.nz;
    int32_t *written = &s->progress.written;
    const int due = q->time[*written + 1] <= s->t;
    const int32_t before = *written / q->share;
    double from = 0;
    if (due || s->of.powers || q->step_dense) s->method->interpolate(s);
    for (; *written < q->outputs && q->time[*written + 1] <= s->t; ++*written) {
        const double part = fmin((q->time[*written + 1] - s->last.from) / s->last.length, 1);
        if (s->of.powers) gather(s, from, part);
        from = part;
        if (q->taken) q->taken[*written] = (double)s->progress.steps + part;
        if (q->x) {
            interpolate(s, part);
            if (nx) memcpy(q->x + (size_t)*written * nx, s->work, nx * sizeof(double));
            if (nz) memcpy(q->z + (size_t)*written * nz, s->work + nx, nz * sizeof(double));
            memcpy(q->integral + 2 * (size_t)*written, s->gathered, sizeof s->gathered);
        }
    }
    if (s->of.powers && from < 1) gather(s, from, 1);
    if (*written / q->share > before) s->written_at = s->progress.steps;
}

/* Keep where the last step ended. */
static void keep(ac_stepper *s) {
    const ac_request *q = &s->request;
    const size_t n = (size_t)s->n, k = (size_t)s->progress.kept, dense = (size_t)s->method->rows * n;
    if (s->progress.kept == q->room) return;
    q->step_time[k] = s->t;
    memcpy(q->step_y + k * n, s->y, n * sizeof(double));
    if (q->step_dense) memcpy(q->step_dense + k * dense, s->last.dense, dense * sizeof(double));
    s->progress.kept++;
}

/* Go on for some steps at most, refused ones among them; AC_MORE where there is more to do. */
int32_t ac_stepper_go(ac_stepper *s, int64_t steps, ac_progress *progress) {
    const int64_t most = s->progress.steps + s->progress.refused + steps;
    int32_t found = AC_DONE;
    s->progress.kept = 0;
    while (s->progress.written < s->request.outputs) {
        const int full = s->progress.steps + s->progress.refused >= most;
        found = full ? AC_MORE : s->progress.steps - s->written_at >= s->request.most ? AC_MANY : s->method->advance(s);
        if (full || (found != AC_DONE && found != AC_MORE)) break;
        if (found == AC_MORE) continue;
        write(s);
        s->progress.steps++;
        keep(s);
    }
    s->progress.time = s->t;
    *progress = s->progress;
    return found;
}
