"""Parameters of the helical pair for its kernels: floats, and the arrays of the mesh."""

from __future__ import annotations

from typing import NamedTuple

from gearlube_core.arrays import Array
from gearlube_core.helical_geometry.contact_line import ContactPlane

# generalised coordinates: three translations and three rotations of pinion, then gear
COORDINATES = (
    "u_xp", "u_yp", "u_zp", "th_xp", "th_yp", "th_zp",
    "u_xg", "u_yg", "u_zg", "th_xg", "th_yg", "th_zg",
)  # fmt: skip
N_COORDINATES = 12
SIX_DOF = ("u_xp", "u_yp", "th_zp", "u_xg", "u_yg", "th_zg")


class PairConstants(NamedTuple):
    """Constants of one pair; built by `HelicalPairParameters.kernel_parameters`."""

    plane: ContactPlane
    m_p: float  # kg
    J_p: float  # diametral [kg m2]
    J_zp: float  # polar [kg m2]
    m_g: float
    J_g: float
    J_zg: float
    m_e: float  # 1/m_e = r_bp^2/J_zp + r_bg^2/J_zg [kg]
    zeta_mesh: float  # damping ratio of the mesh [-]
    T_p: float  # mean driving torque [N.m]
    T_g: float  # T_p r_bg/r_bp [N.m]
    backlash: float  # normal [m]
    one_sided: float  # 1: flanks separate and may touch at the back; 0: linear springs
    mesh_sign: float  # +1; -1 as printed in [he_2007 (4)]


class MeshArrays(NamedTuple):
    """Contact lines at one torque."""

    density: Array  # k, shape (phases, lines, stations) [N/m2]
    offset: Array  # e, same shape [m]
    station: Array  # from 0 to 1 along the line, both included [-]


class SupportArrays(NamedTuple):
    """Supports of both members, and the motions that are free."""

    stiffness: Array  # shape (2, 6, 6)
    damping: Array  # shape (2, 6)
    free: Array  # 1 or 0 per coordinate, shape (12,)
