"""How tooth pairs share the load, their highest pressures, and the Harris map."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import xarray as xr

from gearlube.plotting.style import GREY, SERIES, house_style, new_figure
from gearlube.plotting.words import mark_edge_pressure
from gearlube.studies.helical.figures.layout import closed
from gearlube_core.arrays import Array
from gearlube_core.tooth_contact.sharp_edge import EDGE_PRESSURE

_MEGA = 1e-6  # N/um in N/m
_SHOWN = 4  # torques in one panel
_ROOM = 1.5  # height of the axis of pressures, over that in the middle


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


def load_sharing(contact: xr.Dataset) -> Any:
    """Return shares of the torque, against length shares, and the highest pressures of a pair."""
    with house_style():
        figure = new_figure(7.2, 7.0)
        top, bottom = figure.subplots(2, 1, sharex=True)
        highest: list[Array] = []
        for row, torque in enumerate(spread(contact["torque"].values)):
            part = contact.sel(torque=torque)
            look = {"color": SERIES[row], "label": f"{torque:.4g} N·m"}
            top.plot(*followed(part, "share"), **look)
            phase, pressure = followed(part, "pressure_max")
            highest.append(np.where(pressure > 0.0, 1e-9 * pressure, np.nan))
            bottom.plot(phase, highest[-1], **look)
        phase, share = followed(contact, "length_share")
        top.plot(phase, share, color="black", ls="--", lw=1.2, label="share of length")
        top.set(ylabel="share of the torque", ylim=(0.0, None))
        bottom.set(
            ylabel="highest pressure [GPa]",
            ylim=(0.0, None),
            xlabel="mesh periods since it enters the plane of contact",
            xlim=(-0.5, contact["constant_line"].values[-1] + 1.0),
        )
        _cut_edge_pressures(bottom, phase, highest)
        figure.legend(*top.get_legend_handles_labels(), ncols=5, loc="outside lower center")
        figure.suptitle(f"Load sharing of one pair: {contact.attrs['name']}", fontsize=11.5)
    return figure


def _cut_edge_pressures(ax: Any, phase: Array, highest: Sequence[Array]) -> None:
    """End the axis of pressures [GPa] near those of the middle; mark points beyond with triangles.

    Pressures of sharp edges have no finite value, and would stretch the axis to many times that.
    """
    middle = max(float(one[np.nanargmin(np.abs(phase - _middle(phase, one)))]) for one in highest)
    top = _ROOM * max(middle, 1e-9 * EDGE_PRESSURE)
    greatest = max(float(np.nanmax(one)) for one in highest)
    if greatest <= top:
        mark_edge_pressure(ax)
        return
    limit = 1e-9 * EDGE_PRESSURE
    ax.axhspan(limit, top, color="0.92", zorder=0)
    for row, one in enumerate(highest):
        beyond = one > top
        ax.plot(
            phase[beyond],
            np.full(int(beyond.sum()), top * (0.985 - 0.03 * row)),
            "^",
            color=SERIES[row],
            ms=3.5,
            clip_on=False,
        )
    ax.set_ylim(0.0, top)
    ax.set_title(
        f"grey: sharp edges press; triangles: beyond the axis, up to {greatest:.3g} GPa.\nThis "
        "pressure has no meaning as a number: it rises with finer cells",
        fontsize=8.5,
    )


def _middle(phase: Array, values: Array) -> float:
    """Return the phase half way from the first to the last point that has a value."""
    found = phase[np.isfinite(values)]
    return 0.5 * float(found.min() + found.max())


def harris_map(contact: xr.Dataset) -> Any:
    """Return transmission error over the mesh, and its range and orders against torque."""
    torque = contact["torque"].values
    error = 1e6 * contact["transmission_error"].values
    unloaded = 1e6 * contact["unloaded_error"].values
    with house_style():
        figure = new_figure(10.0, 4.8)
        left, right = figure.subplots(1, 2)
        phase = contact["phase"].values
        x, y = closed(phase, unloaded - unloaded.mean())
        left.plot(x, y, color=GREY, lw=2.2, label="unloaded")
        for row, one in enumerate(spread(torque, 5)):
            values = error[:, int(np.argmin(np.abs(torque - one)))]
            x, y = closed(phase, values - values.mean())
            left.plot(x, y, color=SERIES[row], label=f"{one:.4g} N·m")
        left.set(
            xlim=(0.0, 2.0), xlabel="time [mesh periods]", ylabel=("closing minus its mean [µm]")
        )
        left.set_title("transmission error")
        right.plot(torque, np.ptp(error, axis=0), "o-", color="black", label="peak to peak")
        orders = 2.0 * np.abs(np.fft.rfft(error, axis=0)) / phase.size
        for order in range(1, min(4, orders.shape[0] - 1)):
            right.plot(torque, orders[order], "s-", color=SERIES[order - 1], label=f"order {order}")
        right.axvline(contact.attrs["pinion_torque"], color=GREY, ls=":", lw=1.2)
        right.set(xlabel="pinion torque [N·m]", ylabel="transmission error [µm]")
        right.set(xlim=(0.0, None), ylim=(0.0, None))
        right.set_title("Harris map; dotted: operating point")
        figure.legend(
            *left.get_legend_handles_labels(), ncols=3, loc="outside lower left", fontsize=8.5
        )
        figure.legend(
            *right.get_legend_handles_labels(), ncols=2, loc="outside lower right", fontsize=8.5
        )
        figure.suptitle(
            f"Transmission error along the line of action: {contact.attrs['name']}", fontsize=11.5
        )
    return figure
