/* The driveline as the one entry that the FMI functions call, around the interval from casadi.

   data:   memory at constant speed (MEMORY), what the engine's torque orders add (MEMORY), engine
           torque, pinion torque and wheel torque at constant speed, lowest and highest engine speed
   state:  memory of the driveline (MEMORY), inputs of the last step (GL_INPUTS), one
   inputs: pinion angle, pinion speed, wheel angle, wheel speed, requested speed
   parameters: scale of the torque orders */

#include <string.h>

#include "driveline_interval.c" /* both from casadi */
#include "driveline_interval.h"
#include "driveline_places.h"
#include "model.h"

enum { STEP_TOO_LONG = 1, NOT_FINITE = 2 };

static void fill_work(const double *data, double *work)
{
    static const double limits[2 * GL_INPUTS] = {-1e9, 1e9,  -5e3, 5e3, -1e9,
                                                 1e9,  -5e3, 5e3,  0.0, 120.0};
    memcpy(work + GL_LIMITS_AT, limits, sizeof limits);
    memcpy(work + GL_RANGES_AT, data + ENGINE_SPEEDS, 2 * sizeof *data);
}

static void write_outputs(const double *data, const double *state, const double *work,
                          double *outputs)
{
    const int started = state[STARTED] != 0.0;
    const double speed = state[CRANK_SPEED];
    const double *range = work + GL_RANGES_AT;
    outputs[0] = started ? state[PINION_TORQUE] : data[STEADY_TORQUES];
    outputs[1] = started ? state[WHEEL_TORQUE] : data[STEADY_TORQUES + 1];
    outputs[2] = state[VEHICLE_SPEED];
    outputs[3] = speed < range[0] || speed > range[1];
    outputs[4] = speed;
}

static void start(const double *data, double ripple, const double *inputs, double *state)
{
    for (int i = 0; i < MEMORY; i++) {
        state[i] = data[i] + ripple * data[MEMORY + i];
    }
    memcpy(state + MEMORY, inputs, GL_INPUTS * sizeof *inputs);
    state[GL_CONTROL_AT] = 1.0;
}

static int64_t advance(double h, const double *data, double ripple, const double *inputs,
                       double *state)
{
    const double motion[] = {h, inputs[0], inputs[1], inputs[2], inputs[3]};
    const double settings[] = {inputs[4], data[ENGINE_TORQUE], ripple};
    const double *arguments[] = {state, motion, settings};
    double next[MEMORY], torques[3], work[driveline_interval_SZ_W + 1];
    double *results[] = {next, torques};
    if (h > LONGEST_STEP) {
        return STEP_TOO_LONG;
    }
    driveline_interval(arguments, results, NULL, work, 0);
    const double sum = torques[0] + torques[1] + torques[2];
    if (sum - sum != 0.0) {
        return NOT_FINITE;
    }
    memcpy(state, next, sizeof next);
    memcpy(state + MEMORY, inputs, GL_INPUTS * sizeof *inputs);
    return 0;
}

int64_t gearlube_entry(int64_t operation, double step, const double *data,
                       const double *parameters, const double *inputs, double *state, double *work,
                       double *outputs)
{
    int64_t status = 0;
    if (operation == GL_START || operation == GL_RESUME) {
        fill_work(data, work);
    }
    if (operation == GL_START) {
        start(data, parameters[0], inputs, state);
    }
    if (operation == GL_STEP) {
        status = advance(step, data, parameters[0], inputs, state);
    }
    if (status == 0 && operation != GL_RESUME) {
        write_outputs(data, state, work, outputs);
    }
    return status;
}
