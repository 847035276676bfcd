/* Read a model from a file: what passes can be integrated without reading or writing elsewhere. */
#include "file.h"

#include <stdlib.h>
#include <string.h>

#define VERSION 1

static const char TAG[AC_SECTIONS][AC_TAG + 1] = {"numbers", "values", "slopes", "powers", "kinks", "pattern", "start", "sizes", "rates", "names"};

/* A model in one piece of memory, with the file that its arrays stand in. */
typedef struct {
    ac_model_parts parts; /* first: a model is freed by its address */
    double file[];
} whole;

/* Numbers of unknowns and of what is given, and the start, whose length bounds them. */
static int read_start(ac_section numbers, ac_section s, ac_model *m) {
    ac_equations *e = &m->equations;
    const int32_t *n = ac_take(&numbers, 4, sizeof *n);
    const double *time = ac_take(&s, 1, sizeof *time);
    if (!n || numbers.left || !time) return 0;
    e->nx = n[0], e->nz = n[1], e->np = n[2], e->nc = n[3];
    m->time = *time;
    m->x = ac_take(&s, e->nx, sizeof *m->x);
    m->z = ac_take(&s, e->nz, sizeof *m->z);
    m->p = ac_take(&s, e->np, sizeof *m->p);
    m->c = ac_take(&s, e->nc, sizeof *m->c);
    if (!m->x || !m->z || !m->p || !m->c || s.left) return 0;
    return ac_all_finite(time, 1) && ac_all_finite(m->x, e->nx) && ac_all_finite(m->z, e->nz);
}

/* The sparsity of the Jacobian, with the diagonal of the states. */
static int read_pattern(ac_section s, ac_equations *e) {
    const int32_t n = e->nx + e->nz;
    if (!ac_read_columns(&s, n, n, &e->start, &e->row)) return 0;
    e->diagonal = ac_take(&s, e->nx, sizeof *e->diagonal);
    if (!e->diagonal || s.left) return 0;
    for (int32_t k = 0; k < e->nx; k++) {
        const int32_t at = e->diagonal[k];
        if (at < e->start[k] || at >= e->start[k + 1] || e->row[at] != k) return 0;
    }
    return 1;
}

/* What is known of each state. */
static int read_states(const ac_section *found, ac_model *m) {
    ac_section size = found[AC_SIZES], rate = found[AC_RATES], names = found[AC_NAMES];
    const int32_t nx = m->equations.nx;
    m->size = ac_take(&size, nx, sizeof *m->size);
    m->rate = ac_take(&rate, nx, sizeof *m->rate);
    m->names = (const char *)names.at;
    if (!m->size || !m->rate || !m->names || size.left || rate.left) return 0;
    size_t ends = 0;
    for (size_t k = 0; k < names.left; k++) ends += !names.at[k];
    for (int32_t k = 0; k < nx; k++) {
        if (!(m->size[k] > 0)) return 0;
    }
    return ends == (size_t)nx && (!nx || !names.at[names.left - 1]) && (nx || !names.left)
        && ac_all_finite(m->size, nx) && ac_within(m->rate, nx, 2);
}

/* Read what both kinds of files have. */
int ac_read_parts(const ac_section *found, ac_model_parts *parts) {
    ac_model *m = &parts->model;
    ac_equations *e = &m->equations;
    if (!read_start(found[AC_NUMBERS], found[AC_START], m) || !read_pattern(found[AC_PATTERN], e) || !read_states(found, m)) {
        return 0;
    }
    const int32_t n = e->nx + e->nz, entries = e->start[n], varying = n + 1;
    const ac_tape *t = parts->tape;
    for (int k = 0; k < AC_EQUATION_TAPES; k++) {
        if (AC_VALUES + k >= AC_POWERS && !found[AC_VALUES + k].at) continue;
        if (!ac_read_tape(found[AC_VALUES + k], varying + e->np + e->nc, 0, varying, &parts->tape[k])) return 0;
    }
    e->values = t, e->slopes = t + 1, e->powers = found[AC_POWERS].at ? t + 2 : NULL, e->kinks = found[AC_KINKS].at ? t + 3 : NULL;
    return t[0].outputs == n && (t[1].outputs == entries || t[1].outputs == entries + n) && (!e->powers || t[2].outputs <= 2);
}

/* Read a model; NULL where the bytes are none, and why. They are copied, and need not be aligned. */
ac_model *ac_model_read(const void *bytes, size_t length, int32_t *why) {
    ac_section found[AC_SECTIONS];
    if ((*why = ac_file_outside(bytes, length, VERSION)) != AC_READ) return NULL;
    whole *w = malloc(sizeof *w + length);
    if (!w) {
        *why = AC_NO_MEMORY;
        return NULL;
    }
    memset(w, 0, sizeof *w);
    memcpy(w->file, bytes, length);
    const unsigned char *own = (const unsigned char *)w->file;
    if (ac_file_split(own, length, TAG, AC_SECTIONS, found) && ac_read_parts(found, &w->parts)) return &w->parts.model;
    *why = AC_CONTENT;
    free(w);
    return NULL;
}

void ac_model_free(ac_model *model) { free(model); }
