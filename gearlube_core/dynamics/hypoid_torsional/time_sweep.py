"""Frequency sweeps by time integration, the state handed on from one frequency to the next."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal, get_args

import numpy as np
from numpy.typing import NDArray

from gearlube_core.checks import check_option, check_within
from gearlube_core.dynamics.hypoid_torsional.angle_march import N_RECORD, OK, march
from gearlube_core.dynamics.hypoid_torsional.kernel_parameters import TorsionalParameters
from gearlube_core.dynamics.hypoid_torsional.model import HypoidTorsional
from gearlube_core.dynamics.hypoid_torsional.parameters import HypoidTorsionalParameters
from gearlube_core.dynamics.hypoid_torsional.rates import UM
from gearlube_core.errors import StepError
from gearlube_core.jit import kernel
from gearlube_core.spectra import AngleWindow, order_spectrum

Array = NDArray[np.float64]
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
        Mean pinion speed over the record [rad/s]; the speed hold is slow and lets losses act.
    minimum, maximum : ndarray of shape (n,)
        Of the dynamic transmission error [m].
    harmonics : ndarray of shape (n, ORDERS)
        Amplitudes of its mesh orders from 1 [m].
    separation_share : ndarray of shape (n,)
        Share of the time without mesh force [-].
    impact : ndarray of shape (n,) of int
        0 in contact, 1 single-sided, 2 double-sided: no contact lost, minimum within the backlash,
        minimum on the coast flanks.
    record : ndarray of shape (n, samples, 5)
        Pinion angle [rad], x [m], pinion and gear speed [rad/s], mesh force [N] at equal angles.
    """

    frequency: Array
    mean_speed: Array
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
def sweep_kernel(
    y: NDArray[np.float64],
    speeds: NDArray[np.float64],
    settle: int,
    keep: int,
    load_torque: float,
    rows: NDArray[np.float64],
    p: TorsionalParameters,
    record: NDArray[np.float64],
    mean_speeds: NDArray[np.float64],
) -> int:
    """March through all speeds; return the index of the first that is not finite, or their number.

    Parameters
    ----------
    y : ndarray of shape (4,)
        State of `angle_march` at the first speed.
    speeds, mean_speeds : ndarray of shape (n,)
        Asked for and found [rad/s].
    settle, keep : int
        Mesh periods before the record and in it.
    record : ndarray of shape (n, keep * steps, N_RECORD)
    """
    nothing = record[0, 0:0]
    for i in range(speeds.size):
        if i > 0:
            scale = speeds[i] / speeds[i - 1]
            for j in range(1, 3):
                y[j] *= scale
        status = march(y, 0, settle, load_torque, speeds[i], rows, p, nothing)
        start = y[3]
        if status == OK:
            status = march(y, settle, keep, load_torque, speeds[i], rows, p, record[i])
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
        Mesh periods at each frequency before the record.
    revolutions : int
        Of the pinion, in the record.
    steps_per_mesh_period : int
        Of the integrator.

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
    done = sweep_kernel(
        model.initial_state(speeds[0]),
        speeds,
        periods,
        revolutions * teeth,
        model.mean_load_torque,
        rows,
        model.kernel_parameters,
        record,
        mean_speed,
    )
    if done < order.size:
        raise StepError(
            f"the transmission error is no longer finite or beyond 0.1 m at {order[done]:g} Hz. "
            "Refine steps_per_mesh_period or check the damping."
        )
    record[:, :, 1] *= UM
    x = record[:, :, 1]
    minimum, maximum = x.min(axis=1), x.max(axis=1)
    return TimeSweep(
        frequency=order,
        mean_speed=mean_speed,
        minimum=minimum,
        maximum=maximum,
        harmonics=_harmonics(x, revolutions, per_revolution, teeth, mean_speed),
        separation_share=np.mean(record[:, :, 4] == 0.0, axis=1),
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
