"""The command `gearlube ehl hypoid`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from gearlube.cli.example import print_example
from gearlube.cli.options import CaseArgument, ExampleOption, OverwriteOption
from gearlube.cli.ranges import two_numbers
from gearlube.studies.films.commands.console import exit_on_errors, solve_and_show

_QUICK = {
    "solver.nodes_minor": 97,
    "solver.nodes_major": 33,
    "solver.steps": 40,
    "solver.steady": 5,
}


def hypoid(
    case: CaseArgument = "mohammadpour_2015",
    mesh_table: Annotated[
        str | None,
        typer.Option(help="Shipped mesh table or one of `gearlube contact`.", metavar="TABLE"),
    ] = None,
    speed_rpm: Annotated[
        float | None, typer.Option(help="Pinion speed [rpm].", metavar="RPM")
    ] = None,
    torque: Annotated[
        float | None,
        typer.Option(
            help="Pinion torque [N.m]; below 0 the coast flank carries.", metavar="TORQUE"
        ),
    ] = None,
    load: Annotated[
        str | None,
        typer.Option(
            help="Load of the running axle, or the share of the torque at rest.",
            metavar="dynamic|static",
        ),
    ] = None,
    entrainment: Annotated[
        str | None,
        typer.Option(
            help="Surface speeds as the axle takes them, or against the point of contact.",
            metavar="mesh_table|moving_contact",
        ),
    ] = None,
    oil: Annotated[str | None, typer.Option(help="Name of a shipped oil.")] = None,
    oil_temperature: Annotated[
        float | None, typer.Option(help="Oil temperature [degC].", metavar="DEGC")
    ] = None,
    temperature: Annotated[
        str | None,
        typer.Option(
            help="thermal: also steady films with heat; needs --no-march.",
            metavar="isothermal|thermal",
        ),
    ] = None,
    flow: Annotated[
        str | None,
        typer.Option(
            help="Flow law of the film; newtonian: the Eyring stress acts on friction alone.",
            metavar="eyring|newtonian",
        ),
    ] = None,
    phases: Annotated[
        str | None,
        typer.Option(
            help="Part of the engagement, mesh periods from its middle.", metavar="FIRST:LAST"
        ),
    ] = None,
    nodes_minor: Annotated[
        int | None, typer.Option(help="Nodes along the minor axis.", metavar="N")
    ] = None,
    nodes_major: Annotated[
        int | None, typer.Option(help="Nodes along the major axis.", metavar="N")
    ] = None,
    steps: Annotated[int | None, typer.Option(help="Time steps of the march.", metavar="N")] = None,
    steady: Annotated[
        int | None, typer.Option(help="Positions with a steady film.", metavar="N")
    ] = None,
    no_march: Annotated[
        bool, typer.Option("--no-march", help="Steady films only, no squeeze term.")
    ] = False,
    quick: Annotated[
        bool, typer.Option("--quick", help="Few nodes and steps, for a first look.")
    ] = False,
    out: Annotated[Path, typer.Option(help="Folder for the results.")] = Path(
        "gearlube_ehl_hypoid"
    ),
    overwrite: OverwriteOption = False,
    example: ExampleOption = False,
) -> None:
    """Solve the films of a hypoid tooth pair through its engagement, beside the formulas.

    Writes hypoid.nc, summary.csv and figures. Options override the case file. A stopped march
    continues from the last step stored in OUT when the same command runs again.
    """
    if example:
        print_example("gearlube_core.ehl.case.hypoid_case:HypoidCase", case, "hypoid_")
        return
    from gearlube.studies.films import run_hypoid
    from gearlube_core.ehl.case.hypoid_case import HypoidCase

    with exit_on_errors(out):
        file = HypoidCase.given(case)
        span = (None, None) if phases is None else two_numbers("--phases", phases, "-0.3:0.8")
        given = {
            "mesh_table": mesh_table,
            "pinion_speed_rpm": speed_rpm,
            "pinion_torque_n_m": torque,
            "load": load,
            "entrainment": entrainment,
            "oil": oil,
            "oil_temperature_degc": oil_temperature,
            "temperature": temperature,
            "flow": flow,
            "first_phase": span[0],
            "last_phase": span[1],
            "solver.nodes_minor": nodes_minor,
            "solver.nodes_major": nodes_major,
            "solver.steps": steps,
            "solver.steady": steady,
        }
        changes = {key: value for key, value in given.items() if value is not None}
        if quick:
            changes = _QUICK | changes
        changed = file.varied(changes) if changes else file
        solve_and_show(
            lambda progress: run_hypoid.run_hypoid(
                changed, march=not no_march, folder=out, progress=progress
            ),
            out,
            "ehl hypoid",
            overwrite=overwrite,
        )
