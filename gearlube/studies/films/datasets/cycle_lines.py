"""Pressure and film along the line at each step of a march, and whole films of some steps."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import xarray as xr

from gearlube.studies.films.datasets.variables import Variable, noted
from gearlube_core.arrays import Array
from gearlube_core.ehl.transient.solution import FilmSolution
from gearlube_core.errors import FileError, ParameterError
from gearlube_core.storage.atomic_file import read_arrays, write_arrays


class CycleLines:
    """Largest pressure and smallest film of each section along the line, step by step.

    Parameters
    ----------
    path
        File that holds them between two runs of one march; read if it is there. None: they are
        not written.

    Raises
    ------
    ParameterError
        The file is there but is not such a file.
    """

    def __init__(self, path: Path | None = None) -> None:
        self._path = path
        self._rows: dict[int, tuple[Array, Array]] = {}
        self._y: Array = np.empty(0)
        if path is not None and path.exists():
            self._read(path)

    def _read(self, path: Path) -> None:
        try:
            stored = read_arrays(path)
            self._y = stored["y"]
            rows = zip(stored["step"], stored["pressure"], stored["film"], strict=True)
            self._rows = {int(step): (pressure, film) for step, pressure, film in rows}
        except (FileError, ValueError, KeyError) as reason:
            raise ParameterError(
                f"{path} must hold the lines of a march, got {reason}. Remove it."
            ) from None

    def add(self, step: int, solution: FilmSolution) -> None:
        """Store the pressure and film along the line at one step."""
        self._y = solution.y
        self._rows[step] = (solution.pressure.max(axis=0), solution.film.min(axis=0))

    def write(self) -> None:
        """Write what is kept; an older file stays whole until the new one is complete."""
        if self._path is None:
            return
        pressure, film = (np.array([row[k] for row in self._rows.values()]) for k in (0, 1))
        arrays = {"y": self._y, "step": list(self._rows), "pressure": pressure, "film": film}
        write_arrays(self._path, arrays)

    def variables(self, steps: Array) -> dict[str, Variable]:
        """Return variables over `steps` and y; NaN at steps that are not stored."""
        pressure, film = (np.full((steps.size, self._y.size), np.nan) for _ in range(2))
        for k, step in enumerate(steps):
            if int(step) in self._rows:
                pressure[k], film[k] = self._rows[int(step)]
        return {
            "y": noted("y", self._y, "m", "place along the line"),
            "line_pressure": noted(
                ("step", "y"), pressure, "Pa", "largest pressure across the line"
            ),
            "line_film": noted(("step", "y"), film, "m", "smallest film across the line"),
        }


def step_dataset(line: xr.Dataset, march: str) -> xr.Dataset:
    """Mark the dataset of a line as one step of the march `march`."""
    return line.assign_attrs(contact="helical_step", march=march)


def with_steady_film(dataset: xr.Dataset, steady: FilmSolution) -> xr.Dataset:
    """Add the steady film at the same line position to the dataset of a step."""
    plane = ("x", "y")
    beside = dataset.assign(
        steady_pressure=noted(plane, steady.pressure, "Pa", "pressure with the line at rest"),
        steady_film=noted(plane, steady.film, "m", "film thickness with the line at rest"),
    )
    return beside.assign_attrs(
        steady_converged=int(steady.converged), steady_outcome=steady.outcome
    )
