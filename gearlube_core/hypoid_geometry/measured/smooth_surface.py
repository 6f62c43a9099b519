"""The smooth surface through measured deviations, and what it leaves over."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.checks import check_within
from gearlube_core.errors import ParameterError
from gearlube_core.hypoid_geometry.flank.correction import surface_powers
from gearlube_core.hypoid_geometry.measured.deviation_grid import DeviationGrid


@dataclass(frozen=True, slots=True, kw_only=True)
class SmoothSurface:
    """A polynomial over the flank, fitted to the mean of the measured teeth.

    Parameters
    ----------
    removal : tuple of float
        Coefficients of what is removed [m], minus the deviation, as `FlankCorrection.surface`.
    residual : ndarray of shape (m, n)
        Mean deviation of the teeth less the surface [m].
    scatter_rms : float
        Of single teeth about their mean, over all points [m]; 0 of one tooth.
    """

    removal: tuple[float, ...]
    residual: Array
    scatter_rms: float

    @property
    def residual_rms(self) -> float:
        """Root mean square of the residual [m]."""
        return float(np.sqrt(np.mean(self.residual**2)))


def smooth_surface(grid: DeviationGrid, degree: int = 3) -> SmoothSurface:
    """Return the least-squares polynomial through the mean of the measured teeth.

    Parameters
    ----------
    grid : DeviationGrid
    degree : int
        Of the polynomial in both positions together [-], 0 to 5.

    Raises
    ------
    ParameterError
        The grid has too few rows, columns or points for the degree.

    Notes
    -----
    A low degree smooths what the probe adds. A surface through all points would follow the noise,
    and curvature and contact would follow it too. The polynomial is used up to the edges, beyond
    the outermost points; with 1 um of noise on 5 x 9 points a cubic is uncertain by 1.7 um in
    the corners, by 0.3 um in the middle.
    """
    check_within("degree", degree, 0, 5, "", "3 is usual.")
    shape = grid.deviation.shape[1:]
    powers = surface_powers((degree + 1) * (degree + 2) // 2)
    if min(shape) <= degree or shape[0] * shape[1] < 2 * len(powers):
        raise ParameterError(
            f"{grid.name}: a surface of degree {degree} must have more than {degree} rows and "
            f"columns and {2 * len(powers)} points, got {shape[0]} x {shape[1]}. Lower the degree."
        )
    x, y = np.meshgrid(2.0 * grid.places.s - 1.0, 2.0 * grid.places.t - 1.0, indexing="ij")
    terms = np.stack([(x**i * y**j).ravel() for i, j in powers], axis=1)
    mean = grid.deviation.mean(axis=0)
    coefficients = np.linalg.lstsq(terms, mean.ravel(), rcond=None)[0]
    return SmoothSurface(
        removal=tuple((-coefficients).tolist()),
        residual=mean - (terms @ coefficients).reshape(shape),
        scatter_rms=float(np.sqrt(np.mean((grid.deviation - mean) ** 2))),
    )
