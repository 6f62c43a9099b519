"""The sections of the axle file on the pinion, the gear and their bearings."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace
from functools import partial
from typing import Annotated, Any, ClassVar

from pydantic import ConfigDict, Field, SerializeAsAny, model_validator

from drivetrain.axle_file.axle_sections import SolidOfRevolution, stacked_frusta
from drivetrain.axle_file.section import ModelSection, part_notes, part_numbers
from gearlube_core.bearings.bearing_fields import BearingFields, Diameter, add_catalogue_rollers
from gearlube_core.bearings.bearing_type import Bearing, bearing_types
from gearlube_core.bearings.losses.rib import RIB_HEIGHT
from gearlube_core.bearings.roller_stiffness import palmgren_roller_stiffness
from gearlube_core.bearings.tapered_roller_bearing import (
    LARGEST_FIT,
    PRELOAD,
    Film,
    TaperedRollerBearing,
)
from gearlube_core.dynamics.hypoid_mesh.parameters import HypoidAxleParameters
from gearlube_core.errors import ParameterError
from gearlube_core.input_file.field_notes import Declared, OneOf, Usual
from gearlube_core.input_file.field_units import field_value, unit_of
from gearlube_core.input_file.input_file import InputNote, Origin
from gearlube_core.number import numbers_of

_axle, _bearing = partial(Declared, HypoidAxleParameters), partial(Declared, TaperedRollerBearing)
Stiffness = Annotated[float, _bearing("stiffness_constant"), Usual(1e7, 1e11)]
Exponent = Annotated[float, _bearing("exponent")]
Share = Annotated[float, _bearing("loss")]
Preload = Annotated[float, _bearing("preload_n"), Usual(100.0, 50000.0)]
Interference = Annotated[
    float, Field(ge=0.0, le=1e6 * LARGEST_FIT, allow_inf_nan=False), Usual(0.5, 50.0)
]
RibHeight = Annotated[float, Field(ge=0.0, le=100.0, allow_inf_nan=False), Usual(0.2, 20.0)]
RibFriction = Annotated[float, _bearing("rib_boundary_friction")]
RibRoughness = Annotated[float, _bearing("rib_roughness_um"), Usual(0.02, 3.0)]

_TAPERED = TaperedRollerBearing.name
USUAL_PRELOAD = 2500.0  # N, the lower one of [mohammadpour_2015]
_RACES = ("inner_race_diameter_mm", "outer_race_diameter_mm")
_BOUNDARY = ("bore_diameter_mm", "outside_diameter_mm")
Mass = Annotated[float, _axle("mass_kg", "pinion_mass"), Usual(0.5, 500.0)]
Inertia = Annotated[float, _axle("inertia_kg_m2", "pinion_inertia"), Usual(0.0001, 20.0)]
Length = Annotated[float, Field(gt=0.0, le=2000.0, allow_inf_nan=False), Usual(1.0, 500.0)]
Outside = Annotated[float, Field(gt=0.0, le=3000.0, allow_inf_nan=False), Usual(3.0, 1000.0)]
Bore = Annotated[float, Field(ge=0.0, le=3000.0, allow_inf_nan=False), Usual(1.0, 500.0)]
Frusta = Annotated[tuple[Length, ...], Field(strict=False, min_length=1, max_length=40)]
Diameters = Annotated[tuple[Outside, ...], Field(strict=False, min_length=1, max_length=40)]
Bores = Annotated[tuple[Bore, ...], Field(strict=False, min_length=1, max_length=40)]
_LISTS = ("frusta_lengths_mm", "frusta_first_diameters_mm", "frusta_last_diameters_mm")
_KEYS = ("mass_kg", "inertia_kg_m2")


class BearingSection(ModelSection, BearingFields):
    """The two opposed bearings of one shaft; the fields are those of tapered roller bearings."""

    renamed: ClassVar[Mapping[str, str]] = {"rollers": "n_rollers"}
    sources: ClassVar[Mapping[str, str]] = {
        "contact_angle_deg": "common for axle bearings; no source",
        "exponent": "line contact",
        "f0": "Palmgren 1959",
        "f1": "Palmgren 1959",
        "preload_n": "the lower of the two of Mohammadpour et al. 2015",
        "film": "default of the model",
        "series": "default of the model",
        "rib_boundary_friction": "default of `gearlube bearing`",
        "rib_roughness_um": "default of `gearlube bearing`",
    }

    type: Annotated[str, OneOf(bearing_types)] | None = Field(
        default=None,
        description="Type of the bearings, or the name of a type of your own with its numbers as "
        "fields; all others are those of tapered_roller",
    )
    inner_race_diameter_mm: Diameter | None = Field(
        default=None,
        description="Diameter of the inner race at the middle of the rollers; left out: pitch "
        "diameter minus roller diameter times the cosine of the contact angle",
    )
    outer_race_diameter_mm: Diameter | None = Field(
        default=None,
        description="Diameter of the outer race at the middle of the rollers; left out: pitch "
        "diameter plus roller diameter times the cosine of the contact angle",
    )
    stiffness_constant: Stiffness | None = Field(
        default=None,
        description="Stiffness constant kn of the contact inner race - roller - outer race "
        "[N/m^n]; left out: that of steel rollers of this length",
    )
    exponent: Exponent | None = Field(
        default=None, description="Exponent n in load = kn approach^n; 10/9 for line contacts"
    )
    preload_n: Preload | None = Field(
        default=None,
        description="Axial force on each bearing at standstill; give this or the interference",
    )
    interference_um: Interference | None = Field(
        default=None,
        description="Interference of every roller at standstill, instead of the preload",
    )
    loss: Share | None = Field(
        default=None, description="Hysteresis loss coefficient of the rollers"
    )
    film: Film | None = Field(
        default=None,
        description="Oil film of the rollers: with squeeze factor, without it, or no film at all",
    )
    rib_height_mm: RibHeight | None = Field(
        default=None,
        description="Height of the contact between roller ends and rib above the inner race, "
        "for drag torques from rolling; left out: 0.15 roller diameters, assumed; 0: no rib",
    )
    rib_boundary_friction: RibFriction | None = Field(
        default=None,
        description="Friction coefficient of asperities between roller ends and rib; 0.2 for new "
        "ribs without finish",
    )
    rib_roughness_um: RibRoughness | None = Field(
        default=None, description="Composite RMS roughness of roller ends and rib"
    )

    @model_validator(mode="wrap")
    @classmethod
    def _of_type(cls, data: Any, handler: Any) -> Any:
        name = data.get("type") if isinstance(data, Mapping) else None
        if isinstance(name, str) and name != _TAPERED and name in bearing_types(name):
            return OwnBearings.of(data)
        return handler(data)

    @model_validator(mode="after")
    def _check_bearing(self) -> BearingSection:
        problems = []
        if self.has("preload_n") and self.has("interference_um"):
            problems.append(
                "preload_n and interference_um set the same approach of the rollers, got "
                f"{self.preload_n:g} N and {self.interference_um:g} um; give one of them"
            )
        races = [key for key in _RACES if self.has(key)]
        if len(races) == 1:
            problems.append(
                f"the two race diameters must be given together, got only {races[0]}; give both"
            )
        if races and self.has("pitch_diameter_mm"):
            problems.append(
                "pitch_diameter_mm and the race diameters describe the same size; give one of them"
            )
        if not problems:
            try:
                problems = self._geometry_problems(self._tapered())
            except ParameterError as reason:
                problems = [f"In SI units: {str(reason).removesuffix('.')}"]
        if problems:
            raise ValueError(". ".join(problems))
        return self

    @staticmethod
    def _geometry_problems(made: TaperedRollerBearing) -> list[str]:
        mm = 1e3
        pitch = 0.5 * (made.inner_race_diameter + made.outer_race_diameter)
        problems = []
        preload = made.preload_force()
        if preload > PRELOAD.high:
            problems.append(
                f"the preload must be within 0 to {PRELOAD.high:g} N, got {preload:.4g} N from "
                "the interference; 10 um is common"
            )
        room = pitch * math.sin(math.pi / made.n_rollers)
        if made.roller_diameter > room:
            most = math.floor(math.pi / math.asin(min(1.0, made.roller_diameter / pitch)))
            problems.append(
                f"the rollers overlap: {made.n_rollers} rollers on a pitch diameter of "
                f"{mm * pitch:.4g} mm leave {mm * room:.4g} mm for each, got rollers of "
                f"{mm * made.roller_diameter:.4g} mm; at most {most} fit"
            )
        if not made.bore_diameter < pitch < made.outside_diameter:
            problems.append(
                f"the pitch diameter, {mm * pitch:.4g} mm, must lie between bore and outside "
                f"diameter, got {mm * made.bore_diameter:.4g} and "
                f"{mm * made.outside_diameter:.4g} mm; give all three of one bearing"
            )
        elif not (
            made.bore_diameter < made.inner_race_diameter
            and made.outer_race_diameter < made.outside_diameter
        ):
            problems.append(
                f"the rings must have room: races of {mm * made.inner_race_diameter:.4g} and "
                f"{mm * made.outer_race_diameter:.4g} mm must lie between bore and outside "
                f"diameter, got {mm * made.bore_diameter:.4g} and "
                f"{mm * made.outside_diameter:.4g} mm; check roller and pitch diameter"
            )
        return problems

    @property
    def _pitch(self) -> tuple[float, str] | None:
        """Pitch diameter [m] that the races follow from, and how; None: the paper's races."""
        if self.has("pitch_diameter_mm"):
            return self.si("pitch_diameter_mm"), "pitch diameter"
        base = TaperedRollerBearing.mohammadpour_2015()
        if any(self.has(key) for key in _BOUNDARY):
            bore, outside = (
                self.si(key) if self.has(key) else getattr(base, self.attribute(key))
                for key in _BOUNDARY
            )
            return 0.5 * (bore + outside), "mean of bore and outside diameter"
        if self.has("roller_diameter_mm"):
            return 0.5 * (base.inner_race_diameter + base.outer_race_diameter), "assumed pitch"
        return None

    def _changes(self) -> tuple[dict[str, Any], dict[str, str]]:
        """Return the attributes of the bearing that follow from the file, and the inferred."""
        base = TaperedRollerBearing.mohammadpour_2015()
        changes = self.changes(base)
        inferred: dict[str, str] = {}
        interference = changes.pop("interference", None)
        changes.setdefault("preload", USUAL_PRELOAD)
        pitch = self._pitch
        rating = self.dynamic_load_rating_kn
        if pitch is not None or rating is not None:
            inferred |= add_catalogue_rollers(
                changes,
                pitch[0] if pitch else 0.5 * (base.inner_race_diameter + base.outer_race_diameter),
                None if rating is None else self.si("dynamic_load_rating_kn"),
                base,
            )
        if "roller_length" in changes and not self.has("stiffness_constant"):
            changes["stiffness_constant"] = palmgren_roller_stiffness(changes["roller_length"])
            inferred["stiffness_constant"] = "Palmgren's, from the roller length"
        if not self.has(_RACES[0]) and pitch is not None:
            diameter = changes.get("roller_diameter", base.roller_diameter)
            across = diameter * math.cos(changes.get("contact_angle", base.contact_angle))
            changes["inner_race_diameter"] = pitch[0] - across
            changes["outer_race_diameter"] = pitch[0] + across
            inferred |= dict.fromkeys(_RACES, f"{pitch[1]} and roller diameter")
        if interference is not None:
            fitted = replace(base, **(changes | {"preload": None})).with_interference(interference)
            changes["preload"] = fitted.preload_force()
            inferred["preload_n"] = "interference"
        return changes, inferred

    def bearing(self, preload: float | None = None) -> Bearing:
        """Return the bearing with its preload.

        Parameters
        ----------
        preload : float, optional
            Taken where the file gives neither preload nor interference [N].
        """
        return self._tapered(preload)

    def _tapered(self, preload: float | None = None) -> TaperedRollerBearing:
        changes, _ = self._changes()
        if preload is not None and not (self.has("preload_n") or self.has("interference_um")):
            changes["preload"] = preload
        return replace(TaperedRollerBearing.mohammadpour_2015(), **changes)

    def bearing_notes(self, prefix: str, made: Bearing, why: str) -> list[InputNote]:
        """Return a note on every field; `made` is what `bearing` returned."""
        notes = self.notes(prefix, made, why, self._changes()[1])
        if not self.has("rib_height_mm"):
            assumed = field_value("rib_height_mm", RIB_HEIGHT * self._tapered().roller_diameter)
            why = f"{RIB_HEIGHT:g} roller diameters; no source"
            notes.append(InputNote(f"{prefix}rib_height_mm", assumed, "mm", "assumed", why))
        return notes


