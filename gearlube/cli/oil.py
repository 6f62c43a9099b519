"""The command `gearlube oil`."""

from __future__ import annotations

import logging
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer
from typer.core import TyperGroup

from gearlube.cli.example import print_example
from gearlube.cli.exit_codes import exit_on_error
from gearlube.cli.oil_fit import fit

if TYPE_CHECKING:
    from gearlube_core.oil.oil_file import DescribedOil


class _ShowByDefault(TyperGroup):
    """`gearlube oil my_oil.toml` is `gearlube oil show my_oil.toml`."""

    def parse_args(self, ctx: Any, args: list[str]) -> list[str]:
        """Put "show" in front of arguments that name no command."""
        if args and args[0] not in (*self.commands, "--help"):
            args = ["show", *args]
        return super().parse_args(ctx, args)


logger = logging.getLogger("gearlube")

oil = typer.Typer(
    name="oil",
    cls=_ShowByDefault,
    help="Check and show an oil file, or fit one to measured traction.",
    no_args_is_help=True,
)


@oil.callback()
def _oil() -> None:
    """Show oil files, and fit their stresses to measured traction."""


oil.command()(fit)


@oil.command()
def show(
    file: Annotated[
        str, typer.Argument(help="Oil file (TOML) or the name of a shipped oil.", metavar="OIL")
    ] = "iso_vg_220_pao",
    figure: Annotated[
        Path | None, typer.Option(help="Draw the properties into this file (.png).")
    ] = None,
    assumed: Annotated[
        bool, typer.Option("--assumed", help="Print only the numbers that the file does not give.")
    ] = False,
    example: Annotated[
        bool, typer.Option("--example", help="Print an oil file to start from, and stop.")
    ] = False,
) -> None:
    """Check an oil file; print its numbers, where each is from, and a table over temperature."""
    if example:
        print_example("gearlube_core.oil.oil_file:OilFile", "iso_vg_220_pao")
        return
    from gearlube.plotting.oil_properties import properties_figure
    from gearlube_core.errors import ParameterError
    from gearlube_core.oil.oil_file import read_oil
    from gearlube_core.storage.atomic_file import atomic_write

    with exit_on_error():
        if figure is not None and figure.suffix != ".png":
            raise ParameterError(f"--figure must be a file whose name ends in .png, got {figure}.")
        described = read_oil(file)
        typer.echo(f"{described.name}{f' ({described.source})' if described.source else ''}")
        for line in note_lines(described, assumed):
            typer.echo(line)
        typer.echo(
            f"{len(described.assumed)} of {len(described.inputs)} numbers are not given in "
            "the file: they are assumed or inferred."
        )
        typer.echo("")
        for line in property_lines(described):
            typer.echo(line)
        if figure is not None:
            with atomic_write(figure) as partial:
                properties_figure(described).savefig(partial, format="png", dpi=150)
            logger.info("Figure: %s", figure)


def note_lines(described: DescribedOil, assumed: bool = False) -> list[str]:
    """Return a line for each number of an oil: value, unit, origin, reason."""
    notes = described.assumed if assumed else described.inputs
    wide = max((len(note.field) for note in notes), default=0)
    lines = []
    for note in notes:
        value = f"{note.value_text} {note.unit}".strip()
        lines.append(f"{note.field:{wide}}  {value:20}  {note.origin:8}  {note.why}".rstrip())
    return lines


def property_lines(described: DescribedOil) -> list[str]:
    """Return the properties over temperature as lines of a table."""
    from gearlube_core.oil.property_table import property_table

    head = ("degC", "nu mm2/s", "eta mPa.s", "rho kg/m3", "alpha 1/GPa", "beta 1/K", "k W/(m.K)")
    lines = ["".join(f"{one:>12}" for one in head)]
    for row in property_table(described):
        cells = (
            f"{row.degc:.0f}",
            f"{row.nu * 1e6:.4g}",
            f"{row.eta * 1e3:.4g}",
            f"{row.density:.1f}",
            f"{row.alpha * 1e9:.2f}",
            f"{row.beta:.4f}",
            f"{row.conductivity:.4f}",
        )
        lines.append("".join(f"{one:>12}" for one in cells))
    return lines
