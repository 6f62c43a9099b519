"""Dimensionless groups of elastohydrodynamic point and line contacts, in one convention."""

from __future__ import annotations

import math
from typing import NamedTuple

from gearlube_core.checks import check_positive
from gearlube_core.kernels.jit import kernel


class PointContactGroups(NamedTuple):
    """Groups of Hamrock and Dowson and of Moes; all dimensionless [-]."""

    U: float  # speed, eta0 u/(E' R)
    G: float  # material, alpha E'
    W: float  # load, F/(E' R^2)
    M: float  # Moes load, W (2 U)^(-3/4)
    L: float  # Moes material, G (2 U)^(1/4)


def point_contact_groups(
    *,
    viscosity: float,
    pressure_viscosity: float,
    entrainment_speed: float,
    load: float,
    radius: float,
    reduced_modulus: float,
) -> PointContactGroups:
    """Return the groups of a point contact.

    U = eta0 u/(E' R), G = alpha E', W = F/(E' R^2), M = W (2U)^(-3/4), L = G (2U)^(1/4)

    Parameters
    ----------
    viscosity : float
        eta0 at ambient pressure [Pa s].
    pressure_viscosity : float
        alpha [1/Pa].
    entrainment_speed : float
        Mean surface speed u [m/s].
    load : float
        F [N].
    radius : float
        Relative radius R along entrainment [m].
    reduced_modulus : float
        E' = 2 E* [Pa].

    Raises
    ------
    ParameterError
        When an argument is not above zero.

    References
    ----------
    [hamrock_dowson_1977]; [moes_1992]. The groups of [mohammadpour_2015 (22)], with
    Er = pi E'/2 and the sum of the surface speeds, are the same numbers.

    Examples
    --------
    >>> g = point_contact_groups(viscosity=0.04, pressure_viscosity=2e-8, entrainment_speed=1.0,
    ...                          load=23.0, radius=0.01, reduced_modulus=2.3e11)
    >>> round(g.M, 1), round(g.L, 1)
    (69.8, 11.2)
    """
    for name, value, unit in (
        ("viscosity", viscosity, "Pa s"),
        ("pressure_viscosity", pressure_viscosity, "1/Pa"),
        ("entrainment_speed", entrainment_speed, "m/s"),
        ("load", load, "N"),
        ("radius", radius, "m"),
        ("reduced_modulus", reduced_modulus, "Pa"),
    ):
        check_positive(name, value, unit)
    U = viscosity * entrainment_speed / (reduced_modulus * radius)
    G = pressure_viscosity * reduced_modulus
    W = load / (reduced_modulus * radius**2)
    return PointContactGroups(U, G, W, W * (2.0 * U) ** -0.75, G * (2.0 * U) ** 0.25)


class LineGroups(NamedTuple):
    """Groups of a line contact; all dimensionless [-]."""

    U: float  # speed, eta0 u/(E' R), u the mean speed
    G: float  # material, alpha E'
    W: float  # load, w/(E' R)
    M: float  # Moes load, W (2 U)^(-1/2)
    L: float  # Moes material, G (2 U)^(1/4)


def line_groups(
    *,
    viscosity: float,
    pressure_viscosity: float,
    entrainment_speed: float,
    line_load: float,
    radius: float,
    reduced_modulus: float,
) -> LineGroups:
    """Return the groups of a line contact.

    U = eta0 u/(E' R), G = alpha E', W = w/(E' R), M = W (2U)^(-1/2), L = G (2U)^(1/4)

    Parameters
    ----------
    viscosity, pressure_viscosity : float
        eta0 [Pa s] and alpha [1/Pa].
    entrainment_speed : float
        Mean surface speed u, above zero [m/s].
    line_load : float
        w [N/m].
    radius : float
        R [m].
    reduced_modulus : float
        E' = 2 E* [Pa].

    References
    ----------
    [moes_1992]; [venner_lubrecht_2000].

    Examples
    --------
    >>> g = line_groups(viscosity=0.04, pressure_viscosity=2e-8, entrainment_speed=1.0,
    ...                 line_load=1e5, radius=0.01, reduced_modulus=2.3e11)
    >>> round(g.M, 2), round(g.L, 2)
    (7.37, 11.17)
    """
    stiffness = reduced_modulus * radius
    U = viscosity * entrainment_speed / stiffness
    G, W = pressure_viscosity * reduced_modulus, line_load / stiffness
    return LineGroups(U, G, W, W * (2.0 * U) ** -0.5, G * (2.0 * U) ** 0.25)


@kernel
def point_moes_groups(
    R: float, eta0: float, alpha: float, speed: float, load: float, reduced_modulus: float
) -> tuple[float, float]:
    """Return M and L of a point contact; equations as in `point_contact_groups`, not checked."""
    stiffness = reduced_modulus * R
    root = math.sqrt(math.sqrt(2.0 * eta0 * speed / stiffness))
    return load / (stiffness * R * root * root * root), alpha * reduced_modulus * root


@kernel
def line_moes_groups(
    R: float, eta0: float, alpha: float, speed: float, line_load: float, reduced_modulus: float
) -> tuple[float, float]:
    """Return M and L of a line contact; equations as in `line_groups`, not checked."""
    stiffness = reduced_modulus * R
    root = math.sqrt(math.sqrt(2.0 * eta0 * speed / stiffness))
    return line_load / (stiffness * root * root), alpha * reduced_modulus * root


@kernel
def inlet_heating_number(eta0: float, beta: float, speed: float, conductivity: float) -> float:
    """Return Lt = eta0 beta u^2/K [-].

    Parameters
    ----------
    eta0, beta, conductivity
        Of the oil at the inlet: viscosity [Pa s], -d ln eta0/dT [1/K], K [W/(m K)].
    speed
        u, mean surface speed [m/s].
    """
    return eta0 * beta * speed * speed / conductivity
