/* Whether the algebraic unknowns jump within a step: the method sees errors of states alone, and goes on where a solution ends,
   with another one or with none. */
#include "instance.h"
#include "rodas.h"

#include <math.h>
#include <stdlib.h>

#define HALVINGS 24 /* of the step, at most: a law may be as steep as a ten-millionth of it */
#define SLIGHT 0.01 /* change of an unknown over its size that counts */

/* The algebraic unknowns at a time in the step, from a guess, or from those of the interpolant. */
static int32_t solved(ac_instance *i, double time, const double *guess, double *z) {
    const int32_t nz = i->of->parts.model.equations.nz;
    ac_stand(i, time);
    ac_put(i->z, guess, nz);
    const int32_t failed = ac_know(i, AC_Z);
    ac_put(z, i->z, nz);
    return failed;
}

/* Sizes of the unknowns in the step, from those at its ends. */
static void find_sizes(const ac_instance *i, const double *a, const double *b, double *own) {
    const int32_t nz = i->of->parts.model.equations.nz;
    const double *size = i->of->size;
    double largest = 0;
    for (int32_t k = 0; k < nz; k++) largest = fmax(largest, fmax(fabs(a[k]), fabs(b[k])) / size[k]);
    for (int32_t k = 0; k < nz; k++) {
        own[k] = fmax(fmax(fabs(a[k]), fabs(b[k])), fmax(NOISE * largest, i->now.tolerance) * size[k]);
    }
}

static double change(int32_t nz, const double *a, const double *b, const double *own) {
    double most = 0;
    for (int32_t k = 0; k < nz; k++) most = fmax(most, fabs(b[k] - a[k]) / own[k]);
    return most;
}

/* Follow the part of the step in which they change most, until they hardly do. */
int32_t ac_refuse_jump(ac_instance *i) {
    const int32_t nz = i->of->parts.model.equations.nz;
    if (!nz || i->of->constraints || i->stepper->method->iterates || !ac_rodas_doubts(i->rodas)) return AC_OK;
    double *all = malloc(4 * (size_t)nz * sizeof *all), *a = all, *b = a + nz, *middle = b + nz, *own = middle + nz;
    if (!all) return ac_fail(i, AC_FAILED, "there is not enough memory.");
    double from = i->now.from, to = i->now.to, changes = INFINITY;
    int32_t failed = solved(i, from, NULL, a);
    if (!failed) failed = solved(i, to, NULL, b);
    if (!failed) find_sizes(i, a, b, own);
    for (int k = 0; k < HALVINGS && !failed && (changes = change(nz, a, b, own)) > SLIGHT; k++) {
        const double time = from + (to - from) / 2;
        for (int32_t j = 0; j < nz; j++) middle[j] = (a[j] + b[j]) / 2;
        failed = solved(i, time, middle, middle);
        if (change(nz, a, middle, own) > change(nz, middle, b, own)) ac_put(b, middle, nz), to = time;
        else ac_put(a, middle, nz), from = time;
    }
    free(all);
    return failed || changes > SLIGHT ? ac_fail(i, AC_FAILED, "the solution of the equations ends here.") : AC_OK;
}
