"""One stage of a REXS file: its gears and flanks, and what was made of their attributes."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, field
from typing import Any, Literal, NamedTuple

from gearlube_core.errors import ParameterError
from gearlube_core.rexs.model import Component, RexsModel

_STAGES = ("cylindrical_stage", "bevel_stage")
_OTHERS = ("worm_stage", "planetary_stage")
_GEARS = {"cylindrical_stage": "cylindrical_gear", "bevel_stage": "bevel_gear"}

Kind = Literal["taken", "given", "inferred", "lacking", "left out"]


class ExchangeNote(NamedTuple):
    """What became of one number on its way from one file to the other.

    `kind` is "taken" (the same quantity in both), "given" (by the user), "inferred" (follows
    from others), "lacking" (the file that is written has it, the one that is read does not) or
    "left out" (the other way round).
    """

    kind: Kind
    what: str
    why: str


@dataclass(slots=True)
class Stage:
    """A stage with its members; the pinion is the one with fewer teeth."""

    model: RexsModel
    stage: Component
    pinion: Component
    gear: Component
    notes: list[ExchangeNote] = field(default_factory=list)
    absent: list[str] = field(default_factory=list)  # required fields, and where they were sought

    @classmethod
    def chosen(cls, model: RexsModel, number: int | None = None) -> Stage:
        """Return the stage of a file, or the one with this component number.

        Raises
        ------
        ParameterError
            There is none, there are several, or its gears are of another kind.
        """
        stages = model.of_kind(*_STAGES)
        listed = ", ".join(str(one) for one in stages) or "none"
        if number is not None and number not in [one.number for one in stages]:
            raise ParameterError(
                f"{model.path} has no cylindrical or bevel stage {number}; it has {listed}."
            )
        if not stages:
            others = ", ".join(str(one) for one in model.of_kind(*_OTHERS))
            raise ParameterError(
                f"{model.path} must have a cylindrical_stage or a bevel_stage, got "
                f"{others or 'no stage'}. Gears of other kinds are not modelled"
            )
        if number is None and len(stages) > 1:
            raise ParameterError(
                f"{model.path} has {len(stages)} stages: {listed}. Choose one by its number: "
                f"--stage {stages[0].number}"
            )
        stage = stages[0] if number is None else model.components[number]
        found = model.related("stage", "stage", stage.number)
        roles = found[0] if found else {}
        gears = [model.components.get(roles.get(role, -1)) for role in ("gear_1", "gear_2")]
        first, second = gears
        if first is None or second is None:
            raise ParameterError(
                f"{stage} must have a relation of type stage with gear_1 and gear_2 that are "
                "components of the file. Add it"
            )
        for one in (first, second):
            if one.kind != _GEARS[stage.kind]:
                raise ParameterError(
                    f"The gears of {stage} must be of type {_GEARS[stage.kind]}, got {one}. "
                    "Internal gears and other kinds are not modelled"
                )
        teeth = [one.count("number_of_teeth") for one in (first, second)]
        if None not in teeth and teeth[0] > teeth[1]:  # type: ignore[operator]
            first, second = second, first
        return cls(model, stage, first, second)

    def members(self) -> dict[str, Component]:
        """Return pinion and gear by their names in gear files."""
        return {"pinion": self.pinion, "gear": self.gear}

    def flanks(self, gear: Component) -> list[Component]:
        """Return the flanks of a gear, left and right, as far as the file has them."""
        found = [
            roles.get(side)
            for roles in self.model.related("flank", "gear", gear.number)
            for side in ("left", "right")
        ]
        return [self.model.components[n] for n in found if n in self.model.components]

    def note(self, kind: Kind, what: str, why: str) -> None:
        """Add a note."""
        self.notes.append(ExchangeNote(kind, what, why))

    def required(
        self,
        name: str,
        *places: tuple[Component, str, str],
        given: dict[str, Any],
        other: str = "",
    ) -> float | None:
        """Return the first number that is there; note where it is from, or that it is absent.

        Parameters
        ----------
        name : str
            Dotted field of the gear file.
        *places : tuple of Component, str, str
            Where it may be: component, attribute, unit.
        given : dict
            Fields that the user gives, which need not be in the file.
        other : str, optional
            What else would do, for the error.
        """
        value = self.optional(name, *places)
        if value is None and name not in given:
            sought = " or ".join(
                f"{attribute} of {component}" for component, attribute, _ in places
            )
            self.absent.append(f"{name} (REXS: {sought}{f', or {other}' if other else ''})")
        return value

    def optional(self, name: str, *places: tuple[Component, str, str]) -> float | None:
        """Return the first number that is there, with a note where it is from."""
        for component, attribute, unit in places:
            value = component.value(attribute, unit)
            if value is not None:
                spelled = component.attributes[attribute][1]
                changed = f", from {spelled}" if spelled not in ("", unit, "°") else ""
                self.note("taken", name, f"{attribute} of {component}{changed}")
                return value
        return None

    def check_complete(self) -> None:
        """Raise ParameterError that names every required field that the file lacks."""
        if self.absent:
            raise ParameterError(
                f"{self.model.path} lacks {len(self.absent)} number(s) that a gear file needs: "
                f"{'; '.join(self.absent)}. Add them to the file, or give them: "
                f"--set {self.absent[0].split()[0]}=VALUE"
            )

    def note_left_out(self) -> None:
        """Note every attribute and component that was not read."""
        own = [self.stage, self.pinion, self.gear]
        own += [flank for one in (self.pinion, self.gear) for flank in self.flanks(one)]
        for one in own:
            if one.unused:
                self.note("left out", str(one), ", ".join(one.unused))
        numbers = {one.number for one in own}
        rest = Counter(c.kind for n, c in self.model.components.items() if n not in numbers)
        for kind, count in rest.items():
            self.note("left out", kind, f"{count} component{'s' if count > 1 else ''} of this type")
        if self.model.load_spectra:
            self.note("left out", "load_spectrum", "torques and speeds of the model")
