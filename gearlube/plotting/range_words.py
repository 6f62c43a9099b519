"""Names in reports of the ranges of formulas and tables that an axle can leave."""

from __future__ import annotations

import re
from collections.abc import Sequence

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


def usable_words(inside: Array, axes: Sequence[tuple[Array, str]]) -> str:
    """Return for which part of a grid results are usable, and for which not.

    Parameters
    ----------
    inside : ndarray of bool
        No formula or table is left; one to three axes, with a point outside.
    axes : sequence of (ndarray, str)
        Ascending values and unit of each axis.

    Examples
    --------
    >>> inside = np.array([[True, True, False], [True, False, False]])
    >>> usable_words(inside, [(np.array([40, 90]), "°C"), (np.array([50, 100, 150]), "N·m")])
    'Usable for 40 °C, 50 to 100 N·m (33 % of the points), not for 150 N·m.'
    """
    block = _largest_block(inside.reshape((1,) * (3 - inside.ndim) + inside.shape))
    if block is None:
        return "Usable for no point."
    parts = block[3 - inside.ndim :]
    share = 100.0 * inside[parts].size / inside.size
    good = [_span(values[part], unit) for part, (values, unit) in zip(parts, axes, strict=True)]
    bad = []
    for number, (values, unit) in enumerate(axes):
        nowhere = ~inside.any(axis=tuple(i for i in range(inside.ndim) if i != number))
        edges = np.flatnonzero(np.diff(nowhere)) + 1
        runs = zip(np.split(values, edges), np.split(nowhere, edges), strict=True)
        bad += [_span(run, unit) for run, out in runs if out[0]]
    rest = f"not for {' or '.join(bad)}" if bad else "beyond it some points are extrapolated"
    return f"Usable for {', '.join(good)} ({share:.0f} % of the points), {rest}."


def _span(values: Array, unit: str) -> str:
    first, last = (f"{one:.3g}" if abs(one) < 1e3 else f"{one:.0f}" for one in values[[0, -1]])
    return f"{first} {unit}" if first == last else f"{first} to {last} {unit}"


def _largest_block(inside: Array) -> tuple[slice, ...] | None:
    """Return the block with the most points of a grid (n, m, k) in which all are inside."""
    best = 0
    found: tuple[slice, ...] | None = None
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
