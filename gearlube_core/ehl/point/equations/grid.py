"""Nodes of one grid of a point contact, their cells and the deflection under pressure on them."""

from __future__ import annotations

from functools import cached_property
from typing import Any

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.contact.half_space import (
    GradedConvolution,
    HalfSpaceConvolution,
    graded_coefficients,
    love_coefficients,
)
from gearlube_core.contact.half_space_periodic import (
    PeriodicDeflection,
    periodic_coefficients,
    periodic_modes,
)
from gearlube_core.ehl.point.equations.stencil import (
    Grading,
    MeshMetric,
    cell_faces,
    central_metric,
    mesh_metric,
    x_nodes,
)
from gearlube_core.ehl.point.problem import PointContactProblem
from gearlube_core.ehl.point.scaling import PointScales
from gearlube_core.ehl.point.settings import Sides
from gearlube_core.errors import ParameterError
from gearlube_core.kernels.jit import row_kernel
from gearlube_core.kernels.row_workers import ALONE, RowWorkers

_SHARPNESS = 16  # power of the cosine
_LEAST = 1.0e-2  # of a node's own deflection, below which a neighbour is left out
_REFERENCE = 2.0  # lengths of the domain, where a repeated load leaves the solids as they were


@row_kernel
def sum_neighbours(
    offsets: np.ndarray,
    weights: np.ndarray,
    period: int,
    values: np.ndarray,
    rows: tuple[int, int],
    result: np.ndarray,
) -> None:
    """Write weighted sums of the values of neighbours.

    Parameters
    ----------
    offsets : ndarray of int, shape (n, 2)
        Steps to the neighbours along y and x.
    weights : ndarray, shape (n,)
        Weight of each neighbour.
    period
        Rows after which values repeat; 0: never. Row 0 is then a copy.
    values, result : ndarray, shape (ny, nx)
        Values and their sums; nothing is beyond the columns.
    rows
        First row that is written and the one behind the last.
    """
    ny, nx = values.shape
    for j in range(rows[0], rows[1]):
        row = result[j]
        row[:] = 0.0
        for k in range(offsets.shape[0]):
            jj = j + offsets[k, 0]
            if period > 0:
                jj = 1 + (jj - 1) % period
            if not 0 <= jj < ny:
                continue
            di, weight = offsets[k, 1], weights[k]
            low, high = max(0, -di), min(nx, nx - di)
            total, value = row[low:high], values[jj, low + di : high + di]
            for i in range(total.size):
                total[i] += weight * value[i]


