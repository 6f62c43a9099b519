"""Rewrite docs/ehl.md and its pictures: python -m docs.ehl.make [workdir].

About half an hour of one processor the first time. Films and marches are kept in the folder given
as argument, by default build/ehl, and a rerun takes only what is missing; a march that was
interrupted goes on from its last record. Delete the folder after a change of the solvers.
"""

from __future__ import annotations

import logging
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

from docs.ehl import figures_cycle, figures_fields
from docs.ehl.cases import CYCLE, FACETED, LINE
from docs.ehl.claims_cycle import CYCLES
from docs.ehl.claims_facets import FACETED_FLANKS
from docs.ehl.claims_motion import MOTIONS
from docs.ehl.claims_relief import RELIEFS
from docs.ehl.pages import claims_table, cost, counts, dry_table, grid_table, size
from docs.ehl.runs import all_runs, do_runs
from docs.ehl.store import Store

ROOT = Path(__file__).resolve().parents[2]
TEXTS = Path(__file__).parent / "text"
PICTURES: dict[str, Callable[[Store], Any]] = {
    "cycle_designs": figures_cycle.designs,
    "crowning": figures_cycle.crowns,
    "linear_relief": figures_cycle.linear_relief,
    "parabolas": figures_cycle.parabolas,
    "speeds": figures_cycle.speeds,
    "powers": figures_cycle.powers,
    "facets": figures_cycle.facets,
    "transient_steady": figures_fields.transient_steady,
    "sections": figures_fields.sections,
    "power_contours": figures_fields.power_contours,
    "power_lines": figures_fields.power_lines,
}
logger = logging.getLogger("docs.ehl")


def main() -> None:
    """Run, write the page and the pictures."""
    logging.basicConfig(level=logging.WARNING, format="%(asctime)s %(message)s")
    logger.setLevel(logging.INFO)
    store = Store(Path(sys.argv[1]) if len(sys.argv) > 1 else ROOT / "build" / "ehl")
    runs = all_runs()
    do_runs(store, runs)
    logger.info("claims")
    smooth = (*CYCLES, *RELIEFS, *MOTIONS)
    grids = (
        f"Nodes across and along the line, {size()} in contact at most: "
        f"{_nodes(CYCLE)} for cycles, {_nodes(LINE)} for films at rest and short marches, "
        f"{_nodes(FACETED)} for facets and for comparison. The thesis has 182 by 857."
    )
    page = _text("method").format(grids=grids)
    page += _text("claims") + claims_table(smooth, [c.evaluate(store) for c in smooth])
    page += _text("figures") + _text("facets")
    page += claims_table(FACETED_FLANKS, [c.evaluate(store) for c in FACETED_FLANKS])
    page += _text("facet_figure") + _text("dry") + dry_table(store)
    page += _text("grids") + grid_table(store)
    page += _text("failures") + counts(store, runs) + cost(store, runs)
    page += _text("open")
    (ROOT / "docs" / "ehl.md").write_text(page, encoding="utf-8")
    logger.info("pictures")
    images = ROOT / "docs" / "images"
    for name, draw in PICTURES.items():
        draw(store).savefig(images / f"ehl_{name}.png", dpi=100)


def _nodes(nodes: tuple[int, int]) -> str:
    return f"{nodes[0]} by {nodes[1]}"


def _text(name: str) -> str:
    return (TEXTS / f"{name}.md").read_text(encoding="utf-8")


if __name__ == "__main__":
    main()
