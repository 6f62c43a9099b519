"""How many statements of a source hold, as a sentence."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable

_OF_SEVERAL = {"holds": "hold", "holds in part": "hold in part", "does not hold": "do not hold"}


def tally(verdicts: Iterable[str]) -> str:
    """Return verdicts with their numbers, the most frequent first.

    Examples
    --------
    >>> tally(["holds", "does not hold", "holds"])
    '2 statements hold, 1 does not hold'
    """
    parts = []
    for word, count in Counter(verdicts).most_common():
        said = word if count == 1 else _OF_SEVERAL.get(word, word)
        said = said if word in _OF_SEVERAL else f"{'is' if count == 1 else 'are'} {said}"
        noun = "" if parts else " statement" if count == 1 else " statements"
        parts.append(f"{count}{noun} {said}")
    return ", ".join(parts)
