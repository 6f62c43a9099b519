"""Interactive charts of a tooth contact analysis."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

from gearlube.report.charts import Axis, Line, add_line, panels
from gearlube.studies.contact.figures.flank_maps import _SIDES, _spread
from gearlube_core.arrays import Array

_PERIODS = Axis("pinion rotation", "mesh periods")
_LOADED = 1e-3


def transmission_chart(dataset: xr.Dataset) -> Any:
    """Return the loaded transmission error of both sides over two mesh periods, mean removed."""
    y = Axis("closing minus its mean", "µm")
    figure = panels([_SIDES[side] for side in _SIDES], _PERIODS, [y, y])
    for panel, side in enumerate(_SIDES, 1):
        part = dataset.sel(side=side)
        for number, torque in enumerate(_spread(part["torque"].values, 5)):
            error = loaded_error(part.sel(torque=torque))
            x, values = two_periods(part["phase"].values, error)
            line = Line(name=f"{torque:g} N·m", x=x, y=values, group=number)
            place = {"legendgroup": line.name, "showlegend": panel == 1, "row": panel, "col": 1}
            add_line(figure, line, number, _PERIODS, y, **place)
    return figure


def loaded_error(state: xr.Dataset) -> Array:
    """Return the transmission error of a side at a torque along the line of action [µm]."""
    error = 1e6 * float(state["R_p"].mean()) * state["rotation"].values
    return np.asarray(error - error.mean())


def load_share_chart(dataset: xr.Dataset) -> Any:
    """Return load share and highest pressure of a drive pair from entry to exit."""
    y = [Axis("share of the torque", "%"), Axis("highest pressure", "GPa")]
    figure = panels(["load", "pressure"], _PERIODS, y)
    part = dataset.sel(side="drive")
    phase = (part["phase"].values[:, None] + part["pair"].values).ravel()
    order = np.argsort(phase)
    for number, torque in enumerate(_spread(part["torque"].values, 5)):
        state = part.sel(torque=torque)
        carries = state["share"].values > _LOADED
        for panel, (name, scale) in enumerate((("share", 100.0), ("pressure_max", 1e-9)), 1):
            values = np.where(carries, scale * state[name].values, np.nan).ravel()[order]
            line = Line(name=f"{torque:g} N·m", x=phase[order], y=values, group=number)
            place = {"legendgroup": line.name, "showlegend": panel == 1, "row": panel, "col": 1}
            add_line(figure, line, number, _PERIODS, y[panel - 1], **place)
    carried = (part["share"].values > _LOADED).any(axis=1).ravel()
    ends = (float(phase[carried].min()), float(phase[carried].max()))
    figure.update_xaxes(range=[ends[0] - 0.2, ends[1] + 0.2])
    return figure


def stiffness_chart(dataset: xr.Dataset) -> Any:
    """Return mean mesh stiffness, secant and tangent, and pairs in contact over torque."""
    x, y = Axis("pinion torque", "N·m"), [Axis("mesh stiffness", "N/µm"), Axis("tooth pairs", "-")]
    figure = panels(["stiffness", "pairs that carry load"], x, y, height=280)
    torque = dataset["torque"].values
    for number, side in enumerate(_SIDES):
        part = dataset.sel(side=side)
        for dash, (name, what) in enumerate((("k_m", "secant"), ("k_t", "tangent"))):
            mean = 1e-6 * part[name].mean("phase").values
            line = Line(name=f"{side}, {what}", x=torque, y=mean, group=number, dash=dash)
            add_line(figure, line, number, x, y[0], row=1, col=1)
        pairs = (part["share"] > _LOADED).sum("pair").mean("phase").values
        line = Line(name=f"{side}, pairs", x=torque, y=pairs, group=number)
        add_line(figure, line, number, x, y[1], row=2, col=1, showlegend=False)
    figure.update_yaxes(rangemode="tozero")
    return figure


def two_periods(phase: Array, values: Array) -> tuple[Array, Array]:
    """Return x and y of a periodic curve over two mesh periods."""
    x = np.concatenate([phase, phase + 1.0, [2.0]])
    return x, np.concatenate([values, values, values[:1]])
