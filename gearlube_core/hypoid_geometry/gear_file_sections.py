"""The sections of a hypoid gear file: every field's unit, meaning and range, stated once.

The reference page of the docs and the error messages come from these models.
"""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field, model_validator

from gearlube_core.errors import ParameterError
from gearlube_core.hypoid_geometry.blank.hypoid_blank import HypoidBlank, MemberBlank
from gearlube_core.hypoid_geometry.flank.correction import WORN_GRID, surface_degree
from gearlube_core.input_file.field_notes import Declared, Usual
from gearlube_core.input_file.input_file import Section

Millimetres = Annotated[float, Field(ge=-1000.0, le=1000.0, allow_inf_nan=False), Usual(0.0, 500.0)]
CutterSetting = Annotated[Millimetres, Usual(2.0, 500.0)]
Length = Annotated[float, Field(gt=0.0, le=2000.0, allow_inf_nan=False), Usual(5.0, 800.0)]
EdgeRadius = Annotated[float, Field(gt=0.0, le=1e6, allow_inf_nan=False), Usual(10.0, 100000.0)]
Angle = Annotated[float, Field(ge=-360.0, le=360.0, allow_inf_nan=False)]
ConeAngle = Annotated[float, Field(ge=1.0, le=89.0, allow_inf_nan=False), Usual(3.0, 88.0)]
SpiralAngle = Annotated[float, Field(ge=0.0, le=65.0, allow_inf_nan=False), Usual(3.0, 60.0)]
Slant = Annotated[float, Field(ge=-90.0, le=90.0, allow_inf_nan=False)]
TiltAngle = Annotated[float, Field(ge=0.0, le=80.0, allow_inf_nan=False), Usual(1.0, 45.0)]
ModifiedRoll = Annotated[float, Field(ge=-1.0, le=1.0, allow_inf_nan=False)]
HelicalMotion = Annotated[float, Field(ge=-50.0, le=50.0, allow_inf_nan=False), Usual(0.0, 30.0)]
RollRatio = Annotated[float, Field(ge=0.1, le=50.0, allow_inf_nan=False)]
Teeth = Annotated[int, Declared(MemberBlank, "teeth")]
PairOffset = Annotated[float, Declared(HypoidBlank, "offset_mm"), Usual(1.0, 150.0)]
Clearance = Annotated[float, Field(ge=0.0, le=20.0, allow_inf_nan=False), Usual(0.1, 8.0)]
BladeAngle = Annotated[float, Field(ge=1.0, le=45.0, allow_inf_nan=False), Usual(5.0, 40.0)]
Correction = Annotated[float, Field(ge=-5.0, le=5.0, allow_inf_nan=False), Usual(0.0, 3.0)]
Removal = Annotated[float, Field(ge=0.0, le=500.0, allow_inf_nan=False), Usual(1.0, 200.0)]
Crown = Annotated[float, Field(ge=-500.0, le=500.0, allow_inf_nan=False), Usual(0.5, 200.0)]
# terms of a polynomial may be as small as they come
Coefficients = Annotated[tuple[Annotated[Crown, Usual(0.0, 200.0)], ...], Field(strict=False)]
Depths = Annotated[tuple[Annotated[Removal, Usual(0.0, 200.0)], ...], Field(strict=False)]
Extent = Annotated[float, Field(gt=0.0, le=200.0, allow_inf_nan=False), Usual(0.1, 60.0)]
Rounding = Annotated[float, Field(ge=0.0, le=2.0, allow_inf_nan=False), Usual(0.02, 1.5)]

