"""Series of a mesh table from samples over a mesh period."""

from __future__ import annotations

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.mesh_table.table import PAIRS

ORDERS = 5  # mesh orders kept of each series at least, zero where positions do not resolve them
_POSITIONS_PER_ORDER = 4  # the corners of a series fold what is above half of them onto the rest
ZERO_PHASE = -0.5 * PAIRS  # of tooth pair 0 at pinion angle zero, so that it meets mid-window


def orders_kept(positions: int) -> int:
    """Return the highest mesh order kept of so many positions in a mesh period [-]."""
    return max(ORDERS, positions // _POSITIONS_PER_ORDER)


def fourier(samples: Array, orders: int) -> Array:
    """Return the (orders + 1, 2) cosine and sine coefficients of samples over one mesh period.

    The mesh phase of the first sample is zero; the series counts from the pinion angle at which
    the phase is `ZERO_PHASE`.
    """
    spectrum = np.zeros(orders + 1, dtype=complex)
    resolved = min(orders, (samples.size - 1) // 2)  # an order needs more than two samples
    spectrum[: resolved + 1] = (np.fft.rfft(samples) / samples.size)[: resolved + 1]
    order = np.arange(orders + 1)
    # value(angle) = samples(phase = angle + ZERO_PHASE)
    spectrum = spectrum * np.exp(2j * np.pi * order * ZERO_PHASE)
    result = np.stack([2.0 * spectrum.real, -2.0 * spectrum.imag], axis=1)
    result[0] = spectrum[0].real, 0.0
    return result
