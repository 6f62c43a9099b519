"""Forces of drive and coast flanks on both members, and the heat of their friction: kernels."""

from __future__ import annotations

from gearlube_core.arrays import Array
from gearlube_core.dynamics.helical_pair.march.flank_views import FlankConstants, turned
from gearlube_core.dynamics.helical_pair.march.line_sums import LineSums
from gearlube_core.dynamics.helical_pair.march.state import (
    OM_G,
    OM_P,
    V_G,
    V_P,
    W_G,
    W_P,
)
from gearlube_core.dynamics.helical_pair.mesh.mesh_wrench import Wrench, mesh_wrench
from gearlube_core.helical_geometry.contact_line import ContactPlane
from gearlube_core.kernels.jit import kernel


@kernel
def flank_wrench(sums: LineSums, direction: float, plane: ContactPlane) -> Wrench:
    """Return forces and moments of one flank in its own frame.

    Parameters
    ----------
    direction
        +1 where the pinion turns about -z of this frame, -1 the other way, between at rest.
    """
    along = plane.sin_b * sums.Nx + plane.cos_b * sums.Nz
    return mesh_wrench(
        sums.N, along, direction * sums.F, direction * sums.Fx, direction * sums.Fz, plane
    )


@kernel
def turned_wrench(w: Wrench, p: FlankConstants) -> Wrench:
    """Return the wrench of the coast flanks' frame in that of the pair."""
    F_x, F_y = turned(w.F_x, w.F_y, p)
    M_px, M_py = turned(w.M_px, w.M_py, p)
    M_gx, M_gy = turned(w.M_gx, w.M_gy, p)
    return Wrench(F_x, F_y, -w.F_z, M_px, M_py, -w.M_pz, M_gx, M_gy, -w.M_gz)


@kernel
def friction_heat(sums: LineSums, direction: float, s: Array, p: FlankConstants) -> float:
    """Return the heat of the drive flanks' friction [W], with the true velocities."""
    rate = sums.F * (s[V_P + 1] - s[V_G + 1] + p.plane.x_g * s[W_G])
    rate -= sums.Fz * (s[OM_P] - s[OM_G]) + sums.Fx * (s[W_P] + s[W_G])
    return -direction * rate


@kernel
def turned_friction_heat(sums: LineSums, direction: float, s: Array, p: FlankConstants) -> float:
    """Return the heat of the coast flanks' friction [W]."""
    _, v_p = turned(s[V_P], s[V_P + 1], p)
    _, v_g = turned(s[V_G], s[V_G + 1], p)
    om_p, _ = turned(s[OM_P], s[OM_P + 1], p)
    om_g, _ = turned(s[OM_G], s[OM_G + 1], p)
    rate = sums.F * (v_p - v_g - p.plane.x_g * s[W_G])
    rate -= sums.Fz * (om_p - om_g) - sums.Fx * (s[W_P] + s[W_G])
    return -direction * rate
