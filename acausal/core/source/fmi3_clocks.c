/* The face of FMI 3.0: clocks, which no model has. */
#include "face.h"
#include "fmi.h"

static fmi3Status none(const ac_face *f, const char *call, size_t count) { return ac_face_none(f, call, count, "clocks"); }

fmi3Status fmi3GetClock(fmi3Instance i, const fmi3ValueReference *reference, size_t count, fmi3Clock *value) {
    (void)reference, (void)value;
    return none(i, __func__, count);
}

fmi3Status fmi3SetClock(fmi3Instance i, const fmi3ValueReference *reference, size_t count, const fmi3Clock *value) {
    (void)reference, (void)value;
    return none(i, __func__, count);
}

fmi3Status fmi3GetIntervalDecimal(fmi3Instance i, const fmi3ValueReference *reference, size_t count, fmi3Float64 *interval,
                                  fmi3IntervalQualifier *qualifier) {
    (void)reference, (void)interval, (void)qualifier;
    return none(i, __func__, count);
}

fmi3Status fmi3GetIntervalFraction(fmi3Instance i, const fmi3ValueReference *reference, size_t count, fmi3UInt64 *counter,
                                   fmi3UInt64 *resolution, fmi3IntervalQualifier *qualifier) {
    (void)reference, (void)counter, (void)resolution, (void)qualifier;
    return none(i, __func__, count);
}

fmi3Status fmi3GetShiftDecimal(fmi3Instance i, const fmi3ValueReference *reference, size_t count, fmi3Float64 *shift) {
    (void)reference, (void)shift;
    return none(i, __func__, count);
}

fmi3Status fmi3GetShiftFraction(fmi3Instance i, const fmi3ValueReference *reference, size_t count, fmi3UInt64 *counter,
                                fmi3UInt64 *resolution) {
    (void)reference, (void)counter, (void)resolution;
    return none(i, __func__, count);
}

fmi3Status fmi3SetIntervalDecimal(fmi3Instance i, const fmi3ValueReference *reference, size_t count,
                                  const fmi3Float64 *interval) {
    (void)reference, (void)interval;
    return none(i, __func__, count);
}

fmi3Status fmi3SetIntervalFraction(fmi3Instance i, const fmi3ValueReference *reference, size_t count,
                                   const fmi3UInt64 *counter, const fmi3UInt64 *resolution) {
    (void)reference, (void)counter, (void)resolution;
    return none(i, __func__, count);
}

fmi3Status fmi3SetShiftDecimal(fmi3Instance i, const fmi3ValueReference *reference, size_t count, const fmi3Float64 *shift) {
    (void)reference, (void)shift;
    return none(i, __func__, count);
}

fmi3Status fmi3SetShiftFraction(fmi3Instance i, const fmi3ValueReference *reference, size_t count, const fmi3UInt64 *counter,
                                const fmi3UInt64 *resolution) {
    (void)reference, (void)counter, (void)resolution;
    return none(i, __func__, count);
}
