"""Figures of the sound: spectrogram, levels, metrics, what is heard, transfer path."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import xarray as xr

from gearlube.plotting.style import GREY, MARKERS, SERIES, house_style, new_figure, outlined
from gearlube.studies.sound.dataset import (
    is_ramp,
    level_names,
    level_range,
    level_values,
    order_name,
    speed_axis,
)
from gearlube.studies.sound.metrics import METRICS
from gearlube.studies.sound.order_tracks import AUDIBLE_SHARE, HeardRun
from gearlube.studies.sound.pressure import RATE, REFERENCE, a_weighting
from gearlube_core.arrays import Array

_RANGE = 60.0  # dB from the loudest to the darkest colour
_WINDOW = 0.1  # s
_DASHES = ("-", "--")
_TOP_ORDER = 1.15  # of the highest tracked order's frequency, end of the spectrogram


def spectrogram(runs: Sequence[HeardRun]) -> Any:
    """Return the A-weighted spectrogram of every run, with the tracked orders as lines."""
    from scipy.signal import ShortTimeFFT
    from scipy.signal.windows import hann

    size = int(_WINDOW * RATE)
    transform = ShortTimeFFT(hann(size, sym=False), size // 4, RATE, scale_to="magnitude")
    maps, top = [], max(_top(run) for run in runs)
    for run in runs:
        f = transform.f
        keep = (f > 0.0) & (f <= top)
        rms = np.abs(transform.stft(run.pressure.signal)[keep]) * np.sqrt(2.0)
        level = 20.0 * np.log10(np.maximum(rms * a_weighting(f[keep])[:, None], 1e-9) / REFERENCE)
        maps.append((transform.t(run.pressure.signal.size), f[keep], level))
    high = max(float(level.max()) for _, _, level in maps)
    with house_style():
        figure = new_figure(5.6 * len(runs) + 1.2, 4.8)
        panels = figure.subplots(1, len(runs), squeeze=False, sharey=True)[0]
        for ax, run, (time, f, level) in zip(panels, runs, maps, strict=True):
            mesh = ax.pcolormesh(
                time, f, level, vmin=high - _RANGE, vmax=high, cmap="magma", rasterized=True
            )
            _order_lines(ax, run.dataset, top)
            ax.set(
                xlabel="time [s]",
                title=str(run.dataset.attrs["name"]),
                xlim=(0.0, run.pressure.time[-1]),
                ylim=(0.0, top),
            )
            ax.grid(visible=False)
            _speed_on_top(ax, run.dataset)
        panels[0].set_ylabel("frequency [Hz]")
        figure.colorbar(mesh, ax=list(panels), label="level in 0.1 s windows [dB(A)]", pad=0.02)
    return figure


def levels(runs: Sequence[HeardRun]) -> Any:
    """Return the A-weighted levels of the whole sound and of every tracked order.

    One run: all in one panel. Two runs: a panel for each, with both runs.
    """
    names = level_names(runs[0].dataset)
    apart = len(runs) > 1
    rows = -(-len(names) // 2) if apart else 1
    with house_style():
        figure = new_figure(10.0, 1.0 + 2.3 * rows) if apart else new_figure(9.2, 5.0)
        shape = (rows, 2) if apart else (1, 1)
        panels = figure.subplots(*shape, squeeze=False, sharex=True, sharey=True).ravel()
        for i, name in enumerate(names):
            ax = panels[i if apart else 0]
            for j, run in enumerate(runs):
                values = level_values(run.dataset, i)
                if values is None:
                    continue
                look = {"color": SERIES[j], "ls": _DASHES[j], "label": run.dataset.attrs["name"]}
                if not apart:
                    look = {"color": ("black", *SERIES)[i % 7], "label": name}
                    look |= {"marker": ("", *MARKERS)[i % 7], "lw": 2.0 if i == 0 else 1.4}
                every = max(1, run.dataset.sizes["time"] // 12)
                ax.plot(_axis(run.dataset), values, markevery=every, **look)
            if apart:
                ax.set_title(name)
        for ax in panels[len(names) :]:
            ax.set_visible(False)
        for ax in panels[: len(names)][-2:]:
            ax.set_xlabel(_axis_label(runs[0].dataset))
            ax.tick_params(labelbottom=True)
        panels[0].set_ylim(*level_range([run.dataset for run in runs]))
        figure.supylabel("A-weighted level re 20 µPa [dB(A)]", fontsize=10)
        if apart:
            panels[0].legend(loc="upper left")
        else:
            panels[0].legend(loc="center left", bbox_to_anchor=(1.01, 0.5))
    return figure


def metrics(runs: Sequence[HeardRun]) -> Any:
    """Return every metric that was computed, one panel each; None without any."""
    names = [name for name in METRICS if name in runs[0].dataset]
    if not names:
        return None
    with house_style():
        figure = new_figure(8.6, 1.2 + 2.1 * len(names))
        panels = figure.subplots(len(names), 1, squeeze=False, sharex=True)[:, 0]
        for ax, name in zip(panels, names, strict=True):
            for i, run in enumerate(runs):
                if name not in run.dataset:
                    continue
                ax.plot(
                    _axis(run.dataset),
                    run.dataset[name],
                    color=SERIES[i],
                    ls=_DASHES[i],
                    label=str(run.dataset.attrs["name"]),
                )
            ax.set_ylabel(f"{METRICS[name].words}\n[{METRICS[name].unit}]")
            ax.set_ylim(bottom=0.0)
        panels[-1].set_xlabel(_axis_label(runs[0].dataset))
        if len(runs) > 1:
            panels[0].legend(loc="upper left", ncols=2)
    return figure


def heard_orders(runs: Sequence[HeardRun]) -> Any:
    """Return how much loudness goes with each order; None without loudness."""
    if "order_contribution" not in runs[0].dataset:
        return None
    with house_style():
        figure = new_figure(8.6, 0.9 + 3.0 * len(runs))
        panels = figure.subplots(len(runs), 1, squeeze=False, sharex=True, sharey=True)[:, 0]
        for ax, run in zip(panels, runs, strict=True):
            data, x = run.dataset, _axis(run.dataset)
            limit = AUDIBLE_SHARE * data["steady_loudness"].values
            ax.fill_between(x, 0.0, limit, color=GREY, alpha=0.5, lw=0.0, label="not heard")
            for i, order in enumerate(data["order"].values):
                ax.plot(
                    x,
                    data["order_contribution"].values[i],
                    color=SERIES[i % len(SERIES)],
                    marker=MARKERS[i % len(MARKERS)],
                    markevery=max(1, data.sizes["time"] // 12),
                    label=order_name(float(order), int(data.attrs["pinion_teeth"])),
                )
            ax.set(ylabel="loudness lost without\nthe order [sone]", title=str(data.attrs["name"]))
        panels[0].set_ylim(bottom=0.0)  # of all panels, once all are drawn
        panels[0].legend(loc="center left", bbox_to_anchor=(1.01, 0.5))
        panels[-1].set_xlabel(_axis_label(runs[0].dataset))
    return figure


def transfer(runs: Sequence[HeardRun]) -> Any:
    """Return the magnitude of every path that was used."""
    path = runs[0].path
    f = path.frequency
    with house_style():
        figure = new_figure(8.6, 4.2)
        ax = figure.subplots()
        sizes = {name: np.abs(one) for name, one in path.responses.items()}
        same = path.generic
        for i, (name, size) in enumerate(sizes.items()):
            if same and i:
                break
            ax.loglog(
                f[f > 0.0],
                np.maximum(size[f > 0.0], 1e-12),
                color=SERIES[i % len(SERIES)],
                ls=("-", "--", ":", "-.")[(i // len(SERIES)) % 4],
                label="every force" if same else name,
            )
        low, high = runs[0].pressure.band
        ax.axvspan(low, high, color=GREY, alpha=0.25, lw=0.0, label="band that is used")
        largest = max(float(size.max()) for size in sizes.values())
        smallest = min(float(size[size > 0.0].min(initial=largest)) for size in sizes.values())
        ax.set(
            xlabel="frequency [Hz]",
            ylabel="pressure per force [Pa/N]",
            ylim=(max(1e-4 * largest, 0.3 * smallest), 3.0 * largest),
            title="Generic path, not measured" if same else path.source,
        )
        ax.legend(loc="lower left", ncols=2)
    return figure


CATALOGUE = {
    "spectrogram": spectrogram,
    "levels": levels,
    "metrics": metrics,
    "heard_orders": heard_orders,
    "transfer_path": transfer,
}


def draw_all(runs: Sequence[HeardRun]) -> dict[str, Any]:
    """Return every figure by name; what there is no data for is left out."""
    drawn = {name: draw(runs) for name, draw in CATALOGUE.items()}
    return {name: figure for name, figure in drawn.items() if figure is not None}


def _axis(dataset: xr.Dataset) -> Array:
    return speed_axis(dataset)[0] if is_ramp(dataset) else dataset["time"].values


def _axis_label(dataset: xr.Dataset) -> str:
    if not is_ramp(dataset):
        return "time [s]"
    _, unit, words = speed_axis(dataset)
    return f"{words} [{unit}]"


def _top(run: HeardRun) -> float:
    fastest = float(run.dataset["pinion_speed"].max()) / (2.0 * np.pi)
    highest = float(run.dataset["order"].max()) * fastest * _TOP_ORDER
    return min(run.pressure.band[1], max(500.0, highest))


def _order_lines(ax: Any, dataset: xr.Dataset, top: float) -> None:
    time = dataset["time"].values
    per_turn = dataset["pinion_speed"].values / (2.0 * np.pi)
    for order in dataset["order"].values:
        f = order * per_turn
        at = int(0.06 * f.size)
        if f[at] > top:
            continue
        ax.plot(time[:at], f[:at], color="white", lw=0.8, ls=":")
        label = order_name(float(order), int(dataset.attrs["pinion_teeth"]))
        text = ax.text(time[at], f[at], label.replace("mesh order ", "mesh "), color="white")
        text.set(fontsize=8.5, va="bottom")
        outlined(text)


def _speed_on_top(ax: Any, dataset: xr.Dataset) -> None:
    """Mark the speed along the upper edge."""
    if not is_ramp(dataset):
        return
    speed, unit, words = speed_axis(dataset)
    time = dataset["time"].values
    if not (np.all(np.diff(speed) >= 0.0) or np.all(np.diff(speed) <= 0.0)):
        return
    places = time[np.linspace(0, time.size - 1, 5).astype(int)]
    upper = ax.twiny()
    upper.set_xlim(ax.get_xlim())
    upper.set_xticks(places, [f"{value:.0f}" for value in np.interp(places, time, speed)])
    upper.set_xlabel(f"{words} [{unit}]", fontsize=9)
    upper.grid(visible=False)
    upper.spines["top"].set_visible(True)
