"""The films of a hypoid flank with messages, progress, files and a summary."""

from __future__ import annotations

import logging
from pathlib import Path

import numpy as np
from rich.console import Console
from rich.table import Table

from gearlube.cli.progress_bar import progress_bar
from gearlube.studies.films.figures.catalogue import save_ehl_figures
from gearlube.studies.films.hypoid_case import HypoidFlank, hypoid_flank
from gearlube.studies.films.hypoid_dataset import hypoid_dataset, hypoid_key
from gearlube.studies.films.hypoid_summary import RatioRow, ratio_csv, ratio_rows
from gearlube_core.ehl.case.hypoid_case import HypoidCase
from gearlube_core.ehl.gears.hypoid_cycle import march_flank, steady_films
from gearlube_core.ehl.gears.hypoid_thermal import thermal_films
from gearlube_core.ehl.transient.curves import FilmCurves
from gearlube_core.ehl.transient.solution import FilmSolution
from gearlube_core.errors import ParameterError
from gearlube_core.oil.houpert_1985 import houpert_parameters
from gearlube_core.storage.atomic_file import write_dataset, write_text

logger = logging.getLogger("gearlube")
RECORD_EVERY = 10  # steps of a march
_KEPT = 3  # whole films
_SCALES = {"Pa": (1e-9, "GPa"), "m": (1e6, "µm"), "1": (1.0, "")}


def console_hypoid(
    console: Console, *, case: HypoidCase, march: bool, out: Path, kept: int = _KEPT
) -> str:
    """Solve a hypoid flank's films, write to `out`; return why it failed, or an empty text.

    The march goes on from its last record in `out`, if there is one.
    """
    warm_too = case.temperature == "thermal"
    if warm_too and march:
        raise ParameterError(
            "temperature is thermal, but films in time are isothermal: heat has no history yet. "
            "Leave the march out (--no-march)."
        )
    flank = hypoid_flank(case)
    _warn_of_light_films(flank)
    out.mkdir(parents=True, exist_ok=True)
    solver, cycle = case.solver, flank.film.cycle
    times = np.linspace(cycle.time[0], cycle.time[-1], solver.steady)
    rows = tuple(np.linspace(0, solver.steady - 1, kept + 2).round().astype(int)[1:-1].tolist())
    with progress_bar(console) as bar:
        total = solver.steady * (2 if warm_too else 1) + (solver.steps if march else 0)
        task = bar.add_task("steady films", total=total)

        def observe(done: int, solution: FilmSolution, what: str) -> None:
            words = f"{what}, smallest {1e9 * solution.minimum_film:.0f} nm"
            bar.update(task, completed=done, description=words)

        beta = flank.oil.beta
        steady = steady_films(
            flank.film,
            times,
            beta,
            settings=case.settings(),
            keep=rows,
            progress=lambda n, _, film: observe(n + 1, film, "steady film"),
            throw=False,
        )
        curves: FilmCurves | None = None
        if march:
            curves = march_flank(
                flank.film,
                solver.steps,
                beta,
                settings=case.settings(),
                checkpoint=out / f"march_{hypoid_key(flank)}.npz",
                checkpoint_every=RECORD_EVERY,
                progress=lambda n, _, film: observe(solver.steady + n, film, "film in time"),
                throw=False,
            )
        warm = None
        if warm_too:

            def observe_warm(n: int, _: int, smallest: float) -> None:
                words = f"thermal film, smallest {1e9 * smallest:.0f} nm"
                bar.update(task, completed=solver.steady + n + 1, description=words)

            solid = flank.parameters.solid
            warm = thermal_films(
                flank.film,
                times,
                (solid, solid),
                houpert_parameters(flank.parameters.oil).S0,
                settings=case.settings(),
                progress=observe_warm,
                throw=False,
            )
        bar.update(task, completed=total, description="files and figures")
        dataset = hypoid_dataset(flank, steady, curves, warm)
        found = ratio_rows(dataset)
        write_dataset(dataset, out / "hypoid.nc")
        write_text(ratio_csv(found), out / "summary.csv")
        save_ehl_figures(dataset, out / "figures")
    console.print(_table(case.name, found))
    logger.info("Results: %s, %s", out / "hypoid.nc", out / "figures")
    if dataset.attrs["failures"]:
        return (
            f"{dataset.attrs['failures']} films did not converge. Take more nodes, or smaller "
            "time steps."
        )
    return ""


def _warn_of_light_films(flank: HypoidFlank) -> None:
    if flank.case.load == "dynamic" and not np.isfinite(flank.drive.axle_film).all():
        logger.warning("The axle gives no film at some samples: its teeth separate there.")


def _table(name: str, rows: list[RatioRow]) -> Table:
    table = Table(title=f"{name}: hypoid flank through its engagement")
    for heading in ("quantity", "of"):
        table.add_column(heading)
    for heading in ("least", "largest", "mean by load"):
        table.add_column(heading, justify="right")
    table.add_column("unit")
    for row in rows:
        factor, unit = _SCALES.get(row.unit, (1.0, row.unit))
        numbers = (row.least, row.largest, row.load_weighted_mean)
        table.add_row(row.quantity, row.source, *(f"{factor * v:.4g}" for v in numbers), unit)
    return table
