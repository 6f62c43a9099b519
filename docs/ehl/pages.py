"""Counts of docs/ehl.md, and what depends on the layer of touching solids."""

from __future__ import annotations

from itertools import product

from docs.ehl.claims import GPA, UM
from docs.ehl.lines import March
from docs.ehl.runs import (
    LAYERS,
    TOUCHING,
    TOUCHING_K,
    all_runs,
    touching_case,
)
from docs.ehl.store import Store
from docs.kept_films import MissingFilmError
from docs.page import Page


def touched(march: March) -> bool:
    """Return whether the solids carry load in any step."""
    return bool(march["solid_share"].max() > 0.0)


def put_touching(page: Page, store: Store) -> None:
    """Put in how much depends on the layer."""
    rows = []
    for k, layer in product(TOUCHING_K, LAYERS):
        try:
            rows.append(_values(store.march(touching_case(k, layer), *TOUCHING)))
        except MissingFilmError:
            rows.append([])
    page.cells("k | layer, nm", rows)


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


def put_counts(page: Page, store: Store) -> None:
    """Put in how many films and steps were solved and which failed."""
    rest, marches, failed = [], [], []
    for run in all_runs():
        name = f"`{run.case.name}`"
        try:
            if run.first is None:
                film = store.steady(run.case, run.step)
                rest.append(film)
                bad, how = not film.converged, f" at step {run.step}"
            else:
                march = store.march(run.case, run.first, run.step, run.keep)
                marches.append(march)
                bad = bool(march.failures) or not march.complete
                how = f": {march.failures} of {len(march.step)} steps"
                how += "" if march.complete else ", film lost"
        except MissingFilmError:
            return
        failed += [name + how] if bad else []
    page.paragraph(
        "## Convergence",
        f"Of {len(rest)} films at rest {sum(not f.converged for f in rest)} did not converge, of "
        f"{sum(len(m.step) for m in marches)} time steps {sum(m.failures for m in marches)}"
        f"{': ' if failed else ''}{'; '.join(failed)}.",
    )
