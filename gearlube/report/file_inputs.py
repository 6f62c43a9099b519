"""The fields of an input file as inputs of a report, with their origin."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from gearlube.report.numbers import unit_words
from gearlube.report.parts import ASSUMED, GIVEN, INFERRED, Input
from gearlube_core.helical_geometry.gear_file import HelicalGearFile
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from gearlube_core.input_file.field_notes import field_unit


def file_inputs(file: HypoidGearFile | HelicalGearFile) -> list[Input]:
    """Return the numbers of a gear file: given, inferred or assumed.

    Examples
    --------
    >>> from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
    >>> found = file_inputs(HypoidGearFile.named("mohammadpour_2015"))
    >>> found[0].name, found[0].value, found[0].unit
    ('pair.offset_mm', '24', 'mm')
    """
    found, doubtful = [], file.doubts()
    for field, value in _numbers(file.model_dump(exclude_none=True)):
        origin, why = GIVEN, doubtful.get(field, "")
        for kind, reasons in ((INFERRED, file.inferred), (ASSUMED, file.completed)):
            if field in reasons:
                origin = kind
                why = str(reasons[field]) if isinstance(reasons, Mapping) else ""
        unit = field_unit(field)[0]
        found.append(Input(field, value, unit_words(unit), origin, why))
    return found


def _numbers(data: Mapping[str, Any], prefix: str = "") -> list[tuple[str, str]]:
    found = []
    for key, value in data.items():
        name = f"{prefix}{key}"
        if isinstance(value, dict):
            if name not in ("inferred", "completed"):
                found += _numbers(value, f"{name}.")
        elif isinstance(value, int | float) and not isinstance(value, bool):
            found.append((name, f"{value:.7g}"))
    return found
