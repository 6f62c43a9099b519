"""March a piece of the ramp and keep whole states of the axle over mesh periods."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from drivetrain.speed_ramp import SpeedRamp
from gearlube.studies.runup.record import driver_of, march_step, march_until
from gearlube.studies.runup.settings import NODES, RunupSettings
from gearlube_core.arrays import Array
from gearlube_core.dynamics.hypoid_axle.model import HypoidAxle

PERIODS = 2  # of the mesh
PER_PERIOD = 24  # frames
_BEFORE = 0.2  # s of the ramp before the frames: the controller has taken up the ramp's pace
_PIECE = 1.0  # s, after the frames have begun; they take some milliseconds


@dataclass(frozen=True, slots=True, kw_only=True)
class Frames:
    """The axle at equal times over whole mesh periods.

    Parameters
    ----------
    axle : HypoidAxle
        At the last of them.
    time : ndarray of shape (N,)
        Since the first [s].
    ramp_time : float
        Of the first, since the ramp began [s].
    torque : float
        On the pinion, without the engine's orders [N.m].
    states : ndarray of shape (N, N_STATE)
    outputs : ndarray of shape (N, N_OUTPUTS)
        In the order of the axle's `output_names`.
    """

    axle: HypoidAxle
    time: Array
    ramp_time: float
    torque: float
    states: Array
    outputs: Array

    def output(self, name: str) -> Array:
        """Return an output of the axle by its name, (N,)."""
        return np.asarray(self.outputs[:, self.axle.output_names.index(name)])


def ramp_frames(settings: RunupSettings, time: float) -> Frames:
    """Return the axle over `PERIODS` mesh periods from `time` of the ramp [s] on.

    A piece of the ramp is marched as the ramp is: the speed at its beginning is held for the
    settling time, with the torque and the pace of the ramp from then on. The frames begin where a
    mesh period begins.

    Raises
    ------
    GearLubeError
        The axle refused.
    """
    torques = settings.torques()
    whole = settings.ramp
    begin = min(max(time - _BEFORE, 0.0), 0.99 * whole.duration)
    end = min(time + _PIECE, whole.duration)
    piece = SpeedRamp(start=whole.speed(begin), end=whole.speed(end), duration=end - begin)
    ends = np.linspace(0.0, whole.duration, torques[0].size)
    at = np.linspace(begin, end, NODES)
    sliced = np.interp(at, ends, torques[0]), np.interp(at, ends, torques[1])
    driver = driver_of(settings, piece, sliced)
    axle = HypoidAxle(settings.car_axle.axle)
    pinion_torque, wheel_torque = driver.initial_torques()
    axle.initialise(
        pinion_speed=driver.initial_pinion_speed,
        pinion_torque=pinion_torque,
        wheel_torque=wheel_torque,
        oil_temperature=settings.oil_temperature,
    )
    march_until(time - begin, axle, driver, settings)
    teeth = settings.car_axle.axle.mesh.pinion_teeth
    period = 2.0 * math.pi / (teeth * axle.output("pinion.speed"))
    turned = axle.output("pinion.angle") * teeth / (2.0 * math.pi)
    march_step((math.ceil(turned) - turned) * period or period, axle, driver, settings)
    ramp_time = begin + driver.time
    count, step = PERIODS * PER_PERIOD, period / PER_PERIOD
    parts = math.ceil(step * settings.sample_rate)
    states, outputs = [], []
    for _ in range(count):
        states.append(axle.state_view.copy())
        outputs.append(axle.outputs.copy())
        for _ in range(parts):
            march_step(step / parts, axle, driver, settings)
    return Frames(
        axle=axle,
        time=step * np.arange(count, dtype=np.float64),
        ramp_time=ramp_time,
        torque=float(np.interp(ramp_time, ends, torques[0])),
        states=np.stack(states),
        outputs=np.stack(outputs),
    )
