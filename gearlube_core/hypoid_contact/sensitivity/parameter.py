"""What tooth contact is differentiated by: a field of the gear file or a misalignment."""

from __future__ import annotations

from dataclasses import dataclass, fields, replace
from typing import Literal

from gearlube_core.errors import ParameterError
from gearlube_core.hypoid_contact.pair import FlankPair
from gearlube_core.hypoid_contact.placement import Misalignment
from gearlube_core.hypoid_geometry.flank.flank import Flank, Role
from gearlube_core.hypoid_geometry.flank.machine_frames import reference_point
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from gearlube_core.input_file.field_notes import field_notes
from gearlube_core.units import DEGREE, MILLIMETRE

MISALIGNMENT = "misalignment"
Unit = Literal["mm", "um", "deg", "1", "m", "rad"]

# differences are taken over twice the step: cutting it or doubling it changes derivatives by 1e-7
_STEPS: dict[Unit, float] = {"mm": 1e-3, "um": 0.1, "deg": 1e-3, "1": 1e-5, "m": 1e-6, "rad": 1e-5}
_EDGE_STEP = 2e-4  # of the radius of a blade edge
_ROLES: tuple[Role, Role] = ("pinion", "gear")


@dataclass(frozen=True, slots=True)
class Parameter:
    """A number that decides the flanks or where the members stand.

    Parameters
    ----------
    name : str
        Dotted field of the gear file, e.g. "pinion.machine.radial_setting_mm", or
        "misalignment." and a field of `Misalignment`.
    unit : str
        Of the number: "mm", "um", "deg" or "1" in the gear file, "m" or "rad" of a misalignment.
    value : float
        [unit].
    step : float
        Of the differences of the motions [unit].
    """

    name: str
    unit: Unit
    value: float
    step: float

    @classmethod
    def named(cls, name: str, file: HypoidGearFile, misalignment: Misalignment) -> Parameter:
        """Return the parameter of a name with its value.

        Raises
        ------
        ParameterError
            When there is no such number, it is a count, or the file leaves it open.
        """
        section, _, key = name.partition(".")
        if section == MISALIGNMENT:
            known = [field.name for field in fields(Misalignment)]
            if key not in known:
                raise ParameterError(
                    f"A misalignment must be one of {', '.join(known)}, got {key!r}."
                )
            unit: Unit = "rad" if key == "shaft_angle" else "m"
            return cls(name, unit, float(getattr(misalignment, key)), _STEPS[unit])
        if name not in field_notes(HypoidGearFile):
            raise ParameterError(
                f"A parameter must be a number of the gear file, as "
                f"pinion.machine.radial_setting_mm, or {MISALIGNMENT}. and a displacement, got "
                f"{name!r}. docs/gear_file.md lists the fields."
            )
        value: object = file
        for part in name.split("."):
            value = getattr(value, part, None)
        if value is None:
            raise ParameterError(
                f"{name} must have a value to be changed, and this file leaves it open. Give it."
            )
        if not isinstance(value, float):
            raise ParameterError(
                f"{name} must be a length, an angle or a ratio, got {value!r}: there is no "
                "derivative by counts and words."
            )
        endings: tuple[Unit, ...] = ("mm", "um", "deg")
        unit = next((one for one in endings if name.endswith(f"_{one}")), "1")
        blade = ".cutter." in name and name.endswith("edge_radius_mm")
        step = _EDGE_STEP * value if blade else _STEPS[unit]
        return cls(name, unit, value, step)

    @property
    def scale(self) -> float:
        """SI units in one unit of the parameter: m, rad or 1 [-]."""
        return {"mm": MILLIMETRE, "um": 1e-3 * MILLIMETRE, "deg": DEGREE}.get(self.unit, 1.0)

    @property
    def moves(self) -> tuple[Role, ...]:
        """Members whose flanks change with the parameter."""
        section, _, rest = self.name.partition(".")
        if section == MISALIGNMENT:
            return ()
        if rest.startswith(("machine.", "cutter.")):
            return ("pinion",) if section == "pinion" else ("gear",)
        return _ROLES  # the blank: mean point and region of both

    def changed(self, file: HypoidGearFile, pair: FlankPair, change: float) -> FlankPair:
        """Return the pair with the parameter changed by `change` [unit].

        The flanks can be evaluated at cutting parameters; they have no starts for searches.

        Parameters
        ----------
        file : HypoidGearFile
            Of `pair`.
        pair : FlankPair
            As it stands.
        change : float
        """
        key = self.name.partition(".")[2]
        if self.name.startswith(f"{MISALIGNMENT}."):
            value = self.value + change
            return pair.misaligned(replace(pair.misalignment, **{key: value}))
        moved = file.varied({self.name: self.value + change})
        flanks = {"pinion": pair.pinion, "gear": pair.gear}
        for role in self.moves:
            flanks[role] = Flank.as_cut(moved, role, pair.side)
        mean = reference_point(moved.blank()) if len(self.moves) == 2 else pair.mean_point
        return FlankPair(flanks["pinion"], flanks["gear"], pair.misalignment, mean)

    def about(self, file: HypoidGearFile, pair: FlankPair) -> tuple[FlankPair, FlankPair]:
        """Return the pair with the parameter one step below and one above its value."""
        return self.changed(file, pair, -self.step), self.changed(file, pair, self.step)


def usual_parameters(file: HypoidGearFile) -> tuple[str, ...]:
    """Return the names of the misalignments and of all settings of machines and cutters.

    Left out: fields without value, corrections of blade angles (as the blade angles) and the
    basic cradle angle (only a phase).
    """
    found = [f"{MISALIGNMENT}.{field.name}" for field in fields(Misalignment)]
    for role in _ROLES:
        member = getattr(file, role)
        for section in ("machine", "cutter"):
            values = getattr(member, section)
            for key in type(values).model_fields:
                if key.endswith("_angle_correction_deg") or key == "basic_cradle_angle_deg":
                    continue
                if isinstance(getattr(values, key), float):
                    found.append(f"{role}.{section}.{key}")
    return tuple(found)
