"""Thermal data of the oil of a film."""

from __future__ import annotations

from dataclasses import dataclass

from gearlube_core.checks import check_positive, check_within


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

    def __post_init__(self) -> None:
        check_within("expansion", self.expansion, 0.0, 1e-2, "1/K")
        check_positive("conductivity", self.conductivity, "W/(m K)")
        check_positive("heat_capacity", self.heat_capacity, "J/(kg K)")
