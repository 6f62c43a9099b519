"""The files of a film: NetCDF, summary and figures."""

from __future__ import annotations

import math
from pathlib import Path
from typing import NamedTuple

import xarray as xr

from gearlube.output.csv_text import csv_text
from gearlube.report.result import Result
from gearlube.studies.films.figures.catalogue import save_film_figures
from gearlube.studies.films.film_formulas import film_ratios
from gearlube.studies.films.hypoid.summary import ratio_csv, ratio_rows
from gearlube_core.errors import FileError, ParameterError
from gearlube_core.progress import Progress, no_progress
from gearlube_core.storage.atomic_file import read_dataset, write_dataset, write_text

SOLUTION = "solution"
_ERRORS = {
    "central film": "central_film",
    "minimum film": "minimum_film",
    "largest pressure": "pressure_max",
    "friction": "friction",
}
_NAMES = {
    "line": "line",
    "point": "point",
    "helical": "helical",
    "helical_cycle": "cycle",
    "hypoid": "hypoid",
}


class Row(NamedTuple):
    """One number of the summary."""

    quantity: str
    source: str  # "solution", or whose formula
    value: float
    unit: str
    deviation: float  # of the source from the solution [-]; nan for the solution itself


def summary_rows(dataset: xr.Dataset) -> list[Row]:
    """Return the numbers of a line or point contact or of a contact line of a helical pair."""
    of = dataset.attrs
    # formulas for a helical pair's line are those of a line with its mean load
    basis = ", mean load" if of["contact"] == "helical" else ""
    hertz = [(f"Hertz{basis}", of["hertz_pressure_max"])]
    rows = _compared("largest pressure", of["pressure_max"], "Pa", hertz)
    for name in ("central film", "minimum film"):
        value = of[name.replace(" ", "_")]
        rows += _compared(name, value, "m", _formulas(dataset, name, basis))
    rows += [
        _own(f"film ratio λ, {name}", value, "1") for name, value in film_ratios(dataset).items()
    ]
    if slides := of["friction_coefficient"] != 0.0:
        rows.append(_own("friction coefficient", abs(of["friction_coefficient"]), "1"))
    if of["contact"] == "helical":
        rows += [
            _own("power lost to sliding", of["sliding_power"], "W"),
            _own("load of the line", of["load"], "N"),
            _own("loaded length", 1e3 * of["loaded_length"], "mm"),
            _own("largest pressure at y", 1e3 * of["pressure_max_y"], "mm"),
            _own("minimum film at y", 1e3 * of["minimum_film_y"], "mm"),
        ]
    if of["contact"] == "line":
        rows.append(_own("force of the film on body 1", of["friction_1"], "N/m"))
        rows.append(_own("force of the film on body 2", of["friction_2"], "N/m"))
    if math.isfinite(of.get("temperature_max", math.nan)):
        rise = of["temperature_max"] - of["temperature_inlet"]
        rows.append(_own("highest temperature above the inlet", rise, "K"))
        rows.append(_own("turns of film and energy", of["turns"], "1"))
    rows += [_own(f"group {key}", of[f"group_{key}"], "1") for key in "ML" if f"group_{key}" in of]
    rows += [
        _own(f"estimated error{part}, {name}", 100.0 * of[f"{prefix}error_{key}"], "%")
        for prefix, part in (("", ""), ("domain_", " of the domain"))
        for name, key in _ERRORS.items()
        if math.isfinite(of.get(f"{prefix}error_{key}", math.nan)) and (slides or key != "friction")
    ]
    return [
        *rows,
        _own("unbalanced flow", of["residual"], "1"),
        _own("load error", of["load_error"], "1"),
        _own("iterations", of["iterations"], "1"),
        _own("time", of["seconds"], "s"),
    ]


