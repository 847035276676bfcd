/* Flat positions of closed loops, in which two ways to go on meet: the constraints are not independent there. */
#include "instance.h"

#include <math.h>
#include <string.h>

#define FLAT 1e-3      /* smallest singular value of the constraints over their sizes: nearer, errors choose the way */
#define WORN 0.03      /* the same where the equations cannot be solved any more */

/* Whether the present position is flat, as far as can be told where the equations have no solution. */
int ac_is_flat(ac_instance *i) { return ac_sharpness(i) <= WORN; }

/* States between two points, as a cubic through their values and rates. */
static void between(ac_instance *i, const ac_point *a, const ac_point *b, double s) {
    const double h = b->time - a->time, r = 1 - s;
    for (int32_t k = 0; k < ac_states(i); k++) {
        const double step = b->x[k] - a->x[k];
        i->x[k] = r * a->x[k] + s * b->x[k] + s * r * (r * (h * a->rate[k] - step) + s * (step - h * b->rate[k]));
    }
    i->now.time = a->time + s * h;
}

/* Whether loops pass a flat position between two points, which lie one step apart, and where, as a part of the step: the least value is
   looked for by golden sections. */
int32_t ac_flat(ac_instance *i, const ac_point *a, const ac_point *b, double *where) {
    const ac_unit *u = i->of;
    const int32_t nx = ac_states(i);
    if (!u->levels || !(b->time > a->time)) return 0;
    const double part = 0.5 * (sqrt(5) - 1), time = i->now.time;
    double *kept = i->other, from = 0, to = 1, least;
    memcpy(kept, i->x, (size_t)nx * sizeof *kept);
    between(i, a, b, 0);
    const double first = ac_sharpness(i);
    between(i, a, b, 1);
    const double last = ac_sharpness(i);
    between(i, a, b, 0.5);
    const double middle = ac_sharpness(i);
    least = fmin(middle, fmin(first, last));
    /* It falls and rises about linearly: what passes 0 shows in a difference of the ends, or in the middle. */
    if (isfinite(least) && (least <= fabs(first - last) + FLAT || middle < fmin(first, last))) {
        for (int k = 0; k < 24 && least > FLAT; k++) {
            const double s = to - part * (to - from), t = from + part * (to - from);
            between(i, a, b, s);
            const double lower = ac_sharpness(i);
            between(i, a, b, t);
            const double upper = ac_sharpness(i);
            least = fmin(least, fmin(lower, upper));
            if (lower < upper) to = t;
            else from = s;
        }
    }
    memcpy(i->x, kept, (size_t)nx * sizeof *kept);
    i->now.time = time, *where = (from + to) / 2;
    return least <= FLAT;
}

/* In Model Exchange: whether loops passed a flat position since the last point that was kept, which the present follows. */
int32_t ac_completed(ac_instance *i) {
    const size_t size = (size_t)ac_states(i) * sizeof(double);
    if (!i->of->levels || !size) return AC_OK;
    const int32_t failed = ac_know(i, AC_RATE);
    if (failed) return failed;
    const ac_point a = {i->now.from, i->before, i->after}, b = {i->now.time, i->dense, i->rate};
    memcpy(i->dense, i->x, size); /* the search moves x */
    double where;
    if (i->now.curved && ac_flat(i, &a, &b, &where)) return ac_fail(i, AC_FAILED, AC_FLAT_TEXT);
    memcpy(i->before, i->x, size);
    memcpy(i->after, i->rate, size);
    ac_keep(i);
    i->now.from = i->now.time, i->now.curved = 1;
    return AC_OK;
}
