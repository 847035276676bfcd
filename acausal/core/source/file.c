/* Read sections from a file. Nothing in it is believed: what passes can be used without reading or writing elsewhere. */
#include "file.h"

#include <math.h>
#include <string.h>

#define HEADER 24 /* bytes: magic, version, number of sections, length */
#define TITLE 16  /* tag and length of a section */
#define TRAILER 8 /* checksum, 0 */
#define LONGEST ((size_t)1 << 28) /* of a file: sums of a few of its sizes fit in 32 bits */

static const char MAGIC[8] = "acausal";

/* CRC-32 as in zip and PNG, in halves of bytes. */
static uint32_t checksum(const unsigned char *bytes, size_t length) {
    static const uint32_t half[16] = {
        0x00000000, 0x1db71064, 0x3b6e20c8, 0x26d930ac, 0x76dc4190, 0x6b6b51f4, 0x4db26158, 0x5005713c,
        0xedb88320, 0xf00f9344, 0xd6d6a3e8, 0xcb61b38c, 0x9b64c2b0, 0x86d3d2d4, 0xa00ae278, 0xbdbdf21c,
    };
    uint32_t sum = 0xffffffff;
    for (size_t k = 0; k < length; k++) {
        sum ^= bytes[k];
        sum = half[sum & 15] ^ sum >> 4;
        sum = half[sum & 15] ^ sum >> 4;
    }
    return ~sum;
}

/* Whether this is a whole file of this format; on a machine with another order of bytes none has the right version. */
int32_t ac_file_outside(const unsigned char *bytes, size_t length, uint32_t version) {
    uint32_t own, sum[2];
    uint64_t stated;
    if (length < sizeof MAGIC || memcmp(bytes, MAGIC, sizeof MAGIC) != 0) return AC_FOREIGN;
    if (length < HEADER + TRAILER) return AC_LENGTH;
    memcpy(&own, bytes + 8, sizeof own);
    memcpy(&stated, bytes + 16, sizeof stated);
    memcpy(sum, bytes + length - TRAILER, sizeof sum);
    if (own != version) return AC_VERSION;
    if (stated != length || length % 8 || length > LONGEST) return AC_LENGTH;
    return sum[0] == checksum(bytes, length - TRAILER) && !sum[1] ? AC_READ : AC_CHECKSUM;
}

/* Find the sections: each known, none twice, zeros up to the next multiple of 8, nothing after the last one. */
int ac_file_split(const unsigned char *at, size_t length, const char (*tag)[AC_TAG + 1], int tags, ac_section *found) {
    uint32_t count;
    memcpy(&count, at + 12, sizeof count);
    size_t left = length - HEADER - TRAILER;
    at += HEADER;
    for (int k = 0; k < tags; k++) found[k] = (ac_section){NULL, 0};
    for (; count > 0; count--) {
        uint64_t size;
        int k = 0;
        if (left < TITLE) return 0;
        memcpy(&size, at + 8, sizeof size);
        while (k < tags && memcmp(at, tag[k], AC_TAG) != 0) k++;
        if (k == tags || found[k].at || size > left - TITLE) return 0;
        found[k] = (ac_section){at + TITLE, (size_t)size};
        const size_t used = TITLE + (((size_t)size + 7) & ~(size_t)7);
        for (size_t j = TITLE + (size_t)size; j < used; j++) {
            if (at[j]) return 0;
        }
        at += used, left -= used;
    }
    return !left;
}

/* The next numbers of a section, or NULL where it has fewer. */
const void *ac_take(ac_section *s, int64_t count, size_t size) {
    const unsigned char *here = s->at;
    if (!here || count < 0 || (uint64_t)count > s->left / size) return NULL;
    s->at += (size_t)count * size;
    s->left -= (size_t)count * size;
    return here;
}

/* Whether numbers lie within 0 and a limit. */
int ac_within(const int32_t *number, int32_t count, int64_t limit) {
    for (int32_t k = 0; k < count; k++) {
        if (number[k] < 0 || number[k] >= limit) return 0;
    }
    return 1;
}

int ac_all_finite(const double *number, int32_t count) {
    for (int32_t k = 0; k < count; k++) {
        if (!isfinite(number[k])) return 0;
    }
    return 1;
}

/* Whether every operation needs what stands before it alone, and the early ones none of the inputs that vary. */
static int in_order(const ac_tape *t, int32_t from, int32_t to) {
    const int32_t own = t->constants + t->inputs, vary = t->constants + from, varied = t->constants + to;
    int32_t done = 0;
    for (int32_t k = 0; k < t->runs; k++) {
        if (t->length[k] < 0 || t->length[k] > t->results - done) return 0;
        const int32_t end = done + t->length[k];
        for (; done < end; done++) {
            const int32_t a = t->first[done], b = t->second[done];
            if (a < 0 || b < 0 || a >= own + done || b >= own + done) return 0;
            if (k < t->early && ((a >= vary && a < varied) || (b >= vary && b < varied))) return 0;
        }
    }
    return done == t->results;
}

/* A tape of as many inputs, of which those from one to another vary. */
int ac_read_tape(ac_section s, int32_t inputs, int32_t from, int32_t to, ac_tape *t) {
    const int32_t *n = ac_take(&s, 6, sizeof *n);
    if (!n) return 0;
    *t = (ac_tape){.constants = n[0], .inputs = n[1], .results = n[2], .runs = n[3], .early = n[4], .outputs = n[5]};
    t->constant = ac_take(&s, t->constants, sizeof *t->constant);
    t->kind = ac_take(&s, t->runs, sizeof *t->kind);
    t->length = ac_take(&s, t->runs, sizeof *t->length);
    t->first = ac_take(&s, t->results, sizeof *t->first);
    t->second = ac_take(&s, t->results, sizeof *t->second);
    t->output = ac_take(&s, t->outputs, sizeof *t->output);
    if (!t->constant || !t->kind || !t->length || !t->first || !t->second || !t->output || s.left) return 0;
    return t->inputs == inputs && ac_within(&t->early, 1, (int64_t)t->runs + 1)
        && ac_within(t->kind, t->runs, AC_OPERATIONS) && in_order(t, from, to)
        && ac_within(t->output, t->outputs, (int64_t)t->constants + t->inputs + t->results);
}

/* A sparsity in columns whose rows ascend. */
int ac_read_columns(ac_section *s, int32_t rows, int32_t columns, const int32_t **start, const int32_t **row) {
    const int32_t *first = *start = ac_take(s, (int64_t)columns + 1, sizeof **start);
    if (!first || first[0] != 0) return 0;
    const int32_t *at = *row = ac_take(s, first[columns], sizeof **row);
    if (!at || !ac_within(at, first[columns], rows)) return 0;
    for (int32_t j = 0; j < columns; j++) {
        if (first[j + 1] < first[j] || first[j + 1] > first[columns]) return 0;
        for (int32_t k = first[j] + 1; k < first[j + 1]; k++) {
            if (at[k] <= at[k - 1]) return 0;
        }
    }
    return 1;
}
