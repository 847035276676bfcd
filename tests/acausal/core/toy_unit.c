/* An engine to try the faces with: x' = u - rate x, in closed form; where x falls to a half it jumps to 1.
   Files hold "toy" and a token. References: time, x, its rate, rate, u, trouble, x less a half. Trouble 1: other states
   wanted; 2: lost; 3: steps end at their middle for good; 4: events end the simulation. */
#include "unit.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define HALF 0.5
#define SHORTEST 1e-6 /* between two events */
enum { TIME, X, SLOPE, RATE, U, TROUBLE, INDICATOR, REFERENCES };

struct ac_unit {
    char token[64];
};

struct ac_instance {
    const ac_unit *unit;
    const char *message;
    int32_t phase, simulates, reached;
    double value[REFERENCES], u_slope, stop, tolerance;
};

ac_unit *ac_unit_read(const void *bytes, size_t length, int32_t *why) {
    ac_unit *unit = calloc(1, sizeof *unit);
    *why = length < 4 || memcmp(bytes, "toy ", 4) != 0 ? AC_FOREIGN : length > 60 ? AC_LENGTH : AC_READ;
    if (unit && *why == AC_READ) {
        memcpy(unit->token, (const char *)bytes + 4, length - 4);
        return unit;
    }
    free(unit);
    return NULL;
}

void ac_unit_free(ac_unit *unit) { free(unit); }
const char *ac_unit_why(int32_t why) { return why == AC_FOREIGN ? "it is no toy" : "it was cut"; }
const char *ac_unit_token(const ac_unit *unit) { return unit->token; }

int32_t ac_reset(ac_instance *i) {
    *i = (ac_instance){.unit = i->unit, .message = "", .value = {[X] = 1, [RATE] = 1}};
    return AC_OK;
}

ac_instance *ac_instance_make(const ac_unit *unit) {
    ac_instance *i = calloc(1, sizeof *i);
    if (!i) return NULL;
    i->unit = unit;
    ac_reset(i);
    return i;
}

void ac_instance_free(ac_instance *i) { free(i); }
const char *ac_message(const ac_instance *i) { return i->message; }
int32_t ac_phase(const ac_instance *i) { return i->phase; }
double ac_time(const ac_instance *i) { return i->value[TIME]; }
int32_t ac_states(const ac_instance *i) { return i ? 1 : 0; }
int32_t ac_indicators(const ac_instance *i) { return i ? 1 : 0; }

static int32_t end(ac_instance *i, int32_t how, const char *message) {
    i->message = message;
    return how;
}

static int32_t trouble(ac_instance *i) {
    if (i->value[TROUBLE] == 1) return end(i, AC_RETRY, "there is no solution here, at 100% of #1#");
    return i->value[TROUBLE] == 2 ? end(i, AC_FAILED, "the instance is lost") : AC_OK;
}

static double slope(const ac_instance *i) { return i->value[U] - i->value[RATE] * i->value[X]; }

int32_t ac_get(ac_instance *i, const uint32_t *reference, size_t count, double *value) {
    for (size_t k = 0; k < count; k++) {
        if (reference[k] >= REFERENCES) return end(i, AC_REFUSED, "there is no such variable");
        value[k] = reference[k] == SLOPE ? slope(i) : reference[k] == INDICATOR ? i->value[X] - HALF : i->value[reference[k]];
    }
    return AC_OK;
}

int32_t ac_set(ac_instance *i, const uint32_t *reference, size_t count, const double *value) {
    for (size_t k = 0; k < count; k++) {
        const int fixed = i->phase >= AC_AT_EVENT && (reference[k] == X || reference[k] == RATE);
        if (reference[k] >= REFERENCES || reference[k] == TIME || reference[k] == SLOPE || fixed) {
            return end(i, AC_REFUSED, "this variable is not set now");
        }
    }
    for (size_t k = 0; k < count; k++) i->value[reference[k]] = value[k];
    return AC_OK;
}

int32_t ac_set_slopes(ac_instance *i, const uint32_t *reference, size_t count, const double *given) {
    for (size_t k = 0; k < count; k++) {
        if (reference[k] != U) return end(i, AC_REFUSED, "this is no input");
        i->u_slope = given[k];
    }
    return AC_OK;
}

