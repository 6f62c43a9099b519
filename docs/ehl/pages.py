"""Tables and counts of docs/ehl.md, and where solids touch."""

from __future__ import annotations

from dataclasses import replace
from itertools import product

from docs.ehl.cases import (
    CYCLE,
    FACETED,
    LAYER,
    LINE,
    WIDE,
    WIDE_FINE,
    FilmCase,
    facet_case,
    parabola_case,
)
from docs.ehl.claims import GPA, UM
from docs.ehl.lines import March
from docs.ehl.runs import (
    FACETS,
    LAYERS,
    MARCHED_PARABOLAS,
    POSITIONS,
    TOUCHING,
    TOUCHING_K,
    all_runs,
    power_case,
    touching_case,
)
from docs.ehl.store import Store
from docs.kept_films import MissingFilmError
from docs.page import Page


def touched(march: March) -> bool:
    """Return whether the solids carry load in any step."""
    return bool(march["solid_share"].max() > 0.0)


def put_touching(page: Page, store: Store) -> None:
    """Put in how much depends on the layer, and in which runs of the page solids touch."""
    rows = []
    for k, layer in product(TOUCHING_K, LAYERS):
        try:
            rows.append(_values(store.march(touching_case(k, layer), *TOUCHING)))
        except MissingFilmError:
            rows.append([])
    page.cells("k | layer, nm", rows)
    _all(page, store)


def _values(march: March) -> list[str]:
    films, good = march["min_film"], march["converged"] > 0.0
    failed = f"{march.failures} of {len(march.step)}" + ("" if march.complete else ", film lost")
    return [
        f"{1e3 * UM * films[good].min():.1f}",
        f"{GPA * march['max_pressure'][good].max():.2f}",
        f"{100.0 * march['solid_share'][good].max():.2g} %",
        f"{1e6 * march['solid_area'][good].max():.2g}",
        failed,
    ]


def _all(page: Page, store: Store) -> None:
    rest, marches, words = 0, 0, []
    for run in all_runs():
        if run.case.layer != LAYER:
            continue
        rest, marches = rest + (run.first is None), marches + (run.first is not None)
        name = f"`{run.case.name}`"
        try:
            if run.first is None:
                share = store.steady(run.case, run.step).solid_share
                where = f"{name} at step {run.step}, at rest"
            else:
                march = store.march(run.case, run.first, run.step, run.keep)
                share, where = float(march["solid_share"].max()), f"{name} in motion"
        except MissingFilmError:
            return
        if share > 0.0:
            words.append(f"{where} ({100.0 * share:.2g} %)")
    page.fill(
        "Of {} films at rest and {} marches with that layer solids touch in (largest share of the "
        "load): {}.\n\n",
        rest,
        marches,
        "; ".join(words) or "none",
    )


def dry_rows(store: Store) -> list[list[str]]:
    """Return largest pressures of films beside those of the dry contacts of the same gaps."""
    cases = [(FilmCase(design=d), n) for d in "ab" for n in POSITIONS]
    cases += [(parabola_case("a", k), 500) for k in MARCHED_PARABOLAS]
    cases += [(power_case("b", b), 75) for b in (3.0, 4.0)]
    cases += [(facet_case(n), 300) for n in FACETS[::-1]]
    rows: list[list[str]] = []
    for case, step in cases:
        try:
            film = store.steady(case, step)
        except MissingFilmError:
            rows.append([])
            continue
        over = 100.0 * (film.max_pressure / film.dry_pressure - 1.0)
        rows.append(
            [f"{GPA * film.dry_pressure:.3f}", f"{GPA * film.max_pressure:.3f}",
             f"{over:+.1f} %", f"{UM * film.min_film:.3f}", "yes" if film.converged else "**no**"]
        )  # fmt: skip
    return rows


def grid_rows(store: Store) -> list[list[str | None]]:
    """Return pressure and film at rest on up to three of five grids."""
    grids: tuple[tuple[int, int], ...] = (CYCLE, LINE, WIDE, FACETED, WIDE_FINE)
    narrow: tuple[tuple[int, int], ...] = (CYCLE, LINE, FACETED)
    fine, wider = (LINE, FACETED), (WIDE, WIDE_FINE)
    cases = [(FilmCase(), n, narrow) for n in POSITIONS]
    cases += [(parabola_case("a", k), 500, wider) for k in (0.1, 0.0)]
    cases += [(facet_case(n, LINE), 300, fine) for n in (100, 20)]
    return [
        [_at_rest(store, replace(case, nodes=n), step) if n in ours else "" for n in grids]
        for case, step, ours in cases
    ]


def _at_rest(store: Store, case: FilmCase, step: int) -> str | None:
    try:
        film = store.steady(case, step)
    except MissingFilmError:
        return None
    failed = "" if film.converged else " (not converged)"
    return f"{GPA * film.max_pressure:.3f}, {UM * film.min_film:.3f}{failed}"


_CUT = 0.01


def put_counts(page: Page, store: Store) -> None:
    """Put in how many films and steps were solved, which failed and what they took."""
    rest, marches, failed, cut = [], [], [], []
    for run in all_runs():
        name = f"`{run.case.name}`"
        try:
            if run.first is None:
                film = store.steady(run.case, run.step)
                rest.append(film)
                border, bad, where = film.border_pressure, not film.converged, f"at step {run.step}"
                how = f" {where}"
            else:
                march = store.march(run.case, run.first, run.step, run.keep)
                marches.append(march)
                border, where = float(march["border_pressure"].max()), "in motion"
                bad = bool(march.failures) or not march.complete
                how = f": {march.failures} of {len(march.step)} steps"
                how += "" if march.complete else ", film lost"
        except MissingFilmError:
            return
        cut += [f"{name} {where}"] if border > _CUT else []
        failed += [name + how] if bad else []
    seconds = sorted(film.seconds for film in rest)
    page.paragraph(
        "## What did not converge",
        f"Of {len(rest)} films at rest {sum(not f.converged for f in rest)} did not converge, of "
        f"{sum(len(m.step) for m in marches)} time steps {sum(m.failures for m in marches)}"
        f"{': ' if failed else ''}{'; '.join(failed)}.",
    )
    page.fill("one node from it): {}.\n\n", "; ".join(cut) or "nowhere")
    page.fill(
        "Films at rest took {} s of one processor, a median of {} s each; time steps {} s.",
        f"{sum(seconds):.0f}",
        f"{seconds[len(seconds) // 2]:.1f}",
        f"{sum(float(m['seconds'].sum()) for m in marches):.0f}",
    )
