"""The axle model as a sweep steps it, without an FMU around it."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.dynamics.hypoid_axle.model import HypoidAxle
from gearlube_core.dynamics.hypoid_axle.output_names import (
    OUTPUT_NAMES,
)
from gearlube_core.dynamics.hypoid_axle.parameters import HypoidAxleParameters


class PythonAxle:
    """An axle that starts at a speed; the same interface as `FmuAxle`.

    Parameters
    ----------
    parameters : HypoidAxleParameters
    channels : sequence of str
        Outputs that `read` returns, in this order; FMI names.
    pinion_speed : float
        At the start [rad/s].
    """

    def __init__(
        self, parameters: HypoidAxleParameters, channels: Sequence[str], pinion_speed: float
    ) -> None:
        self._axle = HypoidAxle(parameters)
        self._columns = np.array([OUTPUT_NAMES.index(name) for name in channels])
        self._speed, self._temperature, self._time = pinion_speed, 0.0, 0.0
        self._warned: dict[str, str] = {}

    @property
    def warnings(self) -> list[str]:
        """What left its range since the start, each said once."""
        return list(self._warned.values())

    def initialise(self, pinion_torque: float, wheel_torque: float, temperature: float) -> None:
        """Start with these inputs [N.m, N.m, K]."""
        self._temperature, self._time = temperature, 0.0
        self._axle.initialise(
            pinion_speed=self._speed,
            pinion_torque=pinion_torque,
            wheel_torque=wheel_torque,
            oil_temperature=temperature,
        )

    def step(self, h: float, pinion_torque: float, wheel_torque: float) -> None:
        """Advance by `h` [s] with constant torques [N.m]."""
        self._axle.step(h, pinion_torque, wheel_torque, self._temperature)
        self._time += h
        if self._axle.output("range.exceeded"):
            for name, sentence in self._axle.exceeded().items():
                self._warned.setdefault(name, f"{sentence} First at t = {self._time:g} s.")

    def read(self) -> Array:
        """Return the channels."""
        return np.asarray(self._axle.outputs[self._columns])
