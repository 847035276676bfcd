/* The face of FMI 2.0. */
#include "face.h"
#include "fmi.h"

#include <math.h>

#define ESCAPED 4096 /* bytes of a message: twice the longest one */

/* Importers take messages as formats, and references between # as variables. */
static void say(const ac_face *f, int status, const char *category, const char *message) {
    char text[ESCAPED], *to = text;
    for (; *message && to < text + sizeof text - 2; message++) {
        if (*message == '%' || *message == '#') *to++ = *message;
        *to++ = *message;
    }
    *to = 0;
    if (f->logger.two) f->logger.two(f->environment, f->name, (fmi2Status)status, category, text);
}

const char *fmi2GetTypesPlatform(void) { return "default"; }

const char *fmi2GetVersion(void) { return "2.0"; }

fmi2Status fmi2SetDebugLogging(fmi2Component c, fmi2Boolean on, size_t count, const fmi2String *category) {
    return ac_face_logging(c, __func__, on, count, category);
}

fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String guid, fmi2String resources,
                              const fmi2CallbackFunctions *functions, fmi2Boolean visible, fmi2Boolean logging) {
    ac_face *f = ac_face_make(name, logging, say);
    (void)visible;
    if (!f) return NULL;
    if (functions) f->logger.two = functions->logger, f->environment = functions->componentEnvironment;
    f->simulates = type == fmi2CoSimulation;
    return ac_face_load(f, __func__, guid, resources, 1);
}

void fmi2FreeInstance(fmi2Component c) { ac_face_free(c); }

fmi2Status fmi2SetupExperiment(fmi2Component c, fmi2Boolean has_tolerance, fmi2Real tolerance, fmi2Real start,
                               fmi2Boolean has_stop, fmi2Real stop) {
    return ac_face_times(c, __func__, has_tolerance ? tolerance : 0, start, has_stop ? stop : (double)NAN);
}

fmi2Status fmi2EnterInitializationMode(fmi2Component c) { return ac_face_begin(c, __func__); }

fmi2Status fmi2ExitInitializationMode(fmi2Component c) { return ac_face_begun(c, __func__); }

fmi2Status fmi2Terminate(fmi2Component c) { return ac_face_terminate(c, __func__); }

fmi2Status fmi2Reset(fmi2Component c) { return ac_face_reset(c, __func__); }

fmi2Status fmi2GetReal(fmi2Component c, const fmi2ValueReference *reference, size_t count, fmi2Real *value) {
    return ac_face_get(c, __func__, reference, count, value);
}

fmi2Status fmi2SetReal(fmi2Component c, const fmi2ValueReference *reference, size_t count, const fmi2Real *value) {
    return ac_face_set(c, __func__, reference, count, value);
}

/* All variables are real. */
#define NONE(name, type) \
    fmi2Status fmi2Get##name(fmi2Component c, const fmi2ValueReference *reference, size_t count, type *value) { \
        (void)reference, (void)value; \
        return ac_face_none(c, __func__, count, "variables of this type"); \
    } \
    fmi2Status fmi2Set##name(fmi2Component c, const fmi2ValueReference *reference, size_t count, const type *value) { \
        (void)reference, (void)value; \
        return ac_face_none(c, __func__, count, "variables of this type"); \
    }
NONE(Integer, fmi2Integer)
NONE(Boolean, fmi2Boolean)
NONE(String, fmi2String)

fmi2Status fmi2GetFMUstate(fmi2Component c, fmi2FMUstate *state) { return ac_face_store(c, __func__, state); }

fmi2Status fmi2SetFMUstate(fmi2Component c, fmi2FMUstate state) { return ac_face_restore(c, __func__, state); }

fmi2Status fmi2FreeFMUstate(fmi2Component c, fmi2FMUstate *state) { return ac_face_drop(c, state); }

fmi2Status fmi2SerializedFMUstateSize(fmi2Component c, fmi2FMUstate state, size_t *size) {
    return ac_face_stored_size(c, __func__, state, size);
}

fmi2Status fmi2SerializeFMUstate(fmi2Component c, fmi2FMUstate state, fmi2Byte *bytes, size_t size) {
    return ac_face_serialize(c, __func__, state, bytes, size);
}

fmi2Status fmi2DeSerializeFMUstate(fmi2Component c, const fmi2Byte *bytes, size_t size, fmi2FMUstate *state) {
    return ac_face_deserialize(c, __func__, bytes, size, state);
}

fmi2Status fmi2GetDirectionalDerivative(fmi2Component c, const fmi2ValueReference *unknown, size_t unknowns,
                                        const fmi2ValueReference *known, size_t knowns, const fmi2Real *seed,
                                        fmi2Real *sensitivity) {
    return ac_face_slope(c, __func__, ac_forward, unknown, unknowns, known, knowns, seed, sensitivity);
}
