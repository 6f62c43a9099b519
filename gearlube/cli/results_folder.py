"""Folder of results of a command: checked before anything is computed, marked with its owner."""

from __future__ import annotations

import json
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryFile

from gearlube_core import __version__
from gearlube_core.errors import ParameterError

MARK = "gearlube_results.json"  # says which study wrote a folder, and which version
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
    """Make a folder that can be written; if the command fails, leave no empty one behind.

    Raises
    ------
    ParameterError
        A file is in the way, or nothing can be written there.
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
        yield
    except BaseException:
        for folder in made:
            if not _remove_if_empty(folder):
                break
        raise


@contextmanager
def results_folder(out: Path, study: str, *, overwrite: bool = False) -> Iterator[None]:
    """Make a study's folder of results and mark it; see `written_folder`.

    Parameters
    ----------
    out : Path
    study : str
        The command as typed after `gearlube`.
    overwrite : bool
        Also write into a folder of another study or version.

    Raises
    ------
    ParameterError
        The folder holds results of another study or version, or cannot be written.
    """
    from gearlube_core.storage.atomic_file import write_text  # help does without NumPy

    with written_folder(out):
        mark, mine = out / MARK, {"study": study, "gearlube_version": __version__}
        marked = mark.is_file()
        if not overwrite:
            _check_owner(out, mine)
        write_text(json.dumps(mine) + "\n", mark)
        try:
            yield
        except BaseException:
            if not marked and {entry.name for entry in out.iterdir()} == {MARK}:
                mark.unlink()
            raise


def _check_owner(out: Path, mine: dict[str, str]) -> None:
    mark = out / MARK
    if not mark.is_file():
        found = sorted(_RESULTS & {entry.name for entry in out.iterdir()})
        if found:
            raise ParameterError(
                f"--out must be a new folder or one of `gearlube {mine['study']}`, got {out}, "
                f"where {', '.join(found)} would be mixed with new results. {_CURE}"
            )
        return
    try:
        theirs = json.loads(mark.read_text(encoding="utf-8"))
        study, version = str(theirs["study"]), str(theirs["gearlube_version"])
    except (OSError, ValueError, KeyError, TypeError):
        study, version = "an unknown study", "an unknown version"
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


def _remove_if_empty(folder: Path) -> bool:
    try:
        folder.rmdir()
    except OSError:
        return not folder.exists()
    return True
