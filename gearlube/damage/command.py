"""The command `gearlube damage`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from gearlube.cli.example import prints_example
from gearlube.cli.options import OverwriteOption
from gearlube.cli.study_run import empty_table, study_run

_EXAMPLE = """\
# bins of a whole life, for --cycle or --add; torque and speed of the pinion, torque < 0: coast
torque_n_m, speed_rpm, temperature_degc, hours
350, 600, 90, 20
250, 1500, 100, 50
-60, 2500, 80, 100
"""


def damage(
    axle: Annotated[
        str,
        typer.Argument(help="Axle file (TOML) or the name of a shipped one.", metavar="AXLE"),
    ] = "mohammadpour_2015",
    cycle: Annotated[
        str,
        typer.Option(
            "--cycle",
            help="nedc, wltc, ftp75, a cycle as for `gearlube cycle`, or a table of bins (CSV) "
            "with torque_n_m, speed_rpm, temperature_degc and hours.",
            metavar="NAME|FILE",
        ),
    ] = "wltc",
    distance_km: Annotated[
        float, typer.Option(help="Distance over which the cycle is repeated [km].")
    ] = 300_000.0,
    add: Annotated[
        Path | None,
        typer.Option(
            help="Table of bins (CSV) in addition: a hill, a trailer, starts.", exists=True
        ),
    ] = None,
    gears: Annotated[
        str,
        typer.Option(
            help="Gear file of the axle, for the standard; left out: that of the axle file, or the "
            "shipped one of its mesh table's name.",
            metavar="FILE",
        ),
    ] = "",
    contact_limit_mpa: Annotated[
        float | None,
        typer.Option(help="sigma_H lim of both gears [MPa]; 1500 is an example."),
    ] = None,
    bending_limit_mpa: Annotated[
        float | None,
        typer.Option(help="Nominal sigma_F lim of both gears [MPa]; 430 is an example."),
    ] = None,
    treatment: Annotated[
        str, typer.Option(help="case_hardened, nitrided, through_hardened, ...")
    ] = "case_hardened",
    face_factor: Annotated[
        float, typer.Option(help="K_H beta of the standard; 1.65: light check, one overhung.")
    ] = 1.65,
    application_factor: Annotated[
        float, typer.Option(help="K_A: what the torques of the bins lack.")
    ] = 1.0,
    wear_coefficient: Annotated[
        float | None,
        typer.Option(help="k of Archard's law, of your tests [1/Pa]; left out: no wear."),
    ] = None,
    wear_of_all_load: Annotated[
        bool, typer.Option("--wear-of-all-load", help="Films spare nothing: an upper bound.")
    ] = False,
    pinion_bearings_kn: Annotated[
        list[float] | None,
        typer.Option(help="C, or C and C_0, of the pinion's bearings [kN].", metavar="C C_0..."),
    ] = None,
    gear_bearings_kn: Annotated[
        list[float] | None,
        typer.Option(help="C, or C and C_0, of the gear's bearings [kN].", metavar="C C_0..."),
    ] = None,
    cleanliness: Annotated[
        str | None,
        typer.Option(help="Class of the oil for the bearings, such as 'bath -/17/14'."),
    ] = None,
    raceway_roughness_um: Annotated[
        float | None,
        typer.Option(help="Composite roughness of raceways and rollers, for solved films [µm]."),
    ] = None,
    scuffing_temperature: Annotated[
        float | None, typer.Option(help="At which the oil scuffs, mean of tests [degC].")
    ] = None,
    start_temperature: Annotated[
        float, typer.Option(help="Oil at the start of each cycle, and air [degC].")
    ] = 23.0,
    regeneration: Annotated[
        float, typer.Option(help="Share of the braking through the axle, 0 to 1.")
    ] = 0.0,
    out: Annotated[Path, typer.Option(help="Folder of results.")] = Path("gearlube_damage"),
    overwrite: OverwriteOption = False,
    example: Annotated[bool, prints_example(lambda: _EXAMPLE, "a table of bins")] = False,
) -> None:
    """Will it last? Damage of flanks, roots and bearings of an axle over a duty cycle.

    Lays the numbers of standards and the solved contact side by side. Writes damage.nc, damage.csv,
    summary.csv, report.html and figures.
    """
    from drivetrain.axle_file.read_axle import read_axle
    from drivetrain.cycle.traces import DriveCycle
    from gearlube.cli.axle_gears import bring_gears_up_to_date
    from gearlube.damage.bins import cycle_bins, is_bins, joined, read_bins
    from gearlube.damage.report import damage_report
    from gearlube.damage.run import run_damage
    from gearlube.damage.settings import DamageSettings, rated_bearing, rated_pair
    from gearlube.damage.summary import SUMMARY_HEAD
    from gearlube.report.inputs import noted_inputs
    from gearlube.report.parts import Input
    from gearlube.studies.drive_cycle.settings import DriveCycleSettings
    from gearlube_core.rating.gears import LoadFactors
    from gearlube_core.units import celsius_to_kelvin

    with study_run("damage", out, overwrite=overwrite) as run:
        material, blank = rated_pair(axle, gears, treatment, contact_limit_mpa, bending_limit_mpa)
        bring_gears_up_to_date(axle)
        car = read_axle(axle)
        if is_bins(cycle):
            bins, duty = read_bins(cycle), Path(cycle).name
        else:
            driven = DriveCycleSettings(
                car=car,
                cycle=DriveCycle.given(cycle),
                start_temperature=celsius_to_kelvin(start_temperature),
                air_temperature=celsius_to_kelvin(start_temperature),
                regeneration=regeneration,
            )
            bins = cycle_bins(driven, 1e3 * distance_km)
            duty = f"{cycle} over {distance_km:g} km"
        if add is not None:
            bins, duty = joined(bins, read_bins(add)), f"{duty}, and {add.name}"
        settings = DamageSettings(
            car=car,
            bins=bins,
            gears=material,
            blank=blank,
            factors=LoadFactors(face=face_factor, application=application_factor),
            wear_coefficient=wear_coefficient,
            wear_of_all_load=wear_of_all_load,
            bearings=(
                rated_bearing(car.axle.bearing, pinion_bearings_kn),
                rated_bearing(car.axle.gear_bearing or car.axle.bearing, gear_bearings_kn),
            ),
            cleanliness=cleanliness,
            raceway_roughness=raceway_roughness_um and 1e-6 * raceway_roughness_um,
            scuffing_temperature=(
                None if scuffing_temperature is None else celsius_to_kelvin(scuffing_temperature)
            ),
            duty=duty,
        )
        with run.results() as progress:
            dataset = run_damage(settings, folder=out, progress=progress)
        given = {
            "life": duty,
            "contact limit [MPa]": contact_limit_mpa,
            "bending limit [MPa]": bending_limit_mpa,
            "treatment": treatment if material else None,
            "K_H beta": face_factor,
            "K_A": application_factor,
            "k of wear [1/Pa]": wear_coefficient,
            "wear of all load": wear_of_all_load if wear_coefficient is not None else None,
            "C, C_0 of the pinion's bearings [kN]": pinion_bearings_kn,
            "C, C_0 of the gear's bearings [kN]": gear_bearings_kn,
            "cleanliness": cleanliness,
        }
        inputs = [Input(name, str(value)) for name, value in given.items() if value is not None]
        report = damage_report(dataset, out / "figures", [*inputs, *noted_inputs(car.inputs)])
        table = empty_table("Will it last?", *SUMMARY_HEAD[:2], ">safety", "verdict")
        for row in report.tables[0].rows:
            table.add_row(str(row[0]), str(row[1]), str(row[3]), str(row[5]))
        run.show(table)
        run.written("damage.nc", "damage.csv", "summary.csv", "figures")
        run.finish(report)
