"""The command `gearlube compare`."""

from __future__ import annotations

import logging
from pathlib import Path
from typing import Annotated

import typer

from gearlube.cli.options import OverwriteOption
from gearlube.cli.results_folder import results_folder

logger = logging.getLogger("gearlube")


def compare(
    first: Annotated[
        str,
        typer.Argument(
            help="Folder of results, or NAME=FOLDER to name it; of films a case file.", metavar="A"
        ),
    ],
    second: Annotated[str, typer.Argument(help="Another folder of the same study.", metavar="B")],
    out: Annotated[Path, typer.Option(help="Folder for the results.")] = Path("gearlube_compare"),
    overwrite: OverwriteOption = False,
) -> None:
    """Compare two runs of one study, or a run with measurements. Writes report.html.

    Of two runs: key numbers, curves and inputs, from the report.html of both folders. Marches of
    films have `gearlube ehl compare`, which draws several over their steps.

    Of a run and a table of measurements: the residuals with both uncertainties. A folder of
    `gearlube map` is compared with loss torques or efficiencies, of `gearlube bearing` with
    friction torques, of `gearlube contact` with transmission errors by order. A case file of
    `gearlube ehl point` is solved where central films were measured. Each column of the table ends
    with its unit, and one is the uncertainty.
    """
    from gearlube.cli.study_run import study_run
    from gearlube.report.comparison import comparison
    from gearlube.report.page import report_html
    from gearlube.report.stored import read_report
    from gearlube_core.errors import GearLubeError, ParameterError
    from gearlube_core.input_file.table import TABLES

    if second.lower().endswith(TABLES):
        _with_measurements(first, second, out, overwrite)
        return
    with study_run("compare", out, overwrite=overwrite, stopped="Stopped.") as run:
        names, data = [], []
        for entry in (first, second):
            name, given, folder = entry.rpartition("=")
            where = Path(folder if given else entry)
            names.append(name if given else where.resolve().name)
            data.append(read_report(where))
        if names[0] == names[1]:
            names = [str(Path(entry)) for entry in (first, second)]
        try:
            report = comparison(data[0], data[1], (names[0], names[1]))
            report_html(report)
        except GearLubeError:
            raise
        except (LookupError, TypeError, ValueError, AttributeError, OverflowError) as reason:
            raise ParameterError(
                f"The reports of {names[0]} and {names[1]} must be as their studies wrote them, "
                f"but one was changed or is damaged ({type(reason).__name__}). Run its study again."
            ) from None
        with results_folder(out, "compare", overwrite=overwrite):
            run.finish(report)


def _with_measurements(entry: str, table: str, out: Path, overwrite: bool) -> None:
    from gearlube.cli.study_run import study_run
    from gearlube.plotting.figure_files import save_figure_folder
    from gearlube.report.measured_run import (
        FEWEST,
        compared,
        comparison_with_measured,
        measured_figure,
        residuals_text,
    )
    from gearlube_core.input_file.measurements import read_measurements
    from gearlube_core.storage.atomic_file import write_text

    name, _, folder = entry.rpartition("=")
    with study_run("compare", out, overwrite=overwrite, stopped="Stopped.") as run:
        found = compared(Path(folder), read_measurements(table, fewest=FEWEST))
        report = comparison_with_measured(found, name or Path(folder).resolve().name)
        with results_folder(out, "compare", overwrite=overwrite):
            write_text(residuals_text(found), out / "residuals.csv")
            save_figure_folder({"measured": measured_figure(found)}, out / "figures")
            run.finish(report)
