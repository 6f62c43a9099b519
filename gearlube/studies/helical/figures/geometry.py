"""Figures of the path of contact, of its loads and of their layout."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import xarray as xr

from gearlube.plotting.style import (
    BLUE,
    GREEN,
    GREY,
    PURPLE,
    SERIES,
    VERMILLION,
    house_style,
    new_figure,
)
from gearlube.studies.helical.figures.layout import RPM
from gearlube_core.arrays import Array

MILLI, MICRO, KILO = 1e3, 1e6, 1e-3
_DEGREES = 180.0 / np.pi


def pair_name(dataset: xr.Dataset) -> str:
    """Return the pair's name with its teeth."""
    of = dataset.attrs
    return f"{of['name']} ({of['pinion_teeth']}:{of['gear_teeth']})"


def shown_name(dataset: xr.Dataset, number: int) -> str:
    """Return the number and position of a shown contact line."""
    position = MILLI * float(dataset["shown_position"].sel(shown=number))
    return f"line {number}: $s_i$ = ${position:.1f}$ mm"


def columns(datasets: Sequence[xr.Dataset], rows: int, height: float, **share: Any) -> Any:
    """Return a figure and its axes, shape (rows, pairs), each column headed by its pair."""
    figure = new_figure(max(6.4, 5.2 * len(datasets)), height)
    axes = figure.subplots(rows, len(datasets), squeeze=False, **share)
    for ax, dataset in zip(axes[0], datasets, strict=True):
        ax.set_title(pair_name(dataset))
    return figure, axes


def legend_below(figure: Any, axes: Sequence[Any], count: int) -> None:
    """Put the legend of some axes together below the figure."""
    entries = [ax.get_legend_handles_labels() for ax in axes]
    handles = [handle for found, _ in entries for handle in found]
    labels = [label for _, found in entries for label in found]
    figure.legend(handles, labels, ncols=count, loc="outside lower center")


def line_legend(ax: Any) -> None:
    """Name the shown contact lines below their axes: each pair has its own positions."""
    ax.legend(loc="upper center", bbox_to_anchor=(0.5, -0.14), ncols=3, fontsize=8)


def pitch_line(ax: Any, label: bool = True) -> None:
    """Mark s = 0."""
    ax.axvline(0.0, color="#707070", lw=0.8, ls=(0, (6, 3)))
    if label:
        ax.annotate(
            "pitch line", (0.0, 1.0), xycoords=("data", "axes fraction"), xytext=(4, -4),
            textcoords="offset points", va="top", fontsize=8, color="#505050",
        )  # fmt: skip


def scaled(dataset: xr.Dataset, name: str, factor: float = 1.0, **at: Any) -> Array:
    """Return the values of a variable times a factor, at some of its coordinates."""
    return factor * np.asarray(dataset[name].sel(**at).values, dtype=float)


def unmodified_lines(datasets: Sequence[xr.Dataset]) -> Any:
    """Return length and load of a line over its cycle without relief: [jamali_2015 fig. 4.1]."""
    return _lines(datasets, 0, "Contact lines of unmodified flanks")


def relieved_lines(datasets: Sequence[xr.Dataset]) -> Any:
    """Return length and load of a line between the starts of tip relief: [jamali_2015 fig. 4.2]."""
    return _lines(datasets, 1, "Contact lines between the starts of tip relief")


def _lines(datasets: Sequence[xr.Dataset], state: int, title: str) -> Any:
    with house_style():
        figure, axes = columns(datasets, 2, 6.6, sharex="col", sharey="row")
        for (upper, lower), dataset in zip(axes.T, datasets, strict=True):
            part = dataset.isel(relief=state)
            s_i = scaled(part, "position", MILLI)
            upper.plot(s_i, scaled(part, "length", MILLI), color=BLUE, label="length of one line")
            total = scaled(part, "total_length", MILLI)
            upper.plot(s_i, total, color=VERMILLION, label="length of all lines in contact")
            text = f"mean {MILLI * float(part['mean_length']):.1f} mm"
            text += f", range {100.0 * float(part['length_variation']):.1f} % of it"
            if state > 0:
                plain = float(dataset["mean_length"].isel(relief=0))
                part_lost = 1.0 - float(part["mean_length"]) / plain
                text += f";\nrelief takes {100.0 * part_lost:.1f} %"
            upper.text(
                0.5, 0.97, text, transform=upper.transAxes, ha="center", va="top", fontsize=8.5
            )
            _loads(lower, part, s_i)
            lower.set_xlabel("$s_i$: line's end on face $z=-W/2$, past the pitch line [mm]")
            lower.set_xlim(s_i[0], s_i[-1])
        top = max(MILLI * float(d["total_length"].isel(relief=state).max()) for d in datasets)
        axes[0, 0].set(ylabel="length [mm]", ylim=(0.0, 1.3 * top))
        axes[1, 0].set_ylabel("load of one line [kN]")
        axes[1, 0].set_ylim(0.0, 1.2 * axes[1, 0].get_ylim()[1])
        legend_below(figure, axes[:, 0], 2)
        torques = sorted({float(d.attrs["torque"]) for d in datasets})
        loads = " and ".join(f"{torque:.4g}" for torque in torques)
        figure.suptitle(f"{title}; pinion torque {loads} N·m", fontsize=11.5)
    return figure


