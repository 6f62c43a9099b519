"""Life of rolling bearings by ISO 281, and by ISO/TS 16281 from the load of each ball or roller."""

from __future__ import annotations

import math
from dataclasses import dataclass
from types import MappingProxyType
from typing import Annotated, Literal, NamedTuple

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.checks import check_option, check_positive, check_within
from gearlube_core.errors import ParameterError
from gearlube_core.number import Checked, Number, Positive
from gearlube_core.units import rads_to_rpm

# Cleanliness classes of ISO 4406 for oil with a filter in its circuit, for a bath without one, and
# of grease: A, B of e_C. Those of oil are not checked against the source.
CLEANLINESS = MappingProxyType({
    "-/13/10": (0.0864, 0.5663), "-/15/12": (0.0432, 0.9987),
    "-/17/14": (0.0288, 1.6329), "-/19/16": (0.0216, 2.3362),
    "bath -/13/10": (0.0864, 0.5796), "bath -/15/12": (0.0288, 1.141),
    "bath -/17/14": (0.0133, 1.67), "bath -/19/16": (0.00864, 2.5164),
    "bath -/21/18": (0.00411, 3.8974),
    "grease, very clean": (0.0864, 0.6796), "grease, clean": (0.0432, 1.141),
    "grease, slightly dirty": (0.0177, 1.887), "grease, dirty": (0.0115, 2.662),
    "grease, very dirty": (0.00617, 4.06),
})  # fmt: skip
RELIABILITY = MappingProxyType({90: 1.0, 95: 0.64, 96: 0.55, 97: 0.47, 98: 0.37, 99: 0.25})  # a_1
_LEAST_KAPPA, _MOST_KAPPA = 0.1, 4.0
_MOST, _MOST_EP = 50.0, 3.0  # a_ISO, and with EP additives
_CLEAN_EP = 0.2  # e_C from which additives count
_POWERS = (0.054381, 0.19087, 0.071739)  # of kappa below 0.4, below 1, above
_LARGE = 0.1  # m, pitch diameter from which C_u is lower
_END_LOADS = 0.83  # lambda_nu, by which C is lower for loads at the ends of rollers
_FORCE, _METRES = Positive("N", "1 kN is 1000 N."), "Give metres, not millimetres."


class _Law(NamedTuple):
    """Exponents that differ between balls and rollers."""

    life: float  # exponent p of C/P
    exponents: tuple[float, float]  # of the mean load of elements on a standing and a turning race
    weibull: float  # slope e
    shares: tuple[float, float]  # of F/(Z cos a) in a half loaded bearing, inner and outer race
    rows: float  # exponent of the number of rows
    race: tuple[float, float, float]  # factor and exponents of the ratio of the races
    constants: tuple[float, float, float]  # of a_ISO with the powers of kappa
    a_iso: tuple[float, float, float, float]  # its constant and exponents
    thrust: float  # by which C_u/P counts less in thrust bearings; not checked with the source
    fatigue: tuple[float, float]  # C_0/C_u, and exponent of large bearings

    def modification(self, kappa: float, ratio: Array, most: float) -> Array:
        """Return a_ISO of e_C C_u/P [-]."""
        n = 0 if kappa < 0.4 else 1 if kappa < 1.0 else 2
        first, inner, power, outer = self.a_iso
        film = max(first - self.constants[n] / kappa ** _POWERS[n], 0.0) ** inner
        left = np.maximum(1.0 - film * ratio**power, 1e-3)
        return np.minimum(0.1 * left**outer, most)


_BALL = _Law(
    3.0, (10.0 / 3.0, 3.0), 10.0 / 9.0, (0.407, 0.389), 0.7, (1.044, 1.72, 0.41),
    (2.2649, 1.9987, 1.9987), (2.5671, 0.83, 1.0 / 3.0, -9.3), 3.0, (22.0, 0.5),
)  # fmt: skip
_ROLLER = _Law(
    10.0 / 3.0, (4.5, 4.0), 9.0 / 8.0, (0.378, 0.364), 7.0 / 9.0, (1.038, 143.0 / 108.0, 0.0),
    (1.3993, 1.2348, 1.2348), (1.5859, 1.0, 0.4, -9.185), 2.5, (8.2, 0.3),
)  # fmt: skip


