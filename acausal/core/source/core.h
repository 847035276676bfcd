/* The core: lists of scalar operations, and a sparse LU. No state of its own, no memory taken but where a comment says so. */
#ifndef ACAUSAL_CORE_H
#define ACAUSAL_CORE_H

#include <stddef.h>
#include <stdint.h>

/* A product and a sum are rounded each, whatever the options of whoever compiles: results are the same everywhere. */
#if defined(__clang__)
#pragma STDC FP_CONTRACT OFF
#elif defined(__GNUC__)
#pragma GCC optimize("fp-contract=off")
#elif defined(_MSC_VER)
#pragma fp_contract(off)
#endif

#if defined(_WIN32)
#define AC_PUBLIC __declspec(dllexport)
#else
#define AC_PUBLIC __attribute__((visibility("default")))
#endif

/* What tells the sources that this was compiled from, and their layouts, from others. */
AC_PUBLIC const char *ac_version(void);

/* What an operation does to x and y; the numbers are part of the file format. */
enum {
    AC_ADD, AC_SUB, AC_MUL, AC_DIV, AC_NEG, AC_SQ, AC_TWICE, AC_INV, AC_SQRT, AC_SIN, AC_COS, AC_TAN, AC_ASIN, AC_ACOS,
    AC_ATAN, AC_ATAN2, AC_EXP, AC_LOG, AC_POW, AC_SINH, AC_COSH, AC_TANH, AC_ASINH, AC_ACOSH, AC_ATANH, AC_FABS, AC_SIGN,
    AC_FLOOR, AC_CEIL, AC_FMOD, AC_REMAINDER, AC_COPYSIGN, AC_FMIN, AC_FMAX, AC_HYPOT, AC_LOG1P, AC_EXPM1, AC_ERF, AC_LT,
    AC_LE, AC_EQ, AC_NE, AC_NOT, AC_AND, AC_OR, AC_IF, AC_ASSIGN, AC_FIND, AC_LOAD, AC_PUT, AC_VALUE, AC_OPERATIONS
};

/* Columns by their numbers: how many numbers follow, then these; NULL where there is none any more. */
typedef struct {
    int32_t count;
    const double *const *column;
} ac_tables;

double ac_find(const ac_tables *t, double x, double number, double last);
double ac_load(const ac_tables *t, double place, double number);
AC_PUBLIC void ac_share_tables(const ac_tables *tables); /* those of this process; they have to stay */
const ac_tables *ac_shared_tables(void);

/* A function of another library, in the place of a column. */
#define AC_EXTERNAL (-1)
typedef struct ac_external ac_external;
struct ac_external {
    double count;                                          /* AC_EXTERNAL, less than that of any column */
    int32_t arguments;
    double *argument;                                      /* (arguments) DBL_MAX where any will do */
    double (*value)(ac_external *own, int32_t number);     /* one of its values, or of their derivatives */
    int32_t (*completed)(ac_external *own, int32_t part);  /* told of each accepted step: whether it asks for an event; or NULL */
    int32_t parts;                                         /* of a step, of which it is told one by one, then of events as part 0 */
};

/* A list of operations on an array w: constants, inputs, then the results in their order.
   Operations of one kind stand together in runs. The first `early` runs need parameters and constants of a segment alone. */
typedef struct {
    int32_t constants, inputs, results, runs, early, outputs;
    const double *constant;                     /* (constants) */
    const int32_t *kind, *length;               /* (runs) */
    const int32_t *first, *second;              /* (results) arguments, places in w */
    const int32_t *output;                      /* (outputs) places in w */
    const ac_tables *tables;                    /* that AC_FIND, AC_LOAD and AC_VALUE look up; NULL for none */
} ac_tape;

AC_PUBLIC void ac_casadi_call_rows(int32_t rows);                     /* of what CasADi gives to `ac_casadi_call` */
AC_PUBLIC double ac_fmu_value(ac_external *function, int32_t number); /* of an FMU for Model Exchange, see `exchanged_fmu.c` */
AC_PUBLIC int32_t ac_fmu_completed(ac_external *function, int32_t part);
AC_PUBLIC ac_external *ac_history_make(void);                         /* see `history.c` */
AC_PUBLIC int32_t ac_history_begin(ac_external *function, double time, double signal);
AC_PUBLIC void ac_history_free(ac_external *function);
double ac_external_value(const ac_tape *tape, const double *w, int32_t last, double value);
size_t ac_tape_length(const ac_tape *tape); /* of w, and one more: never 0 */
AC_PUBLIC void ac_tape_run(const ac_tape *tape, double *w, int32_t from, int32_t to);
AC_PUBLIC void ac_tape_rows(const ac_tape *tape, double *w, int32_t rows, int32_t parts, const int32_t *size,
                            const int32_t *stride, const double *const *part, double *found);

