"""The animation of a rough march, from its kept films."""

from __future__ import annotations

from pathlib import Path

import xarray as xr

from gearlube.studies.films.figures.rough_animation import FEWEST, save_rough_animation
from gearlube.studies.films.rough.files import read_frames
from gearlube_core.ehl.case.rough_case import RoughCase
from gearlube_core.errors import ParameterError
from gearlube_core.progress import Progress, no_progress

ANIMATION = "animation.gif"
MOST = 240  # pictures; of more films as many are taken, evenly


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
