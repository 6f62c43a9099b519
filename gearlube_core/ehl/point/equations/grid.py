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
from gearlube_core.contact.half_space_periodic import periodic_coefficients, periodic_modes
from gearlube_core.ehl.point.equations.closed_deflection import ClosedDeflection
from gearlube_core.ehl.point.equations.mesh import (
    Grading,
    cell_faces,
    central_metric,
    mesh_metric,
    x_nodes,
)
from gearlube_core.ehl.point.equations.short_deflection import ShortDeflection
from gearlube_core.ehl.point.equations.stencil import MeshMetric
from gearlube_core.ehl.point.problem import PointContactProblem
from gearlube_core.ehl.point.scaling import PointScales
from gearlube_core.ehl.point.sides import Sides
from gearlube_core.errors import ParameterError
from gearlube_core.kernels.row_workers import ALONE, RowWorkers

_REFERENCE = 2.0  # lengths of the domain, where a repeated load leaves the solids as they were


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
