"""The command `gearlube export`."""

from __future__ import annotations

import logging
from pathlib import Path
from typing import Annotated

import typer

from gearlube.cli.exit_codes import exit_on_error

logger = logging.getLogger("gearlube")


def export(
    run: Annotated[
        Path, typer.Argument(help="Folder of results of any study, or a NetCDF file (.nc).")
    ],
    to: Annotated[str, typer.Option(help="csv, mat, uff58, mdf4, vtk or fmu.", metavar="FORMAT")],
    out: Annotated[
        Path | None,
        typer.Option(
            help="File; a folder for csv and vtk. Default: the name of the dataset, in this folder."
        ),
    ] = None,
    variable: Annotated[
        list[str] | None,
        typer.Option(help="Export this variable; give it once for each. Default: all."),
    ] = None,
    span: Annotated[
        list[str] | None,
        typer.Option(
            help="Export this part, in the unit of the dataset: time=2:5, bearing=pinion.",
            metavar="NAME=FIRST:LAST",
        ),
    ] = None,
    overwrite: Annotated[
        bool, typer.Option("--overwrite", help="Write also where OUT is there.")
    ] = False,
) -> None:
    """Write results of any study for other tools: tables, MATLAB, UFF58, MDF4, VTK, FMU.

    csv writes a folder with one table for each set of dimensions, and tables.csv, which says what
    is where. uff58 holds time histories and spectra, and needs pip install 'gearlube[sound]'.
    mdf4 holds time histories as a measurement file, and vtk writes a folder of fields (contact,
    ehl); both need pip install 'gearlube[export]'. fmu makes a loss map an FMU of FMI 3.0, and
    needs pip install 'gearlube[native]'.
    """
    from gearlube.output.exports.export import export_results

    with exit_on_error():
        written = export_results(
            run,
            to,
            out,
            variables=variable or (),
            spans=dict(_span(text) for text in span or ()),
            overwrite=overwrite,
        )
        for path in written:
            logger.info("Written: %s", path)


def _span(text: str) -> tuple[str, tuple[str, str]]:
    from gearlube_core.errors import ParameterError

    name, sign, limits = text.partition("=")
    first, colon, last = limits.partition(":")
    if not (name and sign and limits):
        raise ParameterError(f"--span must be NAME=FIRST:LAST or NAME=VALUE, got {text!r}.")
    return name, (first, last if colon else first)
