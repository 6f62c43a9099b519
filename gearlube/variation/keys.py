"""Names of parameters that can be varied, and how a typed name is understood."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Literal, NamedTuple

from gearlube_core.errors import ParameterError
from gearlube_core.input_file.field_notes import FieldNote, likely_fields
from gearlube_core.input_file.field_units import field_unit

Kind = Literal["number", "whole number", "text"]
_KINDS: tuple[Kind, ...] = ("number", "whole number", "text")
_NEAR = 3


class Key(NamedTuple):
    """A parameter that can be varied.

    `origin` says whose parameter it is: a field of the input file, a parameter of the FMU, or an
    operand of the study. `usual` is the value of an operand that is not varied.
    """

    name: str
    kind: Kind
    unit: str
    meaning: str
    origin: Literal["file", "fmu", "operand"]
    usual: float | str | None = None
    low: float = float("-inf")
    high: float = float("inf")
    note: FieldNote | None = None  # of a field of the file


Keys = Mapping[str, Key]


def file_keys(notes: Mapping[str, FieldNote]) -> dict[str, Key]:
    """Return the fields of an input file that are numbers or texts."""
    kinds = {kind: kind for kind in _KINDS}
    return {
        name: Key(name, kinds[note.kind], note.unit, note.meaning, "file", note=note)  # type: ignore[index]
        for name, note in notes.items()
        if note.kind in kinds and name not in ("name", "source")
    }


def _short(key: Key) -> str:
    """Return a key without the ending that says its unit."""
    ending = field_unit(key.name)[1]
    if key.origin == "operand":
        unit = key.unit.lower().replace(".", "_")
        endings = f"_{unit.replace('/', '_')}", f"_{unit.replace('/', '')}"  # m_s, kmh
        ending = next((one for one in endings if key.name.endswith(one)), ending)
    return key.name.removesuffix(ending) if key.origin != "fmu" else key.name


def understood(typed: str, keys: Keys, where: str = "--vary") -> Key:
    """Return the key that a typed name stands for; the unit at its end may be left out.

    `where` it was typed is named in errors.

    Raises
    ------
    ParameterError
        No parameter has that name; the message has those that are like it.

    Examples
    --------
    >>> key = Key("oil.temperature_degc", "number", "degC", "Of the oil", "operand")
    >>> understood("oil.temperature", {key.name: key}).name
    'oil.temperature_degc'
    """
    if typed in keys:
        return keys[typed]
    short = [key for key in keys.values() if _short(key) == typed]
    if len(short) == 1:
        return short[0]
    near = [key.name for key in short] or likely_fields(typed, keys)
    if not near:
        last = typed.rpartition(".")[2]
        near = [name for name in keys if last and last in name][:_NEAR]
    cure = f"Is it {' or '.join(near)}?" if near else "`gearlube vary STUDY --keys` lists all."
    raise ParameterError(f"{where} must name a parameter of the study, got {typed!r}. {cure}")
