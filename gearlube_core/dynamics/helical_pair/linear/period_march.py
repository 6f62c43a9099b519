"""Fundamental matrix and forced response of the linear pair over one mesh period."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.dynamics.helical_pair.linear.linear_system import (
    LinearSystem,
    MatrixEntries,
    add_product,
    event_phases,
    fastest_frequency,
    matrix_entries,
    system_moments,
)
from gearlube_core.dynamics.helical_pair.mesh.mesh_damping import damping_constant
from gearlube_core.kernels.jit import kernel

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


class SystemEntries(NamedTuple):
    """Constants of a `LinearSystem`, for the kernels."""

    K: MatrixEntries
    C: Array
    E: MatrixEntries
    W: MatrixEntries
    f: Array
    damping: float


def march_period(
    system: LinearSystem, period: float, samples: int, steps_per_oscillation: int
) -> PeriodMarch:
    """Return states over one mesh period by classical Runge-Kutta steps of fourth order.

    Parameters
    ----------
    system
        Linear system of n coordinates.
    period
        Of the mesh [s].
    samples
        N equally spaced samples a period.
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
    entries = SystemEntries(
        K=matrix_entries(system.K),
        C=system.C,
        E=matrix_entries(system.E),
        W=matrix_entries(system.W),
        f=system.f,
        damping=system.damping,
    )
    moments = system_moments(system, _stage_phases(breaks, steps))
    _march(states, work, sums, np.diff(breaks) * period / steps, steps, moments, entries)
    sample = np.searchsorted(breaks, grid[:-1] - _MERGED)
    return PeriodMarch(breaks, sample, states[:, :, :-1], states[:, :, -1], int(steps.sum()))


def _stage_phases(breaks: Array, steps: np.ndarray) -> Array:
    """Return the phases at ends and middles of all steps: 2 steps + 1 of each interval in turn."""
    counts = 2 * steps + 1
    first = np.repeat(np.cumsum(counts) - counts, counts)
    share = (np.arange(counts.sum()) - first) / np.repeat(2 * steps, counts)
    share = np.clip(share, _INSIDE, 1.0 - _INSIDE)
    return np.asarray(np.repeat(breaks[:-1], counts) + share * np.repeat(np.diff(breaks), counts))


@kernel
def _march(
    states: Array,
    work: Array,
    sums: Array,
    time_steps: Array,
    steps: np.ndarray,
    moments: Array,
    p: SystemEntries,
) -> None:
    """Fill `states` of shape (B, 2n, 2n + 1); the last column is the forced one."""
    q, v, q_s, v_s, a, q_sum, v_sum = (
        work[0], work[1], work[2], work[3], work[4], work[5], work[6],
    )  # fmt: skip
    n, columns = q.shape
    row = 0
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
        h = time_steps[interval]
        for _ in range(steps[interval]):
            _copy(q_s, q)
            _copy(v_s, v)
            _copy(q_sum, q)
            _copy(v_sum, v)
            for stage in range(4):
                now = moments[row + (stage + 1) // 2]
                _accelerate(q_s, v_s, now, p, sums, a)
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
            row += 2
        row += 1


@kernel
def _copy(target: Array, source: Array) -> None:
    rows, columns = source.shape
    for i in range(rows):
        for j in range(columns):
            target[i, j] = source[i, j]


@kernel
def _accelerate(
    q: Array, v: Array, moments: Array, p: SystemEntries, sums: Array, a: Array
) -> None:
    """Fill the accelerations of all columns; forces act on the last column only."""
    n, columns = q.shape
    c_mesh = damping_constant(p.damping, moments[0, 0])
    for i in range(n):
        rate = p.C[i] + (c_mesh if i == n - 1 else 0.0)
        for j in range(columns):
            a[i, j] = -rate * v[i, j]
        a[i, columns - 1] += p.f[i]
    add_product(-1.0, p.K, q, a)
    # rows 5 and 6 hold the strains, 0 to 4 the sums
    for j in range(columns):
        sums[5, j] = 0.0
        sums[6, j] = 0.0
    add_product(1.0, p.E, q, sums[5:])
    for i in range(5):
        g_0, g_1 = moments[i, 0], moments[i, 1]
        for j in range(columns):
            sums[i, j] = g_0 * sums[5, j] + g_1 * sums[6, j]
        sums[i, columns - 1] -= moments[i, 2]
    add_product(1.0, p.W, sums, a)
