"""Folder of results of a command: one run at a time, one study, one input; marked with them."""

from __future__ import annotations

import hashlib
import json
import os
import re
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryFile
from typing import Any

from gearlube_core import __version__
from gearlube_core.errors import ParameterError
from gearlube_core.storage.folders import LOCK, locked_folder

MARK = "gearlube_results.json"  # says which study wrote a folder, which version, of which input
# options that change no result: they say how it is computed, or what is written beside it
_NO_INPUT = frozenset(
    {
        *("out", "overwrite", "jobs", "scheduler", "threads", "block", "limit"),
        *("animate", "animate_rpm", "animation", "export", "regulation_grid", "regulation_raised"),
    }
)
_QUOTED = re.compile(r"""\"([^"\n]*)\"|'([^'\n]*)'""")
_HALF = re.compile(r"\.(\d+\.part|\w{8,32}\.part|[0-9a-f]{32}\.partial)$")  # ours and Zarr's
_CURE = "Give another --out, or --overwrite to write there anyway."
# what studies write: a folder with one of these and no mark holds results of an older version
_RESULTS = frozenset(
    {
        "sweep.nc",
        "summary.csv",
        "report.html",
        "contact.nc",
        "design.nc",
        "optimise.nc",
        "resonance.nc",
        "cycle.nc",
        "line.nc",
        "point.nc",
        "helical.nc",
        "hypoid.nc",
        "rough.nc",
        "compare.png",
        "line_mesh.nc",
        "geometry.nc",
        "bearing.nc",
        "map.nc",
        "sound.nc",
        "runup.nc",
        "coastdown.nc",
        "drive_cycle.nc",
        "results.zarr",
    }
)


@contextmanager
def written_folder(out: Path) -> Iterator[None]:
    """Make a folder that no other run writes to; if the command fails, leave no empty one behind.

    Raises
    ------
    ParameterError
        A file is in the way, nothing can be written there, or another run writes there.
    """
    made = [folder for folder in (out, *out.parents) if not folder.exists()]
    try:
        try:
            out.mkdir(parents=True, exist_ok=True)
            TemporaryFile(dir=out).close()
        except OSError as reason:
            why = reason.strerror or str(reason)
            if any(part.exists() and not part.is_dir() for part in (out, *out.parents)):
                why = "a file is in the way"
            raise ParameterError(
                f"--out must be a folder that can be written, got {out}: {why.lower()}. "
                "Give another folder."
            ) from None
        with locked_folder(out):
            yield
    except BaseException:
        for folder in made:
            if not _remove_if_empty(folder):
                break
        raise


@contextmanager
def results_folder(
    out: Path, study: str, *, overwrite: bool = False, by_parts: bool = False
) -> Iterator[None]:
    """Make a study's folder of results and mark it; see `written_folder`.

    Parameters
    ----------
    out : Path
    study : str
        The command as typed after `gearlube`.
    overwrite : bool
        Also write into a folder of another study, version or input.
    by_parts : bool
        The study keeps the options of each part of its results, and goes on with those that fit:
        only its case must be the same here.

    Raises
    ------
    ParameterError
        The folder holds results of another study, version or input, or cannot be written.
    """
    from gearlube_core.storage.atomic_file import write_text  # help does without NumPy

    with written_folder(out):
        mark = out / MARK
        mine = {"study": study, "gearlube_version": __version__, "input": _input()}
        marked = mark.is_file()
        if not overwrite:
            _check_owner(out, mine, {"case", "gear"} if by_parts else None)
        if marked:
            _remove_halves(out)
        write_text(json.dumps(mine) + "\n", mark)
        try:
            yield
        except BaseException:
            if not marked and {entry.name for entry in out.iterdir()} == {MARK, LOCK}:
                mark.unlink()
            raise


