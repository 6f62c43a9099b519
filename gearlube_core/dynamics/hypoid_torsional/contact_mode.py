"""Modes of the mesh: ranges of deflection and rate in which the mesh force is smooth.

The mesh force is continuous, its slopes are not: they jump at first contact, where the damping is
built up, and where the damping alone would pull the flanks together. An integrator that keeps one
mode throughout a step, and ends the step where the mode ends, meets no jump.
"""

from __future__ import annotations

from typing import NamedTuple

from gearlube_core.dynamics.flank_force import DAMPING_BUILD_UP, backlash_deflection
from gearlube_core.dynamics.hypoid_torsional.kernel_parameters import TorsionalParameters
from gearlube_core.kernels.jit import kernel

# no contact; damping builds up; damping complete; flanks overlap without force. Below 0: coast
GAP, LAYER, FULL, OPEN = 0, 1, 2, 3


class MeshForce(NamedTuple):
    """Deflection and force of the mesh."""

    f: float  # m
    force: float  # N


@kernel
def contact_mode(x: float, x_rate: float, k: float, p: TorsionalParameters) -> int:
    """Return the mode at transmission error `x` [m], its rate [m/s] and stiffness `k` [N/m]."""
    f = backlash_deflection(x, p.backlash)
    if f == 0.0:
        return GAP
    side = 1 if f > 0.0 else -1
    if p.gated == 0.0:
        return side * FULL
    depth = abs(f)
    if k * depth + min(1.0, depth / DAMPING_BUILD_UP) * p.c * side * x_rate <= 0.0:
        return side * OPEN
    return side * (LAYER if depth < DAMPING_BUILD_UP else FULL)


@kernel
def force_in_mode(
    mode: int, x: float, x_rate: float, k: float, p: TorsionalParameters
) -> MeshForce:
    """Return deflection and force by the law of one mode, continued smoothly outside it.

    Inside the mode this is `gated_force`, or k f + c x' if damping acts in the backlash too.
    """
    if mode == GAP:
        return MeshForce(0.0, p.c * x_rate if p.gated == 0.0 else 0.0)
    f = x if mode > 0 else x + p.backlash
    kind = abs(mode)
    if kind == OPEN:
        return MeshForce(f, 0.0)
    if kind == LAYER:
        depth = f if mode > 0 else -f
        return MeshForce(f, k * f + depth / DAMPING_BUILD_UP * p.c * x_rate)
    return MeshForce(f, k * f + p.c * x_rate)


@kernel
def mode_margin(mode: int, x: float, x_rate: float, k: float, p: TorsionalParameters) -> float:
    """Return how far a state lies within its mode [m]; below 0 outside."""
    if mode == GAP:
        return min(-x, x + p.backlash)
    depth = x if mode > 0 else -(x + p.backlash)
    if p.gated == 0.0:
        return depth
    rate = x_rate if mode > 0 else -x_rate
    kind = abs(mode)
    if kind == OPEN:
        push = depth + min(1.0, depth / DAMPING_BUILD_UP) * p.c * rate / k
        return min(depth, -push)
    if kind == LAYER:
        return min(min(depth, DAMPING_BUILD_UP - depth), DAMPING_BUILD_UP + p.c * rate / k)
    return min(depth - DAMPING_BUILD_UP, depth + p.c * rate / k)
