"""Mesh data at the present load, for the flanks in contact."""

from __future__ import annotations

import math
from typing import Any, NamedTuple, TypeAlias

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.dynamics.hypoid_mesh.mesh_force import MeshForceConstants, MeshMotion
from gearlube_core.dynamics.packed_mesh import N_CHANNELS
from gearlube_core.kernels.jit import kernel
from gearlube_core.mesh_table.kernels import (
    MeshSeries,
    blend_levels,
    load_bracket,
    mesh_series,
    transmission_error,
)
from gearlube_core.oil.formula_laws import FORMULA_LAWS, OilLaws

NO_FILM_MODEL = np.zeros(0)


class MeshLevels(NamedTuple):
    """The mesh table at all its loads, the film models of flanks and rollers, laws of the oil.

    Shapes as in `packed_mesh.PackedMesh`.
    """

    levels: Array  # signed pinion torque [N.m]
    series: Array  # Fourier coefficients
    n_orders: int
    windows: Array  # data of the tooth pairs
    n_nodes: int
    film_model: Array = NO_FILM_MODEL  # numbers of a film model, written into; else empty
    roller_model: Array = NO_FILM_MODEL  # likewise of rollers
    laws: OilLaws = FORMULA_LAWS  # the oil's own


@kernel
def series_size(table: MeshLevels) -> int:
    """Return the number of series coefficients at one load, with the tail of `shaft_error`."""
    return table.series.size // table.levels.size


# the same as a plain tuple: Python hands that over 0.6 us faster a call; laws of the oil only if
# it has any of its own
MeshFields: TypeAlias = tuple[Any, ...]


@kernel
def mesh_levels(
    levels: Array,
    series: Array,
    n_orders: int,
    windows: Array,
    n_nodes: int,
    film_model: Array,
    roller_model: Array,
    laws: OilLaws = FORMULA_LAWS,
) -> MeshLevels:
    """Return the table of `MeshFields`; kernels know no defaults of a NamedTuple."""
    return MeshLevels(levels, series, n_orders, windows, n_nodes, film_model, roller_model, laws)


class MeshAtLoad(NamedTuple):
    """The mesh table at one load."""

    series: Array  # shape (series_size(table),)
    n_orders: int
    window: Array  # shape ((n_nodes + 1) * N_CHANNELS,)
    n_nodes: int
    film_model: Array = NO_FILM_MODEL  # as in `MeshLevels`
    roller_model: Array = NO_FILM_MODEL


@kernel
def place_at_load(table: MeshLevels, series: Array, window: Array) -> MeshAtLoad:
    """Return the place of a table at one load, for `blend_mesh`, with the given arrays."""
    return MeshAtLoad(
        series, table.n_orders, window, table.n_nodes, table.film_model, table.roller_model
    )


@kernel
def blend_mesh(load_torque: float, side: float, table: MeshLevels, mesh: MeshAtLoad) -> None:
    """Interpolate the table to the load `load_torque` [N.m] of one side, into `mesh`."""
    bracket = load_bracket(load_torque, side, table.levels, table.levels.size)
    blend_levels(table.series, series_size(table), bracket, mesh.series)
    blend_levels(table.windows, (table.n_nodes + 1) * N_CHANNELS, bracket, mesh.window)


@kernel
def lateral_and_unloaded(
    motion: MeshMotion, m: MeshSeries, series: Array, n_orders: int, z_p: float
) -> float:
    """Return n.(u_p - u_g) - e [m]: what the transmission error holds besides the rotation."""
    lateral = m.n_x * motion.d_x + m.n_y * motion.d_y + m.n_z * motion.d_z
    return lateral - transmission_error(series, n_orders, z_p, motion.angle)


@kernel
def gap_rotation(
    motion: MeshMotion, m: MeshSeries, p: MeshForceConstants, series: Array, n_orders: int
) -> float:
    """Return how far the pinion stands from the middle of the gap [m], along the line of action.

    It decides the side of the mesh data: below 0 the coast flanks', else the drive flanks'.
    In contact it counts the deflection from there, so that it has the sign of the contact.

    Parameters
    ----------
    motion : MeshMotion
    m : MeshSeries
        At motion.angle; read where neither flank touches.
    p : MeshForceConstants
    series : ndarray of shape (N_SERIES * (2 n_orders + 1),)
        Coefficients at the present load.
    """
    rotation = motion.x + 0.5 * p.backlash
    if -p.backlash < motion.x < 0.0:
        rotation -= lateral_and_unloaded(motion, m, series, n_orders, p.z_p)
    return rotation


@kernel
def follow_flank(
    motion: MeshMotion,
    load_torque: float,
    side: float,
    table: MeshLevels,
    p: MeshForceConstants,
    mesh: MeshAtLoad,
) -> tuple[float, float]:
    """Return transmission error [m] and side; the other side where teeth crossed the gap's middle.

    On either side x + b = R_p theta + n.(u_p - u_g) - e, with theta the rotation of the pinion
    against the gear from the middle of the gap: theta and the displacements decide where both
    flanks stand, so x is carried over from one side to the other through theta. Neither flank
    carries force there, so no energy enters; x is kept within the gap for the same reason.

    Where the gap is passed within one step (backlash of a few micrometres or none), the side
    changes in contact: the deflection is scaled so that k_m f^2 / 2 stays.

    Parameters
    ----------
    motion : MeshMotion
    load_torque, side : float
        That the table is read at [N.m], below 0 on the coast flanks.
    table : MeshLevels
        With coast levels.
    p : MeshForceConstants
    mesh : MeshAtLoad
        The table at the present load; rewritten at a change of side.
    """
    x, gap, phi = motion.x, p.backlash, motion.angle
    on_coast = side < 0.0
    if (x <= -gap) if on_coast else (x >= 0.0):
        return x, side
    old = mesh_series(mesh.series, mesh.n_orders, p.z_p, phi)
    separated = -gap < x < 0.0
    rotation = gap_rotation(motion, old, p, mesh.series, mesh.n_orders)
    if (rotation < 0.0) == on_coast:
        return x, side
    side = 1.0 if on_coast else -1.0
    blend_mesh(load_torque, side, table, mesh)
    new = mesh_series(mesh.series, mesh.n_orders, p.z_p, phi)
    if separated:
        x = rotation * new.R_p / old.R_p - 0.5 * gap
        x += lateral_and_unloaded(motion, new, mesh.series, mesh.n_orders, p.z_p)
        return min(0.0, max(-gap, x)), side
    kept = math.sqrt(old.k_m / new.k_m)
    return (x * kept if x >= 0.0 else (x + gap) * kept - gap), side
