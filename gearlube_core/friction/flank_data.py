"""Input and output data of the friction of one flank."""

from __future__ import annotations

from typing import NamedTuple

from gearlube_core.contact.hertz import hertz_coefficients
from gearlube_core.film.point_film import film_geometry
from gearlube_core.kernels.jit import kernel

CONSISTENT = 0
AS_PRINTED = 1
PRINTED_TRACTION = 2  # traction as printed, everything else consistent
ZHOU_HOEPRICH_SHARE = 3  # asperities carry a share of any load that the film ratio alone sets


class ContactGeometry(NamedTuple):
    """Geometry of a flank contact at one position of mesh; all floats, SI."""

    R_e: float  # relative radius of curvature along entrainment [m]
    side_flow: float  # side-flow factor of the central film [-]
    pressure_coefficient: float  # mean Hertz pressure over load^(1/3) [Pa/N^(1/3)]


class FlankState(NamedTuple):
    """Film and friction of one flank contact; all floats, SI, no negative number."""

    film_thickness: float  # central film [m]
    film_ratio: float  # film over composite roughness [-]
    viscous_friction: float  # [N]
    boundary_friction: float  # [N]
    friction_coefficient: float  # total friction over load [-]
    temperature_rise: float  # mean of the film over the oil [K]
    mean_pressure: float  # [Pa]


@kernel
def contact_geometry(R_x: float, R_y: float, psi: float, contact_modulus: float) -> ContactGeometry:
    """Return the geometry numbers of a contact from its radii and direction of entrainment.

    Parameters
    ----------
    R_x, R_y
        Relative principal radii of curvature along the minor and major axis, R_x <= R_y [m].
    psi
        Angle between entrainment and the minor axis [rad].
    contact_modulus
        E* [Pa].

    Returns
    -------
    ContactGeometry
        Evaluate once per contact position.

    Notes
    -----
    Range and source as in `hertz_coefficients` and `film_geometry`.
    """
    R_e, side_flow = film_geometry(R_x, R_y, psi)
    pressure_coefficient = hertz_coefficients(R_x, R_y, contact_modulus)[2]
    return ContactGeometry(R_e, side_flow, pressure_coefficient)
