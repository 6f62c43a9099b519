"""The command `gearlube helical`."""

from __future__ import annotations

import logging
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, cast

import typer
from rich.table import Table

from gearlube.cli.example import print_example
from gearlube.cli.exit_codes import FAILED, INTERRUPTED
from gearlube.cli.oil_option import oil_kelvin
from gearlube.cli.options import (
    ExampleOption,
    HelicalGearArgument,
    JobsOption,
    OilTemperatureOption,
    OverwriteOption,
    RoughnessOption,
    SpeedOfFileOption,
    TorqueOfFileOption,
)
from gearlube.cli.ranges import numbers_from
from gearlube.cli.study_run import empty_table, study_run, tell_findings
from gearlube_core.checks import check_within
from gearlube_core.errors import ParameterError
from gearlube_core.units import rpm_to_rads

if TYPE_CHECKING:  # the study is loaded when the command runs
    from gearlube.studies.helical.summary import Row

logger = logging.getLogger("gearlube")

# units of the table on the terminal; the summary file stays in SI
_SHOWN = {"m": (1e6, "µm"), "N/m": (1e-6, "N/µm"), "1": (1.0, "")}


def helical(
    gear: HelicalGearArgument = "he_2007",
    torque: TorqueOfFileOption = None,
    speed_rpm: SpeedOfFileOption = None,
    mu: Annotated[
        list[str] | None,
        typer.Option(
            help="Coefficients of friction: first:last:step and single values. Default 0:0.3:0.01.",
            metavar="RANGE...",
        ),
    ] = None,
    speeds_rpm: Annotated[
        list[str] | None,
        typer.Option(
            help="Pinion speeds of sweep and losses [rpm]. Default: of the sweep 60 past the mesh "
            "resonance, of the losses 0.2 to 2 times SPEED.",
            metavar="RANGE...",
        ),
    ] = None,
    friction: Annotated[
        str,
        typer.Option(
            help="Friction beside the constant coefficients. arana_2019: oil film, and asperities "
            "that carry a share of any load by the film ratio, as FZG gears were measured; film: "
            "with asperities of Greenwood and Tripp; constant: constant coefficients alone.",
            metavar="arana_2019|film|constant",
        ),
    ] = "arana_2019",
    boundary_friction: Annotated[
        float | None,
        typer.Option(help="Friction coefficient of asperities, of arana_2019. Default 0.07."),
    ] = None,
    share_exponent: Annotated[
        float | None,
        typer.Option(
            help="Exponent of the share that asperities carry, of arana_2019: below 1 they carry "
            "more. Default 1."
        ),
    ] = None,
    mesh: Annotated[
        str | None,
        typer.Option(
            help="Stiffness of the vibrating pair. contact: that of the loaded contact; density: "
            "one density along all contact lines, of ISO 6336-1 or as given. Default: contact, "
            "or density where --density is given.",
            metavar="contact|density",
        ),
    ] = None,
    density: Annotated[
        float | None,
        typer.Option(
            help="Stiffness per length of contact line [N/(um mm)]. Default: ISO 6336-1.",
            metavar="DENSITY",
        ),
    ] = None,
    torques: Annotated[
        list[float] | None,
        typer.Option(
            help="Pinion torques of the loaded contact [N.m], one or more. Default: 0.1 to 1.5 "
            "times TORQUE.",
            metavar="TORQUE...",
        ),
    ] = None,
    positions: Annotated[
        int, typer.Option(help="Mesh phases of the loaded contact.", metavar="N")
    ] = 24,
    oil: Annotated[
        str | None,
        typer.Option(
            help="Shipped oil or an oil file (TOML). Default: film.oil_file of the gear file, else "
            "mohammadpour_2015.",
            metavar="OIL",
        ),
    ] = None,
    film_model: Annotated[
        str | None,
        typer.Option(
            help="Film and friction of the oil. formula: Dowson and Toyoda, Evans and Johnson; "
            "solved: a model of solved films; a file (.json): such a model of your own. Default: "
            "film.model of the gear file.",
            metavar="formula|solved|MODEL",
        ),
    ] = None,
    oil_temperature: OilTemperatureOption = 80.0,
    oil_temperatures: Annotated[
        list[str] | None,
        typer.Option(
            help="Oil temperatures of the losses [degC]. Default: --oil-temperature.",
            metavar="RANGE...",
        ),
    ] = None,
    draws: Annotated[
        int,
        typer.Option(
            help="Samples of the uncertain data for the error bars of the losses; 0: none.",
            metavar="N",
        ),
    ] = 60,
    seed: Annotated[int, typer.Option(help="Random seed of the samples.")] = 1,
    roughness_um: RoughnessOption = 0.5,
    parts: Annotated[
        str,
        typer.Option(
            help="Part of the study to run.", metavar="all|contact|dynamics|geometry|losses"
        ),
    ] = "all",
    jobs: JobsOption = None,
    out: Annotated[Path, typer.Option(help="Folder for the results.")] = Path("gearlube_helical"),
    export: Annotated[
        bool,
        typer.Option("--export", help="Also write both flanks of a tooth of each gear (STEP)."),
    ] = False,
    quick: Annotated[
        bool, typer.Option("--quick", help="Few points and coarse teeth, for a first look.")
    ] = False,
    overwrite: OverwriteOption = False,
    example: ExampleOption = False,
) -> None:
    """Study a helical or spur pair; write NetCDF datasets, figures and report.

    Loaded contact, vibration under sliding friction, parametric instability, tooth separation,
    oil film, losses of the pair alone, geometry. Finished parts are kept in OUT/parts: run the same
    command again to go on after a stop.
    """
    if example:
        print_example("gearlube_core.helical_geometry.gear_file:HelicalGearFile", "he_2007")
        return
    from gearlube.report.stored import PAGE
    from gearlube.studies.helical import run
    from gearlube.studies.helical.findings import findings
    from gearlube.studies.helical.run import write_gears
    from gearlube.studies.helical.settings import LINE_DENSITY, HelicalSettings, quick_settings
    from gearlube.studies.helical.summary import remarks, summary_rows
    from gearlube_core.dynamics.helical_pair.gear_file_pair import gear_file_oil
    from gearlube_core.film_model.chosen_model import chosen_model
    from gearlube_core.film_model.model import LINE
    from gearlube_core.helical_geometry.gear_file import HelicalGearFile
    from gearlube_core.oil.oil_file import read_oil

    stopped = f"Stopped while results were written; {out} may be incomplete."
    with study_run("helical", out, overwrite=overwrite, stopped=stopped) as frame:
        file = HelicalGearFile.given(gear)
        given = file.operation
        torque = torque if torque is not None or given is None else given.pinion_torque_n_m
        speed_rpm = speed_rpm if speed_rpm is not None or given is None else given.pinion_speed_rpm
        if torque is None or speed_rpm is None:
            raise ParameterError(
                f"--torque and --speed-rpm must be given for {file.name}, whose file has no "
                f"[operation], got {torque} N.m and {speed_rpm} rpm. Add the section or give both."
            )
        check_within("--torque", torque, 1e-3, 1e6, "N.m", "Give its magnitude.")
        check_within("--speed-rpm", speed_rpm, 0.1, 1e6, "rpm", "Give its magnitude.")
        if density is not None:
            low, high = 1e-9 * LINE_DENSITY.low, 1e-9 * LINE_DENSITY.high
            check_within("--density", density, low, high, "N/(um mm)", "13 is usual for steel.")
        speeds = numbers_from(
            "--speeds-rpm", speeds_rpm or (), "rpm", 0.1, 1e6, example="100:3000:100"
        )
        lubricant = gear_file_oil(file) if oil is None else read_oil(oil).lubricant
        temperatures = numbers_from(
            "--oil-temperatures", oil_temperatures or (), "degC", -60.0, 250.0, example="40:100:20"
        )
        own_model = film_model is not None and film_model.endswith(".json")
        settings = HelicalSettings(
            file=file,
            pinion_torque=torque,
            pinion_speed=rpm_to_rads(speed_rpm),
            mu=numbers_from("--mu", mu or ("0:0.3:0.01",), "", 0.0, 1.0, example="0:0.3:0.01"),
            speeds=tuple(rpm_to_rads(speed) for speed in speeds),
            friction=friction,
            boundary_friction=boundary_friction,
            share_exponent=share_exponent,
            mesh=mesh or ("contact" if density is None else "density"),
            density=None if density is None else 1e9 * density,
            torques=tuple(sorted(set(torques or ()))),
            positions=positions,
            oil=lubricant,
            # checked by the settings
            film_model="solved" if own_model else cast(Any, film_model),
            line_film_model=(
                chosen_model(film_model or "", LINE, "--film-model") if own_model else None
            ),
            oil_temperature=oil_kelvin(oil_temperature, lubricant),
            oil_temperatures=tuple(
                oil_kelvin(one, lubricant, "--oil-temperatures") for one in temperatures
            ),
            draws=draws,
            seed=seed,
            roughness_rms=1e-6 * roughness_um,
            parts=parts,
        )
        with frame.results(bar="helical pair", by_parts=True) as progress:
            results = run.run_helical(
                quick_settings(settings) if quick else settings,
                folder=out,
                jobs=jobs,
                progress=progress,
            )
            if export and not results.interrupted:
                for path in write_gears(file, out / "gears"):
                    logger.info("Flanks: %s", path)
        frame.show(_table(file.name, summary_rows(results)))
        for sentence in remarks(results):
            logger.warning("%s", sentence)
        frame.written()
        if not results.interrupted:
            tell_findings(findings(results.datasets), out / PAGE)
    for name, reason in results.failures.items():
        logger.error("%s: %s", name, reason)
    if results.interrupted:
        logger.warning("Stopped. Run the same command again to continue from %s.", out / run.PARTS)
        raise typer.Exit(INTERRUPTED)
    if results.failures:
        raise typer.Exit(FAILED)


_SYMBOLS = (
    "delta_z: dynamic transmission error; u, F: displacement and bearing force of the pinion along "
    "x (line of action), y (across it) and z (axis); mu: a constant coefficient of friction"
)


def _table(name: str, rows: list[Row]) -> Table:
    from gearlube.report.numbers import number_text

    symbols = _SYMBOLS if any("delta_z" in row.quantity for row in rows) else None
    table = empty_table(f"{name}: helical pair", "", "quantity", ">value", "unit", caption=symbols)
    topic = ""
    for row in rows:
        factor, unit = _SHOWN.get(row.unit, (1.0, row.unit))
        value = number_text(factor * row.value, 4)
        table.add_row("" if row.topic == topic else row.topic, row.quantity, value, unit)
        topic = row.topic
    return table
