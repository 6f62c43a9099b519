"""The axle as differential equations with events, for any integrator: model exchange.

The continuous states are the first N_CONTINUOUS of the state vector; the side of the mesh data is
the only other thing that the future depends on, and changes at events alone.
"""

from __future__ import annotations

from gearlube_core.arrays import Array
from gearlube_core.dynamics.hypoid_axle.rhs import follow_flank_of, mesh_motion
from gearlube_core.dynamics.hypoid_axle.state import (
    LOAD_TORQUE,
    N_CONTINUOUS,
    N_ODE,
    PHI_P,
    SIDE,
    U_G,
    U_P,
    UM,
    X,
)
from gearlube_core.dynamics.hypoid_mesh.mesh_at_load import (
    MeshAtLoad,
    MeshLevels,
    blend_mesh,
    gap_rotation,
    place_at_load,
    series_size,
)
from gearlube_core.dynamics.hypoid_mesh.mesh_force import MeshForceConstants
from gearlube_core.dynamics.hypoid_mesh.step_parts import LOAD_FILTER_TIME, MICRO
from gearlube_core.kernels.jit import kernel
from gearlube_core.mesh_table.kernels import mesh_series

# outputs that hold the continuous states, in the order of the state vector
STATE_NAMES: tuple[str, ...] = (
    "mesh.dte",
    "pinion.speed",
    "wheel.speed",
    "pinion.angle",
    "wheel.angle",
    *(
        f"{member}.{quantity}.{axis}"
        for member in ("pinion", "wheel")
        for quantity in ("displacement", "velocity")
        for axis in "xyz"
    ),
    "bearing[1].cage.angle",
    "bearing[3].cage.angle",
    "energy.pinion_work",
    "energy.wheel_work",
    "energy.friction_viscous",
    "energy.friction_boundary",
    "energy.mesh_damping",
    "energy.bearing_damping",
    "energy.bearing_torque",
    "energy.churning",
    "energy.seals",
    "energy.friction_rolling",
    "mesh.load_torque",
)
RATE_NAMES = tuple(f"der({name})" for name in STATE_NAMES)
# in micrometres: numbers of order 1, which solvers with a tolerance for roots expect
EVENT_INDICATORS = ("event.drive_flank", "event.coast_flank", "event.side")

_IN_MICROMETRES = (X, U_P, U_P + 1, U_P + 2, U_G, U_G + 1, U_G + 2)
UNITS_OF_STATES = tuple(UM if i in _IN_MICROMETRES else 1.0 for i in range(N_CONTINUOUS))  # in SI


@kernel
def write_rates(s: Array, rates: Array, pinion_torque: float, out: Array) -> None:
    """Write the rates of the continuous states in SI units into `out`, (N_CONTINUOUS,).

    Parameters
    ----------
    s : ndarray of shape (N_STATE,)
    rates : ndarray of shape (N_ODE,)
        Of the integrated states, as `axle_rhs` writes them.
    pinion_torque : float
        [N.m]; the load level follows it with LOAD_FILTER_TIME.
    """
    for i in range(N_ODE):
        out[i] = rates[i]
    out[X] *= UM
    for i in range(3):
        out[U_P + i] *= UM
        out[U_G + i] *= UM
    out[LOAD_TORQUE] = (abs(pinion_torque) - s[LOAD_TORQUE]) / LOAD_FILTER_TIME


@kernel
def write_event_indicators(
    s: Array, table: MeshLevels, mesh: MeshAtLoad, p: MeshForceConstants, out: Array
) -> None:
    """Write what changes its sign at an event into `out`, in the order of EVENT_INDICATORS [um].

    The drive flanks touch at 0 and above, the coast flanks at 0 and below; the third passes 0
    where `follow_flank` changes the side of the mesh data, and is 1 if there is one side only.
    """
    out[0] = s[X]
    out[1] = s[X] + p.backlash * MICRO
    out[2] = 1.0
    if table.levels[0] < 0.0:
        m = mesh_series(mesh.series, mesh.n_orders, p.z_p, s[PHI_P])
        out[2] = gap_rotation(mesh_motion(s), m, p, mesh.series, mesh.n_orders) * MICRO


@kernel
def change_side(s: Array, table: MeshLevels, p: MeshForceConstants, work: Array) -> None:
    """Do what `follow_flank` does, at the present load.

    Parameters
    ----------
    s : ndarray of shape (N_STATE,)
        Changed at X and SIDE, if at all.
    work : ndarray of shape (work_size(series_size(table), n_nodes),)
    """
    if table.levels[0] < 0.0:
        at_window = series_size(table)
        mesh = place_at_load(table, work[0:at_window], work[at_window:])
        blend_mesh(s[LOAD_TORQUE], s[SIDE], table, mesh)
        follow_flank_of(s, s[LOAD_TORQUE], table, p, mesh)