def _loads(ax: Any, part: xr.Dataset, s_i: Any) -> None:
    normal = scaled(part, "load", KILO, convention="normal")
    thesis = scaled(part, "load", KILO, convention="thesis")
    ax.plot(
        s_i,
        normal,
        color=GREEN,
        label="load normal to the flanks, $T_1/(r_{b1}\\cos\\beta_b)$ shared",
    )
    text = f"up to {normal.max():.3g} kN"
    if not np.allclose(normal, thesis):
        ax.plot(
            s_i, thesis, color=PURPLE, ls="--", label="load as in Jamali 2015, $T_1/r_{b1}$ shared"
        )
        text += f" normal to the flanks, {thesis.max():.3g} kN as in Jamali 2015"
    ax.text(0.5, 0.97, text, transform=ax.transAxes, ha="center", va="top", fontsize=8.5)


def contact_plane(datasets: Sequence[xr.Dataset]) -> Any:
    """Return the plane of contact with relief zones and the shown lines: [jamali_2015 fig. 4.6]."""
    with house_style():
        figure, axes = columns(datasets, 1, 5.6, sharey=True)
        for ax, dataset in zip(axes[0], datasets, strict=True):
            path = scaled(dataset, "s", MILLI)
            start, end = scaled(dataset, "unrelieved_s", MILLI)
            half = 0.5 * MILLI * float(dataset.attrs["face_width"])
            _zone(ax, path[0], start, half, "gear")
            _zone(ax, end, path[-1], half, "pinion")
            ax.plot(
                [path[0], path[-1], path[-1], path[0], path[0]], [-half, -half, half, half, -half],
                color="black", lw=1.2,
            )  # fmt: skip
            ax.axvline(0.0, color="#707070", lw=0.8, ls=(0, (6, 3)))
            for row, number in enumerate(dataset["shown"].values):
                at = dataset.sel(shown=number)
                ax.plot(
                    scaled(at, "end_s", MILLI), scaled(at, "end_z", MILLI),
                    color=SERIES[row % len(SERIES)], marker="o",
                    label=shown_name(dataset, number),
                )  # fmt: skip
            ax.set_xlabel("$s$: along the line of action, past the pitch line [mm]")
            ax.grid(visible=False)
            ax.set_ylim(-1.06 * half, 1.18 * half)
            line_legend(ax)
        axes[0, 0].set_ylabel("$z$: along the face, from its middle [mm]")
        figure.suptitle("Plane of contact; dashed: pitch line", fontsize=11.5)
    return figure


def _zone(ax: Any, low: float, high: float, half: float, member: str) -> None:
    """Shade the zone of a member's tip relief, if it has any."""
    if high > low:
        ax.fill_between([low, high], -half, half, color=GREY, alpha=0.35, lw=0)
        ax.text(
            0.5 * (low + high), 1.02 * half, f"{member} tip\nrelief {high - low:.2f} mm",
            ha="center", va="bottom", fontsize=8, color="#404040",
        )  # fmt: skip


