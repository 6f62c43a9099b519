"""What a loss map is computed for, and how uncertain its inputs are."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from drivetrain.steady_temperature import Cooling
from gearlube_core.arrays import Array
from gearlube_core.bearings.losses.loss import CALIBRATED, UNCALIBRATED
from gearlube_core.checks import check_within
from gearlube_core.dynamics.hypoid_axle.bearing_drag import BEARING_LAWS
from gearlube_core.dynamics.hypoid_axle.parameters import HypoidAxleParameters
from gearlube_core.errors import ParameterError
from gearlube_core.units import celsius_to_kelvin

MOST_POINTS = 200_000
MOST_DRAWS = 10_000
_REFERENCE = celsius_to_kelvin(40.0), celsius_to_kelvin(100.0)


@dataclass(frozen=True, slots=True)
class Uncertain:
    """An input or a law that is known to a factor.

    Parameters
    ----------
    name
        Key.
    words
        What it is, for figures and tables.
    factor
        The true value lies between value/factor and value * factor with 95 % (k = 2); the
        logarithm is normal.
    why
        Where the factor is from.
    changed
        Returns the axle with the input times a number; None: the factor scales `sources`.
    sources
        Losses that are scaled, see `losses.LOSS_SOURCES`.
    """

    name: str
    words: str
    factor: float
    why: str
    changed: Callable[[HypoidAxleParameters, float], HypoidAxleParameters] | None = None
    sources: tuple[str, ...] = ()

    def multiplier(self, normal: float) -> float:
        """Return the number to multiply with at a standard normal `normal`."""
        return math.exp(0.5 * normal * math.log(self.factor))


def _viscosity(axle: HypoidAxleParameters, by: float) -> HypoidAxleParameters:
    oil = axle.oil
    low, high = (by * oil.dynamic_viscosity(t) / oil.density for t in _REFERENCE)
    return replace(
        axle,
        oil=oil.with_two_viscosities(low, _REFERENCE[0], high, _REFERENCE[1], name=oil.name),
    )


def _eyring(axle: HypoidAxleParameters, by: float) -> HypoidAxleParameters:
    return replace(axle, oil=replace(axle.oil, eyring_stress=axle.oil.eyring_stress * by))


def _alpha(axle: HypoidAxleParameters, by: float) -> HypoidAxleParameters:
    return replace(axle, oil=replace(axle.oil, alpha=axle.oil.alpha * by))


def _roughness(axle: HypoidAxleParameters, by: float) -> HypoidAxleParameters:
    return replace(axle, roughness_rms=axle.roughness_rms * by)


_NOT_MEASURED = "state of lubrication not known, no torque measured"
_MEASURED = "drag calibrated with measured torques of the bearings"

UNCERTAIN = (
    Uncertain("viscosity", "oil viscosity", 1.08, "batches of one reference oil", _viscosity),
    Uncertain("eyring_stress", "Eyring stress of the oil", 2.0, "2 to 5 MPa in use", _eyring),
    Uncertain("alpha", "pressure-viscosity coefficient", 1.15, "between methods", _alpha),
    Uncertain("roughness", "roughness of the flanks", 1.4, "new against run in", _roughness),
    Uncertain(
        "flank_friction",
        "law of flank friction",
        1.2,
        "assumed, laws of traction among each other",
        None,
        ("friction_viscous", "friction_boundary"),
    ),
    Uncertain(
        "bearing_drag",
        "law of bearing drag",
        UNCALIBRATED["palmgren"],
        _NOT_MEASURED,
        None,
        ("bearing_torque",),
    ),
    Uncertain(
        "churning",
        "law and immersion of the churning",
        3.0,
        "laws among each other, and oil thrown off",
        None,
        ("churning",),
    ),
    Uncertain("seals", "torque of the seals", 2.0, "seals among each other", None, ("seals",)),
    Uncertain(
        "flank_rolling",
        "law of the rolling of the flanks",
        2.0,
        "assumed, laws of rolling among each other, and inlet heating",
        None,
        ("friction_rolling",),
    ),
)


def uncertain_of(
    axle: HypoidAxleParameters, *, calibrated_bearings: bool = False
) -> tuple[Uncertain, ...]:
    """Return the usual uncertain data, with the factors of an axle's oil and bearing law.

    Parameters
    ----------
    axle
        Its oil has factors of its own; the factor of the bearing drag is that of its law, from
        the table that `bearing_loss` takes as well.
    calibrated_bearings
        f0 and f1 of Palmgren's law are from measured torques of these bearings.

    Raises
    ------
    ParameterError
        Calibrated bearings with another law: only Palmgren's has factors to calibrate.

    Examples
    --------
    >>> from dataclasses import replace
    >>> from gearlube_core.dynamics.hypoid_axle.parameters import mohammadpour_2015_axle
    >>> axle = replace(mohammadpour_2015_axle(), bearing_torque_loss="biboulet_houpert_2010")
    >>> {one.name: one.factor for one in uncertain_of(axle)}["bearing_drag"]
    3.0
    """
    oil, law = axle.oil, axle.bearing_torque_loss
    if calibrated_bearings and law not in ("palmgren", "palmgren_loaded"):
        raise ParameterError(
            "Calibrated bearings must have the law palmgren or palmgren_loaded, whose f0 and f1 "
            f"hold the measured torque, got {law}. Leave the calibration out, or take palmgren."
        )
    of_oil = f"of {oil.name}".replace(";", ",")
    own = {"alpha": (oil.alpha_factor, of_oil), "eyring_stress": (oil.eyring_stress_factor, of_oil)}
    if calibrated_bearings:
        own["bearing_drag"] = (CALIBRATED, _MEASURED)
    elif law in BEARING_LAWS:
        own["bearing_drag"] = (UNCALIBRATED[BEARING_LAWS[law]], _NOT_MEASURED)
    found = []
    for one in UNCERTAIN:
        factor, why = own.get(one.name, (None, ""))
        found.append(one if factor is None else replace(one, factor=factor, why=why))
    return tuple(found)


@dataclass(frozen=True, slots=True, kw_only=True)
class LossMapSettings:
    """A loss map: the axle, its grid and its uncertain data.

    Parameters
    ----------
    axle : HypoidAxleParameters
    torques : ndarray of shape (n,)
        On the pinion [N.m], rising; below 0 the wheels drive. Default: 21 from half the coast
        end of the mesh table to its drive end.
    speeds : ndarray of shape (m,)
        Of the pinion [rad/s], rising. Default: 20 from 25 to 525 rad/s.
    temperatures : ndarray of shape (k,)
        Of the oil [K], rising. Default: 40, 60, 80 and 100 degC.
    draws : int
        Samples of the uncertain data, 0 to 10000; 0: no error bars.
    seed : int
    calibrated_bearings : bool
        f0 and f1 of Palmgren's law are from measured torques of these bearings: their drag is
        known to a factor of 1.25.
    uncertain : tuple of Uncertain, optional
        Default: `uncertain_of` the axle.
    cooling : Cooling, optional
        Of the axle in a car; with it the map has the oil temperature at which each torque and
        speed comes to rest, and the loss there.

    Examples
    --------
    >>> from gearlube_core.dynamics.hypoid_axle.parameters import mohammadpour_2015_axle
    >>> settings = LossMapSettings(axle=mohammadpour_2015_axle())
    >>> settings.shape
    (4, 20, 21)
    """

    axle: HypoidAxleParameters
    torques: Array | None = None
    speeds: Array | None = None
    temperatures: Array | None = None
    draws: int = 60
    seed: int = 1
    calibrated_bearings: bool = False
    uncertain: tuple[Uncertain, ...] = ()
    cooling: Cooling | None = None

    def __post_init__(self) -> None:
        if not self.uncertain:
            usual = uncertain_of(self.axle, calibrated_bearings=self.calibrated_bearings)
            object.__setattr__(self, "uncertain", usual)
        low, high = self.axle.torque_range
        given = {
            "torques": (self.torques, _usual_torques(0.5 * low, high)),
            "speeds": (self.speeds, np.linspace(25.0, 525.0, 20)),
            "temperatures": (
                self.temperatures,
                np.array([celsius_to_kelvin(t) for t in (40.0, 60.0, 80.0, 100.0)]),
            ),
        }
        for name, (values, default) in given.items():
            chosen = default if values is None else np.atleast_1d(np.asarray(values, dtype=float))
            if chosen.ndim != 1 or chosen.size == 0 or np.any(np.diff(chosen) <= 0.0):
                raise ParameterError(
                    f"{name} must be a list of rising numbers, got {chosen}. Sort it, and remove "
                    "what stands twice."
                )
            object.__setattr__(self, name, chosen)
        if self.cooling is not None:
            self.axle.oil.check_temperature(self.cooling.air_temperature, "air_temperature")
        check_within("draws", self.draws, 0, MOST_DRAWS, "", "60 are usual.")
        check_within("seed", self.seed, 0, 2**32 - 1, "", "Any whole number.")
        points = math.prod(self.shape)
        if points > MOST_POINTS:
            raise ParameterError(
                f"A map has at most {MOST_POINTS} points, got {points}. Take longer steps."
            )

    @property
    def shape(self) -> tuple[int, int, int]:
        """Numbers of temperatures, speeds and torques."""
        return self.grid[2].size, self.grid[1].size, self.grid[0].size

    @property
    def grid(self) -> tuple[Array, Array, Array]:
        """Torques [N.m], speeds [rad/s] and temperatures [K]."""
        return np.asarray(self.torques), np.asarray(self.speeds), np.asarray(self.temperatures)


def _usual_torques(low: float, high: float) -> Array:
    """Return 21 torques with 0 among them, where the loss has its kink."""
    return np.concatenate([np.linspace(low, 0.0, 7, endpoint=False), np.linspace(0.0, high, 14)])
