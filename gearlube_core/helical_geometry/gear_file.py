"""The gear file of a helical or spur pair: geometry, flanks and bodies in engineers' units."""

from __future__ import annotations

import math
import re
from typing import Annotated, ClassVar, Literal

from pydantic import Field, model_validator

from gearlube_core.errors import ParameterError
from gearlube_core.helical_geometry.gear_body import GearBody, SupportStiffness
from gearlube_core.helical_geometry.gear_file_sections import (
    Bearing,
    DampingRatios,
    Film,
    FilmMesh,
    Flank,
    LineSteps,
    Member,
    Oil,
    Operation,
    Pair,
)
from gearlube_core.helical_geometry.modification import (
    Crown,
    FlankModification,
    ModifiedPair,
    PowerTipRelief,
    TipRelief,
)
from gearlube_core.helical_geometry.pair import LARGEST_SHIFT, HelicalPair
from gearlube_core.helical_geometry.tooth_limits import profile_shift_sum
from gearlube_core.input_file.field_notes import field_notes
from gearlube_core.input_file.input_file import InputFile
from gearlube_core.input_file.tolerance import Tolerances, check_tolerances
from gearlube_core.storage.file_names import Name
from gearlube_core.units import DEGREE, MILLIMETRE

Text = Annotated[str, Field(min_length=1)]
Names = Annotated[tuple[Text, ...], Field(strict=False)]
Origin = Literal["table", "inferred", "completed"]
Role = Literal["pinion", "gear"]
_MICROMETRE = 1e-6  # m
_STEEL = 7850.0  # kg/m3
_DEDENDUM = 1.25  # normal modules; [iso_53], beside an addendum of 1
_UNUSUAL = 0.15  # of an addendum less 1, and of roots against tips, where a guess is doubtful
_ABSENT = {
    "root_diameter_mm": "the basic rack's dedendum, 1.25 normal modules, below the profile shift, "
    "or its full depth, 2.25 normal modules, below the tip",
    "profile_shift_coefficient": "from the centre distance without backlash, and from the other "
    "gear's profile shift or equal addenda",
    "body.mass_kg": "a steel disc of the root diameter and the face width",
    "body.polar_inertia_kg_mm2": "a disc of the member's mass and the root diameter",
    "body.diametral_inertia_kg_mm2": "a disc: J_z/2 + m W^2/12",
}

_RADIUS = re.compile(r"\b(pinion|gear)_(tip|root)_radius")
_IN_METRES = re.compile(r"(\S+) to (\S+) m, got (\S+) m\b")


