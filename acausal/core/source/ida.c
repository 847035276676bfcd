/* Integrate by IDAS of SUNDIALS: BDF of variable order and step, in the form F(t, y, y') = (x' - f, -g) = 0. Its C interface is that of
   version 2.6, which CasADi's wheels export: whoever loads the library gives the addresses of the functions that are named here.

   The linear systems (cj M - J) z = r, M = diag(1, 0), are solved by the LU of the core. No direct solver can be attached through the
   interface, but the preconditioner of GMRES: with so large a tolerance of its own it ends before the first iteration, and IDA takes
   the preconditioned residual as the correction. */
#include "ida.h"

#include "file.h"
#include "lu.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct sundials_vector *N_Vector;
typedef int residual_fn(double, N_Vector, N_Vector, N_Vector, void *);
typedef int setup_fn(double, N_Vector, N_Vector, N_Vector, double, void *, N_Vector, N_Vector, N_Vector);
typedef int solve_fn(double, N_Vector, N_Vector, N_Vector, N_Vector, N_Vector, double, double, void *, N_Vector);
typedef int product_fn(double, N_Vector, N_Vector, N_Vector, N_Vector, N_Vector, double, void *, N_Vector, N_Vector);
typedef void message_fn(int, const char *, const char *, char *, void *);

#define FUNCTIONS(_)                                                                                           \
    _(N_Vector, N_VMake_Serial, (long, double *))                                                              \
    _(void, N_VDestroy, (N_Vector)) _(double *, N_VGetArrayPointer, (N_Vector))                                \
    _(void *, IDACreate, (void)) _(void, IDAFree, (void **))                                                   \
    _(int, IDAInit, (void *, residual_fn *, double, N_Vector, N_Vector))                                       \
    _(int, IDAReInit, (void *, double, N_Vector, N_Vector))                                                    \
    _(int, IDASVtolerances, (void *, double, N_Vector)) _(int, IDASetId, (void *, N_Vector))                   \
    _(int, IDASetSuppressAlg, (void *, int)) _(int, IDASetMaxOrd, (void *, int))                               \
    _(int, IDASetInitStep, (void *, double)) _(int, IDASetNonlinConvCoef, (void *, double))                    \
    _(int, IDASetStopTime, (void *, double)) _(int, IDASetUserData, (void *, void *))                          \
    _(int, IDASetErrHandlerFn, (void *, message_fn *, void *))                                                 \
    _(int, IDASpgmr, (void *, int)) _(int, IDASpilsSetPreconditioner, (void *, setup_fn *, solve_fn *))        \
    _(int, IDASpilsSetJacTimesVecFn, (void *, product_fn *)) _(int, IDASpilsSetEpsLin, (void *, double))       \
    _(int, IDASolve, (void *, double, double *, N_Vector, N_Vector, int))                                      \
    _(int, IDAGetDky, (void *, double, int, N_Vector)) _(int, IDAGetLastOrder, (void *, int *))                \
    _(int, IDAGetNumErrTestFails, (void *, long *)) _(int, IDAGetNumNonlinSolvConvFails, (void *, long *))

#define MEMBER(result, name, arguments) result(*name) arguments;
static struct { FUNCTIONS(MEMBER) } ida;
#define NAME(result, name, arguments) #name,
static const char *const names[] = {FUNCTIONS(NAME) NULL};

enum { ONE_STEP = 2, STOPPED = 1 };
enum { TOO_MUCH_ACCURACY = -2, ERROR_TEST = -3, SETUP = -6, MEMORY = -21, ILL_INPUT = -22 };
#define NO_ITERATION 1e200 /* tolerance of GMRES, with which it takes the preconditioned residual as it is */

#define FIRST 1e-3 /* of the way to the end: the longest first step, as IDA has it */
#define MOST_SHORT 64 /* steps in a row that the time does not show, as after a start late in a run, where they double */

