"""How the uncertain data of an axle move its losses, for a band of 95 % at every instant."""

from __future__ import annotations

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.dynamics.hypoid_axle.losses import LOSS_SOURCES, axle_losses
from gearlube_core.dynamics.hypoid_axle.uncertain import (
    UPPER_END,
    by_one_film,
    changed_axle,
    log_slope,
    uncertain_of,
)
from gearlube_core.dynamics.hypoid_mesh.parameters import HypoidAxleParameters
from gearlube_core.errors import ParameterError

N_SOURCES = len(LOSS_SOURCES)
_TORQUES = 0.1, 0.4  # of the largest torque of the mesh table
_SPEEDS = 100.0, 300.0  # rad/s
_TEMPERATURES = 333.15, 363.15  # K, as far as the oil's data go
_ANGLES = 8


def loss_sensitivities(axle: HypoidAxleParameters) -> Array:
    """Return how independent standard normals move the logarithms of an axle's losses.

    Returns
    -------
    ndarray of shape (8, sources)
        A root of the covariance of ln(loss) over `LOSS_SOURCES`: its rows add up as squares.

    Notes
    -----
    Each uncertain datum of `uncertain_of` moves each loss as a power law, with the mean exponent of
    eight points: two torques, speeds and oil temperatures. A datum that would leave its limits is
    left out.

    Examples
    --------
    >>> from gearlube_core.dynamics.hypoid_axle.mohammadpour_2015 import mohammadpour_2015_axle
    >>> rows = loss_sensitivities(mohammadpour_2015_axle())
    >>> seals = np.sqrt((rows**2).sum(axis=0))[LOSS_SOURCES.index("seals")]
    >>> round(float(seals), 4)  # half of ln 2: known to a factor of 2 (k = 2)
    0.3466
    """
    oil, most = axle.oil, axle.torque_range[1]

    def losses(changed: HypoidAxleParameters) -> tuple[Array, Array]:
        solved = changed.film == "solved"
        found = axle_losses(
            changed,
            torques=np.array(_TORQUES) * most,
            speeds=np.array(_SPEEDS),
            temperatures=np.clip(_TEMPERATURES, oil.temperature_low, oil.temperature_high),
            angles=_ANGLES,
            extremes=solved,
        )
        return found.power, found.share_outside if solved else np.zeros(found.power.shape[:-1])

    slopes = []
    for one in uncertain_of(axle):
        scales = [np.ones(N_SOURCES) for _ in range(2)]
        try:
            ends = [
                changed_axle(one, axle, normal, scale)
                for normal, scale in zip((UPPER_END, -UPPER_END), scales, strict=True)
            ]
        except ParameterError:
            continue  # a map refuses such a bar; an axle in motion runs without it
        moved = log_slope(*(scales if one.changed is None else by_one_film(ends, losses)))
        slopes.append(np.nan_to_num(moved.reshape(-1, N_SOURCES)).mean(axis=0))
    covariance = np.array(slopes).T @ np.array(slopes)
    values, vectors = np.linalg.eigh(covariance)
    return np.asarray(np.sqrt(np.maximum(values, 0.0))[:, None] * vectors.T)
