"""Units of a point contact and the axes of its grid, which follow the entrainment."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.ehl.point.problem import PointContactProblem
from gearlube_core.oil.film_oil import FilmOil


@dataclass(frozen=True, slots=True)
class PointScales:
    """Units of the solver, in SI, and the turn that makes entrainment point to larger indices.

    Lengths in the dry semi-axis, pressure in the dry maximum, film in length^2/R, density and
    viscosity in their ambient values.
    """

    length: float  # [m]
    pressure: float  # [Pa]
    film: float  # [m]
    speed: float  # [m/s]
    mobility: float  # Lambda = h^2 p/(12 eta0 u l) [-]
    load: float  # int p dx dy that balances the load [-]
    flip_x: bool
    flip_y: bool
    swap: bool  # arrays (ny, nx) with x the direction of the larger entrainment over spacing

    @classmethod
    def of(cls, problem: PointContactProblem) -> PointScales:
        """Return the scales of a problem."""
        a_x, a_y, pressure = problem.hertz_contact
        u, v = problem.entrainment
        speed = math.hypot(u, v)
        length = math.sqrt(a_x * a_y)
        film = length * pressure / problem.contact_modulus
        lubricant = problem.lubricant
        dx, dy = problem.spacing
        return cls(
            length=length,
            pressure=pressure,
            film=film,
            speed=speed,
            mobility=film * film * pressure / (12.0 * lubricant.eta0 * speed * length),
            load=problem.load / (pressure * length**2),
            flip_x=u < 0.0,
            flip_y=v < 0.0,
            swap=abs(v) / dy > abs(u) / dx,
        )

    def inward(self, values: Array) -> Array:
        """Return an array of shape (nx, ny) in the solver's order."""
        if self.flip_x:
            values = values[::-1]
        if self.flip_y:
            values = values[:, ::-1]
        return np.ascontiguousarray(values if self.swap else values.T)

    def outward(self, values: Array) -> Array:
        """Return an array of the solver in the order (nx, ny) of the problem."""
        values = values if self.swap else values.T
        if self.flip_x:
            values = values[::-1]
        if self.flip_y:
            values = values[:, ::-1]
        return np.ascontiguousarray(values)

    def along_axes(self, velocity: tuple[float, float]) -> tuple[float, float]:
        """Return a velocity along the axes of the solver's arrays."""
        u, v = velocity
        u, v = -u if self.flip_x else u, -v if self.flip_y else v
        return (v, u) if self.swap else (u, v)

    def oil(self, lubricant: FilmOil) -> FilmOil:
        """Return the oil with viscosity, density and pressure in these units."""
        return lubricant.in_units(self.pressure)
