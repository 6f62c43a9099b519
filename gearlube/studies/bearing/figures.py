"""Figures of bearing friction: all laws with the error bar, and the parts of the first."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

from gearlube.plotting.style import GREY, MARKERS, SERIES, house_style, new_figure
from gearlube_core.bearings.losses.laws import ROLLING
from gearlube_core.units import kelvin_to_celsius, rads_to_rpm

LAW_NAMES = {one.name: one.words for one in ROLLING} | {
    "solved_films": "Solved films",
    "palmgren": "Palmgren",
    "skf": "SKF",
}
_AXES = {
    "speed": "shaft speed [rpm]",
    "axial_load": "axial load [N]",
    "radial_load": "radial load [N]",
    "temperature": "oil temperature [°C]",
}
_MOST_PANELS = 4


def torque_of_laws(dataset: xr.Dataset) -> Any:
    """Return the torque of every law along the longest axis, with the error bar of the first."""
    along, places = drawn_places(dataset)
    x = axis_values(along, dataset[along].values)
    with house_style():
        figure, panels = _panel_grid(len(places))
        for ax, place in zip(panels, places, strict=True):
            at = dataset.sel(place)
            for i, law in enumerate(dataset["law"].values):
                one = at.sel(law=law)
                if i == 0:
                    band = (one["torque_low"], one["torque_high"])
                    words = f"error bar of {LAW_NAMES[str(law)]} (95 %)"
                    ax.fill_between(x, *band, color=GREY, alpha=0.4, lw=0.0, label=words)
                ax.plot(x, one["torque"], label=LAW_NAMES[str(law)], **_look(i))
            ax.set(title=place_words(place))
        panels[0].set_ylim(bottom=0.0)  # of all panels, once all are drawn
        _label_outer(panels, _AXES[along])
        _legend_below(figure, panels[0])
        figure.suptitle(f"{dataset.attrs['name']}, oil {dataset.attrs['oil']}", fontsize=11.5)
    return figure


def parts_of_first_law(dataset: xr.Dataset) -> Any:
    """Return the parts of the torque of the first law along the longest axis, logarithmic."""
    along, places = drawn_places(dataset)
    law = str(dataset["law"].values[0])
    x = axis_values(along, dataset[along].values)
    with house_style():
        figure, panels = _panel_grid(len(places))
        for ax, place in zip(panels, places, strict=True):
            at = dataset.sel(law=law).sel(place)
            ax.plot(x, _above_zero(at["torque"].values), color=GREY, lw=5.0, label="total")
            for i, part in enumerate(dataset["part"].values):
                torque = at["part_torque"].sel(part=part).values
                if np.isfinite(torque).all():
                    ax.plot(x, _above_zero(torque), label=str(part), **_look(i))
            ax.set(title=place_words(place), yscale="log")
        _label_outer(panels, _AXES[along])
        _legend_below(figure, panels[0])
        figure.suptitle(
            f"{dataset.attrs['name']}: parts of the torque by {LAW_NAMES[law]}", fontsize=11.5
        )
    return figure


BEARING_CATALOGUE = {"torque": torque_of_laws, "parts": parts_of_first_law}


def _look(row: int) -> dict[str, Any]:
    """Return the look of line number `row`; more lines than colours are black and dashed."""
    look: dict[str, Any] = {"marker": MARKERS[row % len(MARKERS)]}
    if row < len(SERIES):
        return look | {"color": SERIES[row]}
    return look | {"color": "black", "ls": "--", "fillstyle": "none"}


def _panel_grid(count: int) -> tuple[Any, list[Any]]:
    """Return a figure with `count` panels, at most two beside each other, and the panels."""
    columns = min(count, 2)
    rows = -(-count // columns)
    figure = new_figure(4.6 * columns, 0.4 + 3.7 * rows)
    panels = figure.subplots(rows, columns, squeeze=False, sharex=True, sharey=True).ravel()
    for empty in panels[count:]:
        empty.remove()
    return figure, list(panels[:count])


def _legend_below(figure: Any, panel: Any) -> None:
    """Explain the lines of all panels once, where they cover nothing."""
    handles, labels = panel.get_legend_handles_labels()
    figure.legend(handles, labels, ncols=min(4, len(labels)), loc="outside lower center")


def _label_outer(panels: list[Any], along: str) -> None:
    """Label the axes at the left and at the bottom."""
    for i, ax in enumerate(panels):
        if i % 2 == 0:
            ax.set_ylabel("friction torque [N·m]")
        if i + 2 >= len(panels):
            ax.set_xlabel(along)
            ax.tick_params(labelbottom=True)


def drawn_places(dataset: xr.Dataset) -> tuple[str, list[dict[str, float]]]:
    """Return the longest axis, and the places on the others that are drawn."""
    along = max(_AXES, key=lambda name: dataset.sizes[name])
    others = [name for name in _AXES if name != along]
    places: list[dict[str, float]] = [{}]
    for name in others:
        values = [float(one) for one in dataset[name].values]
        places = [{**place, name: value} for place in places for value in values]
    if len(places) > _MOST_PANELS:
        chosen = np.unique(np.linspace(0, len(places) - 1, _MOST_PANELS).round().astype(int))
        places = [places[i] for i in chosen]
    return along, places


def _above_zero(values: Any) -> Any:
    # a logarithmic axis has no place for the torque at rest
    return np.where(values > 0.0, values, np.nan)


def axis_values(name: str, values: Any) -> Any:
    """Return values of a condition in the units of figures: rpm, N, degC."""
    if name == "speed":
        return rads_to_rpm(values)
    return kelvin_to_celsius(values) if name == "temperature" else values


def place_words(place: dict[str, float]) -> str:
    """Return the conditions of a place with units."""
    words = {
        "speed": lambda v: f"{rads_to_rpm(v):.4g} rpm",
        "axial_load": lambda v: f"{v:g} N axial",
        "radial_load": lambda v: f"{v:g} N radial",
        "temperature": lambda v: f"{kelvin_to_celsius(v):.4g} °C",
    }
    return ", ".join(words[name](value) for name, value in place.items())
