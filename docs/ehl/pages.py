"""Tables and counts of docs/ehl.md."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

from docs.ehl.cases import CYCLE, FACETED, LINE, FilmCase
from docs.ehl.claims import GPA, MM, UM, Claim, Verdict
from docs.ehl.runs import FACETS, MARCHED_PARABOLAS, POSITIONS, Run, power_case
from docs.ehl.store import Steady, Store
from docs.helical.pages import table


def claims_table(claims: Sequence[Claim], verdicts: Sequence[Verdict]) -> str:
    """Return the verdicts, with how many there are of each kind above."""
    counts = Counter(found.verdict for found in verdicts)
    rows = [
        [claim.name, claim.statement, claim.source, claim.tolerance, found.value,
         f"**{found.verdict}**", found.reason]
        for claim, found in zip(claims, verdicts, strict=True)
    ]  # fmt: skip
    heads = ["#", "Claim", "Printed in", "Tolerance", "Found", "Verdict", "Reason"]
    words = ", ".join(f"{n} {word}" for word, n in counts.most_common())
    return f"\n{words}.\n" + table(heads, rows)


def dry_table(store: Store) -> str:
    """Return largest pressures of films beside those of the dry contacts of the same gaps."""
    cases = [
        (f"{d.upper()}, k = 1, step {n}", FilmCase(design=d), n) for d in "ab" for n in POSITIONS
    ]
    cases += [(f"A, k = {k:g}, step 500", FilmCase(k=k), 500) for k in MARCHED_PARABOLAS]
    cases += [(f"B, beta = {b:g}, step 75", power_case("b", b), 75) for b in (3.0, 4.0)]
    cases += [
        (f"A, n_f = {n}, step 300", FilmCase(facets=n, nodes=FACETED), 300) for n in FACETS[::-1]
    ]
    rows = []
    for words, case, step in cases:
        film = store.steady(case, step)
        over = 100.0 * (film.max_pressure / film.dry_pressure - 1.0)
        rows.append(
            [words, f"{GPA * film.dry_pressure:.3f}", f"{GPA * film.max_pressure:.3f}",
             f"{over:+.1f} %", f"{UM * film.min_film:.3f}", "" if film.converged else "no"]
        )  # fmt: skip
    heads = ["At rest", "dry, GPA", "with film, GPa", "film over dry", "smallest film, um"]
    return table([h.replace("GPA", "GPa") for h in heads] + ["converged"], rows)


def grid_table(store: Store) -> str:
    """Return pressure and film at rest on three grids."""
    rows = []
    for step in POSITIONS:
        films = [store.steady(FilmCase(nodes=n), step) for n in (CYCLE, LINE, FACETED)]
        rows.append([f"A, k = 1, step {step}", *(_both(f) for f in films)])
    for k in (0.1, 0.0):
        films = [store.steady(FilmCase(k=k, nodes=n), 500) for n in (LINE, FACETED)]
        rows.append([f"A, k = {k:g}, step 500", "", *(_both(f) for f in films)])
    for facets in (100, 20):
        films = [store.steady(FilmCase(facets=facets, nodes=n), 300) for n in (LINE, FACETED)]
        rows.append([f"A, n_f = {facets}, step 300", "", *(_both(f) for f in films)])
    heads = [f"{n[0]} x {n[1]}" for n in (CYCLE, LINE, FACETED)]
    return table(["GPa, um", *heads], rows)


def _both(film: Steady) -> str:
    failed = "" if film.converged else " (not converged)"
    return f"{GPA * film.max_pressure:.3f}, {UM * film.min_film:.3f}{failed}"


def counts(store: Store, runs: Sequence[Run]) -> str:
    """Return how many films and steps were solved and which failed."""
    films = failed = steps = bad = 0
    words: list[str] = []
    for run in runs:
        if run.first is None:
            film = store.steady(run.case, run.step)
            films += 1
            if not film.converged:
                failed += 1
                words.append(f"`{run.case.name}` at step {run.step}")
        else:
            march = store.march(run.case, run.first, run.step, run.keep)
            steps += len(march.step)
            bad += march.failures
            if march.failures or not march.complete:
                state = "" if march.complete else ", given up"
                words.append(f"`{run.case.name}`: {march.failures} of {len(march.step)}{state}")
    listed = "; ".join(words) or "none"
    return (
        f"\nOf {films} films at rest {failed} did not converge, of {steps} time steps {bad}: "
        f"{listed}.\n"
    )


def cost(store: Store, runs: Sequence[Run]) -> str:
    """Return what films and steps took."""
    rest = [store.steady(r.case, r.step).seconds for r in runs if r.first is None]
    moved = [store.march(r.case, r.first, r.step, r.keep) for r in runs if r.first is not None]
    spent = sum(float(m["seconds"].sum()) for m in moved)
    return (
        f"\nFilms at rest took {sum(rest):.0f} s of one processor, a median of "
        f"{sorted(rest)[len(rest) // 2]:.1f} s each; the marches {spent:.0f} s of a busy machine's "
        "time.\n"
    )


def size() -> str:
    """Return the length of the line and the semi-width, in words."""
    film = FilmCase().film()
    return f"{MM * film.line_length:.1f} mm by {2.0 * MM * film.semi_width():.2f} mm"
