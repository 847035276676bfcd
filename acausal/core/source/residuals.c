/* What steps leave of the algebraic equations. The method sees errors of the states alone. Where unknowns are steep, as beside a kink,
   or where a solution ends, it goes on with others than those of the equations, all stages alike. */
#include "file.h"
#include "lu.h"
#include "rodas.h"

#include <math.h>
#include <string.h>

#define LEFT 30         /* tolerances, of the terms: steps that leave no more are near enough whatever follows */
#define LEAST_LEFT 1e-6 /* of the terms, likewise: what noise leaves is less */
#define CLOSE_LEFT 3e-4 /* of the terms, at most */
#define REST 1e-12      /* error of the states over the tolerance that is none */
#define SOLVED 1e-12    /* of the terms, where a step begins: those of other unknowns may be far larger than what is left of a steep one */
#define NEAR 1e-8       /* of the terms, likewise: beside flat positions of loops that may be rounding, */
#define NEARER 0.5      /* which corrections leave more of */
#define RETURNS 50      /* corrections of unknowns where a step begins: by halves they come from 1 to the width of tanh(1e6 z) */
#define HALVINGS 20     /* of a correction that leaves more than there was */
#define FURTHER 10      /* times as far as the rates at both ends: where they change much in a step */
#define LEAP 0.1        /* tolerances beyond that */
#define ALIKE 1.5       /* times what was left where corrections came to little: as near, whatever follows, in some steps */
#define FADES 0.8       /* what is left of that after each step */
#define TOLERANCES 1000 /* over which, and of the most of the terms, residuals are in doubt: as `Calls.left` of Python */
#define MOST_LEFT 0.015

/* Terms of each algebraic equation, added up, by the slopes where the step begins. Unknowns far below the largest are rounding,
   with terms as small. */
static void find_terms(ac_rodas *r) {
    const double *y = r->s.y;
    double *terms = r->terms, noise = 0;
    memset(terms, 0, (size_t)r->s.n * sizeof *terms);
    for (int32_t j = r->s.of.nx; j < r->s.n; j++) noise = fmax(noise, NOISE * fabs(y[j]));
    for (int32_t j = 0; j < r->s.n; j++) {
        const double size = fmax(fabs(y[j]), noise);
        for (int32_t e = r->s.of.start[j]; e < r->s.of.start[j + 1]; e++) terms[r->s.of.row[e]] += fabs(r->matrix[e]) * size;
    }
}

/* The largest of some residuals over the terms of its equation. */
static double largest(const ac_rodas *r, const double *residual) {
    double most = 0;
    for (int32_t k = r->s.of.nx; k < r->s.n; k++) {
        const double part = residual[k] == 0 ? 0 : fabs(residual[k]) / r->terms[k];
        if (part > most) most = part;
    }
    return most;
}

/* Error of the states by what the algebraic equations leave, over tolerance; in b: how it is corrected. */
static double correction(ac_rodas *r, const double *residual) {
    memset(r->b, 0, (size_t)r->s.of.nx * sizeof *r->b);
    memcpy(r->b + r->s.of.nx, residual + r->s.of.nx, (size_t)r->s.of.nz * sizeof *r->b);
    ac_lu_solve(r->lu, r->b);
    return ac_rodas_norm(r, r->b);
}

/* Whether what is left matters to no state: rates that differ so, were they to last, change none by more than its tolerance. Slopes alone
   do not tell: a law that has saturated where it does not belong has none. */
static int idles(ac_rodas *r, const double *left) {
    const double *time = r->s.request.time, span = time[r->s.request.outputs] - time[0];
    for (int32_t k = 0; k < r->s.of.nx; k++) r->b[k] = span * (left[k] - r->there[k]);
    return ac_rodas_norm(r, r->b) <= 1;
}

/* Whether corrections of what a step leaves change the states by little, the second or third one by far less: beside a kink, or on the
   way to another solution, they would not. */
static int converges(ac_rodas *r, double end, double most) {
    static const double nearer[] = {0.25, 0.1}; /* as Newton's method in IDAS; less where the first two are as large */
    double error = correction(r, r->there), least = error, *left = r->s.last.dense; /* the step has none yet */
    if (!(error <= 1)) return 0;
    memcpy(r->stage, r->s.next, (size_t)r->s.n * sizeof *r->stage);
    for (int tries = 0; tries < 2; tries++) {
        for (int32_t k = 0; k < r->s.n; k++) r->stage[k] += r->b[k];
        ac_equations_at(&r->s, r->stage, end, left);
        if (!tries && error <= REST && idles(r, left)) return 1;
        error = correction(r, left);
        if (error <= nearer[tries] * least && (error > REST || largest(r, left) <= nearer[tries] * most) && ac_all_finite(left, r->s.n)) {
            memcpy(r->s.next, r->stage, (size_t)r->s.n * sizeof *r->s.next);
            memcpy(r->there, left, (size_t)r->s.n * sizeof *r->there);
            return 1;
        }
        least = fmin(least, error);
    }
    return 0;
}

