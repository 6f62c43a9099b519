"""Dimensionless groups of an elastohydrodynamic point contact, in one convention."""

from __future__ import annotations

from typing import NamedTuple

from gearlube_core.checks import check_positive


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
    Hamrock and Dowson 1977; Moes 1992. The groups of Mohammadpour et al. 2015 eq. (22), with
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
