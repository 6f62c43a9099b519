"""Waveforms, spectra, phase portraits and the Poincare section."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

from gearlube.plotting.style import GREY, MARKERS, SERIES, house_style, new_figure
from gearlube.studies.resonance.figures.response_curves import COLOURS
from gearlube.studies.resonance.settings import MODELS

_DRY = ("two_dof", "one_dof")


def _title(relative: float) -> str:
    """Return where the mesh frequency is, a part of the natural frequency."""
    part = "" if np.isclose(relative, 1.0) else f"{relative:g} of "
    return f"mesh at {part}the natural frequency"


def _at(cycle: xr.Dataset, relative: float, models: tuple[str, ...]) -> list[xr.Dataset]:
    """Return the motions of some models at a frequency, in the order of the models."""
    return [
        cycle.isel(motion=number)
        for model in models
        for number in np.flatnonzero(
            (cycle["motion_model"].values == model)
            & (cycle["motion_relative_frequency"].values == relative)
        )
    ]


def _frequencies(cycle: xr.Dataset) -> list[float]:
    return [float(value) for value in np.unique(cycle["motion_relative_frequency"].values)]


def _label(motion: xr.Dataset) -> str:
    name = MODELS[str(motion["motion_model"].values)]
    return name if motion["motion_stable"] > 0.5 else f"{name}, unstable"


def _draw(ax: Any, motion: xr.Dataset, **style: Any) -> None:
    look = {
        "color": COLOURS[str(motion["motion_model"].values)],
        "ls": "-" if motion["motion_stable"] > 0.5 else "--",
        "label": _label(motion),
    }
    ax.plot(motion["sample"], 1e6 * motion["x"], **(look | style))


def _no_contact(ax: Any) -> None:
    """Shade where teeth are apart, if that is within the axes."""
    low, high = ax.get_ylim()
    if low < 0.0:
        ax.axhspan(low, 0.0, color=GREY, alpha=0.3, lw=0)
        ax.set_ylim(low, high)


def time_histories(cycle: xr.Dataset) -> Any:
    """Return waveforms of both dry models over two mesh periods.

    Compare [karagiannis_2012 fig. 8b] [karagiannis_2012 fig. 9] [karagiannis_2012 fig. 11].
    """
    return _waveforms(
        cycle, _DRY, "Transmission error of all coexisting motions, grey: teeth apart"
    )


def _waveforms(cycle: xr.Dataset, models: tuple[str, ...], title: str) -> Any:
    frequencies = _frequencies(cycle)
    with house_style():
        figure = new_figure(9.6, 2.5 * len(frequencies) + 0.8)
        axes = np.atleast_1d(figure.subplots(len(frequencies), 1, sharex=True))
        for ax, relative in zip(axes, frequencies, strict=True):
            for motion in _at(cycle, relative, models):
                _draw(ax, motion)
            ax.set(title=_title(relative), xlim=(0.0, 2.0))
            ax.set_ylabel("transmission\nerror x [µm]")
            _no_contact(ax)
        axes[-1].set_xlabel("pinion rotation [mesh periods]")
        _shared_legend(figure, axes)
        figure.suptitle(title, fontsize=11.5)
    return figure


def _shared_legend(figure: Any, axes: Any) -> None:
    named: dict[str, Any] = {}
    for ax in np.ravel(axes):
        for handle, label in zip(*ax.get_legend_handles_labels(), strict=True):
            named.setdefault(label, handle)
    figure.legend(named.values(), named.keys(), ncols=3, loc="outside lower center")


def spectra(cycle: xr.Dataset) -> Any:
    """Return the amplitudes of mesh orders of both dry models, on one scale.

    Compare [karagiannis_2012 fig. 10] [karagiannis_2012 fig. 12].
    """
    frequencies = _frequencies(cycle)
    with house_style():
        figure = new_figure(3.2 * len(frequencies) + 0.8, 4.4)
        axes = np.atleast_1d(figure.subplots(1, len(frequencies), sharey=True))
        for ax, relative in zip(axes, frequencies, strict=True):
            _stems(ax, cycle, _at(cycle, relative, _DRY))
            ax.set(title=_title(relative), xlabel="mesh order")
        axes[0].set_ylabel("amplitude [µm]")
        top = 1e6 * float(cycle["spectrum"].where(cycle["order"] > 0.0).max())
        axes[0].set_ylim(_LEAST_AMPLITUDE, 2.0 * top)  # one scale for all panels
        _shared_legend(figure, axes)
        figure.suptitle(
            f"Orders of the transmission error{_last_words(cycle)}; stable motions", fontsize=11.5
        )
    return figure


def _last_order(cycle: xr.Dataset) -> int:
    """Return the highest mesh order that is drawn: the mesh table excites no higher one."""
    return min(_MOST_ORDERS, int(cycle.attrs.get("mesh_orders", _MOST_ORDERS)))


def _last_words(cycle: xr.Dataset) -> str:
    last = _last_order(cycle)
    return f" up to {last}, the last of the mesh table" if last < _MOST_ORDERS else ""


_MOST_ORDERS, _LEAST_AMPLITUDE = 8, 1e-3  # um


def _stems(ax: Any, cycle: xr.Dataset, motions: list[xr.Dataset]) -> None:
    """Draw the orders of stable motions beside each other on a logarithmic scale."""
    stable = [motion for motion in motions if motion["motion_stable"] > 0.5]
    last = _last_order(cycle)
    for place, motion in enumerate(stable):
        amplitude = 1e6 * motion["spectrum"].values
        orders = motion["order"].values
        kept = (orders > 0.0) & (orders <= last) & (amplitude > _LEAST_AMPLITUDE)
        model = str(motion["motion_model"].values)
        at = orders[kept] + 0.16 * (place - 0.5 * (len(stable) - 1))
        ax.vlines(at, _LEAST_AMPLITUDE, amplitude[kept], color=COLOURS[model], lw=2.2)
        marker = MARKERS[list(COLOURS).index(model)]
        ax.plot(at, amplitude[kept], marker, color=COLOURS[model], ms=6, label=_label(motion))
    ax.set(yscale="log", xlim=(0.4, last + 0.6), xticks=range(1, last + 1))
    ax.set_ylim(bottom=_LEAST_AMPLITUDE)


def constant_radii(cycle: xr.Dataset) -> Any:
    """Return waveforms and orders of the models with constant radii.

    Compare [karagiannis_2012 fig. 13] [karagiannis_2012 fig. 14].
    """
    models = ("two_dof_mean_radii", "one_dof")
    frequencies = [value for value in _frequencies(cycle) if value != 0.65]
    with house_style():
        figure = new_figure(9.6, 2.7 * max(len(frequencies), 1) + 0.8)
        axes = figure.subplots(max(len(frequencies), 1), 2, squeeze=False)
        for row, relative in zip(axes, frequencies, strict=False):
            motions = _at(cycle, relative, models)
            for motion in motions:
                wide = str(motion["motion_model"].values) == "two_dof_mean_radii"
                _draw(row[0], motion, lw=2.4 if wide else 1.2)
            _no_contact(row[0])
            _stems(row[1], cycle, motions)
            row[0].set(title=_title(relative), ylabel="x [µm]", xlim=(0.0, 2.0))
            row[1].set(title=_title(relative), ylabel="amplitude [µm]")
        axes[-1, 0].set_xlabel("pinion rotation [mesh periods]")
        axes[-1, 1].set_xlabel("mesh order")
        _shared_legend(figure, axes[:, :1])
        figure.suptitle("Constant contact radii", fontsize=11.5)
    return figure


def dry_and_lubricated(cycle: xr.Dataset) -> Any:
    """Return waveforms of the 2-DOF model with and without friction, and their difference.

    Compare [karagiannis_2012 fig. 16] [karagiannis_2012 fig. 17].
    """
    frequencies = _frequencies(cycle)
    with house_style():
        figure = new_figure(9.6, 2.6 * len(frequencies) + 0.8)
        axes = figure.subplots(len(frequencies), 2, sharex=True, squeeze=False)
        for (left, right), relative in zip(axes, frequencies, strict=True):
            pairs = [
                [motion for motion in _at(cycle, relative, (model,)) if motion["motion_stable"] > 0]
                for model in ("two_dof", "two_dof_lubricated")
            ]
            for motions, lw in zip(pairs, (2.6, 1.2), strict=True):
                for motion in motions:
                    _draw(left, motion, lw=lw)
            for dry, wet in zip(*pairs, strict=False):
                right.plot(dry["sample"], 1e9 * (wet["x"] - dry["x"]), color="black")
            left.set(title=_title(relative), ylabel="x [µm]", xlim=(0.0, 2.0))
            right.set(title="lubricated minus dry", ylabel="difference [nm]")
            _no_contact(left)
        for ax in axes[-1]:
            ax.set_xlabel("pinion rotation [mesh periods]")
        _shared_legend(figure, axes[:, :1])
        figure.suptitle("Transmission error with and without flank friction", fontsize=11.5)
    return figure


def phase_portraits(cycle: xr.Dataset) -> Any:
    """Return rate against transmission error of all motions; dots at mesh phase zero."""
    frequencies = _frequencies(cycle)
    models = ("two_dof", "one_dof", "two_dof_lubricated")
    with house_style():
        figure = new_figure(3.4 * len(frequencies) + 0.6, 4.4)
        axes = np.atleast_1d(figure.subplots(1, len(frequencies)))
        for ax, relative in zip(axes, frequencies, strict=True):
            for motion in _at(cycle, relative, models):
                model = str(motion["motion_model"].values)
                ax.plot(
                    1e6 * motion["x"],
                    1e3 * motion["rate"],
                    color=COLOURS[model],
                    lw=0.9 if "lubricated" in model else 1.6,
                    ls="-" if motion["motion_stable"] > 0.5 else "--",
                    label=_label(motion),
                )
                ax.plot(1e6 * motion["x"][0], 1e3 * motion["rate"][0], "o", color=COLOURS[model])
            left, right = ax.get_xlim()
            if left < 0.0:
                ax.axvspan(left, 0.0, color=GREY, alpha=0.3, lw=0)
                ax.set_xlim(left, right)
            ax.set(title=_title(relative), xlabel="x [µm]")
        axes[0].set_ylabel("dx/dt [mm/s]")
        _shared_legend(figure, axes)
        figure.suptitle(
            "Phase portraits of the transmission error x; dots: mesh phase 0; grey: teeth apart",
            fontsize=11.5,
        )
    return figure


def poincare_section(cycle: xr.Dataset) -> Any:
    """Return the Poincare section: motions from many starts, sampled once per mesh period."""
    x, rate = 1e6 * cycle["section_x"].values, 1e3 * cycle["section_rate"].values
    relative = cycle.attrs["section_relative_frequency"]
    with house_style():
        figure = new_figure(9.6, 5.2)
        left, right = figure.subplots(1, 2)
        ends = _groups(x[:, -1], rate[:, -1])
        for start in range(x.shape[0]):
            colour = SERIES[int(ends[start]) % len(SERIES)]
            left.plot(x[start, :60], rate[start, :60], ".", ms=2.2, color=colour, alpha=0.7)
            left.plot(x[start, 0], rate[start, 0], "x", ms=4.5, mew=0.9, color=colour)
            right.plot(np.arange(x.shape[1]), x[start], color=colour, lw=0.7, alpha=0.8)
        for group in np.unique(ends):
            member = int(np.flatnonzero(ends == group)[0])
            left.plot(
                x[member, -1],
                rate[member, -1],
                "o",
                ms=8,
                mfc=SERIES[int(group) % len(SERIES)],
                mec="black",
                zorder=5,
            )
        saddles = cycle["section_motion_stable"].values < 0.5
        left.plot(
            1e6 * cycle["section_motion_x"].values[saddles],
            1e3 * cycle["section_motion_rate"].values[saddles],
            "s",
            ms=6,
            mfc="white",
            mec="black",
            zorder=5,
            label="unstable periodic motion",
        )
        left.plot([], [], "x", color="#404040", label="start")
        left.plot([], [], "o", ms=8, mfc="white", mec="black", label="after 240 mesh periods")
        figure.legend(*left.get_legend_handles_labels(), ncols=3, loc="outside lower center")
        left.set(xlabel="x [µm]", ylabel="dx/dt [mm/s]", title="at mesh phase 0")
        right.set_xlim(0.0, 100.0)
        right.set(xlabel="mesh periods", ylabel="x at mesh phase 0 [µm]", title="approach")
        figure.suptitle(
            f"Poincaré section of the dry 2-DOF model at {relative:.3f} of the natural frequency; "
            "colour by the motion reached",
            fontsize=11.5,
        )
    return figure


def _groups(x: np.ndarray, rate: np.ndarray) -> np.ndarray:
    """Return a number for each end point; points closer than 2 % of the spread share one."""
    points = np.column_stack([values / max(float(np.ptp(values)), 1e-3) for values in (x, rate)])
    numbers = np.full(x.size, -1)
    for i, point in enumerate(points):
        near = np.flatnonzero((numbers >= 0) & (np.hypot(*(points - point).T) < 0.02))
        numbers[i] = numbers[near[0]] if near.size else numbers.max() + 1
    return numbers
