/* The course of a run: times, initialisation, events, steps, and the values in between. */
#include "face.h"

#include <float.h>
#include <math.h>

/* Importers count times in their own way: that is rounding. What is more than this part of a step is another time. */
#define SLACK 1e-3
#define ROUNDING (4 * DBL_EPSILON)

/* The answer where nothing is tried elsewhere: the standard knows nothing that is discarded there. */
static int must(ac_face *f, const char *call, int32_t end) {
    return ac_face_answer(f, call, end == AC_RETRY ? AC_REFUSED : end);
}

/* Note the times of a run; tolerance 0 and stop nan: not given. */
int ac_face_times(ac_face *f, const char *call, double tolerance, double start, double stop) {
    if (!ac_face_in(f, call, AC_NEW)) return fmi3Error;
    if (!isfinite(start)) return ac_face_refuse(f, call, "the start time is not a number");
    if (!(tolerance >= 0) || isinf(tolerance)) return ac_face_refuse(f, call, "the tolerance %g is not positive", tolerance);
    if (stop < start) return ac_face_refuse(f, call, "the stop time %.17g is before the start time %.17g", stop, start);
    f->tolerance = tolerance, f->start = start, f->stop = stop, f->stated = 1;
    return fmi3OK;
}

int ac_face_begin(ac_face *f, const char *call) {
    if (!ac_face_in(f, call, AC_NEW)) return fmi3Error;
    if (!f->stated) return ac_face_refuse(f, call, "the start time has to be stated before");
    const int answer = must(f, call, ac_begin(f->engine, f->start, f->stop, f->tolerance, f->simulates));
    if (answer == fmi3OK) f->mode = AC_STARTING;
    return answer;
}

/* All that happens at this instant. */
static int happen(ac_face *f, const char *call, ac_happened *found) {
    *found = (ac_happened){0};
    const int answer = must(f, call, ac_event(f->engine, found));
    if (answer != fmi3OK) return answer;
    f->ends = found->ends != 0;
    ac_face_log(f, AC_LOG_EVENTS, "event at %.17g%s%s", ac_time(f->engine), found->states ? ", states changed" : "",
                found->ends ? ", the simulation ends" : "");
    return fmi3OK;
}

/* Some importers go on from an event that ends the simulation: they are told again in the next step. */
static int leave(ac_face *f, const char *call) {
    const int answer = must(f, call, f->ends ? AC_OK : ac_leave_event(f->engine));
    if (answer == fmi3OK) f->mode = f->simulates ? AC_STEPPING : AC_CONTINUOUS;
    return answer;
}

/* End the initialisation; where importers know no events, what happens at the start is done at once. */
int ac_face_begun(ac_face *f, const char *call) {
    ac_happened found;
    if (!ac_face_in(f, call, AC_STARTING)) return fmi3Error;
    int answer = must(f, call, ac_begun(f->engine));
    if (answer != fmi3OK) return answer;
    f->mode = AC_EVENT;
    if (!f->simulates || f->events) return fmi3OK;
    answer = happen(f, call, &found);
    return answer == fmi3OK ? leave(f, call) : answer;
}

int ac_face_update(ac_face *f, const char *call, ac_happened *found) {
    return ac_face_in(f, call, AC_EVENT) ? happen(f, call, found) : fmi3Error;
}

int ac_face_enter_event(ac_face *f, const char *call) {
    if (!ac_face_in(f, call, AC_CONTINUOUS | AC_STEPPING)) return fmi3Error;
    if (f->simulates && !f->events) return ac_face_refuse(f, call, "events of this instance are handled in its steps");
    /* A step that found an event may have left the engine there. */
    const int32_t end = ac_phase(f->engine) == AC_AT_EVENT ? AC_OK : ac_enter_event(f->engine);
    const int answer = must(f, call, end);
    if (answer == fmi3OK) f->mode = AC_EVENT, f->waits = 0;
    return answer;
}

/* Go on from an event in the way of one kind. */
int ac_face_leave_event(ac_face *f, const char *call, int simulates) {
    if (!ac_face_in(f, call, AC_EVENT)) return fmi3Error;
    if (f->simulates == simulates) return leave(f, call);
    return ac_face_refuse(f, call, "this must not be called in %s", f->simulates ? "Co-Simulation" : "Model Exchange");
}

/* What happens at the end of a step is an event that an indicator or the time tells. */
int ac_face_completed(ac_face *f, const char *call) {
    if (!ac_face_in(f, call, AC_CONTINUOUS)) return fmi3Error;
    return must(f, call, ac_completed(f->engine));
}

int ac_face_terminate(ac_face *f, const char *call) {
    if (!ac_face_in(f, call, AC_STARTED)) return fmi3Error;
    f->mode = AC_TERMINATED;
    return fmi3OK;
}

int ac_face_reset(ac_face *f, const char *call) {
    if (!ac_face_in(f, call, AC_ANY)) return fmi3Error;
    const int answer = must(f, call, ac_reset(f->engine));
    if (answer == fmi3OK) f->mode = AC_NEW, f->stated = f->ends = f->waits = 0;
    return answer;
}

/* Whether a step is one that the instance can take now. */
static int can_step(const ac_face *f, const char *call, double from, double size) {
    const double now = ac_time(f->engine), to = from + size, slack = SLACK * size + ROUNDING * fabs(now);
    if (!(size > 0) || !isfinite(to)) ac_face_refuse(f, call, "from %.17g by %.17g is no step", from, size);
    else if (fabs(from - now) > slack) ac_face_refuse(f, call, "the step begins at %.17g, the last ended at %.17g", from, now);
    else if (to > f->stop + slack) ac_face_refuse(f, call, "the step ends at %.17g, after the stop time %.17g", to, f->stop);
    else if (f->waits) ac_face_refuse(f, call, "the event at %.17g has to be handled first", now);
    else return 1;
    return 0;
}

int ac_face_step(ac_face *f, const char *call, double from, double size, ac_stepped *done) {
    if (!ac_face_in(f, call, AC_STEPPING) || !can_step(f, call, from, size)) return fmi3Error;
    const double to = from + size > f->stop ? f->stop : from + size;
    double reached = ac_time(f->engine);
    int32_t event = 0;
    if (!f->ends && to > reached) {
        const int answer = ac_face_answer(f, call, ac_step(f->engine, to, f->early, &reached, &event));
        if (answer != fmi3OK) {
            *done = (ac_stepped){.reached = ac_time(f->engine)};
            return answer;
        }
        f->waits = f->early && event;
        f->ends = reached < to && !f->waits;
        if (f->waits) ac_face_log(f, AC_LOG_EVENTS, "the step to %.17g ended at %.17g with an event", to, reached);
        if (f->ends) ac_face_log(f, AC_LOG_EVENTS, "the simulation ended at %.17g", reached);
    }
    *done = (ac_stepped){.event = f->waits, .ends = f->ends, .early = f->early && reached < to, .reached = reached};
    return fmi3OK;
}
