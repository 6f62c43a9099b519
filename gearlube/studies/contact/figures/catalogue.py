"""The figures of a tooth contact analysis, in reading order."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

from gearlube.plotting.style import GREY, SERIES, WIDTHS, house_style, new_figure
from gearlube.plotting.words import mark_edge_pressure
from gearlube.report.pictures import Picture
from gearlube.studies.contact.figures.flank_maps import (
    _SIDES,
    _spread,
    ease_off_map,
    loaded_error,
    pressure_maps,
)

_LOADED = 1e-3  # share above which a pair is drawn


def contact_properties(dataset: xr.Dataset) -> Any:
    """Return curvature and motion at a pair's centre of force over its contact, by torque.

    Compare [karagiannis_2012 fig. 18a]: R_zx along the sliding, entrainment.
    """
    rows = (
        ("R_x", "$R_x$, minor axis [mm]", 1e3),
        ("R_y", "$R_y$, major axis [m]", 1.0),
        ("R_sliding", "$R_{zx}$, along sliding [mm]", 1e3),
        ("entrainment_arm", "entrainment / $\\omega_p$ [mm]", 1e3),
        ("sliding_arm", "sliding / $\\omega_p$ [mm]", 1e3),
        ("psi", "entrainment angle [°]", 180.0 / np.pi),
        ("chi", "sliding angle [°]", 180.0 / np.pi),
    )
    title = "A tooth pair from entry to exit: curvature and motion (angles from the minor axis)"
    return _pair_figure(dataset, rows, title, 13.0, {"R_sliding"})


def _pair_figure(
    dataset: xr.Dataset,
    rows: tuple[tuple[str, str, float], ...],
    title: str,
    height: float,
    logarithmic: set[str] | None = None,
) -> Any:
    from matplotlib.ticker import LogFormatter

    with house_style():
        figure = new_figure(9.6, height)
        axes = figure.subplots(len(rows), 2, sharex=True, sharey="row")
        for column, side in enumerate(_SIDES):
            part = dataset.sel(side=side)
            phase = (part["phase"].values[:, None] + part["pair"].values).ravel()
            order = np.argsort(phase)
            for ax, (name, label, scale) in zip(axes[:, column], rows, strict=True):
                for row, torque in enumerate(_spread(part["torque"].values)):
                    state = part.sel(torque=torque)
                    values = np.where(
                        state["share"].values > _LOADED, scale * state[name].values, np.nan
                    )
                    ax.plot(
                        phase[order],
                        values.ravel()[order],
                        color=SERIES[row],
                        lw=WIDTHS[row],
                        label=f"{torque:g} N·m",
                    )
                if name == "pressure_max":
                    mark_edge_pressure(ax)
                if logarithmic and name in logarithmic:
                    ax.set_yscale("log")
                    ax.yaxis.set_major_formatter(LogFormatter())
                elif name != "R_y" and column == 1:  # both sides are drawn, so the top is known
                    ax.set_ylim(bottom=0.0)
                if column == 0:
                    ax.set_ylabel(label)
            axes[0, column].set_title(_SIDES[side])
            axes[-1, column].set_xlabel("pinion rotation [mesh periods]")
        handles, labels = axes[0, 0].get_legend_handles_labels()
        figure.legend(handles, labels, ncols=5, loc="outside lower center")
        figure.suptitle(title, fontsize=11.5)
    return figure


def _load_shares(dataset: xr.Dataset) -> Any:
    """Return the load share and the highest pressure of a pair over its contact, by torque."""
    rows = (("share", "load share [-]", 1.0), ("pressure_max", "highest pressure [GPa]", 1e-9))
    return _pair_figure(dataset, rows, "A tooth pair from entry to exit: load and pressure", 6.4)


def _transmission_errors(dataset: xr.Dataset) -> Any:
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


def _two_periods(phase: Any, values: Any) -> tuple[Any, Any]:
    x = np.concatenate([phase, phase + 1.0, [2.0]])
    return x, np.concatenate([values, values, values[:1]])


def _stiffness_against_torque(dataset: xr.Dataset) -> Any:
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


def _stiffness_and_radii(dataset: xr.Dataset) -> Any:
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
                for row, torque in enumerate(_spread(part["torque"].values)):
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


def _loaded(ax: Any, part: xr.Dataset) -> None:
    for row, torque in enumerate(_spread(part["torque"].values)):
        state = part.sel(torque=torque)
        x, y = _two_periods(part["phase"].values, loaded_error(state))
        ax.plot(x, y, color=SERIES[row], label=f"{torque:g} N·m")
    ax.set_xlim(0.0, 2.0)
    ax.set_ylabel("approach of the teeth [µm]")


def _drive(part: xr.Dataset) -> bool:
    return str(part["side"].values) == "drive"


CONTACT_CATALOGUE = {
    "pressure": Picture(
        pressure_maps,
        "Contact pattern and pressure on the gear tooth",
        "Highest pressure at each place of the gear tooth while it passes through the mesh, for "
        "each side and torque. A good pattern stays inside the outline. Blue lines at tip or root "
        "are sharp edges that press into the flank; tip relief helps there.",
    ),
    "ease_off": Picture(
        ease_off_map,
        "Contact pattern without load",
        "Gap between the flank and one that would roll without error, with the path of contact "
        "and the pattern of a marking test. Compare the red outline with the pattern of your "
        "testing machine.",
    ),
    "transmission_error": Picture(
        _transmission_errors,
        "Transmission error",
        "Static error over two mesh periods along the line of action, for some torques. The swing "
        "of a curve excites the whine at its torque; the torque with the smallest swing is "
        "quietest.",
    ),
    "load_share": Picture(
        _load_shares,
        "A tooth pair from entry to exit",
        "Share of the torque that one pair carries, and its highest pressure. In the grey zone a "
        "sharp edge presses: such a pressure is no number, it grows with finer cells.",
    ),
    "stiffness": Picture(
        _stiffness_and_radii,
        "Mesh stiffness and contact radii",
        "Over two mesh periods, for some torques. Secant: force over closing; tangent: slope of "
        "force over closing, which governs vibration.",
    ),
    "stiffness_torque": Picture(
        _stiffness_against_torque,
        "Mesh stiffness over torque",
        "Mean stiffness over the mesh, and the number of pairs that carry load. Both grow with the "
        "torque, because the contact spreads.",
    ),
    "contact_properties": Picture(
        contact_properties,
        "Curvature and motion in the contact",
        "At the centre of force of one pair from entry to exit: relative radii, entrainment and "
        "sliding per pinion speed. Entrainment builds the film; sliding makes heat.",
    ),
}
