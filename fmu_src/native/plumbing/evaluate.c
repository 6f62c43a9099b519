/* Outputs of the present state, computed when they are needed, and their ranges. */
#include "instance.h"
#include "internal.h"

#include <math.h>

/* Ranges are looked at where outputs are read, at latest so long after the last time [s]. */
static const double LONGEST_UNWATCHED = 0.01;

/* Inputs have narrower limits than the table of variables says: mesh data and oil decide. */
int gl_say_input_beyond(gl_instance *instance, gl_status status, const char *before)
{
    for (int i = 0; i < instance->model->n.inputs; i++) {
        int reference = instance->model->inputs[i];
        const gl_variable *variable = &instance->model->variables[reference];
        const double *limits = instance->work + instance->model->n.limits_at + 2 * i;
        double value = instance->now.values[reference];
        if (!(limits[0] <= value && value <= limits[1])) {
            gl_say(instance, status, "%s%s must be within %g to %g %s, got %g. %s", before,
                   variable->name, limits[0], limits[1], variable->unit, value,
                   "Beyond it results have no meaning: the data of mesh or oil end before. "
                   "Check the unit.");
            return 1;
        }
    }
    return 0;
}

void gl_take_outputs(gl_instance *instance, int computed)
{
    for (int i = 0; i < instance->model->n.outputs; i++) {
        int reference = instance->model->outputs[i];
        if (instance->model->variables[reference].needs & computed) {
            instance->now.values[reference] = instance->outputs[i];
        }
    }
    instance->fresh |= computed;
}

int gl_is_unwatched(const gl_instance *instance)
{
    return instance->now.time - instance->watched >= LONGEST_UNWATCHED;
}

void gl_watch_ranges(gl_instance *instance)
{
    instance->points++;
    instance->watched = instance->now.time;
    if (instance->model->n.ranges == 0) {
        return;
    }
    unsigned outside = (unsigned)gl_whole(instance->now.values[instance->model->n.exceeded], 0, INT32_MAX);
    for (int i = 0; outside && i < instance->model->n.ranges; i++) {
        if (!(outside >> i & 1u) || instance->outside[i]++) {
            continue;
        }
        const gl_range *range = &instance->model->ranges[i];
        const double *limits = instance->work + instance->model->n.ranges_at + 2 * i;
        gl_say(instance, GL_WARNING,
               "%s: %s should be within %g to %g%s%s, got %.4g. %s First at t = %g s; said once "
               "a run.",
               range->output, range->what, limits[0], limits[1], *range->unit ? " " : "",
               range->unit, instance->now.values[range->reference], range->beyond,
               instance->now.time);
    }
}

gl_status gl_take_inputs(gl_instance *instance)
{
    if (!instance->now.exchange) {
        return GL_OK; /* those of the last step stand in the state */
    }
    if (gl_say_refused(instance, GL_DISCARD, "") || gl_say_input_beyond(instance, GL_DISCARD, "")) {
        return GL_DISCARD;
    }
    gl_gather_inputs(instance->model, instance->now.values,
                     instance->now.state + instance->model->n.inputs_at);
    return GL_OK;
}

/* Does an operation that computes some of what is missing: groups alone, as long as those suffice,
   because all outputs may solve films of rollers. In model exchange powers of the motion are rates, which only the operation for
   all outputs computes. */
static int64_t compute(gl_instance *instance, int missing, int *computed)
{
    double inputs[GL_MOST_INPUTS] = {0.0}; /* those in the state count */
    int64_t operation = GL_WRITE_OUTPUTS;
    *computed = GL_ALL;
    if (missing == GL_OF_RATES) {
        operation = GL_DERIVATIVES;
        *computed = missing;
    } else if (!instance->now.exchange && !(missing & GL_OF_OUTPUTS)) {
        operation = missing & GL_OF_MOTION ? GL_MOTION : GL_SHOW;
        *computed = missing & GL_OF_MOTION ? GL_OF_MOTION : missing;
    }
    return gearlube_entry(operation, *computed, instance->model->data, instance->parameters, inputs,
                          instance->now.state, instance->work, instance->outputs);
}

gl_status gl_refresh(gl_instance *instance, int needed)
{
    int known = instance->fresh, missing = needed & ~known, computed;
    gl_status bad = instance->now.exchange ? GL_DISCARD : GL_ERROR;
    if (!missing) {
        return GL_OK;
    }
    gl_status status = gl_take_inputs(instance);
    if (status == GL_OK && instance->now.exchange && missing != GL_OF_RATES) {
        status = gl_refresh(instance, GL_OF_RATES); /* a state without rates has no outputs */
    }
    if (status != GL_OK) {
        return status;
    }
    int64_t refusal = compute(instance, missing, &computed);
    if (refusal != 0) {
        gl_say(instance, bad, "The outputs cannot be computed: %s.",
               gl_refusal_text(instance->model, refusal));
        return bad;
    }
    for (int i = 0; i < instance->model->n.outputs; i++) {
        const gl_variable *variable = &instance->model->variables[instance->model->outputs[i]];
        if (variable->needs & computed && !isfinite(instance->outputs[i])) {
            gl_say(instance, bad, "%s is not finite.", variable->name);
            return bad;
        }
    }
    gl_take_outputs(instance, computed);
    if (computed & ~known & instance->model->variables[instance->model->n.exceeded].needs &&
        !instance->now.exchange) {
        gl_watch_ranges(instance);
    }
    return gl_refresh(instance, needed);
}

gl_status gl_compute(gl_instance *instance, int needed)
{
    if (needed && instance->now.phase >= GL_STEPPING) {
        return gl_refresh(instance, needed);
    }
    return needed && instance->stale ? gl_start(instance) : GL_OK;
}
