"""The loss of an axle at one point with its uncertain data drawn."""

from __future__ import annotations

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.dynamics.hypoid_axle.losses import LOSS_SOURCES, axle_losses
from gearlube_core.dynamics.hypoid_axle.parameters import HypoidAxleParameters
from gearlube_core.dynamics.hypoid_axle.uncertain import (
    UPPER_END,
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
    inputs = uncertain_of(axle)
    slopes: list[Array] = []
    for one in inputs:
        ends = []
        for normal in (UPPER_END, -UPPER_END):
            scale = np.ones(len(LOSS_SOURCES))
            changed = changed_axle(one, axle, normal, scale)
            if changed is not axle:
                found = axle_losses(
                    changed,
                    torques=np.array([torque]),
                    speeds=np.array([speed]),
                    temperatures=np.array([temperature]),
                    angles=8,
                    extremes=False,
                )
                scale = found.power[0, 0, 0]
            ends.append(scale)
        slopes.append(log_slope(*ends))
    normals = np.random.default_rng(seed).standard_normal((draws, len(inputs)))
    return np.asarray(np.exp(normals @ np.array(slopes)) @ power)
