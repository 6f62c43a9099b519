"""The pair of He et al. 2007 with what the paper leaves out completed."""

from __future__ import annotations

from gearlube_core.dynamics.helical_pair.parameters import HelicalPairParameters
from gearlube_core.dynamics.helical_pair.shaft_support import symmetric_support
from gearlube_core.helical_geometry.contact_line import line_count
from gearlube_core.helical_geometry.pair import HelicalPair
from gearlube_core.helical_geometry.sample_pairs import named_pair
from gearlube_core.mesh_table.line_mesh import LineMesh, uniform_line_mesh

_INCH = 0.0254  # m
_POUND_FORCE = 4.4482216  # N
_MASS = _POUND_FORCE / _INCH  # kg per lbf s2/in
_INERTIA = _POUND_FORCE * _INCH  # kg m2 per lbf s2 in, and N.m per lbf in

# as printed, sec. 3 and 6
PINION_MASS, GEAR_MASS = 1.26e-2 * _MASS, 1.58e-2 * _MASS
PINION_POLAR_INERTIA, GEAR_POLAR_INERTIA = 8.33e-3 * _INERTIA, 1.64e-2 * _INERTIA
PINION_TORQUE = 2000.0 * _INERTIA
PINION_SPEED = 104.71975511965977  # rad/s, 1000 rpm

# completed: the paper has none of them
STIFFNESS_DENSITY = 1.316e10  # N/m2, from c_gamma_alpha of ISO 6336-1 over the mean line length
SUPPORT_STIFFNESS = 8e6 * _POUND_FORCE / _INCH  # N/m per member, so that resonances lie at n = 8-10
BEARING_DISTANCE = 2.0 * _INCH  # m
DAMPING_RATIO = 0.05  # the paper's "5 % damping ratios", for every motion


def he_2007_mesh(pair: HelicalPair, density: float = STIFFNESS_DENSITY) -> LineMesh:
    """Return one stiffness density [N/m2] along all contact lines of a pair."""
    return uniform_line_mesh(
        name=f"{pair.name}, constant density",
        source="He et al. 2007 eq. (2)",
        pinion_teeth=pair.pinion_teeth,
        gear_teeth=pair.gear_teeth,
        base_pitch=pair.base_pitch,
        lines=int(line_count(pair.plane)),
        density=density,
    )


def he_2007_pair(mu: float, pair: HelicalPair | None = None) -> HelicalPairParameters:
    """Return the NASA-ART pair at 2000 lbf in with a constant coefficient of friction.

    Parameters
    ----------
    mu
        [-]; 0.01 and 0.1 in the paper's figures.
    pair
        Another geometry with the same masses and supports, for instance of another helix angle.

    Notes
    -----
    Printed: teeth, masses, polar inertias, torque. Completed: stiffness density, supports,
    diametral inertias (solid discs), damping of rocking and mesh.
    """
    geometry = named_pair("he_2007") if pair is None else pair
    support = symmetric_support(
        K_xx=SUPPORT_STIFFNESS,
        K_yy=SUPPORT_STIFFNESS,
        K_zz=SUPPORT_STIFFNESS,
        distance=BEARING_DISTANCE,
    )
    disc = geometry.face_width**2 / 12.0
    return HelicalPairParameters(
        pair=geometry,
        mesh=he_2007_mesh(geometry),
        pinion_torque=PINION_TORQUE,
        pinion_mass=PINION_MASS,
        pinion_inertia=0.5 * PINION_POLAR_INERTIA + PINION_MASS * disc,
        pinion_polar_inertia=PINION_POLAR_INERTIA,
        gear_mass=GEAR_MASS,
        gear_inertia=0.5 * GEAR_POLAR_INERTIA + GEAR_MASS * disc,
        gear_polar_inertia=GEAR_POLAR_INERTIA,
        pinion_support=support,
        gear_support=support,
        support_damping_ratio=DAMPING_RATIO,
        mesh_damping_ratio=DAMPING_RATIO,
        friction="constant",
        friction_coefficient=mu,
    )
