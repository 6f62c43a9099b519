"""The blank file: the few numbers from which a hypoid or bevel pair is designed."""

from __future__ import annotations

import string
from collections.abc import Mapping
from typing import Annotated, ClassVar

from pydantic import Field, model_validator

from gearlube_core.hypoid_design.blank_sections import (
    BlankCutter,
    BlankDepth,
    BlankMachine,
    BlankPair,
    BlankRelief,
    WantedContact,
)
from gearlube_core.hypoid_geometry.gear_file_sections import UNMODELLED
from gearlube_core.input_file.field_notes import field_notes
from gearlube_core.input_file.input_file import InputFile, InputNote
from gearlube_core.storage.file_names import Name

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
