"""Tables and counts of docs/ehl.md."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from docs.ehl.cases import (
    CYCLE,
    FACETED,
    LINE,
    WIDE,
    WIDE_FINE,
    FilmCase,
    facet_case,
    parabola_case,
)
from docs.ehl.claims import GPA, MISSING, MM, UM, Claim, Verdict
from docs.ehl.lines import March
from docs.ehl.runs import FACETS, MARCHED_PARABOLAS, POSITIONS, Run, power_case
from docs.ehl.store import MissingFilmError, Steady, Store
from docs.helical.pages import table
from docs.validation.tally import tally


def claims_table(claims: Sequence[Claim], verdicts: Sequence[Verdict]) -> str:
    """Return the verdicts, with how many there are of each kind above."""
    rows = [
        [claim.name, claim.statement, claim.source, claim.tolerance, found.value,
         f"**{found.verdict}**", found.reason]
        for claim, found in zip(claims, verdicts, strict=True)
    ]  # fmt: skip
    heads = ["#", "What the thesis says", "Printed in", "Tolerance", "Found", "Verdict", "Reason"]
    return f"\n{tally(found.verdict for found in verdicts)}.\n" + table(heads, rows)


def dry_table(store: Store) -> str:
    """Return largest pressures of films beside those of the dry contacts of the same gaps."""
    cases = [
        (f"{d.upper()}, k = 1, step {n}", FilmCase(design=d), n) for d in "ab" for n in POSITIONS
    ]
    cases += [(f"A, k = {k:g}, step 500", parabola_case("a", k), 500) for k in MARCHED_PARABOLAS]
    cases += [(f"B, beta = {b:g}, step 75", power_case("b", b), 75) for b in (3.0, 4.0)]
    cases += [(f"A, n_f = {n}, step 300", facet_case(n), 300) for n in FACETS[::-1]]
    rows = []
    for words, case, step in cases:
        try:
            film = store.steady(case, step)
        except MissingFilmError:
            continue
        over = 100.0 * (film.max_pressure / film.dry_pressure - 1.0)
        rows.append(
            [words, f"{GPA * film.dry_pressure:.3f}", f"{GPA * film.max_pressure:.3f}",
             f"{over:+.1f} %", f"{UM * film.min_film:.3f}", "yes" if film.converged else "**no**"]
        )  # fmt: skip
    heads = ["At rest", "dry, GPa", "with film, GPa", "film over dry", "smallest film, um"]
    return table([*heads, "converged"], rows)


def grid_table(store: Store) -> str:
    """Return pressure and film at rest on three grids."""
    grids: tuple[tuple[int, int], ...] = (CYCLE, LINE, WIDE, FACETED, WIDE_FINE)
    narrow: tuple[tuple[int, int], ...] = (CYCLE, LINE, FACETED)
    fine, wider = (LINE, FACETED), (WIDE, WIDE_FINE)
    cases = [(f"A, k = 1, step {n}", FilmCase(), n, narrow) for n in POSITIONS]
    cases += [(f"A, k = {k:g}, step 500", parabola_case("a", k), 500, wider) for k in (0.1, 0.0)]
    cases += [(f"A, n_f = {n}, step 300", facet_case(n, LINE), 300, fine) for n in (100, 20)]
    rows = []
    for words, case, step, ours in cases:
        cells = [_at_rest(store, replace(case, nodes=n), step) if n in ours else "" for n in grids]
        rows.append([words, *cells])
    return table(["GPa, um", *(f"{n[0]} x {n[1]}" for n in grids)], rows)


def _at_rest(store: Store, case: FilmCase, step: int) -> str:
    try:
        film = store.steady(case, step)
    except MissingFilmError:
        return MISSING
    failed = "" if film.converged else " (not converged)"
    return f"{GPA * film.max_pressure:.3f}, {UM * film.min_film:.3f}{failed}"


_CUT = 0.01


@dataclass(frozen=True, slots=True)
class _Tally:
    """What the list of runs came to."""

    films: list[Steady]
    marches: list[March]
    failed: list[str]
    cut: list[str]
    missing: int


def _tally(store: Store, runs: Sequence[Run]) -> _Tally:
    films, marches, failed, cut, missing = [], [], [], [], 0
    for run in runs:
        name = f"`{run.case.name}`"
        try:
            if run.first is None:
                film = store.steady(run.case, run.step)
                films.append(film)
                if film.border_pressure > _CUT:
                    cut.append(f"{name} at step {run.step}")
                if not film.converged:
                    failed.append(f"{name} at step {run.step}")
                continue
            march = store.march(run.case, run.first, run.step, run.keep)
        except MissingFilmError:
            missing += 1
            continue
        marches.append(march)
        if march["border_pressure"].max() > _CUT:
            cut.append(f"{name} in motion")
        if march.failures or not march.complete:
            state = "" if march.complete else ", given up"
            failed.append(f"{name}: {march.failures} of {len(march.step)} steps{state}")
    return _Tally(films, marches, failed, cut, missing)


def counts(store: Store, runs: Sequence[Run]) -> str:
    """Return how many films and steps were solved, which failed and what they took."""
    tally = _tally(store, runs)
    rest = sorted(film.seconds for film in tally.films)
    steps = sum(len(m.step) for m in tally.marches)
    bad = sum(m.failures for m in tally.marches)
    spent = sum(float(m["seconds"].sum()) for m in tally.marches)
    lacking = f" {tally.missing} runs of the list are not computed yet." if tally.missing else ""
    failed = f": {'; '.join(tally.failed)}" if tally.failed else ""
    return (
        f"\nOf {len(rest)} films at rest {sum(not f.converged for f in tally.films)} did not "
        f"converge, of {steps} time steps {bad}{failed}.{lacking}\n"
        f"\nPressure reaches the border of the domain (a hundredth of the largest, one node from "
        f"it): {'; '.join(tally.cut) or 'nowhere'}.\n"
        f"\nFilms at rest took {sum(rest):.0f} s of one processor, a median of "
        f"{rest[len(rest) // 2]:.1f} s each; time steps {spent:.0f} s.\n"
    )


def size() -> str:
    """Return the length of the line and the semi-width, in words."""
    film = FilmCase().film()
    return f"{MM * film.line_length:.1f} mm by {2.0 * MM * film.semi_width():.2f} mm"
