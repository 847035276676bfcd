/* Do what importers do: importer VERSION KIND RESOURCES TOKEN STOP STEPS CYCLES STATES INDICATORS REFERENCE..., KIND 0 for Model
   Exchange, 1 for Co-Simulation. Instantiates, initialises, steps, stores, resets and frees as often as asked for, and prints the
   time and the values of the references after each step of the last time. Ends with 1 where a call fails. */
#include "fmi.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int version;
static void *one;

static void say2(fmi2ComponentEnvironment e, fmi2String name, fmi2Status status, fmi2String category, fmi2String message, ...) {
    (void)e, (void)name, (void)category;
    if (status > fmi2Warning) fprintf(stderr, "%s\n", message);
}

static void say3(fmi3InstanceEnvironment e, fmi3Status status, fmi3String category, fmi3String message) {
    (void)e, (void)category;
    if (status > fmi3Warning) fprintf(stderr, "%s\n", message);
}

static void right(int status) {
    if (status) exit(1);
}

#define BOTH(name, ...) right(version == 2 ? (int)fmi2##name(__VA_ARGS__) : (int)fmi3##name(__VA_ARGS__))

static void *room(size_t count) {
    void *found = calloc(count + 1, sizeof(double));
    if (!found) exit(2);
    return found;
}

static void make(int simulates, const char *resources, const char *token) {
    const fmi2CallbackFunctions functions = {say2, NULL, NULL, NULL, NULL};
    if (version == 2) {
        char *uri = room(strlen(resources));
        sprintf(uri, "file:%s", resources);
        one = fmi2Instantiate("one", simulates ? fmi2CoSimulation : fmi2ModelExchange, token, uri, &functions, 0, 1);
        free(uri);
    } else if (simulates) {
        one = fmi3InstantiateCoSimulation("one", token, resources, 0, 1, 0, 0, NULL, 0, NULL, say3, NULL);
    } else {
        one = fmi3InstantiateModelExchange("one", token, resources, 0, 1, NULL, say3);
    }
    if (!one) exit(1);
}

static void start(double stop) {
    if (version == 2) {
        right(fmi2SetupExperiment(one, 1, 1e-6, 0, 1, stop));
        right(fmi2EnterInitializationMode(one));
    } else {
        right(fmi3EnterInitializationMode(one, 1, 1e-6, 0, 1, stop));
    }
    BOTH(ExitInitializationMode, one);
}

static void values(const uint32_t *reference, size_t count, double *value) {
    right(version == 2 ? (int)fmi2GetReal(one, reference, count, value) : (int)fmi3GetFloat64(one, reference, count, value, count));
}

static void step(double from, double size) {
    fmi3Boolean event, ends, early;
    double reached;
    right(version == 2 ? (int)fmi2DoStep(one, from, size, 1) : (int)fmi3DoStep(one, from, size, 1, &event, &ends, &early, &reached));
}

/* The next known time; events until nothing changes. */
static double update(void) {
    fmi3Boolean again = 1, ends, nominals, states, planned = 0;
    double next = INFINITY;
    while (again && version == 3) right(fmi3UpdateDiscreteStates(one, &again, &ends, &nominals, &states, &planned, &next));
    for (fmi2EventInfo info = {.newDiscreteStatesNeeded = 1}; info.newDiscreteStatesNeeded && version == 2;) {
        right(fmi2NewDiscreteStates(one, &info));
        planned = info.nextEventTimeDefined, next = info.nextEventTime;
    }
    BOTH(EnterContinuousTimeMode, one);
    return planned ? next : INFINITY;
}

static void rates(double *rate, size_t n) {
    right(version == 2 ? (int)fmi2GetDerivatives(one, rate, n) : (int)fmi3GetContinuousStateDerivatives(one, rate, n));
}

