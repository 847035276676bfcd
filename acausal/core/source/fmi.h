/* Functions of the Functional Mock-up Interface 2.0 and 3.0: all of them, as importers look for every one. */
#ifndef ACAUSAL_FMI_H
#define ACAUSAL_FMI_H

#include "core.h"
#include "fmi_types.h"

/* Version 2.0: both kinds. */
AC_PUBLIC const char *fmi2GetTypesPlatform(void);
AC_PUBLIC const char *fmi2GetVersion(void);
AC_PUBLIC fmi2Status fmi2SetDebugLogging(fmi2Component c, fmi2Boolean on, size_t count, const fmi2String *category);
AC_PUBLIC fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String guid, fmi2String resources,
                                        const fmi2CallbackFunctions *functions, fmi2Boolean visible, fmi2Boolean logging);
AC_PUBLIC void fmi2FreeInstance(fmi2Component c);
AC_PUBLIC fmi2Status fmi2SetupExperiment(fmi2Component c, fmi2Boolean has_tolerance, fmi2Real tolerance, fmi2Real start,
                                         fmi2Boolean has_stop, fmi2Real stop);
AC_PUBLIC fmi2Status fmi2EnterInitializationMode(fmi2Component c);
AC_PUBLIC fmi2Status fmi2ExitInitializationMode(fmi2Component c);
AC_PUBLIC fmi2Status fmi2Terminate(fmi2Component c);
AC_PUBLIC fmi2Status fmi2Reset(fmi2Component c);

/* Getter and setter of a type. */
#define AC_FMI2_VALUES(name, type) \
    AC_PUBLIC fmi2Status fmi2Get##name(fmi2Component c, const fmi2ValueReference *reference, size_t count, type *value); \
    AC_PUBLIC fmi2Status fmi2Set##name(fmi2Component c, const fmi2ValueReference *reference, size_t count, const type *value);
AC_FMI2_VALUES(Real, fmi2Real)
AC_FMI2_VALUES(Integer, fmi2Integer)
AC_FMI2_VALUES(Boolean, fmi2Boolean)
AC_FMI2_VALUES(String, fmi2String)

AC_PUBLIC fmi2Status fmi2GetFMUstate(fmi2Component c, fmi2FMUstate *state);
AC_PUBLIC fmi2Status fmi2SetFMUstate(fmi2Component c, fmi2FMUstate state);
AC_PUBLIC fmi2Status fmi2FreeFMUstate(fmi2Component c, fmi2FMUstate *state);
AC_PUBLIC fmi2Status fmi2SerializedFMUstateSize(fmi2Component c, fmi2FMUstate state, size_t *size);
AC_PUBLIC fmi2Status fmi2SerializeFMUstate(fmi2Component c, fmi2FMUstate state, fmi2Byte *bytes, size_t size);
AC_PUBLIC fmi2Status fmi2DeSerializeFMUstate(fmi2Component c, const fmi2Byte *bytes, size_t size, fmi2FMUstate *state);
AC_PUBLIC fmi2Status fmi2GetDirectionalDerivative(fmi2Component c, const fmi2ValueReference *unknown, size_t unknowns,
                                                  const fmi2ValueReference *known, size_t knowns, const fmi2Real *seed,
                                                  fmi2Real *sensitivity);

/* Version 2.0: Model Exchange. */
AC_PUBLIC fmi2Status fmi2EnterEventMode(fmi2Component c);
AC_PUBLIC fmi2Status fmi2NewDiscreteStates(fmi2Component c, fmi2EventInfo *info);
AC_PUBLIC fmi2Status fmi2EnterContinuousTimeMode(fmi2Component c);
AC_PUBLIC fmi2Status fmi2CompletedIntegratorStep(fmi2Component c, fmi2Boolean final, fmi2Boolean *event, fmi2Boolean *ends);
AC_PUBLIC fmi2Status fmi2SetTime(fmi2Component c, fmi2Real time);
AC_PUBLIC fmi2Status fmi2SetContinuousStates(fmi2Component c, const fmi2Real *x, size_t count);
AC_PUBLIC fmi2Status fmi2GetDerivatives(fmi2Component c, fmi2Real *rate, size_t count);
AC_PUBLIC fmi2Status fmi2GetEventIndicators(fmi2Component c, fmi2Real *value, size_t count);
AC_PUBLIC fmi2Status fmi2GetContinuousStates(fmi2Component c, fmi2Real *x, size_t count);
AC_PUBLIC fmi2Status fmi2GetNominalsOfContinuousStates(fmi2Component c, fmi2Real *nominal, size_t count);

