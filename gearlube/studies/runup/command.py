"""The command `gearlube runup`."""

from __future__ import annotations

import logging
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from gearlube.cli.example import print_example
from gearlube.cli.options import AxleArgument, ExampleOption, OilOfAxleOption, OverwriteOption
from gearlube.cli.study_run import study_run

if TYPE_CHECKING:
    from drivetrain.axle_file.axle_file import CarAxle
    from gearlube.studies.runup.settings import RunupSettings

logger = logging.getLogger("gearlube")

_FROM, _TO, _DURATION = 20.0, 120.0, 30.0  # km/h, km/h, s
_QUICK_DURATION, _QUICK_RESOLUTION = 10.0, 0.5


def runup(
    axle: AxleArgument = "mohammadpour_2015",
    start: Annotated[
        float | None,
        typer.Option("--from", help="Speed at the start [km/h]. Default: 20.", metavar="SPEED"),
    ] = None,
    end: Annotated[
        float | None,
        typer.Option(
            "--to",
            help="Speed at the end [km/h]; lower than at the start: a coast-down. Default: 120.",
            metavar="SPEED",
        ),
    ] = None,
    rpm: Annotated[
        bool,
        typer.Option("--rpm", help="--from, --to and --rate are of the pinion in rpm, not km/h."),
    ] = False,
    duration: Annotated[
        float | None,
        typer.Option(
            help="Duration of the ramp [s]. Default: 30; longer if the car needs more torque "
            "than the mesh table has.",
            metavar="S",
        ),
    ] = None,
    rate: Annotated[
        float | None,
        typer.Option(
            help="Speed change per second [km/h per s, with --rpm rpm "
            "per s], instead of --duration.",
            metavar="RATE",
        ),
    ] = None,
    torque: Annotated[
        float | None,
        typer.Option(
            help="Constant torque on the pinion [N.m], below 0 for coast. Default: what the car "
            "needs for road load and acceleration.",
            metavar="TORQUE",
        ),
    ] = None,
    engine_orders: Annotated[
        bool,
        typer.Option(
            "--engine-orders",
            help="Run the whole car: engine with its orders, driveline and tyres, in one gear.",
        ),
    ] = False,
    coast_down: Annotated[
        bool,
        typer.Option("--coast-down", help="Add a coast-down at the same rate after the run-up."),
    ] = False,
    coast_torque: Annotated[
        float | None,
        typer.Option(help="Torque on the pinion of that coast-down [N.m].", metavar="TORQUE"),
    ] = None,
    oil_temperature: Annotated[
        float, typer.Option(help="Oil temperature [degC].", metavar="DEGC")
    ] = 80.0,
    oil: OilOfAxleOption = None,
    preload: Annotated[
        float | None,
        typer.Option(help="Bearing preload [N]. Default: that of the axle.", metavar="FORCE"),
    ] = None,
    order_resolution: Annotated[
        float | None,
        typer.Option(help="Order resolution, in orders of the pinion. Default: 0.25."),
    ] = None,
    out: Annotated[Path, typer.Option(help="Folder for the results.")] = Path("gearlube_runup"),
    quick: Annotated[
        bool, typer.Option("--quick", help="A ramp of 10 s, for a first look.")
    ] = False,
    animate: Annotated[
        bool,
        typer.Option(
            "--animate",
            help="Also show flanks and rollers in motion over two mesh periods, in the report and "
            "as GIF; about a minute.",
        ),
    ] = False,
    animate_rpm: Annotated[
        float | None,
        typer.Option(
            "--animate-rpm",
            help="Do so at this speed of the pinion [rpm]. Default: where the bearing forces are "
            "largest.",
            metavar="RPM",
        ),
    ] = None,
    overwrite: OverwriteOption = False,
    example: ExampleOption = False,
) -> None:
    """Run the axle up or down in one continuous speed ramp: waterfalls, order tracks, Campbell.

    Writes runup.nc (coastdown.nc), summary.csv, figures and report.html; with --animate also the
    folder animation. After Ctrl-C the same
    command goes on where it stopped.
    """
    if example:
        print_example("drivetrain.axle_file.axle_file:AxleFile", "mohammadpour_2015")
        return
    from gearlube.cli.axle_gears import bring_gears_up_to_date
    from gearlube.cli.study_run import tell_findings
    from gearlube.studies.runup.animation.dataset import animate_ramp
    from gearlube.studies.runup.figures.moving.parts import save_moving
    from gearlube.studies.runup.findings import findings
    from gearlube.studies.runup.report import summary_csv, write_runup_report
    from gearlube.studies.runup.run import run_runup
    from gearlube.studies.runup.settings import BENCH, VEHICLE
    from gearlube_core.progress import part_of
    from gearlube_core.storage.atomic_file import write_text

    with study_run("runup", out, overwrite=overwrite) as run:
        _check_together(rpm, start, end, duration, rate, torque, coast_down, coast_torque)
        bring_gears_up_to_date(axle)
        car_axle = _car_axle(axle, oil, preload)
        ends = (_FROM if start is None else start, _TO if end is None else end)
        usual = _QUICK_DURATION if quick else _DURATION
        if duration is None and rate is None and torque is None:
            duration = _long_enough(car_axle, ends, rpm, usual)
        first = _settings(
            car_axle,
            ends,
            rpm=rpm,
            rate=rate,
            duration=duration or usual,
            torque=torque,
            driver=VEHICLE if engine_orders else BENCH,
            oil_temperature=oil_temperature,
            order_resolution=order_resolution or (_QUICK_RESOLUTION if quick else 0.25),
        )
        ramps = [first]
        if coast_down:
            ramps.append(
                replace(
                    first,
                    start_speed=first.end_speed,
                    end_speed=first.start_speed,
                    pinion_torque=coast_torque,
                )
            )
        animated_speed = _animated_speed(ramps, animate_rpm)
        logger.info("Preparing the axle. The first time it is compiled: a minute or more.")
        with run.results() as progress:
            count = len(ramps)
            datasets = [
                run_runup(one, folder=out, progress=part_of(progress, i / count, (i + 1) / count))
                for i, one in enumerate(ramps)
            ]
            animations = []
            for one, dataset in zip(ramps, datasets, strict=True):
                if animate or animate_rpm is not None:
                    moving = animate_ramp(
                        one, dataset, speed=animated_speed, folder=out, progress=progress
                    )
                    save_moving(moving, out, progress)
                    animations.append(moving)
            progress(1.0, "writing the report")
            write_text(summary_csv(datasets), out / "summary.csv")
            report = write_runup_report(datasets, out, animations)
        run.written()
        tell_findings([one for dataset in datasets for one in findings(dataset)], report)


