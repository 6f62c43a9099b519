"""Contacts of the training set: a box of groups, and what an axle visits."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from gearlube.studies.film_model.draws import (
    OIL_BOX,
    SOLID_HEAT_CAPACITY,
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
from gearlube_core.contact.hertz import ellipticity, hertz_coefficients
from gearlube_core.ehl.gears.hypoid_film import pair_contact
from gearlube_core.film_model.groups import (
    FilmContact,
    contact_groups,
    contact_parts,
    film_contact,
    semi_minor_axis,
)
from gearlube_core.film_model.reference_friction import film_resistance, reference_friction
from gearlube_core.mesh_table.table import MeshTable
from gearlube_core.oil.lubricant import Lubricant
from gearlube_core.units import rpm_to_rads

_E = STEEL.contact_modulus

_RPM_PER_KMH = 22.95  # pinion, of the axle of Mohammadpour et al. 2015
_LEAST_LOAD = 1.0  # N


# training goes a little farther
DOMAIN, TRAINED = (
    Limits(0.15e9, 1.1, 3.0, 3.85, 0.6, 150.0),
    Limits(0.14e9, 1.2, 3.2, 3.95, 0.5, 180.0),
)
_EDGE_THICKNESS = math.log(0.6)  # from there on films change most from contact to contact

# hypoid flanks of cars to truck axles, creep to top speed, and a margin
HYPOID_BOX: Box = {
    "mean pressure [GPa]": (1e-9 * TRAINED.least_pressure, 1.7, "log"),
    "R_y/R_x": (30.0, 200.0, "log"),
    "entrainment angle [deg]": (25.0, 70.0, "even"),
    "slide-roll ratio": (0.4, 1.1, "log"),
    "sliding from entrainment [deg]": (-4.0, 56.0, "even"),
    "u [m/s]": (0.03, 25.0, "log"),
    "R_x [mm]": (8.0, 45.0, "log"),
    **OIL_BOX,
}


def box_contacts(box: Box, count: int, seed: int, *, random: bool = False) -> list[FilmContact]:
    """Return contacts drawn evenly from a box, within its limits of light and hot contacts.

    Parameters
    ----------
    box
        As `HYPOID_BOX`.
    count, seed
        Number of contacts and what decides them.
    random
        Independent draws of the domain, as a calibration needs them; else a scrambled sequence of
        Sobol, which also covers the margin below the domain's pressures.
    """
    return _drawn(box).even(count, seed, random=random)


def edge_contacts(box: Box, count: int, seed: int) -> list[FilmContact]:
    """Return contacts of a box near its thick films, drawn evenly there; as `box_contacts`."""
    return _drawn(box).until(
        lambda one: contact_groups(one).thickness >= _EDGE_THICKNESS, count, seed
    )


def _drawn(box: Box) -> Drawn:
    return Drawn(box, box_contact, _fits, DOMAIN, TRAINED)


def _fits(contact: FilmContact, limits: Limits) -> bool:
    if not oil_fits(contact):
        return False
    groups, c = contact_groups(contact), contact
    place, inlet = contact_parts(c)
    p = c.pressure_coefficient * c.load ** (1.0 / 3.0)
    semi_axis = semi_minor_axis(c.load, p, place)
    film = (semi_axis * math.exp(groups.thickness)) ** 2 / c.R_x
    across, slip = c.entrainment_speed * place.cos_psi, c.sliding_speed
    friction = reference_friction(film, p, across, slip, semi_axis, c.R_x, inlet)
    rise = friction * p * slip * film_resistance(film, across, semi_axis, inlet)
    return within(groups, rise, limits, c.contact_modulus)


def box_contact(box: Box, draw: Array) -> FilmContact:
    """Return the contact of one draw, numbers from 0 to 1 in the order of the box."""
    p, ratio, psi, slide, delta, u, R_mm, *oil = numbers_of(box, draw)
    R_x = 1e-3 * R_mm
    coefficient = hertz_coefficients(R_x, ratio * R_x, _E)[2]
    return FilmContact(
        load=(1e9 * p / coefficient) ** 3,
        contact_modulus=_E,
        R_x=R_x,
        R_y=ratio * R_x,
        ellipticity=ellipticity(ratio),
        pressure_coefficient=coefficient,
        entrainment_speed=u,
        entrainment_angle=math.radians(psi),
        sliding_speed=slide * u,
        sliding_angle=math.radians(delta),
        limiting_stress=0.0,
        limiting_slope=0.0,
        **oil_of_draw(oil),
    )


def axle_contacts(
    count: int, seed: int, mesh: MeshTable, oils: Sequence[Lubricant], limits: Limits
) -> list[FilmContact]:
    """Return contacts that an axle visits, at random.

    Speed within 2 to 250 km/h and the pinion's torque within 5 to 400 N.m evenly in the logarithm,
    oil at -20 to 150 degC within its data, Eyring stress of `drawn_eyring`, any phase of the
    engagement with load; every fourth coasts, with at most 100 N.m. The load is the static one
    times 0.8 to 1.2.
    """
    rng = np.random.default_rng(seed)
    found: list[FilmContact] = []
    while len(found) < count:
        speed = rpm_to_rads(_RPM_PER_KMH * log_uniform(rng, 2.0, 250.0))
        side = 1.0 if rng.random() < 0.75 else -1.0
        most = 400.0 if side > 0.0 else 100.0
        torque = log_uniform(rng, 5.0, most)
        oil = oils[int(rng.integers(len(oils)))]
        temperature = rng.uniform(*oil_temperatures(oil))
        eyring = drawn_eyring(rng)
        factor = rng.uniform(0.8, 1.2)
        contact = pair_contact(mesh, side * torque, np.array([rng.uniform(-1.5, 1.5)]))
        load = factor * torque / mesh.mean("R_p", side * torque) * float(contact.share[0])
        if load < _LEAST_LOAD:
            continue
        one = flank_contact_of(
            load,
            (float(contact.R_x[0]), float(contact.R_y[0])),
            contact.entrainment[0] * speed,
            contact.sliding[0] * speed,
            oil,
            temperature,
            eyring,
        )
        if _fits(one, limits):
            found.append(one)
    return found


def flank_contact_of(
    load: float,
    radii: tuple[float, float],
    entrainment: Array,
    sliding: Array,
    oil: Lubricant,
    temperature: float,
    eyring: tuple[float, float] | None = None,
) -> FilmContact:
    """Return the contact of steel flanks with an oil of the library.

    Parameters
    ----------
    load
        [N].
    radii
        Along the minor and the major axis [m].
    entrainment, sliding : ndarray, shape (2,)
        Along the same axes [m/s].
    oil, temperature
        Oil and its temperature [K].
    eyring
        As of `oil_of_library`.
    """
    idle = (1.0, 1.0, 1.0, 1.0, 1.0, 1.0)
    place = film_contact(
        load,
        _E,
        *radii,
        (float(entrainment[0]), float(entrainment[1])),
        (float(sliding[0]), float(sliding[1])),
        idle,
        (0.0, 0.0),
        temperature,
        (STEEL.conductivity, SOLID_HEAT_CAPACITY),
    )
    return place._replace(**oil_of_library(oil, temperature, eyring))
