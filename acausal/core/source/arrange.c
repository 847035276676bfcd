/* Arrange the operations of a function for a tape: equal ones once, those of one kind in runs that are as long as possible. */
#include "core.h"

#include <stdlib.h>
#include <string.h>

/* Operations that are ready, by kind, in the order in which they became so; and kinds in the order of their first one. */
typedef struct {
    int32_t first[AC_OPERATIONS], last[AC_OPERATIONS], length[AC_OPERATIONS], seen[AC_OPERATIONS], kinds;
} ready;

typedef struct {
    const ac_operations *of;
    int32_t *same;          /* the first one that is equal to each */
    int32_t *start, *user;  /* operations that take each one: user[start[k]], ... */
    int32_t *waits, *next;  /* for how many arguments each one waits; what became ready after it */
    ready now, later;       /* what needs rarely changing arguments alone, and the rest */
} state;

/* Find equal ones (value numbering): operations of one kind on equal arguments; leaves tell it. */
static int32_t number(const ac_operations *f, int32_t *same) {
    uint32_t size = 16;
    while (size < 2 * (uint32_t)f->n) size *= 2;
    int32_t *table = malloc(size * sizeof *table);
    if (!table) return -1;
    for (uint32_t k = 0; k < size; k++) table[k] = -1;
    for (int32_t k = 0; k < f->n; k++) {
        same[k] = f->first[k];
        if (f->kind[k] < 0) continue;
        const int32_t kind = f->kind[k], a = same[f->first[k]], b = same[f->second[k]];
        uint32_t place = (uint32_t)a * 2654435769u ^ ((uint32_t)b * 2246822519u + (uint32_t)kind * 3266489917u);
        place ^= place >> 16, place *= 2146121005u, place ^= place >> 15;
        for (place &= size - 1; table[place] >= 0; place = (place + 1) & (size - 1)) {
            const int32_t known = table[place];
            if (f->kind[known] == kind && same[f->first[known]] == a && same[f->second[known]] == b) break;
        }
        if (table[place] < 0) table[place] = k;
        same[k] = table[place];
    }
    free(table);
    return 0;
}

/* Whether a place holds the first of equal operations. */
static int counts(const state *s, int32_t k) { return s->of->kind[k] >= 0 && s->same[k] == k; }

/* Note who takes each one, and what changes with arguments that change often. */
static void meet(state *s) {
    const ac_operations *f = s->of;
    memset(s->start, 0, ((size_t)f->n + 1) * sizeof *s->start);
    for (int32_t k = 0; k < f->n; k++) {
        if (!counts(s, k)) continue;
        const int32_t a = s->same[f->first[k]], b = s->same[f->second[k]];
        s->start[a + 1]++, s->start[b + 1]++;
        f->late[k] = f->late[a] || f->late[b];
    }
    for (int32_t k = 0; k < f->n; k++) s->start[k + 1] += s->start[k];
    memcpy(s->next, s->start, (size_t)f->n * sizeof *s->next);
    for (int32_t k = 0; k < f->n; k++) {
        if (!counts(s, k)) continue;
        s->user[s->next[s->same[f->first[k]]]++] = k;
        s->user[s->next[s->same[f->second[k]]]++] = k;
        s->waits[k] = 2;
    }
}

static void put(state *s, int32_t k) {
    const int32_t kind = s->of->kind[k];
    ready *r = s->of->late[k] ? &s->later : &s->now;
    int32_t known = 0;
    while (known < r->kinds && r->seen[known] != kind) known++;
    if (known == r->kinds) r->seen[r->kinds++] = kind;
    if (r->length[kind]++) s->next[r->last[kind]] = k;
    else r->first[kind] = k;
    r->last[kind] = k, s->next[k] = -1;
}

/* Let be ready what waited for this one alone. */
static void follow(state *s, int32_t k) {
    for (int32_t e = s->start[k]; e < s->start[k + 1]; e++) {
        if (!--s->waits[s->user[e]]) put(s, s->user[e]);
    }
}

/* Take the longest of the lists, again and again, with what joins it meanwhile. */
static void take(state *s, ready *r, ac_arranged *to) {
    for (;;) {
        int32_t kind = r->seen[0];
        for (int32_t k = 1; k < r->kinds; k++) {
            if (r->length[r->seen[k]] > r->length[kind]) kind = r->seen[k];
        }
        if (!r->kinds || !r->length[kind]) return;
        for (int32_t k = r->first[kind]; k >= 0; k = s->next[k]) {
            to->order[to->results++] = k;
            follow(s, k);
        }
        to->run_kind[to->runs] = kind, to->run_length[to->runs++] = r->length[kind];
        r->length[kind] = 0;
    }
}

/* Returns 0, -1 where there is no memory. */
int32_t ac_arrange(const ac_operations *f, ac_arranged *to) {
    const size_t n = (size_t)f->n + 1;
    state s = {.of = f, .same = to->same};
    to->results = to->runs = to->early = 0;
    s.start = calloc(5 * n + 1, sizeof *s.start);
    if (!s.start || number(f, s.same)) {
        free(s.start);
        return -1;
    }
    s.waits = s.start + n, s.next = s.waits + n, s.user = s.next + n;
    meet(&s);
    for (int32_t k = 0; k < f->n; k++) {
        if (f->kind[k] < 0 && s.same[k] == k) follow(&s, k);
    }
    take(&s, &s.now, to);
    to->early = to->runs;
    take(&s, &s.later, to);
    free(s.start);
    return 0;
}
