"""Every film and march that the page needs, cheap ones first."""

from __future__ import annotations

import logging
import time
from collections.abc import Sequence
from dataclasses import dataclass

from docs.ehl.cases import CYCLE, FACETED, LINE, WIDE_FINE, FilmCase, facet_case, parabola_case
from docs.ehl.store import Store

logger = logging.getLogger("docs.ehl")

DESIGNS = ("a", "b")
POSITIONS = (75, 300, 500)  # of the thesis' detailed results
CROWNS = (0.0, 0.1, 0.25, 0.4, 0.45)  # F_o over F
PARABOLAS = (1.0, 0.7, 0.5, 0.3, 0.2, 0.1, 0.05, 0.02, 0.01, 0.0)  # k
MARCHED_PARABOLAS = (0.3, 0.1, 0.02, 0.0)
POWERS = (1.0, 2.0, 3.0, 4.0)  # beta
POWER_STEPS = tuple(range(25, 551, 25))
SPEEDS = (1.0, 2.0, 5.0, 10.0)
FACETS = (20, 30, 40, 60, 80, 100)
COUNTS = (200, 400, 800)
COUNT_RANGE = (440, 520)
APPROACH = 40  # steps from rest before a step that is looked at
LAYERS = (0.0, 10.0, 30.0)  # nm; 0: the oil alone
TOUCHING_K = (0.02, 0.0)
TOUCHING = (460, 500)  # steps
FACET_STEPS = (75, 500)
FACET_MARCH = (280, 300)


def power_case(design: str, beta: float, **rest: object) -> FilmCase:
    """Return a relief by eq. (5.6): 2 is the parabola and 1 the straight line."""
    if beta == 1.0:
        return parabola_case(design, 0.0, **rest)  # type: ignore[arg-type]
    if beta == 2.0:
        return FilmCase(design=design, **rest)  # type: ignore[arg-type]
    return FilmCase(design=design, beta=beta, **rest)  # type: ignore[arg-type]


def touching_case(k: float, layer: float) -> FilmCase:
    """Return a steep relief of design A with a given layer on its solids."""
    return FilmCase(k=k, nodes=CYCLE, wide=True, layer=layer)


def default_cycle(design: str) -> FilmCase:
    """Return what a whole cycle is marched as."""
    return FilmCase(design=design, nodes=CYCLE)


@dataclass(frozen=True, slots=True, kw_only=True)
class Run:
    """One entry of the list: a film at rest, or a march up to a step."""

    case: FilmCase
    step: int
    first: int | None = None  # where a march begins
    keep: tuple[int, ...] = ()

    def do(self, store: Store) -> None:
        """Compute what is missing."""
        if self.first is None:
            store.steady(self.case, self.step)
        else:
            store.march(self.case, self.first, self.step, self.keep)


def _films(films: list[tuple[FilmCase, int]]) -> list[Run]:
    return [Run(case=case, step=step) for case, step in films]


def _first() -> list[Run]:
    runs = _films([(FilmCase(design=d), n) for d in DESIGNS for n in POSITIONS])
    runs += _films([(FilmCase(design=d, nodes=CYCLE), n) for d in DESIGNS for n in POSITIONS])
    return [*runs, _cycle("a")]


def _cycle(design: str) -> Run:
    return Run(case=default_cycle(design), first=0, step=575, keep=POSITIONS)


def _at_rest() -> list[Run]:
    films = [(FilmCase(crown_start=f), 300) for f in CROWNS]
    films += [(parabola_case("a", k), 500) for k in PARABOLAS]
    films += [(power_case("b", b), n) for b in POWERS for n in (75, 500)]
    films += [(FilmCase(speed=s, nodes=FACETED), n) for s in SPEEDS for n in POSITIONS]
    films += [(facet_case(n), 300) for n in reversed(FACETS)]
    films += [(power_case("a", b), n) for b in POWERS for n in (75, 500)]
    films += [(facet_case(n), s) for n in (100, 40) for s in FACET_STEPS]
    films += [(parabola_case("b", k), 500) for k in (1.0, *MARCHED_PARABOLAS)]
    films += [(FilmCase(nodes=FACETED), n) for n in POSITIONS]
    films += [(FilmCase(design="b", nodes=FACETED), 300)]
    films += [(facet_case(n, LINE), 300) for n in (100, 20)]
    films += [(parabola_case("a", k, WIDE_FINE), 500) for k in (0.1, 0.0)]
    films += [(facet_case(n), s) for n in (30, 20) for s in FACET_STEPS]
    films += [
        (power_case(d, b, nodes=CYCLE), n) for d in DESIGNS for b in POWERS[1:] for n in POWER_STEPS
    ]
    return _films(films)


def _marches() -> list[Run]:
    runs = [_cycle("b")]
    runs += [
        Run(case=FilmCase(speed=s, nodes=CYCLE), first=500 - APPROACH, step=500) for s in SPEEDS
    ]
    runs += [
        Run(case=parabola_case("a", k), first=500 - APPROACH, step=500)
        for k in (1.0, *MARCHED_PARABOLAS)
    ]
    runs += [Run(case=power_case("b", b), first=75 - APPROACH, step=75) for b in POWERS]
    first, last = COUNT_RANGE
    runs += [Run(case=FilmCase(nodes=CYCLE, count=n), first=first, step=last) for n in COUNTS]
    begin, end = FACET_MARCH
    runs += [Run(case=facet_case(n), first=begin, step=end, keep=(end,)) for n in (100, 40)]
    runs += [
        Run(case=FilmCase(crown_start=f, nodes=CYCLE), first=0, step=575)
        for f in (0.45, 0.25, 0.1, 0.4)
    ]
    return runs


def _touching() -> list[Run]:
    first, last = TOUCHING
    return [
        Run(case=touching_case(k, layer), first=first, step=last)
        for k in TOUCHING_K
        for layer in LAYERS
    ]


def all_runs() -> list[Run]:
    """Return all runs in the order in which they are done."""
    runs: list[Run] = []
    for run in (*_first(), *_at_rest(), *_marches(), *_touching()):
        if run not in runs:
            runs.append(run)
    return runs


def do_runs(store: Store, runs: Sequence[Run]) -> None:
    """Do what is missing and tell how far it is."""
    began = time.monotonic()
    for n, run in enumerate(runs, 1):
        before = time.monotonic()
        run.do(store)
        now = time.monotonic()
        if now - before > 1.0:
            logger.info("%d of %d, %.0f s, %.0f s in all", n, len(runs), now - before, now - began)
