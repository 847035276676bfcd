/* What the parts of a unit and of its instances share. */
#ifndef ACAUSAL_INSTANCE_H
#define ACAUSAL_INSTANCE_H

#include "file.h"
#include "lu.h"
#include "rodas.h"
#include "settle.h"
#include "unit.h"

/* Tapes beside those of the equations; their inputs are x, z, t, p, c, too; of the last two, then nominal values; of the last, then
   new constants and a time span. */
enum {
    AC_HEAD, AC_SHOWN, AC_GUARDS, AC_SCALES, AC_TIMED, AC_INSTANTS, AC_JUMPS, AC_CLOSING, AC_COORDINATES, AC_LIMITS, AC_ARGUMENTS,
    AC_LAWS, AC_CONTINUOUS, AC_TAPES
};
/* Square systems; their inputs are p, c, x, z, t: for all algebraic unknowns; for all unknowns at the start; for the algebraic
   unknowns that event indicators need, those that powers need; of the derivatives of the former, which are inputs behind t. */
enum { AC_ALGEBRAIC, AC_INITIAL, AC_INDICATING, AC_POWERING, AC_MOVING, AC_SQUARES };
/* Tapes that are evaluated at many points; their inputs are p, c, x, z, t, of the first the derivatives of AC_MOVING too:
   event indicators and their derivatives; supplied and dissipated power and stored energy, or nothing. */
enum { AC_INDICATORS, AC_ENERGIES, AC_ROW_TAPES };
/* What an entry of p is. */
enum { AC_TUNABLE, AC_FIXED, AC_INPUT, AC_STARTS, AC_INNER };

/* What a limit is, and so when it is looked at: of a parameter; required of parameters; of variables at the start. */
enum { AC_LIMITED, AC_REQUIRED, AC_REQUIRED_AT_START };

/* A condition: the switch that it sets, or -1; whether it holds at 0; whether it acts at the start; its jumps, from one on; whether
   it compares time with discrete variables alone. */
typedef struct {
    int32_t on, inclusive, at_start, jump, jumps, clocked;
} ac_guard;

/* A call of a function: the condition at which it happens; its results, from one on. */
typedef struct {
    int32_t guard, result, results;
} ac_call;

/* Calls a function; its arguments and results stand in arrays of the caller. Returns whether it fails. */
typedef int32_t ac_function(int32_t call, double time);

/* Constraints that are closed together, and the states that may change for that. */
typedef struct {
    int32_t rows, columns;
    const int32_t *row, *column;
} ac_level;

#define AC_LEVELS 8 /* derivatives of a constraint that hold besides it are fewer */
#define AC_NUMBERED 11
#define AC_MESSAGE 1024 /* bytes of a message */

struct ac_unit {
    ac_model_parts parts; /* first */
    /* Numbers of switches, discrete variables, closures, variables, watched conditions, those of time alone, instants, jumps,
       constraints, inputs, levels. */
    int32_t switches, discretes, closures, shown, watched, timed, instants, jumps, constraints, inputs, levels;
    ac_tape tape[AC_TAPES], squared[AC_SQUARES], row_tape[AC_ROW_TAPES];
    ac_square square[AC_SQUARES];
    const int32_t *role, *start_of;         /* (np) what each entry is; (nx) its entry of p that is its start, or -1 */
    const int32_t *input;                   /* (inputs, 2) entry of p and of its slope; then the entry of the time of both */
    const ac_guard *guard;                  /* (watched + timed) */
    const int32_t *jump;                    /* (jumps, 2): whether it is a state, and its place among these or discrete ones */
    const int32_t *scale_start, *scale_row; /* sparsity of the Jacobian of the watched conditions by x and z, in columns */
    const int32_t *close_start, *close_row; /* sparsity of the Jacobian of the constraints, in columns */
    const int32_t *closure;                 /* (constraints) closure that a constraint belongs to, or -1 */
    const int32_t *kind;                    /* (constraints) those of one equation have one number */
    const int32_t *coordinate;              /* states that are projected, as many as the tape has outputs */
    const int32_t *multiplier, *stands;     /* (constraints) places among z; (standing, 2) places of coordinates among z, and of their states */
    int32_t standing, laws, calls;          /* numbers of those places, of set-valued laws and of calls */
    const ac_call *call;                    /* (calls) in the order of data flow */
    const int32_t *result;                  /* (results, 2) discrete variables: the output, and what becomes it at the next instant; or one */
    const int32_t *law;                     /* (laws, 5) places of mode, offset, shared, share and slip among the discrete variables */
    const int32_t *equation;                /* (nz) place of each equation of g among those of AC_ALGEBRAIC */
    const int32_t *gradient_start, *gradient_row, *law_start, *law_row; /* sparsity (nz, laws) in columns: of the derivatives of their
                                               rates by z, of those of AC_ALGEBRAIC by their shares */
    ac_level level[AC_LEVELS];
    const double *damped;                   /* (nx) sizes of the states in the error test where vibrations are damped */
    const double *nominal, *reach, *follows, *size; /* (nx + nz); (nx) where they close loops, see `coordinate_scaling.py`, and follow a jump; (nz) below which changes are rounding, see `settle.c` */
    const double *bound;                    /* (limits, 3): least value of each, 1 where it has to be above that, and what it is */
    const char *limited;                    /* names of parameters, or what is wrong otherwise, each with a 0 at its end */
    const char *origin;                     /* of each expression that is differentiated, each with a 0 at its end; then the remedy */
    double span, tolerance;
    const char *token;
    ac_tables tables;
    const double **column;                  /* (tables.count) columns of the file; NULL where it has none */
    double file[];
};

