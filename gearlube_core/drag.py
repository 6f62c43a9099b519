"""Drag without load: churning of a gear in its oil, and shaft seals."""

from __future__ import annotations

import math
from typing import Annotated, Literal, NamedTuple, get_args

from gearlube_core.checks import check_option
from gearlube_core.kernels.jit import kernel
from gearlube_core.number import Number
from gearlube_core.units import kelvin_to_celsius, rpm_to_rads

ChurningLaw = Literal["none", "changenet_velex_2007", "boness_1989", "iso_tr_14179_2"]
CHURNING_LAWS: tuple[str, ...] = get_args(ChurningLaw)
_NONE, _CHANGENET_VELEX, _BONESS, _ISO = (float(i) for i in range(4))

STANDARD_GRAVITY = 9.80665  # m/s2
SMOOTHING_SPEED = 1.0  # rad/s, below which the torque falls to zero; choice of this library
# of Changenet and Velex' Reynolds number w R b/nu, between two regimes; second hand
_LOW, _HIGH = 6000.0, 9000.0
_BORDERS = 2000.0, 1e5  # of Boness' Reynolds number; where the laws jump by +8 and +25 %
_HALF_WIDTH = math.sqrt(_HIGH / _LOW)  # a border of Boness is as wide as that of the others
SealMaterial = Literal["fkm", "nbr", "any"]
# N.m per mm of shaft diameter, [iso_tr_14179_1]; not compared with the printed source
_PER_MILLIMETRE = {"fkm": 3.737e-3, "nbr": 2.429e-3}

# as a user gives them, with limits and units
RingDiameter = Annotated[
    float, Number("m", 0.01, 3.0, "165 mm is 0.165 m.", "Outside diameter", shown="mm")
]
RingWidth = Annotated[
    float, Number("m", 1e-3, 1.0, "30 mm is 0.03 m.", "Width of the teeth", shown="mm")
]
Immersion = Annotated[
    float, Number("m", 0.0, 3.0, "40 mm is 0.04 m.", "Depth of the lowest tooth", shown="mm")
]
OilVolume = Annotated[
    float, Number("m3", 1e-5, 1.0, "1.2 l is 1.2e-3 m3.", "Volume of the oil", shown="l")
]
_TORQUE = Number("N.m", 0.0, 100.0, "0.15 N.m a seal is usual.", "Torque of the seal")
SealTorque = Annotated[float, _TORQUE]
_OF_HUBS = "Friction torque of the bearings of both wheel hubs, at the gear"
HubTorque = Annotated[float, _TORQUE._replace(text=_OF_HUBS, fmi="wheel.hub.torque")]
SHAFT_DIAMETER = Number("m", 5e-3, 0.5, "40 mm is 0.04 m.")  # under a seal's lip


class ChurningConstants(NamedTuple):
    """A gear in its oil, for the kernels; all floats."""

    law: float  # place in CHURNING_LAWS
    ring_diameter: float  # outside [m]
    ring_width: float  # of the teeth [m]
    immersion: float  # depth of the lowest tooth below the surface of the oil at rest [m]
    oil_volume: float  # m3


@kernel
def _beyond(value: float, low: float, high: float) -> float:
    """Return 0 to 1 as a value above 0 goes from low to high, smooth in its logarithm."""
    s = math.log(max(value, 1e-12) / low) / math.log(high / low)
    s = min(1.0, max(0.0, s))
    return s * s * (3.0 - 2.0 * s)


@kernel
def fast_regime(speed: float, nu: float, p: ChurningConstants) -> float:
    """Return how far Changenet and Velex' law is in its fast regime at a speed [rad/s] above 0 [-].

    3 s^2 - 2 s^3,  s = ln(Re_c/6000)/ln(9000/6000) within 0 to 1,  Re_c = w R b/nu
    """
    return _beyond(speed * 0.5 * p.ring_diameter * p.ring_width / nu, _LOW, _HIGH)


@kernel
def changenet_velex_factor(speed: float, nu: float, p: ChurningConstants) -> float:
    """Return the dimensionless torque C_m of Changenet and Velex at a speed [rad/s] above 0."""
    radius = 0.5 * p.ring_diameter
    depth = min(1.0, p.immersion / p.ring_diameter)
    volume = p.oil_volume / p.ring_diameter**3
    froude = speed * speed * radius / STANDARD_GRAVITY
    reynolds = speed * radius * radius / nu
    slow = (
        1.366
        * math.pow(depth, 0.45)
        * math.pow(volume, 0.1)
        * math.pow(froude, -0.6)
        * math.pow(reynolds, -0.21)
    )
    fast = (
        3.644
        * math.pow(depth, 0.1)
        * math.pow(volume, -0.35)
        * math.pow(froude, -0.88)
        * math.pow(p.ring_width / p.ring_diameter, 0.85)
    )
    return slow * math.pow(fast / slow, fast_regime(speed, nu, p))