def _animated_speed(ramps: list[RunupSettings], rpm: float | None) -> float | None:
    """Return the speed of the pinion to animate [rad/s]; None: the loudest of each ramp."""
    from gearlube.studies.runup.animation.dataset import check_speed
    from gearlube_core.units import rpm_to_rads

    if rpm is None:
        return None
    for one in ramps:
        check_speed(one, rpm_to_rads(rpm), "--animate-rpm")
    return rpm_to_rads(rpm)


def _check_together(
    rpm: bool,
    start: float | None,
    end: float | None,
    duration: float | None,
    rate: float | None,
    torque: float | None,
    coast_down: bool,
    coast_torque: float | None,
) -> None:
    """Raise ParameterError where options contradict each other."""
    from gearlube_core.checks import check_positive
    from gearlube_core.errors import ParameterError

    if rpm and (start is None or end is None):
        raise ParameterError(
            "--rpm needs --from and --to, for instance --from 600 --to 4000, got one of them or "
            "none."
        )
    if duration is not None and rate is not None:
        raise ParameterError(
            f"--duration and --rate must not both be given, got {duration:g} s and {rate:g}. Leave "
            "one of them out."
        )
    if rate is not None:
        check_positive("--rate", rate, "rpm/s" if rpm else "km/h per s")
    if coast_torque is not None and not coast_down:
        raise ParameterError("--coast-torque works only with --coast-down. Add that option.")
    if coast_down and (torque is None) != (coast_torque is None):
        raise ParameterError(
            "--coast-down needs --torque and --coast-torque, or neither of them, got one of them. "
            "Without both, the torques follow from the car."
        )


def _car_axle(axle: str, oil: str | None, preload: float | None) -> CarAxle:
    """Return the axle with another oil and preload where they are given."""
    from drivetrain.axle_file.read_axle import read_axle
    from fmu_src.axle_arguments import axle_parameters
    from gearlube_core.oil.oil_file import read_oil

    car = read_axle(axle)
    if preload is not None:
        car = replace(car, axle=axle_parameters({"bearing_preload": preload}, car.axle))
    if oil is not None:
        car = replace(car, axle=replace(car.axle, oil=read_oil(oil).lubricant))
        car.axle.check_oil_of_models()
    return car


def _pinion_speeds(car: CarAxle, ends: tuple[float, float], rpm: bool) -> tuple[float, float]:
    """Return the speeds of the pinion [rad/s] at the ends, given in rpm or km/h."""
    from gearlube_core.checks import check_within
    from gearlube_core.units import kmh_to_ms, rpm_to_rads

    unit, most = ("rpm", 20_000.0) if rpm else ("km/h", 400.0)
    road = car.driveline.road_load
    for name, speed in zip(("--from", "--to"), ends, strict=True):
        check_within(name, speed, 1.0, most, unit)
    first, last = (rpm_to_rads(v) if rpm else road.pinion_speed(kmh_to_ms(v)) for v in ends)
    return first, last


def _long_enough(car: CarAxle, ends: tuple[float, float], rpm: bool, usual: float) -> float:
    """Return the usual duration [s], or a longer one that the mesh table allows, and say so."""
    from drivetrain.speed_ramp import SpeedRamp
    from gearlube.studies.runup.settings import fitting_duration

    start, end = _pinion_speeds(car, ends, rpm)
    fitting = fitting_duration(car, SpeedRamp(start=start, end=end, duration=usual))
    if fitting <= usual:
        return usual
    logger.info(
        "The ramp takes %.1f s in place of %g s: a shorter one asks for more torque than the mesh "
        "table has, %g to %g N·m on the pinion. --duration sets another.",
        fitting,
        usual,
        *car.axle.torque_range,
    )
    return fitting


def _settings(
    car: CarAxle,
    ends: tuple[float, float],
    *,
    rpm: bool,
    rate: float | None,
    duration: float,
    torque: float | None,
    driver: str,
    oil_temperature: float,
    order_resolution: float,
) -> RunupSettings:
    """Return the settings of a ramp between speeds in rpm or km/h."""
    from gearlube.cli.oil_option import oil_kelvin
    from gearlube.studies.runup.settings import RunupSettings

    speeds = _pinion_speeds(car, ends, rpm)
    if rate is not None:
        duration = abs(ends[1] - ends[0]) / rate
    return RunupSettings(
        car_axle=car,
        start_speed=speeds[0],
        end_speed=speeds[1],
        duration=duration,
        pinion_torque=torque,
        driver=driver,
        oil_temperature=oil_kelvin(oil_temperature, car.axle.oil),
        order_resolution=order_resolution,
    )
