/* Call the faces of FMI in any order: face_calls RESOURCES TOKEN CALLS. Most calls are out of place; whatever they answer, memory
   is not touched beyond what is theirs and all of it is given back. Prints how many calls of each version went well. */
#include "fmi.h"

#include <stdio.h>
#include <stdlib.h>

#define MOST 8      /* values at once */
#define RUN 60      /* calls on an instance */
#define ARRAY 4096  /* more states and indicators than a model has here */

/* xorshift64* (Vigna 2016): the same on every machine. */
static uint32_t any(uint64_t *state, uint32_t below) {
    *state ^= *state >> 12, *state ^= *state << 25, *state ^= *state >> 27;
    return (uint32_t)((*state * 2685821657736338717u >> 33) % below);
}

typedef struct {
    void *instance, *state;
    uint64_t *chance;
    size_t states, indicators; /* as version 3 tells them */
    double time;               /* of the last step */
    uint32_t reference[MOST];
    double value[MOST], found[MOST], array[ARRAY];
} run;

static void choose(run *r) {
    static const double some[] = {0, 1, -1, 0.5, 0.1, 3, 1e-3, 1e300};
    for (int k = 0; k < MOST; k++) {
        r->reference[k] = any(r->chance, 12);
        r->value[k] = some[any(r->chance, 8)];
    }
}

static int bytes2(run *r) {
    size_t size = 0;
    if (fmi2SerializedFMUstateSize(r->instance, r->state, &size) != fmi2OK) return fmi2Error;
    char *bytes = malloc(size);
    int answer = fmi2SerializeFMUstate(r->instance, r->state, bytes, size);
    if (any(r->chance, 2)) bytes[any(r->chance, (uint32_t)size)] ^= 1;
    answer |= fmi2DeSerializeFMUstate(r->instance, bytes, size, &r->state);
    free(bytes);
    return answer;
}

static int bytes3(run *r) {
    size_t size = 0;
    if (fmi3SerializedFMUStateSize(r->instance, r->state, &size) != fmi3OK) return fmi3Error;
    uint8_t *bytes = malloc(size);
    int answer = fmi3SerializeFMUState(r->instance, r->state, bytes, size);
    if (any(r->chance, 2)) bytes[any(r->chance, (uint32_t)size)] ^= 1;
    answer |= fmi3DeserializeFMUState(r->instance, bytes, size, &r->state);
    free(bytes);
    return answer;
}

static int call2(run *r, uint32_t which) {
    void *i = r->instance;
    const size_t n = any(r->chance, MOST), m = any(r->chance, MOST);
    const int order[MOST] = {1, 1, 1, 1, 1, 1, 1, 1 + (int)any(r->chance, 2)};
    fmi2EventInfo info;
    fmi2Boolean one, other;
    fmi2String text;
    const double size = 0.1 * any(r->chance, 5);
    int answer;
    switch (which) {
    case 0: return fmi2SetupExperiment(i, 1, 1e-4, 0, (int)any(r->chance, 2), 2);
    case 1: return fmi2EnterInitializationMode(i);
    case 2: return fmi2ExitInitializationMode(i);
    case 3: return fmi2NewDiscreteStates(i, &info);
    case 4: return fmi2EnterContinuousTimeMode(i);
    case 5: return fmi2EnterEventMode(i);
    case 6: return fmi2CompletedIntegratorStep(i, 1, &one, &other);
    case 7: return fmi2SetTime(i, r->time += size);
    case 8:
        answer = fmi2DoStep(i, r->time, size, 1);
        fmi2GetRealStatus(i, fmi2LastSuccessfulTime, &r->time);
        return answer;
    case 9: return fmi2GetReal(i, r->reference, n, r->found);
    case 10: return fmi2SetReal(i, r->reference, any(r->chance, 2), r->value);
    case 11: return fmi2GetContinuousStates(i, r->array, r->states + n / 4);
    case 12: return fmi2SetContinuousStates(i, r->array, r->states + n / 4);
    case 13: return fmi2GetDerivatives(i, r->array, r->states + n / 4);
    case 14: return fmi2GetEventIndicators(i, r->array, r->indicators + n / 4);
    case 15: return fmi2GetNominalsOfContinuousStates(i, r->array, r->states + n / 4);
    case 16: return fmi2GetDirectionalDerivative(i, r->reference, n, r->reference, m, r->value, r->found);
    case 17: return fmi2GetFMUstate(i, &r->state);
    case 18: return fmi2SetFMUstate(i, r->state);
    case 19: return fmi2FreeFMUstate(i, &r->state);
    case 20: return bytes2(r);
    case 21: return fmi2SetRealInputDerivatives(i, r->reference, n, order, r->value);
    case 22: return any(r->chance, 4) ? fmi2Error : fmi2Terminate(i);
    case 23: return r->time = 0, fmi2Reset(i);
    default: return fmi2GetStringStatus(i, fmi2PendingStatus, &text);
    }
}

