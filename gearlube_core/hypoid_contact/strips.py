"""A strip of rectangular cells along the contact line of a tooth pair."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gearlube_core.arrays import Array
from gearlube_core.checks import check_within
from gearlube_core.hypoid_contact.flank_intersection import HIT, copy_parameters, intersect_line
from gearlube_core.hypoid_contact.gap_map import GapMap, closing_arm, gear_arm, within_tooth
from gearlube_core.hypoid_contact.pair import FlankPair
from gearlube_core.hypoid_contact.placement import Placement
from gearlube_core.hypoid_geometry.flank.cutting_motion import CuttingMotion
from gearlube_core.hypoid_geometry.flank.vectors import Vector
from gearlube_core.kernels.jit import kernel


@dataclass(frozen=True, slots=True, kw_only=True)
class StripSettings:
    """Resolution of a strip.

    Parameters
    ----------
    cells_across, cells_along : int
        Cells across and along the contact line.
    """

    cells_across: int = 32
    cells_along: int = 48

    def __post_init__(self) -> None:
        check_within("cells_across", self.cells_across, 8, 256)
        check_within("cells_along", self.cells_along, 8, 512)


@dataclass(frozen=True, slots=True)
class StripFrame:
    """Frame of a strip: the tangent plane at the middle of the expected contact.

    Parameters
    ----------
    centre : ndarray of shape (3,)
        [m], fixed frame.
    across, along, normal : ndarray of shape (3,)
        Unit vectors; the normal points from the gear to the pinion.
    half_length : float
        Along the contact line [m].
    gear_start, pinion_start : ndarray of shape (3,)
        Cutting parameters of both flanks near the centre.
    """

    centre: Array
    across: Array
    along: Array
    normal: Array
    half_length: float
    gear_start: Array
    pinion_start: Array


@dataclass(frozen=True, slots=True)
class Strip:
    """Gap and arms of the cells of a strip, shape (nx, ny): x across, y along the contact line.

    Parameters
    ----------
    frame : StripFrame
    cell : tuple of float
        Sides of a cell in the tangent plane [m].
    gap : ndarray of shape (nx, ny)
        Along the gear's normals [m]; inf off the teeth.
    arm, gear_arm : ndarray of shape (nx, ny)
        Closing per pinion rotation, and the arm of a normal force about the gear axis [m].
    point, normal : ndarray of shape (nx, ny, 3)
        Gear points [m] and normals towards the pinion, fixed frame.
    area : ndarray of shape (nx, ny)
        Of the cells on the flank [m2].
    gear_parameters, pinion_parameters : ndarray of shape (nx, ny, 3)
        u [m], th, ph [rad] of the facing points.
    """

    frame: StripFrame
    cell: tuple[float, float]
    gap: Array
    arm: Array
    gear_arm: Array
    point: Array
    normal: Array
    area: Array
    gear_parameters: Array
    pinion_parameters: Array

    @property
    def usable(self) -> NDArray[np.bool_]:
        """Whether both flanks exist at a cell, (nx, ny)."""
        return np.isfinite(self.gap)


def contact_line(gaps: GapMap) -> tuple[Array, Array]:
    """Return the least gap of each column of a gap map [m], (n,), and its gear point [m], (n, 3).

    Refined by a parabola through three neighbours in profile direction; inf and NaN where the
    pinion has no flank.
    """
    rotation = np.where(np.isfinite(gaps.gap), gaps.gap, np.inf)
    columns = np.arange(rotation.shape[1])
    row = np.argmin(rotation, axis=0)
    least = rotation[row, columns]
    point = gaps.point[row, columns].copy()
    point[~np.isfinite(least)] = np.nan
    inner = (row > 0) & (row < rotation.shape[0] - 1)
    for j in columns[inner & np.isfinite(least)]:
        i = row[j]
        before, here, after = rotation[i - 1 : i + 2, j]
        bend = before - 2.0 * here + after
        if not math.isfinite(bend) or bend <= 0.0:
            continue
        shift = 0.5 * (before - after) / bend
        least[j] = here - 0.25 * (before - after) * shift
        neighbour = gaps.point[i + (1 if shift > 0.0 else -1), j]
        point[j] += abs(shift) * (neighbour - gaps.point[i, j])
    return least, point


def strip_frame(gaps: GapMap, reach: float) -> StripFrame | None:
    """Return the frame of a strip over the part of the contact line with a gap below `reach`.

    Parameters
    ----------
    gaps : GapMap
    reach : float
        Largest gap [m] that may close. Gaps may be negative.

    Returns
    -------
    StripFrame or None
        None where no gap is within reach.
    """
    least, points = contact_line(gaps)
    inside = least < reach
    if not inside.any():
        return None
    middle = np.where(inside, np.maximum(reach - least, 1e-3 * abs(reach)), 0.0)
    weight = middle[inside] / middle.sum()
    line = points[inside]
    centre = weight @ line
    # where the gear has no flank its points are NaN, which argmin would take for the least
    distance = np.linalg.norm(gaps.point - centre, axis=-1)
    known = np.where(np.isfinite(gaps.gap), distance, np.inf)
    nearest = np.unravel_index(np.argmin(known), gaps.gap.shape)
    normal = gaps.normal[nearest]
    offsets = line - centre
    offsets = offsets - np.outer(offsets @ normal, normal)
    if inside.sum() > 2:
        along = np.linalg.svd(offsets * np.sqrt(weight)[:, None])[2][0]
    else:
        finite = np.isfinite(least)
        ends = points[finite][[0, -1]]
        along = ends[1] - ends[0]
    along = along - (along @ normal) * normal
    along /= np.linalg.norm(along)
    position = offsets @ along
    step = np.linalg.norm(np.diff(points, axis=0), axis=1)
    margin = 1.5 * float(np.nanmedian(step))
    low, high = position.min() - margin, position.max() + margin
    centre = centre + 0.5 * (low + high) * along
    across = np.cross(along, normal)
    return StripFrame(
        centre,
        across,
        along,
        normal,
        0.5 * (high - low),
        gaps.gear_parameters[nearest],
        gaps.pinion_parameters[nearest],
    )


@kernel
def _facing_parameters(
    motion: CuttingMotion, placement: Placement, frame: Array, x: Array, y: Array, start: Array
) -> Array:
    """Return u, th, ph, height over the tangent plane at the cells, (nx, ny, 4), or NaN.

    `frame` stacks centre, across, along, normal. Every search starts from the neighbour towards
    the middle, or from the last success.
    """
    nx, ny = x.size, y.size
    found = np.full((nx, ny, 4), np.nan)
    direction = Vector(frame[3, 0], frame[3, 1], frame[3, 2])
    last = np.array([start[0], start[1], start[2], 0.0])
    mx, my = nx // 2, ny // 2
    for row in range(ny):
        j = my + row if row < ny - my else ny - 1 - row
        inner_j = j - 1 if j > my else j + 1
        for column in range(nx):
            i = mx + column if column < nx - mx else nx - 1 - column
            inner_i = i - 1 if i > mx else i + 1
            parameters = last.copy()
            if i != mx and not np.isnan(found[inner_i, j, 0]):
                copy_parameters(found[inner_i, j], parameters)
            elif j != my and not np.isnan(found[i, inner_j, 0]):
                copy_parameters(found[i, inner_j], parameters)
            o = frame[0] + x[i] * frame[1] + y[j] * frame[2]
            if (
                intersect_line(motion, placement, Vector(o[0], o[1], o[2]), direction, parameters)
                == HIT
            ):
                copy_parameters(parameters, found[i, j])
                last = parameters
    return found


def cut_strip(
    pair: FlankPair,
    gear_angle: float,
    pinion_angle: float,
    frame: StripFrame,
    half_width: float,
    settings: StripSettings,
) -> Strip:
    """Return the strip's cells: both flanks met along the normal of the tangent plane.

    Parameters
    ----------
    pair : FlankPair
    gear_angle, pinion_angle : float
        [rad]
    frame : StripFrame
    half_width : float
        Across the contact line [m].
    settings : StripSettings
        Numbers of cells.
    """
    nx, ny = settings.cells_across, settings.cells_along
    cell = 2.0 * half_width / nx, 2.0 * frame.half_length / ny
    x: Array = (np.arange(nx, dtype=np.float64) - 0.5 * (nx - 1)) * cell[0]
    y: Array = (np.arange(ny, dtype=np.float64) - 0.5 * (ny - 1)) * cell[1]
    stacked = np.stack([frame.centre, frame.across, frame.along, frame.normal])
    gear, pinion = pair.gear, pair.pinion
    on_gear = _facing_parameters(
        gear.motion, pair.gear_placed(gear_angle), stacked, x, y, frame.gear_start
    )
    on_pinion = _facing_parameters(
        pinion.motion, pair.pinion_placed(pinion_angle), stacked, x, y, frame.pinion_start
    )
    return facing_cells(pair, gear_angle, frame, cell, on_gear, on_pinion)


def facing_cells(
    pair: FlankPair,
    gear_angle: float,
    frame: StripFrame,
    cell: tuple[float, float],
    on_gear: Array,
    on_pinion: Array,
    *,
    beyond: bool = False,
) -> Strip:
    """Return gaps and arms of cells whose points on both flanks are known.

    Parameters
    ----------
    pair : FlankPair
    gear_angle : float
        [rad]
    frame : StripFrame
    cell : tuple of float
        Sides of a cell in the tangent plane [m].
    on_gear, on_pinion : ndarray of shape (..., 4)
        u [m], th, ph [rad] of the points and their height over the tangent plane [m].
    beyond : bool
        Whether cells beyond the edges of either tooth have a gap too.
    """
    gear, pinion = pair.gear, pair.pinion
    gear_surface = gear.sample_parameters(on_gear[..., :3])
    pinion_surface = pinion.sample_parameters(on_pinion[..., :3])
    point, normal = pair.gear_in_place(gear_angle, gear_surface.r, gear_surface.normal)
    cosine = normal @ frame.normal
    there = (
        within_tooth(gear, gear_surface.r)
        & within_tooth(pinion, pinion_surface.r)
        & (gear_surface.regularity > 0.0)
        & (pinion_surface.regularity > 0.0)
        & (cosine > 0.5)
    )
    if beyond:
        there = np.isfinite(cosine) & np.isfinite(on_pinion[..., 3])
    removed = gear.removal(gear_surface.r) + pinion.removal(pinion_surface.r)
    gap = np.where(there, (on_pinion[..., 3] - on_gear[..., 3]) * cosine + removed, np.inf)
    arm = closing_arm(pair, point, normal)
    return Strip(
        frame,
        cell,
        np.where(arm > 0.0, gap, np.inf),
        arm,
        gear_arm(pair, point, normal),
        point,
        normal,
        cell[0] * cell[1] / np.where(there, cosine, 1.0),
        on_gear[..., :3],
        on_pinion[..., :3],
    )
