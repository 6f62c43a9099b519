"""What reports call the ranges of formulas and tables that an axle can leave."""

from __future__ import annotations

import re

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.dynamics.ranges import RANGE_OUTPUTS
from gearlube_core.units import kelvin_to_celsius

_WORDS = (
    "torque (the mesh table ends)",
    "load of the film formula (Moes number M)",
    "speed and viscosity of the film formula (Moes number L)",
    "traction formula (its pressure, film and temperature together)",
    "film temperature (the oil data end)",
    "Hertz pressure (steel yields)",
)
RANGE_WORDS = dict(zip(RANGE_OUTPUTS[1:], _WORDS, strict=True))


def range_words(output: str) -> str:
    """Return the words for an output that has a range.

    >>> range_words("range.temperature")
    'film temperature (the oil data end)'
    """
    return RANGE_WORDS[output]


def range_text(message: str) -> str:
    """Return the messages of left ranges for a reader: without output names, degC in place of K.

    >>> range_text("range.temperature: film should be within 273.15 to 423.15 K, got 430.15 K.")
    'Film should be within 0 to 150 °C, got 157 °C.'
    """

    def celsius(found: re.Match[str]) -> str:
        low, high, value = (kelvin_to_celsius(float(one)) for one in found.groups())
        return f"within {low:.4g} to {high:.4g} °C, got {value:.4g} °C"

    text = re.sub(r"within ([\d.]+) to ([\d.]+) K, got ([\d.]+) K", celsius, message)
    return re.sub(r"(?:range|film|bearing)\.\w+: (\w)", lambda found: found[1].upper(), text)


def largest_block(inside: Array) -> tuple[slice, slice, slice] | None:
    """Return the block with the most points of a grid in which all points are inside.

    Parameters
    ----------
    inside : ndarray of bool, shape (n, m, k)

    Examples
    --------
    >>> largest_block(np.array([[[True, True, False], [True, True, True]]]))
    (slice(0, 1, None), slice(0, 2, None), slice(0, 2, None))
    """
    best, found = 0, None
    n, m, _ = inside.shape
    for i in range(n):
        for j in range(m):
            all_so_far = np.ones(inside.shape[1:], dtype=bool)
            for i_end in range(i + 1, n + 1):
                all_so_far &= inside[i_end - 1]
                row = np.ones(inside.shape[2], dtype=bool)
                for j_end in range(j + 1, m + 1):
                    row &= all_so_far[j_end - 1]
                    first, length = _longest_run(row)
                    size = (i_end - i) * (j_end - j) * length
                    if size > best:
                        best = size
                        found = slice(i, i_end), slice(j, j_end), slice(first, first + length)
    return found


def _longest_run(row: Array) -> tuple[int, int]:
    """Return start and length of the longest run of True."""
    edges = np.flatnonzero(np.diff(np.concatenate([[False], row, [False]]).astype(np.int8)))
    starts, lengths = edges[::2], edges[1::2] - edges[::2]
    if not lengths.size:
        return 0, 0
    most = int(np.argmax(lengths))
    return int(starts[most]), int(lengths[most])
