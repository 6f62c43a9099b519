"""The command `gearlube oil`."""

from __future__ import annotations

import logging
import math
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer
from typer.core import TyperGroup

from gearlube.cli.example import kept_example, print_example, prints_example
from gearlube.cli.exit_codes import exit_on_error

if TYPE_CHECKING:
    from gearlube_core.friction.traction_fit import TractionFit
    from gearlube_core.friction.traction_measurements import TractionMeasurements
    from gearlube_core.oil.oil_file import DescribedOil

_LIMIT = 3.5  # standard deviations of a curve's mean: the worst of ten curves by chance 1 in 200


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


def _fit_lines(measured: TractionMeasurements, found: TractionFit) -> list[str]:
    """Return the result, its fit, and the measured range."""
    lines = [_stress("Eyring stress", 1e-6 * found.eyring_stress, " MPa", found.eyring_factor)]
    if math.isnan(found.limiting_coefficient):
        greatest = float(measured.traction.max())
        lines.append(f"Limiting coefficient: not reached; above {greatest:.3g}")
    else:
        lines.append(
            _stress("Limiting coefficient", found.limiting_coefficient, "", found.limiting_factor)
        )
    curves = int(measured.curve.max()) + 1
    lines.append(
        f"Residual: {found.residual:.2g} (standard deviation of traction), mean of the worst of "
        f"{curves} curves {found.curve_misfit:+.2g}"
    )
    slip = measured.sliding_speed / measured.entrainment_speed
    ranges = (
        ("slide-roll ratio", slip, ""),
        ("entrainment speed", measured.entrainment_speed, " m/s"),
        ("mean pressure", 1e-9 * measured.mean_pressure, " GPa"),
        ("temperature", measured.temperature - 273.15, " degC"),
    )
    words = (f"{name} {x.min():.3g} to {x.max():.3g}{unit}" for name, x, unit in ranges)
    lines.append(f"Range: {len(measured)} points, {', '.join(words)}")
    thin, thick = (1e9 * one for one in found.films)
    lines.append(f"Films by formula: {thin:.0f} to {thick:.0f} nm; roughness must be far below")
    if found.out_of_range:
        lines.append(f"{found.out_of_range} points are outside the range of the law.")
    if abs(found.curve_misfit) > _LIMIT * found.residual / math.sqrt(len(measured) / curves):
        lines.append(
            "The law misses a curve by more than scatter: the factors are too small. Film, alpha "
            "or temperature may be wrong; see docs/oil_file.md."
        )
    return lines


def _stress(name: str, value: float, unit: str, factor: float) -> str:
    low, high = value / factor, value * factor
    return f"{name}: {value:.4g}{unit}, 95 %: {low:.4g} to {high:.4g}, factor {factor:.4g}"


def _example() -> str:
    return kept_example("traction.csv")


def fit(
    measurements: Annotated[
        Path, typer.Argument(help="Table of measured traction (CSV).", metavar="CSV")
    ],
    oil: Annotated[str, typer.Option(help="Oil file (TOML) of the measured oil.", metavar="OIL")],
    radius_mm: Annotated[
        float,
        typer.Option(
            help="Relative radius of curvature along rolling [mm]: of a ball on a disc that of the "
            "ball, of two discs R1 R2/(R1 + R2).",
            metavar="MM",
        ),
    ],
    contact: Annotated[str, typer.Option(help="point (a circle) or line.")] = "point",
    out: Annotated[Path, typer.Option(help="Oil file with the fitted stresses.")] = Path(
        "fitted_oil.toml"
    ),
    overwrite: Annotated[
        bool, typer.Option("--overwrite", help="Replace an existing OUT file.")
    ] = False,
    example: Annotated[
        bool,
        prints_example(
            _example, "a table (CSV; computed for iso_vg_220_pao and 10 mm, not measured)"
        ),
    ] = False,
) -> None:
    """Fit Eyring stress and limiting shear stress to measured traction; write an oil file.

    Steel on steel, smooth surfaces, the traction law of the axle's flanks. docs/oil_file.md lists
    the columns of the table.
    """
    from gearlube.output.toml_text import toml_text
    from gearlube_core.checks import check_within
    from gearlube_core.errors import ParameterError
    from gearlube_core.friction.traction_fit import fit_traction
    from gearlube_core.friction.traction_measurements import read_traction
    from gearlube_core.oil.oil_file import OilFile
    from gearlube_core.storage.atomic_file import write_text

    with exit_on_error():
        check_within("--radius-mm", radius_mm, 0.1, 1e4, "mm", "20 mm is 20.")
        file = OilFile.given(oil)
        if out.exists() and not overwrite:
            raise ParameterError(
                f"--out must be a file that does not exist yet, got {out}. Choose "
                "another name, or add --overwrite."
            )
        measured = read_traction(measurements, contact)
        found = fit_traction(
            measured, file.described().lubricant, contact=contact, radius=1e-3 * radius_mm
        )
        for line in _fit_lines(measured, found):
            typer.echo(line)
        text = toml_text(
            _fitted_fields(file.model_dump(exclude_none=True), found, measurements.name)
        )
        write_text(text, out)
        logger.info("Oil file: %s", out)


def _rounded(value: float) -> float:
    return float(f"{value:.6g}")


def _fitted_fields(fields: Mapping[str, Any], found: TractionFit, table: str) -> dict[str, Any]:
    """Return the fields of an oil file with the fitted stresses."""
    changed = dict(fields)
    source = str(fields.get("source", "")).rstrip(". ")
    changed["source"] = f"{source}; stresses fitted to {table}".removeprefix("; ")
    changed["eyring_stress_mpa"] = _rounded(1e-6 * found.eyring_stress)
    changed["eyring_stress_factor"] = _rounded(found.eyring_factor)
    if not math.isnan(found.limiting_coefficient):
        changed["limiting_coefficient"] = _rounded(found.limiting_coefficient)
        changed["limiting_coefficient_factor"] = _rounded(min(found.limiting_factor, 10.0))
    return changed


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
    from gearlube_core.storage.atomic_file import write_figure

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
            write_figure(properties_figure(described), figure)
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
