"""Tables of an input file's fields, from its data model."""

from __future__ import annotations

from collections.abc import Mapping

from gearlube_core.input_file.field_notes import FieldNote, field_notes
from gearlube_core.input_file.input_file import InputFile


def field_tables(
    model: type[InputFile], sections: Mapping[str, str], defaults: Mapping[str, str] | None = None
) -> str:
    """Return one table for each of `sections`: dotted name of the section to its title.

    `defaults` are those of fields whose data model has none, by dotted name.
    """
    groups: dict[str, list[FieldNote]] = {section: [] for section in sections}
    for name, note in field_notes(model).items():
        section = name.rpartition(".")[0]
        if section in groups:
            groups[section].append(note._replace(default=(defaults or {}).get(name, note.default)))
    return "".join(_table(sections[section], notes) for section, notes in groups.items())


def _table(title: str, notes: list[FieldNote]) -> str:
    lines = [
        f"\n### {title}\n",
        "| Field | Unit | Value | Without it | Meaning |",
        "|---|---|---|---|---|",
    ]
    for note in notes:
        value = f"{note.kind}, {note.limits}" if note.limits else note.kind
        if note.usual is not None:
            value += f"; usual {note.usual[0]:g} to {note.usual[1]:g}"
        field = note.name.rpartition(".")[2]
        without = note.default or "required"
        lines.append(f"| `{field}` | {note.unit or '-'} | {value} | {without} | {note.meaning} |")
    return "\n".join(lines) + "\n"
