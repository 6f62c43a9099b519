"""Vehicle, tyre and road load at the axle, and the speeds that belong to a vehicle speed."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from typing import Annotated

from gearlube_core.checks import check_option, check_within
from gearlube_core.errors import ParameterError
from gearlube_core.number import Checked, Number, check_fields

STANDARD_GRAVITY = 9.80665  # m/s2, [cgpm_1901]
_INCH = 0.0254  # m
_SIZE = re.compile(r"^\s*(?:P|LT)?(\d{3})\s*/\s*(\d{2})\s*Z?R\s*(\d{2})\b.*$", re.IGNORECASE)

# Rolling circumference of a radial tyre over its unladen diameter (ETRTO standards manual).
CIRCUMFERENCE_FACTOR = 3.05
# Loaded rolling radius over the unladen radius, a rule of thumb for radial car tyres.
_RADIUS_FACTOR = 0.965

ROLLING_RADII = ("circumference", "fraction")
_HIGHEST_SPEED = 120.0  # m/s
_SPEED_CURE = "Speeds are in m/s and forward; use gearlube_core.units.kmh_to_ms for km/h."


@dataclass(frozen=True, slots=True, kw_only=True)
class Vehicle(Checked):
    """A vehicle on a road of constant gradient.

    Parameters
    ----------
    mass : float
        Mass of the loaded vehicle m [kg].
    frontal_area : float
        A_f [m2].
    drag_coefficient : float
        C_D [-].
    rolling_coefficient : float
        f_rl [-].
    air_density : float
        rho [kg/m3].
    grade : float
        Rise over horizontal distance; 0.05 is a 5 % climb [-].
    gravity : float
        g [m/s2].
    """

    mass: Annotated[float, Number("kg", 100.0, 1e5, "Give a mass, not a weight in newton.")]
    frontal_area: Annotated[float, Number("m2", 0.1, 20.0)]
    drag_coefficient: Annotated[float, Number("1", 0.0, 2.0)]
    rolling_coefficient: Annotated[float, Number("1", 0.0, 0.2, "Try 0.015.")]
    air_density: Annotated[float, Number("kg/m3", 0.0, 2.0, "Try 1.2 kg/m3.")]
    grade: Annotated[float, Number("1", -0.5, 0.5, "5 % is 0.05.")] = 0.0
    gravity: Annotated[float, Number("m/s2", 1.0, 30.0, "Try 9.80665 m/s2.")] = STANDARD_GRAVITY

    @property
    def rolling_resistance(self) -> float:
        """R_rl = f_rl m g cos(slope) [N] ([mohammadpour_2015 (8)])."""
        normal = self.mass * self.gravity * math.cos(math.atan(self.grade))
        return self.rolling_coefficient * normal

    @property
    def grade_resistance(self) -> float:
        """R_G = m g sin(slope) [N], positive uphill."""
        return self.mass * self.gravity * math.sin(math.atan(self.grade))

    @property
    def drag_area(self) -> float:
        """Air resistance over V^2: rho/2 C_D A_f [N s2/m2] ([mohammadpour_2015 (8)])."""
        return 0.5 * self.air_density * self.drag_coefficient * self.frontal_area


def mohammadpour_2015_vehicle(grade: float = 0.0) -> Vehicle:
    """Return the vehicle of [mohammadpour_2015 Table A3].

    Notes
    -----
    The table gives a "vehicle weight" of 1300 kg; it is the mass, and the weight W of
    [mohammadpour_2015 (8)] is m g. Grade zero is the flat road of the paper.
    """
    return Vehicle(
        mass=1300.0,
        frontal_area=2.2,
        drag_coefficient=0.33,
        rolling_coefficient=0.0166,
        air_density=1.22,
        grade=grade,
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class Tyre:
    """A tyre reduced to its radii.

    Parameters
    ----------
    unladen_radius : float
        Half the outer diameter of the inflated, unloaded tyre [m].
    rolling_radius : float
        Laden dynamic radius r_t: vehicle speed over the angular speed of a freely rolling wheel
        [m].

    Notes
    -----
    Mohammadpour et al. 2015 name the tyre (Table A3: 195/65R16) and use "the laden dynamic tyre
    radius" in [mohammadpour_2015 (7)] without its value.
    """

    unladen_radius: Annotated[float, Number("m", 0.1, 1.0, "Use metres.")]
    rolling_radius: float

    def __post_init__(self) -> None:
        check_fields(self)
        check_within(
            "rolling_radius",
            self.rolling_radius,
            0.9 * self.unladen_radius,
            self.unladen_radius,
            "m",
            "A loaded tyre rolls a few per cent shorter than its unladen circumference.",
        )

    @classmethod
    def from_size(cls, size: str, *, rolling_radius: str = "circumference") -> Tyre:
        """Return the tyre of a metric size code such as "195/65R16".

        D = 25.4 mm * rim + 2 * width * aspect / 100

        Parameters
        ----------
        size : str
            Width [mm] / aspect ratio [%] R rim diameter [inch].
        rolling_radius : str
            "circumference": r_t = 3.05 D / (2 pi), the rolling circumference that the ETRTO
            standards give to radial tyres; "fraction": r_t = 0.965 D / 2.

        Notes
        -----
        195/65R16 has D/2 = 329.95 mm and r_t = 320.3 mm ("circumference") or 318.4 mm.
        """
        check_option("rolling_radius", rolling_radius, ROLLING_RADII)
        match = _SIZE.match(size) if isinstance(size, str) else None
        if match is None:
            raise ParameterError(
                f"The tyre size must read width/aspect R rim, got {size!r}. "
                "Write for example 195/65R16 (mm, per cent, inch)."
            )
        width_mm, aspect_percent, rim_inch = (float(group) for group in match.groups())
        check_within("tyre width", width_mm, 105.0, 355.0, "mm", "Write for example 195/65R16.")
        check_within("tyre aspect ratio", aspect_percent, 25.0, 85.0, "%", "Try 65.")
        check_within("tyre rim diameter", rim_inch, 10.0, 24.0, "inch", "Try 16.")
        radius = 0.5 * rim_inch * _INCH + width_mm * 1e-3 * aspect_percent / 100.0
        if rolling_radius == "circumference":
            rolling = CIRCUMFERENCE_FACTOR * 2.0 * radius / (2.0 * math.pi)
        else:
            rolling = _RADIUS_FACTOR * radius
        return cls(unladen_radius=radius, rolling_radius=rolling)


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


def mohammadpour_2015_road_load(grade: float = 0.0) -> RoadLoad:
    """Return the road load of Mohammadpour et al. 2015 (Tables A1 and A3).

    Parameters
    ----------
    grade : float
        Rise over horizontal distance [-].
    """
    return RoadLoad(
        vehicle=mohammadpour_2015_vehicle(grade),
        tyre=Tyre.from_size("195/65R16"),
        final_drive=FinalDrive(),
    )
