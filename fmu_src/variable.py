"""One FMI variable without reference to an FMI version, its kinds, outputs of all models."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Sequence
from dataclasses import dataclass, fields, replace
from typing import Any, Literal, TypeVar, get_args, get_type_hints

from gearlube_core.checks import check_option
from gearlube_core.dynamics.ranges import MAX_SPEED
from gearlube_core.dynamics.train.elements.held_port import Hold, SpeedHolder
from gearlube_core.dynamics.train.stepped_model import SteppedModel
from gearlube_core.errors import ParameterError
from gearlube_core.number import Output, numbers_of
from gearlube_core.oil.lubricant import Lubricant

VariableType = Literal["Real", "Integer", "Boolean", "Enumeration"]
Causality = Literal["parameter", "input", "output", "local"]
# unit of a state -> unit and typical size of its derivative
_RATES = {
    "m": ("m/s", 0.01),
    "m/s": ("m/s2", 10.0),
    "rad": ("rad/s", 100.0),
    "rad/s": ("rad/s2", 1e3),
    "J": ("W", 1e3),
    "N.m": ("N.m/s", 1e3),
}
_Started = TypeVar("_Started", bound=SteppedModel[Any])
MEMBERS = (("pinion", "pinion"), ("wheel", "gear"))  # in names, in words


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
        Names from `fmu_src.model_description`; every Real has a unit, "1" when dimensionless.
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


def input_(name: str, unit: str, description: str, **limits: float | str) -> Variable:
    """Return a Real input."""
    return Variable(
        name=name, type="Real", causality="input", unit=unit, description=description,
        **limits,  # type: ignore[arg-type]
    )  # fmt: skip


def parameter(name: str, unit: str, description: str, **limits: float | str) -> Variable:
    """Return a Real parameter."""
    return Variable(
        name=name, type="Real", causality="parameter", unit=unit, description=description,
        **limits,  # type: ignore[arg-type]
    )  # fmt: skip


def declared(model: type, argument: str, name: str = "", text: str = "", **shown: Any) -> Variable:
    """Return the parameter of a number that a model declares: its unit, limits and default.

    Parameters
    ----------
    model : type
        Dataclass with the number.
    argument : str
        Name of the field.
    name, text : str
        FMI name and description; by default those of the declaration.
    **shown
        Nominal value and display unit; a start value where the field has no default; other limits.
    """
    one = numbers_of(model)[argument]
    given: dict[str, Any] = {field.name: field.default for field in fields(model)}
    given = {"start": given[argument], "minimum": one.low, "maximum": one.high} | shown
    real = get_type_hints(model)[argument] is not int
    return Variable(
        name=name or one.fmi, type="Real" if real else "Integer", causality="parameter",
        description=text or one.text, unit=one.unit if real else "", argument=argument, **given,
    )  # fmt: skip


def declared_in(model: type, known: Collection[str]) -> tuple[Variable, ...]:
    """Return the parameters of all numbers with an FMI name, but those `known` by argument."""
    found = numbers_of(model).items()
    return tuple(declared(model, name) for name, one in found if one.fmi and name not in known)


def declared_outputs(outputs: Iterable[Output]) -> tuple[Variable, ...]:
    """Return the outputs that a model declares beside its kernels."""
    return tuple(output(one.name, one.unit, one.text, one.nominal, one.shown) for one in outputs)


def declared_locals(outputs: Iterable[Output]) -> tuple[Variable, ...]:
    """Return the locals of a model that solvers need."""
    return tuple(local(one.name, one.unit, one.text, one.nominal, one.shown) for one in outputs)


def in_order(released: Sequence[str], *variables: Variable) -> tuple[Variable, ...]:
    """Return variables that a model declares: the released names in their order, then new ones."""
    place = {name: i for i, name in enumerate(released)}
    return tuple(sorted(variables, key=lambda one: place.get(one.name, len(place))))


def option(name: str, description: str, *literals: str, start: str, argument: str) -> Variable:
    """Return an enumeration for a model option."""
    return Variable(
        name=name, type="Enumeration", causality="parameter", description=description,
        start=1 + literals.index(start), literals=literals, argument=argument,
    )  # fmt: skip


def options_by_number(variables: Sequence[Variable]) -> tuple[Variable, ...]:
    """Return an Integer parameter for each enumeration, for hosts without enumerations."""
    return tuple(
        Variable(
            name=f"{one.name}.number", type="Integer", causality="parameter",
            description=f"{one.name} by number, starting at 1; 0 keeps the value of {one.name}",
            start=0, minimum=0, maximum=len(one.literals), option_of=one.name,
        )
        for one in variables if one.literals
    )  # fmt: skip


def count(
    name: str, description: str, start: int, minimum: int, maximum: int, argument: str
) -> Variable:
    """Return an Integer parameter."""
    return Variable(
        name=name, type="Integer", causality="parameter", description=description,
        start=start, minimum=minimum, maximum=maximum, argument=argument,
    )  # fmt: skip


def local(
    name: str, unit: str, description: str, nominal: float = 1.0, display_unit: str = ""
) -> Variable:
    """Return a Real that a solver needs and no connection."""
    return replace(output(name, unit, description, nominal, display_unit), causality="local")


def rates(states: Sequence[Variable]) -> tuple[Variable, ...]:
    """Return the derivative by time of each continuous state.

    Raises
    ------
    ParameterError
        A state has a unit whose rate has none.
    """
    for one in states:
        check_option(f"unit of the state {one.name}", one.unit, tuple(_RATES))
    return tuple(
        replace(
            local(f"der({one.name})", unit, f"Time derivative: {_in_a_sentence(one)}", nominal),
            rate_of=one.name,
        )
        for one in states
        for unit, nominal in [_RATES[one.unit]]
    )  # fmt: skip


def _in_a_sentence(variable: Variable) -> str:
    return variable.description[0].lower() + variable.description[1:]


def output(
    name: str, unit: str, description: str, nominal: float = 1.0, display_unit: str = ""
) -> Variable:
    """Return a Real output."""
    return Variable(
        name=name, type="Real", causality="output", unit=unit, description=description,
        nominal=nominal, display_unit=display_unit,
    )  # fmt: skip


def motion() -> tuple[Variable, ...]:
    """Return rotation, speed and acceleration of both members."""
    angle = [output(f"{m}.angle", "rad", f"Rotation of the {w}", display_unit="deg")
             for m, w in MEMBERS]  # fmt: skip
    speed = [output(f"{m}.speed", "rad/s", f"Speed of the {w}", 100.0, "rpm") for m, w in MEMBERS]
    acceleration = [output(f"{m}.acceleration", "rad/s2", f"Angular acceleration of the {w}", 1e3)
                    for m, w in MEMBERS]  # fmt: skip
    return (*angle, *speed, *acceleration)


def displacements(member: str, word: str) -> tuple[Variable, ...]:
    """Return the displacements of a member."""
    return tuple(
        output(f"{member}.displacement.{axis}", "m", f"Displacement of the {word} along {axis}",
               1e-5, "um")
        for axis in "xyz"
    )  # fmt: skip


def velocities(member: str, word: str) -> tuple[Variable, ...]:
    """Return the velocities of a member."""
    return tuple(
        local(f"{member}.velocity.{axis}", "m/s", f"Velocity of the {word} along {axis}", 0.01)
        for axis in "xyz"
    )


def tilt_speeds(member: str, word: str) -> tuple[Variable, ...]:
    """Return the speeds at which a member tilts."""
    return tuple(
        local(f"{member}.tilt_speed.{axis}", "rad/s", f"Tilting speed of the {word} about {axis}",
              0.1)
        for axis in "xy"
    )  # fmt: skip


# oils that every FMU of gears has; as their numbers never change, new ones stand at the end
OILS = ("mohammadpour_2015", "karagiannis_2012", "jamali_2015", "fva_3", "fva_3a",
        "arana_2019_m100", "arana_2019_n100", "arana_2019_pao100")  # fmt: skip


def oil_name() -> Variable:
    """Return the choice of the oil."""
    return option("oil.name", "Name of the lubricant", *OILS, start=OILS[0], argument="oil")


def speed_hold(start: float) -> tuple[Variable, ...]:
    """Return the variables that hold the pinion's speed; `start` is the first reference [rad/s]."""
    hold = option("speed.hold", "What holds the speed of the pinion: nothing, a governor, whose "
                  "torque is its gain times the error of the speed, or an imposed motion",
                  *get_args(Hold), start="none", argument="mode")  # fmt: skip
    return (
        input_("speed.reference", "rad/s", "Speed at which the pinion is held, see speed.hold",
               display_unit="rpm", start=start, minimum=-MAX_SPEED, maximum=MAX_SPEED,
               nominal=100.0),
        hold,
        *options_by_number((hold,)),
        declared(SpeedHolder, "governor_gain", "speed.governor_gain", nominal=10.0),
        declared(SpeedHolder, "time_constant", "speed.time_constant", nominal=1e-3),
    )  # fmt: skip