class ShortDeflection:
    """Deflection under pressure without the waves that the next coarser grid holds.

    Long waves reach far; without them deflection falls off within a few nodes.

    Parameters
    ----------
    coefficients : ndarray, shape (rows, nx)
        Deflection under unit pressure on a cell so far away; of all rows where they repeat.
    sides
        Boundary conditions along y.
    halved
        Whether the next coarser grid has fewer rows, and fewer columns.

    Attributes
    ----------
    offsets, weights : ndarray, shapes (n, 2) and (n,)
        Steps to neighbours along y and x, and the deflection under their pressure.

    Notes
    -----
    The share 1 - (cos(k_x dx/2) cos(k_y dy/2))^16 of the transform of the coefficients is kept,
    with a cosine for each side that is halved. The rest is what means of neighbours have as well.
    """

    def __init__(self, coefficients: Array, sides: Sides, halved: tuple[bool, bool]) -> None:
        self._sides = sides
        self._period = coefficients.shape[0] if sides.closed else 0
        whole = coefficients
        if not sides.closed:
            whole = np.concatenate((whole, whole[-2:0:-1]), axis=0)
        whole = np.concatenate((whole, whole[:, -2:0:-1]), axis=1)
        long = [
            np.cos(np.pi * np.fft.fftfreq(count)) ** _SHARPNESS if half else np.ones(count)
            for count, half in zip(whole.shape, halved, strict=True)
        ]
        short = np.fft.ifft2(np.fft.fft2(whole) * (1.0 - np.outer(*long))).real
        places = np.argwhere(np.abs(short) > _LEAST * short[0, 0])
        self.weights = short[tuple(places.T)].astype(np.float32)
        size = np.array(short.shape)
        self.offsets = np.where(places > size // 2, places - size, places)

    def __call__(self, pressure: Any, workers: RowWorkers) -> Any:
        """Return the deflection, shape (ny, nx), as a new array."""
        result = np.empty(pressure.shape, dtype=np.float32)
        given = self.offsets, self.weights, self._period, np.ascontiguousarray(pressure)
        workers.share(lambda rows: sum_neighbours(*given, rows, result), *result.shape)
        self._sides.fill(result)
        return result


class ClosedDeflection:
    """Deflection of solids that repeat along y; those beside closed sides without flow as well.

    Parameters
    ----------
    modes : ndarray, shape (nx, rows//2 + 1)
        From `periodic_modes`.
    sides
        Boundary conditions along y.
    rows
        Number of rows without copied ones.
    single
        In float32, for preconditioners.
    workers
        Threads that share it; results do not depend on it.
    """

    def __init__(
        self,
        modes: Array,
        sides: Sides,
        rows: int,
        *,
        single: bool = False,
        workers: RowWorkers = ALONE,
    ) -> None:
        self._sides = sides
        self._convolution = PeriodicDeflection(modes, rows, "first", single=single, workers=workers)
        kind: Any = np.float32 if single else np.float64
        self._result: Any = np.zeros((rows + 2, modes.shape[0]), dtype=kind)

    def __call__(self, pressure: Array) -> Array:
        """Return the deflection, (rows + 2, nx), under a pressure whose copied rows do not count.

        The result is overwritten by the next call.
        """
        self._result[1:-1] = self._convolution(pressure[1:-1])
        self._sides.fill(self._result)
        return np.asarray(self._result)


class PointGrid:
    """Grid of shape (ny, nx) in the units of the scales; it does not change.

    Parameters
    ----------
    problem, scales, shape
        Contact, its units, rows and columns without copied rows.
    grading
        Of the spacing along x, for entrainment along x; None: uniform.

    Attributes
    ----------
    shape : tuple
        Rows, those included that `sides` copies, and columns.
    sides : Sides
        Of the rows.
    x, y : ndarray
        Nodes along the axes of the problem [m], without copied rows.
    dx, dy : float
        Spacing; the smallest along x [-].
    positions : ndarray, shape (nx,)
        Of the columns along x [-].
    graded : bool
        The spacing along x varies.
    metric : MeshMetric
        Spacing along x against dx.
    modulus : float
        E* [-].
    coefficients : ndarray
        Deflection under unit pressure on a cell, as the convolutions take it [-].
    cell : float
        dx dy [-].
    cells : ndarray, shape (nx,)
        Areas of the cells of a row [-].
    workers : RowWorkers
        Threads that share the work on rows; results do not depend on it.
    """

    def __init__(
        self,
        problem: PointContactProblem,
        scales: PointScales,
        shape: tuple[int, int],
        grading: Grading | None = None,
    ) -> None:
        ny, nx = shape
        self.sides = sides = Sides(problem.sides)
        self.shape = sides.whole(ny), nx
        nodes = (ny, nx) if scales.swap else (nx, ny)
        self.x = x = x_nodes(problem.x_limits, nodes[0], grading)
        self.y = y = sides.rows(problem.y_limits, nodes[1])
        step_x, step_y = float(np.diff(x).min()) if grading else x[1] - x[0], y[1] - y[0]
        if scales.swap:
            step_x, step_y = step_y, step_x
        self.dx, self.dy = step_x / scales.length, step_y / scales.length
        self.modulus = problem.contact_modulus * scales.film / (scales.pressure * scales.length)
        self.positions = x / scales.length if grading else np.arange(nx) * self.dx
        self.graded = grading is not None
        self.workers = ALONE  # who share the rows
        if self.graded and sides.closed:
            raise ParameterError(
                f"A grid that is graded cannot be combined with sides {sides.name}. Use a uniform "
                "spacing."
            )
        self.modes: Array | None = None
        if sides.closed:
            self.metric = MeshMetric(np.ones(nx), np.ones(nx))
            reference = _REFERENCE * (problem.x_limits[1] - problem.x_limits[0]) / scales.length
            self.modes = periodic_modes(self.dx, self.dy, nx, ny, self.modulus, reference)
            self.coefficients = periodic_coefficients(self.modes, ny)
        elif self.graded:
            self.metric = mesh_metric(self.positions, self.dx)
            self.coefficients = graded_coefficients(
                cell_faces(self.positions), self.positions, self.dy, ny, self.modulus
            )
        else:
            self.metric = MeshMetric(np.ones(nx), np.ones(nx))
            self.coefficients = love_coefficients(self.dy, self.dx, ny, nx, 1.0) * (
                self.dx * self.dy / self.modulus
            )
        self.deflection = self.convolution()
        self.cell = self.dx * self.dy
        self.cells = self.cell / self.metric.narrow
        self._dense: Array | None = None
        self._short: dict[tuple[bool, bool], ShortDeflection] = {}

    def set_workers(self, workers: RowWorkers) -> None:
        """Set who share the work on rows."""
        self.workers = workers
        self.deflection = self.convolution()
        vars(self).pop("single_deflection", None)

    def convolution(
        self, single: bool = False
    ) -> HalfSpaceConvolution | GradedConvolution | ClosedDeflection:
        """Return the deflection under a pressure as a function, in float32 for preconditioners."""
        if self.modes is not None:
            return ClosedDeflection(
                self.modes, self.sides, self.shape[0] - 2, single=single, workers=self.workers
            )
        kind = GradedConvolution if self.graded else HalfSpaceConvolution
        return kind(self.coefficients, single=single)

    @cached_property
    def single_deflection(self) -> HalfSpaceConvolution | GradedConvolution | ClosedDeflection:
        """Return the deflection in float32, kept for preconditioners."""
        return self.convolution(single=True)

    def short_deflection(self, pressure: Any, halved: tuple[bool, bool]) -> Any:
        """Return the deflection under short waves of pressure, see `ShortDeflection`, float32.

        A graded grid takes its whole deflection.
        """
        if self.graded:
            return np.array(self.single_deflection(pressure))
        return self.short_waves(halved)(pressure, self.workers)

    def short_waves(self, halved: tuple[bool, bool]) -> ShortDeflection:
        """Return the deflection under short waves on a uniform grid as a sum over neighbours."""
        if halved not in self._short:
            self._short[halved] = ShortDeflection(self.coefficients, self.sides, halved)
        return self._short[halved]

    @property
    def own_deflection(self) -> Array:
        """Return the deflection of nodes under unit pressure on their own cell, (ny, nx) [-]."""
        own = self.coefficients[0].diagonal() if self.graded else self.coefficients[0, 0]
        return np.broadcast_to(own, self.shape)

    def dense_deflection(self) -> Array:
        """Return the matrix of deflection per unit pressure, shape (ny nx, ny nx) [-]."""
        if self._dense is None:
            rows, columns = (n.ravel() for n in np.indices(self.shape))
            if self.sides.closed:
                # of a copied row that of the row itself will do: it carries no pressure
                rows = (rows - 1) % (self.shape[0] - 2)
            apart = abs(columns[:, None] - columns)
            along = (columns[:, None], columns) if self.graded else (apart,)
            self._dense = self.coefficients[(abs(rows[:, None] - rows), *along)]
        return self._dense

    def central_spacing(self) -> Array | None:
        """Return dx over the central spacing of the columns, (nx,) [-]; None: 1 everywhere."""
        return central_metric(self.positions, self.dx) if self.graded else None

    # of the pressure: the load [jamali_2015 (4.5)]
    def integral(self, values: Array) -> float:
        """Return the sum of values, shape (ny, nx), times the areas of their cells."""
        return float(self.sides.inner(values).sum(axis=0) @ self.cells)
