"""The folder of a study's figures."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from gearlube_core.storage.atomic_file import write_figure


def save_figure_folder(figures: Mapping[str, Any], folder: Path, dpi: int = 150) -> list[Path]:
    """Write figures by name as PNG and return the files; what an earlier run drew does not stay.

    Without figures there is no folder after.
    """
    paths = [folder / f"{name}.png" for name in figures]
    for old in set(folder.glob("*.png")) - set(paths):
        old.unlink()
    if figures:
        folder.mkdir(parents=True, exist_ok=True)
    elif folder.is_dir() and not any(folder.iterdir()):
        folder.rmdir()
    for figure, path in zip(figures.values(), paths, strict=True):
        write_figure(figure, path, dpi)
    return paths
