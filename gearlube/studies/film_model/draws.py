"""Draws of contacts from a box of plain numbers, within limits of light and hot contacts."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import numpy as np
from scipy.stats import qmc

from gearlube_core.arrays import Array
from gearlube_core.contact.solid import STEEL_MOHAMMADPOUR_2015, solid_parameters
from gearlube_core.film_model.groups import FilmGroups
from gearlube_core.oil.lubricant import Lubricant
from gearlube_core.oil.modulus_law import (
    Fva3Modulus,
    ModulusLaw,
    NaphthenicModulus,
    PolyalphaolefinModulus,
)
from gearlube_core.oil.pressure_factor import modulus_at, slope_turn
from gearlube_core.oil.roelands_1966 import ROELANDS_KAPPA, ROELANDS_PRESSURE
from gearlube_core.oil.walther_1931 import (
    MM2_S,
    walther_double_log,
    walther_kinematic_viscosity,
    walther_viscosity,
)
from gearlube_core.units import celsius_to_kelvin

STEEL = solid_parameters(STEEL_MOHAMMADPOUR_2015, STEEL_MOHAMMADPOUR_2015)
SOLID_HEAT_CAPACITY = STEEL.density * STEEL.heat_capacity  # by volume [J/(m3 K)]

_FORTY = celsius_to_kelvin(40.0)
_BLOCK = 1024  # of draws
_STEEL_FIELDS = {
    "solid_conductivity": STEEL.conductivity,
    "solid_heat_capacity": SOLID_HEAT_CAPACITY,
}

# name: lowest, highest, and whether evenly ("even") or evenly in the logarithm ("log")
Box = dict[str, tuple[float, float, str]]
Make = Callable[[Box, Array], Any]  # a contact from numbers between 0 and 1
Fits = Callable[[Any, "Limits"], bool]


class Limits(NamedTuple):
    """Where light contacts end, whose films are nearly those of rigid solids, and hot ones."""

    least_pressure: float  # mean [Pa]
    most_thickness: float  # (h R_x)^(1/2)/a_x [-]
    most_heat: float  # beta eta0 u^2/k of the oil; beyond, films take long or are not found
    most_sharpness: float  # of `FilmGroups` [-]; beyond, grids must be finer
    least_sharpness: float  # likewise; below, pressure hardly thickens the oil
    most_rise: float  # of the film over the inlet by the reference friction [K]


ANYWHERE = Limits(0.0, math.inf, math.inf, math.inf, -math.inf, math.inf)
OIL_BOX: Box = {
    "family of the viscosity law": (0.0, 1.0, "even"),
    "oil temperature [degC]": (-20.0, 150.0, "even"),
    "viscosity at 40 degC [mm2/s]": (22.0, 480.0, "log"),
    "Walther B": (2.3, 4.2, "even"),
    "alpha over that of the family": (0.7, 1.4, "log"),
    "Roelands Z": (0.36, 0.88, "log"),
    "local Eyring stress": (0.0, 1.0, "even"),
    "Eyring stress [MPa]": (1.0, 10.0, "log"),
    "Lambda": (0.03, 0.06, "log"),
    "conductivity [W/(m K)]": (0.102, 0.17, "log"),
    "heat capacity [MJ/(m3 K)]": (1.5, 2.1, "log"),
}
_DENSITY = 870.0  # kg/m3, of drawn oils
_VISCOSITIES = (1.6e-3, 20.0)  # Pa s at the inlet
_STEEPEST = 6e-8  # 1/Pa, of alpha
_FACTORS = [
    one()._own for one in (ModulusLaw, Fva3Modulus, NaphthenicModulus, PolyalphaolefinModulus)
]
_ROELANDS_SHARE, _LOCAL_SHARE = 0.25, 0.6  # of drawn oils
_OIL_TEMPERATURES = celsius_to_kelvin(-20.0), celsius_to_kelvin(150.0)  # of visited contacts
_OIL_MARGIN = 1.03  # of a box that is widened for an oil


def widened(box: Box, oils: Sequence[Lubricant]) -> Box:
    """Return a box, widened where an oil lies beyond it."""
    box = dict(box)
    for oil in oils:
        line = oil.walther_a, oil.walther_b
        found = {
            "viscosity at 40 degC [mm2/s]": walther_kinematic_viscosity(*line, _FORTY) / MM2_S,
            "Walther B": oil.walther_b,
            "Roelands Z": oil.roelands_z,
            "conductivity [W/(m K)]": oil.conductivity,
            "heat capacity [MJ/(m3 K)]": 1e-6 * oil.density * oil.heat_capacity,
        }
        for name, value in found.items():
            low, high, scale = box[name]
            if not low <= value <= high:
                low, high = min(low, value / _OIL_MARGIN), max(high, value * _OIL_MARGIN)
                box[name] = (low, high, scale)
    return box


def oil_temperatures(oil: Lubricant) -> tuple[float, float]:
    """Return the temperatures of visited contacts within the range of an oil's data [K]."""
    low, high = _OIL_TEMPERATURES
    return max(low, oil.temperature_low), min(high, oil.temperature_high)


def numbers_of(box: Box, draw: Array) -> list[float]:
    """Return the numbers of one draw, from 0 to 1 in the order of the box."""
    return [
        math.exp(math.log(low) + t * math.log(high / low))
        if scale == "log"
        else low + t * (high - low)
        for t, (low, high, scale) in zip(draw, box.values(), strict=True)
    ]


