/* Damage a stored model or unit in every way: damage FILE N. Each byte changed and each length cut has to be refused; with a
   checksum that fits, each byte changed and N random changes have to be refused or integrated. Prints how many random ones were
   integrated. */
#include "rodas.h"
#include "unit.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define STEPS 20
#define OUTPUTS 3
#define UNIT 9 /* version of the files of units */

static uint32_t version; /* of the file */

/* CRC-32 bit by bit. */
static uint32_t checksum(const unsigned char *bytes, size_t length) {
    uint32_t sum = 0xffffffff;
    for (size_t k = 0; k < length; k++) {
        sum ^= bytes[k];
        for (int bit = 0; bit < 8; bit++) sum = sum >> 1 ^ (sum & 1 ? 0xedb88320 : 0);
    }
    return ~sum;
}

/* xorshift64* (Vigna 2016): the same on every machine. */
static uint32_t any(uint64_t *state, size_t below) {
    *state ^= *state >> 12, *state ^= *state << 25, *state ^= *state >> 27;
    return (uint32_t)((*state * 2685821657736338717u >> 33) % below);
}

/* Read and write what an instance has, and derivatives; answers may be errors. */
static void ask(ac_instance *i) {
    const uint32_t states = (uint32_t)ac_states(i), rate = 1 + states, state = 1;
    const double one = 1;
    double found, *all = malloc((states + (size_t)ac_indicators(i) + 1) * sizeof *all);
    void *stored = malloc(ac_state_size(i));
    if (!all || !stored) exit(2);
    for (uint32_t reference = 0; ac_get(i, &reference, 1, &found) != AC_REFUSED; reference++) {
        ac_forward(i, &reference, 1, &state, 1, &one, &found);
    }
    ac_backward(i, &rate, 1, &state, 1, &one, &found);
    ac_get_rates(i, all);
    ac_get_indicators(i, all);
    ac_state_write(i, stored);
    ac_state_read(i, stored, ac_state_size(i));
    free(stored);
    free(all);
}

/* A run in Co-Simulation or Model Exchange as far as it goes. */
static void run(ac_instance *i, double span, int simulates) {
    uint32_t most = 0;
    double value = STEPS, reached, x[1000];
    int32_t event = 0;
    ac_happened happened;
    ac_reset(i);
    while (ac_get(i, &most, 1, &reached) != AC_REFUSED) most++; /* the last variable is the number of steps of one call */
    most--;
    ac_set(i, &most, 1, &value);
    if (ac_begin(i, 0, span, 1e-4, simulates) || ac_begun(i) || ac_event(i, &happened) || ac_leave_event(i)) return;
    for (int k = 1; k <= OUTPUTS; k++) {
        if (simulates) {
            if (ac_step(i, 1e-3 * span * k, k & 1, &reached, &event) == AC_FAILED) break;
        } else {
            if (ac_states(i) > 1000 || ac_set_time(i, 1e-3 * span * k) || ac_get_states(i, x) || ac_set_states(i, x)) break;
            ac_completed(i);
            event = 1;
        }
        ask(i);
        if (event && (ac_enter_event(i) || ac_event(i, &happened) || ac_leave_event(i))) break;
    }
}

static int refused_unit(const void *bytes, size_t length) {
    int32_t why = -1;
    ac_unit *u = ac_unit_read(bytes, length, &why);
    if (!u != (why != AC_READ)) exit(3);
    if (!u) return 1;
    ac_instance *i = ac_instance_make(u);
    if (i) {
        run(i, 1, 1);
        run(i, 1, 0);
    }
    ac_instance_free(i);
    ac_unit_free(u);
    return 0;
}

