"""The sections of the axle file on what drives the car: engine or electric motor, and gearbox."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Annotated, ClassVar

from pydantic import Field, model_validator

from drivetrain.axle_file.car_sections import Damping, Inertia, Stiffness, or_problem
from drivetrain.axle_file.field_units import field_value, si_value
from drivetrain.axle_file.model_section import ModelSection
from drivetrain.engine import LARGEST_ORDER, Engine, EngineKind, Gearbox, TorqueOrder
from gearlube_core.input_file.field_notes import Usual
from gearlube_core.input_file.input_note import InputNote

Ratio = Annotated[float, Field(ge=0.3, le=20.0, allow_inf_nan=False)]
Ratios = Annotated[tuple[Ratio, ...], Field(strict=False, min_length=1)]
Speed = Annotated[float, Field(gt=0.0, le=2e4, allow_inf_nan=False), Usual(300.0, 20000.0)]
HighestSpeed = Annotated[Speed, Usual(1e3, 2e4)]
Orders = Annotated[tuple[Annotated[int, Field(ge=1, le=LARGEST_ORDER)], ...], Field(strict=False)]
Amplitude = Annotated[float, Field(ge=0.0, le=10.0, allow_inf_nan=False)]
Amplitudes = Annotated[tuple[Amplitude, ...], Field(strict=False)]
Phase = Annotated[float, Field(ge=-360.0, le=360.0, allow_inf_nan=False)]
Phases = Annotated[tuple[Phase, ...], Field(strict=False)]

_CAR = "size found in passenger cars; no source"
_MOTOR = "size of a motor for a passenger car; no source"


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
