"""Maps on the drawn gear tooth, as pictures and as charts: ease-off, path and pattern, pressure."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

from gearlube.plotting.drawn_tooth import DrawnTooth, ease_off_levels
from gearlube.plotting.style import SKY, house_style, new_figure
from gearlube.report.charts import Axis, Line, add_line, panels
from gearlube_core.arrays import Array
from gearlube_core.tooth_contact.sharp_edge import EDGE_PRESSURE

_SIDES = {"drive": "drive side", "coast": "coast side"}
_INSIDE = 97.0  # percent of the loaded cells that the colours of the pressure span
_PERIODS = Axis("pinion rotation", "mesh periods")
_LOADED = 1e-3
_TORQUES = 4  # that are drawn, at most; each has one colour in all figures


def ease_off_map(dataset: xr.Dataset) -> Any:
    """Return ease-off, path of contact and marked pattern on the drawn gear tooth, both sides."""
    tooth, levels = DrawnTooth.of_dataset(dataset), ease_off_levels(dataset)
    with house_style():
        figure = new_figure(9.6, 6.4)
        axes = figure.subplots(2, 1)
        for ax, side in zip(axes, _SIDES, strict=True):
            part = dataset.sel(side=side)
            filled = tooth.draw_ease_off(ax, part, levels, 2.0)
            ratio = float(part["path_contact_ratio"])
            tooth.draw(ax, f"{_SIDES[side]}: the path lasts {ratio:.2f} mesh periods")
        axes[0].set_xlabel("")
        figure.colorbar(filled, ax=axes, label="ease-off [µm]", ticks=levels[::2], format="%.0f")
        figure.suptitle(
            "Gear tooth without load: gap to the conjugate flank (colours), path of contact "
            "(black),\npattern that 6.35 µm of marking compound shows (red). White: the pinion "
            "does not reach it",
            fontsize=10.5,
        )
    return figure


def pressure_maps(dataset: xr.Dataset) -> Any:
    """Return the highest pressure at each point of the drawn gear tooth, per side and torque.

    Colours span the pressures inside the flanks. Those of sharp edges are far above: they have one
    colour of their own.
    """
    import matplotlib

    tooth = DrawnTooth.of_dataset(dataset)
    torques = _spread(dataset["torque"].values)
    top = inside_pressure(dataset)
    colours = matplotlib.colormaps["magma_r"].with_extremes(over=SKY)
    with house_style():
        figure = new_figure(10.5, 1.1 + 1.5 * len(torques))
        axes = figure.subplots(len(torques), 2, squeeze=False)
        for row, torque in zip(axes, torques, strict=True):
            for ax, side in zip(row, _SIDES, strict=True):
                part = dataset.sel(side=side, torque=torque)
                values = 1e-9 * part["pressure_map"].values
                image = ax.pcolormesh(
                    tooth.along(part["map_t"]),
                    tooth.up(part["map_s"]),
                    np.where(values > 0.0, values, np.nan),
                    vmin=0.0,
                    vmax=top,
                    cmap=colours,
                )
                tooth.draw(ax, f"{_SIDES[side]}, {torque:g} N·m: {_highest(values, top)}")
        for ax in axes[:-1].ravel():
            ax.set_xlabel("")
        for ax in axes[:, 1]:
            ax.set_ylabel("")
        figure.colorbar(
            image, ax=axes, label="highest pressure over the mesh [GPa]", extend="max", shrink=0.7
        )
        figure.suptitle(
            "Gear tooth under load: contact pattern and pressure. Blue: above the scale, "
            "pressed by the edge of a tip",
            fontsize=10.5,
        )
    return figure


def inside_pressure(dataset: xr.Dataset) -> float:
    """Return the pressure [GPa] up to which the colours of a map go: that inside the flanks."""
    values = dataset["pressure_map"].values
    inside = values[(values > 0.0) & (values < EDGE_PRESSURE)]
    return float(np.ceil(1e-8 * np.percentile(inside, _INSIDE))) / 10.0 if inside.size else 1.0


def _highest(values: Array, top: float) -> str:
    """Return "up to 0.87 GPa"; without the number where it has none, at a sharp edge."""
    highest = float(np.nanmax(values, initial=0.0))
    if highest > 1e-9 * EDGE_PRESSURE:
        return "a sharp edge presses"
    return f"up to {highest:.2f} GPa" + (" at an edge" if highest > top else "")


def _spread(values: Any) -> list[float]:
    chosen = np.unique(np.linspace(0, len(values) - 1, min(_TORQUES, len(values))).astype(int))
    return [float(values[i]) for i in chosen]


def transmission_chart(dataset: xr.Dataset) -> Any:
    """Return the loaded transmission error of both sides over two mesh periods, mean removed."""
    y = Axis("transmission error minus its mean", "µm")
    figure = panels([_SIDES[side] for side in _SIDES], _PERIODS, [y, y])
    for panel, side in enumerate(_SIDES, 1):
        part = dataset.sel(side=side)
        for number, torque in enumerate(_spread(part["torque"].values)):
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
    for number, torque in enumerate(_spread(part["torque"].values)):
        state = part.sel(torque=torque)
        carries = (state["share"].values > _LOADED, state["pressure_max"].values < EDGE_PRESSURE)
        for panel, (name, scale) in enumerate((("share", 100.0), ("pressure_max", 1e-9)), 1):
            shown = carries[0] & carries[1] if name == "pressure_max" else carries[0]
            values = np.where(shown, scale * state[name].values, np.nan).ravel()[order]
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
            look = _TORQUES + number  # colours that no torque has
            line = Line(name=f"{side}, {what}", x=torque, y=mean, group=look, dash=dash)
            add_line(figure, line, look, x, y[0], row=1, col=1)
        pairs = (part["share"] > _LOADED).sum("pair").mean("phase").values
        line = Line(name=f"{side}, pairs", x=torque, y=pairs, group=_TORQUES + number)
        add_line(figure, line, number, x, y[1], row=2, col=1, showlegend=False)
    figure.update_yaxes(rangemode="tozero")
    return figure


def two_periods(phase: Array, values: Array) -> tuple[Array, Array]:
    """Return x and y of a periodic curve over two mesh periods."""
    x = np.concatenate([phase, phase + 1.0, [2.0]])
    return x, np.concatenate([values, values, values[:1]])
