"""Lines of action of gears from few numbers, by one formula for spur to hypoid gears; phases.

At the mean point of a gear's pitch cone, in the axes of its body: e_t along the rotation about +z,
e_l along the cone away from its apex, e_n = e_t x e_l outwards. With helix angle b, sigma = 1 of a
right hand, and s = 1 where it pushes with rotation about +z, gear 1 pushes gear 2 along

    n = s cos(a_n) [cos(b) e_t - sigma sin(b) e_l] + sin(a_n) e_n

A cone angle of zero makes the cylinder of parallel axes.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.errors import ParameterError

Vector = Array  # shape (3,)


class PitchPoint(NamedTuple):
    """The mean point of contact of one gear, in the axes of its body."""

    place: Vector  # from the centre of the body [m]
    along_face: Vector  # unit vectors; of gear 1's pitch cone, away from its apex
    along_tooth: Vector
    drive: Vector  # normals of the flanks: how gear 1 pushes gear 2
    coast: Vector


class Gear(NamedTuple):
    """One gear at its pitch point."""

    radius: float  # mean, of the pitch circle [m]
    azimuth: float  # of the pitch point, from x towards y [rad]
    arm: float  # of the pitch point along z, from the centre of the body [m]
    helix_angle: float  # [rad]
    cone_angle: float = 0.0  # [rad]


def pitch_points(
    first: Gear,
    second: Gear,
    normal_pressure_angle: float,
    *,
    right_hand: bool,
    forward: bool = True,
    internal: bool = False,
) -> tuple[PitchPoint, PitchPoint]:
    """Return the pitch point of both gears, each in the axes of its own body.

    Parameters
    ----------
    first, second : Gear
        Gear 1 is external. Unlike helix angles cross the axes, or offset them, as of hypoid gears.
    normal_pressure_angle : float
        At the pitch point [rad].
    right_hand : bool
        Hand of gear 1; an external mate has the other one, a ring the same.
    forward : bool
        Whether the drive flank of gear 1 pushes with rotation about +z.
    internal : bool
        Whether gear 2 is a ring.

    Examples
    --------
    >>> gears = (Gear(0.03, at, 0.0, np.radians(20.0)) for at in (0.3, 0.3 + np.pi))
    >>> one, two = pitch_points(*gears, np.radians(20.0), right_hand=True)
    >>> one.drive.round(6), bool(np.allclose(one.drive, two.drive))
    (array([ 0.065793,  0.944657, -0.321394]), True)
    """
    sigma, s = 1.0 if right_hand else -1.0, 1.0 if forward else -1.0
    mate = 1.0 if internal else -1.0  # of gear 2 against gear 1: hand, and sense of the normals
    cos_n, sin_n = math.cos(normal_pressure_angle), math.sin(normal_pressure_angle)
    cos_f, sin_f = math.cos(first.helix_angle), sigma * math.sin(first.helix_angle)
    found = []
    for gear, hand, sense in ((first, sigma, 1.0), (second, mate * sigma, mate)):
        e_t, e_l, e_n = _triad(gear)
        cos, sin = math.cos(gear.helix_angle), hand * math.sin(gear.helix_angle)
        across, outwards = sense * (cos * e_t - sin * e_l), sense * e_n
        tooth = cos * e_l + sin * e_t
        found.append(
            PitchPoint(
                _place(gear),
                cos_f * tooth - sin_f * across,
                tooth,
                s * cos_n * across + sin_n * outwards,
                -s * cos_n * across + sin_n * outwards,
            )
        )
    return found[0], found[1]


def _place(gear: Gear) -> Vector:
    c, s = math.cos(gear.azimuth), math.sin(gear.azimuth)
    return np.array([gear.radius * c, gear.radius * s, gear.arm])


def _triad(gear: Gear) -> tuple[Vector, Vector, Vector]:
    c, s = math.cos(gear.azimuth), math.sin(gear.azimuth)
    cos, sin = math.cos(gear.cone_angle), math.sin(gear.cone_angle)
    radial, axis = np.array([c, s, 0.0]), np.array([0.0, 0.0, 1.0])
    return np.array([-s, c, 0.0]), sin * radial + cos * axis, cos * radial - sin * axis


class Working(NamedTuple):
    """Angles of gears on parallel axes at their working pitch circles [rad], and the radii [m]."""

    pressure_angle: float  # normal
    helix_angle: float
    first_radius: float
    second_radius: float


def working_pitch(
    first_teeth: int,
    second_teeth: int,
    normal_module: float,
    normal_pressure_angle: float,
    helix_angle: float,
    centre_distance: float,
    *,
    internal: bool = False,
) -> Working:
    """Return what gears with profile shift have at the pitch point of their centre distance.

    cos(a_wt) = (r_b2 +- r_b1)/a, tan(b_w) = tan(b) r_w/r

    Raises
    ------
    ParameterError
        The base circles do not let the gears touch.

    Examples
    --------
    >>> # of the gearbox of [nejad_2016]
    >>> found = working_pitch(19, 17, 0.045, 0.349066, 0.0, 0.863)
    >>> round(float(np.degrees(found.pressure_angle)), 3), round(found.first_radius, 6)
    (28.118, 0.455472)
    """
    of_ring = -1.0 if internal else 1.0
    transverse = math.atan(math.tan(normal_pressure_angle) / math.cos(helix_angle))
    module = normal_module / math.cos(helix_angle)
    reference = 0.5 * module * (second_teeth + of_ring * first_teeth)
    cos = reference * math.cos(transverse) / centre_distance
    if not 0.5 < cos < 0.999:
        raise ParameterError(
            f"centre_distance must be near {1e3 * reference:.6g} mm, that of these teeth, and "
            f"above {1e3 * reference * math.cos(transverse):.6g} mm, where the base circles touch; "
            f"got {1e3 * centre_distance:.6g} mm. Correct teeth, module or distance."
        )
    stretch = centre_distance / reference
    helix = math.atan(math.tan(helix_angle) * stretch)
    half = 0.5 * module * stretch
    normal = math.atan(math.tan(math.acos(cos)) * math.cos(helix))
    return Working(normal, helix, half * first_teeth, half * second_teeth)


def contact_ratio(
    first: Gear,
    second: Gear,
    normal_module: float,
    normal_pressure_angle: float,
    *,
    internal: bool = False,
) -> float:
    """Return the transverse contact ratio of teeth with addenda of one module [-].

    Bevel gears count as the cylindrical gears of their back cones.

    Examples
    --------
    >>> gears = Gear(0.05, 0.0, 0.0, 0.0), Gear(0.1, np.pi, 0.0, 0.0)
    >>> round(contact_ratio(*gears, 0.005, 0.349066), 3)  # 20 and 40 teeth
    1.635
    """
    of_ring = -1.0 if internal else 1.0
    angle = math.atan(math.tan(normal_pressure_angle) / math.cos(first.helix_angle))
    module = normal_module / math.cos(first.helix_angle)
    length = 0.0
    for gear, sign in ((first, 1.0), (second, of_ring)):
        radius = gear.radius / math.cos(gear.cone_angle)
        tip, base = radius + sign * normal_module, radius * math.cos(angle)
        reached = math.sqrt(max(tip * tip - base * base, 0.0)) - radius * math.sin(angle)
        length += sign * reached
    return length / (math.pi * module * math.cos(angle))


def fitting_angle(
    first_teeth: int,
    second_teeth: int,
    first_angle: float,
    azimuth: float,
    *,
    internal: bool = False,
    second_azimuth: float | None = None,
) -> float:
    """Return the angle of a tooth of gear 2 [rad], below one pitch, where it meshes with gear 1.

    A tooth of gear 1 stands at `first_angle`; both from x towards y, at the start.

    Examples
    --------
    >>> fitting_angle(20, 40, 0.0, 0.0) * 40 / np.pi  # a gap meets the tooth: half a pitch off
    1.0
    """
    if second_azimuth is None:
        second_azimuth = azimuth if internal else azimuth + math.pi
    sense = 1.0 if internal else -1.0
    cycles = sense * first_teeth * (first_angle - azimuth) / (2.0 * math.pi) + 0.5
    pitch = 2.0 * math.pi / second_teeth
    return (second_azimuth + cycles * pitch) % pitch


def split_delay(teeth: int, first_azimuth: float, second_azimuth: float) -> float:
    """Return by how many mesh cycles a gear's second mesh follows its first one, 0 to 1.

    The gear turns about +z and drives both, or is driven by both. With a sun these are the phases
    of its planets, [parker_lin_2004].

    Examples
    --------
    >>> round(split_delay(17, 0.0, np.pi / 2), 12)
    0.25
    """
    return (teeth * (second_azimuth - first_azimuth) / (2.0 * math.pi)) % 1.0


def idler_delay(
    teeth: int, driven_azimuth: float, driving_azimuth: float, thickness: float = 0.5
) -> float:
    """Return by how many mesh cycles the mesh that an idler drives follows the one that drives it.

    It turns about +z. `thickness` is that of its teeth over the pitch, on the working circle [-].

    Examples
    --------
    >>> [round(idler_delay(z, 0.0, np.pi), 9) % 1.0 for z in (31, 30)]  # planets in a ring
    [0.0, 0.5]
    """
    return (split_delay(teeth, driven_azimuth, driving_azimuth) - thickness) % 1.0


def planets_fit(
    sun_teeth: int, ring_teeth: int, azimuths: tuple[float, ...], within: float = 0.01
) -> bool:
    """Return whether all planets can be put between sun and ring, to a share of a mesh cycle.

    Examples
    --------
    >>> planets_fit(19, 56, (0.0, 2 * np.pi / 3, 4 * np.pi / 3)), planets_fit(19, 56, (0.0, np.pi))
    (True, False)
    """
    cycles = [(sun_teeth + ring_teeth) * (one - azimuths[0]) / (2.0 * math.pi) for one in azimuths]
    return all(abs(one - round(one)) <= within for one in cycles)


def excited_modes(sun_teeth: int, planets: int, harmonic: int) -> str:
    """Return which modes a harmonic of the mesh excites in a set of equal planets, equally spaced.

    "rotational", "translational" or "planet": (l z_s) mod N is 0, 1 or N - 1, or another number.
    Source: [parker_lin_2004].

    Examples
    --------
    >>> [excited_modes(27, 4, harmonic) for harmonic in (1, 2, 3, 4)]
    ['translational', 'planet', 'translational', 'rotational']
    """
    left = harmonic * sun_teeth % planets
    if left == 0:
        return "rotational"
    return "translational" if left in (1, planets - 1) else "planet"
