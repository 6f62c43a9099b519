"""What each step of a march leaves behind beside its curves: pressure and film along the line."""

from __future__ import annotations

import zipfile
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from gearlube.studies.films.helical_case import HelicalLineCase
from gearlube.studies.films.helical_dataset import helical_dataset
from gearlube.studies.films.variables import unit_note
from gearlube_core.arrays import Array
from gearlube_core.ehl.gears.helical_film import HelicalFilm
from gearlube_core.ehl.transient.solution import FilmSolution
from gearlube_core.errors import ParameterError
from gearlube_core.storage.atomic_file import whole_file


class CycleLines:
    """Largest pressure and smallest film of each section along the line, step by step.

    Parameters
    ----------
    path
        File that holds them between two runs of one march; read if it is there.

    Raises
    ------
    ParameterError
        The file is there but is not such a file.
    """

    def __init__(self, path: Path) -> None:
        self._path = path
        self._rows: dict[int, tuple[Array, Array]] = {}
        self._y: Array = np.empty(0)
        if path.exists():
            self._read()

    def _read(self) -> None:
        try:
            with np.load(self._path, allow_pickle=False) as stored:
                self._y = stored["y"]
                rows = zip(stored["step"], stored["pressure"], stored["film"], strict=True)
                self._rows = {int(step): (pressure, film) for step, pressure, film in rows}
        except (OSError, ValueError, KeyError, zipfile.BadZipFile) as reason:
            raise ParameterError(
                f"{self._path} must hold the lines of a march, got {reason}. Remove it."
            ) from None

    def add(self, step: int, solution: FilmSolution) -> None:
        """Keep the lines of a step."""
        self._y = solution.y
        self._rows[step] = (solution.pressure.max(axis=0), solution.film.min(axis=0))

    def write(self) -> None:
        """Write what is kept; an older file stays whole until the new one is complete."""
        pressure, film = (np.array([row[k] for row in self._rows.values()]) for k in (0, 1))
        with whole_file(self._path) as partial, partial.open("wb") as stream:
            np.savez(stream, y=self._y, step=list(self._rows), pressure=pressure, film=film)

    def variables(self, steps: Array) -> dict[str, Any]:
        """Return variables over `steps` and y; not a number at steps that are not kept."""
        pressure, film = (np.full((steps.size, self._y.size), np.nan) for _ in range(2))
        for k, step in enumerate(steps):
            if int(step) in self._rows:
                pressure[k], film[k] = self._rows[int(step)]
        return {
            "y": ("y", self._y, unit_note("m", "place along the line")),
            "line_pressure": (
                ("step", "y"), pressure, unit_note("Pa", "largest pressure across the line"),
            ),
            "line_film": (("step", "y"), film, unit_note("m", "smallest film across the line")),
        }  # fmt: skip


def step_dataset(
    case: HelicalLineCase, film: HelicalFilm, step: int, solution: FilmSolution, march: str
) -> xr.Dataset:
    """Return a step of a march as the dataset of a line, marked as one of the march `march`."""
    dataset = helical_dataset(case, film, float(step), solution)
    dataset.attrs |= {"contact": "helical_step", "march": march}
    return dataset


def with_steady_film(dataset: xr.Dataset, steady: FilmSolution) -> xr.Dataset:
    """Return the dataset of a step with the film of the line at rest there beside its own."""
    pressure = unit_note("Pa", "pressure with the line at rest")
    film = unit_note("m", "film thickness with the line at rest")
    beside = dataset.assign(
        steady_pressure=(("x", "y"), steady.pressure, pressure),
        steady_film=(("x", "y"), steady.film, film),
    )
    return beside.assign_attrs(
        steady_converged=int(steady.converged), steady_outcome=steady.outcome
    )
