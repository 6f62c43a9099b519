"""The command `gearlube`."""

from __future__ import annotations

import logging
import shlex
import sys
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console
from rich.logging import RichHandler

from gearlube.cli.arguments import speeds_from
from gearlube.cli.build_fmu import build_fmu
from gearlube.cli.exit_codes import BAD_ARGUMENT, FAILED, INTERRUPTED
from gearlube.cli.native import native
from gearlube.cli.options import JobsOption, OilTemperatureOption, RoughnessOption
from gearlube.cli.spread_values import SpreadingCommand
from gearlube.studies.contact.command import ContactCommand, contact
from gearlube.studies.films.command import ehl
from gearlube.studies.helical.command import HelicalCommand, helical
from gearlube.studies.resonance.command import resonance
from gearlube_core import __version__
from gearlube_core.checks import check_within
from gearlube_core.errors import GearLubeError, ParameterError, TableError
from gearlube_core.units import celsius_to_kelvin

logger = logging.getLogger("gearlube")
console = Console(stderr=True)

_DEFAULT_SPEEDS = ("20:100:5",)
_QUICK_SPEEDS = ("20:100:40",)
_DEFAULT_PRELOADS = (2500.0, 6000.0)

app = typer.Typer(
    name="gearlube",
    help="Lubricated gears: tooth contact, vibration, FMUs, speed sweeps and their report.",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_show_locals=False,
    rich_markup_mode="markdown",  # of the others, one would swallow [units]
)


class _SweepCommand(SpreadingCommand):
    spreading = frozenset({"--speeds", "--preload"})


def _show_version(wanted: bool) -> None:
    if wanted:
        typer.echo(f"gearlube {__version__}")
        raise typer.Exit


@app.callback()
def _common(
    version: Annotated[
        bool,
        typer.Option("--version", callback=_show_version, is_eager=True, help="Show the version."),
    ] = False,
    verbose: Annotated[bool, typer.Option("--verbose", "-v", help="Log details.")] = False,
) -> None:
    logger.setLevel(logging.INFO)
    logging.getLogger("drivetrain").setLevel(logging.INFO)
    if verbose:
        for name in ("gearlube", "drivetrain", "fmu_src", "gearlube_core"):
            logging.getLogger(name).setLevel(logging.DEBUG)


@app.command(cls=_SweepCommand)
def sweep(
    speeds: Annotated[
        list[str] | None,
        typer.Option(
            help="Vehicle speeds [km/h]: first:last:step and single values. Default 20:100:5.",
            metavar="RANGE...",
        ),
    ] = None,
    preload: Annotated[
        list[float] | None,
        typer.Option(
            help="Bearing preloads [N], one or more. Default 2500 6000.", metavar="FORCE..."
        ),
    ] = None,
    oil_temperature: OilTemperatureOption = 95.0,
    oil: Annotated[
        str, typer.Option(help="mohammadpour_2015 or karagiannis_2012.")
    ] = "mohammadpour_2015",
    roughness_um: RoughnessOption = 0.5,
    equations: Annotated[
        str, typer.Option(help="consistent, or as_printed in the paper.")
    ] = "consistent",
    friction: Annotated[
        str, typer.Option(help="Flank friction: consistent, as_printed or off.")
    ] = "consistent",
    bearing_torque_loss: Annotated[
        str, typer.Option(help="Drag torque of the bearings: palmgren or none.")
    ] = "palmgren",
    driver: Annotated[
        str, typer.Option(help="vehicle: coupled driveline; hold: road load and speed hold.")
    ] = "vehicle",
    jobs: JobsOption = None,
    scheduler: Annotated[
        str | None,
        typer.Option(help="Address of a running Dask scheduler instead of local processes."),
    ] = None,
    out: Annotated[Path, typer.Option(help="Folder of results.")] = Path("gearlube_sweep"),
    quick: Annotated[
        bool, typer.Option("--quick", help="Few speeds and short records, for a first look.")
    ] = False,
    fmu: Annotated[
        Path | None, typer.Option(help="Axle FMU to run. Default: that of this installation.")
    ] = None,
    mesh_table: Annotated[
        Path | None,
        typer.Option(help="Mesh table (.nc) of another gear pair, built into the axle FMU."),
    ] = None,
) -> None:
    """Sweep vehicle speed and bearing preload; write sweep.nc, summary.csv and report.html.

    Finished points are kept in OUT/points: run the same command again to go on after a stop.
    """
    from gearlube.studies.sweep import SweepInterruptedError, SweepSettings, quick_settings
    from gearlube.studies.sweep.console import console_sweep

    try:
        check_within("--oil-temperature", oil_temperature, -20.0, 160.0, "degC")
        if fmu is not None and mesh_table is not None:
            raise ParameterError(
                "--mesh-table must not be given with --fmu, which has its own table, got both. "
                "Build the FMU with `gearlube build-fmu --mesh-table`, or leave out --fmu."
            )
        settings = SweepSettings(
            oil_temperature=celsius_to_kelvin(oil_temperature),
            oil=oil,
            roughness_rms=roughness_um * 1e-6,
            equations=equations,
            friction=friction,
            bearing_torque_loss=bearing_torque_loss,
            driver=driver,
        )
        failures = console_sweep(
            console,
            fmu=fmu,
            mesh_table=mesh_table,
            speeds_kmh=speeds_from(speeds or (_QUICK_SPEEDS if quick else _DEFAULT_SPEEDS)),
            preloads=preload or list(_DEFAULT_PRELOADS),
            settings=quick_settings(settings) if quick else settings,
            out=out,
            jobs=jobs,
            scheduler=scheduler,
            quick=quick,
            command_line=shlex.join(["gearlube", *sys.argv[1:]]),
        )
    except SweepInterruptedError as error:
        logger.warning("%s", error)
        raise typer.Exit(INTERRUPTED) from None
    except (ParameterError, TableError) as error:
        logger.error("%s", error)
        raise typer.Exit(BAD_ARGUMENT) from None
    except GearLubeError as error:
        logger.error("%s", error)
        raise typer.Exit(FAILED) from None
    if failures:
        raise typer.Exit(FAILED)


app.command("build-fmu")(build_fmu)
app.command("contact", cls=ContactCommand)(contact)
app.command("resonance")(resonance)
app.command("helical", cls=HelicalCommand)(helical)
app.command("native", context_settings={"allow_interspersed_args": False})(native)
app.add_typer(ehl, name="ehl")


def main() -> None:
    """Entry point of the command `gearlube`."""
    handler = RichHandler(console=console, show_path=False, show_time=False, markup=False)
    logging.basicConfig(level=logging.WARNING, format="%(message)s", handlers=[handler])
    app()