def summary_csv(rows: list[Row]) -> str:
    """Return rows as text with a head, comma between; no deviation is left empty."""

    def written(row: Row) -> list[str]:
        deviation = f"{row.deviation:.4g}" if math.isfinite(row.deviation) else ""
        return [row.quantity, row.source, f"{row.value:.6g}", row.unit, deviation]

    return csv_text(Row._fields, map(written, rows))


def _own(quantity: str, value: float, unit: str) -> Row:
    return Row(quantity, SOLUTION, float(value), unit, math.nan)


def _compared(quantity: str, value: float, unit: str, others: list[tuple[str, float]]) -> list[Row]:
    return [
        _own(quantity, value, unit),
        *(Row(quantity, who, other, unit, other / value - 1.0) for who, other in others),
    ]


def _formulas(dataset: xr.Dataset, quantity: str, basis: str) -> list[tuple[str, float]]:
    if "formula_film" not in dataset:
        return []
    of_quantity = dataset["formula_quantity"].values == quantity
    sources = dataset["formula_source"].values[of_quantity]
    films = dataset["formula_film"].values[of_quantity]
    return [(f"{who}{basis}", float(film)) for who, film in zip(sources, films, strict=True)]


def step_file(folder: Path, step: int) -> Path:
    """Return the file in `folder` for the whole film of one step of a march."""
    return folder / f"step_{step:04d}.nc"


def dataset_file(dataset: xr.Dataset, folder: Path) -> Path:
    """Return the file in `folder` that holds a dataset of this kind."""
    kind = dataset.attrs["contact"]
    if kind == "helical_step":
        return step_file(folder, round(dataset.attrs["step"]))
    return folder / f"{_NAMES[kind]}.nc"


def write_film_results(dataset: xr.Dataset, folder: Path) -> None:
    """Write the dataset of a film as NetCDF, with its summary and its figures.

    Parameters
    ----------
    dataset
        From `gearlube.studies.films.datasets`, or of a run.
    folder
        Made if it is not there. Older results in it are replaced.
    """
    folder.mkdir(parents=True, exist_ok=True)
    path = dataset_file(dataset, folder)
    write_dataset(dataset, path)
    kind = dataset.attrs["contact"]
    if kind in ("line", "point", "helical"):
        write_text(summary_csv(summary_rows(dataset)), folder / "summary.csv")
    elif kind == "hypoid":
        write_text(ratio_csv(ratio_rows(dataset)), folder / "summary.csv")
    # several steps of a march share a folder
    prefix = f"{path.stem}_" if kind == "helical_step" else ""
    save_film_figures(dataset, folder / "figures", prefix)


def begin(folder: Path | None, progress: Progress, sentence: str) -> None:
    """Make the folder of a run before any film is solved, so that a wrong path stops it now.

    Without a folder nothing is written; `progress` starts with a share of 0.
    """
    if folder is not None:
        folder.mkdir(parents=True, exist_ok=True)
    progress(0.0, sentence)


def finished(
    dataset: xr.Dataset, folder: Path | None, progress: Progress = no_progress, share: float = 0.5
) -> Result:
    """Write the dataset of a run if `folder` is given, and return it as a result.

    `share` of the run was done before.
    """
    dataset = Result.of(dataset, "ehl")
    if folder is not None:
        progress(share, "writing files and figures")
        write_film_results(dataset, folder)
    progress(1.0, "done")
    return dataset


def read_march(path: Path) -> xr.Dataset:
    """Return the dataset of a march from its folder or its file.

    Raises
    ------
    ParameterError
        It is not that of a march.
    """
    path = path / "cycle.nc" if path.is_dir() else path
    try:
        dataset = read_dataset(path, engine="scipy")
    except FileError as reason:
        raise ParameterError(
            f"{path} is not the cycle of a march: {reason}. Run gearlube ehl helical --march first."
        ) from None
    if dataset.attrs.get("contact") != "helical_cycle":
        raise ParameterError(f"{path} must be the cycle.nc of a march, got another dataset.")
    return dataset
