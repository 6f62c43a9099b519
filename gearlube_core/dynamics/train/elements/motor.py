"""Electric motor: a torque with its ripple and a radial pull, behind the lag of its control."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated, Any, ClassVar, NamedTuple

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.dynamics.train.element import RATE, RZ, Listed, W
from gearlube_core.dynamics.train.elements.port import Port
from gearlube_core.dynamics.train.part import GROUND
from gearlube_core.dynamics.train.ripple_table import RippleTable, skew_factor
from gearlube_core.kernels.checked_numbers import all_finite
from gearlube_core.kernels.jit import kernel
from gearlube_core.number import Number, Output
from gearlube_core.oil.lubricant_state import LubricantState

# places of `at` behind rotor and stator
_LAGGED, _WORK, _GIVEN, _SPEEDS, _TORQUES, _ORDERS = range(2, 8)
_PER_POINT = 4  # cosine and sine of the torque, then of the pull
_MOST = 100_000  # points of a table


class _Act(NamedTuple):
    """Torque and pull on the rotor, against the stator."""

    torque: float  # about z, with the ripple [N.m]
    ripple: float  # about z
    pull_x: float  # [N]
    pull_y: float


class MotorKernels(NamedTuple):
    """Constants of a motor, and its kernels: see `element.Kernels`."""

    sign: float  # of its torque about z
    lag_rate: float  # [1/s], 0 for none
    steps_per_period: float
    pull_stiffness: float  # [N/m]

    @kernel
    def at_rest(self, at: Any, memory: Array, s: Array, oil: LubricantState) -> None:
        """See `Kernels.at_rest`."""
        s[at[_LAGGED]] = s[at[_GIVEN]]

    @kernel
    def add_forces(
        self, at: Any, memory: Array, s: Array, oil: LubricantState, stage: int, ds: Array
    ) -> None:
        """See `Kernels.add_forces`."""
        one = _act(self, at, memory, s)
        rotor, stator = at[0] + RATE, at[1] + RATE
        ds[rotor] += one.pull_x
        ds[rotor + 1] += one.pull_y
        ds[rotor + RZ] += one.torque
        ds[stator] -= one.pull_x
        ds[stator + 1] -= one.pull_y
        ds[stator + RZ] -= one.torque
        ds[at[_LAGGED]] = self.lag_rate * (s[at[_GIVEN]] - s[at[_LAGGED]])
        power = one.torque * (s[rotor + RZ] - s[stator + RZ])
        power += one.pull_x * (s[rotor] - s[stator]) + one.pull_y * (s[rotor + 1] - s[stator + 1])
        ds[at[_WORK]] += power

    @kernel
    def step_rate(self, at: Any, memory: Array, s: Array, oil: LubricantState) -> float:
        """See `Kernels.step_rate`; two steps in the time of the lag keep it exact to 1e-3."""
        orders, rate = at[_ORDERS], 2.0 * self.lag_rate
        if orders == 0:
            return rate
        highest = memory[at[_SPEEDS] + at[_TORQUES] + orders - 1]
        turns = abs(s[at[0] + W] - s[at[1] + W]) / (2.0 * math.pi)
        return max(rate, self.steps_per_period * highest * turns)

    @kernel
    def write(
        self, at: Any, memory: Array, s: Array, oil: LubricantState, out: Array, first: int
    ) -> None:
        """See `Kernels.write`."""
        one = _act(self, at, memory, s)
        for i in range(len(one)):
            out[first + i] = one[i]

    @kernel
    def check(self, at: Any, memory: Array, s: Array, oil: LubricantState, kept: int) -> float:
        """See `Kernels.check`."""
        n, m, k = at[_SPEEDS], at[_TORQUES], at[_ORDERS]
        fits = kept == 1 and n <= _MOST and m <= _MOST and k <= _MOST
        fits = fits and (k == 0 or (n > 0 and m > 0))
        fits = fits and memory.size == n + m + k + _PER_POINT * k * n * m
        return 1.0 if fits and all_finite(memory, 0, memory.size) else 0.0


@kernel
def _bracket(memory: Array, first: int, n: int, x: float) -> tuple[int, float]:
    """Return the point at or below `x` and the share of the next one; held at both ends."""
    i = 0
    while i + 2 < n and memory[first + i + 1] <= x:
        i += 1
    if n == 1:
        return 0, 0.0
    low, high = memory[first + i], memory[first + i + 1]
    return i, min(max((x - low) / (high - low), 0.0), 1.0)


@kernel
def _act(self: MotorKernels, at: Any, memory: Array, s: Array) -> _Act:
    n, m, k = at[_SPEEDS], at[_TORQUES], at[_ORDERS]
    mean = s[at[_LAGGED]] if self.lag_rate > 0.0 else s[at[_GIVEN]]
    drawn_x = self.pull_stiffness * (s[at[0]] - s[at[1]])  # to where the gap is narrow
    drawn_y = self.pull_stiffness * (s[at[0] + 1] - s[at[1] + 1])
    if k == 0:
        return _Act(self.sign * mean, 0.0, drawn_x, drawn_y)
    i, over = _bracket(memory, 0, n, abs(s[at[0] + W] - s[at[1] + W]))
    j, beyond = _bracket(memory, n, m, abs(mean))
    turned = self.sign * (s[at[0] + RZ] - s[at[1] + RZ])
    ripple = along = across = 0.0
    for o in range(k):
        cos, sin = math.cos(memory[n + m + o] * turned), math.sin(memory[n + m + o] * turned)
        point = n + m + k + _PER_POINT * ((o * n + i) * m + j)
        for side in range(4):
            up, right = side // 2, side % 2
            share = (over if up else 1.0 - over) * (beyond if right else 1.0 - beyond)
            if share > 0.0:  # a table with one speed or torque has no next one
                p = point + _PER_POINT * (up * m + right)
                ripple += share * (memory[p] * cos - memory[p + 1] * sin)
                along += share * (memory[p + 2] * cos - memory[p + 3] * sin)
                across += share * (memory[p + 2] * sin + memory[p + 3] * cos)
    torque = self.sign * (mean + ripple)
    return _Act(torque, self.sign * ripple, along + drawn_x, self.sign * across + drawn_y)


@dataclass(frozen=True, kw_only=True)
class Motor(Port):
    """An electric motor, whose wanted torque is an input of the train as that of a `Port`.

    T = T_mean + sum A cos(order angle + phase),  dT_mean/dt = 2 pi bandwidth (T_wanted - T_mean)

    F_x + i F_y = sum B exp(i (order angle + phase)) + k_m (x + i y)

    Amplitudes A and B are those of a table at the speed and T_mean, both absolute, between its
    points by their cosine and sine parts; beyond its ends they are held. The angle is that of the
    rotor against the stator, in the sense of a positive torque, in which the pull turns too. x, y
    is the rotor's displacement in the stator.

    Parameters beside those of `Port`
    ---------------------------------
    stator : str
        Body that bears torque and pull the other way.
    bandwidth : float
        Of the control of the torque, where it follows by 1/sqrt(2); 0: without lag [Hz].
    ripple : RippleTable, optional
    skew_angle : float
        Of rotor or stator over the whole length, where the table is that without skew [rad].
    skew_steps : int
        Of the skew; 0 for one without steps.
    pull_stiffness : float
        k_m, how far the pull of the magnets grows where the rotor leaves the middle of the stator
        [N/m]; it acts against the bearings, as a negative spring.
    steps_per_ripple_period : float
        Integrator steps per period of the highest order.

    Notes
    -----
    The work of ripple and pull is part of that put in. Skew leaves `skew_factor` of the torque
    ripple; the pull stays as it is. The pull acts at the centre of the body, or at its node.

    Examples
    --------
    >>> motor = Motor(name="motor", body="rotor", ripple=RippleTable.named("48_slots_8_poles"))
    >>> motor.sizes()  # speeds, torques, orders
    (3, 3, 5)
    """

    stator: str = GROUND
    bandwidth: Annotated[
        float, Number("Hz", 0.0, 1e5, text="Bandwidth of the torque control; 0: without lag")
    ] = 0.0
    ripple: RippleTable | None = None
    skew_angle: Annotated[
        float,
        Number("rad", 0.0, math.pi, text="Skew, where the table is that without it", shown="deg"),
    ] = 0.0
    skew_steps: Annotated[int, Number("1", 0, 100, text="Steps of the skew; 0: no steps")] = 0
    pull_stiffness: Annotated[
        float,
        Number(
            "N/m", 0.0, 1e9, text="Growth of the magnetic pull with the rotor's displacement",
            shown="N/um",
        ),
    ] = 0.0  # fmt: skip
    steps_per_ripple_period: Annotated[
        float, Number("1", 4.0, 4096.0, text="Integrator steps per period of the highest order")
    ] = 16.0
    kind: ClassVar = "motor"
    interpreted: ClassVar = (Listed(MotorKernels, (), 8),)
    linear: ClassVar = False  # ripple follows the rotor
    on: ClassVar = ("body", "stator")
    lags: ClassVar = (Output("mean_torque", "N.m", "torque that follows the wanted one", 100.0),)
    outputs: ClassVar = (
        Output("torque_about_z", "N.m", "torque on the rotor about z, with its ripple", 100.0),
        Output("ripple", "N.m", "ripple of the torque about z"),
        Output("pull.x", "N", "magnetic pull along x on the rotor", 100.0),
        Output("pull.y", "N", "magnetic pull along y on the rotor", 100.0),
    )

    def numbers(self) -> MotorKernels:  # type: ignore[override]
        """Return the constants of the kernels."""
        rate = 2.0 * math.pi * self.bandwidth
        steps = float(self.steps_per_ripple_period)
        return MotorKernels(float(self.sign), rate, steps, float(self.pull_stiffness))

    def sizes(self) -> tuple[int, ...]:
        """Return the numbers of speeds, torques and orders of the table."""
        table = self.ripple
        return (0, 0, 0) if table is None else table.torque.shape[1:] + table.orders.shape

    def ripple_at(self, speed: float, torque: float) -> dict[float, complex]:
        """Return the torque ripple by order, beyond the ends of the table as there [N.m].

        Parameters
        ----------
        speed, torque : float
            Of the rotor [rad/s], [N.m].

        Examples
        --------
        >>> motor = Motor(name="motor", body="rotor", ripple=RippleTable.named("48_slots_8_poles"))
        >>> round(abs(motor.ripple_at(628.3, 100.0)[24.0]), 2)
        1.32
        """
        table, found = self.ripple, {}
        if table is not None:
            for order, rows in zip(table.orders, table.torque, strict=True):
                by_speed = [np.interp(abs(torque), table.torques, row) for row in rows]
                ripple = complex(np.interp(abs(speed), table.speeds, by_speed))
                if ripple and order:
                    found[float(order)] = ripple * skew_factor(
                        order, self.skew_angle, self.skew_steps
                    )
        return found

    def memory(self) -> Array:
        """Return speeds, torques and orders of the table, then parts of all amplitudes."""
        table = self.ripple
        if table is None:
            return np.empty(0)
        left = [skew_factor(one, self.skew_angle, self.skew_steps) for one in table.orders]
        torque = np.array(left)[:, None, None] * table.torque
        parts = np.stack([torque.real, torque.imag, table.pull.real, table.pull.imag], axis=-1)
        return np.concatenate([table.speeds, table.torques, table.orders, parts.ravel()])
