"""Section of docs/ehl.md on the micro-cavity: table, picture, speeds."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np

from docs.ehl.micro_cavity import (
    FASTER,
    ROLLING,
    SLIDING,
    SPEED,
    A,
    CavityCase,
    Passage,
    kept_passage,
    speeds,
)
from docs.ehl.store import Store
from docs.kept_films import MissingFilmError
from docs.page import IMAGES, Page
from gearlube.plotting.style import BLUE, GREY, VERMILLION, house_style, new_figure

NODES = (161, 97)
_NM, _UM, _MPA = 1e9, 1e6, 1e-6


class Published(NamedTuple):
    """Numbers of Mourier's simulation at one place of the cavity, sliding."""

    centre: float  # where the film in the cavity is thickest [um]
    hollow: float  # that film [nm]
    oil_place: float  # where the film in front is thickest [um]
    oil: float  # that film [nm]
    pressure: float  # largest [MPa]


# read from the curves of Mourier et al. 2006 as digitised with Hansen et al. 2022; about 3 um, 3 nm
SLIDING_PUBLISHED = (
    Published(-69.0, 316.7, -37.3, 277.6, 579.7),
    Published(-37.7, 288.6, 20.8, 275.3, 549.0),
    Published(-8.4, 284.6, 81.7, 269.5, 541.9),
)


def put_micro_cavity(page: Page, store: Store) -> None:
    """Put in the tables and draw the picture; all stays where films are missing."""
    cases = (ROLLING, SLIDING, FASTER)
    try:
        passages = [kept_passage(store, case, NODES) for case in cases]
    except MissingFilmError:
        return
    sliding = passages[1]
    draw(sliding).savefig(IMAGES / "ehl_micro_cavity.png", dpi=100)
    page.fill(
        "{} of {} time steps did not converge. They took {} s of one processor.",
        sum(one.failures for one in passages),
        sum(one.times.size for one in passages),
        f"{sum(one.seconds for one in passages):.0f}",
    )
    smooth = _NM * float(np.interp(0.0, sliding.x, sliding.smooth_film))
    page.fill("Without a cavity the film in the middle is 212 / {} nm.", f"{smooth:.0f}")
    page.rows("cavity at, um", _film_rows(sliding))
    page.rows("slide-roll | u of", _speed_rows(list(zip(cases, passages, strict=True))))


class Found(NamedTuple):
    """What `Published` holds, of a march."""

    hollow: float  # [nm]
    oil_place: float  # [um]
    oil: float  # [nm]
    pressure: float  # [MPa]


def at_cavity(case: CavityCase, passage: Passage, centre: float) -> Found:
    """Return films and pressure when the cavity is at a place [um].

    The oil that was let in is the thickest film between the cavity's edge, 1.2 r_c from its
    centre, and 0.8 dry radii.
    """
    n = passage.step(centre / _UM)
    x, film = passage.x, passage.film[n]
    offset = x - passage.centre[n]
    hollow = film[np.abs(offset) < case.cavity_radius].max()
    ahead = np.flatnonzero((offset > 1.2 * case.cavity_radius) & (x < 0.8 * A))
    k = int(ahead[film[ahead].argmax()])
    top, place = _summit(x, film, k)
    return Found(
        _NM * float(hollow), _UM * place, _NM * top, _MPA * float(passage.pressure[n].max())
    )


def _summit(x: Any, film: Any, k: int) -> tuple[float, float]:
    """Return the height and the place of the parabola through node k and its neighbours."""
    low, top, high = film[k - 1 : k + 2]
    bend = low - 2.0 * top + high
    if bend >= 0.0:
        return float(top), float(x[k])
    part = 0.5 * (low - high) / bend
    return float(top - 0.25 * (low - high) * part), float(x[k] + part * (x[1] - x[0]))


def _film_rows(passage: Passage) -> list[list[str]]:
    rows = []
    for one in SLIDING_PUBLISHED:
        found = at_cavity(SLIDING, passage, one.centre)
        rows.append(
            [f"{one.centre:.1f}", f"{one.hollow:.0f} / {found.hollow:.0f}",
             f"{one.oil:.0f} / {found.oil:.0f}", f"{one.oil_place:.0f} / {found.oil_place:.0f}",
             f"{one.pressure:.0f} / {found.pressure:.0f}"]
        )  # fmt: skip
    return rows


def _speed_rows(found: list[tuple[CavityCase, Passage]]) -> list[list[str]]:
    rows = []
    for case, passage in found:
        hollow, oil = speeds(case, passage)
        rows.append(
            [f"{case.slide_roll:+g}", f"{case.cavity_speed:.3f}", f"{hollow:.4f}",
             f"{100.0 * (hollow / case.cavity_speed - 1.0):+.1f} %",
             *(("", "") if math.isnan(oil)
               else (f"{oil:.4f}", f"{100.0 * (oil / SPEED - 1.0):+.1f} %"))]
        )  # fmt: skip
    return rows


def draw(passage: Passage) -> Any:
    """Return films at the published places and the change of film over place and time."""
    with house_style():
        figure = new_figure(11.0, 6.2)
        axes = figure.subplots(2, 2)
        x = _UM * passage.x
        for ax, one in zip(axes.flat, SLIDING_PUBLISHED, strict=False):
            n = passage.step(one.centre / _UM)
            ax.plot(x, _NM * passage.smooth_film, color=GREY, label="without cavity")
            ax.plot(x, _NM * passage.film[n], color=BLUE, label="with cavity")
            ax.plot(
                (one.centre, one.oil_place), (one.hollow, one.oil), "o",
                color=VERMILLION, label="Mourier et al. 2006, simulation",
            )  # fmt: skip
            ax.set_xlim(-150.0, 150.0)
            ax.set_ylim(150.0, 350.0)
            ax.set_title(f"cavity at {one.centre:g} µm")
            ax.set_ylabel("film [nm]")
        axes[0, 0].legend()
        _over_time(figure, axes[1, 1], passage)
        for ax in axes.flat:
            ax.set_xlabel("x [µm]")
        return figure


def _over_time(figure: Any, ax: Any, passage: Passage) -> None:
    inside = np.abs(passage.x) < A
    x, t = _UM * passage.x[inside], 1e3 * passage.times
    change = _NM * passage.change[:, inside]
    drawn = ax.pcolormesh(x, t, change, cmap="RdBu_r", vmin=-110.0, vmax=110.0, shading="auto")
    figure.colorbar(drawn, ax=ax, label="change of film [nm]")
    place = SLIDING_PUBLISHED[1].centre
    n = passage.step(place / _UM)
    for speed, through, style, words in (
        (SLIDING.cavity_speed, _UM * passage.centre[n], "-", "speed of the cavity"),
        (SPEED, at_cavity(SLIDING, passage, place).oil_place, "--", "mean speed"),
    ):
        line = through + 1e3 * speed * (t - t[n])
        shown = (line > x[0]) & (line < x[-1])
        ax.plot(line[shown], t[shown], style, color="black", linewidth=1.0, label=words)
    ax.legend(loc="lower right")
    ax.set_ylabel("time [ms]")
    ax.set_ylim(t[passage.step(-1.1 * A)], t[-1])
    ax.set_title("change of film")
