/* The face of FMI 3.0: values, their derivatives and stored states. */
#include "face.h"
#include "fmi.h"

/* Whether there is a value to each reference: all variables are scalars. */
static int scalars(const ac_face *f, const char *call, size_t count, size_t values) {
    if (!f || count == values) return f != NULL;
    ac_face_refuse(f, call, "%lu values for %lu scalars", (unsigned long)values, (unsigned long)count);
    return 0;
}

fmi3Status fmi3GetFloat64(fmi3Instance i, const fmi3ValueReference *reference, size_t count, fmi3Float64 *value, size_t values) {
    return scalars(i, __func__, count, values) ? ac_face_get(i, __func__, reference, count, value) : fmi3Error;
}

fmi3Status fmi3SetFloat64(fmi3Instance i, const fmi3ValueReference *reference, size_t count, const fmi3Float64 *value,
                          size_t values) {
    return scalars(i, __func__, count, values) ? ac_face_set(i, __func__, reference, count, value) : fmi3Error;
}

/* All variables are of the type Float64. */
static fmi3Status none(const ac_face *f, const char *call, size_t count) {
    return ac_face_none(f, call, count, "variables of this type");
}

#define NONE(name, type) \
    fmi3Status fmi3Get##name(fmi3Instance i, const fmi3ValueReference *reference, size_t count, type *value, size_t values) { \
        (void)reference, (void)value, (void)values; \
        return none(i, __func__, count); \
    } \
    fmi3Status fmi3Set##name(fmi3Instance i, const fmi3ValueReference *reference, size_t count, const type *value, \
                             size_t values) { \
        (void)reference, (void)value, (void)values; \
        return none(i, __func__, count); \
    }
NONE(Float32, fmi3Float32)
NONE(Int8, fmi3Int8)
NONE(UInt8, fmi3UInt8)
NONE(Int16, fmi3Int16)
NONE(UInt16, fmi3UInt16)
NONE(Int32, fmi3Int32)
NONE(UInt32, fmi3UInt32)
NONE(Int64, fmi3Int64)
NONE(UInt64, fmi3UInt64)
NONE(Boolean, fmi3Boolean)
NONE(String, fmi3String)

fmi3Status fmi3GetBinary(fmi3Instance i, const fmi3ValueReference *reference, size_t count, size_t *size, fmi3Binary *value,
                         size_t values) {
    (void)reference, (void)size, (void)value, (void)values;
    return none(i, __func__, count);
}

fmi3Status fmi3SetBinary(fmi3Instance i, const fmi3ValueReference *reference, size_t count, const size_t *size,
                         const fmi3Binary *value, size_t values) {
    (void)reference, (void)size, (void)value, (void)values;
    return none(i, __func__, count);
}

fmi3Status fmi3GetNumberOfVariableDependencies(fmi3Instance i, fmi3ValueReference reference, size_t *count) {
    (void)reference, (void)count;
    return ac_face_none(i, __func__, 1, "dependencies other than those of its description");
}

fmi3Status fmi3GetVariableDependencies(fmi3Instance i, fmi3ValueReference dependent, size_t *element,
                                       fmi3ValueReference *independent, size_t *element_of, fmi3DependencyKind *kind,
                                       size_t count) {
    (void)dependent, (void)element, (void)independent, (void)element_of, (void)kind, (void)count;
    return ac_face_none(i, __func__, 1, "dependencies other than those of its description");
}

fmi3Status fmi3GetFMUState(fmi3Instance i, fmi3FMUState *state) { return ac_face_store(i, __func__, state); }

fmi3Status fmi3SetFMUState(fmi3Instance i, fmi3FMUState state) { return ac_face_restore(i, __func__, state); }

fmi3Status fmi3FreeFMUState(fmi3Instance i, fmi3FMUState *state) { return ac_face_drop(i, state); }

fmi3Status fmi3SerializedFMUStateSize(fmi3Instance i, fmi3FMUState state, size_t *size) {
    return ac_face_stored_size(i, __func__, state, size);
}

fmi3Status fmi3SerializeFMUState(fmi3Instance i, fmi3FMUState state, fmi3Byte *bytes, size_t size) {
    return ac_face_serialize(i, __func__, state, bytes, size);
}

fmi3Status fmi3DeserializeFMUState(fmi3Instance i, const fmi3Byte *bytes, size_t size, fmi3FMUState *state) {
    return ac_face_deserialize(i, __func__, bytes, size, state);
}

fmi3Status fmi3GetDirectionalDerivative(fmi3Instance i, const fmi3ValueReference *unknown, size_t unknowns,
                                        const fmi3ValueReference *known, size_t knowns, const fmi3Float64 *seed, size_t seeds,
                                        fmi3Float64 *sensitivity, size_t sensitivities) {
    if (!scalars(i, __func__, knowns, seeds) || !scalars(i, __func__, unknowns, sensitivities)) return fmi3Error;
    return ac_face_slope(i, __func__, ac_forward, unknown, unknowns, known, knowns, seed, sensitivity);
}

fmi3Status fmi3GetAdjointDerivative(fmi3Instance i, const fmi3ValueReference *unknown, size_t unknowns,
                                    const fmi3ValueReference *known, size_t knowns, const fmi3Float64 *seed, size_t seeds,
                                    fmi3Float64 *sensitivity, size_t sensitivities) {
    if (!scalars(i, __func__, unknowns, seeds) || !scalars(i, __func__, knowns, sensitivities)) return fmi3Error;
    return ac_face_slope(i, __func__, ac_backward, unknown, unknowns, known, knowns, seed, sensitivity);
}

fmi3Status fmi3SetTime(fmi3Instance i, fmi3Float64 time) { return ac_face_set_time(i, __func__, time); }

fmi3Status fmi3SetContinuousStates(fmi3Instance i, const fmi3Float64 *x, size_t count) {
    return ac_face_set_states(i, __func__, x, count);
}

fmi3Status fmi3GetContinuousStateDerivatives(fmi3Instance i, fmi3Float64 *rate, size_t count) {
    return ac_face_read_states(i, __func__, ac_get_rates, rate, count);
}

fmi3Status fmi3GetEventIndicators(fmi3Instance i, fmi3Float64 *value, size_t count) {
    return ac_face_read_indicators(i, __func__, value, count);
}

fmi3Status fmi3GetContinuousStates(fmi3Instance i, fmi3Float64 *x, size_t count) {
    return ac_face_read_states(i, __func__, ac_get_states, x, count);
}

fmi3Status fmi3GetNominalsOfContinuousStates(fmi3Instance i, fmi3Float64 *nominal, size_t count) {
    return ac_face_read_states(i, __func__, ac_get_nominals, nominal, count);
}

fmi3Status fmi3GetNumberOfEventIndicators(fmi3Instance i, size_t *count) {
    if (!ac_face_in(i, __func__, AC_SOUND)) return fmi3Error;
    *count = (size_t)ac_indicators(((ac_face *)i)->engine);
    return fmi3OK;
}

fmi3Status fmi3GetNumberOfContinuousStates(fmi3Instance i, size_t *count) {
    if (!ac_face_in(i, __func__, AC_SOUND)) return fmi3Error;
    *count = (size_t)ac_states(((ac_face *)i)->engine);
    return fmi3OK;
}

fmi3Status fmi3GetOutputDerivatives(fmi3Instance i, const fmi3ValueReference *reference, size_t count, const fmi3Int32 *order,
                                    fmi3Float64 *value, size_t values) {
    (void)reference, (void)order, (void)value, (void)values;
    return ac_face_none(i, __func__, count, "derivatives of outputs");
}
