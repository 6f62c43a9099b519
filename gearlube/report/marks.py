"""Lines, areas, bars and maps of matplotlib as traces of plotly, for `gearlube.report.redrawn`."""

from __future__ import annotations

import re
from collections.abc import Iterable
from typing import Any

import numpy as np

from gearlube_core.arrays import Array

PX = 4.0 / 3.0  # of a point
GREY = "#808080"
_COLOURS = 64  # of a scale
_CELLS = 200_000  # of a map; more are a picture, or the page grows by megabytes
_DARK = 0.35  # grey below it is drawn in a grey that is seen on white and on black
_GREEK = {
    "beta": "β", "delta": "δ", "eta": "η", "lambda": "λ", "mu": "µ", "omega": "ω", "tau": "τ",
    "theta": "θ", "zeta": "ζ",
}  # fmt: skip
_SYMBOLS = {
    "s": "square", "^": "triangle-up", "v": "triangle-down", "D": "diamond", "d": "diamond",
    "P": "cross", "x": "x-thin-open", "+": "cross-thin-open", "*": "star",
}  # fmt: skip


class PictureOnly(Exception):  # noqa: N818
    """A part of the figure has no like in a chart."""


def named(artist: Any) -> dict[str, Any]:
    """Return the name of an artist for the legend; none where matplotlib made it up."""
    label = str(artist.get_label() or "")
    words = "" if label.startswith("_") else plain(label)
    return {"name": words, "legendgroup": words, "showlegend": bool(words)}


def line_look(line: Any) -> dict[str, Any]:
    """Return colour, dashes and markers of a line."""
    width = PX * line.get_linewidth()
    solid = line.get_linestyle() not in ("None", " ", "")
    marked = line.get_marker() not in ("None", " ", "", None)
    dashes = [f"{max(width, 1.0) * one:.1f}px" for one in line._unscaled_dash_pattern[1] or ()]
    symbol = _SYMBOLS.get(line.get_marker(), "circle")
    ink, face = colour(line.get_color()), colour(line.get_markerfacecolor())
    edge, every = colour(line.get_markeredgecolor()), line.get_markevery()
    hollow = face == "#ffffff" or str(line.get_markerfacecolor()).lower() == "none"
    return {
        "mode": "+".join(["lines"] * solid + ["markers"] * marked) or "none",
        "line": {"color": ink, "width": width, "dash": ",".join(dashes) or "solid"},
        "marker": {
            "symbol": symbol + "-open" * (hollow and not symbol.endswith("-open")),
            "size": PX * line.get_markersize(),
            "maxdisplayed": len(line.get_xdata()) // every if isinstance(every, int) else 0,
            "color": edge if hollow else face,
            "line": {"width": 1.4 if hollow or "thin" in symbol else 0.0, "color": edge},
        },
        "opacity": line.get_alpha() or 1.0,
    }


def collection(artist: Any) -> dict[str, Any]:
    """Return dots, segments, an area or a map as a trace."""
    from matplotlib.collections import LineCollection, PathCollection, PolyCollection, QuadMesh

    one: Any = artist
    if isinstance(artist, QuadMesh):
        return _map(one)
    if isinstance(artist, PathCollection):
        return _dots(one)
    trace = {"type": "scatter", **named(one), "mode": "lines", "hoverinfo": "skip"}
    if isinstance(artist, LineCollection):
        ink = {"color": colour(one.get_colors()[0]), "width": PX * one.get_linewidths()[0]}
        return trace | joined(one.get_segments()) | {"line": ink}
    if not isinstance(artist, PolyCollection) or not len(one.get_facecolors()):
        raise PictureOnly
    shade = colour(one.get_facecolors()[0], alpha=True)
    trace |= joined(path.vertices for path in one.get_paths())
    return trace | {"line": {"width": 0.0}, "fill": "toself", "fillcolor": shade}


def _dots(one: Any) -> dict[str, Any]:
    one.update_scalarmappable()
    at, shades = one.get_offsets(), [colour(shade) for shade in one.get_facecolors()] or [GREY]
    return {
        "type": "scatter",
        **named(one),
        **joined([np.ma.filled(at, np.nan)]),
        "mode": "markers",
        "marker": {
            "size": small(PX * np.broadcast_to(np.sqrt(one.get_sizes()), len(at))),
            "color": shades[0] if len(shades) == 1 else shades,
            "line": {"width": 0.5, "color": "white"},
        },
        "opacity": one.get_alpha() or 1.0,
        "hovertemplate": "%{y:.4g} at %{x:.5g}<extra></extra>",
    }


