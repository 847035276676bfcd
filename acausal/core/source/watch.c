/* Conditions at many times, and whether they are surely as they were in between. As `Locator` of Python looks at them. */
#include "file.h"
#include "sampler.h"

#include <math.h>
#include <string.h>

/* Sizes of the algebraic unknowns in some rows; what is far below the largest may be rounding. */
static void size_up(ac_sampler *s, int32_t rows, const double *z) {
    const int32_t nz = s->of.equations->nz;
    double largest = 0;
    for (int32_t k = 0; k < nz; k++) {
        s->sizes[k] = 0;
        for (int32_t i = 0; i < rows; i++) s->sizes[k] = fmax(s->sizes[k], fabs(z[i * nz + k]));
        largest = fmax(largest, s->sizes[k] / s->request.declared[k]);
    }
    for (int32_t k = 0; k < nz; k++) {
        const double nominal = s->request.declared[k];
        s->sizes[k] = largest > 0 ? fmax(s->sizes[k], s->request.noise * largest * nominal) : nominal;
    }
}

/* Bring the unknowns of a square on their equations in some rows; whether that succeeds in all. */
int ac_sampler_settle(ac_sampler *s, ac_settler *by, const ac_square *q, int32_t rows, ac_looks *at) {
    if (!by) return 1;
    const ac_equations *e = s->of.equations;
    const int32_t length[5] = {e->np, e->nc, e->nx, e->nz, 1}, stride[5] = {0, 0, e->nx, e->nz, 1};
    const double *part[5] = {s->request.p, s->c, at->x, at->z, at->time};
    const int32_t first = e->np + e->nc + e->nx;
    size_up(s, rows, at->z);
    for (int32_t k = 0; k < q->n; k++) s->size[k] = s->sizes[q->unknown[k] - first];
    s->evaluations += ac_settle_rows(by, rows, 5, 2, length, stride, part, s->size, s->request.enough, s->picked, s->settled);
    for (int32_t i = 0; i < rows; i++) {
        if (!s->settled[i]) return 0;
        for (int32_t k = 0; k < q->n; k++) at->z[i * e->nz + q->unknown[k] - first] = s->picked[i * q->n + k];
    }
    return 1;
}

/* Conditions and their rates in some rows; whether all have values. */
int ac_sampler_watch(ac_sampler *s, int32_t rows, ac_looks *at) {
    const ac_equations *e = s->of.equations;
    const int32_t n = s->of.moving ? s->of.moving->n : 0;
    const int32_t length[6] = {e->np, e->nc, e->nx, e->nz, 1, n};
    int32_t stride[6] = {0, 0, e->nx, e->nz, 1, 0};
    const double *part[6] = {s->request.p, s->c, at->x, at->z, at->time, s->rates};
    if (s->moving) {
        /* The equations are linear: one step is enough. */
        memset(s->rates, 0, (size_t)n * sizeof *s->rates);
        s->evaluations += ac_settle_rows(s->moving, rows, 6, 2, length, stride, part, s->ones, INFINITY, s->picked, s->settled);
        for (int32_t i = 0; i < rows; i++) {
            if (!s->settled[i]) return 0;
        }
        part[5] = s->picked, stride[5] = n;
    }
    ac_tape_rows(s->of.watched, s->tape, rows, 6, length, stride, part, at->found);
    return ac_all_finite(at->found, 2 * rows * s->of.conditions);
}

/* A condition in the looks at a step: value and rate, positive where nothing changes. */
typedef struct {
    const double *time, *found;
    int32_t each;
    double side;
} of_one;

static double value(const of_one *o, int32_t i) { return o->side * o->found[i * 2 * o->each]; }

static double rate(const of_one *o, int32_t i) { return o->side * o->found[(i * 2 + 1) * o->each]; }

/* How far a look is from the cubic that has values and rates of its neighbours; a quarter is about the error of theirs. */
static double off(const of_one *o, int32_t i) {
    const double h = o->time[i + 1] - o->time[i - 1], t = (o->time[i] - o->time[i - 1]) / h;
    const double a = value(o, i - 1), b = value(o, i + 1), da = rate(o, i - 1) * h, db = rate(o, i + 1) * h;
    const double c3 = 2 * a - 2 * b + da + db, c2 = 3 * (b - a) - 2 * da - db;
    return fabs(((c3 * t + c2) * t + da) * t + a - value(o, i)) / 4;
}

/* Whether a condition stays on its side between two looks, above levels at both: a cubic lies in the hull of its values and the
   ends of the thirds of its tangents, and a function that is convex above its tangents. */
static int stays(const ac_sampler *s, const of_one *o, int32_t i, int32_t parts, const double level[2], double most, double width) {
    const double h = o->time[i] - o->time[i - 1], a = value(o, i - 1), b = value(o, i), da = h * rate(o, i - 1), db = h * rate(o, i);
    const double travel = fmax(fabs(da), fabs(db)), nearest = fmin(a, b) - level[0];
    if (b < level[1]) return 0;
    if (nearest > s->request.reach * travel) return 1;
    if (travel > fmax(most, width)) return 0;
    if (da < 0 && db > 0 && (a - level[0]) * db - (b - level[1]) * da + da * db < 0) return 0;
    const double margin = fmin(fmin(a, b), fmin(a + da / 3, b - db / 3)) - level[0];
    const double error = fmax(i > 1 ? off(o, i - 1) : 0, i < parts ? off(o, i) : 0);
    return margin >= -width && (error <= width || margin >= s->request.error * error);
}

/* Whether all conditions surely stay as they are in a step with looks at the ends of so many parts; `first`: their values where
   the leg began. What may change and change back unseen is not sure. */
int ac_sampler_clear(ac_sampler *s, int32_t parts, const int32_t *truth, const double *first) {
    for (int32_t k = 0; k < s->of.conditions; k++) {
        const of_one o = {s->looks.time, s->looks.found + k, s->of.conditions, truth[k] ? -1 : 1};
        double low = value(&o, 0), high = low;
        for (int32_t i = 1; i <= parts; i++) low = fmin(low, value(&o, i)), high = fmax(high, value(&o, i));
        const double least = fmin(o.side * first[k], 0) - s->request.level * s->width[k];
        for (int32_t i = 1; i <= parts; i++) {
            double level[2];
            for (int32_t j = 0; j < 2; j++) {
                s->risen[k] |= value(&o, i - 1 + j) > 0;
                level[j] = s->risen[k] ? 0 : least;
            }
            if (!stays(s, &o, i, parts, level, high - low, s->width[k])) return 0;
        }
        s->request.peak[k] = fmax(s->request.peak[k], high);
    }
    return 1;
}
