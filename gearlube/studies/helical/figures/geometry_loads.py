"""Length, load and position of contact lines over the meshing cycle."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import xarray as xr

from gearlube.plotting.style import BLUE, GREEN, GREY, PURPLE, SERIES, VERMILLION, house_style
from gearlube.studies.helical.figures.geometry_layout import (
    KILO,
    MILLI,
    columns,
    legend_below,
    line_legend,
    scaled,
    shown_name,
)


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
