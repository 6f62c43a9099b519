"""Road load at the axle, and the speeds that belong to a vehicle speed."""

from __future__ import annotations

import math
from dataclasses import dataclass

from drivetrain.tyre import Tyre
from drivetrain.vehicle import Vehicle, mohammadpour_2015_vehicle
from gearlube_core.checks import check_within
from gearlube_core.errors import ParameterError

_HIGHEST_SPEED = 120.0  # m/s
_SPEED_CURE = "Speeds are in m/s and forward; use gearlube_core.units.kmh_to_ms for km/h."


@dataclass(frozen=True, slots=True, kw_only=True)
class FinalDrive:
    """Tooth numbers of the axle's gear pair.

    Parameters
    ----------
    pinion_teeth, gear_teeth : int
        13 and 36 in [mohammadpour_2015 Table A1].
    """

    pinion_teeth: int = 13
    gear_teeth: int = 36

    def __post_init__(self) -> None:
        for name in ("pinion_teeth", "gear_teeth"):
            value = getattr(self, name)
            if not isinstance(value, int):
                raise ParameterError(
                    f"{name} must be a whole number, got {value!r}. Give the number of teeth."
                )
            check_within(name, value, 5, 500, "", "Count the teeth.")

    @property
    def ratio(self) -> float:
        """Pinion speed over gear speed [-]."""
        return self.gear_teeth / self.pinion_teeth


@dataclass(frozen=True, slots=True, kw_only=True)
class RoadLoad:
    """Resistance of the road, seen from the axle, of a vehicle at constant speed.

    R_a = rho/2 C_D A_f V^2, R_rl = f_rl m g, T_ag = r_t (R_a + R_rl + R_G)

    Parameters
    ----------
    vehicle : Vehicle
        Who resists.
    tyre : Tyre
        Gives r_t.
    final_drive : FinalDrive
        Gives the axle ratio.

    References
    ----------
    [mohammadpour_2015 (7)], [mohammadpour_2015 (8)], [mohammadpour_2015 (9)].
    """

    vehicle: Vehicle
    tyre: Tyre
    final_drive: FinalDrive = FinalDrive()

    def resistance(self, speed: float) -> float:
        """Return R_a + R_rl + R_G [N] at vehicle speed `speed` [m/s]."""
        speed = self._speed(speed)
        vehicle = self.vehicle
        rolling = vehicle.rolling_resistance if speed > 0.0 else 0.0
        return vehicle.drag_area * speed**2 + rolling + vehicle.grade_resistance

    def ring_gear_torque(self, speed: float) -> float:
        """Return T_ag [N m], the load on the ring gear at vehicle speed `speed` [m/s]."""
        return self.tyre.rolling_radius * self.resistance(speed)

    def pinion_torque(self, speed: float, axle_power_loss: float = 0.0) -> float:
        """Return the steady pinion torque [N m] at vehicle speed `speed` [m/s].

        T_ap = (Zp/Zg) T_ag + P_loss / w_p

        Parameters
        ----------
        speed : float
            Vehicle speed [m/s].
        axle_power_loss : float
            Power lost in the axle [W].

        Notes
        -----
        [mohammadpour_2015 (9)] has the ratio of the contact radii Rp/Rg. The ratio of the
        tooth numbers is used here: it alone balances the power of a lossless axle. The two differ
        by less than 0.1 % for this gear pair (21.1 mm / 58.4 mm against 13/36).
        """
        check_within("axle_power_loss", axle_power_loss, 0.0, 1e6, "W", "A loss is positive.")
        torque = self.ring_gear_torque(speed) / self.final_drive.ratio
        if axle_power_loss == 0.0:
            return torque
        return torque + axle_power_loss / self.pinion_speed(self._moving(speed))

    def wheel_speed(self, speed: float) -> float:
        """Return the speed of wheels and ring gear V / r_t [rad/s] at `speed` [m/s]."""
        return self._speed(speed) / self.tyre.rolling_radius

    def pinion_speed(self, speed: float) -> float:
        """Return the speed of the pinion [rad/s] at vehicle speed `speed` [m/s]."""
        return self.final_drive.ratio * self.wheel_speed(speed)

    def mesh_frequency(self, speed: float) -> float:
        """Return f_m = Zg V / (2 pi r_t) [Hz] at vehicle speed `speed` [m/s]."""
        return self.final_drive.gear_teeth * self.wheel_speed(speed) / (2.0 * math.pi)

    def vehicle_speed(self, wheel_speed: float) -> float:
        """Return the vehicle speed [m/s] at which the wheels turn at `wheel_speed` [rad/s]."""
        return wheel_speed * self.tyre.rolling_radius

    def _speed(self, speed: float) -> float:
        return check_within("vehicle speed", speed, 0.0, _HIGHEST_SPEED, "m/s", _SPEED_CURE)

    def _moving(self, speed: float) -> float:
        return check_within("vehicle speed", speed, 0.1, _HIGHEST_SPEED, "m/s", _SPEED_CURE)


def mohammadpour_2015_road_load(
    grade: float = 0.0, final_drive: FinalDrive | None = None
) -> RoadLoad:
    """Return the road load of Mohammadpour et al. 2015 (Tables A1 and A3).

    Parameters
    ----------
    grade : float
        Rise over horizontal distance [-].
    final_drive : FinalDrive, optional
        Of another gear pair in the same car.
    """
    return RoadLoad(
        vehicle=mohammadpour_2015_vehicle(grade),
        tyre=Tyre.from_size("195/65R16"),
        final_drive=final_drive or FinalDrive(),
    )
