"""Contacts of the training set: a box of groups, and what an axle visits."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from gearlube.studies.film_model.draws import (
    SOLID_HEAT_CAPACITY,
    STEEL,
    Box,
    Drawn,
    Limits,
    numbers_of,
    oil_of_draw,
    oil_temperatures,
)
from gearlube_core.arrays import Array
from gearlube_core.contact.hertz import ellipticity, hertz_coefficients
from gearlube_core.ehl.gears.hypoid_film import pair_contact
from gearlube_core.film.groups import inlet_heating_number
from gearlube_core.film_model.groups import FilmContact, contact_groups, film_contact
from gearlube_core.mesh_table.table import MeshTable
from gearlube_core.oil.lubricant import Lubricant
from gearlube_core.units import rpm_to_rads

_E = STEEL.contact_modulus

_RPM_PER_KMH = 22.95  # pinion, of the axle of Mohammadpour et al. 2015
_LEAST_LOAD = 1.0  # N


# training goes a little farther
# beyond a heat of 0.6 films take long or are not found
DOMAIN, TRAINED = Limits(0.2e9, 1.0, 0.6), Limits(0.18e9, 1.15, 0.6)
_EDGE_THICKNESS = 0.6  # from there on films change most from contact to contact

# What the shipped axle visits from 20 to
# 100 km/h, with 5 to 400 N.m and oil of 40 to 120 degC, and a margin.
HYPOID_BOX: Box = {
    "mean pressure [GPa]": (1e-9 * TRAINED.least_pressure, 1.08, "log"),
    "R_y/R_x": (36.0, 190.0, "log"),
    "entrainment angle [deg]": (28.0, 67.0, "even"),
    "slide-roll ratio": (0.54, 1.0, "log"),
    "sliding from entrainment [deg]": (-2.0, 54.0, "even"),
    "viscosity [Pa s]": (0.0085, 0.115, "log"),
    "Roelands Z": (0.37, 0.86, "log"),
    "Eyring stress [MPa]": (1.0, 10.0, "log"),
    "u/R_x [1/s]": (28.0, 520.0, "log"),
    "u R_x [m2/s]": (0.0065, 0.19, "log"),
    "Houpert S0": (0.95, 1.3, "log"),
    "oil temperature [degC]": (38.0, 122.0, "even"),
    "conductivity [W/(m K)]": (0.105, 0.155, "log"),
    "heat capacity [MJ/(m3 K)]": (1.6, 1.9, "log"),
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
    heat = inlet_heating_number(
        contact.eta0, contact.beta, contact.entrainment_speed, contact.conductivity
    )
    p = contact.pressure_coefficient * contact.load ** (1.0 / 3.0)
    return (
        heat <= limits.most_heat
        and p >= (1.0 - 1e-9) * limits.least_pressure
        and contact_groups(contact).thickness <= limits.most_thickness
    )


def box_contact(box: Box, draw: Array) -> FilmContact:
    """Return the contact of one draw, numbers from 0 to 1 in the order of the box."""
    p, ratio, psi, slide, delta, eta0, Z, tau0, per, times, S0, T, k, c = numbers_of(box, draw)
    R_x, u = math.sqrt(times / per), math.sqrt(times * per)
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
        **oil_of_draw(eta0, Z, tau0, S0, T, k, c),
    )


def axle_contacts(
    count: int, seed: int, mesh: MeshTable, oils: Sequence[Lubricant], limits: Limits
) -> list[FilmContact]:
    """Return contacts that an axle visits, at random.

    Speed evenly within 20 to 100 km/h, the pinion's torque within 5 to 400 N.m and the Eyring
    stress within 1 to 10 MPa evenly in the logarithm, oil at 40 to 120 degC, any phase of the
    engagement with load; every fourth coasts, with at most 100 N.m. The load is the static one
    times 0.8 to 1.2.
    """
    rng = np.random.default_rng(seed)
    found: list[FilmContact] = []
    while len(found) < count:
        speed = rpm_to_rads(_RPM_PER_KMH * rng.uniform(20.0, 100.0))
        side = 1.0 if rng.random() < 0.75 else -1.0
        most = 400.0 if side > 0.0 else 100.0
        torque = math.exp(rng.uniform(math.log(5.0), math.log(most)))
        oil = oils[int(rng.integers(len(oils)))]
        temperature = rng.uniform(*oil_temperatures(oil))
        tau0 = 1e6 * math.exp(rng.uniform(0.0, math.log(10.0)))
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
            tau0,
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
    tau0: float,
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
    tau0
        Eyring stress [Pa].
    """
    state = oil.state(temperature)
    return film_contact(
        load,
        _E,
        *radii,
        (float(entrainment[0]), float(entrainment[1])),
        (float(sliding[0]), float(sliding[1])),
        (
            state.eta0,
            state.slope,
            state.beta,
            tau0,
            state.conductivity,
            oil.density * oil.heat_capacity,
        ),
        (0.0, 0.0),
        temperature,
        (STEEL.conductivity, SOLID_HEAT_CAPACITY),
    )
