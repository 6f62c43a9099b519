"""Section of docs/ehl.md on solids that touch: how much depends on the layer that carries them."""

from __future__ import annotations

from pathlib import Path

from docs.ehl.cases import LAYER
from docs.ehl.claims import GPA, MISSING, UM
from docs.ehl.lines import March
from docs.ehl.runs import LAYERS, TOUCHING, TOUCHING_K, Run, touching_case
from docs.ehl.store import MissingFilmError, Store
from docs.helical.pages import table


def touched(march: March) -> bool:
    """Return whether the solids carry load in any step."""
    return bool(march["solid_share"].max() > 0.0)


def touching_section(store: Store, runs: list[Run]) -> str:
    """Return the section with its table and what the runs of the page came to."""
    text = (Path(__file__).parent / "text" / "touching.md").read_text(encoding="utf-8")
    text = text.format(layer=LAYER, first=TOUCHING[0], last=TOUCHING[1])
    rows = []
    for k in TOUCHING_K:
        for layer in LAYERS:
            row = [f"{k:g}", f"{layer:g}" if layer else "none"]
            try:
                march = store.march(touching_case(k, layer), *TOUCHING)
            except MissingFilmError:
                rows.append([*row, MISSING, "", "", "", ""])
                continue
            rows.append([*row, *_values(march)])
    heads = ["k", "layer, nm", "smallest film, nm", "largest pressure, GPa"]
    heads += ["share of load on solids", "touching area, mm2", "steps not converged"]
    return text + table(heads, rows) + _all(store, runs)


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


def _all(store: Store, runs: list[Run]) -> str:
    rest, marches, words = 0, 0, []
    for run in runs:
        if run.case.layer != LAYER:
            continue
        name = f"`{run.case.name}`"
        try:
            if run.first is None:
                rest += 1
                film = store.steady(run.case, run.step)
                if film.solid_share > 0.0:
                    words.append(
                        f"{name} at step {run.step}, at rest ({100.0 * film.solid_share:.2g} %)"
                    )
                continue
            marches += 1
            march = store.march(run.case, run.first, run.step, run.keep)
        except MissingFilmError:
            continue
        if touched(march):
            words.append(f"{name} in motion ({100.0 * march['solid_share'].max():.2g} %)")
    return (
        f"\nOf {rest} films at rest and {marches} marches with that layer solids "
        f"touch in (largest share of the load): {'; '.join(words) or 'none'}.\n"
    )
