"""Line contacts of a training set: boxes of numbers, and what helical pairs and rollers visit."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from gearlube.studies.film_model.draws import (
    STEEL,
    Box,
    Drawn,
    Limits,
    log_uniform,
    numbers_of,
    oil_of_draw,
    oil_of_library,
    oil_temperatures,
)
from gearlube_core.arrays import Array
from gearlube_core.bearings.bearing_file import BearingFile
from gearlube_core.bearings.raceway_drag import line_radii
from gearlube_core.bearings.tapered_roller_bearing import TaperedRollerBearing
from gearlube_core.contact.hertz import line_mean_pressure
from gearlube_core.errors import ParameterError
from gearlube_core.film.groups import inlet_heating_number
from gearlube_core.film_model.line_contact import LEAST_SLIDING, LineContact, line_contact_groups
from gearlube_core.film_model.rolling import RollerContact, rolling_groups, rolling_line
from gearlube_core.friction.line_points import line_points
from gearlube_core.helical_geometry.contact_line import line_kinematics
from gearlube_core.helical_geometry.gear_file import HelicalGearFile
from gearlube_core.oil.lubricant import Lubricant
from gearlube_core.units import rpm_to_rads

_E = STEEL.contact_modulus

# training goes a little farther
LINE_DOMAIN, LINE_TRAINED = Limits(0.1e9, 3.0, 5.0), Limits(0.09e9, 3.2, 5.3)
_EDGE_THICKNESS = 1.8

# what the shipped helical pairs visit, see `pair_contacts`, and a margin
LINE_BOX: Box = {
    "mean pressure [GPa]": (1e-9 * LINE_TRAINED.least_pressure, 1.1, "log"),
    "slide-roll ratio and 0.003, root of squares": (LEAST_SLIDING, 0.85, "log"),
    "viscosity [Pa s]": (0.0085, 0.115, "log"),
    "Roelands Z": (0.37, 0.86, "log"),
    "Eyring stress [MPa]": (1.0, 10.0, "log"),
    "u/R [1/s]": (60.0, 1400.0, "log"),
    "u R [m2/s]": (0.0065, 0.55, "log"),
    "Houpert S0": (0.95, 1.3, "log"),
    "oil temperature [degC]": (38.0, 122.0, "even"),
    "conductivity [W/(m K)]": (0.105, 0.155, "log"),
    "heat capacity [MJ/(m3 K)]": (1.6, 1.9, "log"),
}

# N.m, of the papers
_TORQUES = {"he_2007": 226.0, "jamali_2015_a": 1060.0, "jamali_2015_b": 1060.0}
_USUAL_TORQUE = 300.0  # N.m, of other pairs
_TORQUE_SHARES = (0.05, 1.5)
_SPEEDS = (500.0, 6000.0)  # rpm of the pinion
_PHASES, _NODES = 24, 6  # of the points on the lines
_UNEVEN = (0.4, 1.6)  # load of a point over the mean of all lines
# training goes a little farther
ROLLER_DOMAIN, ROLLER_TRAINED = Limits(0.1e9, 2.5, 3.0), Limits(0.09e9, 2.75, 3.2)
_ROLLER_EDGE_THICKNESS = 1.5  # from there on films change most from contact to contact

# what the rollers of the shipped bearings visit, see `roller_contacts`, and a margin
ROLLER_BOX: Box = {
    "mean pressure [GPa]": (1e-9 * ROLLER_TRAINED.least_pressure, 1.4, "log"),
    "viscosity [Pa s]": (0.0055, 0.12, "log"),
    "Roelands Z": (0.37, 0.86, "log"),
    "Eyring stress [MPa]": (1.0, 10.0, "log"),
    "u/R [1/s]": (20.0, 2200.0, "log"),
    "u R [m2/s]": (0.0008, 0.15, "log"),
    "Houpert S0": (0.95, 1.3, "log"),
    "oil temperature [degC]": (38.0, 122.0, "even"),
    "conductivity [W/(m K)]": (0.105, 0.155, "log"),
    "heat capacity [MJ/(m3 K)]": (1.6, 1.9, "log"),
}

AXLE_BEARING = "mohammadpour_2015"


def line_fits(contact: LineContact, limits: Limits) -> bool:
    """Tell whether a contact lies within limits."""
    heat = inlet_heating_number(
        contact.eta0, contact.beta, contact.entrainment_speed, contact.conductivity
    )
    p = line_mean_pressure(contact.line_load, contact.R, contact.contact_modulus)
    return (
        heat <= limits.most_heat
        and p >= (1.0 - 1e-9) * limits.least_pressure
        and line_contact_groups(contact).thickness <= limits.most_thickness
    )


def line_box_contact(box: Box, draw: Array) -> LineContact:
    """Return the contact of one draw, numbers from 0 to 1 in the order of the box."""
    p, slide, eta0, Z, tau0, per, times, S0, T, k, c = numbers_of(box, draw)
    R, u = math.sqrt(times / per), math.sqrt(times * per)
    return LineContact(
        line_load=(1e9 * p) ** 2 / line_mean_pressure(1.0, R, _E) ** 2,
        contact_modulus=_E,
        R=R,
        entrainment_speed=u,
        sliding_speed=u * math.sqrt(max(slide * slide - LEAST_SLIDING * LEAST_SLIDING, 0.0)),
        limiting_stress=0.0,
        limiting_slope=0.0,
        **oil_of_draw(eta0, Z, tau0, S0, T, k, c),
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

    Speed of the pinion within 500 to 6000 rpm, its torque within 5 to 150 % of the paper's and the
    Eyring stress within 1 to 10 MPa evenly in the logarithm, oil at 40 to 120 degC, any place on
    any line at any phase of the mesh. The load per length is the mean of all lines times 0.4 to
    1.6.
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
            **oil_of_library(oil, temperature, 1e6 * log_uniform(rng, 1.0, 10.0)),
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

    The axle: both shafts from 20 to 100 km/h, 5 to 400 N.m and a preload of 2500 N.
    """
    if name == AXLE_BEARING:
        p = TaperedRollerBearing.mohammadpour_2015().with_preload(2500.0).parameters()
        speeds = rpm_to_rads(160.0), rpm_to_rads(2300.0)
        loads = 50.0 / p.roller_length, 7000.0 / p.roller_length
        return _Races(line_radii(p), p.film_speed_radius, speeds, loads)
    geometry = BearingFile.named(name).geometry()
    b = geometry.parameters()
    speeds = rpm_to_rads(200.0), rpm_to_rads(4000.0)
    return _Races((b.R_inner, b.R_outer), b.mean_ratio, speeds, (3e2 / b.length, 6e3 / b.length))


