"""Frequency sweeps by time integration; each frequency starts from the last state."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal, get_args

import numpy as np
from numpy.typing import NDArray

from gearlube_core.arrays import Array
from gearlube_core.checks import check_option, check_within
from gearlube_core.dynamics.hypoid_torsional.kernel_parameters import TorsionalParameters
from gearlube_core.dynamics.hypoid_torsional.mode_march import MARCH_WORK, N_RECORD, OK, march
from gearlube_core.dynamics.hypoid_torsional.model import HypoidTorsional
from gearlube_core.dynamics.hypoid_torsional.parameters import HypoidTorsionalParameters
from gearlube_core.dynamics.hypoid_torsional.rates import UM
from gearlube_core.errors import StepError
from gearlube_core.kernels.jit import kernel
from gearlube_core.spectra import AngleWindow, order_spectrum

Direction = Literal["up", "down"]

ORDERS = 8  # mesh orders of the transmission error that a sweep keeps


@dataclass(frozen=True, slots=True, kw_only=True)
class TimeSweep:
    """Response over mesh frequency, one row each, in the order it was run.

    Parameters
    ----------
    frequency : ndarray of shape (n,)
        Mesh frequency asked for [Hz].
    mean_speed : ndarray of shape (n,)
        Mean pinion speed over the record [rad/s].
    load_torque : ndarray of shape (n,)
        T_g, which leaves the pinion its speed [N.m].
    minimum, maximum : ndarray of shape (n,)
        Of the dynamic transmission error [m].
    harmonics : ndarray of shape (n, ORDERS)
        Amplitudes of its mesh orders from 1 [m].
    separation_share : ndarray of shape (n,)
        Share of the time within the backlash [-].
    impact : ndarray of shape (n,) of int
        0 in contact, 1 single-sided, 2 double-sided: no contact lost, minimum within the backlash,
        minimum on the coast flanks.
    record : ndarray of shape (n, samples, 5)
        Pinion angle [rad], x [m], pinion and gear speed [rad/s], mesh force [N] at equal angles.
    """

    frequency: Array
    mean_speed: Array
    load_torque: Array
    minimum: Array
    maximum: Array
    harmonics: Array
    separation_share: Array
    impact: NDArray[np.int64]
    record: Array

    @property
    def peak_to_peak(self) -> Array:
        """Of the dynamic transmission error [m], shape (n,)."""
        return self.maximum - self.minimum


@kernel
def settle_load(
    y: Array,
    revolutions: int,
    load_torque: float,
    speed: float,
    rows: Array,
    p: TorsionalParameters,
    work: Array,
) -> float:
    """March whole revolutions and return the load torque [N.m] under which `speed` stays.

    After each revolution the load takes up a share of what accelerated the pair, which falls as
    1/(1 + n/2) so that the swing of a motion that does not repeat averages out, and the pair is
    put back to its speed.
    """
    nothing = rows[0:0]
    inertia = p.I_p + p.I_g * (p.R_p0 / p.R_g0) ** 2
    for n in range(revolutions):
        w_0, t_0 = y[1], y[3]
        if march(y, 0, int(p.z_p), load_torque, speed, rows, p, nothing, work) != OK:
            return load_torque
        elapsed = y[3] - t_0
        mean = 2.0 * math.pi / elapsed
        excess = inertia * (y[1] - w_0) / elapsed - p.hold_gain * (speed - mean)
        load_torque += excess * p.R_g0 / p.R_p0 / (1.0 + 0.5 * n)
        y[1] *= speed / mean
        y[2] *= speed / mean
    return load_torque


@kernel
def sweep_kernel(
    y: Array,
    speeds: Array,
    balance: int,
    settle: int,
    keep: int,
    load_torque: float,
    rows: Array,
    p: TorsionalParameters,
    record: Array,
    mean_speeds: Array,
    load_torques: Array,
    work: Array,
) -> int:
    """March through all speeds; return the index of the first that is not finite, or their number.

    Parameters
    ----------
    y : ndarray of shape (4,)
        State of `mode_march` at the first speed.
    speeds, mean_speeds, load_torques : ndarray of shape (n,)
        Asked for and found [rad/s], and the load of each [N.m].
    balance : int
        Revolutions in which the load is found, see `settle_load`.
    settle, keep : int
        Mesh periods under that load before the record and in it.
    load_torque : float
        To start with [N.m].
    record : ndarray of shape (n, keep * steps, N_RECORD)
    work : ndarray of shape (MARCH_WORK,)
    """
    nothing = record[0, 0:0]
    for i in range(speeds.size):
        if i > 0:
            scale = speeds[i] / speeds[i - 1]
            for j in range(1, 3):
                y[j] *= scale
        if p.form == 2.0:
            load_torque = settle_load(y, balance, load_torque, speeds[i], rows, p, work)
        load_torques[i] = load_torque
        status = march(y, 0, settle, load_torque, speeds[i], rows, p, nothing, work)
        start = y[3]
        if status == OK:
            status = march(y, settle, keep, load_torque, speeds[i], rows, p, record[i], work)
        if status != OK:
            return i
        mean_speeds[i] = keep * 2.0 * math.pi / p.z_p / (y[3] - start)
    return speeds.size


def time_sweep(
    parameters: HypoidTorsionalParameters,
    frequencies: Array,
    direction: Direction,
    *,
    periods: int = 300,
    revolutions: int = 1,
    steps_per_mesh_period: int = 256,
) -> TimeSweep:
    """Return the response over mesh frequency, found by integration in time.

    The state at the end of one frequency starts the next, so that a sweep stays on its branch
    where two motions coexist: up and down differ there.

    Parameters
    ----------
    parameters : HypoidTorsionalParameters
    frequencies : array of shape (n,)
        Mesh frequencies [Hz], any order.
    direction : {"up", "down"}
        Order in which they are run, rising or falling.
    periods : int
        Mesh periods at each frequency before the record. In the whole revolutions among the first
        three quarters of them the load torque is fitted to the losses, so that the mean speed is
        the one asked for; the speed hold alone would take 0.2 s to settle, and short of it.
    revolutions : int
        Of the pinion, in the record.
    steps_per_mesh_period : int
        Integration steps in a mesh period.

    Raises
    ------
    ParameterError
        When an input is out of range.
    StepError
        When the motion is no longer finite at a frequency.
    """
    check_option("direction", direction, get_args(Direction))
    check_within("periods", periods, 0, 1_000_000)
    check_within("revolutions", revolutions, 1, 10_000)
    model = HypoidTorsional(parameters)
    rows = model.rows(steps_per_mesh_period)
    order = np.sort(np.asarray(frequencies, dtype=np.float64))
    if direction == "down":
        order = order[::-1]
    speeds = np.array([model.pinion_speed(f) for f in order])
    teeth = parameters.mesh.pinion_teeth
    per_revolution = teeth * steps_per_mesh_period
    record = np.zeros((order.size, revolutions * per_revolution, N_RECORD))
    mean_speed = np.zeros(order.size)
    load_torque = np.zeros(order.size)
    balance = 3 * periods // (4 * teeth)
    done = sweep_kernel(
        model.initial_state(speeds[0]),
        speeds,
        balance,
        periods - balance * teeth if parameters.form == "two_dof" else periods,
        revolutions * teeth,
        model.mean_load_torque,
        rows,
        model.kernel_parameters,
        record,
        mean_speed,
        load_torque,
        np.zeros(MARCH_WORK),
    )
    if done < order.size:
        raise StepError(
            f"The transmission error is infinite, not a number or above 0.1 m at {order[done]:g} "
            "Hz. Raise steps_per_mesh_period or check the damping."
        )
    record[:, :, 1] *= UM
    x = record[:, :, 1]
    minimum, maximum = x.min(axis=1), x.max(axis=1)
    return TimeSweep(
        frequency=order,
        mean_speed=mean_speed,
        load_torque=load_torque,
        minimum=minimum,
        maximum=maximum,
        harmonics=_harmonics(x, revolutions, per_revolution, teeth, mean_speed),
        separation_share=np.mean((x < 0.0) & (x > -parameters.backlash), axis=1),
        impact=(minimum < 0.0).astype(np.int64) + (minimum <= -parameters.backlash),
        record=record,
    )


def _harmonics(
    x: Array, revolutions: int, per_revolution: int, teeth: int, mean_speed: Array
) -> Array:
    """Return the amplitudes of mesh orders 1 to ORDERS [m], shape (n, ORDERS)."""
    window = AngleWindow(
        start=0.0,
        revolutions=revolutions,
        samples_per_revolution=per_revolution,
        mean_speed=float(np.mean(mean_speed)),
    )
    amplitude = order_spectrum(x.T, window).amplitude
    return np.asarray(amplitude[teeth * revolutions * np.arange(1, ORDERS + 1)].T)
