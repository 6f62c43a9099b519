"""Settings of a damage run: an axle, its life in bins, materials, bearings."""

from __future__ import annotations

import hashlib
import pickle
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields
from functools import cached_property
from typing import Annotated

import numpy as np

from drivetrain.axle_file.axle_file import CarAxle
from drivetrain.axle_file.read_axle import gear_file_of
from gearlube.damage.teeth import Teeth, axle_teeth
from gearlube_core import __version__
from gearlube_core.bearings.bearing_type import Bearing
from gearlube_core.bearings.tapered_roller_bearing import TaperedRollerBearing
from gearlube_core.checks import check_option, check_positive, check_within
from gearlube_core.contact.dang_van import FatigueLimits
from gearlube_core.errors import ParameterError
from gearlube_core.hypoid_geometry.blank.hypoid_blank import HypoidBlank
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from gearlube_core.number import Checked, Number
from gearlube_core.rating.bearing_life import CLEANLINESS, RatedBearing
from gearlube_core.rating.gears import Gears, LoadFactors, RatedGear
from gearlube_core.rating.spectrum import DutyBins, Rate
from gearlube_core.rating.subsurface import CaseHardening, hardness_profile

_MOST_BINS = 1000
_NOT_OF_A_BIN = "bins", "pair", "factors", "duty", "wear_steps", "wear_step", "gear_file"


@dataclass(frozen=True, kw_only=True)
class DamageSettings(Checked):
    """An axle or a pair, its life in bins, and what its gears and bearings bear.

    Parameters
    ----------
    car
        Axle of an axle file; its mesh table has the places of contact on the tooth.
    pair
        Teeth of a helical or spur pair, see `helical_teeth`, where there is no axle.
    bins
        Torque on the pinion, speed of the pinion, oil temperature, time of the whole life; see
        `cycle_bins`, `read_bins`.
    gears
        Material of pinion and gear; None: no strength.
    blank
        Of the gears, for ISO 10300; None: no rating by the standard.
    factors
        K factors of the standard; its loads are those of the bins, without dynamics. None: K_H beta
        of the solved contact for a pair, 1.65 for an axle, K_A 1.
    wear_coefficient
        k of Archard's law [1/Pa]; None: no wear.
    wear_of_all_load
        Whether films spare nothing: the coefficients of tests count the whole load. False: only the
        load on asperities wears, a hypothesis; its share depends on the law of friction.
    wear_steps
        Most steps of wear, after each of which the contact is solved again, see `wear_in_steps`; 0:
        the rate of the new flank alone.
    wear_step
        Depth of both members together in one of them, at the worst place [m].
    gear_file
        Gear file of the axle's gears, for steps of wear; see `gear_file_of`.
    bearings
        Of the pinion's and of the gear's shaft, see `rated_bearing`; None: no life.
    cleanliness
        Of the oil, a key of `CLEANLINESS`; None: basic life alone.
    raceway_roughness
        Composite, of raceways and rollers [m]; with solved films of rollers kappa follows from it.
    scuffing_temperature
        At which the oil scuffs, mean of tests [K]; None: no probability of scuffing.
    case
        Hardness of the flanks over depth; None: no flank fracture.
    fatigue
        Limits under the surface, the same at all depths; None: no number of Dang Van.
    test_torque
        Of the C-GF test gear at the failure stage of the oil [N.m]; None: no permissible film.
    test_bulk
        Temperature of the flanks in that test [K]; 363.15 is that of its oil, the safe choice.
    duty
        Words for the bins.

    Examples
    --------
    >>> import gearlube as gl
    >>> bins = gl.rating.duty_bins([3600.0], [100.0], [200.0], 353.15, widths=(10.0, 10.0, 10.0))
    >>> DamageSettings(car=gl.read_axle("mohammadpour_2015"), bins=bins).rate is None  # no material
    True
    """

    bins: DutyBins
    car: CarAxle | None = None
    pair: Teeth | None = None
    gears: Gears | None = None
    blank: HypoidBlank | None = None
    factors: LoadFactors | None = None
    wear_coefficient: Annotated[
        float | None, Number("1/Pa", 0.0, 1e-11, "Measured ones lie within 1e-19 to 1e-15.")
    ] = None
    wear_of_all_load: bool = False
    wear_steps: Annotated[int, Number("", 0, 1000, "Each is an analysis of the contact.")] = 0
    wear_step: Annotated[float, Number("m", 1e-8, 1e-4, "1 um is 1e-6.")] = 1e-6
    gear_file: HypoidGearFile | None = None
    bearings: tuple[RatedBearing | None, RatedBearing | None] = (None, None)
    cleanliness: str | None = None
    raceway_roughness: Annotated[float | None, Number("m", 1e-9, 1e-5, "0.2 um is 2e-7.")] = None
    scuffing_temperature: Annotated[
        float | None, Number("K", 300.0, 1000.0, "250 degC is 523 K.")
    ] = None
    case: CaseHardening | None = None
    fatigue: FatigueLimits | None = None
    test_torque: Annotated[
        float | None, Number("N.m", 5.0, 1000.0, "265.1 N.m is load stage 10.")
    ] = None
    test_bulk: Annotated[float, Number("K", 300.0, 500.0, "90 degC is 363.15 K.")] = 363.15
    duty: str = "own bins"

    def __post_init__(self) -> None:
        Checked.__post_init__(self)
        if self.case is not None:
            hardness_profile(np.zeros(1), **self.case._asdict())
        cure = "Take wider bins."
        check_within("the number of bins", self.bins.torque.size, 1, _MOST_BINS, "", cure)
        for torque in self.bins.torque:
            words = *self.teeth.torques, "N.m", self.teeth.cure
            check_within("torque of a bin", torque, *words)
        for temperature in self.bins.temperature:
            self.teeth.oil.check_temperature(float(temperature), "temperature of a bin")
        check_positive("time of all bins", self.bins.time.sum(), "s", "Leave out empty bins.")
        if self.cleanliness is not None:
            check_option("cleanliness", self.cleanliness, CLEANLINESS)
        if self.test_torque is not None:
            self.teeth.oil.check_temperature(self.test_bulk, "test_bulk")
        if self.wear_steps:
            self.worn  # noqa: B018  fails here, before any work

    @property
    def worn(self) -> tuple[CarAxle, HypoidGearFile]:
        """Axle and gear file, which steps of wear need, and with them a coefficient."""
        if self.car is None or self.gear_file is None or self.wear_coefficient is None:
            raise ParameterError(
                "Steps of wear must have an axle, a gear file and a wear coefficient, got "
                f"{self.car and self.car.name}, {self.gear_file and self.gear_file.name} and "
                f"{self.wear_coefficient}. Give --wear-coefficient, and --gears where the axle "
                "names no gear file."
            )
        return self.car, self.gear_file

    @cached_property
    def teeth(self) -> Teeth:
        """Those that mesh."""
        if self.pair is not None and self.car is None:
            return self.pair
        if self.pair is not None or self.car is None:
            raise ParameterError(
                "Either car or pair must be given, got "
                f"{'neither' if self.car is None else 'both'}. Take `read_axle` or `helical_teeth`."
            )
        return axle_teeth(self.car, self.blank)

    @cached_property
    def load_factors(self) -> LoadFactors:
        """Those that are given, or of the teeth."""
        return self.factors or LoadFactors(face=self.teeth.face(self.bins))

    def bin_key(self, place: int) -> str:
        """Return a hash of a bin and of all that decides what is found there."""
        given = [getattr(self, one.name) for one in fields(self) if one.name not in _NOT_OF_A_BIN]
        teeth = self.pair and self.pair.key
        at = [float(one[place]) for one in self.bins]
        whole = __version__, given, self.load_factors, teeth, at
        return hashlib.sha256(pickle.dumps(whole)).hexdigest()[:20]

    @property
    def rate(self) -> Rate | None:
        """The standard's rating over torque [N.m], speed [rad/s], temperature [K]; None: none."""
        return None if self.gears is None else self.teeth.rate(self.gears, self.load_factors)


