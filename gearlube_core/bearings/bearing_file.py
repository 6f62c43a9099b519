"""The bearing file: a tapered roller bearing for the study of its losses."""

from __future__ import annotations

from functools import partial
from typing import Annotated, Any, ClassVar

from pydantic import Field, model_validator

from gearlube_core.bearings.bearing_fields import (
    BORE,
    CONTACT_ANGLE,
    F0,
    F1,
    OUTSIDE,
    SERIES,
    Angle,
    BearingFields,
    Diameter,
    LoadFactor,
    Series,
    ViscousFactor,
    add_catalogue_rollers,
)
from gearlube_core.bearings.losses.catalogue import F0_TAPERED_OIL_BATH, F1_TAPERED
from gearlube_core.bearings.losses.geometry import BearingGeometry, Rib, closing_inner_angle
from gearlube_core.bearings.losses.rib import (
    RIB_BOUNDARY_FRICTION,
    RIB_END_RADIUS,
    RIB_HEIGHT,
    RIB_ROUGHNESS,
    RIB_SHARE_B,
    RIB_SHARE_C,
)
from gearlube_core.errors import ParameterError
from gearlube_core.film_model.chosen_model import chosen_model
from gearlube_core.film_model.model import ROLLER, FilmModel
from gearlube_core.input_file.field_notes import Declared, Usual, field_notes
from gearlube_core.input_file.input_file import InputFile, InputNote, Section
from gearlube_core.input_file.tolerance import Tolerances, check_tolerances
from gearlube_core.oil.oil_file import Temperature
from gearlube_core.units import DEGREE, MILLIMETRE

Text = Annotated[str, Field(min_length=1)]
_of, _rib = partial(Declared, BearingGeometry), partial(Declared, Rib)
Rows = Annotated[int, _of("rows")]
InnerAngle = Annotated[float, Field(ge=0.1, le=45.0, allow_inf_nan=False), Usual(2.0, 36.0)]
Roughness = Annotated[float, _of("roughness_um"), Usual(0.02, 2.0)]
Scale = Annotated[float, _of("rolling_scale")]
Height = Annotated[float, Field(ge=0.1, le=50.0, allow_inf_nan=False), Usual(0.2, 20.0)]
EndRadius = Annotated[float, _rib("end_radius")]
ShareB = Annotated[float, _rib("share_b")]
ShareC = Annotated[float, _rib("share_c")]
Friction = Annotated[float, _rib("boundary_friction")]
ShaftSpeed = Annotated[float, Field(ge=0.0, le=1e5, allow_inf_nan=False), Usual(10.0, 3e4)]
Load = Annotated[float, Field(ge=0.0, le=1e7, allow_inf_nan=False), Usual(20.0, 1e6)]
Speeds = Annotated[tuple[ShaftSpeed, ...], Field(strict=False, min_length=1)]
Loads = Annotated[tuple[Load, ...], Field(strict=False, min_length=1)]
Temperatures = Annotated[tuple[Temperature, ...], Field(strict=False, min_length=1)]
_MICROMETRE = 1e-6  # m


class LossBearingSection(BearingFields):
    """Rings, races and rollers; these fields of a bearing have no default here."""

    series: Annotated[Series, SERIES] = "other"
    bore_diameter_mm: Annotated[Diameter, BORE]
    outside_diameter_mm: Annotated[Diameter, OUTSIDE]
    pitch_diameter_mm: Diameter | None = Field(
        default=None,
        description="Diameter of the circle through the middles of the rollers; left out: the "
        "mean of bore and outside diameter",
    )
    rows: Rows = Field(
        default=1, description="Number of rows; each row carries the same share of the load"
    )
    contact_angle_deg: Annotated[Angle, CONTACT_ANGLE]
    inner_angle_deg: InnerAngle | None = Field(
        default=None,
        description="Contact angle of the inner race; left out: the angle at which rollers and "
        "races share one apex",
    )
    roughness_um: Roughness = Field(
        default=0.16,
        description="Composite RMS roughness of roller and race; used only for the film ratio",
    )
    f0: Annotated[ViscousFactor, F0] = F0_TAPERED_OIL_BATH
    f1: Annotated[LoadFactor, F1] = F1_TAPERED
    rolling_scale: Scale | None = Field(
        default=None,
        description="Measured rolling torque of this bearing divided by the computed one; if "
        "given, the error bar of the raceways is a factor of 1.25 instead of that of the law",
    )

    def rollers_and_pitch(self) -> tuple[dict[str, Any], dict[str, str]]:
        """Return pitch and rollers in SI units, and how those left out follow, by field."""
        given = {
            "bore_diameter": self.bore_diameter_mm * MILLIMETRE,
            "outside_diameter": self.outside_diameter_mm * MILLIMETRE,
            "contact_angle": self.contact_angle_deg * DEGREE,
        }
        for name in ("pitch_diameter", "roller_diameter", "roller_length"):
            size = getattr(self, f"{name}_mm")
            if size is not None:
                given[name] = size * MILLIMETRE
        if self.rollers is not None:
            given["n_rollers"] = self.rollers
        how = {}
        if "pitch_diameter" not in given:
            given["pitch_diameter"] = 0.5 * (given["bore_diameter"] + given["outside_diameter"])
            how["pitch_diameter_mm"] = "mean of bore and outside diameter"
        rating = self.dynamic_load_rating_kn
        force = None if rating is None else 1e3 * rating
        return given, how | add_catalogue_rollers(given, given["pitch_diameter"], force, None)


