"""The shipped example of measured gears: a measured-gear file and its tables."""

from __future__ import annotations

from pathlib import Path

from gearlube_core.errors import ParameterError
from gearlube_core.storage.atomic_file import write_text

EXAMPLE = Path(__file__).parents[1] / "data" / "measured"


def write_example(folder: Path) -> tuple[Path, ...]:
    """Write the example into a folder; return the files, the measured-gear file first.

    Raises
    ------
    ParameterError
        One of the files is there already. Nothing is written then.
    """
    shipped = sorted(EXAMPLE.iterdir(), key=lambda file: (file.suffix != ".toml", file.name))
    written = tuple(folder / file.name for file in shipped)
    there = [str(path) for path in written if path.exists()]
    if there:
        raise ParameterError(
            f"--example must be a folder without these files, got {', '.join(there)}. Choose "
            "another folder."
        )
    folder.mkdir(parents=True, exist_ok=True)
    for source, path in zip(shipped, written, strict=True):
        write_text(source.read_text(encoding="utf-8"), path)
    return written
