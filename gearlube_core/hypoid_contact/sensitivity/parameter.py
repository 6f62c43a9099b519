"""Parameter of derivatives of tooth contact: a field of the gear file or a misalignment."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, fields, replace

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.errors import ParameterError
from gearlube_core.hypoid_contact.pair import FlankPair
from gearlube_core.hypoid_contact.placement import ALIGNED, Misalignment
from gearlube_core.hypoid_geometry.flank.flank import Flank, Role
from gearlube_core.hypoid_geometry.flank.machine_frames import reference_point
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from gearlube_core.input_file.field_notes import field_notes
from gearlube_core.units import DEGREE, MILLIMETRE

MISALIGNMENT = "misalignment"

# differences are taken over twice the step: cutting it or doubling it changes derivatives by 1e-7
_STEPS = {"mm": 1e-3, "um": 0.1, "deg": 1e-3, "mm/rad": 1e-3, "m": 1e-6, "rad": 1e-5}
_RATIO_STEP = 1e-5
_TOLERANCES = {
    "mm": 0.01,
    "um": 1.0,
    "deg": 0.01,
    "mm/rad": 0.01,
    "m": 0.01 * MILLIMETRE,
    "rad": 0.01 * DEGREE,
}
_RATIO_TOLERANCE = 1e-4
_BLADE_EDGE = ".cutter.", "edge_radius_mm"
_OF_FLANKS = ("machine", "cutter", "drive_flank", "coast_flank")  # sections of a member
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
        Of the number: that of the field in the gear file, "1" without one; "m" or "rad" of a
        misalignment.
    value : float
        [unit].
    step : float
        Of the differences of the motions [unit].
    """

    name: str
    unit: str
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
            unit = "rad" if key == "shaft_angle" else "m"
            return cls(name, unit, float(getattr(misalignment, key)), _STEPS[unit])
        notes = field_notes(HypoidGearFile)
        if name not in notes:
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
                f"{name} must have a value to be changed, but this file does not give it. Give it "
                "in the file."
            )
        if not isinstance(value, float):
            raise ParameterError(
                f"{name} must be a length, an angle or a ratio, got {value!r}. Counts and words "
                "have no derivative."
            )
        unit = notes[name].unit or "1"
        step = _EDGE_STEP * value if _is_blade_edge(name) else _STEPS.get(unit, _RATIO_STEP)
        return cls(name, unit, value, step)

    @property
    def tolerance(self) -> float:
        """A small change to compare parameters by [unit].

        0.01 mm, 0.01 deg, 1 um of a relief, 1e-4 of a ratio, a hundredth of the radius of a blade
        edge.
        """
        if _is_blade_edge(self.name):
            return 0.01 * self.value
        return _TOLERANCES.get(self.unit, _RATIO_TOLERANCE)

    @property
    def moves(self) -> tuple[Role, ...]:
        """Members whose flanks change with the parameter."""
        section, _, rest = self.name.partition(".")
        if section == MISALIGNMENT:
            return ()
        if rest.partition(".")[0] in _OF_FLANKS:
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
    """Return the names of the misalignments, of all settings and of the reliefs of the file.

    Left out: fields without value or with one on its limit, corrections of blade angles (as the
    blade angles) and the basic cradle angle (only a phase).
    """
    found = [f"{MISALIGNMENT}.{field.name}" for field in fields(Misalignment)]
    for role in _ROLES:
        member = getattr(file, role)
        for section in _OF_FLANKS:
            values = getattr(member, section)
            if values is None:
                continue
            for key in type(values).model_fields:
                if key.endswith("_angle_correction_deg") or key == "basic_cradle_angle_deg":
                    continue
                name = f"{role}.{section}.{key}"
                if isinstance(getattr(values, key), float) and _is_free(file, name):
                    found.append(name)
    return tuple(found)


def _is_blade_edge(name: str) -> bool:
    section, ending = _BLADE_EDGE
    return section in name and name.endswith(ending)


def _is_free(file: HypoidGearFile, name: str) -> bool:
    parameter = Parameter.named(name, file, ALIGNED)
    try:
        for step in (-parameter.step, parameter.step):
            file.varied({name: parameter.value + step})
    except ParameterError:
        return False
    return True


@dataclass(frozen=True, slots=True)
class Variations:
    """Analysis from which all derivatives of a pair are taken.

    Parameters
    ----------
    pair : FlankPair
        As it stands.
    parameters : tuple of Parameter
        P of them.
    lower, upper : tuple of FlankPair
        P pairs, each with one parameter a step below and a step above its value.
    """

    pair: FlankPair
    parameters: tuple[Parameter, ...]
    lower: tuple[FlankPair, ...]
    upper: tuple[FlankPair, ...]

    @classmethod
    def of(cls, file: HypoidGearFile, pair: FlankPair, names: Iterable[str]) -> Variations:
        """Return the variations of a file's pair by the named parameters.

        Parameters
        ----------
        file : HypoidGearFile
        pair : FlankPair
            Of the file, displaced or not.
        names : iterable of str
            See `Parameter`.

        Raises
        ------
        ParameterError
            When there is no such number, or a step leaves the range of its field: a value on its
            limit has no derivative.
        """
        parameters = tuple(Parameter.named(name, file, pair.misalignment) for name in names)
        ends = [one.about(file, pair) for one in parameters]
        return cls(pair, parameters, tuple(a for a, _ in ends), tuple(b for _, b in ends))

    @property
    def steps(self) -> Array:
        """Step of each parameter [its unit], (P,)."""
        return np.array([one.step for one in self.parameters])

    def difference(self, at_lower: Array, at_upper: Array) -> Array:
        """Return the derivatives (P, ...) of something known at all lower and upper pairs."""
        change = np.asarray(at_upper) - np.asarray(at_lower)
        return np.asarray(change / (2.0 * self.steps).reshape(-1, *[1] * (change.ndim - 1)))
