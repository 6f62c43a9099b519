"""Names of files made from names that a user gives: readable, safe and each of its own."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterable

_LONGEST = 100  # characters, which leaves room for endings
# files that studies write beside one with the name of the pair
_TAKEN = [
    "axle",
    "problem",
    "contact",
    "design",
    "flanks",
    "optimise",
    "sensitivity",
    "tooth_errors",
]


def file_stem(text: str, spare: str = "result") -> str:
    """Return a name of a file without ending: letters of any language, digits, _ . + -.

    Examples
    --------
    >>> file_stem("müll 1/2"), file_stem("../..")
    ('müll_1_2', 'result')
    """
    plain = re.sub(r"[^\w.+-]+", "_", unicodedata.normalize("NFC", text))
    return plain[:_LONGEST].strip("_.") or spare


def told_apart(stems: Iterable[str]) -> list[str]:
    """Return names that differ on every file system, also where the case of letters is lost.

    Examples
    --------
    >>> told_apart(["run", "Run", "run_2", "other"])
    ['run', 'Run_2', 'run_2_2', 'other']
    """
    found: list[str] = []
    taken: set[str] = set()
    for stem in stems:
        name, count = stem, 1
        while name.casefold() in taken:
            count += 1
            name = f"{stem}_{count}"
        taken.add(name.casefold())
        found.append(name)
    return found


def pair_stem(name: str) -> str:
    """Return the name, without ending, of files that studies write for a gear pair.

    Examples
    --------
    >>> pair_stem("van 10/41"), pair_stem("contact")
    ('van_10_41', 'contact_2')
    """
    return told_apart([*_TAKEN, file_stem(name)])[-1]
