"""Errors of input files as a whole: wrong fields, another kind of file, files not found."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from os.path import isfile  # false for a name that no file can have
from pathlib import Path
from typing import Any, NamedTuple

from gearlube_core.errors import ParameterError, unread_named
from gearlube_core.input_file.field_notes import FieldNote, sentence, unusual_numbers

MOST_LISTED = 20  # wrong fields
_LONGEST = 1000  # characters of a sentence


class _FileKind(NamedTuple):
    """A kind of input file by the fields that no other kind has."""

    words: str  # what errors call it, with its article
    marks: tuple[str, ...]  # dotted fields or sections
    use: str  # a sentence: what takes such a file


_KINDS = (
    _FileKind(
        "an axle file",
        ("gear_set",),
        "gearlube axle show, sweep, map, cycle and runup take it.",
    ),
    _FileKind(
        "a gear file of a hypoid pair",
        ("pinion.machine", "gear.machine"),
        "gearlube contact takes it; an axle file names it in [gear_set] as gear_file.",
    ),
    _FileKind(
        "a gear file of a helical pair",
        ("pair.helix_angle_deg",),
        "gearlube helical, whine and build-fmu --gear take it.",
    ),
    _FileKind(
        "a blank file",
        ("pair.pinion_teeth", "pair.gear_teeth"),
        "gearlube design makes a gear file of it.",
    ),
    _FileKind(
        "a train file",
        ("bodies", "elements"),
        "gearlube drivetrain and build-fmu --train take it.",
    ),
    _FileKind(
        "an oil file",
        ("base_oil",),
        "gearlube oil shows it; an axle file names it in [oil] as file, other commands as --oil.",
    ),
)


def named_places(data: Any, fields: Sequence[str], folder: Path) -> dict[str, Path]:
    """Return the paths of files that data name in dotted fields, by field, not names of shipped.

    Relative paths count from `folder`.
    """
    places = {}
    for field in fields:
        text = data
        for part in field.split("."):
            text = text.get(part) if isinstance(text, dict) else None
        if isinstance(text, str) and text:
            place = folder / text
            if isfile(place) or Path(text).suffix or len(Path(text).parts) > 1:
                places[field] = place
    return places


def check_places(path: str | Path, places: Mapping[str, Path]) -> None:
    """Raise ParameterError where a file that `path` names is not there; places are by field."""
    for field, place in places.items():
        if not isfile(place):
            reason = IsADirectoryError() if place.is_dir() else FileNotFoundError()
            raise ParameterError(unread_named(place, reason, path, field))


def refusal(
    data: Mapping[str, Any],
    where: str,
    errors: Sequence[Any],
    notes: dict[str, FieldNote],
    title: str,
    unmodelled: Mapping[str, str],
) -> ParameterError:
    """Return the error for a file with these errors of pydantic; `where` names the file in it."""
    other = _other_kind(data, notes)
    if other is not None:
        return ParameterError(
            f"{where} is not the file that is asked for ({title}): its fields are "
            f"those of {other.words}. {other.use}"
        )
    known = {".".join(str(part) for part in error["loc"]) for error in errors}
    asked = [said for name, said in unusual_numbers(data, notes).items() if name not in known]
    wrong = [sentence(error, notes, unmodelled) for error in errors[:MOST_LISTED]]
    return wrong_fields(where, wrong, asked, count=len(errors))


def wrong_fields(
    where: str, wrong: Sequence[str], asked: Sequence[str] = (), count: int = 0
) -> ParameterError:
    """Return the error of a file with wrong fields, which sentences name; `asked` are doubts.

    `count` is the number of wrong fields where there are more than sentences.
    """
    count = max(count, len(wrong))
    more = f" And {count - MOST_LISTED} more." if count > MOST_LISTED else ""
    shown = [*wrong[:MOST_LISTED], *asked]
    return ParameterError(
        f"{where} has {count} wrong field(s). "
        + " ".join(one if len(one) < _LONGEST else f"{one[:_LONGEST]}..." for one in shown)
        + more
    )


def _other_kind(data: Mapping[str, Any], fields: Collection[str]) -> _FileKind | None:
    """Return the kind of file that data are, if that kind lacks these dotted fields; else None.

    >>> _other_kind({"base_oil": "pao"}, ["gear_set.mesh_table"]).words
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
