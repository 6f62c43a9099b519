"""Files of a rough march: kept films, statistics, summary, figures."""

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
from gearlube_core.ehl.transient.solution import FilmSolution
from gearlube_core.errors import FileError, ParameterError
from gearlube_core.storage.atomic_file import read_dataset, write_dataset, write_figure, write_text

DATASET, FRAMES = "rough.nc", "frames"


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
            name: (
                ("time", "x", "y"),
                values[None].astype(np.float32),
                {"units": unit, "long_name": words},
            )
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
