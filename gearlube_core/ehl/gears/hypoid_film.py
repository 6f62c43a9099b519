"""The film of one hypoid tooth pair as its contact rolls over the flanks."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.checks import check_option, check_within
from gearlube_core.ehl.gears.hypoid_flank import FlankCycle, FlankInstant
from gearlube_core.ehl.point.contact_domain import elliptical_contact
from gearlube_core.ehl.point.problem import PointContactProblem
from gearlube_core.ehl.transient.level import FilmConditions
from gearlube_core.ehl.transient.problem import MovingFilm
from gearlube_core.oil.film_oil import FilmOil

FLOWS = ("eyring", "newtonian")

# along the major axis, in its semi-axis: oil enters across the minor one. What is carried farther
# out is that of the oil beyond
_Y_REACH = (-1.5, 1.3)


def flank_contact(
    instant: FlankInstant,
    contact_modulus: float,
    lubricant: FilmOil,
    nodes: tuple[int, int],
    oil_beyond: bool = True,
) -> PointContactProblem:
    """Return the steady contact of one instant on a domain of its own.

    Parameters
    ----------
    instant
        Load, radii and motion.
    contact_modulus
        E* [Pa].
    lubricant
        As it flows.
    nodes
        Along the minor and along the major axis.
    oil_beyond
        As in `PointContactProblem`. False takes a larger inlet where films are thick.
    """
    problem = elliptical_contact(
        R_x=instant.R_x,
        R_y=instant.R_y,
        entrainment=instant.entrainment,
        load=instant.load,
        contact_modulus=contact_modulus,
        lubricant=lubricant,
        nodes=nodes,
        sliding=instant.sliding,
        oil_beyond=oil_beyond,
    )
    semi_axis = problem.hertz_contact[1]
    low, high = (reach * semi_axis for reach in _Y_REACH)
    return replace(problem, y_limits=(low, high))


@dataclass(frozen=True, slots=True, kw_only=True)
class HypoidFilm:
    """Film of one tooth pair through its engagement.

    Parameters
    ----------
    cycle : FlankCycle
        Load, radii and motion of the contact.
    lubricant : FilmOil
        Its Eyring stress, if it has one, acts on the traction, and on the flow as `flow` says.
    contact_modulus
        E* [Pa].
    nodes
        Along the minor and along the major axis of the ellipse.
    flow
        "eyring": the oil flows as it shears, along and across sliding; "newtonian": as an oil
        without an Eyring stress.

    Raises
    ------
    ParameterError
        An input is out of range.

    Notes
    -----
    Film x is the minor axis, y the major one. Entrainment has components along both, steady and
    in time. The axes move with the contact: what the flanks' frame sees of the ellipse's slow
    turning is left out.
    """

    cycle: FlankCycle
    lubricant: FilmOil
    contact_modulus: float
    nodes: tuple[int, int] = (257, 65)
    flow: str = "eyring"

    def __post_init__(self) -> None:
        check_option("flow", self.flow, FLOWS)
        for axis, count in zip(("minor", "major"), self.nodes, strict=True):
            check_within(f"nodes along the {axis} axis", count, 17, 2049)

    def problem(self, instant: FlankInstant) -> PointContactProblem:
        """Return the steady contact of one instant on a domain of its own."""
        return flank_contact(instant, self.contact_modulus, self._flowing(), self.nodes)

    def domain(self) -> tuple[tuple[float, float], tuple[float, float]]:
        """Return limits along x and y [m] that contain the contact of all instants."""
        contact = (self.contact_modulus, self._flowing(), self.nodes, False)
        problems = [flank_contact(instant, *contact) for instant in self.cycle.instants()]
        limits = np.array([[*problem.x_limits, *problem.y_limits] for problem in problems])
        low, high = limits.min(axis=0), limits.max(axis=0)
        return (float(low[0]), float(high[1])), (float(low[2]), float(high[3]))

    def conditions(self, x: Array, y: Array, time: float) -> FilmConditions:
        """Return gap, load and speeds of the film at a time [s]."""
        now = self.cycle.at(time)
        u, v = now.entrainment
        slip, side_slip = now.sliding
        return FilmConditions(
            gap=now.gap(x[:, None], y[None, :]),
            load=now.load,
            speed_1=np.full(y.size, u - 0.5 * slip),
            speed_2=np.full(y.size, u + 0.5 * slip),
            slope=v / u,
            side_sliding=side_slip,
        )

    def moving_film(self) -> MovingFilm:
        """Return the film in time with the scales of the largest load."""
        most = self.cycle.at(float(self.cycle.time[self.cycle.load.argmax()]))
        x_limits, y_limits = self.domain()
        return MovingFilm(
            conditions=self.conditions,
            lubricant=self._flowing(),
            contact_modulus=self.contact_modulus,
            x_limits=x_limits,
            y_limits=y_limits,
            nodes=self.nodes,
            hertz=most.gap,
            load=most.load,
            speed=most.entrainment[0],
        )

    def _flowing(self) -> FilmOil:
        return self.lubricant if self.flow == "eyring" else self.lubricant.newtonian()
