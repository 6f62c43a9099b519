"""The film of a helical pair's contact line through its meshing cycle as a labelled dataset."""

from __future__ import annotations

import hashlib
from typing import Any

import xarray as xr

from gearlube.studies.films.cycle_lines import CycleLines
from gearlube.studies.films.helical_case import HelicalLineCase
from gearlube.studies.films.variables import unit_note
from gearlube_core.ehl.gears.helical_film import HelicalFilm
from gearlube_core.ehl.transient.curves import FilmCurves

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
}


def cycle_dataset(
    case: HelicalLineCase, film: HelicalFilm, cycle: FilmCurves, lines: CycleLines
) -> xr.Dataset:
    """Return the curves over the steps of a meshing cycle, each with units.

    Parameters
    ----------
    case
        What was asked for.
    film
        The line through its cycle.
    cycle
        Its curves.
    lines
        Pressure and film along the line at its steps.
    """
    steps = cycle["step"]
    variables: dict[str, Any] = {
        name: ("step", cycle[name], unit_note(*note)) for name, note in _NOTES.items()
    } | lines.variables(steps)
    position = film.steps.position(steps)
    variables["position"] = ("step", position, unit_note("m", "s_i, from the pitch line"))
    return xr.Dataset(
        variables,
        coords={"step": ("step", steps, unit_note("1", "step of the meshing cycle"))},
        attrs={
            "contact": "helical_cycle",
            "name": case.file.name,
            "source": case.file.source,
            "torque": film.torque,
            "pinion_speed": film.pinion_speed,
            "load_convention": film.convention,
            "time_step": film.time_step,
            "nodes_across": film.nodes[0],
            "nodes_along": film.nodes[1],
            "spacing_across": case.mesh[1],
            "failures": cycle.failures,
            "converged": int(cycle.failures == 0),
        },
    )


def march_key(film: HelicalFilm, first: int) -> str:
    """Return a short name that differs where pair, operation, oil, grid or first step do."""
    return hashlib.sha256(repr((film, first)).encode()).hexdigest()[:12]
