"""One grid of a film whose gap, load and surface speeds change in time and along the contact."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.checks import check_positive, check_within
from gearlube_core.ehl.point.equations.grid import PointGrid
from gearlube_core.ehl.point.equations.stencil import Grading
from gearlube_core.ehl.point.level import PointLevel, Scheme
from gearlube_core.ehl.point.problem import PointContactProblem
from gearlube_core.ehl.point.scaling import PointScales
from gearlube_core.ehl.point.settings import FEWEST_ROWS
from gearlube_core.ehl.point.terms.boundary import AmbientOutside
from gearlube_core.ehl.point.terms.differences import Differences, Storage
from gearlube_core.ehl.point.terms.film_terms import RowEntrainment, film_shear
from gearlube_core.ehl.point.terms.solids import NoContact, TouchingSolids
from gearlube_core.ehl.point.terms.state import FilmState
from gearlube_core.errors import ParameterError

_STEEPEST = 20.0  # of entrainment against x
_MOST_NODES = 0.05  # share of the nodes with pressure; more are no peaks of roughness
_CALLS = 12
_SHARE = 0.7  # of what is missing, in one call: neighbours lift each other
_BEYOND = 1.5  # the least film, which is aimed at


@dataclass(frozen=True, slots=True)
class FilmConditions:
    """Terms that act on a film at one time, on the nodes of one grid.

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


def lifted(level: MovingLevel, state: FilmState, least: Array | float) -> FilmState | None:
    """Return the state with pressure added where its film is too thin.

    Parameters
    ----------
    level
        Grid level with its equations.
    state
        A trial; its film may be below zero.
    least : ndarray, shape (ny, nx), or float
        Film that every node should have [-].

    Returns
    -------
    FilmState or None
        None: more than a few nodes are too thin, or they are still after twelve calls.

    Notes
    -----
    A linearised film overshoots at peaks. To shorten the step everywhere for their sake, or to part
    the solids, costs far more steps than to press these peaks down by themselves.
    """
    pressure, film = state.pressure.copy(), state.film
    own, limit = level.grid.own_deflection, np.broadcast_to(least, film.shape)
    few = _MOST_NODES * np.count_nonzero(pressure > 0.0)
    for _ in range(_CALLS):
        low = film < limit
        count = np.count_nonzero(low)
        if count == 0:
            return level.state(pressure, state.approach)
        if count > few:
            return None
        pressure[low] += _SHARE * (_BEYOND * limit - film)[low] / own[low]
        film = level.film(pressure, state.approach)
    return None


def lifted_off_solids(level: MovingLevel, state: FilmState) -> FilmState:
    """Return the state lifted where solids press on each other far more than the pressure says.

    Parameters
    ----------
    level
        Grid level with its equations.
    state
        A trial; its film is above zero.

    Returns
    -------
    FilmState
        As given where no node, or more than a few, are pressed too far.

    Notes
    -----
    The pressure of a layer rises with the second power of 1/h: a Newton step that left a node with
    too thin a film is followed by steps that each make it thicker by a third or so. Such nodes get
    the film at which their layer carries the pressure, at once.
    """
    contact, solids = state.contact, level.terms.solids
    if isinstance(contact, NoContact) or not isinstance(solids, TouchingSolids):
        return state
    carrying = solids.layer.film(np.maximum(state.pressure, 0.0))
    least = np.where(contact.left < 0.0, carrying / _BEYOND, 0.0)
    if not (state.film < least).any():
        return state
    return lifted(level, state, least) or state
