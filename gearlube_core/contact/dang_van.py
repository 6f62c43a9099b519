"""Fatigue number of Dang Van over a sequence of stresses, from their smallest ball."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.checks import check_within
from gearlube_core.contact.half_space_stress import greatest_shear, hydrostatic_stress
from gearlube_core.errors import ConvergenceError, ParameterError
from gearlube_core.kernels.jit import kernel

DIMENSIONS = 5  # of deviatoric stress
_MOST_STEPS = 20_000
_ROOT = math.sqrt(2.0)
# a deviator as a vector whose length is that of the tensor, sqrt(s:s)
_FROM_NORMAL = np.array([[math.sqrt(1.5), 0.0, 0.0], [math.sqrt(0.5), _ROOT, 0.0]])


@kernel
def smallest_ball(
    points: np.ndarray, tolerance: float, most: int, weights: np.ndarray, centre: np.ndarray
) -> tuple[float, int]:
    """Return the radius of the smallest ball around points and write its centre.

    Frank and Wolfe's method with steps towards the farthest and away from the nearest point. The
    ball holds all points and its radius is at most 1 + tolerance times the smallest.

    Parameters
    ----------
    points
        Points in stress space, shape (n, 5).
    tolerance
        Of the radius [-].
    most
        Largest number of steps.
    weights
        Scratch memory, shape (n,).
    centre
        Centre of the ball, shape (5,), written.

    Returns
    -------
    tuple
        Radius, and steps; `most` if it did not converge.

    Notes
    -----
    Source: [yildirim_2008 algorithm 4.1].
    """
    n, d = points.shape
    for m in range(d):
        centre[m] = points[0, m]
    far, _ = _farthest(points, centre)
    for i in range(n):
        weights[i] = 0.0
    weights[0] += 0.5
    weights[far] += 0.5
    for m in range(d):
        centre[m] = 0.5 * (points[0, m] + points[far, m])
    limit = (1.0 + tolerance) ** 2 - 1.0
    largest = 0.0
    for step in range(most):
        inner, nearest, near = 0.0, np.inf, 0
        largest, far = -1.0, 0
        for i in range(n):
            square = 0.0
            for m in range(d):
                difference = points[i, m] - centre[m]
                square += difference * difference
            # the weighted mean square from the centre: never above that of the smallest ball
            inner += weights[i] * square
            if square > largest:
                largest, far = square, i
            if weights[i] > 0.0 and square < nearest:
                nearest, near = square, i
        if largest <= inner * (1.0 + limit) or largest == 0.0:
            return np.sqrt(largest), step
        outward, inward = largest / inner - 1.0, 1.0 - nearest / inner
        if outward >= inward or weights[near] >= 1.0:
            share, i = outward / (2.0 * (1.0 + outward)), far
        else:
            whole = weights[near] / (1.0 - weights[near])
            best = inward / (2.0 * (1.0 - inward)) if inward < 1.0 else whole
            share, i = -min(best, whole), near
            if best >= whole:
                weights[near] = 0.0  # set below to exactly none
        for k in range(n):
            weights[k] *= 1.0 - share
        if share > 0.0 or weights[i] > 0.0:
            weights[i] += share
        for m in range(d):
            centre[m] = (1.0 - share) * centre[m] + share * points[i, m]
    return np.sqrt(largest), most


@kernel
def _farthest(points: np.ndarray, centre: np.ndarray) -> tuple[int, float]:
    far, largest = 0, -1.0
    for i in range(points.shape[0]):
        square = 0.0
        for m in range(points.shape[1]):
            difference = points[i, m] - centre[m]
            square += difference * difference
        if square > largest:
            largest, far = square, i
    return far, largest


@dataclass(frozen=True, slots=True, kw_only=True)
class FatigueLimits:
    """Fatigue limits of a steel under fully reversed load, for `dang_van_number`.

    Parameters
    ----------
    bending
        f_-1, amplitude of the normal stress [Pa].
    torsion
        t_-1, amplitude of the shear stress [Pa]; 0.5 to 0.8 of f_-1.
    name
        Name of the material in tables.

    Examples
    --------
    >>> round(QUENCHED_42CRMO4.pressure_weight, 2)
    0.46
    """

    bending: float
    torsion: float
    name: str = "steel"

    def __post_init__(self) -> None:
        check_within("bending", self.bending, 1e7, 3e9, "Pa", "398 MPa is 3.98e8 Pa.")
        check_within(
            "torsion over bending", self.torsion / self.bending, 0.5, 0.8, "", "Give both in Pa."
        )

    @property
    def pressure_weight(self) -> float:
        """Alpha = 3 (t_-1/f_-1 - 1/2) [-]."""
        return 3.0 * (self.torsion / self.bending - 0.5)


# 42CrMo4, quenched and tempered, tests of Zenner et al. as listed by [papadopoulos_1997].
# A case-hardened flank has other limits, and residual stress.
QUENCHED_42CRMO4 = FatigueLimits(bending=398e6, torsion=260e6, name="42CrMo4, quenched")


def dang_van_number(
    history: Array,
    limits: FatigueLimits,
    residual: Array | None = None,
    *,
    compression: bool = True,
    tolerance: float = 1e-3,
) -> Array:
    """Return the fatigue number of Dang Van; above 1 the steel is expected to fail by fatigue.

    N = max over time of (tau(t) + alpha sigma_h(t))/t_-1

    tau is the greatest shear of s(t) - s*, with the deviator s and the centre s* of the smallest
    ball around all s(t). It is the mesoscopic stress in a grain that has shaken down.

    Parameters
    ----------
    history
        Stress of material points over a cycle [Pa]: xx, yy, zz, xy, yz, xz, shape (steps, 6, ...).
    limits
        Fatigue limits of the steel.
    residual
        Stress that does not change [Pa], (6, ...); only its hydrostatic part acts.
    compression
        Whether hydrostatic compression helps. False: it does not, which is the safe bound.
    tolerance
        Tolerance of the ball's radius [-].

    Returns
    -------
    ndarray, shape (...)
        N [-]. It may be below 0 where there is only high pressure.

    Raises
    ------
    ParameterError
        The shape is wrong or a number is not finite.
    ConvergenceError
        A ball was not found.

    Notes
    -----
    The macroscopic stress is elastic. In contacts sigma_h is strongly negative, far beyond the
    tests from which alpha comes. There the criterion is known to be too optimistic [desimone_2006].
    Source: [dang_van_1989].

    Examples
    --------
    Torsion to and fro at the fatigue limit:

    >>> turn = np.linspace(0.0, 2.0 * np.pi, 25)
    >>> history = np.zeros((25, 6))
    >>> history[:, 3] = 260e6 * np.cos(turn)
    >>> round(float(dang_van_number(history, QUENCHED_42CRMO4)), 3)
    1.0
    """
    stress = np.asarray(history, dtype=float)
    if stress.ndim < 2 or stress.shape[1] != 6 or stress.shape[0] < 2:
        raise ParameterError(
            f"history must have the shape (steps, 6, ...), steps from 2 on, got {stress.shape}."
        )
    if not np.isfinite(stress).all():
        raise ParameterError("history must be finite. Leave out steps without a solution.")
    check_within("tolerance", tolerance, 1e-8, 0.1)
    steps, places = stress.shape[0], stress.shape[2:]
    flat = stress.reshape(steps, 6, -1)
    offset = np.zeros(flat.shape[2])
    if residual is not None:
        if residual.shape != (6, *places):
            raise ParameterError(
                f"residual must have the shape {(6, *places)}, got {residual.shape}."
            )
        offset = hydrostatic_stress(residual).ravel()
    number = np.empty(flat.shape[2])
    weights, centre = np.zeros(steps), np.zeros(DIMENSIONS)
    for n in range(flat.shape[2]):
        one = np.ascontiguousarray(flat[:, :, n].T)
        vectors = _vectors(one)
        _, taken = smallest_ball(vectors, tolerance, _MOST_STEPS, weights, centre)
        if taken == _MOST_STEPS:
            raise ConvergenceError(
                f"The smallest ball of place {n} must be found within {_MOST_STEPS} steps. Raise "
                f"tolerance above {tolerance:g}."
            )
        shear = greatest_shear(_stress(vectors - centre))
        pressure = hydrostatic_stress(one) + offset[n]
        if not compression:
            pressure = np.maximum(pressure, 0.0)
        number[n] = float((shear + limits.pressure_weight * pressure).max())
    return (number / limits.torsion).reshape(places)


def passage_history(stress: Array) -> Array:
    """Return the stress over time in material that passes a steady load along x.

    Parameters
    ----------
    stress
        (6, nx, ...) [Pa], from far before to far behind the load.

    Returns
    -------
    ndarray, shape (nx, 6, ...)
        For `dang_van_number`.

    Examples
    --------
    >>> passage_history(np.zeros((6, 101, 16))).shape
    (101, 6, 16)
    """
    return np.moveaxis(stress, 1, 0)


def followed_history(stress: Array, x: Array, travel: Array, places: Array) -> Array:
    """Return the stress over time in material that moves through changing loads.

    Parameters
    ----------
    stress
        Stress on fixed nodes, (steps, 6, nx, ...) [Pa].
    x
        Nodes [m], shape (nx,).
    travel
        Distance that the material has moved along x at each step [m], shape (steps,).
    places
        Positions of the material points at travel 0 [m], shape (n,). Outside the nodes the stress
        of the last node is used.

    Returns
    -------
    ndarray, shape (steps, 6, n, ...)
        Linearly interpolated between nodes.

    Examples
    --------
    >>> x, travel = np.linspace(0.0, 1e-3, 11), 1e-5 * np.arange(4.0)
    >>> followed_history(np.zeros((4, 6, 11, 16)), x, travel, np.array([2e-4, 4e-4])).shape
    (4, 6, 2, 16)
    """
    if stress.shape[0] != travel.size or stress.shape[2] != x.size:
        raise ParameterError(
            f"stress must have the shape ({travel.size}, 6, {x.size}, ...), got {stress.shape}."
        )
    found = np.empty((*stress.shape[:2], places.size, *stress.shape[3:]))
    for k, moved in enumerate(travel):
        at = np.clip(np.interp(places + moved, x, np.arange(x.size)), 0.0, x.size - 1.0)
        low = np.minimum(at.astype(int), x.size - 2)
        share = (at - low).reshape(-1, *(1,) * (stress.ndim - 3))
        found[k] = (1.0 - share) * stress[k][:, low] + share * stress[k][:, low + 1]
    return found


def _vectors(stress: Array) -> Array:
    """Return deviators of (6, n) as vectors (n, 5) of their own length sqrt(s:s)."""
    mean = hydrostatic_stress(stress)
    first, second = stress[0] - mean, stress[1] - mean
    normal = (_FROM_NORMAL[0, 0] * first, _FROM_NORMAL[1, 0] * first + _FROM_NORMAL[1, 1] * second)
    return np.stack((*normal, *(_ROOT * stress[n] for n in (3, 4, 5))), axis=1)


def _stress(vectors: Array) -> Array:
    """Return the deviators (6, n) of vectors (n, 5)."""
    first = vectors[:, 0] / _FROM_NORMAL[0, 0]
    second = (vectors[:, 1] - _FROM_NORMAL[1, 0] * first) / _FROM_NORMAL[1, 1]
    shear = (vectors[:, n] / _ROOT for n in (2, 3, 4))
    return np.stack((first, second, -first - second, *shear))
