"""Datasets of the films of a helical pair: a contact line, and a cycle of it."""

from __future__ import annotations

import hashlib
import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import xarray as xr

from gearlube.studies.films.datasets.variables import (
    Variable,
    error_attributes,
    formula_variables,
    noted_curves,
)
from gearlube.studies.films.film_formulas import line_film_formulas
from gearlube.studies.films.helical_case import line_of_step
from gearlube_core.arrays import Array
from gearlube_core.ehl.gears.helical_film import GRADINGS, HelicalFilm
from gearlube_core.ehl.grid_error import estimated_error
from gearlube_core.ehl.line.problem import LineProblem
from gearlube_core.ehl.line.traction import fill_mean_stress
from gearlube_core.ehl.time_error import time_error_sentence
from gearlube_core.ehl.transient.curves import FilmCurves
from gearlube_core.ehl.transient.solution import FilmSolution
from gearlube_core.errors import FileError, ParameterError
from gearlube_core.oil.film_oil import film_properties
from gearlube_core.storage.atomic_file import read_arrays, write_arrays
from gearlube_core.units import labelled

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
            "y": labelled("y", self._y, "m", "place along the line"),
            "line_pressure": labelled(
                ("step", "y"), pressure, "Pa", "largest pressure across the line"
            ),
            "line_film": labelled(("step", "y"), film, "m", "smallest film across the line"),
        }


def step_dataset(line: xr.Dataset, march: str) -> xr.Dataset:
    """Mark the dataset of a line as one step of the march `march`."""
    return line.assign_attrs(contact="helical_step", march=march)


