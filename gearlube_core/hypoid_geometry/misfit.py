"""A number that must vanish in a gear file that is right, with the limit above which it is not."""

from __future__ import annotations

import math
from dataclasses import dataclass

from gearlube_core.units import DEGREE, MILLIMETRE

_SIZES = {"mm": MILLIMETRE, "deg": DEGREE, "mrad": 1e-3, "%": 1e-2, "": 1.0}


@dataclass(frozen=True, slots=True, kw_only=True)
class Misfit:
    """One check of a gear file.

    Parameters
    ----------
    what : str
        What differs, as the subject of a sentence.
    value : float
        By how much, in SI units; NaN where the settings do not even allow the question.
    limit : float
        Largest value of a sound file, in SI units.
    refused : float
        Largest value with which an analysis starts; between both limits a file gets a warning.
    unit : {"mm", "deg", "mrad", "%", ""}
        Of both numbers in the sentence.
    fields : tuple of str
        Dotted names of the settings that decide it.
    reason : str
        Stands for the sentence where the value is NaN.
    """

    what: str
    value: float
    limit: float
    refused: float
    unit: str
    fields: tuple[str, ...]
    reason: str = ""

    @property
    def share(self) -> float:
        """Value over limit [-], without sign; infinite for NaN."""
        return math.inf if math.isnan(self.value) else abs(self.value) / self.limit

    @property
    def is_sound(self) -> bool:
        """Whether the value is within the limit of sound files."""
        return self.share <= 1.0

    @property
    def is_refused(self) -> bool:
        """Whether an analysis must not start."""
        return not abs(self.value) <= self.refused

    def __str__(self) -> str:
        if math.isnan(self.value):
            return self.reason
        size = _SIZES[self.unit]
        unit = f" {self.unit}" if self.unit else ""
        return (
            f"{self.what} must be within {self.limit / size:g}{unit}, got "
            f"{self.value / size:.3g}{unit}."
        )