static int call3(run *r, uint32_t which) {
    void *i = r->instance;
    const size_t n = any(r->chance, MOST), m = any(r->chance, MOST);
    bool a, b, c, d, e;
    double next;
    const double size = 0.1 * any(r->chance, 5);
    switch (which) {
    case 0:
    case 1: return fmi3EnterInitializationMode(i, 1, 1e-4, 0, any(r->chance, 2), 2);
    case 2: return fmi3ExitInitializationMode(i);
    case 3: return fmi3UpdateDiscreteStates(i, &a, &b, &c, &d, &e, &next);
    case 4: return any(r->chance, 2) ? fmi3EnterContinuousTimeMode(i) : fmi3EnterStepMode(i);
    case 5: return fmi3EnterEventMode(i);
    case 6: return fmi3CompletedIntegratorStep(i, 1, &a, &b);
    case 7: return fmi3SetTime(i, r->time += size);
    case 8: return fmi3DoStep(i, r->time, size, 1, &a, &b, &c, &r->time);
    case 9: return fmi3GetFloat64(i, r->reference, n, r->found, n);
    case 10: return fmi3SetFloat64(i, r->reference, n % 2, r->value, n % 2);
    case 11: return fmi3GetContinuousStates(i, r->array, r->states + n / 4);
    case 12: return fmi3SetContinuousStates(i, r->array, r->states + n / 4);
    case 13: return fmi3GetContinuousStateDerivatives(i, r->array, r->states + n / 4);
    case 14: return fmi3GetEventIndicators(i, r->array, r->indicators + n / 4);
    case 15: return fmi3GetNominalsOfContinuousStates(i, r->array, r->states + n / 4);
    case 16: return fmi3GetDirectionalDerivative(i, r->reference, n, r->reference, m, r->value, m, r->found, n);
    case 17: return fmi3GetFMUState(i, &r->state);
    case 18: return fmi3SetFMUState(i, r->state);
    case 19: return fmi3FreeFMUState(i, &r->state);
    case 20: return bytes3(r);
    case 21: return fmi3GetAdjointDerivative(i, r->reference, n, r->reference, m, r->value, n, r->found, m);
    case 22: return any(r->chance, 4) ? fmi3Error : fmi3Terminate(i);
    case 23: return r->time = 0, fmi3Reset(i);
    default: return any(r->chance, 2) ? fmi3EnterConfigurationMode(i) : fmi3ExitConfigurationMode(i);
    }
}

/* Half of the calls are those that lead on. */
static uint32_t which(uint64_t *chance) { return any(chance, any(chance, 2) ? 25 : 9); }

int main(int count, char **given) {
    if (count != 4) return 2;
    uint64_t chance = 88172645463325252u;
    long well[2] = {0, 0};
    const long calls = atol(given[3]);
    for (long done = 0; done < calls; done += RUN) {
        run r = {.chance = &chance};
        const int three = (int)any(&chance, 2), simulates = (int)any(&chance, 2);
        void *probe = fmi3InstantiateModelExchange("probe", given[2], given[1], 0, 0, NULL, NULL);
        if (!probe) return 1;
        fmi3GetNumberOfContinuousStates(probe, &r.states);
        fmi3GetNumberOfEventIndicators(probe, &r.indicators);
        fmi3FreeInstance(probe);
        if (r.states + MOST > ARRAY || r.indicators + MOST > ARRAY) return 3;
        if (!three) r.instance = fmi2Instantiate("one", simulates, given[2], given[1], NULL, 0, 1);
        else if (!simulates) r.instance = fmi3InstantiateModelExchange("one", given[2], given[1], 0, 1, NULL, NULL);
        else r.instance = fmi3InstantiateCoSimulation("one", given[2], given[1], 0, 1, any(&chance, 2), any(&chance, 2), NULL, 0,
                                                      NULL, NULL, NULL);
        if (!r.instance) return 1;
        for (int k = 0; k < RUN; k++) {
            choose(&r);
            well[three] += (three ? call3 : call2)(&r, which(&chance)) == 0;
        }
        free(r.state);
        if (three) fmi3FreeInstance(r.instance);
        else fmi2FreeInstance(r.instance);
    }
    printf("%ld %ld\n", well[0], well[1]);
    return 0;
}
