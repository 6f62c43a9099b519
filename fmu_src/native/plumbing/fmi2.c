/* FMI 2.0: what both interfaces share, and co-simulation. */
#include "fmi2Functions.h"

#include "instance.h"

#include <math.h>
#include <string.h>

static const fmi2Status statuses[] = {fmi2OK, fmi2Warning, fmi2Discard, fmi2Error};

static fmi2Status answer(gl_status status)
{
    return statuses[status];
}

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

fmi2Status fmi2SetDebugLogging(fmi2Component c, fmi2Boolean on, size_t n, const fmi2String names[])
{
    return answer(GL_CALL(c, gl_choose_logs(c, on, n, names)));
}

fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String guid, fmi2String resources,
                              const fmi2CallbackFunctions *calls, fmi2Boolean visible,
                              fmi2Boolean logging)
{
    char why[GL_LONGEST_MESSAGE] = "";
    gl_model *model = NULL;
    (void)visible;
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

void fmi2FreeInstance(fmi2Component c)
{
    gl_free(c);
}

fmi2Status fmi2SetupExperiment(fmi2Component c, fmi2Boolean tolerance_defined, fmi2Real tolerance,
                               fmi2Real start, fmi2Boolean stop_defined, fmi2Real stop)
{
    (void)tolerance_defined;
    (void)tolerance; /* the step follows from the frequencies of the model */
    return answer(GL_CALL(c, gl_set_times(c, start, stop_defined ? stop : INFINITY)));
}

fmi2Status fmi2EnterInitializationMode(fmi2Component c)
{
    return answer(GL_CALL(c, gl_enter_initialisation(c)));
}

fmi2Status fmi2ExitInitializationMode(fmi2Component c)
{
    return answer(GL_CALL(c, gl_exit_initialisation(c)));
}

fmi2Status fmi2Terminate(fmi2Component c)
{
    return answer(GL_CALL(c, gl_terminate(c)));
}

fmi2Status fmi2Reset(fmi2Component c)
{
    return answer(GL_CALL(c, gl_reset(c)));
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

fmi2Status fmi2GetReal(fmi2Component c, const fmi2ValueReference vr[], size_t n, fmi2Real value[])
{
    const double *from;
    fmi2Status status = read_values(c, GL_REAL, vr, n, value, &from);
    for (size_t i = 0; from && i < n; i++) {
        value[i] = from[vr[i]];
    }
    return status;
}

fmi2Status fmi2GetInteger(fmi2Component c, const fmi2ValueReference vr[], size_t n,
                          fmi2Integer value[])
{
    const double *from;
    fmi2Status status = read_values(c, GL_INTEGER, vr, n, value, &from);
    for (size_t i = 0; from && i < n; i++) {
        value[i] = (fmi2Integer)gl_whole(from[vr[i]], INT32_MIN, INT32_MAX);
    }
    return status;
}

fmi2Status fmi2GetBoolean(fmi2Component c, const fmi2ValueReference vr[], size_t n,
                          fmi2Boolean value[])
{
    const double *from;
    fmi2Status status = read_values(c, GL_BOOLEAN, vr, n, value, &from);
    for (size_t i = 0; from && i < n; i++) {
        value[i] = from[vr[i]] != 0.0 ? fmi2True : fmi2False;
    }
    return status;
}

static fmi2Status no_strings(gl_instance *instance, size_t n)
{
    return answer(GL_CALL(
        instance, n ? gl_refuse(instance, "No variable of this FMU is a String.") : GL_OK));
}

fmi2Status fmi2GetString(fmi2Component c, const fmi2ValueReference vr[], size_t n,
                         fmi2String value[])
{
    (void)vr;
    (void)value;
    return no_strings(c, n);
}

fmi2Status fmi2SetString(fmi2Component c, const fmi2ValueReference vr[], size_t n,
                         const fmi2String value[])
{
    (void)vr;
    (void)value;
    return no_strings(c, n);
}

static fmi2Status worse(fmi2Status status, gl_status other)
{
    return answer(other) > status ? answer(other) : status;
}

fmi2Status fmi2SetReal(fmi2Component c, const fmi2ValueReference vr[], size_t n,
                       const fmi2Real value[])
{
    if (!gl_is_instance(c)) {
        return fmi2Error;
    }
    fmi2Status status = answer(GL_CALL(c, gl_check_set(c, GL_REAL, n, vr, value)));
    if (status != fmi2OK) {
        return status;
    }
    for (size_t i = 0; i < n; i++) {
        status = worse(status, GL_CALL(c, gl_set(c, vr[i], value[i])));
    }
    return status;
}

fmi2Status fmi2SetInteger(fmi2Component c, const fmi2ValueReference vr[], size_t n,
                          const fmi2Integer value[])
{
    if (GL_CALL(c, gl_check_set(c, GL_INTEGER, n, vr, value)) != GL_OK) {
        return fmi2Error;
    }
    fmi2Status status = fmi2OK;
    for (size_t i = 0; i < n; i++) {
        status = worse(status, GL_CALL(c, gl_set(c, vr[i], (double)value[i])));
    }
    return status;
}

fmi2Status fmi2SetBoolean(fmi2Component c, const fmi2ValueReference vr[], size_t n,
                          const fmi2Boolean value[])
{
    if (GL_CALL(c, gl_check_set(c, GL_BOOLEAN, n, vr, value)) != GL_OK) {
        return fmi2Error;
    }
    fmi2Status status = fmi2OK;
    for (size_t i = 0; i < n; i++) {
        status = worse(status, GL_CALL(c, gl_set(c, vr[i], value[i] ? 1.0 : 0.0)));
    }
    return status;
}

fmi2Status fmi2GetFMUstate(fmi2Component c, fmi2FMUstate *state)
{
    return answer(GL_CALL(c, gl_save(c, state)));
}

fmi2Status fmi2SetFMUstate(fmi2Component c, fmi2FMUstate state)
{
    return answer(GL_CALL(c, gl_restore(c, state)));
}

fmi2Status fmi2FreeFMUstate(fmi2Component c, fmi2FMUstate *state)
{
    return answer(GL_CALL(c, gl_forget(c, state)));
}

fmi2Status fmi2SerializedFMUstateSize(fmi2Component c, fmi2FMUstate state, size_t *size)
{
    return answer(GL_CALL(c, gl_state_size(c, state, size)));
}

fmi2Status fmi2SerializeFMUstate(fmi2Component c, fmi2FMUstate state, fmi2Byte bytes[], size_t size)
{
    return answer(GL_CALL(c, gl_serialise(c, state, (unsigned char *)bytes, size)));
}

fmi2Status fmi2DeSerializeFMUstate(fmi2Component c, const fmi2Byte bytes[], size_t size,
                                   fmi2FMUstate *state)
{
    return answer(GL_CALL(c, gl_deserialise(c, (const unsigned char *)bytes, size, state)));
}

fmi2Status fmi2DoStep(fmi2Component c, fmi2Real time, fmi2Real step, fmi2Boolean no_way_back)
{
    (void)no_way_back;
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
    (void)vr;
    (void)n;
    (void)order;
    (void)value;
    return unsupported(c, "derivatives of inputs");
}

fmi2Status fmi2GetRealOutputDerivatives(fmi2Component c, const fmi2ValueReference vr[], size_t n,
                                        const fmi2Integer order[], fmi2Real value[])
{
    (void)vr;
    (void)n;
    (void)order;
    (void)value;
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
    (void)kind;
    (void)value;
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
    (void)kind;
    (void)value;
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
    (void)kind;
    (void)value;
    return no_information(c, "status that is a String");
}