def _check_owner(out: Path, mine: dict[str, Any], compared: set[str] | None) -> None:
    mark = out / MARK
    found = sorted(_RESULTS & {entry.name for entry in out.iterdir()})
    if not mark.is_file():
        if found:
            raise ParameterError(
                f"--out must be a new folder or one of `gearlube {mine['study']}`, got {out}, "
                f"where {', '.join(found)} would be mixed with new results. {_CURE}"
            )
        return
    try:
        theirs = json.loads(mark.read_text(encoding="utf-8"))
        study, version = str(theirs["study"]), str(theirs["gearlube_version"])
        before = dict(theirs.get("input", mine["input"]))
    except (OSError, ValueError, KeyError, TypeError):
        study, version, before = "an unknown study", "an unknown version", {}
    if study != mine["study"]:
        raise ParameterError(
            f"--out must be a folder of `gearlube {mine['study']}`, got {out}, which holds results "
            f"of `gearlube {study}`. {_CURE}"
        )
    if version != mine["gearlube_version"]:
        raise ParameterError(
            f"--out must be a folder of gearlube {mine['gearlube_version']}, got {out}, which "
            f"holds results of gearlube {version}. {_CURE}"
        )
    now = mine["input"]
    names = {**before, **now}.keys() & (compared or {**before, **now}.keys())
    pairs = {name: (before.get(name), now.get(name)) for name in sorted(names)}
    other = {name: pair for name, pair in pairs.items() if _key(pair[0]) != _key(pair[1])}
    if found and other:
        words = "; ".join(
            f"{name} was {_said(old)}, now {_said(new)}" for name, (old, new) in other.items()
        )
        raise ParameterError(
            f"--out must be a new folder or one of the same input, got {out}, which holds results "
            f"of another one: {words}. {_CURE}"
        )


def _key(value: Any) -> Any:
    """Return the key by which two inputs are compared: a file may have another name."""
    if isinstance(value, list):
        return [_key(one) for one in value]
    return value.get("sha256") if isinstance(value, dict) else value


def _said(value: Any) -> str:
    if isinstance(value, list):
        return " ".join(map(_said, value))
    if isinstance(value, dict):
        return f"{value.get('file')} (SHA-256 {str(value.get('sha256'))[:8]})"
    return "not given" if value is None else str(value)


def _input() -> dict[str, Any]:
    """Return what the running command was given: values, and hashes of files, by parameter.

    What is not given is left out. Outside a command nothing is given.
    """
    from gearlube.report.inputs import get_current_context  # help does without input files

    context = get_current_context(silent=True)
    given = {} if context is None else context.params
    return {
        name: _content(value)
        for name, value in given.items()
        if name not in _NO_INPUT and value not in (None, False, [], ())
    }


def _content(value: Any) -> Any:
    """Return a value as JSON has it; of a file name and hash, of a folder of results its mark's."""
    if isinstance(value, list | tuple):
        return [_content(one) for one in value]
    if not isinstance(value, str | Path):
        return value
    path = Path(value) / MARK if os.path.isfile(os.path.join(value, MARK)) else Path(value)
    if not os.path.isfile(path):
        return str(value)
    digest = hashlib.sha256()
    for one in _with_named_files(path, []):
        with one.open("rb") as stream:
            digest.update(hashlib.file_digest(stream, "sha256").digest())
    return {"file": path.name, "sha256": digest.hexdigest()}


def _with_named_files(path: Path, found: list[Path]) -> list[Path]:
    """Return a file and, if it is TOML, all files that it names, directly or not."""
    found.append(path)
    if path.suffix.lower() == ".toml":
        for texts in _QUOTED.findall(path.read_text(encoding="utf-8", errors="replace")):
            one = path.parent / "".join(texts)
            if os.path.isfile(one) and one not in found:
                _with_named_files(one, found)
    return found


def _remove_halves(folder: Path) -> None:
    """Remove what runs that were killed have not finished writing."""
    for root, _, names in os.walk(folder):
        for name in filter(_HALF.search, names):
            (Path(root) / name).unlink(missing_ok=True)


def _remove_if_empty(folder: Path) -> bool:
    try:
        folder.rmdir()
    except OSError:
        return not folder.exists()
    return True
