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
        typer.Argument(help="Folder of results, or NAME=FOLDER to name it.", metavar="A"),
    ],
    second: Annotated[str, typer.Argument(help="Another folder of the same study.", metavar="B")],
    out: Annotated[Path, typer.Option(help="Folder of results.")] = Path("gearlube_compare"),
    overwrite: OverwriteOption = False,
) -> None:
    """Compare two runs of one study: key numbers, curves, inputs. Writes report.html.

    Reads the report.html of both folders. Marches of films have `gearlube ehl compare`, which draws
    several over their steps.
    """
    from gearlube.cli.study_run import study_run
    from gearlube.report.comparison import comparison
    from gearlube.report.page import report_html
    from gearlube.report.stored import read_report
    from gearlube_core.errors import GearLubeError, ParameterError

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