typedef struct {
    ac_stepper s; /* first */
    void *mem;
    ac_lu *lu;
    N_Vector y, yp, size, within; /* size: absolute tolerances, before: whether unknowns are states */
    double *shift;                /* (n) of the states since it was started: what IDA integrates is y less that */
    double *matrix, cj;           /* cj: of the matrix whose factors stand in the LU */
    int begun, order;             /* order: of the last step */
    double stop;                  /* no step leads beyond; NAN before it is set */
    double origin, from, time;    /* where it began; since then: the ends of the last step, as times late in a run are coarse */
    int64_t refused;              /* steps before the last restart */
    long errors, unsolved;        /* of those since, by the error test, and as the equations could not be solved */
    int32_t why;                  /* the last one was refused, as of AC_SHORT or AC_UNSOLVED */
} ac_ida;

const char *ac_ida_function(int32_t k) { return names[k]; }

/* Pointers to functions and to data are the same wherever a library can be loaded. */
void ac_ida_load(void *const *address) { memcpy(&ida, address, sizeof ida); }

static double *array(N_Vector v) { return ida.N_VGetArrayPointer(v); }

/* The unknowns that belong to those of IDA. */
static void shifted(const ac_ida *i, N_Vector own, double *y) {
    const double *from = array(own);
    for (int32_t k = 0; k < i->s.n; k++) y[k] = from[k] + i->shift[k];
}

/* What returns 1 is tried again with a shorter step. */
static int residual(double t, N_Vector y, N_Vector yp, N_Vector rv, void *data) {
    ac_ida *i = data;
    const double *rate = array(yp);
    double *r = array(rv);
    shifted(i, y, i->s.work);
    ac_equations_at(&i->s, i->s.work, i->origin + t, r);
    for (int32_t k = 0; k < i->s.n; k++) r[k] = (k < i->s.of.nx ? rate[k] : 0) - r[k];
    return !ac_all_finite(r, i->s.n);
}

static int setup(double t, N_Vector y, N_Vector yp, N_Vector r, double cj, void *data, N_Vector a, N_Vector b, N_Vector c) {
    ac_ida *i = data;
    const ac_equations *e = &i->s.of;
    const ac_tape *tape = e->slopes;
    (void)yp, (void)r, (void)a, (void)b, (void)c;
    shifted(i, y, i->s.work);
    ac_evaluate_tape(&i->s, tape, i->s.slopes, i->s.work, i->origin + t);
    for (int32_t k = 0; k < e->start[i->s.n]; k++) i->matrix[k] = -i->s.slopes[tape->output[k]];
    for (int32_t k = 0; k < e->nx; k++) i->matrix[e->diagonal[k]] += cj;
    i->cj = cj;
    i->s.progress.slopes++, i->s.progress.factors++;
    return (int)ac_lu_factor(i->lu, i->matrix);
}

/* Where the step has changed since, the correction is scaled as IDA's own direct solvers do it. */
static int solve(double t, N_Vector y, N_Vector yp, N_Vector r, N_Vector b, N_Vector z, double cj, double delta, void *data,
                 N_Vector a) {
    ac_ida *i = data;
    const double scale = 2 / (1 + cj / i->cj);
    double *x = array(z);
    (void)t, (void)y, (void)yp, (void)r, (void)delta, (void)a;
    memcpy(x, array(b), (size_t)i->s.n * sizeof *x);
    ac_lu_solve(i->lu, x);
    for (int32_t k = 0; k < i->s.n; k++) x[k] *= scale;
    return !ac_all_finite(x, i->s.n);
}

/* GMRES begins to iterate with numbers alone that are not finite. */
static int product(double t, N_Vector y, N_Vector yp, N_Vector r, N_Vector v, N_Vector found, double cj, void *data, N_Vector a,
                   N_Vector b) {
    (void)t, (void)y, (void)yp, (void)r, (void)v, (void)found, (void)cj, (void)data, (void)a, (void)b;
    return 1;
}

/* What IDA has to say follows from its flags. */
static void hush(int code, const char *module, const char *function, char *message, void *data) {
    (void)code, (void)module, (void)function, (void)message, (void)data;
}

#define TRY(call)                          \
    do {                                   \
        const int failed_ = (call);        \
        if (failed_ < 0) return failed_;   \
    } while (0)

