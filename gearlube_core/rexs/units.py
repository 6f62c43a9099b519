"""Units of REXS attributes, and other spellings that files have."""

from __future__ import annotations

from gearlube_core.errors import ParameterError
from gearlube_core.units import DEGREE

# unit of the data base of [fva_2022] and how much of it one of another is
_SAME = {
    "mm": {"mm": 1.0, "m": 1e3, "cm": 10.0, "mum": 1e-3, "um": 1e-3, "µm": 1e-3, "in": 25.4},
    "deg": {"deg": 1.0, "°": 1.0, "rad": 1.0 / DEGREE},
    "none": {"none": 1.0},
}


def converted(value: float, unit: str, wanted: str, what: str) -> float:
    """Return a value in the unit that is wanted.

    Parameters
    ----------
    value : float
    unit : str
        As the file says; empty: that of the data base, which is the one that is wanted.
    wanted : str
        "mm", "deg" or "none".
    what : str
        Names the attribute in errors.

    Raises
    ------
    ParameterError
        The unit is of another kind.

    Examples
    --------
    >>> converted(0.25, "m", "mm", "face_width")
    250.0
    """
    factors = _SAME[wanted]
    if unit and unit not in factors:
        raise ParameterError(
            f"{what} must have a unit out of {', '.join(factors)}, got {value:g} {unit!r}. Correct "
            "the unit in the file"
        )
    return value * factors[unit or wanted]
