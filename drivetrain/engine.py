"""Drive of the propshaft: engine or electric motor with its torque orders, and a gearbox."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated, Literal

from gearlube_core.checks import check_finite, check_within
from gearlube_core.errors import ParameterError
from gearlube_core.number import Number, Positive, check_fields
from gearlube_core.units import rads_to_rpm, rpm_to_rads

EngineKind = Literal["combustion", "electric_motor"]
LARGEST_ORDER = 24  # 6 periods for each of four pole pairs
LOWEST_RATIO, HIGHEST_RATIO = 0.3, 20.0
HIGHEST_SPEED_RPM = 2e4


@dataclass(frozen=True, slots=True, kw_only=True)
class TorqueOrder:
    """One order of the engine torque, relative to the mean torque.

    Parameters
    ----------
    order : int
        Periods per crank revolution [-].
    amplitude : float
        Amplitude over the mean torque a_k [-].
    phase : float
        Phase at crank angle zero, the firing dead centre of cylinder 1 [rad].
    """

    order: int
    amplitude: Annotated[float, Number("1", 0.0, 10.0, "It is relative to the mean.")]
    phase: float

    def __post_init__(self) -> None:
        cure = "Orders are counted per revolution."
        check_within("order", self.order, 1, LARGEST_ORDER, "", cure)
        check_fields(self)
        check_finite("phase", self.phase, "rad")


# Gas torque of four evenly fired cylinders over an ideal Otto cycle: compression ratio 10,
# polytropic exponent 1.32, crank radius over rod length 0.27, heat of 20 p0 Vs released by a
# cosine law from 20 deg before to 30 deg after dead centre, intake pressure p0 = 0.6 bar. Within
# 10 % for p0 = 0.4 to 1 bar. Reciprocating masses are left out: they lower order 2 at high speed.
IDEAL_OTTO_ORDERS = (
    TorqueOrder(order=2, amplitude=1.87, phase=math.radians(-90.3)),
    TorqueOrder(order=4, amplitude=0.85, phase=math.radians(-117.9)),
    TorqueOrder(order=6, amplitude=0.37, phase=math.radians(-143.9)),
)


@dataclass(frozen=True, slots=True, kw_only=True)
class Engine:
    """Engine with a dual-mass flywheel, or electric motor with its shaft.

    T(theta) = T_mean [1 + sum a_k cos(k theta + phase_k)]

    Parameters
    ----------
    orders : tuple of TorqueOrder
        Torque orders; an empty tuple gives a perfectly smooth engine.
    primary_inertia : float
        Crankshaft and primary flywheel mass [kg m2].
    secondary_inertia : float
        Secondary flywheel mass, clutch and gearbox input shaft [kg m2].
    flywheel_stiffness : float
        Arc springs of the dual-mass flywheel [N m/rad].
    flywheel_damping : float
        The same, viscous [N m s/rad].
    idle_speed_rpm, highest_speed_rpm : float
        Range of crank speed [1/min].
    kind : {"combustion", "electric_motor"}
        Of an electric motor the crank is the rotor, and the flywheel its shaft up to the gearbox.

    Notes
    -----
    The inertias, stiffness (7 N m per degree, 15 Hz between the two masses) and damping (ratio
    0.1) are assumptions of the size found in passenger cars; no source gives the engine of
    Mohammadpour et al. 2015.
    """

    orders: tuple[TorqueOrder, ...] = IDEAL_OTTO_ORDERS
    primary_inertia: Annotated[float, Positive("kg m2")] = 0.16
    secondary_inertia: Annotated[float, Positive("kg m2")] = 0.06
    flywheel_stiffness: Annotated[float, Positive("N m/rad")] = 400.0
    flywheel_damping: Annotated[float, Number("N m s/rad", 0.0, 1e4)] = 0.85
    idle_speed_rpm: Annotated[float, Positive("1/min")] = 800.0
    highest_speed_rpm: float = 6000.0
    kind: EngineKind = "combustion"

    @classmethod
    def electric_motor(cls) -> Engine:
        """Return a smooth electric motor; its numbers are assumed, no source gives them.

        A steel rotor of 150 mm, 130 mm long, with a hole of 80 mm; a shaft of 30 mm, 150 mm long;
        damping of 2 % in its mode. It runs from standstill to 16,000 rpm.
        """
        return cls(
            orders=(),
            primary_inertia=0.05,
            secondary_inertia=0.01,
            flywheel_stiffness=42e3,
            flywheel_damping=0.75,
            idle_speed_rpm=1.0,
            highest_speed_rpm=16000.0,
            kind="electric_motor",
        )

    def __post_init__(self) -> None:
        check_fields(self)
        low, high = self.idle_speed_rpm, HIGHEST_SPEED_RPM
        check_within("highest_speed_rpm", self.highest_speed_rpm, low, high, "1/min")

    def torque(self, mean_torque: float, crank_angle: float) -> float:
        """Return the torque [N m] at `crank_angle` [rad] for the mean `mean_torque` [N m]."""
        ripple = sum(o.amplitude * math.cos(o.order * crank_angle + o.phase) for o in self.orders)
        return mean_torque * (1.0 + ripple)


@dataclass(frozen=True, slots=True, kw_only=True)
class Gearbox:
    """Gearbox and the rule for choosing a gear.

    Parameters
    ----------
    ratios : tuple of float
        Input speed over output speed, first gear first [-].
    lowest_cruising_speed_rpm : float
        The highest gear that keeps the engine above this speed is used [1/min].

    Notes
    -----
    The ratios are an assumption: a five-speed box of a rear-driven passenger car.
    """

    ratios: tuple[float, ...] = (3.6, 2.1, 1.4, 1.0, 0.8)
    lowest_cruising_speed_rpm: Annotated[float, Positive("1/min")] = 1400.0

    def __post_init__(self) -> None:
        if not self.ratios:
            raise ParameterError("ratios must hold at least one gear, got none. Try (1.0,).")
        for gear, ratio in enumerate(self.ratios, start=1):
            check_within(f"ratio of gear {gear}", ratio, LOWEST_RATIO, HIGHEST_RATIO)
        if any(high <= low for high, low in zip(self.ratios, self.ratios[1:], strict=False)):
            raise ParameterError(
                f"ratios must fall from gear to gear, got {self.ratios}. First gear comes first."
            )
        check_fields(self)

    def gear_for(self, propshaft_speed: float, engine: Engine) -> int:
        """Return the gear, counted from 1, for a propshaft speed [rad/s].

        Raises
        ------
        ParameterError
            When no gear keeps the engine between idle and its highest speed.
        """
        speed_rpm = rads_to_rpm(propshaft_speed)
        usable = [
            gear
            for gear, ratio in enumerate(self.ratios, start=1)
            if engine.idle_speed_rpm <= ratio * speed_rpm <= engine.highest_speed_rpm
        ]
        if not usable:
            slowest = rpm_to_rads(engine.idle_speed_rpm) / self.ratios[0]
            fastest = rpm_to_rads(engine.highest_speed_rpm) / self.ratios[-1]
            raise ParameterError(
                f"The propshaft speed must be within {slowest:.1f} to {fastest:.1f} rad/s for the "
                f"gears {self.ratios}, got {propshaft_speed:g} rad/s. Choose another vehicle "
                "speed, another ratio, or the driver SpeedHold, which has no engine."
            )
        floor = self.lowest_cruising_speed_rpm
        lively = [gear for gear in usable if self.ratios[gear - 1] * speed_rpm >= floor]
        return max(lively) if lively else min(usable)
