"""Pictures of matplotlib in a report: what each is called, what it shows, how it is drawn."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from gearlube.report.parts import Figure
from gearlube_core.storage.atomic_file import write_figure


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
    """Draw every picture of a catalogue from `given` into a folder as PNG; return the files."""
    folder.mkdir(parents=True, exist_ok=True)
    files = []
    for name, one in catalogue.items():
        path = folder / f"{name}.png"
        write_figure(one.draw(*given), path)
        files.append(path)
    return files


def pictured(
    catalogue: Mapping[str, Picture], folder: Path, charts: Mapping[str, Any] | None = None
) -> list[Figure]:
    """Return the figures of a catalogue that lie in a folder as PNG, in its order.

    `charts` has charts of plotly that are shown in place of pictures, by name.
    """
    charts = charts or {}
    found = []
    for name, one in catalogue.items():
        path = folder / f"{name}.png"
        chart = charts.get(name)
        if chart is None and not path.is_file():
            continue
        found.append(
            Figure(
                name=name,
                title=one.title,
                caption=one.caption,
                chart=chart,
                picture=path.read_bytes() if chart is None else None,
            )
        )
    return found
