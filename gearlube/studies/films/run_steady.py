"""Steady films of line contacts, point contacts and contact lines of helical pairs."""

from __future__ import annotations

import logging
import time
from pathlib import Path

import xarray as xr

from gearlube.report.inputs import remark_attributes
from gearlube.report.result import Result
from gearlube.studies.films.datasets.contact import line_dataset, point_dataset
from gearlube.studies.films.datasets.helical import helical_dataset
from gearlube.studies.films.film_formulas import ROUGHNESS
from gearlube.studies.films.helical_case import HelicalLineCase
from gearlube.studies.films.results import begin, finished
from gearlube_core.ehl.case.contact_case import LineCase, PointCase
from gearlube_core.ehl.gears.helical_film import HelicalFilm, solve_helical_line
from gearlube_core.ehl.grid_error import LARGE_ERROR
from gearlube_core.ehl.line.solver import solve_line
from gearlube_core.ehl.line.thermal import solve_thermal_line
from gearlube_core.ehl.point.solver import solve_point_contact
from gearlube_core.ehl.point.thermal.solver import solve_thermal_point
from gearlube_core.ehl.transient.march import MARCH_SETTINGS
from gearlube_core.progress import Progress, no_progress

logger = logging.getLogger("gearlube")
_ERRORS = {
    "central film": "error_central_film",
    "smallest film": "error_minimum_film",
    "largest pressure": "error_pressure_max",
    "friction": "error_friction",
}


def run_line(
    case: LineCase,
    *,
    film_error: float | None = None,
    folder: Path | None = None,
    progress: Progress = no_progress,
) -> Result:
    """Return the film of a line contact, isothermal or thermal as the case says.

    Parameters
    ----------
    case
        `LineCase.named` for a shipped case, `LineCase.from_toml` for a file or
        `LineCase.from_data` for numbers.
    film_error
        Wanted relative error of the films [-]: the spacing is halved until the estimate is below
        it. None: the grid of the case.
    folder
        Folder for line.nc, summary.csv and figures; None: nothing is written.
    progress
        Called with the share done and a sentence on what runs.

    Returns
    -------
    xr.Dataset
        See `line_dataset`. A film that did not converge has the attribute `converged` 0.

    Examples
    --------
    >>> case = LineCase.named("jamali_2015").varied({"solver.nodes": 201})
    >>> film = run_line(case)
    >>> f"{1e6 * film.attrs['minimum_film']:.2f} um"
    '0.20 um'
    """
    _warn_of_heights(case)
    begin(folder, progress, f"film on {case.solver.nodes} nodes")
    began = time.monotonic()
    problem, settings = case.problem(), case.settings()
    solution = (
        solve_thermal_line(problem, *case.solids, settings, film_error=film_error, throw=False)
        if case.temperature == "thermal"
        else solve_line(problem, settings, film_error=film_error, throw=False)
    )
    seconds = time.monotonic() - began
    dataset = line_dataset(solution, name=case.name, source=case.source, seconds=seconds)
    note_roughness(dataset, case.roughness_um)
    warn_of_grid(dataset)
    return finished(dataset, folder, progress)


def run_point(
    case: PointCase,
    *,
    film_error: float | None = None,
    folder: Path | None = None,
    progress: Progress = no_progress,
) -> Result:
    """Return the film of a point contact, isothermal or thermal as the case says.

    Parameters
    ----------
    case, film_error, folder, progress
        As in `run_line`; the dataset is point.nc.

    Returns
    -------
    xr.Dataset
        See `point_dataset`. A film that did not converge has the attribute `converged` 0.

    Examples
    --------
    >>> grid = {"solver.nodes_x": 33, "solver.nodes_y": 33}
    >>> film = run_point(PointCase.named("mourier_2006").varied(grid))
    >>> film["pressure"].dims
    ('x', 'y')
    """
    _warn_of_heights(case)
    begin(folder, progress, f"film on {case.solver.nodes_x} x {case.solver.nodes_y} nodes")
    problem, settings = case.problem(), case.settings()
    solution = (
        solve_thermal_point(problem, *case.solids, settings, film_error=film_error, throw=False)
        if case.temperature == "thermal"
        else solve_point_contact(problem, settings, film_error=film_error, throw=False)
    )
    dataset = point_dataset(solution, sliding=case.sliding, name=case.name, source=case.source)
    note_roughness(dataset, case.roughness_um)
    warn_of_grid(dataset)
    return finished(dataset, folder, progress)


def run_helical_line(
    case: HelicalLineCase,
    *,
    film_error: float | None = None,
    folder: Path | None = None,
    progress: Progress = no_progress,
) -> Result:
    """Return the steady film on a helical pair's contact line at one position.

    Parameters
    ----------
    case
        Gear pair, operation, oil, grid and position.
    film_error, folder, progress
        As in `run_line`; the dataset is helical.nc.

    Returns
    -------
    xr.Dataset
        See `helical_dataset`. A film that did not converge has the attribute `converged` 0.

    Raises
    ------
    ParameterError
        The case is incomplete or out of range.

    Examples
    --------
    >>> from gearlube_core.helical_geometry.gear_file import HelicalGearFile
    >>> gears = HelicalGearFile.named("jamali_2015_a")
    >>> film = run_helical_line(HelicalLineCase(file=gears, step=300.0, nodes=(33, 49)))
    >>> film.sizes["x"], film.sizes["y"]
    (33, 49)
    """
    film = case.film()
    step = case.step_of(film)
    warn_of_ends(film)
    begin(folder, progress, f"film on {film.nodes[0]} x {film.nodes[1]} nodes")
    # the settings of a march, so that both give one film where nothing moves
    solution = solve_helical_line(film, step, MARCH_SETTINGS, film_error=film_error, throw=False)
    dataset = helical_dataset(film, step, solution, name=case.file.name, source=case.file.source)
    dataset.attrs |= remark_attributes(case.file)
    note_roughness(dataset, case.roughness_um)
    warn_of_grid(dataset)
    return finished(dataset, folder, progress)


def note_roughness(dataset: xr.Dataset, roughness_um: float | None) -> None:
    """Keep the composite rms roughness with the film, in m, where it was given."""
    if roughness_um is not None:
        dataset.attrs[ROUGHNESS] = 1e-6 * roughness_um


def warn_of_ends(film: HelicalFilm) -> None:
    """Warn where lines end at the full face width."""
    if film.modified.pinion.crown is None and film.modified.gear.crown is None:
        logger.warning(
            "Neither flank is crowned, so the contact line ends abruptly. The film may not "
            "converge there."
        )


def warn_of_grid(dataset: xr.Dataset) -> None:
    """Warn where the estimated error of the grid is large, by the attributes of a film."""
    largest = {name: dataset.attrs[key] for name, key in _ERRORS.items()}
    large = {name: error for name, error in largest.items() if error > LARGE_ERROR}
    if large:
        logger.warning(
            "The estimated error by the grid is %s. Take more nodes, or ask for an error of the "
            "films (film_error, --film-error).",
            ", ".join(f"{100.0 * error:.2g} % of the {name}" for name, error in large.items()),
        )


def _warn_of_heights(case: LineCase | PointCase) -> None:
    if case.heights_travel:
        logger.warning(
            "The heights do not move, but both surfaces do. Heights that vary along the motion "
            "would in fact travel through the contact and squeeze the film."
        )
