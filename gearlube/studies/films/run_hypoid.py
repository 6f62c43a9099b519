"""The films of a hypoid tooth pair through its engagement, steady and in time."""

from __future__ import annotations

import logging
from pathlib import Path

import numpy as np

from gearlube.report.result import Result
from gearlube.studies.films.datasets.hypoid import hypoid_dataset, hypoid_key
from gearlube.studies.films.hypoid.flank import HypoidFlank, hypoid_flank
from gearlube.studies.films.results import begin, finished
from gearlube_core.ehl.case.hypoid_case import HypoidCase
from gearlube_core.ehl.gears.hypoid_cycle import march_flank, steady_films, thermal_films
from gearlube_core.errors import ParameterError
from gearlube_core.oil.houpert_1985 import houpert_parameters
from gearlube_core.progress import Progress, no_progress

logger = logging.getLogger("gearlube")


def run_hypoid(
    case: HypoidCase,
    *,
    march: bool = True,
    kept: int = 3,
    record_every: int = 10,
    folder: Path | None = None,
    progress: Progress = no_progress,
) -> Result:
    """Return the films of a hypoid tooth pair from entry to exit, together with film formulas.

    Parameters
    ----------
    case
        Axle, operation, oil and grid.
    march
        True: films in time too, with squeeze; False: steady films only. It must be False for a
        thermal case.
    kept
        Number of steady films that are kept whole.
    record_every
        Number of time steps between two records of the march.
    folder
        Folder for hypoid.nc, summary.csv, figures and records of the march. If there is a record,
        the march continues from it. None: nothing is written.
    progress
        Called with the share done and a sentence on what runs.

    Returns
    -------
    xr.Dataset
        See `hypoid_dataset`. The attribute `converged` is 0 if any film did not converge.

    Raises
    ------
    ParameterError
        Something is out of range, the pair carries no load, or a march is asked of a thermal case.

    Examples
    --------
    >>> films = run_hypoid(HypoidCase.named("mohammadpour_2015"))  # doctest: +SKIP
    """
    thermal = case.temperature == "thermal"
    if thermal and march:
        raise ParameterError(
            "temperature must be isothermal for a march, got thermal: transient thermal films are "
            "not implemented. Add --no-march."
        )
    flank = hypoid_flank(case)
    _warn_of_separation(flank)
    begin(folder, progress, "steady films")
    solver, cycle, settings = case.solver, flank.film.cycle, case.settings()
    times = np.linspace(cycle.time[0], cycle.time[-1], solver.steady)
    rows = tuple(np.linspace(0, solver.steady - 1, kept + 2).round().astype(int)[1:-1].tolist())
    films = solver.steady * (2 if thermal else 1) + (solver.steps if march else 0)

    def report(solved: int, sentence: str) -> None:
        # files and figures count as much as one more film
        progress(solved / (films + 1), sentence)

    def observe(solved: int, what: str, minimum_film: float) -> None:
        report(solved, f"{what}, smallest {1e9 * minimum_film:.0f} nm")

    beta = flank.oil.beta
    steady = steady_films(
        flank.film,
        times,
        beta,
        settings=settings,
        keep=rows,
        progress=lambda n, _, film: observe(n + 1, "steady film", film.minimum_film),
        throw=False,
    )
    in_time, with_heat = None, None
    if march:
        in_time = march_flank(
            flank.film,
            solver.steps,
            beta,
            settings=settings,
            checkpoint=None if folder is None else folder / f"march_{hypoid_key(flank)}.npz",
            checkpoint_every=record_every,
            progress=lambda n, _, film: observe(
                solver.steady + n, "film in time", film.minimum_film
            ),
            throw=False,
        )
    if thermal:
        solid = flank.parameters.solid
        with_heat = thermal_films(
            flank.film,
            times,
            (solid, solid),
            houpert_parameters(flank.parameters.oil).S0,
            settings=settings,
            progress=lambda n, _, minimum: observe(solver.steady + n + 1, "thermal film", minimum),
            throw=False,
        )
    dataset = hypoid_dataset(flank, steady, in_time, with_heat)
    return finished(dataset, folder, progress, films / (films + 1))


def _warn_of_separation(flank: HypoidFlank) -> None:
    if flank.case.load == "dynamic" and not np.isfinite(flank.drive.axle_film).all():
        logger.warning(
            "The axle model gives no film at some samples, because its teeth separate there."
        )
