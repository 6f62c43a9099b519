"""Section of docs/ehl.md on the formulas of smooth contacts: tables, picture, failures."""

from __future__ import annotations

import statistics
from collections.abc import Sequence
from typing import Any

from docs.ehl.film_map import (
    ANGLES,
    CHITTENDEN,
    COARSE,
    ELLIPTICITIES,
    FINE,
    HAMROCK_DOWSON,
    MATERIALS,
    NIJENBANNING,
    TURNED,
    Contact,
    Film,
    Films,
    all_films,
    grid_error,
    map_contacts,
    spread,
    turned_contacts,
)
from docs.ehl.store import Store
from docs.page import IMAGES, Page
from gearlube.plotting.style import MARKERS, SERIES, house_style, new_figure

CENTRAL, MINIMUM = "central film", "minimum film"
PAIRS = (
    (CENTRAL, HAMROCK_DOWSON),
    (CENTRAL, CHITTENDEN),
    (CENTRAL, NIJENBANNING),
    (MINIMUM, HAMROCK_DOWSON),
    (MINIMUM, CHITTENDEN),
)
LIMITS = (0.1, 0.2, 0.3)
_BANDS = {0.2: "#E9E9E9", 0.1: "#CFCFCF"}  # shade by half width, the narrow one on top
_TICKS = (0.5, 0.6, 0.7, 0.8, 1.0, 1.2, 1.5, 2.0, 3.0, 5.0)
_SPREAD = 0.035  # of markers of one load, in decades


def put_film_map(page: Page, store: Store) -> None:
    """Put in the table of the map and draw its picture; all stays where films are missing."""
    films = all_films(store)
    if not {(contact, FINE) for contact in map_contacts()} <= films.keys():
        return
    draw(films).savefig(IMAGES / "ehl_film_map.png", dpi=100)
    along = [films[c, FINE] for c in map_contacts()]
    _state(page, films)
    page.rows("Formula, not rigid", _spread_rows(along))


def _state(page: Page, films: Films) -> None:
    wanted = [*map_contacts(), *(c for c in turned_contacts() if c.angle)]
    found = [films[c, FINE] for c in wanted if (c, FINE) in films]
    failed = [film for film in found if not film.converged]
    first = [film for film in found if film.converged and film.wedge != "upwind-2"]
    limited = [f for f in found if f.converged and f.wedge == "upwind-2" and not f.sound]
    both = [c for c in map_contacts() if {(c, COARSE), (c, FINE)} <= films.keys()]
    errors = [[100.0 * grid_error(films, c, q) for c in both] for q in (CENTRAL, MINIMUM)]
    listed = [f"{one:.1f}" for some in errors for one in (statistics.median(some), max(some))]
    page.fill(
        f"Of {{}} contacts on {FINE} by {FINE} nodes {{}} did not converge{{}} have a film with "
        "the first-order stencil alone{} have more than 1 % of first-order {}. They took {} "
        "s of one processor, a median of {} s each. By both grids the error of the finer one is "
        "{} % (at most {} %) of the central film and {} % (at most {} %) of the minimum film.",
        len(found),
        len(failed),
        f"{_named(failed)}; {len(first)}",
        f"{_named(first)}; {len(limited)}",
        f"faces{_named(limited)}",
        f"{sum(film.seconds for film in found):.0f}",
        f"{statistics.median(f.seconds for f in found):.1f}",
        *listed,
    )


def _named(films: Sequence[Film]) -> str:
    names = [
        f"k {f.contact.ellipticity:g} M {f.contact.M:g} L {f.contact.L:g}"
        + (f" at {f.contact.angle:g} degrees" if f.contact.angle else "")
        for f in films
    ]
    return f" ({'; '.join(names)})" if names else ""


def _spread_rows(films: Sequence[Film]) -> list[list[str]]:
    rows = []
    elastic = [film for film in films if not film.contact.rigid]
    for quantity, source in PAIRS:
        good = [film.ratio(quantity, source) for film in elastic if film.converged]
        found = spread(good, len(elastic) - len(good), LIMITS)
        rows.append(
            [source, quantity, str(found.count), f"{found.mean:.3f}",
             f"{found.low:.2f} to {found.high:.2f}",
             *(f"{100.0 * share:.0f} %" for share in found.within)]
        )  # fmt: skip
    return rows


def draw(films: Films) -> Any:
    """Return ratios over load, colours for ellipticities and markers for materials."""
    from matplotlib.patches import Patch

    with house_style():
        figure = new_figure(11.0, 6.8)
        axes = figure.subplots(2, 3, sharey=True)
        for ax, (quantity, source) in zip(axes.flat, PAIRS, strict=False):
            _ratios(ax, films, quantity, source)
        _angles(axes[1, 2], films)
        for ax in axes.flat:
            for half, shade in _BANDS.items():
                ax.axhspan(1.0 - half, 1.0 + half, color=shade, lw=0.0, zorder=0)
            ax.set_yscale("log")
            ax.set_yticks(_TICKS, [f"{tick:g}" for tick in _TICKS])
            ax.minorticks_off()
        for ax in axes[:, 0]:
            ax.set_ylabel("solved film over formula [-]")
        handles = [
            axes[0, 0].plot([], [], "o", color=colour, label=f"$a_y/a_x$ = {k:g}")[0]
            for k, colour in zip(ELLIPTICITIES, SERIES, strict=False)
        ] + [
            axes[0, 0].plot([], [], marker, color="black", label=f"L = {L:g}")[0]
            for L, marker in zip(MATERIALS, MARKERS, strict=False)
        ]
        handles += axes[0, 0].plot(
            [], [], "o", color="black", markerfacecolor="none", label="open: rigid contact"
        )
        handles += [
            Patch(color=shade, label=f"within {100.0 * half:.0f} % of the formula")
            for half, shade in _BANDS.items()
        ]
        figure.legend(handles=handles, loc="outside lower center", ncols=6)
        return figure


def _ratios(ax: Any, films: Films, quantity: str, source: str) -> None:
    for contact in map_contacts():
        film = films.get((contact, FINE))
        if film is None:
            continue
        place = ELLIPTICITIES.index(contact.ellipticity)
        x = contact.M * 10.0 ** (_SPREAD * (place - 0.5 * (len(ELLIPTICITIES) - 1)))
        if not film.converged:
            ax.plot(x, 1.0, "x", color=SERIES[place], markersize=8)
            continue
        ax.plot(
            x,
            film.ratio(quantity, source),
            MARKERS[MATERIALS.index(contact.L)],
            color=SERIES[place],
            markerfacecolor="none" if contact.rigid else SERIES[place],
        )
    ax.set_xscale("log")
    ax.set_xlabel("load M [-]")
    ax.set_title(f"{quantity}, {source}")


def _angles(ax: Any, films: Films) -> None:
    for k, M, L in TURNED:
        found = [films.get((Contact(k, M, L, angle), FINE)) for angle in ANGLES]
        good = [film for film in found if film is not None and film.converged]
        for quantity, line in (("central film", "-"), ("minimum film", "--")):
            ax.plot(
                [film.contact.angle for film in good],
                [film.ratio(quantity, CHITTENDEN) for film in good],
                line,
                marker=MARKERS[MATERIALS.index(L)],
                color=SERIES[ELLIPTICITIES.index(k)],
            )
    ax.set_xticks(ANGLES)
    ax.set_xlabel("angle of entrainment to the short axis [°]")
    ax.set_title("Chittenden et al. 1985; dashed: minimum")
