"""A car over a drive cycle: energy lost in its axle, and the temperature of the oil."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import ClassVar, Self

from drivetrain.cycle.traces import DriveCycle
from drivetrain.sump_heat import SumpHeat
from gearlube.studies.drive_cycle.loss_field import demand_of
from gearlube.studies.drive_cycle.run import run_cycle
from gearlube.studies.drive_cycle.settings import COAST_TORQUE, DriveCycleSettings
from gearlube.variation.design import Point, Value
from gearlube.variation.file_variants import content_hash
from gearlube.variation.keys import Keys
from gearlube.variation.point_study import Quantity
from gearlube.variation.points.of_file import AxlePoint, operand, value
from gearlube_core.dynamics.hypoid_axle.losses import LOSS_SOURCES
from gearlube_core.units import celsius_to_kelvin

_HEAT = SumpHeat()
CYCLE = operand("cycle", "", "nedc, wltc, ftp75 or a trace file (CSV)", "nedc", kind="text")
START = operand("oil.start_temperature_degc", "degC", "Of oil and housing", 23.0, -60.0, 250.0)
AIR = operand("air.temperature_degc", "degC", "Of the air", 23.0, -60.0, 250.0)
SHARE = operand("brakes.regeneration", "", "Share through the axle", 0.0, 0.0, 1.0)
COAST = operand("engine.coast_torque_n_m", "N.m", "At the pinion", COAST_TORQUE, 0.0, 1e4)
CAPACITY = operand(
    "heat.capacity_kj_k", "kJ/K", "Of oil and housing", 1e-3 * _HEAT.capacity, 0.01, 1e5
)
AT_REST = operand(
    "heat.conductance_at_rest_w_k", "W/K", "To air", _HEAT.conductance_at_rest, 0.0, 1e5
)
MOVING = operand(
    "heat.conductance_at_100_w_k", "W/K", "At 100 km/h", _HEAT.conductance_at_100_kmh, 0.0, 1e5
)
_OPERANDS = {key.name: key for key in (CYCLE, START, AIR, SHARE, COAST, CAPACITY, AT_REST, MOVING)}
_QUANTITIES = (
    Quantity("energy_lost", "kJ", "total energy lost"),
    *(Quantity(f"energy_lost_{name}", "kJ", f"energy lost by {name}") for name in LOSS_SOURCES),
    Quantity("energy_in", "kJ", "energy into the axle, from either side"),
    Quantity("efficiency", "1", "efficiency of the axle over the cycle"),
    Quantity("oil_temperature_end", "degC", "oil temperature at the end"),
    Quantity("oil_temperature_high", "degC", "highest oil temperature"),
)


@dataclass(frozen=True, kw_only=True)
class CyclePoint(AxlePoint):
    """The study of drive cycles at one point.

    Parameters
    ----------
    cycles : mapping of str to DriveCycle
        By the name or file of the operand `cycle`.
    """

    name: ClassVar[str] = "cycle"
    block: ClassVar[int] = 5
    shown: ClassVar[tuple[str, ...]] = ("energy_lost", "efficiency", "oil_temperature_end")
    operands: ClassVar[Keys] = _OPERANDS
    quantities: ClassVar[tuple[Quantity, ...]] = _QUANTITIES

    cycles: Mapping[str, DriveCycle] = field(default_factory=dict)

    def prepared(self, texts: Mapping[str, tuple[Value, ...]]) -> Self:
        """Return the study with all files and cycles read that the values of the axes name."""
        names = map(str, texts.get(CYCLE.name, (str(CYCLE.usual),)))
        cycles = {name: DriveCycle.given(name) for name in names}
        return replace(AxlePoint.prepared(self, texts), cycles=cycles)

    @property
    def identity(self) -> str:
        """Axle file, its tables, and the content of trace files."""
        return f"{self.axle.identity} traces {[content_hash(one) for one in sorted(self.cycles)]}"

    def check(self, point: Point) -> None:
        """Raise ParameterError where axle, car, cycle or temperatures are wrong."""
        demand_of(self._settings(point))

    def compute(self, point: Point) -> Sequence[float]:
        """Drive the cycle; return energies and temperatures."""
        found = run_cycle(self._settings(point))
        lost = found["energy_lost"].values
        oil = found["oil_temperature"].values
        return (
            float(lost.sum()),
            *map(float, lost),
            float(found["energy_in"]),
            float(found["efficiency"]),
            float(oil[-1]),
            float(oil.max()),
        )

    def _settings(self, point: Point) -> DriveCycleSettings:
        return DriveCycleSettings(
            draws=0,
            car=self.axle.car_axle(point),
            cycle=self._cycle(value(point, CYCLE)),
            start_temperature=celsius_to_kelvin(value(point, START)),
            air_temperature=celsius_to_kelvin(value(point, AIR)),
            regeneration=value(point, SHARE),
            coast_torque=value(point, COAST),
            heat=SumpHeat(
                capacity=1e3 * value(point, CAPACITY),
                conductance_at_rest=value(point, AT_REST),
                conductance_at_100_kmh=value(point, MOVING),
            ),
        )

    def _cycle(self, name: str) -> DriveCycle:
        held = self.cycles.get(name)
        return DriveCycle.given(name) if held is None else held