/* What an instance goes on from, beside its arrays. */
typedef struct {
    double time, stop;                     /* stop: nan where none is known */
    double tolerance, damping, most;       /* settings; damping: 1 where vibrations are damped; most: steps of one call */
    double from, to, first_step, end;      /* the last step of the integration, the next one to try, where it ends */
    double next, event;                    /* of the instants that are known; event in the last step; infinite for none */
    double sure_time;                      /* of the last point at which the algebraic unknowns were solved for */
    double crowd;                          /* since when events follow one another closely */
    double undefined;                      /* time at which a condition has no value; the values there stand in event_y */
    double delay;                          /* for how long the time of the event is uncertain by the tolerance */
    double sharp, sharp_before, sharp_pace; /* smallest singular value of constraints at the ends of the last step, and its change over time */
    double firm;                           /* conditioning of the kept constraints when the integration began; 0 where none is spare */
    double since, longer, last;            /* start of the output interval; longer of the last two steps; last step */
    int32_t phase, simulates, known;       /* known: what of the values is that of the present, see AC_Z... */
    int32_t curved, integrates, first, failed; /* an interpolant is there, in Model Exchange a point; the integration goes on; the first event is to come */
    ac_pace pace;                          /* of the integration */
    int32_t crowded;                       /* events of the crowd */
    int32_t weak, hasty;                   /* events in a row with hardly any motion between; whether samples may have missed some */
    int32_t given;                         /* values were set since the last step, by which conditions may change at once */
    int32_t sure;                          /* whether there is such a point, with these parameters */
    int32_t blind;                         /* whether events are passed over */
    int32_t taken;                         /* steps since closed loops were at their constraints */
    int32_t pasts, crosses;                /* points that are remembered; whether the last step crosses a singular configuration */
    int32_t looked;                        /* whether conditions and rates at the end of the last step stand in `looks` */
} ac_now;

/* What is known at present: algebraic unknowns, rates, variables, conditions, values at the start, factors of g_z. */
enum { AC_Z = 1, AC_RATE = 2, AC_SHOW = 4, AC_GUARD = 8, AC_FIRST = 16, AC_FACTORS = 32 };
#define SETTLED 1e-7 /* change over the size after which the next one would be rounding, as in `Consistent` */

#define AC_ROWS 32         /* points at which indicators or powers are evaluated at once, at most */
#define AC_FIRST_SAMPLES 8 /* samples of the first step after an event */
#define AC_POINTS 4        /* points of the polynomial by which they cross it */
#define AC_PAST 72         /* points of steps that are remembered to cross a singular configuration: steps shrink by a third or less on the way */
#define AC_MOST_WEAK 100   /* events in a row with hardly any motion between are chattering */
#define AC_DUE 2           /* of `crossed`: the condition holds now whatever its value, until that changes */
#define AC_SLOTS 52        /* samples of indicators in a step that are kept at a time */

/* Points of a step: (AC_ROWS, ...) each; `found`: what is evaluated there; `solution`: of a square, `solved`: whether it is one. */
typedef struct {
    double *time, *x, *z, *found, *solution, *scale;
    int32_t solved[AC_ROWS];
} ac_samples;

/* Settings of a multistep method, as in `ac_request`. `size` must outlive the run; it is NULL for other methods. */
typedef struct {
    const double *size;
    double tolerance, newton;
    int32_t order;
} ac_multistep;

/* Counts of steps, refused ones, factorisations, evaluations of the equations, of parts of them, and integrations that were begun. */
typedef struct {
    int64_t steps, refused, factors, values, evaluations, begun;
} ac_counts;

/* Steps and refused steps up to a time, the farthest that a window of steps led, and slow windows in a row. */
typedef struct {
    int64_t steps, refused;
    double time, farthest;
    int32_t slow;
} ac_window;

#define AC_MODES 84 /* modes that a search tries: 5,000 sets of up to 8 saturations in random monotone feedback took 2 for each at most */

