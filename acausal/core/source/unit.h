/* A model that other tools run: what is stored of it, and its instances. The faces of FMI 2 and 3 are thin layers on this.

   Values are read and written by references: time; states x; their rates; p; variables; indicators; the settings. */
#ifndef ACAUSAL_UNIT_H
#define ACAUSAL_UNIT_H

#include "core.h"

typedef struct ac_unit ac_unit;
typedef struct ac_instance ac_instance;

AC_PUBLIC ac_unit *ac_unit_read(const void *bytes, size_t length, int32_t *why);
AC_PUBLIC void ac_unit_free(ac_unit *unit);
const char *ac_unit_why(int32_t why);              /* in words */
const char *ac_unit_token(const ac_unit *unit);    /* tells this model from others */

/* Phases, in this order: being set up, being initialised, at an event, between events. */
enum { AC_SET_UP, AC_INITIALISING, AC_AT_EVENT, AC_RUNNING };
/* How a call ended: done; refused with nothing changed; tried elsewhere where steps are shorter; never again. */
enum { AC_OK, AC_REFUSED, AC_RETRY, AC_FAILED, AC_PAUSE, AC_LEAVE, AC_EXCHANGE }; /* the last three: of runs alone */

/* An instance of a unit, which has to stay; NULL without memory. */
AC_PUBLIC ac_instance *ac_instance_make(const ac_unit *unit);
AC_PUBLIC void ac_instance_free(ac_instance *i);
int32_t ac_reset(ac_instance *i);                  /* as it was made */
AC_PUBLIC const char *ac_message(const ac_instance *i);      /* of the last call that was not AC_OK */
int32_t ac_phase(const ac_instance *i);
double ac_time(const ac_instance *i);

int32_t ac_states(const ac_instance *i);           /* how many */
int32_t ac_indicators(const ac_instance *i);
int32_t ac_get(ac_instance *i, const uint32_t *reference, size_t count, double *value);
/* Settable are: before the end of the initialisation all parameters, starts, settings and inputs; then tunable parameters and
   inputs; between events in Model Exchange the time and states, too, as CasADi evaluates at any point through this alone. */
int32_t ac_set(ac_instance *i, const uint32_t *reference, size_t count, const double *value);
int32_t ac_set_slopes(ac_instance *i, const uint32_t *reference, size_t count, const double *slope); /* of inputs, by time */

/* Begin to initialise at a time; tolerance 0: as the setting has it; horizon: a stop time, or nan. */
int32_t ac_begin(ac_instance *i, double time, double stop, double tolerance, int32_t simulates);
int32_t ac_begun(ac_instance *i);                  /* consistent values from here on; then it is at an event */

/* What an event changed, and the next one that is known. */
typedef struct {
    int32_t states, changed, ends, planned; /* whether states changed, or anything; whether it cannot go on; whether a next time is known */
    double next;
} ac_happened;

int32_t ac_event(ac_instance *i, ac_happened *found);   /* all that happens at this instant; it stays at the event */
int32_t ac_enter_event(ac_instance *i);
int32_t ac_leave_event(ac_instance *i);

/* Model Exchange, between events. */
int32_t ac_set_time(ac_instance *i, double time);
int32_t ac_set_states(ac_instance *i, const double *x);
int32_t ac_get_states(ac_instance *i, double *x);
int32_t ac_get_rates(ac_instance *i, double *rate);
int32_t ac_get_nominals(ac_instance *i, double *nominal);
int32_t ac_get_indicators(ac_instance *i, double *value);
int32_t ac_completed(ac_instance *i);              /* the present ends a step that the importer keeps */

/* Co-Simulation: from the present time towards another; with `early`, back at the first event, at *reached. */
int32_t ac_step(ac_instance *i, double to, int32_t early, double *reached, int32_t *event);

/* Directional derivatives: of unknowns (rates, variables, indicators) along a seed of knowns (time, states, inputs, parameters), and
   the transpose. */
int32_t ac_forward(ac_instance *i, const uint32_t *unknown, size_t unknowns, const uint32_t *known, size_t knowns,
                   const double *seed, double *sensitivity);
int32_t ac_backward(ac_instance *i, const uint32_t *unknown, size_t unknowns, const uint32_t *known, size_t knowns,
                    const double *seed, double *sensitivity);

/* All that an instance goes on from, as bytes: the copy goes on bit by bit as the original does. */
size_t ac_state_size(const ac_instance *i);
void ac_state_write(const ac_instance *i, void *bytes);
int32_t ac_state_read(ac_instance *i, const void *bytes, size_t length);

#endif
