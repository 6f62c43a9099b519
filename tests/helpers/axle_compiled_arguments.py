"""Arguments of the kernels of the axle that are compiled for its bearing and friction law."""

from numpy import array, zeros

from gearlube_core.bearings.parameters import ROLLERS_MAX
from gearlube_core.bearings.tapered_roller_kernels import TaperedRollerParameters
from gearlube_core.dynamics.hypoid_axle.communication import axle_kernels
from gearlube_core.dynamics.hypoid_axle.model import START_WORK
from gearlube_core.dynamics.hypoid_axle.output_names import N_OUTPUTS
from gearlube_core.dynamics.hypoid_axle.state import N_STATE
from gearlube_core.friction.flank_laws import MixedFlankFriction
from gearlube_core.kernels.flat_tuples import flatten
from tests.helpers.axle_cases import OIL

COMPILED = axle_kernels(TaperedRollerParameters, MixedFlankFriction)


def compiled_cases(state, torques, table, both_sides, p, lossless, control, work, crossed):
    """Kernels with arguments, from those that `axle_kernel_arguments` has made."""
    inputs_now = array([*torques, OIL])
    return [
        (
            COMPILED.static_state,
            (zeros(N_STATE), 145.0, inputs_now, tuple(table), flatten(lossless), zeros(START_WORK)),
        ),
        (
            COMPILED.step_control,
            (
                state, 64.0, 22.0, inputs_now, tuple(table), flatten(lossless), zeros(START_WORK),
                zeros(5),
            ),
        ),
        (
            COMPILED.derivatives,
            (state, 0.0, 60.0, OIL, tuple(table), flatten(p), zeros(START_WORK), zeros(64)),
        ),
        (
            COMPILED.communication_step,
            (
                state, zeros(N_STATE), 1e-4, array([*torques, OIL]), tuple(table), flatten(p),
                flatten(control), work, zeros(ROLLERS_MAX), zeros(N_OUTPUTS),
            ),
        ),
        (
            COMPILED.step_without_outputs,
            (
                state, zeros(N_STATE), 1e-4, array([*torques, OIL]), tuple(table), flatten(p),
                flatten(control), work,
            ),
        ),
        (
            COMPILED.continuous_rates,
            (state, array([*torques, OIL]), tuple(table), flatten(p), work, zeros(N_OUTPUTS)),
        ),
        (COMPILED.event, (crossed, tuple(both_sides), flatten(p), work)),
        (
            COMPILED.motion_outputs,
            (state, tuple(table), flatten(p), work, zeros(N_OUTPUTS)),
        ),
        *(
            (
                COMPILED.group_outputs,
                (
                    group, state, array([*torques, OIL]), tuple(table), flatten(p), work,
                    zeros(ROLLERS_MAX), zeros(N_OUTPUTS),
                ),
            )
            for group in range(3)
        ),
        (
            COMPILED.outputs,
            (
                state, array([*torques, OIL]), tuple(table), flatten(p), work,
                zeros(ROLLERS_MAX), zeros(N_OUTPUTS),
            ),
        ),
    ]  # fmt: skip
