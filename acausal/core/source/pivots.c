/* Choose the pivots of a sparse matrix by Markowitz's count, among those that are large enough.

   The matrix stands in columns whose entries of rows already taken stand in front: at the end these are U, the others L. */
#include "lu.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define CANDIDATES 4 /* columns that are looked at for a pivot, as in Zlatev's strategy */

/* Lists that grow: entries of list k stand at place[k], used[k] of room[k]. */
typedef struct {
    int32_t *place, *used, *room, *index;
    double *value;
    int32_t end, capacity;
} lists;

static void empty(lists *m) {
    free(m->place);
    free(m->index);
    free(m->value);
    memset(m, 0, sizeof *m);
}

/* Lists of `count[k]` entries and some room. */
static int make(lists *m, int32_t n, const int32_t *count, int values) {
    memset(m, 0, sizeof *m);
    m->place = malloc((3 * (size_t)n + 1) * sizeof *m->place);
    if (!m->place) return 0;
    m->used = m->place + n;
    m->room = m->used + n;
    for (int32_t k = 0; k < n; k++) {
        m->place[k] = m->end;
        m->used[k] = 0;
        m->room[k] = count[k] + 4;
        m->end += m->room[k];
    }
    m->capacity = 2 * m->end + 16;
    m->index = malloc((size_t)m->capacity * sizeof *m->index);
    m->value = values ? malloc((size_t)m->capacity * sizeof *m->value) : NULL;
    return m->index && (m->value || !values);
}

/* Move a list to the end, with twice the room. */
static int widen(lists *m, int32_t k) {
    const int32_t room = 2 * m->room[k];
    if (m->end > m->capacity - room) {
        if (m->capacity > (INT32_MAX - room) / 2) return 0;
        const int32_t capacity = 2 * m->capacity + room;
        int32_t *index = realloc(m->index, (size_t)capacity * sizeof *index);
        if (!index) return 0;
        m->index = index;
        if (m->value) {
            double *value = realloc(m->value, (size_t)capacity * sizeof *value);
            if (!value) return 0;
            m->value = value;
        }
        m->capacity = capacity;
    }
    memcpy(m->index + m->end, m->index + m->place[k], (size_t)m->used[k] * sizeof *m->index);
    if (m->value) memcpy(m->value + m->end, m->value + m->place[k], (size_t)m->used[k] * sizeof *m->value);
    m->place[k] = m->end;
    m->room[k] = room;
    m->end += room;
    return 1;
}

static int append(lists *m, int32_t k, int32_t index, double value) {
    if (m->used[k] == m->room[k] && !widen(m, k)) return 0;
    const int32_t at = m->place[k] + m->used[k]++;
    m->index[at] = index;
    if (m->value) m->value[at] = value;
    return 1;
}

/* The matrix while pivots are chosen. */
typedef struct {
    lists columns, rows; /* rows: columns alone, those already taken among them */
    int32_t *taken;      /* entries at the front of each column whose rows have been taken */
    int32_t *in_row;     /* entries of each row in columns not yet taken */
    int32_t *head, *next, *before, *seat; /* columns by number of entries in rows not yet taken; places in a column */
} choice;

static int32_t left(const choice *c, int32_t j) { return c->columns.used[j] - c->taken[j]; }

static void leave(choice *c, int32_t j) {
    if (c->before[j] >= 0) c->next[c->before[j]] = c->next[j];
    else c->head[left(c, j)] = c->next[j];
    if (c->next[j] >= 0) c->before[c->next[j]] = c->before[j];
}

static void enter(choice *c, int32_t j) {
    int32_t *head = &c->head[left(c, j)];
    c->before[j] = -1;
    c->next[j] = *head;
    if (*head >= 0) c->before[*head] = j;
    *head = j;
}

static void drop(choice *c) {
    empty(&c->columns);
    empty(&c->rows);
    free(c->taken);
    memset(c, 0, sizeof *c);
}

static int begin(choice *c, const ac_lu *lu, const double *value) {
    const int32_t n = lu->n, entries = lu->start[n];
    memset(c, 0, sizeof *c);
    c->taken = calloc(6 * (size_t)n + 2, sizeof *c->taken);
    if (!c->taken) return 0;
    c->in_row = c->taken + n;
    c->next = c->in_row + n;
    c->before = c->next + n;
    c->seat = c->before + n;
    c->head = c->seat + n;
    for (int32_t k = 0; k < entries; k++) c->in_row[lu->row[k]]++;
    for (int32_t j = 0; j < n; j++) c->next[j] = lu->start[j + 1] - lu->start[j];
    if (!make(&c->columns, n, c->next, 1) || !make(&c->rows, n, c->in_row, 0)) return 0;
    for (int32_t k = 0; k <= n; k++) c->head[k] = -1;
    for (int32_t j = 0; j < n; j++) {
        for (int32_t k = lu->start[j]; k < lu->start[j + 1]; k++) {
            const int32_t i = lu->row[k];
            append(&c->columns, j, i, value[k] * lu->scale[i]);
            append(&c->rows, i, j, 0);
        }
        enter(c, j);
    }
    return 1;
}

