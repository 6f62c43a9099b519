"""The blank file: the few numbers from which a hypoid or bevel pair is designed."""

from __future__ import annotations

import string
from collections.abc import Mapping
from typing import Annotated, ClassVar, Literal

from pydantic import Field, model_validator

from gearlube_core.hypoid_geometry.gear_file_sections import UNMODELLED, PairOffset, SpiralAngle
from gearlube_core.input_file.field_notes import Usual, field_notes
from gearlube_core.input_file.input_file import InputFile, InputNote, Section
from gearlube_core.storage.file_names import Name

Length = Annotated[float, Field(gt=0.0, le=2000.0, allow_inf_nan=False), Usual(5.0, 1000.0)]
PressureAngle = Annotated[float, Field(ge=10.0, le=30.0, allow_inf_nan=False), Usual(12.0, 28.0)]
CutterRadius = Annotated[float, Field(gt=0.0, le=900.0, allow_inf_nan=False), Usual(5.0, 600.0)]
Depth = Annotated[float, Field(ge=1.0, le=3.0, allow_inf_nan=False)]
Share = Annotated[float, Field(ge=0.0, le=1.0, allow_inf_nan=False)]
Error = Annotated[float, Field(ge=5.0, le=1000.0, allow_inf_nan=False)]
PathAngle = Annotated[float, Field(ge=1.0, le=179.0, allow_inf_nan=False), Usual(5.0, 175.0)]
Place = Annotated[float, Field(ge=0.2, le=0.8, allow_inf_nan=False)]
EllipseLength = Annotated[float, Field(gt=0.0, le=500.0, allow_inf_nan=False), Usual(2.0, 100.0)]
Removal = Annotated[float, Field(ge=0.0, le=200.0, allow_inf_nan=False), Usual(1.0, 150.0)]
Torque = Annotated[float, Field(gt=0.0, le=1e5, allow_inf_nan=False), Usual(1.0, 20000.0)]
Clearance = Annotated[float, Field(gt=0.0, le=0.5, allow_inf_nan=False)]
Text = Annotated[str, Field(min_length=1)]
Method = Annotated[int, Field(ge=0, le=3)]

# what each method of the standard starts from
_NEEDS = {
    0: ("outer_pitch_diameter_mm", "gear_spiral_angle_deg"),
    1: ("outer_pitch_diameter_mm", "pinion_spiral_angle_deg"),
    2: ("mean_pitch_diameter_mm", "gear_spiral_angle_deg"),
    3: ("outer_pitch_diameter_mm", "gear_spiral_angle_deg"),
}
_CHOICES = tuple(dict.fromkeys(name for names in _NEEDS.values() for name in names))
_NAME = frozenset(string.ascii_letters + string.digits + "_+-. ")
_USUAL = "usual for spiral bevel and hypoid gears"
_OWN = "this package's choice"


class BlankPair(Section):
    """Teeth, offset and size; axes at 90 degrees."""

    pinion_teeth: int = Field(ge=3, le=100, description="Number of teeth of the pinion")
    gear_teeth: int = Field(ge=3, le=400, description="Number of teeth of the gear")
    offset_mm: PairOffset = Field(
        description="Distance between the axes (pinion offset), without a sign: pinion_hand "
        "gives its side; 0: bevel gears"
    )
    pinion_hand: Literal["right", "left"] = Field(
        default="right",
        description="Hand of the pinion's teeth; left: the mirror image, with the offset on the "
        "other side",
    )
    face_width_mm: Length = Field(description="Face width of the gear along its pitch cone")
    outer_pitch_diameter_mm: Length | None = Field(
        default=None, description="Outer diameter of the gear, at the heel; methods 0, 1 and 3"
    )
    mean_pitch_diameter_mm: Length | None = Field(
        default=None, description="Mean diameter of the gear, at mid-face; method 2"
    )
    pinion_spiral_angle_deg: SpiralAngle | None = Field(
        default=None, description="Mean spiral angle of the pinion; method 1"
    )
    gear_spiral_angle_deg: SpiralAngle | None = Field(
        default=None, description="Mean spiral angle of the gear; methods 0, 2 and 3"
    )


class BlankCutter(Section):
    """The cutter head and the inclination of both flanks."""

    radius_mm: CutterRadius = Field(description="Cutter radius")
    blade_groups: int = Field(
        ge=0,
        le=50,
        description="Blade groups of the cutter head (face hobbing). 0: single indexing (face "
        "milling)",
    )
    drive_pressure_angle_deg: PressureAngle = Field(
        default=20.0,
        description="Effective pressure angle of the drive flanks, measured from the limit angle",
    )
    coast_pressure_angle_deg: PressureAngle = Field(
        default=20.0,
        description="Effective pressure angle of the coast flanks, measured from the limit angle",
    )


