/* FMI 3.0: co-simulation, and what model exchange shares with it or with FMI 2. Values of arrays lie one after the other, element by element. */
#include "fmi3Functions.h"

#include "instance.h"

#include <math.h>
#include <string.h>

static const char *const type_names[] = {"Float64", "Int32", "Boolean"}; /* by gl_kind */

#define FMI(name) fmi3##name
#define STATE(before, after) fmi3##before##FMUState##after
#include "both_versions.h"

static void tell(gl_instance *instance, gl_status status, const char *category, const char *text)
{
    fmi3LogMessageCallback log = (fmi3LogMessageCallback)instance->logger;
    if (log) {
        log(instance->host, answer(status), category, text);
    }
}

const char *fmi3GetVersion(void)
{
    return fmi3Version;
}

static fmi3Instance no_instance(fmi3String name, fmi3InstanceEnvironment host,
                                fmi3LogMessageCallback log, const char *why)
{
    gl_say_no_instance(name, why);
    if (log) {
        log(host, fmi3Error, gl_log_names[GL_LOG_ERROR], why);
    }
    return NULL;
}

static fmi3Instance make(fmi3String name, fmi3String token, fmi3String resources,
                         fmi3Boolean logging, fmi3InstanceEnvironment host,
                         fmi3LogMessageCallback log, int exchange)
{
    char why[GL_LONGEST_MESSAGE];
    gl_model *model = gl_load(resources, token, "token", why);
    if (!model) {
        return no_instance(name, host, log, why);
    }
    return gl_make(model, name, tell, host, (uintptr_t)log, logging, exchange);
}

fmi3Instance fmi3InstantiateCoSimulation(
    fmi3String name, fmi3String token, fmi3String resources, fmi3Boolean visible,
    fmi3Boolean logging, fmi3Boolean events, fmi3Boolean early_return,
    const fmi3ValueReference intermediate[], size_t n_intermediate, fmi3InstanceEnvironment host,
    fmi3LogMessageCallback log, fmi3IntermediateUpdateCallback update)
{
    if (events || n_intermediate) {
        return no_instance(name, host, log,
                           "This FMU has neither event mode nor intermediate variables.");
    }
    return make(name, token, resources, logging, host, log, 0);
}

fmi3Instance fmi3InstantiateModelExchange(fmi3String name, fmi3String token, fmi3String resources,
                                          fmi3Boolean visible, fmi3Boolean logging,
                                          fmi3InstanceEnvironment host, fmi3LogMessageCallback log)
{
    if (!GL_EXCHANGE) {
        return no_instance(name, host, log, "This FMU is for co-simulation only.");
    }
    return make(name, token, resources, logging, host, log, 1);
}

fmi3Instance fmi3InstantiateScheduledExecution(
    fmi3String name, fmi3String token, fmi3String resources, fmi3Boolean visible,
    fmi3Boolean logging, fmi3InstanceEnvironment host, fmi3LogMessageCallback log,
    fmi3ClockUpdateCallback update, fmi3LockPreemptionCallback lock,
    fmi3UnlockPreemptionCallback unlock)
{
    return no_instance(name, host, log, "This FMU has no scheduled execution.");
}

fmi3Status fmi3EnterInitializationMode(fmi3Instance c, fmi3Boolean tolerance_defined,
                                       fmi3Float64 tolerance, fmi3Float64 start,
                                       fmi3Boolean stop_defined, fmi3Float64 stop)
{
    /* the tolerance is not used: the step follows from the frequencies of the model */
    gl_status status = GL_CALL(c, gl_set_times(c, start, stop_defined ? stop : INFINITY));
    return answer(status == GL_OK ? GL_CALL(c, gl_enter_initialisation(c)) : status);
}

fmi3Status fmi3DoStep(fmi3Instance c, fmi3Float64 time, fmi3Float64 step, fmi3Boolean no_way_back,
                      fmi3Boolean *event_needed, fmi3Boolean *terminate, fmi3Boolean *early_return,
                      fmi3Float64 *last_time)
{
    gl_instance *instance = c;
    if (!gl_is_instance(instance)) {
        return fmi3Error;
    }
    if (!event_needed || !terminate || !early_return || !last_time) {
        return no_pointer(instance);
    }
    gl_status status = GL_CALL(instance, gl_step(instance, time, step));
    *event_needed = *terminate = *early_return = false;
    *last_time = instance->now.time;
    return answer(status);
}

