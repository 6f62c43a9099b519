"""The sections of the axle file on the car: vehicle, tyre, driveline, engine."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace
from functools import partial
from typing import Annotated, Any, ClassVar

from pydantic import Field, model_validator

from drivetrain.axle_file.section import ModelSection
from drivetrain.driveline.parameters import DrivelineParameters
from drivetrain.engine import (
    HIGHEST_RATIO,
    HIGHEST_SPEED_RPM,
    LARGEST_ORDER,
    LOWEST_RATIO,
    Engine,
    EngineKind,
    Gearbox,
    TorqueOrder,
)
from drivetrain.road_load import CIRCUMFERENCE_FACTOR, Tyre, Vehicle, mohammadpour_2015_vehicle
from gearlube_core.errors import ParameterError
from gearlube_core.input_file.field_notes import Declared, Usual
from gearlube_core.input_file.field_units import field_value, si_value
from gearlube_core.input_file.input_file import InputNote

Text = Annotated[str, Field(min_length=1)]
_vehicle, _tyre = partial(Declared, Vehicle), partial(Declared, Tyre)
_driveline = partial(Declared, DrivelineParameters)
Mass = Annotated[float, _vehicle("mass_kg"), Usual(500.0, 50000.0)]
Area = Annotated[float, _vehicle("frontal_area_m2"), Usual(0.2, 12.0)]
Drag = Annotated[float, _vehicle("drag_coefficient")]
Rolling = Annotated[float, _vehicle("rolling_coefficient")]
AirDensity = Annotated[float, _vehicle("air_density_kg_m3"), Usual(0.7, 1.6)]
Grade = Annotated[float, _vehicle("grade")]
Gravity = Annotated[float, _vehicle("gravity_m_s2"), Usual(9.0, 10.5)]
Radius = Annotated[float, _tyre("unladen_radius_mm"), Usual(200.0, 650.0)]
# the models take any inertia and stiffness above 0: a wall, a rigid tyre
Inertia = Annotated[float, Field(ge=1e-4, le=100.0, allow_inf_nan=False), Usual(0.001, 20.0)]
Stiffness = Annotated[float, Field(ge=1.0, le=1e8, allow_inf_nan=False), Usual(100.0, 1e7)]
ShaftStiffness = Annotated[Stiffness, Usual(2e3, 1e6)]
Damping = Annotated[float, _driveline("propshaft_damping_n_m_s_per_rad"), Usual(0.01, 1000.0)]
SlipStiffness = Annotated[float, Field(ge=1e3, le=1e8, allow_inf_nan=False), Usual(10000.0, 1e7)]
Relaxation = Annotated[float, Field(ge=10.0, le=5000.0, allow_inf_nan=False), Usual(50.0, 2000.0)]
Bandwidth = Annotated[float, _driveline("speed_control_frequency_hz"), Usual(0.001, 0.5)]

TYRE_SIZE = "195/65R16"  # [mohammadpour_2015 Table A3]
_PAPER = "Mohammadpour et al. 2015, Table A3"
Ratio = Annotated[float, Field(ge=LOWEST_RATIO, le=HIGHEST_RATIO, allow_inf_nan=False)]
Ratios = Annotated[tuple[Ratio, ...], Field(strict=False, min_length=1)]
Speed = Annotated[
    float, Field(gt=0.0, le=HIGHEST_SPEED_RPM, allow_inf_nan=False), Usual(300.0, 20000.0)
]
HighestSpeed = Annotated[Speed, Usual(1e3, 2e4)]
Orders = Annotated[tuple[Annotated[int, Field(ge=1, le=LARGEST_ORDER)], ...], Field(strict=False)]
Amplitude = Annotated[float, Declared(TorqueOrder, "amplitude")]
Amplitudes = Annotated[tuple[Amplitude, ...], Field(strict=False)]
Phase = Annotated[float, Field(ge=-360.0, le=360.0, allow_inf_nan=False)]
Phases = Annotated[tuple[Phase, ...], Field(strict=False)]

_CAR = "size found in passenger cars; no source"
_MOTOR = "size of a motor for a passenger car; no source"


def or_problem(build: Any) -> list[str]:
    """Return why a model cannot be built, nothing where it can."""
    try:
        build()
    except ParameterError as reason:
        return [f"In SI units: {str(reason).removesuffix('.')}"]
    return []


class VehicleSection(ModelSection):
    """The vehicle as the road sees it."""

    mass_kg: Mass | None = Field(default=None, description="Mass of the loaded vehicle")
    drag_area_m2: Area | None = Field(
        default=None, description="Drag coefficient times frontal area; give this or the next two"
    )
    frontal_area_m2: Area | None = Field(default=None, description="Frontal area A_f")
    drag_coefficient: Drag | None = Field(default=None, description="Drag coefficient C_D")
    rolling_coefficient: Rolling | None = Field(
        default=None, description="Rolling resistance divided by the weight"
    )
    air_density_kg_m3: AirDensity | None = Field(default=None, description="Density of the air")
    grade: Grade | None = Field(
        default=None, description="Slope of the road: rise divided by horizontal distance"
    )
    gravity_m_s2: Gravity | None = Field(default=None, description="Gravitational acceleration")

    @model_validator(mode="after")
    def _check_vehicle(self) -> VehicleSection:
        if self.has("drag_area_m2") and (
            self.has("frontal_area_m2") or self.has("drag_coefficient")
        ):
            raise ValueError(
                "drag_area_m2 is frontal_area_m2 times drag_coefficient; give one: it or these two"
            )
        if problems := or_problem(self.vehicle):
            raise ValueError(problems[0])
        return self

    def vehicle(self) -> Vehicle:
        """Return the vehicle."""
        base = mohammadpour_2015_vehicle()
        changes = self.changes(base)
        drag_area = changes.pop("drag_area", None)
        if drag_area is not None:
            changes |= {"frontal_area": drag_area, "drag_coefficient": 1.0}
        return replace(base, **changes)

    def vehicle_notes(self, prefix: str, made: Vehicle) -> list[InputNote]:
        """Return a note on every field; `made` is what `vehicle` returned."""
        # the drag area of the model holds half the air's density too
        left_out = {"frontal_area_m2", "drag_coefficient"}
        if not self.has("drag_area_m2"):
            left_out = {"drag_area_m2"}
        notes = self.notes(prefix, made, _PAPER)
        return [note for note in notes if note.field.removeprefix(prefix) not in left_out]


class TyreSection(ModelSection):
    """The tyres, all of one size."""

    size: Text | None = Field(
        default=None, description="Tyre size such as 195/65R16; give this or the radii"
    )
    rolling_radius_mm: Radius | None = Field(
        default=None,
        description="Vehicle speed divided by the angular speed of the wheel; left out: from "
        "the size",
    )
    unladen_radius_mm: Radius | None = Field(
        default=None,
        description="Half the outer diameter of the unloaded tyre; left out: from the size or "
        "the rolling radius",
    )

    @model_validator(mode="after")
    def _check_tyre(self) -> TyreSection:
        if self.has("size") and (self.has("rolling_radius_mm") or self.has("unladen_radius_mm")):
            raise ValueError("size and the radii describe the same tyre; give one of them")
        if problems := or_problem(self.tyre):
            text = self.has("size")  # which has its own units
            raise ValueError(problems[0].removeprefix("In SI units: ") if text else problems[0])
        return self

    def tyre(self) -> Tyre:
        """Return the tyre."""
        if not (self.has("rolling_radius_mm") or self.has("unladen_radius_mm")):
            return Tyre.from_size(self.size or TYRE_SIZE)
        to_unladen = math.pi / CIRCUMFERENCE_FACTOR
        if not self.has("rolling_radius_mm"):
            unladen = self.si("unladen_radius_mm")
            return Tyre(rolling_radius=unladen / to_unladen, unladen_radius=unladen)
        rolling = self.si("rolling_radius_mm")
        unladen = (
            self.si("unladen_radius_mm") if self.has("unladen_radius_mm") else to_unladen * rolling
        )
        return Tyre(rolling_radius=rolling, unladen_radius=unladen)

    def tyre_notes(self, prefix: str, made: Tyre) -> list[InputNote]:
        """Return a note on every field; `made` is what `tyre` returned."""
        radii = self.has("rolling_radius_mm") or self.has("unladen_radius_mm")
        how = "the other radius" if radii else "tyre size, by the rolling circumference of ETRTO"
        radii_keys = ("rolling_radius_mm", "unladen_radius_mm")
        notes = self.notes(prefix, made, "", dict.fromkeys(radii_keys, how))
        if not radii and not self.has("size"):
            notes.insert(0, InputNote(f"{prefix}size", TYRE_SIZE, "", "assumed", _PAPER))
        return notes


class DrivelineSection(ModelSection):
    """Shafts, wheels and the speed controller."""

    propshaft_inertia_kg_m2: Inertia | None = Field(
        default=None, description="Moment of inertia of gearbox output shaft and propshaft"
    )
    propshaft_stiffness_n_m_per_rad: ShaftStiffness | None = Field(
        default=None, description="Torsional stiffness between gearbox output and pinion flange"
    )
    propshaft_damping_n_m_s_per_rad: Damping | None = Field(
        default=None, description="Torsional damping between gearbox output and pinion flange"
    )
    half_shaft_stiffness_n_m_per_rad: ShaftStiffness | None = Field(
        default=None,
        description="Torsional stiffness of both half-shafts together, ring gear to hubs",
    )
    half_shaft_damping_n_m_s_per_rad: Damping | None = Field(
        default=None, description="Torsional damping of both half-shafts together"
    )
    wheel_inertia_kg_m2: Inertia | None = Field(
        default=None, description="Moment of inertia of one wheel with tyre and brake disc"
    )
    tyre_slip_stiffness_n: SlipStiffness | None = Field(
        default=None, description="Longitudinal force per slip of both driven wheels together"
    )
    tyre_relaxation_length_mm: Relaxation | None = Field(
        default=None,
        description="Relaxation length of the tyre: slip stiffness divided by carcass stiffness",
    )
    speed_control_frequency_hz: Bandwidth | None = Field(
        default=None, description="Bandwidth of the speed controller"
    )


class GearboxSection(ModelSection):
    """The gearbox between engine or motor and propshaft."""

    ratios: Ratios | None = Field(
        default=None,
        description="Ratios, input speed divided by output speed, from first gear on, falling",
    )
    lowest_cruising_speed_rpm: Speed | None = Field(
        default=None,
        description="The car drives in the highest gear in which the engine stays above this speed",
    )

    @model_validator(mode="after")
    def _check_gearbox(self) -> GearboxSection:
        if problems := or_problem(self.gearbox):
            raise ValueError(problems[0].removeprefix("In SI units: "))
        return self

    def gearbox(self, behind: EngineKind = "combustion") -> Gearbox:
        """Return the gearbox; behind an electric motor it has one gear where none is given."""
        base = Gearbox() if behind == "combustion" else Gearbox(ratios=(1.0,))
        return replace(base, **self.changes(base))

    def gearbox_notes(self, prefix: str, made: Gearbox) -> list[InputNote]:
        """Return a note on every field; `made` is what `gearbox` returned."""
        notes = self.notes(prefix, made, _CAR)
        if len(made.ratios) > 1:
            return notes
        # the only gear is used at any speed
        return [note for note in notes if note.field != f"{prefix}lowest_cruising_speed_rpm"]


class EngineSection(ModelSection):
    """The engine with its dual-mass flywheel, or the electric motor with its shaft."""

    sources: ClassVar[Mapping[str, str]] = {"kind": "default of the model"}

    kind: EngineKind | None = Field(
        default=None,
        description="Kind of engine; electric_motor: smooth torque, from standstill, with one gear",
    )
    orders: Orders | None = Field(
        default=None,
        description="Orders of the engine torque, in periods per revolution of crankshaft or "
        "rotor; []: smooth torque",
    )
    order_amplitudes: Amplitudes | None = Field(
        default=None, description="Amplitudes of the orders, divided by the mean torque"
    )
    order_phases_deg: Phases | None = Field(
        default=None, description="Phases of the orders at firing dead centre of cylinder 1"
    )
    primary_inertia_kg_m2: Inertia | None = Field(
        default=None,
        description="Moment of inertia of crankshaft and primary flywheel mass; of a motor: of "
        "its rotor",
    )
    secondary_inertia_kg_m2: Inertia | None = Field(
        default=None,
        description="Moment of inertia of secondary flywheel mass, clutch and gearbox input; "
        "with a motor: of the gearbox input alone",
    )
    flywheel_stiffness_n_m_per_rad: Stiffness | None = Field(
        default=None,
        description="Torsional stiffness of the arc springs of the flywheel; of a motor: of its "
        "shaft",
    )
    flywheel_damping_n_m_s_per_rad: Damping | None = Field(
        default=None, description="Viscous damping of the arc springs"
    )
    idle_speed_rpm: Speed | None = Field(
        default=None, description="Lowest speed of crankshaft or rotor"
    )
    highest_speed_rpm: HighestSpeed | None = Field(
        default=None, description="Highest speed of crankshaft or rotor"
    )

    @model_validator(mode="after")
    def _check_engine(self) -> EngineSection:
        lists = (self.orders, self.order_amplitudes, self.order_phases_deg)
        if len({None if one is None else len(one) for one in lists}) > 1:
            sizes = [0 if one is None else len(one) for one in lists]
            raise ValueError(
                "orders, order_amplitudes and order_phases_deg must have the same number of "
                f"entries, got {sizes[0]}, {sizes[1]} and {sizes[2]}"
            )
        if problems := or_problem(self.engine):
            raise ValueError(problems[0])
        return self

    def engine(self) -> Engine:
        """Return the engine."""
        base = Engine.electric_motor() if self.kind == "electric_motor" else Engine()
        changes = self.changes(base)
        if self.orders is not None:
            phases = si_value("order_phases_deg", self.order_phases_deg)
            parts = zip(self.orders, self.order_amplitudes or (), phases, strict=True)
            changes["orders"] = tuple(
                TorqueOrder(order=k, amplitude=a, phase=phase) for k, a, phase in parts
            )
        return replace(base, **changes)

    def engine_notes(self, prefix: str, made: Engine) -> list[InputNote]:
        """Return a note on every field; `made` is what `engine` returned."""
        motor = made.kind == "electric_motor"
        notes = self.notes(prefix, made, _MOTOR if motor else _CAR)
        if self.orders is not None:
            return notes
        lists = {
            "orders": tuple(one.order for one in made.orders),
            "order_amplitudes": tuple(one.amplitude for one in made.orders),
            "order_phases_deg": tuple(
                field_value("order_phases_deg", one.phase) for one in made.orders
            ),
        }
        why = "a smooth motor" if motor else "four cylinders, ideal Otto cycle"
        of_orders = [
            InputNote(prefix + key, value, "deg" if key.endswith("deg") else "", "assumed", why)
            for key, value in lists.items()
        ]
        return of_orders + [note for note in notes if note.field != f"{prefix}orders"]
