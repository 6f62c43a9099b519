"""Surface temperature of a moving half-space heated on the cells of a fixed grid."""

from __future__ import annotations

import math

import numpy as np
import scipy.fft
from scipy.special import erf

from gearlube_core.arrays import Array
from gearlube_core.checks import check_finite, check_positive
from gearlube_core.contact.solid import Solid

_POINTS = 4  # of Gauss and Legendre between two times
_GROWTH = 1.6  # of the times where nothing else divides them
_FIRST = 1e-4  # of the time in which heat crosses a cell by conduction
_LAST = 1e7  # of the time in which it crosses the grid
_SMEARED = 4.0  # diffusion lengths (4 kappa t)^(1/2) behind the grid at which heat has left it


def _times(steps: tuple[float, float], counts: tuple[int, int], velocity: tuple[float, float],
           diffusivity: float) -> Array:  # fmt: skip
    """Return times [s] between which the temperature of every cell is smooth, from zero on.

    Heat of a cell reaches and leaves the others where edges meet: those times are among them.
    """
    extent = max(step * count for step, count in zip(steps, counts, strict=True))
    first = _FIRST * min(steps) ** 2 / diffusivity
    last = _LAST * extent**2 / diffusivity
    edges: list[Array] = [np.zeros(1)]
    for step, count, speed in zip(steps, counts, velocity, strict=True):
        if speed == 0.0:
            continue
        # behind the grid by several diffusion lengths: |u| t = extent + s (4 kappa t)^(1/2)
        smear = _SMEARED * math.sqrt(4.0 * diffusivity)
        root = (smear + math.sqrt(smear**2 + 4.0 * abs(speed) * step * count)) / (2.0 * abs(speed))
        last = min(last, root * root)
        edges.append(np.asarray((np.arange(count) + 0.5) * step / abs(speed)))
    number = max(2, math.ceil(math.log(last / first) / math.log(_GROWTH)))
    edges.append(np.asarray(np.geomspace(first, last, number)))
    times = np.unique(np.concatenate(edges))
    return times[times <= last]


def moving_heat_coefficients(
    solid: Solid,
    velocity: tuple[float, float],
    steps: tuple[float, float],
    counts: tuple[int, int],
) -> Array:
    """Return the rise of a surface at all offsets from a cell with unit heat per area.

    dT(x, y) = integral over t > 0 of dt/(rho c (pi kappa t)^(1/2)) X(t) Y(t),
    X = [erf((x + a - u t)/s) - erf((x - a - u t)/s)]/2,  s = (4 kappa t)^(1/2), Y alike

    Parameters
    ----------
    solid
        Density, conductivity, heat capacity.
    velocity
        Of the surface along x and y against the cells [m/s], any sign, zero included.
    steps
        Sides 2a and 2b of a cell along x and y [m].
    counts
        Cells along x and y.

    Returns
    -------
    ndarray, shape (2 ny - 1, 2 nx - 1)
        [K m2/W]; entry (ny - 1 + j, nx - 1 + i) at the centre of the cell i steps along x and j
        along y from the heated one.

    Notes
    -----
    Steady, in the frame of the cells, and exact for any Peclet number: conduction along the
    surface is contained. The integrand is a product of functions of x and of y, so that all
    offsets follow from one product of matrices; quadrature between the times where edges of
    cells meet leaves less than 1e-6 of the largest rise. At rest, what comes after 1e7 crossing
    times is left out, 1e-4 of a plate's. Source: [carslaw_jaeger_1959 sec. 10.3]
    [carslaw_jaeger_1959 sec. 10.7].
    """
    for axis, speed, step in zip("xy", velocity, steps, strict=True):
        check_finite(f"velocity along {axis}", speed, "m/s")
        check_positive(f"d{axis}", step, "m")
    diffusivity = solid.conductivity / (solid.density * solid.heat_capacity)
    roots = np.sqrt(_times(steps, counts, velocity, diffusivity))
    nodes, weights = np.polynomial.legendre.leggauss(_POINTS)
    half = 0.5 * np.diff(roots)
    root = (half[:, None] * nodes + (0.5 * (roots[1:] + roots[:-1]))[:, None]).ravel()
    weight = (half[:, None] * weights).ravel()
    # dt/t^(1/2) = 2 d(t^(1/2))
    weight *= 2.0 / (solid.density * solid.heat_capacity * math.sqrt(math.pi * diffusivity))
    parts = []
    for speed, step, count in zip(velocity, steps, counts, strict=True):
        edge = (np.arange(2 * count) - count + 0.5) * step
        passed = erf((edge - speed * root[:, None] ** 2) / (math.sqrt(4.0 * diffusivity)
                                                           * root[:, None]))  # fmt: skip
        parts.append(0.5 * np.diff(passed, axis=1))
    along, across = parts
    return np.asarray((weight[:, None] * across).T @ along)


class MovingHeat:
    """Rise of a moving surface under heat on a grid, by FFT.

    Parameters
    ----------
    solid, velocity, steps, counts
        As in `moving_heat_coefficients`.
    """

    def __init__(
        self,
        solid: Solid,
        velocity: tuple[float, float],
        steps: tuple[float, float],
        counts: tuple[int, int],
    ) -> None:
        nx, ny = counts
        coefficients = moving_heat_coefficients(solid, velocity, steps, counts)
        self.total = float(coefficients.sum())
        self._padded = tuple(scipy.fft.next_fast_len(2 * n - 1, real=True) for n in (ny, nx))
        self._first = (ny - 1, nx - 1)
        self._transfer = scipy.fft.rfft2(coefficients, self._padded)

    def __call__(self, flux: Array) -> Array:
        """Return the rise [K] under a flux into the body [W/m2], both of shape (ny, nx)."""
        ny, nx = flux.shape
        spectrum = scipy.fft.rfft2(flux, self._padded)
        spectrum *= self._transfer
        rise = scipy.fft.irfft2(spectrum, self._padded)
        # cyclic: the offset of the middle is turned back to zero
        j, i = self._first
        return np.ascontiguousarray(np.roll(rise, (-j, -i), axis=(0, 1))[:ny, :nx])
