"""Thermal data of the oil of a film."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, NamedTuple

from gearlube_core.checks import check_option, check_positive, check_within


class HeatRise(NamedTuple):
    """How conductivity and heat capacity by volume rise with pressure: 1 + a p/(1 + b p) each."""

    conductivity: float  # a [1/Pa]
    conductivity_bend: float  # b [1/Pa]
    capacity: float
    capacity_bend: float


# [larsson_andersson_2000], to 1.1 GPa; as two published programs quote it
HEAT_RISES = {
    "none": HeatRise(0.0, 0.0, 0.0, 0.0),
    "mineral": HeatRise(1.72e-9, 0.54e-9, 0.47e-9, 0.81e-9),
    "pao": HeatRise(1.40e-9, 0.34e-9, 0.41e-9, 1.05e-9),
}
HeatUnderPressure = Literal["none", "mineral", "pao"]


@dataclass(frozen=True, slots=True)
class OilHeat:
    """Thermal data of an oil for thermal solutions.

    The default conductivity lies 4 % above that of the mineral oil FVA 3, 0.134 W/(m K)
    [wingertszahn_2023]. The default heat capacity is assumed; no source was compared.

    Parameters
    ----------
    expansion
        Coefficient of thermal volume expansion [1/K], 0 to 0.01.
    conductivity
        Thermal conductivity [W/(m K)], positive.
    heat_capacity
        Specific heat capacity [J/(kg K)], positive.
    under_pressure
        Class of base oil by which conductivity and heat capacity rise with pressure in films;
        "none": they do not. These rises are not checked against the source.

    Raises
    ------
    ParameterError
        When a number is out of range.

    Examples
    --------
    >>> OilHeat(conductivity=0.13).heat_capacity  # J/(kg K)
    2000.0
    """

    expansion: float = 0.0
    conductivity: float = 0.14
    heat_capacity: float = 2000.0
    under_pressure: HeatUnderPressure = "none"

    def __post_init__(self) -> None:
        check_within("expansion", self.expansion, 0.0, 1e-2, "1/K")
        check_positive("conductivity", self.conductivity, "W/(m K)")
        check_positive("heat_capacity", self.heat_capacity, "J/(kg K)")
        check_option("under_pressure", self.under_pressure, HEAT_RISES)