RELIEFS = (  # amount and extent of the relief of each edge
    ("tip_relief_um", "tip_relief_depth_mm"),
    ("root_relief_um", "root_relief_depth_mm"),
    ("toe_relief_um", "toe_relief_length_mm"),
    ("heel_relief_um", "heel_relief_length_mm"),
)
_UNIFORM = (
    "teeth are equally deep from toe to heel, so pitch, face and root cones are parallel; tapered "
    "depth is not modelled. Leave it out: the depth at mid-face counts for the whole tooth"
)
UNMODELLED = {  # words in fields that neither gear files nor blank files have, and the cure
    "duplex": "both flanks of the pinion are cut in one set-up; duplex taper is not modelled. "
    "Leave it out, and for duplex helical give the pinion's machine helical motion",
    "completing": "both flanks of the pinion are always cut in one set-up (completing). Leave it "
    "out; set-ups of their own for convex and concave flanks are not modelled",
    "taper": _UNIFORM,
    "dedendum_angle": _UNIFORM,
    "addendum_angle": _UNIFORM,
    "face_angle": _UNIFORM,
    ".root_angle": _UNIFORM,
    "shaft_angle": "the axes stand at 90 deg; other angles are not modelled. Leave it out",
    "hand": 'the hand is pair.pinion_hand, "left" or "right"',
    "thickness": "teeth and slots are equally wide at the middle of the working depth: no field",
}
_LEAST_RELIEF, _MOST_RELIEF = 0.5, 500.0  # um
_STEEPEST = 0.1  # amount over extent: the removal stays along the normal


class Cutter(Section):
    """Blades of one member's cutter head; angles are named after the flank that they cut."""

    point_radius_mm: Length = Field(
        description="Radius of both blade edges at the reference plane, the mid-working-depth plane"
    )
    convex_flank_blade_angle_deg: BladeAngle = Field(
        description="Blade angle that cuts the convex flank (inside blades)"
    )
    concave_flank_blade_angle_deg: BladeAngle = Field(
        description="Blade angle that cuts the concave flank (outside blades)"
    )
    convex_flank_angle_correction_deg: Correction = Field(
        0.0, description="Added to the blade angle of the convex flank"
    )
    concave_flank_angle_correction_deg: Correction = Field(
        0.0, description="Added to the blade angle of the concave flank"
    )
    blade_groups: int = Field(
        ge=0,
        le=60,
        description="Blade groups of the cutter head; the work turns by one tooth per group (face "
        "hobbing). 0: the work does not turn, single indexing (face milling)",
    )
    blade_edge_radius_mm: EdgeRadius | None = Field(
        None,
        description="Radius of a curved blade edge, hollow, so that the flank is crowned along its "
        "profile; left out: straight",
    )
    convex_flank_edge_radius_mm: EdgeRadius | None = Field(
        None,
        description="Radius of the edge of the blades that cut the convex flank; left out: "
        "blade_edge_radius_mm",
    )
    concave_flank_edge_radius_mm: EdgeRadius | None = Field(
        None,
        description="Radius of the edge of the blades that cut the concave flank; left out: "
        "blade_edge_radius_mm",
    )
    blade_offset_angle_deg: Slant | None = Field(
        None,
        description="Angle from the cutter radius to the blade face, about the cutter axis; "
        "left out: the blade face is normal to the cutting velocity at the reference point",
    )

    def edge_radius_mm(self, curve: Literal["convex", "concave"]) -> float | None:
        """Return the edge radius [mm] of the blades that cut a flank; None: straight."""
        own = (
            self.convex_flank_edge_radius_mm
            if curve == "convex"
            else self.concave_flank_edge_radius_mm
        )
        return self.blade_edge_radius_mm if own is None else own


class GearMachine(Section):
    """Machine settings of a gear, form-cut or generated without tilt."""

    machine_root_angle_deg: ConeAngle = Field(
        description="Angle from the gear axis to the reference plane of the cutter"
    )
    machine_center_to_back_mm: Millimetres = Field(
        description="Distance from the crossing point to the apex of the reference plane (the "
        "machine centre), along the gear axis; positive beyond the crossing point"
    )
    horizontal_setting_mm: CutterSetting = Field(
        description="Distance of the cutter centre from the machine centre along the root line; "
        "positive towards the heel"
    )
    vertical_setting_mm: CutterSetting = Field(
        description="Distance of the cutter centre from the machine centre, parallel to the "
        "offset; positive on the side of the pinion axis"
    )
    ratio_of_roll: RollRatio | None = Field(
        None,
        description="Rotation of the gear per rotation of the cradle, about the cutter's direction "
        "through the machine centre; left out: form-cut (Formate)",
    )
    sliding_base_mm: Millimetres = Field(
        0.0,
        description="Distance from the machine centre to the reference plane, along the cutter "
        "axis; positive away from the blade tips; the machine centre then is where the cradle "
        "axis meets the gear axis",
    )


