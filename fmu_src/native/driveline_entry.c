/* The driveline as the one entry that the FMI functions call, around the intervals from casadi.

   data:   lowest and highest engine speed [rad/s]; for each gear the vehicle's speeds [m/s] where the
           engine idles, where the gear is first chosen, and where the engine turns fastest, then
           SPEEDS rows of ROW numbers between the first and the last of these: state at constant
           speed (STATES), what the engine's torque orders add to it (STATES), torques of engine,
           pinion and wheel [N.m], speed of the pinion [rad/s]
   state:  memory of the driveline (MEMORY), inputs of the last step (INPUTS), gear, speed of the
           pinion at the start, engine torque at constant speed
   inputs: pinion angle, pinion speed, wheel angle, wheel speed, requested speed
   parameters: scale of the torque orders, start speed, gear or 0 */

#include <math.h>
#include <string.h>

#include "driveline_gears.h" /* from casadi */
#include "driveline_places.h"
#include "model.h"

enum { NOT_FINITE = 2, NO_GEAR = 3 };
enum { GEAR_AT = MEMORY + INPUTS, PINION_AT, ENGINE_AT };
/* s; nothing moves in it, and the means over a shorter step are lost to underflow */
static const double SHORTEST_STEP = 1e-290;

static const double LOWEST[] = LOWEST_INPUTS, HIGHEST[] = HIGHEST_INPUTS;

enum { LIMITS = 3, GEAR_SIZE = LIMITS + SPEEDS * ROW, GEARS_AT = 2 };

static void fill_work(const double *data, double *work)
{
    for (int i = 0; i < INPUTS; i++) {
        work[LIMITS_AT + 2 * i] = LOWEST[i];
        work[LIMITS_AT + 2 * i + 1] = HIGHEST[i];
    }
    memcpy(work + RANGES_AT, data, 2 * sizeof *data);
}

static void write_outputs(const double *state, const double *work, double *outputs)
{
    const double speed = state[CRANK_SPEED];
    const double *range = work + RANGES_AT;
    outputs[0] = state[PINION_TORQUE];
    outputs[1] = state[WHEEL_TORQUE];
    outputs[2] = state[VEHICLE_SPEED];
    outputs[3] = speed < range[0] || speed > range[1];
    outputs[4] = speed;
    outputs[5] = state[PINION_AT];
    outputs[6] = state[GEAR_AT];
}

/* The highest gear in which the engine is not too slow to cruise, or else the lowest that is legal. */
static int gear_for(const double *data, double speed)
{
    int found = 0;
    for (int gear = 1; gear <= GEARS; gear++) {
        const double *limits = data + GEARS_AT + (gear - 1) * GEAR_SIZE;
        const int legal = limits[0] <= speed && speed <= limits[2];
        if (legal && (!found || limits[1] <= speed)) {
            found = gear;
        }
    }
    return found;
}

/* Writes the row at a speed, by the cubic through the four nearest. */
static void row_at(const double *gear, double speed, double *row)
{
    const double *rows = gear + LIMITS;
    const double place = (speed - gear[0]) / (gear[2] - gear[0]) * (SPEEDS - 1);
    const int first = (int)fmin(fmax(floor(place) - 1.0, 0.0), SPEEDS - 4.0);
    const double t = place - first;
    const double weights[] = {
        -(t - 1.0) * (t - 2.0) * (t - 3.0) / 6.0,
        t * (t - 2.0) * (t - 3.0) / 2.0,
        -t * (t - 1.0) * (t - 3.0) / 2.0,
        t * (t - 1.0) * (t - 2.0) / 6.0,
    };
    for (int i = 0; i < ROW; i++) {
        row[i] = 0.0;
        for (int k = 0; k < 4; k++) {
            row[i] += weights[k] * rows[(first + k) * ROW + i];
        }
    }
}

static int64_t start(const double *data, const double *parameters, const double *inputs,
                     double *state)
{
    const double ripple = parameters[0], speed = parameters[1];
    const int wanted = (int)parameters[2];
    const int gear = wanted ? wanted : gear_for(data, speed);
    double row[ROW];
    if (gear == 0) {
        return NO_GEAR;
    }
    const double *limits = data + GEARS_AT + (gear - 1) * GEAR_SIZE;
    if (speed < limits[0] || speed > limits[2]) {
        return NO_GEAR;
    }
    row_at(limits, speed, row);
    memset(state, 0, MEMORY * sizeof *state);
    for (int i = 0; i < STATES; i++) {
        state[i] = row[i] + ripple * row[STATES + i];
    }
    memcpy(state + MEMORY, inputs, INPUTS * sizeof *inputs);
    state[GEAR_AT] = gear;
    state[ENGINE_AT] = row[2 * STATES];
    state[PINION_TORQUE] = row[2 * STATES + 1]; /* memory without effect before the first step */
    state[WHEEL_TORQUE] = row[2 * STATES + 2];
    state[PINION_AT] = row[2 * STATES + 3];
    return 0;
}

static void interval(int gear, const double **arguments, double **results)
{
    double work[WORK];
#define GEAR(n) gear == n ? gear_##n(arguments, results, NULL, work, 0) :
    (void)(ALL_GEARS 0);
#undef GEAR
}

/* An angle that is the same as in the last step is not connected: the speed continues it. */
static double angle_of(const double *inputs, const double *state, int input, int expected)
{
    const int continued = state[STARTED] != 0.0 && inputs[input] == state[MEMORY + input];
    return continued ? state[expected] : inputs[input];
}

static int64_t advance(double h, const double *parameters, const double *inputs, double *state)
{
    const int gear = (int)fmin(fmax(state[GEAR_AT], 0.0), GEARS + 1.0);
    const double motion[] = {fmax(h, SHORTEST_STEP), angle_of(inputs, state, 0, PINION_ANGLE),
                             inputs[1], angle_of(inputs, state, 2, WHEEL_ANGLE), inputs[3]};
    const double settings[] = {inputs[4], state[ENGINE_AT], parameters[0]};
    const double *arguments[] = {state, motion, settings};
    double next[MEMORY], torques[3];
    double *results[] = {next, torques};
    if (gear < 1 || gear > GEARS) {
        return NO_GEAR;
    }
    interval(gear, arguments, results);
    const double sum = torques[0] + torques[1] + torques[2];
    if (sum - sum != 0.0) {
        return NOT_FINITE;
    }
    memcpy(state, next, sizeof next);
    memcpy(state + MEMORY, inputs, INPUTS * sizeof *inputs);
    return 0;
}

/* A step in parts that the integration resolves; angles are continued, torques are means over all. */
static int64_t advance_in_parts(double h, const double *parameters, const double *inputs,
                                double *state)
{
    const int parts = (int)fmax(ceil(h / LONGEST_PART), 1.0);
    double next[STATE_SIZE], pinion = 0.0, wheel = 0.0;
    memcpy(next, state, sizeof next);
    for (int part = 0; part < parts; part++) {
        const int64_t status = advance(h / parts, parameters, inputs, next);
        if (status != 0) {
            return status;
        }
        pinion += next[PINION_TORQUE];
        wheel += next[WHEEL_TORQUE];
    }
    next[PINION_TORQUE] = pinion / parts;
    next[WHEEL_TORQUE] = wheel / parts;
    memcpy(state, next, sizeof next);
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
        status = start(data, parameters, inputs, state);
    }
    if (operation == GL_STEP) {
        status = advance_in_parts(step, parameters, inputs, state);
    }
    if (status == 0 && operation != GL_RESUME) {
        write_outputs(state, work, outputs);
    }
    return status;
}
