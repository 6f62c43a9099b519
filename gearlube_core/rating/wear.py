"""Initial rate of mild wear of flanks by Archard's law."""

from __future__ import annotations

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.checks import check_within
from gearlube_core.errors import ParameterError

# Archard's K over the hardness [1/Pa]; examples, not checked against the source
MILD = 5e-18  # FZG gears in oil
_Number = Array | float


def wear_per_cycle(
    coefficient: float,
    line_load: _Number,
    speeds: tuple[_Number, _Number],
    *,
    sliding: _Number | None = None,
    asperity_share: _Number = 1.0,
) -> tuple[Array, Array]:
    """Return the depth that pinion and gear lose at a place each time it passes the contact [m].

    dh_i = k w s |u_s|/u_i: the pressure over the contact, times the sliding distance there

    Parameters
    ----------
    coefficient
        k [1/Pa], of the user's tests; scatter of 40 to 60 % is usual in one test. `MILD` is an
        example.
    line_load
        w at the place [N/m].
    speeds
        u1, u2 across the line of contact, relative to it, above 0 [m/s].
    sliding
        |u_s|, of hypoid gears with the part along the line [m/s]; None: |u1 - u2|.
    asperity_share
        s: the share of the load that asperities carry; that only they wear is a hypothesis [-].

    Raises
    ------
    ParameterError

    Notes
    -----
    The initial rate: after 1 to 2 um the contact must be solved again on the worn flank.
    Source: [archard_1953].

    Examples
    --------
    >>> pinion, gear = wear_per_cycle(MILD, 236.3e3, (1.0538, 4.7835))  # FZG C at the point A
    >>> f"{float(pinion):.3g} {float(gear):.3g}"
    '4.18e-12 9.21e-13'
    """
    check_within("coefficient", coefficient, 0.0, 1e-11, "1/Pa", "5e-18 is mild, 1e-14 dry wear.")
    w, u1, u2, share = (
        np.asarray(one, dtype=float) for one in (line_load, *speeds, asperity_share)
    )
    if not ((u1 > 0.0).all() and (u2 > 0.0).all() and (w >= 0.0).all()):
        raise ParameterError(
            "speeds must be above 0 and line_load not negative. Take speeds relative to the line "
            "of contact, where both surfaces pass it in one direction."
        )
    if not ((share >= 0.0) & (share <= 1.0)).all():
        raise ParameterError("asperity_share must be within 0 to 1.")
    path = np.abs(u1 - u2) if sliding is None else np.abs(np.asarray(sliding, dtype=float))
    lost = coefficient * w * share * path
    return lost / u1, lost / u2
