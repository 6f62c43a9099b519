"""Rough films in motion as an animated picture."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import xarray as xr

from gearlube.plotting.animation import save_animation
from gearlube.studies.films.figures.rough import loaded_film, rough_frame
from gearlube_core.errors import ParameterError
from gearlube_core.progress import Progress, no_progress

FEWEST = 2  # films


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
        Pictures a second.
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
