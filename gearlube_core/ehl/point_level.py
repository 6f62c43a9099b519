"""One grid of a point contact: its gap, deflection, residual and linearised operator."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from gearlube_core.contact.half_space import HalfSpaceConvolution, love_coefficients
from gearlube_core.ehl.lubricant import EhlLubricant, fill_properties
from gearlube_core.ehl.point_stencil import (
    NEIGHBOURS,
    StencilParameters,
    apply_derivatives,
    reynolds_derivatives,
    reynolds_residual,
)
from gearlube_core.ehl.problem import PointContactProblem
from gearlube_core.ehl.scaling import PointScales
from gearlube_core.ehl.settings import WEDGE_WEIGHTS

Array = np.ndarray[Any, np.dtype[np.float64]]

# rho h at a face over that of the node upstream of it; reached where the film halves in a cell
_LEAST_FACE = 0.5
_MOST_FACE = 2.0


@dataclass(slots=True)
class FilmState:
    """Pressure and what follows from it on one grid, in units of `PointScales`."""

    pressure: Array
    approach: float  # h_0
    film: Array
    mass: Array  # rho h
    density: Array
    fluidity: Array  # 1/eta
    density_slope: Array
    viscosity_slope: Array  # d ln eta/dp
    cubic_x: Array  # rho h^3 times the flow factor along x
    cubic_y: Array
    log_viscosity: Array
    residual: Array
    load_error: float  # what the pressure lacks, relative to the load

    @property
    def free(self) -> np.ndarray[Any, np.dtype[np.bool_]]:
        """Return where the Reynolds equation holds: pressure, or a residual that calls for it."""
        return (self.pressure > 0.0) | (self.residual > 0.0)


@dataclass(slots=True)
class Linearisation:
    """Derivatives of the residual on one grid at a state."""

    by_pressure: Array  # (7, ny, nx)
    by_film: Array  # (7, ny, nx)
    by_approach: Array  # (ny, nx)
    free: np.ndarray[Any, np.dtype[np.bool_]]
    result: Array = field(repr=False)


class PointLevel:
    """Grid of shape (ny, nx) with the discrete equations of a problem."""

    def __init__(
        self, problem: PointContactProblem, scales: PointScales, shape: tuple[int, int], wedge: str
    ) -> None:
        self.shape = ny, nx = shape
        self.scales = scales
        nodes = (ny, nx) if scales.swap else (nx, ny)
        x = np.linspace(*problem.x_limits, nodes[0])
        y = np.linspace(*problem.y_limits, nodes[1])
        gap = np.broadcast_to(problem.gap(x[:, None], y[None, :]), nodes)
        self.gap = scales.inward(np.asarray(gap, dtype=np.float64) / scales.film)
        step_x, step_y = x[1] - x[0], y[1] - y[0]
        if scales.swap:
            step_x, step_y = step_y, step_x
        self.dx, self.dy = step_x / scales.length, step_y / scales.length
        u, v = (abs(component) / scales.speed for component in problem.entrainment)
        if scales.swap:
            u, v = v, u
        semi_x, semi_y, _ = problem.hertz_contact
        across = (
            math.hypot(u * semi_y, v * semi_x)
            if not scales.swap
            else math.hypot(u * semi_x, v * semi_y)
        )
        self.half_width = across / scales.length
        self.oil: EhlLubricant = scales.oil(problem.lubricant)
        self.modulus = problem.contact_modulus * scales.film / (scales.pressure * scales.length)
        self.coefficients = love_coefficients(self.dy, self.dx, ny, nx, 1.0) * (
            self.dx * self.dy / self.modulus
        )
        self.deflection = HalfSpaceConvolution(self.coefficients)
        self._weights = here, upstream, downstream = WEDGE_WEIGHTS[wedge]
        self.stencil = StencilParameters(
            poiseuille_x=scales.mobility / self.dx**2,
            poiseuille_y=scales.mobility / self.dy**2,
            wedge_x=u / self.dx,
            wedge_y=v / self.dy,
            here=here,
            upstream=upstream,
            downstream=downstream,
            squeeze=0.0,
            least=_LEAST_FACE,
            most=_MOST_FACE,
        )
        self.source = np.zeros(shape)
        self.cell = self.dx * self.dy
        self.flow_rate = self.stencil.wedge_x + self.stencil.wedge_y
        self._dense: Array | None = None

    def dense_deflection(self) -> Array:
        """Return the matrix of deflection per unit pressure, shape (ny nx, ny nx)."""
        if self._dense is None:
            rows, columns = (n.ravel() for n in np.indices(self.shape))
            self._dense = self.coefficients[
                abs(rows[:, None] - rows), abs(columns[:, None] - columns)
            ]
        return self._dense

    def film(self, pressure: Array, approach: float) -> Array:
        """Return h = h_0 + h_u + deflection, shape (ny, nx)."""
        return self.deflection(pressure) + self.gap + approach

    def state(self, pressure: Array, approach: float, film: Array | None = None) -> FilmState:
        """Return the state at a pressure, zero on the border, and an approach."""
        if film is None:
            film = self.film(pressure, approach)
        viscosity, viscosity_slope, density, density_slope = np.empty((4, *self.shape))
        fill_properties(
            self.oil,
            pressure.ravel(),
            viscosity.ravel(),
            viscosity_slope.ravel(),
            density.ravel(),
            density_slope.ravel(),
        )
        mass = density * film
        cubic = density * np.maximum(film, 0.0) ** 3
        fluidity, log_viscosity = 1.0 / viscosity, np.log(viscosity)
        residual = np.empty(self.shape)
        reynolds_residual(
            self.stencil,
            pressure,
            mass,
            cubic,
            cubic,
            fluidity,
            log_viscosity,
            self.source,
            residual,
        )
        load_error = (self.scales.load - self.cell * float(pressure.sum())) / self.scales.load
        return FilmState(
            pressure=pressure,
            approach=approach,
            film=film,
            mass=mass,
            density=density,
            fluidity=fluidity,
            density_slope=density_slope,
            viscosity_slope=viscosity_slope * fluidity,
            cubic_x=cubic,
            cubic_y=cubic,
            log_viscosity=log_viscosity,
            residual=residual,
            load_error=load_error,
        )

    def ease(self, mobility: float, order: float) -> None:
        """Set an easier problem of a continuation.

        Parameters
        ----------
        mobility
            Multiple of the problem's; below 1 the film is thicker [1].
        order
            1 the chosen wedge stencil, 0 the first-order one, linear between [1].
        """
        here, upstream, downstream = (order * weight for weight in self._weights)
        poiseuille = mobility * self.scales.mobility
        self.stencil = self.stencil._replace(
            poiseuille_x=poiseuille / self.dx**2,
            poiseuille_y=poiseuille / self.dy**2,
            here=here + 1.0 - order,
            upstream=upstream,
            downstream=downstream,
        )

    def linearise(self, state: FilmState, squeeze: float = 0.0) -> Linearisation:
        """Return the derivatives of the residual at a state; flow factors are held.

        `squeeze` adds a rate of rho h that the residual does not contain.
        """
        free = state.free
        by_pressure = np.empty((NEIGHBOURS, *self.shape))
        by_film = np.empty((NEIGHBOURS, *self.shape))
        reynolds_derivatives(
            self.stencil._replace(squeeze=self.stencil.squeeze + squeeze),
            state.pressure,
            state.cubic_x,
            state.cubic_y,
            state.fluidity,
            state.log_viscosity,
            state.viscosity_slope,
            state.density,
            state.density_slope,
            state.film,
            free,
            by_pressure,
            by_film,
        )
        return Linearisation(by_pressure, by_film, by_film.sum(axis=0), free, np.empty(self.shape))

    def apply(self, linear: Linearisation, pressure: Array, approach: float) -> Array:
        """Return the change of the residual under changes of pressure and approach.

        The result is overwritten by the next call with the same `linear`.
        """
        film = self.deflection(pressure)
        apply_derivatives(linear.by_pressure, linear.by_film, pressure, film, linear.result)
        if approach != 0.0:
            linear.result += approach * linear.by_approach
        return linear.result