class OwnBearings(BearingSection):
    """Bearings of a type that registers itself: the fields are its numbers."""

    model_config = ConfigDict(extra="allow")

    @classmethod
    def of(cls, data: Mapping[str, Any]) -> OwnBearings:
        """Return the section with data of a file; raise ValueError where they are wrong."""
        made = cls.model_construct(set(data), **data)
        try:
            made.bearing()
        except ParameterError as reason:
            raise ValueError(str(reason).removesuffix(".")) from None
        return made

    @property
    def _data(self) -> dict[str, Any]:
        return self.model_dump(exclude_unset=True, exclude={"type"})

    def bearing(self, preload: float | None = None) -> Bearing:
        """Return the bearing; `preload` [N] is taken where it has one and the file gives none."""
        kind = bearing_types()[str(self.type)]
        numbers = part_numbers(kind, self._data)
        if preload is not None and "preload" in numbers_of(kind):
            numbers = {"preload": preload} | numbers
        return kind(**numbers)

    def bearing_notes(self, prefix: str, made: Bearing, why: str) -> list[InputNote]:
        """Return a note on the type and on every number of it."""
        of_type = InputNote(f"{prefix}type", made.name, "", "given", "")
        return [of_type, *part_notes(prefix, made, self._data)]


class Member(ModelSection):
    """Pinion or gear with all that turns and moves with it."""

    mass_kg: Mass | None = Field(
        default=None,
        description="Mass of the member with its shaft and all parts on it; left out: from its "
        "frusta",
    )
    inertia_kg_m2: Inertia | None = Field(
        default=None,
        description="Moment of inertia of the member with its shaft and all parts on it, about "
        "its axis; left out: from its frusta",
    )
    frusta_lengths_mm: Frusta | None = Field(
        default=None,
        description="Blank and shaft described as cone frusta on one axis, of the steel: length "
        "of each frustum",
    )
    frusta_first_diameters_mm: Diameters | None = Field(
        default=None, description="Outside diameter of each frustum at one end"
    )
    frusta_last_diameters_mm: Diameters | None = Field(
        default=None, description="Outside diameter of each frustum at the other end"
    )
    frusta_bores_mm: Bores | None = Field(
        default=None, description="Bore diameter of each frustum; left out: solid"
    )
    bearing: SerializeAsAny[BearingSection] | None = None

    @model_validator(mode="after")
    def _check_frusta(self) -> Member:
        keys = (*_LISTS, "frusta_bores_mm") if self.has("frusta_bores_mm") else _LISTS
        sizes = [len(getattr(self, key) or ()) for key in keys]
        if len(set(sizes)) > 1:
            raise ValueError(
                f"{', '.join(keys)} must have the same number of entries, got "
                f"{', '.join(map(str, sizes))}; give one of each for every frustum"
            )
        ends = zip(
            self.frusta_bores_mm or (),
            self.frusta_first_diameters_mm or (),
            self.frusta_last_diameters_mm or (),
            strict=False,
        )
        for k, (bore, one, two) in enumerate(ends):
            if bore >= min(one, two):
                raise ValueError(
                    f"frusta_bores_mm must be below both diameters of their frustum, got "
                    f"{bore:g} mm in frustum {k + 1} of {one:g} and {two:g} mm; 0 is a solid one"
                )
        return self

    def solid(self, density: float) -> SolidOfRevolution | None:
        """Return mass and inertia of the frusta of a density [kg/m3]; None: the file has none."""
        if self.frusta_lengths_mm is None:
            return None
        lengths, first, last = (self.si(key) for key in _LISTS)
        bores = self.si("frusta_bores_mm") if self.has("frusta_bores_mm") else (0.0,) * len(lengths)
        return stacked_frusta(lengths, first, last, bores, density)

    def member_changes(self, role: str, density: float) -> dict[str, Any]:
        """Return mass and inertia of pinion or gear as the axle has them, given or of the frusta.

        `density` is that of the steel [kg/m3].
        """
        solid = self.solid(density)
        changes = {} if solid is None else {"mass": solid.mass, "inertia": solid.inertia}
        changes |= {self.attribute(key): self.si(key) for key in _KEYS if self.has(key)}
        return {f"{role}_{name}": value for name, value in changes.items()}

    def member_notes(self, role: str, axle: object, density: float, why: str) -> list[InputNote]:
        """Return notes on mass, inertia and frusta; `why` is where the defaults are from."""
        solid = self.solid(density)
        origin: Origin = "assumed" if solid is None else "inferred"
        if solid is not None:
            why = f"{len(self.si('frusta_lengths_mm'))} frusta, density {density:g} kg/m3"
        notes = []
        for key in _KEYS:
            value = field_value(key, getattr(axle, f"{role}_{self.attribute(key)}"))
            given = self.has(key)
            notes.append(
                InputNote(
                    f"{role}.{key}",
                    value,
                    unit_of(key),
                    "given" if given else origin,
                    "" if given else why,
                )
            )
        for key in (*_LISTS, "frusta_bores_mm"):
            if self.has(key):
                value = getattr(self, key)
                notes.append(InputNote(f"{role}.{key}", value, unit_of(key), "given", ""))
        return notes