class BlankDepth(Section):
    """Tooth depth in mean normal modules; the same from toe to heel."""

    depth_factor: Depth = Field(
        default=2.0, description="k_d: working depth divided by the mean normal module"
    )
    clearance_factor: Clearance = Field(
        default=0.125, description="k_c: bottom clearance divided by the working depth"
    )
    gear_addendum_factor: Share | None = Field(
        default=None,
        description="c_ham: addendum of the gear divided by the working depth; left out: 0.21 + "
        "0.29 (pinion teeth / gear teeth)^2",
    )


class WantedContact(Section):
    """Contact without load that the pinion is cut for, on the gear flank."""

    drive_error_urad: Error = Field(
        default=50.0,
        description="Transmission error of the drive flanks, peak to peak at the pinion",
    )
    coast_error_urad: Error = Field(
        default=80.0,
        description="Transmission error of the coast flanks, peak to peak at the pinion",
    )
    ellipse_length_mm: EllipseLength | None = Field(
        default=None,
        description="Length of the contact ellipse at a gap of 6.35 um, both sides; left out: a "
        "third of the face width",
    )
    profile_position: Place | None = Field(
        default=None,
        description="Mean position of the contact over the tooth height; 0: root, 1: tip; left "
        "out: the middle of the working depth",
    )
    face_position: Place = Field(
        default=0.5, description="Mean position of the contact over the face width; 0: toe, 1: heel"
    )
    drive_path_angle_deg: PathAngle | None = Field(
        default=None,
        description="Direction of the path of contact on the drive flank, from the root line "
        "(towards the heel) and positive towards the tip; left out: 44 deg from the normal of "
        "the lines of contact, or 30 or 15 if that fails",
    )
    coast_path_angle_deg: PathAngle | None = Field(
        default=None,
        description="Direction of the path of contact on the coast flank, in the same way",
    )


class BlankRelief(Section):
    """Relief of the designed flanks; sharp edges would carry from small torques on."""

    torque_n_m: Torque | None = Field(
        default=None,
        description="Pinion torque up to which no edge carries, for reliefs that are chosen; "
        "absent: a gear torque of 0.2 N/mm2 times the cube of the gear's outer diameter",
    )
    tip_relief_um: Removal | None = Field(
        default=None,
        description="Material removed at the tips of pinion and gear, on both flanks; 0: none; "
        "absent: chosen for torque_n_m, 20 or more",
    )
    tip_relief_share: Share = Field(
        default=0.25, description="Share of the tooth height over which tip relief falls to 0"
    )
    end_relief_um: Removal | None = Field(
        default=None,
        description="Material removed at toe and heel of the pinion, on both flanks; 0: none; "
        "absent: chosen for torque_n_m, 30 or more",
    )
    end_relief_share: Share = Field(
        default=0.15,
        description="Share of the gear's face width over which each end relief falls to 0; the "
        "part of the pinion beyond the gear's end is added",
    )


class BlankMachine(Section):
    """Abilities of machines and blades."""

    gear: Literal["form-cut", "generated"] = Field(
        default="form-cut",
        description="form-cut: the gear's slots are plunged (Formate); generated: its teeth are "
        "generated by a rolling cradle",
    )
    curved_blades: bool = Field(
        default=True,
        description="Whether the pinion's blades may have hollow edges, with a radius of its "
        "own for each flank",
    )
    modified_roll: bool = Field(
        default=False,
        description="Whether the pinion's ratio of roll may change with the cradle angle (2C, 6D)",
    )
    helical_motion: bool = Field(
        default=False,
        description="Whether the pinion's sliding base may change with the cradle angle",
    )

    @property
    def denied(self) -> str:
        """The freedoms that are not allowed, as a sentence names them; empty when all are."""
        names = ("curved_blades", "modified_roll", "helical_motion")
        return " or ".join(f"machine.{name}" for name in names if not getattr(self, name))


