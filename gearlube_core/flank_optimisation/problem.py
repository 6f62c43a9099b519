"""An optimisation as data: gear file, parameters with bounds, loads, errors, limits."""

from __future__ import annotations

import logging
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from os.path import isfile
from typing import Any, NamedTuple

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.errors import ParameterError
from gearlube_core.flank_optimisation.problem_file import Errors, OptimisationFile, Range, Settings
from gearlube_core.helical_geometry.gear_file import HelicalGearFile
from gearlube_core.hypoid_contact.placement import ALIGNED, Misalignment
from gearlube_core.hypoid_geometry.flank.flank import CURVES, Side
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from gearlube_core.hypoid_geometry.gear_file_sections import FlankRelief
from gearlube_core.input_file.field_notes import field_notes, likely_fields
from gearlube_core.input_file.field_units import field_unit
from gearlube_core.input_file.input_file import read_toml

logger = logging.getLogger(__name__)

GearFile = HypoidGearFile | HelicalGearFile
_MISALIGNMENTS = {
    "pinion_offset_um": ("pinion_offset", 1e-6),
    "pinion_axial_um": ("pinion_axial", 1e-6),
    "gear_axial_um": ("gear_axial", 1e-6),
    "shaft_angle_mrad": ("shaft_angle", 1e-3),
}
_SLOPES = {
    "lead_slope_um": "gear.flank.lead_slope_um",
    "profile_slope_um": "gear.flank.profile_slope_um",
}
_STEPS = {"um": 1e-2, "mm": 1e-3, "deg": 1e-3, "mm/rad": 1e-3}
_RATIO_STEP = 1e-5
# phases, what doubles a blade angle, and motions that not every machine has
_NOT_FREE = (
    "basic_cradle_angle_deg",
    "convex_flank_angle_correction_deg",
    "concave_flank_angle_correction_deg",
    "modified_roll_2c",
    "modified_roll_6d",
    "helical_motion_mm_per_rad",
)
_LEAST = 0.5  # um, smallest amount of a hypoid gear file
DIGITS = 5  # of a value in its unit, as the better gear file gives it


@dataclass(frozen=True, slots=True)
class Scenario:
    """One error of assembly or making.

    Parameters
    ----------
    name : str
        "none" for the pair as drawn.
    misalignment : Misalignment
        Of a hypoid pair.
    added : dict of str to float
        What is added to fields of the gear file [unit of each].
    """

    name: str
    misalignment: Misalignment = ALIGNED
    added: dict[str, float] = field(default_factory=dict)


class Load(NamedTuple):
    """A torque of the pinion [N.m] and the flanks that carry it."""

    torque: float
    side: Side


