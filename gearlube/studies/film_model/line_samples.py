"""Line contacts of a training set: boxes of numbers, and what helical pairs and rollers visit."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from gearlube.studies.film_model.draws import (
    OIL_BOX,
    STEEL,
    Box,
    Drawn,
    Limits,
    drawn_eyring,
    log_uniform,
    numbers_of,
    oil_fits,
    oil_of_draw,
    oil_of_library,
    oil_temperatures,
    within,
)
from gearlube_core.arrays import Array
from gearlube_core.bearings.bearing_file import BearingFile
from gearlube_core.bearings.raceway_drag import line_radii
from gearlube_core.bearings.tapered_roller_bearing import TaperedRollerBearing
from gearlube_core.contact.hertz import line_mean_pressure
from gearlube_core.errors import ParameterError
from gearlube_core.film_model.line_contact import (
    LEAST_SLIDING,
    LineContact,
    line_contact_groups,
    line_parts,
)
from gearlube_core.film_model.reference_friction import film_resistance, line_reference_friction
from gearlube_core.film_model.rolling import RollerContact, rolling_groups, rolling_line
from gearlube_core.friction.line_points import line_points
from gearlube_core.helical_geometry.contact_line import line_kinematics
from gearlube_core.helical_geometry.gear_file import HelicalGearFile
from gearlube_core.oil.lubricant import Lubricant
from gearlube_core.units import rpm_to_rads

_E = STEEL.contact_modulus

# training goes a little farther
LINE_DOMAIN, LINE_TRAINED = (
    Limits(0.1e9, 2.2, 8.0, 4.8, 0.7, 150.0),
    Limits(0.09e9, 2.4, 8.5, 4.9, 0.6, 200.0),
)
_EDGE_THICKNESS = math.log(1.8)

# spur teeth of cars to truck axles, creep to top speed, and a margin
LINE_BOX: Box = {
    "mean pressure [GPa]": (1e-9 * LINE_TRAINED.least_pressure, 2.0, "log"),
    "slide-roll ratio and 0.003, root of squares": (LEAST_SLIDING, 1.3, "log"),
    "u [m/s]": (0.02, 30.0, "log"),
    "R [mm]": (2.0, 60.0, "log"),
    **OIL_BOX,
}

# N.m, of the papers
_TORQUES = {"he_2007": 226.0, "jamali_2015_a": 1060.0, "jamali_2015_b": 1060.0}
_USUAL_TORQUE = 300.0  # N.m, of other pairs
_TORQUE_SHARES = (0.05, 2.0)
_SPEEDS = (20.0, 12000.0)  # rpm of the pinion
_PHASES, _NODES = 24, 6  # of the points on the lines
_UNEVEN = (0.4, 1.6)  # load of a point over the mean of all lines
# training goes a little farther
ROLLER_DOMAIN, ROLLER_TRAINED = (
    Limits(0.1e9, 2.5, 5.0, 4.8, -0.5, math.inf),
    Limits(0.09e9, 2.75, 5.5, 4.9, -0.6, math.inf),
)
_ROLLER_EDGE_THICKNESS = math.log(1.5)  # from there on films change most from contact to contact

# rollers of cars to truck axles, creep to top speed, and a margin
ROLLER_BOX: Box = {
    "mean pressure [GPa]": (1e-9 * ROLLER_TRAINED.least_pressure, 2.0, "log"),
    "u [m/s]": (0.01, 25.0, "log"),
    "R [mm]": (1.5, 40.0, "log"),
    **OIL_BOX,
}

AXLE_BEARING = "mohammadpour_2015"


def line_fits(contact: LineContact, limits: Limits) -> bool:
    """Tell whether a contact lies within limits."""
    if not oil_fits(contact):
        return False
    groups, c = line_contact_groups(contact), contact
    p = line_mean_pressure(c.line_load, c.R, c.contact_modulus)
    inlet, half = line_parts(c)[1], 0.5 * c.line_load / p
    film = (half * math.exp(groups.thickness)) ** 2 / c.R
    u, slip = c.entrainment_speed, c.sliding_speed
    friction = line_reference_friction(film, p, u, slip, half, c.R, inlet)
    rise = friction * p * slip * film_resistance(film, u, half, inlet)
    return within(groups, rise, limits, c.contact_modulus)


def line_box_contact(box: Box, draw: Array) -> LineContact:
    """Return the contact of one draw, numbers from 0 to 1 in the order of the box."""
    p, slide, u, R_mm, *oil = numbers_of(box, draw)
    R = 1e-3 * R_mm
    return LineContact(
        line_load=(1e9 * p) ** 2 / line_mean_pressure(1.0, R, _E) ** 2,
        contact_modulus=_E,
        R=R,
        entrainment_speed=u,
        sliding_speed=u * math.sqrt(max(slide * slide - LEAST_SLIDING * LEAST_SLIDING, 0.0)),
        limiting_stress=0.0,
        limiting_slope=0.0,
        **oil_of_draw(oil),
    )


def line_box_contacts(
    box: Box, count: int, seed: int, *, random: bool = False
) -> list[LineContact]:
    """Return contacts drawn evenly from a box; arguments as in `samples.box_contacts`."""
    return _drawn(box).even(count, seed, random=random)


def line_edge_contacts(box: Box, count: int, seed: int) -> list[LineContact]:
    """Return contacts of a box near its thick films, drawn evenly there."""
    return _drawn(box).until(
        lambda one: line_contact_groups(one).thickness >= _EDGE_THICKNESS, count, seed
    )


def _drawn(box: Box) -> Drawn:
    return Drawn(box, line_box_contact, line_fits, LINE_DOMAIN, LINE_TRAINED)


def pair_contacts(
    count: int, seed: int, pairs: Sequence[str], oils: Sequence[Lubricant], limits: Limits
) -> list[LineContact]:
    """Return contacts that helical pairs visit, at random.

    Speed of the pinion within 20 to 12,000 rpm and its torque within 5 to 200 % of the paper's
    evenly in the logarithm, oil at -20 to 150 degC within its data, Eyring stress of
    `drawn_eyring`, any place on any line at any phase of the mesh. The load per length is the mean
    of all lines times 0.4 to 1.6.
    """
    rng = np.random.default_rng(seed)
    places = []
    for name in pairs:
        pair = HelicalGearFile.named(name).helical_pair()
        points = line_points(pair, _PHASES, _NODES)
        here = points.length > 0.0
        total = np.broadcast_to(points.total_length[:, None, None], here.shape)
        places.append((name, pair.plane, points.x[here], total[here]))
    found: list[LineContact] = []
    while len(found) < count:
        name, plane, x, total = places[int(rng.integers(len(places)))]
        n = int(rng.integers(x.size))
        torque = _TORQUES.get(name, _USUAL_TORQUE) * log_uniform(rng, *_TORQUE_SHARES)
        speed = rpm_to_rads(log_uniform(rng, *_SPEEDS))
        oil = oils[int(rng.integers(len(oils)))]
        temperature = rng.uniform(*oil_temperatures(oil))
        motion = line_kinematics(float(x[n]), speed, plane)
        load = torque / (plane.r_bp * plane.cos_b * float(total[n])) * rng.uniform(*_UNEVEN)
        one = LineContact(
            line_load=load,
            contact_modulus=_E,
            R=motion.R,
            entrainment_speed=motion.entrainment,
            sliding_speed=abs(motion.sliding),
            limiting_stress=0.0,
            limiting_slope=0.0,
            **oil_of_library(oil, temperature, drawn_eyring(rng)),
        )
        if line_fits(one, limits):
            found.append(one)
    return found


class _Races(NamedTuple):
    """A bearing as the draws need it."""

    R: tuple[float, float]  # relative radii at both races [m]
    ratio: float  # rolling speed over shaft speed [m]
    speeds: tuple[float, float]  # of the shaft, lowest and highest [rad/s]
    loads: tuple[float, float]  # per length of a roller [N/m]


def _races(name: str) -> _Races:
    """Return the bearings of the shipped axle's shafts, or the bearing of a bearing file.

    The axle: both shafts from 2 to 250 km/h, 5 to 400 N.m and a preload of 2500 N.
    """
    if name == AXLE_BEARING:
        p = TaperedRollerBearing.mohammadpour_2015().with_preload(2500.0).parameters()
        speeds = rpm_to_rads(12.0), rpm_to_rads(5800.0)
        loads = 50.0 / p.roller_length, 7000.0 / p.roller_length
        return _Races(line_radii(p), p.film_speed_radius, speeds, loads)
    geometry = BearingFile.named(name).geometry()
    b = geometry.parameters()
    speeds = rpm_to_rads(20.0), rpm_to_rads(6000.0)
    return _Races((b.R_inner, b.R_outer), b.mean_ratio, speeds, (3e2 / b.length, 6e3 / b.length))


def roller_fits(contact: RollerContact, limits: Limits) -> bool:
    """Tell whether a contact lies within limits."""
    return line_fits(rolling_line(contact), limits)


def roller_box_contact(box: Box, draw: Array) -> RollerContact:
    """Return the contact of one draw, numbers from 0 to 1 in the order of the box."""
    p, u, R_mm, *oil = numbers_of(box, draw)
    R = 1e-3 * R_mm
    return RollerContact(
        line_load=(1e9 * p) ** 2 / line_mean_pressure(1.0, R, _E) ** 2,
        contact_modulus=_E,
        R=R,
        speed=u,
        **oil_of_draw(oil),
    )


def roller_box_contacts(
    box: Box, count: int, seed: int, *, random: bool = False
) -> list[RollerContact]:
    """Return contacts drawn evenly from a box; arguments as in `samples.box_contacts`."""
    return _drawn_rollers(box).even(count, seed, random=random)


def roller_edge_contacts(box: Box, count: int, seed: int) -> list[RollerContact]:
    """Return contacts of a box near its thick films, drawn evenly there."""
    return _drawn_rollers(box).until(
        lambda one: rolling_groups(one).thickness >= _ROLLER_EDGE_THICKNESS, count, seed
    )


def _drawn_rollers(box: Box) -> Drawn:
    return Drawn(box, roller_box_contact, roller_fits, ROLLER_DOMAIN, ROLLER_TRAINED)


def roller_contacts(
    count: int, seed: int, bearings: Sequence[str], oils: Sequence[Lubricant], limits: Limits
) -> list[RollerContact]:
    """Return contacts that the rollers of bearings visit, at random.

    Bearing and race at random; speed of the shaft and load of a roller evenly in the logarithm,
    oil at -20 to 150 degC within its data, Eyring stress of `drawn_eyring`.

    Parameters
    ----------
    count, seed
        Number of contacts and what decides them.
    bearings
        "mohammadpour_2015" for those of the shipped axle, or shipped bearing files.
    oils, limits
        Oils of the bearings, and limits of the contacts.

    Raises
    ------
    ParameterError
        No bearing is named.
    """
    if not bearings:
        raise ParameterError("bearings must name at least one bearing, got none.")
    rng = np.random.default_rng(seed)
    races = [_races(name) for name in bearings]
    found: list[RollerContact] = []
    while len(found) < count:
        one = races[int(rng.integers(len(races)))]
        oil = oils[int(rng.integers(len(oils)))]
        contact = roller_contact_of(
            log_uniform(rng, *one.loads),
            one.R[int(rng.integers(2))],
            one.ratio * log_uniform(rng, *one.speeds),
            oil,
            rng.uniform(*oil_temperatures(oil)),
            drawn_eyring(rng),
        )
        if roller_fits(contact, limits):
            found.append(contact)
    return found


def roller_contact_of(
    line_load: float,
    R: float,
    speed: float,
    oil: Lubricant,
    temperature: float,
    eyring: tuple[float, float] | None = None,
) -> RollerContact:
    """Return the contact of steel bodies with an oil of the library.

    Parameters
    ----------
    line_load, R, speed
        [N/m], [m], rolling speed [m/s].
    oil, temperature
        Oil and its temperature [K].
    eyring
        As of `oil_of_library`.
    """
    return RollerContact(
        line_load=line_load,
        contact_modulus=_E,
        R=R,
        speed=speed,
        **oil_of_library(oil, temperature, eyring),
    )
