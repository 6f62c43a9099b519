/* Model exchange: modes, continuous states, their rates, event indicators, derivatives. */
#include "instance.h"
#include "internal.h"

#include <math.h>
#include <string.h>

gl_status gl_enter_events(gl_instance *instance)
{
    gl_status status = gl_expect_either(instance, GL_EVENTS, GL_CONTINUOUS_TIME);
    if (status == GL_OK) {
        instance->now.phase = GL_EVENTS;
    }
    return status;
}

gl_status gl_enter_continuous_time(gl_instance *instance)
{
    gl_status status = gl_expect(instance, GL_EVENTS);
    if (status == GL_OK) {
        instance->now.phase = GL_CONTINUOUS_TIME;
    }
    return status;
}

/* Lets a copy of the state take what an event changes, in this phase alone. */
static gl_status event(gl_instance *instance, gl_phase phase, double *state)
{
    double inputs[GL_MOST_INPUTS] = {0.0}; /* those in the state count */
    gl_status status = gl_expect(instance, phase);
    if (status == GL_OK) {
        status = gl_take_inputs(instance);
    }
    if (status != GL_OK) {
        return status;
    }
    memcpy(state, instance->now.state, gl_state_bytes(instance->model));
    int64_t refusal = gearlube_entry(GL_EVENT, 0.0, instance->model->data, instance->parameters,
                                     inputs, state, instance->work, instance->outputs);
    if (refusal != 0 || !gl_all_finite(state, instance->model->n.state)) {
        gl_say(instance, GL_DISCARD, "The event cannot be computed: %s.",
               refusal ? gl_refusal_text(instance->model, refusal) : "a state is not finite");
        return GL_DISCARD;
    }
    return GL_OK;
}

gl_status gl_update_discrete(gl_instance *instance, int *states_changed)
{
    double state[GL_MOST_STATE];
    gl_status status = event(instance, GL_EVENTS, state);
    if (status != GL_OK) {
        return status;
    }
    *states_changed = 0;
    for (int i = 0; i < instance->model->n.continuous; i++) {
        int place = instance->model->states[i].place;
        *states_changed |= memcmp(&state[place], &instance->now.state[place], sizeof *state) != 0;
    }
    if (memcmp(state, instance->now.state, gl_state_bytes(instance->model))) {
        memcpy(instance->now.state, state, gl_state_bytes(instance->model));
        instance->fresh = 0;
    }
    return GL_OK;
}

gl_status gl_complete_step(gl_instance *instance, int *due)
{
    double state[GL_MOST_STATE];
    gl_status status = event(instance, GL_CONTINUOUS_TIME, state);
    if (status != GL_OK) {
        return status;
    }
    *due = memcmp(state, instance->now.state, gl_state_bytes(instance->model)) != 0;
    if (gl_is_unwatched(instance) && gl_refresh(instance, GL_ALL) == GL_OK) {
        gl_watch_ranges(instance);
    }
    return GL_OK;
}

/* Beyond the stop time too: integrators look ahead there and interpolate. */
gl_status gl_set_time(gl_instance *instance, double time)
{
    gl_status status = gl_expect_either(instance, GL_EVENTS, GL_CONTINUOUS_TIME);
    if (status == GL_OK && !isfinite(time)) {
        status = gl_refuse(instance, "The time must be finite, got %g s.", time);
    }
    if (status == GL_OK) {
        instance->now.time = time;
    }
    return status;
}

static gl_status check_array(gl_instance *instance, const double *values, size_t count,
                             size_t expected)
{
    if (count != expected) {
        return gl_refuse(instance, "The call must bring room for %d values, got %lu.",
                         (int)expected, (unsigned long)count);
    }
    return values || !count ? GL_OK : gl_refuse(instance, "The values are missing: a null pointer.");
}

gl_status gl_check_state(gl_instance *instance, int number, double value)
{
    const gl_continuous_state *state = &instance->model->states[number];
    if (isfinite(value / state->unit)) {
        return GL_OK;
    }
    gl_say(instance, GL_DISCARD, "%s must be finite, also in the unit of the model, got %g.",
           instance->model->variables[state->reference].name, value);
    return GL_DISCARD;
}

void gl_put_state(gl_instance *instance, int number, double value)
{
    const gl_continuous_state *state = &instance->model->states[number];
    instance->now.state[state->place] = value / state->unit;
    instance->fresh = 0;
}

