"""Contours and sections of films, for docs/ehl.md."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.colors import BoundaryNorm

from docs.ehl.cases import CYCLE, FACETED, FilmCase, relief_starts
from docs.ehl.claims import GPA, MM, UM
from docs.ehl.claims_cycle import cycle
from docs.ehl.claims_motion import line_contact, section
from docs.ehl.figures_cycle import dry_cycle
from docs.ehl.runs import POSITIONS, POWERS, power_case
from docs.ehl.store import Store
from gearlube.plotting.style import BLUE, VERMILLION, house_style, new_figure
from gearlube_core.arrays import Array

_FILMS = np.array([0.1, 0.14, 0.18, 0.22, 0.26, 0.3, 0.4, 0.6, 1.0])  # um
_PRESSURES = np.array([0.1, 0.3, 0.5, 0.7, 0.9, 1.1, 1.3])  # GPa
_SECTIONS = (-18.0, -10.0, 0.0, 10.0, 17.0, 18.0)  # mm


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


def sections(store: Store) -> Any:
    """Return sections of B at step 300: transient, at rest and line contact: fig. 5.13."""
    case = FilmCase(design="b", nodes=FACETED)
    with house_style():
        figure = new_figure(11.5, 5.4)
        axes = figure.subplots(2, len(_SECTIONS), sharex=True, sharey="row")
        for (above, below), y in zip(axes.T, _SECTIONS, strict=True):
            fine = store.steady(case, 300)
            j = fine.column(y / MM)
            both = section(store, "b", 300, float(fine.y[j]))
            curves = [
                (fine.x, fine.pressure[:, j], fine.film[:, j], "at rest", ("-", BLUE, 2.4)),
                (both.x, both.pressure, both.film, "in motion", ("--", VERMILLION, 1.4)),
            ]
            if y < 18.0:
                line = line_contact(store, case, 300, y / MM)
                look = (":", "black", 1.2)
                curves.append((line.x, line.pressure, line.film, "line contact", look))
            for x, pressure, film, words, (dashes, colour, width) in curves:
                more = {"ls": dashes, "color": colour, "lw": width, "label": words}
                above.plot(MM * x, GPA * pressure, **more)
                below.plot(MM * x, UM * film, **more)
            above.set_title(f"y = {y:g} mm")
        axes[0, 0].set(xlim=(-0.6, 0.5), ylim=(0.0, 1.0), ylabel="pressure [GPa]")
        axes[1, 0].set(ylim=(0.0, 0.6), ylabel="film [µm]")
        for below in axes[1]:
            below.set_xlabel("x [mm]")
        figure.legend(*axes[0, 0].get_legend_handles_labels(), ncols=3, loc="outside lower center")
        figure.suptitle(
            "Design B, step 300: motion changes the film where the tip relief begins, at y = 18 mm",
            fontsize=11,
        )
    return figure


def power_contours(store: Store) -> Any:
    """Return film and pressure of B at step 75 for four power laws: fig. 5.23."""
    levels = np.array([0.1, 0.3, 0.5, 0.7, 0.9, 1.1, 1.5, 2.0, 3.0])
    with house_style():
        figure = new_figure(10.0, 7.6)
        axes = figure.subplots(4, 2, sharex=True, sharey=True)
        for row, beta in zip(axes, POWERS, strict=True):
            film = store.steady(power_case("b", beta), 75)
            thick, dense = _maps(row, film.x, film.y, film.pressure, film.film, levels)
            row[0].set_title(
                f"β = {beta:g}: film, {UM * film.min_film:.3f} µm at least", fontsize=9
            )
            row[1].set_title(f"pressure, {GPA * film.max_pressure:.2f} GPa at most", fontsize=9)
            row[0].set_ylabel("x [mm]")
            row[0].set(xlim=(-10.0, 24.0), ylim=(-0.65, 0.45))
        for ax in axes[-1]:
            ax.set_xlabel("along the line, y [mm]")
        figure.colorbar(thick, ax=axes[:, 0], label="film [µm]", location="bottom", aspect=40)
        figure.colorbar(dense, ax=axes[:, 1], label="pressure [GPa]", location="bottom", aspect=40)
        figure.suptitle(
            "Design B, step 75, at rest: tip relief that grows with the power β of the distance",
            fontsize=11,
        )
    return figure


def power_lines(store: Store) -> Any:
    """Return dry pressures of the cycle over step and y for four power laws: fig. 5.24."""
    levels = np.array([0.1, 0.3, 0.5, 0.7, 0.8, 0.9, 1.0, 1.1, 1.2, 1.5, 2.0, 3.0])
    with house_style():
        figure = new_figure(10.0, 6.4)
        axes = figure.subplots(2, 4, sharex=True, sharey=True)
        for d, row in zip("ab", axes, strict=True):
            for ax, beta in zip(row, POWERS, strict=True):
                case = power_case(d, beta, nodes=CYCLE)
                dry = dry_cycle(store, case, every=5)
                places = (dry.step, MM * dry.y)
                drawn = _filled(ax, places, GPA * dry.pressure.T, levels, "magma_r", "max")
                ax.set_title(f"design {d.upper()}, β = {beta:g}", fontsize=9)
                ax.grid(visible=False)
            row[0].set_ylabel("along the line, y [mm]")
        figure.supxlabel("step of the cycle", fontsize=10)
        figure.suptitle(
            "Dry contact over the cycle: tip relief that grows with the power β of the distance",
            fontsize=11,
        )
        words = "largest pressure of the section [GPa]"
        figure.colorbar(drawn, ax=axes, label=words, ticks=levels)
    return figure