/* Whether a step takes states further than their rates at its ends allow: beside a bend stages may lead unknowns far away, and what that
   does to the states is as large as the tolerance at most, but again in each of many short steps. */
static int leaps(ac_rodas *r, double h) {
    for (int32_t k = 0; k < r->s.of.nx; k++)
        r->b[k] = fmax(0, fabs(r->s.next[k] - r->s.y[k]) - FURTHER * h * fmax(fabs(r->here[k]), fabs(r->there[k])));
    return ac_rodas_norm(r, r->b) > LEAP;
}

/* Whether the algebraic equations are solved where a step leads, near enough for its tolerance. */
int ac_rodas_follows(ac_rodas *r, double h) {
    const double end = r->s.t + h;
    find_terms(r);
    ac_equations_at(&r->s, r->s.next, end, r->there);
    if (!ac_all_finite(r->there, r->s.n)) return 0;
    if (!r->s.of.nz) return 1;
    const double least = fmax(fmin(LEFT * r->s.request.tolerance, CLOSE_LEFT), LEAST_LEFT), enough = fmax(least, r->pace.trusted);
    for (int32_t k = 0; k < r->s.of.nz; k++) r->most[k] = fmax(r->most[k], r->terms[r->s.of.nx + k]);
    const double most = largest(r, r->there);
    r->pace.trusted *= FADES;
    if (!(most <= enough) && !r->s.request.singular) {
        if (!converges(r, end, most)) return 0;
        r->pace.trusted = fmin(ALIKE * most, MOST_LEFT);
    }
    if (r->pace.bent && leaps(r, h)) return 0;
    for (int32_t k = 0; k < r->s.of.nz; k++) r->left[k] = fmax(r->left[k], fabs(r->there[r->s.of.nx + k]));
    const int32_t sign = ac_lu_is_negative(r->lu) ? -1 : 1;
    r->s.progress.turned += sign == -r->sign;
    if (!r->sign) r->sign = sign;
    return 1;
}

/* Bring the unknowns where a step begins nearer to their equations; return whether they came nearer, and may come nearer still.
   Where these bend, what the last step left may be far from them, and a whole correction may lead further away. */
static int returns(ac_rodas *r) {
    if (!r->s.of.nz || r->s.request.singular) return 0;
    find_terms(r);
    const double left = largest(r, r->here);
    if (!(left > SOLVED)) return 0;
    correction(r, r->here);
    if (!ac_all_finite(r->b, r->s.n)) return 0;
    double part = 1, *found = r->s.last.dense; /* the step has none */
    for (int tries = 0; tries <= HALVINGS; tries++, part /= 2) {
        memcpy(r->stage, r->s.y, (size_t)r->s.n * sizeof *r->stage);
        for (int32_t k = r->s.of.nx; k < r->s.n; k++) r->stage[k] += part * r->b[k];
        ac_equations_at(&r->s, r->stage, r->s.t, found);
        const double now = largest(r, found);
        if (ac_all_finite(found, r->s.n) && now < left) {
            memcpy(r->s.y, r->stage, (size_t)r->s.n * sizeof *r->s.y);
            memcpy(r->here, found, (size_t)r->s.n * sizeof *r->here);
            r->stale = 1;
            return left > NEAR || now <= NEARER * left;
        }
    }
    return 0;
}

/* Solve for the algebraic unknowns where a step of length h begins, as far as that goes. */
void ac_rodas_return(ac_rodas *r, double h) {
    int tries = 0;
    while (tries++ < RETURNS && returns(r) && !ac_rodas_factorise(r, h)) {}
}

/* The largest residual after steps, over the largest sum of the terms of its equation. */
static double most_left(const ac_rodas *r) {
    double most = 0;
    for (int32_t k = 0; k < r->s.of.nz; k++) {
        const double part = r->left[k] == 0 ? 0 : r->left[k] / r->most[k];
        if (!(part <= most)) most = isfinite(part) ? part : INFINITY;
    }
    return most;
}

/* Whether it is in doubt after a step that the algebraic equations were followed; each doubt is told once. */
int ac_rodas_doubts(ac_rodas *r) {
    ac_progress *p = &r->s.progress;
    if (most_left(r) <= fmin(TOLERANCES * r->s.request.tolerance, MOST_LEFT) && !p->turned) return 0;
    memset(r->left, 0, (size_t)r->s.of.nz * sizeof *r->left);
    p->turned = r->sign = 0;
    return 1;
}
