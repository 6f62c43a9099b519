"""Interactive charts of a resonance study."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

from gearlube.plotting.style import GREY
from gearlube.report.charts import Axis, Line, add_line, line_chart, mark_level, panels
from gearlube.studies.resonance.figures.response_curves import segments
from gearlube.studies.resonance.settings import MODELS
from gearlube_core.arrays import Array

_FREQUENCY = Axis("mesh over natural frequency")
_SHOWN = ("two_dof", "one_dof")  # of the others a click in the legend shows the lines
_ORDERS = 4  # as in the picture; higher ones may lie beyond those of the mesh table
_ERROR, _APART = Axis("peak to peak", "µm"), Axis("time without contact", "%")
_MICRO, _PERCENT = 1e6, 100.0


def response_chart(response: xr.Dataset) -> Any:
    """Return transmission error and time without contact over frequency; dashed: unstable."""
    figure = panels(("Transmission error", "Teeth apart"), _FREQUENCY, (_ERROR, _APART), height=330)
    for number, model in enumerate(response["model"].values):
        label = MODELS[str(model)]
        branches = segments(response, str(model))
        for row, (name, scale) in enumerate(
            (("peak_to_peak", _MICRO), ("separation_share", _PERCENT)), 1
        ):
            axis = (_ERROR, _APART)[row - 1]
            for line in _by_stability(branches, "relative_frequency", name, scale, label):
                add_line(figure, line, number, _FREQUENCY, axis, row=row, col=1)
                figure.data[-1].update(
                    mode="lines",
                    legendgroup=line.name,
                    showlegend=row == 1,
                    visible=True if str(model) in _SHOWN else "legendonly",
                )
    _add_sweeps(figure, response)
    figure.update_layout(showlegend=True)
    return figure


def _add_sweeps(figure: Any, response: xr.Dataset) -> None:
    """Add slow sweeps in time of the first model that has them, as triangles."""
    if "sweep_peak_to_peak" not in response:
        return
    part = response.isel(swept_model=0)
    for direction, symbol in (("up", "triangle-up-open"), ("down", "triangle-down-open")):
        one = part.sel(direction=direction)
        figure.add_scatter(
            x=one["sweep_relative_frequency"].values,
            y=_MICRO * one["sweep_peak_to_peak"].values,
            mode="markers",
            marker={"symbol": symbol, "size": 9, "color": GREY},
            name=f"sweep {direction} in time, {MODELS[str(part['swept_model'].values)]}",
            row=1,
            col=1,
        )


def harmonics_chart(response: xr.Dataset, model: str) -> Any:
    """Return the mesh orders of the stable motions of a model over frequency."""
    part = segments(response, model)
    lines = []
    for order in response["harmonic"].values[:_ORDERS]:
        x, y = _joined(part, "relative_frequency", None)
        values = [
            np.append(_MICRO * one["harmonics"].sel(harmonic=order).values, np.nan) for one in part
        ]
        held = np.concatenate([np.append(one["stable"].values, np.nan) for one in part]) > 0.5
        y = np.where(held, np.concatenate(values), np.nan)
        lines.append(Line(name=f"mesh order {order}", x=x, y=y))
    return line_chart(lines, _FREQUENCY, Axis("amplitude", "µm", log=True))


def stability_chart(response: xr.Dataset) -> Any:
    """Return the growth of a small disturbance in one mesh period, of each model."""
    lines = []
    for model in response["model"].values:
        x, y = _joined(segments(response, str(model)), "relative_frequency", "multiplier")
        lines.append(Line(name=MODELS[str(model)], x=x, y=y))
    figure = line_chart(lines, _FREQUENCY, Axis("factor in a mesh period"))
    mark_level(figure, 1.0, "above: unstable")
    return figure


def load_chart(load: xr.Dataset) -> Any:
    """Return transmission error and time without contact over the torque; dashed: unstable."""
    torque = Axis("pinion torque", "N·m")
    figure = panels(("Transmission error", "Teeth apart"), torque, (_ERROR, _APART), height=300)
    for number, form in enumerate(load["form"].values):
        part = load.sel(form=form)
        branches = [part.sel(branch=one) for one in part["branch"].values]
        for row, (name, scale) in enumerate(
            (("peak_to_peak", _MICRO), ("separation_share", _PERCENT)), 1
        ):
            axis = (_ERROR, _APART)[row - 1]
            for line in _by_stability(branches, "torque", name, scale, MODELS[str(form)]):
                add_line(figure, line, number, torque, axis, row=row, col=1)
                figure.data[-1].update(mode="lines", legendgroup=line.name, showlegend=row == 1)
    figure.update_layout(showlegend=True)
    return figure


def _joined(branches: list[xr.Dataset], x: str, y: str | None) -> tuple[Array, Array]:
    """Return branches one after the other, with gaps between them."""
    places = [np.append(one[x].values, np.nan) for one in branches]
    values = places if y is None else [np.append(one[y].values, np.nan) for one in branches]
    return np.concatenate(places), np.concatenate(values)


def _by_stability(
    branches: list[xr.Dataset], x: str, y: str, scale: float, label: str
) -> list[Line]:
    """Return a solid line of stable motions and a dashed one of unstable motions.

    A stretch ends on the first row of the next, so that both meet.
    """
    places, values = _joined(branches, x, y)
    stable = np.concatenate([np.append(one["stable"].values, np.nan) for one in branches])
    loose = stable < 0.5
    reached = loose.copy()
    reached[1:] |= loose[:-1]
    reached[:-1] |= loose[1:]
    found = [Line(name=label, x=places, y=np.where(stable > 0.5, scale * values, np.nan))]
    if loose.any():
        dashed = np.where(reached, scale * values, np.nan)
        found.append(Line(name=f"{label}, unstable", x=places, y=dashed, dash=1))
    return found
