"""Charts of plotly in the style of all figures: lines, stacks, maps, bars.

Each function returns a `plotly.graph_objects.Figure`, to which a study may add. The page gives it
fonts, colours and margins for light, dark and print.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from textwrap import wrap
from typing import Any

import numpy as np

from gearlube.plotting.style import PARTS, SIZES, WIDTHS
from gearlube_core.arrays import Array

COLOURS = PARTS
_SYMBOLS = ("circle", "square", "triangle-up", "diamond", "triangle-down", "cross")
_DASHES = ("solid", "dash", "dot", "dashdot", "longdash", "longdashdot")
_LETTERS = 30  # of a line of a label
_LEVELS = 10  # of a contour map, at most
_LIGHT = 0.55  # of a scale of colours, from which black is legible on it
_MANY = 60  # points of a line, above which they have no markers


@dataclass(frozen=True, slots=True)
class Axis:
    """Name and unit of an axis.

    Parameters
    ----------
    name : str
    unit : str
        Unit behind the axis name; "" for none.
    log : bool
        True for a logarithmic axis.
    """

    name: str
    unit: str = ""
    log: bool = False

    @property
    def label(self) -> str:
        """The label, "vehicle speed [km/h]"; a long one has two lines."""
        words = f"{self.name} [{self.unit}]" if self.unit else self.name
        return "<br>".join(wrap(words, max(_LETTERS, len(words) // 2 + 6)))


@dataclass(frozen=True, slots=True, kw_only=True)
class Line:
    """A line of a chart.

    Parameters
    ----------
    name : str
        Line's text in the legend.
    x, y : sequence of float
        In the units of the axes.
    group : int
        Lines of one group have one colour; None: each its own.
    dash : int
        Number of the dash pattern; 0: solid.
    """

    name: str
    x: Sequence[float] | Array
    y: Sequence[float] | Array
    group: int | None = None
    dash: int = 0


def empty_chart(x: Axis, y: Axis, height: int = 420) -> Any:
    """Return a chart with named axes and nothing in it."""
    import plotly.graph_objects as go

    figure = go.Figure(layout={"template": None, "height": height})
    name_axes(figure, x, y)
    return figure


def name_axes(figure: Any, x: Axis, y: Axis, **place: int) -> None:
    """Name the axes of a chart, or of its panel row=, col=."""
    for update, axis in ((figure.update_xaxes, x), (figure.update_yaxes, y)):
        scale = {"type": "log", "dtick": "D2"} if axis.log else {"type": "linear"}
        update(title_text=axis.label, **scale, **place)


def line_chart(lines: Sequence[Line], x: Axis, y: Axis, height: int = 420) -> Any:
    """Return lines over an axis.

    Examples
    --------
    >>> speed = Axis("vehicle speed", "km/h")
    >>> chart = line_chart(
    ...     [Line(name="order 1", x=[20, 40], y=[0.1, 0.3])], speed, Axis("amplitude", "µm")
    ... )
    >>> chart.layout.yaxis.title.text
    'amplitude [µm]'
    """
    figure = empty_chart(x, y, height)
    for number, line in enumerate(lines):
        add_line(figure, line, number, x, y)
    figure.update_layout(showlegend=len(lines) > 1)
    return figure


def add_line(figure: Any, line: Line, number: int, x: Axis, y: Axis, **place: Any) -> None:
    """Add a line with the look of series `number` to a chart, or to its panel row=, col=."""
    look = number if line.group is None else line.group
    count = len(line.x)
    figure.add_scatter(
        x=_small(line.x),
        y=_small(line.y),
        name=line.name,
        mode="lines" if count > _MANY else "lines+markers",
        line={
            "color": COLOURS[look % len(COLOURS)],
            "width": WIDTHS[look % len(WIDTHS)] + 0.4,
            "dash": _DASHES[line.dash % len(_DASHES)],
        },
        marker={
            "symbol": _SYMBOLS[look % len(_SYMBOLS)]
            + ("-open" if line.dash and count <= _MANY else ""),
            "size": SIZES[look % len(SIZES)] + 2.0,
        },
        hovertemplate=f"%{{y:.4g}} {y.unit} at %{{x:.5g}} {x.unit}<extra>{line.name}</extra>",
        **place,
    )


def stack_chart(
    names: Sequence[str],
    x: Sequence[float] | Array,
    parts: Array,
    x_axis: Axis,
    y_axis: Axis,
    *,
    kept: Sequence[bool] | Array | None = None,
    colours: Sequence[str] = COLOURS,
) -> Any:
    """Return parts that add up, of shape (parts, len(x)), as areas.

    `kept` says which parts are drawn, `colours` the colour of each.
    """
    figure = empty_chart(x_axis, y_axis, 440)
    add_stack(figure, names, x, parts, x_axis, y_axis, kept=kept, colours=colours)
    return figure


def add_stack(
    figure: Any,
    names: Sequence[str],
    x: Sequence[float] | Array,
    parts: Array,
    x_axis: Axis,
    y_axis: Axis,
    *,
    kept: Sequence[bool] | Array | None = None,
    colours: Sequence[str] = COLOURS,
    **place: Any,
) -> None:
    """Add parts that add up to a chart, or to its panel row=, col=.

    A part has the same colour in every panel, and stands in the legend once; `kept` says which
    parts are drawn, `colours` the colour of each.
    """
    already = {one.legendgroup for one in figure.data}
    for number, (name, values) in enumerate(zip(names, parts, strict=True)):
        if kept is not None and not kept[number]:
            continue
        shared: dict[str, Any] = {
            "x": _small(x),
            "y": _small(np.nan_to_num(values)),
            "name": name,
            "legendgroup": name,
            "showlegend": name not in already,
            "hovertemplate": f"%{{y:.4g}} {y_axis.unit} at %{{x}} {x_axis.unit}"
            f"<extra>{name}</extra>",
            **place,
        }
        colour = colours[number % len(colours)]
        figure.add_scatter(
            stackgroup=f"all {place.get('row', 1)}",
            mode="lines",
            line={"width": 0.5, "color": colour},
            fillcolor=colour,
            **shared,
        )
    figure.update_layout(showlegend=True)


def heat_map(
    x: Sequence[float] | Array,
    y: Sequence[float] | Array,
    values: Array,
    axes: tuple[Axis, Axis, Axis],
    *,
    limits: tuple[float, float] | None = None,
    height: int = 460,
) -> Any:
    """Return a map of values of shape (len(y), len(x)); `axes` name x, y and the colour.

    `limits` are the ends of the colour scale, by default those of the values.
    """
    figure = empty_chart(axes[0], axes[1], height)
    add_map(figure, x, y, values, axes, limits=limits)
    return figure


def add_map(
    figure: Any,
    x: Sequence[float] | Array,
    y: Sequence[float] | Array,
    values: Array,
    axes: tuple[Axis, Axis, Axis],
    *,
    limits: tuple[float, float] | None = None,
    contours: bool = False,
    bar: bool = True,
    **place: Any,
) -> None:
    """Add a map to a chart, or to its panel row=, col=; `bar`: with its scale of colours.

    `contours`: levels with numbers in place of cells.
    """
    import plotly.graph_objects as go

    low, high = limits or (float(np.nanmin(values)), float(np.nanmax(values)))
    looks: dict[str, Any] = {
        "x": _small(x),
        "y": _small(y),
        "z": _small(values),
        "zmin": low,
        "zmax": high,
        "colorscale": "Cividis",
        "showscale": bar,
        "colorbar": {
            "title": {"text": axes[2].label, "side": "right"},
            "thickness": 14,
            "len": 0.95,
        },
        "hovertemplate": f"%{{z:.4g}} {axes[2].unit} at %{{x:.5g}} {axes[0].unit}, "
        f"%{{y:.5g}} {axes[1].unit}<extra></extra>",
    }
    if not contours:
        figure.add_trace(go.Heatmap(**looks), **place)
        return
    size = _round_step((high - low) / _LEVELS)
    light = low + _LIGHT * (high - low)
    first, change, last = (size * np.ceil(value / size) for value in (low, light, high))
    looks["contours"] = {"start": first, "end": last, "size": size, "showlines": False}
    figure.add_trace(go.Contour(**looks), **place)
    for start, end, ink in ((first, change - size, "white"), (change, last, "black")):
        lines = {"start": start, "end": end + 0.01 * size, "size": size, "coloring": "none"}
        lines |= {"showlabels": True, "labelfont": {"size": 11, "color": ink}}
        own = {name: looks[name] for name in ("x", "y", "z")}
        look = {"contours": lines, "line": {"width": 0.7, "color": ink}, "hoverinfo": "skip"}
        figure.add_trace(go.Contour(**own, **look, showscale=False, showlegend=False), **place)


def _round_step(step: float) -> float:
    """Return the next of 1, 2, 5, 10, 20 and so on that is not smaller."""
    tens = 10.0 ** np.floor(np.log10(step)) if step > 0.0 else 1.0
    return float(next(tens * one for one in (1.0, 2.0, 5.0, 10.0) if tens * one >= 0.999 * step))


def bar_chart(names: Sequence[str], values: Sequence[float] | Array, axis: Axis) -> Any:
    """Return level bars, the first name on top."""
    figure = empty_chart(axis, Axis(""), height=max(220, 36 * len(names) + 110))
    figure.add_bar(
        x=_small(values),
        y=list(names),
        orientation="h",
        marker_color=COLOURS[0],
        hovertemplate=f"%{{x:.4g}} {axis.unit}<extra>%{{y}}</extra>",
    )
    figure.update_yaxes(autorange="reversed", type="category")
    return figure


def panels(titles: Sequence[str], x: Axis, y: Sequence[Axis], height: int = 320) -> Any:
    """Return a chart with a panel for each title, one below the other, over the same axis.

    Traces go to a panel by row=1, 2, ... and col=1. A phone shows them as well as a wide screen.
    """
    from plotly.subplots import make_subplots

    count = len(titles)
    figure = make_subplots(
        rows=count,
        cols=1,
        shared_xaxes=True,
        subplot_titles=list(titles),
        vertical_spacing=0.16 / count,
    )
    figure.update_layout(template=None, height=height * count + 80)
    figure.update_annotations(x=0.0, xanchor="left", font_size=13)
    for row, axis in enumerate(y, 1):
        name_axes(figure, x, axis, row=row, col=1)
        if row < count:
            figure.update_xaxes(title_text="", row=row, col=1)
    return figure


def mark_level(figure: Any, value: float, text: str, *, across: bool = True, **place: Any) -> None:
    """Draw a named dotted line at a value of the y axis, or of the x axis if not `across`."""
    add = figure.add_hline if across else figure.add_vline
    add(
        value,
        line={"dash": "dot", "width": 1.2, "color": "#808080"},
        annotation={"text": text, "font": {"size": 11}},
        annotation_position="top right" if across else "top",
        **place,
    )


def _small(values: Any) -> Array:
    """Return values as 32 bit floats: half the size in the file, seven digits."""
    return np.asarray(values, dtype=np.float32)
