"""The command `gearlube bearing`."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer
from rich.box import SIMPLE
from rich.table import Table

from gearlube.cli.example import print_example
from gearlube.cli.oil_option import oil_kelvin
from gearlube.cli.options import ExampleOption, OverwriteOption
from gearlube.cli.ranges import numbers_from
from gearlube.cli.study_run import study_run
from gearlube_core.checks import check_within
from gearlube_core.units import kelvin_to_celsius, rads_to_rpm, rpm_to_rads

if TYPE_CHECKING:  # the study is loaded when the command runs
    from gearlube.studies.bearing.summary import BearingRow

_MICRO = 1e-6


def bearing(
    file: Annotated[
        str, typer.Argument(help="Bearing file (TOML) or a shipped one.", metavar="BEARING")
    ] = "wingertszahn_2023",
    oil: Annotated[
        str | None,
        typer.Option(
            help="Shipped oil or an oil file (TOML). Default: that of the bearing file.",
            metavar="OIL",
        ),
    ] = None,
    law: Annotated[
        list[str] | None,
        typer.Option(
            help="Repeat it for several: zhou_hoeprich, biboulet_houpert, goksem_hargreaves, "
            "aihara, solved_films, palmgren, skf, or all. Default: palmgren and zhou_hoeprich.",
            metavar="LAW",
        ),
    ] = None,
    film_model: Annotated[
        str | None,
        typer.Option(
            help="Film model of rollers for the law solved_films: file (.json) or the name of a "
            "shipped one. Default: that of the bearing file.",
            metavar="MODEL",
        ),
    ] = None,
    speed_rpm: Annotated[
        list[str] | None,
        typer.Option(help="Shaft speeds [rpm]: first:last:step, values.", metavar="RANGE..."),
    ] = None,
    axial_load: Annotated[
        list[str] | None, typer.Option(help="Axial loads [N].", metavar="RANGE...")
    ] = None,
    radial_load: Annotated[
        list[str] | None, typer.Option(help="Radial loads [N].", metavar="RANGE...")
    ] = None,
    temperature: Annotated[
        list[str] | None,
        typer.Option(help="Oil temperatures at the bearing [degC].", metavar="RANGE..."),
    ] = None,
    inlet_layer_um: Annotated[
        float,
        typer.Option(
            help="Thickness of the oil layer at the raceway inlet [um]; 0: flooded.", metavar="UM"
        ),
    ] = 0.0,
    temperature_rise: Annotated[
        float,
        typer.Option(
            help="Temperature rise of the oil in the contacts above --temperature [K].", metavar="K"
        ),
    ] = 0.0,
    out: Annotated[Path, typer.Option(help="Folder for the results.")] = Path("gearlube_bearing"),
    overwrite: OverwriteOption = False,
    example: ExampleOption = False,
) -> None:
    """Friction of a tapered roller bearing: torque and power loss, each part on its own line.

    Writes bearing.nc, bearing.csv, report.html and figures. Conditions given here replace those of
    the file.
    """
    if example:
        print_example("gearlube_core.bearings.bearing_file:BearingFile", "wingertszahn_2023")
        return
    from gearlube.report.inputs import file_inputs, noted_inputs
    from gearlube.studies.bearing.report import bearing_report
    from gearlube.studies.bearing.run import DEFAULT_LAWS, BearingSettings, run_bearing
    from gearlube.studies.bearing.summary import bearing_summary
    from gearlube_core.bearings.bearing_file import BearingFile
    from gearlube_core.bearings.losses.laws import CATALOGUE_LAWS, LAWS
    from gearlube_core.bearings.losses.loss import LARGEST_SPEED_FACTOR, LossModel
    from gearlube_core.errors import ParameterError
    from gearlube_core.film_model.chosen_model import chosen_model
    from gearlube_core.film_model.model import ROLLER
    from gearlube_core.oil.oil_file import read_oil

    with study_run("bearing", out, overwrite=overwrite) as run:
        given = BearingFile.given(file)
        lubricant = read_oil(given.oil if oil is None else oil).lubricant
        operation = given.operation
        check_within("--inlet-layer-um", inlet_layer_um, 0.0, 1e4, "um")
        check_within("--temperature-rise", temperature_rise, 0.0, 100.0, "K")

        def numbers(
            option: str, texts: list[str] | None, usual: Sequence[float], unit: str, high: float
        ) -> tuple[float, ...]:
            chosen = texts or [repr(one) for one in usual]
            low = -100.0 if unit == "degC" else 0.0
            return numbers_from(option, chosen, unit, low, high, example="500:4000:500")

        geometry = given.geometry()
        degrees = numbers("--temperature", temperature, operation.temperature_degc, "degC", 300.0)
        fastest = rads_to_rpm(LARGEST_SPEED_FACTOR / geometry.pitch_diameter)
        laws = list(law or DEFAULT_LAWS)
        if "all" in laws:
            laws = [DEFAULT_LAWS[0], *(one for one in LAWS if one != DEFAULT_LAWS[0])]
        if film_model is not None and "solved_films" not in laws:
            raise ParameterError(
                f"--film-model needs --law solved_films, got {film_model} with {', '.join(laws)}. "
                "Add that law, or leave the option out."
            )
        films = (
            given.own_film_model()
            if film_model is None
            else chosen_model(film_model, ROLLER, "--film-model")
        )
        physical = any(one not in CATALOGUE_LAWS for one in laws)
        settings = BearingSettings(
            speeds=tuple(
                rpm_to_rads(n)
                for n in numbers("--speed-rpm", speed_rpm, operation.speed_rpm, "rpm", fastest)
            ),
            axial_loads=numbers("--axial-load", axial_load, operation.axial_load_n, "N", 1e8),
            radial_loads=numbers("--radial-load", radial_load, operation.radial_load_n, "N", 1e8),
            temperatures=tuple(oil_kelvin(t, lubricant, "--temperature") for t in degrees),
            models=tuple(
                LossModel(
                    law=one,
                    # catalogue laws beside others do without; alone they say that they cannot
                    inlet_layer=(
                        0.0 if physical and one in CATALOGUE_LAWS else _MICRO * inlet_layer_um
                    ),
                    temperature_rise=temperature_rise,
                    film_model=films if one == "solved_films" else None,
                )
                for one in laws
            ),
        )
        settings.check(geometry, lubricant)
        with run.results() as progress:
            dataset = run_bearing(given, settings, oil=lubricant, folder=out, progress=progress)
        run.show(_table(given.name, laws[0], bearing_summary(dataset)))
        run.written("bearing.nc", "bearing.csv", "figures")
        inputs = [*file_inputs(given), *noted_inputs(given.inferred_notes())]
        run.finish(bearing_report(dataset, inputs))


def _table(name: str, law: str, rows: list[BearingRow]) -> Table:
    table = Table(title=f"{name}: friction torque [N.m] by {law}", box=SIMPLE, padding=0)
    parts = list(rows[0].parts) if rows else []
    headings = ["rpm", "axial N", "radial N", "degC", *parts, "total", "loss W"]
    for heading in headings:
        shown = heading.replace(" ", "\n")
        table.add_column(shown, justify="right", no_wrap=True)
    for row in rows:
        table.add_row(
            f"{rads_to_rpm(row.speed):.4g}",
            f"{row.axial_load:g}",
            f"{row.radial_load:g}",
            f"{kelvin_to_celsius(row.temperature):.4g}",
            *(f"{row.parts.get(part, math.nan):.3f}" for part in parts),
            f"{row.torque:.3f}",
            f"{row.power:.4g}",
        )
    return table