class RibSection(Section):
    """The rib of the inner ring."""

    contact_height_mm: Height | None = Field(
        default=None,
        description="Height of the contact between roller end and rib above the inner race; "
        "left out: 0.15 roller diameters, assumed",
    )
    end_radius_ratio: EndRadius = Field(
        default=RIB_END_RADIUS,
        description="Radius of the spherical roller end divided by its distance from the apex",
    )
    roughness_um: Roughness = Field(
        default=RIB_ROUGHNESS / _MICROMETRE,
        description="Composite RMS roughness of rib and roller end",
    )
    share_b: ShareB = Field(
        default=RIB_SHARE_B,
        description="B in the share of the load on asperities, exp(-B Lambda^C), with Lambda "
        "the film ratio",
    )
    share_c: ShareC = Field(default=RIB_SHARE_C, description="C in the same formula")
    boundary_friction: Friction = Field(
        default=RIB_BOUNDARY_FRICTION,
        description="Friction coefficient of the asperities; 0.2 for new ribs without finish",
    )


class OperationSection(Section):
    """Default operation of the study."""

    speed_rpm: Speeds = Field(
        default=(500.0, 1000.0, 2000.0, 4000.0), description="Speeds of the shaft"
    )
    axial_load_n: Loads = Field(default=(1000.0,), description="Axial loads of the bearing")
    radial_load_n: Loads = Field(default=(0.0,), description="Radial loads of the bearing")
    temperature_degc: Temperatures = Field(
        default=(60.0,), description="Temperatures of the oil in the bearing"
    )


class BearingFile(InputFile):
    """Bearing file: a tapered roller bearing as a drawing and a catalogue describe it.

    Examples
    --------
    >>> BearingFile.shipped()
    ('wingertszahn_2023',)
    >>> bearing = BearingFile.named("wingertszahn_2023").geometry()
    >>> round(bearing.cage_ratio, 3)  # cage speed over shaft speed
    0.424
    """

    package: ClassVar[str] = "gearlube_core.bearings"
    title: ClassVar[str] = "bearing file"
    files: ClassVar[tuple[str, ...]] = ("oil", "film_model")

    name: Text = Field(description="Name of the bearing in results and figures")
    source: Text | None = Field(default=None, description="Where the numbers come from")
    oil: Text = Field(
        default="fva_3",
        description="Name of a shipped oil, or an oil file (.toml), its path relative to the "
        "bearing file; the command can take another one",
    )
    film_model: Text | None = Field(
        default=None,
        description="Film model of rollers for the law solved_films: file (.json) of `gearlube "
        "film-model fit`, its path relative to the bearing file, or the name of a shipped one; "
        "left out: roller_race",
    )
    bearing: LossBearingSection
    rib: RibSection = Field(default_factory=RibSection)
    operation: OperationSection = Field(default_factory=OperationSection)
    tolerances: Tolerances = Field(default={})

    @model_validator(mode="after")
    def _check_tolerances(self) -> BearingFile:
        if self.tolerances:
            check_tolerances(self.tolerances, field_notes(type(self)))
        return self

    @model_validator(mode="after")
    def _check_bearing(self) -> BearingFile:
        try:
            self.geometry()
        except ParameterError as reason:
            raise ValueError(str(reason).removesuffix(".")) from None
        return self

    def own_film_model(self) -> FilmModel | None:
        """Return the film model that the file names; None: the one in the package.

        Raises
        ------
        FileError, ParameterError
            It is missing, damaged or of another kind.
        """
        named = self.film_model
        return None if named is None else chosen_model(named, ROLLER, "film_model")

    def inferred_notes(self) -> list[InputNote]:
        """Return the rollers that are inferred where the file leaves them out."""
        found, how = self.bearing.rollers_and_pitch()
        return [
            InputNote(f"bearing.{key}", value, unit, "inferred", how[key])
            for key, value, unit in (
                ("pitch_diameter_mm", found["pitch_diameter"] / MILLIMETRE, "mm"),
                ("rollers", found["n_rollers"], ""),
                ("roller_diameter_mm", found["roller_diameter"] / MILLIMETRE, "mm"),
                ("roller_length_mm", found["roller_length"] / MILLIMETRE, "mm"),
            )
            if key in how
        ]

    def geometry(self) -> BearingGeometry:
        """Return the bearing in SI units."""
        of, rib, mm = self.bearing, self.rib, MILLIMETRE
        found, _ = of.rollers_and_pitch()
        pitch, roller, outer = (
            found[name] for name in ("pitch_diameter", "roller_diameter", "contact_angle")
        )
        given = of.inner_angle_deg
        height = rib.contact_height_mm
        return BearingGeometry(
            bore_diameter=found["bore_diameter"],
            outside_diameter=found["outside_diameter"],
            pitch_diameter=pitch,
            roller_diameter=roller,
            roller_length=found["roller_length"],
            n_rollers=found["n_rollers"],
            outer_angle=outer,
            inner_angle=(
                closing_inner_angle(pitch, roller, outer) if given is None else given * DEGREE
            ),
            rib=Rib(
                contact_height=RIB_HEIGHT * roller if height is None else height * mm,
                end_radius=rib.end_radius_ratio,
                roughness=rib.roughness_um * _MICROMETRE,
                share_b=rib.share_b,
                share_c=rib.share_c,
                boundary_friction=rib.boundary_friction,
            ),
            rows=of.rows,
            series=of.series,
            roughness=of.roughness_um * _MICROMETRE,
            f0=of.f0,
            f1=of.f1,
            rolling_scale=of.rolling_scale,
        )