/* The independent variable comes behind all others. */
static fmi3ValueReference reference_of_time(const gl_instance *instance)
{
    return (fmi3ValueReference)instance->model->n.variables;
}

static int is_time(const gl_instance *instance, fmi3ValueReference reference, gl_kind kind,
                   int setting)
{
    return reference == reference_of_time(instance) && kind == GL_REAL && !setting;
}

/* The variable of a reference; NULL if there is none. */
static const gl_array *array_of(const gl_instance *instance, fmi3ValueReference reference)
{
    const gl_array *array = reference < reference_of_time(instance) ? &instance->model->arrays[reference] : NULL;
    return array && array->count ? array : NULL;
}

/* Checks that references are of this type, as many as there are values. */
static gl_status check_types(gl_instance *instance, gl_kind kind, int enumeration, int setting,
                             const fmi3ValueReference refs[], size_t n, size_t n_values)
{
    size_t expected = 0;
    for (size_t i = 0; i < n; i++) {
        if (is_time(instance, refs[i], kind, setting)) {
            expected++;
            continue;
        }
        const gl_array *array = array_of(instance, refs[i]);
        if (!array) {
            return gl_refuse(instance, "No variable of this FMU has the value reference %u.",
                             refs[i]);
        }
        const gl_variable *variable = &instance->model->variables[refs[i]];
        if (variable->kind != kind ||
            (kind == GL_INTEGER && enumeration != (variable->literals != NULL))) {
            return gl_refuse(instance, "%s must be accessed as %s.", variable->name,
                             variable->literals ? "Int64" : type_names[variable->kind]);
        }
        expected += (size_t)array->count;
    }
    if (expected != n_values) {
        return gl_refuse(instance, "The call must bring room for %llu values, got %llu.",
                         (unsigned long long)expected, (unsigned long long)n_values);
    }
    return GL_OK;
}

/* Checks the whole call before anything is computed for it; for an enumeration `enumeration`. */
static gl_status check(gl_instance *instance, gl_kind kind, int enumeration, int setting,
                       const fmi3ValueReference refs[], size_t n, const void *values,
                       size_t n_values)
{
    if (n && (!refs || !values)) {
        return gl_refuse(instance, "References or values are missing: a null pointer.");
    }
    gl_status status = check_types(instance, kind, enumeration, setting, refs, n, n_values);
    const double *reals = kind == GL_REAL ? values : NULL;
    for (size_t i = 0; status == GL_OK && i < n; i++) {
        if (!is_time(instance, refs[i], kind, setting)) {
            const gl_array *array = &instance->model->arrays[refs[i]];
            const void *own = reals ? reals : values;
            status = (setting ? gl_check_set : gl_check_read)(
                instance, kind, (size_t)array->count, array->members, own);
            reals = reals ? reals + array->count : NULL;
        } else {
            reals++;
        }
    }
    return status;
}

