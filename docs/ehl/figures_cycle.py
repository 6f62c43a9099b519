"""Curves over the meshing cycle and over the number of facets, for docs/ehl.md."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from docs.ehl.cases import CYCLE, FACETED, FilmCase, facet_case
from docs.ehl.claims import GPA, MM, UM
from docs.ehl.claims_cycle import drawn_cycle
from docs.ehl.lines import March
from docs.ehl.runs import (
    FACET_MARCH,
    FACET_STEPS,
    POSITIONS,
)
from docs.ehl.store import Store
from gearlube.plotting.style import (
    BLUE,
    GREY,
    ORANGE,
    PURPLE,
    SERIES,
    SKY,
    VERMILLION,
    house_style,
    new_figure,
)
from gearlube_core.arrays import Array
from gearlube_core.ehl.point.dry_contact import dry_contact_of_gap


def facets(store: Store) -> Any:
    """Return pressure and film over the number of facets, and sections: figs 6.7 and 6.14."""
    with house_style():
        figure = new_figure(9.6, 7.0)
        axes = figure.subplots(2, 2)
        for row, step in enumerate(sorted((300, *FACET_STEPS))):
            films = [store.steady(facet_case(n), step) for n in (20, 30, 40, 100)]
            films += [store.steady(FilmCase(nodes=FACETED), step)]
            places = range(5)
            axes[0, 0].plot(
                places, [GPA * f.max_pressure for f in films], "o-", color=SERIES[row],
                label=f"step {step}, at rest", lw=1.0,
            )  # fmt: skip
            axes[0, 1].plot(
                places, [UM * f.min_film for f in films], "o-", color=SERIES[row], lw=1.0
            )
        for place, n in ((2, 40), (3, 100)):
            march = store.march(facet_case(n), *FACET_MARCH, FACET_MARCH[1:])
            for ax, name, unit in ((axes[0, 0], "max_pressure", GPA), (axes[0, 1], "min_film", UM)):
                values = unit * march[name]
                label = "steps 281 to 300, in motion" if n == 40 else None
                ends = (values.min(), values.max())
                ax.vlines(place + 0.12, *ends, color=GREY, lw=5, label=label)
        for ax in axes[0]:
            ax.set_xticks(range(5), ["20", "30", "40", "100", "smooth"])
            ax.set(xlabel="number of facets $n_f$", ylim=(0.0, None))
        axes[0, 0].set_ylabel("largest pressure [GPa]")
        axes[0, 1].set_ylabel("smallest film [µm]")
        axes[0, 0].legend()
        # other colours than those of the steps above
        for n, colour in zip((20, 40, 100, 0), (PURPLE, ORANGE, SKY, "black"), strict=True):
            film = store.steady(facet_case(n), 300)
            j, label = film.column(0.0), f"$n_f$ = {n}" if n else "smooth"
            x = MM * film.x
            axes[1, 0].plot(x, GPA * film.pressure[:, j], color=colour, lw=1.3, label=label)
            axes[1, 1].plot(x, UM * film.film[:, j], color=colour, lw=1.3)
        for ax in axes[1]:
            ax.set(xlabel="across the line, x [mm], y = 0", xlim=(-0.45, 0.4))
        axes[1, 0].set_ylabel("pressure [GPa]")
        axes[1, 0].legend()
        axes[1, 1].set(ylabel="film [µm]", ylim=(0.0, 1.0))
        figure.suptitle(
            "Design A with faceted flanks: each edge makes a spike of pressure; below: step 300",
            fontsize=11,
        )
    return figure


@dataclass(frozen=True, slots=True, kw_only=True)
class DryCycle:
    """Dry pressures over the steps of the thesis."""

    step: Array
    y: Array  # [m]
    pressure: Array  # largest of every section [Pa], (steps, y)

    @property
    def max_pressure(self) -> Array:
        """Return the largest pressure of each step [Pa]."""
        return np.asarray(self.pressure.max(axis=1))


def dry_cycle(store: Store, case: FilmCase, every: int = 25) -> DryCycle:
    """Return the dry contact of a case at every so many steps, kept by the store."""

    def pressed() -> dict[str, Array]:
        steps = np.arange(0, 576, every)
        film = case.film()
        moving = film.moving_film()
        x, y = moving.x, moving.y
        rows = []
        for step in steps:
            X = film.line(case.number(float(step)) * film.time_step)
            dry = dry_contact_of_gap(
                film.gap(x, y, X), x[1] - x[0], y[1] - y[0], film.contact_modulus, film.load(X),
                tolerance=1e-4,
            )  # fmt: skip
            rows.append(dry.pressure.max(axis=0))
        return {"step": steps, "y": y, "pressure": np.array(rows)}

    return DryCycle(**store.kept(f"dry_{case.name}_every{every}", pressed))


COLOURS = dict(zip("ab", (BLUE, VERMILLION), strict=True))


def _two_panels(height: float = 6.0) -> tuple[Any, Any, Any]:
    figure = new_figure(8.2, height)
    top, bottom = figure.subplots(2, 1, sharex=True)
    top.set_ylabel("largest pressure [GPa]")
    bottom.set(ylabel="smallest film [µm]", xlabel="step of the cycle", xlim=(0, 575))
    return figure, top, bottom


def _curves(top: Any, bottom: Any, march: March, label: str, **style: Any) -> None:
    top.plot(march.step, GPA * march["max_pressure"], label=label, **style)
    bottom.plot(march.step, UM * march["min_film"], label=label, **style)
    failed = march["converged"] == 0.0
    bottom.plot(march.step[failed], UM * march["min_film"][failed], "x", color=GREY)


def designs(store: Store) -> Any:
    """Return pressure and film of both designs over the cycle: fig. 5.5."""
    with house_style():
        figure, top, bottom = _two_panels()
        for d in "ab":
            colour = COLOURS[d]
            label = f"{d.upper()}, in motion"
            _curves(top, bottom, drawn_cycle(store, d), label, color=colour)
            dry = dry_cycle(store, FilmCase(design=d, nodes=CYCLE))
            top.plot(
                dry.step, GPA * dry.max_pressure, ".", color=colour, ms=5,
                label=f"{d.upper()}, dry",
            )  # fmt: skip
            rest = [store.steady(FilmCase(design=d, nodes=CYCLE), n) for n in POSITIONS]
            bottom.plot(
                POSITIONS, [UM * f.min_film for f in rest], "o", color=colour, mfc="white",
                label=f"{d.upper()}, at rest",
            )  # fmt: skip
        top.legend(ncols=2)
        bottom.legend(ncols=2)
        bottom.set_ylim(0.0, None)
        figure.suptitle(
            "Designs A and B over the cycle: parabolic relief, $k$ = 1, $F_o$ = 0", fontsize=11
        )
    return figure
