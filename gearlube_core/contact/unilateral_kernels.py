"""Vector operations of one conjugate-gradient iteration with proportioning."""

from __future__ import annotations

import math

import numpy as np

from gearlube_core.kernels.jit import kernel


@kernel
def update_separation(
    forces: np.ndarray,
    displacement: np.ndarray,
    gap: np.ndarray,
    arm: np.ndarray,
    rotation: float,
    residual: np.ndarray,
) -> tuple[float, float, float, float, float, float]:
    """Write the angular separation of all cells; return the error of complementarity.

    r = (g + u)/R - delta

    Parameters
    ----------
    forces, displacement, gap, arm
        f [N], u [m], g [m] (inf where a cell is masked) and R [m], shape (n,).
    rotation
        delta [rad]; NaN takes the mean of (g + u)/R over the loaded cells.
    residual
        r [rad], shape (n,), written.

    Returns
    -------
    tuple of float
        delta [rad], sum of r^2 over loaded and over penetrating cells [rad2], sum of f |r R|
        [J], the deepest penetration -r R of an unloaded cell [m], and the sum of (r/R)^2 over
        loaded and penetrating cells [rad2/m2].
    """
    if math.isnan(rotation):
        total, count = 0.0, 0
        for i in range(forces.size):
            if forces[i] > 0.0:
                total += (gap[i] + displacement[i]) / arm[i]
                count += 1
        rotation = total / count
    loaded, penetrating, misfit, deepest, spread = 0.0, 0.0, 0.0, 0.0, 0.0
    for i in range(forces.size):
        r = (gap[i] + displacement[i]) / arm[i] - rotation
        residual[i] = r
        if forces[i] > 0.0:
            loaded += r * r
            misfit += forces[i] * abs(r * arm[i])
        elif r < 0.0:
            penetrating += r * r
            deepest = max(deepest, -r * arm[i])
        if forces[i] > 0.0 or r < 0.0:
            spread += (r / arm[i]) ** 2
    return rotation, loaded, penetrating, misfit, deepest, spread


@kernel
def conjugate_direction(
    forces: np.ndarray,
    residual: np.ndarray,
    arm: np.ndarray,
    factor: float,
    fixed_torque: bool,
    direction: np.ndarray,
    probe: np.ndarray,
) -> None:
    """Update the search direction: t = r + factor t on loaded cells, zero elsewhere.

    Under a fixed torque the mean over loaded cells is taken off, so that no step changes the sum
    of the moments. `direction` holds t [rad]; `probe` receives t/R, the forces that the
    compliance is applied to.
    """
    mean, count = 0.0, 0
    for i in range(forces.size):
        if forces[i] > 0.0:
            direction[i] = residual[i] + factor * direction[i]
            mean += direction[i]
            count += 1
        else:
            direction[i] = 0.0
            probe[i] = 0.0
    mean = mean / count if fixed_torque and count > 0 else 0.0
    for i in range(forces.size):
        if forces[i] > 0.0:
            direction[i] -= mean
            probe[i] = direction[i] / arm[i]


@kernel
def direction_with_penetration(
    forces: np.ndarray,
    residual: np.ndarray,
    arm: np.ndarray,
    fixed_torque: bool,
    direction: np.ndarray,
    probe: np.ndarray,
) -> None:
    """Start a new direction that loads penetrating cells too: t = r - m there and on loaded cells.

    Under a fixed torque m is the mean over these cells; a penetrating cell joins only if r < m,
    for the step would pull it otherwise. Given rotation: m = 0.
    """
    m, settled = 0.0, False
    while not settled:
        total, count, least = 0.0, 0, 0.0
        for i in range(forces.size):
            if forces[i] > 0.0 or residual[i] < m:
                total += residual[i]
                count += 1
        if fixed_torque and count > 0:
            least = total / count
        settled = not least < m
        m = min(m, least)
    for i in range(forces.size):
        joins = forces[i] > 0.0 or residual[i] < m
        direction[i] = residual[i] - m if joins else 0.0
        probe[i] = direction[i] / arm[i]


@kernel
def step_length(
    residual: np.ndarray, direction: np.ndarray, probe: np.ndarray, product: np.ndarray
) -> float:
    """Return tau = r.t / (t/R).A(t/R), the minimum of energy along t; zero where t vanishes."""
    fall, curvature = 0.0, 0.0
    for i in range(direction.size):
        if direction[i] != 0.0:
            fall += residual[i] * direction[i]
            curvature += probe[i] * product[i]
    return fall / curvature if curvature > 0.0 else 0.0


@kernel
def longest_step(forces: np.ndarray, probe: np.ndarray) -> float:
    """Return the largest step f - tau t/R that leaves no force negative; inf if none does."""
    longest = math.inf
    for i in range(forces.size):
        if probe[i] > 0.0:
            longest = min(longest, forces[i] / probe[i])
    return longest


@kernel
def project(
    forces: np.ndarray, probe: np.ndarray, arm: np.ndarray, tau: float, torque: float
) -> None:
    """Step along the direction, release cells in tension and restore the torque, in place.

    f <- max(f - tau t/R, 0),  then  f <- f T / (R.f)  unless the torque is NaN
    """
    total = 0.0
    for i in range(forces.size):
        forces[i] = max(forces[i] - tau * probe[i], 0.0)
        total += arm[i] * forces[i]
    if not math.isnan(torque) and total > 0.0:
        scale = torque / total
        for i in range(forces.size):
            forces[i] *= scale
