/* A run over instants that discrete variables plan, as long as nothing else happens. As `Course` of Python does it, which goes on
   wherever something is in doubt. */
#include "sampler.h"

#include "condition.h"
#include "file.h"
#include "rodas.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define GOLDEN 0.6180339887498949 /* no periodic motion stays in step with looks that it divides */

/* Length of the longest array of the tapes that share one. */
static size_t longest(const ac_sampled *of) {
    const ac_tape *tape[] = {of->watched, of->acts, of->project, of->energies};
    size_t most = 0;
    for (int k = 0; k < 4; k++) most = tape[k] && ac_tape_length(tape[k]) > most ? ac_tape_length(tape[k]) : most;
    return most;
}

ac_sampler *ac_sampler_make(const ac_sampled *sampled) {
    ac_sampler *s = calloc(1, sizeof *s);
    if (!s) return NULL;
    const ac_equations *e = sampled->equations;
    const size_t nx = (size_t)e->nx, nz = (size_t)e->nz, n = nx + nz, nc = (size_t)e->nc, m = (size_t)sampled->conditions;
    const size_t moving = sampled->moving ? (size_t)sampled->moving->n : 0, picked = moving > nz ? moving : nz;
    const size_t row = 1 + n + 2 * m, acted = (size_t)sampled->acts->outputs, tape = longest(sampled);
    s->of = *sampled;
    s->rodas = ac_rodas_make(e);
    s->whole = sampled->whole ? ac_settler_make(sampled->whole) : NULL;
    s->needed = sampled->needed ? ac_settler_make(sampled->needed) : NULL;
    s->moving = sampled->moving ? ac_settler_make(sampled->moving) : NULL;
    s->powering = sampled->powering ? ac_settler_make(sampled->powering) : NULL;
    s->settled = calloc(LOOKS + 1 + 2 * m, sizeof *s->settled);
    s->block = calloc((LOOKS + 2) * row + nc + tape + 2 * nz + (LOOKS + 1) * picked
                      + 2 * moving + acted + m + 5 * n + nx + 3 * (LOOKS + 1) + 1, sizeof(double));
    if (!s->rodas || !s->settled || !s->block || (sampled->whole && !s->whole) || (sampled->needed && !s->needed)
        || (sampled->moving && !s->moving) || (sampled->powering && !s->powering)) {
        ac_sampler_free(s);
        return NULL;
    }
    s->risen = s->settled + LOOKS + 1, s->truth = s->risen + m;
    double *at = s->block;
    ac_looks *both[] = {&s->now, &s->looks};
    for (size_t k = 0, rows = 1; k < 2; k++, rows = LOOKS + 1) {
        both[k]->time = at, both[k]->x = at + rows, both[k]->z = both[k]->x + rows * nx, both[k]->found = both[k]->z + rows * nz;
        at += rows * row;
    }
    s->c = at, s->tape = s->c + nc, s->size = s->tape + tape;
    s->sizes = s->size + nz, s->picked = s->sizes + nz, s->rates = s->picked + (LOOKS + 1) * picked, s->ones = s->rates + moving;
    s->acted = s->ones + moving, s->width = s->acted + acted;
    s->step_y = s->width + m, s->before = s->step_y + n, s->dense = s->before + n, s->coordinates = s->dense + 3 * n;
    s->energies = s->coordinates + nx;
    for (size_t k = 0; k < moving; k++) s->ones[k] = 1;
    return s;
}

void ac_sampler_free(ac_sampler *s) {
    if (!s) return;
    ac_rodas_free(s->rodas);
    ac_settler_free(s->whole), ac_settler_free(s->needed), ac_settler_free(s->moving), ac_settler_free(s->powering);
    free(s->settled), free(s->block);
    free(s);
}

static void copy(double *to, const double *from, int32_t count) {
    if (count) memcpy(to, from, (size_t)count * sizeof *to);
}

