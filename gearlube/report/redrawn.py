"""Figures of matplotlib as charts of plotly: each figure is described once, as a picture."""

from __future__ import annotations

import re
from collections.abc import Sequence
from itertools import chain
from textwrap import wrap
from typing import Any

import numpy as np

from gearlube.report.marks import (
    PX,
    PictureOnly,
    bars,
    collection,
    colour,
    joined,
    line_look,
    named,
    pattern,
    plain,
)

_INCH = 84.0  # px of a chart's height for an inch of the picture's
_LETTER, _MARGIN, _WIDE = 6.4, 12, 1000  # px; the last about the width of a chart
_GAP, _BARE_GAP = 0.3, 0.16  # below a panel with and without a label, of a row
_BESIDE = 0.09  # of the width, between panels
_LETTERS, _LONG, _TITLE = 30, 44, 90  # of a line of a label of y and of x, and of a title
_ASIDE = 7.0  # px
_TICKS = 6  # of a logarithmic axis, about
_DECADES = 2.0  # of an axis, above which only powers of ten are labelled
_ANCHORS = {"baseline": "bottom", "center": "middle", "center_baseline": "middle"}


def redrawn(figure: Any) -> Any:
    """Return a figure of matplotlib as a chart; None if it has parts that only a picture shows.

    Panels keep their places on a wide page; on a phone the page lays them one below the other.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> figure = Figure()
    >>> line = figure.subplots().plot([1, 2], [3, 5], label="order 1")
    >>> redrawn(figure).data[0].name
    'order 1'
    """
    import plotly.graph_objects as go

    axes = [ax for ax in figure.axes if not hasattr(ax, "_colorbar") and ax.get_visible()]
    axes = [ax for ax in axes if ax.axison and (ax.has_data() or len(_twins(ax)) == 1)]
    second = [ax for i, ax in enumerate(axes) if set(_twins(ax)) & set(axes[:i])]
    first = [ax for ax in axes if ax not in second]
    chart = go.Figure(layout={"template": None, "height": int(_INCH * figure.get_figheight()) + 60})
    try:
        _lay_out(chart, first)
        for number, ax in enumerate(second, len(first) + 1):
            _lay_over(chart, first, ax, number)
        for number, ax in enumerate([*first, *second], 1):
            _add_panel(chart, ax, "" if number == 1 else str(number))
    except PictureOnly:
        return None
    if figure.get_suptitle():
        lines = _lines(figure.get_suptitle(), _TITLE)
        look = {"showarrow": False, "xanchor": "left", "yanchor": "bottom", "align": "left"}
        chart.add_annotation(
            text="<br>".join(lines),
            x=0,
            y=1,
            xref="paper",
            yref="paper",
            xshift=-40,
            yshift=20,
            **look,
        )
        chart.layout.margin.t = 34 + 17 * len(lines)
    if room := chart.layout.margin.r:  # names beside the axes, then the scale of colours
        chart.update_traces(colorbar_x=1.0 + room / _WIDE, selector={"type": "heatmap"})
    legends = [*figure.legends, *(ax.get_legend() for ax in axes)]
    _add_legend(chart, [one for one in legends if one is not None])
    return chart


def _lay_out(chart: Any, axes: Sequence[Any]) -> None:
    """Place and name the axes."""
    if not axes or any(ax.get_subplotspec() is None for ax in axes):
        raise PictureOnly
    specs = [ax.get_subplotspec().get_topmost_subplotspec() for ax in axes]
    for ax, spec in zip(axes, specs, strict=True):
        scales = {ax.get_xscale(), ax.get_yscale()}
        if ax.name != "rectilinear" or not scales <= {"linear", "log"}:
            raise PictureOnly
        if spec.get_gridspec() is not specs[0].get_gridspec() or specs.count(spec) > 1:
            raise PictureOnly
    grid = specs[0].get_gridspec()
    shares = np.asarray(grid.get_height_ratios(), dtype=float)
    bottoms = np.maximum(1.0 - np.cumsum(shares / shares.sum()), 0.0)
    tops = np.concatenate([[1.0], bottoms[:-1]])
    labelled = any(
        ax.get_xlabel() for ax, s in zip(axes, specs, strict=True) if not s.is_last_row()
    )
    gap = (_GAP if labelled else _BARE_GAP) / grid.nrows
    wide = (1.0 + _BESIDE) / grid.ncols
    for number, (ax, spec) in enumerate(zip(axes, specs, strict=True), 1):
        name = "" if number == 1 else str(number)
        rows, cols = spec.rowspan, spec.colspan
        below = 0.0 if spec.is_last_row() else gap
        first = axes[next(i for i, s in enumerate(specs) if s.rowspan.start == rows.start)]
        of_row = first.get_ylabel() or ax.get_figure().get_supylabel()
        label = ax.get_ylabel() or (of_row if len(of_row) <= _LONG else "")
        shown = ax.xaxis.get_tick_params().get("labelbottom", True)
        chart.layout[f"xaxis{name}"] = {
            **_axis(ax.xaxis, ax.get_xlim(), ax.get_xlabel(), _LONG),
            "domain": [cols.start * wide, cols.stop * wide - _BESIDE],
            "anchor": f"y{name}",
            "showticklabels": shown,
        }
        chart.layout[f"yaxis{name}"] = {
            **_axis(ax.yaxis, ax.get_ylim(), label, _LETTERS),
            "domain": [bottoms[rows.stop - 1] + below, tops[rows.start]],
            "anchor": f"x{name}",
        }
        if number > 1 and ax.get_shared_x_axes().joined(ax, axes[0]):
            chart.layout[f"xaxis{name}"].matches = "x"
        if title := ax.get_title() or ax.get_title(loc="left"):
            look = {"xanchor": "left", "yanchor": "bottom", "showarrow": False, "font_size": 13}
            chart.add_annotation(text=plain(title), x=0, y=1, **_refs(name, False, False), **look)
    chart.layout.meta = {
        "columns": grid.ncols,
        "places": [[s.rowspan.start, s.colspan.start] for s in specs],
    }


