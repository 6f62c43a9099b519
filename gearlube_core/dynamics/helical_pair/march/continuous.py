"""The pair as differential equations with events, for any integrator: model exchange.

The continuous states are the first N_CONTINUOUS of the state vector. What else the future depends
on, the coefficients of friction and when they were computed, changes at events alone: there
`refresh_friction` does what it does between the steps of `integrate.advance`.
"""

from __future__ import annotations

import math

from gearlube_core.arrays import Array
from gearlube_core.dynamics.helical_pair.march.flanks import (
    N_FRICTION,
    MarchConstants,
    coast_deepest,
    deepest,
    drive_view,
)
from gearlube_core.dynamics.helical_pair.march.jumps import LOAD_FILTER_TIME
from gearlube_core.dynamics.helical_pair.march.line_points import refresh_friction
from gearlube_core.dynamics.helical_pair.march.mesh_data import (
    LEAST_OFFSET,
    MeshFields,
    laws_of_oil,
    mesh_at_torque,
)
from gearlube_core.dynamics.helical_pair.march.state import (
    LOAD_TORQUE,
    N_ODE,
    REFRESHED,
    pair_motion,
)
from gearlube_core.kernels.array_part import part
from gearlube_core.kernels.flat_tuples import tuple_from_array
from gearlube_core.kernels.jit import kernel
from gearlube_core.oil.lubricant import lubricant_state

# outputs that hold the continuous states, in the order of the state vector
STATE_NAMES: tuple[str, ...] = (
    "mesh.rotation",
    "pinion.speed",
    "wheel.speed",
    "pinion.angle",
    "wheel.angle",
    *(
        f"{member}.{quantity}.{axis}"
        for translation, rotation in (("displacement", "tilt"), ("velocity", "tilt_speed"))
        for member in ("pinion", "wheel")
        for quantity, axes in ((translation, "xyz"), (rotation, "xy"))
        for axis in axes
    ),
    "energy.pinion_work",
    "energy.wheel_work",
    "energy.friction",
    "energy.mesh_damping",
    "energy.bearing_damping",
    "mesh.load_torque",
)
RATE_NAMES = tuple(f"der({name})" for name in STATE_NAMES)
EVENT_INDICATORS = ("event.drive_flank", "event.coast_flank", "event.friction_update")

_MICRO = 1.0e6  # um per m: numbers of order 1, which solvers with a tolerance for roots expect


@kernel
def write_rates(s: Array, rates: Array, pinion_torque: float, out: Array) -> None:
    """Write the rates of the continuous states into `out`, (N_CONTINUOUS,); SI.

    Parameters
    ----------
    s : ndarray of shape (N_STATE,)
    rates : ndarray of shape (N_ODE,)
        Of the integrated states, as `march_rates` writes them.
    pinion_torque : float
        [N.m]; the load level follows it with LOAD_FILTER_TIME.
    """
    for i in range(N_ODE):
        out[i] = rates[i]
    out[LOAD_TORQUE] = (abs(pinion_torque) - s[LOAD_TORQUE]) / LOAD_FILTER_TIME


@kernel
def write_event_indicators(s: Array, data: Array, p: MarchConstants, out: Array) -> None:
    """Write what changes its sign where `refresh_friction` has to do, as EVENT_INDICATORS.

    Bounds of the deflection of both flanks [um], and the sine of pi times the updates since phase
    zero, which is 1 without friction of the film. `data` are the pair data.
    """
    flanks = p.motion.flanks
    m = pair_motion(s)
    drive = drive_view(m, flanks)
    out[0] = deepest(drive, data[LEAST_OFFSET], flanks) * _MICRO
    out[1] = coast_deepest(m, data[LEAST_OFFSET], flanks) * _MICRO
    out[2] = 1.0
    if p.friction_form > 0.0:
        out[2] = math.sin(math.pi * drive.phase * p.refreshes)


@kernel
def event(s: Array, oil_temperature: float, mesh: MeshFields, data: Array) -> None:
    """Compute the friction of the film anew if that is due.

    Parameters
    ----------
    s : ndarray of shape (N_STATE,)
        Changed at MU and REFRESHED, if at all.
    oil_temperature : float
        [K]
    mesh, data
        As in `integrate.advance`.
    """
    p: MarchConstants = tuple_from_array(data, MarchConstants)
    if p.friction_form > 0.0:
        mesh_at_torque(s[LOAD_TORQUE], mesh, data)
        oil = lubricant_state(p.oil, oil_temperature, laws_of_oil(*mesh))
        refresh_friction(pair_motion(s), part(s, REFRESHED, N_FRICTION), data, oil)
