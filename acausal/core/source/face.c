/* Instances as importers see them: made, freed, logged, and asked for what their state allows. */
#include "face.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define LONGEST 2048 /* of a message */

static const char *const CATEGORY[AC_LOGS] = {"logStatusError", "logEvents"};

ac_face *ac_face_make(const char *name, int logging, ac_say *say) {
    const char *own = name ? name : "";
    ac_face *f = calloc(1, sizeof *f + strlen(own) + 1);
    if (!f) return NULL;
    strcpy(f->name, own);
    f->mode = AC_NEW;
    f->say = say;
    /* Errors are told unless they are switched off: an importer that wants no other messages wants these. */
    f->logs[AC_LOG_ERRORS] = 1, f->logs[AC_LOG_EVENTS] = logging;
    return f;
}

void ac_face_free(ac_face *f) {
    if (!f) return;
    ac_instance_free(f->engine);
    ac_unit_free(f->unit);
    free(f);
}

/* Read the model and check that it is the one that the description tells of; whether that went well. */
static int load(ac_face *f, const char *call, const char *token, const char *path) {
    size_t length;
    int32_t why;
    void *bytes = ac_face_bytes(path, &length);
    if (!bytes) {
        ac_face_refuse(f, call, "%s cannot be read", path);
        return 0;
    }
    f->unit = ac_unit_read(bytes, length, &why);
    free(bytes);
    if (!f->unit) {
        ac_face_refuse(f, call, "%s is not used: %s", path, ac_unit_why(why));
        return 0;
    }
    const char *own = ac_unit_token(f->unit);
    if (!token || strcmp(token, own) != 0) {
        ac_face_refuse(f, call, "%s is of model %s, not of %s", path, own, token ? token : "no name");
        return 0;
    }
    f->engine = ac_instance_make(f->unit);
    if (!f->engine) ac_face_refuse(f, call, "there is no memory for an instance");
    return f->engine != NULL;
}

/* Complete an instance, or free it and return NULL. */
ac_face *ac_face_load(ac_face *f, const char *call, const char *token, const char *resources, int is_uri) {
    char *path = resources ? ac_face_path(resources, is_uri) : NULL;
    const int loaded = path && load(f, call, token, path);
    if (!path) ac_face_refuse(f, call, "'%s' names no folder of this machine", resources ? resources : "");
    free(path);
    if (loaded) return f;
    ac_face_free(f);
    return NULL;
}

static void tell(const ac_face *f, int status, int category, const char *call, const char *format, va_list given) {
    char text[LONGEST];
    if (!f->logs[category]) return;
    const int used = call ? snprintf(text, sizeof text, "%s: ", call) : 0;
    if (used < 0 || used >= LONGEST) return;
    vsnprintf(text + used, sizeof text - (size_t)used, format, given);
    f->say(f, status, CATEGORY[category], text);
}

/* Log what is no error. */
void ac_face_log(const ac_face *f, int category, const char *format, ...) {
    va_list given;
    va_start(given, format);
    tell(f, fmi3OK, category, NULL, format, given);
    va_end(given);
}

/* Log an error, and answer with it. */
int ac_face_refuse(const ac_face *f, const char *call, const char *format, ...) {
    va_list given;
    va_start(given, format);
    tell(f, fmi3Error, AC_LOG_ERRORS, call, format, given);
    va_end(given);
    return fmi3Error;
}

/* The same, for what may go well in another way. */
int ac_face_discard(const ac_face *f, const char *call, const char *format, ...) {
    va_list given;
    va_start(given, format);
    tell(f, fmi3Discard, AC_LOG_ERRORS, call, format, given);
    va_end(given);
    return fmi3Discard;
}

static const char *name_of(int mode) {
    switch (mode) {
    case AC_NEW: return "the state Instantiated";
    case AC_CONFIGURED: return "Configuration Mode";
    case AC_STARTING: return "Initialization Mode";
    case AC_EVENT: return "Event Mode";
    case AC_CONTINUOUS: return "Continuous-Time Mode";
    case AC_STEPPING: return "Step Mode";
    case AC_TERMINATED: return "the state Terminated";
    default: return "the state after an error from which it cannot go on";
    }
}

/* Whether an instance is in one of these states. */
int ac_face_in(const ac_face *f, const char *call, int modes) {
    if (!f) return 0;
    if (f->mode & modes) return 1;
    ac_face_refuse(f, call, "this must not be called in %s", name_of(f->mode));
    return 0;
}

/* The answer to how the engine ended. */
int ac_face_answer(ac_face *f, const char *call, int32_t end) {
    if (end == AC_OK) return fmi3OK;
    if (end == AC_RETRY) return ac_face_discard(f, call, "%s", ac_message(f->engine));
    if (end == AC_FAILED) f->mode = AC_LOST;
    return ac_face_refuse(f, call, "%s", ac_message(f->engine));
}

/* The answer to a call for what no model has: right for none of it. */
int ac_face_none(const ac_face *f, const char *call, size_t count, const char *what) {
    if (!f) return fmi3Error;
    return count ? ac_face_refuse(f, call, "the model has no %s", what) : fmi3OK;
}

/* Switch categories of the log, all of them where none is named. */
int ac_face_logging(ac_face *f, const char *call, int on, size_t count, const char *const *category) {
    if (!ac_face_in(f, call, AC_ANY)) return fmi3Error;
    int chosen[AC_LOGS];
    for (int k = 0; k < AC_LOGS; k++) chosen[k] = !count;
    for (size_t j = 0; j < count; j++) {
        int k = 0;
        while (k < AC_LOGS && (!category[j] || strcmp(category[j], CATEGORY[k]) != 0)) k++;
        if (k == AC_LOGS) return ac_face_refuse(f, call, "there is no category %s", category[j] ? category[j] : "of no name");
        chosen[k] = 1;
    }
    for (int k = 0; k < AC_LOGS; k++) {
        if (chosen[k]) f->logs[k] = on;
    }
    return fmi3OK;
}
