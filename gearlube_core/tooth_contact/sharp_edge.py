"""When a computed pressure is that of a sharp edge, and the words for it."""

from __future__ import annotations

EDGE_PRESSURE = 2.5e9  # Pa; hardened steel flanks are rated to about 1.5e9, films end near 4e9
EDGE_WORDS = (
    "Above 2.5 GPa: the sharp edge of a tip or end presses into the flank. Such a pressure has no "
    "finite value, it rises with finer cells. Read it as a place, not as a load; tip and end "
    "relief remove it."
)


def sharp_edge_remark(pressure: float) -> str:
    """Return a sentence on the highest pressure [Pa] of a loaded contact, empty below the limit.

    Half-space cells under a sharp edge return a pressure that grows as their size falls: elastic
    theory has no finite value there. Stiffness, load shares and transmission error do not depend
    on it.
    """
    if not pressure > EDGE_PRESSURE:
        return ""
    return (
        f"The highest pressure, {1e-9 * pressure:.1f} GPa, is that of a sharp tip or end edge that "
        "presses into the flank. It has no finite value and rises with finer cells. Stiffness and "
        "load shares do not depend on it. Tip and end relief in the gear file remove it."
    )
