"""Flow factors of a periodic rough patch, from Reynolds' equation on its own heights."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np
from scipy.sparse import csc_matrix
from scipy.sparse.linalg import splu

from gearlube_core.arrays import Array
from gearlube_core.checks import check_option, check_positive
from gearlube_core.errors import ParameterError
from gearlube_core.surface.heights import HeightMap, check_closed, check_plausible

# Peklenik number to C, r, smallest h/sigma; [patir_cheng_1978 Table 1]
_PRESSURE = {
    1.0 / 9.0: (1.48, 0.42, 1.0),
    1.0 / 6.0: (1.38, 0.42, 1.0),
    1.0 / 3.0: (1.18, 0.42, 0.75),
    1.0: (0.90, 0.56, 0.5),
    3.0: (0.225, 1.5, 0.5),
    6.0: (0.520, 1.5, 0.5),
    9.0: (0.870, 1.5, 0.5),
}
# Peklenik number to A1, alpha1, alpha2, alpha3, A2; [patir_cheng_1979 Table 1]
_SHEAR = {
    1.0 / 9.0: (2.046, 1.12, 0.78, 0.03, 1.856),
    1.0 / 6.0: (1.962, 1.08, 0.77, 0.03, 1.754),
    1.0 / 3.0: (1.858, 1.01, 0.76, 0.03, 1.561),
    1.0: (1.899, 0.98, 0.92, 0.05, 1.126),
    3.0: (1.560, 0.85, 1.13, 0.08, 0.556),
    6.0: (1.290, 0.62, 1.09, 0.08, 0.388),
    9.0: (1.011, 0.54, 1.07, 0.08, 0.295),
}
PEKLENIK = tuple(_PRESSURE)
_SHEAR_JOINT = 5.0  # h/sigma where the two forms of the shear factor meet
_SHEAR_LEAST = 0.5
_THINNEST = 1e-3  # of the rms height: a film that stands for contact
_MOST_NODES = 1_100_000


def pressure_flow_factor(film_ratio: Array, peklenik: float) -> Array:
    """Return the pressure flow factor along the motion.

    phi_x = 1 - C exp(-r h/sigma) for gamma <= 1,  1 + C (h/sigma)^(-r) for gamma > 1

    Parameters
    ----------
    film_ratio
        h/sigma [-]: distance of the mean planes over the rms height of both surfaces together.
    peklenik
        gamma, correlation length along the motion over that across it: one of 1/9, 1/6, 1/3, 1, 3,
        6, 9. That across the motion is phi_x of 1/gamma.

    Raises
    ------
    ParameterError
        Another Peklenik number, or a film ratio below 0.5 (0.75 for 1/3; 1 for 1/6 and 1/9).

    Notes
    -----
    Gaussian heights with a linear autocorrelation. Source: [patir_cheng_1978].
    """
    C, r, least = _row(_PRESSURE, peklenik)
    _check_ratio(film_ratio, least)
    if peklenik > 1.0:
        return np.asarray(1.0 + C * film_ratio**-r)
    return np.asarray(1.0 - C * np.exp(-r * film_ratio))


def shear_flow_factor(film_ratio: Array, peklenik: float) -> Array:
    """Return the shear flow factor of one rough surface that moves against a smooth one.

    Phi_s = A1 H^alpha1 exp(-alpha2 H + alpha3 H^2) for H = h/sigma <= 5,  A2 exp(-H/4) beyond

    Of two: phi_s = (sigma_1/sigma)^2 Phi_s(gamma_1) - (sigma_2/sigma)^2 Phi_s(gamma_2).

    Parameters, errors as of `pressure_flow_factor`; h/sigma is at least 0.5.

    Notes
    -----
    Source: [patir_cheng_1979].
    """
    A1, alpha1, alpha2, alpha3, A2 = _row(_SHEAR, peklenik)
    _check_ratio(film_ratio, _SHEAR_LEAST)
    near = A1 * film_ratio**alpha1 * np.exp(-alpha2 * film_ratio + alpha3 * film_ratio**2)
    return np.asarray(np.where(film_ratio <= _SHEAR_JOINT, near, A2 * np.exp(-0.25 * film_ratio)))


def _row(table: Mapping[float, tuple[float, ...]], peklenik: float) -> tuple[float, ...]:
    nearest = min(table, key=lambda one: abs(one / peklenik - 1.0))
    if abs(nearest / peklenik - 1.0) > 1e-9:
        check_option("peklenik", f"{peklenik:g}", [f"{one:.6g}" for one in table])
    return table[nearest]


def _check_ratio(film_ratio: Array, least: float) -> None:
    if not float(np.min(film_ratio)) >= least:
        raise ParameterError(
            f"film_ratio h/sigma must be at least {least:g} for this Peklenik number, got "
            f"{float(np.min(film_ratio)):.3g}. The published fit does not cover smaller values."
        )


class FlowFactors(NamedTuple):
    """Mean flow of one patch at one distance from a smooth plane."""

    pressure_x: float  # phi_x: flow along x by a slope of pressure along x, over that of planes [-]
    pressure_y: float  # phi_y, along y [-]
    pressure_xy: float  # flow along y by a slope along x; 0 for a lay along x or y [-]
    shear_x: float  # Phi_s: of a patch that moves along x against a smooth plane [-]
    mean_film: float  # mean of the local film, contact counted as zero [m]
    contact_share: float  # of the area where both planes overlap [-]


def flow_factors(patch: HeightMap, film: float) -> FlowFactors:
    """Return the flow factors of a rough patch against a smooth plane, for the mean flow of oil.

    d/dx(h^3 dp/dx) + d/dy(h^3 dp/dy) = 0 with a mean slope of 1,  phi = mean(h^3 dp/dx)/h_0^3
    d/dx(h^3 dP/dx) + d/dy(h^3 dP/dy) = -dh/dx with no mean slope,  Phi_s = -mean(h^3 dP/dx)/sigma

    Parameters
    ----------
    patch
        Periodic heights of both surfaces together [m]; their mean is subtracted.
    film
        h_0, distance of the mean planes [m].

    Returns
    -------
    FlowFactors
        sigma is the root mean square of the patch.

    Raises
    ------
    ParameterError
        The patch is not periodic, has more than 1.1 million points, or the film is not above zero.

    Notes
    -----
    Local film h = h_0 - z, and zero where the planes overlap: heights are cut there and do not
    deform. The oil is Newtonian with constant viscosity and does not cavitate. Finite volumes take
    the film on each face from the Fourier series of the heights, which gives second order; they
    are solved by a direct method. The patch repeats, whereas that of [patir_cheng_1978] has two
    closed sides and two at given pressures.

    If both surfaces are rough and move past each other, the pressure factor is that of the sum of
    heights, and the shear factor is made of two, see `shear_flow_factor`.
    Source: the problems of [patir_cheng_1978], [patir_cheng_1979] on a periodic cell.

    Examples
    --------
    Straight waves across the flow leave 1/mean(h^-3):

    >>> crests = np.cos(2.0 * np.pi * np.arange(64) / 64)[:, None] + np.zeros(8)
    >>> wave = HeightMap(height=1e-7 * crests, spacing=(1e-6, 1e-6), periodic=(True, True))
    >>> round(flow_factors(wave, 2e-7).pressure_x, 4)
    0.433
    """
    check_positive("film", film, "m")
    check_closed(patch)
    check_plausible(patch)
    height = patch.height - patch.height.mean()
    if height.size > _MOST_NODES:
        raise ParameterError(
            f"{patch.name} must have at most {_MOST_NODES} points, got {height.size}. Take a "
            "smaller patch; several seeds show more than one large patch."
        )
    sigma = float(height.std())
    dx, dy = patch.spacing
    film_x = _face_film(height, film, sigma, 0)
    film_y = _face_film(height, film, sigma, 1)
    cubed_x, cubed_y = film_x**3, film_y**3
    factor = splu(
        _operator(cubed_x / dx**2, cubed_y / dy**2),
        permc_spec="MMD_AT_PLUS_A",
        diag_pivot_thresh=0.0,
        options={"SymmetricMode": True},
    )

    def mean_flow(drive_x: Array | float, drive_y: Array | float) -> tuple[float, float]:
        """Return mean flows along x and y with given parts that no pressure makes."""
        given_x, given_y = drive_x + 0.0 * cubed_x, drive_y + 0.0 * cubed_y
        source = (given_x - np.roll(given_x, 1, 0)) / dx + (given_y - np.roll(given_y, 1, 1)) / dy
        pressure = factor.solve(source.ravel()).reshape(height.shape)
        flow_x = cubed_x * (np.roll(pressure, -1, 0) - pressure) / dx + given_x
        flow_y = cubed_y * (np.roll(pressure, -1, 1) - pressure) / dy + given_y
        return float(flow_x.mean()), float(flow_y.mean())

    along, aside = mean_flow(cubed_x, 0.0)
    sheared = mean_flow(film_x, 0.0)[0]
    local = film - height
    return FlowFactors(
        pressure_x=along / film**3,
        pressure_y=mean_flow(0.0, cubed_y)[1] / film**3,
        pressure_xy=aside / film**3,
        shear_x=(float(film_x.mean()) - sheared) / sigma,
        mean_film=float(np.maximum(local, 0.0).mean()),
        contact_share=float((local <= 0.0).mean()),
    )


def _face_film(height: Array, film: float, sigma: float, axis: int) -> Array:
    """Return the film on the faces half a spacing farther along an axis."""
    count = height.shape[axis]
    waves = np.fft.rfft(height, axis=axis)
    turn = np.exp(1j * np.pi * np.arange(waves.shape[axis]) / count)
    shifted = np.fft.irfft(waves * (turn[:, None] if axis == 0 else turn), count, axis=axis)
    return np.asarray(np.maximum(film - shifted, _THINNEST * sigma))


def _operator(share_x: Array, share_y: Array) -> csc_matrix:
    """Return minus the divergence of h^3 times the slope; one node is held at zero."""
    nodes = np.arange(share_x.size).reshape(share_x.shape)
    right, upper = np.roll(nodes, -1, 0).ravel(), np.roll(nodes, -1, 1).ravel()
    own = nodes.ravel()
    diagonal = share_x + np.roll(share_x, 1, 0) + share_y + np.roll(share_y, 1, 1)
    # a pressure that is free by a constant: a node where the film is thick is tied down
    tied = int(diagonal.argmax())
    diagonal = diagonal.ravel().copy()
    diagonal[tied] *= 2.0
    x, y = -share_x.ravel(), -share_y.ravel()
    entries = np.concatenate((diagonal, x, x, y, y))
    rows = np.concatenate((own, own, right, own, upper))
    columns = np.concatenate((own, right, own, upper, own))
    return csc_matrix((entries, (rows, columns)))
