"""The command `gearlube contact`."""

from __future__ import annotations

import logging
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer
from rich.table import Table

from gearlube.cli.example import print_example
from gearlube.cli.exit_codes import console
from gearlube.cli.options import ExampleOption, JobsOption, OverwriteOption
from gearlube.cli.study_run import StudyRun, empty_table, study_run, tell_findings
from gearlube_core.progress import part_of
from gearlube_core.storage.file_names import pair_stem

if TYPE_CHECKING:  # the study is loaded when the command runs
    from gearlube.studies.contact.findings import ContactSummary
    from gearlube_core.hypoid_contact.placement import Misalignment
    from gearlube_core.hypoid_contact.sensitivity.analysis import SensitivitySettings
    from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile

logger = logging.getLogger("gearlube")


def contact(
    gear: Annotated[
        str,
        typer.Argument(help="Gear file (TOML) or the name of a shipped one.", metavar="GEAR"),
    ] = "mohammadpour_2015",
    torques: Annotated[
        list[float] | None,
        typer.Option(
            help="Pinion torques [N.m], one or more. Default 5 10 20 50 100 200 300 400.",
            metavar="TORQUE...",
        ),
    ] = None,
    positions: Annotated[
        int | None,
        typer.Option(
            help="Positions over a mesh period. Default 20. The mesh table keeps one mesh order "
            "for every four positions, five at least.",
            metavar="N",
        ),
    ] = None,
    offset_error_um: Annotated[
        float,
        typer.Option(
            help="Misalignment E: change of the pinion offset, micrometres.", metavar="UM"
        ),
    ] = 0.0,
    pinion_axial_um: Annotated[
        float,
        typer.Option(
            help="Misalignment P: pinion away from the crossing point, micrometres.", metavar="UM"
        ),
    ] = 0.0,
    gear_axial_um: Annotated[
        float,
        typer.Option(
            help="Misalignment G: gear away from the crossing point, micrometres.", metavar="UM"
        ),
    ] = 0.0,
    shaft_angle_mrad: Annotated[
        float, typer.Option(help="Misalignment of the shaft angle, milliradians.", metavar="MRAD")
    ] = 0.0,
    jobs: JobsOption = None,
    out: Annotated[Path, typer.Option(help="Folder for the results.")] = Path("gearlube_contact"),
    export: Annotated[
        bool,
        typer.Option(
            "--export",
            help="Also write flanks (CSV, STEP) and gears (STL, GLB); "
            "for these: pip install 'gearlube[export]'.",
        ),
    ] = False,
    quick: Annotated[
        bool, typer.Option("--quick", help="Few positions and torques, for a first look.")
    ] = False,
    films_rpm: Annotated[
        float | None,
        typer.Option(
            help="Also write flank_films.gif: pressure and oil film on the drive flank over a mesh "
            "period, at the largest torque and this speed of the pinion [rpm].",
            metavar="RPM",
        ),
    ] = None,
    oil: Annotated[
        str | None,
        typer.Option(
            help="Oil of --films-rpm: a shipped one or an oil file; default that of its axle.",
            metavar="OIL",
        ),
    ] = None,
    axle: Annotated[
        str | None,
        typer.Option(
            help="Axle of --films-rpm: an axle file, of which masses, bearings, laws and oil are "
            "taken; default mohammadpour_2015.",
            metavar="AXLE",
        ),
    ] = None,
    oil_temperature: Annotated[
        float | None,
        typer.Option(help="Oil temperature of the films [degC]; default 90.", metavar="DEGC"),
    ] = None,
    sensitivity: Annotated[
        bool,
        typer.Option(
            "--sensitivity",
            help="Derivatives instead: effect of a small error of each machine setting, cutter "
            "dimension and misalignment. At one of --torques, default 50; 8 positions.",
        ),
    ] = False,
    example: ExampleOption = False,
    overwrite: OverwriteOption = False,
) -> None:
    """Analyse the tooth contact of a hypoid pair; write its mesh table, data and report.

    With --sensitivity: sensitivity.nc, sensitivity.csv and figures/sensitivity.png. Finished
    positions are kept in OUT: run the same command again to go on after a stop.
    """
    if example:
        print_example("gearlube_core.hypoid_geometry.gear_file:HypoidGearFile", "mohammadpour_2015")
        return
    from gearlube.report.stored import PAGE
    from gearlube.studies.contact import run
    from gearlube.studies.contact.film_option import film_request, write_films
    from gearlube.studies.contact.findings import (
        contact_summary,
        edge_warnings,
        findings,
        gear_file_warnings,
    )
    from gearlube.studies.contact.run import write_gears
    from gearlube.studies.contact.settings import (
        QUICK,
        ContactSettings,
        CycleSettings,
        Misalignment,
    )
    from gearlube_core.extras import extra_package
    from gearlube_core.hypoid_contact.contact_table import levels_left_out
    from gearlube_core.hypoid_contact.kept_table import KeptTable
    from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile

    stopped = f"Stopped. Run the same command again to go on from {out / run.POSITIONS}."
    with study_run("contact", out, overwrite=overwrite, stopped=stopped) as frame:
        file = HypoidGearFile.given(gear)
        usual = QUICK if quick else ContactSettings()
        films = film_request(films_rpm, oil, oil_temperature, axle)
        if export:  # before the long work
            extra_package("trimesh", "export", "An STL or GLB file is written")
        cycle = replace(
            usual.cycle,
            positions=positions or usual.cycle.positions,
            torques=tuple(sorted(torques or usual.cycle.torques)),
            misalignment=Misalignment(
                pinion_offset=1e-6 * offset_error_um,
                pinion_axial=1e-6 * pinion_axial_um,
                gear_axial=1e-6 * gear_axial_um,
                shaft_angle=1e-3 * shaft_angle_mrad,
            ),
        )
        for sentence in gear_file_warnings(file):
            logger.warning("%s", sentence)
        if sensitivity:
            wanted = _sensitivity_settings(
                torques, positions, cycle.misalignment, export, films is not None
            )
            _sensitivity(file, wanted, frame, jobs)
            return
        share = 1.0 - 0.1 * export - 0.3 * (films is not None)  # of the time, before these
        with frame.results() as progress:
            results = run.run_contact(
                file,
                replace(usual, cycle=cycle),
                folder=out,
                jobs=jobs,
                progress=part_of(progress, 0.0, share),
            )
            if export:
                progress(share, "writing flanks and gears")
                write_gears(file, out / "gears")
            if films is not None:
                progress(0.7, "films in the running axle (compiled the first time)")
                animation = write_films(results, films, out)
            progress(1.0, "done")
        kept = None
        if gear.endswith(".toml") and replace(cycle, torques=CycleSettings().torques) == (
            CycleSettings()
        ):
            kept = KeptTable(Path(gear), cycle.torques if torques else None).keep(
                results.mesh_table
            )
        rows = contact_summary(results.contact)
        console.print(_table(file.name, rows))
        for sentence in [*levels_left_out(results.contact), *edge_warnings(results.contact)]:
            logger.warning("%s", sentence)
        table = f"{pair_stem(file.name)}.nc"
        if films is not None:
            logger.info("Animation: %s", animation)
        frame.written(table, "contact.nc", "figures", note=" (mesh table)")
        tell_findings(findings(results.contact), out / PAGE)
        if kept is not None:
            logger.info("Kept for axle files whose gear_file is %s: %s", gear, kept)


