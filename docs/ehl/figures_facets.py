"""Pressure and film of faceted flanks, for docs/ehl.md."""

from __future__ import annotations

from typing import Any

from docs.ehl.cases import FACETED, FilmCase, facet_case
from docs.ehl.claims import GPA, MM, UM
from docs.ehl.runs import FACET_MARCH, FACET_STEPS
from docs.ehl.store import Store
from gearlube.plotting.style import GREY, ORANGE, PURPLE, SERIES, SKY, house_style, new_figure


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
