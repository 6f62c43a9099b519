"""Stress, film and wear of flanks under one load, along the engagement and on the tooth."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from gearlube_core.arrays import Array
from gearlube_core.contact.solid import Solid
from gearlube_core.friction.flank_states import FlankStates
from gearlube_core.rating.contact_temperature import contact_temperature
from gearlube_core.rating.wear import wear_per_cycle

WIDE, HIGH = 96, 32  # cells of a map, along the tooth and up
_FINER = 8  # lines between two states
_ACROSS = np.linspace(-1.0, 1.0, 81)  # along a contact line, over the semi-axis
_WITHIN = np.zeros(1)  # the same along a strip, which is as narrow as a cell
_BAND = np.linspace(-1.0, 1.0, 121)  # across it
# a quantity along the contact line goes with this power of 1 - (y/b)^2
POWERS = {
    "pressure": 0.5, "film": 0.0, "flash": 0.75, "heat": 0.5, "pinion_wear": 1.0, "gear_wear": 1.0,
}  # fmt: skip


class FlankDamage(NamedTuple):
    """Quantities in the middle of the contact lines of `FlankStates`; arrays of shape (N,)."""

    pressure: Array  # of Hertz [Pa]
    film: Array  # over composite roughness [-]
    flash: Array  # greatest rise in the contact [K]
    heat: Array  # greatest friction power over area [W/m2]
    pinion_wear: Array  # depth that a passing contact takes [m]
    gear_wear: Array
    peclet: Array  # of the slower surface [-]; below 5 the rise is less than this


def flank_damage(
    states: FlankStates, solid: Solid, wear_coefficient: float, *, all_load: bool = False
) -> FlankDamage:
    """Return what the contact of each state does, with the wear coefficient k [1/Pa].

    All the load wears, or that on asperities alone.

    Examples
    --------
    >>> import gearlube as gl
    >>> axle = gl.read_axle("mohammadpour_2015").axle
    >>> states = gl.gears.flank_states(axle, torque=100.0, speed=200.0, temperature=353.15)
    >>> found = flank_damage(states, axle.solid, 5e-18)
    >>> round(float(found.flash.max()))  # K
    48
    """
    speeds = states.pinion_speed, states.gear_speed
    capacity = float(solid.density * solid.heat_capacity)
    effusivity = math.sqrt(float(solid.conductivity) * capacity)
    middle = 0.5 * (_BAND[1:] + _BAND[:-1])
    rise = contact_temperature(
        _BAND, np.sqrt(1.0 - middle**2)[:, None] * states.heat, speeds, (states.bulk, states.bulk),
        half_width=states.semi_minor, effusivity=(effusivity, effusivity),
        diffusivity=float(solid.conductivity) / capacity,
    )  # fmt: skip
    wear = wear_per_cycle(
        wear_coefficient, states.line_load, speeds, sliding=states.sliding,
        asperity_share=1.0 if all_load else states.asperity_share,
    )  # fmt: skip
    return FlankDamage(
        states.pressure, states.film_ratio, rise.flash, states.heat, *wear, rise.peclet
    )


def places_along(states: FlankStates) -> Array:
    """Return places along a contact line over half its length, -1 to 1; of a strip its middle."""
    return _WITHIN if states.strips else _ACROSS


class ContactLines(NamedTuple):
    """Contact lines of N states and between them, on a drawn tooth."""

    at: tuple[Array, Array]  # places along the tooth and up, 0 to 1 within its edges, (lines, n)
    inside: NDArray[np.bool_]  # whether a place is within the edges
    profile: Array  # of the load along a line, 1 - (y/b)^2; of a strip 1
    between: Callable[[Array], Array]  # values of the states, (N,) or (N, n), at the lines


def contact_lines(states: FlankStates, tooth_size: tuple[float, float]) -> ContactLines:
    """Return the lines on a tooth of a size along and up [m], as long as the ellipse or strip."""
    n = states.load.size
    fine = np.linspace(0.0, n - 1.0, n if states.strips else _FINER * n)
    across = places_along(states)
    low = fine.astype(int)
    high, share = np.minimum(low + 1, n - 1), (fine - low)[:, None]

    def between(values: Array) -> Array:
        rows = values.reshape(n, -1)
        return np.asarray(rows[low] + share * (rows[high] - rows[low]))

    x, y = (
        (between(states.place[:, k]) + between(states.semi_major * states.major[:, k]) * across)
        / size
        for k, size in enumerate(tooth_size)
    )
    inside = (x >= 0.0) & (x < 1.0) & (y >= 0.0) & (y < 1.0)
    profile = np.ones_like(across) if states.strips else 1.0 - across**2
    return ContactLines((x, y), inside, profile, between)


def tooth_maps(
    states: FlankStates,
    damage: FlankDamage,
    tooth_size: tuple[float, float],
    along: Mapping[str, Array] | None = None,
) -> dict[str, Array]:
    """Return the quantities of `POWERS` on the drawn gear tooth, (HIGH, WIDE); 0: no contact.

    And those of `along`, each known at `places_along` every contact line, shape (N, places).

    Every point of a flank is passed by the contact line once. Lines are laid between the states, as
    long as the Hertz ellipse, and cut off at the edges of the tooth; strips are laid as they are.
    Pressure, temperature and heat are the largest while the line passes, the film the thinnest;
    wear is that of one pass. The pinion is drawn where it touches the gear.
    """
    lines = contact_lines(states, tooth_size)
    columns, rows = (
        (one[lines.inside] * count).astype(int)
        for one, count in zip(lines.at, (WIDE, HIGH), strict=True)
    )
    cell = rows * WIDE + columns
    every = {name: lines.between(one) for name, one in (along or {}).items()}
    for name, power in POWERS.items():
        every[name] = lines.between(getattr(damage, name)) * lines.profile**power
    maps = {}
    for name, values in every.items():
        values = 1.0 / values if name == "film" else values
        found = np.zeros(HIGH * WIDE)
        np.maximum.at(found, cell, values[lines.inside])
        maps[name] = found.reshape(HIGH, WIDE)
    film = maps["film"]
    maps["film"] = np.divide(1.0, film, out=np.zeros_like(film), where=film > 0.0)
    return maps
