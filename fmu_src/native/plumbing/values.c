/* Values of the variables, and the rules for reading and setting them. */
#include "instance.h"
#include "internal.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const char *const kind_names[] = {"Real", "Integer", "Boolean"};

void gl_limits_text(const gl_variable *variable, char *text, size_t size)
{
    if (!variable->literals) {
        snprintf(text, size, "within %g to %g%s%s", variable->low, variable->high,
                 *variable->unit ? " " : "", variable->unit);
        return;
    }
    size_t used = (size_t)snprintf(text, size, "one of");
    for (int i = 0; i < (int)variable->high && used < size; i++) {
        used += (size_t)snprintf(text + used, size - used, "%s %d (%s)", i ? "," : "", i + 1,
                                 variable->literals[i]);
    }
}

static int is_legal(const gl_variable *variable, double value)
{
    return variable->low <= value && value <= variable->high; /* false for NaN */
}

int gl_say_refused(gl_instance *instance, gl_status status, const char *before)
{
    for (int i = 0; instance->refusals && i < instance->model->n.variables; i++) {
        if (instance->refused[i]) {
            char limits[GL_LONGEST_LIMITS];
            const gl_variable *variable = &instance->model->variables[i];
            gl_limits_text(variable, limits, sizeof limits);
            gl_say(instance, status, "%s%s must be %s, got %g.", before, variable->name, limits,
                   instance->now.values[i]);
            return 1;
        }
    }
    return 0;
}

static void note(gl_instance *instance, unsigned reference, int refused)
{
    instance->refusals += refused - instance->refused[reference];
    instance->refused[reference] = (unsigned char)refused;
}

void gl_find_refused(gl_instance *instance)
{
    for (int i = 0; i < instance->model->n.variables; i++) {
        const gl_variable *variable = &instance->model->variables[i];
        note(instance, (unsigned)i,
             variable->causality != GL_OUTPUT && !is_legal(variable, instance->now.values[i]));
    }
}

void gl_gather_parameters(const gl_model *model, const double *values, double *parameters)
{
    const gl_variable *variables = model->variables;
    for (int i = 0; i < model->n.variables; i++) {
        if (variables[i].causality == GL_PARAMETER && variables[i].place >= 0) {
            parameters[variables[i].place] = values[i];
        }
    }
    for (int i = 0; i < model->n.variables; i++) {
        if (variables[i].option >= 0 && values[i] != 0.0) {
            parameters[variables[variables[i].option].place] = values[i];
        }
    }
}

void gl_gather_inputs(const gl_model *model, const double *values, double *inputs)
{
    for (int i = 0; i < model->n.inputs; i++) {
        inputs[i] = values[model->inputs[i]];
    }
}

int64_t gl_whole(double value, int64_t low, int64_t high)
{
    /* no conversion here is inexact, which a host may have set to trap */
    static const double LIMIT = 9223372036854775808.0; /* 2^63 */
    int64_t whole = value >= LIMIT ? INT64_MAX : value > -LIMIT ? (int64_t)value : INT64_MIN;
    return whole < low ? low : whole > high ? high : whole;
}

static gl_status check(gl_instance *instance, gl_kind kind, size_t count, const unsigned *refs,
                       const void *values)
{
    if (count && (!refs || !values)) {
        return gl_refuse(instance, "References or values are missing: a null pointer.");
    }
    for (size_t i = 0; i < count; i++) {
        if (refs[i] >= (unsigned)instance->model->n.variables) {
            return gl_refuse(instance, "The value reference must be within 0 to %d, got %u.",
                             instance->model->n.variables - 1, refs[i]);
        }
        const gl_variable *variable = &instance->model->variables[refs[i]];
        if (variable->kind != kind) {
            return gl_refuse(instance, "%s must be accessed as %s, got %s.", variable->name,
                             kind_names[variable->kind], kind_names[kind]);
        }
    }
    return GL_OK;
}

static int needed_by(const gl_model *model, size_t count, const unsigned *refs)
{
    int needs = GL_NOTHING;
    for (size_t i = 0; i < count; i++) {
        needs |= model->variables[refs[i]].needs;
    }
    return needs;
}

gl_status gl_check_read(gl_instance *instance, gl_kind kind, size_t count, const unsigned *refs,
                        const void *values)
{
    gl_status status = check(instance, kind, count, refs, values);
    return status == GL_OK ? gl_compute(instance, needed_by(instance->model, count, refs)) : status;
}

/* Some hosts of model exchange set states one by one, as variables. */
static int is_set_as_state(const gl_instance *instance, unsigned reference)
{
    return (instance->now.phase == GL_EVENTS || instance->now.phase == GL_CONTINUOUS_TIME) &&
           gl_state_number(instance->model, reference) >= 0;
}

static int can_be_set(const gl_instance *instance, const gl_variable *variable)
{
    return (variable->causality == GL_INPUT && instance->now.phase != GL_TERMINATED) ||
           (variable->causality == GL_PARAMETER && instance->now.phase < GL_STEPPING);
}

gl_status gl_check_set(gl_instance *instance, gl_kind kind, size_t count, const unsigned *refs,
                       const void *values)
{
    gl_status status = check(instance, kind, count, refs, values);
    for (size_t i = 0; status == GL_OK && i < count; i++) {
        const gl_variable *variable = &instance->model->variables[refs[i]];
        if (!can_be_set(instance, variable) && !is_set_as_state(instance, refs[i])) {
            status = gl_refuse(instance,
                               "%s must not be set in this phase of the simulation. Set "
                               "parameters before the end of initialisation, inputs before "
                               "termination, outputs never.",
                               variable->name);
        } else if (is_set_as_state(instance, refs[i])) {
            status = gl_check_state(instance, gl_state_number(instance->model, refs[i]),
                                    ((const double *)values)[i]);
        }
    }
    return status;
}

gl_status gl_set(gl_instance *instance, unsigned reference, double value)
{
    const gl_variable *variable = &instance->model->variables[reference];
    if (variable->causality == GL_OUTPUT) {
        gl_put_state(instance, gl_state_number(instance->model, reference), value);
        return GL_OK;
    }
    instance->now.values[reference] = value;
    instance->stale = 1;
    if (instance->now.exchange) {
        instance->fresh = 0; /* an input counts at once */
    }
    note(instance, reference, !is_legal(variable, value));
    if (!instance->refused[reference]) {
        return GL_OK;
    }
    char limits[GL_LONGEST_LIMITS];
    gl_limits_text(variable, limits, sizeof limits);
    gl_say(instance, GL_ERROR,
           "%s must be %s, got %g. No step is taken until a legal value replaces it.",
           variable->name, limits, value);
    return GL_WARNING;
}
