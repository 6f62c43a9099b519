"""Load and area of asperities from a table over the film ratio."""

from __future__ import annotations

import math

import numpy as np

from gearlube_core.kernels.jit import kernel


@kernel
def tabled_asperities(film_ratio: float, table: np.ndarray) -> tuple[float, float]:
    """Return mean pressure over E* and share of the area of asperities.

    Straight in ln(pressure) and ln(area) between film ratios; the first row holds below the table;
    beyond its end the last two rows are carried on, which falls as an exponential.

    Parameters
    ----------
    film_ratio
        h/sigma [-].
    table
        Film ratio, mean pressure over E*, share of the area, shape (n, 3), n from 2 on; ratios
        rise and all else is above zero.

    Returns
    -------
    tuple of float
        W_a/(E* A) and A_a/A [-].
    """
    last = table.shape[0] - 1
    if film_ratio <= table[0, 0]:
        return table[0, 1], table[0, 2]
    low, high = 0, last
    while high - low > 1:
        middle = (low + high) // 2
        if table[middle, 0] <= film_ratio:
            low = middle
        else:
            high = middle
    share = (film_ratio - table[low, 0]) / (table[high, 0] - table[low, 0])
    pressure = table[low, 1] * math.exp(share * math.log(table[high, 1] / table[low, 1]))
    area = table[low, 2] * math.exp(share * math.log(table[high, 2] / table[low, 2]))
    return pressure, area
