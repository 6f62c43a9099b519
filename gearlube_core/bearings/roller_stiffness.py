"""Stiffness of a roller between its races, from its length."""

from __future__ import annotations

from gearlube_core.bearings.roller_contact import N_LINE
from gearlube_core.checks import check_within

_APPROACH = 3.84e-5  # mm N^-0.9 mm^0.8, steel on steel, [harris_kotzalas_2007 ch. 6]
_LENGTH_EXPONENT = 8.0 / 9.0
_MM = 1e-3  # m


def palmgren_roller_stiffness(roller_length: float) -> float:
    """Return kn of inner race - steel roller - outer race [N/m^(10/9)].

    d = 3.84e-5 Q^0.9 / l^0.8 for one contact, d in mm, Q in N, l in mm; two contacts in series.

    Parameters
    ----------
    roller_length : float
        Effective length l of the contact [m].

    Notes
    -----
    Fitted by Palmgren to rollers of steel. The bearing of [mohammadpour_2015 Table A2] has 2.5
    times less than this for its 22 mm.

    References
    ----------
    [palmgren_1959], as in [harris_kotzalas_2007 ch. 6] and, for the series, [harris_kotzalas_2007
    ch. 7].

    Examples
    --------
    >>> f"{palmgren_roller_stiffness(0.022):.3g}"
    '1.25e+09'
    """
    check_within("roller_length", roller_length, 1e-3, 2.0, "m", "22 mm is 0.022 m.")
    one = _APPROACH**-N_LINE * (roller_length / _MM) ** _LENGTH_EXPONENT  # N/mm^(10/9)
    return float(one / 2.0**N_LINE / _MM**N_LINE)
