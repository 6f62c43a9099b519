"""The command `gearlube contact`."""

from __future__ import annotations

import logging
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console

from gearlube.cli.exit_codes import BAD_ARGUMENT, FAILED, INTERRUPTED
from gearlube.cli.options import JobsOption
from gearlube.cli.spread_values import SpreadingCommand
from gearlube_core.errors import GearLubeError, ParameterError

logger = logging.getLogger("gearlube")
console = Console(stderr=True)

_QUICK_TORQUES = (20.0, 50.0, 150.0)
_QUICK_POSITIONS = 8


class ContactCommand(SpreadingCommand):
    """Takes several torques after one option."""

    spreading = frozenset({"--torques"})


def contact(
    gear: Annotated[
        str,
        typer.Argument(help="Gear file (TOML) or the name of a shipped one.", metavar="GEAR"),
    ] = "mohammadpour_2015",
    torques: Annotated[
        list[float] | None,
        typer.Option(
            help="Pinion torques [N.m], one or more. Default 5 10 20 50 100 200 300 400.",
            metavar="TORQUE...",
        ),
    ] = None,
    positions: Annotated[
        int | None, typer.Option(help="Positions over a mesh period. Default 20.", metavar="N")
    ] = None,
    offset_error_um: Annotated[
        float,
        typer.Option(
            help="Misalignment E: change of the pinion offset, micrometres.", metavar="UM"
        ),
    ] = 0.0,
    pinion_axial_um: Annotated[
        float,
        typer.Option(
            help="Misalignment P: pinion away from the crossing point, micrometres.", metavar="UM"
        ),
    ] = 0.0,
    gear_axial_um: Annotated[
        float,
        typer.Option(
            help="Misalignment G: gear away from the crossing point, micrometres.", metavar="UM"
        ),
    ] = 0.0,
    shaft_angle_mrad: Annotated[
        float, typer.Option(help="Misalignment of the shaft angle, milliradians.", metavar="MRAD")
    ] = 0.0,
    jobs: JobsOption = None,
    out: Annotated[Path, typer.Option(help="Folder of results.")] = Path("gearlube_contact"),
    export: Annotated[
        bool,
        typer.Option("--export", help="Also write flank points (CSV) and gears (STL, GLB)."),
    ] = False,
    quick: Annotated[
        bool, typer.Option("--quick", help="Few positions and torques, for a first look.")
    ] = False,
) -> None:
    """Analyse the tooth contact of a hypoid pair; write its mesh table, contact.nc and figures.

    Finished positions are kept in OUT/positions: run the same command again to go on after a stop.
    """
    from gearlube.studies.contact.console import console_contact
    from gearlube_core.hypoid_contact.analysis import ContactSettings
    from gearlube_core.hypoid_contact.mesh_cycle import CycleSettings
    from gearlube_core.hypoid_contact.placement import Misalignment
    from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile

    defaults = CycleSettings()
    try:
        file = HypoidGearFile.given(gear)
        chosen = torques or (_QUICK_TORQUES if quick else defaults.torques)
        settings = ContactSettings(
            cycle=CycleSettings(
                positions=positions or (_QUICK_POSITIONS if quick else defaults.positions),
                torques=tuple(sorted(chosen)),
                misalignment=Misalignment(
                    pinion_offset=1e-6 * offset_error_um,
                    pinion_axial=1e-6 * pinion_axial_um,
                    gear_axial=1e-6 * gear_axial_um,
                    shaft_angle=1e-3 * shaft_angle_mrad,
                ),
            )
        )
        console_contact(console, file=file, settings=settings, out=out, jobs=jobs, export=export)
    except KeyboardInterrupt:
        logger.warning("Stopped. Run the same command again to go on from %s.", out / "positions")
        raise typer.Exit(INTERRUPTED) from None
    except ParameterError as error:
        logger.error("%s", error)
        raise typer.Exit(BAD_ARGUMENT) from None
    except (GearLubeError, OSError) as error:
        logger.error("%s", error)
        raise typer.Exit(FAILED) from None
