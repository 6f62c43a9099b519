"""Common base of solutions of films with temperatures."""

from __future__ import annotations

from typing import Any

from gearlube_core.arrays import Array
from gearlube_core.ehl.grid_error import FilmError, FilmNumbers, OnGrid


class WarmFilm:
    """A film on a grid and its temperatures; nodes first, then across the film."""

    __slots__ = ()

    film: OnGrid
    temperature: Array
    converged: bool
    coarser: tuple[Any, ...]
    wider: Any

    @property
    def nodes(self) -> tuple[int, ...]:
        """Number of nodes along each side."""
        return self.film.nodes

    @property
    def axes(self) -> tuple[Array, ...]:
        """Places of the nodes along each side [m]."""
        return self.film.axes

    @property
    def pressure(self) -> Array:
        """Pressure on the nodes [Pa]."""
        return self.film.pressure

    @property
    def formal_order(self) -> float:
        """Return the order of the grid."""
        return self.film.formal_order

    @property
    def numbers(self) -> FilmNumbers:
        """Films, largest pressure and friction."""
        return self.film.numbers

    @property
    def error(self) -> FilmError:
        """Estimated errors of the grid."""
        return FilmError.of(self)

    @property
    def surface_temperature(self) -> tuple[Array, Array]:
        """Temperatures of body 1 and body 2 at the film, on the nodes [K]."""
        return self.temperature[..., 0], self.temperature[..., -1]

    @property
    def max_temperature(self) -> float:
        """Largest temperature in the film [K]."""
        return float(self.temperature.max())