gl_status gl_set_states(gl_instance *instance, const double *values, size_t count)
{
    gl_status status = gl_expect(instance, GL_CONTINUOUS_TIME);
    if (status == GL_OK) {
        status = check_array(instance, values, count, (size_t)instance->model->n.continuous);
    }
    if (status != GL_OK) {
        return status;
    }
    for (int i = 0; i < instance->model->n.continuous; i++) { /* all or none */
        if (gl_check_state(instance, i, values[i]) != GL_OK) {
            return GL_DISCARD;
        }
    }
    for (int i = 0; i < instance->model->n.continuous; i++) {
        gl_put_state(instance, i, values[i]);
    }
    return GL_OK;
}

/* In any phase from initialisation on; computes what is needed. */
static gl_status check_get(gl_instance *instance, const double *values, size_t count,
                           size_t expected, int needed)
{
    if (!instance->now.exchange || instance->now.phase < GL_INITIALISING) {
        return gl_refuse(instance, "This call needs an instance for model exchange that has "
                                   "entered initialisation.");
    }
    gl_status status = check_array(instance, values, count, expected);
    return status == GL_OK ? gl_compute(instance, needed) : status;
}

gl_status gl_get_states(gl_instance *instance, double *values, size_t count)
{
    int needed = instance->now.phase < GL_STEPPING ? GL_ALL : GL_NOTHING;
    gl_status status = check_get(instance, values, count, (size_t)instance->model->n.continuous, needed);
    for (int i = 0; status == GL_OK && i < instance->model->n.continuous; i++) {
        const gl_continuous_state *state = &instance->model->states[i];
        values[i] = instance->now.state[state->place] * state->unit;
    }
    return status;
}

gl_status gl_get_nominals(gl_instance *instance, double *values, size_t count)
{
    gl_status status = check_get(instance, values, count, (size_t)instance->model->n.continuous, GL_NOTHING);
    for (int i = 0; status == GL_OK && i < instance->model->n.continuous; i++) {
        values[i] = instance->model->variables[instance->model->states[i].reference].nominal;
    }
    return status;
}

gl_status gl_get_rates(gl_instance *instance, double *values, size_t count)
{
    gl_status status = check_get(instance, values, count, (size_t)instance->model->n.continuous, GL_OF_RATES);
    for (int i = 0; status == GL_OK && i < instance->model->n.continuous; i++) {
        values[i] = instance->now.values[instance->model->states[i].rate];
    }
    return status;
}

gl_status gl_get_indicators(gl_instance *instance, double *values, size_t count)
{
    gl_status status = check_get(instance, values, count, (size_t)instance->model->n.indicators, GL_OF_RATES);
    for (int i = 0; status == GL_OK && i < instance->model->n.indicators; i++) {
        values[i] = instance->now.values[instance->model->indicators[i]];
    }
    return status;
}

int gl_state_number(const gl_model *model, unsigned reference)
{
    for (int i = 0; i < model->n.continuous; i++) {
        if (model->states[i].reference == (int)reference) {
            return i;
        }
    }
    return -1;
}

/* Place in the state of what a direction changes, with the size of one there; -1: none such. */
static int place_of(const gl_model *model, unsigned reference, double *unit)
{
    int number = gl_state_number(model, reference);
    *unit = number >= 0 ? model->states[number].unit : 1.0;
    if (number >= 0) {
        return model->states[number].place;
    }
    const gl_variable *variable = &model->variables[reference];
    return variable->causality == GL_INPUT ? model->n.inputs_at + variable->place : -1;
}

static gl_status check_seed(gl_instance *instance, const double *seed, size_t count)
{
    gl_status status = GL_OK;
    for (size_t i = 0; status == GL_OK && i < count; i++) {
        if (!isfinite(seed[i])) {
            status = gl_refuse(instance, "The seed must be finite, got %g.", seed[i]);
        }
    }
    return status;
}

static gl_status check_direction(gl_instance *instance, const unsigned *unknowns, size_t n_unknowns,
                                 const unsigned *knowns, size_t n_knowns, const double *of_unknowns,
                                 const double *of_knowns)
{
    double unit;
    const gl_variable *variables = instance->model->variables;
    gl_status status = gl_expect_either(instance, GL_EVENTS, GL_CONTINUOUS_TIME);
    if (status == GL_OK && ((n_unknowns && (!unknowns || !of_unknowns)) ||
                            (n_knowns && (!knowns || !of_knowns)))) {
        status = gl_refuse(instance, "References or values are missing: a null pointer.");
    }
    for (size_t i = 0; status == GL_OK && i < n_unknowns; i++) {
        if (unknowns[i] >= (unsigned)instance->model->n.variables ||
            variables[unknowns[i]].causality != GL_OUTPUT ||
            variables[unknowns[i]].kind != GL_REAL) {
            status = gl_refuse(instance, "An unknown must be a Real that the FMU computes, got the "
                                         "value reference %u.", unknowns[i]);
        }
    }
    for (size_t i = 0; status == GL_OK && i < n_knowns; i++) {
        if (knowns[i] >= (unsigned)instance->model->n.variables ||
            place_of(instance->model, knowns[i], &unit) < 0) {
            status = gl_refuse(instance, "A known must be a continuous state or an input, got the "
                                         "value reference %u.", knowns[i]);
        }
    }
    return status;
}

