"""The commands `gearlube ehl line`, `point`, `helical`, `hypoid`, `rough` and `compare`."""

from __future__ import annotations

import logging
from pathlib import Path
from typing import Annotated

import typer

from gearlube.cli.options import OverwriteOption
from gearlube.cli.results_folder import results_folder
from gearlube.studies.films.commands.console import exit_on_errors
from gearlube.studies.films.commands.contacts import line, point, rough
from gearlube.studies.films.commands.helical import helical
from gearlube.studies.films.commands.hypoid import hypoid
from gearlube_core.checks import check_within
from gearlube_core.errors import ParameterError

logger = logging.getLogger("gearlube")

ehl = typer.Typer(
    name="ehl",
    help="Lubricated contacts: film, pressure and friction of lines, points and helical teeth.",
    no_args_is_help=True,
)


def compare(
    marches: Annotated[
        list[str],
        typer.Argument(
            help="Folders of marches, or NAME=FOLDER to name them.", metavar="FOLDER..."
        ),
    ],
    film_exponent: Annotated[
        float,
        typer.Option(
            help="Divide films by the pinion speed, over that of the first, to this power.",
            metavar="N",
        ),
    ] = 0.0,
    out: Annotated[Path, typer.Option(help="Folder for the results.")] = Path(
        "gearlube_ehl_compare"
    ),
    overwrite: OverwriteOption = False,
) -> None:
    """Draw largest pressures and smallest films of several marches over their steps.

    For instance of one pair with other tip reliefs, crowns, facets or speeds, each marched before
    by gearlube ehl helical --march. Writes compare.png.
    """
    from gearlube.studies.films.run_march import compare_marches

    with exit_on_errors(out):
        folders: dict[str, Path] = {}
        for entry in marches:
            name, given, folder = entry.rpartition("=")
            where = Path(folder if given else entry)
            label = name if given else where.name
            if label in folders:
                raise ParameterError(
                    f"The names of the marches must differ, got {label!r} twice. Write NAME=FOLDER."
                )
            folders[label] = where
        check_within("--film-exponent", film_exponent, -5.0, 5.0)
        with results_folder(out, "ehl compare", overwrite=overwrite):
            compare_marches(folders, film_exponent=film_exponent, folder=out)
        logger.info("Results: %s", out / "compare.png")


for _command in (line, point, helical, hypoid, rough, compare):
    ehl.command(_command.__name__)(_command)
