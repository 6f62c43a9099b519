"""An animation as parts of the report, and as files beside it."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import xarray as xr

from gearlube.report.moving import steering
from gearlube.report.numbers import quantity_text
from gearlube.report.parts import Figure
from gearlube.studies.runup.animation.dataset import animation_file
from gearlube.studies.runup.figures.moving import pictures, words
from gearlube_core.arrays import Array
from gearlube_core.progress import Progress, no_progress, part_of

_FRAME_MS = 110
_TOOTH_HEIGHT, _COURSE_HEIGHT, _RING_HEIGHT = 330, 190, 370  # px
_ROOM_ABOVE, _ROOM_BELOW, _BAR_HEIGHT = 40, 120, 60  # px
_COLOURS = "Viridis"
_GREY = "#808080"


class Moving(NamedTuple):
    """Something in motion: its names, what to see in it, how it is drawn."""

    name: str
    title: str
    caption: str
    shown: Callable[[xr.Dataset], bool]
    sentence: Callable[[xr.Dataset], str]
    chart: Callable[[xr.Dataset], Any]
    animate: Callable[[xr.Dataset, Path, Progress], Path]


def _moved(
    figure: Any,
    frames: list[tuple[str, list[Any]]],
    start: int,
    height: int,
    above: int = 0,
    below: int = 0,
) -> Any:
    """Return a chart whose last traces go through frames; more room [px] `above` and `below`."""
    import plotly.graph_objects as go

    places = list(range(start, len(figure.data)))
    figure.frames = [go.Frame(name=name, data=data, traces=places) for name, data in frames]
    layout = steering([name for name, _ in frames], "mesh phase", frame_ms=_FRAME_MS)
    layout["margin"] = {"l": 60, "r": 10, "t": _ROOM_ABOVE + above, "b": _ROOM_BELOW + below}
    layout["sliders"][0] |= {"pad": {"t": 60 + below, "b": 10}, "x": 0.0, "len": 1.0}
    layout["updatemenus"][0] |= {"y": 1.0, "yanchor": "bottom", "pad": {"b": 6 + above}}
    figure.update_layout(
        template=None, height=height + _ROOM_ABOVE + above + _ROOM_BELOW + below, **layout
    )
    return figure


def _ring(
    dataset: xr.Dataset, k: int, frame: int, ends: tuple[float, float] | None
) -> tuple[Any, Any]:
    """Return the bars of a bearing in a frame, and its rollers on the cage."""
    import plotly.graph_objects as go

    ring = pictures.ring_at(dataset, k, frame)
    hub = pictures.HUB * (ring.top or 1.0)
    width = pictures.WIDTH * 360.0 / ring.angle.size
    theta = _small(np.degrees(ring.angle))
    marker: dict[str, Any] = {"color": "#0072B2", "line": {"color": "#606060", "width": 0.5}}
    listed = "%{customdata[0]:.0f} N"
    if ends is not None:
        marker |= {"color": _small(np.nan_to_num(ring.film, nan=ends[0])), "colorscale": _COLOURS,
                   "cmin": ends[0], "cmax": ends[1]}  # fmt: skip
        listed += ", film %{customdata[1]:.3f} µm"
    bars = go.Barpolar(
        r=_small(ring.load), theta=theta, base=hub, width=width, marker=marker,
        customdata=_small(np.stack([ring.load, ring.film], 1)),
        hovertemplate=f"{listed}<extra></extra>",
    )  # fmt: skip
    first = np.arange(ring.angle.size) == 0
    cage = go.Scatterpolar(
        r=_small(np.full(ring.angle.size, hub)), theta=theta, mode="markers", hoverinfo="skip",
        marker={"color": ["black" if one else "white" for one in first],
                "size": [9 if one else 6 for one in first],
                "line": {"color": "#606060", "width": 1}},
    )  # fmt: skip
    return bars, cage


def _contacts(dataset: xr.Dataset, frame: int) -> list[Any]:
    """Return the contacts of a frame in the colours of their films, and their loads."""
    import plotly.graph_objects as go

    load = dataset["flank_load"].values[frame]
    traces = []
    for pair, colour in enumerate(pictures.PAIR_COLOURS):
        x, y = pictures.outline(dataset, frame, pair) if np.isfinite(load[pair]) else ([], [])
        film = 1e6 * float(dataset["flank_film"][frame, pair])
        traces.append(
            go.Scatter(
                x=_small(x), y=_small(y), mode="lines", fill="toself",
                line={"color": colour, "width": 2.5},
                fillcolor=_colour(film, pictures.flank_film_scale(dataset)),
                hoverinfo="skip",
            )
        )  # fmt: skip
    loaded = np.flatnonzero(np.isfinite(load))
    tooth = pictures.drawn_tooth(dataset)
    beside = 0.1 * tooth.height
    sides = [pictures.label_side(dataset, frame, int(pair)) for pair in loaded]
    x, y = 1e3 * dataset["flank_centre"].values[frame, loaded].T
    x = x + beside * np.array(sides)
    y = np.minimum(y + beside, 0.96 * tooth.height)  # a label outside the axes is not drawn
    texts = [f"<b>{quantity_text(float(load[pair]), 'N')}</b>" for pair in loaded]
    traces.append(
        go.Scatter(x=_small(x), y=_small(y), mode="text", text=texts, hoverinfo="skip",
                   textposition=["top right" if one > 0 else "top left" for one in sides],
                   cliponaxis=False,
                   textfont={"color": [pictures.PAIR_COLOURS[pair] for pair in loaded]})
    )  # fmt: skip
    return traces


def _roller_chart(dataset: xr.Dataset) -> Any:
    """Return the rings of rollers, two beside each other, with loads as bars outwards."""
    from plotly.subplots import make_subplots

    count = dataset.sizes["ring"]
    titles = ["<br>".join(filter(None, pictures.ring_title(dataset, k))) for k in range(count)]
    rows = (count + 1) // 2
    figure = make_subplots(
        rows=rows, cols=2, specs=[[{"type": "polar"}] * 2] * rows, subplot_titles=titles,
        vertical_spacing=0.17, horizontal_spacing=0.1,
    )  # fmt: skip
    figure.update_annotations(font_size=11.5, yshift=22)
    ends = pictures.roller_film_scale(dataset)
    for k in range(count):
        _ring_frame(figure, dataset, k)
    if ends is not None:
        _film_bar(figure, dataset, ends)
    start = len(figure.data)
    frames = []
    for frame in range(dataset.sizes["frame"]):
        traces = [one for k in range(count) for one in _ring(dataset, k, frame, ends)]
        frames.append((words.instant(dataset, frame), traces))
    for number, trace in enumerate(frames[0][1]):
        ring = number // 2
        figure.add_trace(trace, row=ring // 2 + 1, col=ring % 2 + 1)
    for _, traces in frames:
        for number, trace in enumerate(traces):
            trace.subplot = figure.data[start + number].subplot
    below = 0 if ends is None else _BAR_HEIGHT
    return _moved(figure, frames, start, rows * _RING_HEIGHT, above=80, below=below)


def _flank_chart(dataset: xr.Dataset) -> Any:
    """Return the contacts on the tooth over load, film and friction of the tooth pairs."""
    from plotly.subplots import make_subplots

    placed = pictures.has_places(dataset)
    heights = [_TOOTH_HEIGHT] * placed + [_COURSE_HEIGHT] * len(pictures.COURSES)
    figure = make_subplots(
        rows=len(heights), cols=1, row_heights=heights, vertical_spacing=0.32 / len(heights)
    )
    first = 1 + placed
    if placed:
        _tooth(figure, dataset)
    _courses(figure, dataset, first)
    frames = []
    for frame in range(dataset.sizes["frame"]):
        now = [*(_contacts(dataset, frame) if placed else ()), *_now(dataset, frame)]
        name = words.instant(dataset, frame)
        if not words.one_flank(dataset):
            name += f", {words.flank_of(dataset, frame)}"
        frames.append((name, now))
    start = len(figure.data)
    rows = [1] * (len(frames[0][1]) - len(pictures.COURSES))
    rows += [first + k for k in range(len(pictures.COURSES))]
    for trace, row in zip(frames[0][1], rows, strict=True):
        figure.add_trace(trace, row=row, col=1)
    _name_rows(figure, dataset, first)
    return _moved(figure, frames, start, sum(heights), above=24 * placed)


def _now(dataset: xr.Dataset, frame: int) -> list[Any]:
    """Return a mark at the frame on every course."""
    import plotly.graph_objects as go

    phase = float(dataset["mesh_phase"][frame])
    marker = {"color": list(pictures.PAIR_COLOURS), "size": 10}
    return [
        go.Scatter(x=_small([phase] * len(pictures.PAIR_COLOURS)),
                   y=_small(factor * dataset[name].values[frame]),
                   mode="markers", marker=marker, hoverinfo="skip")
        for name, factor, _, _ in pictures.COURSES
    ]  # fmt: skip


def _small(values: Any) -> Array:
    """Return values as 32 bit floats: half the size in the file, seven digits."""
    return np.asarray(values, dtype=np.float32)


def _name_rows(figure: Any, dataset: xr.Dataset, first: int) -> None:
    if first > 1:
        tooth = pictures.drawn_tooth(dataset)
        figure.update_xaxes(
            title_text="along the face [mm]", range=[0.0, tooth.width], showgrid=False,
            zeroline=False, constrain="domain", row=1, col=1,
        )  # fmt: skip
        figure.update_yaxes(
            title_text="height [mm]", range=[0.0, tooth.height], showgrid=False,
            zeroline=False, scaleanchor="x", constrain="domain", row=1, col=1,
        )  # fmt: skip
    phase = dataset["mesh_phase"].values
    for k, (name, factor, label, unit) in enumerate(pictures.COURSES):
        figure.update_yaxes(
            title_text=f"{label} [{unit}]" if unit else label,
            range=[0.0, pictures.course_limit(dataset, name, factor)], row=first + k, col=1,
        )  # fmt: skip
        ends = [-0.03, float(phase[-1]) + 0.03]  # marks at the ends are seen whole
        figure.update_xaxes(range=ends, row=first + k, col=1)
    figure.update_xaxes(title_text="mesh phase", row=first + len(pictures.COURSES) - 1, col=1)


def _courses(figure: Any, dataset: xr.Dataset, first: int) -> None:
    """Draw load, film and friction of every tooth pair over the mesh phase."""
    phase = dataset["mesh_phase"].values
    for k, (name, factor, label, unit) in enumerate(pictures.COURSES):
        for pair, colour in enumerate(pictures.PAIR_COLOURS):
            figure.add_scatter(
                x=_small(phase), y=_small(factor * dataset[name].values[:, pair]), mode="lines",
                line={"color": colour, "width": 2},
                hovertemplate=f"%{{y:.3g}} {unit} at %{{x:.2f}}<extra>{label}, pair {pair + 1}"
                "</extra>",
                row=first + k, col=1,
            )  # fmt: skip


def _tooth(figure: Any, dataset: xr.Dataset) -> None:
    """Draw the outline of the tooth and the scale of the films."""
    tooth = pictures.drawn_tooth(dataset)
    w, h = tooth.width, tooth.height
    figure.add_scatter(
        x=[0.0, w, w, 0.0, 0.0], y=[0.0, 0.0, h, h, 0.0], mode="lines",
        line={"color": _GREY, "width": 2}, hoverinfo="skip", row=1, col=1,
    )  # fmt: skip
    for x, y, name, shift in (
        (0.0, h, "toe", {"yshift": 9, "xanchor": "left"}),
        (w, h, "heel", {"yshift": 9, "xanchor": "right"}),
        (w, 0.93 * h, "tip", {"xshift": -3, "xanchor": "right"}),
        (w, 0.07 * h, "root", {"xshift": -3, "xanchor": "right"}),
    ):
        figure.add_annotation(x=x, y=y, text=name, showarrow=False, row=1, col=1, **shift)
    low, high = pictures.flank_film_scale(dataset)
    bar = {"title": {"text": "film<br>[µm]", "side": "top"}, "thickness": 10, "len": 0.36,
           "y": 1.03, "yanchor": "top", "xpad": 4}  # fmt: skip
    figure.add_scatter(
        x=[None], y=[None], mode="markers", hoverinfo="skip", row=1, col=1,
        marker={"color": [low], "cmin": low, "cmax": high, "colorscale": _COLOURS,
                "showscale": True, "colorbar": bar},
    )  # fmt: skip


def _film_bar(figure: Any, dataset: xr.Dataset, ends: tuple[float, float]) -> None:
    law = dataset.attrs["roller_film_law"]
    bar = {"title": {"text": f"film [µm], {law}", "side": "top"}, "orientation": "h",
           "thickness": 12, "len": 0.8, "y": -0.01, "yanchor": "top", "x": 0.5}  # fmt: skip
    figure.add_scatterpolar(
        r=[None], theta=[None], mode="markers", hoverinfo="skip", row=1, col=1,
        marker={"color": [ends[0]], "cmin": ends[0], "cmax": ends[1], "colorscale": _COLOURS,
                "showscale": True, "colorbar": bar},
    )  # fmt: skip


def _ring_frame(figure: Any, dataset: xr.Dataset, k: int) -> None:
    """Draw the loaded zone of a bearing, and its axes."""
    ring = pictures.ring_at(dataset, k, 0)
    top = ring.top or 1.0
    place = {"row": k // 2 + 1, "col": k % 2 + 1}
    for begin, end in zip(*ring.zone, strict=True):
        arc = np.degrees(np.linspace(begin, end, 61))
        figure.add_scatterpolar(
            r=_small(np.full(arc.size, 0.8 * pictures.HUB * top)), theta=_small(arc), mode="lines",
            line={"color": _GREY, "width": 4}, hoverinfo="skip", **place,
        )  # fmt: skip
    figure.update_polars(
        bgcolor="rgba(0,0,0,0)",
        radialaxis={"range": [0.0, (pictures.HUB + pictures.REACH) * top], "visible": False},
        angularaxis={"tickmode": "array", "tickvals": [0, 90],
                     "ticktext": list(words.AXES[ring.number]), "gridcolor": "rgba(0,0,0,0)"},
        **place,
    )  # fmt: skip


def _colour(value: float, ends: tuple[float, float]) -> str:
    """Return the colour of a value on the scale."""
    from plotly.colors import sample_colorscale

    if not np.isfinite(value):
        return "rgba(0,0,0,0)"
    part = min(max((value - ends[0]) / (ends[1] - ends[0]), 0.0), 1.0)
    return str(sample_colorscale(_COLOURS, [part])[0])


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
        chart=_flank_chart,
        animate=pictures.animate_flanks,
    ),
    Moving(
        name="rollers",
        title="Rollers in motion",
        caption="Bars outwards: load of each roller, each bearing on its own scale. Colour: film, "
        "one scale for all. Thick arc: where rollers carry load. The rollers go round with the "
        "cage; the black one is number 1. Axes are those of the fixed frame.",
        shown=pictures.has_rollers,
        sentence=words.roller_sentence,
        chart=_roller_chart,
        animate=pictures.animate_rollers,
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