/* Evaluate what acts at the present, and how far conditions may be off. */
static void act(ac_sampler *s) {
    const ac_equations *e = s->of.equations;
    const int32_t length[6] = {e->np, e->nc, e->nx, e->nz, 1, e->nx + e->nz}, stride[6] = {0};
    const double *part[6] = {s->request.p, s->c, s->now.x, s->now.z, s->now.time, s->request.nominal};
    ac_tape_rows(s->of.acts, s->tape, 1, 6, length, stride, part, s->acted);
    for (int32_t k = 0; k < s->of.conditions; k++) {
        const double scale = s->acted[k];
        s->width[k] = s->request.tolerance * (scale > 0 ? fmin(scale, DBL_MAX) : fmin(s->request.span, 1));
    }
}

/* Bring the present on the equations, and look at its conditions. */
static int stand(ac_sampler *s) {
    if (!ac_sampler_settle(s, s->whole, s->of.whole, 1, &s->now) || !ac_sampler_watch(s, 1, &s->now)) return 0;
    act(s);
    return 1;
}

/* Bring the coordinates of closed loops where the constraints have them at the present; whether they were nearly there. */
static int project(ac_sampler *s) {
    const ac_equations *e = s->of.equations;
    const int32_t length[5] = {e->np, e->nc, e->nx, e->nz, 1}, stride[5] = {0};
    const double *part[5] = {s->request.p, s->c, s->now.x, s->now.z, s->now.time};
    if (!s->of.project) return 1;
    ac_tape_rows(s->of.project, s->tape, 1, 5, length, stride, part, s->coordinates);
    for (int32_t k = 0; k < s->of.project->outputs; k++) {
        double *x = s->now.x + s->of.coordinate[k];
        const double q = s->coordinates[k], nominal = s->request.nominal[s->of.coordinate[k]];
        if (!(fabs(q - *x) <= s->request.apart * (nominal + fabs(q)))) return 0;
        *x = q;
    }
    return 1;
}

/* The next instant that is planned. */
static double planned(const ac_sampler *s) {
    double next = INFINITY;
    for (int32_t k = s->of.conditions + s->of.jumps; k < s->of.acts->outputs; k++) {
        const double instant = s->acted[k];
        if (instant > s->now.time[0] + s->request.shortest && instant < next) next = instant;
    }
    return next;
}

/* Whether a condition holds from now on. */
static int holds(const ac_sampler *s, int32_t k, int before) {
    const ac_samples *q = &s->request;
    const double value = s->now.found[k], change = s->now.found[s->of.conditions + k] * q->span, width = s->width[k];
    const double soon = s->of.is_clocked[k] ? q->added * fmax(fabs(s->now.time[0]) / q->span, 1) : q->soon;
    return ac_holds(value, change, width, q->moves * width, fabs(value) <= fabs(change) * soon, before);
}

/* Let variables jump at the present; whether it is sure what happens. */
static int happen(ac_sampler *s, int32_t *truth) {
    const ac_sampled *of = &s->of;
    const double *jump = s->acted + of->conditions;
    int32_t changes = 0;
    if (!project(s)) return 0;
    for (int32_t k = 0; k < of->conditions; k++) {
        const int32_t now = holds(s, k, truth[k]);
        if (of->is_switch[k] && now != truth[k]) return 0;
        for (int32_t j = of->jump[k]; now && !truth[k] && j < of->jump[k + 1]; j++) {
            double *to = of->to[j] < 0 ? s->now.x - of->to[j] - 1 : s->c + of->to[j];
            if (!isfinite(jump[j]) || (of->project && of->to[j] < 0)) return 0;
            changes |= *to != jump[j];
            *to = jump[j];
        }
        s->truth[k] = now;
    }
    if (!changes || !stand(s)) return 0;
    for (int32_t k = 0; k < of->conditions; k++) {
        const int32_t now = holds(s, k, s->truth[k]);
        if (now != s->truth[k] && (now || of->is_switch[k])) return 0;
        s->truth[k] = now;
    }
    memcpy(truth, s->truth, (size_t)of->conditions * sizeof *truth);
    return 1;
}

/* Values at a part of the last step. */
static void within(const ac_sampler *s, double part, double *x, double *z) {
    const int32_t nx = s->of.equations->nx, nz = s->of.equations->nz, n = nx + nz;
    ac_interpolate(n, s->before, s->step_y, s->dense, part, 0, nx, x);
    ac_interpolate(n, s->before, s->step_y, s->dense, part, nx, nz, z);
}

