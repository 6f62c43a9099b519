"""Pictures of matplotlib in a report: what each is called, what it shows, how it is drawn."""

from __future__ import annotations

import io
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from gearlube.report.parts import Figure
from gearlube.report.redrawn import redrawn
from gearlube_core.storage.atomic_file import write_figure, write_text

_DPI = 130


@dataclass(frozen=True, slots=True)
class Picture:
    """An entry of a study's catalogue of figures.

    Parameters
    ----------
    draw : callable
        From the datasets of the study to a figure of matplotlib.
    title : str
        Caption of a few words.
    caption : str
        What is drawn, and what to see in it.
    needs : str
        What there must be for it, as the study says; "" for nothing.
    """

    draw: Callable[..., Any]
    title: str
    caption: str
    needs: str = ""


def save_pictures(catalogue: Mapping[str, Picture], folder: Path, *given: Any) -> list[Path]:
    """Draw every picture of a catalogue from `given` into a folder as PNG; return the files.

    Those that can be a chart of plotly lie there as JSON too.
    """
    folder.mkdir(parents=True, exist_ok=True)
    paths = [folder / f"{name}.png" for name in catalogue]
    for one, path in zip(catalogue.values(), paths, strict=True):
        save_picture(one.draw(*given), path)
    return paths


def save_picture(figure: Any, path: Path) -> None:
    """Write a figure of matplotlib as PNG, and beside it as JSON where it can be a chart."""
    write_figure(figure, path)
    if (chart := redrawn(figure)) is not None:
        write_text(chart.to_json(), path.with_suffix(".json"))


def kept_figure(name: str, title: str, caption: str, path: Path, chart: Any = None) -> Figure:
    """Return a figure that `save_picture` wrote: as `chart`, else as its own chart, else as PNG."""
    from plotly.io import read_json

    if chart is None and path.with_suffix(".json").is_file():
        chart = read_json(path.with_suffix(".json"))
    picture = path.read_bytes() if chart is None else None
    return Figure(name=name, title=title, caption=caption, chart=chart, picture=picture)


def shown(name: str, title: str, caption: str, figure: Any, chart: Any = None) -> Figure:
    """Return a figure of matplotlib as a part of a report: as `chart`, else redrawn, else a PNG."""
    chart = redrawn(figure) if chart is None else chart
    if chart is not None:
        return Figure(name=name, title=title, caption=caption, chart=chart)
    buffer = io.BytesIO()
    figure.savefig(buffer, format="png", dpi=_DPI)
    return Figure(name=name, title=title, caption=caption, picture=buffer.getvalue())


def pictured(
    catalogue: Mapping[str, Picture], folder: Path, charts: Mapping[str, Any] | None = None
) -> list[Figure]:
    """Return the figures of a catalogue that lie in a folder as JSON or PNG, in its order.

    `charts` has charts of plotly that are shown in their place, by name.
    """
    charts = charts or {}
    return [
        kept_figure(name, one.title, one.caption, folder / f"{name}.png", charts.get(name))
        for name, one in catalogue.items()
        if name in charts or (folder / f"{name}.png").is_file()
    ]