class BlankFile(InputFile):
    """Blank file of a hypoid or bevel pair to be designed: teeth, offset, size, spiral, cutter.

    References
    ----------
    [iso_23509 6] (methods 0 to 3), [iso_23509 annex C] (depth factors).

    Examples
    --------
    >>> BlankFile.named("hypoid_13_42").design_method
    1
    """

    package: ClassVar[str] = "gearlube_core.hypoid_design"
    title: ClassVar[str] = "blank file"
    unmodelled: ClassVar[Mapping[str, str]] = UNMODELLED

    name: Name = Field(description="Name of the pair in reports and in the designed gear file")
    method: Method | None = Field(
        None,
        description="Method of ISO 23509 for the pitch cones; left out: the method to which the "
        "given diameter and spiral angle belong",
    )
    pair: BlankPair
    cutter: BlankCutter
    depth: BlankDepth = BlankDepth()
    contact: WantedContact = WantedContact()
    machine: BlankMachine = BlankMachine()
    relief: BlankRelief = BlankRelief()

    @model_validator(mode="after")
    def _check_relations(self) -> BlankFile:
        """Check relations between fields."""
        pair, method = self.pair, self.design_method
        if not set(self.name) <= _NAME or self.name.startswith((".", " ")):
            raise ValueError(
                "name must be letters, digits, blanks and _ + - . because files are named after "
                f"it, and begin with no dot or blank, got {self.name!r}"
            )
        if pair.gear_teeth < pair.pinion_teeth:
            raise ValueError(
                f"pair.gear_teeth must be at least pair.pinion_teeth, {pair.pinion_teeth}, got "
                f"{pair.gear_teeth}. Swap them"
            )
        if (method == 0) != (pair.offset_mm == 0.0):
            raise ValueError(
                "method 0 is for bevel gears, pair.offset_mm = 0, and methods 1 to 3 for hypoid "
                f"gears, got method {method} and pair.offset_mm {pair.offset_mm:g} mm. Leave "
                "method out, or change the offset"
            )
        given = [name for name in _CHOICES if getattr(pair, name) is not None]
        if sorted(given) != sorted(_NEEDS[method]):
            raise ValueError(
                f"method {method} needs {_listed(_NEEDS[method])} and no other diameter or spiral "
                f"angle, got {_listed(given) or 'none of them'}. The others follow from the cones"
            )
        length = self.contact.ellipse_length_mm
        if length is not None and not length <= 2.0 * pair.face_width_mm:
            raise ValueError(
                "contact.ellipse_length_mm must be at most twice pair.face_width_mm, "
                f"{2.0 * pair.face_width_mm:g} mm, got {length:g} mm"
            )
        size = pair.outer_pitch_diameter_mm or pair.mean_pitch_diameter_mm or 0.0
        if not 2.0 * pair.offset_mm < size:
            raise ValueError(
                f"pair.offset_mm must be below half the gear's diameter, {0.5 * size:g} mm, got "
                f"{pair.offset_mm:g} mm. Reduce it; or is the diameter in another unit? {size:g} m "
                f"is {1e3 * size:g} mm, {size:g} in is {25.4 * size:g} mm"
            )
        return self

    @property
    def design_method(self) -> int:
        """Method of the standard, 0 to 3: as given, else from the fields that are given."""
        if self.method is not None:
            return self.method
        if self.pair.offset_mm == 0.0:
            return 0
        if self.pair.mean_pitch_diameter_mm is not None:
            return 2
        return 1 if self.pair.pinion_spiral_angle_deg is not None else 3

    @property
    def gear_addendum_factor(self) -> float:
        """c_ham [-]: as given, else chosen."""
        given = self.depth.gear_addendum_factor
        ratio = self.pair.pinion_teeth / self.pair.gear_teeth
        return 0.21 + 0.29 * ratio**2 if given is None else given

    def inputs(self) -> list[InputNote]:
        """Return every number of the file: given, or chosen because the file is silent."""
        chosen = {
            "method": (self.design_method, "the diameter and the spiral angle belong to it"),
            "depth.gear_addendum_factor": (
                self.gear_addendum_factor,
                "0.21 + 0.29 (pinion teeth / gear teeth)^2",
            ),
        }
        found = []
        for name, note in field_notes(BlankFile).items():
            *sections, key = name.split(".")
            place = getattr(self, sections[0]) if sections else self
            value = getattr(place, key)
            if key in place.model_fields_set and value is not None:
                found.append(InputNote(name, value, note.unit, "given", ""))
            elif name == "pair.pinion_hand":
                found.append(InputNote(name, value, "", "assumed", "left is its mirror image"))
            elif name in chosen:
                found.append(InputNote(name, chosen[name][0], "", "assumed", chosen[name][1]))
            elif value is not None:
                usual = _OWN if name.startswith(("contact.", "machine.", "relief.")) else _USUAL
                found.append(InputNote(name, value, note.unit, "assumed", usual))
        return found


def _listed(names: tuple[str, ...] | list[str]) -> str:
    return " and ".join(f"pair.{name}" for name in names)