def roller_fits(contact: RollerContact, limits: Limits) -> bool:
    """Tell whether a contact lies within limits."""
    return line_fits(rolling_line(contact), limits)


def roller_box_contact(box: Box, draw: Array) -> RollerContact:
    """Return the contact of one draw, numbers from 0 to 1 in the order of the box."""
    p, eta0, Z, tau0, per, times, S0, T, k, c = numbers_of(box, draw)
    R, u = math.sqrt(times / per), math.sqrt(times * per)
    return RollerContact(
        line_load=(1e9 * p) ** 2 / line_mean_pressure(1.0, R, _E) ** 2,
        contact_modulus=_E,
        R=R,
        speed=u,
        **oil_of_draw(eta0, Z, tau0, S0, T, k, c),
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
    oil at 40 to 120 degC, Eyring stress evenly in the logarithm within 1 to 10 MPa.

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
            1e6 * log_uniform(rng, 1.0, 10.0),
        )
        if roller_fits(contact, limits):
            found.append(contact)
    return found


def roller_contact_of(
    line_load: float, R: float, speed: float, oil: Lubricant, temperature: float, tau0: float
) -> RollerContact:
    """Return the contact of steel bodies with an oil of the library.

    Parameters
    ----------
    line_load, R, speed
        [N/m], [m], rolling speed [m/s].
    oil, temperature
        Oil and its temperature [K].
    tau0
        Eyring stress [Pa].
    """
    return RollerContact(
        line_load=line_load,
        contact_modulus=_E,
        R=R,
        speed=speed,
        **oil_of_library(oil, temperature, tau0),
    )
