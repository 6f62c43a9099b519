/* Phases of an instance and its steps. */
#include "instance.h"
#include "internal.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const uint64_t INSTANCE_MARK = 0x6c756265696e7374u;
static const char *const phase_names[] = {"instantiated", "initialising",    "stepping",
                                          "in event mode", "in continuous-time mode",
                                          "terminated"};

static void set_to_start(gl_instance *instance)
{
    int exchange = instance->now.exchange;
    memset(&instance->now, 0, sizeof instance->now);
    instance->now.exchange = exchange;
    memset(instance->refused, 0, sizeof instance->refused);
    memset(instance->outside, 0, sizeof instance->outside);
    instance->points = 0;
    instance->stop = INFINITY;
    instance->refusals = 0;
    instance->step_refused = 0;
    instance->stale = 1;
    for (int i = 0; i < instance->model->n.variables; i++) {
        instance->now.values[i] = instance->model->variables[i].start;
    }
}

gl_instance *gl_make(gl_model *model, const char *name, gl_listener listener, void *host,
                     uintptr_t logger, int logging, int exchange)
{
    const char *given = name && *name ? name : GL_MODEL_NAME;
    size_t length = strlen(given) + 1;
    size_t work = (size_t)model->work * sizeof(double) * (exchange ? 3 : 1);
    gl_instance *instance = calloc(1, sizeof *instance + work);
    char *copy = malloc(length);
    if (!instance || !copy) {
        free(instance);
        free(copy);
        free(model);
        gl_say_no_instance(name, "There is not enough memory for an instance.");
        return NULL;
    }
    memcpy(copy, given, length);
    instance->mark = INSTANCE_MARK;
    instance->model = model;
    instance->name = copy;
    instance->listener = listener;
    instance->host = host;
    instance->logger = logger;
    instance->logs = logging ? GL_ALL_LOGS : 0;
    instance->now.exchange = exchange;
    set_to_start(instance);
    return instance;
}

int gl_is_instance(const gl_instance *instance)
{
    return instance && instance->mark == INSTANCE_MARK;
}

void gl_free(gl_instance *instance)
{
    if (gl_is_instance(instance)) {
        instance->mark = 0;
        free(instance->name);
        free(instance->model);
        free(instance);
    }
}

gl_status gl_expect_either(gl_instance *instance, gl_phase one, gl_phase other)
{
    if (instance->now.phase == one || instance->now.phase == other) {
        return GL_OK;
    }
    return gl_refuse(instance, "The FMU must be %s%s%s for this call, is %s.", phase_names[one],
                     one == other ? "" : " or ", one == other ? "" : phase_names[other],
                     phase_names[instance->now.phase]);
}

gl_status gl_expect(gl_instance *instance, gl_phase phase)
{
    return gl_expect_either(instance, phase, phase);
}

gl_status gl_set_times(gl_instance *instance, double start, double stop)
{
    gl_status status = gl_expect(instance, GL_INSTANTIATED);
    if (status == GL_OK && !isfinite(start)) {
        status = gl_refuse(instance, "The start time must be finite, got %g s.", start);
    }
    if (status == GL_OK && !(start <= stop)) {
        status = gl_refuse(instance, "The stop time must not be before the start, %g s, got %g s.",
                           start, stop);
    }
    if (status == GL_OK) {
        instance->now.time = start;
        instance->stop = stop;
    }
    return status;
}

gl_status gl_enter_initialisation(gl_instance *instance)
{
    gl_status status = gl_expect(instance, GL_INSTANTIATED);
    if (status == GL_OK) {
        instance->now.phase = GL_INITIALISING;
    }
    return status;
}

const char *gl_refusal_text(const gl_model *model, int64_t status)
{
    for (int i = 0; i < model->n_refusals; i++) {
        if (model->refusals[i].status == status) {
            return model->refusals[i].text;
        }
    }
    return "the model refused it";
}

int gl_all_finite(const double *values, int count)
{
    for (int i = 0; i < count; i++) {
        if (!isfinite(values[i])) {
            return 0;
        }
    }
    return 1;
}

size_t gl_state_bytes(const gl_model *model)
{
    return sizeof(double) * (size_t)model->n.state;
}

/* Why an operation of the model gives no result; NULL where it does. Without `outputs` it gives
   none. */
static const char *why_not(const gl_model *model, int64_t status, const double *outputs,
                           const double *state)
{
    if (status != 0) {
        return gl_refusal_text(model, status);
    }
    if (outputs && !gl_all_finite(outputs, model->n.outputs)) {
        return "an output is not finite";
    }
    return gl_all_finite(state, model->n.state) ? NULL : "a state is not finite";
}

gl_status gl_start(gl_instance *instance)
{
    if (gl_say_refused(instance, GL_ERROR, "")) {
        return GL_ERROR;
    }
    double inputs[GL_MOST_INPUTS], state[GL_MOST_STATE];
    memset(state, 0, gl_state_bytes(instance->model));
    gl_gather_parameters(instance->model, instance->now.values, instance->parameters);
    gl_gather_inputs(instance->model, instance->now.values, inputs);
    instance->differentiated = 0;
    int64_t status = gearlube_entry(GL_RESUME, 0.0, instance->model->data, instance->parameters,
                                    inputs, state, instance->work, instance->outputs);
    if (status == 0) {
        if (gl_say_input_beyond(instance, GL_ERROR, "")) {
            return GL_ERROR;
        }
        status = gearlube_entry(GL_START, 0.0, instance->model->data, instance->parameters, inputs,
                                state, instance->work, instance->outputs);
    }
    const char *why = why_not(instance->model, status, instance->outputs, state);
    if (why) {
        return gl_refuse(instance, "The start was refused: %s.", why);
    }
    memcpy(instance->now.state, state, gl_state_bytes(instance->model));
    gl_take_outputs(instance, GL_ALL);
    instance->stale = 0;
    return GL_OK;
}