def with_steady_film(dataset: xr.Dataset, steady: FilmSolution) -> xr.Dataset:
    """Add the steady film at the same line position to the dataset of a step."""
    plane = ("x", "y")
    beside = dataset.assign(
        steady_pressure=labelled(plane, steady.pressure, "Pa", "pressure with the line at rest"),
        steady_film=labelled(plane, steady.film, "m", "film thickness with the line at rest"),
    )
    return beside.assign_attrs(
        steady_converged=int(steady.converged), steady_outcome=steady.outcome
    )


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
        Solved cycle with its curves.
    lines
        Pressure and film along the line at its steps.
    start
        Film at rest at the first step, whose grid error is given; None: no error.
    repeated
        The errors of the time steps come from a second march with longer ones.
    name, source
        What figures call the pair, and where its numbers are from.
    """
    steps = cycle["step"]
    position = film.steps.position(steps)
    variables = noted_curves(_NOTES, cycle, "step") | lines.variables(steps)
    variables["position"] = labelled("step", position, "m", "s_i, from the pitch line")
    return xr.Dataset(
        variables,
        coords={"step": labelled("step", steps, "1", "step of the meshing cycle")},
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
        "steady_pressure_max": labelled("step", pressure, "Pa", "largest pressure, line at rest"),
        "steady_minimum_film": labelled("step", film, "m", "smallest film, line at rest"),
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


def helical_dataset(
    film: HelicalFilm,
    step: float,
    solution: FilmSolution,
    *,
    name: str = "helical pair",
    source: str = "",
) -> xr.Dataset:
    """Return pressure, film, gap and shear of a contact line, each with units.

    Parameters
    ----------
    film
        The line through its cycle.
    step
        Where the line is looked at [-].
    solution
        Solved film at this line.
    name, source
        What figures call the pair, and where its numbers are from.

    Returns
    -------
    xr.Dataset
        On `x`, across the line, and `y`, along it [m]. Films of formulas are those of a line
        with the middle's radius and the mean load of the loaded length. Attributes hold scalars
        in SI and the outcome; the coefficient of friction counts shear of both signs alike.
    """
    x, y = solution.x, solution.y
    position, X = line_of_step(film.steps, step)
    speed_1, speed_2 = film.surface_speeds(y, X)
    stress = _mean_stress(film, solution, speed_2 - speed_1)
    across = np.trapezoid(stress, x, axis=0)  # N/m; changes sign at the pitch line
    frictions = [_friction(film, one, speed_1, speed_2, y) for one in (solution, *solution.coarser)]
    load = film.load(X)
    middle = _middle_line(film, X, load, solution.loaded_length)
    pressure_x, pressure_y = solution.maximum_pressure_place
    film_x, film_y = solution.minimum_film_place
    plane = ("x", "y")
    return xr.Dataset(
        {
            "pressure": labelled(plane, solution.pressure, "Pa", "pressure"),
            "film": labelled(plane, solution.film, "m", "film thickness"),
            "gap": labelled(plane, film.gap(x, y, X), "m", "gap of the bare flanks"),
            "mean_stress": labelled(plane, stress, "Pa", "shear stress at mid-film"),
            "speed_1": labelled("y", speed_1, "m/s", "surface speed of the pinion"),
            "speed_2": labelled("y", speed_2, "m/s", "surface speed of the gear"),
            **formula_variables(line_film_formulas(middle)),
        },
        coords={
            "x": labelled("x", x, "m", "place across the line"),
            "y": labelled("y", y, "m", "place along the line"),
        },
        attrs={
            "contact": "helical",
            "name": name,
            "source": source,
            "step": step,
            "position": position,
            "line": X,
            "torque": film.torque,
            "pinion_speed": film.pinion_speed,
            "load_convention": film.convention,
            "load": load,
            "reduced_modulus": 2.0 * film.contact_modulus,
            "half_width": middle.half_width,
            "hertz_pressure_max": middle.hertz_pressure,
            "pressure_max": solution.maximum_pressure,
            "pressure_max_x": pressure_x,
            "pressure_max_y": pressure_y,
            "central_film": float(solution.film[np.abs(x).argmin(), _mid(solution)]),
            "minimum_film": solution.minimum_film,
            "minimum_film_x": film_x,
            "minimum_film_y": film_y,
            "loaded_length": solution.loaded_length,
            "friction_coefficient": frictions[0] / load,
            **error_attributes(
                replace(
                    solution.error,
                    friction=estimated_error(frictions, formal=solution.formal_order),
                )
            ),
            "friction_force": float(np.trapezoid(across, y)),
            "sliding_power": float(np.trapezoid(across * (speed_2 - speed_1), y)),
            "residual": float(solution.residual),
            "load_error": float(solution.load_error),
            "iterations": solution.newton_steps,
            "krylov_steps": solution.krylov_steps,
            "seconds": solution.seconds,
            "converged": int(solution.converged),
            "outcome": solution.outcome,
        },
    )


def _friction(
    film: HelicalFilm, solution: FilmSolution, speed_1: Array, speed_2: Array, y: Array
) -> float:
    """Return the shear force of both signs counted alike [N]; the speeds hold at `y`."""
    sliding = np.interp(solution.y, y, speed_2 - speed_1)
    across = np.trapezoid(_mean_stress(film, solution, sliding), solution.x, axis=0)
    return float(np.trapezoid(np.abs(across), solution.y))


def _mid(solution: FilmSolution) -> int:
    """Return the row in the middle of the loaded length."""
    rows = np.flatnonzero((solution.pressure > 1.0e6).any(axis=0))
    return int(rows[rows.size // 2]) if rows.size else solution.y.size // 2


def _middle_line(film: HelicalFilm, X: float, load: float, length: float) -> LineProblem:
    """Return the line contact of the same mean load, with radius and speeds of the middle."""
    plane = film.modified.pair.plane
    s = X - 0.5 * plane.W * plane.sin_b / plane.cos_b
    speed_1, speed_2 = (float(u[0]) for u in film.surface_speeds(np.zeros(1), X))
    return LineProblem(
        lubricant=film.lubricant,
        radius=s * (plane.x_g - s) / (plane.x_g * plane.cos_b),
        line_load=load / (length if length > 0.0 else film.line_length),
        reduced_modulus=2.0 * film.contact_modulus,
        speed_1=speed_1,
        speed_2=speed_2,
    )


def _mean_stress(film: HelicalFilm, solution: FilmSolution, sliding: Array) -> Array:
    """Return the shear stress at mid-film across the line [Pa], rows of other sliding."""
    slope = np.gradient(solution.pressure, solution.x, axis=0)
    oil, n = film.lubricant, solution.x.size
    stress = np.empty_like(solution.pressure)
    tau, void = np.empty(n), np.zeros(n)
    for j, slide in enumerate(sliding):
        p, h, dp = (
            np.ascontiguousarray(a[:, j]) for a in (solution.pressure, solution.film, slope)
        )
        fill_mean_stress(p, dp, h, void, film_properties(oil, p)[0], float(slide), oil, tau)
        stress[:, j] = tau
    return stress
