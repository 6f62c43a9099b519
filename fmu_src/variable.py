"""One FMI variable, described without reference to an FMI version."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, get_args

from gearlube_core.checks import check_option
from gearlube_core.errors import ParameterError

VariableType = Literal["Real", "Integer", "Boolean", "Enumeration"]
Causality = Literal["parameter", "input", "output", "local"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Variable:
    """A variable of an FMU; its value reference is its place in the table.

    Parameters
    ----------
    name : str
        FMI name of the structured naming convention.
    type : {"Real", "Integer", "Boolean", "Enumeration"}
        FMI 2 type. FMI 3 calls them Float64, Int32, Boolean and Enumeration.
    causality : {"parameter", "input", "output", "local"}
        A parameter is fixed after initialisation. A local is computed as an output is, but meant
        for no connection: what else a solver needs.
    description : str
        One line for the user.
    unit, display_unit : str
        Names from `fmu_src.units`; every Real has a unit, "1" when dimensionless.
    start : float, optional
        Start value in `unit`; an enumeration counts its literals from 1. Outputs have none.
    minimum, maximum : float, optional
        Closed range of legal values, in `unit`.
    nominal : float, optional
        Typical magnitude, in `unit`.
    literals : tuple of str
        Items of an enumeration, in the order of their values 1, 2, ...
    argument : str
        Of a parameter: name of the model's argument.
    option_of : str
        Name of the enumeration that this Integer parameter sets by number, for hosts that know no
        enumerations; 0 leaves it as it is.
    rate_of : str
        Name of the variable whose derivative by time this is.
    """

    name: str
    type: VariableType
    causality: Causality
    description: str
    unit: str = ""
    display_unit: str = ""
    start: float | None = None
    minimum: float | None = None
    maximum: float | None = None
    nominal: float | None = None
    literals: tuple[str, ...] = ()
    argument: str = ""
    option_of: str = ""
    rate_of: str = ""

    def __post_init__(self) -> None:
        check_option(f"type of {self.name}", self.type, get_args(VariableType))
        check_option(f"causality of {self.name}", self.causality, get_args(Causality))
        if (self.start is None) != self.is_computed:
            raise ParameterError(f"{self.name} must have a start value unless it is computed.")
        if (self.type == "Real") != bool(self.unit):
            raise ParameterError(f"{self.name} must have a unit if, and only if, it is Real.")
        if (self.type == "Enumeration") != bool(self.literals):
            raise ParameterError(f"{self.name} must have literals if it is an Enumeration.")
        if (self.causality == "parameter") != bool(self.argument or self.option_of):
            raise ParameterError(f"{self.name} must have an argument if it is a parameter.")

    @property
    def is_computed(self) -> bool:
        """Whether the model computes it: an output or a local."""
        return self.causality in ("output", "local")

    @property
    def is_model_parameter(self) -> bool:
        """Whether the model takes it by `argument`; an option by number only stands for one."""
        return self.causality == "parameter" and not self.option_of

    @property
    def variability(self) -> str:
        """FMI variability: parameters are fixed, Real signals continuous, others discrete."""
        if self.causality == "parameter":
            return "fixed"
        return "continuous" if self.type == "Real" else "discrete"

    @property
    def initial(self) -> str | None:
        """FMI 2 attribute `initial`; inputs must not have one."""
        return "calculated" if self.is_computed else {"parameter": "exact"}.get(self.causality)

    @property
    def range(self) -> tuple[float, float]:
        """Closed range of legal values [unit]; every item of an enumeration is legal."""
        if self.type == "Enumeration":
            return 1.0, float(len(self.literals))
        low = -float("inf") if self.minimum is None else self.minimum
        high = float("inf") if self.maximum is None else self.maximum
        return low, high

    def decoded(self, value: float) -> float | int | bool | str:
        """Return `value` as the type that the model takes: an enumeration becomes its literal."""
        if self.type == "Enumeration":
            return self.literals[int(value) - 1]
        if self.type == "Integer":
            return int(value)
        return bool(value) if self.type == "Boolean" else float(value)