def oil_of_draw(numbers: Sequence[float]) -> dict[str, float]:
    """Return the fields of a contact that oil and steel decide, from the numbers of `OIL_BOX`."""
    family, degc, nu_40, B, scale, Z, local, tau0, Lambda, k, c = numbers
    T = celsius_to_kelvin(degc)
    A = walther_double_log(nu_40 * MM2_S) + B * math.log10(_FORTY)
    nu, beta = walther_viscosity(A, B, T)
    eta0 = _DENSITY * nu
    fields = {
        "eta0": eta0,
        "alpha": ROELANDS_PRESSURE * Z * math.log(max(eta0, _VISCOSITIES[0]) / ROELANDS_KAPPA),
        "beta": beta,
        "tau0": 1e6 * tau0,
        "temperature": T,
        "conductivity": k,
        "heat_capacity": 1e6 * c,
        "eyring_slope": Lambda if local < _LOCAL_SHARE else 0.0,
        **_STEEL_FIELDS,
    }
    if family < _ROELANDS_SHARE:
        return fields
    place = (family - _ROELANDS_SHARE) / (1.0 - _ROELANDS_SHARE)
    factor = _FACTORS[min(int(place * len(_FACTORS)), len(_FACTORS) - 1)].scaled(scale)
    A_factor, B_factor = modulus_at(factor, T)
    return {
        **fields,
        "modulus": A_factor,
        "modulus_slope": B_factor,
        "modulus_turn": factor.a2,
        "slope_turn": slope_turn(factor, T, B_factor),
    }


def oil_fits(contact: Any) -> bool:
    """Tell whether the oil of a drawn contact is one that gears run in."""
    steep = 1.0 / contact.modulus if contact.modulus > 0.0 else contact.alpha
    return _VISCOSITIES[0] <= contact.eta0 <= _VISCOSITIES[1] and steep <= _STEEPEST


def within(groups: FilmGroups, rise: float, limits: Limits, modulus: float) -> bool:
    """Tell whether groups and rise [K] of a contact of solids with E* [Pa] lie within limits."""
    return (
        math.exp(groups.heat) <= limits.most_heat
        and modulus * math.exp(groups.pressure) >= (1.0 - 1e-9) * limits.least_pressure
        and math.exp(groups.thickness) <= limits.most_thickness
        and limits.least_sharpness <= groups.sharpness <= limits.most_sharpness
        and rise <= limits.most_rise
    )


def oil_of_library(
    oil: Lubricant, temperature: float, eyring: tuple[float, float] | None = None
) -> dict[str, float]:
    """Return the fields of a contact that oil and steel decide, for an oil of the library.

    Parameters
    ----------
    oil, temperature
        Oil and its temperature [K].
    eyring
        Eyring stress [Pa], and Lambda [-] of the local one or 0; default: those of the oil.
    """
    state = oil.state(temperature)
    tau0, Lambda = eyring or (state.tau0, state.eyring_slope)
    return {
        "eta0": state.eta0,
        "alpha": state.slope,
        "beta": state.beta,
        "tau0": tau0,
        "temperature": temperature,
        "conductivity": state.conductivity,
        "heat_capacity": oil.density * oil.heat_capacity,
        "modulus": state.modulus,
        "modulus_slope": state.modulus_slope,
        "modulus_turn": state.modulus_turn if state.modulus > 0.0 else 0.0,
        "slope_turn": state.slope_turn if state.modulus > 0.0 else 0.0,
        "eyring_slope": Lambda,
        **_STEEL_FIELDS,
    }


def drawn_eyring(rng: np.random.Generator) -> tuple[float, float]:
    """Return an Eyring stress [Pa] and Lambda of the local one, 0 in some draws, at random."""
    tau0, Lambda = 1e6 * log_uniform(rng, 1.0, 10.0), log_uniform(rng, 0.033, 0.055)
    return tau0, Lambda if rng.random() < _LOCAL_SHARE else 0.0


def log_uniform(rng: np.random.Generator, low: float, high: float) -> float:
    """Return a number drawn evenly in the logarithm."""
    return math.exp(rng.uniform(math.log(low), math.log(high)))


class Drawn(NamedTuple):
    """A box with what draws need of its kind of contact."""

    box: Box
    make: Make  # contact of a draw of the box
    fits: Fits  # whether a contact lies within limits
    domain: Limits
    trained: Limits  # a little wider

    def even(self, count: int, seed: int, *, random: bool = False) -> list[Any]:
        """Return contacts drawn evenly from the box.

        Parameters
        ----------
        count, seed
            Number of contacts and what decides them.
        random
            Independent draws of the domain, as a calibration needs them; else a scrambled sequence
            of Sobol, which also covers the margin of the training.
        """
        size, rng = len(self.box), np.random.default_rng(seed)
        sequence = qmc.Sobol(size, scramble=True, rng=rng)
        limits = self.domain if random else self.trained
        found: list[Any] = []
        while len(found) < count:
            draws = rng.random((_BLOCK, size)) if random else sequence.random(_BLOCK)
            made = (self.make(self.box, draw) for draw in draws)
            found += [one for one in made if self.fits(one, limits)]
        return found[:count]

    def until(self, wanted: Callable[[Any], bool], count: int, seed: int) -> list[Any]:
        """Return independent contacts of the training's limits that are wanted."""
        found: list[Any] = []
        rng = np.random.default_rng(seed)
        while len(found) < count:
            one = self.make(self.box, rng.random(len(self.box)))
            if self.fits(one, self.trained) and wanted(one):
                found.append(one)
        return found
