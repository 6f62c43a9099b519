"""The command `gearlube drivetrain`."""

from __future__ import annotations

import logging
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from gearlube.cli.convert import REXS_ENDINGS, train_text
from gearlube.cli.example import print_example
from gearlube.cli.options import ExampleOption, OverwriteOption
from gearlube.cli.study_run import empty_table, study_run

if TYPE_CHECKING:
    from gearlube_core.arrays import Array

_LOGGER = logging.getLogger("gearlube")
_TARGET = "drivetrain.train.train_file:TrainFile"


def drivetrain(
    file: Annotated[
        str,
        typer.Argument(
            help="Train file (.toml), or the name of a shipped one, such as e_axle or "
            "e_axle_elastic; or a gearbox as REXS file (.rexs, .rexsj, .rexsz).",
            metavar="TRAIN",
        ),
    ] = "e_axle",
    duration_ms: Annotated[
        float, typer.Option(help="Length of the run [ms].", metavar="MS")
    ] = 50.0,
    step_us: Annotated[
        float | None,
        typer.Option(
            help="Time between two rows of the results [us]. Default: 1/24 of the shortest mesh "
            "period.",
            metavar="US",
        ),
    ] = None,
    run_up: Annotated[
        str | None,
        typer.Option(
            help="Also run from one speed of the driven shaft to another [rpm], such as 600:6000, "
            "at the torque of the file.",
            metavar="FIRST:LAST",
        ),
    ] = None,
    ramp_s: Annotated[
        float | None,
        typer.Option(
            help="Duration of the run-up [s]. Default: long enough to separate its orders.",
            metavar="S",
        ),
    ] = None,
    loss_map: Annotated[
        bool,
        typer.Option("--map", help="Also map the losses of each element over speed and torque."),
    ] = False,
    map_speeds: Annotated[
        list[str] | None,
        typer.Option(
            help="Speeds of the map [rpm] of the driven shaft, first:last:step and single values.",
            metavar="RANGE...",
        ),
    ] = None,
    map_torques: Annotated[
        list[str] | None,
        typer.Option(
            help="Torques of the map [N.m]; below 0 the shaft brakes.", metavar="RANGE..."
        ),
    ] = None,
    cycle: Annotated[
        str | None,
        typer.Option(
            help="Also drive the vehicle of the file over a cycle: nedc, wltc, ftp75, or a file as "
            "of gearlube cycle. The map then has the cycle's speeds and torques.",
            metavar="NAME|FILE",
        ),
    ] = None,
    regeneration: Annotated[
        float | None,
        typer.Option(help="Share of the cycle's braking that the train does, 0 to 1; default: 1."),
    ] = None,
    out: Annotated[Path, typer.Option(help="Folder for the results.")] = Path(
        "gearlube_drivetrain"
    ),
    overwrite: OverwriteOption = False,
    example: ExampleOption = False,
) -> None:
    """Run a drivetrain of bodies and elements: modes, transmission errors, losses.

    Writes drivetrain.nc with all outputs over time, report.html and figures; of a REXS file
    also train.toml, the train file to go on with; with --run-up runup.nc with waterfall and orders,
    which `gearlube sound` makes audible; with --map loss_map.nc and loss_map.csv;
    with --cycle also cycle.nc and cycle.csv.
    """
    if example:
        print_example(_TARGET, file)
        return
    from gearlube_core.checks import check_within
    from gearlube_core.errors import ParameterError

    with study_run("drivetrain", out, overwrite=overwrite) as run:
        check_within("--duration-ms", duration_ms, 1e-3, 1e7, "ms")
        if step_us is not None:
            check_within("--step-us", step_us, 0.1, min(1e5, 1e3 * duration_ms), "us")
        ramp = _ramp(run_up, ramp_s)
        grid = _grid(map_speeds, map_torques)
        if regeneration is not None and not cycle:
            raise ParameterError(
                "--regeneration needs --cycle, got none. Add it or leave both out."
            )
        if cycle and grid:
            raise ParameterError("--cycle chooses the map, got --map-speeds or --map-torques too. "
                                 "Leave these out.")  # fmt: skip
        from_rexs = Path(file).suffix.lower() in REXS_ENDINGS
        # loaded after the options are checked, as this takes seconds
        from drivetrain.cycle.traces import DriveCycle
        from drivetrain.train.train_file import TrainFile
        from gearlube_core.rexs.gearbox import read_gearbox

        trace = DriveCycle.given(cycle) if cycle else None
        gearbox = read_gearbox(file) if from_rexs else None
        given = TrainFile.from_data(gearbox.data, file) if gearbox else TrainFile.given(file)
        case = given.case()
        from gearlube.report.inputs import file_inputs
        from gearlube.studies.drivetrain.clashes import clashes
        from gearlube.studies.drivetrain.cycle import cycle_losses, plan_cycle
        from gearlube.studies.drivetrain.figures import losses, save_figures
        from gearlube.studies.drivetrain.layout import layout
        from gearlube.studies.drivetrain.losses import map_losses
        from gearlube.studies.drivetrain.operation import Operation
        from gearlube.studies.drivetrain.ramp import plan_ramp, run_ramp
        from gearlube.studies.drivetrain.report import report
        from gearlube.studies.drivetrain.run import run_drivetrain
        from gearlube.studies.drivetrain.space_view import space_view
        from gearlube_core.progress import part_of
        from gearlube_core.storage.atomic_file import write_text

        placed = layout(case.train)
        for one in (crossed := clashes(placed)):
            _LOGGER.warning("%s", one)
        if ramp is not None:
            plan_ramp(case, *ramp, ramp_s)  # refuses what it cannot run before all else
        if loss_map or grid:
            Operation.of(case)  # likewise
        share = 1.0 if regeneration is None else regeneration
        plan = plan_cycle(case, trace, share) if trace else None
        if plan:
            loss_map, grid = True, {"speeds": plan.speeds, "torques": plan.torques}
        with run.results() as progress:
            dataset = run_drivetrain(
                case,
                duration=1e-3 * duration_ms,
                step=None if step_us is None else 1e-6 * step_us,
                folder=out,
                progress=progress if ramp is None else part_of(progress, 0.0, 0.3),
            )
            runup = None
            if ramp is not None:
                rest = part_of(progress, 0.3, 1.0)
                runup = run_ramp(case, *ramp, duration=ramp_s, folder=out, progress=rest)
            losses_of_all, driven = None, None
            if loss_map or grid:
                losses_of_all = map_losses(case, **grid, folder=out, progress=progress)
                driven = cycle_losses(plan, losses_of_all, out, progress) if plan else None
            studies = {"runup": runup, "loss_map": losses_of_all, "cycle": driven}
            figures = save_figures(dataset, case.train, out / "figures", **studies)
            if gearbox:
                write_text(train_text(gearbox), out / "train.toml")
        table = empty_table("Power lost, mean of the second half", "kind", ">W")
        for name, power in losses(dataset).items():
            table.add_row(name.replace("_", " "), f"{power:.4g}")
        run.show(table)
        run.written("drivetrain.nc", "figures", *(["train.toml"] if gearbox else []))
        notes = gearbox.notes if gearbox else ()
        views = [space_view(placed)] if placed.gears else []
        inputs = file_inputs(given)
        run.finish(report(dataset, figures, inputs, notes, views=views, clashes=crossed, **studies))


