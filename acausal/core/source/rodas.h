/* What the parts of the one-step method share. */
#ifndef ACAUSAL_RODAS_H
#define ACAUSAL_RODAS_H

#include "core.h"
#include "rodas5p.h"

#define NOISE 1e-9 /* of the largest algebraic unknown: what is smaller may be rounding */
#define KEPT 3     /* choices of pivots: most runs take no more, and a run like it takes the same ones */

struct ac_rodas {
    ac_equations of;
    int32_t n, timely; /* unknowns; whether the equations depend on time */
    ac_lu *lu, *kept[KEPT];                     /* the factors, one of those whose pivots were chosen last */
    int32_t turn;                               /* which one */
    double *block;                              /* all the memory */
    double *values, *slopes, *powers;           /* arrays of the tapes */
    double *y, *next, *u, *stage, *b, *matrix, *dense; /* u: (STAGES, n), dense: (3, n) */
    double *here, *there;                       /* values of the equations where a step begins and ends */
    double *left, *most, *terms;                /* (nz) most that each algebraic equation left, and of its terms; terms of all */
    double t, h, factored, gathered[2]; /* factored: step whose factors stand in the LU, 0 for none */
    int64_t written_at; /* steps at the last output */
    ac_pace pace;
    int32_t begun, stale; /* first step is chosen; slopes are not those of y */
    int32_t known; /* whether `here` stands */
    int32_t sign;  /* of the determinant at the first step, -1 or 1; 0: there was none */
    ac_request request;
    ac_progress progress;
};

void ac_rodas_evaluate(const ac_rodas *r, const ac_tape *tape, double *w, const double *y, double t);
void ac_rodas_values(ac_rodas *r, const double *y, double t, double *found);
double ac_rodas_norm(const ac_rodas *r, const double *change);
void ac_rodas_write(ac_rodas *r, double h, int last);
int ac_rodas_follows(ac_rodas *r, double h);
int32_t ac_rodas_factorise(ac_rodas *r, double h);
void ac_rodas_keep(ac_rodas *r);
void ac_rodas_return(ac_rodas *r, double h);
void ac_rodas_tell(ac_rodas *r);
int ac_rodas_doubts(ac_rodas *r);
#define AC_NODES 4
/* Place between 0 and 1 of a node of Lobatto's rule of order 6, and its weight. */
double ac_lobatto(int k, double *weight);
void ac_interpolate(int32_t n, const double *before, const double *after, const double *dense, double s, int32_t first,
                    int32_t count, double *y);

#endif
