/* FMI 2.0: co-simulation and model exchange. */
#include "fmi2Functions.h"

#include "instance.h"

#include <math.h>
#include <string.h>

#define FMI(name) fmi2##name
#define STATE(before, after) fmi2##before##FMUstate##after
#include "both_versions.h"

/* The logger takes a text like that of printf, with #r1# for a variable. The message is sent as that
   text and not as an argument of "%s", because hosts exist that read no arguments. */
static void log_text(fmi2CallbackLogger logger, void *host, const char *name, gl_status status,
                     const char *category, const char *text)
{
    char message[2 * GL_LONGEST_MESSAGE];
    size_t used = 0;
    for (; *text && used + 2 < sizeof message; text++) {
        if (*text == '%' || *text == '#') {
            message[used++] = *text;
        }
        message[used++] = *text;
    }
    message[used] = '\0';
    logger(host, name, answer(status), category, message);
}

static void tell(gl_instance *instance, gl_status status, const char *category, const char *text)
{
    log_text((fmi2CallbackLogger)instance->logger, instance->host, instance->name, status, category,
             text);
}

const char *fmi2GetTypesPlatform(void)
{
    return fmi2TypesPlatform;
}

const char *fmi2GetVersion(void)
{
    return fmi2Version;
}

fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String guid, fmi2String resources,
                              const fmi2CallbackFunctions *calls, fmi2Boolean visible,
                              fmi2Boolean logging)
{
    char why[GL_LONGEST_MESSAGE] = "";
    gl_model *model = NULL;
    if (!calls || !calls->logger) {
        gl_say_no_instance(name, "The host must give a logger.");
        return NULL;
    }
    if (type != fmi2CoSimulation && !GL_EXCHANGE) {
        strcpy(why, "This FMU is for co-simulation only.");
    } else {
        model = gl_load(resources, guid, "GUID", why);
    }
    if (!model) {
        gl_say_no_instance(name, why);
        log_text(calls->logger, calls->componentEnvironment, name ? name : GL_MODEL_NAME, GL_ERROR,
                 gl_log_names[GL_LOG_ERROR], why);
        return NULL;
    }
    return gl_make(model, name, tell, calls->componentEnvironment, (uintptr_t)calls->logger,
                   logging, type == fmi2ModelExchange);
}

fmi2Status fmi2SetupExperiment(fmi2Component c, fmi2Boolean tolerance_defined, fmi2Real tolerance,
                               fmi2Real start, fmi2Boolean stop_defined, fmi2Real stop)
{
    /* the tolerance is not used: the step follows from the frequencies of the model */
    return answer(GL_CALL(c, gl_set_times(c, start, stop_defined ? stop : INFINITY)));
}

fmi2Status fmi2EnterInitializationMode(fmi2Component c)
{
    return answer(GL_CALL(c, gl_enter_initialisation(c)));
}

/* Points at the values that may be read, if any. */
static fmi2Status read_values(gl_instance *instance, gl_kind kind, const unsigned *refs, size_t n,
                              const void *values, const double **from)
{
    *from = NULL;
    if (!gl_is_instance(instance)) {
        return fmi2Error;
    }
    gl_status status = GL_CALL(instance, gl_check_read(instance, kind, n, refs, values));
    if (status == GL_OK) {
        *from = instance->now.values;
    }
    return answer(status);
}

/* Reads and sets the values of one FMI type, `kind` in our table. */
#define ACCESS(name, kind, read, written)                                                         \
    fmi2Status fmi2Get##name(fmi2Component c, const fmi2ValueReference refs[], size_t n,          \
                             fmi2##name values[])                                                 \
    {                                                                                             \
        const double *from;                                                                       \
        fmi2Status status = read_values(c, kind, refs, n, values, &from);                         \
        for (size_t i = 0; from && i < n; i++) {                                                  \
            double value = from[refs[i]];                                                         \
            values[i] = read;                                                                     \
        }                                                                                         \
        return status;                                                                            \
    }                                                                                             \
    fmi2Status fmi2Set##name(fmi2Component c, const fmi2ValueReference refs[], size_t n,          \
                             const fmi2##name values[])                                           \
    {                                                                                             \
        gl_status status = GL_CALL(c, gl_check_set(c, kind, n, refs, values));                    \
        gl_status worst = status;                                                                 \
        for (size_t i = 0; status == GL_OK && i < n; i++) {                                       \
            gl_status one = GL_CALL(c, gl_set(c, refs[i], written));                              \
            worst = one > worst ? one : worst;                                                    \
        }                                                                                         \
        return answer(worst);                                                                     \
    }

