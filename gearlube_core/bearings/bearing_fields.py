"""The fields of a tapered roller bearing that bearing files and axle files share.

Rollers of a tapered roller bearing from what a catalogue prints: boundary sizes and load rating.

Catalogues print neither number nor size of the rollers. Shares of the section are those of two
bearings whose rollers are known: 32216 in [wingertszahn_2023], and that of [mohammadpour_2015].
"""

from __future__ import annotations

import math
from functools import partial
from typing import Annotated, Any, Literal

from pydantic import Field

from gearlube_core.bearings.losses.geometry import BearingGeometry
from gearlube_core.input_file.field_notes import Declared, Usual
from gearlube_core.input_file.input_file import Section

_OF_SECTION = 0.57  # roller diameter over half the difference of outside diameter and bore
_OF_CIRCLE = 0.8  # roller diameters over the circumference of the pitch circle
_LENGTH = 1.5  # over the diameter, if no load rating is known
_B_M = 1.1  # tapered roller bearings
_LAMBDA_NU = 0.83
_of = partial(Declared, BearingGeometry)
Diameter = Annotated[float, _of("bore_diameter_mm"), Usual(10.0, 800.0)]
RollerSize = Annotated[float, _of("roller_diameter_mm"), Usual(2.5, 120.0)]
Rollers = Annotated[int, _of("rollers", "n_rollers")]
Rating = Annotated[float, Field(ge=1.0, le=20000.0, allow_inf_nan=False), Usual(10.0, 5000.0)]
Angle = Annotated[float, _of("contact_angle_deg", "outer_angle"), Usual(8.0, 36.0)]
ViscousFactor = Annotated[float, _of("f0")]
LoadFactor = Annotated[float, _of("f1")]
Series = Literal["302", "303", "313", "320X", "322", "other"]

# texts of fields
BORE = Field(description="Bore diameter of the inner ring")
OUTSIDE = Field(description="Outside diameter of the outer ring")
CONTACT_ANGLE = Field(
    description="Contact angle of the outer race: half the included angle of the cup"
)
F0 = Field(description="Viscous factor of Palmgren's law; 6 is for an oil bath")
F1 = Field(description="Load factor of Palmgren's law")
SERIES = Field(description="Series in the catalogue, for the friction law of SKF")


def usual_roller_diameter(bore: float, outside: float) -> float:
    """Return the mean roller diameter that is usual in a section [m].

    Bearing 32216 has 0.57 of the section, that of [mohammadpour_2015] 0.58.

    >>> round(1e3 * usual_roller_diameter(0.080, 0.140), 1)  # 32216 has 17 mm
    17.1
    """
    return 0.5 * _OF_SECTION * (outside - bore)


def usual_roller_count(pitch: float, diameter: float) -> int:
    """Return how many rollers usually stand on the pitch circle [-].

    Their diameters fill 0.8 of its circumference; 0.77 and 0.80 in the two bearings.

    >>> usual_roller_count(0.1085, 0.017)  # 32216 has 16
    16
    """
    return max(3, round(_OF_CIRCLE * math.pi * pitch / diameter))


def roller_length_of_rating(
    rating: float, *, rollers: int, diameter: float, contact_angle: float, pitch: float
) -> float:
    """Return the effective roller length that gives a load rating C of one row of rollers [m].

    C = b_m f_c (L cos a)^(7/9) Z^(3/4) D^(29/27) in N and mm, [iso_281], with f_c by its
    formula. The factors are quoted from memory.

    Parameters
    ----------
    rating : float
        C, basic dynamic radial load rating [N].
    rollers : int
        Number of rollers Z [-].
    diameter, pitch : float
        Mean diameter D of a roller and diameter of the circle through the roller centres [m].
    contact_angle : float
        a [rad].
    """
    long_side = rating / _rating_per_length(rollers, diameter, contact_angle, pitch)
    return 1e-3 * float(long_side ** (9 / 7)) / math.cos(contact_angle)


def usual_roller_length(diameter: float) -> float:
    """Return 1.5 roller diameters [m]; the two bearings have 1.34 and 1.73."""
    return _LENGTH * diameter


