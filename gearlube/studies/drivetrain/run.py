"""Run a drivetrain in time and find its modes: from a train file to a dataset."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import xarray as xr

from drivetrain.train.train_file import TrainCase
from gearlube.report.result import Result
from gearlube.studies.drivetrain.operation import Operation
from gearlube.studies.drivetrain.orders import order_forces
from gearlube.studies.drivetrain.vibration import mean_train, responses
from gearlube_core.arrays import Array
from gearlube_core.checks import check_within
from gearlube_core.dynamics.train.element import N_COORDINATES
from gearlube_core.dynamics.train.elements.housing_motion import CarriedInterface
from gearlube_core.dynamics.train.elements.motor import Motor
from gearlube_core.dynamics.train.elements.shaft_motion import CarriedNodes
from gearlube_core.dynamics.train.model import Train
from gearlube_core.dynamics.train.part import GROUND
from gearlube_core.errors import ParameterError
from gearlube_core.progress import Progress, no_progress
from gearlube_core.storage.atomic_file import write_dataset
from gearlube_core.units import rads_to_rpm

FILE = "drivetrain.nc"
MOST_POINTS = 200_000
MOST_FREQUENCY = 1e4  # Hz, of responses
_PER_PERIOD, _USUAL_STEP = 24, 1e-4  # steps of a mesh period; without a mesh [s]
_SPEEDS, _N_SPEEDS = (0.05, 1.5), 400  # of orders, over the speed at the start
_RIGID = 1.0  # Hz, below which a mode is a turning of the whole train


def run_drivetrain(
    case: TrainCase,
    *,
    duration: float = 0.05,
    step: float | None = None,
    folder: Path | None = None,
    progress: Progress = no_progress,
) -> Result:
    """Return the motion of a drivetrain from its equilibrium, and its modes.

    Parameters
    ----------
    case : TrainCase
        The train with its speeds, torques and oil temperature, which stay as they are.
    duration, step : float
        Of the run, and of a communication step [s]; at most 200,000 steps of at most 0.1 s. By
        default a step is 1/24 of the shortest mesh period.
    folder : Path, optional
        Folder for FILE.
    progress : callable, optional
        Called with the share that is done [-] and a sentence on what runs.

    Returns
    -------
    xarray.Dataset
        The outputs over `time` [s], units in their attributes; `frequency` [Hz] over `mode` and
        `share` [-] of each body in the kinetic energy of a mode; `response` [N/m], the forces of
        meshes and bearings over the transmission error of each mesh. In the attributes `exceeded`
        has a sentence for each range that was left, `imbalance` the share of the energy that has
        passed through and is neither stored nor lost.

    Raises
    ------
    ParameterError
        A number is out of range.
    ConvergenceError
        No static equilibrium is found.
    StepError
        A step cannot be made.

    Examples
    --------
    >>> import gearlube as gl
    >>> rotors = [gl.train.Body.spinning("engine", 0.2), gl.train.Body.spinning("wheel", 2.0)]
    >>> shaft = gl.train.HalfShaft(name="shaft", first="engine", second="wheel", stiffness=1e4)
    >>> parts = [shaft, gl.train.Port(name="motor", body="engine")]
    >>> train = gl.Train(rotors, parts, gl.Lubricant.named("mohammadpour_2015"))
    >>> start = {"speeds": {"engine": 100.0}, "torques": {"motor": 5.0}, "oil_temperature": 340.0}
    >>> motion = run_drivetrain(TrainCase(name="rotors", train=train, **start), duration=0.01)
    >>> motion.sizes["time"], motion["shaft.torque"].units
    (101, 'N.m')
    """
    check_within("duration", duration, 1e-6, 1e4, "s")
    shortest, longest = max(1e-7, duration / MOST_POINTS), min(0.1, duration)
    if step is not None:
        check_within("step", step, shortest, longest, "s")
    progress(0.0, "finding the equilibrium")
    train = case.start()
    if step is None:
        meshes = [v for name, v in train.outputs().items() if name.endswith(".frequency")]
        highest = max(map(abs, meshes), default=0.0)
        step = min(longest, max(shortest, 1.0 / max(_PER_PERIOD * highest, 1.0 / _USUAL_STEP)))
    before = train.energy
    mean = mean_train(case)
    frequency, share = mode_shares(mean)
    motors = [one.name for one in train.elements if isinstance(one, Motor) and one.ripple]
    vibration = responses(mean, motors, min(trusted_frequency(train), MOST_FREQUENCY))
    driven = {}
    try:
        operation = Operation.of(case)
    except ParameterError:  # nothing drives it, or no port takes what it gives
        pass
    else:
        vibration |= order_forces(
            operation, mean, np.geomspace(*_SPEEDS, _N_SPEEDS) * operation.speed
        )
        driven = {"shaft": operation.title, "shaft_rpm": float(rads_to_rpm(operation.speed))}
    steps = math.ceil(duration / step - 1e-9)
    rows = np.empty((steps + 1, len(train.output_records)))
    rows[0] = list(train.outputs().values())
    exceeded: dict[str, str] = {}
    for k in range(1, steps + 1):
        train.step(step, case.torques, case.oil_temperature)
        rows[k] = list(train.outputs().values())
        exceeded = train.exceeded() | exceeded
        progress(k / steps, f"{1e3 * k * step:.4g} of {1e3 * steps * step:.4g} ms")
    time = xr.DataArray(np.arange(steps + 1) * step, dims="time", attrs={"units": "s"})
    dataset = xr.Dataset(
        {
            one.name: ("time", rows[:, i], {"units": one.unit, "long_name": one.text})
            for i, one in enumerate(train.output_records)
        }
        | {
            "frequency": ("mode", frequency, {"units": "Hz", "long_name": "natural frequency"}),
            "share": (
                ("mode", "body"),
                share,
                {"units": "1", "long_name": "share of the body in the kinetic energy"},
            ),
        }
        | vibration,
        coords={"time": time, "body": _names(train)},
        attrs={
            "name": case.name,
            "reference": next(iter(case.speeds)),
            "imbalance": _imbalance(train, before),
            "exceeded": "\n".join(exceeded.values()),
            **driven,
        },
    )
    dataset = Result.of(dataset, "drivetrain")
    if folder is not None:
        write_dataset(dataset, folder / FILE)
    return dataset


def mode_shares(train: Train) -> tuple[Array, Array]:
    """Return the frequencies of the modes that vibrate [Hz] and the bodies' shares in each.

    Modes above the highest frequency of an elastic body are left out: they are none of the body.
    Shares are those in the kinetic energy, shape (modes, bodies).
    """
    frequency, shapes = train.modes()
    vibrates = (frequency > _RIGID) & (frequency <= trusted_frequency(train))
    mobility = np.concatenate([body.mobility for body in train.bodies])
    # modal coordinates have the name of their body before a point
    owners = np.repeat([body.name.partition(".")[0] for body in train.bodies], N_COORDINATES)
    free = mobility > 0.0
    energy = shapes**2 / mobility[free][:, None]
    share = np.array([energy[owners[free] == name].sum(axis=0) for name in _names(train)])
    return frequency[vibrates], share.T[vibrates]


def trusted_frequency(train: Train) -> float:
    """Return the frequency up to which modes are those of all elastic bodies [Hz], or infinity."""
    elastic = CarriedNodes | CarriedInterface
    limits = [one.highest_frequency for one in train.elements if isinstance(one, elastic)]
    return min(filter(None, limits), default=math.inf)


def _names(train: Train) -> list[str]:
    """Return the names of all bodies as they are listed, without the ground."""
    owners = (body.name.partition(".")[0] for body in train.bodies)
    return [one for one in dict.fromkeys(owners) if one != GROUND]


def _imbalance(train: Train, before: float) -> float:
    """Return the missing share of the energy that has passed through.

    `before` is the energy of the train at the start [J].
    """
    outputs = train.outputs()
    works = [v for name, v in outputs.items() if name.startswith("energy.") and ".work" in name]
    missing = train.work - sum(train.lost.values()) - (train.energy - before)
    return abs(missing) / max(1e-9, sum(map(abs, works)), sum(train.lost.values()))
