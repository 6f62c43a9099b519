"""What is kept of every step of a march: curves, and the extremes of every section."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.ehl.transient.solution import FilmSolution
from gearlube_core.storage.atomic_file import write_arrays

COLUMNS = (
    "number", "max_pressure", "max_pressure_y", "min_film", "min_film_y", "load_error",
    "converged", "seconds", "border_pressure", "solid_share", "solid_area",
)  # fmt: skip


class GivenUpError(Exception):
    """A march was given up before the step that is asked for."""


@dataclass(slots=True)
class Lines:
    """Steps of a march that goes on."""

    rows: list[Array] = field(default_factory=list)  # COLUMNS
    pressure: list[Array] = field(default_factory=list)  # largest of every section [Pa]
    film: list[Array] = field(default_factory=list)  # smallest of every section [m]
    kept: dict[int, tuple[Array, Array]] = field(default_factory=dict)  # whole fields

    def add(self, n: int, solution: FilmSolution, keep: bool, seconds: float) -> None:
        """Add a step and what it took of the processor [s]."""
        pressure, film = solution.pressure, solution.film
        row = int(pressure.max(axis=0).argmax())
        thin = int(film.min(axis=0).argmin())
        self.rows.append(
            np.array(
                [n, pressure.max(), solution.y[row], film.min(), solution.y[thin],
                 solution.load_error, solution.converged, seconds, solution.border_pressure,
                 solution.touch.share, solution.touch.area]
            )
        )  # fmt: skip
        self.pressure.append(pressure.max(axis=0).astype(np.float32))
        self.film.append(film.min(axis=0).astype(np.float32))
        if keep:
            self.kept[n] = (pressure.astype(np.float32), film.astype(np.float32))

    def failed_on_end(self) -> int:
        """Return how many of the last steps failed one after the other."""
        failed = 0
        for row in reversed(self.rows):
            if row[COLUMNS.index("converged")]:
                break
            failed += 1
        return failed

    def arrays(self, scale: float = 1.0) -> dict[str, Any]:
        """Return everything as arrays; `scale` turns numbers of steps into those of the thesis."""
        table = np.array(self.rows).reshape(-1, len(COLUMNS))
        numbers = sorted(self.kept)
        return {
            "step": table[:, 0] * scale,
            "table": table,
            "pressure": np.array(self.pressure),
            "film": np.array(self.film),
            "kept_steps": np.array(numbers, dtype=float) * scale,
            "kept_pressure": np.array([self.kept[n][0] for n in numbers]),
            "kept_film": np.array([self.kept[n][1] for n in numbers]),
        }

    def write(self, path: Path) -> None:
        """Write the steps so far."""
        write_arrays(path, self.arrays(), compress=True)

    @classmethod
    def read(cls, path: Path) -> Lines:
        """Return the steps in a file; none if it is not there."""
        if not path.exists():
            return cls()
        with np.load(path) as data:
            kept = {
                int(n): (data["kept_pressure"][i], data["kept_film"][i])
                for i, n in enumerate(data["kept_steps"])
            }
            return cls(list(data["table"]), list(data["pressure"]), list(data["film"]), kept)


@dataclass(frozen=True, slots=True, kw_only=True)
class March:
    """Curves over part of a cycle that begins at rest."""

    step: Array  # of the thesis' 575
    table: Array  # (steps, COLUMNS)
    x: Array  # [m]
    y: Array  # [m]
    pressure: Array  # largest of every section [Pa], (steps, y)
    film: Array  # smallest of every section [m], (steps, y)
    kept_steps: Array
    kept_pressure: Array  # [Pa], (kept, x, y)
    kept_film: Array  # [m]
    complete: bool  # False: given up after steps that failed

    @classmethod
    def of(cls, kept: dict[str, Any]) -> March:
        """Return the march of kept arrays."""
        return cls(**(kept | {"complete": bool(kept["complete"])}))

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
        """Return the march, which must not have been given up."""
        if not self.complete:
            raise GivenUpError(f"given up after step {self.last_found:.0f}")
        return self

    def row(self, step: float) -> int:
        """Return the row of the nearest step."""
        if step > self.step[-1]:
            self.whole()
        return int(np.abs(self.step - step).argmin())

    def at(self, column: str, step: float) -> float:
        """Return a column at the nearest step."""
        return float(self[column][self.row(step)])

    def fields(self, step: float) -> tuple[Array, Array]:
        """Return pressure [Pa] and film [m] of a kept step, shape (x, y)."""
        if step > self.step[-1]:
            self.whole()
        i = int(np.abs(self.kept_steps - step).argmin())
        return self.kept_pressure[i], self.kept_film[i]
