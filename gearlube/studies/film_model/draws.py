"""Draws of contacts from a box of plain numbers, within limits of light and hot contacts."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import numpy as np
from scipy.stats import qmc

from gearlube_core.arrays import Array
from gearlube_core.contact.solid import STEEL_MOHAMMADPOUR_2015, solid_parameters
from gearlube_core.oil.lubricant import Lubricant
from gearlube_core.oil.roelands_1966 import GLASS_TEMPERATURE, ROELANDS_KAPPA, ROELANDS_PRESSURE
from gearlube_core.units import celsius_to_kelvin

STEEL = solid_parameters(STEEL_MOHAMMADPOUR_2015, STEEL_MOHAMMADPOUR_2015)
SOLID_HEAT_CAPACITY = STEEL.density * STEEL.heat_capacity  # by volume [J/(m3 K)]

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
    most_thickness: float  # of `FilmGroups` [-]
    most_heat: float  # beta eta0 u^2/k of the oil; beyond, films take long or are not found


ANYWHERE = Limits(0.0, math.inf, math.inf)
_OIL_TEMPERATURES = (313.15, 393.15)  # K, of visited contacts
_OIL_MARGIN = 1.03  # of a box that is widened for an oil


def widened(box: Box, oils: Sequence[Lubricant]) -> Box:
    """Return a box, widened where an oil between 40 and 120 degC lies beyond it."""
    box = dict(box)
    for oil in oils:
        for temperature in oil_temperatures(oil):
            state = oil.state(temperature)
            log_ratio = math.log(state.eta0 / ROELANDS_KAPPA)
            found = {
                "viscosity [Pa s]": state.eta0,
                "Roelands Z": state.slope / (ROELANDS_PRESSURE * log_ratio),
                "Houpert S0": state.beta * (temperature - GLASS_TEMPERATURE) / log_ratio,
                "conductivity [W/(m K)]": state.conductivity,
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


def oil_of_draw(
    eta0: float, Z: float, tau0: float, S0: float, temperature: float, k: float, c: float
) -> dict[str, float]:
    """Return the fields of a contact that oil and steel decide, from the numbers of a box.

    Parameters
    ----------
    eta0, Z, tau0, S0, temperature, k, c
        [Pa s], of Roelands, [MPa], of Houpert, [degC], [W/(m K)], [MJ/(m3 K)].
    """
    log_ratio = math.log(eta0 / ROELANDS_KAPPA)
    kelvin = celsius_to_kelvin(temperature)
    return {
        "eta0": eta0,
        "alpha": ROELANDS_PRESSURE * Z * log_ratio,
        "beta": S0 * log_ratio / (kelvin - GLASS_TEMPERATURE),
        "tau0": 1e6 * tau0,
        "temperature": kelvin,
        "conductivity": k,
        "heat_capacity": 1e6 * c,
        **_STEEL_FIELDS,
    }


def oil_of_library(oil: Lubricant, temperature: float, tau0: float) -> dict[str, float]:
    """Return the fields of a contact that oil and steel decide, for an oil of the library.

    Parameters
    ----------
    oil, temperature
        Oil and its temperature [K].
    tau0
        Eyring stress [Pa].
    """
    state = oil.state(temperature)
    return {
        "eta0": state.eta0,
        "alpha": state.slope,
        "beta": state.beta,
        "tau0": tau0,
        "temperature": temperature,
        "conductivity": state.conductivity,
        "heat_capacity": oil.density * oil.heat_capacity,
        **_STEEL_FIELDS,
    }


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
        draws = (
            rng.random((4 * count + 64, size))
            if random
            else qmc.Sobol(size, scramble=True, rng=rng).random_base2(
                math.ceil(math.log2(2 * count + 64))
            )
        )
        limits = self.domain if random else self.trained
        made = (self.make(self.box, draw) for draw in draws)
        return [one for one in made if self.fits(one, limits)][:count]

    def until(self, wanted: Callable[[Any], bool], count: int, seed: int) -> list[Any]:
        """Return independent contacts of the training's limits that are wanted."""
        found: list[Any] = []
        rng = np.random.default_rng(seed)
        while len(found) < count:
            one = self.make(self.box, rng.random(len(self.box)))
            if self.fits(one, self.trained) and wanted(one):
                found.append(one)
        return found
