"""The parts of an FMU as data, independent of the FMI version and of the packing tool."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Protocol

from fmu_src.variable import Variable
from gearlube_core.arrays import Array
from gearlube_core.errors import ParameterError

Value = float | int | bool | str


class Stepped(Protocol):
    """A running model that is stepped."""

    @property
    def outputs(self) -> Array:
        """Present outputs, in the order of `Definition.output_names`."""

    @property
    def step(self) -> Callable[..., None]:
        """(h, *inputs): advance by h [s]; on failure raise a GearLubeError and keep the state."""


class Model(Stepped, Protocol):
    """Interface of a running model that a slave steps."""

    def exceeded(self) -> Mapping[str, str]:
        """Return the quantities out of range now: a sentence for each, by the output's name."""

    def get_state(self) -> Array:
        """Return the whole state, enough to continue from it."""

    def set_state(self, state: Array) -> None:
        """Continue from a state that `get_state` returned."""


# name of a flange -> its words; its variables: torque, speed and angle at a mechanical connection
FLANGES: Mapping[str, tuple[str, str, str, str]] = {
    "pinion": ("Pinion shaft", "pinion.torque", "pinion.speed", "pinion.angle"),
    "wheel": ("Shaft of the gear to the wheels", "wheel.torque", "wheel.speed", "wheel.angle"),
}

MAP = "org.fmi-standard.fmi-ls-struct.map"  # what kinds of members of a sampled map begin with


def _native_only(parameters: Mapping[str, Value], inputs: Sequence[float]) -> Model:
    raise ParameterError(
        "This model must run as a native FMU, got a start in Python. Build it without --python."
    )


@dataclass(frozen=True, kw_only=True, eq=False)
class Definition:
    """An FMU as data.

    Parameters
    ----------
    name : str
        Model name and model identifier.
    description : str
        One line for the user.
    variables : tuple of Variable
        The table; the place in it is the value reference.
    output_names : tuple of str
        Names of the model's outputs in the order of `Model.outputs`.
    start : callable
        (parameters by `Variable.argument`, input values) -> initialised `Model`; left out: the FMU
        is native only.
    stop_time, step_size : float
        Default experiment [s].
    slave : str
        Module of this package that becomes the script inside the FMU.
    shipped_data : tuple of str
        Files of the installed packages that the model reads, as `glob` patterns.
    resources : mapping of str to bytes
        Files inside the FMU for its model, by name.
    sources : tuple of str
        Files of code that the model needs and that the slave's module does not import.
    flanges : mapping
        As FLANGES; terminals of FMI 3.
    map_members : tuple of (str, str)
        Variables of FMI 3 that form one sampled map on a rectilinear grid, with their kinds.
    map_shape : tuple of int
        Points on each axis of that map.
    """

    name: str
    description: str
    variables: tuple[Variable, ...]
    output_names: tuple[str, ...]
    start: Callable[[Mapping[str, Value], Sequence[float]], Model] = _native_only
    stop_time: float
    step_size: float
    slave: str
    shipped_data: tuple[str, ...]
    resources: Mapping[str, bytes] = field(default_factory=dict)
    sources: tuple[str, ...] = ()
    flanges: Mapping[str, tuple[str, str, str, str]] = field(default_factory=lambda: FLANGES)
    map_members: tuple[tuple[str, str], ...] = ()
    map_shape: tuple[int, ...] = ()

    @cached_property
    def references(self) -> dict[str, int]:
        """Value reference of every name."""
        return {variable.name: i for i, variable in enumerate(self.variables)}

    @property
    def arguments(self) -> dict[str, str]:
        """Name under which the model takes each parameter."""
        return {v.name: v.argument for v in self.variables if v.argument}

    def start_model(self, parameters: Mapping[str, Value], inputs: Sequence[float]) -> Model:
        """Return the initialised model; parameters by FMI name, enumerations by literal."""
        return self.start({self.arguments[name]: v for name, v in parameters.items()}, inputs)

    def references_of(self, causality: str) -> list[int]:
        """Return the value references of all variables with this causality."""
        return [i for i, v in enumerate(self.variables) if v.causality == causality]