/* Look at the last step, and whether nothing happens in it; the first look is the last one at the step before. */
static int look(ac_sampler *s, double from, double to, int32_t inside, const int32_t *truth) {
    const int32_t nx = s->of.equations->nx, nz = s->of.equations->nz, dense = 2 * s->request.density * (1 + inside);
    const int32_t parts = dense > s->request.fine ? dense : s->request.fine, width = 2 * s->of.conditions;
    ac_looks *l = &s->looks, rest = {l->time + 1, l->x + nx, l->z + nz, l->found + width};
    double sum = 0, all = 0;
    if (parts > LOOKS) return 0;
    for (int32_t k = 0; k < parts; k++) all += 0.6 + 0.8 * fmod(k * GOLDEN, 1);
    for (int32_t k = 0; k < parts; k++) {
        sum += 0.6 + 0.8 * fmod(k * GOLDEN, 1);
        const double part = k + 1 < parts ? sum / all : 1;
        rest.time[k] = k + 1 < parts ? from + part * (to - from) : to;
        within(s, part, rest.x + k * nx, rest.z + k * nz);
    }
    if (!ac_sampler_settle(s, s->needed, s->of.needed, parts, &rest) || !ac_sampler_watch(s, parts, &rest)) return 0;
    const int clear = ac_sampler_clear(s, parts, truth, s->now.found);
    copy(l->x, rest.x + (parts - 1) * nx, nx), copy(l->z, rest.z + (parts - 1) * nz, nz);
    copy(l->found, rest.found + (parts - 1) * width, width);
    l->time[0] = to;
    return clear;
}

static void put_row(const ac_sampler *s, ac_sampled_state *state, double time, const double *x, const double *z, double event) {
    const ac_equations *e = s->of.equations;
    const ac_samples *q = &s->request;
    const int32_t k = state->rows++;
    q->row_time[k] = time, q->row_event[k] = event;
    copy(q->row_x + (ptrdiff_t)k * e->nx, x, e->nx), copy(q->row_z + (ptrdiff_t)k * e->nz, z, e->nz);
    copy(q->row_c + (ptrdiff_t)k * e->nc, s->c, e->nc);
    copy(q->row_work + 2 * (ptrdiff_t)k, s->work, 2);
}

/* From the present to an instant, with the outputs before it; whether nothing happens on the way. */
static int32_t pass(ac_sampler *s, ac_sampled_state *state, double to, int32_t output, int32_t outputs, const int32_t *truth) {
    const int32_t nx = s->of.equations->nx, nz = s->of.equations->nz, m = s->of.conditions;
    const double ends[2] = {s->now.time[0], to};
    double time, at = ends[0], last = 0;
    ac_request steps = *s->request.steps;
    steps.first_step = fmin(state->step, to - at), steps.outputs = 1, steps.time = ends, steps.most = INT64_MAX / 4;
    steps.x = steps.z = steps.integral = NULL, steps.room = 1;
    steps.step_time = &time, steps.step_y = s->step_y, steps.step_dense = s->dense;
    const int64_t longest = to - at > s->request.calm ? s->request.ringing : s->request.longest;
    ac_progress done = {0}, before = {0};
    if (!project(s)) return AC_DOUBT;
    for (int32_t k = 0; k < s->of.multipliers; k++) s->now.z[s->of.multiplier[k]] = 0;
    ac_rodas_begin(s->rodas, &steps, s->now.x, s->now.z, s->request.p, s->c);
    copy(s->before, s->now.x, nx), copy(s->before + nx, s->now.z, nz);
    copy(s->looks.x, s->now.x, nx), copy(s->looks.z, s->now.z, nz), copy(s->looks.found, s->now.found, 2 * m);
    s->looks.time[0] = at;
    for (int32_t k = 0; k < m; k++) s->risen[k] = 0;
    int32_t end = AC_MORE, found = AC_NO_INSTANT;
    while (found == AC_NO_INSTANT && end == AC_MORE) {
        end = ac_rodas_go(s->rodas, 1, &done);
        state->steps += done.steps - before.steps, state->refused += done.refused - before.refused;
        state->values += done.values - before.values;
        before = done;
        if ((end != AC_DONE && end != AC_MORE) || done.steps + done.refused > longest) found = AC_DOUBT;
        else if (done.kept) {
            int32_t inside = 0;
            while (inside < outputs && s->request.time[output + inside] < time) inside++;
            double worked = at;
            if (!look(s, at, time, inside, truth)) found = AC_DOUBT;
            for (; found == AC_NO_INSTANT && inside; inside--, output++, outputs--) {
                if (!ac_sampler_work(s, at, time, worked, s->request.time[output])) found = AC_DOUBT;
                worked = s->request.time[output];
                const double part = (s->request.time[output] - at) / (time - at);
                within(s, part, s->looks.x + nx, s->looks.z + nz);
                put_row(s, state, s->request.time[output], s->looks.x + nx, s->looks.z + nz, NAN);
            }
            if (found == AC_NO_INSTANT && !ac_sampler_work(s, at, time, worked, time)) found = AC_DOUBT;
            state->step = fmax(last, time - at), last = time - at, at = time;
            copy(s->before, s->step_y, nx + nz);
            /* Loops are looked at where steps end. */
            if (s->of.project && end == AC_MORE && found == AC_NO_INSTANT) {
                if (state->rows + outputs + 1 >= s->request.room) return AC_FULL;
                put_row(s, state, time, s->step_y, s->step_y + nx, NAN);
            }
        }
    }
    if (found == AC_NO_INSTANT) copy(s->now.x, s->step_y, nx), copy(s->now.z, s->step_y + nx, nz);
    return found;
}

