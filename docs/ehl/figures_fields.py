"""Contours of films, for docs/ehl.md."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.colors import BoundaryNorm

from docs.ehl.cases import CYCLE, FilmCase, relief_starts
from docs.ehl.claims import GPA, MM, UM
from docs.ehl.claims_cycle import cycle
from docs.ehl.runs import POSITIONS
from docs.ehl.store import Store
from gearlube.plotting.style import VERMILLION, house_style, new_figure
from gearlube_core.arrays import Array

_FILMS = np.array([0.1, 0.14, 0.18, 0.22, 0.26, 0.3, 0.4, 0.6, 1.0])  # um
_PRESSURES = np.array([0.1, 0.3, 0.5, 0.7, 0.9, 1.1, 1.3])  # GPa


def _maps(axes: Any, x: Array, y: Array, pressure: Array, film: Array, levels: Array) -> Any:
    places = (MM * y, MM * x)
    thick = _filled(axes[0], places, UM * film, _FILMS, "viridis", "min")
    dense = _filled(axes[1], places, GPA * pressure, levels, "magma_r", "max")
    for ax in axes:
        ax.grid(visible=False)
        ax.set_ylim(-0.5, 0.45)
    return thick, dense


def _filled(ax: Any, places: Any, values: Array, levels: Array, colours: str, extend: Any) -> Any:
    # one colour a band, however wide: the bands of thin films would be all alike otherwise
    norm = BoundaryNorm(levels, 256, extend=extend)
    ax.contour(*places, values, levels=levels, colors="black", linewidths=0.25)
    return ax.contourf(*places, values, levels=levels, cmap=colours, norm=norm, extend=extend)


def transient_steady(store: Store) -> Any:
    """Return film and pressure in motion and at rest at the detailed steps: fig. 5.7."""
    with house_style():
        figure = new_figure(10.0, 9.0)
        axes = figure.subplots(6, 2, sharex=True, sharey=True)
        for i, step in enumerate(POSITIONS):
            rest = store.steady(FilmCase(nodes=CYCLE), step)
            moving = cycle(store, "a").fields(step)
            ends = relief_starts(FilmCase(nodes=CYCLE), step)
            starts = [y for y in ends if abs(y) < 0.999 * rest.y[-1]]
            for j, (words, fields) in enumerate(
                (("in motion", moving), ("at rest", (rest.pressure, rest.film)))
            ):
                row = axes[2 * i + j]
                thick, dense = _maps(row, rest.x, rest.y, *fields, _PRESSURES)
                row[0].set_title(f"step {step}, {words}: film", fontsize=9)
                row[1].set_title(f"step {step}, {words}: pressure", fontsize=9)
                row[0].set_ylabel("x [mm]")
                for place in starts:
                    for ax in row:
                        ax.axvline(MM * place, color=VERMILLION, lw=1.0, ls=":")
        for ax in axes[-1]:
            ax.set_xlabel("along the line, y [mm]")
        figure.colorbar(thick, ax=axes[:, 0], label="film [µm]", location="bottom", aspect=40)
        figure.colorbar(dense, ax=axes[:, 1], label="pressure [GPa]", location="bottom", aspect=40)
        figure.suptitle(
            "Design A: pressures in motion and at rest are alike, films are not; dotted: where the "
            "tip relief begins",
            fontsize=11,
        )
    return figure