/* Version 2.0: Co-Simulation. */
AC_PUBLIC fmi2Status fmi2SetRealInputDerivatives(fmi2Component c, const fmi2ValueReference *reference, size_t count,
                                                 const fmi2Integer *order, const fmi2Real *value);
AC_PUBLIC fmi2Status fmi2GetRealOutputDerivatives(fmi2Component c, const fmi2ValueReference *reference, size_t count,
                                                  const fmi2Integer *order, fmi2Real *value);
AC_PUBLIC fmi2Status fmi2DoStep(fmi2Component c, fmi2Real from, fmi2Real size, fmi2Boolean final);
AC_PUBLIC fmi2Status fmi2CancelStep(fmi2Component c);
AC_PUBLIC fmi2Status fmi2GetStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Status *value);
AC_PUBLIC fmi2Status fmi2GetRealStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Real *value);
AC_PUBLIC fmi2Status fmi2GetIntegerStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Integer *value);
AC_PUBLIC fmi2Status fmi2GetBooleanStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Boolean *value);
AC_PUBLIC fmi2Status fmi2GetStringStatus(fmi2Component c, const fmi2StatusKind kind, fmi2String *value);

/* Version 3.0: all kinds. */
AC_PUBLIC const char *fmi3GetVersion(void);
AC_PUBLIC fmi3Status fmi3SetDebugLogging(fmi3Instance i, fmi3Boolean on, size_t count, const fmi3String *category);
AC_PUBLIC fmi3Instance fmi3InstantiateModelExchange(fmi3String name, fmi3String token, fmi3String resources, fmi3Boolean visible,
                                                    fmi3Boolean logging, fmi3InstanceEnvironment environment,
                                                    fmi3LogMessageCallback log);
AC_PUBLIC fmi3Instance fmi3InstantiateCoSimulation(fmi3String name, fmi3String token, fmi3String resources, fmi3Boolean visible,
                                                   fmi3Boolean logging, fmi3Boolean events, fmi3Boolean early,
                                                   const fmi3ValueReference *intermediate, size_t intermediates,
                                                   fmi3InstanceEnvironment environment, fmi3LogMessageCallback log,
                                                   fmi3IntermediateUpdateCallback update);
AC_PUBLIC fmi3Instance fmi3InstantiateScheduledExecution(fmi3String name, fmi3String token, fmi3String resources,
                                                         fmi3Boolean visible, fmi3Boolean logging,
                                                         fmi3InstanceEnvironment environment, fmi3LogMessageCallback log,
                                                         fmi3ClockUpdateCallback update, fmi3LockPreemptionCallback lock,
                                                         fmi3UnlockPreemptionCallback unlock);
AC_PUBLIC void fmi3FreeInstance(fmi3Instance i);
AC_PUBLIC fmi3Status fmi3EnterInitializationMode(fmi3Instance i, fmi3Boolean has_tolerance, fmi3Float64 tolerance,
                                                 fmi3Float64 start, fmi3Boolean has_stop, fmi3Float64 stop);
AC_PUBLIC fmi3Status fmi3ExitInitializationMode(fmi3Instance i);
AC_PUBLIC fmi3Status fmi3EnterEventMode(fmi3Instance i);
AC_PUBLIC fmi3Status fmi3Terminate(fmi3Instance i);
AC_PUBLIC fmi3Status fmi3Reset(fmi3Instance i);

/* Getter and setter of a type. */
#define AC_FMI3_VALUES(name, type) \
    AC_PUBLIC fmi3Status fmi3Get##name(fmi3Instance i, const fmi3ValueReference *reference, size_t count, type *value, \
                                       size_t values); \
    AC_PUBLIC fmi3Status fmi3Set##name(fmi3Instance i, const fmi3ValueReference *reference, size_t count, const type *value, \
                                       size_t values);