/* Search for a mode: n numbers, of which those at `place` are switches; the others, as discrete variables, change with them. */
typedef struct {
    int32_t n, switches, *place;            /* (switches) */
    double *seen;                           /* (AC_MODES, n) modes in their order */
    int32_t count, first, cycle;            /* of them; where modes begin to repeat themselves, after how many; 0 until they do */
    int32_t changes, base, *order, *chosen; /* enumeration: switches that change, and the mode of the cycle that they change */
    int32_t cycling;                        /* switches that change in the cycle: the first ones of `order` */
} ac_mode_search;

/* What the clock changes at an instant, where the caller of a run decides that: switches from then on, and conditions (timed) that become
   true; NULL where the file has a tape for it. */
typedef struct {
    const double *c, *fires;
} ac_clock;

struct ac_instance {
    const ac_unit *of;
    ac_now now;
    size_t saved;                           /* numbers from x on that belong to the state */
    double *x, *z, *p, *c, *truth, *held, *crossed; /* truth, crossed: of watched conditions, held: of those of time alone */
    double *before, *after, *dense;         /* interpolant: (n), (n), (AC_DENSE_ROWS, n); in Model Exchange the last point that was kept, its rates */
    double *past, *past_rate;               /* (AC_PAST, 1 + n) times, x and z of the last steps, the latest first; (AC_POINTS, nx) rates; for loops */
    double *sure;                           /* x and z of the last point at which z was solved for */
    double *rate, *shown, *guards, *work, *other, *flips; /* work, other: as long as any of x, z, p, c together and more */
    double *w[AC_TAPES], *values, *dw;      /* of the tapes; values: of the equations; dw: of the longest */
    ac_settler *settler[AC_SQUARES];
    ac_rodas *rodas;
    ac_stepper *idas, *stepper;             /* idas: NULL until a run asks for it; stepper: the one of the run */
    ac_multistep multistep;
    double *looks;                          /* values, rates and levels of indicators at the end of the last step */
    double *least, *width, *peak;           /* of indicators: levels of what was not positive, tolerance bands, greatest values since the last event */
    ac_samples samples;
    double *event_y, *crossing;             /* states and algebraic unknowns at the event; indicators that change there */
    double *sampled, *errors, *row_w;       /* work of `ac_locate`; array of the row tapes */
    double *kept, *round;                   /* points before an event iteration and before a round of it, see ac_save */
    double *continuous;                     /* outputs of AC_CONTINUOUS, twice */
    double *law_values, *redundant;         /* (laws, 5) before a decision; (laws) 1 for those that are redundant */
    ac_mode_search search;
    double *mode;                           /* that is tried: switches, discrete variables, x; then that before */
    ac_counts counts;
    ac_window window;                       /* of the integration */
    double energy[2];                       /* supplied and dissipated energy */
    struct ac_recorder *recorder;           /* of a run; NULL in Co-Simulation */
    ac_clock clock;                         /* of an instant of a run */
    ac_function *function;                  /* of the caller of a run */
    double *arguments, *results;            /* of all its calls */
    ac_external *const *external;           /* (externals) functions of other libraries that are told of accepted steps */
    int32_t externals;
    double *acts;                           /* (watched + timed) conditions that changed in an event iteration: those to blame where it fails */
    int32_t why;                            /* reason of the last failure */
    double *step_y, step_time;              /* a step as the integrator writes it */
    double ends[3];                         /* of the integration, with the first output or communication point between */
    int32_t going;                          /* whether the integrator is where the last step ended */
    double *order;                          /* of pivots, while they are copied; x and z on the way to a point */
    int32_t prepared;                       /* tapes whose early runs are done */
    double *block;
    char message[AC_MESSAGE];
};

/* Stands at a part of a step. */
typedef void ac_part_of_step(ac_instance *i, double s);

#define AC_UNSOLVED_TEXT "the equations have no solution here."
#define AC_FLAT_TEXT "closed loops pass a flat position: two ways lead on from there, and rounding would choose one."

