"""Put numbers into docs/ehl.md and draw its pictures: python -m docs.ehl.make [DIR] [--present].

A quarter of an hour of one processor the first time. Films and marches are kept in the folder given
as argument, by default build/ehl, and a rerun takes only what is missing; a march that was
interrupted goes on from its last record. Delete the folder after a change of the solvers.
With --present nothing is computed; what needs a missing film stays as the page has it.
"""

from __future__ import annotations

import logging
import sys
from collections.abc import Callable
from typing import Any

from docs.ehl import figures_cycle, figures_fields
from docs.ehl.claims import verdicts
from docs.ehl.claims_cycle import CYCLES
from docs.ehl.claims_facets import FACETED_FLANKS
from docs.ehl.claims_motion import MOTIONS
from docs.ehl.claims_relief import RELIEFS
from docs.ehl.film_map_page import put_film_map
from docs.ehl.lines import LostFilmError
from docs.ehl.micro_cavity_page import put_micro_cavity
from docs.ehl.minimum_film import put_minimum_film
from docs.ehl.pages import put_counts, put_touching
from docs.ehl.runs import all_runs, do_runs
from docs.ehl.store import Store
from docs.kept_films import MissingFilmError
from docs.page import IMAGES, Claims, Page, begin

SMOOTH = Claims(CYCLES | RELIEFS | MOTIONS)
# words of the page before the counts of statements
SMOOTH_CLAIMS = "*at rest* the steady one."
FACET_CLAIMS = "with twice the nodes across."
PICTURES: dict[str, Callable[[Store], Any]] = {
    "cycle_designs": figures_cycle.designs,
    "transient_steady": figures_fields.transient_steady,
    "facets": figures_cycle.facets,
}
logger = logging.getLogger("docs.ehl")


def draw(store: Store) -> None:
    """Draw the pictures; those whose films are missing stay."""
    for name, picture in PICTURES.items():
        try:
            picture(store).savefig(IMAGES / f"ehl_{name}.png", dpi=100)
        except (MissingFilmError, LostFilmError) as error:
            logger.warning("picture %s stays as it is: %s", name, error)


def main() -> None:
    """Run, write the page and the pictures."""
    store = Store(begin("ehl"), compute="--present" not in sys.argv)
    if store.compute:
        do_runs(store, all_runs())
    logger.info("page and pictures")
    page = Page("ehl")
    for claims, after in ((SMOOTH, SMOOTH_CLAIMS), (FACETED_FLANKS, FACET_CLAIMS)):
        page.verdicts(dict.fromkeys(claims) | verdicts(claims, store), after)
    put_minimum_film(page, store)
    put_touching(page, store)
    put_counts(page, store)
    put_film_map(page, store)
    put_micro_cavity(page, store)
    page.write()
    draw(store)


if __name__ == "__main__":
    main()
