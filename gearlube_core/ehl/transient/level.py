"""One grid of a film whose gap, load and surface speeds change in time and along the contact."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.checks import check_positive, check_within
from gearlube_core.ehl.point.equations.grid import PointGrid
from gearlube_core.ehl.point.equations.mesh import Grading
from gearlube_core.ehl.point.level import PointLevel, Scheme
from gearlube_core.ehl.point.problem import PointContactProblem
from gearlube_core.ehl.point.scaling import PointScales
from gearlube_core.ehl.point.sides import FEWEST_ROWS
from gearlube_core.ehl.point.terms.boundary import AmbientOutside
from gearlube_core.ehl.point.terms.differences import Differences
from gearlube_core.ehl.point.terms.entrainment import RowEntrainment
from gearlube_core.ehl.point.terms.film_terms import film_shear
from gearlube_core.ehl.point.terms.storage import Storage
from gearlube_core.ehl.transient.conditions import FilmConditions
from gearlube_core.errors import ParameterError

_STEEPEST = 20.0  # of entrainment against x


class MovingLevel(PointLevel):
    """Grid with surface speeds that vary across the motion, storage of oil and an Eyring film.

    The equation of a row is divided by nothing: its wedge is its own share of the speed of the
    scales. Entrainment points to larger x and not to smaller y.
    """

    def __init__(
        self,
        problem: PointContactProblem,
        scales: PointScales,
        shape: tuple[int, int],
        wedge: str,
        grading: Grading | None = None,
        *,
        scheme: Callable[[PointGrid], Scheme] = Differences,
    ) -> None:
        if scales.swap or scales.flip_x or problem.entrainment[1] != 0.0:
            raise ParameterError(
                "a film that changes in time must be entrained along x towards larger x, got "
                f"{problem.entrainment} m/s. Turn the axes."
            )
        super().__init__(problem, scales, shape, wedge, grading, scheme=scheme)
        # it slides as the conditions of a time say
        shear = film_shear(problem, scales, self.grid, (0.0, 0.0))
        self.terms = replace(self.terms, shear=shear)

    def set_conditions(self, conditions: FilmConditions) -> None:
        """Set gap, load and speeds; storage is kept."""
        check_positive("load", conditions.load, "N")
        mean = 0.5 * (conditions.speed_1 + conditions.speed_2)
        if not (mean > 0.0).all():
            raise ParameterError(
                "the mean of both surface speeds must be above 0 m/s on every row, got "
                f"{mean.min():.4g} m/s. Turn the x axis."
            )
        if conditions.slope != 0.0 and self._scheme.upwinds_along_x:
            raise ParameterError(
                "elements in a film that changes in time need entrainment along x, got a slope of "
                f"{conditions.slope:.4g}. Take differences."
            )
        check_within("slope", conditions.slope, 0.0, _STEEPEST, "", "Turn the y axis or the axes.")
        scales = self.scales
        self.set_load(conditions.load / (scales.pressure * scales.length**2))
        # of a row's own speed along x
        self.stencil = self.stencil._replace(wedge_y=conditions.slope / self.grid.dy)
        sides = self.grid.sides
        if sides.closed and (conditions.slope != 0.0 or conditions.side_sliding != 0.0):
            # the rows of the finest grid were checked with the film; coarse ones have fewer
            sides.check_goes_with(FEWEST_ROWS, conditions.slope, (0.0, conditions.side_sliding))
        self.gap = np.ascontiguousarray(sides.extended(conditions.gap.T / scales.film))
        mean = sides.extended(mean)
        sliding = sides.extended(conditions.speed_2 - conditions.speed_1)
        self.terms = replace(
            self.terms,
            entrainment=RowEntrainment(mean / scales.speed),
            shear=self.terms.shear.with_sliding(sliding, conditions.side_sliding),
        )

    def hold_ambient_above(self, film: Array, limit: float) -> None:
        """Hold ambient pressure where a film, (ny, nx) [-], passes a limit [m]."""
        self.set_boundary(AmbientOutside(film <= limit / self.scales.film, self.grid.sides))

    def set_storage(self, rate: Array | float, source: Array) -> None:
        """Set the rate at which rho h is stored and what is stored already, (ny, nx) [-]."""
        self.terms = replace(self.terms, storage=Storage.of(rate, source, self.shape))
