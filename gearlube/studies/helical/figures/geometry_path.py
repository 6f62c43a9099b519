"""Curvature, velocities and lay along the path of contact and along one line."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import xarray as xr

from gearlube.plotting.style import BLUE, GREEN, SERIES, VERMILLION, house_style, new_figure
from gearlube.studies.helical.figures.geometry_layout import (
    MILLI,
    columns,
    legend_below,
    line_legend,
    pair_name,
    pitch_line,
    scaled,
    shown_name,
)
from gearlube.studies.helical.figures.layout import RPM

_DEGREES = 180.0 / np.pi


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
