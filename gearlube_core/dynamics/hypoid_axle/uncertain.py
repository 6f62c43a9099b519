"""How uncertain the losses of an axle are: data and laws that are known to a factor."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.bearings.followed_shaft import BEARING_LAWS
from gearlube_core.bearings.losses.laws import DEFAULT_LAW, RACE_LAWS
from gearlube_core.bearings.losses.loss import CALIBRATED, UNCALIBRATED
from gearlube_core.bearings.losses.rib import RIB_FRICTION_FACTOR, RIB_ROUGHNESS_FACTOR
from gearlube_core.dynamics.hypoid_axle.losses import LOSS_SOURCES, axle_losses
from gearlube_core.dynamics.hypoid_mesh.parameters import HypoidAxleParameters
from gearlube_core.errors import ParameterError
from gearlube_core.film_model.model import MOST_OUTSIDE
from gearlube_core.number import numbers_of
from gearlube_core.oil.base_oils import HIGH_PRESSURE_FACTOR
from gearlube_core.units import celsius_to_kelvin

MOST_DRAWS = 10_000
UPPER_END = 2.0  # standard deviations of one input alone
_REFERENCE = celsius_to_kelvin(40.0), celsius_to_kelvin(100.0)


@dataclass(frozen=True, slots=True)
class Uncertain:
    """An input or a law that is known to a factor.

    Parameters
    ----------
    name
        Key of the uncertain input.
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
    oil = axle.oil
    oil = replace(oil, eyring_stress=oil.eyring_stress * by, eyring_slope=oil.eyring_slope * by)
    return replace(axle, oil=oil)


def _alpha(axle: HypoidAxleParameters, by: float) -> HypoidAxleParameters:
    return replace(axle, oil=replace(axle.oil, alpha=axle.oil.alpha * by))


def _high_pressure(axle: HypoidAxleParameters, by: float) -> HypoidAxleParameters:
    return replace(axle, oil=axle.oil.with_high_pressure(by))


def _roughness(axle: HypoidAxleParameters, by: float) -> HypoidAxleParameters:
    return replace(axle, roughness_rms=axle.roughness_rms * by)


def _of_bearings(name: str) -> Callable[[HypoidAxleParameters, float], HypoidAxleParameters]:
    """Return the change of a number of all bearings that have it, times a number."""
    return partial(_times, "bearing", name)


def _of_numbers(axle: HypoidAxleParameters) -> Iterator[Uncertain]:
    """Yield numbers that are declared with a factor, of axle, friction law, bearings, oil's laws.

    Those of the bearings of both shafts are one input.
    """
    laws = [("oil", law) for law in (axle.oil.viscosity_law, axle.oil.shear_law) if law]
    parts = ("", axle), ("friction", axle.friction_law), ("bearing", axle.bearing), *laws
    for field, part in parts:
        kind: Any = type(part)
        for name, one in numbers_of(kind).items():
            if one.factor > 1.0:
                changed = partial(_times, field, name)
                key = f"{field}_{name}".lstrip("_")
                yield Uncertain(key, one.text, one.factor, one.source, changed)


def _times(field: str, name: str, axle: HypoidAxleParameters, by: float) -> HypoidAxleParameters:
    """Return the axle with a number of it or of the part in a field times another."""

    def changed(part: Any) -> Any:
        value = getattr(part, name, None)
        return replace(part, **{name: by * value}) if value else part

    if not field:
        return changed(axle)  # type: ignore[no-any-return]
    if field == "friction":
        return replace(axle, friction=changed(axle.friction_law))
    if field == "oil":
        oil = axle.oil
        laws = {"viscosity_law": changed(oil.viscosity_law), "shear_law": changed(oil.shear_law)}
        return replace(axle, oil=replace(oil, **laws))
    other = axle.gear_bearing and changed(axle.gear_bearing)
    return replace(axle, bearing=changed(axle.bearing), gear_bearing=other)


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
        UNCALIBRATED[DEFAULT_LAW],
        _NOT_MEASURED,
        None,
        ("bearing_torque",),
    ),
    Uncertain(
        "preload",
        "preload of the bearings",
        2.0,
        "assumed, 2500 and 6000 N in one paper",
        _of_bearings("preload"),
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
    Uncertain(
        "high_pressure",
        "viscosity of the oil at 1 GPa",
        HIGH_PRESSURE_FACTOR,
        "alpha of films known, viscosity there is not",
        _high_pressure,
    ),
)

