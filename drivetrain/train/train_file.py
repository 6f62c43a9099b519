"""The train file: a drivetrain as a list of bodies and elements."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Annotated, Any, ClassVar, Self

import numpy as np
from pydantic import Field

from drivetrain.axle_file.car_sections import Inertia, TyreSection, VehicleSection
from drivetrain.driveline.parameters import DrivelineParameters
from drivetrain.road_load import RoadLoad
from drivetrain.train.part_section import BODIES, OF_THE_TRAIN, files_in, read_part
from gearlube_core.checks import check_within, is_it
from gearlube_core.dynamics.ranges import MAX_SPEED
from gearlube_core.dynamics.train.choice import Driver
from gearlube_core.dynamics.train.elements.motor import Motor
from gearlube_core.dynamics.train.elements.port import Port
from gearlube_core.dynamics.train.housing import Housing
from gearlube_core.dynamics.train.model import MOST_TORQUE, Integration, Train
from gearlube_core.dynamics.train.part import ELEMENTS, Body, Element
from gearlube_core.dynamics.train.plan import MOST_EXPONENTIAL
from gearlube_core.dynamics.train.shaft import Shaft
from gearlube_core.errors import GearLubeError, ParameterError
from gearlube_core.input_file.input_file import InputFile, Section
from gearlube_core.input_file.refusal import wrong_fields
from gearlube_core.oil.oil_file import Temperature, read_oil
from gearlube_core.units import ZERO_CELSIUS, rads_to_rpm, rpm_to_rads

_NAME = re.compile(r"[A-Za-z]\w{0,62}", re.ASCII)
_RESERVED = ("oil", "range", "energy", "efficiency", "start")  # words of the FMU's own variables
_PARTS = ("bodies", "elements")
_SHOWN = 80  # signs of a wrong text
Text = Annotated[str, Field(min_length=1)]
_FASTEST = rads_to_rpm(MAX_SPEED)
_NO_MODE = 0.5  # Hz, below which nothing brings a motion back: bearings and mounts have more


class OilSection(Section):
    """The oil of all elements."""

    name: Text = Field(description="Name of a shipped oil, or an oil file (.toml)")


class StartSection(Section):
    """The state at the start: a static equilibrium, turning."""

    oil_temperature_degc: Temperature = Field(default=60.0, description="Temperature of the oil")
    speed_rpm: dict[str, float] = Field(
        description="Speeds about z of as many bodies as can turn independently, by their names; "
        "all others follow"
    )
    torque_n_m: dict[str, float] = Field(
        description="Torques of the ports by their names; those left out are 0. The first bodies "
        "with a speed bear what they leave, as many as can turn independently"
    )


class CarSection(VehicleSection):
    """The vehicle that the loads drive, for drive cycles."""

    wheel_inertia_kg_m2: Inertia | None = Field(
        default=None,
        description="Moment of inertia of one of its four wheels with tyre and brake disc",
    )


@dataclass(frozen=True, kw_only=True)
class TrainCase:
    """A train with what it starts from.

    Parameters
    ----------
    name : str
    train : Train
    speeds : mapping
        Of bodies [rad/s].
    torques : mapping
        Of all ports [N.m].
    oil_temperature : float
        [K]
    car : DrivelineParameters, optional
        Whose wheels the loads are, for drive cycles: its vehicle, tyres and wheels.
    """

    name: str
    train: Train
    speeds: Mapping[str, float]
    torques: Mapping[str, float]
    oil_temperature: float
    car: DrivelineParameters | None = None

    def start(self) -> Train:
        """Return the train in static equilibrium, turning.

        Raises
        ------
        ParameterError, ConvergenceError
            See `Train.initialise`; or the pull of a motor draws its rotor away.
        """
        self.train.initialise(self.speeds, self.torques, self.oil_temperature)
        pulled = [one for one in self.train.elements if isinstance(one, Motor)]
        if any(one.pull_stiffness > 0.0 for one in pulled):
            still = int(np.sum(self.train.modes()[0] < _NO_MODE))
            if still > len(self.speeds):
                named = ", ".join(f"{one.pull_stiffness:g} N/m of {one.name}" for one in pulled)
                raise ParameterError(
                    "pull_stiffness must be below what bearings and shafts resist, got "
                    f"{named}: {still - len(self.speeds)} motion(s) that nothing brings back. "
                    "Lower it, or stiffen the bearings of the rotor."
                )
        return self.train


class TrainFile(InputFile):
    """Train file: the bodies of a drivetrain and the elements that act on them.

    Examples
    --------
    >>> TrainFile.shipped()[:4]
    ('e_axle', 'e_axle_case', 'e_axle_elastic', 'e_axle_full')
    >>> axle = TrainFile.named("e_axle").case().start()
    >>> round(axle.state("motor.rz.rate"), 1)  # rad/s
    -314.1
    """

    package: ClassVar[str] = "drivetrain.train"
    title: ClassVar[str] = "train file"
    files: ClassVar[tuple[str, ...]] = ("oil.name",)

    name: Text = Field(description="Name of the drivetrain; that of its FMU without signs")
    source: Text | None = Field(default=None, description="Where the numbers come from")
    steps_per_highest_period: Annotated[int, Field(ge=6, le=4096)] = Field(
        default=16, description="Integrator steps per period of the highest mode"
    )
    driver: Driver = Field(
        default="automatic",
        description="interpreted: code for all lists, which compiles nothing; generated: code of "
        "this list, 10 to 25 % faster; automatic: interpreted where all elements are shipped ones",
    )
    integration: Integration = Field(
        default="automatic",
        description="rk4; exponential: longer steps, exact in all that is linear",
    )
    exponential_steps_per_ms: Annotated[int, Field(ge=1, le=MOST_EXPONENTIAL)] = Field(
        default=25, description="Exponential steps a ms, at least"
    )
    oil: OilSection
    start: StartSection
    vehicle: CarSection | None = Field(default=None, description="The vehicle, for drive cycles")
    tyre: TyreSection | None = Field(default=None, description="Its tyres")
    bodies: dict[str, dict[str, Any]] = Field(description="The bodies by name, each a section")
    elements: dict[str, dict[str, Any]] = Field(
        description="The elements by name, each a section with its kind; their order is that of "
        "the sums"
    )

    @classmethod
    def from_data(cls, data: dict[str, Any], where: str) -> Self:
        """Return the file of parsed TOML `data`, checked with all that it names.

        Raises
        ------
        ParameterError
            Names every field that is wrong.
        """
        whole = {key: _completed(data[key]) for key in _PARTS if key in data}
        found = super().from_data(data | whole, where)
        wrong = found._parts()[2]
        if wrong:
            raise wrong_fields(where, wrong)
        try:
            found.case()
        except GearLubeError as reason:
            raise ParameterError(f"{where}: {reason}") from None
        return found

    @classmethod
    def file_fields(cls, data: Mapping[str, Any]) -> tuple[str, ...]:
        """Return the dotted fields that name a file, those of the bodies and elements too."""
        found = list(cls.files)
        for section, known in (("bodies", BODIES), ("elements", ELEMENTS.known())):
            parts = _completed(data.get(section))
            for name, given in parts.items() if isinstance(parts, dict) else ():
                kind = given.get("kind") if isinstance(given, dict) else None
                if isinstance(kind, str) and kind in known and "." not in name:
                    found += [f"{section}.{name}.{key}" for key in files_in(known[kind])]
        return tuple(found)

    def _parts(self) -> tuple[list[Body | Shaft | Housing], list[Element], list[str]]:
        """Return bodies and elements, and what is wrong with them, in sentences."""
        wrong = [
            f"{section}.{name[:_SHOWN]} must have a name of letters, digits and _, at most 63, "
            f"that is none of {', '.join(_RESERVED)}."
            for section in _PARTS
            for name in getattr(self, section)
            if not _NAME.fullmatch(name) or name in _RESERVED
        ]
        wrong += [
            f"{section}.{name[:_SHOWN]}.like must name a section of {section} above it, got "
            f"{str(given['like'])[:_SHOWN]!r}."
            for section in _PARTS
            for name, given in getattr(self, section).items()
            if "like" in given
        ]
        wrong += [
            f"elements.{name} has the name of a body. Give it a name of its own."
            for name in self.elements
            if name in self.bodies
        ]
        bodies, elements = [], []
        of_train = {name: getattr(self, name) for name in OF_THE_TRAIN}
        for name, given in self.bodies.items():
            if "like" in given:
                continue
            kind = given.get("kind", "rigid")
            if not isinstance(kind, str) or kind not in BODIES:
                wrong.append(
                    f"bodies.{name}.kind must be one of {', '.join(BODIES)}, got "
                    f"{str(kind)[:_SHOWN]!r}.{is_it(kind, BODIES)}"
                )
                continue
            body, problems = read_part(BODIES[kind], name, given, f"bodies.{name}", of_train)
            if isinstance(body, Shaft | Housing):
                problems += [
                    f"bodies.{name}.nodes: {node[:_SHOWN]!r} must be a name of letters, digits and "
                    "_, at most 63."
                    for node in body.nodes
                    if not _NAME.fullmatch(node)
                ]
            wrong += problems
            bodies += [body] if body else []
        for name, given in self.elements.items():
            if "like" in given:
                continue
            kind = given.get("kind", "")
            known = ELEMENTS.known(kind if isinstance(kind, str) else "")
            if not isinstance(kind, str) or kind not in known:
                wrong.append(
                    f"elements.{name}.kind must be one of {', '.join(known)}, got "
                    f"{str(kind)[:_SHOWN]!r}.{is_it(kind, known)} One of your own must be "
                    f"imported first, or be an entry point of {ELEMENTS.group}."
                )
                continue
            element, problems = read_part(known[kind], name, given, f"elements.{name}", of_train)
            wrong += problems
            elements += [element] if element else []
        return bodies, elements, wrong

    def case(self) -> TrainCase:
        """Return the train with what it starts from.

        Raises
        ------
        GearLubeError
            A file that an element names is wrong, or the parts do not fit together.
        """
        bodies, elements, _ = self._parts()
        ports = [one.name for one in elements if isinstance(one, Port)]
        for field, given, there, most, unit in (
            ("start.torque_n_m", self.start.torque_n_m, ports, MOST_TORQUE, "N.m"),
            ("start.speed_rpm", self.start.speed_rpm, list(self.bodies), _FASTEST, "rpm"),
        ):
            for name, value in given.items():
                check_within(f"{field}.{name}", value, -most, most, unit)
                if name not in there:
                    known = ", ".join(there) or "none"
                    raise ParameterError(
                        f"{field}.{name} names nothing of the train. There are: {known}."
                        f"{is_it(name, there)}"
                    )
        if not self.start.speed_rpm:
            raise ParameterError("start.speed_rpm must name a body with its speed, got none.")
        oil = read_oil(self.oil.name).lubricant
        kelvin = self.start.oil_temperature_degc + ZERO_CELSIUS
        oil.check_temperature(kelvin, "start.oil_temperature_degc, in K,")
        train = Train(
            bodies,
            elements,
            oil,
            steps_per_highest_period=self.steps_per_highest_period,
            driver=self.driver,
            integration=self.integration,
            exponential_steps_per_ms=self.exponential_steps_per_ms,
        )
        return TrainCase(
            name=self.name,
            train=train,
            speeds={name: rpm_to_rads(one) for name, one in self.start.speed_rpm.items()},
            torques={name: self.start.torque_n_m.get(name, 0.0) for name in ports},
            oil_temperature=kelvin,
            car=self._car(),
        )

    def _car(self) -> DrivelineParameters | None:
        if self.vehicle is None and self.tyre is None:
            return None
        vehicle, tyre = self.vehicle or CarSection(), self.tyre or TyreSection()
        drag = vehicle.drag_area_m2 or (vehicle.frontal_area_m2 and vehicle.drag_coefficient)
        other = [*{"frontal_area_m2", "drag_coefficient"} - vehicle.model_fields_set]
        given = {
            "vehicle.mass_kg": vehicle.mass_kg,
            "vehicle.rolling_coefficient": vehicle.rolling_coefficient,
            f"vehicle.{other[0] if len(other) == 1 else 'drag_area_m2'}": drag,
            "vehicle.wheel_inertia_kg_m2": vehicle.wheel_inertia_kg_m2,
            "tyre.size": tyre.size or tyre.rolling_radius_mm or tyre.unladen_radius_mm,
        }
        if missing := [name for name, value in given.items() if value is None]:
            raise ParameterError(
                f"The vehicle of a train needs {', '.join(given)}; got no {', '.join(missing)}. "
                "Give them, or leave out [vehicle] and [tyre]."
            )
        return DrivelineParameters(
            road_load=RoadLoad(vehicle=vehicle.vehicle(), tyre=tyre.tyre()),
            wheel_inertia=vehicle.si("wheel_inertia_kg_m2"),
        )


def _completed(parts: Any) -> Any:
    """Return sections by name, each with the fields of the one above it that it is `like`.

    One that names none above keeps its `like`.
    """
    if not isinstance(parts, dict):
        return parts
    found: dict[str, Any] = {}
    for name, given in parts.items():
        other = found.get(str(given.get("like"))) if isinstance(given, dict) else None
        if isinstance(other, dict) and "like" not in other:
            given = other | {key: value for key, value in given.items() if key != "like"}
        found[name] = given
    return found
