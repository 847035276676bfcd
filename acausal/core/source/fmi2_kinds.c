/* The face of FMI 2.0: what Model Exchange and Co-Simulation have of their own. */
#include "face.h"
#include "fmi.h"

fmi2Status fmi2EnterEventMode(fmi2Component c) { return ac_face_enter_event(c, __func__); }

fmi2Status fmi2NewDiscreteStates(fmi2Component c, fmi2EventInfo *info) {
    ac_happened found;
    const int answer = ac_face_update(c, __func__, &found);
    if (answer != fmi2OK) return answer;
    *info = (fmi2EventInfo){
        .terminateSimulation = found.ends, .valuesOfContinuousStatesChanged = found.states,
        .nextEventTimeDefined = found.planned, .nextEventTime = found.next,
    };
    return fmi2OK;
}

fmi2Status fmi2EnterContinuousTimeMode(fmi2Component c) { return ac_face_leave_event(c, __func__, 0); }

fmi2Status fmi2CompletedIntegratorStep(fmi2Component c, fmi2Boolean final, fmi2Boolean *event, fmi2Boolean *ends) {
    (void)final;
    *event = *ends = 0;
    return ac_face_completed(c, __func__);
}

fmi2Status fmi2SetTime(fmi2Component c, fmi2Real time) { return ac_face_set_time(c, __func__, time); }

fmi2Status fmi2SetContinuousStates(fmi2Component c, const fmi2Real *x, size_t count) {
    return ac_face_set_states(c, __func__, x, count);
}

fmi2Status fmi2GetDerivatives(fmi2Component c, fmi2Real *rate, size_t count) {
    return ac_face_read_states(c, __func__, ac_get_rates, rate, count);
}

fmi2Status fmi2GetEventIndicators(fmi2Component c, fmi2Real *value, size_t count) {
    return ac_face_read_indicators(c, __func__, value, count);
}

fmi2Status fmi2GetContinuousStates(fmi2Component c, fmi2Real *x, size_t count) {
    return ac_face_read_states(c, __func__, ac_get_states, x, count);
}

fmi2Status fmi2GetNominalsOfContinuousStates(fmi2Component c, fmi2Real *nominal, size_t count) {
    return ac_face_read_states(c, __func__, ac_get_nominals, nominal, count);
}

fmi2Status fmi2SetRealInputDerivatives(fmi2Component c, const fmi2ValueReference *reference, size_t count,
                                       const fmi2Integer *order, const fmi2Real *value) {
    return ac_face_set_slopes(c, __func__, reference, count, order, value);
}

fmi2Status fmi2GetRealOutputDerivatives(fmi2Component c, const fmi2ValueReference *reference, size_t count,
                                        const fmi2Integer *order, fmi2Real *value) {
    (void)reference, (void)order, (void)value;
    return ac_face_none(c, __func__, count, "derivatives of outputs");
}

/* A step that ends the simulation is discarded, and fmi2Terminated tells why. */
fmi2Status fmi2DoStep(fmi2Component c, fmi2Real from, fmi2Real size, fmi2Boolean final) {
    ac_stepped done;
    (void)final;
    const int answer = ac_face_step(c, __func__, from, size, &done);
    return answer == fmi2OK && done.ends ? fmi2Discard : (fmi2Status)answer;
}

fmi2Status fmi2CancelStep(fmi2Component c) { return ac_face_none(c, __func__, 1, "step that is still under way"); }

/* Whether something about steps can be told. */
static fmi2Status told(const ac_face *f, const char *call, int known) {
    if (!ac_face_in(f, call, AC_STEPPING | AC_TERMINATED | AC_LOST)) return fmi2Error;
    if (known && f->simulates) return fmi2OK;
    return ac_face_discard(f, call, "this is known of steps alone that are still under way");
}

fmi2Status fmi2GetStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Status *value) {
    (void)kind, (void)value;
    return told(c, __func__, 0);
}

fmi2Status fmi2GetRealStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Real *value) {
    const fmi2Status answer = told(c, __func__, kind == fmi2LastSuccessfulTime);
    if (answer == fmi2OK) *value = ac_time(((ac_face *)c)->engine);
    return answer;
}

fmi2Status fmi2GetIntegerStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Integer *value) {
    (void)kind, (void)value;
    return told(c, __func__, 0);
}

fmi2Status fmi2GetBooleanStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Boolean *value) {
    const fmi2Status answer = told(c, __func__, kind == fmi2Terminated);
    if (answer == fmi2OK) *value = ((ac_face *)c)->ends;
    return answer;
}

fmi2Status fmi2GetStringStatus(fmi2Component c, const fmi2StatusKind kind, fmi2String *value) {
    (void)kind, (void)value;
    return told(c, __func__, 0);
}
