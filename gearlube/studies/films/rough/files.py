"""Results of a rough march: statistics and work of every step, kept films, files, figures."""

from __future__ import annotations

import math
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import xarray as xr

from gearlube.output.csv_text import csv_text
from gearlube.studies.films.figures.rough import (
    rough_distributions,
    rough_frame,
    rough_history,
    rough_thin_films,
)
from gearlube_core.arrays import Array
from gearlube_core.ehl.case.rough_case import RoughCase
from gearlube_core.ehl.point.solver import solve_point_contact
from gearlube_core.ehl.statistics.rough_film import FilmFriction, RoughFilmStatistics
from gearlube_core.ehl.statistics.zone import FilmZone
from gearlube_core.ehl.transient.solution import FilmSolution
from gearlube_core.errors import FileError, ParameterError
from gearlube_core.storage.atomic_file import read_dataset, write_dataset, write_figure, write_text
from gearlube_core.units import labelled

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
DATASET, FRAMES = "rough.nc", "frames"


def composite_roughness(case: RoughCase) -> float:
    """Return sqrt(Rq_1^2 + Rq_2^2) [m]."""
    return math.sqrt(sum(float(one.heights.height.var()) for one in case.surfaces()))


def new_statistics(case: RoughCase, *, smooth: bool = True) -> RoughFilmStatistics:
    """Return the statistics of a case without any film.

    Parameters
    ----------
    case
        Case of the rough contact.
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
        Case of the rough contact.
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


def frame_file(folder: Path, step: int) -> Path:
    """Return the file of a kept film."""
    return folder / FRAMES / f"step_{step:06d}.nc"


def write_frame(folder: Path, step: int, solution: FilmSolution, key: str) -> None:
    """Write a film in single precision; an older one stays until it is whole."""
    path = frame_file(folder, step)
    path.parent.mkdir(parents=True, exist_ok=True)
    fields = {
        "film": (solution.film, "m", "film"),
        "pressure": (solution.pressure, "Pa", "pressure of oil and solids"),
    }
    frame = xr.Dataset(
        {
            name: labelled(("time", "x", "y"), values[None].astype(np.float32), unit, words)
            for name, (values, unit, words) in fields.items()
        },
        {
            "time": ("time", [solution.time], {"units": "s"}),
            "x": ("x", solution.x, {"units": "m"}),
            "y": ("y", solution.y, {"units": "m"}),
        },
        {"step": step, "march": key, "converged": int(solution.converged)},
    )
    write_dataset(frame, path)


def frame_files(folder: Path) -> list[Path]:
    """Return the files of kept films by rising step."""
    return sorted((folder / FRAMES).glob("step_*.nc"))


def read_frames(folder: Path, key: str, most: int | None = None) -> Iterator[xr.Dataset]:
    """Yield the kept films of a march by rising step, one at a time; of many `most`, evenly.

    Raises
    ------
    ParameterError
        A file is damaged, of another case, or there is none.
    """
    files = frame_files(folder)
    if not files:
        raise ParameterError(
            f"{folder / FRAMES} must hold kept films, got none. Run the case with every or steps "
            "in [frames]."
        )
    if most is not None and len(files) > most:
        files = [files[k * (len(files) - 1) // (most - 1)] for k in range(most)]
    for path in files:
        try:
            frame = read_dataset(path, engine="scipy")
        except FileError as reason:
            raise ParameterError(f"{path} must be a kept film: {reason}") from None
        if frame.attrs.get("march") != key:
            raise ParameterError(
                f"{path} must be a film of this case, got one of another. Give the case from which "
                "it was computed, or another --out."
            )
        yield frame


def summary_rows(dataset: xr.Dataset) -> list[tuple[str, float, str]]:
    """Return the main numbers of a march: quantity, value, unit; rough: once all is rough."""
    rough = dataset.isel(time=dataset["time"].values >= dataset.attrs["rough_time"] * (1 - 1e-12))
    if rough.sizes["time"] == 0:
        rough = dataset.isel(time=slice(-1, None))
    thin = rough.sel(threshold=dataset["threshold"].values[-1])
    rows = [
        ("largest pressure, rough", float(rough["pressure_max"].max()), "Pa"),
        ("mean of the largest pressure, rough", float(rough["pressure_max"].mean()), "Pa"),
        ("smallest film, rough", float(rough["film_min"].min()), "m"),
        ("mean film, rough", float(rough["film_mean"].mean()), "m"),
        ("mean film over roughness", float(rough["lambda_mean"].mean()), "1"),
        ("smooth film over roughness", float(dataset.attrs["lambda_smooth"]), "1"),
        ("share of the zone below 25 nm, rough", float(thin["contact_share"].mean()), "1"),
        ("share of the load on solids, rough", float(rough["solid_share"].mean()), "1"),
        ("largest share of the load on solids", float(rough["solid_share"].max()), "1"),
        ("friction coefficient, rough", float(rough["friction_coefficient"].mean()), "1"),
    ]
    if "converged" in dataset:
        rows += [
            ("steps", float(dataset.sizes["time"] - 1), "1"),
            ("steps that did not converge", float((dataset["converged"] == 0.0).sum()), "1"),
            ("wall time", float(dataset["seconds"].sum()), "s"),
        ]
    return [row for row in rows if not math.isnan(row[1])]


def write_rough_results(dataset: xr.Dataset, folder: Path) -> list[Path]:
    """Write statistics, summary and figures; return the files."""
    folder.mkdir(parents=True, exist_ok=True)
    write_dataset(dataset, folder / DATASET)
    rows = summary_rows(dataset)
    write_text(
        csv_text(("quantity", "value", "unit"), ((q, f"{v:.6g}", u) for q, v, u in rows)),
        folder / "summary.csv",
    )
    figures = folder / "figures"
    figures.mkdir(exist_ok=True)
    runs = {str(dataset.attrs["name"]): dataset}
    drawn = {"history": rough_history(runs, float(dataset.attrs["time_step"]))}
    if dataset.attrs["gathered_films"]:
        drawn["distributions"] = rough_distributions(runs)
        drawn["thin_films"] = rough_thin_films(runs)
    for path in frame_files(folder):
        frame = read_dataset(path, engine="scipy")
        if frame.attrs.get("march") == dataset.attrs["march"]:
            drawn[path.stem] = rough_frame(frame.isel(time=0))
    written = [folder / DATASET, folder / "summary.csv"]
    for name, figure in drawn.items():
        write_figure(figure, figures / f"{name}.png")
        written.append(figures / f"{name}.png")
    return written
