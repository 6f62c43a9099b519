"""Harmonics of the periodic response over friction and speed."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.checks import check_positive, check_within
from gearlube_core.dynamics.helical_pair.linear.linear_system import RELATIVE
from gearlube_core.dynamics.helical_pair.linear.periodic_response import (
    COMPOSITES,
    ResponseSettings,
    harmonics,
    periodic_response,
    with_friction,
)
from gearlube_core.dynamics.helical_pair.parameters import HelicalPairParameters
from gearlube_core.storage.process_pool import ProcessPool, single_threaded

QUANTITIES = (*RELATIVE, *COMPOSITES)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class HarmonicGrid:
    """Amplitudes over friction and speed; rows of unstable pairs hold NaN.

    Parameters
    ----------
    mu : ndarray of shape (M,)
        [-]
    pinion_speed : ndarray of shape (S,)
        [rad/s]
    displacement : ndarray of shape (M, S, 14, count)
        Of `QUANTITIES`, harmonics 1 to count of the mesh frequency [m, rad].
    bearing_force : ndarray of shape (M, S, 12, count)
        Of `BEARING_FORCES` [N, N.m].
    mean_bearing_force : ndarray of shape (M, S, 12)
        [N, N.m]
    friction_torque : ndarray of shape (M, S)
        [N.m]
    stability_margin : ndarray of shape (M, S)
        One less the largest modulus of a Floquet multiplier [-].
    """

    mu: Array
    pinion_speed: Array
    displacement: Array
    bearing_force: Array
    mean_bearing_force: Array
    friction_torque: Array
    stability_margin: Array


def harmonic_grid(
    parameters: HelicalPairParameters,
    mu: Array,
    pinion_speed: Array,
    *,
    count: int = 15,
    settings: ResponseSettings | None = None,
    workers: int = 1,
) -> HarmonicGrid:
    """Return harmonics 1 to `count` over coefficients of friction [-] and speeds [rad/s].

    Parameters
    ----------
    parameters
        The pair; its own friction is replaced.
    mu, pinion_speed
        Axes.
    count
        Harmonics kept.
    settings
        Resolution of each response.
    workers
        Processes among which the speeds are divided.
    """
    settings = settings or ResponseSettings()
    mu, pinion_speed = np.array(mu, dtype=np.float64), np.array(pinion_speed, dtype=np.float64)
    for value in mu:
        check_within("mu", value, 0.0, 1.0, "1")
    for value in pinion_speed:
        check_positive("pinion_speed", value, "rad/s")
    check_within("count", count, 1, settings.samples // 8, "", "Raise the number of samples.")
    jobs = [(parameters, mu, float(speed), count, settings) for speed in pinion_speed]
    with ProcessPool(jobs=workers).open(len(jobs)) as executor:
        if executor is None:
            with single_threaded():
                columns = [_column(*job) for job in jobs]
        else:
            columns = list(executor.map(_column, *zip(*jobs, strict=True), chunksize=4))
    parts = [np.stack([column[part] for column in columns], axis=1) for part in range(5)]
    return HarmonicGrid(
        mu=mu,
        pinion_speed=pinion_speed,
        displacement=parts[0],
        bearing_force=parts[1],
        mean_bearing_force=parts[2],
        friction_torque=parts[3],
        stability_margin=parts[4],
    )


def _column(
    parameters: HelicalPairParameters,
    mu: Array,
    speed: float,
    count: int,
    settings: ResponseSettings,
) -> tuple[Any, ...]:
    displacement = np.empty((mu.size, len(QUANTITIES), count))
    force, mean = np.empty((mu.size, 12, count)), np.empty((mu.size, 12))
    torque, margin = np.empty(mu.size), np.empty(mu.size)
    for i, value in enumerate(mu):
        response = periodic_response(
            with_friction(parameters, float(value)), speed, settings, throw=False
        )
        histories = np.column_stack([response.signal(name) for name in QUANTITIES])
        bearing = response.bearing_force
        displacement[i], force[i] = harmonics(histories, count).T, harmonics(bearing, count).T
        mean[i], torque[i] = bearing.mean(axis=0), response.friction_torque
        margin[i] = 1.0 - abs(response.multipliers[0])
        if margin[i] <= 0.0:
            displacement[i] = force[i] = mean[i] = torque[i] = np.nan
    return displacement, force, mean, torque, margin