/* Place of the pivot that fills least, among those that are large enough; -1 where all are 0. */
static int32_t cheapest(const choice *c, int32_t n, double enough, int32_t *column) {
    int64_t least = INT64_MAX;
    int32_t best = -1, seen = 0;
    double size = 0;
    for (int32_t count = 1; count <= n; count++) {
        for (int32_t j = c->head[count]; j >= 0; j = c->next[j]) {
            const int32_t from = c->columns.place[j] + c->taken[j], to = c->columns.place[j] + c->columns.used[j];
            double most = 0;
            for (int32_t k = from; k < to; k++) most = fmax(most, fabs(c->columns.value[k]));
            for (int32_t k = from; k < to && most > 0; k++) {
                const double here = fabs(c->columns.value[k]);
                const int64_t fill = (int64_t)(c->in_row[c->columns.index[k]] - 1) * (count - 1);
                if (here >= enough * most && (fill < least || (fill == least && here > size))) {
                    least = fill, size = here, best = k, *column = j;
                }
            }
            seen += most > 0;
            if (best >= 0 && (least <= (int64_t)(count - 1) * (count - 1) || seen >= CANDIDATES)) return best;
        }
    }
    return best;
}

static void to_front(choice *c, int32_t j, int32_t at) {
    lists *m = &c->columns;
    const int32_t front = m->place[j] + c->taken[j]++, index = m->index[at];
    const double value = m->value[at];
    m->index[at] = m->index[front], m->value[at] = m->value[front];
    m->index[front] = index, m->value[front] = value;
}

/* Subtract the pivot's column, times a factor, from column j whose entry in the pivot's row has just been taken. */
static int eliminate(choice *c, int32_t j, int32_t pivot, double factor) {
    lists *m = &c->columns;
    int32_t *seat = c->seat;
    for (int32_t k = c->taken[j]; k < m->used[j]; k++) seat[m->index[m->place[j] + k]] = k + 1;
    for (int32_t k = c->taken[pivot]; k < m->used[pivot]; k++) {
        const int32_t i = m->index[m->place[pivot] + k];
        const double change = factor * m->value[m->place[pivot] + k];
        if (seat[i]) {
            m->value[m->place[j] + seat[i] - 1] -= change;
        } else {
            if (!append(m, j, i, -change) || !append(&c->rows, i, j, 0)) return 0;
            c->in_row[i]++;
        }
    }
    for (int32_t k = c->taken[j]; k < m->used[j]; k++) seat[m->index[m->place[j] + k]] = 0;
    return 1;
}

/* Take a pivot: its row leaves all columns, its column all rows. */
static int take(choice *c, int32_t j, int32_t at, const int32_t *step_of_column) {
    lists *m = &c->columns;
    const int32_t i = m->index[at];
    const double pivot = m->value[at];
    leave(c, j);
    to_front(c, j, at);
    for (int32_t k = c->taken[j]; k < m->used[j]; k++) c->in_row[m->index[m->place[j] + k]]--;
    for (int32_t k = 0; k < c->rows.used[i]; k++) {
        const int32_t other = c->rows.index[c->rows.place[i] + k];
        if (other == j || step_of_column[other] >= 0) continue;
        int32_t here = m->place[other] + c->taken[other];
        while (m->index[here] != i) here++;
        const double factor = m->value[here] / pivot;
        leave(c, other);
        to_front(c, other, here);
        if (!eliminate(c, other, j, factor)) return 0;
        enter(c, other);
    }
    return 1;
}

/* Where the rows of a factor begin, columns of their entries from the first or the last on, and places of those of columns. */
static void by_rows(int32_t n, const int32_t *start, const int32_t *row, int32_t way, int32_t *in, int32_t *column, int32_t *place) {
    memset(in, 0, ((size_t)n + 1) * sizeof *in);
    for (int32_t e = 0; e < start[n]; e++) in[row[e]]++;
    for (int32_t k = 0; k < n; k++) in[k + 1] += in[k]; /* ends, which go back to the beginnings */
    for (int32_t j = way > 0 ? n - 1 : 0; j >= 0 && j < n; j -= way) {
        for (int32_t e = start[j]; e < start[j + 1]; e++) column[place[e] = --in[row[e]]] = j;
    }
}

