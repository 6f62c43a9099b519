"""The command `gearlube build-fmu`."""

from __future__ import annotations

import logging
import time
from pathlib import Path
from typing import Annotated

import typer

from gearlube.cli.exit_codes import exit_on_error
from gearlube.cli.results_folder import written_folder

_LOGGER = logging.getLogger("gearlube")


def build_fmu(
    out: Annotated[Path, typer.Option(help="Folder for the FMUs.")] = Path(),
    model: Annotated[
        str | None,
        typer.Option(
            help="hypoid-axle or helical-pair. Default: the model of the given file, else both."
        ),
    ] = None,
    mesh_table: Annotated[
        Path | None,
        typer.Option(help="Mesh table (.nc) of another hypoid pair. Default: the one that ships."),
    ] = None,
    gear: Annotated[
        Path | None, typer.Option(help="Gear file (.toml) of another helical pair.")
    ] = None,
    line_mesh: Annotated[
        Path | None, typer.Option(help="Line mesh (.nc) of that helical pair.")
    ] = None,
) -> None:
    """Build HypoidAxle.fmu and HelicalPair.fmu (FMI 2.0 co-simulation)."""
    from fmu_src.build import build_models

    began = time.monotonic()
    with exit_on_error("Stopped; no FMU was built."), written_folder(out):
        paths = build_models(out, model, mesh_table, gear, line_mesh)
    built = " and ".join(str(path) for path in paths)
    _LOGGER.info("Built %s in %.1f s.", built, time.monotonic() - began)
