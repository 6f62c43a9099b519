"""Settings that explain measured flanks, and those that correct them."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from gearlube.output.csv_text import csv_text
from gearlube_core.errors import ParameterError
from gearlube_core.hypoid_contact.settings_fit import SettingsFit, fit_settings
from gearlube_core.hypoid_geometry.measured.measured_flanks import MeasuredFlanks
from gearlube_core.storage.atomic_file import write_text

HEAD = ("field", "unit", "nominal", "cut_with_more", "uncertainty", "corrective")


def fitted_settings(
    flanks: MeasuredFlanks, fields: Sequence[str], folder: Path | None = None
) -> list[SettingsFit]:
    """Return the fit of settings for each member that fields name.

    Parameters
    ----------
    flanks : MeasuredFlanks
    fields : sequence of str
        Dotted fields of the gear file, see `fit_settings`.
    folder : Path, optional
        Gets settings.csv.

    Raises
    ------
    ParameterError
        No flank of a member was measured, or a field cannot be fitted.
    """
    members = dict.fromkeys(field.partition(".")[0] for field in fields)
    found = []
    for role in members:
        grids = [grid for (whose, _), grid in flanks.grids.items() if whose == role]
        if not grids:
            measured = ", ".join(grid.name for grid in flanks.grids.values()) or "none"
            raise ParameterError(
                f"settings of {role!r} can be fitted only if its flanks were measured; measured "
                f"flanks: {measured}. Fit fields of a member whose deviations are in the file."
            )
        own = [field for field in fields if field.partition(".")[0] == role]
        found.append(fit_settings(flanks.nominal, grids, own))
    if folder is not None:
        write_text(csv_text(HEAD, [row for fit in found for row in rows(fit)]), folder / FILE)
    return found


FILE = "settings.csv"


def rows(fit: SettingsFit) -> list[tuple[str, ...]]:
    """Return the rows of a fit under `HEAD`, as text."""
    numbers = zip(fit.nominal, fit.change, fit.uncertainty, fit.corrective, strict=True)
    return [
        (field, unit, f"{a:.6g}", f"{b:.4g}", f"{c:.2g}", f"{d:.6g}")
        for field, unit, (a, b, c, d) in zip(fit.fields, fit.units, numbers, strict=True)
    ]
