"""Measured flanks of a pair: their smooth surfaces, and the gear file that has them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import zip_longest
from pathlib import Path

from gearlube_core.errors import ParameterError
from gearlube_core.hypoid_geometry.flank.flank import Role, Side
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from gearlube_core.hypoid_geometry.measured.deviation_grid import (
    DeviationGrid,
    read_deviation_grids,
)
from gearlube_core.hypoid_geometry.measured.measured_file import MeasuredFile
from gearlube_core.hypoid_geometry.measured.nominal_points import check_nominal_points
from gearlube_core.hypoid_geometry.measured.smooth_surface import SmoothSurface, smooth_surface
from gearlube_core.hypoid_geometry.measured.tooth_errors import ToothErrors


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
    surfaces: Mapping[tuple[Role, Side], SmoothSurface]
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