/* Leaves and operations of a function, each after its arguments. */
typedef struct {
    int32_t n;
    const int32_t *kind;           /* (n) -1 for a leaf */
    const int32_t *first, *second; /* (n) arguments, twice the same where there is one; of a leaf, the first that is equal */
    int32_t *late;                 /* (n) of a leaf, whether it changes often; of operations, it is found */
} ac_operations;

/* What a tape of them is: `order` names the operations that it holds, `same` the one that stands for each. */
typedef struct {
    int32_t results, runs, early;
    int32_t *same, *order, *run_kind, *run_length; /* (n) */
} ac_arranged;

AC_PUBLIC int32_t ac_arrange(const ac_operations *function, ac_arranged *found);

/* Factors of a sparse n x n matrix in columns: L U = P S A Q, S powers of 2 that bring each row near 1. */
typedef struct ac_lu ac_lu;

AC_PUBLIC ac_lu *ac_lu_make(int32_t n, const int32_t *start, const int32_t *row);
AC_PUBLIC int32_t ac_lu_factor(ac_lu *lu, const double *value);
AC_PUBLIC void ac_lu_solve(ac_lu *lu, double *b);
AC_PUBLIC void ac_lu_counts(const ac_lu *lu, int64_t counts[4]);
AC_PUBLIC void ac_lu_free(ac_lu *lu);

/* As many equations as unknowns, which stand among the inputs of a tape. */
typedef struct {
    int32_t n;
    const ac_tape *tape;        /* residuals, then entries of their Jacobian */
    const int32_t *start, *row; /* sparsity of the Jacobian in columns */
    const int32_t *unknown;     /* (n) places among the inputs */
} ac_square;

typedef struct ac_settler ac_settler;

AC_PUBLIC ac_settler *ac_settler_make(const ac_square *square);
AC_PUBLIC int64_t ac_settle_rows(ac_settler *s, int32_t rows, int32_t parts, int32_t early, const int32_t *length,
                                 const int32_t *stride, const double *const *part, const double *size, double enough,
                                 double *found, int32_t *settled);
AC_PUBLIC double ac_settler_least(const ac_settler *s);
AC_PUBLIC void ac_settler_renew(ac_settler *s);
AC_PUBLIC void ac_settler_free(ac_settler *s);

/* Equations x' = f, 0 = g of states x and algebraic unknowns z at times t, for parameters p and constants c of a segment.
   The inputs of all tapes are x, z, t, p, c in this order. */
typedef struct {
    int32_t nx, nz, np, nc;
    const ac_tape *values;      /* f, g */
    const ac_tape *slopes;      /* d(f, g)/d(x, z), of the sparsity below; then d(f, g)/dt where they depend on time */
    const ac_tape *powers;      /* what is integrated besides, NULL for nothing */
    const ac_tape *kinks;       /* next times, after t, at which they have kinks, NULL for none */
    const int32_t *start, *row; /* sparsity in columns, the diagonal of the states included */
    const int32_t *diagonal;    /* (nx) places of that diagonal */
} ac_equations;

typedef struct ac_request ac_request; /* for one integration, see `stepper.h` */

/* Friction forces of n laws at rest, as shares u of their limits: |u| <= 1, where the accelerations a = b - A u are 0 for |u| < 1 and have
   the sign of u elsewhere. A (n, n) is positive semi-definite with a positive diagonal. The accelerations are unique; redundant
   forces have the least norm of u_k sqrt(A_kk), which has no unit. `reached`: 1 or -1 for forces that have reached a limit, else 0; they
   stay there if the others can hold their speeds, so that under a growing load each reaches its limit once. `sense`: of a speed that
   leaves rest, 1 or -1, else 0; `sticks`: 1 for an independent subset of the speeds at rest, with which the others rest. It takes
   memory while it runs; other than 0 without. */
AC_PUBLIC int32_t ac_shares(int32_t n, const double *A, const double *b, const double *reached, double *share, double *sense,
                            double *sticks);

/* A model as a file has it; the format is in docs/background/model-file.md. */
typedef struct {
    ac_equations equations;
    double time;                 /* where it starts, consistent */
    const double *x, *z, *p, *c;
    const double *size;          /* (nx) and the next as in ac_request */
    const int32_t *rate;
    const char *names;           /* of the states, each with a 0 at its end */
} ac_model;

/* Why a file is not read: no model, another version of the format, cut, damaged, not what a model has to be, no memory. */
enum { AC_READ, AC_FOREIGN, AC_VERSION, AC_LENGTH, AC_CHECKSUM, AC_CONTENT, AC_NO_MEMORY };

AC_PUBLIC ac_model *ac_model_read(const void *bytes, size_t length, int32_t *why);
AC_PUBLIC void ac_model_free(ac_model *model);

#endif