def _twins(ax: Any) -> list[Any]:
    return list(ax._twinned_axes.get_siblings(ax))


def _lay_over(chart: Any, first: Sequence[Any], ax: Any, number: int) -> None:
    """Give axes number `number` the place of their twin, with the scale of y on the right."""
    at = next(i for i, one in enumerate(first) if one in _twins(ax))
    own = str(at + 1) if at else ""
    columns = chart.layout.meta["columns"]
    if columns > 1 or not ax.get_shared_x_axes().joined(ax, first[at]):
        raise PictureOnly  # no room between columns
    below = chart.layout[f"xaxis{own}"].to_plotly_json()
    below |= {"overlaying": f"x{own}", "matches": f"x{own}", "visible": False}
    chart.layout[f"xaxis{number}"] = below | {"anchor": f"y{number}"}
    chart.layout[f"yaxis{number}"] = {
        **_axis(ax.yaxis, ax.get_ylim(), ax.get_ylabel(), _LETTERS),
        "overlaying": f"y{own}",
        "anchor": f"x{own}",
        "side": "right",
        "showgrid": False,
    }


def _axis(axis: Any, limits: tuple[float, float], label: str, letters: int) -> dict[str, Any]:
    from matplotlib.ticker import FixedLocator, LogFormatter, ScalarFormatter

    log = axis.get_scale() == "log"
    ends = np.log10(limits) if log else np.asarray(limits)
    ink = None if axis.label.get_color() == "black" else colour(axis.label.get_color())
    found: dict[str, Any] = {
        "title": {"text": "<br>".join(_lines(label, letters)), "font": {"color": ink}},
        "type": "log" if log else "linear",
        "range": [float(one) for one in ends],
    }
    usual = isinstance(axis.get_major_formatter(), ScalarFormatter | LogFormatter)
    if isinstance(axis.get_major_locator(), FixedLocator) or not usual:
        ticks = [one for one in axis.get_majorticklocs() if min(limits) <= one <= max(limits)]
        words = axis.get_major_formatter().format_ticks(ticks)
        found |= {"tickvals": ticks, "ticktext": [plain(one) for one in words]}
    elif log:
        found["dtick"] = max(1, round(np.ptp(ends) / _TICKS)) if np.ptp(ends) > _DECADES else "D2"
    return found


def _lines(label: str, letters: int) -> list[str]:
    return [part for line in label.split("\n") for part in wrap(plain(line), letters)]


def _refs(name: str, in_x: bool, in_y: bool) -> dict[str, str]:
    """Return the axes of panel `name` to which a place refers: their values, or their length."""
    ends = "" if in_x else " domain", "" if in_y else " domain"
    return {"xref": f"x{name}{ends[0]}", "yref": f"y{name}{ends[1]}"}


def _add_panel(chart: Any, ax: Any, name: str) -> None:
    from matplotlib.container import BarContainer

    inset = [one for one in ax.child_axes if type(one).__name__ != "SecondaryAxis"]
    if ax.images or ax.tables or inset:
        raise PictureOnly
    place = {"xaxis": f"x{name}", "yaxis": f"y{name}"}
    stacks = [one for one in ax.containers if isinstance(one, BarContainer)]
    barred = set(chain.from_iterable(one.patches for one in stacks))
    for one in sorted(ax.collections, key=lambda one: one.get_zorder()):
        chart.add_trace(collection(one) | place)
    for stack in stacks:
        chart.add_trace(bars(stack) | place)
    for line in ax.lines:
        _add_line(chart, ax, line, name)
    for patch in ax.patches:
        if patch not in barred:
            _add_patch(chart, ax, patch, name)
    for text in ax.texts:
        _add_text(chart, ax, text, name)
    chart.update_layout(barmode="overlay")


