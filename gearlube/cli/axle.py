"""The command `gearlube axle`."""

from __future__ import annotations

import logging
from typing import Annotated

import typer

from gearlube.cli.example import print_example
from gearlube.cli.exit_codes import exit_on_error
from gearlube.cli.options import ExampleOption

_LOGGER = logging.getLogger("gearlube")

axle = typer.Typer(
    name="axle", help="Check and show an axle file (an axle and its car).", no_args_is_help=True
)


@axle.callback()
def _axle() -> None:
    """Check axle files and show what they give."""


@axle.command()
def show(
    file: Annotated[
        str, typer.Argument(help="Axle file (TOML) or the name of a shipped one.", metavar="AXLE")
    ] = "mohammadpour_2015",
    assumed: Annotated[
        bool, typer.Option("--assumed", help="Print only the inputs that the file does not give.")
    ] = False,
    example: ExampleOption = False,
) -> None:
    """Check an axle file; print every input with its value, unit and where it is from."""
    if example:
        print_example("drivetrain.axle_file.axle_file:AxleFile", "mohammadpour_2015")
        return
    _LOGGER.info("Reading the axle with its gears and oil, some seconds; more the first time.")
    from drivetrain.axle_file.read_axle import read_axle
    from gearlube.cli.axle_gears import bring_gears_up_to_date

    with exit_on_error("Stopped. Run the same command again to go on."):
        bring_gears_up_to_date(file)
        described = read_axle(file)
        mesh = described.axle.mesh
        typer.echo(f"{described.name}{f' ({described.source})' if described.source else ''}")
        typer.echo(f"mesh table {mesh.name}: {mesh.pinion_teeth}/{mesh.gear_teeth} teeth")
        notes = described.assumed if assumed else described.inputs
        wide = max((len(note.field) for note in notes), default=0)
        for note in notes:
            value = f"{note.value_text} {note.unit}".strip()
            line = f"{note.field:{wide}}  {value:28}  {note.origin:8}  {note.why}"
            typer.echo(line.rstrip())
        typer.echo(
            f"{len(described.assumed)} of {len(described.inputs)} inputs are not given in "
            "the file: they are assumed or inferred."
        )
