"""The command `gearlube build-fmu`."""

from __future__ import annotations

import logging
import time
from pathlib import Path
from typing import Annotated

import typer

from gearlube.cli.exit_codes import exit_on_error
from gearlube.cli.results_folder import written_folder
from gearlube_core.errors import ParameterError

_LOGGER = logging.getLogger("gearlube")


def build_fmu(
    out: Annotated[Path, typer.Option(help="Folder for the FMUs.")] = Path(),
    model: Annotated[
        str | None,
        typer.Option(
            help="hypoid-axle, helical-pair or driveline. Default: those of the given files, "
            "else all."
        ),
    ] = None,
    mesh_table: Annotated[
        Path | None,
        typer.Option(help="Mesh table (.nc) of another hypoid pair. Default: the shipped one."),
    ] = None,
    axle: Annotated[
        str | None,
        typer.Option(
            help="Axle file (.toml) of another hypoid axle and its car; it names its mesh table.",
            metavar="AXLE",
        ),
    ] = None,
    gear: Annotated[
        Path | None, typer.Option(help="Gear file (.toml) of another helical pair.")
    ] = None,
    line_mesh: Annotated[
        Path | None, typer.Option(help="Line mesh (.nc) of that helical pair.")
    ] = None,
    train: Annotated[
        str | None,
        typer.Option(
            help="Train file (.toml) of a drivetrain, or the name of a shipped one: an FMU with "
            "its name.",
            metavar="TRAIN",
        ),
    ] = None,
    fmi: Annotated[
        list[str] | None,
        typer.Option(help="Version of FMI, 2 or 3; may be repeated. Default: both."),
    ] = None,
    platform: Annotated[
        list[str] | None,
        typer.Option(help="Platform, such as x86_64-windows; may be repeated. Default: all."),
    ] = None,
    python: Annotated[
        bool,
        typer.Option(
            "--python",
            help="Build FMI 2 FMUs that run in this Python installation, for development.",
        ),
    ] = False,
) -> None:
    """Build HypoidAxle.fmu, HelicalPair.fmu, Driveline.fmu or a drivetrain; they need no Python."""
    from fmu_src.native.build_target import compile_for_any_machine

    if not python:
        compile_for_any_machine()
    from fmu_src.build import build_models
    from fmu_src.native.build import FMI_VERSIONS, NativeOptions
    from fmu_src.native.platforms import PLATFORM_NAMES
    from gearlube.cli.axle_gears import bring_gears_up_to_date

    began = time.monotonic()
    with exit_on_error("Stopped; no FMU was built."):
        if python and (fmi or platform):
            raise ParameterError(
                "--python cannot be combined with --fmi or --platform. Leave one of them out."
            )
        native = None
        if not python:
            if not platform:
                _LOGGER.info(
                    "The first build for all %d platforms takes some minutes, later ones seconds. "
                    "--platform x86_64-linux or x86_64-windows builds for one of them.",
                    len(PLATFORM_NAMES),
                )
            native = NativeOptions(
                fmi=fmi or FMI_VERSIONS,
                platforms=platform or PLATFORM_NAMES,
                report=lambda text: _LOGGER.info("%s", text),
            )
        with written_folder(out):
            if axle is not None:
                from fmu_src.hypoid_axle import check_one_table

                check_one_table(mesh_table)
            bring_gears_up_to_date(axle)
            paths = build_models(
                out, model, mesh_table, gear, line_mesh, axle=axle, train=train, native=native
            )
    built = " and ".join(str(path) for path in paths)
    _LOGGER.info("Built %s in %.1f s.", built, time.monotonic() - began)
