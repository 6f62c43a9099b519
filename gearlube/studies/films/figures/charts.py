"""The main curves of films as charts of a report."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import xarray as xr

from gearlube.report.charts import Axis, Line, add_line, panels
from gearlube.studies.films.figures.parts import HEADROOM, shown_range

_PRESSURE = Axis("pressure", "GPa")
_FILM = Axis("film", "µm")
_SIDE = 1.6  # half widths that are shown


def main_charts(dataset: xr.Dataset) -> dict[str, Any]:
    """Return charts by the names of the figures that they stand for."""
    kind = dataset.attrs["contact"]
    if kind == "line":
        return {"profile": _line(dataset)}
    if kind == "point":
        return {"sections": _point(dataset)}
    if kind == "helical":
        return {"along": _along(dataset)}
    if kind == "helical_cycle":
        return {"cycle": _cycle(dataset)}
    return {"curves": _hypoid(dataset)}


def _two(
    titles: Sequence[str],
    x: Axis,
    lines: Sequence[tuple[int, Line]],
    y: Sequence[Axis] = (_PRESSURE, _FILM),
) -> Any:
    """Return lines in panels, each with the number of its panel from 1."""
    figure = panels(titles, x, y, 280)
    for number, (row, line) in enumerate(lines):
        add_line(figure, line, number, x, y[row - 1], row=row, col=1)
    return figure


def _limits(figure: Any, dataset: xr.Dataset, low_high: tuple[float, float] | None = None) -> Any:
    """Show the loaded zone, and films up to a few central ones: outside the gap grows fast."""
    top = 1e6 * HEADROOM * dataset.attrs["central_film"]
    figure.update_yaxes(range=[0.0, top], row=2, col=1)
    if low_high is not None:
        figure.update_xaxes(range=list(low_high))
    return figure


def _line(dataset: xr.Dataset) -> Any:
    x = 1e3 * dataset["x"].values
    figure = _two(
        ("Pressure", "Film"),
        Axis("along the motion", "mm"),
        [
            (1, Line(name="pressure", x=x, y=1e-9 * dataset["pressure"].values)),
            (1, Line(name="dry contact", x=x, y=1e-9 * dataset["hertz_pressure"].values, dash=2)),
            (2, Line(name="film", x=x, y=1e6 * dataset["film"].values)),
        ],
    )
    side = _SIDE * dataset.attrs["half_width"]
    return _limits(figure, dataset, shown_range(dataset, "x", side, 0.01))


def _point(dataset: xr.Dataset) -> Any:
    lines = []
    for group, (along, other) in enumerate((("x", "y"), ("y", "x"))):
        section = dataset.sel({other: 0.0}, method="nearest")
        place = 1e3 * section[along].values
        for row, name, scale in ((1, "pressure", 1e-9), (2, "film", 1e6)):
            values = scale * section[name].values
            label = f"{name} along {along}"
            lines.append((row, Line(name=label, x=place, y=values, group=group)))
    figure = _two(("Pressure", "Film"), Axis("from the centre", "mm"), lines)
    side = _SIDE * dataset.attrs["semi_axis_x"]
    return _limits(figure, dataset, shown_range(dataset, "x", side, 0.01))


def _along(dataset: xr.Dataset) -> Any:
    y = 1e3 * dataset["y"].values
    figure = _two(
        ("Largest pressure of each section", "Smallest film of each section"),
        Axis("along the line", "mm"),
        [
            (1, Line(name="pressure", x=y, y=1e-9 * dataset["pressure"].max("x").values)),
            (2, Line(name="film", x=y, y=1e6 * dataset["film"].min("x").values)),
        ],
    )
    return _limits(figure, dataset)


def _cycle(dataset: xr.Dataset) -> Any:
    step = dataset["step"].values
    return _two(
        ("Largest pressure", "Smallest film"),
        Axis("step of the meshing cycle"),
        [
            (1, Line(name="pressure", x=step, y=1e-9 * dataset["pressure_max"].values)),
            (2, Line(name="film", x=step, y=1e6 * dataset["minimum_film"].values)),
        ],
    )


def _hypoid(dataset: xr.Dataset) -> Any:
    phase = dataset["steady_phase"].values

    def line(label: str, name: str, scale: float, group: int, dash: int = 0) -> Line:
        return Line(name=label, x=phase, y=scale * dataset[name].values, group=group, dash=dash)

    return _two(
        ("Central film", "Smallest film", "Coefficient of friction"),
        Axis("mesh periods from the middle of the engagement"),
        [
            (1, line("solved", "steady_central_film", 1e6, 0)),
            (1, line("Chittenden et al. 1985", "chittenden_central", 1e6, 1, 1)),
            (1, line("Grubin 1949", "grubin", 1e6, 2, 1)),
            (2, line("solved, smallest", "steady_minimum_film", 1e6, 0)),
            (2, line("Chittenden, smallest", "chittenden_minimum", 1e6, 1, 1)),
            (3, line("solved, heated Eyring", "steady_traction_heated", 1.0, 0)),
            (3, line("Evans and Johnson 1986", "evans_johnson", 1.0, 3, 1)),
        ],
        (_FILM, _FILM, Axis("friction")),
    )
