"""Picture of solved films over published formulas."""

from __future__ import annotations

from typing import Any

from docs.ehl.film_map import (
    ANGLES,
    CHITTENDEN,
    ELLIPTICITIES,
    FINE,
    HAMROCK_DOWSON,
    MATERIALS,
    NIJENBANNING,
    TURNED,
    Contact,
    Films,
    map_contacts,
)
from gearlube.plotting.style import MARKERS, SERIES, house_style, new_figure

_PANELS = (
    ("central film", HAMROCK_DOWSON),
    ("central film", CHITTENDEN),
    ("central film", NIJENBANNING),
    ("minimum film", HAMROCK_DOWSON),
    ("minimum film", CHITTENDEN),
)
_BANDS = {0.2: "#E9E9E9", 0.1: "#CFCFCF"}  # shade by half width, the narrow one on top
_TICKS = (0.5, 0.6, 0.7, 0.8, 1.0, 1.2, 1.5, 2.0, 3.0, 5.0)
_SPREAD = 0.035  # of markers of one load, in decades


def draw(films: Films) -> Any:
    """Return ratios over load, colours for ellipticities and markers for materials."""
    from matplotlib.patches import Patch

    with house_style():
        figure = new_figure(11.0, 6.8)
        axes = figure.subplots(2, 3, sharey=True)
        for ax, (quantity, source) in zip(axes.flat, _PANELS, strict=False):
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
