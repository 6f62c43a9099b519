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
    gear_set: Annotated[
        str,
        typer.Argument(
            help="Axle file, gear file of a helical or spur pair (TOML), or the name of a shipped "
            "one.",
            metavar="AXLE|PAIR",
        ),
    ] = "mohammadpour_2015",
    cycle: Annotated[
        str,
        typer.Option(
            "--cycle",
            help="nedc, wltc, ftp75, a cycle as for `gearlube cycle`, or a table of bins (CSV) "
            "with torque_n_m, speed_rpm, temperature_degc and hours. A pair takes a table.",
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
        float | None,
        typer.Option(
            help="K_H beta of the standard. Default: of a pair that of the solved contact, of an "
            "axle 1.65, light check and one member overhung."
        ),
    ] = None,
    application_factor: Annotated[
        float,
        typer.Option(help="Application factor K_A: overload that the torques of the bins lack."),
    ] = 1.0,
    wear_coefficient: Annotated[
        float | None,
        typer.Option(help="k of Archard's law, of your tests [1/Pa]; left out: no wear."),
    ] = None,
    wear_of_all_load: Annotated[
        bool,
        typer.Option(
            "--wear-of-all-load", help="Wear by all load, also on full films: an upper bound."
        ),
    ] = False,
    wear_steps: Annotated[
        int,
        typer.Option(
            help="Most steps of wear of 1 µm, after each of which the contact is solved again "
            "(about a minute). 0: the rate of the new flank alone.",
            min=0,
        ),
    ] = 0,
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
    load_stage: Annotated[
        float | None,
        typer.Option(help="Failure load stage of the oil in the FZG test A/8.3/90, for a pair."),
    ] = None,
    load_stage_torque_nm: Annotated[
        float | None,
        typer.Option(
            help="Pinion torque at that stage [N.m]. Default: 3.726 times the square of the stage, "
            "not checked against the source."
        ),
    ] = None,
    edition: Annotated[
        str | None,
        typer.Option(
            help="Edition of ISO 6336-2, -3, for a pair. Default: 2006.", metavar="2006|2019"
        ),
    ] = None,
    oil: Annotated[
        str | None,
        typer.Option(help="Of a pair: oil or oil file (TOML); left out: that of the gear file."),
    ] = None,
    roughness_um: Annotated[
        float | None,
        typer.Option(help="Composite rms roughness of the flanks of a pair [µm]. Default: 0.5."),
    ] = None,
    scuffing_temperature: Annotated[
        float | None, typer.Option(help="Scuffing temperature of the oil, mean of tests [degC].")
    ] = None,
    surface_hv: Annotated[
        float | None, typer.Option(help="Hardness of the flanks at the surface [HV].")
    ] = None,
    core_hv: Annotated[float | None, typer.Option(help="Hardness of the core [HV].")] = None,
    case_depth_mm: Annotated[
        float | None, typer.Option(help="Depth at 550 HV [mm]; with both, for flank fracture.")
    ] = None,
    torsion_limit_mpa: Annotated[
        float | None,
        typer.Option(help="Fatigue limit of reversed torsion, for under the surface [MPa]."),
    ] = None,
    bending_fatigue_mpa: Annotated[
        float | None, typer.Option(help="Fatigue limit of reversed bending of a smooth bar [MPa].")
    ] = None,
    micropitting_torque_nm: Annotated[
        float | None,
        typer.Option(help="Pinion torque at the failure stage of the oil's C-GF test [N.m]."),
    ] = None,
    micropitting_bulk: Annotated[
        float, typer.Option(help="Flanks in that test; 90 is its oil, the safe choice [degC].")
    ] = 90.0,
    start_temperature: Annotated[
        float, typer.Option(help="Oil at the start of each cycle, and air [degC].")
    ] = 23.0,
    regeneration: Annotated[
        float, typer.Option(help="Share of the braking through the axle, 0 to 1.")
    ] = 0.0,
    out: Annotated[Path, typer.Option(help="Folder for the results.")] = Path("gearlube_damage"),
    overwrite: OverwriteOption = False,
    example: Annotated[bool, prints_example(lambda: _EXAMPLE, "a table of bins")] = False,
) -> None:
    """Will it last? Damage of an axle over a duty cycle, or of a helical or spur pair.

    Lays the numbers of standards and the solved contact side by side. Writes damage.nc, damage.csv,
    summary.csv, report.html and figures.
    """
    from drivetrain.axle_file.read_axle import gear_file_of, read_axle
    from drivetrain.cycle.traces import DriveCycle
    from gearlube.cli.axle_gears import bring_gears_up_to_date
    from gearlube.damage.bins import cycle_bins, is_bins, joined, read_bins
    from gearlube.damage.pair import check_options, helical_teeth, is_pair, pair_settings
    from gearlube.damage.report import damage_report
    from gearlube.damage.run import run_damage
    from gearlube.damage.settings import (
        DamageSettings,
        check_needed,
        rated_bearing,
        rated_gears,
        rated_pair,
        together,
    )
    from gearlube.damage.summary import SUMMARY_HEAD
    from gearlube.damage.teeth import BEVEL_FACE
    from gearlube.report.inputs import file_inputs, noted_inputs
    from gearlube.report.parts import Input
    from gearlube.studies.drive_cycle.settings import DriveCycleSettings
    from gearlube_core.contact.dang_van import FatigueLimits
    from gearlube_core.errors import ParameterError
    from gearlube_core.helical_geometry.gear_file import HelicalGearFile
    from gearlube_core.oil.oil_file import read_oil
    from gearlube_core.rating.gears import LoadFactors
    from gearlube_core.rating.subsurface import CaseHardening
    from gearlube_core.units import celsius_to_kelvin

    hardness = {
        "--surface-hv": surface_hv, "--core-hv": core_hv, "--case-depth-mm": case_depth_mm,
    }  # fmt: skip
    fatigue = {
        "--torsion-limit-mpa": torsion_limit_mpa, "--bending-fatigue-mpa": bending_fatigue_mpa,
    }  # fmt: skip
    stopped = f"Stopped. {out} keeps what is finished: the same command goes on."
    with study_run("damage", out, overwrite=overwrite, stopped=stopped) as run:
        case = together(hardness, "720 and 342 HV with 0.5 mm are an example.")
        steel = together(fatigue, "260 and 398 MPa are those of quenched 42CrMo4.")
        limits = treatment, contact_limit_mpa, bending_limit_mpa
        car = blank = teeth = None
        pair = is_pair(gear_set)
        of_axle = {
            "--gears": gears or None, "--cleanliness": cleanliness,
            "--pinion-bearings-kn": pinion_bearings_kn, "--gear-bearings-kn": gear_bearings_kn,
            "--raceway-roughness-um": raceway_roughness_um, "--wear-steps": wear_steps or None,
        }  # fmt: skip
        of_pair = {
            "--oil": oil, "--roughness-um": roughness_um, "--load-stage": load_stage,
            "--load-stage-torque-nm": load_stage_torque_nm, "--edition": edition,
        }  # fmt: skip
        check_options(pair, of_axle, of_pair)
        rated = pinion_bearings_kn or gear_bearings_kn
        check_needed(
            ("--wear-of-all-load", wear_of_all_load, "--wear-coefficient", wear_coefficient),
            ("--load-stage-torque-nm", load_stage_torque_nm, "--load-stage", load_stage),
            ("--cleanliness", cleanliness, "--pinion-bearings-kn or --gear-bearings-kn", rated),
            ("--raceway-roughness-um", raceway_roughness_um, "ratings of bearings", rated),
        )
        if pair:
            file = HelicalGearFile.given(gear_set)
            material, inputs_of = rated_gears(*limits), file_inputs(file)
        else:
            material, blank = rated_pair(gear_set, gears, *limits)
            bring_gears_up_to_date(gear_set)
            car = read_axle(gear_set)
            inputs_of = noted_inputs(car.inputs)
        if is_bins(cycle):
            bins, duty = read_bins(cycle), Path(cycle).name
        elif car is None:
            raise ParameterError(
                f"--cycle of a pair must be a table of bins with hours, got {cycle!r}: a vehicle "
                "cycle needs an axle. `gearlube damage --example` prints a table."
            )
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
        if pair:
            contact = pair_settings(
                file, bins, oil=None if oil is None else read_oil(oil).lubricant,
                roughness_rms=1e-6 * (0.5 if roughness_um is None else roughness_um),
            )  # fmt: skip
            with run.results(bar="contact") as progress:
                teeth = helical_teeth(
                    contact, edition=edition or "2006", load_stage=load_stage,
                    test_torque=load_stage_torque_nm, store=out / "contact", progress=progress,
                )  # fmt: skip
        face = face_factor
        if face is None:
            face = BEVEL_FACE if teeth is None else teeth.face(bins)
        settings = DamageSettings(
            car=car,
            pair=teeth,
            bins=bins,
            gears=material,
            blank=blank,
            factors=LoadFactors(face=face, application=application_factor),
            wear_coefficient=wear_coefficient,
            wear_of_all_load=wear_of_all_load,
            wear_steps=wear_steps,
            gear_file=gear_file_of(gear_set, gears) if wear_steps else None,
            bearings=(None, None)
            if car is None
            else (
                rated_bearing(car.axle.bearing, pinion_bearings_kn),
                rated_bearing(car.axle.gear_bearing or car.axle.bearing, gear_bearings_kn),
            ),
            cleanliness=cleanliness,
            raceway_roughness=raceway_roughness_um and 1e-6 * raceway_roughness_um,
            scuffing_temperature=(
                None if scuffing_temperature is None else celsius_to_kelvin(scuffing_temperature)
            ),
            case=CaseHardening(case[0], case[1], 1e-3 * case[2]) if case else None,
            fatigue=(
                FatigueLimits(torsion=1e6 * steel[0], bending=1e6 * steel[1]) if steel else None
            ),
            test_torque=micropitting_torque_nm,
            test_bulk=celsius_to_kelvin(micropitting_bulk),
            duty=duty,
        )
        with run.results() as progress:
            dataset = run_damage(settings, folder=out, progress=progress)
        given = {
            "life": duty,
            "contact limit [MPa]": contact_limit_mpa,
            "bending limit [MPa]": bending_limit_mpa,
            "treatment": treatment if material else None,
            "K_H beta": round(face, 3),
            "K_A": application_factor,
            "k of wear [1/Pa]": wear_coefficient,
            "most steps of wear": wear_steps or None,
            "wear of all load": wear_of_all_load if wear_coefficient is not None else None,
            "C, C_0 of the pinion's bearings [kN]": pinion_bearings_kn,
            "C, C_0 of the gear's bearings [kN]": gear_bearings_kn,
            "cleanliness": cleanliness,
            "oil": settings.teeth.oil.name,
            "load stage": load_stage,
            "its torque [N·m]": load_stage_torque_nm,
            "roughness [µm]": roughness_um,
            **hardness,
            **fatigue,
            "torque of the C-GF test [N·m]": micropitting_torque_nm,
            "bulk in that test [°C]": micropitting_bulk if micropitting_torque_nm else None,
        }
        inputs = [Input(name, str(value)) for name, value in given.items() if value is not None]
        report = damage_report(dataset, out / "figures", [*inputs, *inputs_of])
        table = empty_table("Will it last?", *SUMMARY_HEAD[:2], ">safety", "verdict")
        for row in report.tables[0].rows:
            table.add_row(str(row[0]), str(row[1]), str(row[3]), str(row[5]))
        run.show(table)
        worn = ("worn.toml", "worn.nc") if wear_steps else ()
        run.written("damage.nc", "damage.csv", "summary.csv", "figures", *worn)
        run.finish(report)
