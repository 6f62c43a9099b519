"""What is kept of every step of a march."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.ehl.transient.solution import FilmSolution

COLUMNS = (
    "number", "max_pressure", "max_pressure_y", "min_film", "min_film_y", "load_error",
    "converged", "seconds", "border_pressure", "solid_share", "solid_area",
)  # fmt: skip


_LOST = 10  # steps on end that fail before a film counts as lost


class LostFilmError(Exception):
    """The film of a march was lost before the step that is asked for."""


def row_of(n: int, solution: FilmSolution, seconds: float) -> list[float]:
    """Return the numbers of a step in the order of `COLUMNS`; `seconds` of the processor."""
    pressure, film = solution.pressure, solution.film
    row = int(pressure.max(axis=0).argmax())
    thin = int(film.min(axis=0).argmin())
    return [
        n, pressure.max(), solution.y[row], film.min(), solution.y[thin], solution.load_error,
        solution.converged, seconds, solution.border_pressure, solution.touch.share,
        solution.touch.area,
    ]  # fmt: skip


@dataclass(frozen=True, slots=True, kw_only=True)
class March:
    """Curves over part of a cycle that begins at rest."""

    step: Array  # of the thesis' 575
    table: Array  # (steps, COLUMNS)
    kept_steps: Array
    kept_pressure: Array  # [Pa], (kept, x, y)
    kept_film: Array  # [m]

    @property
    def complete(self) -> bool:
        """Whether the film was not lost for good: some of the last steps converged."""
        last = self["converged"][-_LOST:]
        return last.size < _LOST or bool((last > 0.0).any())

    def __getitem__(self, column: str) -> Array:
        """Return a column by its name."""
        return np.asarray(self.table[:, COLUMNS.index(column)])

    @property
    def failures(self) -> int:
        """Return the number of steps that did not converge."""
        return int((self["converged"] == 0.0).sum())

    @property
    def last_found(self) -> float:
        """Return the last step that converged; nan if none did."""
        found = self.step[self["converged"] > 0.0]
        return float(found[-1]) if found.size else np.nan

    def whole(self) -> March:
        """Return the march, whose film must not have been lost."""
        if not self.complete:
            raise LostFilmError(f"lost after step {self.last_found:.0f}")
        return self

    def row(self, step: float) -> int:
        """Return the row of the nearest step."""
        if not step <= self.last_found:
            self.whole()
        return int(np.abs(self.step - step).argmin())

    def at(self, column: str, step: float) -> float:
        """Return a column at the nearest step."""
        return float(self[column][self.row(step)])

    def fields(self, step: float) -> tuple[Array, Array]:
        """Return pressure [Pa] and film [m] of a kept step, shape (x, y)."""
        if not step <= self.last_found:
            self.whole()
        i = int(np.abs(self.kept_steps - step).argmin())
        return self.kept_pressure[i], self.kept_film[i]