def _add_line(chart: Any, ax: Any, line: Any, name: str) -> None:
    in_x, in_y = line.get_transform().contains_branch_seperately(ax.transData)
    points: Any = np.column_stack(
        [np.ma.filled(np.ma.asarray(one, float), np.nan) for one in line.get_data()]
    )
    if not len(points):  # a name for the legend
        points = np.full((1, 2), np.nan)
    trace = {"type": "scatter", **named(line), **line_look(line)}
    if not (in_x or in_y):
        raise PictureOnly
    if not (in_x and in_y):
        (x0, y0), (x1, y1) = points[[0, -1]]
        chart.add_shape(
            x0=x0, x1=x1, y0=y0, y1=y1, line=trace["line"], layer="below", **_refs(name, in_x, in_y)
        )
        points = points[:1] * np.nan  # the legend needs no more
    if (in_x and in_y) or trace["name"]:
        units = (re.search(r"\[([^-].*)\]$", one) for one in (ax.get_ylabel(), ax.get_xlabel()))
        y, x = ("" if one is None else f" {one[1]}" for one in units)
        trace["hovertemplate"] = f"%{{y:.4g}}{y} at %{{x:.5g}}{x}<extra>{trace['name']}</extra>"
        chart.add_trace(trace | joined([points]) | {"xaxis": f"x{name}", "yaxis": f"y{name}"})


def _add_patch(chart: Any, ax: Any, patch: Any, name: str) -> None:
    from matplotlib.patches import Polygon, Rectangle

    look = {"fillcolor": colour(patch.get_facecolor(), alpha=True)}
    in_x, in_y = patch.get_transform().contains_branch_seperately(ax.transData)
    if isinstance(patch, Rectangle):
        (x0, y0), (x1, y1) = patch.get_xy(), patch.get_bbox().max
        refs = _refs(name, in_x, in_y)
        look["layer"] = "below"
        chart.add_shape(type="rect", x0=x0, x1=x1, y0=y0, y1=y1, line_width=0, **look, **refs)
    elif isinstance(patch, Polygon) and in_x and in_y:
        look |= {"mode": "lines", "fill": "toself", "line_color": colour(patch.get_edgecolor())}
        look |= named(patch) | joined([patch.get_xy()]) | {"hoverinfo": "skip"}
        chart.add_scatter(xaxis=f"x{name}", yaxis=f"y{name}", **look)
    else:
        raise PictureOnly


def _add_text(chart: Any, ax: Any, text: Any, name: str) -> None:
    if not text.get_text().strip():
        return
    at, shift = text.get_position(), (0.0, 0.0)
    in_data = list(text.get_transform().contains_branch_seperately(ax.transData))
    if (where := getattr(text, "xycoords", None)) is not None:
        at, where = (text.xyann, text.anncoords)
        if where == "offset points":
            at, where, shift = text.xy, text.xycoords, text.xyann
        both = where if isinstance(where, tuple) else (where, where)
        if not {*map(str, both)} <= {"data", "axes fraction"}:
            raise PictureOnly
        in_data = [one == "data" for one in both]
    logs = [ax.get_xscale() == "log" and in_data[0], ax.get_yscale() == "log" and in_data[1]]
    x, y = (float(np.log10(one) if log else one) for one, log in zip(at, logs, strict=True))
    words = plain(text.get_text())
    if not in_data[0] and x >= 1.0 and text.get_ha() == "left":
        longest = max(map(len, words.split("<br>")))
        room = int(_LETTER * longest + (x - 1.0) * _WIDE) + _MARGIN
        chart.layout.margin.r = max(chart.layout.margin.r or 0, room)
    ink, aside = text.get_color(), _ASIDE if text.get_rotation() else 0.0  # not on its line
    chart.add_annotation(
        text=words, x=x, y=y, showarrow=False, xshift=PX * shift[0] - aside, yshift=PX * shift[1],
        xanchor=text.get_ha(), yanchor=_ANCHORS.get(text.get_va(), text.get_va()), align="left",
        textangle=-text.get_rotation(),
        font={"size": 11, "color": None if ink == "black" else colour(ink)},
        **_refs(name, *in_data),
    )  # fmt: skip


def _add_legend(chart: Any, legends: Sequence[Any]) -> None:
    """Show each name once, and what legends of the picture have beside the names of lines."""
    seen: set[str] = set()
    for trace in chart.data:
        if trace.name:
            trace.showlegend = trace.name not in seen
            seen.add(trace.name)
    for legend in legends:
        for handle, text in zip(legend.legend_handles, legend.get_texts(), strict=True):
            name = plain(text.get_text())
            if name in seen:
                continue
            seen.add(name)
            if hasattr(handle, "get_marker"):
                chart.add_scatter(x=[None], y=[None], name=name, **line_look(handle))
            else:
                shade = colour(np.atleast_2d(handle.get_facecolor())[0], alpha=True)
                look = {"color": shade, "pattern": pattern(handle)}
                chart.add_bar(x=[None], y=[None], name=name, marker=look)
    chart.update_layout(showlegend=len(seen) > 1 or bool(legends))
