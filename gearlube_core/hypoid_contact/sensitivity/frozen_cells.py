"""The loaded cells of a strip, held where they are while the flanks behind them change."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gearlube_core.arrays import Array, Indices
from gearlube_core.hypoid_contact.gap_map import along_normals
from gearlube_core.hypoid_contact.loaded_contact import LoadedPair
from gearlube_core.hypoid_contact.pair import FlankPair
from gearlube_core.hypoid_contact.placement import Placement, placed_axis, tooth_position
from gearlube_core.hypoid_contact.strips import Strip, StripFrame, facing_cells
from gearlube_core.hypoid_geometry.flank.vectors import Vector
from gearlube_core.tooth_compliance.flank_compliance import FlankCompliance
from gearlube_core.tooth_compliance.hat_grid import bracket
from gearlube_core.tooth_contact.coupled_strips import PairStiffness

_ORIGIN = Vector(0.0, 0.0, 0.0)
_FIXED = Placement(_ORIGIN, Vector(0.0, 0.0, 1.0), 1.0, 0.0, 1.0, 0.0, _ORIGIN)


@dataclass(frozen=True, slots=True)
class CellGeometry:
    """Inputs of the load of n cells, and its results.

    Parameters
    ----------
    gap, arm, gear_arm, area : ndarray of shape (n,)
        As in `Strip` [m], [m], [m], [m2].
    normal : ndarray of shape (n, 3)
        Of the gear, towards the pinion [-].
    weights : ndarray of shape (n, hats)
        On the hats of pinion and gear, W of `interpolation_weights` side by side.
    s, t : ndarray of shape (n,)
        On the gear flank [-].
    sliding : ndarray of shape (n,)
        Sliding speed per pinion speed [m].
    """

    gap: Array
    arm: Array
    gear_arm: Array
    area: Array
    normal: Array
    weights: Array
    s: Array
    t: Array
    sliding: Array


@dataclass(frozen=True, slots=True)
class FrozenCells:
    """Loaded cells of one tooth pair; their places in the tangent plane stay.

    Parameters
    ----------
    gear_angle, pinion_angle : float
        [rad]
    frame : StripFrame
    cell : tuple of float
        Sides of a cell [m].
    row, column : ndarray of int, shape (n,)
        Which cells of the strip.
    origin : ndarray of shape (n, 3)
        Centres of the cells in the tangent plane [m].
    pair : FlankPair
        As it stands.
    on_gear, on_pinion : ndarray of shape (n, 4)
        Its points, as in `facing_cells`.
    """

    gear_angle: float
    pinion_angle: float
    frame: StripFrame
    cell: tuple[float, float]
    row: Indices
    column: Indices
    origin: Array
    pair: FlankPair
    on_gear: Array
    on_pinion: Array

    @classmethod
    def of(cls, pair: FlankPair, loaded: LoadedPair) -> FrozenCells:
        """Return the cells of a tooth pair that carry load."""
        return cls.of_strip(pair, loaded.phase, loaded.strip, loaded.forces > 0.0)

    @classmethod
    def of_strip(
        cls, pair: FlankPair, phase: float, strip: Strip, there: NDArray[np.bool_]
    ) -> FrozenCells:
        """Return some cells, `there` (nx, ny), of the strip of a tooth pair.

        `phase` is that of the tooth pair [mesh periods].
        """
        row, column = np.nonzero(there)
        nx, ny = there.shape
        x = (row - 0.5 * (nx - 1)) * strip.cell[0]
        y = (column - 0.5 * (ny - 1)) * strip.cell[1]
        frame = strip.frame
        origin = frame.centre + x[:, None] * frame.across + y[:, None] * frame.along
        starts = strip.gear_parameters[row, column], strip.pinion_parameters[row, column]
        angles = phase * pair.gear_pitch, phase * pair.pinion_pitch
        empty = np.full((row.size, 4), np.nan)
        cells = cls(*angles, frame, strip.cell, row, column, origin, pair, empty, empty)
        return cls(
            *angles,
            frame,
            strip.cell,
            row,
            column,
            origin,
            pair,
            cells._on_gear(pair, starts[0]),
            cells._on_pinion(pair, starts[1]),
        )

    def geometry(self, pair: FlankPair, stiffness: PairStiffness) -> CellGeometry:
        """Return the cells with the flanks of a pair that differs little from their own."""
        on_gear, on_pinion = self.on_gear, self.on_pinion
        if not _same(pair.gear_placed(0.0), self.pair.gear_placed(0.0), pair.gear, self.pair.gear):
            on_gear = self._on_gear(pair, on_gear[:, :3].copy())
        if not _same(
            pair.pinion_placed(0.0), self.pair.pinion_placed(0.0), pair.pinion, self.pair.pinion
        ):
            on_pinion = self._on_pinion(pair, on_pinion[:, :3].copy())
        strip = facing_cells(
            pair, self.gear_angle, self.frame, self.cell, on_gear, on_pinion, beyond=True
        )
        places = [
            tooth_position(flank, flank.sample_parameters(parameters).r)
            for flank, parameters in (
                (pair.pinion, strip.pinion_parameters),
                (pair.gear, strip.gear_parameters),
            )
        ]
        teeth = (stiffness.pinion, stiffness.gear)
        return CellGeometry(
            strip.gap,
            strip.arm,
            strip.gear_arm,
            strip.area,
            strip.normal,
            np.hstack([_weights(*one, tooth) for one, tooth in zip(places, teeth, strict=True)]),
            *places[1],
            sliding_arm(pair, strip.point, strip.normal),
        )

    def _on_gear(self, pair: FlankPair, starts: Array) -> Array:
        normals = np.broadcast_to(self.frame.normal, self.origin.shape).copy()
        placed = pair.gear_placed(self.gear_angle)
        return along_normals(pair.gear.motion, placed, _FIXED, self.origin, normals, starts)

    def _on_pinion(self, pair: FlankPair, starts: Array) -> Array:
        normals = np.broadcast_to(self.frame.normal, self.origin.shape).copy()
        placed = pair.pinion_placed(self.pinion_angle)
        return along_normals(pair.pinion.motion, placed, _FIXED, self.origin, normals, starts)


def sliding_arm(pair: FlankPair, point: Array, normal: Array) -> Array:
    """Return the sliding speed per pinion speed [m] at points (n, 3) with unit normals (n, 3).

    |(v_p - v_g) - n (n.(v_p - v_g))|,  v_p = j_p x r,  v_g = (z_p / z_g) j_g x r
    """
    axis_p, point_p = placed_axis(pair.pinion, pair.pinion_base)
    axis_g, point_g = placed_axis(pair.gear, pair.gear_base)
    velocity = np.cross(-axis_p, point - point_p) - np.cross(axis_g, point - point_g) / pair.ratio
    velocity -= np.einsum("ni,ni->n", velocity, normal)[:, None] * normal
    return np.asarray(np.linalg.norm(velocity, axis=1))


def _weights(s: Array, t: Array, tooth: FlankCompliance) -> Array:
    """Return the values of all hats at n places, dense: `hat_values` without its bookkeeping."""
    i, u = bracket(s, tooth.s)
    j, v = bracket(t, tooth.t)
    found = np.zeros((s.size, tooth.s.size * tooth.t.size))
    rows, corner = np.arange(s.size), i * tooth.t.size + j
    found[rows, corner] = (1.0 - u) * (1.0 - v)
    found[rows, corner + 1] = (1.0 - u) * v
    found[rows, corner + tooth.t.size] = u * (1.0 - v)
    found[rows, corner + tooth.t.size + 1] = u * v
    return found


def _same(placed: Placement, other: Placement, flank: object, other_flank: object) -> bool:
    return flank is other_flank and placed == other
