"""A lubricated contact with messages, a progress bar, files and a summary."""

from __future__ import annotations

import logging
import time
from collections.abc import Callable
from pathlib import Path

import xarray as xr
from rich.console import Console
from rich.table import Table

from gearlube.cli.progress_bar import progress_bar
from gearlube.studies.films.figures.catalogue import save_ehl_figures
from gearlube.studies.films.helical_case import HelicalLineCase
from gearlube.studies.films.helical_dataset import helical_dataset
from gearlube.studies.films.line_dataset import line_dataset
from gearlube.studies.films.point_dataset import point_dataset
from gearlube.studies.films.summary import SOLUTION, Row, summary_csv, summary_rows
from gearlube_core.ehl.case.contact_case import LineCase, PointCase
from gearlube_core.ehl.gears.helical_cycle import solve_helical_line
from gearlube_core.ehl.gears.helical_film import HelicalFilm
from gearlube_core.ehl.line.solver import solve_line
from gearlube_core.ehl.line.thermal import solve_thermal_line
from gearlube_core.ehl.point.solver import solve_point_contact
from gearlube_core.ehl.point.thermal.solver import solve_thermal_point
from gearlube_core.ehl.transient.march import MARCH_SETTINGS
from gearlube_core.storage.atomic_file import write_dataset, write_text

logger = logging.getLogger("gearlube")
_STAGES = 3  # solution, files, figures
_SCALES = {"Pa": (1e-9, "GPa"), "m": (1e6, "µm"), "N/m": (1e-3, "N/mm")}


def console_line(console: Console, *, case: LineCase, out: Path) -> str:
    """Solve a line contact, write to `out`; return why it failed, or an empty text."""
    _warn_of_heights(case)

    def solve() -> xr.Dataset:
        began = time.monotonic()
        problem, settings = case.problem(), case.settings()
        if case.temperature == "thermal":
            warm = solve_thermal_line(problem, *case.solids, settings, throw=False)
            return line_dataset(case, warm, time.monotonic() - began)
        film = solve_line(problem, settings, throw=False)
        return line_dataset(case, film, time.monotonic() - began)

    return _console(console, ("line", case.name), f"film on {case.solver.nodes} nodes", solve, out)


def console_point(console: Console, *, case: PointCase, out: Path) -> str:
    """Solve a point contact, write to `out`; return why it failed, or an empty text."""
    _warn_of_heights(case)

    def solve() -> xr.Dataset:
        problem, settings = case.problem(), case.settings()
        if case.temperature == "thermal":
            warm = solve_thermal_point(problem, *case.solids, settings, throw=False)
            return point_dataset(case, warm)
        return point_dataset(case, solve_point_contact(problem, settings, throw=False))

    nodes = f"{case.solver.nodes_x} x {case.solver.nodes_y}"
    return _console(console, ("point", case.name), f"film on {nodes} nodes", solve, out)


def console_helical_line(console: Console, *, case: HelicalLineCase, out: Path) -> str:
    """Solve a helical pair's contact line, write to `out`; return why it failed, or nothing."""
    film = case.film()
    step = case.step_of(film)
    warn_of_ends(film)

    def solve() -> xr.Dataset:
        # as in a march, so that both have one film where nothing moves
        solution = solve_helical_line(film, step, MARCH_SETTINGS, throw=False)
        return helical_dataset(case, film, step, solution)

    nodes = f"{film.nodes[0]} x {film.nodes[1]}"
    return _console(console, ("helical", case.file.name), f"film on {nodes} nodes", solve, out)


def _warn_of_heights(case: LineCase | PointCase) -> None:
    if case.heights_travel:
        logger.warning(
            "The heights are held at rest while both surfaces move. Those that do not lie along "
            "the motion would travel through the contact and squeeze its film."
        )


def warn_of_ends(film: HelicalFilm) -> None:
    """Warn where lines end at the full face width."""
    if film.modified.pinion.crown is None and film.modified.gear.crown is None:
        logger.warning(
            "Neither flank is crowned: the line ends abruptly, where the film may not converge."
        )


def _console(
    console: Console,
    what: tuple[str, str],
    announced: str,
    solve: Callable[[], xr.Dataset],
    out: Path,
) -> str:
    """Solve and write a contact, `what` its kind and name."""
    kind, name = what
    out.mkdir(parents=True, exist_ok=True)
    with progress_bar(console) as bar:
        task = bar.add_task(announced, total=_STAGES)
        dataset = solve()
        rows = summary_rows(dataset)
        bar.update(task, advance=1, description="files")
        write_dataset(dataset, out / f"{kind}.nc")
        write_text(summary_csv(rows), out / "summary.csv")
        bar.update(task, advance=1, description="figures")
        save_ehl_figures(dataset, out / "figures")
        bar.update(task, advance=1, description="done")
    console.print(_table(kind, name, rows))
    logger.info("Results: %s, %s", out / f"{kind}.nc", out / "figures")
    outcome = str(dataset.attrs["outcome"])
    if not dataset.attrs["converged"]:
        return outcome
    logger.info("%s", outcome)
    return ""


def _table(kind: str, name: str, rows: list[Row]) -> Table:
    table = Table(title=f"{name}: lubricated {kind} contact")
    for heading, justify in (
        ("quantity", "left"),
        ("value", "right"),
        ("unit", "left"),
        ("deviation", "right"),
    ):
        table.add_column(heading, justify=justify)  # type: ignore[arg-type]
    for row in rows:
        factor, unit = _SCALES.get(row.unit, (1.0, row.unit))
        own = row.source == SOLUTION
        table.add_row(
            row.quantity if own else f"  {row.source}",
            f"{factor * row.value:.4g}",
            "" if unit == "1" else unit,
            "" if own else f"{100.0 * row.deviation:+.1f} %",
        )
    return table
