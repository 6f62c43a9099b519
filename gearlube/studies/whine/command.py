"""The command `gearlube whine`."""

from __future__ import annotations

import logging
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer
from rich.table import Table

from gearlube.cli.example import is_shipped, print_example
from gearlube.cli.options import ExampleOption, JobsOption, OverwriteOption
from gearlube.cli.ranges import numbers_from
from gearlube.cli.study_run import empty_table, study_run
from gearlube_core.checks import check_within

if TYPE_CHECKING:  # the study is loaded when the command runs
    from gearlube.studies.whine.run import WhineRow

logger = logging.getLogger("gearlube")
_SHOWN = 12
_HELICAL, _HYPOID = (
    f"gearlube_core.{kind}_geometry.gear_file:{kind.capitalize()}GearFile"
    for kind in ("helical", "hypoid")
)


def whine(
    gear: Annotated[
        str,
        typer.Argument(
            help="Gear file (TOML) of a hypoid or helical pair, or the name of a shipped one.",
            metavar="GEAR",
        ),
    ] = "mohammadpour_2015",
    torque: Annotated[float, typer.Option(help="Pinion torque [N.m].", metavar="TORQUE")] = 50.0,
    speeds_rpm: Annotated[
        list[str] | None,
        typer.Option(
            help="Pinion speeds [rpm]: first:last:step and single values. Default: 500:6000:100.",
            metavar="RANGE...",
        ),
    ] = None,
    by: Annotated[
        list[str] | None,
        typer.Option(
            help="Setting, relief or misalignment, as pinion.machine.tilt_angle_deg, or of a "
            "helical pair pinion.flank.crown_um; repeat for more. Default: all of them.",
            metavar="FIELD",
        ),
    ] = None,
    pinion_inertia: Annotated[
        float | None,
        typer.Option(
            help="Moment of inertia about its axis [kg m2]. Default: that of the shipped hypoid "
            "pair or of the helical gear file.",
            metavar="KGM2",
        ),
    ] = None,
    gear_inertia: Annotated[
        float | None,
        typer.Option(
            help="Moment of inertia about its axis [kg m2]. Default: that of the shipped hypoid "
            "pair or of the helical gear file.",
            metavar="KGM2",
        ),
    ] = None,
    damping_ratio: Annotated[
        float, typer.Option(help="Damping ratio of the mesh mode [-].", metavar="RATIO")
    ] = 0.03,
    positions: Annotated[int, typer.Option(help="Positions over a mesh period.", metavar="N")] = 16,
    jobs: JobsOption = None,
    out: Annotated[Path, typer.Option(help="Folder for the results.")] = Path("gearlube_whine"),
    overwrite: OverwriteOption = False,
    example: ExampleOption = False,
) -> None:
    """Whine orders of a pair over the speed, and their change by each setting or relief.

    From the flanks through the mesh table to the vibration of the torsional pair, with exact
    derivatives. Writes whine.nc, whine.csv, a figure and report.html. Finished positions are kept
    in OUT: run the same command again to go on after a stop.
    """
    if example:
        helical = is_shipped(_HELICAL, gear)
        print_example(_HELICAL if helical else _HYPOID, gear)
        return
    from gearlube.studies.whine.report import whine_report
    from gearlube.studies.whine.run import WhineSettings, run_whine, whine_rows
    from gearlube_core.flank_optimisation.problem import read_gear_file
    from gearlube_core.hypoid_contact.sensitivity.series_rates import SeriesSettings
    from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
    from gearlube_core.units import rpm_to_rads

    stopped = f"Stopped. Run the same command again to go on from {out}."
    with study_run("whine", out, overwrite=overwrite, stopped=stopped) as run:
        file = read_gear_file(gear)
        check_within("--positions", positions, 7, 400, "", "Three mesh orders need seven.")
        rpm = numbers_from(
            "--speeds-rpm",
            speeds_rpm or ("500:6000:100",),
            "rpm",
            10.0,
            47000.0,
            example="500:6000:100",
            most=500,
        )
        settings = WhineSettings(
            series=SeriesSettings(parameters=tuple(by or ()), torque=torque, positions=positions),
            speeds=tuple(float(rpm_to_rads(one)) for one in rpm),
            pinion_inertia=pinion_inertia,
            gear_inertia=gear_inertia,
            damping_ratio=damping_ratio,
        )
        hypoid = isinstance(file, HypoidGearFile)
        if hypoid and gear.endswith(".toml") and None in (pinion_inertia, gear_inertia):
            logger.warning(
                "The moments of inertia are those of the shipped pair, %g and %g kg m2. Give your "
                "own with --pinion-inertia and --gear-inertia.",
                *settings.inertias(file),
            )
        with run.results(positions) as progress:
            dataset = run_whine(file, settings, folder=out, jobs=jobs, progress=progress)
        rows = whine_rows(dataset)
        run.show(_table(file.name, torque, rows[:_SHOWN]))
        run.written("whine.nc", "whine.csv", "figures")
        run.finish(whine_report(dataset))


def _table(name: str, torque: float, rows: list[WhineRow]) -> Table:
    from gearlube.plotting.words import parameter_words, tolerance_words
    from gearlube_core.units import rads_to_rpm

    table = empty_table(
        f"{name}: what small errors change of mesh order 1 at {torque:g} N·m",
        "what grows by how much",
        ">mesh force,\nat most [N]",
        ">there\n[rpm]",
        ">transmission error,\nat most [µrad]",
    )
    for row in rows:
        table.add_row(
            f"{parameter_words(row.parameter)}, {tolerance_words(row.tolerance, row.unit)}",
            f"{row.force:.2f}",
            f"{rads_to_rpm(row.pinion_speed):.0f}",
            f"{1e6 * row.transmission_error:.2f}",
        )
    return table
