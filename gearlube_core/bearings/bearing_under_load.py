"""Where a load puts the inner ring of a rolling bearing, and the stiffness there."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple, Protocol

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.bearings.ring_loads import (
    N_RING,
    RingLoads,
    RingMotion,
    Rings,
    ring_loads,
    ring_pressure,
    ring_stiffness,
)
from gearlube_core.checks import check_within
from gearlube_core.errors import ConvergenceError, ParameterError

MOST_LOAD = 1e8  # N, and N.m
_NAMES = ("F_x", "F_y", "F_z", "M_x", "M_y")
_UNITS = ("N", "N", "N", "N.m", "N.m")
_ARM = 0.03  # m, of the turns that compare with displacements
_SMALL = 1e-6  # m: the first search moves the ring about so far
_FAR = 2e-3  # m, beyond which no element carries the load
_STEPS = 400
_SETTLED = 1e-13  # of the load


class UnderLoad(NamedTuple):
    """The inner ring of a bearing under a load."""

    displacement: Array  # x, y, z [m], rx, ry [rad] relative to the outer ring, shape (5,)
    stiffness: Array  # d(load)/d(displacement) [N/m], [N/rad], [N.m/rad], shape (5, 5)
    loads: RingLoads
    pressure: float  # largest Hertz pressure on the inner ring [Pa]


class HasRings(Protocol):
    """A bearing in words, such as an element of a train."""

    def rings(self) -> tuple[Rings, Array]:
        """Return its numbers for kernels, and the gaps of laminae [m], empty for balls."""


def bearing_under_load(
    bearing: HasRings, load: Sequence[float], *, cage_angle: float = 0.0
) -> UnderLoad:
    """Return position and stiffness of a bearing whose inner ring bears a load.

    Parameters
    ----------
    bearing : BallBearing or CylindricalBearing
        With its clearance and offset. Its place in a train and its damping play no part.
    load : sequence of 5 float
        F_x, F_y, F_z [N], M_x, M_y [N.m] on the inner ring, in the middle of the bearing.
    cage_angle : float
        Of the first element, from x towards y [rad].

    Returns
    -------
    UnderLoad
        The stiffness is that of the train's own kernel: the tangent at this load.

    Raises
    ------
    ParameterError
        The load has not five finite numbers.
    ConvergenceError
        No position bears this load.

    Notes
    -----
    The energy is a convex function of the displacement, so that the position is found from any
    start; a direction without load and stiffness stays where it is.

    Examples
    --------
    >>> import gearlube as gl
    >>> bearing = gl.train.BallBearing(
    ...     name="6205", body="shaft", n_balls=9, ball_diameter=7.94e-3, pitch_diameter=38.5e-3,
    ...     inner_groove=0.52, outer_groove=0.53, f0=2.0, f1=3e-4,
    ... )
    >>> found = gl.bearing.bearing_under_load(bearing, [2000.0, 0.0, 0.0, 0.0, 0.0])
    >>> shift, stiffness = float(found.displacement[0]), float(found.stiffness[0, 0])
    >>> round(1e6 * shift, 1), round(1e-6 * stiffness)  # um, N/um
    (23.1, 130)
    """
    if np.shape(load) != (N_RING,):
        raise ParameterError(
            f"load must be the 5 numbers F_x, F_y, F_z, M_x, M_y, got {np.shape(load)}."
        )
    for name, one, unit in zip(_NAMES, load, _UNITS, strict=True):
        check_within(name, one, -MOST_LOAD, MOST_LOAD, unit)
    rings, gaps = bearing.rings()
    return _search(rings, gaps, np.array(load, dtype=float), float(cage_angle))


def _motion(u: Array, cage_angle: float) -> RingMotion:
    x, y, z, rx, ry = u.tolist()
    return RingMotion(x, y, z, rx, ry, 0.0, 0.0, 0.0, 0.0, 0.0, cage_angle, 0.0)


def _search(rings: Rings, gaps: Array, load: Array, cage_angle: float) -> UnderLoad:
    """Return the least of energy less work by Newton steps, shortened until they lead down."""
    units = np.array([1.0, 1.0, 1.0, 1.0 / _ARM, 1.0 / _ARM])  # moves of one metre
    size = max(1e-9, float(np.abs(units * load).max()))
    u, stiffness = np.zeros(N_RING), np.zeros(N_RING * N_RING)
    softness = _SMALL / size  # of a spring added to all moves

    def state(at: Array) -> tuple[RingLoads, Array, float]:
        found = ring_loads(rings, _motion(at, cage_angle), 0.0, gaps)
        return found, units * (load + np.array(found[:N_RING])), found.energy - float(load @ at)

    found, left, height = state(u)
    for _ in range(_STEPS):
        if np.abs(left).max() <= _SETTLED * size or np.abs(u / units).max() > _FAR:
            break
        ring_stiffness(rings, _motion(u, cage_angle), gaps, stiffness)
        matrix = stiffness.reshape(N_RING, N_RING) * np.outer(units, units)
        move = units * np.linalg.solve(matrix + np.eye(N_RING) / softness, left)
        there, over, low = state(u + move)
        if low <= height or np.abs(over).max() < np.abs(left).max():
            u, found, left, height, softness = u + move, there, over, low, 10.0 * softness
        else:
            softness *= 0.1
    if np.abs(left).max() > 1e-9 * size:
        where = int(np.argmax(np.abs(left)))
        raise ConvergenceError(
            f"no position of the inner ring bears {_NAMES[where]} = {load[where]:g} "
            f"{_UNITS[where]} within {_FAR * 1e3:g} mm. Give the load a direction that the "
            "bearing carries; cylindrical rollers carry none along z without ribs."
        )
    ring_stiffness(rings, _motion(u, cage_angle), gaps, stiffness)
    matrix = stiffness.reshape(N_RING, N_RING).copy()
    return UnderLoad(u, matrix, found, ring_pressure(rings, found))
