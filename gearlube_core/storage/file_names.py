"""Names that a user gives, and the names of files made of them: readable, safe, each of its own."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterable
from typing import Annotated

from pydantic import AfterValidator, Field

_LONGEST = 100  # characters, which leaves room for endings
_NO_NAME = re.compile(r'[/\\:*?"<>|]')
_DEVICE = re.compile(r"(con|prn|aux|nul|conin\$|conout\$|(com|lpt)[0-9¹²³])(\..*)?", re.IGNORECASE)
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


def _checked(name: str) -> str:
    """Return a name; raise ValueError where a file of this name would be unsafe or impossible."""
    wrong = [c for c in name if unicodedata.category(c)[0] == "C"] or _NO_NAME.findall(name)
    if len(name) > _LONGEST:
        what = f"must have at most {_LONGEST} characters, got {len(name)}"
    elif wrong:
        what = f'must be without control characters and / \\ : * ? " < > |, got {wrong[0]!r}'
    elif name != name.strip(" .") or not name:
        what = f"must not begin or end with a space or a point, got {name!r}"
    elif _DEVICE.fullmatch(name):
        what = f"must not be the name of a device of Windows, got {name!r}"
    else:
        return name
    raise ValueError(f"{what}. Files are named after it: take letters, digits, spaces, _ and -")


Name = Annotated[str, Field(min_length=1), AfterValidator(_checked)]


def file_stem(text: str, spare: str = "result") -> str:
    """Return a name of a file without ending: letters of any language, digits, _ . + -.

    Examples
    --------
    >>> file_stem("müll 1/2"), file_stem("../..")
    ('müll_1_2', 'result')
    """
    plain = re.sub(r"[^\w.+-]+", "_", unicodedata.normalize("NFC", text[: 4 * _LONGEST]))
    plain = plain[:_LONGEST].strip("_.") or spare
    return f"_{plain}" if _DEVICE.fullmatch(plain) else plain


def as_name(text: str) -> str:
    """Return a text that serves as `Name`: as it is if it does, else as a name of a file.

    Examples
    --------
    >>> as_name("Stage 1"), as_name("Stage 1/2")
    ('Stage 1', 'Stage_1_2')
    """
    try:
        return _checked(text)
    except ValueError:
        return file_stem(text, "pair")


def told_apart(stems: Iterable[str]) -> list[str]:
    """Return names that differ on every file system, also where the case of letters is lost.

    The first of equal names stays: put the names of a study's own files first.

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