AC_FMI3_VALUES(Float32, fmi3Float32)
AC_FMI3_VALUES(Float64, fmi3Float64)
AC_FMI3_VALUES(Int8, fmi3Int8)
AC_FMI3_VALUES(UInt8, fmi3UInt8)
AC_FMI3_VALUES(Int16, fmi3Int16)
AC_FMI3_VALUES(UInt16, fmi3UInt16)
AC_FMI3_VALUES(Int32, fmi3Int32)
AC_FMI3_VALUES(UInt32, fmi3UInt32)
AC_FMI3_VALUES(Int64, fmi3Int64)
AC_FMI3_VALUES(UInt64, fmi3UInt64)
AC_FMI3_VALUES(Boolean, fmi3Boolean)
AC_FMI3_VALUES(String, fmi3String)
AC_PUBLIC fmi3Status fmi3GetBinary(fmi3Instance i, const fmi3ValueReference *reference, size_t count, size_t *size,
                                   fmi3Binary *value, size_t values);
AC_PUBLIC fmi3Status fmi3SetBinary(fmi3Instance i, const fmi3ValueReference *reference, size_t count, const size_t *size,
                                   const fmi3Binary *value, size_t values);
AC_PUBLIC fmi3Status fmi3GetClock(fmi3Instance i, const fmi3ValueReference *reference, size_t count, fmi3Clock *value);
AC_PUBLIC fmi3Status fmi3SetClock(fmi3Instance i, const fmi3ValueReference *reference, size_t count, const fmi3Clock *value);

AC_PUBLIC fmi3Status fmi3GetNumberOfVariableDependencies(fmi3Instance i, fmi3ValueReference reference, size_t *count);
AC_PUBLIC fmi3Status fmi3GetVariableDependencies(fmi3Instance i, fmi3ValueReference dependent, size_t *element,
                                                 fmi3ValueReference *independent, size_t *element_of,
                                                 fmi3DependencyKind *kind, size_t count);
AC_PUBLIC fmi3Status fmi3GetFMUState(fmi3Instance i, fmi3FMUState *state);
AC_PUBLIC fmi3Status fmi3SetFMUState(fmi3Instance i, fmi3FMUState state);
AC_PUBLIC fmi3Status fmi3FreeFMUState(fmi3Instance i, fmi3FMUState *state);
AC_PUBLIC fmi3Status fmi3SerializedFMUStateSize(fmi3Instance i, fmi3FMUState state, size_t *size);
AC_PUBLIC fmi3Status fmi3SerializeFMUState(fmi3Instance i, fmi3FMUState state, fmi3Byte *bytes, size_t size);
AC_PUBLIC fmi3Status fmi3DeserializeFMUState(fmi3Instance i, const fmi3Byte *bytes, size_t size, fmi3FMUState *state);
AC_PUBLIC fmi3Status fmi3GetDirectionalDerivative(fmi3Instance i, const fmi3ValueReference *unknown, size_t unknowns,
                                                  const fmi3ValueReference *known, size_t knowns, const fmi3Float64 *seed,
                                                  size_t seeds, fmi3Float64 *sensitivity, size_t sensitivities);
AC_PUBLIC fmi3Status fmi3GetAdjointDerivative(fmi3Instance i, const fmi3ValueReference *unknown, size_t unknowns,
                                              const fmi3ValueReference *known, size_t knowns, const fmi3Float64 *seed,
                                              size_t seeds, fmi3Float64 *sensitivity, size_t sensitivities);
AC_PUBLIC fmi3Status fmi3EnterConfigurationMode(fmi3Instance i);
AC_PUBLIC fmi3Status fmi3ExitConfigurationMode(fmi3Instance i);
AC_PUBLIC fmi3Status fmi3EvaluateDiscreteStates(fmi3Instance i);
AC_PUBLIC fmi3Status fmi3UpdateDiscreteStates(fmi3Instance i, fmi3Boolean *again, fmi3Boolean *ends, fmi3Boolean *nominals,
                                              fmi3Boolean *states, fmi3Boolean *planned, fmi3Float64 *next);