# arguments of a run, no properties of the gears: the start speed, and those of `speed_hold`
OF_HOLDER = ("mode", *numbers_of(SpeedHolder))  # in the order of `SpeedHolder.numbers`
OF_RUN = ("pinion_speed", *OF_HOLDER)


def taken_holder(arguments: dict[str, Any]) -> SpeedHolder:
    """Return the holder of a speed, whose arguments are taken out of a mapping."""
    return SpeedHolder(**{one: arguments.pop(one) for one in OF_HOLDER if one in arguments})


def started(model: _Started, speed: float, inputs: Sequence[float]) -> _Started:
    """Return a model that is initialised at a speed of the pinion under inputs in their order.

    They are pinion.torque [N.m], wheel.torque [N.m], oil.temperature [K], speed.reference [rad/s];
    without the last, the start speed.
    """
    names = "pinion_torque", "wheel_torque", "oil_temperature", "speed_reference"
    model.initialise(pinion_speed=speed, **dict(zip(names, inputs, strict=False)))
    return model


def load_level() -> Variable:
    """Return the state by which the load level of the mesh data follows the pinion torque."""
    return local("mesh.load_torque", "N.m", "Pinion torque at which the mesh data are read: "
                 "absolute value, low-pass filtered with 20 ms", 100.0)  # fmt: skip