ACCESS(Real, GL_REAL, value, values[i])
ACCESS(Integer, GL_INTEGER, (fmi2Integer)gl_whole(value, INT32_MIN, INT32_MAX), (double)values[i])
ACCESS(Boolean, GL_BOOLEAN, value != 0.0, values[i] ? 1.0 : 0.0)

static fmi2Status no_strings(gl_instance *instance, size_t n)
{
    return answer(GL_CALL(
        instance, n ? gl_refuse(instance, "No variable of this FMU is a String.") : GL_OK));
}

fmi2Status fmi2GetString(fmi2Component c, const fmi2ValueReference vr[], size_t n,
                         fmi2String value[])
{
    return no_strings(c, n);
}

fmi2Status fmi2SetString(fmi2Component c, const fmi2ValueReference vr[], size_t n,
                         const fmi2String value[])
{
    return no_strings(c, n);
}

fmi2Status fmi2DeSerializeFMUstate(fmi2Component c, const fmi2Byte bytes[], size_t size,
                                   fmi2FMUstate *state)
{
    return answer(GL_CALL(c, gl_deserialise(c, (const unsigned char *)bytes, size, state)));
}

fmi2Status fmi2DoStep(fmi2Component c, fmi2Real time, fmi2Real step, fmi2Boolean no_way_back)
{
    return answer(GL_CALL(c, gl_step(c, time, step)));
}

static fmi2Status unsupported(gl_instance *instance, const char *what)
{
    return answer(GL_CALL(instance, gl_refuse(instance, "This FMU has no %s.", what)));
}

fmi2Status fmi2CancelStep(fmi2Component c)
{
    return unsupported(c, "step that runs in the background");
}

fmi2Status fmi2SetRealInputDerivatives(fmi2Component c, const fmi2ValueReference vr[], size_t n,
                                       const fmi2Integer order[], const fmi2Real value[])
{
    return unsupported(c, "derivatives of inputs");
}

fmi2Status fmi2GetRealOutputDerivatives(fmi2Component c, const fmi2ValueReference vr[], size_t n,
                                        const fmi2Integer order[], fmi2Real value[])
{
    return unsupported(c, "derivatives of outputs");
}

/* Discard says that the FMU has not the information that is asked for (FMI 2.0.4, 2.1.3). */
static fmi2Status no_information(gl_instance *instance, const char *what)
{
    if (!gl_enter(instance)) {
        return fmi2Error;
    }
    gl_say(instance, GL_DISCARD, "This FMU has no %s.", what);
    return answer(gl_leave(instance, GL_DISCARD));
}

fmi2Status fmi2GetStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Status *value)
{
    return no_information(c, "step that runs in the background");
}

fmi2Status fmi2GetRealStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Real *value)
{
    const gl_instance *instance = c;
    if (!gl_is_instance(c) || !value || kind != fmi2LastSuccessfulTime) {
        return no_information(c, "status of this kind that is a Real");
    }
    *value = instance->now.time;
    return fmi2OK;
}

fmi2Status fmi2GetIntegerStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Integer *value)
{
    return no_information(c, "status that is an Integer");
}

fmi2Status fmi2GetBooleanStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Boolean *value)
{
    if (!gl_is_instance(c) || !value || kind != fmi2Terminated) {
        return no_information(c, "status of this kind that is a Boolean");
    }
    /* a host that would repeat a refused step for ever ends the run here */
    const gl_instance *instance = c;
    *value = instance->step_refused ? fmi2True : fmi2False;
    return fmi2OK;
}

fmi2Status fmi2GetStringStatus(fmi2Component c, const fmi2StatusKind kind, fmi2String *value)
{
    return no_information(c, "status that is a String");
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

fmi2Status fmi2GetDerivatives(fmi2Component c, fmi2Real x[], size_t n)
{
    return answer(GL_CALL(c, gl_get_rates(c, x, n)));
}

fmi2Status fmi2GetDirectionalDerivative(fmi2Component c, const fmi2ValueReference unknown[],
                                        size_t n_unknown, const fmi2ValueReference known[],
                                        size_t n_known, const fmi2Real d_known[],
                                        fmi2Real d_unknown[])
{
    return answer(GL_CALL(
        c, gl_differentiate(c, unknown, n_unknown, known, n_known, d_known, d_unknown)));
}
