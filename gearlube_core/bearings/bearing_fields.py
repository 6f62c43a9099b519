"""The fields of a tapered roller bearing that bearing files and axle files share."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from gearlube_core.input_file.field_notes import Usual
from gearlube_core.input_file.input_file import Section

Diameter = Annotated[float, Field(ge=5.0, le=2000.0, allow_inf_nan=False), Usual(10.0, 800.0)]
RollerSize = Annotated[float, Field(ge=2.0, le=500.0, allow_inf_nan=False), Usual(2.5, 120.0)]
Rollers = Annotated[int, Field(ge=3, le=40)]
Rating = Annotated[float, Field(ge=1.0, le=20000.0, allow_inf_nan=False), Usual(10.0, 5000.0)]
Angle = Annotated[float, Field(ge=5.0, le=45.0, allow_inf_nan=False), Usual(8.0, 36.0)]
ViscousFactor = Annotated[float, Field(ge=0.0, le=100.0, allow_inf_nan=False)]
LoadFactor = Annotated[float, Field(ge=0.0, le=0.1, allow_inf_nan=False)]
Series = Literal["302", "303", "313", "320X", "322", "other"]


class BearingFields(Section):
    """What a drawing and a catalogue tell of a tapered roller bearing."""

    bore_diameter_mm: Diameter | None = Field(
        default=None, description="Bore diameter of the inner ring"
    )
    outside_diameter_mm: Diameter | None = Field(
        default=None, description="Outside diameter of the outer ring"
    )
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
    contact_angle_deg: Angle | None = Field(
        default=None,
        description="Contact angle of the outer race: half the included angle of the cup",
    )
    f0: ViscousFactor | None = Field(
        default=None, description="Viscous factor of Palmgren's law; 6 is for an oil bath"
    )
    f1: LoadFactor | None = Field(default=None, description="Load factor of Palmgren's law")
    series: Series | None = Field(
        default=None, description="Series in the catalogue, for the friction law of SKF"
    )
