"""The section of a body or an element in a train file: its fields are those of its dataclass.

A `Number` becomes a field with its unit, limits and text; a text, a choice, a list or a truth value
stays what it is. A dataclass of numbers, or a list of them, becomes a section of its own. A part
that is read from other files, such as the gears of a mesh, has one in READERS.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from dataclasses import MISSING, fields, is_dataclass
from functools import cache
from typing import (
    Annotated,
    Any,
    Literal,
    NamedTuple,
    TypeVar,
    get_args,
    get_origin,
    get_type_hints,
)

from pydantic import Field, ValidationError, create_model

from drivetrain.train.file_parts import READERS, ContactGears
from gearlube_core.dynamics.train.elements.gear_mesh import GearMesh
from gearlube_core.dynamics.train.housing import Housing
from gearlube_core.dynamics.train.part import Body, Element
from gearlube_core.dynamics.train.shaft import Shaft
from gearlube_core.errors import GearLubeError, ParameterError
from gearlube_core.input_file.field_notes import Declared, field_notes, sentence
from gearlube_core.input_file.field_units import attribute_of, field_value, si_value, unit_ending
from gearlube_core.input_file.input_file import Section
from gearlube_core.number import Number, numbers_of

Text = Annotated[str, Field(min_length=1)]
_Value = TypeVar("_Value")
_Part = TypeVar("_Part", Body, Shaft, Housing, Element)

BODIES: Mapping[str, Any] = {"rigid": Body, "shaft": Shaft, "housing": Housing}
# of a gear_mesh, which a gear file and its loaded contact say; kinds that no such file has
_OF_CONTACT = (
    "teeth_1", "teeth_2", "normal_module_mm", "face_width_mm", "normal_pressure_angle_deg",
    "helix_angle_deg", "helix_angle_2_deg", "ring", "cone_angle_1_deg", "cone_angle_2_deg",
    "centre_distance_mm", "azimuth_2_deg", "stiffness_n_per_um", "stiffness_waves",
    "station_stiffness", "gap", "backlash_um", "tooth_thickness",
)  # fmt: skip
OF_THE_TRAIN = ("steps_per_highest_period",)  # fields that elements have from their train

_WORDS = {
    "body": "Body on which it acts",
    "housing": "Body that carries the outer ring; left out: the ground",
    "tilt_arm": "Where a tilt moves the inner groove along the axis",
    "pinion": "Body that carries the pinion",
    "gear": "Body that carries the gear",
    "first": "One of the two bodies",
    "second": "The other of the two bodies",
    "stator": "Body that bears torque and pull the other way",
    "case": "Body of the case",
    "left": "Body of one side: a side gear, or a wheel",
    "right": "Body of the other side",
    "holder": "Part that holds the speed of the body",
    "mode": "none; governor: a torque over the error of the speed; imposed: the body follows the "
    "reference whatever the other torques",
    "held": "Coordinates that do not move, among x, y, z, rx, ry, rz",
    "torque_of": "Port whose torque chooses the level of the mesh's table; left out: the torque "
    "of the mesh itself",
    "drives_forward": "Whether the pinion, or gear 1, drives about +z; else about -z",
    "right_hand": "Whether the teeth of the pinion, or of gear 1, are right-handed",
    "ring": "Whether gear 2 is internal",
    "carrier": "Body with which the pitch point, or the body, turns around the axis",
    "stiffness_waves": "Cosine and sine of each harmonic of the stiffness over its mean, in turn",
    "station_stiffness": "Stiffness of each station over the mean of all, each a row as of gap; "
    "instead of stiffness_waves",
    "gap": "Unloaded gap [m] of each station from low z or the apex on, or one row for all: a "
    "number, or numbers at equal distances over a mesh cycle",
    "torque_loss": "Law of the drag, named as model.bearing_torque_loss of an axle file",
    "axes": "Places of the two radial axes and the axial one among x, y, z, counted from 0",
    "cage_moment": "Whether the shaft carries the moment that loaded rollers exert on their cage",
    "law": "Law of the churning loss",
    "sections": "Cylinders from end to end; where two overlap they add up",
    "discs": "Rigid masses on it",
    "nodes": "Bearings and gears by name, and where along z they are; elements name them BODY.NODE",
    "material": "Elastic material; steel by default",
    "gyroscopic": "Whether gyroscopic moments act",
    "free": "Whether the model floats and needs mounts; false: it is fixed somewhere",
    "model_axes": "Axes of the model along x, y, z of the train, such as -z for the opposite one",
}


class _Nested(NamedTuple):
    """A field that is a dataclass of numbers, a tuple of them, or named numbers."""

    kind: Any
    many: bool
    number: Number | None  # of each of the named ones


def _nested(hint: Any) -> _Nested | None:
    of = get_args(hint)
    if get_origin(hint) is Mapping:
        marks = [one for one in getattr(of[1], "__metadata__", ()) if isinstance(one, Number)]
        return _Nested(None, many=True, number=marks[0]) if marks else None
    kind = of[0] if of[1:] == (Ellipsis,) else hint
    if is_dataclass(kind) and hint not in READERS and numbers_of(kind):  # type: ignore[arg-type]
        return _Nested(kind, many=kind is not hint, number=None)
    return None


def _of_lists(hint: Any) -> Any:
    """Return the annotation of a field whose tuples are lists in a file."""
    if get_origin(hint) is not tuple:
        return hint
    inner = tuple(_of_lists(one) for one in get_args(hint))
    return Annotated[tuple[inner], Field(strict=False)]  # type: ignore[valid-type]


@cache
def _hints(kind: Any) -> tuple[Mapping[str, Any], Mapping[str, Any]]:
    """Return the types of the fields of a dataclass, and these with what is marked on them."""
    return get_type_hints(kind), get_type_hints(kind, include_extras=True)


def _section_of(kind: Any) -> type[Section]:
    hints, whole, numbers = *_hints(kind), numbers_of(kind)
    model: dict[str, Any] = {}
    base: type[Section] = Section
    bodies = getattr(kind, "on", ())
    for field in sorted(fields(kind), key=lambda one: one.name not in bodies):
        name, hint, default = field.name, hints[field.name], field.default
        given: dict[str, Any] = {} if default is MISSING else {"default": default}
        if name in ("name", *OF_THE_TRAIN):
            continue
        if name in numbers:
            number = numbers[name]
            key = name + unit_ending(number.shown or number.unit)
            if default is not MISSING:
                given["default"] = field_value(key, default)
            declared: Any = Annotated[hint, Declared(kind, key, name)]
            model[key] = declared, Field(description=number.text, **given)
        elif nested := _nested(whole[name]):
            text, own = _WORDS[name], nested.number
            if own is not None:
                model[name + unit_ending(own.shown or own.unit)] = (
                    dict[str, Annotated[float, Field(allow_inf_nan=False)]],
                    Field(description=text),
                )
                continue
            section: Any = section_of(nested.kind)
            optional = default is not MISSING or field.default_factory is not MISSING
            given = {"default": [] if nested.many else None} if optional else {}
            if nested.many:
                section = list[section]
            elif optional:
                section = section | None
            model[name] = section, Field(description=text, **given)
        elif hint in READERS and not READERS[hint].nested:
            base = READERS[hint].section
        elif hint in READERS:
            model[name] = READERS[hint].section, Field(description="See the axle file")
        else:
            text = _WORDS.get(name, f"Body: {name}")
            model[name] = _of_lists(hint), Field(description=text, **given)
    if issubclass(kind, Element):
        model["kind"] = Literal[kind.kind], Field(description="Kind of the element")
    elif kind in BODIES.values():
        named = next(name for name, one in BODIES.items() if one is kind)
        given = {"default": named} if kind is Body else {}
        model["kind"] = Literal[named], Field(description="Kind of the body", **given)
    return create_model(kind.__name__, __base__=base, **model)


section_of: Callable[[Any], type[Section]] = cache(_section_of)  # of a body or a kind of element


@cache
def contact_section() -> type[Section]:
    """Return the section of a gear_mesh that names a gear file."""
    whole = section_of(GearMesh).model_fields
    rest = {
        name: (one.annotation, one)
        for name, one in whole.items()
        if name not in (*_OF_CONTACT, *ContactGears.model_fields)
    }
    return create_model("ContactMesh", __base__=ContactGears, **rest)  # type: ignore[call-overload]


def read_part(
    kind: type[_Part], name: str, data: Mapping[str, Any], head: str, of_train: Mapping[str, Any]
) -> tuple[_Part | None, list[str]]:
    """Return a body or an element of a file's section, or None and what is wrong with it.

    `head` names the section in these sentences; `of_train` has the fields OF_THE_TRAIN.
    """
    section = section_of(kind)
    if kind is GearMesh and "gear_file" in data:
        section = contact_section()
    try:
        given = section.model_validate(dict(data))
    except ValidationError as reason:
        notes = field_notes(section)
        return None, [f"{head}.{sentence(error, notes)}" for error in reason.errors()]
    try:
        known = {"name": name, **of_train}
        if isinstance(given, ContactGears):
            known |= given.read()
        return _built(kind, given, known), []
    except GearLubeError as reason:
        return None, [f"{head}: {reason}"]


def _built(kind: Any, given: Section, known: Mapping[str, Any], head: str = "") -> Any:
    """Return the dataclass of a section; fields that are `known` stand in no file.

    Its errors begin with `head` and end with the names in the file of the fields that they name.
    """
    hints, whole, numbers = *_hints(kind), numbers_of(kind)
    keys = {attribute_of(key): key for key in type(given).model_fields}
    found: dict[str, Any] = {}
    for field in fields(kind):
        name = field.name
        reader, key = READERS.get(hints[name]), keys.get(name, name)
        value: Any = getattr(given, key, None)
        if name in known:
            found[name] = known[name]
        elif isinstance(given, ContactGears) and key not in type(given).model_fields:
            continue  # no cone angles and the like of gears on parallel axes
        elif name in numbers:
            found[name] = si_value(key, value)
        elif nested := _nested(whole[name]):
            if nested.number is not None:
                found[name] = {one: si_value(key, number) for one, number in value.items()}
            elif nested.many:
                found[name] = tuple(
                    _built(nested.kind, one, {}, f"{key} {i + 1}: ") for i, one in enumerate(value)
                )
            elif value is not None:
                found[name] = _built(nested.kind, value, {}, f"{key}: ")
        elif reader is not None:
            found[name] = reader.read(value if reader.nested else given)
        else:
            found[name] = value
    try:
        return kind(**found)
    except GearLubeError as reason:
        named = set(re.findall(r"\w+", str(reason))) & (keys.keys() - set(keys.values()))
        here = f" In the file: {', '.join(keys[one] for one in sorted(named))}." if named else ""
        raise ParameterError(f"{head}{reason}{here}") from None


def files_in(kind: type[Any]) -> tuple[str, ...]:
    """Return the fields of a body or an element that name files."""
    of_contact = ContactGears.files if kind is GearMesh else ()
    return (*getattr(section_of(kind), "files", ()), *of_contact)
