/* Read a model from a file. Nothing in it is believed: what passes can be integrated without reading or writing elsewhere. */
#include "core.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define VERSION 1
#define HEADER 24 /* bytes: magic, version, number of sections, length */
#define TITLE 16  /* tag and length of a section */
#define TRAILER 8 /* checksum, 0 */
#define LONGEST ((size_t)1 << 28) /* of a file: sums of a few of its sizes fit in 32 bits */

static const char MAGIC[8] = "acausal";

enum { NUMBERS, VALUES, SLOPES, POWERS, PATTERN, START, SIZES, RATES, NAMES, SECTIONS };
static const char TAG[SECTIONS][8] = {"numbers", "values", "slopes", "powers", "pattern", "start", "sizes", "rates", "names"};

/* What is left of a section. */
typedef struct {
    const unsigned char *at;
    size_t left;
} section;

/* A model in one piece of memory, with the file that its arrays stand in. */
typedef struct {
    ac_model model;
    ac_tape tape[3];
    double file[];
} whole;

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
static int32_t outside(const unsigned char *bytes, size_t length) {
    uint32_t version, sum[2];
    uint64_t stated;
    if (length < sizeof MAGIC || memcmp(bytes, MAGIC, sizeof MAGIC) != 0) return AC_FOREIGN;
    if (length < HEADER + TRAILER) return AC_LENGTH;
    memcpy(&version, bytes + 8, sizeof version);
    memcpy(&stated, bytes + 16, sizeof stated);
    memcpy(sum, bytes + length - TRAILER, sizeof sum);
    if (version != VERSION) return AC_VERSION;
    if (stated != length || length % 8 || length > LONGEST) return AC_LENGTH;
    return sum[0] == checksum(bytes, length - TRAILER) && !sum[1] ? AC_READ : AC_CHECKSUM;
}

/* Find the sections: each known, none twice, zeros up to the next multiple of 8, nothing after the last one. */
static int split(const unsigned char *at, size_t length, section found[SECTIONS]) {
    uint32_t count;
    memcpy(&count, at + 12, sizeof count);
    size_t left = length - HEADER - TRAILER;
    at += HEADER;
    for (int k = 0; k < SECTIONS; k++) found[k] = (section){NULL, 0};
    for (; count > 0; count--) {
        uint64_t size;
        int k = 0;
        if (left < TITLE) return 0;
        memcpy(&size, at + 8, sizeof size);
        while (k < SECTIONS && memcmp(at, TAG[k], sizeof TAG[k]) != 0) k++;
        if (k == SECTIONS || found[k].at || size > left - TITLE) return 0;
        found[k] = (section){at + TITLE, (size_t)size};
        const size_t used = TITLE + (((size_t)size + 7) & ~(size_t)7);
        for (size_t j = TITLE + (size_t)size; j < used; j++) {
            if (at[j]) return 0;
        }
        at += used, left -= used;
    }
    return !left;
}

/* The next numbers of a section, or NULL where it has fewer. */
static const void *take(section *s, int64_t count, size_t size) {
    const unsigned char *here = s->at;
    if (!here || count < 0 || (uint64_t)count > s->left / size) return NULL;
    s->at += (size_t)count * size;
    s->left -= (size_t)count * size;
    return here;
}

/* Whether numbers lie within 0 and a limit. */
static int within(const int32_t *number, int32_t count, int64_t limit) {
    for (int32_t k = 0; k < count; k++) {
        if (number[k] < 0 || number[k] >= limit) return 0;
    }
    return 1;
}

static int all_finite(const double *number, int32_t count) {
    for (int32_t k = 0; k < count; k++) {
        if (!isfinite(number[k])) return 0;
    }
    return 1;
}

/* Whether every operation is known and needs what stands before it alone, and the early ones none of the first inputs,
   which vary. */
static int in_order(const ac_tape *t, int32_t varying) {
    const int32_t own = t->constants + t->inputs, varied = t->constants + varying;
    int32_t done = 0;
    for (int32_t k = 0; k < t->runs; k++) {
        if (t->length[k] < 0 || t->length[k] > t->results - done) return 0;
        const int32_t end = done + t->length[k];
        for (; done < end; done++) {
            const int32_t a = t->first[done], b = t->second[done];
            if (a < 0 || b < 0 || a >= own + done || b >= own + done) return 0;
            if (k < t->early && ((a >= t->constants && a < varied) || (b >= t->constants && b < varied))) return 0;
        }
    }
    return done == t->results;
}