def rated_gears(
    treatment: str, contact_mpa: float | None, bending_mpa: float | None
) -> Gears | None:
    """Return the material of both gears with limits in MPa; None: neither is given.

    Raises
    ------
    ParameterError
        One of both limits is missing, or out of range.
    """
    both = {"--contact-limit-mpa": contact_mpa, "--bending-limit-mpa": bending_mpa}
    limits = together(both, "1500 and 430 MPa are an example of case-hardened steel.")
    if not limits:
        return None
    gear = RatedGear(
        treatment=treatment, contact_limit=1e6 * limits[0], bending_limit=1e6 * limits[1]
    )
    return gear, gear


def together(numbers: Mapping[str, float | None], cure: str) -> list[float]:
    """Return numbers that are given together, or none of them; only some raise ParameterError."""
    given = [one for one in numbers.values() if one is not None]
    if given and len(given) < len(numbers):
        got = ", ".join(f"{name} {one}" for name, one in numbers.items())
        raise ParameterError(f"These must be given together, got {got}. {cure}")
    return given


def check_needed(*options: tuple[str, object, str, object]) -> None:
    """Raise ParameterError where an option is given without another one that it needs."""
    for name, value, needed, there in options:
        if value and not there:
            raise ParameterError(
                f"{name} must have {needed} with it, got none: alone it changes nothing. Give "
                f"{needed}, or leave out {name}."
            )


def rated_pair(
    axle: str, gears: str, treatment: str, contact_mpa: float | None, bending_mpa: float | None
) -> tuple[Gears | None, HypoidBlank | None]:
    """Return the material of an axle's gears, and their blank of the gear file; None where missing.

    Parameters
    ----------
    axle, gears
        Axle file, and gear file if that is not named there; paths or shipped names.
    treatment, contact_mpa, bending_mpa
        Of both gears, limits in MPa; neither: no strength.

    Raises
    ------
    ParameterError
        One of both limits is missing, or the gear file.
    """
    material = rated_gears(treatment, contact_mpa, bending_mpa)
    if material is None:
        return None, None
    return material, gear_file_of(axle, gears).blank()


def rated_bearing(size: Bearing, ratings_kn: Sequence[float] | None) -> RatedBearing | None:
    """Return tapered rollers with C, or C and C_0 [kN], and the sizes of an axle file's bearing."""
    if not ratings_kn:
        return None
    if not isinstance(size, TaperedRollerBearing) or len(ratings_kn) > 2:
        raise ParameterError(
            "Ratings of bearings must be C, or C and C_0, of tapered rollers, got "
            f"{len(ratings_kn)} of {size.name}. `bearing_life` takes other bearings."
        )
    for rating in ratings_kn:
        check_within("rating of a bearing", rating, 1.0, 1e4, "kN", "88 kN is 88, not 88000.")
    return RatedBearing(
        kind="radial_roller",
        dynamic_rating=1e3 * ratings_kn[0],
        static_rating=1e3 * ratings_kn[1] if len(ratings_kn) > 1 else None,
        pitch_diameter=0.5 * (size.inner_race_diameter + size.outer_race_diameter),
        elements=size.n_rollers,
        element_diameter=size.roller_diameter,
        contact_angle=size.contact_angle,
    )
