/* Runs of the hybrid loop that record rows, as `simulate` asks for them. */
#ifndef ACAUSAL_HYBRID_H
#define ACAUSAL_HYBRID_H

#include "instance.h"

/* Methods of integration. */
enum { AC_RODAS, AC_IDAS };

/* How a run is integrated. */
typedef struct {
    int32_t method, damps, blind;    /* damps: as of the settings, of Rodas5P; blind: whether events are passed over */
    double tolerance, step;          /* first step, chosen if 0 */
    ac_multistep multistep;          /* of IDAS */
} ac_run_method;

/* What a run is asked for. */
typedef struct {
    double end;                      /* where it stops; what happens there is left to the caller */
    int64_t steps, longest;          /* steps, refused ones too: after which it pauses; between two outputs or events at most */
    int32_t outputs, room;           /* outputs in all; rows and events at most */
    const double *time;              /* (outputs) ascending */
    double *row_time, *row_x, *row_z, *row_c; /* (room, ...) rows at outputs, after events, and at the end */
    double *row_work;                /* (room, 2) supplied and dissipated energy since it began */
    double *event_time;              /* (room) of each event */
} ac_run_request;

/* How far it is. */
typedef struct {
    double time, step;               /* reached; the longer of the last two steps, 0 for none */
    double supplied, dissipated;     /* energies since it began */
    int64_t steps, refused, factors, values, evaluations, begun;
    int64_t since;                   /* steps since the last output or event */
    int32_t rows, events, hasty, why; /* why: as of `ac_stepper_go` or `ac_refuse` */
    int32_t weak;                    /* events in a row with hardly any motion between */
} ac_run_state;

struct ac_recorder {
    const ac_run_request *run;
    ac_run_state *state;
    int64_t left, since;             /* steps before a pause; steps since the last output or event */
    double output;                   /* the next one: what happens there needs no row of its own */
    int32_t rows, events;            /* before the last step, with the energies until then: what a run in doubt goes back to */
    double energy[2];
};

/* Why a run came back: it is at its end; at its room; at its pause; at an event whose iteration failed; it is in doubt what happens
   next; other independent constraints are to be selected. */
enum { AC_RUN_END, AC_RUN_FULL, AC_RUN_PAUSED, AC_RUN_EVENT, AC_RUN_DOUBT, AC_RUN_UNFIT };

/* Take an instance to a consistent point, from which it runs; `truth`: which watched conditions hold. AC_FAILED without memory. */
AC_PUBLIC int32_t ac_run_begin(ac_instance *i, const ac_run_method *method, double time, const double *x, const double *z, const double *p,
                               const double *c, const double *truth);
AC_PUBLIC int32_t ac_run_go(ac_instance *i, const ac_run_request *run, ac_run_state *state);
/* Let happen what happens at the present: what the clock changes, and watched conditions that change now, as of `crossed`. Returns whether
   anything changed; where it fails -1, and why. `acts`: (watched + timed) conditions to blame. */
AC_PUBLIC int32_t ac_run_happen(ac_instance *i, const double *c, const double *fires, const double *crossed, double *acts, int32_t *why);
/* The function that is called at events, and arrays of the arguments and results of all calls; before a run. */
AC_PUBLIC void ac_run_functions(ac_instance *i, ac_function *function, double *arguments, double *results);
/* Functions of other libraries that are told of accepted steps; before a run. */
AC_PUBLIC void ac_run_externals(ac_instance *i, int32_t count, ac_external *const *external);
/* Values at the present: states, algebraic unknowns, constants, conditions that hold, indicators that change now. */
AC_PUBLIC void ac_run_values(const ac_instance *i, double *x, double *z, double *c, double *truth, double *crossed);
/* The time at which a condition has no value, with states and algebraic unknowns there. */
AC_PUBLIC double ac_run_undefined(const ac_instance *i, double *x, double *z);

/* Set-valued laws that are redundant at rest, in the first decision that found some. */
AC_PUBLIC void ac_redundant_laws(const ac_instance *i, double *redundant);

int ac_creeps(ac_instance *i, const ac_progress *done);
int32_t ac_meet_flat(ac_instance *i, double *shorter);
int ac_is_full(const ac_instance *i);
void ac_record_event(ac_instance *i, int32_t changed); /* and stand there; a row where anything changed */
void ac_hold(ac_instance *i);           /* the present is what a run goes back to */
void ac_retreat(ac_instance *i);        /* go back to where the last step began */
int32_t ac_go(ac_instance *i, double to, int32_t early, int32_t *event);

#endif
