"""Run-up of a train in time: a record at a constant rate, its orders and its waterfall."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import xarray as xr

from drivetrain.speed_ramp import RampHold, SpeedRamp
from drivetrain.train.train_file import TrainCase
from gearlube.plotting.style import house_style, largest_in_cells, name_levels, new_figure, outlined
from gearlube.report.parts import NOTE, Finding
from gearlube.report.result import Result
from gearlube.studies.drivetrain.operation import Operation, lost_power
from gearlube.studies.drivetrain.orders import Order, Parts, order_forces, orders_of, parts_of
from gearlube.studies.drivetrain.vibration import mean_train
from gearlube_core.arrays import Array
from gearlube_core.checks import check_within
from gearlube_core.dynamics.train.elements.housing_motion import CarriedInterface
from gearlube_core.dynamics.train.elements.motor import Motor
from gearlube_core.dynamics.train.model import Train
from gearlube_core.dynamics.train.outputs import outputs_at
from gearlube_core.errors import ParameterError
from gearlube_core.progress import Progress, no_progress
from gearlube_core.spectra import order_blocks, samples_for, waterfall
from gearlube_core.storage.atomic_file import write_compressed_dataset
from gearlube_core.units import rads_to_rpm

FILE = "runup.nc"
_NODES = 5  # speeds at which losses are found
_GAIN = 5.0  # 1/s, of what holds the ramp: far below all modes
_CHANGE = 0.25  # of the speed within a block
_SHORTEST, _LONGEST = 5.0, 60.0  # s, of a ramp that nobody asked for
_SAMPLES = 5.0  # of a period of the highest order, which splines then keep to 4e-3
_LEAST_RATE, _MOST_RATE = 4000.0, 65536.0  # Hz; a WAV needs half of the first
_MOST_SAMPLES = 4_000_000
_LEAD, _MOST_LEAD = 30, 5.0  # mesh periods and s at the first speed, before the record
_SLICES = 60  # of a waterfall, at least
_RANGE = 70.0  # dB of the colours
_LOWEST = 3.5  # bins above 0 Hz, where the change of the mean leaks
_SPEED = 1e-9  # m/s, of the level of velocities


def run_ramp(
    case: TrainCase,
    start: float,
    end: float,
    *,
    duration: float | None = None,
    folder: Path | None = None,
    progress: Progress = no_progress,
) -> Result:
    """Return the motion of a train whose drive keeps its torque, while its loads hold a ramp.

    Parameters
    ----------
    case : TrainCase
    start, end : float
        Speeds of the shaft that is driven [rad/s]; the end may be lower.
    duration : float, optional
        Of the ramp [s]; by default long enough to separate the orders, 5 to 60 s.
    folder : Path, optional
        Folder for FILE, which `gearlube sound` takes.
    progress : callable, optional

    Returns
    -------
    xarray.Dataset
        Over `time` [s]: `bearing_force` [N], `mesh_force` [N], `motor_torque` [N.m], and angle and
        speed of the shaft. Amplitudes `order_track` [N] of each force by each order over
        `block_speed`, and beside them `order_force` by frequency. Over slices of speed the spectra
        of all bearing forces, `force_waterfall` [N], and of a housing's nodes,
        `velocity_waterfall` [m/s].

    Raises
    ------
    ParameterError
        A number is out of range, nothing drives the train, or it has no bearing.
    ConvergenceError, StepError
        There is no equilibrium at a speed, or a step cannot be made.

    Examples
    --------
    >>> from drivetrain.train.train_file import TrainFile
    >>> axle = TrainFile.named("hypoid_axle").case()
    >>> run = run_ramp(axle, 200.0, 240.0, duration=0.5)
    >>> run["part"].values.tolist()
    ['mesh', 'pinion_bearings', 'gear_bearings']
    """
    plan = plan_ramp(case, start, end, duration)
    operation, parts, orders, rate = plan.operation, plan.parts, plan.orders, plan.rate
    ramp = SpeedRamp(start=start, end=end, duration=plan.duration)
    nodes = _nodes_of(case.train)
    motors = [one.name for one in case.train.elements if isinstance(one, Motor)]
    channels = [
        f"{operation.shaft}.angle",
        f"{operation.shaft}.speed",
        *parts.outputs,
        *(f"{name}.displacement.{c}" for name in nodes for c in "xyz"),
        *(f"{name}.torque_about_z" for name in motors),
    ]
    values = _march(operation, ramp, rate, channels, orders, progress)
    progress(1.0, "orders and spectra")
    dataset = _dataset(operation, values, rate, parts, orders, plan.revolutions, nodes, motors)
    speeds = np.geomspace(min(start, end), max(start, end), 400)
    case.start()
    dataset = dataset.merge(order_forces(operation, mean_train(case), speeds), join="exact")
    dataset.attrs |= {"duration": plan.duration, "revolutions": plan.revolutions}
    dataset = Result.of(dataset, "train run-up")
    if folder is not None:
        write_compressed_dataset(dataset, folder / FILE)
    return dataset


class Plan(NamedTuple):
    """Records of a run-up and their duration."""

    operation: Operation
    parts: Parts
    orders: list[Order]
    revolutions: int  # of a block
    duration: float  # [s]
    rate: float  # [Hz]


def plan_ramp(case: TrainCase, start: float, end: float, duration: float | None = None) -> Plan:
    """Return the plan of a run-up; arguments and errors are those of `run_ramp`."""
    operation = Operation.of(case)
    for name, speed in (("start", start), ("end", end)):
        least, most, rpm = (float(rads_to_rpm(w)) for w in (1e-3 * operation.speed, 1e4, speed))
        check_within(f"{name} of the run-up", rpm, least, most, "rpm")
    if start == end:
        raise ParameterError(
            f"A run-up must end at another speed, got {rads_to_rpm(start):g} rpm twice."
        )
    parts, orders = parts_of(case.train), orders_of(operation)
    if not parts.bearings or not orders:
        raise ParameterError("A run-up needs meshes and bearings whose forces are outputs.")
    slow, fast = sorted((start, end))
    revolutions = _revolutions(orders)
    if duration is None:
        usual = (fast - slow) * 2.0 * math.pi * revolutions / (_CHANGE * slow**2)
        duration = min(max(usual, _SHORTEST), _LONGEST)
    check_within("duration of the run-up", duration, 0.2, 3600.0, "s")
    highest = max(one.order for one in orders) * fast / (2.0 * math.pi)
    rate = min(max(_SAMPLES * highest, _LEAST_RATE), _MOST_RATE)
    check_within(
        "samples of the run-up", duration * rate, 1.0, _MOST_SAMPLES, "", "Take a shorter ramp."
    )
    turned = 0.5 * (start + end) * duration / (2.0 * math.pi)
    cure = f"Take {duration * 4.0 * revolutions / turned:.3g} s or more."
    check_within("turns of the shaft in the run-up", turned, 4.0 * revolutions, 1e9, "", cure)
    return Plan(operation, parts, orders, revolutions, duration, rate)


def _revolutions(orders: Sequence[Order]) -> int:
    """Return the turns of a block in which no order hides another one."""
    rising = np.unique([round(one.order, 6) for one in orders])
    least = float(np.diff(rising).min()) if rising.size > 1 else 1.0
    return int(min(max(math.ceil(4.0 / least), 2), 16))


def _nodes_of(train: Train) -> list[str]:
    """Return the nodes of all housings."""
    bodies = {
        one.nodes.partition(".")[0] for one in train.elements if isinstance(one, CarriedInterface)
    }
    end = ".displacement.x"
    found = [one.name for one in train.output_records if one.name.endswith(end)]
    names = [one.removesuffix(end) for one in found]
    return [one for one in names if "." in one and one.partition(".")[0] in bodies]


def _march(
    operation: Operation,
    ramp: SpeedRamp,
    rate: float,
    channels: Sequence[str],
    orders: Sequence[Order],
    progress: Progress,
) -> Array:
    """Return the channels at a constant rate, shape (samples, channels)."""
    case, torque = operation.case, operation.torque
    losses, energies = [], []
    for speed in np.linspace(ramp.start, ramp.end, _NODES):
        train = operation.at(float(speed), torque).train
        losses.append(lost_power(train) / float(speed))
        energies.append(train.energy)
    # what is stored but in motion does not depend on the speed
    inertia = 2.0 * (energies[-1] - energies[0]) / (ramp.end**2 - ramp.start**2)
    slowest = min(one.order for one in orders) * ramp.start / (2.0 * math.pi)
    lead = min(max(1.0, _LEAD / slowest), _MOST_LEAD)
    hold = RampHold(
        ramp,
        ratio=1.0,
        pinion_torque=np.full(_NODES, torque / inertia),
        loss_torque=np.array(losses) / inertia,
        axle_inertia=1.0,  # torques are those over the inertia
        lead=lead,
        proportional_gain=_GAIN,
        start_factor=1.0,
    )
    train = operation.at(ramp.start, torque).train
    names = [one.name for one in train.output_records]
    columns = outputs_at(train.assembly.sizes) + np.array([names.index(one) for one in channels])
    h, steps, first = 1.0 / rate, round(ramp.duration * rate), round(lead * rate)
    values = np.empty((steps, len(channels)))
    for k in range(first + steps):
        row = train.written()[1][columns]
        if k >= first:
            values[k - first] = row
        angle, speed = operation.turns * row[:2]
        drive, load = hold.step(h, float(angle), float(speed), 0.0, 0.0)
        train.step(h, operation.torques(inertia * drive, inertia * load), case.oil_temperature)
        if k % 500 == 0:
            rpm = float(rads_to_rpm(speed))
            progress(0.95 * k / (first + steps), f"run-up of {operation.title}, {rpm:.4g} rpm")
    values[:, :2] *= operation.turns
    return values


def _dataset(
    operation: Operation,
    values: Array,
    rate: float,
    parts: Parts,
    orders: Sequence[Order],
    revolutions: int,
    nodes: Sequence[str],
    motors: Sequence[str],
) -> xr.Dataset:
    time, (angle, speed) = np.arange(len(values)) / rate, values[:, :2].T
    n, m = len(parts.outputs), len(parts.meshes)
    forces, moved = values[:, 2 : 2 + n], values[:, 2 + n : 2 + n + 3 * len(nodes)]
    blocks = order_blocks(
        time,
        angle,
        forces,
        revolutions=revolutions,
        samples_per_revolution=samples_for(0.4 * rate, float(speed.min())),
        highest_order=1.0,
        orders=np.array([one.order for one in orders]),
    )
    of_bearings = forces[:, m:].reshape(len(time), len(parts.bearings), 3)
    variables: dict[str, Any] = {
        "pinion_speed": ("time", speed, _about("rad/s", f"speed of {operation.title}")),
        "pinion_angle": ("time", angle, _about("rad", f"angle of {operation.title}")),
        "mesh_force": (("time", "mesh"), forces[:, :m], _about("N", "normal load")),
        "bearing_force": (
            ("time", "bearing", "direction"),
            of_bearings,
            _about("N", "force of bearings and supports"),
        ),
        "motor_torque": (
            ("time", "motor"),
            values[:, values.shape[1] - len(motors) :],
            _about("N.m", "torque on the rotor about z"),
        ),
        "block_speed": ("block", blocks.speed, _about("rad/s", "mean speed of a block")),
        "order_track": (
            ("block", "line", "part"),
            parts.sizes(blocks.amplitude),
            _about("N", "amplitude of a force by one order"),
        ),
    }
    resolution = rate / round(rate * max(0.05, time[-1] / _SLICES))
    for name, unit, signals in (
        ("force_waterfall", "N", forces[:, m:]),
        ("velocity_waterfall", "m/s", np.gradient(moved, 1.0 / rate, axis=0)),
    ):
        if not signals.shape[1]:
            continue
        found = [
            waterfall(one, rate, resolution=resolution, highest_frequency=0.4 * rate)
            for one in signals.T
        ]
        total = np.sqrt(sum(one.amplitude**2 for one in found))
        if unit == "m/s":  # mean of the nodes
            total = total / math.sqrt(len(nodes))
        at = np.interp(found[0].time, time, speed)
        variables |= {
            "slice_speed": ("slice", at, _about("rad/s", "speed at the middle of a slice")),
            "spectrum": ("spectrum", found[0].frequency, _about("Hz", "frequency")),
            name: (
                ("slice", "spectrum"),
                total,
                _about(unit, f"amplitude over {resolution:.3g} Hz"),
            ),
        }
    return xr.Dataset(
        variables,
        coords={
            "time": ("time", time, _about("s", "time")),
            "mesh": list(parts.meshes),
            "bearing": parts.bearings,
            "direction": list("xyz"),
            "motor": [*motors],
            "line": [one.name for one in orders],
            "part": parts.names,
        },
        attrs={"name": operation.case.name, "shaft": operation.title, "nodes": ", ".join(nodes)},
    )


def _about(units: str, long_name: str) -> dict[str, str]:
    return {"units": units, "long_name": long_name}


def loudest(runup: xr.Dataset | None) -> list[Finding]:
    """Return where an order of a run-up makes the largest force of a bearing."""
    if runup is None:
        return []
    forces = runup["order_track"].sel(part=runup["bearing"].values)
    place = {str(name): int(one) for name, one in forces.argmax(...).items()}
    at, rpm = forces[place], float(rads_to_rpm(runup["block_speed"].values[place["block"]]))
    return [
        Finding(
            NOTE,
            f"In the run-up {at['line'].item()} makes the largest force: {float(at):.4g} N on "
            f"{at['part'].item()} at {rpm:.0f} rpm.",
            "Run `gearlube sound` on this folder to hear it.",
        )
    ]


def waterfall_figure(dataset: xr.Dataset) -> Any:
    """Draw the level of a housing's velocity, else of bearing forces, over speed and frequency."""
    of_housing = "velocity_waterfall" in dataset
    name, reference = ("velocity_waterfall", _SPEED) if of_housing else ("force_waterfall", 1.0)
    rising = np.argsort(dataset["slice_speed"].values)
    speed = dataset["slice_speed"].values[rising] * rads_to_rpm(1.0)
    frequency = dataset["spectrum"].values
    seen = (frequency > _LOWEST * frequency[1]) & (frequency <= _top(dataset))
    rows, cells = largest_in_cells(frequency[seen], dataset[name].values[rising][:, seen])
    level = 20.0 * np.log10(np.maximum(cells, 1e-30) / reference)
    with house_style():
        figure = new_figure(9.4, 5.6)
        ax = figure.subplots()
        peak = 5.0 * math.ceil(float(level.max()) / 5.0)
        drawn = ax.pcolormesh(
            speed, rows, level.T, cmap="viridis", vmin=peak - _RANGE, vmax=peak,
            shading="nearest", rasterized=True,
        )  # fmt: skip
        words = "velocity of the housing [dB re 1 nm/s]" if of_housing else "forces [dB re 1 N]"
        figure.colorbar(drawn, ax=ax, extend="min", label=words, location="bottom", aspect=50)
        ax.grid(visible=False)
        ax.set_facecolor(drawn.cmap(0.0))
        for order in dataset["order"].values:
            (drawn_line,) = ax.plot(speed, order * speed / 60.0, color="white", lw=0.5, ls=":")
            outlined(drawn_line, width=1.0)
        ax.set(
            xlabel=f"speed of {dataset.attrs['shaft']} [rpm]",
            ylabel="frequency [Hz]",
            xlim=(speed[0], speed[-1]),
            ylim=(0.0, _top(dataset)),
        )
        tops = dataset["order"].values * speed[-1] / 60.0
        name_levels(ax, dict(zip(dataset["line"].values.tolist(), tops, strict=True)))
    return figure


def _top(dataset: xr.Dataset) -> float:
    """Return the end of the frequency axis [Hz]."""
    fastest = float(dataset["slice_speed"].max()) / (2.0 * math.pi)
    return min(1.1 * float(dataset["order"].max()) * fastest, float(dataset["spectrum"].max()))
