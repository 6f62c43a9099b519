"""Dry width, dry pressure and expected film of a line contact: scales of a part of one."""

from __future__ import annotations

import math

from gearlube_core.film.groups import line_groups
from gearlube_core.film.moes_1992 import central_film_group
from gearlube_core.oil.film_oil import FilmOil, pressure_viscosity


def hertz_line(radius: float, contact_modulus: float, line_load: float) -> tuple[float, float]:
    """Return the half width a = [4 w R/(pi E*)]^(1/2) [m] and the pressure 2 w/(pi a) [Pa].

    Parameters
    ----------
    radius
        Relative radius of curvature R [m].
    contact_modulus
        E* [Pa].
    line_load
        w [N/m].

    Examples
    --------
    >>> a, pressure = hertz_line(0.014, 1.1375e11, 3.6e5)
    >>> round(1e6 * a, 1), round(1e-9 * pressure, 3)  # um, GPa
    (237.5, 0.965)
    """
    a = math.sqrt(4.0 * line_load * radius / (math.pi * contact_modulus))
    return a, 2.0 * line_load / (math.pi * a)


def line_film(
    radius: float, contact_modulus: float, line_load: float, lubricant: FilmOil, speed: float
) -> float:
    """Return the central film [m] of a line contact by [moes_1992], entrained at `speed` [m/s]."""
    groups = line_groups(
        viscosity=lubricant.eta0,
        pressure_viscosity=pressure_viscosity(lubricant),
        entrainment_speed=speed,
        line_load=line_load,
        radius=radius,
        reduced_modulus=2.0 * contact_modulus,
    )
    return radius * math.sqrt(2.0 * groups.U) * central_film_group(groups.M, groups.L)
