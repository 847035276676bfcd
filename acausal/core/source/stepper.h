/* Steppers: methods of integration behind one interface. A method is one file with a table of functions; the loop over steps, outputs,
   integrals and the steps that are kept are the same for all, see `stepper.c`.

   How a stepper is used: make it for some equations; begin at a point; go on, some steps at a time; what is known within the last step
   is its interpolant. After an event, begin again; after a small correction of the states, move. */
#ifndef ACAUSAL_STEPPER_H
#define ACAUSAL_STEPPER_H

#include "core.h"

#define AC_DENSE_ROWS 4 /* coefficients of an interpolant, over a value: no method has more */

/* Request for one integration. */
struct ac_request {
    double tolerance, first_step;  /* first step: of a multistep method the longest one; 0: chosen by the method */
    const double *size;            /* (nx) sizes of the states in the error test; of a multistep method (nx + nz) */
    const int32_t *rate;           /* (nx) whether a state is a rate of another one; NULL: none is */
    int32_t smooth;                /* whether vibrations that a step does not resolve are left out of the error of rates */
    int32_t largest;               /* whether the largest error of a state counts, not their root mean square */
    int32_t singular;              /* whether positions of closed loops may be passed at which unknowns grow without end: what steps
                                      leave of the algebraic equations is not looked at then */
    int64_t most;                  /* steps between two outputs, of those that do not share them */
    int32_t share, outputs;        /* share: so many outputs share these steps */
    const double *time;            /* (1 + outputs) start and output times, ascending; no step goes beyond the last one */
    double *x, *z, *integral;      /* (outputs, ...) what is found; NULL: nothing is written */
    double *taken;                 /* (outputs) steps up to each, with the part of its own; NULL: not written */
    int32_t room;                  /* for steps that are kept: the first ones since one was told to go on */
    double *step_time, *step_y;    /* (room), (room, nx + nz) their ends */
    double *step_dense;            /* (room, rows of the method, nx + nz) coefficients of their interpolants; NULL: none */
    int32_t order;                 /* highest order of a multistep method */
    double newton;                 /* part of the tolerance that Newton iterations of a multistep method may leave */
};

/* How a call ended: at the last output; with more steps to do; with too many between two outputs; step size underflow, by the error test or
   as the equations could not be solved; without memory; the tolerance is below round-off. */
enum { AC_DONE, AC_MORE, AC_MANY, AC_SHORT, AC_UNSOLVED, AC_MEMORY, AC_ROUNDING };

/* Counts of one integration: accepted and refused steps, Jacobians, residuals, choices of pivots, factorisations. */
typedef struct {
    int64_t steps, refused, slopes, values, pivots;
    int32_t written, kept; /* outputs and steps */
    double time;           /* reached */
    int64_t turned;        /* how often the determinant of the matrix had another sign than at first */
    int64_t factors;
} ac_progress;

/* The last step: values at its ends, and the interpolant between them, see `ac_interpolate`. It stands until the next step is tried. */
typedef struct {
    double from, length;
    double *before, *after, *dense; /* (n), (n), (rows, n) */
} ac_last_step;

typedef struct ac_stepper ac_stepper;

/* A method. */
typedef struct {
    int32_t rows;                        /* coefficients of its interpolant, over a value */
    int32_t iterates;                    /* whether Newton iterations solve each step, which keep to a solution of the equations */
    void (*begin)(ac_stepper *s);        /* at s->t, s->y; nothing is computed yet */
    int32_t (*advance)(ac_stepper *s);   /* try a step: AC_DONE: accepted, see ac_accept; AC_MORE: refused; or why it ended */
    void (*interpolate)(ac_stepper *s);  /* find s->last.dense */
    void (*move)(ac_stepper *s);         /* s->y is changed */
    void (*renew)(ac_stepper *s);        /* forget what was integrated: what is found from here on does not depend on it */
    void (*free)(ac_stepper *s);         /* what it has taken itself */
} ac_method;

/* What the parts of all steppers share; the first member of each. */
struct ac_stepper {
    const ac_method *method;
    ac_equations of;
    int32_t n;                          /* unknowns */
    double *block;                      /* all the memory */
    double *values, *slopes, *powers, *kinks; /* arrays of the tapes */
    double kink;                        /* next time at which the equations have one; infinite for none */
    double t, *y, *next;                /* where it is; where a step leads, then where the last one came from */
    double *work;                       /* (n) */
    double gathered[2];                 /* integrals of the powers */
    int64_t written_at;                 /* steps at the last output */
    ac_last_step last;
    ac_request request;
    ac_progress progress;
};

AC_PUBLIC void ac_stepper_begin(ac_stepper *s, const ac_request *request, const double *x, const double *z, const double *p,
                                const double *c);
AC_PUBLIC void ac_stepper_move(ac_stepper *s, const double *x, const double *z);
AC_PUBLIC void ac_stepper_allow(ac_stepper *s, int64_t most);
AC_PUBLIC int32_t ac_stepper_go(ac_stepper *s, int64_t steps, ac_progress *progress);
AC_PUBLIC void ac_stepper_renew(ac_stepper *s);
AC_PUBLIC void ac_stepper_free(ac_stepper *s);

/* For methods: memory of a stepper, with `more` numbers of its own behind, NULL without memory; equations and slopes at a point; whether
   a step is the last one, so that it ends at the last output; a step from s->t, s->y to s->next was accepted. */
double *ac_stepper_take(ac_stepper *s, const ac_method *method, const ac_equations *equations, size_t more);
void ac_evaluate_tape(const ac_stepper *s, const ac_tape *tape, double *w, const double *y, double t);
void ac_equations_at(ac_stepper *s, const double *y, double t, double *found);
double ac_end(const ac_stepper *s);
double ac_step_end(const ac_stepper *s); /* no step leads beyond: the end or the next kink */
void ac_accept(ac_stepper *s, double time, double length);

#define AC_NODES 4
/* Place between 0 and 1 of a node of Lobatto's rule of order 6, and its weight. */
double ac_lobatto(int k, double *weight);
/* Some of n values at a part s of a step: (1 - s) before + s (after + (1 - s) (d_0 + s (d_1 + s (...)))) with the rows d of its
   interpolant. */
void ac_interpolate(int32_t n, int32_t rows, const double *before, const double *after, const double *dense, double s, int32_t first,
                    int32_t count, double *y);

#endif