RIBS = (
    Uncertain(
        "rib_friction",
        "friction of asperities at the ribs",
        RIB_FRICTION_FACTOR,
        "0.1 to 0.2",
        _of_bearings("rib_boundary_friction"),
    ),
    Uncertain(
        "rib_roughness",
        "roughness of the ribs",
        RIB_ROUGHNESS_FACTOR,
        "assumed, run in against new",
        _of_bearings("rib_roughness"),
    ),
)  # with a law of the bearings that counts ribs


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
    >>> from gearlube_core.dynamics.hypoid_axle.mohammadpour_2015 import mohammadpour_2015_axle
    >>> axle = replace(mohammadpour_2015_axle(), bearing_torque_loss="biboulet_houpert_2010")
    >>> {one.name: one.factor for one in uncertain_of(axle)}["bearing_drag"]
    5.0
    """
    oil, law = axle.oil, axle.bearing_torque_loss
    if calibrated_bearings and law not in ("palmgren", "palmgren_loaded"):
        raise ParameterError(
            "Calibrated bearings must have the law palmgren or palmgren_loaded, whose f0 and f1 "
            f"come from the measured torque, got {law}. Do not set the bearings as calibrated, or "
            "take palmgren."
        )
    of_oil = f"of {oil.name}".replace(";", ",")
    own = {
        "alpha": (oil.alpha_factor, of_oil),
        "eyring_stress": (oil.eyring_stress_factor, of_oil),
        "high_pressure": (oil.high_pressure_factor, of_oil),
    }
    if calibrated_bearings:
        own["bearing_drag"] = (CALIBRATED, _MEASURED)
    elif law in BEARING_LAWS:
        laws = [BEARING_LAWS[law]]
        if laws == ["solved_films"]:  # and the formula of rollers outside the model's domain
            laws.append("biboulet_houpert")
        own["bearing_drag"] = (max(UNCALIBRATED[one] for one in laws), _NOT_MEASURED)
    found = []
    ribbed = BEARING_LAWS.get(law) in RACE_LAWS
    for one in (*UNCERTAIN, *RIBS * ribbed, *_of_numbers(axle)):
        factor, why = own.get(one.name, (None, ""))
        if one.name == "preload" and (calibrated_bearings or not hasattr(axle.bearing, "preload")):
            continue  # it is in the measured torque, or there is none
        if one.name == "high_pressure" and oil.pressure_factor() is None:
            continue  # formulas keep the law of their source
        found.append(one if factor is None else replace(one, factor=factor, why=why))
    return tuple(found)


def log_slope(upper: Array, lower: Array) -> Array:
    """Return d ln(loss) by the standard normal of an input, from the losses at +-UPPER_END.

    0 where a loss is not above 0.
    """
    both = (upper > 0.0) & (lower > 0.0)
    ratio = np.divide(upper, lower, out=np.ones_like(upper), where=both)
    return np.asarray(np.log(ratio) / (2.0 * UPPER_END))


def by_one_film(
    ends: Sequence[HypoidAxleParameters],
    losses: Callable[[HypoidAxleParameters], tuple[Array, Array]],
) -> list[Array]:
    """Return losses (..., sources) of axles that differ in a datum, by one film at each point.

    `losses` returns them and the share of the flanks' load outside the film model (...). Where this
    is too large for any of the axles, all are by the formulas.
    """
    found = [losses(one) for one in ends]
    left = np.any([share > MOST_OUTSIDE for _, share in found], axis=0)[..., None]
    if not left.any():
        return [power for power, _ in found]
    formulas = [losses(replace(one, film="formula"))[0] for one in ends]
    pairs = zip(formulas, found, strict=True)
    return [np.where(left, formula, power) for formula, (power, _) in pairs]


def changed_axle(
    one: Uncertain, axle: HypoidAxleParameters, normal: float, scale: Array
) -> HypoidAxleParameters:
    """Return the axle with one uncertain input changed, or change the scale of its sources.

    Parameters
    ----------
    one
    axle
    normal
        Standard normal of the input [-]; 2 is its upper end.
    scale : ndarray of shape (sources,)
        Factors of the losses, see `losses.LOSS_SOURCES`; multiplied in place.

    Raises
    ------
    ParameterError
        The input leaves its limits.
    """
    by = one.multiplier(normal)
    if normal == 0.0:
        return axle
    if one.changed is not None:
        try:
            return one.changed(axle, by)
        except ParameterError as error:
            raise ParameterError(
                f"The error bars draw the {one.words} at {by:.3g} times its value, and must stay "
                f"within its limits: {error} Take a value farther from its limit, or --draws 0 "
                "(draws = 0) for no error bars."
            ) from error
    for source in one.sources:
        scale[LOSS_SOURCES.index(source)] *= by
    return axle


def drawn_losses(
    axle: HypoidAxleParameters,
    power: Array,
    *,
    torque: float,
    speed: float,
    temperature: float,
    draws: int = 200,
    seed: int = 1,
) -> Array:
    """Return the total loss [W] of an axle in steady running with its uncertain data drawn.

    Parameters
    ----------
    axle
    power : ndarray of shape (sources,)
        What it loses [W], see `losses.LOSS_SOURCES`.
    torque, speed, temperature
        Of the pinion [N.m], [rad/s], of the oil [K], where it loses that.
    draws, seed
        Number of draws and what they start from.

    Returns
    -------
    ndarray of shape (draws,)

    Notes
    -----
    Each datum changes a source as a power law, found from the losses with the datum at either end.

    Raises
    ------
    ParameterError
        A datum leaves its limits, or the point those of the axle.
    """

    def losses(changed: HypoidAxleParameters) -> tuple[Array, Array]:
        solved = changed.film == "solved"
        found = axle_losses(
            changed,
            torques=np.array([torque]),
            speeds=np.array([speed]),
            temperatures=np.array([temperature]),
            angles=8,
            extremes=solved,
        )
        return found.power[0, 0, 0], found.share_outside[0, 0, 0] if solved else np.zeros(())

    inputs = uncertain_of(axle)
    slopes: list[Array] = []
    for one in inputs:
        scales = [np.ones(len(LOSS_SOURCES)) for _ in range(2)]
        ends = [
            changed_axle(one, axle, normal, scale)
            for normal, scale in zip((UPPER_END, -UPPER_END), scales, strict=True)
        ]
        slopes.append(log_slope(*(scales if one.changed is None else by_one_film(ends, losses))))
    normals = np.random.default_rng(seed).standard_normal((draws, len(inputs)))
    return np.asarray(np.exp(normals @ np.array(slopes)) @ power)
