"""The motion of the axle at one mesh order, at the speed where the bearing forces are largest."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gearlube.studies.runup.modes import RampModes
from gearlube_core.arrays import Array
from gearlube_core.spectra import OrderBlocks

# channels of the record in the order of modes.COORDINATES; the shafts' speeds give their turning
CHANNELS = (
    "pinion.speed",
    *(f"pinion.displacement.{axis}" for axis in "xyz"),
    "wheel.speed",
    *(f"wheel.displacement.{axis}" for axis in "xyz"),
)
_TURNING = (0, 4)  # of these


@dataclass(frozen=True, slots=True, kw_only=True)
class OperatingShape:
    """Operating deflection shape.

    Parameters
    ----------
    speed : float
        Of the pinion [rad/s].
    mesh_order : int
        Cycles per mesh period [-].
    motion : array of complex
        Amplitude and phase of every coordinate, turning as displacement at the contact [m], shape
        (8,).
    share : array
        Of each mode in the kinetic energy of this motion [-], shape (modes,).
    """

    speed: float
    mesh_order: int
    motion: NDArray[np.complex128]
    share: Array


def loudest(force_track: Array) -> tuple[int, int]:
    """Return block and place of the mesh order with the largest force over all directions.

    `force_track` has shape (blocks, orders, directions).
    """
    total = np.sqrt(np.sum(force_track**2, axis=2))
    block, order = np.unravel_index(int(np.argmax(total)), total.shape)
    return int(block), int(order)


def operating_shape(
    blocks: OrderBlocks, block: int, mesh_order: int, teeth: int, modes: RampModes
) -> OperatingShape:
    """Return the motion in a block of the order analysis of `CHANNELS`."""
    order = teeth * mesh_order
    place = int(np.argmin(np.abs(blocks.order - order)))
    speed = float(blocks.speed[block])
    motion = blocks.amplitude[block, place].copy()
    for at, radius in zip(_TURNING, modes.radii, strict=True):
        motion[at] *= radius / (1j * order * speed)
    # shapes have modal mass 1, so that this is the modal amplitude
    modal = np.abs(modes.shape.T @ (modes.mass * motion)) ** 2
    total = float(np.sum(modes.mass * np.abs(motion) ** 2))
    return OperatingShape(
        speed=speed,
        mesh_order=mesh_order,
        motion=motion,
        share=modal / total if total > 0.0 else np.full(modal.size, math.nan),
    )