gl_status gl_exit_initialisation(gl_instance *instance)
{
    gl_status status = gl_expect(instance, GL_INITIALISING);
    if (status == GL_OK && instance->stale) {
        status = gl_start(instance);
    }
    if (status != GL_OK) {
        return status;
    }
    instance->now.phase = instance->now.exchange ? GL_EVENTS : GL_STEPPING;
    gl_watch_ranges(instance);
    gl_say(instance, GL_OK, "initialised at t = %g s", instance->now.time);
    for (int i = 0; i < instance->model->n.variables; i++) {
        const gl_variable *variable = &instance->model->variables[i];
        if (variable->causality == GL_PARAMETER && variable->place >= 0) {
            double value = instance->parameters[variable->place]; /* also if by number */
            const char *const *literals = variable->literals;
            gl_say(instance, GL_OK, "%s = %g%s%s", variable->name, value,
                   literals ? " " : "", literals ? literals[(int)value - 1] : "");
        }
    }
    return GL_OK;
}

gl_status gl_terminate(gl_instance *instance)
{
    gl_status status = instance->now.exchange
                           ? gl_expect_either(instance, GL_EVENTS, GL_CONTINUOUS_TIME)
                           : gl_expect(instance, GL_STEPPING);
    if (status != GL_OK) {
        return status;
    }
    /* so that the ranges are looked at where the run ends */
    if (gl_refresh(instance, GL_ALL) == GL_OK && instance->now.exchange) {
        gl_watch_ranges(instance);
    }
    instance->now.phase = GL_TERMINATED;
    for (int i = 0; i < instance->model->n.ranges; i++) {
        if (instance->outside[i]) {
            gl_say(instance, GL_OK, "%s was outside its range at %llu of %llu communication points.",
                   instance->model->ranges[i].output, (unsigned long long)instance->outside[i],
                   (unsigned long long)instance->points);
        }
    }
    return GL_OK;
}

gl_status gl_reset(gl_instance *instance)
{
    set_to_start(instance);
    return GL_OK;
}

static gl_status check_step(gl_instance *instance, double time, double step)
{
    double last = instance->now.time;
    /* of the host's times; a limit, because a huge time must not allow any step */
    double rounding = fmin(2.0 * DBL_EPSILON * (fabs(last) + GL_LONGEST_STEP), 1e-3 * GL_LONGEST_STEP);
    double allowed = 1e-3 * step + rounding;
    if (instance->now.phase != GL_STEPPING) {
        return gl_expect(instance, GL_STEPPING);
    }
    if (!(0.0 < step && step <= GL_LONGEST_STEP + rounding)) {
        gl_say(instance, GL_DISCARD,
               "step at t = %g s refused. The communication step must be above 0 and at most %g s, "
               "got %g s. Renew the torques at least that often.",
               time, GL_LONGEST_STEP, step);
        return GL_DISCARD;
    }
    if (!(fabs(time - last) <= allowed)) {
        gl_say(instance, GL_DISCARD,
               "step at t = %g s refused. The last step ended at %.17g s, and this one must begin "
               "there. Restore an FMU state to repeat a step.",
               time, last);
        return GL_DISCARD;
    }
    if (time + step > instance->stop + allowed) {
        return gl_refuse(instance, "The step to %g s goes beyond the stop time, %g s.",
                         time + step, instance->stop);
    }
    if (gl_say_refused(instance, GL_DISCARD, "step refused. ") ||
        gl_say_input_beyond(instance, GL_DISCARD, "step refused. ")) {
        return GL_DISCARD;
    }
    return GL_OK;
}

static gl_status step_to(gl_instance *instance, double time, double step)
{
    gl_status checked = check_step(instance, time, step);
    if (checked != GL_OK) {
        return checked;
    }
    double inputs[GL_MOST_INPUTS], before[GL_MOST_STATE];
    gl_gather_inputs(instance->model, instance->now.values, inputs);
    memcpy(before, instance->now.state, gl_state_bytes(instance->model));
    int64_t status = gearlube_entry(GL_STEP, step, instance->model->data, instance->parameters,
                                    inputs, instance->now.state, instance->work, instance->outputs);
    const char *why = why_not(instance->model, status, GL_LAZY ? NULL : instance->outputs,
                              instance->now.state);
    if (why) {
        memcpy(instance->now.state, before, gl_state_bytes(instance->model));
        gl_say(instance, GL_DISCARD, "step of %g s at t = %g s refused: %s.", step, time, why);
        return GL_DISCARD;
    }
    instance->now.time = time + step;
    if (!GL_LAZY) {
        gl_take_outputs(instance, GL_ALL);
        gl_watch_ranges(instance);
        return GL_OK;
    }
    instance->fresh = 0;
    if (gl_is_unwatched(instance)) {
        gl_refresh(instance, GL_ALL);
    }
    return GL_OK;
}

gl_status gl_step(gl_instance *instance, double time, double step)
{
    gl_status status = step_to(instance, time, step);
    instance->step_refused = status == GL_DISCARD;
    return status;
}
