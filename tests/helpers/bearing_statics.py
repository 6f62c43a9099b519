"""Stiffness, natural frequencies and static displacement of a shaft in two opposed bearings."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from gearlube_core.bearings.parameters import FILM_FLOOR_APPROACH, BearingParameters
from gearlube_core.bearings.roller_contact import approach_with_film, film_amplitude, film_and_slope
from gearlube_core.errors import ConvergenceError

_CAGE_ANGLES = 32  # cage positions within one roller pitch for an average


def forces_and_stiffness(
    p: BearingParameters,
    displacement: Sequence[float] | np.ndarray,
    cage_angle: float,
    *,
    shaft_speed: float = 0.0,
    eta0: float = 1.0,
    alpha: float = 1.0,
) -> tuple[np.ndarray, np.ndarray]:
    """Return the quasi-steady force on the shaft and the stiffness -dF/du at one cage angle.

    K = sum over sides and rollers of a w'(g) e e^T, e = (cos th cos L, sin th cos L, s sin L).

    Parameters
    ----------
    p : BearingParameters
        The bearing on either side.
    displacement : sequence of 3 floats
        u = (r1, r2, xa) [m].
    cage_angle : float
        [rad].
    shaft_speed, eta0, alpha : float
        Operating point of the film [rad/s], [Pa s], [1/Pa]; no film at rest.

    Returns
    -------
    tuple of ndarray, shapes (3,) and (3, 3)
        F [N], K [N/m].
    """
    film, _ = film_amplitude(shaft_speed, eta0, alpha, p)
    u = np.asarray(displacement, dtype=float)
    count = int(p.n_rollers)
    force = np.zeros(3)
    stiffness = np.zeros((3, 3))
    for side in (1.0, -1.0):
        for angle in cage_angle + 2.0 * np.pi * np.arange(count) / count:
            direction = np.array(
                [np.cos(angle) * p.cos_contact, np.sin(angle) * p.cos_contact, side * p.sin_contact]
            )
            g = p.interference + p.approach_factor * float(direction @ u)
            x = approach_with_film(g / FILM_FLOOR_APPROACH, film, p.n)
            if x <= 0.0:
                continue
            _, slope = film_and_slope(x, film, p.n)
            d = x * FILM_FLOOR_APPROACH
            force -= p.kn * d**p.n * direction
            rate = p.kn * p.n * d ** (p.n - 1.0) / (1.0 + slope)
            stiffness += p.approach_factor * rate * np.outer(direction, direction)
    return force, stiffness


def stiffness(
    p: BearingParameters,
    displacement: Sequence[float] | np.ndarray = (0.0, 0.0, 0.0),
    *,
    cage_angle: float | None = None,
    shaft_speed: float = 0.0,
    eta0: float = 1.0,
    alpha: float = 1.0,
) -> np.ndarray:
    """Return the stiffness of a shaft in two opposed bearings about a static displacement.

    Parameters
    ----------
    p, displacement, shaft_speed, eta0, alpha
        As in `forces_and_stiffness`.
    cage_angle : float or None
        [rad]; None averages over one roller pitch.

    Returns
    -------
    ndarray, shape (3, 3)
        Symmetric K in (r1, r2, xa) [N/m].

    Notes
    -----
    Without displacement or film the radial and axial diagonals are N kn n d^(n-1) cos^2 L and
    2 N kn n d^(n-1) sin^2 L, so that natural frequencies go with preload^((n-1)/(2n)), the
    1/20th power for lines.
    """
    pitch = 2.0 * np.pi / p.n_rollers
    angles = (
        pitch * np.arange(_CAGE_ANGLES) / _CAGE_ANGLES
        if cage_angle is None
        else np.array([cage_angle])
    )
    total = sum(
        forces_and_stiffness(
            p, displacement, float(angle), shaft_speed=shaft_speed, eta0=eta0, alpha=alpha
        )[1]
        for angle in angles
    )
    return np.asarray(total) / angles.size


def natural_frequencies(stiffness_matrix: np.ndarray, mass: float) -> np.ndarray:
    """Return the natural frequencies of a rigid mass on a stiffness, lowest first [Hz].

    f = sqrt(k/m)/(2 pi) for each principal stiffness k.
    """
    principal = np.linalg.eigvalsh(stiffness_matrix)
    return np.asarray(np.sqrt(np.maximum(principal, 0.0) / mass) / (2.0 * np.pi))


def static_displacement(
    p: BearingParameters,
    load: Sequence[float] | np.ndarray,
    *,
    cage_angle: float = 0.0,
    shaft_speed: float = 0.0,
    eta0: float = 1.0,
    alpha: float = 1.0,
) -> np.ndarray:
    """Return the displacement at which two opposed bearings carry a constant load.

    Parameters
    ----------
    p, cage_angle, shaft_speed, eta0, alpha
        As in `forces_and_stiffness`.
    load : sequence of 3 floats
        External force on the shaft (r1, r2, axial) [N].

    Returns
    -------
    ndarray, shape (3,)
        u [m]; the component along a direction without stiffness stays 0.

    Raises
    ------
    ConvergenceError
        When the damped Newton iteration does not balance the load to 1e-10 of it.
    """
    target = np.asarray(load, dtype=float)
    u = np.zeros(3)
    # A bearing with clearance has no stiffness at rest; start against the loaded rollers.
    radial = float(np.hypot(target[0], target[1]))
    if p.interference <= 0.0 and radial > 0.0:
        reach = (2.0 * FILM_FLOOR_APPROACH - p.interference) / (p.approach_factor * p.cos_contact)
        u[:2] = reach * target[:2] / radial
    scale = max(float(np.linalg.norm(target)), 1.0)

    def residual(v: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        force, slope = forces_and_stiffness(
            p, v, cage_angle, shaft_speed=shaft_speed, eta0=eta0, alpha=alpha
        )
        return target + force, slope

    rest, slope = residual(u)
    for _ in range(100):
        if float(np.linalg.norm(rest)) <= 1e-10 * scale:
            return u
        step = np.linalg.lstsq(slope, rest, rcond=1e-9)[0]
        fraction = 1.0
        for _ in range(30):
            trial, trial_slope = residual(u + fraction * step)
            if np.linalg.norm(trial) < np.linalg.norm(rest):
                break
            fraction *= 0.5
        u = u + fraction * step
        rest, slope = trial, trial_slope
    raise ConvergenceError(
        f"The bearings carry the load only to {float(np.linalg.norm(rest)):g} N after 100 steps, "
        f"limit {1e-10 * scale:g} N. An axial load needs a contact angle above 0 rad."
    )
