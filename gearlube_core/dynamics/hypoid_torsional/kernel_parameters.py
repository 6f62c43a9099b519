"""Parameters of the torsional pair for its kernels, as nested tuples of floats.

Mesh data at one pinion angle as a row of floats, and rows over a mesh period.

Steps are locked to the pinion angle, so that the same angles return every mesh period: rows for
all stages of an integrator are made once and only read inside a time step.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from gearlube_core.arrays import Array
from gearlube_core.contact.greenwood_tripp_1971 import SurfaceParameters
from gearlube_core.contact.solid import SolidParameters
from gearlube_core.dynamics.packed_mesh import N_CHANNELS
from gearlube_core.friction.thermal_eyring_data import ThermalEyringOil, ThermalEyringOptions
from gearlube_core.kernels.jit import kernel
from gearlube_core.mesh_table.kernels import MeshSeries, mesh_series, pair_channels
from gearlube_core.mesh_table.table import PAIRS
from gearlube_core.oil.lubricant_state import LubricantState

K, DK, R_P, R_G, DE = range(5)  # N/m, N/m per rad, m, m, m per rad
PAIRS_AT = 5  # N_CHANNELS values of each pair from here, see `packed_mesh`
N_ROW = PAIRS_AT + PAIRS * N_CHANNELS
_PAIRS = PAIRS
FRICTION_OFF, EVANS_JOHNSON, THERMAL_EYRING = -1.0, 0.0, 1.0
ONE_DOF, TWO_DOF = 1.0, 2.0


@kernel
def mesh_row(
    series: Array, n_orders: int, window: Array, n_nodes: int, z_p: float, phi: float, row: Array
) -> None:
    """Write the mesh data at pinion angle `phi` [rad] into `row`, shape (N_ROW,)."""
    m: MeshSeries = mesh_series(series, n_orders, z_p, phi)
    row[K] = m.k_m
    row[DK] = m.dk_m
    row[R_P] = m.R_p
    row[R_G] = m.R_g
    row[DE] = m.de
    for pair in range(_PAIRS):
        at = PAIRS_AT + pair * N_CHANNELS
        channels = row[at : at + N_CHANNELS]
        pair_channels(window, n_nodes, z_p, phi, pair, N_CHANNELS, channels)


@kernel
def mesh_rows(
    series: Array, n_orders: int, window: Array, n_nodes: int, z_p: float, rows: Array
) -> None:
    """Write the rows at equal angles over one mesh period, shape (2 steps, N_ROW).

    A pair hands its place to the next one from period to period; sums over the pairs do not
    notice.
    """
    count = rows.shape[0]
    for i in range(count):
        phi = 2.0 * math.pi * i / (z_p * count)
        mesh_row(series, n_orders, window, n_nodes, z_p, phi, rows[i])


@kernel
def rows_between(rows: Array, first: int, start: float, end: float, between: Array) -> None:
    """Write the rows at the start, middle and end of a part of a step.

    Parameters
    ----------
    rows : ndarray of shape (2 steps, N_ROW)
        `mesh_rows`; the step has three of them, from `first`, in a circle.
    start, end : float
        Of the part, as shares of the step [-].
    between : ndarray of shape (3, N_ROW)
        Out. The series follow a parabola through the three rows, the flank data, which are
        linear between nodes, straight lines.
    """
    i, j, k = first, first + 1, (first + 2) % rows.shape[0]
    for at in range(3):
        t = start + 0.5 * at * (end - start)
        a = (1.0 - t) * (1.0 - 2.0 * t)
        b = 4.0 * t * (1.0 - t)
        c = t * (2.0 * t - 1.0)
        for n in range(PAIRS_AT):
            between[at, n] = a * rows[i, n] + b * rows[j, n] + c * rows[k, n]
        lower, upper = (i, j) if t < 0.5 else (j, k)
        weight = 2.0 * t if t < 0.5 else 2.0 * t - 1.0
        for n in range(PAIRS_AT, N_ROW):
            between[at, n] = rows[lower, n] + weight * (rows[upper, n] - rows[lower, n])


class TorsionalParameters(NamedTuple):
    """Constants of one gear pair; built by `HypoidTorsionalParameters.kernel_parameters`."""

    form: float  # ONE_DOF or TWO_DOF
    I_p: float  # kg m2
    I_g: float  # kg m2
    z_p: float  # pinion teeth [-]
    ratio: float  # gear teeth / pinion teeth [-]
    R_p0: float  # mean radii [m]
    R_g0: float  # m
    m_eq: float  # kg
    backlash: float  # 2b along the line of action [m]
    c: float  # mesh damping [N s/m]
    gated: float  # 0: damping acts within the backlash too, as printed
    consistent: float  # 1 with the terms that make the mesh conserve energy, 0 as printed
    pinion_torque: float  # mean [N.m]
    ripple: float  # share of the mean that the pinion torque swings by, once a revolution [-]
    instantaneous_load: float  # 1: the load follows R_g/R_p through the mesh, 0: it does not
    hold_gain: float  # speed hold on the pinion [N.m s/rad]
    friction_form: float  # FRICTION_OFF, EVANS_JOHNSON or THERMAL_EYRING
    surface: SurfaceParameters
    solid: SolidParameters
    oil: LubricantState
    along_sliding: float  # 1: entrainment speed as printed, along sliding; 0: vector mean
    thermal_oil: ThermalEyringOil
    thermal: ThermalEyringOptions
