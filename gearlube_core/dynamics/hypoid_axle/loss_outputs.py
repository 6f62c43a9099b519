"""Kernel that writes the powers lost and the efficiencies of the axle."""

from __future__ import annotations

from gearlube_core.arrays import Array
from gearlube_core.dynamics.hypoid_axle.output_names import (
    AXLE_EFFICIENCY,
    AXLE_EFFICIENCY_BOUND,
    BEARING_LOSS,
    BOUNDARY_LOSS,
    CHURNING_LOSS,
    DAMPING_LOSS,
    DRAG_LOSS_BOUND,
    EFFICIENCY,
    EFFICIENCY_BOUND,
    FRICTION_LOSS,
    LOSS_BOUND,
    ROLLING_LOSS,
    SEAL_LOSS,
)
from gearlube_core.dynamics.hypoid_axle.state import (
    BEARING_DAMPING,
    BEARING_TORQUE,
    BOUNDARY,
    CHURNING,
    DRAG_BOUND,
    FRICTION_BOUND,
    MESH_DAMPING,
    PINION_WORK,
    ROLLING,
    SEALS,
    TIME_IN_STEP,
    VISCOUS,
    WHEEL_WORK,
    WORK_MARK,
)
from gearlube_core.dynamics.mean_power import mean_power
from gearlube_core.kernels.jit import kernel

_IDLE_WORK = 1e-12  # J; no efficiency is stated for less work


@kernel
def write_losses(
    s: Array, rates: Array, friction_bound: float, drag_bound: float, out: Array
) -> None:
    """Write powers lost and efficiencies, averaged over the last communication step.

    The bounds are those of the power lost in flank friction and in the bearings [W], read before
    the first step only.

    Efficiency is 1 - loss/input with the work put in at the side that drives; 0 where no work is
    put in.

    References
    ----------
    [mohammadpour_2015 (20)] [mohammadpour_2015 (21)]
    """
    duration = s[TIME_IN_STEP]
    pinion = mean_power(s, rates, PINION_WORK, WORK_MARK, duration)
    wheel = mean_power(s, rates, WHEEL_WORK, WORK_MARK + 1, duration)
    viscous = mean_power(s, rates, VISCOUS, WORK_MARK + 2, duration)
    boundary = mean_power(s, rates, BOUNDARY, WORK_MARK + 3, duration)
    mesh = mean_power(s, rates, MESH_DAMPING, WORK_MARK + 4, duration)
    rollers = mean_power(s, rates, BEARING_DAMPING, WORK_MARK + 5, duration)
    drag = mean_power(s, rates, BEARING_TORQUE, WORK_MARK + 6, duration)
    churning = mean_power(s, rates, CHURNING, WORK_MARK + 7, duration)
    seals = mean_power(s, rates, SEALS, WORK_MARK + 8, duration)
    rolling = mean_power(s, rates, ROLLING, WORK_MARK + 9, duration)
    friction = viscous + boundary
    out[FRICTION_LOSS] = friction
    out[BOUNDARY_LOSS] = boundary
    out[BEARING_LOSS] = drag
    out[CHURNING_LOSS] = churning
    out[SEAL_LOSS] = seals
    out[ROLLING_LOSS] = rolling
    out[DAMPING_LOSS] = mesh + rollers
    out[EFFICIENCY] = 0.0
    out[AXLE_EFFICIENCY] = 0.0
    idle_power = _IDLE_WORK * (1.0 / duration) if duration > 0.0 else _IDLE_WORK
    put_in = pinion if pinion > 0.0 else -wheel
    if duration > 0.0:
        friction_bound = s[FRICTION_BOUND] * (1.0 / duration)
        drag_bound = s[DRAG_BOUND] * (1.0 / duration)
    out[LOSS_BOUND] = friction_bound
    out[DRAG_LOSS_BOUND] = drag_bound
    out[EFFICIENCY_BOUND] = 0.0
    out[AXLE_EFFICIENCY_BOUND] = 0.0
    if put_in > idle_power:
        out[EFFICIENCY_BOUND] = friction_bound / put_in
        out[AXLE_EFFICIENCY_BOUND] = (friction_bound + drag_bound) / put_in
        out[EFFICIENCY] = 1.0 - friction / put_in
        others = mesh + rollers + drag + churning + seals + rolling
        out[AXLE_EFFICIENCY] = 1.0 - (friction + others) / put_in
