/* An FMU of FMI 2.0 for Model Exchange: x' = speed while it is on; at the end of a step in which x has passed 1, it asks for an event,
   at which x falls by 1 and n grows by 1. */
#include "fmi_types.h"

#include <stdlib.h>

typedef struct {
    double x, speed;
    int on, n;
} counter;

enum { X, RATE, SPEED, ON, N };

#define EXPORT __attribute__((visibility("default")))
#define DONE(name, ...) EXPORT int name(__VA_ARGS__)

EXPORT const char *fmi2GetTypesPlatform(void) { return "default"; }
EXPORT const char *fmi2GetVersion(void) { return "2.0"; }

EXPORT void *fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String guid, fmi2String place, const fmi2CallbackFunctions *f,
                             fmi2Boolean visible, fmi2Boolean logs) {
    (void)name, (void)type, (void)guid, (void)place, (void)f, (void)visible, (void)logs;
    counter *c = calloc(1, sizeof *c);
    if (c) *c = (counter){.speed = 1, .on = 1};
    return c;
}

EXPORT void fmi2FreeInstance(void *c) { free(c); }
DONE(fmi2SetupExperiment, void *c, int given, double tolerance, double start, int ends, double stop) {
    (void)c, (void)given, (void)tolerance, (void)start, (void)ends, (void)stop;
    return fmi2OK;
}
DONE(fmi2EnterInitializationMode, void *c) { return (void)c, fmi2OK; }
DONE(fmi2ExitInitializationMode, void *c) { return (void)c, fmi2OK; }
DONE(fmi2Terminate, void *c) { return (void)c, fmi2OK; }
DONE(fmi2EnterEventMode, void *c) { return (void)c, fmi2OK; }
DONE(fmi2EnterContinuousTimeMode, void *c) { return (void)c, fmi2OK; }
DONE(fmi2SetTime, void *c, double time) { return (void)c, (void)time, fmi2OK; }
DONE(fmi2Reset, counter *c) { return *c = (counter){.speed = 1, .on = 1}, fmi2OK; }

DONE(fmi2SetReal, counter *c, const unsigned *reference, size_t n, const double *value) {
    for (size_t k = 0; k < n; k++) *(reference[k] == SPEED ? &c->speed : &c->x) = value[k];
    return fmi2OK;
}
DONE(fmi2GetReal, counter *c, const unsigned *reference, size_t n, double *value) {
    for (size_t k = 0; k < n; k++) value[k] = reference[k] == X ? c->x : reference[k] == SPEED ? c->speed : c->on * c->speed;
    return fmi2OK;
}
DONE(fmi2SetBoolean, counter *c, const unsigned *reference, size_t n, const int *value) { return (void)reference, (void)n, c->on = *value, fmi2OK; }
DONE(fmi2GetInteger, counter *c, const unsigned *reference, size_t n, int *value) { return (void)reference, (void)n, *value = c->n, fmi2OK; }

DONE(fmi2SetContinuousStates, counter *c, const double *x, size_t n) { return (void)n, c->x = *x, fmi2OK; }
DONE(fmi2GetContinuousStates, counter *c, double *x, size_t n) { return (void)n, *x = c->x, fmi2OK; }
DONE(fmi2GetDerivatives, counter *c, double *rate, size_t n) { return (void)n, *rate = c->on * c->speed, fmi2OK; }
DONE(fmi2GetEventIndicators, counter *c, double *z, size_t n) { return (void)c, (void)z, (void)n, fmi2OK; }

DONE(fmi2CompletedIntegratorStep, counter *c, int final, int *event, int *end) {
    (void)final;
    *event = c->x > 1, *end = 0;
    return fmi2OK;
}
DONE(fmi2NewDiscreteStates, counter *c, fmi2EventInfo *info) {
    const int falls = c->x > 1;
    c->x -= falls, c->n += falls;
    *info = (fmi2EventInfo){.valuesOfContinuousStatesChanged = falls};
    return fmi2OK;
}

DONE(fmi2GetFMUstate, counter *c, void **state) {
    if (!(*state = malloc(sizeof *c))) return fmi2Error;
    return *(counter *)*state = *c, fmi2OK;
}
DONE(fmi2SetFMUstate, counter *c, const counter *state) { return *c = *state, fmi2OK; }
DONE(fmi2FreeFMUstate, void *c, void **state) { return (void)c, free(*state), *state = NULL, fmi2OK; }

/* What importers look for. */
#define NONE(name) DONE(name, void) { return fmi2Error; }
NONE(fmi2SetDebugLogging) NONE(fmi2SerializedFMUstateSize) NONE(fmi2SerializeFMUstate) NONE(fmi2DeSerializeFMUstate)
NONE(fmi2GetDirectionalDerivative) NONE(fmi2GetNominalsOfContinuousStates)
NONE(fmi2SetInteger) NONE(fmi2GetBoolean) NONE(fmi2SetString) NONE(fmi2GetString)
