"""What is known about the film on one grid: its state, and the residual's slopes there."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from scipy.sparse import csr_matrix

from gearlube_core.arrays import Array, Flags, Offsets
from gearlube_core.ehl.point.equations.cross_flow import CrossFlow
from gearlube_core.ehl.point.equations.film_shear import ShearFactors
from gearlube_core.ehl.point.equations.rupture import carried_entries, pass_on
from gearlube_core.ehl.point.equations.solids import SolidShare
from gearlube_core.ehl.point.equations.stencil import FilmFlow


@dataclass(slots=True)
class FilmState:
    """Pressure and what follows from it on one grid, in units of `PointScales`."""

    pressure: Array
    approach: float  # h_0
    film: Array
    mass: Array  # rho h, times the fill where the film is ruptured
    density: Array
    fluidity: Array  # 1/eta
    density_slope: Array
    viscosity_slope: Array  # d ln eta/dp
    cubic_x: Array  # rho h^3 times the flow factor along x
    cubic_y: Array
    log_viscosity: Array
    residual: Array
    load_error: float  # what the pressure lacks, relative to the load
    cubic_xy: Array | None = None  # of the flow along x by dp/dy; None: no such flow
    shear: ShearFactors | None = None  # of an Eyring film
    closed: Flags | None = None  # where oil may be above ambient pressure; None: everywhere
    solids: SolidShare | None = None  # None: no solids touch
    ruptured: Flags | None = None  # holds less oil than its gap; None: no node does

    @property
    def oil(self) -> Array:
        """Return the pressure of the oil."""
        return self.pressure if self.solids is None else self.solids.oil

    @property
    def cross(self) -> CrossFlow | None:
        """Return what flows across the slope of pressure; None: nothing."""
        return None if self.shear is None or self.shear.xy is None else self.shear.cross()

    @property
    def film_flow(self) -> FilmFlow:
        """Return what pressure drives oil with along x and y, apart."""
        f, resistance = self.fluidity, self.log_viscosity
        if self.shear is None:
            return FilmFlow(self.cubic_x, f, f, resistance, resistance)
        return self.shear.flow(self.cubic_x / self.shear.xx, f, resistance)

    @property
    def free(self) -> Flags:
        """Return where the Reynolds equation holds: pressure, or a residual that calls for it."""
        free = (self.oil > 0.0) | (self.residual > 0.0)
        if self.solids is not None:
            free &= ~self.solids.drained(self.residual)
        return free if self.closed is None else free & self.closed


@dataclass(frozen=True, slots=True)
class Carriage:
    """How changes of what gathers in ruptured nodes reach full ones; arrays of shape (ny, nx)."""

    to_x: Array
    to_y: Array
    ruptured: Flags

    def pass_on(self, change: Array) -> None:
        """Carry rows times a change downstream, in place."""
        pass_on(self.to_x, self.to_y, self.ruptured, change)

    def matrix(
        self, offsets: Offsets, by_pressure: Array, by_film: Array, free: Flags
    ) -> csr_matrix:
        """Return what free nodes get this way, by pressure (real) and film (imaginary part)."""
        size = free.size
        count, room = 0, 40 * sum(free.shape)
        while True:
            row, column = np.empty((2, room), dtype=np.int32)
            entry = np.empty(room, dtype=np.complex128)
            count = carried_entries(
                self.to_x,
                self.to_y,
                self.ruptured,
                free,
                offsets,
                by_pressure,
                by_film,
                row,
                column,
                entry,
            )
            if count <= room:
                break
            room = count
        parts = entry[:count], (row[:count], column[:count])
        return csr_matrix(parts, shape=(size, size))


@dataclass(slots=True)
class Linearisation:
    """Derivatives of the residual on one grid at a state."""

    offsets: Offsets  # (m, 2), m >= n, steps to the neighbours along y and x
    by_pressure: Array  # (n, ny, nx)
    by_film: Array  # (n, ny, nx)
    by_approach: Array  # (ny, nx)
    free: Flags  # where pressure is unknown
    right: Array  # what the derivatives times the changes have to be, (ny, nx)
    result: Array = field(repr=False)
    load_by_approach: float = 0.0  # change of the load that is carried over the load
    carriage: Carriage | None = None  # of oil through ruptured nodes; None: no node ruptures
