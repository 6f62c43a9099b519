"""Steady films and marches, each computed once and kept in a folder."""

from __future__ import annotations

import logging
import time
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from docs.ehl.cases import STEPS, FilmCase
from docs.ehl.lines import COLUMNS, March, row_of
from docs.kept_films import KeptFilms
from gearlube_core.arrays import Array
from gearlube_core.ehl.gears.helical_film import solve_helical_line
from gearlube_core.ehl.point.dry_contact import dry_contact_of_gap
from gearlube_core.ehl.point.settings import PointSolverSettings
from gearlube_core.ehl.transient.curves import NumberedSteps, march_curves
from gearlube_core.ehl.transient.solution import FilmSolution

logger = logging.getLogger("docs.ehl")

# steady films take the stencil of the march, so that both may be compared
SETTINGS = PointSolverSettings(wedge="quick", tolerance=1e-5)
_NUMBERS = (
    "dry_pressure", "load", "load_error", "seconds", "border_pressure", "solid_share", "solid_area",
)  # fmt: skip
_LOADED = 1.0e6  # Pa; from where a section counts as loaded
_EVERY = 25  # steps between records of a march


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


class Store(KeptFilms):
    """Films of the page by their cases."""

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
        record = self.folder / f"{name}.record_part.npz"
        values = self.kept(name, lambda: _march(case, first, last, keep, record))
        record.unlink(missing_ok=True)
        return March(**{key: values[key] for key in March.__slots__})


def _march(
    case: FilmCase, first: int, last: int, keep: tuple[int, ...], record: Path
) -> dict[str, Any]:
    film = case.film()
    begin, end = (round(case.number(n)) for n in (first, last))
    began, spent = time.monotonic(), time.process_time()

    def row(n: int, solution: FilmSolution) -> list[float]:
        nonlocal spent
        seconds, spent = time.process_time() - spent, time.process_time()
        return row_of(n, solution, seconds)

    def follow(n: int, last: int, _: FilmSolution) -> None:
        if n % _EVERY == 0 or n == last:
            logger.info("  step %d of %d, %.0f s", n, last, time.monotonic() - began)

    curves = march_curves(
        film.moving_film(),
        COLUMNS,
        row,
        NumberedSteps(begin, end, begin * film.time_step, film.time_step),
        settings=SETTINGS,
        keep=tuple(round(case.number(n)) for n in keep),
        checkpoint=record,
        checkpoint_every=_EVERY,
        progress=follow,
        throw=False,
    )
    scale, kept = STEPS / case.count, [curves.kept[n] for n in sorted(curves.kept)]
    return {
        "step": curves["number"] * scale,
        "table": curves.table,
        "kept_steps": np.array(sorted(curves.kept), dtype=float) * scale,
        "kept_pressure": np.array([one.pressure.astype(np.float32) for one in kept]),
        "kept_film": np.array([one.film.astype(np.float32) for one in kept]),
    }


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