def add_catalogue_rollers(
    given: dict[str, Any], pitch: float, rating: float | None, usual: object
) -> dict[str, str]:
    """Add the rollers that a file leaves out; return how they follow, by field of the file.

    Parameters
    ----------
    given : dict
        What the file gives, in SI units: bore_diameter, outside_diameter, n_rollers,
        roller_diameter, roller_length, contact_angle. Rollers are added to it.
    pitch : float
        Pitch diameter [m].
    rating : float, optional
        Basic dynamic load rating [N].
    usual : object
        Has n_rollers, roller_diameter and contact_angle where they do not follow.
    """
    how = {}
    if "bore_diameter" in given and "outside_diameter" in given:
        if "roller_diameter" not in given:
            bore, outside = given["bore_diameter"], given["outside_diameter"]
            given["roller_diameter"] = usual_roller_diameter(bore, outside)
            how["roller_diameter_mm"] = "usual in this section: 0.57 of its height"
        if "n_rollers" not in given:
            given["n_rollers"] = usual_roller_count(pitch, given["roller_diameter"])
            how["rollers"] = "usual: they fill 0.8 of the pitch circle"
        if "roller_length" not in given and rating is None:
            given["roller_length"] = usual_roller_length(given["roller_diameter"])
            how["roller_length_mm"] = "1.5 roller diameters; give dynamic_load_rating_kn"
    if rating is not None and "roller_length" not in given:
        rollers, diameter, angle = (
            given[name] if name in given else getattr(usual, name)
            for name in ("n_rollers", "roller_diameter", "contact_angle")
        )
        given["roller_length"] = roller_length_of_rating(
            rating, rollers=rollers, diameter=diameter, contact_angle=angle, pitch=pitch
        )
        how["roller_length_mm"] = "load rating, ISO 281"
    return how


def rating_factor(gamma: float) -> float:
    """Return f_c of [iso_281] for D cos(a) over the pitch diameter [-].

    >>> round(rating_factor(0.1), 1)
    84.2
    """
    ratio = (1.0 - gamma) / (1.0 + gamma)
    races = (1.0 + (1.04 * ratio ** (143 / 108)) ** 4.5) ** (-2 / 9)
    form = gamma ** (2 / 9) * (1.0 - gamma) ** (29 / 27) / (1.0 + gamma) ** 0.25
    return 207.9 * _LAMBDA_NU * float(races * form)


def _rating_per_length(rollers: int, diameter: float, contact_angle: float, pitch: float) -> float:
    gamma = diameter * math.cos(contact_angle) / pitch
    size = rollers**0.75 * (1e3 * diameter) ** (29 / 27)
    return _B_M * rating_factor(gamma) * float(size)


class BearingFields(Section):
    """Data of a tapered roller bearing from a drawing and a catalogue."""

    bore_diameter_mm: Annotated[Diameter | None, BORE] = None
    outside_diameter_mm: Annotated[Diameter | None, OUTSIDE] = None
    pitch_diameter_mm: Diameter | None = Field(
        default=None,
        description="Diameter of the circle through the roller centres; left out: the mean of "
        "the race diameters, or of bore and outside diameter if one of these is given",
    )
    dynamic_load_rating_kn: Rating | None = Field(
        default=None,
        description="Basic dynamic load rating C of the catalogue, only to find the roller length",
    )
    rollers: Rollers | None = Field(
        default=None,
        description="Number of rollers in a row; left out beside bore and outside diameter: as "
        "many as fill 0.8 of the pitch circle",
    )
    roller_diameter_mm: RollerSize | None = Field(
        default=None,
        description="Mean roller diameter, at mid-length; left out beside bore and outside "
        "diameter: 0.57 of half their difference",
    )
    roller_length_mm: RollerSize | None = Field(
        default=None,
        description="Effective roller length: without chamfers and undercuts; left out: from the "
        "load rating, or 1.5 roller diameters beside bore and outside diameter",
    )
    contact_angle_deg: Annotated[Angle | None, CONTACT_ANGLE] = None
    f0: Annotated[ViscousFactor | None, F0] = None
    f1: Annotated[LoadFactor | None, F1] = None
    series: Annotated[Series | None, SERIES] = None
