"""Statistics and work of every step of a rough march, and how a record holds them."""

from __future__ import annotations

import math

import numpy as np
import xarray as xr

from gearlube_core.arrays import Array
from gearlube_core.ehl.case.rough_case import RoughCase
from gearlube_core.ehl.point.solver import solve_point_contact
from gearlube_core.ehl.statistics.rough_film import FilmFriction, RoughFilmStatistics
from gearlube_core.ehl.statistics.zone import FilmZone
from gearlube_core.ehl.transient.solution import FilmSolution
from gearlube_core.errors import ParameterError

# of every step beside its statistics: name, unit, words
WORK = (
    ("converged", "1", "1 where the step converged"),
    ("residual", "1", "unbalanced flow"),
    ("load_error", "1", "missing share of the load"),
    ("time_error", "1", "estimated error of the smallest film by the time steps"),
    ("newton_steps", "1", "Newton steps"),
    ("krylov_steps", "1", "iterations of linear solutions"),
    ("seconds", "s", "wall time"),
)


def composite_roughness(case: RoughCase) -> float:
    """Return sqrt(Rq_1^2 + Rq_2^2) [m]."""
    return math.sqrt(sum(float(one.heights.height.var()) for one in case.surfaces()))


def new_statistics(case: RoughCase, *, smooth: bool = True) -> RoughFilmStatistics:
    """Return the statistics of a case without any film.

    Parameters
    ----------
    case
        Case.
    smooth
        Solve the smooth film, for the lambda ratio.
    """
    section, schedule = case.section(), case.schedule()
    friction = None
    if section.sliding is not None:
        friction = FilmFriction(
            oil=section.lubricant,
            sliding=section.sliding,
            solid_coefficient=case.touching.friction,
        )
    film = solve_point_contact(section, case.settings(), throw=False) if smooth else None
    known = film is not None and film.converged
    return RoughFilmStatistics(
        zone=FilmZone.line(section.x, section.y, section.hertz_contact[0]),
        roughness=composite_roughness(case),
        smooth_film=film.central_film if known and film is not None else None,
        solids=case.touching_solids(),
        friction=friction,
        gather_from=schedule.time(schedule.until_rough),
    )


class Gathered:
    """Statistics and work of the steps so far.

    Parameters
    ----------
    case
        Case.
    """

    def __init__(self, case: RoughCase) -> None:
        self.statistics = new_statistics(case)
        self._work: list[list[float]] = []

    @property
    def steps(self) -> int:
        """Number of steps so far, the start included."""
        return len(self._work)

    def add(self, solution: FilmSolution) -> None:
        """Take up a film; what is below a vanished film counts as none."""
        self.statistics.add(solution.time, np.maximum(solution.film, 0.0), solution.pressure)
        self._work.append([float(getattr(solution, name)) for name, _, _ in WORK])

    def packed(self) -> Array:
        """Return all as one array, shape (n,), for `unpack`."""
        work = np.array(self._work).ravel()
        return np.concatenate(([float(len(self._work))], work, self.statistics.gathered()))

    def unpack(self, packed: Array) -> None:
        """Go on from what `packed` returned.

        Raises
        ------
        ParameterError
            It is of another kind.
        """
        count = int(packed[0]) if packed.size else 0
        end = 1 + count * len(WORK)
        if count < 1 or packed.size <= end:
            raise ParameterError(
                f"the record must hold the statistics of a rough march, got {packed.size} numbers. "
                "Remove it and start again."
            )
        self._work = packed[1:end].reshape(count, len(WORK)).tolist()
        self.statistics.resume(packed[end:])

    def dataset(self) -> xr.Dataset:
        """Return statistics and work over time."""
        dataset = self.statistics.dataset()
        table = np.array(self._work)
        for k, (name, unit, words) in enumerate(WORK):
            notes = {"units": unit, "long_name": words}
            dataset[name] = (("time",), table[:, k], notes)
        dataset["step"] = (("time",), np.arange(len(table), dtype=np.float64), {"units": "1"})
        return dataset
