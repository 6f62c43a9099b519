"""One communication step as a single kernel: advance a copy, keep it if sound, write outputs."""

from __future__ import annotations

from gearlube_core.arrays import Array
from gearlube_core.dynamics.helical_pair.march.integrate import (
    DIVERGED,
    NOT_FINITE,
    OK,
    TOO_FAST,
    advance,
)
from gearlube_core.dynamics.helical_pair.march.mesh_data import MeshFields
from gearlube_core.dynamics.helical_pair.march.outputs import write_outputs
from gearlube_core.dynamics.helical_pair.march.state import (
    N_ENERGIES,
    N_STATE,
    PHI_G,
    PHI_P,
    PINION_WORK,
    PSI,
    TIME_IN_STEP,
    W_G,
    W_P,
    WORK_MARK,
)
from gearlube_core.dynamics.mean_power import LEAST_WINDOW, keep_means
from gearlube_core.dynamics.ranges import MAX_ANGLE, MAX_SPEED, TOO_FAR
from gearlube_core.kernels.jit import kernel


@kernel
def state_status(s: Array) -> int:
    """Return OK, or why the model says nothing of a state: NOT_FINITE, TOO_FAST or TOO_FAR."""
    if not abs(s[PSI]) <= DIVERGED:
        return NOT_FINITE
    if not max(abs(s[W_P]), abs(s[W_G])) <= MAX_SPEED:
        return TOO_FAST
    angle = max(abs(s[PHI_P]), abs(s[PHI_G]))
    return OK if angle <= MAX_ANGLE else TOO_FAR


@kernel
def step_without_outputs(
    s: Array,
    trial: Array,
    duration: float,
    inputs: Array,
    mesh: MeshFields,
    data: Array,
    control: Array,
    work: Array,
) -> int:
    """Advance the pair by `duration` [s]; arguments and status as in `communication_step`."""
    for i in range(N_STATE):
        trial[i] = s[i]
    status = state_status(s)
    if status == OK:
        status = advance(trial, duration, inputs, mesh, data, control, work)
    if status == OK:
        status = state_status(trial)
    if status == OK:
        if duration < LEAST_WINDOW:
            keep_means(s, trial, PINION_WORK, WORK_MARK, N_ENERGIES, TIME_IN_STEP)
        for i in range(N_STATE):
            s[i] = trial[i]
    return status


@kernel
def communication_step(
    s: Array,
    trial: Array,
    duration: float,
    inputs: Array,
    mesh: MeshFields,
    data: Array,
    bearings: Array,
    control: Array,
    work: Array,
    out: Array,
) -> int:
    """Advance the pair by `duration` [s] and write its outputs; return a status.

    Parameters
    ----------
    s, trial : ndarray of shape (N_STATE,)
        State, unchanged when the status is not OK; work space.

    Others as in `advance` and `write_outputs`.
    """
    status = step_without_outputs(s, trial, duration, inputs, mesh, data, control, work)
    if status == OK:
        write_outputs(s, inputs, mesh, data, bearings, work, out)
    return status
