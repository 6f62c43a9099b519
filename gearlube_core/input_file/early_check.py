"""Fields of an input file checked before its model is imported, which takes seconds.

`fields.json` beside this module has the schemas of all kinds of files: `python -m docs.field_pages`
writes it. Only what a schema knows is checked; what passes here meets the model itself later.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping, Sequence
from functools import cache
from importlib.resources import files
from pathlib import Path
from typing import Any, NamedTuple

from gearlube_core.input_file.field_notes import notes_of_schema, sentence
from gearlube_core.input_file.input_file import check_given, read_toml, shipped_names
from gearlube_core.input_file.refusal import check_places, named_places, refusal, wrong_fields

FIELDS = "fields.json"
_TYPES: dict[str, tuple[type, ...]] = {
    "number": (float, int), "integer": (int,), "boolean": (bool,), "string": (str,),
    "array": (list,), "object": (dict,),
}  # fmt: skip
_ERRORS = {
    "number": "float_type", "integer": "int_type", "boolean": "bool_type",
    "string": "string_type", "array": "tuple_type", "object": "dict_type",
}  # fmt: skip
# limit in a schema, in the order of pydantic: its error and name there, whether a value keeps it
_LIMITS = {
    "maximum": ("less_than_equal", "le", lambda value, limit: value <= limit),
    "exclusiveMaximum": ("less_than", "lt", lambda value, limit: value < limit),
    "minimum": ("greater_than_equal", "ge", lambda value, limit: value >= limit),
    "exclusiveMinimum": ("greater_than", "gt", lambda value, limit: value > limit),
}

# models of the files that a file names, by the field or its last part
_GEARS, _OIL = ("HypoidGearFile", "HelicalGearFile"), ("OilFile",)
_NAMED = {
    "gear_file": _GEARS, "gear": _GEARS, "axle_file": ("AxleFile",), "oil": _OIL,
    "oil_file": _OIL, "oil.file": _OIL, "oil.name": _OIL,
}  # fmt: skip


class FileKind(NamedTuple):
    """A kind of input file, as `fields.json` has it."""

    package: str
    prefix: str
    title: str
    files: Sequence[str]  # fields that name files
    unmodelled: Mapping[str, str]
    schema: Mapping[str, Any]
    parts: Mapping[str, Mapping[str, Any]]  # section of a train file: schemas by kind


@cache
def file_kinds() -> dict[str, FileKind]:
    """Return the kinds of input files by the names of their models."""
    text = (files("gearlube_core.input_file") / FIELDS).read_text(encoding="utf-8")
    return {name: FileKind(**kind) for name, kind in json.loads(text).items()}


def check_early(path: str | Path, names: Sequence[str]) -> None:
    """Raise ParameterError where a file cannot be read, or fits no model with one of these names.

    The message is that of `InputFile.from_toml`, without what fields say together.
    """
    kinds = [file_kinds()[name] for name in names]
    data = read_toml(path, kinds[0].title)
    found = [(list(_errors(data, one.schema, one.schema)), one) for one in kinds]
    errors, kind = min(found, key=lambda one: len(one[0]))
    if errors:
        notes = notes_of_schema(kind.schema)
        raise refusal(data, str(path), errors, notes, kind.title, kind.unmodelled)
    if wrong := [one for section in kind.parts for one in _of_parts(data, section, kind)]:
        raise wrong_fields(str(path), wrong)
    fields = [*kind.files, *(one for section in kind.parts for one in _files(data, section, kind))]
    places = named_places(data, fields, Path(path).parent.absolute())
    check_places(path, places)
    for field, place in places.items():
        named = _NAMED.get(field) or _NAMED.get(field.rpartition(".")[2])
        if named and place.suffix == ".toml":
            check_early(place, named)


def check_name(name: str, names: Sequence[str]) -> None:
    """Raise ParameterError for a name that is no path and that no file of these models has."""
    kinds = [file_kinds()[one] for one in names]
    shipped = [one for kind in kinds for one in shipped_names(kind.package, kind.prefix)]
    check_given(name, kinds[0].title, shipped)


def _files(data: Mapping[str, Any], section: str, kind: FileKind) -> Iterator[str]:
    for name, given in data[section].items():
        of_kind = given.get("kind", "rigid") if isinstance(given, dict) else ""
        for field in kind.parts[section].get(str(of_kind), {}).get("files", ()):
            yield f"{section}.{name}.{field}"


def _of_parts(data: Mapping[str, Any], section: str, kind: FileKind) -> Iterator[str]:
    for name, given in data[section].items():
        if not isinstance(given, dict) or {"like", "gear_file"} & given.keys():
            continue
        schema = kind.parts[section].get(str(given.get("kind", "rigid")))
        if schema is not None:
            notes = notes_of_schema(schema)
            for error in _errors(given, schema, schema):
                yield f"{section}.{name}.{sentence(error, notes)}"


def _errors(
    value: Any, field: Mapping[str, Any], whole: Mapping[str, Any], place: tuple[Any, ...] = ()
) -> Iterator[dict[str, Any]]:
    """Yield what is wrong with a value, as pydantic has it."""
    options = [one for one in field.get("anyOf", [field]) if one.get("type") != "null"]
    if len(options) != 1:
        return
    schema: Mapping[str, Any] = options[0]
    if "$ref" in schema:
        schema = whole["$defs"][schema["$ref"].rpartition("/")[2]]
    kind = schema.get("type")
    error: dict[str, Any] = {"loc": place, "input": value, "msg": "wrong"}
    if kind not in _TYPES or "enum" in schema or "const" in schema:
        return  # names may be those of a registry
    allowed: Any = _TYPES[kind]
    if not isinstance(value, allowed) or (isinstance(value, bool) and kind != "boolean"):
        yield error | {"type": "model_type" if "properties" in schema else _ERRORS[kind]}
    elif "properties" in schema:
        yield from _errors_of_section(value, schema, whole, place)
    elif kind == "array":
        for number, one in enumerate(value):
            yield from _errors(one, schema.get("items", {}), whole, (*place, number))
    elif kind in ("number", "integer"):
        for limit, (name, short, keeps) in _LIMITS.items():
            if limit in schema and not keeps(value, schema[limit]):
                yield error | {"type": name, "ctx": {short: schema[limit]}}
                return


def _errors_of_section(
    given: Mapping[str, Any], schema: Mapping[str, Any], whole: Any, place: tuple[Any, ...]
) -> Iterator[dict[str, Any]]:
    fields = schema["properties"]
    types = [one.get("enum") for one in fields.get("type", {}).get("anyOf", [])]
    if types and "type" in given and given["type"] not in (types[0] or ()):
        return  # a type of the user's own has fields of its own
    for key, of_field in fields.items():
        if key in given:
            yield from _errors(given[key], of_field, whole, (*place, key))
        elif key in schema.get("required", ()):
            yield {"type": "missing", "loc": (*place, key), "input": given, "msg": "missing"}
    for key in given:
        if key not in fields and schema.get("additionalProperties") is False:
            error = {"type": "extra_forbidden", "loc": (*place, key), "input": given[key]}
            yield error | {"msg": "unknown"}
