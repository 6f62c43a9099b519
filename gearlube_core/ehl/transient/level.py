"""One grid of a film whose gap, load and surface speeds change in time and along the contact."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.checks import check_finite, check_positive, check_within
from gearlube_core.ehl.point.equations.level import PointLevel
from gearlube_core.ehl.point.equations.mesh import Grading, x_nodes
from gearlube_core.ehl.point.equations.state import FilmState
from gearlube_core.ehl.point.problem import PointContactProblem
from gearlube_core.ehl.point.scaling import PointScales
from gearlube_core.errors import ParameterError

_STEEPEST = 20.0  # of entrainment against x
_EVEN = 1e-9  # spread of sliding along x over that along y


@dataclass(frozen=True, slots=True)
class FilmConditions:
    """What acts on a film at one time, on the nodes of one grid.

    Parameters
    ----------
    gap : ndarray, shape (nx, ny)
        Of the undeformed solids [m], finite, up to a constant.
    load : float
        W [N].
    speed_1, speed_2 : ndarray, shape (ny,)
        Surface speeds along x [m/s]; their mean is above zero. They may vary across the motion,
        not along it.
    slope : float
        Entrainment along y over that along x [-], not below zero.
    side_sliding : float
        Speed along y of surface 2 less that of surface 1 [m/s], on all rows; where it is not
        zero the sliding along x must not vary either. It acts in an Eyring film alone.
    """

    gap: Array
    load: float
    speed_1: Array
    speed_2: Array
    slope: float = 0.0
    side_sliding: float = 0.0


# (x, y, time) to what acts then: nodes [m], shapes (nx,) and (ny,); time [s]
Conditions = Callable[[Array, Array, float], FilmConditions]


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
    ) -> None:
        if scales.swap or scales.flip_x or problem.entrainment[1] != 0.0:
            raise ParameterError(
                "a film that changes in time must be entrained along x towards larger x, got "
                f"{problem.entrainment} m/s. Turn the axes."
            )
        super().__init__(problem, scales, shape, wedge, grading)
        ny, nx = shape
        self.x: Array = x_nodes(problem.x_limits, nx, grading)
        self.y: Array = np.linspace(*problem.y_limits, ny)
        self.rate = np.ones((ny, 1))
        self.storage = np.zeros(shape)
        if problem.lubricant.shear.tau0 > 0.0:
            self.shear = self._film_shear(problem, (0.0, 0.0))

    def impose(self, conditions: FilmConditions) -> None:
        """Set gap, load and speeds; storage is kept."""
        check_positive("load", conditions.load, "N")
        mean = 0.5 * (conditions.speed_1 + conditions.speed_2)
        if not (mean > 0.0).all():
            raise ParameterError(
                "the mean of both surface speeds must be above 0 m/s on every row, got "
                f"{mean.min():.4g} m/s. Turn the x axis."
            )
        check_within("slope", conditions.slope, 0.0, _STEEPEST, "", "Turn the y axis or the axes.")
        scales = self.scales
        unit = scales.pressure * scales.length**2
        self.scales = replace(scales, load=conditions.load / unit)
        # of a row's own speed along x
        self.stencil = self.stencil._replace(wedge_y=conditions.slope / self.dy)
        self.flow_rate = self.stencil.wedge_x + self.stencil.wedge_y
        self.gap = np.ascontiguousarray(conditions.gap.T / scales.film)
        self.rate = (mean / scales.speed)[:, None]
        if self.shear is not None:
            sliding = conditions.speed_2 - conditions.speed_1
            self.shear.slide(sliding, _side_sliding(conditions, sliding))

    def open_where_thicker(self, film: Array, limit: float) -> None:
        """Hold ambient pressure where a film [m over the unit of films] passes a limit [m]."""
        self.closed = film <= limit / self.scales.film

    def keep(self, storage: Array | float, source: Array | float) -> None:
        """Set storage and what earlier times give, both in units of the scales."""
        self.storage = np.broadcast_to(np.asarray(storage, dtype=np.float64), self.shape)
        self.source = np.ascontiguousarray(
            np.broadcast_to(np.asarray(source, dtype=np.float64), self.shape)
        )

    def outflow(self, state: FilmState) -> Array:
        """Return what flows into every node without storage and source."""
        assert self.storage is not None
        return np.asarray(state.residual - self.source + self.storage * state.mass)


def _side_sliding(conditions: FilmConditions, along: Array) -> float:
    """Return the sliding along y [m/s] where all rows slide in one direction."""
    side = check_finite("side_sliding", conditions.side_sliding, "m/s")
    spread = float(np.ptp(along))
    if side != 0.0 and spread > _EVEN * abs(side):
        raise ParameterError(
            f"sliding along x must not vary over the rows where side_sliding is {side:.4g} m/s, "
            f"got a spread of {spread:.4g} m/s. Turn the axes along sliding."
        )
    return side