/* Pass the next instant; -1 where that was possible. */
static int32_t go(ac_sampler *s, ac_sampled_state *state, int32_t *truth, int32_t *output) {
    const ac_samples *q = &s->request;
    const double now = s->now.time[0], instant = planned(s);
    if (!(instant < q->end)) return AC_NO_INSTANT;
    while (*output < q->outputs && q->time[*output] <= now) ++*output;
    /* An output a rounding error away is the instant. */
    int32_t outputs = 0;
    double label = instant;
    for (int32_t k = *output; k < q->outputs && label == instant; k++) {
        if (fabs(q->time[k] - instant) <= q->added * fabs(instant)) label = q->time[k];
        else if (q->time[k] < instant) outputs++;
        else break;
    }
    const double to = fmin(instant, label), event = fmax(instant, label);
    if (event + q->shortest >= q->end) return AC_NO_INSTANT;
    if (to - now <= q->crowded * q->span) return AC_DOUBT;
    if (state->rows + outputs >= q->room || state->steps + state->refused >= q->most) return AC_FULL;
    const int32_t found = pass(s, state, to, *output, outputs, truth);
    if (found != AC_NO_INSTANT) return found;
    s->now.time[0] = event;
    double before, after;
    if (!stand(s) || !ac_sampler_stored(s, &before) || !happen(s, truth) || !ac_sampler_stored(s, &after)) return AC_DOUBT;
    ac_sampler_gain(s, after - before);
    put_row(s, state, label, s->now.x, s->now.z, event);
    return -1;
}

/* Run over instants; x, z, c and truth are where it stands, consistent, and what holds there. */
int32_t ac_sampler_go(ac_sampler *s, const ac_samples *request, ac_sampled_state *state, double *x, double *z, double *c, int32_t *truth) {
    const ac_equations *e = s->of.equations;
    int32_t output = 0, found = -1;
    s->request = *request, s->evaluations = 0, s->work[0] = s->work[1] = 0;
    copy(s->now.x, x, e->nx), copy(s->now.z, z, e->nz), copy(s->c, c, e->nc);
    s->now.time[0] = state->time;
    if (!ac_sampler_watch(s, 1, &s->now)) return AC_DOUBT;
    act(s);
    while (found < 0) {
        const int32_t rows = state->rows;
        const double step = state->step;
        found = go(s, state, truth, &output);
        if (found >= 0) {
            state->rows = rows, state->step = step;
            break;
        }
        state->instants++, state->time = s->now.time[0];
        copy(x, s->now.x, e->nx), copy(z, s->now.z, e->nz), copy(c, s->c, e->nc);
    }
    state->evaluations += s->evaluations;
    return found;
}
