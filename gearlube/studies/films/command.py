"""The commands `gearlube ehl line`, `point`, `helical`, `hypoid` and `compare`."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, TypeVar

import typer
from rich.console import Console

from gearlube.cli.options import (
    CaseArgument,
    ExampleOption,
    HelicalGearArgument,
    SpeedOfFileOption,
    TorqueOfFileOption,
)
from gearlube.studies.films.compare_command import compare
from gearlube.studies.films.hypoid_command import hypoid
from gearlube.studies.films.outcome import told, verdict
from gearlube_core.checks import check_finite, check_within
from gearlube_core.errors import ParameterError
from gearlube_core.units import celsius_to_kelvin, rpm_to_rads

if TYPE_CHECKING:  # the solvers take seconds to import, other commands do without
    from gearlube_core.ehl.case.contact_case import EhlCase

console = Console(stderr=True)

Case = TypeVar("Case", bound="EhlCase")

ehl = typer.Typer(
    name="ehl",
    help="Lubricated contacts: film, pressure and friction of lines, points and helical teeth.",
    no_args_is_help=True,
)

_Entrainment = Annotated[
    float | None,
    typer.Option(help="Mean surface speed along x [m/s].", metavar="M/S"),
]
_SlideRoll = Annotated[
    float | None,
    typer.Option(help="Slide-roll ratio along x, 2 (u1 - u2)/(u1 + u2).", metavar="RATIO"),
]


@ehl.command("line")
def line(
    case: CaseArgument = "jamali_2015",
    load: Annotated[
        float | None, typer.Option(help="Load per length [N/mm].", metavar="N/MM")
    ] = None,
    entrainment: _Entrainment = None,
    slide_roll: _SlideRoll = None,
    nodes: Annotated[
        int | None, typer.Option(help="Nodes of the finest grid.", metavar="N")
    ] = None,
    stencil: Annotated[
        str | None,
        typer.Option(help="Of the wedge.", metavar="upwind-2|central|upwind-1|galerkin"),
    ] = None,
    cavitation: Annotated[
        str | None,
        typer.Option(help="Where the film breaks.", metavar="reynolds|mass_conserving"),
    ] = None,
    temperature: Annotated[
        str | None,
        typer.Option(
            help="thermal: with the energy balance of oil and bodies.",
            metavar="isothermal|thermal",
        ),
    ] = None,
    out: Annotated[Path, typer.Option(help="Folder of results.")] = Path("gearlube_ehl_line"),
    example: ExampleOption = False,
) -> None:
    """Solve a lubricated line contact; write line.nc, summary.csv and figures.

    Shipped cases: jamali_2015, jamali_2015_thermal. Options given here replace those of the case.
    """
    from gearlube.studies.films.console import console_line
    from gearlube_core.ehl.case.contact_case import LineCase

    with told(out):
        if example:
            typer.echo(LineCase.shipped_text(case), nl=False)
            return
        changes = {
            "load_n_per_mm": load,
            "solver.nodes": nodes,
            "solver.stencil": stencil,
            "solver.cavitation": cavitation,
            "temperature": temperature,
        }
        file = _changed(LineCase.given(case), changes, entrainment, slide_roll)
        verdict(console_line(console, case=file, out=out))


@ehl.command("point")
def point(
    case: CaseArgument = "mourier_2006",
    load: Annotated[float | None, typer.Option(help="Load [N].", metavar="NEWTON")] = None,
    entrainment: _Entrainment = None,
    slide_roll: _SlideRoll = None,
    nodes: Annotated[
        int | None, typer.Option(help="Nodes along x and along y.", metavar="N")
    ] = None,
    wedge: Annotated[
        str | None,
        typer.Option(help="Stencil of the wedge.", metavar="upwind-2|upwind-1|central|quick"),
    ] = None,
    cavitation: Annotated[
        str | None,
        typer.Option(help="Where the film breaks.", metavar="reynolds|mass_conserving"),
    ] = None,
    out: Annotated[Path, typer.Option(help="Folder of results.")] = Path("gearlube_ehl_point"),
    example: ExampleOption = False,
) -> None:
    """Solve a lubricated point contact; write point.nc, summary.csv and figures.

    Shipped cases: mourier_2006, elliptical. Options given here replace those of the case.
    """
    from gearlube.studies.films.console import console_point
    from gearlube_core.ehl.case.contact_case import PointCase

    with told(out):
        if example:
            typer.echo(PointCase.shipped_text(case), nl=False)
            return
        changes = {
            "load_n": load,
            "solver.nodes_x": nodes,
            "solver.nodes_y": nodes,
            "solver.wedge": wedge,
            "solver.cavitation": cavitation,
        }
        file = _changed(PointCase.given(case), changes, entrainment, slide_roll)
        verdict(console_point(console, case=file, out=out))


@ehl.command("helical")
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
            help="March in time over these steps of the cycle, with squeeze.",
            metavar="all|FIRST:LAST",
        ),
    ] = None,
    torque: TorqueOfFileOption = None,
    speed_rpm: SpeedOfFileOption = None,
    oil: Annotated[
        str | None,
        typer.Option(help="Oil of the library. Default: that of the gear file."),
    ] = None,
    oil_temperature: Annotated[
        float, typer.Option(help="Temperature of an oil of the library [degC].", metavar="DEGC")
    ] = 80.0,
    newtonian: Annotated[
        bool, typer.Option("--newtonian", help="Leave the oil's Eyring stress out.")
    ] = False,
    facets: Annotated[
        int | None,
        typer.Option(help="Facets of both flanks in place of the involute; 0: none.", metavar="N"),
    ] = None,
    crown_start: Annotated[
        float | None,
        typer.Option(help="Of both crowns, from mid-face [mm].", metavar="MM"),
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
            help="Of the nodes across the line: even, or dense where the film leaves the contact. "
            "Default: that of the gear file.",
            metavar="uniform|exit",
        ),
    ] = None,
    out: Annotated[Path, typer.Option(help="Folder of results.")] = Path("gearlube_ehl_helical"),
) -> None:
    """Solve the film on a helical pair's contact line, at rest at one position or marching.

    At rest: helical.nc, summary.csv, figures. With --march: cycle.nc, its figures and step_*.nc of
    the snapshots; a stopped march goes on from its record in OUT when the same command runs again.
    Tip relief, crown and facets are those of the gear file; options replace them on both flanks.
    """
    from gearlube.studies.films.console import console_helical_line
    from gearlube.studies.films.helical_case import HelicalLineCase
    from gearlube.studies.films.march_console import console_helical_cycle
    from gearlube_core.helical_geometry.gear_file import HelicalGearFile

    with told(out):
        file = HelicalGearFile.given(gear)
        flanks = {
            "facets": facets,
            "crown_start_mm": crown_start,
            "tip_relief_parabola": relief_parabola,
            "tip_relief_exponent": relief_exponent,
            "tip_relief_form": None if relief_exponent is None else "power",
        }
        if relief_parabola is not None and relief_exponent is not None:
            raise ParameterError(
                f"--relief-parabola must not be given with --relief-exponent, got "
                f"{relief_parabola:g} and {relief_exponent:g}. Leave one out."
            )
        if relief_parabola is not None:
            flanks["tip_relief_form"] = "blended"
        changes = {
            f"{role}.flank.{field}": value
            for role in ("pinion", "gear")
            for field, value in flanks.items()
            if value is not None
        }
        file = file.varied(changes) if changes else file
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
            oil_temperature=celsius_to_kelvin(oil_temperature),
            newtonian=newtonian,
            convention=load_sharing,
            nodes=(nodes_across, nodes_along),
            spacing=spacing,
        )
        if march is None:
            if snapshots is not None:
                raise ParameterError(
                    f"--snapshots must be given with --march, got {snapshots!r} alone. Give both."
                )
            verdict(console_helical_line(console, case=case, out=out))
            return
        if step is not None or position is not None:
            raise ParameterError(
                f"--march must not be given with --step or --position, got {march!r}. "
                "Leave one out."
            )
        first, last = _steps(march)
        verdict(
            console_helical_cycle(
                console,
                case=case,
                first=first,
                last=last,
                snapshots=_snapshots(snapshots),
                out=out,
            )
        )


ehl.command("hypoid")(hypoid)
ehl.command("compare")(compare)


def _changed(
    case: Case, changes: dict[str, Any], entrainment: float | None, slide_roll: float | None
) -> Case:
    """Return the case with what the options replace."""
    given = {field: value for field, value in changes.items() if value is not None}
    for name, value, unit in (
        ("--entrainment", entrainment, "m/s"),
        ("--slide-roll", slide_roll, ""),
    ):
        if value is not None:
            check_finite(name, value, unit)
    return (case.varied(given) if given else case).moved(entrainment, slide_roll)


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
