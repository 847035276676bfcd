/* Flat positions of closed loops, in which two ways to go on meet: the constraints are not independent there. */
#include "instance.h"

#include <math.h>
#include <string.h>

#define FLAT 1e-3      /* smallest singular value of the constraints over their sizes: nearer, errors choose the way */
#define INSIDE 0.9     /* of that at the ends of a step: a larger least value is at one of them */

/* Whether loops pass a flat position in a step whose ends have two least singular values, and where, as a part of it: the least value is
   looked for by golden sections. `at` stands at a part of the step. */
int32_t ac_flat(ac_instance *i, ac_part_of_step *at, const double ends[2], double *where) {
    const double part = 0.5 * (sqrt(5) - 1);
    double from = 0, to = 1;
    at(i, 0.5);
    const double middle = ac_sharpness(i);
    double least = fmin(middle, fmin(ends[0], ends[1]));
    /* It falls and rises about linearly: what passes 0 shows in a difference of the ends, or in the middle. */
    if (isfinite(least) && (least <= fabs(ends[0] - ends[1]) + FLAT || middle < fmin(ends[0], ends[1]))) {
        for (int k = 0; k < 24 && least > FLAT; k++) {
            const double s = to - part * (to - from), t = from + part * (to - from);
            at(i, s);
            const double lower = ac_sharpness(i);
            at(i, t);
            const double upper = ac_sharpness(i);
            least = fmin(least, fmin(lower, upper));
            if (lower < upper) to = t;
            else from = s;
        }
    }
    *where = (from + to) / 2;
    return least <= FLAT && least < INSIDE * fmin(ends[0], ends[1]);
}

/* States between the last point that was kept and the present one, as a cubic through their values and rates. */
static void between(ac_instance *i, double s) {
    const int32_t nx = ac_states(i);
    const double h = i->now.to - i->now.from, r = 1 - s;
    const double *x = i->dense, *rate = i->dense + nx;
    for (int32_t k = 0; k < nx; k++) {
        const double step = x[k] - i->before[k];
        i->x[k] = r * i->before[k] + s * x[k] + s * r * (r * (h * i->after[k] - step) + s * (step - h * rate[k]));
    }
    i->now.time = i->now.from + s * h;
}

/* In Model Exchange: whether loops passed a flat position since the last point that was kept, which the present follows. */
int32_t ac_refuse_flat(ac_instance *i) {
    const int32_t nx = ac_states(i);
    if (!i->of->levels || !nx) return AC_OK;
    const int32_t failed = ac_know(i, AC_RATE);
    if (failed) return failed;
    ac_put(i->dense, i->x, nx), ac_put(i->dense + nx, i->rate, nx); /* the search moves x */
    i->now.to = i->now.time;
    if (i->now.curved && i->now.to > i->now.from) {
        double ends[2], where;
        ends[1] = ac_sharpness(i);
        between(i, 0);
        ends[0] = ac_sharpness(i);
        const int32_t passes = ac_flat(i, between, ends, &where);
        ac_put(i->x, i->dense, nx);
        i->now.time = i->now.to;
        if (passes) return ac_fail(i, AC_FAILED, AC_FLAT_TEXT);
    }
    ac_put(i->before, i->x, nx), ac_put(i->after, i->rate, nx);
    ac_keep(i);
    i->now.from = i->now.time, i->now.curved = 1;
    return AC_OK;
}