def joined(parts: Iterable[Array]) -> dict[str, Any]:
    """Return the points of parts one after the other, with gaps between them."""
    gap = np.full((1, 2), np.nan)
    points = np.concatenate([gap, *(np.concatenate([part, gap]) for part in parts)])
    return {"x": small(points[1:-1, 0]), "y": small(points[1:-1, 1])}


def _map(mesh: Any) -> dict[str, Any]:
    places, norm, bar = mesh.get_coordinates(), mesh.norm, mesh.colorbar
    if mesh.get_array().size > _CELLS or type(norm).__name__ != "Normalize":
        raise PictureOnly
    if np.ptp(places[:, 0, 0]) > 0.0:
        raise PictureOnly
    if not np.array_equal(mesh.cmap.get_over(), mesh.cmap(mesh.cmap.N - 1)):
        raise PictureOnly  # a colour of its own beyond the scale, which a chart has not
    values = np.ma.filled(mesh.get_array().astype(float), np.nan)
    label = "" if bar is None else plain(bar.ax.get_ylabel() or bar.ax.get_xlabel())
    shades = np.linspace(0.0, 1.0, _COLOURS)
    return {
        "type": "heatmap",
        "x": small(places[0, :, 0]),
        "y": small(places[:, 0, 1]),
        "z": small(values.reshape(*(n - 1 for n in places.shape[:2]))),
        "zmin": norm.vmin,
        "zmax": norm.vmax,
        "colorscale": [[float(one), colour(mesh.cmap(one), dark=True)] for one in shades],
        "showscale": bar is not None,
        "colorbar": {"thickness": 14, "title": {"side": "right", "text": label}},
        "hovertemplate": "%{z:.4g} at %{x:.5g}, %{y:.5g}<extra></extra>",
    }


def bars(container: Any) -> dict[str, Any]:
    """Return bars as a trace."""
    boxes = [(*one.get_xy(), one.get_width(), one.get_height()) for one in container.patches]
    x, y, width, height = np.reshape(boxes, (-1, 4)).T
    level = container.orientation == "horizontal"
    along, base, length, thick = (y, x, width, height) if level else (x, y, height, width)
    middle = small(along + 0.5 * thick)
    return {
        "type": "bar",
        **named(container),
        **dict(zip("yx" if level else "xy", (middle, small(length)), strict=True)),
        "base": small(base),
        "width": small(thick),
        "orientation": "h" if level else "v",
        "marker": {
            "color": [colour(one.get_facecolor()) for one in container.patches],
            "pattern": pattern(container.patches[0]) if container.patches else {},
        },
    }


def pattern(patch: Any) -> dict[str, Any]:
    """Return the hatch of a patch: white stripes on its colour, or none."""
    shape = "/" if patch.get_hatch() else ""
    return {"shape": shape, "fillmode": "overlay", "fgcolor": "white", "size": 7, "solidity": 0.25}


def plain(text: str) -> str:
    """Return text with the line ends and the mathematics of plotly.

    Examples
    --------
    >>> plain("order at $2f_m$")
    'order at 2f<sub>m</sub>'
    """

    def inner(found: re.Match[str]) -> str:
        words = re.sub(r"\\dot\{?(\\?[a-zA-Z]+)\}?", "\\1\u0307", found[1])  # a dot on the letter
        words = re.sub(r"\\([a-z]+)", lambda one: _GREEK.get(one[1], one[0]), words)
        words = re.sub(r"_\{?(\w+)\}?", r"<sub>\1</sub>", words)
        words = re.sub(r"\^\{?([-\w]+)\}?", r"<sup>\1</sup>", words)
        return re.sub(r"\\mathdefault|[\\{}]", "", words)

    return re.sub(r"\$([^$]*)\$", inner, text).replace("\n", "<br>")


def colour(shade: Any, *, alpha: bool = False, dark: bool = False) -> str:
    """Return a colour as plotly writes it; ink that is nearly black is grey, for a dark page."""
    from matplotlib.colors import to_hex, to_rgba

    rgba = to_rgba(shade)
    if not dark and max(rgba[:3]) < _DARK:
        rgba = (*to_rgba(GREY)[:3], rgba[3])
    if alpha and rgba[3] < 1.0:
        return f"rgba({','.join(str(round(255 * one)) for one in rgba[:3])},{rgba[3]:.3g})"
    return str(to_hex(rgba))


def small(values: Any) -> Array:
    """Return values as 32 bit floats: half the size in the file, seven digits."""
    return np.asarray(values, dtype=np.float32)