/* Reads and sets the values of one FMI type, `kind` in our table. */
#define ACCESS(name, type, kind, enumeration, read)                                               \
    fmi3Status fmi3Get##name(fmi3Instance c, const fmi3ValueReference refs[], size_t n,           \
                             type values[], size_t n_values)                                      \
    {                                                                                             \
        gl_instance *instance = c;                                                                \
        size_t k = 0;                                                                             \
        if (!gl_is_instance(instance)) {                                                          \
            return fmi3Error;                                                                     \
        }                                                                                         \
        gl_status status =                                                                        \
            GL_CALL(c, check(instance, kind, enumeration, 0, refs, n, values, n_values));         \
        if (status != GL_OK) {                                                                    \
            return answer(status);                                                                \
        }                                                                                         \
        for (size_t i = 0; i < n; i++) {                                                          \
            const gl_array *array = array_of(instance, refs[i]);                                  \
            for (int j = 0; array && j < array->count; j++) {                                     \
                double value = instance->now.values[array->members[j]];                           \
                values[k++] = read;                                                               \
            }                                                                                     \
            if (refs[i] == reference_of_time(instance)) {                                                                \
                double value = instance->now.time;                                                \
                values[k++] = read;                                                               \
            }                                                                                     \
        }                                                                                         \
        return fmi3OK;                                                                            \
    }                                                                                             \
    fmi3Status fmi3Set##name(fmi3Instance c, const fmi3ValueReference refs[], size_t n,           \
                             const type values[], size_t n_values)                                \
    {                                                                                             \
        gl_instance *instance = c;                                                                \
        fmi3Status worst = fmi3OK;                                                                \
        size_t k = 0;                                                                             \
        if (!gl_is_instance(c)) {                                                                 \
            return fmi3Error;                                                                     \
        }                                                                                         \
        gl_status status =                                                                        \
            GL_CALL(c, check(c, kind, enumeration, 1, refs, n, values, n_values));                \
        if (status != GL_OK) {                                                                    \
            return answer(status);                                                                \
        }                                                                                         \
        for (size_t i = 0; i < n; i++) {                                                          \
            const gl_array *array = &instance->model->arrays[refs[i]];                            \
            for (int j = 0; j < array->count; j++) {                                              \
                unsigned reference = array->members[j];                                           \
                fmi3Status one = answer(GL_CALL(c, gl_set(c, reference, (double)values[k])));     \
                k++;                                                                              \
                worst = one > worst ? one : worst;                                                \
            }                                                                                     \
        }                                                                                         \
        return worst;                                                                             \
    }

ACCESS(Float64, fmi3Float64, GL_REAL, 0, value)
ACCESS(Int32, fmi3Int32, GL_INTEGER, 0, (fmi3Int32)gl_whole(value, INT32_MIN, INT32_MAX))
ACCESS(Int64, fmi3Int64, GL_INTEGER, 1, gl_whole(value, INT64_MIN, INT64_MAX))
ACCESS(Boolean, fmi3Boolean, GL_BOOLEAN, 0, value != 0.0)

static fmi3Status unsupported(gl_instance *instance, size_t asked, const char *what)
{
    return answer(
        GL_CALL(instance, asked ? gl_refuse(instance, "This FMU has no %s.", what) : GL_OK));
}

/* Types that no variable has. */
#define NO_ACCESS(name, type)                                                                     \
    fmi3Status fmi3Get##name(fmi3Instance c, const fmi3ValueReference refs[], size_t n,           \
                             type values[], size_t n_values)                                      \
    {                                                                                             \
        return unsupported(c, n, "variable of type " #name);                                      \
    }                                                                                             \
    fmi3Status fmi3Set##name(fmi3Instance c, const fmi3ValueReference refs[], size_t n,           \
                             const type values[], size_t n_values)                                \
    {                                                                                             \
        return unsupported(c, n, "variable of type " #name);                                      \
    }

NO_ACCESS(Float32, fmi3Float32)
NO_ACCESS(Int8, fmi3Int8)
NO_ACCESS(UInt8, fmi3UInt8)
NO_ACCESS(Int16, fmi3Int16)
NO_ACCESS(UInt16, fmi3UInt16)
NO_ACCESS(UInt32, fmi3UInt32)
NO_ACCESS(UInt64, fmi3UInt64)
NO_ACCESS(String, fmi3String)

fmi3Status fmi3GetBinary(fmi3Instance c, const fmi3ValueReference refs[], size_t n, size_t sizes[],
                         fmi3Binary values[], size_t n_values)
{
    return unsupported(c, n, "variable of type Binary");
}

fmi3Status fmi3SetBinary(fmi3Instance c, const fmi3ValueReference refs[], size_t n,
                         const size_t sizes[], const fmi3Binary values[], size_t n_values)
{
    return unsupported(c, n, "variable of type Binary");
}

fmi3Status fmi3DeserializeFMUState(fmi3Instance c, const fmi3Byte bytes[], size_t size,
                                   fmi3FMUState *state)
{
    return answer(GL_CALL(c, gl_deserialise(c, bytes, size, state)));
}
