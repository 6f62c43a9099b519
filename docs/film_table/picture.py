"""Picture of the table of films."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from docs.film_table.contacts import LOADS, MATERIALS
from docs.film_table.extrapolated import Row
from gearlube.plotting.style import GREY, MARKERS, SERIES, house_style, new_figure
from gearlube_core.film.point_film import central_film_group

_SHAPES = ((1.0, 0.0), (4.0, 0.0))  # those shown


def draw(rows: Sequence[Row]) -> Any:
    """Return central films, filled, and smallest films, open, over load; a fit in grey."""
    with house_style():
        figure = new_figure(10.0, 4.6)
        axes = figure.subplots(1, len(_SHAPES), sharey=True)
        for ax, (ellipticity, angle) in zip(axes, _SHAPES, strict=True):
            _films(ax, rows, ellipticity, angle)
            ax.set_title(f"$a_y/a_x$ = {ellipticity:g}, entrained along the short axis")
            ax.set_xlabel("load M [-]")
        axes[0].set_ylabel("film H [-]")
        handles = [
            axes[0].plot([], [], marker, color=colour, label=f"L = {L:g}")[0]
            for L, marker, colour in zip(MATERIALS, MARKERS, SERIES, strict=False)
        ]
        for label, style in (
            ("central film $H_c$", {"color": "k", "marker": "o", "linestyle": "-"}),
            ("smallest film $H_{min}$",
             {"color": "k", "marker": "o", "linestyle": "--", "markerfacecolor": "w"}),
            ("formula for $H_c$, Nijenbanning et al. 1994", {"color": GREY}),
        ):  # fmt: skip
            handles.append(axes[0].plot([], [], label=label, **style)[0])
        figure.legend(handles=handles, loc="outside lower center", ncols=4)
        return figure


def _films(ax: Any, rows: Sequence[Row], ellipticity: float, angle: float) -> None:
    loads = np.geomspace(LOADS[0], LOADS[-1], 60)
    for L, marker, colour in zip(MATERIALS, MARKERS, SERIES, strict=False):
        own = [
            row
            for row in rows
            if (c := row.solved.contact).L == L and (c.ellipticity, c.angle) == (ellipticity, angle)
        ]
        if not own:
            continue
        M = [row.solved.contact.M for row in own]
        ratio = 1.0 / own[0].solved.contact.radius_ratio
        ax.plot(loads, [central_film_group(m, L, ratio) for m in loads], color=GREY, zorder=1)
        ax.plot(M, [row.central.value for row in own], marker + "-", color=colour)
        ax.plot(
            M, [row.minimum.value for row in own], marker + "--", color=colour, markerfacecolor="w"
        )
    ax.set_xscale("log")
    ax.set_yscale("log")
