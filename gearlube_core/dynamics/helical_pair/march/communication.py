"""One communication step as a single kernel: advance a copy, keep it if sound, write outputs."""

from __future__ import annotations

from gearlube_core.arrays import Array
from gearlube_core.dynamics.helical_pair.march.integrate import OK, advance
from gearlube_core.dynamics.helical_pair.march.mesh_data import MeshFields
from gearlube_core.dynamics.helical_pair.march.outputs import write_outputs
from gearlube_core.dynamics.helical_pair.march.state import N_STATE
from gearlube_core.kernels.jit import kernel


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
    status = advance(trial, duration, inputs, mesh, data, control, work)
    if status == OK:
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