class GeneratorMachine(Section):
    """Machine settings of a pinion generated with cutter tilt.

    The cradle stands in for the gear: with all crowning taken away, its axis is the gear axis.
    """

    machine_root_angle_deg: Slant = Field(
        description="Angle of the pinion axis to the plane normal to the cradle axis; positive "
        "if the pinion leans to the side of the blade tips"
    )
    machine_center_to_back_mm: Millimetres = Field(
        description="Shift of the pinion along its axis; positive away from the crossing point: "
        "the pinion is cut farther out than it runs by this distance"
    )
    sliding_base_mm: Millimetres = Field(
        description="Distance from the pinion axis to the machine plane, which holds the cutter "
        "centre, along the cradle axis; positive if the pinion axis is on the side of the blade "
        "tips"
    )
    blank_offset_mm: Millimetres = Field(
        description="Distance of the pinion axis from the cradle axis; sign as the pair's offset"
    )
    radial_setting_mm: Length = Field(
        description="Distance of the cutter centre from the cradle axis"
    )
    basic_cradle_angle_deg: Angle = Field(
        description="q: angle of the cutter centre about the cradle axis, from the direction of "
        "the pinion axis towards that of the offset; it only sets a phase"
    )
    basic_swivel_angle_deg: Angle = Field(
        description="j: the cutter axis leans to the azimuth q - j - 90 deg"
    )
    tilt_angle_deg: TiltAngle = Field(
        description="i: angle between the cutter axis and the cradle axis"
    )
    ratio_of_roll: RollRatio = Field(description="Rotation of the work per rotation of the cradle")
    modified_roll_2c: ModifiedRoll = Field(
        0.0,
        description="2C [1/rad]: at the cradle angle f from its basic position the work has turned "
        "by the ratio of roll times f - 2C f^2/2 - 6D f^3/6",
    )
    modified_roll_6d: ModifiedRoll = Field(
        0.0, description="6D [1/rad^2]: the next coefficient of modified roll"
    )
    helical_motion_mm_per_rad: HelicalMotion = Field(
        0.0, description="Increase of the sliding base per cradle angle (helical motion)"
    )


