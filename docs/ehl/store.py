"""Steady films and marches, each computed once and kept in a folder."""

from __future__ import annotations

import logging
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from docs.ehl.cases import STEPS, FilmCase
from docs.ehl.lines import Lines, March
from gearlube_core.arrays import Array
from gearlube_core.ehl.gears.helical_film import march_helical_cycle, solve_helical_line
from gearlube_core.ehl.point.dry_contact import dry_contact_of_gap
from gearlube_core.ehl.point.settings import PointSolverSettings
from gearlube_core.ehl.transient.history import MarchRecord
from gearlube_core.ehl.transient.solution import FilmSolution
from gearlube_core.errors import ConvergenceError
from gearlube_core.storage.atomic_file import write_arrays

logger = logging.getLogger("docs.ehl")

# steady films take the stencil of the march, so that both may be compared
SETTINGS = PointSolverSettings(wedge="quick", tolerance=1e-5)
_NUMBERS = (
    "dry_pressure", "load", "load_error", "seconds", "border_pressure", "solid_share", "solid_area",
)  # fmt: skip
_LOADED = 1.0e6  # Pa; from where a section counts as loaded
_EVERY = 25  # steps between records of a march
_GIVE_UP = 10  # steps on end that fail before a march is given up


@dataclass(frozen=True, slots=True, kw_only=True)
class Steady:
    """A film at rest and the dry contact of the same gap, on the same grid."""

    x: Array  # [m]
    y: Array  # [m]
    pressure: Array  # [Pa], shape (x, y)
    film: Array  # [m], shape (x, y)
    dry_pressure: float  # largest of the dry contact [Pa]
    load: float  # [N]
    load_error: float
    converged: bool
    outcome: str
    seconds: float  # of the processor
    border_pressure: float = 0.0  # beside the border over the largest of all [-]
    solid_share: float = 0.0  # of the load
    solid_area: float = 0.0  # [m^2]

    @property
    def max_pressure(self) -> float:
        """Return the largest pressure [Pa]."""
        return float(self.pressure.max())

    @property
    def min_film(self) -> float:
        """Return the smallest film [m]."""
        return float(self.film.min())

    @property
    def along(self) -> Array:
        """Return the largest pressure of every section [Pa]."""
        return np.asarray(self.pressure.max(axis=0))

    @property
    def length(self) -> float:
        """Return the length of the loaded part of the line [m]."""
        rows = self.y[self.along > _LOADED]
        return float(rows[-1] - rows[0]) if rows.size else 0.0

    def column(self, y: float) -> int:
        """Return the number of the section nearest to y [m]."""
        return int(np.abs(self.y - y).argmin())


class _Given(Exception):  # noqa: N818
    """A march is given up."""


class MissingFilmError(Exception):
    """A film is not in the folder and may not be computed."""


class Store:
    """Films by their names in a folder.

    Parameters
    ----------
    folder
        Made if it is not there.
    compute
        Whether what is missing is computed; else it raises `MissingFilmError`.
    """

    def __init__(self, folder: Path, compute: bool = True) -> None:
        self.folder, self.compute = folder, compute
        folder.mkdir(parents=True, exist_ok=True)

    def kept(self, name: str, compute: Callable[[], Mapping[str, Any]]) -> dict[str, Any]:
        """Return the arrays of a name, computed if they are not in the folder."""
        path = self.folder / f"{name}.npz"
        if not path.exists():
            if not self.compute:
                raise MissingFilmError(name)
            logger.info("computing %s", name)
            write_arrays(path, compute(), compress=True)
        with np.load(path) as data:
            return {key: data[key] for key in data.files}

    def steady(self, case: FilmCase, step: float) -> Steady:
        """Return the steady film of a case at one of the thesis' steps."""
        name = f"steady_{case.name}_at{step:g}"
        values = self.kept(name, lambda: _solve_steady(case, step))
        for name in _NUMBERS:
            values[name] = float(values[name])
        values["converged"], values["outcome"] = bool(values["converged"]), str(values["outcome"])
        return Steady(**values)

    def march(
        self, case: FilmCase, first: int = 0, last: int = 575, keep: tuple[int, ...] = ()
    ) -> March:
        """Return the transient film of a case between two of the thesis' steps.

        The film is steady at the first. Steps in `keep` are those of the thesis too.
        """
        name = f"march_{case.name}_from{first}_to{last}"
        values = self.kept(name, lambda: self._march(case, first, last, keep, name))
        for part in self.folder.glob(f"{name}.*part.npz"):
            part.unlink()
        return March.of(values)

    def _march(
        self, case: FilmCase, first: int, last: int, keep: tuple[int, ...], name: str
    ) -> dict[str, Any]:
        film = case.film()
        record = self.folder / f"{name}.record_part.npz"
        beside = self.folder / f"{name}.lines_part.npz"
        begin, end = (round(case.number(n)) for n in (first, last))
        lines = Lines.read(beside)
        if not record.exists() or MarchRecord.read(record).steps + 1 != len(lines.rows):
            record.unlink(missing_ok=True)
            lines = Lines()
        began, complete = time.monotonic(), True
        spent = time.process_time()

        def follow(n: int, last: int, solution: FilmSolution) -> None:
            nonlocal spent
            now = time.process_time()
            lines.add(n, solution, n in wanted, now - spent)
            spent = now
            given_up = lines.failed_on_end() >= _GIVE_UP
            if n % _EVERY == 0 or n == last or given_up:
                lines.write(beside)
                logger.info("  step %d of %d, %.0f s", n, last, time.monotonic() - began)
            if given_up:
                raise _Given

        wanted = {round(case.number(n)) for n in keep}
        try:
            march_helical_cycle(
                film, first=begin, last=end, settings=SETTINGS, checkpoint=record,
                checkpoint_every=_EVERY, progress=follow, throw=False,
            )  # fmt: skip
        except _Given:
            complete = False
        except ConvergenceError as error:
            logger.info("  %s", error)
            complete = False
        moving = film.moving_film()
        scale = STEPS / case.count
        return lines.arrays(scale) | {"x": moving.x, "y": moving.y, "complete": complete}


def _solve_steady(case: FilmCase, step: float) -> dict[str, Any]:
    film = case.film()
    began = time.process_time()
    found = solve_helical_line(film, case.number(step), SETTINGS, throw=False)
    seconds = time.process_time() - began
    X = film.line(case.number(step) * film.time_step)
    load = film.load(X)
    dry = dry_contact_of_gap(
        film.gap(found.x, found.y, X), found.x[1] - found.x[0], found.y[1] - found.y[0],
        film.contact_modulus, load, tolerance=1e-4,
    )  # fmt: skip
    return {
        "x": found.x,
        "y": found.y,
        "pressure": found.pressure.astype(np.float32),
        "film": found.film.astype(np.float32),
        "dry_pressure": dry.pressure.max(),
        "load": load,
        "load_error": found.load_error,
        "converged": found.converged,
        "outcome": found.outcome,
        "seconds": seconds,
        "border_pressure": found.border_pressure,
        "solid_share": found.touch.share,
        "solid_area": found.touch.area,
    }
