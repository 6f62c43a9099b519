"""What left the range of its formula or table while a point ran."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

_OUTPUTS = "range."  # an FMU's warning of a range begins with its output


def range_variables(warnings: Sequence[str]) -> dict[str, Any]:
    """Return the flag column of a point and its words.

    Parameters
    ----------
    warnings : sequence of str
        Of the FMU; those of ranges begin with the name of an output `range.*`.

    Examples
    --------
    >>> range_variables(["range.torque: got 450 N.m.", "built from other sources"])
    {'range_exceeded': 1, 'range_message': 'range.torque: got 450 N.m.'}
    """
    found = [text for text in warnings if text.startswith(_OUTPUTS)]
    return {"range_exceeded": len(found), "range_message": " ".join(found)}
