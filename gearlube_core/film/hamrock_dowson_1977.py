"""Films of elliptical contacts entrained along their minor axis, Hamrock and Dowson 1977."""

from __future__ import annotations

import math


def brewe_hamrock_ellipticity(R_x: float, R_y: float) -> float:
    """Return k = 1.0339 (R_y/R_x)^0.636, about the ratio of the semi-axes [-].

    Parameters
    ----------
    R_x, R_y
        Relative radii [m], R_y not below R_x.

    Notes
    -----
    Source: [brewe_hamrock_1977]; [hamrock_brewe_1983].
    """
    return 1.0339 * (R_y / R_x) ** 0.636


def hamrock_dowson_films(U: float, G: float, W: float, k: float) -> tuple[float, float]:
    """Return central and minimum film of a point contact, divided by R_x, after Hamrock and Dowson.

    H_c = 2.69 U^0.67 G^0.53 W^-0.067 (1 - 0.61 e^(-0.73 k)),
    H_m = 3.63 U^0.68 G^0.49 W^-0.073 (1 - e^(-0.68 k))

    Parameters
    ----------
    U, G, W
        Speed, material and load parameters with E' and R_x, as in `PointContactGroups` [-].
    k
        Ellipticity, 1 and above [-].

    Notes
    -----
    Fully flooded, isothermal, steady, Newtonian, elastic solids and an oil that thickens with
    pressure; fitted over k from 1 to 8. Source: [hamrock_dowson_1977]; the
    smallest film is also [jamali_2015 (4.6)].

    Examples
    --------
    >>> central, minimum = hamrock_dowson_films(1e-11, 5000.0, 1e-6, 1.0)
    >>> round(1e6 * 0.01 * central, 3), round(1e6 * 0.01 * minimum, 3)  # um on a ball of 10 mm
    (0.187, 0.106)
    """
    central = 2.69 * U**0.67 * G**0.53 * W**-0.067 * (1.0 - 0.61 * math.exp(-0.73 * k))
    minimum = 3.63 * U**0.68 * G**0.49 * W**-0.073 * (1.0 - math.exp(-0.68 * k))
    return central, minimum