/* A step of Heun's method in Model Exchange, and the events at its end. */
static void exchange(double from, double to, size_t n, size_t m, double *next, double *work) {
    double *x = work, *y = x + n, *f = y + n, *g = f + n, *before = g + n, *after = before + m;
    int event = *next <= to;
    BOTH(GetContinuousStates, one, x, n);
    BOTH(GetEventIndicators, one, before, m);
    rates(f, n);
    for (size_t k = 0; k < n; k++) y[k] = x[k] + (to - from) * f[k];
    BOTH(SetTime, one, to);
    BOTH(SetContinuousStates, one, y, n);
    rates(g, n);
    for (size_t k = 0; k < n; k++) y[k] = x[k] + 0.5 * (to - from) * (f[k] + g[k]);
    BOTH(SetContinuousStates, one, y, n);
    BOTH(GetEventIndicators, one, after, m);
    for (size_t k = 0; k < m; k++) event |= (before[k] > 0) != (after[k] > 0);
    fmi2Boolean asked2 = 0, ends2;
    fmi3Boolean asked3 = 0, ends3;
    right(version == 2 ? (int)fmi2CompletedIntegratorStep(one, 1, &asked2, &ends2)
                       : (int)fmi3CompletedIntegratorStep(one, 1, &asked3, &ends3));
    if (!event && !asked2 && !asked3) return;
    BOTH(EnterEventMode, one);
    *next = update();
}

/* Store the state, as bytes too, go on from these, and forget both. */
static void store(void) {
    void *state = NULL, *other = NULL;
    size_t size;
    right(version == 2 ? (int)fmi2GetFMUstate(one, &state) : (int)fmi3GetFMUState(one, &state));
    right(version == 2 ? (int)fmi2SerializedFMUstateSize(one, state, &size) : (int)fmi3SerializedFMUStateSize(one, state, &size));
    void *bytes = room(size);
    if (version == 2) {
        right(fmi2SerializeFMUstate(one, state, bytes, size));
        right(fmi2DeSerializeFMUstate(one, bytes, size, &other));
        right(fmi2SetFMUstate(one, other));
        right(fmi2FreeFMUstate(one, &state));
        right(fmi2FreeFMUstate(one, &other));
    } else {
        right(fmi3SerializeFMUState(one, state, bytes, size));
        right(fmi3DeserializeFMUState(one, bytes, size, &other));
        right(fmi3SetFMUState(one, other));
        right(fmi3FreeFMUState(one, &state));
        right(fmi3FreeFMUState(one, &other));
    }
    free(bytes);
}

static void cycle(int simulates, double stop, int steps, const uint32_t *reference, size_t count, size_t n, size_t m, int print) {
    double *work = room(4 * n + 2 * m), *value = room(count), next = INFINITY;
    start(stop);
    if (!simulates) next = update();
    for (int k = 0; k < steps; k++) {
        const double from = stop * k / steps, to = stop * (k + 1) / steps;
        if (simulates) step(from, to - from);
        else exchange(from, to, n, m, &next, work);
        if (k == steps / 2) store();
        values(reference, count, value);
        if (!print) continue;
        printf("%.17g", to);
        for (size_t j = 0; j < count; j++) printf(" %.17g", value[j]);
        printf("\n");
    }
    BOTH(Terminate, one);
    free(value);
    free(work);
}

int main(int count, char **given) {
    if (count < 10) return 2;
    version = atoi(given[1]);
    const int simulates = atoi(given[2]), steps = atoi(given[6]), cycles = atoi(given[7]);
    const size_t n = (size_t)atoi(given[8]), m = (size_t)atoi(given[9]), references = (size_t)(count - 10);
    uint32_t *reference = room(references);
    for (size_t k = 0; k < references; k++) reference[k] = (uint32_t)strtoul(given[10 + k], NULL, 10);
    for (int k = 1; k <= cycles; k++) {
        make(simulates, given[3], given[4]);
        if (k % 2) {
            cycle(simulates, atof(given[5]), steps, reference, references, n, m, 0);
            BOTH(Reset, one);
        }
        cycle(simulates, atof(given[5]), steps, reference, references, n, m, k == cycles);
        if (version == 2) fmi2FreeInstance(one);
        else fmi3FreeInstance(one);
    }
    free(reference);
    return 0;
}
