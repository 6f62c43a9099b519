"""The loss of an axle at one point with its uncertain data drawn."""

from __future__ import annotations

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.dynamics.hypoid_axle.losses import LOSS_SOURCES, axle_losses
from gearlube_core.dynamics.hypoid_axle.parameters import HypoidAxleParameters
from gearlube_core.dynamics.hypoid_axle.uncertain import (
    UPPER_END,
    by_one_film,
    changed_axle,
    log_slope,
    uncertain_of,
)


def drawn_losses(
    axle: HypoidAxleParameters,
    power: Array,
    *,
    torque: float,
    speed: float,
    temperature: float,
    draws: int = 200,
    seed: int = 1,
) -> Array:
    """Return the total loss [W] of an axle in steady running with its uncertain data drawn.

    Parameters
    ----------
    axle
    power : ndarray of shape (sources,)
        What it loses [W], see `losses.LOSS_SOURCES`.
    torque, speed, temperature
        Of the pinion [N.m], [rad/s], of the oil [K], where it loses that.
    draws, seed
        Number of draws and what they start from.

    Returns
    -------
    ndarray of shape (draws,)

    Notes
    -----
    Each datum changes a source as a power law, found from the losses with the datum at either end.

    Raises
    ------
    ParameterError
        A datum leaves its limits, or the point those of the axle.
    """

    def losses(changed: HypoidAxleParameters) -> tuple[Array, Array]:
        solved = changed.film == "solved"
        found = axle_losses(
            changed,
            torques=np.array([torque]),
            speeds=np.array([speed]),
            temperatures=np.array([temperature]),
            angles=8,
            extremes=solved,
        )
        return found.power[0, 0, 0], found.share_outside[0, 0, 0] if solved else np.zeros(())

    inputs = uncertain_of(axle)
    slopes: list[Array] = []
    for one in inputs:
        scales = [np.ones(len(LOSS_SOURCES)) for _ in range(2)]
        ends = [
            changed_axle(one, axle, normal, scale)
            for normal, scale in zip((UPPER_END, -UPPER_END), scales, strict=True)
        ]
        slopes.append(log_slope(*(scales if one.changed is None else by_one_film(ends, losses))))
    normals = np.random.default_rng(seed).standard_normal((draws, len(inputs)))
    return np.asarray(np.exp(normals @ np.array(slopes)) @ power)
