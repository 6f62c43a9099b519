"""Viscosity and density of the oil at the nodes, at one temperature or the film temperature."""

from __future__ import annotations

from dataclasses import dataclass

from gearlube_core.arrays import Array
from gearlube_core.oil.film_oil import FilmOil, film_properties

Properties = tuple[Array, Array, Array, Array]


@dataclass(frozen=True, slots=True)
class IsothermalOil:
    """Oil at its own temperature, in the units of a grid."""

    oil: FilmOil

    def properties(self, pressure: Array) -> Properties:
        """Return eta, d eta/dp, rho and d rho/dp at a pressure, of its shape [-]."""
        return film_properties(self.oil, pressure, None)

    def heated(self, viscosity: Array, density: Array) -> HeatedOil:
        """Return the oil at the temperatures of a film, see `HeatedOil`."""
        return HeatedOil(self.oil, viscosity, density)


@dataclass(frozen=True, slots=True)
class HeatedOil:
    """Oil at the temperatures of a film, in the units of a grid."""

    oil: FilmOil
    viscosity: Array  # thermal factor, `cooling_factor` of the temperature, (ny, nx) [-]
    density: Array  # thermal factor, (ny, nx) [-]

    def properties(self, pressure: Array) -> Properties:
        """Return eta, d eta/dp, rho and d rho/dp at a pressure, of its shape [-]."""
        return film_properties(self.oil, pressure, (self.viscosity, self.density))

    def heated(self, viscosity: Array, density: Array) -> HeatedOil:
        """Return the oil at other temperatures."""
        return HeatedOil(self.oil, viscosity, density)


OilTerm = IsothermalOil | HeatedOil