class FlankRelief(Section):
    """Material taken off one flank as it is cut, along its normal."""

    tip_relief_um: Removal = Field(0.0, description="Material removed at the tip edge; 0: none")
    tip_relief_depth_mm: Extent | None = Field(
        None,
        description="Tooth height, from the tip, over which tip relief falls to 0 as a parabola",
    )
    root_relief_um: Removal = Field(0.0, description="Material removed at the root line; 0: none")
    root_relief_depth_mm: Extent | None = Field(
        None, description="Tooth height, from the root line, over which root relief falls to 0"
    )
    toe_relief_um: Removal = Field(0.0, description="Material removed at the toe; 0: none")
    toe_relief_length_mm: Extent | None = Field(
        None,
        description="Length along the pitch cone, from the toe, over which toe relief falls to 0",
    )
    heel_relief_um: Removal = Field(0.0, description="Material removed at the heel; 0: none")
    heel_relief_length_mm: Extent | None = Field(
        None,
        description="Length along the pitch cone, from the heel, over which heel relief falls to 0",
    )
    tip_edge_radius_mm: Rounding = Field(
        0.0,
        description="Radius of the tip edge; 0: sharp. Half of this radius is removed at the edge",
    )
    end_edge_radius_mm: Rounding = Field(
        0.0, description="Radius of the edges at toe and heel; 0: sharp"
    )
    profile_crown_um: Crown = Field(
        0.0,
        description="Profile crown, a parabola over the tooth height: material removed at tip "
        "and root",
    )
    lead_crown_um: Crown = Field(
        0.0,
        description="Lead crown, a parabola over the face width: material removed at toe and heel",
    )
    twist_um: Crown = Field(
        0.0,
        description="Twist: material removed at the tip of the heel and at the root of the toe; "
        "the same amount is added at the other two corners; zero along the middle lines",
    )
    surface_um: Coefficients = Field(
        (),
        description="Smooth removal over the whole flank, a_ij x^i y^j, of either sign, in the "
        "order 1, x, y, x^2, x y, y^2, ...: x -1 at the root line to 1 at the tip, y -1 at the toe "
        "to 1 at the heel. Written by `gearlube measured`; 1, 3, 6, 10, 15 or 21 numbers, each "
        "-500 to 500 um",
    )
    worn_um: Depths = Field(
        (),
        description="Wear, as coefficients of 16 x 32 cubic B-splines: from the root line to the "
        "tip, in each row from toe to heel. Written by `gearlube damage`; none or 512 numbers, "
        "each 0 to 500 um",
    )

    @model_validator(mode="after")
    def _check_reliefs(self) -> FlankRelief:
        if self.surface_um:
            try:
                surface_degree(len(self.surface_um))
            except ParameterError as reason:
                raise ValueError(str(reason).replace("surface must", "surface_um must")) from None
        if len(self.worn_um) not in (0, WORN_GRID[0] * WORN_GRID[1]):
            raise ValueError(
                f"worn_um must hold none or {WORN_GRID[0] * WORN_GRID[1]} numbers, got "
                f"{len(self.worn_um)}. Take those of the worn gear file that `gearlube damage` "
                "writes"
            )
        for name in type(self).model_fields:
            if name in ("surface_um", "worn_um"):
                continue
            amount = abs(getattr(self, name) or 0.0)
            if name.endswith("_um") and 0.0 < amount < _LEAST_RELIEF:
                raise ValueError(
                    f"{name} must be 0 or {_LEAST_RELIEF:g} to {_MOST_RELIEF:g} um, got {amount:g} "
                    f"um. Is it in mm? {amount:g} mm is {1e3 * amount:g} um"
                )
        for name, extent in RELIEFS:
            amount, reach = getattr(self, name), getattr(self, extent)
            if amount > 0.0 and reach is None:
                raise ValueError(f"{extent} is missing; it must be above 0 mm where {name} is")
            if reach is not None and amount > _STEEPEST * 1e3 * reach:
                raise ValueError(
                    f"{name} must be at most {100.0 * _STEEPEST:g} % of {extent}, "
                    f"{_STEEPEST * 1e3 * reach:g} um, got {amount:g} um. Make the relief longer; "
                    "an edge radius makes a steep edge"
                )
        return self


class Member(Section):
    """Blank of one member; apexes count positive beyond the crossing point of the axes."""

    teeth: Teeth = Field(description="Number of teeth")
    face_width_mm: Length = Field(description="Face width along the pitch cone")
    outer_cone_distance_mm: Length = Field(
        description="Distance from the pitch apex to the heel, along the pitch cone"
    )
    pitch_angle_deg: ConeAngle = Field(
        description="Half angle of the pitch cone; face and root cone have the same (uniform depth)"
    )
    spiral_angle_deg: SpiralAngle = Field(description="Mean spiral angle, without sign")
    pitch_apex_mm: Millimetres = Field(
        description="Position of the apex of the pitch cone; positive beyond the crossing point"
    )
    face_apex_mm: Millimetres = Field(
        description="Position of the apex of the face cone; positive beyond the crossing point"
    )
    cutter: Cutter
    drive_flank: FlankRelief | None = None
    coast_flank: FlankRelief | None = None


class Pinion(Member):
    """Blank, cutter and machine of the pinion."""

    machine: GeneratorMachine


class Gear(Member):
    """Blank, cutter and machine of the gear."""

    machine: GearMachine


class Pair(Section):
    """How the members stand to each other; axes at 90 degrees."""

    offset_mm: PairOffset = Field(description="Distance between the axes (pinion offset)")
    pinion_hand: Literal["right", "left"] = Field(
        default="right",
        description="Hand of the pinion's teeth; left: the real pair is the mirror image of the "
        "computed one, in exported files and measured points",
    )
    clearance_mm: Clearance | None = Field(
        None,
        description="Gap between the tip of one member and the root of the other; left out: an "
        "eighth of the working depth",
    )
