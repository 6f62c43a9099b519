"""Inertias, stiffnesses and control of a rear-driven car around its axle."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Annotated

from drivetrain.engine import Engine, Gearbox
from drivetrain.road_load import RoadLoad
from gearlube_core.checks import check_positive, check_within
from gearlube_core.number import Checked, Number, Positive

_STEEL_SHEAR_MODULUS = 79.3e9  # Pa
_DAMPING = Number("N m s/rad", 0.0, 1e4)


def shaft_stiffness(outer_diameter: float, length: float, inner_diameter: float = 0.0) -> float:
    """Return the torsional stiffness of a straight round shaft of steel [N m/rad].

    k = G pi (D^4 - d^4) / (32 l)   (Saint-Venant)

    Parameters
    ----------
    outer_diameter, length, inner_diameter : float
        D, l, d [m].
    """
    check_positive("length", length, "m")
    check_positive("outer_diameter", outer_diameter, "m")
    check_within("inner_diameter", inner_diameter, 0.0, 0.999 * outer_diameter, "m")
    polar = math.pi / 32.0 * (outer_diameter**4 - inner_diameter**4)
    return _STEEL_SHEAR_MODULUS * polar / length


@dataclass(frozen=True, slots=True, kw_only=True)
class DrivelineParameters(Checked):
    """A car from the crankshaft to the road, without the axle's gears.

    Parameters
    ----------
    road_load : RoadLoad
        Vehicle, tyre and axle ratio.
    engine : Engine
        Torque orders, flywheel.
    gearbox : Gearbox
        Ratios and gear choice.
    propshaft_inertia : float
        Gearbox output shaft and propshaft, turning at propshaft speed [kg m2].
    propshaft_stiffness, propshaft_damping : float
        Between gearbox output and pinion flange [N m/rad], [N m s/rad].
    half_shaft_stiffness, half_shaft_damping : float
        Both half-shafts in parallel, ring gear to hubs [N m/rad], [N m s/rad].
    wheel_inertia : float
        One wheel with tyre and brake disc [kg m2]. The driven pair turns with the hubs; the other
        pair rolls and is added to the vehicle's mass.
    tyre_slip_stiffness : float
        Longitudinal force over slip of the driven pair [N].
    tyre_relaxation_length : float
        sigma [m]. The carcass stiffness is tyre_slip_stiffness / sigma [N/m].
    speed_control_frequency : float
        Bandwidth of the speed controller [Hz], critically damped.

    Notes
    -----
    The paper of the axle gives no driveline. Defaults are assumptions for a 1300 kg car:
    propshaft a steel tube 70 mm x 2 mm, 1.4 m long (27.6 kN m/rad, 5.4e-3 kg m2 of tube);
    half-shafts solid steel, 27 mm, 0.7 m long; dampings of 2 % in the respective local mode; slip
    stiffness 20 times the load of two wheels; relaxation length 0.3 m. The inertia of the
    propshaft is lumped at the gearbox.
    """

    road_load: RoadLoad
    engine: Engine = field(default_factory=Engine)
    gearbox: Gearbox = field(default_factory=Gearbox)
    propshaft_inertia: Annotated[float, Positive("kg m2")] = 0.012
    propshaft_stiffness: Annotated[float, Positive("N m/rad")] = shaft_stiffness(0.070, 1.4, 0.066)
    propshaft_damping: Annotated[float, _DAMPING] = 0.64
    half_shaft_stiffness: Annotated[float, Positive("N m/rad")] = 2.0 * shaft_stiffness(0.027, 0.7)
    half_shaft_damping: Annotated[float, _DAMPING] = 3.0
    wheel_inertia: Annotated[float, Positive("kg m2")] = 0.9
    tyre_slip_stiffness: Annotated[float, Positive("N")] = 127.5e3
    tyre_relaxation_length: Annotated[float, Positive("m")] = 0.3
    speed_control_frequency: Annotated[
        float,
        Number("Hz", 0.0, 0.5, "A faster controller would excite the driveline's modes."),
    ] = 0.1

    @property
    def rolling_radius(self) -> float:
        """r_t [m]."""
        return self.road_load.tyre.rolling_radius

    @property
    def axle_ratio(self) -> float:
        """Pinion speed over wheel speed [-]."""
        return self.road_load.final_drive.ratio

    @property
    def translating_mass(self) -> float:
        """Vehicle mass and the undriven wheels, m + 2 J_w / r_t^2 [kg]."""
        rolling = 2.0 * self.wheel_inertia / self.rolling_radius**2
        return self.road_load.vehicle.mass + rolling

    @property
    def tyre_stiffness(self) -> float:
        """Longitudinal carcass stiffness of the driven pair [N/m]."""
        return self.tyre_slip_stiffness / self.tyre_relaxation_length

    def gearbox_input_inertia(self, gear_ratio: float) -> float:
        """Return the inertia behind the flywheel springs, seen from the engine [kg m2]."""
        return self.engine.secondary_inertia + self.propshaft_inertia / gear_ratio**2

    def control_gains(self, gear_ratio: float) -> tuple[float, float]:
        """Return the gains of the speed controller [N m s/m], [N m/m], at the crankshaft.

        A vehicle of effective mass M under F = 2 w M (V0 - V) + w^2 M int (V0 - V) dt has the
        characteristic polynomial (s + w)^2.
        """
        w = 2.0 * math.pi * self.speed_control_frequency
        mass = self.moved_mass(gear_ratio)
        total = gear_ratio * self.axle_ratio / self.rolling_radius
        return 2.0 * w * mass / total, w**2 * mass / total

    def moved_mass(self, gear_ratio: float) -> float:
        """Return the mass that accelerates with the car, turning parts but the axle included [kg].

        Parameters
        ----------
        gear_ratio : float
            Crank speed over propshaft speed [-].
        """
        crank = self.engine.primary_inertia + self.gearbox_input_inertia(gear_ratio)
        total = gear_ratio * (self.axle_ratio / self.rolling_radius)
        return (
            self.translating_mass
            + 2.0 * self.wheel_inertia / self.rolling_radius**2
            + crank * total**2
        )
