"""The loss map on the grid of heavy-duty axle tests: speeds and torques of the wheels.

[european_commission_2017] could not be read where it sets grid, oil temperature and what is added
for uncertainty; docs/loss_map.md says where they are from.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from gearlube.studies.loss_map.sampling import spread_of
from gearlube.studies.loss_map.settings import LossMapSettings
from gearlube_core.arrays import Array
from gearlube_core.dynamics.hypoid_axle.losses import FAILURES, axle_losses
from gearlube_core.dynamics.hypoid_axle.model import torque_limits
from gearlube_core.errors import ParameterError
from gearlube_core.progress import Progress, no_progress
from gearlube_core.units import celsius_to_kelvin, rads_to_rpm, rpm_to_rads

OIL_DEGC = 70.0
SPEED_STEP = 50.0  # rpm of the wheels
TORQUE_STEPS = (  # N.m of both wheels: up to the first, in steps of the second
    (1000.0, 250.0),
    (2000.0, 500.0),
    (10_000.0, 1000.0),
    (np.inf, 2000.0),
)
FREE_SHARE, FREE_TORQUE = 0.05, 1.0  # of the loss, and [N.m], of which the larger is not added
_ROUNDS, _SETTLED = 30, 1e-9  # N.m
_LEAST_DRAWS = 20  # from which an upper end of 97.5 % says something


@dataclass(frozen=True, slots=True, kw_only=True)
class RegulationMap:
    """Losses at round speeds and torques of the wheels; a row for each point.

    Parameters
    ----------
    speed : ndarray of shape (n,)
        Of the pinion [rpm].
    torque, loss : ndarray of shape (n,)
        On the pinion, below 0 for coast, and lost, at the pinion [N.m].
    wheel_speed, wheel_torque : ndarray of shape (n,)
        Of the wheels [rpm], of both together [N.m].
    """

    speed: Array
    torque: Array
    loss: Array
    wheel_speed: Array
    wheel_torque: Array


def wheel_torques(highest: float) -> Array:
    """Return the torques of the grid up to `highest` [N.m], 0 among them.

    Examples
    --------
    >>> wheel_torques(3500.0).astype(int).tolist()
    [0, 250, 500, 750, 1000, 1500, 2000, 3000]
    """
    nodes = [0.0]
    for end, step in TORQUE_STEPS:
        while nodes[-1] < end and nodes[-1] + step <= highest:
            nodes.append(nodes[-1] + step)
    return np.array(nodes)


def regulation_map(
    settings: LossMapSettings, *, raised: bool = False, progress: Progress = no_progress
) -> RegulationMap:
    """Return the losses at 70 degC oil on the grid of wheel speeds and wheel torques.

    Parameters
    ----------
    settings
        Axle; the highest speed and the ends of the torques bound the grid. Its temperatures do
        not matter.
    raised
        Add to the loss its uncertainty less the larger of 5 % of it and 1 N.m, if that is above
        0. The uncertainty is that of the computed loss, to the end that 97.5 % of the draws stay
        below.
    progress
        Called with the share that is done and a sentence.

    Raises
    ------
    ParameterError
        No torque of the grid lies within the settings; `raised` with fewer than 20 draws; oil
        whose data leave out 70 degC; a point failed.

    Notes
    -----
    The torque of the pinion is that of the wheels over the ratio plus the loss torque, by
    iteration. A torque that needs more than the settings' ends at any speed is left out at all.
    The rows at rest repeat the loss of the lowest speed: friction from rest is not computed.
    """
    if raised and settings.draws < _LEAST_DRAWS:
        raise ParameterError(
            f"draws must be at least {_LEAST_DRAWS} if the loss is raised by its error bar, got "
            f"{settings.draws}. Take 60, or do not raise the loss."
        )
    axle, ratio = settings.axle, settings.axle.mesh.ratio
    torques, speeds, _ = settings.grid
    limits = torque_limits(axle)
    low, high = max(torques[0], limits.pinion_low), min(torques[-1], limits.pinion_high)
    count = int(rads_to_rpm(float(speeds[-1])) / ratio / SPEED_STEP + 1e-9)
    wheels = np.concatenate(
        [-wheel_torques(-low * ratio)[:0:-1], wheel_torques(max(0.0, high) * ratio)]
    )
    if count < 1 or wheels.size < 2:
        raise ParameterError(
            f"The grid must have a wheel speed of {SPEED_STEP:g} rpm and a wheel torque of "
            f"{TORQUE_STEPS[0][1]:g} N.m, got pinion speeds up to "
            f"{rads_to_rpm(float(speeds[-1])):.4g} rpm and torques of {low:.4g} to {high:.4g} N.m "
            f"at a ratio of {ratio:.4g}. Take larger ones."
        )
    carried, lost = np.empty((count, wheels.size)), np.empty((count, wheels.size))
    for j in range(count):
        progress(j / count, "losses at wheel torques")
        turning = rpm_to_rads(SPEED_STEP * (j + 1)) * ratio
        carried[j], lost[j] = _at_wheels(settings, wheels / ratio, turning, low, high)
    within = np.all((carried >= low) & (carried <= high), axis=0)
    if raised:
        for j in range(count):
            progress(j / count, "error bars")
            turning = rpm_to_rads(SPEED_STEP * (j + 1)) * ratio
            lost[j, within] += _excess(settings, carried[j, within], lost[j, within], turning)
    # pinion torque and loss at the lowest speed hold at rest as well
    carried, lost = (np.concatenate([one[:1], one])[:, within] for one in (carried, lost))
    shape = carried.shape
    wheel_speed = np.broadcast_to(SPEED_STEP * np.arange(count + 1)[:, None], shape)
    wheel_torque = np.broadcast_to(wheels[within], shape)
    loss = lost.ravel()
    return RegulationMap(
        speed=(wheel_speed * ratio).ravel(),
        torque=wheel_torque.ravel() / ratio + loss,
        loss=loss,
        wheel_speed=wheel_speed.ravel(),
        wheel_torque=wheel_torque.ravel(),
    )


def _at_wheels(
    settings: LossMapSettings, asked: Array, speed: float, low: float, high: float
) -> tuple[Array, Array]:
    """Return pinion torques that leave `asked` [N.m] at the wheels over the ratio, and the loss.

    The loss of a torque beyond the ends is that of the end.
    """
    carried = asked.copy()
    for _ in range(_ROUNDS):
        found = axle_losses(
            settings.axle,
            torques=np.clip(carried, low, high),
            speeds=np.array([speed]),
            temperatures=np.array([celsius_to_kelvin(OIL_DEGC)]),
            extremes=False,
        )
        failed = np.flatnonzero(found.status[0, 0])
        if failed.size:
            raise ParameterError(
                f"The loss must be found at every point, but none was found at {speed:.4g} rad/s "
                f"and {carried[failed[0]]:.4g} N.m: {FAILURES[int(found.status[0, 0, failed[0]])]}"
            )
        lost = found.total[0, 0] / speed
        change = float(np.abs(asked + lost - carried).max())
        carried = asked + lost
        if change < _SETTLED:
            return carried, lost
    raise ParameterError(
        f"The iteration of the pinion torque with the losses must settle to within {_SETTLED:g} "
        f"N.m, got a change of {change:.2g} N.m in the last round. The losses grow faster than the "
        "torque. Check oil and roughness."
    )


def _excess(settings: LossMapSettings, torques: Array, lost: Array, speed: float) -> Array:
    """Return by what the uncertainty of the loss exceeds what is free [N.m]."""
    here = replace(
        settings,
        torques=torques,
        speeds=np.array([speed]),
        temperatures=np.array([celsius_to_kelvin(OIL_DEGC)]),
    )
    high = spread_of(here).high[0, 0] / speed
    return np.maximum(0.0, high - lost - np.maximum(FREE_SHARE * lost, FREE_TORQUE))