/* Make what stays; it says nothing of its own from the first line on, and the user data are copied by IDASpgmr. */
static int make(ac_ida *i) {
    double *is_state = array(i->within);
    for (int32_t k = 0; k < i->s.n; k++) is_state[k] = k < i->s.of.nx;
    TRY(ida.IDASetErrHandlerFn(i->mem, hush, NULL));
    TRY(ida.IDASetUserData(i->mem, i));
    TRY(ida.IDAInit(i->mem, residual, 0, i->y, i->yp));
    TRY(ida.IDASetId(i->mem, i->within));
    TRY(ida.IDASetSuppressAlg(i->mem, i->s.of.nz > 0));
    TRY(ida.IDASpgmr(i->mem, 1));
    TRY(ida.IDASpilsSetPreconditioner(i->mem, setup, solve));
    TRY(ida.IDASpilsSetJacTimesVecFn(i->mem, product));
    return ida.IDASpilsSetEpsLin(i->mem, NO_ITERATION);
}

/* The first step as IDA chooses it, and no longer than the request has it. */
static double first_step(const ac_ida *i) {
    const ac_stepper *s = &i->s;
    const ac_request *q = &s->request;
    const double *size = array(i->size), *rate = array(i->yp), most = FIRST * (ac_end(s) - s->t);
    double sum = 0;
    for (int32_t k = 0; k < s->of.nx; k++) {
        const double change = rate[k] / (q->tolerance * fabs(s->y[k]) + size[k]);
        sum += change * change;
    }
    const double own = fmin(most, 0.5 / sqrt(sum / s->n));
    return q->first_step > 0 ? fmin(own, q->first_step) : own;
}

/* Start at the current point: derivatives of the states follow from the equations, those of algebraic unknowns start as 0. */
static int start(ac_ida *i) {
    ac_stepper *s = &i->s;
    const ac_request *q = &s->request;
    const size_t nx = (size_t)s->of.nx, nz = (size_t)s->of.nz;
    double *size = array(i->size), *rate = array(i->yp);
    memcpy(array(i->y), s->y, (nx + nz) * sizeof(double));
    memset(i->shift, 0, (nx + nz) * sizeof(double));
    ac_equations_at(s, s->y, s->t, rate);
    memset(rate + nx, 0, nz * sizeof *rate);
    for (int32_t k = 0; k < s->n; k++) size[k] = q->tolerance * q->size[k];
    i->refused = s->progress.refused, i->errors = i->unsolved = 0, i->why = AC_SHORT;
    i->origin = s->t, i->time = 0;
    TRY(ida.IDAReInit(i->mem, 0, i->y, i->yp));
    TRY(ida.IDASVtolerances(i->mem, q->tolerance, i->size));
    TRY(ida.IDASetMaxOrd(i->mem, q->order));
    TRY(ida.IDASetInitStep(i->mem, first_step(i)));
    TRY(ida.IDASetNonlinConvCoef(i->mem, q->newton));
    i->begun = 1, i->stop = NAN;
    return 0;
}

static int32_t reason(int flag) {
    switch (flag) {
    case TOO_MUCH_ACCURACY: return AC_ROUNDING;
    case ERROR_TEST: case ILL_INPUT: return AC_SHORT; /* ill input: the end is a rounding error away */
    case SETUP: case MEMORY: return AC_MEMORY;
    default: return AC_UNSOLVED;
    }
}

/* Count what IDA has refused since it was started. */
static void count(ac_ida *i) {
    int64_t counts[4];
    long errors = 0, unsolved = 0;
    ida.IDAGetNumErrTestFails(i->mem, &errors), ida.IDAGetNumNonlinSolvConvFails(i->mem, &unsolved);
    if (errors > i->errors || unsolved > i->unsolved) i->why = unsolved > i->unsolved ? AC_UNSOLVED : AC_SHORT;
    i->errors = errors, i->unsolved = unsolved;
    i->s.progress.refused = i->refused + errors + unsolved;
    ac_lu_counts(i->lu, counts);
    i->s.progress.pivots = counts[0];
}

