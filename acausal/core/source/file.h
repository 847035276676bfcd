/* What readers of files share: the frame around the sections, and numbers, patterns and tapes in them. */
#ifndef ACAUSAL_FILE_H
#define ACAUSAL_FILE_H

#include "core.h"

#define AC_TAG 8 /* letters that name a section */

/* What is left of a section. */
typedef struct {
    const unsigned char *at;
    size_t left;
} ac_section;

/* The sections that both kinds of files have, first. */
enum { AC_NUMBERS, AC_VALUES, AC_SLOPES, AC_POWERS, AC_KINKS, AC_PATTERN, AC_START, AC_SIZES, AC_RATES, AC_NAMES, AC_SECTIONS };

#define AC_EQUATION_TAPES (AC_PATTERN - AC_VALUES)

/* What a model is read into: the tapes stand beside it. */
typedef struct {
    ac_model model;
    ac_tape tape[AC_EQUATION_TAPES];
} ac_model_parts;

int32_t ac_file_outside(const unsigned char *bytes, size_t length, uint32_t version);
int ac_file_split(const unsigned char *at, size_t length, const char (*tag)[AC_TAG + 1], int tags, ac_section *found);
const void *ac_take(ac_section *s, int64_t count, size_t size);
int ac_within(const int32_t *number, int32_t count, int64_t limit);
int ac_all_finite(const double *number, int32_t count);
int ac_read_tape(ac_section s, int32_t inputs, int32_t from, int32_t to, ac_tape *t);
int ac_read_columns(ac_section *s, int32_t rows, int32_t columns, const int32_t **start, const int32_t **row);
int ac_read_parts(const ac_section *found, ac_model_parts *parts);

#endif
