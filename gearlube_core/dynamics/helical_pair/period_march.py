"""Fundamental matrix and forced response of the linear pair over one mesh period."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from gearlube_core.dynamics.helical_pair.contact_points import N_COLUMNS, point_capacity
from gearlube_core.dynamics.helical_pair.kernel_parameters import Array, MeshArrays
from gearlube_core.dynamics.helical_pair.linear_system import (
    LinearSystem,
    event_phases,
    fastest_frequency,
)
from gearlube_core.dynamics.helical_pair.mesh_moments import phase_moments
from gearlube_core.helical_geometry.contact_line import ContactPlane
from gearlube_core.jit import kernel

_MERGED = 1e-10  # phases closer than this are one
_INSIDE = 1e-9  # share of an interval by which its ends are moved inwards: the mesh may jump there


class PeriodMarch(NamedTuple):
    """States over a period are Phi(t) z0 + forced(t); z = (q, q').

    Held at B phases: equally spaced ones and those at which the mesh has kinks or jumps.
    """

    phase: Array  # from 0 to 1, both included, shape (B,)
    sample: np.ndarray  # rows that are equally spaced, from 0, 1 left out, shape (N,)
    transition: Array  # Phi, shape (B, 2n, 2n)
    forced: Array  # response from rest, shape (B, 2n)
    steps: int


class _Entries(NamedTuple):
    """A matrix as its entries that are not zero."""

    row: np.ndarray
    column: np.ndarray
    value: Array


def _entries(matrix: Array) -> _Entries:
    row, column = np.nonzero(matrix)
    return _Entries(row, column, np.ascontiguousarray(matrix[row, column]))


def march_period(
    system: LinearSystem, period: float, samples: int, steps_per_oscillation: int
) -> PeriodMarch:
    """Return states over one mesh period by classical Runge-Kutta steps of fourth order.

    Parameters
    ----------
    system
        n coordinates.
    period
        Of the mesh [s].
    samples
        N, equally spaced.
    steps_per_oscillation
        Steps for one oscillation of the fastest motion; no step spans a kink or jump of the mesh.
    """
    n = len(system.names)
    grid = np.arange(samples + 1) / samples
    breaks = np.sort(np.concatenate((grid, event_phases(system.plane, system.mesh))))
    breaks = breaks[np.append(True, np.diff(breaks) > _MERGED)]
    oscillations = period * fastest_frequency(system) / (2.0 * math.pi)
    steps = np.ceil(np.diff(breaks) * oscillations * steps_per_oscillation).astype(np.int64)
    steps = np.maximum(steps, 1)
    states = np.zeros((breaks.size, 2 * n, 2 * n + 1))
    work, sums = np.zeros((7, n, 2 * n + 1)), np.zeros((7, 2 * n + 1))
    _march(
        states, work, sums, breaks, steps, period, _entries(system.K), system.C,
        _entries(system.E), _entries(system.W), system.f, system.mu, system.damping,
        system.variation, system.plane, system.mesh, system.mean,
        np.empty((point_capacity(system.mesh), N_COLUMNS)), np.empty((3, *system.mean.shape)),
    )  # fmt: skip
    sample = np.searchsorted(breaks, grid[:-1] - _MERGED)
    return PeriodMarch(breaks, sample, states[:, :, :-1], states[:, :, -1], int(steps.sum()))


@kernel
def _march(
    states: Array,
    work: Array,
    sums: Array,
    breaks: Array,
    steps: np.ndarray,
    period: float,
    K: _Entries,
    C: Array,
    E: _Entries,
    W: _Entries,
    f: Array,
    mu: float,
    damping: float,
    variation: float,
    plane: ContactPlane,
    mesh: MeshArrays,
    mean: Array,
    points: Array,
    moments: Array,
) -> None:
    """Fill `states` of shape (B, 2n, 2n + 1); the last column is the forced one."""
    q, v, q_s, v_s, a, q_sum, v_sum = (
        work[0], work[1], work[2], work[3], work[4], work[5], work[6],
    )  # fmt: skip
    n, columns = q.shape
    for i in range(n):
        q[i, i] = 1.0
        v[i, n + i] = 1.0
    for interval in range(steps.size + 1):
        for i in range(n):
            for j in range(columns):
                states[interval, i, j] = q[i, j]
                states[interval, n + i, j] = v[i, j]
        if interval == steps.size:
            break
        start, width = breaks[interval], breaks[interval + 1] - breaks[interval]
        count = steps[interval]
        h = width * period / count
        for step in range(count):
            for stage in range(3):
                at = (step + 0.5 * stage) / count
                at = min(max(at, _INSIDE), 1.0 - _INSIDE)
                phase = start + at * width
                phase_moments(phase, 1.0, mu, plane, mesh, points, moments[stage])
                for i in range(5):
                    for j in range(3):
                        varying = moments[stage, i, j] - mean[i, j]
                        moments[stage, i, j] = mean[i, j] + variation * varying
            _copy(q_s, q)
            _copy(v_s, v)
            _copy(q_sum, q)
            _copy(v_sum, v)
            for stage in range(4):
                _accelerate(
                    q_s, v_s, moments[(stage + 1) // 2], K, C, E, W, f, damping, plane, sums, a
                )
                weight = h / 6.0 if stage in (0, 3) else h / 3.0
                ahead = h if stage == 2 else 0.5 * h
                for i in range(n):
                    for j in range(columns):
                        q_sum[i, j] += weight * v_s[i, j]
                        v_sum[i, j] += weight * a[i, j]
                        q_s[i, j] = q[i, j] + ahead * v_s[i, j]
                        v_s[i, j] = v[i, j] + ahead * a[i, j]
            _copy(q, q_sum)
            _copy(v, v_sum)


@kernel
def _copy(target: Array, source: Array) -> None:
    rows, columns = source.shape
    for i in range(rows):
        for j in range(columns):
            target[i, j] = source[i, j]


@kernel
def _accelerate(
    q: Array,
    v: Array,
    moments: Array,
    K: _Entries,
    C: Array,
    E: _Entries,
    W: _Entries,
    f: Array,
    damping: float,
    plane: ContactPlane,
    sums: Array,
    a: Array,
) -> None:
    """Fill the accelerations of all columns; forces act on the last column only."""
    n, columns = q.shape
    k_m = max(0.0, moments[0, 0]) * plane.cos_b * plane.cos_b
    c_mesh = damping * math.sqrt(k_m)
    for i in range(n):
        rate = C[i] + (c_mesh if i == n - 1 else 0.0)
        for j in range(columns):
            a[i, j] = -rate * v[i, j]
        a[i, columns - 1] += f[i]
    for entry in range(K.value.size):
        row, column, value = K.row[entry], K.column[entry], K.value[entry]
        for j in range(columns):
            a[row, j] -= value * q[column, j]
    # rows 5 and 6 hold the strains, 0 to 4 the sums
    for j in range(columns):
        sums[5, j] = 0.0
        sums[6, j] = 0.0
    for entry in range(E.value.size):
        row, column, value = 5 + E.row[entry], E.column[entry], E.value[entry]
        for j in range(columns):
            sums[row, j] += value * q[column, j]
    for i in range(5):
        g_0, g_1 = moments[i, 0], moments[i, 1]
        for j in range(columns):
            sums[i, j] = g_0 * sums[5, j] + g_1 * sums[6, j]
        sums[i, columns - 1] -= moments[i, 2]
    for entry in range(W.value.size):
        row, column, value = W.row[entry], W.column[entry], W.value[entry]
        for j in range(columns):
            a[row, j] += value * sums[column, j]
