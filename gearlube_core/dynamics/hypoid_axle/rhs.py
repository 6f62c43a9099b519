"""Right-hand side of the 8-DOF hypoid axle with dynamic roller bearings."""

from __future__ import annotations

from typing import NamedTuple

from numpy import float64
from numpy.typing import NDArray

from gearlube_core.bearings.shaft_forces import shaft_bearing_forces
from gearlube_core.dynamics.hypoid_axle.flanks import flank_sum
from gearlube_core.dynamics.hypoid_axle.kernel_parameters import AxleParameters
from gearlube_core.dynamics.hypoid_axle.mesh_force import mesh_force, reference_frequency
from gearlube_core.dynamics.hypoid_axle.state import (
    BEARING_DAMPING,
    BEARING_TORQUE,
    BOUNDARY,
    CAGE_G,
    CAGE_P,
    MESH_DAMPING,
    MICRO,
    PHI_G,
    PHI_P,
    PINION_WORK,
    U_G,
    U_P,
    V_G,
    V_P,
    VISCOUS,
    W_G,
    W_P,
    WHEEL_WORK,
    X,
)
from gearlube_core.dynamics.packed_mesh import N_CHANNELS
from gearlube_core.jit import kernel
from gearlube_core.mesh_table.table import PAIRS
from gearlube_core.rheology.lubricant_state import LubricantState

N_FRICTION = 2 * PAIRS
SCRATCH = N_FRICTION + N_CHANNELS


class StepInputs(NamedTuple):
    """What is constant over one integrator step."""

    pinion_torque: float  # N.m
    wheel_torque: float  # N.m
    drag_p: float  # drag torque of both pinion bearings [N.m]
    drag_g: float  # ditto of the gear's


@kernel
def axle_rhs(
    s: NDArray[float64],
    inputs: StepInputs,
    series: NDArray[float64],
    n_orders: int,
    window: NDArray[float64],
    n_nodes: int,
    oil: LubricantState,
    p: AxleParameters,
    refresh: bool,
    scratch: NDArray[float64],
    ds: NDArray[float64],
) -> float:
    """Write ds/dt of the N_ODE integrated states into `ds`; return the mesh force [N].

    I_p w_p' = T_p - R_p F + T_fr,p ; I_g w_g' = -T_g + R_g F + T_fr,g
    m_p u_p'' = -n F - f xi + F_b,p ; m_g u_g'' = +n F + f xi + F_b,g

    Parameters
    ----------
    s, ds : ndarray of shape (N_STATE,), (N_ODE,)
    inputs : StepInputs
    series, n_orders, window, n_nodes
        The mesh table at the present load, see `mesh_table.kernels`.
    oil : LubricantState
    p : AxleParameters
    refresh : bool
        Evaluate films and tractions anew, see `flank_sum`.
    scratch : ndarray of shape (SCRATCH,)
        Friction coefficients kept between calls, and work space.

    Notes
    -----
    The printed eq. (1) c-h has the opposite sign of n F to the one that eq. (2) implies, and no
    flank friction in the lateral equations: p.lateral_sign = -1, p.consistent = 0. The moment that
    the loaded rollers exert on the orbiting cage is carried by its shaft in the consistent form;
    the paper has none, and its rollers then do work on nothing.

    References
    ----------
    Mohammadpour et al. 2015, eq. (1), (2), (6), (24).
    """
    mesh = mesh_force(s, series, n_orders, p)
    friction = flank_sum(
        s,
        mesh.force,
        window,
        n_nodes,
        oil,
        p,
        refresh,
        scratch[0:N_FRICTION],
        scratch[N_FRICTION:SCRATCH],
    )
    w_p = s[W_P]
    w_g = s[W_G]
    f_ref = reference_frequency(p, w_p)

    # pinion shaft along x: r1 = z, r2 = y turns with the pinion, which drives about -x
    p1z, p1y, p1x, p2z, p2y, p2x, lost_p = shaft_bearing_forces(
        s[U_P + 2] / MICRO,
        s[U_P + 1] / MICRO,
        s[U_P] / MICRO,
        s[V_P + 2],
        s[V_P + 1],
        s[V_P],
        s[CAGE_P],
        w_p,
        f_ref,
        oil.eta0,
        oil.alpha,
        p.bearing_p,
    )
    g1x, g1y, g1z, g2x, g2y, g2z, lost_g = shaft_bearing_forces(
        s[U_G] / MICRO,
        s[U_G + 1] / MICRO,
        s[U_G + 2] / MICRO,
        s[V_G],
        s[V_G + 1],
        s[V_G + 2],
        s[CAGE_G],
        w_g,
        f_ref,
        oil.eta0,
        oil.alpha,
        p.bearing_g,
    )
    cage_p = ((p1z + p2z) * s[U_P + 1] - (p1y + p2y) * s[U_P + 2]) / MICRO
    cage_g = ((g1x + g2x) * s[U_G + 1] - (g1y + g2y) * s[U_G]) / MICRO
    shared = p.consistent
    on_shaft_p = shared * p.bearing_p.cage_ratio * cage_p - inputs.drag_p
    on_shaft_g = shared * p.bearing_g.cage_ratio * cage_g - inputs.drag_g

    ds[X] = mesh.x_rate * MICRO
    ds[W_P] = (inputs.pinion_torque + mesh.torque_p + friction.torque_p + on_shaft_p) / p.I_p
    ds[W_G] = (-inputs.wheel_torque + mesh.torque_g + friction.torque_g + on_shaft_g) / p.I_g
    ds[PHI_P] = w_p
    ds[PHI_G] = w_g
    lateral = p.lateral_sign * mesh.force
    ds[V_P] = (-mesh.n_x * lateral + shared * friction.f_x + p1x + p2x) / p.m_p
    ds[V_P + 1] = (-mesh.n_y * lateral + shared * friction.f_y + p1y + p2y) / p.m_p
    ds[V_P + 2] = (-mesh.n_z * lateral + shared * friction.f_z + p1z + p2z) / p.m_p
    ds[V_G] = (mesh.n_x * lateral - shared * friction.f_x + g1x + g2x) / p.m_g
    ds[V_G + 1] = (mesh.n_y * lateral - shared * friction.f_y + g1y + g2y) / p.m_g
    ds[V_G + 2] = (mesh.n_z * lateral - shared * friction.f_z + g1z + g2z) / p.m_g
    for i in range(3):
        ds[U_P + i] = s[V_P + i] * MICRO
        ds[U_G + i] = s[V_G + i] * MICRO
    ds[CAGE_P] = p.bearing_p.cage_ratio * w_p
    ds[CAGE_G] = p.bearing_g.cage_ratio * w_g
    ds[PINION_WORK] = inputs.pinion_torque * w_p
    ds[WHEEL_WORK] = inputs.wheel_torque * w_g
    ds[VISCOUS] = friction.viscous_power
    ds[BOUNDARY] = friction.boundary_power
    ds[MESH_DAMPING] = mesh.damping_power
    ds[BEARING_DAMPING] = lost_p + lost_g
    ds[BEARING_TORQUE] = inputs.drag_p * w_p + inputs.drag_g * w_g
    return mesh.force
