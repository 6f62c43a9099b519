"""Smallest film of a line contact, Dowson 1968."""

from __future__ import annotations

from gearlube_core.film.line_film_law import LineFilmLaw, power_law_line_film
from gearlube_core.kernels.jit import kernel

_LAW = LineFilmLaw(coefficient=2.65, speed=0.70, material=0.54, load=-0.13)


@kernel
def minimum_line_film_thickness(
    R: float,
    eta0: float,
    alpha: float,
    entrainment_speed: float,
    line_load: float,
    reduced_modulus: float,
) -> float:
    """Return the smallest film thickness of a line contact, at the outlet constriction.

    h_m = R 2.65 U^0.70 G^0.54 W'^-0.13
    U = eta0 u/(E' R),  G = alpha E',  W' = w/(E' R),  u = (u_1 + u_2)/2

    Parameters
    ----------
    R, eta0, alpha, entrainment_speed, line_load, reduced_modulus
        As in `dowson_toyoda_1979.line_film_thickness`.

    Returns
    -------
    float
        h_m [m].

    Notes
    -----
    Fully flooded, isothermal, steady, Newtonian, piezoviscous-elastic regime; U about 1e-13 to
    1e-10, G about 2500 to 5000, W' about 3e-5 to 3e-4. Quoted from later literature.
    Source: [dowson_1968], revising [dowson_higginson_1966].
    """
    return power_law_line_film(_LAW, R, eta0, alpha, entrainment_speed, line_load, reduced_modulus)
