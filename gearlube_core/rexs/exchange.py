"""Gear files from REXS files, and REXS files from gear files."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from os.path import isfile
from pathlib import Path
from typing import Any

from gearlube_core.errors import ParameterError
from gearlube_core.helical_geometry.gear_file import HelicalGearFile
from gearlube_core.hypoid_design.blank_file import BlankFile
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from gearlube_core.input_file.field_notes import field_notes, sentence
from gearlube_core.rexs.bevel import blank_data, nested
from gearlube_core.rexs.cylindrical import helical_data, lacking_fields, write_helical
from gearlube_core.rexs.document import Document, RatedLoad, write_blank, write_hypoid
from gearlube_core.rexs.model import RexsModel
from gearlube_core.rexs.stage import ExchangeNote, Stage

PairFile = HelicalGearFile | HypoidGearFile | BlankFile
_WRITERS: dict[type, Any] = {
    HelicalGearFile: write_helical,
    HypoidGearFile: write_hypoid,
    BlankFile: write_blank,
}


@dataclass(frozen=True, slots=True, kw_only=True)
class RexsPair:
    """A pair that was read from a REXS file.

    Parameters
    ----------
    file : HelicalGearFile or BlankFile
        Of a cylindrical or a bevel stage.
    data : dict
        The fields that are known, as tables; what to write as TOML.
    notes : tuple of ExchangeNote
        What was taken, what follows, what the REXS file lacks and what was left out.
    """

    file: HelicalGearFile | BlankFile
    data: dict[str, Any]
    notes: tuple[ExchangeNote, ...]


def read_rexs(
    path: str | Path, *, stage: int | str | None = None, given: Mapping[str, Any] | None = None
) -> RexsPair:
    """Return the pair of a REXS file (version 1) with a cylindrical or a bevel stage.

    Parameters
    ----------
    path : path
        XML (.rexs), JSON (.rexsj) or an archive (.rexsz) of one of them.
    stage : int or str, optional
        Number or name of the stage, if the file has several; a planetary stage stands for the mesh
        of its sun with a planet.
    given : dict of str to number, optional
        Values of dotted gear-file fields that the REXS file lacks; they replace those of the REXS
        file.

    Raises
    ------
    ParameterError
        The file is no REXS file, lacks numbers, or has numbers that a gear file cannot have.

    References
    ----------
    [fva_2022].

    Examples
    --------
    >>> pair = read_rexs("my_pair.rexs")  # doctest: +SKIP
    >>> pair.file.pair.centre_distance_mm  # doctest: +SKIP
    """
    model, own = RexsModel.read(path), dict(given or {})
    chosen = Stage.chosen(model, stage)
    cylindrical = chosen.stage.kind == "cylindrical_stage"
    _check_names(own, HelicalGearFile if cylindrical else BlankFile)
    data = helical_data(chosen, own) if cylindrical else blank_data(chosen, own)
    data |= own
    replaced = {note.what: note.why for note in chosen.notes if note.what in own}
    chosen.notes = [note for note in chosen.notes if note.what not in own]
    for name, value in own.items():
        instead = f", instead of {replaced[name]}" if name in replaced else ""
        chosen.note("given", name, f"{value:g}{instead}")
    file: HelicalGearFile | BlankFile
    if cylindrical:
        file = HelicalGearFile.from_data(nested(data), str(path))
        chosen.notes += lacking_fields(file)
    else:
        file = BlankFile.from_data(nested(data), str(path))
        for note in file.inputs():
            if note.origin == "assumed" and note.field.split(".")[0] in _WISHES:
                chosen.note("lacking", note.field, f"{note.value_text} {note.unit}".strip())
    chosen.note_left_out()
    return RexsPair(file=file, data=nested(data), notes=tuple(chosen.notes))


def _check_names(given: dict[str, Any], kind: type[HelicalGearFile | BlankFile]) -> None:
    """Refuse given fields that a kind of file does not have, before numbers are missed."""
    notes = field_notes(kind)
    unknown = [
        sentence({"loc": (name,), "type": "extra_forbidden", "input": value}, notes)
        for name, value in given.items()
        if name not in notes
    ]
    if unknown:
        raise ParameterError(" ".join([*unknown, f"Give fields of a {kind.title}."]))


_WISHES = ("contact", "machine", "relief")  # of a blank file, which REXS has no words for


def write_rexs(
    file: PairFile, path: str | Path, load: RatedLoad | None = None
) -> tuple[ExchangeNote, ...]:
    """Write the macro geometry of a pair as a REXS file; return what could not be written.

    Parameters
    ----------
    file : HelicalGearFile, HypoidGearFile or BlankFile
        Gear or blank file.
    path : path
        The .rexs file to write.
    load : RatedLoad, optional
        A rating of this pair and its load, which become a load case of REXS 1.7.

    Returns
    -------
    tuple of ExchangeNote
        Every field of the file that has no place in a REXS file.

    Raises
    ------
    ParameterError
        The blank cannot exist, or the rating is of gears of another kind.

    Examples
    --------
    >>> from gearlube_core.helical_geometry.gear_file import HelicalGearFile
    >>> from pathlib import Path
    >>> from tempfile import TemporaryDirectory
    >>> with TemporaryDirectory() as folder:
    ...     left_out = write_rexs(HelicalGearFile.named("he_2007"), Path(folder) / "he.rexs")
    >>> left_out[0].what
    'source'
    """
    document, notes = _document(file)
    if load is not None:
        document.results(load)
    document.write(Path(path))
    return notes


def _document(file: PairFile) -> tuple[Document, tuple[ExchangeNote, ...]]:
    document = Document()
    taken = _WRITERS[type(file)](file, document)
    found: dict[str, list[str]] = {}
    for name, value in flat(file.model_dump(exclude_unset=True, exclude_none=True)).items():
        if name not in taken:
            section, _, key = name.rpartition(".")
            found.setdefault(section or key, []).append(f"{key} {value}" if section else f"{value}")
    notes = (ExchangeNote("left out", name, ", ".join(keys)) for name, keys in found.items())
    return document, tuple(notes)


def pair_file(name: str) -> PairFile:
    """Return a gear file or blank file of any kind: a TOML file, or a shipped one by its name."""
    kinds: tuple[type[PairFile], ...] = (HelicalGearFile, HypoidGearFile, BlankFile)
    for kind in kinds:
        if name in kind.shipped():
            return kind.named(name)
    if not (name.endswith(".toml") or isfile(name)):
        shipped = ", ".join(one for kind in kinds for one in kind.shipped())
        raise ParameterError(f"No gear file is called {name!r}. Shipped: {shipped}")
    from gearlube_core.input_file.input_file import read_toml

    data = read_toml(name, "gear file")
    if "cutter" in data:
        return BlankFile.from_toml(name)
    members = [one for role in ("pinion", "gear") if isinstance(one := data.get(role), dict)]
    hypoid = any("machine" in one for one in members)
    return (HypoidGearFile if hypoid else HelicalGearFile).from_toml(name)


def flat(data: Mapping[str, Any], prefix: str = "") -> dict[str, Any]:
    """Return tables in tables as dotted fields.

    >>> flat({"name": "a", "pair": {"offset_mm": 15.0}})
    {'name': 'a', 'pair.offset_mm': 15.0}
    """
    found: dict[str, Any] = {}
    for key, value in data.items():
        if isinstance(value, Mapping):
            found |= flat(value, f"{prefix}{key}.")
        else:
            found[f"{prefix}{key}"] = value
    return found
