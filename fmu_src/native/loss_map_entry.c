/* A loss map over speed, torque and oil temperature: linear between its points, held at its ends.

   data:       numbers of speeds, torques, temperatures and maps; limits of the inputs
   parameters: speeds [rad/s], torques [N.m], temperatures [K], then the values of each map [N.m], the last
               axis first
   work:       limits of the inputs, then the parameters
   state:      inputs of the last step in the order of the axes, and 1
   outputs:    a value for each map, power lost [W], sum of 1, 2 and 4 for each axis that is left */

#include <math.h>
#include <string.h>

#include "model.h"

enum { AXES = 3, LIMITS = 2 * AXES, NOT_RISING = 2 };

/* Writes the first point of the cell around x, and how far x lies in it; returns whether x is inside. */
static int place(const double *axis, int n, double x, int *first, double *part)
{
    *first = 0;
    while (*first < n - 2 && x > axis[*first + 1]) {
        ++*first;
    }
    const double low = axis[*first], high = axis[*first + 1];
    *part = fmin(fmax((x - low) / (high - low), 0.0), 1.0);
    return axis[0] <= x && x <= axis[n - 1];
}

static void write_outputs(const double *data, const double *state, const double *work,
                          double *outputs)
{
    const double *axis = work + LIMITS;
    const int n_maps = (int)data[AXES];
    int n[AXES], first[AXES], points = 1, left = 0;
    double part[AXES];
    for (int i = 0; i < AXES; i++) {
        n[i] = (int)data[i];
        left += place(axis, n[i], state[i], &first[i], &part[i]) ? 0 : 1 << i;
        axis += n[i];
        points *= n[i];
    }
    for (int map = 0; map < n_maps; map++, axis += points) {
        outputs[map] = 0.0;
        for (int corner = 0; corner < 1 << AXES; corner++) {
            double weight = 1.0;
            int at = 0;
            for (int i = 0; i < AXES; i++) {
                const int up = corner >> i & 1;
                weight *= up ? part[i] : 1.0 - part[i];
                at = at * n[i] + first[i] + up;
            }
            outputs[map] += weight * axis[at];
        }
    }
    outputs[n_maps] = outputs[0] * state[0];
    outputs[n_maps + 1] = left;
}

static int64_t begin(const double *data, const double *parameters, double *work)
{
    int size = 1, before = 0;
    memcpy(work, data + AXES + 1, LIMITS * sizeof *work);
    for (int i = 0; i < AXES; i++) {
        const int n = (int)data[i];
        for (int k = before + 1; k < before + n; k++) {
            if (parameters[k] <= parameters[k - 1]) {
                return NOT_RISING;
            }
        }
        before += n;
        size *= n;
    }
    memcpy(work + LIMITS, parameters, (size_t)(before + size * (int)data[AXES]) * sizeof *work);
    return 0;
}

int64_t gearlube_entry(int64_t operation, double step, const double *data,
                       const double *parameters, const double *inputs, double *state, double *work,
                       double *outputs)
{
    int64_t status = 0;
    (void)step;
    if (operation == GL_START || operation == GL_RESUME) {
        status = begin(data, parameters, work);
    }
    if (status == 0 && (operation == GL_START || operation == GL_STEP)) {
        memcpy(state, inputs, AXES * sizeof *state);
        state[AXES] = 1.0;
    }
    if (status == 0 && operation != GL_RESUME) {
        write_outputs(data, state, work, outputs);
    }
    return status;
}