static int read_tape(section s, const ac_equations *e, ac_tape *t) {
    const int32_t *n = take(&s, 6, sizeof *n), varying = e->nx + e->nz + 1;
    if (!n) return 0;
    *t = (ac_tape){.constants = n[0], .inputs = n[1], .results = n[2], .runs = n[3], .early = n[4], .outputs = n[5]};
    t->constant = take(&s, t->constants, sizeof *t->constant);
    t->kind = take(&s, t->runs, sizeof *t->kind);
    t->length = take(&s, t->runs, sizeof *t->length);
    t->first = take(&s, t->results, sizeof *t->first);
    t->second = take(&s, t->results, sizeof *t->second);
    t->output = take(&s, t->outputs, sizeof *t->output);
    if (!t->constant || !t->kind || !t->length || !t->first || !t->second || !t->output || s.left) return 0;
    return t->inputs == varying + e->np + e->nc && within(&t->early, 1, (int64_t)t->runs + 1)
        && within(t->kind, t->runs, AC_OPERATIONS) && in_order(t, varying)
        && within(t->output, t->outputs, (int64_t)t->constants + t->inputs + t->results);
}

/* Numbers of unknowns and of what is given, and the start, whose length bounds them. */
static int read_start(section numbers, section s, ac_model *m) {
    ac_equations *e = &m->equations;
    const int32_t *n = take(&numbers, 4, sizeof *n);
    const double *time = take(&s, 1, sizeof *time);
    if (!n || numbers.left || !time) return 0;
    e->nx = n[0], e->nz = n[1], e->np = n[2], e->nc = n[3];
    m->time = *time;
    m->x = take(&s, e->nx, sizeof *m->x);
    m->z = take(&s, e->nz, sizeof *m->z);
    m->p = take(&s, e->np, sizeof *m->p);
    m->c = take(&s, e->nc, sizeof *m->c);
    if (!m->x || !m->z || !m->p || !m->c || s.left) return 0;
    return all_finite(time, 1) && all_finite(m->x, e->nx) && all_finite(m->z, e->nz);
}

/* The sparsity: rows ascend in each column, and the diagonal of the states is there. */
static int read_pattern(section s, ac_equations *e) {
    const int32_t n = e->nx + e->nz;
    e->start = take(&s, (int64_t)n + 1, sizeof *e->start);
    if (!e->start || e->start[0] != 0) return 0;
    e->row = take(&s, e->start[n], sizeof *e->row);
    e->diagonal = take(&s, e->nx, sizeof *e->diagonal);
    if (!e->row || !e->diagonal || s.left || !within(e->row, e->start[n], n)) return 0;
    for (int32_t j = 0; j < n; j++) {
        if (e->start[j + 1] < e->start[j] || e->start[j + 1] > e->start[n]) return 0;
        for (int32_t k = e->start[j] + 1; k < e->start[j + 1]; k++) {
            if (e->row[k] <= e->row[k - 1]) return 0;
        }
    }
    for (int32_t k = 0; k < e->nx; k++) {
        const int32_t at = e->diagonal[k];
        if (at < e->start[k] || at >= e->start[k + 1] || e->row[at] != k) return 0;
    }
    return 1;
}

/* What is known of each state. */
static int read_states(const section found[SECTIONS], ac_model *m) {
    section size = found[SIZES], rate = found[RATES], names = found[NAMES];
    const int32_t nx = m->equations.nx;
    m->size = take(&size, nx, sizeof *m->size);
    m->rate = take(&rate, nx, sizeof *m->rate);
    m->names = (const char *)names.at;
    if (!m->size || !m->rate || !m->names || size.left || rate.left) return 0;
    size_t ends = 0;
    for (size_t k = 0; k < names.left; k++) ends += !names.at[k];
    for (int32_t k = 0; k < nx; k++) {
        if (!(m->size[k] > 0)) return 0;
    }
    return ends == (size_t)nx && (!nx || !names.at[names.left - 1]) && (nx || !names.left)
        && all_finite(m->size, nx) && within(m->rate, nx, 2);
}

static int read_all(const section found[SECTIONS], whole *w) {
    ac_equations *e = &w->model.equations;
    if (!read_start(found[NUMBERS], found[START], &w->model) || !read_pattern(found[PATTERN], e)
        || !read_states(found, &w->model)) return 0;
    const int32_t n = e->nx + e->nz, entries = e->start[n];
    const ac_tape *t = w->tape;
    for (int k = 0; k < 3; k++) {
        if (k == 2 && !found[POWERS].at) break;
        if (!read_tape(found[VALUES + k], e, &w->tape[k])) return 0;
    }
    e->values = t, e->slopes = t + 1, e->powers = found[POWERS].at ? t + 2 : NULL;
    return t[0].outputs == n && (t[1].outputs == entries || t[1].outputs == entries + n) && (!e->powers || t[2].outputs <= 2);
}

/* Read a model; NULL where the bytes are none, and why. They are copied, and need not be aligned. */
ac_model *ac_model_read(const void *bytes, size_t length, int32_t *why) {
    section found[SECTIONS];
    if ((*why = outside(bytes, length)) != AC_READ) return NULL;
    whole *w = malloc(sizeof *w + length);
    if (!w) {
        *why = AC_NO_MEMORY;
        return NULL;
    }
    memset(w, 0, sizeof *w);
    memcpy(w->file, bytes, length);
    if (split((const unsigned char *)w->file, length, found) && read_all(found, w)) return &w->model;
    *why = AC_CONTENT;
    free(w);
    return NULL;
}

void ac_model_free(ac_model *model) { free(model); }