def _sensitivity_settings(
    torques: list[float] | None,
    positions: int | None,
    misalignment: Misalignment,
    export: bool,
    films: bool,
) -> SensitivitySettings:
    from gearlube_core.errors import ParameterError
    from gearlube_core.hypoid_contact.sensitivity.analysis import SensitivitySettings

    if torques and len(torques) > 1:
        raise ParameterError(
            f"--sensitivity must have one torque, got {len(torques)}. Give one torque; run the "
            "command again with another --out for the next one."
        )
    for option, given in (("--export", export), ("--films-rpm", films)):
        if given:
            raise ParameterError(
                f"{option} cannot be combined with --sensitivity. Run the command once with each."
            )
    usual = SensitivitySettings()
    return SensitivitySettings(
        torque=torques[0] if torques else usual.torque,
        positions=positions or usual.positions,
        misalignment=misalignment,
    )


def _sensitivity(
    file: HypoidGearFile, settings: SensitivitySettings, frame: StudyRun, jobs: int | None
) -> None:
    from gearlube.studies.contact.sensitivity import (
        run_sensitivity,
        sensitivity_rows,
        sensitivity_table,
    )

    with frame.results() as progress:
        dataset = run_sensitivity(file, settings, folder=frame.out, jobs=jobs, progress=progress)
    frame.show(sensitivity_table(file.name, settings.torque, sensitivity_rows(dataset)))
    frame.written("sensitivity.nc", "sensitivity.csv", "figures/sensitivity.png")


def _table(name: str, rows: list[ContactSummary]) -> Table:
    table = empty_table(
        f"{name}: loaded tooth contact, means over the mesh",
        ">flanks",
        ">torque [N·m]",
        ">secant k [N/µm]",
        ">tangent k [N/µm]",
        ">R_p [mm]",
        ">pairs",
        ">highest pressure [GPa]",
    )
    for row in rows:
        table.add_row(
            row.side,
            f"{row.torque:g}",
            f"{1e-6 * row.secant_stiffness:.0f}",
            f"{1e-6 * row.tangent_stiffness:.0f}",
            f"{1e3 * row.pinion_arm:.2f}",
            f"{row.pairs:.2f}",
            f"{1e-9 * row.highest_pressure:.2f}",
        )
    return table
