"""Shared by the commands `gearlube ehl`: progress, summary, messages and exit codes."""

from __future__ import annotations

import logging
import math
from collections.abc import Callable
from contextlib import AbstractContextManager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer
from rich.table import Table

from gearlube.cli.exit_codes import console, exit_if_failed, exit_on_error
from gearlube.cli.results_folder import results_folder
from gearlube.cli.study_run import progress_on, tell_findings
from gearlube_core.checks import check_within
from gearlube_core.errors import ParameterError

if TYPE_CHECKING:
    import xarray as xr

    from gearlube.studies.films.hypoid.summary import RatioRow
    from gearlube.studies.films.results import Row
    from gearlube_core.progress import Progress

FilmErrorOption = Annotated[
    str | None,
    typer.Option(
        help="Halve the spacing until the estimated error of the films is below this, such as 1%.",
        metavar="PERCENT%",
    ),
]
logger = logging.getLogger("gearlube")
_SCALES = {"Pa": (1e-9, "GPa"), "m": (1e6, "µm"), "N/m": (1e-3, "N/mm"), "1": (1.0, "")}


def film_error_of(text: str | None) -> float | None:
    """Return the share that "1%" or "0.01" stands for.

    Raises
    ------
    ParameterError
        It is no number, or not within 0.01 % to 100 %.

    Examples
    --------
    >>> film_error_of("1%")
    0.01
    """
    if text is None:
        return None
    number = text.strip().removesuffix("%")
    try:
        value = float(number) * (0.01 if text.strip().endswith("%") else 1.0)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise ParameterError(
            f"--film-error must be a percentage or a fraction, got {text!r}. Write 1% or 0.01."
        )
    return check_within("--film-error", value, 1e-4, 1.0, "", "1 % is 1% or 0.01.")


def exit_on_errors(out: Path) -> AbstractContextManager[None]:
    """Turn errors into messages and exit codes; `out` is the folder of results."""
    return exit_on_error(f"Stopped; {out} may be incomplete. Run the same command again.")


def solve_and_show(
    solve: Callable[[Progress], xr.Dataset], out: Path, study: str, *, overwrite: bool
) -> None:
    """Solve with a progress bar and print a summary; exit as failed if it did not converge.

    `solve` takes the progress callback and writes its files into `out`, which is or becomes a
    folder of `study`.
    """
    from gearlube.report.page import write_report
    from gearlube.studies.films.report import film_report
    from gearlube.studies.films.results import dataset_file

    with (
        results_folder(out, study, overwrite=overwrite, by_parts=True),
        progress_on("films") as progress,
    ):
        dataset = solve(progress)
    _show(dataset)
    logger.info("Results: %s, %s", dataset_file(dataset, out), out / "figures")
    report = film_report(dataset, out / "figures")
    tell_findings(report.findings, write_report(report, out))
    outcome = str(dataset.attrs["outcome"])
    exit_if_failed("" if dataset.attrs["converged"] else outcome)
    logger.info("%s", outcome)


def _show(dataset: xr.Dataset) -> None:
    """Print the summary of a dataset, for a march its largest pressure and smallest film."""
    from gearlube.studies.films.hypoid.summary import ratio_rows
    from gearlube.studies.films.results import summary_rows

    kind, name = dataset.attrs["contact"], dataset.attrs["name"]
    if kind == "helical_cycle":
        logger.info("Largest pressure %.3f GPa.", 1e-9 * float(dataset["pressure_max"].max()))
        logger.info("Smallest film %.1f nm.", 1e9 * float(dataset["minimum_film"].min()))
    elif kind == "hypoid":
        console.print(_ratio_table(name, ratio_rows(dataset)))
    else:
        console.print(_summary_table(f"{name}: lubricated {kind} contact", summary_rows(dataset)))


def _summary_table(title: str, rows: list[Row]) -> Table:
    from gearlube.studies.films.results import SOLUTION

    table = _table(title, "quantity", ">value", "unit", ">deviation")
    for row in rows:
        factor, unit = _SCALES.get(row.unit, (1.0, row.unit))
        own = row.source == SOLUTION
        table.add_row(
            row.quantity if own else f"  {row.source}",
            f"{factor * row.value:.4g}",
            unit,
            "" if own else f"{100.0 * row.deviation:+.1f} %",
        )
    return table


def _ratio_table(name: str, rows: list[RatioRow]) -> Table:
    title = f"{name}: hypoid flank through its engagement"
    table = _table(title, "quantity", "of", ">least", ">largest", ">mean by load", "unit")
    for row in rows:
        factor, unit = _SCALES.get(row.unit, (1.0, row.unit))
        numbers = (row.least, row.largest, row.load_weighted_mean)
        table.add_row(row.quantity, row.source, *(f"{factor * v:.4g}" for v in numbers), unit)
    return table


def _table(title: str, *headings: str) -> Table:
    """Return an empty table; columns whose heading begins with > are aligned to the right."""
    table = Table(title=title)
    for heading in headings:
        table.add_column(
            heading.removeprefix(">"), justify="right" if heading[0] == ">" else "left"
        )
    return table
