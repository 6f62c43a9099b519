"""Measured flanks of a pair: their smooth surfaces, and the gear file that has them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import zip_longest
from pathlib import Path

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.checks import check_within
from gearlube_core.errors import ParameterError
from gearlube_core.hypoid_geometry.flank.correction import surface_powers
from gearlube_core.hypoid_geometry.flank.flank import Role, Side
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from gearlube_core.hypoid_geometry.measured.deviation_grid import (
    DeviationGrid,
    read_deviation_grids,
)
from gearlube_core.hypoid_geometry.measured.measured_file import MeasuredFile
from gearlube_core.hypoid_geometry.measured.nominal_points import check_nominal_points
from gearlube_core.hypoid_geometry.measured.tooth_errors import ToothErrors


@dataclass(frozen=True, slots=True, kw_only=True)
class _SmoothSurface:
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


@dataclass(frozen=True, slots=True, kw_only=True)
class MeasuredFlanks:
    """Measured flanks beside the nominal pair.

    Parameters
    ----------
    file : MeasuredFile
    nominal : HypoidGearFile
    grids : mapping of (role, side) to DeviationGrid
    surfaces : mapping of (role, side) to SmoothSurface
    errors : ToothErrors
        How teeth differ from each other.
    """

    file: MeasuredFile
    nominal: HypoidGearFile
    grids: Mapping[tuple[Role, Side], DeviationGrid]
    surfaces: Mapping[tuple[Role, Side], _SmoothSurface]
    errors: ToothErrors

    def gear_file(self) -> HypoidGearFile:
        """Return the nominal gear file with the smooth surfaces laid on its flanks.

        The deviations are those from the flanks of that file, its reliefs included: coefficients
        that a flank already has are added to.
        """
        changes: dict[str, object] = {
            "name": self.file.name,
            "source": f"{self.nominal.source}; measured flanks: {self.file.source}",
        }
        for (role, side), surface in self.surfaces.items():
            before = self.nominal.correction(role, side).surface
            both = zip_longest(before, surface.removal, fillvalue=0.0)
            changes[f"{role}.{side}_flank.surface_um"] = tuple(1e6 * (a + b) for a, b in both)
        return self.nominal.varied(changes)


def read_measured_flanks(path: str | Path) -> MeasuredFlanks:
    """Return the measured flanks of a measured-gear file (TOML) and its CSV files.

    Raises
    ------
    ParameterError
        A file is missing or wrong; the sentence names the line.
    """
    file = MeasuredFile.from_toml(path)
    nominal = file.nominal()
    grids: dict[tuple[Role, Side], DeviationGrid] = {}
    if file.deviations is not None:
        places = file.places(nominal.blank())
        if file.nominal_points is not None:
            places |= check_nominal_points(file.nominal_points, nominal)
        if not places:
            raise ParameterError(
                f"{path}: deviations are given, so a grid must be described. Add the section "
                "[pinion.grid] or [gear.grid], or nominal_points."
            )
        grids = read_deviation_grids(
            file.deviations, places, middle_is_zero=file.middle_point == "zero"
        )
    surfaces = {key: smooth_surface(grid, file.degree) for key, grid in grids.items()}
    return MeasuredFlanks(
        file=file,
        nominal=nominal,
        grids=grids,
        surfaces=surfaces,
        errors=file.tooth_errors(nominal.blank()),
    )


def smooth_surface(grid: DeviationGrid, degree: int = 3) -> _SmoothSurface:
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
    return _SmoothSurface(
        removal=tuple((-coefficients).tolist()),
        residual=mean - (terms @ coefficients).reshape(shape),
        scatter_rms=float(np.sqrt(np.mean((grid.deviation - mean) ** 2))),
    )
