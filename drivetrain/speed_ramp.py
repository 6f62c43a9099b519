"""A bench that takes the axle through a speed ramp: torque on the pinion, speed on the wheel."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.checks import check_positive, check_within
from gearlube_core.errors import ParameterError, StepError

# Bandwidth times time while the loop learns; errors then fall with time to the power -2.5.
_LEARNING = 3.0


class SlowLoop:
    """The torque K f (w_r - w) + K_I f^2 (integral of w_r - w) that brings a shaft to a speed.

    Parameters
    ----------
    proportional_gain : float
        K [N m s/rad]. The gain is a damper K / I on the shaft.
    integral_gain : float, optional
        K_I [N m/rad]; by default K^2 / (4 I), which is critical damping.
    inertia : float
        I [kg m2].
    start_factor : float
        By which the loop is faster at the start, so that it learns what the shaft loses before a
        record begins [-]: f = 3 / (w t), at most this factor and at least 1, where w = K / (2 I)
        is the bandwidth. 1 switches it off.

    Notes
    -----
    The integral is formed from the angle, so the mean speed has no sampling error.
    """

    def __init__(
        self,
        proportional_gain: float,
        integral_gain: float | None,
        inertia: float,
        start_factor: float,
    ) -> None:
        cure = "0.05 N m s/rad leaves the mesh mode alone."
        k = check_within("proportional_gain", proportional_gain, 0.0, 100.0, "N m s/rad", cure)
        check_positive("axle_inertia", inertia, "kg m2")
        if integral_gain is None:
            integral_gain = k**2 / (4.0 * inertia)
        check_within("integral_gain", integral_gain, 0.0, 1e5, "N m/rad")
        check_within("start_factor", start_factor, 1.0, 100.0, "", "1 is no faster start.")
        self._gains = (k, integral_gain)
        self._fastest = start_factor
        # Time at which the gains have come down to those requested [s].
        self._learning = _LEARNING * 2.0 * inertia / k if k > 0.0 else 0.0
        # Elapsed time, integral torque, expected angle, started.
        self.state = (0.0, 0.0, 0.0, 0.0)

    @property
    def elapsed(self) -> float:
        """Time since the start [s]."""
        return self.state[0]

    @property
    def learnt(self) -> float:
        """Torque of the integral [N m]."""
        return self.state[1]

    def torque(self, h: float, angle: float, speed: float, wanted: float, turn: float) -> float:
        """Return the torque [N m] for the next `h` [s].

        Parameters
        ----------
        h : float
            [s]
        angle, speed : float
            Of the shaft now [rad], [rad/s].
        wanted : float
            Speed that it should have now [rad/s].
        turn : float
            Angle that it should cover in `h` [rad].
        """
        elapsed, integral, expected, started = self.state
        factor = 1.0
        if elapsed < self._learning:
            factor = min(self._fastest, self._learning / (elapsed + h))
        gain, integral_gain = self._gains
        if started:
            integral += integral_gain * factor**2 * (expected - angle)
        self.state = (elapsed + h, integral, angle + turn, 1.0)
        return integral + gain * factor * (wanted - speed)


@dataclass(frozen=True, slots=True, kw_only=True)
class SpeedRamp:
    """Pinion speed that rises or falls linearly with time, held before and after.

    Parameters
    ----------
    start, end : float
        Pinion speed [rad/s].
    duration : float
        From start to end [s].
    """

    start: float
    end: float
    duration: float

    def __post_init__(self) -> None:
        check_positive("start", self.start, "rad/s")
        check_positive("end", self.end, "rad/s")
        check_positive("duration", self.duration, "s")

    @property
    def acceleration(self) -> float:
        """Angular acceleration of the pinion during the ramp [rad/s2], below 0 when it slows."""
        return (self.end - self.start) / self.duration

    def speed(self, time: float) -> float:
        """Return the pinion speed [rad/s] at `time` [s]; the ramp begins at 0."""
        return self.start + self.acceleration * min(max(time, 0.0), self.duration)

    def angle(self, time: float) -> float:
        """Return the angle [rad] that the pinion has turned since time 0; below 0 before."""
        within = min(max(time, 0.0), self.duration)
        return (
            self.start * min(time, 0.0)
            + (self.start + 0.5 * self.acceleration * within) * within
            + self.end * max(time - self.duration, 0.0)
        )


class RampHold:
    """Driver for a speed ramp: the torque on the pinion is given, the wheel holds the ramp.

    T_w = i [T_p - T_loss - I a - T_c],  T_c = K (w_r - w) + K_I (integral of w_r - w)

    Parameters
    ----------
    ramp : SpeedRamp
    ratio : float
        i, pinion speed over wheel speed [-].
    pinion_torque, loss_torque : array
        T_p from outside and the expected loss, both at the pinion [N m], at equal times from the
        start of the ramp to its end; shape (n,), n >= 2.
    axle_inertia : float
        I of the whole axle at the pinion [kg m2].
    lead : float
        Time for which the start speed is held before the ramp begins [s].
    proportional_gain : float
        K at the pinion [N m s/rad]; small, so that the modes of the axle keep their damping.
    start_factor : float
        By which the loop is faster at the start [-]; see `SlowLoop`.
    """

    def __init__(
        self,
        ramp: SpeedRamp,
        *,
        ratio: float,
        pinion_torque: Array,
        loss_torque: Array,
        axle_inertia: float,
        lead: float,
        proportional_gain: float = 0.05,
        start_factor: float = 20.0,
    ) -> None:
        check_positive("ratio", ratio)
        check_within("lead", lead, 0.0, 60.0, "s")
        self._loop = SlowLoop(proportional_gain, None, axle_inertia, start_factor)
        torque, loss = (np.asarray(one, dtype=np.float64) for one in (pinion_torque, loss_torque))
        if torque.ndim != 1 or torque.size < 2 or torque.shape != loss.shape:
            raise ParameterError(
                f"pinion_torque and loss_torque must have one equal dimension of 2 or more, got "
                f"shapes {torque.shape} and {loss.shape}."
            )
        if not np.all(np.isfinite(torque + loss)):
            raise ParameterError("pinion_torque and loss_torque must be finite, got NaN.")
        self.ramp = ramp
        self._ratio, self._inertia, self._lead = ratio, axle_inertia, lead
        self._torque, self._loss = torque.tolist(), loss.tolist()
        self._per_second = (torque.size - 1) / ramp.duration

    def _at(self, values: list[float], time: float) -> float:
        place = min(max(time * self._per_second, 0.0), len(values) - 1.0)
        left = min(int(place), len(values) - 2)
        return values[left] + (place - left) * (values[left + 1] - values[left])

    def initial_torques(self) -> tuple[float, float]:
        """Return the torques on pinion and wheel [N m] at the steady start."""
        return self._torque[0], self._ratio * (self._torque[0] - self._loss[0])

    @property
    def initial_pinion_speed(self) -> float:
        """Pinion speed at which the axle should start [rad/s]."""
        return self.ramp.start

    @property
    def time(self) -> float:
        """Time since the ramp began [s], below 0 before."""
        return self._loop.elapsed - self._lead

    def step(
        self,
        h: float,
        pinion_angle: float,
        pinion_speed: float,
        wheel_angle: float,
        wheel_speed: float,
    ) -> tuple[float, float]:
        """Return the torques on pinion and wheel [N m] for the next `h` [s].

        Parameters as of `drivers.Driver.step`; the wheel's motion is not used.
        """
        if not (h > 0.0 and math.isfinite(h + pinion_angle + pinion_speed)):
            raise StepError(
                f"The ramp needs h above 0 s and finite signals, got h {h:g} s, pinion "
                f"{pinion_angle:g} rad, {pinion_speed:g} rad/s. Look at the axle's outputs before "
                "this step."
            )
        ramp, time = self.ramp, self.time
        middle = time + 0.5 * h
        wanted = ramp.acceleration if 0.0 <= middle < ramp.duration else 0.0
        torque = self._at(self._torque, middle)
        turn = ramp.angle(time + h) - ramp.angle(time)
        control = self._loop.torque(h, pinion_angle, pinion_speed, ramp.speed(time), turn)
        held = torque - self._at(self._loss, middle) - self._inertia * wanted - control
        return torque, self._ratio * held

    def get_state(self) -> Array:
        """Return everything that determines the future, shape (4,)."""
        return np.array(self._loop.state)

    def set_state(self, state: Array) -> None:
        """Continue bit by bit from what `get_state` returned."""
        values = np.asarray(state, dtype=np.float64)
        if values.shape != (4,) or not np.all(np.isfinite(values)):
            raise ParameterError(
                f"The state must hold 4 finite numbers, got shape {values.shape}. "
                "Use what get_state of the same class returned."
            )
        elapsed, integral, expected, started = values.tolist()
        self._loop.state = (elapsed, integral, expected, started)
