"""Figures as files: the folder of a study's figures, and animated pictures."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from io import BytesIO
from pathlib import Path
from typing import Any

from gearlube_core.progress import Progress, no_progress
from gearlube_core.storage.atomic_file import atomic_write, write_figure


def save_figure_folder(figures: Mapping[str, Any], folder: Path) -> list[Path]:
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
        write_figure(figure, path)
    return paths


def save_animation(
    draw: Callable[[int], Any],
    count: int,
    path: Path | str,
    *,
    first: int = 0,
    per_second: int = 12,
    dots_per_inch: int = 80,
    progress: Progress = no_progress,
) -> Path:
    """Write `count` figures as an animated GIF; return the file, which appears whole or not at all.

    Parameters
    ----------
    draw : callable
        Returns figure number k, 0 to count - 1.
    first : int
        The figure whose colours all pictures have, so that none of them flickers.
    per_second : int
        Frame rate [1/s].
    """
    from PIL import Image

    palette = None
    pictures = {}
    for done, k in enumerate([first, *(k for k in range(count) if k != first)], 1):
        buffer = BytesIO()
        draw(k).savefig(buffer, format="png", dpi=dots_per_inch)
        buffer.seek(0)
        picture = Image.open(buffer).convert("RGB")
        if palette is None:
            palette = picture.quantize(256)
        pictures[k] = picture.quantize(palette=palette, dither=Image.Dither.NONE)
        progress(done / count, f"animation, picture {done} of {count}")
    path = Path(path)
    with atomic_write(path) as partial:
        pictures[0].save(
            partial,
            format="GIF",
            save_all=True,
            append_images=[pictures[k] for k in range(1, count)],
            duration=round(1000 / per_second),
            loop=0,
        )
    return path
