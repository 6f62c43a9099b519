"""Film over roughness against contact and load: python -m docs.rough_line_contact.film_ratio.

Prints the table of docs/rough_line_contact.md from numbers.csv, which `make` writes; seconds.
"""

from __future__ import annotations

import csv
import math
import sys

from docs.rough_line_contact.make import NUMBERS, TITLES
from gearlube_core.contact.greenwood_tripp_1971 import asperity_load, gear_flanks
from gearlube_core.ehl.case.rough_case import RoughCase

QUANTITIES = {
    "smooth": "smooth film over roughness",
    "mean": "mean film over roughness",
    "below": "share of the zone below 10 nm, rough",
    "solids": "share of the load on solids, rough",
}
HEADINGS = (
    "case", "smooth film/Rq", "mean film/Rq", "zone below 10 nm", "load on solids",
    "heights that overlap, rigid", "load, Greenwood and Tripp",
)  # fmt: skip


def rows() -> list[tuple[str, ...]]:
    """Return the rows of the table; shares in %."""
    with NUMBERS.open(newline="") as file:
        found = {
            (row["case"], row["quantity"]): float(row["value"]) for row in csv.DictReader(file)
        }
    section = RoughCase.named("jamali_2015_a").section()
    mean_pressure = 0.25 * math.pi * section.hertz_contact[2]
    table = []
    for case, title in TITLES.items():
        one = {name: found[case, words] for name, words in QUANTITIES.items()}
        # share of a Gaussian surface that stands higher than the mean film
        overlap = 0.5 * math.erfc(one["mean"] / math.sqrt(2.0))
        law = asperity_load(one["mean"], 1.0, section.contact_modulus, gear_flanks(1.0))
        shares = (one["below"], one["solids"], overlap, law / mean_pressure)
        table.append(
            (
                title,
                f"{one['smooth']:.2f}",
                f"{one['mean']:.2f}",
                *(f"{100.0 * share:.2g} %" for share in shares),
            )
        )
    return table


if __name__ == "__main__":
    for line in (HEADINGS, ("---",) * len(HEADINGS), *rows()):
        sys.stdout.write("| " + " | ".join(line) + " |\n")
