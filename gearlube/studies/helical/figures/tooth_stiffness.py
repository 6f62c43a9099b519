"""Stiffness of tooth pairs from loaded contact and with one stiffness density."""

from __future__ import annotations

from itertools import pairwise
from typing import Any

import numpy as np
import xarray as xr

from gearlube.plotting.style import GREY, SERIES, house_style, new_figure
from gearlube.studies.helical.figures.layout import closed
from gearlube_core.arrays import Array

_MEGA = 1e-6  # N/um in N/m
_SHOWN = 4  # torques in one panel


def at_torque(contact: xr.Dataset) -> xr.Dataset:
    """Return the loaded contact nearest to the operating point's torque."""
    return contact.sel(torque=contact.attrs["pinion_torque"], method="nearest")


def spread(torques: Array, count: int = _SHOWN) -> Array:
    """Return up to `count` torques spread from the lowest to the highest."""
    rows = np.unique(np.linspace(0, torques.size - 1, min(count, torques.size)).round().astype(int))
    return np.asarray(torques[rows])


def followed(part: xr.Dataset, name: str) -> tuple[Array, Array]:
    """Return phase since a line enters the plane of contact, and values along its way.

    Line i of phase s has turned i + s mesh periods since then; -1 is before.
    """
    phase = (part["line"].values[None, :] + part["phase"].values[:, None]).T.ravel()
    return phase, part[name].transpose("line", "phase").values.ravel()


def loaded_stiffness(contact: xr.Dataset) -> Any:
    """Return stiffness functions of the pairs and of all, from loaded contact.

    Compare [he_2007 fig. 2].
    """
    part = at_torque(contact)
    torque = float(part["torque"])
    with house_style():
        figure = new_figure(10.0, 4.8)
        left, right = figure.subplots(1, 2, sharey=True)
        phase = part["phase"].values
        x, y = closed(phase, _MEGA * part["K"].values, 1)
        left.plot(x, y, color="black", lw=2.4, label="all pairs")
        row = 0
        for line in part["line"].values:
            values = _MEGA * part["K_line"].sel(line=line).values
            if values.max() < 1e-3 * y.max():
                continue
            after = part["line"].values.max() >= line + 1
            end = _MEGA * float(part["K_line"].sel(line=line + 1)[0]) if after else np.nan
            left.plot(
                np.append(phase, 1.0),
                np.append(values, end),
                color=SERIES[row % len(SERIES)],
                label=f"pair {line}" if line >= 0 else "next pair, tip corner",
            )
            row += 1
        iso = _MEGA * contact.attrs["iso_mesh_stiffness"]
        left.axhline(iso, color=GREY, ls="--", lw=1.2, label="mean after ISO 6336-1")
        left.set(xlim=(0.0, 1.0), xlabel="time [mesh periods]", ylabel="stiffness along x [N/µm]")
        left.set_ylim(0.0, 1.12 * max(float(y.max()), iso))
        left.set_title(f"pairs in one mesh period, {torque:.4g} N·m")
        _one_pair(right, contact)
        figure.legend(
            *left.get_legend_handles_labels(), ncols=3, loc="outside lower left", fontsize=8.5
        )
        figure.legend(
            *right.get_legend_handles_labels(), ncols=2, loc="outside lower right", fontsize=8.5
        )
        figure.suptitle(
            f"Tooth stiffness from loaded contact, torque over base radius and closing: "
            f"{contact.attrs['name']}",
            fontsize=11.5,
        )
    return figure


def _one_pair(ax: Any, contact: xr.Dataset) -> None:
    torques = spread(contact["torque"].values)
    for row, torque in enumerate(torques):
        phase, values = followed(contact.sel(torque=torque), "K_line")
        ax.plot(phase, _MEGA * values, color=SERIES[row], label=f"{torque:.4g} N·m")
    line, zone = contact["constant_line"].values, contact["zone_phase"].values
    values = contact["K_line_constant"].transpose("constant_line", "zone_phase").values
    ax.plot(
        (line[:, None] + zone).ravel(),
        _MEGA * values.ravel(),
        color="black",
        lw=1.2,
        ls="--",
        label="one density",
    )
    ax.set(xlim=(-0.5, line[-1] + 1.0), xlabel="mesh periods since it enters the plane of contact")
    ax.set_title("one pair from entry to exit")


def constant_stiffness(contact: xr.Dataset) -> Any:
    """Return stiffness functions with one density, and the zones of each pair.

    Compare [he_2007 fig. 3] [he_2007 fig. 4].
    """
    with house_style():
        figure = new_figure(9.0, 6.4)
        top, bottom = figure.subplots(2, 1, sharex=True, gridspec_kw={"height_ratios": (2.6, 1.0)})
        phase = contact["zone_phase"].values
        values = _MEGA * contact["K_line_constant"].values
        total = values.sum(axis=1)
        top.plot(phase, total, color="black", lw=2.4, label="all pairs")
        for row, line in enumerate(contact["constant_line"].values):
            colour = SERIES[row % len(SERIES)]
            top.plot(phase, values[:, row], color=colour, label=f"pair {line}")
        _zones(bottom, contact)
        top.set_ylim(0.0, 1.1 * total.max())
        top.set_ylabel("stiffness along x [N/µm]")
        bottom.set_xlabel("time [mesh periods]")
        bottom.set_xlim(0.0, 1.0)
        figure.legend(*top.get_legend_handles_labels(), ncols=4, loc="outside lower center")
        figure.suptitle(
            f"Tooth stiffness with {1e-9 * contact.attrs['density']:.4g} N/(µm·mm) along all "
            f"contact lines: {contact.attrs['name']}",
            fontsize=11.5,
        )
    return figure


_SIDES = {
    "before": "#BFD9EA",
    "across": "#F6D9A8",
    "past": "#C9E7DB",
    "none": "#F2F2F2",
}


def _zones(ax: Any, contact: xr.Dataset) -> None:
    """Draw, for each pair, where its line lies; a new zone begins where an end changes course."""
    at = contact.attrs
    A, D, P = at["contact_start"], at["contact_end"], at["pitch_point"]
    lag, pitch = at["line_lag"], at["base_pitch"]
    edges = sorted({P, D, A + lag, P + lag, D + lag})
    number = 0
    for line in contact["constant_line"].values:
        low, high = A + line * pitch, A + (line + 1) * pitch
        cuts = [low, *(edge for edge in edges if low < edge < high), high]
        for first, last in pairwise(cuts):
            number += 1
            middle = 0.5 * (first + last)
            if middle > D + lag:
                where = "none"
            elif middle < P:
                where = "before"
            else:
                where = "across" if middle - lag < P else "past"
            start, width = (first - low) / pitch, (last - first) / pitch
            ax.broken_barh(
                [(start, width)], (line - 0.4, 0.8), facecolor=_SIDES[where], edgecolor="#606060"
            )
            if width > 0.02:
                ax.text(start + 0.5 * width, line, str(number), ha="center", va="center")
            else:
                ax.annotate(
                    str(number),
                    (start + 0.5 * width, line),
                    xytext=(8, 0),
                    textcoords="offset points",
                    ha="left",
                    va="center",
                    arrowprops={"arrowstyle": "-", "lw": 0.6},
                )
    ax.set_yticks(contact["constant_line"].values)
    ax.set_yticklabels([f"pair {line}" for line in contact["constant_line"].values])
    ax.grid(False)
    ax.set_title(
        "zones; line before (blue), across (sand), past (green) the pitch line, gone (grey)",
        fontsize=9,
    )