def _grid(speeds: list[str] | None, torques: list[str] | None) -> dict[str, Array]:
    """Return the grid of a map in SI units; what was not asked for is left out."""
    import numpy as np

    from gearlube.cli.ranges import numbers_from
    from gearlube_core.units import rpm_to_rads

    grid = {}
    if speeds:
        rpm = numbers_from("--map-speeds", speeds, "rpm", 0.01, 1e5, example="500:6000:500")
        grid["speeds"] = np.array([rpm_to_rads(one) for one in rpm])
    if torques:
        found = numbers_from("--map-torques", torques, "N.m", -1e7, 1e7, example="25:150:25")
        grid["torques"] = np.array(found)
    return grid


def _ramp(run_up: str | None, ramp_s: float | None) -> tuple[float, float] | None:
    """Return the speeds of a run-up [rad/s], or None."""
    from gearlube.cli.ranges import two_numbers
    from gearlube_core.checks import check_within
    from gearlube_core.errors import ParameterError
    from gearlube_core.units import rpm_to_rads

    if run_up is None:
        if ramp_s is not None:
            raise ParameterError(f"--ramp-s needs --run-up, got {ramp_s:g} s alone. Add it.")
        return None
    if ramp_s is not None:
        check_within("--ramp-s", ramp_s, 0.2, 3600.0, "s")
    first, last = two_numbers("--run-up", run_up, "600:6000", "speeds [rpm]")
    for speed in (first, last):
        check_within("--run-up", speed, 0.01, 1e5, "rpm")
    if first == last:
        raise ParameterError(
            f"--run-up must end at another speed than it starts, got {first:g} rpm twice. "
            "Give two speeds such as 600:6000."
        )
    return rpm_to_rads(first), rpm_to_rads(last)
