/* States of an instance, stored in memory and as bytes: the head below, then what the engine goes on from. */
#include "face.h"

#include <stdlib.h>
#include <string.h>

typedef struct {
    char magic[8];
    uint64_t sum;    /* of the model's token and all that follows, in bytes alone: memory is believed */
    uint64_t length; /* of the whole */
    int32_t mode, simulates, events, early, stated, ends, waits, zero;
    double start, stop, tolerance;
} head;

static const char MAGIC[8] = "acstate";

/* FNV-1a of 64 bits. */
static uint64_t summed(uint64_t sum, const void *bytes, size_t length) {
    const unsigned char *byte = bytes;
    for (size_t k = 0; k < length; k++) sum = (sum ^ byte[k]) * 0x100000001b3u;
    return sum;
}

static uint64_t checksum(const ac_face *f, const void *bytes, size_t length) {
    const char *token = ac_unit_token(f->unit);
    const size_t from = offsetof(head, length);
    const uint64_t sum = summed(0xcbf29ce484222325u, token, strlen(token));
    return summed(sum, (const char *)bytes + from, length - from);
}

/* Store the state, in place of another one that is no longer needed. */
int ac_face_store(ac_face *f, const char *call, void **stored) {
    if (!ac_face_in(f, call, AC_SOUND)) return fmi3Error;
    const size_t own = ac_state_size(f->engine);
    head *h = realloc(*stored, sizeof *h + own);
    if (!h) return ac_face_refuse(f, call, "there is no memory for a state");
    memset(h, 0, sizeof *h);
    memcpy(h->magic, MAGIC, sizeof MAGIC);
    h->length = sizeof *h + own;
    h->mode = f->mode, h->simulates = f->simulates, h->events = f->events, h->early = f->early;
    h->stated = f->stated, h->ends = f->ends, h->waits = f->waits;
    h->start = f->start, h->stop = f->stop, h->tolerance = f->tolerance;
    ac_state_write(f->engine, h + 1);
    *stored = h;
    return fmi3OK;
}

int ac_face_restore(ac_face *f, const char *call, const void *stored) {
    const head *h = stored;
    if (!ac_face_in(f, call, AC_ANY)) return fmi3Error;
    if (!h) return ac_face_refuse(f, call, "there is no state");
    if (h->simulates != f->simulates || h->events != f->events || h->early != f->early) {
        return ac_face_refuse(f, call, "the state is of an instance that was made in another way");
    }
    const int answer = ac_face_answer(f, call, ac_state_read(f->engine, h + 1, (size_t)h->length - sizeof *h));
    if (answer != fmi3OK) return answer;
    f->mode = h->mode, f->stated = h->stated, f->ends = h->ends, f->waits = h->waits;
    f->start = h->start, f->stop = h->stop, f->tolerance = h->tolerance;
    return fmi3OK;
}

int ac_face_drop(ac_face *f, void **stored) {
    if (!f) return fmi3Error;
    if (stored) {
        free(*stored);
        *stored = NULL;
    }
    return fmi3OK;
}

int ac_face_stored_size(ac_face *f, const char *call, const void *stored, size_t *size) {
    if (!ac_face_in(f, call, AC_ANY)) return fmi3Error;
    if (!stored) return ac_face_refuse(f, call, "there is no state");
    *size = (size_t)((const head *)stored)->length;
    return fmi3OK;
}

int ac_face_serialize(ac_face *f, const char *call, const void *stored, void *bytes, size_t size) {
    if (!ac_face_in(f, call, AC_ANY)) return fmi3Error;
    if (!stored) return ac_face_refuse(f, call, "there is no state");
    const size_t length = (size_t)((const head *)stored)->length;
    if (size < length) return ac_face_refuse(f, call, "the state takes %lu bytes", (unsigned long)length);
    const uint64_t sum = checksum(f, stored, length);
    memcpy(bytes, stored, length);
    memcpy((char *)bytes + offsetof(head, sum), &sum, sizeof sum);
    return fmi3OK;
}

/* Read a state from bytes, in place of another one; longer memory than the state takes is right. */
int ac_face_deserialize(ac_face *f, const char *call, const void *bytes, size_t size, void **stored) {
    head h;
    if (!ac_face_in(f, call, AC_ANY)) return fmi3Error;
    if (size < sizeof h) return ac_face_refuse(f, call, "the bytes are no state");
    memcpy(&h, bytes, sizeof h);
    if (memcmp(h.magic, MAGIC, sizeof MAGIC) != 0 || h.length < sizeof h || h.length > size) {
        return ac_face_refuse(f, call, "the bytes are no state, or were cut");
    }
    if (h.sum != checksum(f, bytes, (size_t)h.length)) {
        return ac_face_refuse(f, call, "the bytes are a state of another model, or damaged");
    }
    void *own = realloc(*stored, (size_t)h.length);
    if (!own) return ac_face_refuse(f, call, "there is no memory for a state");
    *stored = memcpy(own, bytes, (size_t)h.length);
    return fmi3OK;
}
