"""Section of docs/ehl.md on solids that touch: how much depends on the layer that carries them."""

from __future__ import annotations

from itertools import product

from docs.ehl.cases import LAYER
from docs.ehl.claims import GPA, UM
from docs.ehl.lines import March
from docs.ehl.runs import LAYERS, TOUCHING, TOUCHING_K, all_runs, touching_case
from docs.ehl.store import MissingFilmError, Store
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
    failed = f"{march.failures} of {len(march.step)}" + ("" if march.complete else ", given up")
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