/* Outputs at the present state, and their changes along the seed. */
static gl_status changes_along(gl_instance *instance, int operation, const unsigned *knowns,
                               size_t n_knowns, const double *seed, double *outputs,
                               double *changes)
{
    double state[GL_MOST_STATE], inputs[GL_MOST_INPUTS] = {0.0};
    double along[GL_MOST_STATE] = {0.0}, unit;
    double *work = instance->work + instance->model->work, *of_work = work + instance->model->work;
    int64_t refusal = 0;
    if (!instance->differentiated) { /* what it keeps in `work` must be of its own last direction */
        memcpy(work, instance->work, (size_t)instance->model->work * sizeof *work);
        memset(of_work, 0, (size_t)instance->model->work * sizeof *work);
        instance->differentiated = 1;
    }
    memcpy(state, instance->now.state, gl_state_bytes(instance->model));
    for (size_t i = 0; i < n_knowns; i++) {
        int place = place_of(instance->model, knowns[i], &unit);
        along[place] += seed[i] / unit;
    }
#if GL_EXCHANGE /* no other model gets here */
    refusal = gearlube_tangent(operation, 0.0, instance->model->data, instance->parameters, inputs,
                               state, work, outputs, along, of_work, changes);
#endif
    if (refusal != 0) {
        gl_say(instance, GL_DISCARD, "The derivatives cannot be computed: %s.",
               gl_refusal_text(instance->model, refusal));
    }
    return refusal == 0 ? GL_OK : GL_DISCARD;
}

gl_status gl_differentiate(gl_instance *instance, const unsigned *unknowns, size_t n_unknowns,
                           const unsigned *knowns, size_t n_knowns, const double *seed,
                           double *derivatives)
{
    double outputs[GL_MOST_OUTPUTS], changes[GL_MOST_OUTPUTS];
    const gl_variable *variables = instance->model->variables;
    int needs = GL_OF_RATES;
    gl_status status = check_direction(instance, unknowns, n_unknowns, knowns, n_knowns, derivatives,
                                       seed);
    if (status == GL_OK) {
        status = check_seed(instance, seed, n_knowns);
    }
    if (status == GL_OK) {
        status = gl_take_inputs(instance);
    }
    for (size_t i = 0; status == GL_OK && i < n_unknowns; i++) {
        needs |= variables[unknowns[i]].needs;
    }
    if (status == GL_OK) {
        int operation = needs == GL_OF_RATES ? GL_DERIVATIVES : GL_WRITE_OUTPUTS;
        status = changes_along(instance, operation, knowns, n_knowns, seed, outputs, changes);
    }
    for (size_t i = 0; status == GL_OK && i < n_unknowns; i++) {
        int place = variables[unknowns[i]].place;
        if (!isfinite(outputs[place]) || !isfinite(changes[place])) {
            gl_say(instance, GL_DISCARD, "The derivative of %s is not finite. Use a smaller seed, or "
                   "a state nearer to a run.", variables[unknowns[i]].name);
            status = GL_DISCARD;
        }
    }
    for (size_t i = 0; status == GL_OK && i < n_unknowns; i++) {
        derivatives[i] = changes[variables[unknowns[i]].place];
    }
    return status;
}

gl_status gl_differentiate_back(gl_instance *instance, const unsigned *unknowns, size_t n_unknowns,
                                const unsigned *knowns, size_t n_knowns, const double *seed,
                                double *derivatives)
{
    double column[GL_MOST_VARIABLES], found[GL_MOST_VARIABLES];
    const double one = 1.0;
    gl_status status = check_direction(instance, unknowns, n_unknowns, knowns, n_knowns, seed,
                                       derivatives);
    if (status == GL_OK) {
        status = check_seed(instance, seed, n_unknowns);
    }
    for (size_t i = 0; status == GL_OK && i < n_knowns; i++) {
        status = gl_differentiate(instance, unknowns, n_unknowns, &knowns[i], 1, &one, column);
        found[i] = 0.0;
        for (size_t j = 0; status == GL_OK && j < n_unknowns; j++) {
            found[i] += seed[j] * column[j];
        }
    }
    for (size_t i = 0; status == GL_OK && i < n_knowns; i++) {
        derivatives[i] = found[i];
    }
    return status;
}
