"""Rewrite docs/ehl.md and its pictures: python -m docs.ehl.make [workdir] [--present].

A quarter of an hour of one processor the first time. Films and marches are kept in the folder given
as argument, by default build/ehl, and a rerun takes only what is missing; a march that was
interrupted goes on from its last record. Delete the folder after a change of the solvers.
With --present nothing is computed, and what is missing is left out or said to be.
"""

from __future__ import annotations

import logging
import sys
from collections.abc import Callable
from pathlib import Path

from docs.ehl.cases import CYCLE, FACETED, LINE
from docs.ehl.claims import verdicts
from docs.ehl.claims_cycle import CYCLES
from docs.ehl.claims_facets import FACETED_FLANKS
from docs.ehl.claims_motion import MOTIONS
from docs.ehl.claims_relief import RELIEFS
from docs.ehl.film_map_page import film_map_section
from docs.ehl.micro_cavity_page import micro_cavity_section
from docs.ehl.minimum_film import minimum_film_section
from docs.ehl.pages import claims_table, counts, dry_table, grid_table, size
from docs.ehl.pictures import CYCLE_PICTURES, FACET_PICTURES, SMOOTH_PICTURES, shown
from docs.ehl.runs import all_runs, do_runs
from docs.ehl.store import Store
from docs.ehl.touching import touching_section

ROOT = Path(__file__).resolve().parents[2]
TEXTS = Path(__file__).parent / "text"
IMAGES = ROOT / "docs" / "images"
Section = Callable[[Store], str]
logger = logging.getLogger("docs.ehl")


def _intro(_: Store) -> str:
    return _text("intro")


def _smooth(store: Store) -> str:
    claims = (*CYCLES, *RELIEFS, *MOTIONS)
    return _text("claims") + claims_table(claims, verdicts(claims, store))


def _facets(store: Store) -> str:
    return _text("facets") + claims_table(FACETED_FLANKS, verdicts(FACETED_FLANKS, store))


def _figures(store: Store) -> str:
    pictures = (*CYCLE_PICTURES, *SMOOTH_PICTURES, *FACET_PICTURES)
    return _text("figures") + shown(store, pictures, IMAGES)


def _method(store: Store) -> str:
    grids = (
        f"Nodes across and along the line, {size()} in contact at\n  most: "
        f"{_nodes(CYCLE)} for cycles, {_nodes(LINE)} for films at rest and short marches,\n  "
        f"{_nodes(FACETED)} for facets and for comparison. The thesis has 182 by 857."
    )
    return _text("method").format(grids=grids)


def _dry(store: Store) -> str:
    return _text("dry") + dry_table(store)


def _grids(store: Store) -> str:
    return _text("grids") + grid_table(store)


def _touching(store: Store) -> str:
    return touching_section(store, all_runs())


def _failures(store: Store) -> str:
    return _text("failures") + counts(store, all_runs())


def _open(_: Store) -> str:
    return _text("open")


# in the order of the page; further studies of films add theirs
SECTIONS: tuple[Section, ...] = (
    _intro,
    _smooth,
    _facets,
    _figures,
    _method,
    _dry,
    _grids,
    minimum_film_section,
    _touching,
    _failures,
    film_map_section,
    micro_cavity_section,
    _open,
)


def main() -> None:
    """Run, write the page and the pictures."""
    logging.basicConfig(level=logging.WARNING, format="%(asctime)s %(message)s")
    logger.setLevel(logging.INFO)
    given = [word for word in sys.argv[1:] if word != "--present"]
    folder = Path(given[0]) if given else ROOT / "build" / "ehl"
    store = Store(folder, compute="--present" not in sys.argv)
    if store.compute:
        do_runs(store, all_runs())
    logger.info("page and pictures")
    page = "".join(section(store) for section in SECTIONS)
    (ROOT / "docs" / "ehl.md").write_text(page, encoding="utf-8")


def _nodes(nodes: tuple[int, int]) -> str:
    return f"{nodes[0]} by {nodes[1]}"


def _text(name: str) -> str:
    return (TEXTS / f"{name}.md").read_text(encoding="utf-8")


if __name__ == "__main__":
    main()
