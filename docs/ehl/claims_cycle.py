"""Statements of Jamali 2015 on the whole meshing cycle: J1 to J9."""

from __future__ import annotations

import numpy as np

from docs.ehl.cases import CYCLE, FilmCase
from docs.ehl.claims import (
    GPA,
    MM,
    UM,
    highest_near,
    jumps,
    largest_change,
    listed,
    off_range,
    peaks,
    span,
)
from docs.ehl.lines import March
from docs.ehl.runs import COUNT_RANGE, COUNTS, CROWNS, POSITIONS, default_cycle
from docs.ehl.store import Store
from docs.page import Claims, Verdict, judge_parts
from gearlube_core.arrays import Array

_PRESSURE, _FILM = 0.05, 0.15
_SIDE = 200  # steps at both ends of the cycle
CYCLES = Claims()


def drawn_cycle(store: Store, design: str) -> March:
    """Return as much of that cycle as was found."""
    return store.march(default_cycle(design), 0, 575, POSITIONS)


def cycle(store: Store, design: str) -> March:
    """Return the whole cycle of a design as the thesis takes it by default."""
    return drawn_cycle(store, design).whole()


def crowned(store: Store, start: float) -> March:
    """Return the whole cycle of design A for F_o over F."""
    if start == 0.0:
        return cycle(store, "a")
    return store.march(FilmCase(crown_start=start, nodes=CYCLE), 0, 575).whole()


@CYCLES("J1")
def _load(store: Store) -> Verdict:
    marches = {d: cycle(store, d) for d in "ab"}
    most = [float(np.abs(m["load_error"]).max()) for m in marches.values()]
    steps = [len(m.step) - m.failures for m in marches.values()]
    return Verdict(
        f"A / B: at most {listed(most, '{:.0e}')} over {listed(steps, '{:.0f}')} steps",
        judge_parts(max(most) < 5e-3 and all(m.failures == 0 for m in marches.values())),
    )


@CYCLES("J2")
def _step_counts(store: Store) -> Verdict:
    first, last = COUNT_RANGE
    at = np.linspace(0.5 * (first + last), last - 2, 40)
    curves: dict[int, dict[str, Array]] = {}
    for count in COUNTS:
        march = store.march(FilmCase(nodes=CYCLE, count=count), first, last).whole()
        curves[count] = {
            name: np.interp(at, march.step, march[name]) for name in ("max_pressure", "min_film")
        }
    finest = curves[COUNTS[-1]]
    off = {
        count: [100.0 * largest_change(finest[name], curves[count][name]) for name in finest]
        for count in COUNTS[:-1]
    }
    return Verdict(
        "; ".join(f"{count}: {p:.2f} %, {h:.2f} %" for count, (p, h) in off.items())
        + f" off {COUNTS[-1]} (pressure, film)",
        judge_parts(max(off[400]) < 1.0),
        f"Steps {at[0]:.0f} to {at[-1]:.0f} of A, from rest at step {first}. First-order wedge: "
        "four times the steps change the film by 0.5 % (97 x 81 nodes), 6 % (182 x 161).",
    )


def _ranges(store: Store, design: str, pressures: tuple[float, float], films: tuple[float, float]):  # type: ignore[no-untyped-def]
    march = cycle(store, design)
    p, h = GPA * march["max_pressure"], UM * march["min_film"]
    at_rest = [UM * store.steady(FilmCase(design=design), n).min_film for n in POSITIONS]
    thinnest, place = int(march.step[h.argmin()]), MM * march["min_film_y"][h.argmin()]
    rest = span(min(at_rest), max(at_rest), "{:.3f}")
    return Verdict(
        f"{span(p.min(), p.max(), '{:.3f}')} GPa, {span(h.min(), h.max(), '{:.3f}')} um",
        judge_parts(off_range(p, *pressures) < _PRESSURE, off_range(h, *films) < _FILM),
        f"Thinnest at step {thinnest}, y = {place:.1f} mm; at rest at steps 75, 300 and 500 {rest} "
        "um. [Not converged in time](#the-smallest-film-in-motion).",
    )


@CYCLES("J3")
def _range_a(store: Store) -> Verdict:
    return _ranges(store, "a", (1.02, 1.25), (0.16, 0.22))