/* Read a copy that ends where its memory ends; whether it was refused, and integrate a little where not. */
static int refused(const unsigned char *bytes, size_t length) {
    int32_t why = -1;
    void *copy = malloc(length);
    if (!copy && length) exit(2);
    if (length) memcpy(copy, bytes, length);
    if (version == UNIT) {
        const int unit = refused_unit(copy, length);
        free(copy);
        return unit;
    }
    ac_model *m = ac_model_read(copy, length, &why);
    free(copy);
    if (!m != (why != AC_READ)) exit(3);
    if (!m) return 1;
    const size_t nx = (size_t)m->equations.nx, nz = (size_t)m->equations.nz;
    double time[OUTPUTS + 1], integral[2 * OUTPUTS], *x = calloc(OUTPUTS * (nx + nz) + 1, sizeof *x);
    for (int k = 0; k <= OUTPUTS; k++) time[k] = m->time + 1e-3 * k;
    const ac_request request = {
        .tolerance = 1e-4, .size = m->size, .rate = m->rate, .smooth = 1, .most = STEPS, .share = 1, .outputs = OUTPUTS,
        .time = time, .x = x, .z = x + OUTPUTS * nx, .integral = integral,
    };
    ac_progress done;
    ac_rodas *r = ac_rodas_make(&m->equations);
    if (!x || !r) exit(2);
    ac_stepper_begin(&r->s, &request, m->x, m->z, m->p, m->c);
    ac_stepper_go(&r->s, STEPS, &done);
    ac_stepper_free((ac_stepper *)r);
    free(x);
    ac_model_free(m);
    return 0;
}

static void sign(unsigned char *bytes, size_t length) {
    const uint32_t sum = checksum(bytes, length - 8), zero = 0;
    memcpy(bytes + length - 8, &sum, sizeof sum);
    memcpy(bytes + length - 4, &zero, sizeof zero);
}

/* Change a few numbers, or cut, and let length and checksum fit. */
static size_t change(unsigned char *bytes, size_t length, uint64_t *state) {
    static const int32_t extreme[] = {-1, 0, 1, 2, 255, INT32_MAX, INT32_MIN, 0x7ff00000};
    for (uint32_t k = any(state, 3); k < 3; k++) {
        int32_t number;
        unsigned char *place = bytes + 8 + 4 * any(state, (length - 16) / 4);
        memcpy(&number, place, sizeof number);
        const uint32_t way = any(state, 4);
        if (way == 0) number = extreme[any(state, 8)];
        else if (way == 1) number ^= 1 << any(state, 31);
        else if (way == 2) number = (int32_t)((uint32_t)number + any(state, 9) - 4);
        else number = (int32_t)any(state, 100);
        memcpy(place, &number, sizeof number);
    }
    if (any(state, 16) == 0) length = 8 * (4 + any(state, length / 8 - 3));
    const uint64_t stated = length;
    if (any(state, 16)) memcpy(bytes + 8, &version, sizeof version);
    if (any(state, 16)) memcpy(bytes + 16, &stated, sizeof stated);
    sign(bytes, length);
    return length;
}

int main(int count, char **given) {
    static unsigned char bytes[1 << 20], copy[1 << 20];
    FILE *file = count == 3 ? fopen(given[1], "rb") : NULL;
    if (!file) return 2;
    const size_t length = fread(bytes, 1, sizeof bytes, file);
    fclose(file);
    if (length < 32 || length == sizeof bytes) return 2;
    memcpy(&version, bytes + 8, sizeof version);
    if (refused(bytes, length)) return 2;
    for (size_t k = 0; k < length; k++) {
        const unsigned char old = bytes[k];
        bytes[k] ^= (unsigned char)(1 << k % 8);
        if (!refused(bytes, length)) return 4;
        bytes[k] = (unsigned char)~old;
        if (!refused(bytes, length)) return 4;
        bytes[k] = old;
        if (!refused(bytes, k)) return 5;
        memcpy(copy, bytes, length);
        copy[k] = (unsigned char)~old;
        sign(copy, length);
        refused(copy, length);
    }
    if (!refused(bytes, length + 8)) return 5;
    uint64_t state = 1;
    int integrated = 0;
    for (int k = atoi(given[2]); k > 0; k--) {
        memcpy(copy, bytes, length);
        integrated += !refused(copy, change(copy, length, &state));
    }
    printf("%d\n", integrated);
    return 0;
}
