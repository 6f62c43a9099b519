"""One stiffness along the contact lines of a pair, from ISO 6336-1."""

from __future__ import annotations

import math

from gearlube_core.helical_geometry.iso_6336_stiffness import iso_stiffness
from gearlube_core.helical_geometry.pair import HelicalPair

_RACK_DEDENDUM = 1.2  # h_fP/m_n, whose factor in C_B is one


def iso_mesh_stiffness(pair: HelicalPair, pinion_torque: float) -> tuple[float, tuple[str, ...]]:
    """Return the mean mesh stiffness along the line of action [N/m], and limits it exceeds.

    Parameters
    ----------
    pair : HelicalPair
    pinion_torque : float
        [N.m]; below 100 N per mm of face width the teeth count as softer.

    Notes
    -----
    c_gamma_alpha W, with the basic rack's dedendum of 1.2 modules and solid discs; see
    `iso_stiffness` for the range of the fit.
    """
    load = pinion_torque / pair.pinion_base_radius / pair.face_width
    found = iso_stiffness(pair, line_load=load, rack_dedendum=_RACK_DEDENDUM)
    return found.mesh * pair.face_width, found.outside


def iso_density(pair: HelicalPair, pinion_torque: float) -> float:
    """Return the stiffness per length of contact line [N/m2] that ISO 6336-1 implies.

    k = c_gamma_alpha W/(L_mean cos(b)^2)

    Notes
    -----
    c_gamma_alpha is felt along the line of action, k normal to the flanks.
    """
    normal = math.cos(pair.base_helix_angle) ** 2
    return iso_mesh_stiffness(pair, pinion_torque)[0] / (pair.mean_contact_length * normal)
