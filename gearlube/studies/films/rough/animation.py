"""The animation of a rough march, from its kept films."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import xarray as xr

from gearlube.plotting.figure_files import save_animation
from gearlube.studies.films.figures.rough import loaded_film, rough_frame
from gearlube.studies.films.rough.files import read_frames
from gearlube_core.ehl.case.rough_case import RoughCase
from gearlube_core.errors import ParameterError
from gearlube_core.progress import Progress, no_progress

FEWEST = 2  # films
ANIMATION = "animation.gif"
MOST = 240  # pictures; of more films as many are taken, evenly


def save_rough_animation(
    frames: xr.Dataset,
    path: Path | str,
    *,
    per_second: int = 12,
    dots_per_inch: int = 80,
    progress: Progress = no_progress,
) -> Path:
    """Write frames over `time` as an animated GIF with one scale of colours; return the file.

    Parameters
    ----------
    frames
        `film` [m] and `pressure` [Pa] over `time` [s], `x` and `y` [m], two films at least.
    path
        GIF file; it appears whole or not at all.
    per_second
        Frame rate [1/s].
    dots_per_inch
        A picture is 8.5 by 7 inches.
    progress
        Called with the share done and what is done now.

    Raises
    ------
    ParameterError
        Fewer than two films.

    Examples
    --------
    >>> save_rough_animation(frames, "film.gif")  # doctest: +SKIP
    """
    count = frames.sizes.get("time", 1)
    if count < FEWEST:
        raise ParameterError(
            f"frames must hold at least {FEWEST} films over time, got {count}. Keep more films: "
            "[frames] every."
        )
    highest = float(frames["pressure"].max())
    at = frames.transpose("time", "y", "x")
    thickest = max(
        loaded_film(film, pressure)
        for film, pressure in zip(at["film"].values, at["pressure"].values, strict=True)
    )
    # colours are those of the picture with the highest pressure
    first = int(np.argmax(at["pressure"].max(("x", "y")).values))
    return save_animation(
        lambda k: rough_frame(frames.isel(time=k), highest, thickest),
        count,
        path,
        first=first,
        per_second=per_second,
        dots_per_inch=dots_per_inch,
        progress=progress,
    )


def check_animation(case: RoughCase, steps: int | None = None) -> None:
    """Refuse a march that will keep too few films for an animation.

    Raises
    ------
    ParameterError
        Fewer than two films are kept up to the last step.
    """
    last = case.schedule().steps if steps is None else steps
    kept = sum(1 for step in case.kept_steps() if step <= last)
    if kept < FEWEST:
        raise ParameterError(
            f"[frames] must keep at least {FEWEST} films for an animation, got {kept} up to step "
            f"{last}. Set every in [frames], for example every = {max(last // 50, 1)}."
        )


def write_animation(case: RoughCase, folder: Path, progress: Progress = no_progress) -> Path:
    """Draw the kept films of a march as an animated picture; return the file.

    Raises
    ------
    ParameterError
        There are fewer than two kept films, or one is damaged or of another case.
    """
    films = xr.concat(list(read_frames(folder, case.key(), MOST)), "time")
    return save_rough_animation(films, folder / ANIMATION, progress=progress)