def energies(words: dict[str, str]) -> tuple[Variable, ...]:
    """Return energies by name and description."""
    return tuple(output(f"energy.{name}", "J", text, 100.0) for name, text in words.items())


def ranges() -> tuple[Variable, ...]:
    """Return the quantities that decide whether tables and formulas are within their ranges."""
    at = "at the most loaded contact; 0 when not in use"
    return (
        Variable(
            name="range.exceeded", type="Integer", causality="output",
            description="0: all quantities are in range; else the sum of 1 torque, 2 film_load, "
            "4 film_material, 8 traction, 16 temperature, 32 pressure, see docs/fmu.md",
        ),
        output("range.torque", "N.m", "Pinion torque of the mesh data, or the torque of the "
               "teeth if larger; negative on the coast flanks", 100.0),
        output("range.film_load", "1", f"Load group M of Moes {at}", 1e3),
        output("range.film_material", "1", f"Material group L of Moes {at}", 10.0),
        output("range.traction", "1", f"Dimensionless group of the traction map {at}", 10.0),
        output("range.temperature", "K", f"Film temperature {at}", 300.0, "degC"),
        output("range.pressure", "Pa", f"Largest Hertz pressure {at}", 1e9, "GPa"),
    )  # fmt: skip


def with_own_oil(variable: Variable, oil: Lubricant, custom: str) -> Variable:
    """Return oil.name or its number as of a file with an oil of its own; other variables as is.

    The oil is a new literal, `custom`. With a law of its own it is the only one: the FMU is
    compiled for it.
    """
    alone = bool(oil.own_laws())
    if variable.option_of == "oil.name":
        return replace(variable, maximum=1.0 if alone else (variable.maximum or 0.0) + 1.0)
    if variable.name != "oil.name":
        return variable
    literals = (custom,) if alone else (*variable.literals, custom)
    text = variable.description
    if alone:
        own = [law.name for law in oil.laws if not getattr(law, "formulas_know", law.ships)]
        laws = " and ".join(own)
        text += f", of the file alone: {', '.join(variable.literals)} do not have its law {laws}"
    return replace(variable, literals=literals, start=float(len(literals)), description=text)
