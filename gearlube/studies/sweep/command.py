"""The command `gearlube sweep`."""

from __future__ import annotations

import logging
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Annotated

import typer

from gearlube.cli.example import print_example
from gearlube.cli.exit_codes import exit_if_failed
from gearlube.cli.options import (
    AirTemperatureOption,
    ConductanceAt100Option,
    ConductanceAtRestOption,
    ExampleOption,
    JobsOption,
    OverwriteOption,
    given_cooling,
)
from gearlube.cli.study_run import study_run

logger = logging.getLogger("gearlube")

_DEFAULT_SPEEDS = ("20:100:5",)
_QUICK_SPEEDS = ("20:100:40",)
_DEFAULT_PRELOADS = (2500.0, 6000.0)


def sweep(
    axle: Annotated[
        str | None,
        typer.Argument(
            help="Axle file (TOML): your axle and car. Default: those of the paper.",
            metavar="AXLE",
        ),
    ] = None,
    speeds: Annotated[
        list[str] | None,
        typer.Option(
            help="Vehicle speeds [km/h]: first:last:step and single values. "
            "Default: 20 to 100 in steps of 5.",
            metavar="RANGE...",
        ),
    ] = None,
    preload: Annotated[
        list[float] | None,
        typer.Option(
            help="Bearing preloads [N], one or more. Default: that of the axle file, else 2500 "
            "6000.",
            metavar="FORCE...",
        ),
    ] = None,
    oil_temperature: Annotated[
        float | None,
        typer.Option(help="Oil temperature [degC]. Default: 95.", metavar="DEGC"),
    ] = None,
    steady_temperature: Annotated[
        bool,
        typer.Option(
            "--steady-temperature",
            help="Run each point at the oil temperature that balances loss and cooling.",
        ),
    ] = False,
    air_temperature: AirTemperatureOption = None,
    conductance_at_rest: ConductanceAtRestOption = None,
    conductance_at_100: ConductanceAt100Option = None,
    oil: Annotated[
        str | None,
        typer.Option(
            help="Shipped oil, such as karagiannis_2012, or an oil file (TOML). Default: that of "
            "the axle.",
            metavar="OIL",
        ),
    ] = None,
    roughness_um: Annotated[
        float | None,
        typer.Option(
            help="Composite rms roughness of the flanks [um]. Default: that of the axle.",
            metavar="UM",
        ),
    ] = None,
    equations: Annotated[
        str | None,
        typer.Option(help="consistent, or as_printed in the paper. Default: those of the axle."),
    ] = None,
    friction: Annotated[
        str | None,
        typer.Option(
            help="Law of the flank friction, as in an axle file, e.g. consistent, off or "
            "printed_traction_circular (the reading that gives the paper's efficiency). Default: "
            "that of the axle."
        ),
    ] = None,
    bearing_torque_loss: Annotated[
        str | None,
        typer.Option(
            help="Drag torque of the bearings, as in an axle file, e.g. palmgren, none or "
            "zhou_hoeprich_1991. Default: that of the axle."
        ),
    ] = None,
    driver: Annotated[
        str, typer.Option(help="vehicle: coupled driveline; hold: road load and speed hold.")
    ] = "vehicle",
    peak_step: Annotated[
        float,
        typer.Option(
            min=0.0,
            max=20.0,
            help="Add speeds around the largest mesh orders until they lie this far apart there "
            "[km/h]; 0: none. Not with --quick.",
            metavar="KMH",
        ),
    ] = 1.0,
    jobs: JobsOption = None,
    scheduler: Annotated[
        str | None,
        typer.Option(help="Address of a running Dask scheduler instead of local processes."),
    ] = None,
    out: Annotated[Path, typer.Option(help="Folder for the results.")] = Path("gearlube_sweep"),
    quick: Annotated[
        bool, typer.Option("--quick", help="Few speeds and short records, for a first look.")
    ] = False,
    fmu: Annotated[
        Path | None, typer.Option(help="Axle FMU to run. Default: that of this installation.")
    ] = None,
    mesh_table: Annotated[
        Path | None,
        typer.Option(help="Mesh table (.nc) of another gear pair, built into the axle FMU."),
    ] = None,
    overwrite: OverwriteOption = False,
    example: ExampleOption = False,
) -> None:
    """Sweep vehicle speed and bearing preload; write sweep.nc, summary.csv and report.html.

    Finished points are kept in OUT/points: run the same command again to go on after a stop.
    """
    if example:
        print_example("drivetrain.axle_file.axle_file:AxleFile", "mohammadpour_2015")
        return
    from gearlube.cli.axle_gears import bring_gears_up_to_date
    from gearlube.cli.oil_option import oil_kelvin
    from gearlube.cli.ranges import numbers_from
    from gearlube.cli.study_run import tell_findings
    from gearlube.studies.sweep import run
    from gearlube.studies.sweep.axle_in_fmu import (
        axle_with_oil,
        chosen_axle,
        given_preload,
        settings_of,
    )
    from gearlube.studies.sweep.figures.catalogue import CATALOGUE, ESSENTIAL
    from gearlube.studies.sweep.findings import findings
    from gearlube.studies.sweep.report import write_sweep_report
    from gearlube.studies.sweep.settings import (
        OILS,
        PRELOAD_RANGE,
        SPEED_RANGE,
        STEADY,
        quick_sweep_settings,
    )
    from gearlube_core.checks import check_address, check_option, check_within
    from gearlube_core.errors import ParameterError
    from gearlube_core.oil.lubricant import Lubricant
    from gearlube_core.units import kelvin_to_celsius

    with (
        study_run("sweep", out, overwrite=overwrite) as frame,
        TemporaryDirectory(prefix="gearlube-") as folder,
    ):
        own_axle = axle is not None
        if fmu is None and mesh_table is None:
            bring_gears_up_to_date(axle, jobs=jobs)
        if oil is not None and oil.endswith(".toml"):
            if fmu is not None:
                raise ParameterError(
                    "--oil cannot be a file if --fmu is given, because the FMU has its own oil; "
                    f"got {oil}. Build the FMU with it by `gearlube build-fmu`, or leave out --fmu."
                )
            axle = str(axle_with_oil(axle, mesh_table, oil, Path(folder)))
            mesh_table, oil = None, None
        if oil is not None:
            check_option("--oil", oil, OILS)
        cooling = given_cooling(
            steady_temperature, air_temperature, conductance_at_rest, conductance_at_100
        )
        if cooling is not None and oil_temperature is not None:
            raise ParameterError(
                "--oil-temperature cannot be combined with --steady-temperature, which computes "
                f"it, got {oil_temperature:g} degC. Leave one of them out."
            )
        car_axle = chosen_axle(fmu, mesh_table, axle)
        if scheduler is not None:
            check_address(scheduler)
        changes: dict[str, str | float | None] = {
            "oil": oil,
            "roughness_rms": None if roughness_um is None else roughness_um * 1e-6,
            "equations": equations,
            "friction": friction,
            "bearing_torque_loss": bearing_torque_loss,
        }
        of_axle = car_axle.axle.oil if oil is None else Lubricant.named(oil)
        if cooling is None:
            degc = 95.0 if oil_temperature is None else oil_temperature
            changes["oil_temperature"] = oil_kelvin(degc, of_axle)
        else:
            air, heat = cooling
            changes |= {
                "oil_state": STEADY,
                "air_temperature": oil_kelvin(kelvin_to_celsius(air), of_axle, "--air-temperature"),
                "conductance_at_rest": heat.conductance_at_rest,
                "conductance_at_100_kmh": heat.conductance_at_100_kmh,
            }
        settings = settings_of(
            car_axle.axle,
            driver=driver,
            **{name: value for name, value in changes.items() if value is not None},
        )
        ranges = speeds or (_QUICK_SPEEDS if quick else _DEFAULT_SPEEDS)
        speeds_kmh = numbers_from(
            "--speeds", ranges, "km/h", *SPEED_RANGE, example="20:100:5", most=500
        )
        preloads = [check_within("--preload", p, *PRELOAD_RANGE, "N") for p in preload or ()]
        of_file = given_preload(car_axle) if own_axle else ()
        logger.info(
            "Preparing the axle. For new gears or a new axle file its FMU is built first, half a "
            "minute; the very first time kernels are compiled, one to two minutes more."
        )
        with frame.results() as progress:
            dataset = run.run_sweep(
                quick_sweep_settings(settings) if quick else settings,
                speeds_kmh=speeds_kmh,
                preloads=preloads or of_file or _DEFAULT_PRELOADS,
                fmu=fmu,
                mesh_table=mesh_table,
                axle=axle,
                out=out,
                jobs=jobs,
                scheduler=scheduler,
                peak_step_kmh=0.0 if quick else peak_step,
                progress=progress,
            )
            progress(1.0, "writing the report")
            report = write_sweep_report(dataset, out, ESSENTIAL if quick else CATALOGUE)
        computed = dataset.attrs["computed_points"]
        logger.info("%d points computed in %.1f s.", computed, dataset.attrs["wall_time"])
        logger.info("Results: %s, %s", out / "sweep.nc", out / "summary.csv")
        tell_findings(findings(dataset), report)
        failures = int((dataset["status"] == 0).sum())
        exit_if_failed(f"{failures} points failed; the report says why." if failures else "")