@dataclass(frozen=True)
class Problem:
    """A gear pair, what may change of it and by what it is judged.

    Parameters
    ----------
    given : OptimisationFile
    file : HypoidGearFile or HelicalGearFile
        The pair as it is.
    names : tuple of str
        P fields that may change.
    low, high, start : ndarray of shape (P,)
        Bounds and start [unit of each].
    scenarios : tuple of Scenario
        The first is without errors.
    """

    given: OptimisationFile
    file: GearFile
    names: tuple[str, ...]
    low: Array
    high: Array
    start: Array
    scenarios: tuple[Scenario, ...]

    @classmethod
    def of(cls, given: OptimisationFile) -> Problem:
        """Return the problem of a file; its gear file is read.

        Raises
        ------
        ParameterError
            The gear file is wrong, a parameter or an error is none of its pair, or bounds leave
            the range of a field.
        """
        file = read_gear_file(given.gear)
        if given.limits.force_swing is not None and isinstance(file, HelicalGearFile):
            raise ParameterError(
                f"limits.force_swing is only for a hypoid pair, got {file.name}, a helical one, "
                "whose force has a constant arm. Leave it out."
            )
        if given.limits.other_side_torques_n_m and isinstance(file, HelicalGearFile):
            raise ParameterError(
                f"limits.other_side_torques_n_m is only for a hypoid pair, got {file.name}, a "
                "helical one, whose two flanks are equal. Leave it out."
            )
        allowed = {**_free_settings(file, given), **given.parameters}
        names = tuple(allowed)
        for name in names:
            _check_parameter(file, name, given)
        for name, one in given.parameters.items():
            if warning := field_notes(type(file))[name].warning(max(abs(one.low), abs(one.high))):
                logger.warning("[parameters]: %s", warning)
        ranges = list(allowed.values())
        values = [_start(file, name, one) for name, one in allowed.items()]
        problem = cls(
            given,
            file,
            names,
            np.array([one.low for one in ranges]),
            np.array([one.high for one in ranges]),
            np.array(values),
            (Scenario("none"), *_scenarios(file, given.errors)),
        )
        steep = np.array([name.endswith("_um") for name in names])  # much relief over little
        corners = (problem.low, problem.high, np.where(steep, problem.high, problem.low))
        for corner in (problem.start, *corners):
            problem.changed(corner)
        return problem

    @property
    def is_hypoid(self) -> bool:
        """Whether the pair is a hypoid one."""
        return isinstance(self.file, HypoidGearFile)

    @property
    def other_side(self) -> Side:
        """The flanks that only limits look at."""
        return "coast" if self.given.side == "drive" else "drive"

    @property
    def loads(self) -> tuple[Load, ...]:
        """Operating torques, then those of the other side."""
        given = self.given
        own = [Load(one, given.side) for one in given.torques_n_m]
        other = [Load(one, self.other_side) for one in given.limits.other_side_torques_n_m]
        return (*own, *other)

    @property
    def steps(self) -> Array:
        """Steps of differences of the flanks [unit of each], (P,)."""
        units = [field_unit(name.rpartition(".")[2])[0] for name in self.names]
        return np.array([_STEPS.get(unit, _RATIO_STEP) for unit in units])

    def changed(self, values: Array) -> GearFile:
        """Return the gear file with other values (P,) [unit of each], checked."""
        return self.file.varied(self._fields(values))

    def tried(self, values: Array, scenario: Scenario) -> GearFile:
        """Return the gear file with other values and with an error, not checked.

        Amounts may be smaller than a gear file takes.
        """
        return with_error(unchecked(self.file, self._fields(values)), scenario)

    def rounded(self, values: Array) -> Array:
        """Return values as a gear file gives them: few digits, amounts below 0.5 um are zero."""
        found = np.clip(np.round(values, DIGITS), self.low, self.high)
        small = [name.endswith("_um") for name in self.names] & (np.abs(found) < _LEAST)
        if not self.is_hypoid:
            small = np.zeros(found.size, bool)
        return np.where(small & (self.low <= 0.0) & (self.high >= 0.0), 0.0, found)

    def _fields(self, values: Array) -> dict[str, float]:
        return dict(zip(self.names, np.asarray(values, float).tolist(), strict=True))

    def ends(self, values: Array) -> list[tuple[str, float, float]]:
        """Return name, lower and upper end of the difference of each parameter, within bounds."""
        lower = np.maximum(values - self.steps, self.low)
        upper = np.minimum(values + self.steps, self.high)
        return list(zip(self.names, lower.tolist(), upper.tolist(), strict=True))


def read_gear_file(name: str) -> GearFile:
    """Return the shipped gear file of a name or the file at a path, of either kind."""
    if name in HelicalGearFile.shipped():
        return HelicalGearFile.named(name)
    if name in HypoidGearFile.shipped():
        return HypoidGearFile.named(name)
    if not (name.endswith(".toml") or isfile(name)):
        known = ", ".join((*HypoidGearFile.shipped(), *HelicalGearFile.shipped()))
        raise ParameterError(f"No gear file is called {name!r}. Shipped: {known}. Or give a path.")
    pair = read_toml(name, "gear file").get("pair")
    hypoid = isinstance(pair, dict) and "offset_mm" in pair
    return (HypoidGearFile if hypoid else HelicalGearFile).from_toml(name)


def with_error(file: GearFile, scenario: Scenario) -> GearFile:
    """Return a gear file with what an error adds to its fields."""
    if not scenario.added:
        return file
    return unchecked(
        file, {name: (_value(file, name) or 0.0) + more for name, more in scenario.added.items()}
    )


def unchecked(file: GearFile, changes: Mapping[str, float]) -> Any:
    """Return a gear file with dotted fields changed and no look whether it is sound."""
    found: Any = file
    for name, value in changes.items():
        found = _with(found, name.split("."), value)
    return found


def _with(section: Any, parts: list[str], value: float) -> Any:
    key, *rest = parts
    if rest:
        inner = getattr(section, key)
        value = _with(FlankRelief.model_validate({}) if inner is None else inner, rest, value)
    return section.model_copy(update={key: value})


