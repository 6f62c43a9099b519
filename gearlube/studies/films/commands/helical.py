"""The command `gearlube ehl helical`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from gearlube.cli.example import print_example
from gearlube.cli.oil_option import oil_kelvin
from gearlube.cli.options import (
    ExampleOption,
    FilmRoughnessOption,
    HelicalGearArgument,
    OverwriteOption,
    SpeedOfFileOption,
    TorqueOfFileOption,
)
from gearlube.studies.films.commands.console import (
    FilmErrorOption,
    exit_on_errors,
    film_error_of,
    solve_and_show,
)
from gearlube_core.checks import check_option, check_within
from gearlube_core.errors import ParameterError
from gearlube_core.units import celsius_to_kelvin, rpm_to_rads


def helical(
    gear: HelicalGearArgument = "jamali_2015_a",
    step: Annotated[
        float | None,
        typer.Option(help="Step of the meshing cycle, 0.04 mm each.", metavar="N"),
    ] = None,
    position: Annotated[
        float | None,
        typer.Option(
            help="Place of the line's end on the line of action, from the pitch line [mm]. "
            "Default: where the line carries most.",
            metavar="MM",
        ),
    ] = None,
    march: Annotated[
        str | None,
        typer.Option(
            help="Transient solution over these steps of the cycle, with squeeze.",
            metavar="all|FIRST:LAST",
        ),
    ] = None,
    torque: TorqueOfFileOption = None,
    speed_rpm: SpeedOfFileOption = None,
    oil: Annotated[
        str | None,
        typer.Option(help="Name of a shipped oil. Default: that of the gear file."),
    ] = None,
    oil_temperature: Annotated[
        float, typer.Option(help="Temperature of the shipped oil [degC].", metavar="DEGC")
    ] = 80.0,
    newtonian: Annotated[
        bool, typer.Option("--newtonian", help="Newtonian oil: ignore its Eyring stress.")
    ] = False,
    facets: Annotated[
        int | None,
        typer.Option(help="Facets of both flanks in place of the involute; 0: none.", metavar="N"),
    ] = None,
    crown_start: Annotated[
        float | None,
        typer.Option(help="Start of both crowns, from mid-face [mm].", metavar="MM"),
    ] = None,
    relief_parabola: Annotated[
        float | None,
        typer.Option(help="Parabolic share k of both tip reliefs.", metavar="K"),
    ] = None,
    relief_exponent: Annotated[
        float | None,
        typer.Option(help="Exponent of both tip reliefs as powers of the depth.", metavar="BETA"),
    ] = None,
    snapshots: Annotated[
        str | None,
        typer.Option(
            help="Steps of a march whose film is written and drawn beside the line at rest.",
            metavar="N,N,...",
        ),
    ] = None,
    load_sharing: Annotated[
        str,
        typer.Option(
            help="Load of all lines: normal to the flanks, or as in the thesis, T/r_b.",
            metavar="normal|thesis",
        ),
    ] = "normal",
    nodes_across: Annotated[
        int | None,
        typer.Option(help="Nodes across the line. Default: those of the gear file.", metavar="N"),
    ] = None,
    nodes_along: Annotated[
        int | None,
        typer.Option(help="Nodes along the line. Default: those of the gear file.", metavar="N"),
    ] = None,
    spacing: Annotated[
        str | None,
        typer.Option(
            help="Spacing of nodes across the line: even, or dense at the outlet. "
            "Default: that of the gear file.",
            metavar="uniform|exit",
        ),
    ] = None,
    roughness_um: FilmRoughnessOption = None,
    film_error: FilmErrorOption = None,
    time_error: Annotated[
        str,
        typer.Option(
            help="How a march estimates the error of its time steps: from its own steps, or from "
            "a repeat with steps twice as long, half as much time again.",
            metavar="embedded|repeat",
        ),
    ] = "embedded",
    out: Annotated[Path, typer.Option(help="Folder for the results.")] = Path(
        "gearlube_ehl_helical"
    ),
    overwrite: OverwriteOption = False,
    example: ExampleOption = False,
) -> None:
    """Solve the film on a helical pair's contact line, steady at one position or in time.

    At rest: helical.nc, summary.csv, figures. With --march: cycle.nc, its figures and step_*.nc of
    the snapshots; a stopped march goes on from its record in OUT when the same command runs again.
    Tip relief, crown and facets are those of the gear file; options replace them on both flanks.
    """
    if example:
        print_example("gearlube_core.helical_geometry.gear_file:HelicalGearFile", gear)
        return
    from gearlube.studies.films import run_march, run_steady
    from gearlube.studies.films.helical_case import HelicalLineCase, with_flanks
    from gearlube_core.helical_geometry.gear_file import HelicalGearFile

    with exit_on_errors(out):
        _check_options(step, position, march, snapshots)
        check_option("--time-error", time_error, ("embedded", "repeat"))
        goal = film_error_of(film_error)
        if goal is not None and march is not None:
            raise ParameterError(
                f"--film-error cannot be combined with --march, got {film_error!r}: the error is "
                "only estimated for steady films. Leave one out, or give --nodes-across."
            )
        file = with_flanks(
            HelicalGearFile.given(gear), facets, crown_start, relief_parabola, relief_exponent
        )
        if oil is None:
            check_within("--oil-temperature", oil_temperature, -20.0, 160.0, "degC")
        if speed_rpm is not None:
            check_within("--speed-rpm", speed_rpm, 0.1, 1e6, "rpm", "Give its magnitude.")
        case = HelicalLineCase(
            file=file,
            torque=torque,
            pinion_speed=None if speed_rpm is None else rpm_to_rads(speed_rpm),
            step=step,
            position=None if position is None else 1e-3 * position,
            oil=oil,
            oil_temperature=celsius_to_kelvin(oil_temperature)
            if oil is None
            else oil_kelvin(oil_temperature, oil),
            newtonian=newtonian,
            convention=load_sharing,
            nodes=(nodes_across, nodes_along),
            spacing=spacing,
            roughness_um=roughness_um,
        )
        if march is None:
            solve_and_show(
                lambda progress: run_steady.run_helical_line(
                    case, film_error=goal, folder=out, progress=progress
                ),
                out,
                "ehl helical",
                overwrite=overwrite,
            )
            return
        first, last = _steps(march)
        steps = run_march.MarchSteps(
            first=first,
            last=last,
            snapshots=_snapshots(snapshots),
            repeat=time_error == "repeat",
        )
        solve_and_show(
            lambda progress: run_march.run_helical_march(
                case, steps, folder=out, progress=progress
            ),
            out,
            "ehl helical",
            overwrite=overwrite,
        )


def _check_options(
    step: float | None, position: float | None, march: str | None, snapshots: str | None
) -> None:
    """Raise ParameterError if options exclude each other."""
    if march is None and snapshots is not None:
        raise ParameterError(f"--snapshots needs --march, got {snapshots!r} without it. Give both.")
    if march is not None and (step is not None or position is not None):
        raise ParameterError(
            f"--march cannot be combined with --step or --position, got {march!r}. Leave one out."
        )


def _steps(text: str) -> tuple[int, int | None]:
    """Return the two whole numbers of "100:200", or those of the whole cycle."""
    if text == "all":
        return 0, None
    pieces = text.split(":")
    if len(pieces) != 2 or not all(piece.isdecimal() for piece in pieces):
        raise ParameterError(
            f"--march must be all or two whole numbers, got {text!r}. Write FIRST:LAST, for "
            "instance 100:200."
        )
    return int(pieces[0]), int(pieces[1])


def _snapshots(text: str | None) -> tuple[int, ...]:
    """Return the whole numbers of "75,300"."""
    pieces = [] if text is None else [piece.strip() for piece in text.split(",")]
    if not all(piece.isdecimal() for piece in pieces):
        raise ParameterError(
            f"--snapshots must be whole numbers, got {text!r}. Write N,N,..., for instance 75,300."
        )
    return tuple(sorted({int(piece) for piece in pieces}))
