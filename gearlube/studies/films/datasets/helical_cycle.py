"""The film of a helical pair's contact line through its meshing cycle as a labelled dataset."""

from __future__ import annotations

import hashlib
import math

import numpy as np
import xarray as xr

from gearlube.studies.films.datasets.cycle_lines import CycleLines
from gearlube.studies.films.datasets.variables import (
    Variable,
    error_attributes,
    noted,
    noted_curves,
)
from gearlube_core.arrays import Array
from gearlube_core.ehl.gears.helical_film import GRADINGS, HelicalFilm
from gearlube_core.ehl.time_error import time_error_sentence
from gearlube_core.ehl.transient.curves import FilmCurves
from gearlube_core.ehl.transient.solution import FilmSolution

_NOTES = {
    "load": ("N", "load that the pressure carries"),
    "pressure_max": ("Pa", "largest pressure"),
    "pressure_max_y": ("m", "its place along the line"),
    "minimum_film": ("m", "smallest film"),
    "minimum_film_x": ("m", "its place across the line"),
    "minimum_film_y": ("m", "its place along the line"),
    "loaded_length": ("m", "length of the line that carries"),
    "load_error": ("1", "missing share of the load"),
    "converged": ("1", "1 where the step converged"),
    "newton_steps": ("1", "Newton steps"),
    "krylov_steps": ("1", "iterations of the linear solutions"),
    "seconds": ("s", "time that the step took"),
    "time_error": ("1", "estimated error of the smallest film by the time steps"),
    "time_error_pressure": ("1", "estimated error of the largest pressure by the time steps"),
}


def cycle_dataset(
    film: HelicalFilm,
    cycle: FilmCurves,
    lines: CycleLines,
    *,
    start: FilmSolution | None = None,
    repeated: bool = False,
    name: str = "helical pair",
    source: str = "",
) -> xr.Dataset:
    """Return the curves over the steps of a meshing cycle, each with units.

    Parameters
    ----------
    film
        The line through its cycle.
    cycle
        Its curves.
    lines
        Pressure and film along the line at its steps.
    start
        Film at rest at the first step, whose error of the grid is told; None: none is.
    repeated
        The errors of the time steps come from a second march with longer ones.
    name, source
        What figures call the pair, and where its numbers are from.
    """
    steps = cycle["step"]
    position = film.steps.position(steps)
    variables = noted_curves(_NOTES, cycle, "step") | lines.variables(steps)
    variables["position"] = noted("step", position, "m", "s_i, from the pitch line")
    return xr.Dataset(
        variables,
        coords={"step": noted("step", steps, "1", "step of the meshing cycle")},
        attrs={
            "contact": "helical_cycle",
            "name": name,
            "source": source,
            "torque": film.torque,
            "pinion_speed": film.pinion_speed,
            "load_convention": film.convention,
            "time_step": film.time_step,
            "nodes_across": film.nodes[0],
            "nodes_along": film.nodes[1],
            "spacing_across": _spacing(film),
            "time_error_of": "repeat" if repeated else "embedded",
            "largest_time_error": _largest(cycle["time_error"]),
            **({} if start is None else error_attributes(start.error)),
            "failures": cycle.failures,
            "converged": int(cycle.failures == 0),
            "outcome": _outcome(cycle),
        },
    )


def with_steady_points(dataset: xr.Dataset, steady: dict[int, FilmSolution]) -> xr.Dataset:
    """Return the curves of a cycle with the largest pressures and smallest films of steady lines.

    `steady` holds the films of the line at rest by their steps.
    """
    if not steady:
        return dataset
    steps = dataset["step"].values
    pressure, film = (np.full(steps.size, np.nan) for _ in range(2))
    for step, solution in steady.items():
        k = int(np.flatnonzero(steps == step)[0])
        pressure[k], film[k] = solution.maximum_pressure, solution.minimum_film
    points: dict[str, Variable] = {
        "steady_pressure_max": noted("step", pressure, "Pa", "largest pressure, line at rest"),
        "steady_minimum_film": noted("step", film, "m", "smallest film, line at rest"),
    }
    return dataset.assign(points)


def march_key(film: HelicalFilm, first: int) -> str:
    """Return a short key that is unique for pair, operation, oil, grid and first step."""
    return hashlib.sha256(repr((film, first)).encode()).hexdigest()[:12]


def _spacing(film: HelicalFilm) -> str:
    """Return the name of the spacing of nodes across the line."""
    return next((name for name, one in GRADINGS.items() if one == film.grading), "own")


def _largest(errors: Array) -> float:
    known = errors[np.isfinite(errors)]
    return float(known.max()) if known.size else math.nan


def _outcome(cycle: FilmCurves) -> str:
    warning = time_error_sentence(_largest(cycle["time_error"]))
    steps, failed = cycle["step"], cycle["step"][cycle["converged"] == 0.0]
    if not failed.size:
        return f"All {steps.size} steps converged.{warning}"
    return (
        f"{failed.size} of {steps.size} steps did not converge, the first is step "
        f"{failed[0]:.0f}. Take more nodes.{warning}"
    )
