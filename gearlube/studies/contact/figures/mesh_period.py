"""Quantities that repeat every mesh period: transmission error, stiffness, contact radii."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

from gearlube.plotting.style import GREY, SERIES, house_style, new_figure
from gearlube.studies.contact.figures.flank_maps import _SIDES, _spread


def transmission_errors(dataset: xr.Dataset) -> Any:
    """Return single-pair errors and the unloaded and loaded transmission error over two periods.

    Compare [karagiannis_2012 fig. 7].
    """
    with house_style():
        figure = new_figure(9.6, 7.0)
        axes = figure.subplots(2, 2, sharex="row")
        axes[1, 1].sharey(axes[1, 0])
        for column, side in enumerate(_SIDES):
            part = dataset.sel(side=side)
            _single_pairs(axes[0, column], part)
            axes[0, column].set_title(f"{_SIDES[side]}: unloaded")
            _loaded(axes[1, column], part)
            axes[1, column].set_title(f"{_SIDES[side]}: loaded, mean removed")
            axes[1, column].set_xlabel("pinion rotation [mesh periods]")
        unloaded, loaded = (ax.get_legend_handles_labels() for ax in axes[:, 0])
        handles, labels = (one + other for one, other in zip(unloaded, loaded, strict=True))
        figure.legend(handles, labels, ncols=7, loc="outside lower center")
        figure.suptitle("Static transmission error along the line of action", fontsize=11.5)
    return figure


def _single_pairs(ax: Any, part: xr.Dataset) -> None:
    arm = float(part["R_p"].mean())
    phase, error = part["path_phase"].values, arm * 1e6 * part["path_error"].values
    zero = float(
        np.nanmin(part["error"].values) if _drive(part) else np.nanmax(part["error"].values)
    )
    for shift in (-1, 0, 1, 2):
        label = "one pair alone, unloaded" if shift == 0 else None
        ax.plot(phase + shift, error - zero * arm * 1e6, color=GREY, lw=1.2, label=label)
    x, y = _two_periods(part["fine_phase"].values, arm * 1e6 * (part["error"].values - zero))
    ax.plot(x, y, color="black", label="the pairs in turn, unloaded")
    span = max(float(np.ptp(y)), 0.1)
    ax.set(xlim=(0.0, 2.0), ylim=(y.min() - 0.4 * span, y.max() + 0.6 * span))
    ax.set_ylabel("gear lags [µm]")


def _loaded(ax: Any, part: xr.Dataset) -> None:
    for row, torque in enumerate(_spread(part["torque"].values, 5)):
        state = part.sel(torque=torque)
        error = 1e6 * float(state["R_p"].mean()) * state["rotation"].values
        x, y = _two_periods(part["phase"].values, error - error.mean())
        ax.plot(x, y, color=SERIES[row], label=f"{torque:g} N·m")
    ax.set_xlim(0.0, 2.0)
    ax.set_ylabel("approach of the teeth [µm]")


def stiffness_and_radii(dataset: xr.Dataset) -> Any:
    """Return mesh stiffness and contact radii over their means against pinion rotation.

    Compare [karagiannis_2012 fig. 6].
    """
    rows = (
        ("k_m", "secant stiffness [N/µm]", 1e-6),
        ("k_t", "tangent stiffness [N/µm]", 1e-6),
        ("R_p", "pinion contact radius [mm]", 1e3),
        ("R_g", "gear contact radius [mm]", 1e3),
    )
    with house_style():
        figure = new_figure(9.6, 9.6)
        axes = figure.subplots(len(rows), 2, sharex=True, sharey="row")
        for column, side in enumerate(_SIDES):
            part = dataset.sel(side=side)
            for ax, (name, label, scale) in zip(axes[:, column], rows, strict=True):
                for row, torque in enumerate(_spread(part["torque"].values, 5)):
                    values = scale * part[name].sel(torque=torque).values
                    x, y = _two_periods(part["phase"].values, values)
                    ax.plot(x, y, color=SERIES[row], label=f"{torque:g} N·m")
                if column == 0:
                    ax.set_ylabel(label)
            axes[0, column].set_title(_SIDES[side])
            axes[-1, column].set_xlabel("pinion rotation [mesh periods]")
        axes[0, 0].set_ylim(bottom=0.0)
        axes[1, 0].set_ylim(bottom=0.0)
        axes[-1, 0].set_xlim(0.0, 2.0)
        handles, labels = axes[0, 0].get_legend_handles_labels()
        figure.legend(handles, labels, ncols=5, loc="outside lower center")
        figure.suptitle("Mesh stiffness and contact radii", fontsize=11.5)
    return figure


def stiffness_against_torque(dataset: xr.Dataset) -> Any:
    """Return mean secant and tangent stiffness, their range, and pairs in contact, by torque."""
    with house_style():
        figure = new_figure(9.0, 4.2)
        left, right = figure.subplots(1, 2)
        for column, side in enumerate(_SIDES):
            part = dataset.sel(side=side)
            torque = part["torque"].values
            for name, style, what in (("k_m", "-", "secant"), ("k_t", "--", "tangent")):
                values = 1e-6 * part[name].values
                left.plot(
                    torque,
                    values.mean(axis=0),
                    ls=style,
                    color=SERIES[column],
                    label=f"{side}, {what}",
                )
                left.fill_between(
                    torque,
                    values.min(axis=0),
                    values.max(axis=0),
                    color=SERIES[column],
                    alpha=0.12,
                    lw=0,
                    label="range over the mesh" if column == 1 and name == "k_t" else None,
                )
            pairs = (part["share"].values > 1e-3).sum(axis=-1)
            right.plot(torque, pairs.mean(axis=0), color=SERIES[column], label=f"{side}, mean")
            right.plot(
                torque, pairs.max(axis=0), ls=":", color=SERIES[column], label=f"{side}, most"
            )
        left.set(xlabel="pinion torque [N·m]", ylabel="mesh stiffness [N/µm]", ylim=(0.0, None))
        right.set(xlabel="pinion torque [N·m]", ylabel="tooth pairs in contact", ylim=(0.0, None))
        left.legend()
        right.legend()
        figure.suptitle("Mesh stiffness and pairs in contact against torque", fontsize=11.5)
    return figure


def _drive(part: xr.Dataset) -> bool:
    return str(part["side"].values) == "drive"


def _two_periods(phase: Any, values: Any) -> tuple[Any, Any]:
    x = np.concatenate([phase, phase + 1.0, [2.0]])
    return x, np.concatenate([values, values, values[:1]])