@CYCLES("J4")
def _range_b(store: Store) -> Verdict:
    return _ranges(store, "b", (0.82, 1.12), (0.16, 0.25))


@CYCLES("J5")
def _best_crown(store: Store) -> Verdict:
    marches = {f: crowned(store, f) for f in CROWNS}
    tops = {f: GPA * float(m["max_pressure"].max()) for f, m in marches.items()}
    films = {f: UM * float(m["min_film"].min()) for f, m in marches.items()}
    p, h = GPA * marches[0.25]["max_pressure"], UM * marches[0.25]["min_film"]
    sound = [f for f in CROWNS if films[f] > 0.95 * films[0.0]]
    best = min(sound, key=lambda f: tops[f])
    return Verdict(
        f"{span(p.min(), p.max())} GPa, {span(h.min(), h.max(), '{:.3f}')} um; the five: at most "
        f"{listed(tops.values())} GPa, at least {listed(films.values(), '{:.3f}')} um",
        judge_parts(
            off_range(p, 0.98, 1.17) < _PRESSURE, off_range(h, 0.16, 0.22) < _FILM, best == 0.25
        ),
        "Best: lowest pressure with a film not thinner by 5 % than that of F_o = 0. Here F_o = "
        f"{best:g} F.",
    )


@CYCLES("J6")
def _crown_films(store: Store) -> Verdict:
    plain, sharp, even = (crowned(store, f) for f in (0.0, 0.45, 0.25))
    films = [UM * m.at("min_film", 300) for m in (plain, sharp)]
    tops = [GPA * m.at("max_pressure", 300) for m in (sharp, even)]
    place = MM * sharp.at("max_pressure_y", 300)
    return Verdict(
        f"{listed(films, '{:.3f}')} um; at step 300 0.45 F {tops[0]:.3f} GPa at y = "
        f"{place:.1f} mm, 0.25 F {tops[1]:.3f} GPa",
        judge_parts(
            abs(films[0] / 0.21 - 1.0) < _FILM, abs(films[1] / 0.14 - 1.0) < _FILM,
            tops[0] > 1.02 * tops[1] and abs(place) > 10.0,
        ),
    )  # fmt: skip


@CYCLES("J7")
def _crown_order(store: Store) -> Verdict:
    sides = []
    for start in CROWNS:
        march = crowned(store, start)
        side = (march.step <= _SIDE) | (march.step >= 575 - _SIDE)
        sides.append(GPA * float(march["max_pressure"][side].mean()))
    counts = [peaks(store.steady(FilmCase(crown_start=f), 300).along, 0.01) for f in CROWNS]
    return Verdict(
        f"mean over both ends {listed(sides, '{:.3f}')} GPa; peaks along the line at step 300: "
        f"{listed(counts, '{:.0f}')}",
        judge_parts(bool((np.diff(sides) < 0.0).all()), counts[0] == 1 and min(counts[1:]) >= 2),
        f"For F_o = {listed(CROWNS, '{:g}')} F. A peak rises by 1 % of the largest pressure.",
    )


@CYCLES("J8")
def _places(store: Store) -> Verdict:
    printed = {"a": [(210, 360), (204, 370)], "b": [(180, 370)]}
    words, good = [], []
    for design, ranges in printed.items():
        march = cycle(store, design)
        found = jumps(march.step, march["max_pressure_y"], 3e-3)
        ends = (found[0], found[-1]) if len(found) > 1 else (np.nan, np.nan)
        words.append(f"{design.upper()} {ends[0]:.0f} to {ends[1]:.0f}")
        off = [max(abs(ends[0] - low), abs(ends[1] - high)) for low, high in ranges]
        good.append(min(off) <= 20.0)
    return Verdict(", ".join(words), judge_parts(*good))


@CYCLES("J9")
def _highest(store: Store) -> Verdict:
    found = []
    for design in "ab":
        march = cycle(store, design)
        found += [*highest_near(march.step, march["max_pressure"], 290.0)]
    off = [abs(v - printed) for v, printed in zip(found, (100, 500, 100, 500), strict=True)]
    return Verdict(
        f"A {found[0]:.0f}, {found[1]:.0f}; B {found[2]:.0f}, {found[3]:.0f}",
        judge_parts(max(off) <= 50.0),
    )