/* A step, or several where they are too short for the time to show it: IDA goes on without an end where steps are rounding. */
static int32_t advance(ac_stepper *s) {
    ac_ida *i = (ac_ida *)s;
    int flag = i->begun ? 0 : start(i);
    double time = s->t;
    const double end = ac_step_end(s);
    if (flag >= 0 && end != i->stop) flag = ida.IDASetStopTime(i->mem, (i->stop = end) - i->origin); /* dropped where it is reached */
    for (int tries = 0; flag >= 0 && time <= s->t && tries < MOST_SHORT; tries++) {
        i->from = i->time;
        flag = ida.IDASolve(i->mem, end - i->origin, &i->time, i->y, i->yp, ONE_STEP);
        count(i);
        time = flag == STOPPED ? end : i->origin + i->time;
    }
    if (flag < 0) return reason(flag);
    if (time <= s->t) return i->why;
    ida.IDAGetLastOrder(i->mem, &i->order);
    shifted(i, i->y, s->next);
    ac_accept(s, time, time - s->t);
    return AC_DONE;
}

/* The coefficients of a polynomial as high as the order of the step, from so many values within it: Newton's divided differences, then
   their expansion in powers. */
static void interpolate(ac_stepper *s) {
    ac_ida *i = (ac_ida *)s;
    const ac_last_step *l = &s->last;
    const int m = i->order - 1;
    const size_t n = (size_t)s->n;
    double *y = s->work;
    memset(l->dense, 0, AC_DENSE_ROWS * n * sizeof *l->dense);
    for (int j = 0; j < m; j++) {
        const double part = (j + 1.) / (m + 1);
        ida.IDAGetDky(i->mem, i->from + part * (i->time - i->from), 0, i->within);
        shifted(i, i->within, y);
        for (size_t k = 0; k < n; k++) {
            l->dense[(size_t)j * n + k] = (y[k] - (1 - part) * l->before[k] - part * l->after[k]) / (part * (1 - part));
        }
    }
    for (int j = 1; j < m; j++) {
        for (int e = m - 1; e >= j; e--) {
            double *d = l->dense + (size_t)e * n, *less = d - n;
            for (size_t k = 0; k < n; k++) d[k] = (d[k] - less[k]) * (m + 1) / j;
        }
    }
    for (int j = m - 2; j >= 0; j--) {
        for (int e = j; e < m - 1; e++) {
            double *d = l->dense + (size_t)e * n, *more = d + n;
            for (size_t k = 0; k < n; k++) d[k] -= more[k] * (j + 1) / (m + 1);
        }
    }
}

static void begin(ac_stepper *s) { ((ac_ida *)s)->begun = 0; }

/* A small correction moves all past values alike: differences of these are what IDA goes on with. */
static void move(ac_stepper *s) {
    ac_ida *i = (ac_ida *)s;
    const double *own = array(i->y);
    for (int32_t k = 0; k < s->n; k++) i->shift[k] = s->y[k] - own[k];
}

static void renew(ac_stepper *s) { ac_lu_renew(((ac_ida *)s)->lu); }

static void free_own(ac_stepper *s) {
    ac_ida *i = (ac_ida *)s;
    N_Vector all[] = {i->y, i->yp, i->size, i->within};
    for (size_t k = 0; k < sizeof all / sizeof *all; k++) {
        if (all[k]) ida.N_VDestroy(all[k]);
    }
    if (i->mem) ida.IDAFree(&i->mem);
    ac_lu_free(i->lu);
}

static const ac_method METHOD = {AC_DENSE_ROWS, 1, begin, advance, interpolate, move, renew, free_own};

ac_stepper *ac_ida_make(const ac_equations *equations) {
    ac_ida *i = ida.IDACreate ? calloc(1, sizeof *i) : NULL;
    if (!i) return NULL;
    const ac_equations *e = equations;
    const long n = (long)e->nx + e->nz;
    double *at = ac_stepper_take(&i->s, &METHOD, e, 5 * (size_t)n + (size_t)e->start[n] + 1);
    i->lu = ac_lu_make(i->s.n, e->start, e->row);
    i->mem = ida.IDACreate();
    N_Vector *vectors[] = {&i->y, &i->yp, &i->size, &i->within};
    int good = at && i->lu && i->mem;
    for (int k = 0; k < 4 && good; k++, at += n) good = (*vectors[k] = ida.N_VMake_Serial(n, at)) != NULL;
    if (!good || make(i) < 0) {
        ac_stepper_free(&i->s);
        return NULL;
    }
    i->shift = at, i->matrix = at + n;
    return &i->s;
}