@dataclass(frozen=True, kw_only=True)
class RatedBearing(Checked):
    """Catalogue data of a rolling bearing.

    Parameters
    ----------
    kind
        "radial_ball", "radial_roller" (cylindrical, tapered), "thrust_ball" or "thrust_roller".
    dynamic_rating, static_rating, fatigue_limit
        C, C_0, C_u; None: C_0/22 of balls, C_0/8.2 of rollers, lower above a pitch diameter of
        100 mm.
    elements, rows
        Balls or rollers of a row, and rows.
    grooves
        Groove radii of inner and outer ring over the ball diameter [-].

    Examples
    --------
    >>> bearing = RatedBearing(kind="radial_ball", dynamic_rating=55.3e3, pitch_diameter=72.5e-3)
    >>> round((bearing.dynamic_rating / 10e3) ** bearing.law.life, 1)  # 1e6 turns
    169.1
    """

    kind: Literal["radial_ball", "radial_roller", "thrust_ball", "thrust_roller"]
    dynamic_rating: Annotated[float, _FORCE]
    pitch_diameter: Annotated[float, Number("m", 1e-3, 10.0, _METRES)]
    static_rating: Annotated[float | None, _FORCE] = None
    fatigue_limit: Annotated[float | None, _FORCE] = None
    element_diameter: Annotated[float | None, Positive("m", "Give metres.")] = None
    contact_angle: Annotated[float, Number("rad", 0.0, 0.5 * math.pi, "Give radians.")] = 0.0
    elements: Annotated[int, Number("1", 0, 500)] = 0
    rows: Annotated[int, Number("1", 1, 8)] = 1
    grooves: tuple[float, float] = (0.52, 0.52)

    def __post_init__(self) -> None:
        Checked.__post_init__(self)
        for ring, groove in zip(("inner", "outer"), self.grooves, strict=True):
            check_within(f"groove of the {ring} ring", groove, 0.501, 0.75, "", "0.52 is usual.")

    @property
    def law(self) -> _Law:
        """Exponents of its balls or rollers."""
        return _BALL if self.kind.endswith("ball") else _ROLLER

    @property
    def fatigue_load(self) -> float:
        """C_u [N]; not a number where neither it nor C_0 is given."""
        if self.fatigue_limit is not None or self.static_rating is None:
            return math.nan if self.fatigue_limit is None else self.fatigue_limit
        share, power = self.law.fatigue
        return self.static_rating / share * min(_LARGE / self.pitch_diameter, 1.0) ** power

    def race_ratings(self) -> tuple[float, float]:
        """Return Q_ci, Q_ce: loads on an element that a race turns 1e6 times under [N].

        Source: [iso_16281], for radial bearings.
        """
        if not self.elements or self.element_diameter is None or self.kind.startswith("thrust"):
            raise ParameterError(
                f"The loads of elements need a radial bearing with elements and element_diameter, "
                f"got a {self.kind} with {self.elements} and {self.element_diameter}. Give `load`."
            )
        law, cos, (inner, outer) = self.law, math.cos(self.contact_angle), self.grooves
        gamma = self.element_diameter * cos / self.pitch_diameter
        factor, power, groove = law.race
        ratio = factor * ((1.0 - gamma) / (1.0 + gamma)) ** power
        ratio *= (inner / outer * (2.0 * outer - 1.0) / (2.0 * inner - 1.0)) ** groove
        w = law.exponents[0]
        one = self.dynamic_rating / (self.elements * cos) / self.rows**law.rows
        return (
            one / law.shares[0] * (1.0 + ratio**w) ** (1.0 / w),
            one / law.shares[1] * (1.0 + ratio**-w) ** (1.0 / w),
        )


class BearingLife(NamedTuple):
    """Life of a bearing at one load and speed, by the standard's formulas as implemented here."""

    basic: float  # L_10 or L_10r [revolutions]
    modified: float  # L_nm or L_nmr [revolutions]; not a number outside of the law of a_iso
    speed: float  # [rad/s]
    load: float  # P, or the load of equal life, P_ref [N]
    kappa: float  # viscosity ratio [-]
    contamination: float  # e_C [-]
    a_iso: float
    a_1: float
    outside: tuple[str, ...]  # limits of the law of a_iso that are exceeded, in words
    standard: str

    @property
    def hours(self) -> tuple[float, float]:
        """Basic and modified life at the speed [h]."""
        per_hour = 3600.0 * self.speed / (2.0 * math.pi)
        return self.basic / per_hour, self.modified / per_hour