class HelicalGearFile(InputFile):
    """Gear file of a helical or spur pair: geometry, flank modifications, bodies and bearings.

    Notes
    -----
    Values that a file leaves out are completed: root diameters from the basic rack, inertia from
    a steel disc. `provenance` is whether the source of a field prints it.

    Examples
    --------
    >>> HelicalGearFile.shipped()
    ('he_2007', 'jamali_2015_a', 'jamali_2015_b')
    >>> HelicalGearFile.named("he_2007").helical_pair().ratio
    1.24
    """

    package: ClassVar[str] = "gearlube_core.helical_geometry"
    files: ClassVar[tuple[str, ...]] = ("film.oil_file", "film.line_model")

    name: Name = Field(description="Name of the pair in reports and figures")
    source: Text = Field(description="Where the numbers come from")
    compared_with: Names = Field(
        default=(),
        description="Names of shipped gear files; `gearlube helical` shows their geometry "
        "beside that of this pair",
    )
    pair: Pair
    pinion: Member
    gear: Member
    damping: DampingRatios = DampingRatios()
    operation: Operation | None = None
    meshing_steps: LineSteps | None = None
    oil: Oil | None = None
    film: Film = Film()
    film_mesh: FilmMesh = FilmMesh()
    inferred: dict[Text, Text] = Field(
        default={},
        description="Dotted names of fields that the source does not print but that follow from "
        "it, and how they follow",
    )
    completed: dict[Text, Text] = Field(
        default={},
        description="Dotted names of fields or sections that the source lacks, and why these "
        "values were chosen",
    )
    tolerances: Tolerances = Field(default={})

    @model_validator(mode="after")
    def _check_relations(self) -> HelicalGearFile:
        """Check relations between fields."""
        known = field_notes(HelicalGearFile)
        for field in (*self.inferred, *self.completed):
            if not any(name == field or name.startswith(f"{field}.") for name in known):
                raise ValueError(f"inferred or completed names {field!r}, which is not a field")
        check_tolerances(self.tolerances, known)
        for name in self.compared_with:
            if name not in self.shipped():
                raise ValueError(
                    f"compared_with must name shipped gear files ({', '.join(self.shipped())}), "
                    f"got {name!r}"
                )
        for role, member in (("pinion", self.pinion), ("gear", self.gear)):
            if (member.bearing_1 is None) != (member.bearing_2 is None):
                raise ValueError(f"{role} needs bearing_1 and bearing_2, or neither")
            start, half = member.flank.crown_start_mm, 0.5 * self.pair.face_width_mm
            if member.flank.crown_um > 0.0 and not start < half:
                raise ValueError(
                    f"{role}.flank.crown_start_mm must be below half of pair.face_width_mm, "
                    f"{half:g} mm, got {start:g} mm"
                )
        try:
            self.modified_pair()
        except ParameterError as reason:
            text = str(reason).partition(" Give metres")[0].removesuffix(".")
            text = text.replace("centre_distance", "pair.centre_distance_mm")
            text = _RADIUS.sub(r"half of \1.\2_diameter_mm", text)
            text = _IN_METRES.sub(lambda found: _in_millimetres(*found.groups()), text)
            raise ValueError(
                f"{text}. With other teeth, module or helix angle the diameters of "
                "tip and root and the centre distance change too"
            ) from None
        return self

    def helical_pair(self) -> HelicalPair:
        """Return the macro geometry, in SI units."""
        pair = self.pair
        backlash = math.nan if pair.backlash_mm is None else pair.backlash_mm * MILLIMETRE
        return HelicalPair(
            name=self.name,
            pinion_teeth=self.pinion.teeth,
            gear_teeth=self.gear.teeth,
            normal_module=self._normal_module,
            normal_pressure_angle=self._normal_pressure_angle,
            helix_angle=pair.helix_angle_deg * DEGREE,
            centre_distance=pair.centre_distance_mm * MILLIMETRE,
            pinion_tip_radius=0.5 * self.pinion.tip_diameter_mm * MILLIMETRE,
            gear_tip_radius=0.5 * self.gear.tip_diameter_mm * MILLIMETRE,
            pinion_root_radius=self._root_radius("pinion"),
            gear_root_radius=self._root_radius("gear"),
            face_width=pair.face_width_mm * MILLIMETRE,
            backlash=backlash,
            profile_shift=self._given_shifts,
            fillet_factor=pair.fillet_radius_factor,
        )

    def modified_pair(self) -> ModifiedPair:
        """Return the pair with its flank modifications, in SI units."""
        return ModifiedPair(
            pair=self.helical_pair(),
            pinion=_modification(self.pinion.flank),
            gear=_modification(self.gear.flank),
        )

    def guesses(self) -> list[str]:
        """Return sentences on profile shifts that are guessed; none where one is given."""
        if self._given_shifts != (None, None):
            return []
        x1, x2 = (round(x, 3) + 0.0 for x in self.helical_pair().profile_shifts)
        return [
            f"Profile shift coefficients are guessed: x = {x1:.3f} (pinion) and {x2:.3f} (gear). "
            "Their sum is that of teeth that mesh with zero backlash at the given centre distance, "
            "their difference that of equal addenda. Give profile_shift_coefficient of [pinion] "
            "and [gear]."
        ]

    def remarks(self) -> list[str]:
        """Return warnings about tips, roots, undercut and guessed profile shifts."""
        pair, found = self.helical_pair(), []
        if self._given_shifts == (None, None):
            m, (x1, x2) = pair.normal_module, pair.profile_shifts
            pinion, gear = pair.pinion_reference_radius, pair.gear_reference_radius
            addendum = (pair.pinion_tip_radius - pinion) / m - x1
            roots = ((pinion - pair.pinion_root_radius) / m + x1,
                     (gear - pair.gear_root_radius) / m + x2)  # fmt: skip
            if max(abs(addendum - 1.0), abs(roots[0] - roots[1])) > _UNUSUAL:
                found.append(
                    "The guessed profile shifts are doubtful: with them addenda are "
                    f"{addendum:.2f} and dedenda {roots[0]:.2f} (pinion) and {roots[1]:.2f} (gear) "
                    "normal modules. Usual are 1 and 1.25, alike for both gears."
                )
        return found + pair.remarks()

    def body(self, role: Role) -> GearBody:
        """Return inertia and supports of the "pinion" or the "gear", in SI units."""
        member: Member = getattr(self, role)
        width, root = self.pair.face_width_mm * MILLIMETRE, self._root_radius(role)
        given = member.body
        mass = given.mass_kg
        if mass is None:
            mass = _STEEL * math.pi * root**2 * width
        polar = 0.5 * mass * root**2
        if given.polar_inertia_kg_mm2 is not None:
            polar = given.polar_inertia_kg_mm2 * MILLIMETRE**2
        diametral = 0.5 * polar + mass * width**2 / 12.0
        if given.diametral_inertia_kg_mm2 is not None:
            diametral = given.diametral_inertia_kg_mm2 * MILLIMETRE**2
        sides = ((1.0, member.bearing_1), (-1.0, member.bearing_2))
        supports = tuple(_support(side, one) for side, one in sides if one is not None)
        return GearBody(mass, polar, diametral, supports)

    def origin(self, field: str) -> Origin:
        """Return where the value of a dotted field, e.g. "pinion.body.mass_kg", is from."""
        return self._provenance(field)[0]

    def provenance(self, field: str) -> str:
        """Return the origin of a dotted field with its sentence, if it has one."""
        origin, sentence = self._provenance(field)
        return f"{origin}: {sentence}" if sentence else origin

    def _provenance(self, field: str) -> tuple[Origin, str]:
        tags: tuple[tuple[Origin, dict[str, str]], ...] = (
            ("completed", self.completed),
            ("inferred", self.inferred),
        )
        for origin, named in tags:
            for name, sentence in named.items():
                if field == name or field.startswith(f"{name}."):
                    return origin, sentence
        role, _, rest = field.partition(".")
        if role in ("pinion", "gear") and rest in _ABSENT:
            value: object = getattr(self, role)
            for part in rest.split("."):
                value = getattr(value, part)
            if value is None:
                return "completed", _ABSENT[rest]
        return "table", ""

    @property
    def _normal_module(self) -> float:
        cos = math.cos(self.pair.helix_angle_deg * DEGREE)
        modules = ((self.pair.normal_module_mm, 1.0), (self.pair.transverse_module_mm, cos))
        return next(m * factor * MILLIMETRE for m, factor in modules if m is not None)

    @property
    def _given_shifts(self) -> tuple[float | None, float | None]:
        return self.pinion.profile_shift_coefficient, self.gear.profile_shift_coefficient

    @property
    def _normal_pressure_angle(self) -> float:
        pair, cos = self.pair, math.cos(self.pair.helix_angle_deg * DEGREE)
        angles = ((pair.normal_pressure_angle_deg, 1.0), (pair.transverse_pressure_angle_deg, cos))
        return math.atan(
            next(math.tan(a * DEGREE) * factor for a, factor in angles if a is not None)
        )

    def _root_radius(self, role: Role) -> float:
        member: Member = getattr(self, role)
        module, x = self._normal_module, member.profile_shift_coefficient
        if member.root_diameter_mm is not None:
            return 0.5 * member.root_diameter_mm * MILLIMETRE
        if x is None:
            x = self._other_shift()
        if x is not None:
            reference = 0.5 * member.teeth / math.cos(self.pair.helix_angle_deg * DEGREE)
            return (reference + x - _DEDENDUM) * module
        return 0.5 * member.tip_diameter_mm * MILLIMETRE - (1.0 + _DEDENDUM) * module

    def _other_shift(self) -> float | None:
        """Return x of the gear without one [-], as the pair completes it; None where it cannot."""
        given = [x for x in self._given_shifts if x is not None]
        if not given:
            return None
        teeth = self.pinion.teeth + self.gear.teeth
        cos = math.cos(self.pair.helix_angle_deg * DEGREE)
        normal = self._normal_pressure_angle
        transverse = math.atan(math.tan(normal) / cos)
        base = 0.5 * teeth * self._normal_module / cos * math.cos(transverse)
        working = math.acos(min(base / (self.pair.centre_distance_mm * MILLIMETRE), 1.0))
        x = profile_shift_sum(teeth, normal, transverse, working) - given[0]
        return x if abs(x) <= LARGEST_SHIFT else None  # the pair refuses it, in clearer words


