/* FMI 2.0 for model exchange. */
#include "fmi2Functions.h"

#include "instance.h"

/* In the order of the standard: OK, warning, discard, error. */
static fmi2Status answer(gl_status status)
{
    return (fmi2Status)status;
}

static fmi2Status no_pointer(gl_instance *instance)
{
    return answer(GL_CALL(instance, gl_refuse(instance, "A pointer of the call is null.")));
}

fmi2Status fmi2EnterEventMode(fmi2Component c)
{
    return answer(GL_CALL(c, gl_enter_events(c)));
}

fmi2Status fmi2NewDiscreteStates(fmi2Component c, fmi2EventInfo *info)
{
    int changed = 0;
    if (!gl_is_instance(c)) {
        return fmi2Error;
    }
    if (!info) {
        return no_pointer(c);
    }
    gl_status status = GL_CALL(c, gl_update_discrete(c, &changed));
    if (status == GL_OK) {
        info->newDiscreteStatesNeeded = fmi2False;
        info->terminateSimulation = fmi2False;
        info->nominalsOfContinuousStatesChanged = fmi2False;
        info->valuesOfContinuousStatesChanged = changed ? fmi2True : fmi2False;
        info->nextEventTimeDefined = fmi2False;
        info->nextEventTime = 0.0;
    }
    return answer(status);
}

fmi2Status fmi2EnterContinuousTimeMode(fmi2Component c)
{
    return answer(GL_CALL(c, gl_enter_continuous_time(c)));
}

fmi2Status fmi2CompletedIntegratorStep(fmi2Component c, fmi2Boolean no_way_back,
                                       fmi2Boolean *enter_event_mode, fmi2Boolean *terminate)
{
    int due = 0;
    (void)no_way_back;
    if (!gl_is_instance(c)) {
        return fmi2Error;
    }
    if (!enter_event_mode || !terminate) {
        return no_pointer(c);
    }
    gl_status status = GL_CALL(c, gl_complete_step(c, &due));
    if (status == GL_OK) {
        *enter_event_mode = due ? fmi2True : fmi2False;
        *terminate = fmi2False;
    }
    return answer(status);
}

fmi2Status fmi2SetTime(fmi2Component c, fmi2Real time)
{
    return answer(GL_CALL(c, gl_set_time(c, time)));
}

fmi2Status fmi2SetContinuousStates(fmi2Component c, const fmi2Real x[], size_t n)
{
    return answer(GL_CALL(c, gl_set_states(c, x, n)));
}

fmi2Status fmi2GetContinuousStates(fmi2Component c, fmi2Real x[], size_t n)
{
    return answer(GL_CALL(c, gl_get_states(c, x, n)));
}

fmi2Status fmi2GetNominalsOfContinuousStates(fmi2Component c, fmi2Real x[], size_t n)
{
    return answer(GL_CALL(c, gl_get_nominals(c, x, n)));
}

fmi2Status fmi2GetDerivatives(fmi2Component c, fmi2Real x[], size_t n)
{
    return answer(GL_CALL(c, gl_get_rates(c, x, n)));
}

fmi2Status fmi2GetEventIndicators(fmi2Component c, fmi2Real z[], size_t n)
{
    return answer(GL_CALL(c, gl_get_indicators(c, z, n)));
}

fmi2Status fmi2GetDirectionalDerivative(fmi2Component c, const fmi2ValueReference unknown[],
                                        size_t n_unknown, const fmi2ValueReference known[],
                                        size_t n_known, const fmi2Real d_known[],
                                        fmi2Real d_unknown[])
{
    return answer(GL_CALL(
        c, gl_differentiate(c, unknown, n_unknown, known, n_known, d_known, d_unknown)));
}
