/* Search for consistent modes: positions of all switches that agree with the values that they imply, as `mode_search.py`.

   The mode follows from the values until one recurs. Then switches change one at a time, as in principal pivoting methods (Murty 1974),
   those that open before those that close; where that recurs too, all modes are enumerated by the number of switches that change. */
#include "instance.h"

#include <string.h>

static double *mode_of(const ac_mode_search *s, int32_t k) { return s->seen + (ptrdiff_t)k * s->n; }

void ac_begin_search(ac_instance *i, int32_t n) {
    ac_mode_search *s = &i->search;
    s->n = n, s->count = s->first = s->cycle = s->changes = 0;
}

/* The first mode that was seen and is equal to another; their number where there is none. */
static int32_t find(const ac_mode_search *s, const double *mode) {
    for (int32_t k = 0; k < s->count; k++) {
        int32_t equal = 0;
        while (equal < s->n && mode_of(s, k)[equal] == mode[equal]) equal++;
        if (equal == s->n) return k;
    }
    return s->count;
}

/* Take back all changes from one mode to another but that of one switch, which opens if any does. */
static void change_one(const ac_mode_search *s, const double *current, double *mode) {
    int32_t one = -1;
    for (int32_t k = 0; k < s->switches; k++) {
        const int32_t place = s->place[k];
        if (current[place] != mode[place] && (one < 0 || current[place] > current[one])) one = place;
    }
    for (int32_t k = 0; k < s->switches; k++) {
        if (s->place[k] != one) mode[s->place[k]] = current[s->place[k]];
    }
}

/* Begin to enumerate: the switches that change in the cycle come first. */
static void begin_cycle(ac_mode_search *s, int32_t first) {
    int32_t found = 0;
    s->first = first, s->cycle = s->count - first;
    for (int changes = 1; changes >= 0; changes--) {
        for (int32_t k = 0; k < s->switches; k++) {
            int differs = 0;
            for (int32_t m = first; m < s->count; m++) differs |= mode_of(s, m)[s->place[k]] != mode_of(s, first)[s->place[k]];
            if (differs == changes) s->order[found++] = s->place[k];
        }
        if (changes) s->cycling = found;
    }
}

/* The next combination of `changes` switches; 0 where there is none. */
static int combine(ac_mode_search *s) {
    int32_t k = s->changes - 1;
    while (k >= 0 && s->chosen[k] == s->switches - s->changes + k) k--;
    if (k < 0) return 0;
    s->chosen[k]++;
    for (int32_t j = k + 1; j < s->changes; j++) s->chosen[j] = s->chosen[j - 1] + 1;
    return 1;
}

/* The next of all modes: they differ from one of the cycle in as many switches as are chosen. */
static int enumerate(ac_mode_search *s, double *mode) {
    if (!s->changes || !combine(s)) {
        if (!s->changes || ++s->base == s->first + s->cycle) s->base = s->first, s->changes++;
        if (s->changes > s->switches) return 0;
        for (int32_t k = 0; k < s->changes; k++) s->chosen[k] = k;
    }
    ac_put(mode, mode_of(s, s->base), s->n);
    for (int32_t k = 0; k < s->changes; k++) {
        const int32_t place = s->order[s->chosen[k]];
        mode[place] = mode[place] == 0;
    }
    return 1;
}

int ac_next_mode(ac_mode_search *s, const double *current, double *mode) {
    const int32_t seen = find(s, mode);
    if (s->count == AC_MODES) return 0;
    if (!s->cycle && seen < s->count) begin_cycle(s, seen);
    if (s->cycle) change_one(s, current, mode);
    while (find(s, mode) < s->count) {
        if (!s->cycle || !enumerate(s, mode)) return 0;
    }
    ac_put(mode_of(s, s->count++), mode, s->n);
    return 1;
}
