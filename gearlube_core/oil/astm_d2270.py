"""Viscosity index and the viscosities at 40 and 100 degC: ASTM D2270."""

from __future__ import annotations

import math

from scipy.optimize import brentq

from gearlube_core.checks import check_within
from gearlube_core.errors import ParameterError
from gearlube_core.oil.walther_1931 import MM2_S

INDEX_RANGE = (0.0, 400.0)
# [astm_d2270 Table X2.1]: from nu of 100 degC [mm2/s] on; a, b, c of L; d, e, f of H
_ROWS = (
    (2.0, 1.14673, 1.7576, -0.109, 0.84155, 1.5521, -0.077),
    (3.8, 3.38095, -15.4952, 33.196, 0.78571, 1.7929, -0.183),
    (4.4, 2.5, -7.2143, 13.812, 0.82143, 1.5679, 0.119),
    (5.0, 0.101, 16.635, -45.469, 0.04985, 9.1613, -18.557),
    (6.4, 3.35714, -23.5643, 78.466, 0.22619, 7.7369, -16.656),
    (7.0, 0.01191, 21.475, -72.87, 0.79762, -0.7321, 14.61),
    (7.7, 0.41858, 16.1558, -56.04, 0.05794, 10.5156, -28.24),
    (9.0, 0.88779, 7.5527, -16.6, 0.26665, 6.7015, -10.81),
    (12.0, 0.7672, 10.7972, -38.18, 0.20073, 8.4658, -22.49),
    (15.0, 0.97305, 5.3135, -2.2, 0.28889, 5.9741, -4.93),
    (18.0, 0.97256, 5.25, -0.98, 0.24504, 7.416, -16.73),
    (22.0, 0.91413, 7.4759, -21.82, 0.20323, 9.1267, -34.23),
    (28.0, 0.87031, 9.7157, -50.77, 0.18411, 10.1015, -46.75),
    (40.0, 0.84703, 12.6752, -133.31, 0.17029, 11.4866, -80.62),
    (55.0, 0.85921, 11.1009, -83.19, 0.1713, 11.368, -76.94),
    (70.0, 0.83531, 14.6731, -216.246, 0.16841, 11.8493, -96.947),
)
_SLOPE = 0.00715  # of the index above 100


def _references(nu_100: float) -> tuple[float, float]:
    """Return L and H [mm2/s], viscosities at 40 degC of oils of index 0 and 100."""
    Y = nu_100 / MM2_S
    check_within("viscosity at 100 degC", Y, _ROWS[0][0], 1000.0, "mm2/s", "ASTM D2270 ends there.")
    _, a, b, c, d, e, f = next(row for row in reversed(_ROWS) if row[0] <= Y)
    return (a * Y + b) * Y + c, (d * Y + e) * Y + f


def viscosity_index(nu_40: float, nu_100: float) -> float:
    """Return the viscosity index of an oil.

    VI = 100 (L - U)/(L - H) to 100;  above, VI = 100 + (10^N - 1)/0.00715, N = lg(H/U)/lg Y

    Parameters
    ----------
    nu_40, nu_100 : float
        Kinematic viscosities U and Y at 40 and 100 degC [m2/s].

    Returns
    -------
    float
        Not rounded [-].

    Notes
    -----
    L and H by the quadratic forms of the standard, for Y above 2 mm2/s. The coefficients were
    read in a published copy, not in the standard; they are continuous within 0.2 % and give the
    printed index of the reference oil FVA 3A in [manjunath_2023].
    Source: [astm_d2270].

    Examples
    --------
    >>> round(viscosity_index(90.02e-6, 10.41e-6))
    97
    """
    L, H = _references(nu_100)
    U = nu_40 / MM2_S
    if U >= H:
        return 100.0 * (L - U) / (L - H)
    N = math.log(H / U) / math.log(nu_100 / MM2_S)
    return 100.0 + (10.0**N - 1.0) / _SLOPE


def viscosity_at_40(nu_100: float, index: float) -> float:
    """Return the viscosity at 40 degC [m2/s] of an oil with this index [-] and nu_100 [m2/s]."""
    check_within("viscosity_index", index, *INDEX_RANGE)
    L, H = _references(nu_100)
    if index <= 100.0:
        return (L - 0.01 * index * (L - H)) * MM2_S
    N = math.log10(1.0 + _SLOPE * (index - 100.0))
    return float(H * (nu_100 / MM2_S) ** -N * MM2_S)


def viscosity_at_100(nu_40: float, index: float) -> float:
    """Return the viscosity at 100 degC [m2/s] of an oil with this index [-] and nu_40 [m2/s].

    Raises
    ------
    ParameterError
        There is none above 2 mm2/s.
    """
    # not quite the ends of the range: roundings of units would leave it
    low, high = 2.000001 * MM2_S, min(nu_40, 999.999 * MM2_S)

    def excess(nu_100: float) -> float:
        return viscosity_at_40(nu_100, index) - nu_40

    if not low < high or excess(low) > 0.0 or excess(high) < 0.0:
        raise ParameterError(
            f"viscosity_index {index:g} with {nu_40 / MM2_S:g} mm2/s at 40 degC gives no viscosity "
            "at 100 degC within 2 to 1000 mm2/s. Give the viscosity at 100 degC instead of the "
            "index."
        )
    return float(brentq(excess, low, high, xtol=1e-15, rtol=1e-12))
