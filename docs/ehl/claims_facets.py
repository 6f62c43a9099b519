"""Statements of Jamali 2015 chapter 6 on faceted flanks: F1 to F8."""

from __future__ import annotations

import numpy as np

from docs.ehl.cases import LINE, FilmCase, facet_case
from docs.ehl.claims import GPA, MM, UM, exponent, listed, peaks, span
from docs.ehl.runs import FACET_MARCH, FACET_STEPS, FACETS
from docs.ehl.store import Steady, Store
from docs.page import Claims, Verdict, judge_parts
from gearlube_core.arrays import Array

_PRESSURE, _FILM = 0.1, 0.2
_MARCHED = (40, 100)
_SPIKE = 0.2  # of the largest pressure
FACETED_FLANKS = Claims()


def faceted(store: Store, facets: int, step: int = 300) -> Steady:
    """Return design A with faceted flanks at rest; 0 facets: smooth."""
    return store.steady(facet_case(facets), step)


def _found(store: Store, facets: int) -> tuple[Array, Array, int, int]:
    """Return pressures [GPa] and films [um], at rest and in motion, films and failures."""
    films = [faceted(store, facets, n) for n in (300, *FACET_STEPS)]
    p = [GPA * f.max_pressure for f in films]
    h = [UM * f.min_film for f in films]
    count, failed = len(films), sum(not f.converged for f in films)
    if facets in _MARCHED:
        march = store.march(facet_case(facets), *FACET_MARCH, FACET_MARCH[1:])
        p += list(GPA * march["max_pressure"])
        h += list(UM * march["min_film"])
        count, failed = count + len(march.step), failed + march.failures
    return np.array(p), np.array(h), count, failed


def _within(values: Array, low: float, high: float, tolerance: float) -> bool:
    return bool(values.min() > low * (1 - tolerance) and values.max() < high * (1 + tolerance))


def _values(p: Array, h: Array, count: int, failed: int) -> str:
    words = f"{span(p.min(), p.max())} GPa, {span(h.min(), h.max(), '{:.3f}')} um"
    return f"{words}; {failed} of {count} films not converged"


@FACETED_FLANKS("F1")
def _twenty(store: Store) -> Verdict:
    p, h, count, failed = _found(store, 20)
    return Verdict(
        _values(p, h, count, failed),
        judge_parts(_within(p, 2.44, 3.16, _PRESSURE), failed > 0 or h.min() < 0.02),
    )


@FACETED_FLANKS("F2")
def _thirty(store: Store) -> Verdict:
    p, h, count, failed = _found(store, 30)
    drop = 1.0 - p.max() / _found(store, 20)[0].max()
    return Verdict(
        f"{_values(p, h, count, failed)}; {-100.0 * drop:+.0f} % from 20",
        judge_parts(
            abs(p.max() / 2.27 - 1.0) < _PRESSURE, abs(drop - 0.28) < 0.05,
            failed > 0 or h.min() < 0.02,
        ),
    )  # fmt: skip


@FACETED_FLANKS("F3")
def _forty(store: Store) -> Verdict:
    p, h, count, failed = _found(store, 40)
    return Verdict(
        _values(p, h, count, failed),
        judge_parts(
            _within(p, 1.6, 1.9, _PRESSURE), _within(h, 0.11, 0.16, _FILM),
            failed == 0 and h.min() > 0.02,
        ),
    )  # fmt: skip


@FACETED_FLANKS("F4")
def _hundred(store: Store) -> Verdict:
    p, h, count, failed = _found(store, 100)
    smooth = max(GPA * faceted(store, 0, n).max_pressure for n in (300, *FACET_STEPS))
    rise = p.max() / smooth - 1.0
    return Verdict(
        f"{_values(p, h, count, failed)}; {100.0 * rise:+.1f} % on the smooth pressure",
        judge_parts(
            _within(p, 1.18, 1.42, _PRESSURE), _within(h, 0.14, 0.20, _FILM),
            abs(rise - 0.136) < 0.05,
        ),
    )  # fmt: skip


@FACETED_FLANKS("F5")
def _monotone(store: Store) -> Verdict:
    films = [faceted(store, n) for n in (*FACETS, 0)]
    p = [GPA * f.max_pressure for f in films]
    h = [UM * f.min_film for f in films]
    return Verdict(
        f"{listed(p)} GPa, {listed(h, '{:.3f}')} um",
        judge_parts(bool((np.diff(p) < 0.0).all()), bool((np.diff(h) > 0.0).all())),
        f"At rest, step 300, n_f = {listed(FACETS, '{:g}')} / smooth.",
    )


@FACETED_FLANKS("F6")
def _spikes(store: Store) -> Verdict:
    found = peaks(faceted(store, 20).along, _SPIKE)
    return Verdict(f"{found}", judge_parts(abs(found - 13) <= 1))


@FACETED_FLANKS("F7")
def _grids(store: Store) -> Verdict:
    off = {}
    for n in (20, 100):
        coarse, fine = store.steady(facet_case(n, LINE), 300), faceted(store, n)
        off[n] = [
            100.0 * (coarse.max_pressure / fine.max_pressure - 1.0),
            100.0 * (coarse.min_film / fine.min_film - 1.0),
        ]
    return Verdict(
        "; ".join(f"n_f = {n}: {p:+.1f} %, {h:+.1f} %" for n, (p, h) in off.items())
        + " (pressure, film)",
        judge_parts(max(map(abs, off[20])) < 10.0, max(map(abs, off[100])) < 2.0),
    )


def facet_gaps(counts: tuple[int, ...] = FACETS) -> list[float]:
    """Return the largest difference of the faceted from the smooth gap at step 300 [m]."""
    case = FilmCase()
    smooth = case.film()
    moving = smooth.moving_film()
    X = smooth.line(300 * smooth.time_step)
    y = moving.y[np.abs(moving.y) < 0.015]  # clear of both reliefs
    gap = smooth.gap(moving.x, y, X)
    return [
        float(np.abs(facet_case(n, LINE).film().gap(moving.x, y, X) - gap).max()) for n in counts
    ]


@FACETED_FLANKS("F8")
def _geometry(_: Store) -> Verdict:
    gaps = facet_gaps()
    slope = exponent(FACETS, gaps)
    pair = FilmCase().film().modified.pair
    length = MM * (pair.contact_end - pair.contact_start) / 20
    return Verdict(
        f"{length:.2f} mm; gap off by {listed([UM * g for g in gaps], '{:.3f}')} um, power "
        f"{slope:.2f}",
        judge_parts(abs(length - 1.0) < 0.1, abs(slope + 2.0) < 0.1),
    )