def _scenarios(file: GearFile, errors: Errors) -> list[Scenario]:
    found = []
    own, other = (_MISALIGNMENTS, _SLOPES)
    if isinstance(file, HelicalGearFile):
        own, other = other, own  # type: ignore[assignment]
    for key in other:
        if getattr(errors, key):
            kind = "hypoid" if isinstance(file, HypoidGearFile) else "helical"
            raise ParameterError(
                f"errors.{key} is not for a {kind} pair. Give one of {', '.join(own)}, or "
                "errors.fields."
            )
    for key in own:
        value = getattr(errors, key)
        if not value:
            continue
        for sign, word in ((1.0, "+"), (-1.0, "-")):
            unit = field_unit(key)[1]
            name = f"{key.removesuffix(unit)} {word}{value:g} {unit[1:]}"
            if isinstance(file, HypoidGearFile):
                axis, factor = _MISALIGNMENTS[key]
                moved = Misalignment(**{axis: sign * factor * value})
                found.append(Scenario(name, misalignment=moved))
            else:
                found.append(Scenario(name, added={_SLOPES[key]: sign * value}))
    for key, value in errors.fields.items():
        _check_number(file, key)
        for sign, word in ((1.0, "+"), (-1.0, "-")):
            unit = field_notes(type(file))[key].unit
            words = f"{key} {word}{abs(value):g} {unit}"
            found.append(Scenario(words, added={key: sign * value}))
    return found


def _free_settings(file: GearFile, given: OptimisationFile) -> dict[str, Range]:
    """Return the settings that [settings] frees, with their bounds."""
    free = given.settings
    if free is None:
        return {}
    if not isinstance(file, HypoidGearFile):
        raise ParameterError(
            f"[settings] is only for a hypoid pair, got {file.name}, a helical one. Name reliefs, "
            "crowns and slopes in [parameters]."
        )
    found: dict[str, Range] = {}
    for role in free.members:
        curve = CURVES[role, given.side]
        for section in ("machine", "cutter") if free.blades else ("machine",):
            part = getattr(getattr(file, role), section)
            for key in type(part).model_fields:
                value = getattr(part, key)
                span = _span(key, value, curve, free)
                if span is not None:
                    one = Range(low=value - span[0], high=value + span[1])
                    found[f"{role}.{section}.{key}"] = one
    return found


def _span(key: str, value: Any, curve: str, free: Settings) -> tuple[float, float] | None:
    """Return how far a setting may go down and up, None where it stays."""
    other = "concave" if curve == "convex" else "convex"
    if not isinstance(value, float) or key.startswith(other) or key in _NOT_FREE:
        return None
    if key.endswith("edge_radius_mm"):
        return 0.5 * value, value
    if key == "ratio_of_roll":
        return free.within_ratio * value, free.within_ratio * value
    width = free.within_deg if key.endswith("_deg") else free.within_mm
    if key == "tilt_angle_deg":
        return min(width, value), width
    return width, width


def _check_number(file: GearFile, name: str) -> None:
    notes = field_notes(type(file))
    numbers = [key for key, note in notes.items() if note.kind == "number"]
    if name not in numbers:
        near = likely_fields(name, numbers)
        cure = f"Is it {near[0]}?" if near else "docs/gear_file.md and its helical twin list them."
        raise ParameterError(
            f"A parameter must be a number of the gear file of {file.name}, got {name!r}. {cure}"
        )


def _check_parameter(file: GearFile, name: str, given: OptimisationFile) -> None:
    _check_number(file, name)
    parts = name.split(".")
    allowed: Sequence[str] = ("flank",)
    if isinstance(file, HypoidGearFile):
        flanks = [f"{given.side}_flank"]
        if given.limits.other_side_torques_n_m:
            flanks = ["drive_flank", "coast_flank"]
        allowed = (*flanks, "machine", "cutter")
    if parts[0] not in ("pinion", "gear") or parts[1] not in allowed:
        sections = ", ".join(f"{role}.{one}" for role in ("pinion", "gear") for one in allowed)
        raise ParameterError(
            f"A parameter must be a field of {sections}, got {name!r}. The blank cannot change, "
            "and flanks without load cannot either. limits.other_side_torques_n_m puts load on "
            "the other flanks."
        )


def _value(file: GearFile, name: str) -> float | None:
    value: Any = file
    for part in name.split("."):
        value = getattr(value, part, None)
    return value


def values_of(file: GearFile, names: Sequence[str]) -> Array:
    """Return the values of dotted fields [unit of each], NaN where the file has none."""
    found = [_value(file, name) for name in names]
    return np.array([np.nan if one is None else one for one in found], float)


def _start(file: GearFile, name: str, given: Range) -> float:
    value = given.start if given.start is not None else _value(file, name)
    if value is None:
        raise ParameterError(
            f"parameters.{name} must have a start, because {file.name} has no value of it. Give "
            "start."
        )
    if not given.low <= value <= given.high:
        raise ParameterError(
            f"parameters.{name} must hold the value of {file.name} within low and high, "
            f"{given.low:g} to {given.high:g}, got {value:g}. Widen them or give start."
        )
    return float(value)
