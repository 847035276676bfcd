/* The state of an instance as bytes: its numbers, and the pivots of its factors, without which it would go on with other roundings. */
#include "instance.h"

#include <string.h>

#define FACTORS (AC_SQUARES + 1)

static const char MAGIC[8] = "acstate";

typedef struct {
    char magic[8];
    uint64_t length, model; /* model: tells the state of another one */
} head;

static ac_lu *factors(const ac_instance *i, int k) { return k < AC_SQUARES ? i->settler[k]->lu : i->rodas->lu; }

/* FNV-1a. */
static uint64_t hash(const char *text) {
    uint64_t found = 14695981039346656037u;
    while (*text) found = (found ^ (unsigned char)*text++) * 1099511628211u;
    return found;
}

size_t ac_state_size(const ac_instance *i) {
    size_t numbers = i->saved;
    for (int k = 0; k < FACTORS; k++) numbers += ac_lu_order_size(factors(i, k));
    return sizeof(head) + sizeof i->now + numbers * sizeof(double);
}

static head head_of(const ac_instance *i) {
    head own = {.length = ac_state_size(i), .model = hash(ac_unit_token(i->of))};
    memcpy(own.magic, MAGIC, sizeof MAGIC);
    return own;
}

/* Write as many bytes as the size says; they need not be aligned. */
void ac_state_write(const ac_instance *i, void *bytes) {
    const head own = head_of(i);
    unsigned char *to = bytes;
    memcpy(to, &own, sizeof own), to += sizeof own;
    memcpy(to, &i->now, sizeof i->now), to += sizeof i->now;
    memcpy(to, i->x, i->saved * sizeof(double)), to += i->saved * sizeof(double);
    for (int k = 0; k < FACTORS; k++) {
        ac_lu_order(factors(i, k), i->order);
        const size_t size = ac_lu_order_size(factors(i, k)) * sizeof(double);
        memcpy(to, i->order, size), to += size;
    }
}

/* Go on from bytes that were written by an instance of the same model. */
int32_t ac_state_read(ac_instance *i, const void *bytes, size_t length) {
    const head own = head_of(i);
    const unsigned char *from = bytes;
    if (length != own.length || memcmp(from, &own, sizeof own)) {
        return ac_fail(i, AC_REFUSED, "these bytes are no state of this model.");
    }
    from += sizeof own;
    memcpy(&i->now, from, sizeof i->now), from += sizeof i->now;
    memcpy(i->x, from, i->saved * sizeof(double)), from += i->saved * sizeof(double);
    i->now.known &= AC_Z | AC_FIRST;
    i->prepared = 0, i->going = 0;
    for (int k = 0; k < FACTORS; k++) {
        const size_t size = ac_lu_order_size(factors(i, k)) * sizeof(double);
        memcpy(i->order, from, size), from += size;
        if (!ac_lu_reorder(factors(i, k), i->order)) return ac_fail(i, AC_REFUSED, "these bytes are no state of this model.");
    }
    return AC_OK;
}
