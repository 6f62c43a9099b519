"""Pressure on one grid and the film, the oil and the residual that follow from it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

from gearlube_core.arrays import Array, Flags
from gearlube_core.ehl.point.equations.shear_factors import ShearFactors
from gearlube_core.ehl.point.equations.stencil import FilmFlow, StencilParameters
from gearlube_core.ehl.point.terms.boundary import AmbientBorder
from gearlube_core.ehl.point.terms.solids import Contact


class Balance(NamedTuple):
    """Data that the terms of one balance of oil share."""

    stencil: StencilParameters
    rows: Array  # entrainment of every row over that of the problem, (ny,) [-]
    storage: Array  # rate at which rho h is stored, (ny, nx) [-]


@dataclass(slots=True)
class FilmState:
    """State of a film on one grid, in units of `PointScales`; arrays of shape (ny, nx) [-]."""

    pressure: Array
    approach: float  # h_0
    film: Array
    mass: Array  # rho h, times the fill where the film is ruptured
    density: Array
    fluidity: Array  # 1/eta
    density_slope: Array  # d rho/dp
    viscosity_slope: Array  # d ln eta/dp
    cubic: Array  # rho h^3
    cubic_x: Array  # rho h^3 times the flow factor along x
    cubic_y: Array
    log_viscosity: Array
    residual: Array
    load_error: float  # what the pressure lacks, relative to the load
    shear: ShearFactors
    boundary: AmbientBorder
    contact: Contact  # of solids
    ruptured: Flags  # nodes that hold less oil than their gap

    @property
    def oil(self) -> Array:
        """Return the pressure of the oil."""
        return self.contact.oil

    @property
    def dense(self) -> Array:
        """Return d ln(rho)/dp."""
        return self.density_slope / self.density

    @property
    def film_flow(self) -> FilmFlow:
        """Return the conductance of pressure-driven flow along x and y."""
        return self.shear.flow(self.cubic_x, self.fluidity, self.log_viscosity)

    @property
    def free(self) -> Flags:
        """Return where the Reynolds equation holds: pressure, or a residual that calls for it."""
        free = (self.oil > 0.0) | (self.residual > 0.0)
        return self.boundary.within(self.contact.undrained(free, self.residual))