def contact_characteristics(datasets: Sequence[xr.Dataset]) -> Any:
    """Return relative curvature, entrainment and slide-roll along the path: fig. 4.3.

    All pairs in one set of axes; figure numbers are those of Jamali 2015.
    """
    rows = (
        ("R_transverse", "relative radius $R'$,\ntransverse [mm]", MILLI),
        ("entrainment", "entrainment\nvelocity [m/s]", 1.0),
        ("slide_roll", "slide-roll ratio [-]", 1.0),
    )
    with house_style():
        figure = new_figure(7.6, 7.6)
        axes = figure.subplots(len(rows), 1, sharex=True)
        for ax, (name, label, factor) in zip(axes, rows, strict=True):
            for row, dataset in enumerate(datasets):
                speed = float(dataset.attrs["pinion_speed"]) / RPM
                ax.plot(
                    scaled(dataset, "s", MILLI), scaled(dataset, name, factor),
                    color=SERIES[row % len(SERIES)], ls=("-", "--", "-.", ":")[row % 4],
                    label=f"{pair_name(dataset)}, {speed:.4g} rpm",
                )  # fmt: skip
            ax.set_ylabel(label)
            if name != "slide_roll":
                ax.set_ylim(0.0, 1.12 * ax.get_ylim()[1])
            pitch_line(ax, label=ax is axes[0])
        axes[-1].set_xlabel("$s$: along the line of action, past the pitch line [mm]")
        legend_below(figure, axes[:1], 2)
        figure.suptitle("Contact along the path of contact", fontsize=11.5)
    return figure


def sliding_on_line(datasets: Sequence[xr.Dataset]) -> Any:
    """Return the sliding velocity along the shown contact lines: fig. 4.4."""
    with house_style():
        figure, axes = columns(datasets, 1, 4.8, sharey=True)
        for ax, dataset in zip(axes[0], datasets, strict=True):
            y = scaled(dataset, "y", MILLI)
            for row, number in enumerate(dataset["shown"].values):
                ax.plot(
                    y, scaled(dataset, "line_sliding", shown=number),
                    color=SERIES[row % len(SERIES)],
                    label=shown_name(dataset, number),
                )  # fmt: skip
            ax.axhline(0.0, color="#707070", lw=0.8, ls=(0, (6, 3)))
            ax.set_xlabel("$y$: along the contact line, from mid-face [mm]")
            ax.set_xlim(y[0], y[-1])
            line_legend(ax)
        axes[0, 0].set_ylabel("sliding velocity $u_1-u_2$ [m/s]")
        speeds = sorted({f"{float(d.attrs['pinion_speed']) / RPM:.4g}" for d in datasets})
        speed = " and ".join(speeds)
        figure.suptitle(
            f"Sliding along a contact line, pinion at {speed} rpm; dashed: pitch line",
            fontsize=11.5,
        )
    return figure


def lay_angles(datasets: Sequence[xr.Dataset]) -> Any:
    """Return the inclination of grinding marks to the contact line, and slide-roll: fig. 7.4."""
    members = (("pinion", "$\\theta_p$", BLUE, "-"), ("gear", "$\\theta_w$", VERMILLION, "--"))
    most = 1.15 * max(float(np.abs(scaled(one, "slide_roll")).max()) for one in datasets)
    with house_style():
        figure, axes = columns(datasets, 1, 4.8)
        for ax, dataset in zip(axes[0], datasets, strict=True):
            s = scaled(dataset, "s", MILLI)
            for member, symbol, colour, style in members:
                ax.plot(
                    s, scaled(dataset, f"lay_{member}", _DEGREES), color=colour, ls=style,
                    label=f"{symbol}, {member}",
                )  # fmt: skip
            ax.set_ylim(0.0, 1.1 * ax.get_ylim()[1])
            ax.set_xlabel("$s$: along the line of action, past the pitch line [mm]")
            pitch_line(ax)
            ratio = ax.twinx()
            ratio.plot(s, scaled(dataset, "slide_roll"), color=GREEN, ls="-.")
            ax.plot([], [], color=GREEN, ls="-.", label="$\\zeta$, slide-roll ratio (right)")
            ratio.set_ylim(-most, most)
            ratio.spines["right"].set_visible(True)
            ratio.grid(visible=False)
            ratio.set_ylabel("slide-roll ratio $\\zeta$ [-]", color=GREEN)
        axes[0, 0].set_ylabel("angle of the marks to the contact line [°]")
        legend_below(figure, axes[0, :1], 3)
        chord = MILLI * float(datasets[0]["lay_chord"])
        figure.suptitle(f"Lay: grinding marks seen along a chord of {chord:g} mm", fontsize=11.5)
    return figure