void ac_put(double *to, const double *from, int32_t count);     /* copy; NULL: nothing */
int32_t ac_fail(ac_instance *i, int32_t status, const char *text);
int32_t ac_refuse_chatter(ac_instance *i);                      /* events with hardly any motion between follow one another without end */
int32_t ac_refuse(ac_instance *i, int32_t why, const char *text); /* the same with AC_FAILED for one of these reasons: */
enum { AC_SINGULAR = 16, AC_FOLD, AC_UNDEFINED, AC_UNSETTLED, AC_DISCONTINUOUS, AC_NO_NUMBER, AC_APART, AC_CONTRADICTION, AC_FUNCTION };
void ac_restart(ac_instance *i);
void ac_moved(ac_instance *i);
void ac_changed(ac_instance *i);
/* Save what an event iteration changes, and go back to that: x, z, c, truth, crossed. */
void ac_save(ac_instance *i, double *saved);
void ac_restore(ac_instance *i, double *saved);
const double *ac_run(ac_instance *i, int32_t tape);             /* evaluate at the present; its array */
int32_t ac_solve(ac_instance *i, int32_t square);               /* from the present values on */
int32_t ac_know(ac_instance *i, int32_t what);
int32_t ac_indicator_rates(ac_instance *i);                     /* conditions and their rates, all in `guards` */
/* Add seeds to changes, and read changes, by references: of what is known, dt, dx and dp; of unknowns, those in `of`. */
int32_t ac_seed(ac_instance *i, const uint32_t *known, size_t count, double *dt, double *dx, double *dp, const double *seed,
                double *found);
int32_t ac_pick(ac_instance *i, const uint32_t *unknown, size_t count, double *of[3], const double *seed, double *found);
int32_t ac_close(ac_instance *i, const double *held, double *from);
int32_t ac_close_all(ac_instance *i);
int ac_cross(ac_instance *i);
void ac_follow_states(ac_instance *i);                          /* guesses of coordinates where the states have them */
int32_t ac_counting(const ac_instance *i, const ac_level *l, int32_t *row);
double ac_dot(const double *a, const double *b, int32_t n);
/* Size of the equation of each of m rows: the longest one of A (m, n) that belongs to it, 0 where all vanish. */
void ac_measure(const ac_instance *i, const int32_t *row, int32_t m, const double *A, int32_t n, double *size);
const double *ac_constraints(ac_instance *i, const int32_t *row, int32_t m, const int32_t *column, int32_t n, double *A);
int32_t ac_initial(ac_instance *i);
int32_t ac_limits(ac_instance *i, int at_start);                /* what is broken: of parameters, or of variables at the start */
int32_t ac_happen(ac_instance *i, ac_happened *found);
int32_t ac_call_functions(ac_instance *i, const double *fires); /* before anything jumps */
int32_t ac_complete_step(ac_instance *i);
int32_t ac_complete_event(ac_instance *i);
void ac_renew_inputs(ac_instance *i);
double ac_near(const ac_instance *i);                           /* times that near are one */
double ac_next_instant(ac_instance *i, double *between);
void ac_find_scales(ac_instance *i);                            /* changes of watched conditions by nominal changes of x and z */
double ac_width(const ac_instance *i, int32_t guard);           /* how far off a condition may be, by the scales found last */
void ac_stand(ac_instance *i, double time);                     /* at a time within the last step of Co-Simulation */
int32_t ac_refuse_jump(ac_instance *i);
int32_t ac_linearise(ac_instance *i);                           /* factors of g_z at the present */
void ac_evaluate(const ac_instance *i, const ac_tape *t, double *w); /* a tape of x, z, t, p, c at the present */
void ac_read_laws(const ac_instance *i, const double *c, double *found); /* discrete variables of the laws, (laws, 5) */
int32_t ac_decide_laws(ac_instance *i, const double *was);      /* laws at rest, given those variables before the event */
int ac_laws_are_open(const ac_instance *i);                     /* whether a law at rest was never decided */
int32_t ac_part_laws(ac_instance *i, int32_t *parted);
void ac_begin_search(ac_instance *i, int32_t n);                /* for a mode of n numbers */
/* Replace the mode that the values of the current one imply by the next one to try; 0 where none is left. */
int ac_next_mode(ac_mode_search *s, const double *current, double *mode);
double ac_leeway(const ac_instance *i, int32_t guard);          /* time in which a watched condition changes by its scale */
int32_t ac_refuse_discontinuity(ac_instance *i, double leeway); /* refuse jumps since the round began of what is differentiated */
void ac_sample_step(ac_instance *i, int32_t rows);
int32_t ac_sample_indicators(ac_instance *i, int32_t rows);
int ac_matters(ac_instance *i, int32_t row, int32_t guard);      /* whether any equation depends on a condition in a sample */
int32_t ac_sample_energies(ac_instance *i, int32_t rows);
int32_t ac_locate(ac_instance *i);                              /* the first event of the last step */
int32_t ac_add_work(ac_instance *i, double from, double to);
int32_t ac_stored_energy(ac_instance *i, double *stored);
void ac_add_jump(ac_instance *i, double change);
double ac_sharpness(ac_instance *i);
int ac_is_unfit(ac_instance *i);
void ac_keep(ac_instance *i);
int32_t ac_refuse_flat(ac_instance *i);                         /* Model Exchange: loops that passed a flat position since the last step */
int32_t ac_flat(ac_instance *i, ac_part_of_step *at, const double ends[2], double *where);

#endif
