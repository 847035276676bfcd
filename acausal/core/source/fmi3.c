/* The face of FMI 3.0: the course of a run. */
#include "face.h"
#include "fmi.h"

#include <math.h>

static void say(const ac_face *f, int status, const char *category, const char *message) {
    if (f->logger.three) f->logger.three(f->environment, (fmi3Status)status, category, message);
}

static ac_face *made(fmi3String name, fmi3Boolean logging, fmi3InstanceEnvironment environment, fmi3LogMessageCallback log) {
    ac_face *f = ac_face_make(name, logging, say);
    if (f) f->logger.three = log, f->environment = environment;
    return f;
}

const char *fmi3GetVersion(void) { return "3.0"; }

fmi3Status fmi3SetDebugLogging(fmi3Instance i, fmi3Boolean on, size_t count, const fmi3String *category) {
    return ac_face_logging(i, __func__, on, count, category);
}

fmi3Instance fmi3InstantiateModelExchange(fmi3String name, fmi3String token, fmi3String resources, fmi3Boolean visible,
                                          fmi3Boolean logging, fmi3InstanceEnvironment environment,
                                          fmi3LogMessageCallback log) {
    ac_face *f = made(name, logging, environment, log);
    (void)visible;
    return f ? ac_face_load(f, __func__, token, resources, 0) : NULL;
}

/* Steps end early at events that the importer handles: there is nothing between communication points to show it else. */
fmi3Instance fmi3InstantiateCoSimulation(fmi3String name, fmi3String token, fmi3String resources, fmi3Boolean visible,
                                         fmi3Boolean logging, fmi3Boolean events, fmi3Boolean early,
                                         const fmi3ValueReference *intermediate, size_t intermediates,
                                         fmi3InstanceEnvironment environment, fmi3LogMessageCallback log,
                                         fmi3IntermediateUpdateCallback update) {
    ac_face *f = made(name, logging, environment, log);
    (void)visible, (void)intermediate, (void)intermediates, (void)update;
    if (!f) return NULL;
    f->simulates = 1, f->events = events, f->early = events && early;
    return ac_face_load(f, __func__, token, resources, 0);
}

fmi3Instance fmi3InstantiateScheduledExecution(fmi3String name, fmi3String token, fmi3String resources, fmi3Boolean visible,
                                               fmi3Boolean logging, fmi3InstanceEnvironment environment,
                                               fmi3LogMessageCallback log, fmi3ClockUpdateCallback update,
                                               fmi3LockPreemptionCallback lock, fmi3UnlockPreemptionCallback unlock) {
    ac_face *f = made(name, logging, environment, log);
    (void)token, (void)resources, (void)visible, (void)update, (void)lock, (void)unlock;
    if (f) ac_face_none(f, __func__, 1, "partitions, so that there is no Scheduled Execution of it");
    ac_face_free(f);
    return NULL;
}

void fmi3FreeInstance(fmi3Instance i) { ac_face_free(i); }

fmi3Status fmi3EnterConfigurationMode(fmi3Instance i) {
    if (!ac_face_in(i, __func__, AC_NEW)) return fmi3Error;
    ((ac_face *)i)->mode = AC_CONFIGURED;
    return fmi3OK;
}

fmi3Status fmi3ExitConfigurationMode(fmi3Instance i) {
    if (!ac_face_in(i, __func__, AC_CONFIGURED)) return fmi3Error;
    ((ac_face *)i)->mode = AC_NEW;
    return fmi3OK;
}

fmi3Status fmi3EnterInitializationMode(fmi3Instance i, fmi3Boolean has_tolerance, fmi3Float64 tolerance, fmi3Float64 start,
                                       fmi3Boolean has_stop, fmi3Float64 stop) {
    const int answer = ac_face_times(i, __func__, has_tolerance ? tolerance : 0, start, has_stop ? stop : (double)NAN);
    return answer == fmi3OK ? ac_face_begin(i, __func__) : answer;
}

fmi3Status fmi3ExitInitializationMode(fmi3Instance i) { return ac_face_begun(i, __func__); }

fmi3Status fmi3EnterEventMode(fmi3Instance i) { return ac_face_enter_event(i, __func__); }

fmi3Status fmi3Terminate(fmi3Instance i) { return ac_face_terminate(i, __func__); }

fmi3Status fmi3Reset(fmi3Instance i) { return ac_face_reset(i, __func__); }

/* Discrete states follow from the others wherever they are read. */
fmi3Status fmi3EvaluateDiscreteStates(fmi3Instance i) {
    return ac_face_in(i, __func__, AC_STARTING | AC_EVENT) ? fmi3OK : fmi3Error;
}

fmi3Status fmi3UpdateDiscreteStates(fmi3Instance i, fmi3Boolean *again, fmi3Boolean *ends, fmi3Boolean *nominals,
                                    fmi3Boolean *states, fmi3Boolean *planned, fmi3Float64 *next) {
    ac_happened found;
    const int answer = ac_face_update(i, __func__, &found);
    if (answer != fmi3OK) return answer;
    *again = *nominals = false;
    *ends = found.ends, *states = found.states, *planned = found.planned, *next = found.next;
    return fmi3OK;
}

fmi3Status fmi3EnterContinuousTimeMode(fmi3Instance i) { return ac_face_leave_event(i, __func__, 0); }

fmi3Status fmi3CompletedIntegratorStep(fmi3Instance i, fmi3Boolean final, fmi3Boolean *event, fmi3Boolean *ends) {
    (void)final;
    *event = *ends = false;
    return ac_face_completed(i, __func__);
}

fmi3Status fmi3EnterStepMode(fmi3Instance i) { return ac_face_leave_event(i, __func__, 1); }

fmi3Status fmi3DoStep(fmi3Instance i, fmi3Float64 from, fmi3Float64 size, fmi3Boolean final, fmi3Boolean *event,
                      fmi3Boolean *ends, fmi3Boolean *early, fmi3Float64 *reached) {
    ac_stepped done = {0};
    (void)final;
    const int answer = ac_face_step(i, __func__, from, size, &done);
    *event = done.event, *ends = done.ends, *early = done.early, *reached = done.reached;
    return answer;
}

fmi3Status fmi3ActivateModelPartition(fmi3Instance i, fmi3ValueReference clock, fmi3Float64 time) {
    (void)clock, (void)time;
    return ac_face_none(i, __func__, 1, "partitions");
}
