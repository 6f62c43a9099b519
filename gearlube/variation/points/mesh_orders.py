"""Mesh orders of a periodic signal as quantities of a point."""

from __future__ import annotations

import numpy as np

from gearlube.variation.point_study import Quantity
from gearlube_core.arrays import Array
from gearlube_core.dynamics.helical_pair.linear.periodic_response import harmonics

ORDERS = (1, 2, 3)


def order_quantities(name: str, unit: str, meaning: str) -> tuple[Quantity, ...]:
    """Return the quantities of a signal: peak to peak, and the amplitude of each mesh order."""
    return (
        Quantity(f"{name}_pp", unit, f"{meaning}, peak to peak"),
        *(Quantity(f"{name}_mesh_{k}", unit, f"{meaning}, mesh order {k}") for k in ORDERS),
    )


def order_values(signal: Array) -> list[float]:
    """Return peak to peak and amplitudes of a signal over one mesh period, equal steps.

    Examples
    --------
    >>> phase = np.arange(24) / 24
    >>> [round(one, 9) for one in order_values(3.0 * np.cos(4.0 * np.pi * phase))]
    [6.0, 0.0, 3.0, 0.0]
    """
    return [float(np.ptp(signal)), *map(float, harmonics(signal, len(ORDERS)))]
