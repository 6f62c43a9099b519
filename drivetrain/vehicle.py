"""The vehicle as the road sees it: mass, drag, rolling resistance, gradient."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated

from gearlube_core.number import Number, check_fields

STANDARD_GRAVITY = 9.80665  # m/s2, [cgpm_1901]


@dataclass(frozen=True, slots=True, kw_only=True)
class Vehicle:
    """A vehicle on a road of constant gradient.

    Parameters
    ----------
    mass : float
        Mass of the loaded vehicle m [kg].
    frontal_area : float
        A_f [m2].
    drag_coefficient : float
        C_D [-].
    rolling_coefficient : float
        f_rl [-].
    air_density : float
        rho [kg/m3].
    grade : float
        Rise over horizontal distance; 0.05 is a 5 % climb [-].
    gravity : float
        g [m/s2].
    """

    mass: Annotated[float, Number("kg", 100.0, 1e5, "Give a mass, not a weight in newton.")]
    frontal_area: Annotated[float, Number("m2", 0.1, 20.0)]
    drag_coefficient: Annotated[float, Number("1", 0.0, 2.0)]
    rolling_coefficient: Annotated[float, Number("1", 0.0, 0.2, "Try 0.015.")]
    air_density: Annotated[float, Number("kg/m3", 0.0, 2.0, "Try 1.2 kg/m3.")]
    grade: Annotated[float, Number("1", -0.5, 0.5, "5 % is 0.05.")] = 0.0
    gravity: Annotated[float, Number("m/s2", 1.0, 30.0, "Try 9.80665 m/s2.")] = STANDARD_GRAVITY

    def __post_init__(self) -> None:
        check_fields(self)

    @property
    def rolling_resistance(self) -> float:
        """R_rl = f_rl m g cos(slope) [N] ([mohammadpour_2015 (8)])."""
        normal = self.mass * self.gravity * math.cos(math.atan(self.grade))
        return self.rolling_coefficient * normal

    @property
    def grade_resistance(self) -> float:
        """R_G = m g sin(slope) [N], positive uphill."""
        return self.mass * self.gravity * math.sin(math.atan(self.grade))

    @property
    def drag_area(self) -> float:
        """Air resistance over V^2: rho/2 C_D A_f [N s2/m2] ([mohammadpour_2015 (8)])."""
        return 0.5 * self.air_density * self.drag_coefficient * self.frontal_area


def mohammadpour_2015_vehicle(grade: float = 0.0) -> Vehicle:
    """Return the vehicle of [mohammadpour_2015 Table A3].

    Notes
    -----
    The table gives a "vehicle weight" of 1300 kg; it is the mass, and the weight W of
    [mohammadpour_2015 (8)] is m g. Grade zero is the flat road of the paper.
    """
    return Vehicle(
        mass=1300.0,
        frontal_area=2.2,
        drag_coefficient=0.33,
        rolling_coefficient=0.0166,
        air_density=1.22,
        grade=grade,
    )
