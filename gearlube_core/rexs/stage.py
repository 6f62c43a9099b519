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

_RING = "ring_gear"

Kind = Literal["taken", "given", "inferred", "lacking", "left out"]


class ExchangeNote(NamedTuple):
    """Outcome of one number in the conversion from one file to the other.

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
    def chosen(cls, model: RexsModel, wanted: str | int | None = None) -> Stage:
        """Return the stage of a file, or the one with this component number or name.

        A planetary stage stands for the mesh of its sun with a planet.

        Raises
        ------
        ParameterError
            There is none, there are several, or its gears are of another kind.
        """
        stages = model.of_kind(*_STAGES)
        if not stages:
            others = ", ".join(str(one) for one in model.of_kind(*_OTHERS))
            raise ParameterError(
                f"{model.path} must have a cylindrical_stage or a bevel_stage, got "
                f"{others or 'no stage'}. Gears of other kinds are not modelled"
            )
        planetary = {
            mesh: planets
            for planets in model.of_kind("planetary_stage")
            for relation in model.related("assembly", "assembly", planets.number)
            if (mesh := relation.get("part", -1)) in model.components
            and model.components[mesh].kind in _STAGES
        }
        offered = _offered(model, stages, planetary)
        stage = _one_of(model, stages, wanted, offered, planetary)
        first, second = _gears(model, stage)
        for one in (first, second):
            if one.kind != _GEARS[stage.kind]:
                around = planetary.get(stage.number)
                raise ParameterError(
                    f"The gears of {stage} must be of type {_GEARS[stage.kind]}, got {one}. "
                    "Internal gears and other kinds are not modelled"
                    + (f"; of {around} choose the mesh of sun and planet" if around else "")
                )
        teeth = [one.count("number_of_teeth") for one in (first, second)]
        if None not in teeth and teeth[0] > teeth[1]:  # type: ignore[operator]
            first, second = second, first
        found = cls(model, stage, first, second)
        if stage.number in planetary:
            found._note_planets(planetary)
        return found

    def _note_planets(self, planetary: dict[int, Component]) -> None:
        """Note what the planetary stage is of which one mesh is read."""
        around = planetary[self.stage.number]
        meshes = [mesh for mesh, one in planetary.items() if one is around]
        gears = [_gears(self.model, self.model.components[mesh]) for mesh in meshes]
        planets = sum(all(gear.kind != _RING for gear in pair) for pair in gears)
        rings = {str(one) for pair in gears for one in pair if one.kind == _RING}
        self.note(
            "inferred", str(around), f"read as the mesh of {self.pinion} and {self.gear}, one of "
            f"{planets}: give the torque of that mesh, and speeds relative to the carrier",
        )  # fmt: skip
        if rings:
            self.note("left out", ", ".join(sorted(rings)), "internal gears are not modelled")

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
        self, name: str, *places: tuple[Component, str, str], given: dict[str, Any], other: str = ""
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


def _gears(model: RexsModel, stage: Component) -> tuple[Component, Component]:
    """Return both gears of a stage in the order of its relation."""
    found = model.related("stage", "stage", stage.number)
    roles = found[0] if found else {}
    first, second = (model.components.get(roles.get(role, -1)) for role in ("gear_1", "gear_2"))
    if first is None or second is None:
        raise ParameterError(
            f"{stage} must have a relation of type stage with gear_1 and gear_2 that are "
            "components of the file. Add it"
        )
    return first, second


def _offered(
    model: RexsModel, stages: list[Component], planetary: dict[int, Component]
) -> list[Component]:
    """Return the stages to choose from: of a planetary stage the first mesh of sun and planet."""
    offered, seen = [], set()
    for stage in stages:
        around = planetary.get(stage.number)
        if around is not None:
            internal = any(gear.kind == _RING for gear in _gears(model, stage))
            if internal or around.number in seen:
                continue
            seen.add(around.number)
        offered.append(stage)
    return offered or stages


def _one_of(
    model: RexsModel,
    stages: list[Component],
    wanted: str | int | None,
    offered: list[Component],
    planetary: dict[int, Component],
) -> Component:
    """Return the stage that is wanted, by number, name or a part of the name."""
    text, found = str(wanted).strip().lower(), stages
    if wanted is not None:
        called = {one.number: [one] for one in stages}
        for one in offered:
            called[one.number] += [planetary[one.number]] if one.number in planetary else []
        found = [
            one
            for one in stages
            if any(text in (str(own.number), own.name.lower()) for own in called[one.number])
        ] or [one for one in stages if any(text in own.name.lower() for own in called[one.number])]
    found = [one for one in found if one in offered] or found[:1]  # else copies of one mesh
    if len(found) == 1:
        return found[0]
    listed = "; ".join(_listed(model, one, planetary) for one in offered)
    if not found:
        raise ParameterError(
            f"{model.path} has no cylindrical or bevel stage {wanted}; it has {listed}."
        )
    raise ParameterError(
        f"{model.path} has {len(found)} stages{f' called {wanted}' if wanted else ''}: {listed}. "
        f"Choose one by its number or name: --stage {offered[0].number}"
    )


def _listed(model: RexsModel, stage: Component, planetary: dict[int, Component]) -> str:
    """Return a stage with its teeth, and the planetary stage that it is in."""
    related = model.related("stage", "stage", stage.number)
    gears = [model.components.get(number) for roles in related for role, number in roles.items()
             if role in ("gear_1", "gear_2")]  # fmt: skip
    teeth = "/".join(str(one.count("number_of_teeth") if one else "?") for one in gears) or "no"
    around = planetary.get(stage.number)
    return f"{stage}, {teeth} teeth" + (f", sun and planet of {around}" if around else "")
