"""Evaluation of a mesh table inside a time step."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.kernels.jit import kernel
from gearlube_core.kernels.places import place_below

# order of the series in a packed coefficient array
K_M, R_P, R_G, N_X, N_Y, N_Z, E = range(7)
N_SERIES = 7
SHAFT_HEAD = 3  # numbers before the coefficients of `shaft_error`

_THIRD = 1.0 / 3.0
_WINDOWS_PER_RADIAN = _THIRD / (2.0 * math.pi)


class LoadBracket(NamedTuple):
    """Two neighbouring load levels and the weight of the upper one."""

    lower: int
    upper: int
    weight: float


class MeshSeries(NamedTuple):
    """Values of the series at one pinion angle and, where dynamics needs them, d/d(angle)."""

    k_m: float
    R_p: float
    R_g: float
    n_x: float
    n_y: float
    n_z: float
    dk_m: float
    dn_x: float
    dn_y: float
    dn_z: float
    de: float


@kernel
def load_bracket(torque: float, side: float, levels: Array, n_levels: int) -> LoadBracket:
    """Return the load levels around abs(torque) [N.m] of one side; the end levels hold outside.

    Parameters
    ----------
    torque : float
        Pinion torque [N.m]; its sign does not count.
    side : float
        Below 0: the coast flanks, which have the negative levels, or the drive flanks' data if
        there are none; else the drive flanks.
    levels : ndarray of shape (n_levels,)
        Rising, the last one positive [N.m].
    n_levels : int
    """
    load = abs(torque)
    first = 0
    while levels[first] < 0.0:
        first += 1
    last = n_levels - 1
    if side < 0.0 and first > 0:
        last = first - 1
        first = 0
        load = -load
    if first == last or load <= levels[first]:
        return LoadBracket(first, first, 0.0)
    upper = first + 1
    while upper < last and load > levels[upper]:
        upper += 1
    span = levels[upper] - levels[upper - 1]
    return LoadBracket(upper - 1, upper, min(1.0, (load - levels[upper - 1]) / span))


@kernel
def blend_levels(packed: Array, size: int, bracket: LoadBracket, out: Array) -> None:
    """Interpolate data packed level by level, shape (L * size,), into out, shape (size,)."""
    lower = bracket.lower * size
    upper = bracket.upper * size
    for i in range(size):
        out[i] = packed[lower + i] + bracket.weight * (packed[upper + i] - packed[lower + i])


@kernel
def shaft_error(tail: Array, phi: float) -> float:
    """Return the part of e with periods of the shafts [m].

    Parameters
    ----------
    tail : ndarray of shape (SHAFT_HEAD + 2 (P + Q),)
        P and Q, even, and gear turns per pinion turn; then cosine and sine of orders 1 to P of
        the pinion and of orders 1 to Q of the gear [m].
    phi : float
        Pinion angle [rad]; the gear turns in proportion.
    """
    error = 0.0
    place = SHAFT_HEAD
    step = 1.0
    for member in range(2):
        c1 = math.cos(step * phi)
        s1 = math.sin(step * phi)
        c = 1.0
        s = 0.0
        for _ in range(int(tail[member])):
            c, s = c * c1 - s * s1, s * c1 + c * s1
            error += tail[place] * c + tail[place + 1] * s
            place += 2
        step = tail[2]
    return error


@kernel
def shaft_error_rate(tail: Array, phi: float) -> float:
    """Return the derivative of `shaft_error` by `phi` [m/rad]; arguments as there.

    Odd and even orders turn on side by side: a processor then waits half as long.
    """
    rate = 0.0
    place = SHAFT_HEAD
    step = 1.0
    for member in range(2):
        c_odd = math.cos(step * phi)
        s_odd = math.sin(step * phi)
        c2 = c_odd * c_odd - s_odd * s_odd
        s2 = 2.0 * s_odd * c_odd
        c_even = c2
        s_even = s2
        odd = 0.0
        even = 0.0
        order = 1.0
        for _ in range(int(tail[member]) // 2):
            odd += order * (tail[place + 1] * c_odd - tail[place] * s_odd)
            even += (order + 1.0) * (tail[place + 3] * c_even - tail[place + 2] * s_even)
            c_odd, s_odd = c_odd * c2 - s_odd * s2, s_odd * c2 + c_odd * s2
            c_even, s_even = c_even * c2 - s_even * s2, s_even * c2 + c_even * s2
            order += 2.0
            place += 4
        rate += step * (odd + even)
        step = tail[2]
    return rate


@kernel
def mesh_series(coefficients: Array, n_orders: int, z_p: float, phi: float) -> MeshSeries:
    """Return all series at pinion angle `phi` [rad].

    `coefficients` has shape (N_SERIES * (2 n_orders + 1),): the series are grouped by order,
    first the means, then for each order h the N_SERIES cosine and the N_SERIES sine coefficients.
    What follows, if anything, is the `tail` of `shaft_error`.

    Notes
    -----
    Source: [mohammadpour_2015 (5)], which prints n phi_p for n z_p phi_p; [karagiannis_2012 (26)].
    """
    k = coefficients[K_M]
    rp = coefficients[R_P]
    rg = coefficients[R_G]
    nx = coefficients[N_X]
    ny = coefficients[N_Y]
    nz = coefficients[N_Z]
    dk = 0.0
    dnx = 0.0
    dny = 0.0
    dnz = 0.0
    de = 0.0
    c1 = math.cos(z_p * phi)
    s1 = math.sin(z_p * phi)
    c = 1.0
    s = 0.0
    for h in range(1, n_orders + 1):
        c, s = c * c1 - s * s1, s * c1 + c * s1
        i = N_SERIES * (2 * h - 1)
        j = i + N_SERIES
        w = h * z_p
        k += coefficients[i + K_M] * c + coefficients[j + K_M] * s
        rp += coefficients[i + R_P] * c + coefficients[j + R_P] * s
        rg += coefficients[i + R_G] * c + coefficients[j + R_G] * s
        nx += coefficients[i + N_X] * c + coefficients[j + N_X] * s
        ny += coefficients[i + N_Y] * c + coefficients[j + N_Y] * s
        nz += coefficients[i + N_Z] * c + coefficients[j + N_Z] * s
        dk += w * (coefficients[j + K_M] * c - coefficients[i + K_M] * s)
        dnx += w * (coefficients[j + N_X] * c - coefficients[i + N_X] * s)
        dny += w * (coefficients[j + N_Y] * c - coefficients[i + N_Y] * s)
        dnz += w * (coefficients[j + N_Z] * c - coefficients[i + N_Z] * s)
        de += w * (coefficients[j + E] * c - coefficients[i + E] * s)
    size = N_SERIES * (2 * n_orders + 1)
    if coefficients.size > size:
        de += shaft_error_rate(coefficients[size:], phi)
    return MeshSeries(k, rp, rg, nx, ny, nz, dk, dnx, dny, dnz, de)


@kernel
def transmission_error(coefficients: Array, n_orders: int, z_p: float, phi: float) -> float:
    """Return e [m] at pinion angle `phi` [rad]; `coefficients` as in `mesh_series`."""
    c1 = math.cos(z_p * phi)
    s1 = math.sin(z_p * phi)
    c = 1.0
    s = 0.0
    e = coefficients[E]
    for h in range(1, n_orders + 1):
        c, s = c * c1 - s * s1, s * c1 + c * s1
        i = N_SERIES * (2 * h - 1)
        e += coefficients[i + E] * c + coefficients[i + N_SERIES + E] * s
    size = N_SERIES * (2 * n_orders + 1)
    if coefficients.size > size:
        e += shaft_error(coefficients[size:], phi)
    return e


@kernel
def pair_node(n_nodes: int, z_p: float, phi: float, pair: int) -> tuple[int, float]:
    """Return the node of the window before a tooth pair, and how far it is on to the next one."""
    position = z_p * phi * _WINDOWS_PER_RADIAN + pair * _THIRD
    position = (position - np.floor(position)) * n_nodes
    node = place_below(position, n_nodes)
    return node, position - node


@kernel
def pair_channels(
    window: Array, n_nodes: int, z_p: float, phi: float, pair: int, n_channels: int, out: Array
) -> None:
    """Interpolate the window channels of one tooth pair into out, shape (n_channels,).

    `window` has shape ((n_nodes + 1) * n_channels,), the first node repeated at the end. Linear
    between nodes, so that shares that sum to 1 at the nodes do so everywhere. The first channel is
    the share; the others are left alone where it is zero.

    Notes
    -----
    Windows of whole mesh periods in place of the flank functions.
    Source: [karagiannis_2012 (27)] [karagiannis_2012 (28)] [karagiannis_2012 (29)]
    """
    node, t = pair_node(n_nodes, z_p, phi, pair)
    a = node * n_channels
    b = a + n_channels
    out[0] = window[a] + t * (window[b] - window[a])
    if out[0] > 0.0:
        for i in range(1, n_channels):
            out[i] = window[a + i] + t * (window[b + i] - window[a + i])
