"""Which kind of input file some data are, where a file of another kind was asked for."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from typing import Any, NamedTuple


class FileKind(NamedTuple):
    """A kind of input file by the fields that no other kind has."""

    words: str  # what errors call it, with its article
    marks: tuple[str, ...]  # dotted fields or sections
    use: str  # a sentence: what takes such a file


_KINDS = (
    FileKind(
        "an axle file",
        ("gear_set",),
        "gearlube axle show, sweep, map, cycle and runup take it.",
    ),
    FileKind(
        "a gear file of a hypoid pair",
        ("pinion.machine", "gear.machine"),
        "gearlube contact takes it; an axle file names it in [gear_set] as gear_file.",
    ),
    FileKind(
        "a gear file of a helical pair",
        ("pair.helix_angle_deg",),
        "gearlube helical, whine and build-fmu --gear take it.",
    ),
    FileKind(
        "a blank file",
        ("pair.pinion_teeth", "pair.gear_teeth"),
        "gearlube design makes a gear file of it.",
    ),
    FileKind(
        "an oil file",
        ("base_oil",),
        "gearlube oil shows it; an axle file names it in [oil] as file, other commands as --oil.",
    ),
)


def other_kind(data: Mapping[str, Any], fields: Collection[str]) -> FileKind | None:
    """Return the kind of file that data are, if that kind lacks these dotted fields; else None.

    >>> other_kind({"base_oil": "pao"}, ["gear_set.mesh_table"]).words
    'an oil file'
    """
    for kind in _KINDS:
        if all(_has(data, mark) for mark in kind.marks):
            known = all(
                any(f"{field}.".startswith(f"{mark}.") for field in fields) for mark in kind.marks
            )
            return None if known else kind
    return None


def _has(data: Any, dotted: str) -> bool:
    for part in dotted.split("."):
        if not isinstance(data, Mapping) or part not in data:
            return False
        data = data[part]
    return True
