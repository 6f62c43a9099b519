"""Line contacts of the tests of the film solver."""

from __future__ import annotations

from typing import Any

from gearlube_core.ehl.line.problem import LineProblem
from gearlube_core.oil.film_oil_data import jamali_2015_oil

_ENTRAINMENT = 6.71  # m/s


def thesis_line(*, slide_roll: float = 0.3632, **changes: Any) -> LineProblem:
    """Return the smooth line contact of Jamali 2015, chapter 7, with some of its data changed."""
    given = {
        "lubricant": jamali_2015_oil(),
        "radius": 0.014,
        "line_load": 360e3,
        "reduced_modulus": 227.5e9,
        "speed_1": _ENTRAINMENT * (1.0 + 0.5 * slide_roll),
        "speed_2": _ENTRAINMENT * (1.0 - 0.5 * slide_roll),
    }
    return LineProblem(**(given | changes))
