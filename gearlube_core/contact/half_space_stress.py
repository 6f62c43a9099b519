"""Stress below the surface of an elastic half-space under pressure and shear on its surface."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np
from scipy.fft import irfft2, next_fast_len, rfft2
from scipy.signal import fftconvolve

from gearlube_core.arrays import Array
from gearlube_core.checks import check_positive, check_within
from gearlube_core.errors import ParameterError

_FAR = 4.0  # widths of a domain open on all sides to which it is padded
_FADED = 1.5  # periods along the closed side, over which its longest wave fades to 8e-5


@dataclass(frozen=True, eq=False, kw_only=True)
class HalfSpaceStress:
    """Stress at any depth of a solid under pressure and shear on a grid, e.g. those of a film.

    For each wave exp(i k s) of the loads along s, with E = exp(-k z):

    sigma_ss = -p (1 - k z) E + i q_s (2 - k z) E,  sigma_zz = -p (1 + k z) E + i q_s k z E
    sigma_sz = i p k z E - q_s (1 - k z) E,  sigma_tt = nu (sigma_ss + sigma_zz)
    sigma_st = i q_t E,  sigma_tz = -q_t E

    Parameters
    ----------
    pressure
        p [Pa], shape (nx, ny), pressing along z into the solid.
    spacing
        Distances of the nodes along x and y [m].
    traction_x, traction_y
        Shear that acts on the solid along x and y [Pa], shape (nx, ny); None: none.
    poisson_ratio
        nu [-].
    periodic
        Whether the load repeats along x and along y. (False, False): a point contact, (False,
        True): a line contact whose load repeats along it.

    Raises
    ------
    ParameterError
        Shapes differ, a number is not finite, or the load is open along y and periodic along x.

    Notes
    -----
    Tension is positive. The solution is exact for all waves that the grid resolves. Open sides are
    padded with zeros to four times the width. This leaves an error of 1e-3 of the largest pressure
    under a round load, and of 1 % under a load that fills the domain. For a line contact the mean
    over y is taken from closed forms for strips instead, without repeated loads. If both sides are
    periodic, the solid under the mean pressure cannot expand sideways, sigma_xx = -nu/(1 - nu) p.
    Source: Airy's function of each wave, [johnson_1985 sec. 2.2]; strips, [johnson_1985 sec. 2.5].

    Examples
    --------
    >>> x = np.linspace(-2.0, 2.0, 129)[:, None] + np.zeros(4)
    >>> line = np.sqrt(np.maximum(1.0 - x**2, 0.0))
    >>> stress = HalfSpaceStress(
    ...     pressure=line, spacing=(1 / 32, 1.0), poisson_ratio=0.3, periodic=(False, True)
    ... )
    >>> round(float(greatest_shear(stress(0.786))[64, 0]), 2)
    0.3
    """

    pressure: Array
    spacing: tuple[float, float]
    poisson_ratio: float
    traction_x: Array | None = None
    traction_y: Array | None = None
    periodic: tuple[bool, bool] = (False, False)
    _waves: tuple[Array, Array, Array] = field(init=False, repr=False)
    _directions: tuple[Array, Array, Array] = field(init=False, repr=False)
    _padded: tuple[int, int] = field(init=False, repr=False)

    def __post_init__(self) -> None:
        check_within("poisson_ratio", self.poisson_ratio, 0.0, 0.5)
        for axis, step in zip("xy", self.spacing, strict=True):
            check_positive(f"spacing along {axis}", step, "m")
        if self.periodic == (True, False):
            raise ParameterError(
                "periodic must not be (True, False), a line contact along x. Turn the axes."
            )
        shape = self.pressure.shape
        loads = [
            np.zeros(shape) if one is None else np.asarray(one, dtype=float)
            for one in (self.pressure, self.traction_x, self.traction_y)
        ]
        for name, one in zip(("pressure", "traction_x", "traction_y"), loads, strict=True):
            if one.ndim != 2 or one.shape != shape or not np.isfinite(one).all():
                raise ParameterError(
                    f"{name} must be finite with the shape (nx, ny) of the pressure, {shape}, got "
                    f"{one.shape}."
                )
        padded = self._padded_shape(shape)
        waves = tuple(rfft2(one, padded) for one in loads)
        k_x = 2.0 * math.pi * np.fft.fftfreq(padded[0], self.spacing[0])[:, None]
        k_y = 2.0 * math.pi * np.fft.rfftfreq(padded[1], self.spacing[1])[None, :]
        k = np.hypot(k_x, k_y)
        some = np.where(k > 0.0, k, 1.0)
        for one in waves:
            # waves of two nodes have no direction; the mean is dealt with apart
            if padded[0] % 2 == 0:
                one[padded[0] // 2, :] = 0.0
            if padded[1] % 2 == 0:
                one[:, -1] = 0.0
        set_ = object.__setattr__
        set_(self, "_waves", waves)
        set_(self, "_directions", (k, k_x / some, k_y / some))
        set_(self, "_padded", padded)

    def _padded_shape(self, shape: tuple[int, ...]) -> tuple[int, int]:
        nx, ny = shape
        if self.periodic == (True, True):
            return nx, ny
        if self.periodic[1]:
            faded = math.ceil(_FADED * ny * self.spacing[1] / self.spacing[0])
            return next_fast_len(nx + max(nx, faded), True), ny
        return next_fast_len(math.ceil(_FAR * nx), True), next_fast_len(math.ceil(_FAR * ny), True)

    def __call__(self, depth: float) -> Array:
        """Return the stress at a depth z [m] from 0 on, (6, nx, ny) [Pa].

        In the order xx, yy, zz, xy, yz, xz.
        """
        check_within("depth", depth, 0.0, 1e3, "m")
        nu = self.poisson_ratio
        p, q_x, q_y = self._waves
        k, c, s = self._directions
        kz = k * depth
        fade = np.exp(-kz)
        q_s, q_t = q_x * c + q_y * s, q_y * c - q_x * s
        along = (-p * (1.0 - kz) + 1j * q_s * (2.0 - kz)) * fade
        down = (-p * (1.0 + kz) + 1j * q_s * kz) * fade
        across = nu * (along + down)
        along_down = (1j * p * kz - q_s * (1.0 - kz)) * fade
        along_across = 1j * q_t * fade
        across_down = -q_t * fade
        waves = [
            c * c * along + s * s * across - 2.0 * c * s * along_across,
            s * s * along + c * c * across + 2.0 * c * s * along_across,
            down,
            c * s * (along - across) + (c * c - s * s) * along_across,
            s * along_down + c * across_down,
            c * along_down - s * across_down,
        ]
        for one, mean in zip(waves, self._mean(), strict=True):
            one[0, 0] = mean
        line = self.periodic == (False, True)
        if line:
            for one in waves:
                one[:, 0] = 0.0
        nx, ny = self.pressure.shape
        found = np.array([irfft2(one, self._padded)[:nx, :ny] for one in waves])
        if line:
            found += self._strips(depth)[:, :, None]
        return found

    def _mean(self) -> tuple[complex, ...]:
        nu = self.poisson_ratio
        p, q_x, q_y = (one[0, 0] for one in self._waves)
        # held sideways; or, of a single load, the mean over all directions of its longest waves
        side = -nu / (1.0 - nu) * p if self.periodic[0] else -0.5 * (1.0 + 2.0 * nu) * p
        return side, side, -p, 0.0, -q_y, -q_x

    def _strips(self, z: float) -> Array:
        """Return the stress of the mean loads over y, (6, nx) [Pa], from uniform strips."""
        dx, nx, nu = self.spacing[0], self.pressure.shape[0], self.poisson_ratio
        x = dx * np.arange(1 - nx, nx, dtype=float)
        right, left = x - 0.5 * dx, x + 0.5 * dx
        theta_1, theta_2 = np.arctan2(z, right), np.arctan2(z, left)
        turn = 2.0 * (theta_1 - theta_2)
        sines = np.sin(2.0 * theta_1) - np.sin(2.0 * theta_2)
        cosines = np.cos(2.0 * theta_1) - np.cos(2.0 * theta_2)
        ratio = np.log(np.hypot(right, z) / np.hypot(left, z))

        def of(load: Array | None, kernel: Array) -> Array:
            if load is None:
                return np.zeros(nx)
            mean = np.asarray(load, dtype=float).mean(axis=1)
            return np.asarray(fftconvolve(mean, kernel / (2.0 * math.pi))[nx - 1 : 2 * nx - 1])

        p, q_x, q_y = self.pressure, self.traction_x, self.traction_y
        xx = of(p, -(turn + sines)) + of(q_x, 4.0 * ratio - cosines)
        zz = of(p, -(turn - sines)) + of(q_x, cosines)
        xz = of(p, cosines) + of(q_x, -(turn + sines))
        return np.array((xx, nu * (xx + zz), zz, of(q_y, 2.0 * ratio), of(q_y, -turn), xz))


def hydrostatic_stress(stress: Array) -> Array:
    """Return (sigma_xx + sigma_yy + sigma_zz)/3 [Pa] of a stress (6, ...)."""
    return np.asarray((stress[0] + stress[1] + stress[2]) / 3.0)


def mises_stress(stress: Array) -> Array:
    """Return the von Mises equivalent stress [Pa] of a stress (6, ...).

    Examples
    --------
    >>> round(float(mises_stress(np.array([250e6, 0.0, 0.0, 0.0, 0.0, 0.0]))), 3)
    250000000.0
    """
    return np.asarray(np.sqrt(3.0 * _second_invariant(stress)))


def principal_stresses(stress: Array) -> Array:
    """Return the principal stresses, greatest first, (3, ...) [Pa], of a stress (6, ...)."""
    mean = hydrostatic_stress(stress)
    a, b, c = (stress[n] - mean for n in range(3))
    xy, yz, xz = stress[3], stress[4], stress[5]
    third = a * b * c + 2.0 * xy * yz * xz - a * yz**2 - b * xz**2 - c * xy**2
    radius = np.sqrt(_second_invariant(stress) / 3.0)
    cubed = 2.0 * radius**3
    turn = np.divide(third, cubed, out=np.ones_like(third), where=cubed > 0.0)
    angle = np.arccos(np.clip(turn, -1.0, 1.0)) / 3.0
    third_turn = 2.0 * math.pi / 3.0
    first = 2.0 * radius * np.cos(angle)
    last = 2.0 * radius * np.cos(angle + third_turn)
    return np.array((mean + first, mean - first - last, mean + last))


def greatest_shear(stress: Array) -> Array:
    """Return the greatest shear stress [Pa] of a stress (6, ...): half the principal difference.

    Examples
    --------
    >>> round(float(greatest_shear(np.array([0.0, 0.0, 0.0, 80e6, 0.0, 0.0]))))
    80000000
    """
    first, _, last = principal_stresses(stress)
    return np.asarray(0.5 * (first - last))


def _second_invariant(stress: Array) -> Array:
    mean = hydrostatic_stress(stress)
    squares = sum((stress[n] - mean) ** 2 for n in range(3))
    return np.asarray(0.5 * squares + stress[3] ** 2 + stress[4] ** 2 + stress[5] ** 2)