@kernel
def boness_factor(speed: float, nu: float, p: ChurningConstants) -> float:
    """Return the dimensionless torque C_m of Boness at a speed [rad/s] above 0."""
    radius = 0.5 * p.ring_diameter
    chord = 2.0 * math.sqrt(max(0.0, p.immersion * (p.ring_diameter - p.immersion)))
    reynolds = speed * radius * chord / nu
    reynolds = max(reynolds, 1e-12)
    first = _beyond(reynolds, _BORDERS[0] / _HALF_WIDTH, _BORDERS[0] * _HALF_WIDTH)
    second = _beyond(reynolds, _BORDERS[1] / _HALF_WIDTH, _BORDERS[1] * _HALF_WIDTH)
    slow = math.log(20.0 / reynolds)
    middle = math.log(8.6e-4) + math.log(reynolds) / 3.0
    fast = math.log(5e8 / (reynolds * reynolds))
    between = middle + second * (fast - middle)
    return math.exp(slow + first * (between - slow))


@kernel
def wetted_surface(p: ChurningConstants) -> float:
    """Return the surface of the gear in the oil [m2]: both faces and the rim."""
    radius = 0.5 * p.ring_diameter
    angle = math.acos(min(1.0, max(-1.0, 1.0 - p.immersion / radius)))
    faces = radius * radius * (2.0 * angle - math.sin(2.0 * angle))
    return faces + 2.0 * radius * p.ring_width * angle


@kernel
def churning_torque(speed: float, nu: float, density: float, p: ChurningConstants) -> float:
    """Return the churning torque of a gear [N.m], with the sign of its speed.

    T = 1/2 rho w^2 S R^3 C_m with S the wetted surface, for Changenet and Velex and for Boness;
    T = C1 exp(C2 v/10), C1 = 0.063 h/10 + 0.0128 (b/10)^3, C2 = h/800 + 0.2 [N.m, mm, m/s] for
    ISO/TR 14179-2, free of viscosity.

    Parameters
    ----------
    speed : float
        Of the gear [rad/s].
    nu : float
        Kinematic viscosity [m2/s].
    density : float
        [kg/m3]
    p : ChurningConstants

    Notes
    -----
    Made for spur and helical gears, speeds to about 25 m/s at the rim; laws differ by a factor of
    three among each other, and oil that is thrown off lowers the immersion. The constants are
    those that reviews quote; they were not compared with the printed sources. The law of Changenet
    and Velex has two regimes below 6000 and above 9000 of its Reynolds number. Reviews quote a
    straight line between them; here C_m goes over as slow (fast/slow)^`fast_regime`, without a
    kink. So do the three of Boness, within a factor 1.22 about Re = 2000 and 1e5. In axles the
    fast regime is several times the slow one, so that the torque rises steeply
    there. The factor w/sqrt(w^2 + w0^2), w0 = 1 rad/s, makes all smooth through rest.

    References
    ----------
    [changenet_velex_2007]; [boness_1989]; [iso_tr_14179_2]
    """
    size = abs(speed)
    if p.law == _NONE or p.immersion <= 0.0 or size == 0.0:
        return 0.0
    radius = 0.5 * p.ring_diameter
    if p.law == _ISO:
        depth = 1e3 * min(p.immersion, p.ring_diameter)
        width = 1e3 * p.ring_width
        first = 0.063 * depth / 10.0 + 0.0128 * (width / 10.0) ** 3
        magnitude = first * math.exp((depth / 800.0 + 0.2) * size * radius / 10.0)
    else:
        if p.law == _BONESS:
            factor = boness_factor(size, nu, p)
        else:
            factor = changenet_velex_factor(size, nu, p)
        magnitude = 0.5 * density * size * size * wetted_surface(p) * radius**3 * factor
    return magnitude * speed / math.sqrt(speed * speed + SMOOTHING_SPEED * SMOOTHING_SPEED)


def seal_torque(
    diameter: float, material: SealMaterial = "fkm", temperature: float = 0.0, nu_40: float = 0.0
) -> float:
    """Return the friction torque of a radial shaft seal [N.m], free of speed.

    P = [145 - 1.6 T + 350 lg lg(nu_40 + 0.8)] d^2 n 1e-7 for "any", in W, degC, mm2/s, mm, 1/min

    Parameters
    ----------
    diameter
        Of the shaft under the lip [m], 0.005 to 0.5.
    material
        Fluorocarbon or nitrile rubber, a torque for each mm; "any": by the oil.
    temperature, nu_40
        Of the oil [K], and its kinematic viscosity at 40 degC [m2/s], both for "any" alone.

    Notes
    -----
    Seals of one size differ by a factor of two, with their spring, wear and the oil; packed with
    grease they take 1.5 to 3 times as much. The equation was not checked against its source.

    References
    ----------
    [iso_tr_14179_1]; [iso_tr_14179_2] for "any"

    Examples
    --------
    >>> round(seal_torque(0.040), 3), round(seal_torque(0.040, "any", 343.15, 100e-6), 3)
    (0.149, 0.212)
    """
    SHAFT_DIAMETER.check("diameter", diameter)
    check_option("material", material, get_args(SealMaterial))
    if material != "any":
        return 1e3 * diameter * _PER_MILLIMETRE[material]
    oil = 350.0 * math.log10(math.log10(1e6 * nu_40 + 0.8))
    factor = max(145.0 - 1.6 * kelvin_to_celsius(temperature) + oil, 0.0)
    return factor * (1e3 * diameter) ** 2 * 1e-7 / rpm_to_rads(1.0)


@kernel
def seal_drag(speed: float, torque: float) -> float:
    """Return the torque of a seal with the sign of the speed [rad/s], smooth through rest."""
    return torque * speed / math.sqrt(speed * speed + SMOOTHING_SPEED * SMOOTHING_SPEED)