def equivalent_load(
    radial: float, axial: float, *, contact_angle: float = 0.0, catalogue: Array | None = None
) -> float:
    """Return P [N] of a radial bearing: F_r, or X F_r + Y F_a where F_a/F_r is above e.

    Radial and axial load [N] are not negative. With the contact angle of a single row of tapered
    rollers [rad]: e 1.5 tan a, X 0.4, Y 0.4 cot a. 0: F_r, of cylindrical rollers. `catalogue` has
    e, X, Y of a catalogue instead, as for balls.

    >>> round(equivalent_load(4e3, 3e3, contact_angle=0.25))
    6300
    """
    for name, load in (("radial", radial), ("axial", axial)):
        check_within(name, load, 0.0, 1e9, "N", "Give its amount.")
    if catalogue is not None:
        e, X, Y = catalogue
    elif contact_angle > 0.0:
        e, X, Y = 1.5 * math.tan(contact_angle), 0.4, 0.4 / math.tan(contact_angle)
    else:
        return radial
    return radial if axial <= e * radial else X * radial + Y * axial


def bearing_life(
    bearing: RatedBearing, *, speed: float, cleanliness: str | tuple[float, float],
    load: float | None = None, element_loads: Array | None = None,
    viscosity: float | None = None, film_ratio: float | None = None, reliability: int = 90,
    additives: bool = False, inner_turns: bool = True, end_loads: bool = False,
) -> BearingLife:  # fmt: skip
    """Return basic and modified life of a bearing.

    Slices: L = [sum (q_ci/q_ei)^-4.5 + (q_ce/q_ee)^-4.5]^(-8/9), q_c = Q_c n^(-7/9), with the means
    q_e of the loads of all rollers. A slice's a_ISO is that of a bearing with all slices alike.
    e_C = min(1, A kappa^0.68 D^0.55) (1 - B/D^(1/3)) of a pitch diameter D in mm. ParameterError
    where loads or viscosity are missing or impossible. Source: [iso_281]; [iso_16281].

    Parameters
    ----------
    bearing, speed
        Ratings and sizes; speed of one ring relative to the other [rad/s].
    cleanliness
        A key of `CLEANLINESS`, or A and B of e_C.
    load, element_loads
        P, see `equivalent_load` [N], or loads of each ball (Z,) or of each slice of each roller
        (Z, n), with several rows (rows, Z, n) [N].
    viscosity, film_ratio
        Kinematic, at the temperature of the raceway [m2/s], or least film over composite roughness
        of raceway and element; kappa is its power 1.3, not checked against the source.
    reliability, additives
        90, 95 to 99 [%]; whether proven EP additives let kappa below 1 count as 1.
    inner_turns
        Whether the inner ring turns relative to the load.
    end_loads
        Whether slices at the ends of rollers bear the standard's multiples of their loads; not
        checked against the source. False: loads have them, or rollers are profiled.

    Examples
    --------
    >>> bearing = RatedBearing(
    ...     kind="radial_roller", dynamic_rating=80e3, fatigue_limit=8.5e3, pitch_diameter=62.7e-3
    ... )
    >>> life = bearing_life(
    ...     bearing, load=12e3, speed=157.08, viscosity=20e-6, cleanliness="-/17/14"
    ... )
    >>> [round(one) for one in life.hours], round(life.a_iso, 4)
    ([6196, 3604], 0.5816)
    """
    check_positive("speed", speed, "rad/s", "1000 rpm is 104.7 rad/s.")
    check_option("reliability", str(reliability), map(str, RELIABILITY))
    if (load is None) == (element_loads is None):
        raise ParameterError("Give load or element_loads, one of them.")
    if (viscosity is None) == (film_ratio is None):
        raise ParameterError("Give viscosity or film_ratio, one of them.")
    law = bearing.law
    n, D = rads_to_rpm(speed), 1e3 * bearing.pitch_diameter
    nu_1 = 1e-6 * (45000.0 * n**-0.83 if n < 1000.0 else 4500.0 * n**-0.5) / math.sqrt(D)
    kappa = max(film_ratio or 0.0, 0.0) ** 1.3 if viscosity is None else viscosity / nu_1
    if isinstance(cleanliness, str):
        cleanliness = CLEANLINESS[check_option("cleanliness", cleanliness, CLEANLINESS)]
    A, B = cleanliness
    clean = min(1.0, A * min(kappa, _MOST_KAPPA) ** 0.68 * D**0.55)
    e_C = max(clean * (1.0 - B / D ** (1.0 / 3.0)), 0.0)
    with_ep = additives and kappa < 1.0 and e_C >= _CLEAN_EP
    used = 1.0 if with_ep else min(kappa, _MOST_KAPPA)
    outside = []
    if used < _LEAST_KAPPA:
        outside.append(f"viscosity ratio kappa from 0.1 on, got {kappa:.3g}: no modified life")
    if math.isnan(bearing.fatigue_load):
        outside.append("fatigue_limit or static_rating is needed, got neither: no modified life")
    withheld = bool(outside)
    if bearing.fatigue_limit is None and bearing.pitch_diameter > _LARGE:
        outside.append("C_u of bearings above 100 mm is a formula from memory; give fatigue_limit")
    if element_loads is None:
        share = check_positive("load", load or 0.0, "N") / bearing.dynamic_rating
        sums = np.array([share]) ** (law.life * law.weibull)
    else:
        sums = _slice_sums(bearing, np.asarray(element_loads), inner_turns, end_loads)
    basic = float(sums.sum() ** (-1.0 / law.weibull))
    loads = bearing.dynamic_rating * (sums.size * sums) ** (1.0 / (law.weibull * law.life))
    a_iso = math.nan
    if not withheld:
        ratio = e_C * bearing.fatigue_load / np.maximum(loads, 1e-9 * bearing.dynamic_rating)
        ratio /= law.thrust if bearing.kind.startswith("thrust") else 1.0
        of_slices = law.modification(used, ratio, _MOST_EP if with_ep else _MOST)
        a_iso = float((sums * of_slices**-law.weibull).sum() ** (-1.0 / law.weibull)) / basic
    a_1 = RELIABILITY[reliability]
    return BearingLife(
        basic=1e6 * basic, modified=1e6 * a_1 * a_iso * basic, speed=speed,
        load=bearing.dynamic_rating * basic ** (-1.0 / law.life),
        kappa=kappa, contamination=e_C, a_iso=a_iso, a_1=a_1, outside=tuple(outside),
        standard="ISO 281:2007" if element_loads is None else "ISO/TS 16281:2008",
    )  # fmt: skip


