"""Torque from outside on a body."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Any, ClassVar, NamedTuple

from gearlube_core.arrays import Array
from gearlube_core.dynamics.train.element import RATE, RZ, Listed, W
from gearlube_core.dynamics.train.part import Element
from gearlube_core.errors import ParameterError
from gearlube_core.kernels.inlining import inside
from gearlube_core.kernels.jit import kernel
from gearlube_core.number import Number, check_fields
from gearlube_core.oil.lubricant_state import LubricantState


class _Port(NamedTuple):
    sign: float  # of its torque about z

    @inside
    def add_forces(
        self, at: Any, memory: Array, s: Array, oil: LubricantState, stage: int, ds: Array
    ) -> None:
        body, work, given = at
        torque = self.sign * s[given]
        ds[body + RATE + RZ] += torque
        ds[work] += torque * s[body + W]

    @kernel
    def check(self, at: Any, memory: Array, s: Array, oil: LubricantState, kept: int) -> float:
        return 1.0 if kept == 1 else 0.0


@dataclass(frozen=True, slots=True, kw_only=True)
class Port(Element):
    """A torque on a body, an input of the train: the first number that it keeps.

    Parameters
    ----------
    name : str
    body : str
    sign : float
        +1 where a positive torque acts about +z, -1 about -z.

    Examples
    --------
    >>> Port(name="motor", body="rotor", sign=-1.0).numbers().sign
    -1.0
    """

    name: str
    body: str
    sign: Annotated[
        float, Number("1", -1.0, 1.0, text="1: a positive torque acts about +z, -1: about -z")
    ] = 1.0
    kind: ClassVar = "port"
    interpreted: ClassVar = (Listed(_Port, (), 3),)
    linear: ClassVar = True  # the torque does not depend on motion
    on: ClassVar[tuple[str, ...]] = ("body",)
    works: ClassVar = ("work",)

    def __post_init__(self) -> None:
        check_fields(self)
        if abs(self.sign) != 1.0:
            raise ParameterError(f"sign of {self.name} must be 1 or -1, got {self.sign:g}.")

    def numbers(self) -> _Port:
        """Return the constants of the kernels."""
        return _Port(float(self.sign))

    def kept_size(self) -> int:
        """Return the place of the torque."""
        return 1
