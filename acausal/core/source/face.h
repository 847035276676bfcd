/* What the faces of both versions of FMI share: an instance with its state in the standard's sense, its log, and what is done
   in each call. Answers are numbers of fmi2Status and fmi3Status, which agree. */
#ifndef ACAUSAL_FACE_H
#define ACAUSAL_FACE_H

#include "fmi_types.h"
#include "unit.h"

/* States of the standard, and sets of them. A lost instance can only be reset, brought back to a stored state or freed. */
enum {
    AC_NEW = 1, AC_CONFIGURED = 2, AC_STARTING = 4, AC_EVENT = 8, AC_CONTINUOUS = 16, AC_STEPPING = 32, AC_TERMINATED = 64,
    AC_LOST = 128,
    AC_STARTED = AC_EVENT | AC_CONTINUOUS | AC_STEPPING,
    AC_VALUED = AC_STARTING | AC_STARTED | AC_TERMINATED,
    AC_SOUND = AC_NEW | AC_CONFIGURED | AC_VALUED,
    AC_ANY = AC_SOUND | AC_LOST
};

/* Categories of the log. */
enum { AC_LOG_ERRORS, AC_LOG_EVENTS, AC_LOGS };

typedef struct ac_face ac_face;

/* Hand a message to the importer as its version wants it. */
typedef void ac_say(const ac_face *f, int status, const char *category, const char *message);

struct ac_face {
    ac_unit *unit;
    ac_instance *engine;
    int mode;
    int simulates, events, early; /* Co-Simulation; whether the importer handles events; whether steps may end at them */
    int stated;                   /* whether the times below were */
    int ends, waits;              /* whether it cannot go on; whether an event waits to be handled */
    double start, stop, tolerance;
    int logs[AC_LOGS];
    ac_say *say;
    union {
        fmi2CallbackLogger two;
        fmi3LogMessageCallback three;
    } logger;
    void *environment;
    char name[]; /* of the instance */
};

ac_face *ac_face_make(const char *name, int logging, ac_say *say);
ac_face *ac_face_load(ac_face *f, const char *call, const char *token, const char *resources, int is_uri);
void ac_face_free(ac_face *f);

void ac_face_log(const ac_face *f, int category, const char *format, ...);
int ac_face_refuse(const ac_face *f, const char *call, const char *format, ...);
int ac_face_discard(const ac_face *f, const char *call, const char *format, ...);
int ac_face_in(const ac_face *f, const char *call, int modes);
int ac_face_answer(ac_face *f, const char *call, int32_t end);
int ac_face_none(const ac_face *f, const char *call, size_t count, const char *what);
int ac_face_logging(ac_face *f, const char *call, int on, size_t count, const char *const *category);

/* The course of a run. */
int ac_face_times(ac_face *f, const char *call, double tolerance, double start, double stop);
int ac_face_begin(ac_face *f, const char *call);
int ac_face_begun(ac_face *f, const char *call);
int ac_face_update(ac_face *f, const char *call, ac_happened *found);
int ac_face_enter_event(ac_face *f, const char *call);
int ac_face_leave_event(ac_face *f, const char *call, int simulates);
int ac_face_completed(ac_face *f, const char *call);
int ac_face_terminate(ac_face *f, const char *call);
int ac_face_reset(ac_face *f, const char *call);

/* How a step ended: at an event that waits, for good, and when. */
typedef struct {
    int event, ends, early;
    double reached;
} ac_stepped;

int ac_face_step(ac_face *f, const char *call, double from, double size, ac_stepped *done);

/* Values. */
typedef int32_t ac_reader(ac_instance *i, double *value);

int ac_face_get(ac_face *f, const char *call, const uint32_t *reference, size_t count, double *value);
int ac_face_set(ac_face *f, const char *call, const uint32_t *reference, size_t count, const double *value);
int ac_face_set_slopes(ac_face *f, const char *call, const uint32_t *reference, size_t count, const int *order,
                       const double *slope);
int ac_face_set_time(ac_face *f, const char *call, double time);
int ac_face_set_states(ac_face *f, const char *call, const double *x, size_t count);
int ac_face_read_states(ac_face *f, const char *call, ac_reader *reader, double *value, size_t count);
int ac_face_read_indicators(ac_face *f, const char *call, double *value, size_t count);

typedef int32_t ac_slope(ac_instance *i, const uint32_t *unknown, size_t unknowns, const uint32_t *known, size_t knowns,
                         const double *seed, double *sensitivity);

int ac_face_slope(ac_face *f, const char *call, ac_slope *slope, const uint32_t *unknown, size_t unknowns,
                  const uint32_t *known, size_t knowns, const double *seed, double *sensitivity);

/* Stored states of an instance. */
int ac_face_store(ac_face *f, const char *call, void **stored);
int ac_face_restore(ac_face *f, const char *call, const void *stored);
int ac_face_drop(ac_face *f, void **stored);
int ac_face_stored_size(ac_face *f, const char *call, const void *stored, size_t *size);
int ac_face_serialize(ac_face *f, const char *call, const void *stored, void *bytes, size_t size);
int ac_face_deserialize(ac_face *f, const char *call, const void *bytes, size_t size, void **stored);

/* The file of a model; both are freed by whoever calls. */
char *ac_face_path(const char *resources, int is_uri);
void *ac_face_bytes(const char *path, size_t *length);

#endif