def _slice_sums(bearing: RatedBearing, loads: Array, inner_turns: bool, end_loads: bool) -> Array:
    """Return the contribution of each slice of the elements to life to the power -e."""
    law, ratings = bearing.law, np.array(bearing.race_ratings())
    if loads.size % (bearing.rows * bearing.elements) or not loads.size:
        raise ParameterError(
            f"element_loads must have a load of each of {bearing.rows * bearing.elements} elements "
            f"or of their slices, got the shape {loads.shape}."
        )
    loads = loads.reshape(bearing.rows, bearing.elements, -1)
    if not (np.isfinite(loads).all() and (loads >= 0.0).all() and loads.any()):
        raise ParameterError("element_loads must be finite, not negative and not all 0.")
    n = loads.shape[2]
    if law is _BALL and n > 1:
        raise ParameterError(f"A ball has no slices, got {n}. Give a load of each ball.")
    if end_loads and n > 1:
        place = np.abs((2.0 * np.arange(1, n + 1) - n - 1.0) / (2.0 * n - 2.0))
        with np.errstate(divide="ignore"):
            loads = loads * (1.0 - 0.01 / np.log(1.985 * place))
        ratings /= _END_LOADS
    sums = np.zeros(n)
    for race, rating in enumerate(ratings * n ** (-7.0 / 9.0) if n > 1 else ratings):
        exponent = law.exponents[inner_turns == (race == 0)]
        mean = (loads**exponent).mean(axis=1) ** (1.0 / exponent)
        sums += ((mean / rating) ** law.exponents[0]).sum(axis=0)
    return sums


def life_of_spectrum(lives: Array, revolutions: Array) -> float:
    """Return the life of load cases in turn [revolutions], of their lives and their revolutions.

    L = sum u/sum(u/L): Palmgren and Miner; a case without an own life makes it not a number.

    >>> round(life_of_spectrum(np.array([1e6, 4e6]), np.array([1.0, 1.0])))
    1600000
    """
    n = np.asarray(revolutions, dtype=float)
    if not ((n >= 0.0).all() and n.sum() > 0.0):
        raise ParameterError("revolutions must not be negative, and not all 0.")
    return float(n.sum() / (n / np.asarray(lives, dtype=float)).sum())
