"""Figures of a damage run: maps on the drawn tooth, and the bins that matter most."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import xarray as xr

from gearlube.plotting.drawn_tooth import DrawnTooth, ToothWords
from gearlube.plotting.style import house_style, new_figure

_MAPS = {
    "pressure_map": ("largest Hertz pressure", "GPa", "magma_r"),
    "film_map": ("thinnest film over roughness", "", "viridis"),
    "flash_map": ("greatest rise of temperature", "K", "magma_r"),
    "heat_map": ("greatest friction power", "W/mm²", "magma_r"),
    "wear_map": ("wear depth", "µm", "cividis_r"),
    "local_damage_map": ("local pitting damage", "", "cividis_r"),
    "fracture_map": ("flank fracture, greatest A_FF", "", "magma_r"),
    "fatigue_map": ("Dang Van, compression does not help", "", "magma_r"),
}
_STRESS, _SHARE = "stress and strength [MPa]", "share of the limit"
_OVER_DEPTH = {
    "shear_strength": (_STRESS, "shear strength by hardness"),
    "shear_amplitude": (_STRESS, "amplitude of shear"),
    "fracture_profile": (_SHARE, "flank fracture, A_FF"),
    "fatigue_bound_profile": (_SHARE, "Dang Van, compression does not help"),
    "fatigue_profile": (_SHARE, "Dang Van, compression helps"),
}
_BARS = {"contact_damage": "pitting damage by the standard", "wear": "wear depth [µm]"}
_SHOWN, _LEAST = 10, 1e-3  # bins in a chart, and the share of the sum that is shown
_NARROW = 2.0  # width over height, below which a tooth fills its panel
_FAINT = 0.01  # of the deepest wear; what the splines spread farther is not drawn
_INSIDE = 99.0  # percent of the cells that the colours span


def damage_figures(dataset: xr.Dataset) -> dict[str, Any]:
    """Return the figures by name: maps of each flank that bears load, and bins with damage."""
    sides = [one for one in ("drive", "coast") if dataset["pressure_map"].sel(side=one).any()]
    maps = {f"maps_{side}": tooth_figure(dataset.sel(side=side), side) for side in sides}
    kept = {name: words for name, words in _BARS.items() if name in dataset and dataset[name].any()}
    under = {"under_surface": depth_figure(dataset, sides)} if "depth" in dataset else {}
    steps = {"wear_steps": steps_figure(dataset)} if "worn_life" in dataset else {}
    return maps | under | steps | ({"bins": bin_figure(dataset, kept)} if kept else {})


def tooth_figure(dataset: xr.Dataset, side: str) -> Any:
    """Return the maps of one side on the drawn gear tooth; wear and damage of both members."""
    x, y = dataset["along"].values, dataset["up"].values
    words_of = ToothWords(*json.loads(dataset.attrs["drawn"]))
    tooth = DrawnTooth(float(x[0] + x[-1]), float(y[0] + y[-1]), words_of)
    drawn: list[tuple[str, str, str, Any]] = []
    for name, (words, unit, colours) in _MAPS.items():
        if name not in dataset:
            continue
        maps = dataset[name].values
        if np.nanmax(maps, initial=0.0) > 0.0:
            each = {words: maps} if maps.ndim == 2 else dict(
                zip((f"{words}, pinion", f"{words}, gear"), maps, strict=True)
            )  # fmt: skip
            drawn += [(title, unit, colours, values) for title, values in each.items()]
    rows = (len(drawn) + 1) // 2
    with house_style():
        figure = new_figure(10.5, 0.9 + 1.75 * rows)
        axes = figure.subplots(rows, 2, squeeze=False)
        for ax, (title, unit, colours, values) in zip(axes.ravel(), drawn, strict=False):
            shown = np.where(values > 0.0, values, np.nan)
            top = float(np.nanpercentile(shown, _INSIDE))
            image = ax.pcolormesh(x, y, shown, cmap=colours, vmin=0.0, vmax=top, rasterized=True)
            tooth.draw(ax, title)
            if tooth.width < _NARROW * tooth.height:
                ax.set_aspect("auto")
            figure.colorbar(image, ax=ax, label=unit, shrink=0.85)
        for ax in axes[:-1].ravel():
            ax.set_xlabel("")
        for ax in axes.ravel()[len(drawn) :]:
            ax.remove()
        figure.suptitle(
            f"{side.capitalize()} side over the whole life. {words_of.where}", fontsize=10.5
        )
    return figure


def depth_figure(dataset: xr.Dataset, sides: Sequence[str]) -> Any:
    """Return stress, strength and shares of limits over depth at the worst place of each side."""
    kept = {name: words for name, words in _OVER_DEPTH.items() if name in dataset}
    labels = list(dict.fromkeys(label for label, _ in kept.values()))
    with house_style():
        figure = new_figure(10.5, 0.9 + 2.7 * len(labels))
        axes = figure.subplots(len(labels), len(sides), squeeze=False, sharex=True, sharey="row")
        for k, side in enumerate(sides):
            of_side = dataset.sel(side=side)
            for name, (label, words) in kept.items():
                ax = axes[labels.index(label), k]
                ax.plot(of_side["depth"].values, of_side[name].values, label=words)
            for label, ax in zip(labels, axes[:, k], strict=True):
                ax.set_ylim(0.0)
                ax.set_ylabel(label)
                ax.legend(title=f"{side} side", loc="upper right")
            axes[-1, k].axhline(1.0, color="0.4", linestyle=":", linewidth=1.0)
            axes[-1, k].set_xlabel("depth below the flank [mm]")
        figure.suptitle("Under the surface, at the worst place of the whole life", fontsize=10.5)
    return figure


def steps_figure(dataset: xr.Dataset) -> Any:
    """Return depth over the life, pressure and maps of the side that wears most."""
    side = int(dataset["worn_depth"].values[-1].max(axis=1).argmax())
    found = dataset.isel(side=side)
    hours = found["worn_life"].values * float(dataset["hours"].sum())
    x, y = dataset["along"].values, dataset["up"].values
    tooth = DrawnTooth(float(x[0] + x[-1]), float(y[0] + y[-1]))
    with house_style():
        figure = new_figure(10.5, 5.6)
        (over, profile), maps = figure.subplots(2, 2, height_ratios=(1.6, 1.0))
        for member, role in enumerate(("pinion", "gear")):
            (line,) = over.plot(hours, found["worn_depth"][:, member], "o-", label=role)
            rate = found["worn_rate"].values[0, member] * found["worn_life"].values
            over.plot(
                hours, rate, ":", color=line.get_color(), label=f"{role}, rate of the new flank"
            )
            worn = found["worn_map"].values[member]
            shown = np.where(worn > _FAINT * worn.max(), worn, np.nan)
            image = maps[member].pcolormesh(
                x, y, shown, cmap="cividis_r", vmin=0.0, rasterized=True
            )
            tooth.draw(maps[member], f"wear depth, {role}")
            figure.colorbar(image, ax=maps[member], label="µm", shrink=0.85)
        over.set(xlabel="hours", ylabel="wear depth at the worst place [µm]")
        for step, style, words in ((0, "--", "new"), (-1, "-", "worn")):
            profile.plot(dataset["worn_phase"], found["worn_profile"][step], style, label=words)
        profile.set(xlabel="mesh periods of a pair", ylabel="Hertz pressure [GPa]")
        for ax in (over, profile):
            ax.set_ylim(0.0)
            ax.legend()
        name = str(dataset["side"].values[side])
        figure.suptitle(f"Wear in steps, {name} side. {tooth.words.where}", fontsize=10.5)
    return figure


def bin_figure(dataset: xr.Dataset, kept: Mapping[str, str]) -> Any:
    """Return the bins that do most of each variable; `kept` has its words."""
    names = json.loads(dataset.attrs["bins"])
    with house_style():
        figure = new_figure(10.5, 4.0)
        for ax, (name, words) in zip(
            np.ravel(figure.subplots(1, len(kept))), kept.items(), strict=True
        ):
            values = dataset[name].values
            worst = np.argsort(values.max(axis=1))[::-1][:_SHOWN]
            worst = worst[values.max(axis=1)[worst] > _LEAST * values.max(axis=1).sum()]
            for member, role in enumerate(("pinion", "gear")):
                places = np.arange(worst.size) + 0.4 * member - 0.2
                ax.barh(places, values[worst, member], 0.4, label=role)
            ax.set_yticks(range(worst.size), [names[i] for i in worst], fontsize=8)
            ax.set_ylim(max(worst.size, 4) - 0.5, -0.5)
            ax.set_xlabel(words)
            ax.legend(loc="lower right")
        figure.suptitle("The bins that matter most", fontsize=10.5)
    return figure
