/* Values of an instance as importers read and write them. */
#include "face.h"

#define SETTABLE (AC_NEW | AC_STARTING | AC_STARTED)

int ac_face_get(ac_face *f, const char *call, const uint32_t *reference, size_t count, double *value) {
    /* Without a sound state values can still tell what went wrong. */
    if (!ac_face_in(f, call, AC_ANY)) return fmi3Error;
    return count ? ac_face_answer(f, call, ac_get(f->engine, reference, count, value)) : fmi3OK;
}

int ac_face_set(ac_face *f, const char *call, const uint32_t *reference, size_t count, const double *value) {
    if (!ac_face_in(f, call, SETTABLE)) return fmi3Error;
    return count ? ac_face_answer(f, call, ac_set(f->engine, reference, count, value)) : fmi3OK;
}

/* Slopes of inputs in the next step; no other derivatives are taken. */
int ac_face_set_slopes(ac_face *f, const char *call, const uint32_t *reference, size_t count, const int *order,
                       const double *slope) {
    if (!ac_face_in(f, call, AC_NEW | AC_STARTING | AC_STEPPING)) return fmi3Error;
    if (!f->simulates) return ac_face_refuse(f, call, "this must not be called in Model Exchange");
    for (size_t k = 0; k < count; k++) {
        if (order[k] != 1) return ac_face_refuse(f, call, "derivatives of order %d are not taken", order[k]);
    }
    return count ? ac_face_answer(f, call, ac_set_slopes(f->engine, reference, count, slope)) : fmi3OK;
}

/* Whether a call of Model Exchange meets an instance of that kind, and as many values as there are. */
static int exchanges(const ac_face *f, const char *call, int modes, size_t count, int32_t own) {
    if (!ac_face_in(f, call, modes)) return 0;
    if (f->simulates) ac_face_refuse(f, call, "this must not be called in Co-Simulation");
    else if (count != (size_t)own) ac_face_refuse(f, call, "%lu values, where there are %d", (unsigned long)count, (int)own);
    else return 1;
    return 0;
}

int ac_face_set_time(ac_face *f, const char *call, double time) {
    if (!exchanges(f, call, AC_EVENT | AC_CONTINUOUS, 0, 0)) return fmi3Error;
    return ac_face_answer(f, call, ac_set_time(f->engine, time));
}

int ac_face_set_states(ac_face *f, const char *call, const double *x, size_t count) {
    if (!f || !exchanges(f, call, AC_CONTINUOUS, count, ac_states(f->engine))) return fmi3Error;
    return count ? ac_face_answer(f, call, ac_set_states(f->engine, x)) : fmi3OK;
}

int ac_face_read_states(ac_face *f, const char *call, ac_reader *reader, double *value, size_t count) {
    if (!f || !exchanges(f, call, AC_VALUED, count, ac_states(f->engine))) return fmi3Error;
    return count ? ac_face_answer(f, call, reader(f->engine, value)) : fmi3OK;
}

int ac_face_read_indicators(ac_face *f, const char *call, double *value, size_t count) {
    if (!f || !exchanges(f, call, AC_VALUED, count, ac_indicators(f->engine))) return fmi3Error;
    return count ? ac_face_answer(f, call, ac_get_indicators(f->engine, value)) : fmi3OK;
}

int ac_face_slope(ac_face *f, const char *call, ac_slope *slope, const uint32_t *unknown, size_t unknowns,
                  const uint32_t *known, size_t knowns, const double *seed, double *sensitivity) {
    if (!ac_face_in(f, call, AC_VALUED)) return fmi3Error;
    return ac_face_answer(f, call, slope(f->engine, unknown, unknowns, known, knowns, seed, sensitivity));
}
