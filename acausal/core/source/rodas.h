/* What the parts of the one-step method share. */
#ifndef ACAUSAL_RODAS_H
#define ACAUSAL_RODAS_H

#include "stepper.h"

#define NOISE 1e-9 /* of the largest algebraic unknown: what is smaller may be rounding */
#define AC_RODAS_ROWS 3 /* coefficients of its interpolant */
#define KEPT 3     /* choices of pivots: most runs take no more, and a run like it takes the same ones */

/* What the next step takes over from the ones before. */
typedef struct {
    double trusted;             /* what steps may leave of the terms, as one left it whose unknowns were near enough */
    int32_t refused, unsolved;  /* the last step was; the equations were not solved where it led */
    int32_t slow;               /* so many of the next steps grow slowly */
    int32_t bent;               /* so many of the next steps may begin beside a bend */
} ac_pace;

typedef struct {
    ac_stepper s;                               /* first */
    int32_t timely;                             /* whether the equations depend on time */
    ac_lu *lu, *kept[KEPT];                     /* the factors, one of those whose pivots were chosen last */
    int32_t turn;                               /* which one */
    double *u, *stage, *b, *matrix;             /* u: (STAGES, n) */
    double *here, *there;                       /* values of the equations where a step begins and ends */
    double *left, *most, *terms;                /* (nz) most that each algebraic equation left, and of its terms; terms of all */
    double h, factored;                         /* next step; factored: the one whose factors stand in the LU, 0 for none */
    ac_pace pace;
    int32_t begun, stale; /* first step is chosen; slopes are not those of y */
    int32_t known; /* whether `here` stands */
    int32_t sign;  /* of the determinant at the first step, -1 or 1; 0: there was none */
} ac_rodas;

AC_PUBLIC ac_rodas *ac_rodas_make(const ac_equations *equations);
double ac_rodas_norm(const ac_rodas *r, const double *change);
int ac_rodas_follows(ac_rodas *r, double h);
int32_t ac_rodas_factorise(ac_rodas *r, double h);
void ac_rodas_return(ac_rodas *r, double h);
int ac_rodas_doubts(ac_rodas *r);

#endif
