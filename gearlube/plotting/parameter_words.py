"""Names and sizes of settings, reliefs and misalignments as labels show them."""

from __future__ import annotations

import numpy as np

_WORDS = {
    "misalignment.pinion_offset": "misalignment E (offset)",
    "misalignment.pinion_axial": "misalignment P (pinion)",
    "misalignment.gear_axial": "misalignment G (gear)",
    "misalignment.shaft_angle": "misalignment Σ (shaft angle)",
}


def parameter_words(name: str) -> str:
    """Return a parameter's name as labels show it: without unit and section."""
    if name in _WORDS:
        return _WORDS[name]
    role, *_, field = name.split(".")
    for unit in ("_mm_per_rad", "_mm", "_deg", "_um"):
        field = field.removesuffix(unit)
    return f"{role}: {field.replace('_', ' ')}"


def tolerance_words(tolerance: float, unit: str) -> str:
    """Return a tolerance as labels show it, lengths in mm and angles in degrees."""
    if unit == "m":
        return f"{1e3 * tolerance:.3g} mm"
    if unit == "rad":
        return f"{np.degrees(tolerance):.3g}°"
    if unit == "deg":
        return f"{tolerance:.3g}°"
    return f"{tolerance:.3g}" + ("" if unit == "1" else f" {unit}")