int32_t ac_begin(ac_instance *i, double time, double stop, double tolerance, int32_t simulates) {
    i->value[TIME] = time, i->stop = stop, i->tolerance = tolerance, i->simulates = simulates;
    i->phase = AC_INITIALISING;
    return AC_OK;
}

int32_t ac_begun(ac_instance *i) {
    i->phase = AC_AT_EVENT;
    return trouble(i);
}

int32_t ac_event(ac_instance *i, ac_happened *found) {
    found->states = i->value[X] <= HALF;
    found->ends = found->states && i->value[TROUBLE] == 4;
    if (found->states) i->value[X] = 1;
    return AC_OK;
}

int32_t ac_enter_event(ac_instance *i) {
    i->phase = AC_AT_EVENT;
    return AC_OK;
}

int32_t ac_leave_event(ac_instance *i) {
    i->phase = AC_RUNNING;
    return AC_OK;
}

int32_t ac_set_time(ac_instance *i, double time) {
    i->value[TIME] = time;
    return AC_OK;
}

int32_t ac_set_states(ac_instance *i, const double *x) {
    i->value[X] = *x;
    return AC_OK;
}

int32_t ac_get_states(ac_instance *i, double *x) {
    *x = i->value[X];
    return AC_OK;
}

int32_t ac_completed(ac_instance *i) {
    (void)i;
    return AC_OK;
}

int32_t ac_get_rates(ac_instance *i, double *rate) {
    *rate = slope(i);
    return trouble(i);
}

int32_t ac_get_nominals(ac_instance *i, double *nominal) {
    *nominal = i->value[RATE];
    return AC_OK;
}

int32_t ac_get_indicators(ac_instance *i, double *value) {
    *value = i->value[X] - HALF;
    return AC_OK;
}

int32_t ac_step(ac_instance *i, double to, int32_t early, double *reached, int32_t *event) {
    double *v = i->value;
    *reached = v[TIME], *event = 0;
    if (trouble(i) != AC_OK) return trouble(i);
    if (v[TROUBLE] == 3) to = (v[TIME] + to) / 2;
    while (v[TIME] < to) {
        const double rest = v[U] / v[RATE], falls = log((v[X] - rest) / (HALF - rest)) / v[RATE];
        const double span = falls > SHORTEST && falls < to - v[TIME] ? falls : to - v[TIME];
        v[X] = rest + (v[X] - rest) * exp(-v[RATE] * span);
        v[U] += i->u_slope * span;
        if (span == falls) {
            v[TIME] += falls, *event = 1, v[X] = HALF;
            if (early || v[TROUBLE] == 4) break;
            v[X] = 1;
        } else {
            v[TIME] = to;
        }
    }
    *reached = v[TIME];
    return AC_OK;
}

int32_t ac_forward(ac_instance *i, const uint32_t *unknown, size_t unknowns, const uint32_t *known, size_t knowns,
                   const double *seed, double *sensitivity) {
    for (size_t k = 0; k < unknowns; k++) {
        if (unknown[k] != SLOPE) return end(i, AC_REFUSED, "this is no unknown");
        sensitivity[k] = 0;
        for (size_t j = 0; j < knowns; j++) sensitivity[k] += seed[j] * (known[j] == U ? 1 : -i->value[RATE]);
    }
    return AC_OK;
}

int32_t ac_backward(ac_instance *i, const uint32_t *unknown, size_t unknowns, const uint32_t *known, size_t knowns,
                    const double *seed, double *sensitivity) {
    for (size_t j = 0; j < knowns; j++) {
        sensitivity[j] = 0;
        for (size_t k = 0; k < unknowns; k++) {
            if (unknown[k] != SLOPE) return end(i, AC_REFUSED, "this is no unknown");
            sensitivity[j] += seed[k] * (known[j] == U ? 1 : -i->value[RATE]);
        }
    }
    return AC_OK;
}

size_t ac_state_size(const ac_instance *i) { return sizeof *i; }
void ac_state_write(const ac_instance *i, void *bytes) { memcpy(bytes, i, sizeof *i); }

int32_t ac_state_read(ac_instance *i, const void *bytes, size_t length) {
    const ac_unit *unit = i->unit;
    if (length != sizeof *i) return end(i, AC_REFUSED, "this is no state");
    memcpy(i, bytes, length);
    i->unit = unit, i->message = "";
    return AC_OK;
}
