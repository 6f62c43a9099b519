"""Classes of tooth contact loss."""

from __future__ import annotations

NONE, SINGLE_SIDED, DOUBLE_SIDED = 0, 1, 2


def separation_class(dte_min: float, dte_max: float, backlash: float) -> int:
    """Return the class of contact loss: 0 none, 1 single-sided, 2 double-sided impacts.

    With the drive flank in contact for x > 0 and the coast flank for x < -2b:
    single-sided when max >= 0 and -2b < min < 0, double-sided when min <= -2b and max >= 0.

    Parameters
    ----------
    dte_min, dte_max : float
        Extremes of the dynamic transmission error [m].
    backlash : float
        Total normal backlash 2b [m].

    Notes
    -----
    Mirrored for coasting: contact with the coast flank throughout (max <= -2b) is class 0.
    Teeth that float in the gap for the whole record (-2b < x < 0) count as single-sided.
    Source: [mohammadpour_2015 (3)], classes after [karagiannis_2012 sec. 3].
    """
    if dte_min >= 0.0 or dte_max <= -backlash:
        return NONE
    if dte_min <= -backlash and dte_max >= 0.0:
        return DOUBLE_SIDED
    return SINGLE_SIDED