/* Version 3.0: clocks. */
AC_PUBLIC fmi3Status fmi3GetIntervalDecimal(fmi3Instance i, const fmi3ValueReference *reference, size_t count,
                                            fmi3Float64 *interval, fmi3IntervalQualifier *qualifier);
AC_PUBLIC fmi3Status fmi3GetIntervalFraction(fmi3Instance i, const fmi3ValueReference *reference, size_t count,
                                             fmi3UInt64 *counter, fmi3UInt64 *resolution, fmi3IntervalQualifier *qualifier);
AC_PUBLIC fmi3Status fmi3GetShiftDecimal(fmi3Instance i, const fmi3ValueReference *reference, size_t count, fmi3Float64 *shift);
AC_PUBLIC fmi3Status fmi3GetShiftFraction(fmi3Instance i, const fmi3ValueReference *reference, size_t count,
                                          fmi3UInt64 *counter, fmi3UInt64 *resolution);
AC_PUBLIC fmi3Status fmi3SetIntervalDecimal(fmi3Instance i, const fmi3ValueReference *reference, size_t count,
                                            const fmi3Float64 *interval);
AC_PUBLIC fmi3Status fmi3SetIntervalFraction(fmi3Instance i, const fmi3ValueReference *reference, size_t count,
                                             const fmi3UInt64 *counter, const fmi3UInt64 *resolution);
AC_PUBLIC fmi3Status fmi3SetShiftDecimal(fmi3Instance i, const fmi3ValueReference *reference, size_t count,
                                         const fmi3Float64 *shift);
AC_PUBLIC fmi3Status fmi3SetShiftFraction(fmi3Instance i, const fmi3ValueReference *reference, size_t count,
                                          const fmi3UInt64 *counter, const fmi3UInt64 *resolution);

/* Version 3.0: Model Exchange. */
AC_PUBLIC fmi3Status fmi3EnterContinuousTimeMode(fmi3Instance i);
AC_PUBLIC fmi3Status fmi3CompletedIntegratorStep(fmi3Instance i, fmi3Boolean final, fmi3Boolean *event, fmi3Boolean *ends);
AC_PUBLIC fmi3Status fmi3SetTime(fmi3Instance i, fmi3Float64 time);
AC_PUBLIC fmi3Status fmi3SetContinuousStates(fmi3Instance i, const fmi3Float64 *x, size_t count);
AC_PUBLIC fmi3Status fmi3GetContinuousStateDerivatives(fmi3Instance i, fmi3Float64 *rate, size_t count);
AC_PUBLIC fmi3Status fmi3GetEventIndicators(fmi3Instance i, fmi3Float64 *value, size_t count);
AC_PUBLIC fmi3Status fmi3GetContinuousStates(fmi3Instance i, fmi3Float64 *x, size_t count);
AC_PUBLIC fmi3Status fmi3GetNominalsOfContinuousStates(fmi3Instance i, fmi3Float64 *nominal, size_t count);
AC_PUBLIC fmi3Status fmi3GetNumberOfEventIndicators(fmi3Instance i, size_t *count);
AC_PUBLIC fmi3Status fmi3GetNumberOfContinuousStates(fmi3Instance i, size_t *count);

/* Version 3.0: Co-Simulation and Scheduled Execution. */
AC_PUBLIC fmi3Status fmi3EnterStepMode(fmi3Instance i);
AC_PUBLIC fmi3Status fmi3GetOutputDerivatives(fmi3Instance i, const fmi3ValueReference *reference, size_t count,
                                              const fmi3Int32 *order, fmi3Float64 *value, size_t values);
AC_PUBLIC fmi3Status fmi3DoStep(fmi3Instance i, fmi3Float64 from, fmi3Float64 size, fmi3Boolean final, fmi3Boolean *event,
                                fmi3Boolean *ends, fmi3Boolean *early, fmi3Float64 *reached);
AC_PUBLIC fmi3Status fmi3ActivateModelPartition(fmi3Instance i, fmi3ValueReference clock, fmi3Float64 time);

#endif
