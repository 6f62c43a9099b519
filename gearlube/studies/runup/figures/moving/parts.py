"""An animation as parts of the report, and as files beside it."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

import xarray as xr

from gearlube.report.parts import Figure
from gearlube.studies.runup.animation.dataset import animation_file
from gearlube.studies.runup.figures.moving import flanks, rollers, words
from gearlube.studies.runup.figures.moving.charts import flank_chart, roller_chart
from gearlube_core.progress import Progress, no_progress, part_of


class Moving(NamedTuple):
    """Something in motion: its names, what to see in it, how it is drawn."""

    name: str
    title: str
    caption: str
    shown: Callable[[xr.Dataset], bool]
    sentence: Callable[[xr.Dataset], str]
    chart: Callable[[xr.Dataset], Any]
    animate: Callable[[xr.Dataset, Path, Progress], Path]


MOVING = (
    Moving(
        name="flanks",
        title="Flanks in motion",
        caption="Each ellipse is the contact of one tooth pair on the drawn gear tooth, in the "
        "colour of its film, with its load. Below: load, film and friction of the three pairs, in "
        "the colours of the outlines. Film and friction follow from load and speeds of each "
        "instant.",
        shown=lambda dataset: True,
        sentence=words.flank_sentence,
        chart=flank_chart,
        animate=flanks.animate_flanks,
    ),
    Moving(
        name="rollers",
        title="Rollers in motion",
        caption="Bars outwards: load of each roller, each bearing on its own scale. Colour: film, "
        "one scale for all. Thick arc: where rollers carry load. The rollers go round with the "
        "cage; the black one is number 1. Axes are those of the fixed frame.",
        shown=rollers.has_rollers,
        sentence=words.roller_sentence,
        chart=roller_chart,
        animate=rollers.animate_rollers,
    ),
)


def moving_figures(dataset: xr.Dataset, before: str = "") -> list[Figure]:
    """Return the figures of an animation for a report; `before` stands before their titles."""
    at = (
        f"At {words.heading(dataset)}, over {dataset.attrs['mesh_periods']} mesh periods from "
        f"{dataset.attrs['ramp_time']:.3g} s of the ramp on."
    )
    return [
        Figure(
            name=f"{dataset.attrs['ramp'].replace('-', '')}_{one.name}_moving",
            title=before + (one.title[0].lower() + one.title[1:] if before else one.title),
            caption=f"{one.sentence(dataset)} {at} {one.caption}",
            chart=one.chart(dataset),
        )
        for one in MOVING
        if one.shown(dataset)
    ]


def save_moving(
    dataset: xr.Dataset, folder: Path | str, progress: Progress = no_progress
) -> list[Path]:
    """Write an animation as GIF files into FOLDER/animation; return them.

    Examples
    --------
    >>> save_moving(load_animation("my_runup/animation/runup.nc"), "my_runup")  # doctest: +SKIP
    [PosixPath('my_runup/animation/runup_flanks.gif'), ...]
    """
    data = animation_file(folder, dataset.attrs["ramp"])
    data.parent.mkdir(parents=True, exist_ok=True)
    shown = [one for one in MOVING if one.shown(dataset)]
    return [
        one.animate(
            dataset,
            data.with_name(f"{data.stem}_{one.name}.gif"),
            part_of(progress, k / len(shown), (k + 1) / len(shown)),
        )
        for k, one in enumerate(shown)
    ]
