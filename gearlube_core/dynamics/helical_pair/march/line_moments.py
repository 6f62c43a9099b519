"""Sums along the part of a contact line that touches all along, from kept moments: kernels.

Loads and energy of such a part follow from integrals of k t^n, k e t^n and k e^2 along its
stations t. These moments are polynomials of the part of the way to the next phase of the mesh. They
are computed once for a line at a phase and a level of load, and kept in the pair data.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.dynamics.flank_force import DAMPING_BUILD_UP
from gearlube_core.dynamics.helical_pair.march.mesh_data import (
    LEVEL,
    LINE_HEAD,
    N_MOMENTS,
    STATIONS_AT,
)
from gearlube_core.kernels.jit import kernel

_THREE_APART = 0.3872983346207417  # sqrt(15)/10: of three Gauss points, the outer from the middle

# Moments up to a station: first coefficients of k t^n, n = 0 to 3, of k e t^n, n = 0 to 2, and of
# k e^2; then the coefficients of the part itself, of its square (no k), and of its cube (k e^2).
_E, _EE = 4, 7
LINEAR, _SQUARE, _CUBE = 8, 12, 13  # from a first coefficient to the others


class CellEnds(NamedTuple):
    """k and e at both ends of the piece between two stations, and their growth to next phase."""

    k_a: float  # [N/m2]
    k_b: float
    e_a: float  # [m]
    e_b: float
    dk_a: float
    dk_b: float
    de_a: float
    de_b: float


@kernel
def cell_ends(here: int, after: int, to_offset: int, part: float, data: Array) -> CellEnds:
    """Return a piece of a line at a part of the way between two phases of the mesh.

    `here` and `after` are the places in the pair data of the density at its first station at both
    phases; `to_offset` further are the offsets.
    """
    k_a = data[here]
    k_b = data[here + 1]
    e_a = data[here + to_offset]
    e_b = data[here + to_offset + 1]
    dk_a = data[after] - k_a
    dk_b = data[after + 1] - k_b
    de_a = data[after + to_offset] - e_a
    de_b = data[after + to_offset + 1] - e_b
    k_a += part * dk_a
    k_b += part * dk_b
    e_a += part * de_a
    e_b += part * de_b
    return CellEnds(k_a, k_b, e_a, e_b, dk_a, dk_b, de_a, de_b)


@kernel
def fill_moments(here: int, after: int, to_offset: int, at: int, n_s: int, data: Array) -> None:
    """Write the head of a line and its moments from its start to each of `n_s` stations.

    The head has the level they are for, and the greatest offset. `at` is its place; other arguments
    as in `cell_ends`.
    """
    data[at] = data[LEVEL]
    data[at + 1] = -math.inf
    for c in range(to_offset, to_offset + n_s):
        data[at + 1] = max(data[at + 1], data[here + c], data[after + c])
    to = at + LINE_HEAD
    for j in range(N_MOMENTS):
        data[to + j] = 0.0
    for c in range(n_s - 1):
        cell = cell_ends(here + c, after + c, to_offset, 0.0, data)
        t_a = data[STATIONS_AT + c]
        width = data[STATIONS_AT + c + 1] - t_a
        to += N_MOMENTS
        for j in range(N_MOMENTS):
            data[to + j] = data[to - N_MOMENTS + j]
        for point in range(3):  # exact: the integrands are of at most fourth degree
            u = 0.5 + (point - 1) * _THREE_APART
            weight = (4.0 if point == 1 else 2.5) / 9.0 * width
            k = cell.k_a + u * (cell.k_b - cell.k_a)
            e = cell.e_a + u * (cell.e_b - cell.e_a)
            dk = cell.dk_a + u * (cell.dk_b - cell.dk_a)
            de = cell.de_a + u * (cell.de_b - cell.de_a)
            data[to + _EE] += weight * k * e * e
            data[to + _EE + LINEAR] += weight * e * (2.0 * k * de + dk * e)
            data[to + _EE + _SQUARE] += weight * de * (k * de + 2.0 * dk * e)
            data[to + _EE + _CUBE] += weight * dk * de * de
            for n in range(4):
                data[to + n] += weight * k
                data[to + n + LINEAR] += weight * dk
                if n < 3:
                    data[to + _E + n] += weight * k * e
                    data[to + _E + n + LINEAR] += weight * (k * de + dk * e)
                    data[to + _E + n + _SQUARE] += weight * dk * de
                weight *= t_a + u * width


@kernel
def moment(place: int, start: int, end: int, data: Array) -> float:
    """Return a coefficient of a moment between two stations, whose moments lie where given."""
    return data[np.uint64(end + place)] - data[np.uint64(start + place)]


@kernel
def load_moment(
    n: int, b0: float, b1: float, start: int, end: int, part: float, data: Array
) -> float:
    """Return the integral of k (b0 + b1 t - e) t^n between two stations, as `moment` does."""
    found = -moment(n + _E + _SQUARE, start, end, data)
    for i in (n + LINEAR, n):
        found *= part
        found += b0 * moment(i, start, end, data) + b1 * moment(i + 1, start, end, data)
        found -= moment(i + _E, start, end, data)
    return found


@kernel
def energy_and_growth(
    b0: float, b1: float, start: int, end: int, part: float, data: Array
) -> tuple[float, float]:
    """Return the integral of k (b0 + b1 t - e)^2 as `load_moment` does, and d/dpart of it."""
    cubic = moment(_EE + _CUBE, start, end, data)
    square = moment(_EE + _SQUARE, start, end, data)
    square -= 2.0 * b0 * moment(_E + _SQUARE, start, end, data)
    square -= 2.0 * b1 * moment(_E + _SQUARE + 1, start, end, data)
    linear = constant = 0.0
    for i in (LINEAR, 0):
        linear = constant
        constant = moment(i + _EE, start, end, data)
        constant += b0 * b0 * moment(i, start, end, data)
        constant += 2.0 * b0 * b1 * moment(i + 1, start, end, data)
        constant += b1 * b1 * moment(i + 2, start, end, data)
        constant -= 2.0 * b0 * moment(i + _E, start, end, data)
        constant -= 2.0 * b1 * moment(i + _E + 1, start, end, data)
    energy = constant + part * (linear + part * (square + part * cubic))
    return energy, linear + part * (2.0 * square + part * 3.0 * cubic)


@kernel
def built_up_stations(
    b0: float, b1: float, here: int, after: int, to_offset: int, part: float, n_s: int, data: Array
) -> tuple[int, int]:
    """Return the ends of the first row of stations with damping built up; both `n_s` without one.

    delta is b0 + b1 t; other arguments as in `fill_moments` and `cell_ends`.
    """
    low = high = n_s
    for c in range(n_s):
        e = data[here + to_offset + c]
        e += part * (data[after + to_offset + c] - e)
        if b0 + b1 * data[STATIONS_AT + c] - e >= DAMPING_BUILD_UP:
            low = min(low, c)
            high = c
        elif low < n_s:
            break
    return low, high