def _modification(flank: Flank) -> FlankModification:
    relief: TipRelief | PowerTipRelief | None = None
    if flank.tip_relief_um > 0.0 and flank.tip_relief_depth_mm is not None:
        amount, extent = flank.tip_relief_um * _MICROMETRE, flank.tip_relief_depth_mm * MILLIMETRE
        if flank.tip_relief_form == "power":
            beta = flank.tip_relief_exponent
            relief = PowerTipRelief(amount=amount, extent=extent, beta=beta)
        else:
            relief = TipRelief(amount=amount, extent=extent, k=flank.tip_relief_parabola)
    crown = None
    if flank.crown_um > 0.0:
        start = flank.crown_start_mm * MILLIMETRE
        crown = Crown(amount=flank.crown_um * _MICROMETRE, start=start)
    return FlankModification(
        tip_relief=relief,
        crown=crown,
        lead_slope=flank.lead_slope_um * _MICROMETRE,
        profile_slope=flank.profile_slope_um * _MICROMETRE,
        facets=flank.facets,
    )


def _support(side: float, bearing: Bearing) -> SupportStiffness:
    return SupportStiffness(
        position=side * bearing.distance_mm * MILLIMETRE,
        K_xx=bearing.stiffness_x_n_per_um / _MICROMETRE,
        K_yy=bearing.stiffness_y_n_per_um / _MICROMETRE,
        K_zz=bearing.stiffness_z_n_per_um / _MICROMETRE,
        K_theta_x=bearing.tilt_x_knm_per_rad * 1e3,
        K_theta_y=bearing.tilt_y_knm_per_rad * 1e3,
        K_x_theta_y=bearing.coupling_x_kn_per_rad * 1e3,
        K_y_theta_x=bearing.coupling_y_kn_per_rad * 1e3,
    )


def _in_millimetres(*metres: str) -> str:
    low, high, got = (f"{float(one) / MILLIMETRE:.4g}" for one in metres)
    return f"{low} to {high} mm, got {got} mm"
