"""Flow factors of a periodic rough patch, from Reynolds' equation on its own heights."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from scipy.sparse import csc_matrix
from scipy.sparse.linalg import splu

from gearlube_core.arrays import Array
from gearlube_core.checks import check_positive
from gearlube_core.errors import ParameterError
from gearlube_core.surface.heights import HeightMap, check_closed, check_plausible

_THINNEST = 1e-3  # of the rms height: a film that stands for contact
_MOST_NODES = 1_100_000


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
            "smaller patch; several seeds tell more than one large patch."
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
