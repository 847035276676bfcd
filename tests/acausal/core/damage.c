/* Damage a stored model in every way: damage FILE N. Each byte changed and each length cut has to be refused; with a checksum
   that fits, N random changes have to be refused or integrated. Prints how many of them were integrated. */
#include "core.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define STEPS 20
#define OUTPUTS 3

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

/* Read a copy that ends where its memory ends; whether it was refused, and integrate a little where not. */
static int refused(const unsigned char *bytes, size_t length) {
    int32_t why = -1;
    void *copy = malloc(length);
    if (!copy && length) exit(2);
    if (length) memcpy(copy, bytes, length);
    ac_model *m = ac_model_read(copy, length, &why);
    free(copy);
    if (!m != (why != AC_READ)) exit(3);
    if (!m) return 1;
    const size_t nx = (size_t)m->equations.nx, nz = (size_t)m->equations.nz;
    double time[OUTPUTS + 1], integral[2 * OUTPUTS], *x = calloc(OUTPUTS * (nx + nz) + 1, sizeof *x);
    for (int k = 0; k <= OUTPUTS; k++) time[k] = m->time + 1e-3 * k;
    const ac_request request = {
        .tolerance = 1e-4, .size = m->size, .rate = m->rate, .smooth = 1, .most = STEPS, .outputs = OUTPUTS,
        .time = time, .x = x, .z = x + OUTPUTS * nx, .integral = integral,
    };
    ac_progress done;
    ac_rodas *r = ac_rodas_make(&m->equations);
    if (!x || !r) exit(2);
    ac_rodas_begin(r, &request, m->x, m->z, m->p, m->c);
    ac_rodas_go(r, STEPS, &done);
    ac_rodas_free(r);
    free(x);
    ac_model_free(m);
    return 0;
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
    const uint32_t version = 1;
    if (any(state, 16)) memcpy(bytes + 8, &version, sizeof version);
    if (any(state, 16)) memcpy(bytes + 16, &stated, sizeof stated);
    const uint32_t sum = checksum(bytes, length - 8), zero = 0;
    memcpy(bytes + length - 8, &sum, sizeof sum);
    memcpy(bytes + length - 4, &zero, sizeof zero);
    return length;
}

int main(int count, char **given) {
    static unsigned char bytes[1 << 20], copy[1 << 20];
    FILE *file = count == 3 ? fopen(given[1], "rb") : NULL;
    if (!file) return 2;
    const size_t length = fread(bytes, 1, sizeof bytes, file);
    fclose(file);
    if (length == sizeof bytes || refused(bytes, length)) return 2;
    for (size_t k = 0; k < length; k++) {
        const unsigned char old = bytes[k];
        bytes[k] ^= (unsigned char)(1 << k % 8);
        if (!refused(bytes, length)) return 4;
        bytes[k] = (unsigned char)~old;
        if (!refused(bytes, length)) return 4;
        bytes[k] = old;
        if (!refused(bytes, k)) return 5;
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
