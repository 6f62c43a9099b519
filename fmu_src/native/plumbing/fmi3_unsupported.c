/* Functions that FMI 3.0 asks a library to have, for what this FMU has not. */
#include "fmi3Functions.h"

#include "instance.h"

static fmi3Status without(gl_instance *instance, const char *what)
{
    (void)GL_CALL(instance, gl_refuse(instance, "This FMU has no %s.", what));
    return fmi3Error;
}

/* A function of the standard, with its parameters: an instance `c` first. */
#define WITHOUT(what, name, parameters)                                                           \
    fmi3Status name parameters                                                                    \
    {                                                                                             \
        return without(c, what);                                                                  \
    }

WITHOUT("clocks", fmi3GetClock,
        (fmi3Instance c, const fmi3ValueReference refs[], size_t n, fmi3Clock values[]))
WITHOUT("clocks", fmi3SetClock,
        (fmi3Instance c, const fmi3ValueReference refs[], size_t n, const fmi3Clock values[]))
WITHOUT("dependencies of variables", fmi3GetNumberOfVariableDependencies,
        (fmi3Instance c, fmi3ValueReference valueReference, size_t *nDependencies))
WITHOUT("dependencies of variables", fmi3GetVariableDependencies,
        (fmi3Instance c, fmi3ValueReference dependent, size_t elementIndicesOfDependent[],
         fmi3ValueReference independents[], size_t elementIndicesOfIndependents[],
         fmi3DependencyKind dependencyKinds[], size_t nDependencies))
WITHOUT("configuration mode", fmi3EnterConfigurationMode, (fmi3Instance c))
WITHOUT("configuration mode", fmi3ExitConfigurationMode, (fmi3Instance c))
WITHOUT("clocks", fmi3GetIntervalDecimal,
        (fmi3Instance c, const fmi3ValueReference refs[], size_t n, fmi3Float64 intervals[],
         fmi3IntervalQualifier qualifiers[]))
WITHOUT("clocks", fmi3GetIntervalFraction,
        (fmi3Instance c, const fmi3ValueReference refs[], size_t n, fmi3UInt64 counters[],
         fmi3UInt64 resolutions[], fmi3IntervalQualifier qualifiers[]))
WITHOUT("clocks", fmi3GetShiftDecimal,
        (fmi3Instance c, const fmi3ValueReference refs[], size_t n, fmi3Float64 shifts[]))
WITHOUT("clocks", fmi3GetShiftFraction,
        (fmi3Instance c, const fmi3ValueReference refs[], size_t n, fmi3UInt64 counters[],
         fmi3UInt64 resolutions[]))
WITHOUT("clocks", fmi3SetIntervalDecimal,
        (fmi3Instance c, const fmi3ValueReference refs[], size_t n, const fmi3Float64 intervals[]))
WITHOUT("clocks", fmi3SetIntervalFraction,
        (fmi3Instance c, const fmi3ValueReference refs[], size_t n, const fmi3UInt64 counters[],
         const fmi3UInt64 resolutions[]))
WITHOUT("clocks", fmi3SetShiftDecimal,
        (fmi3Instance c, const fmi3ValueReference refs[], size_t n, const fmi3Float64 shifts[]))
WITHOUT("clocks", fmi3SetShiftFraction,
        (fmi3Instance c, const fmi3ValueReference refs[], size_t n, const fmi3UInt64 counters[],
         const fmi3UInt64 resolutions[]))
WITHOUT("event mode", fmi3EvaluateDiscreteStates, (fmi3Instance c))
WITHOUT("event mode", fmi3EnterStepMode, (fmi3Instance c))
WITHOUT("derivatives of outputs", fmi3GetOutputDerivatives,
        (fmi3Instance c, const fmi3ValueReference refs[], size_t n, const fmi3Int32 orders[],
         fmi3Float64 values[], size_t nValues))
WITHOUT("model partitions", fmi3ActivateModelPartition,
        (fmi3Instance c, fmi3ValueReference clockReference, fmi3Float64 activationTime))