/* Keep the pattern that the choice has left. */
static int keep(ac_lu *lu, const choice *c) {
    const lists *m = &c->columns;
    int32_t l = 0, u = 0;
    for (int32_t j = 0; j < lu->n; j++) u += c->taken[j] - 1, l += left(c, j);
    if (l > lu->l_room || u > lu->u_room) {
        const size_t below = (size_t)l + 1, above = (size_t)u + 1;
        free(lu->l), free(lu->l_row);
        lu->l_room = l, lu->u_room = u;
        lu->l = malloc((2 * below + above) * sizeof *lu->l), lu->l_row = malloc(3 * (below + above) * sizeof *lu->l_row);
        if (!lu->l || !lu->l_row) return lu->l_room = lu->u_room = 0;
        lu->l_rows = lu->l + below, lu->u_rows = lu->l_rows + below;
        lu->l_column = lu->l_row + below, lu->l_place = lu->l_column + below;
        lu->u_row = lu->l_place + below, lu->u_column = lu->u_row + above, lu->u_place = lu->u_column + above;
    }
    for (int32_t e = 0; e < lu->start[lu->n]; e++) lu->step[e] = lu->step_of[lu->row[e]], lu->factor[e] = lu->scale[lu->row[e]];
    lu->l_start[0] = lu->u_start[0] = l = u = 0, lu->flops = 0;
    for (int32_t k = 0; k < lu->n; k++) {
        const int32_t j = lu->column_of[k], *index = m->index + m->place[j];
        for (int32_t e = 0; e < c->taken[j] - 1; e++) { /* rows were taken in ascending order of steps */
            lu->u_row[u++] = lu->step_of[index[e]];
        }
        for (int32_t e = c->taken[j]; e < m->used[j]; e++) lu->l_row[l++] = lu->step_of[index[e]];
        for (int32_t e = lu->u_start[k]; e < u; e++) {
            lu->flops += 2 * (int64_t)(lu->l_start[lu->u_row[e] + 1] - lu->l_start[lu->u_row[e]]);
        }
        lu->flops += l - lu->l_start[k];
        lu->l_start[k + 1] = l, lu->u_start[k + 1] = u;
    }
    by_rows(lu->n, lu->l_start, lu->l_row, 1, lu->l_in, lu->l_column, lu->l_place);
    by_rows(lu->n, lu->u_start, lu->u_row, -1, lu->u_in, lu->u_column, lu->u_place);
    return 1;
}

/* Place of the entry of a row in a column, -1 where there is none that is not taken. */
static int32_t entry(const choice *c, int32_t i, int32_t j) {
    const lists *m = &c->columns;
    for (int32_t k = m->place[j] + c->taken[j]; k < m->place[j] + m->used[j]; k++) {
        if (m->index[k] == i) return k;
    }
    return -1;
}

/* Take all pivots: those that are given, rows and columns, else the cheapest that are `enough` of the largest entry of their
   column; 0, 1 where there is none, -1 without memory. */
int32_t ac_lu_take(ac_lu *lu, const double *value, double enough, const int32_t *row, const int32_t *column) {
    const int32_t n = lu->n;
    choice c;
    int32_t failed = 0;
    int32_t *step_of_column = malloc(((size_t)n + 1) * sizeof *step_of_column);
    if (!step_of_column) return -1;
    for (int32_t k = 0; k < n; k++) step_of_column[k] = -1;
    if (!begin(&c, lu, value)) failed = -1;
    for (int32_t k = 0; k < n && !failed; k++) {
        int32_t j = row ? column[k] : -1;
        const int32_t at = row ? entry(&c, row[k], j) : cheapest(&c, n, enough, &j);
        if (at < 0) {
            failed = 1;
            break;
        }
        lu->row_of[k] = c.columns.index[at];
        lu->column_of[k] = j;
        lu->step_of[lu->row_of[k]] = k;
        if (!take(&c, j, at, step_of_column)) failed = -1;
        step_of_column[j] = k;
    }
    if (!failed && !keep(lu, &c)) failed = -1;
    lu->odd = failed ? 0 : ac_is_odd(n, lu->row_of, step_of_column) ^ ac_is_odd(n, lu->column_of, step_of_column);
    drop(&c);
    free(step_of_column);
    return failed;
}

/* Choose all pivots for a matrix; 0, 1 where it is singular, -1 where there is no memory. */
int32_t ac_lu_choose(ac_lu *lu, const double *value, double enough) {
    const int32_t n = lu->n;
    for (int32_t i = 0; i < n; i++) lu->scale[i] = 0;
    for (int32_t k = 0; k < lu->start[n]; k++) lu->scale[lu->row[k]] = fmax(lu->scale[lu->row[k]], fabs(value[k]));
    for (int32_t i = 0; i < n; i++) {
        if (!(lu->scale[i] > 0 && isfinite(lu->scale[i]))) return 1;
        lu->scale[i] = ldexp(1, -ilogb(lu->scale[i]));
    }
    return ac_lu_take(lu, value, enough, NULL, NULL);
}
