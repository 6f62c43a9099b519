"""How statements of Jamali 2015 on films are judged."""

from __future__ import annotations

import logging
from collections.abc import Iterable

from docs.ehl.lines import GivenUpError
from docs.ehl.store import MissingFilmError, Store
from docs.page import FAILS, Claims, Verdict

GPA, UM, MM = 1e-9, 1e6, 1e3
logger = logging.getLogger("docs.ehl")


def verdicts(claims: Claims, store: Store) -> dict[str, Verdict]:
    """Return the verdicts on all claims but those whose films are missing, which the log names.

    A claim on a march that was given up fails.
    """
    found = {}
    for name, claim in claims.items():
        try:
            found[name] = claim(store)
        except MissingFilmError as error:
            logger.warning("%s stays as it is: %s is not computed yet", name, error)
        except GivenUpError as error:
            found[name] = Verdict("-", FAILS, f"A march was {error}.")
    return found


def span(low: float, high: float, form: str = "{:.2f}") -> str:
    """Return "low to high"."""
    return f"{form.format(low)} to {form.format(high)}"


def listed(values: Iterable[float], form: str = "{:.2f}") -> str:
    """Return values with strokes between."""
    return " / ".join(form.format(v) for v in values)
