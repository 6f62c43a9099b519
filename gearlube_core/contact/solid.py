"""Elastic and thermal data of a solid, and the three moduli of a pair used in papers."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated, NamedTuple

from gearlube_core.number import Checked, Number

YOUNGS_MODULUS = Number("Pa", 1e6, 2e12, "210 GPa is 2.1e11 Pa.")


class SolidParameters(NamedTuple):
    """Data of a pair of equal solids for the kernels; all floats, SI."""

    contact_modulus: float  # E* [Pa]
    conductivity: float  # [W/(m K)]
    density: float  # [kg/m3]
    heat_capacity: float  # [J/(kg K)]


@dataclass(frozen=True, slots=True, kw_only=True)
class Solid(Checked):
    """An isotropic solid.

    Parameters
    ----------
    youngs_modulus
        [Pa].
    poisson_ratio
        [-].
    density
        [kg/m3].
    conductivity
        [W/(m K)].
    heat_capacity
        [J/(kg K)].
    """

    youngs_modulus: Annotated[float, YOUNGS_MODULUS]
    poisson_ratio: Annotated[float, Number("1", 0.0, 0.5)]
    density: Annotated[float, Number("kg/m3", 100.0, 3e4, "7.85 g/cm3 is 7850 kg/m3.")]
    conductivity: Annotated[float, Number("W/(m K)", 0.01, 3000.0)]
    heat_capacity: Annotated[float, Number("J/(kg K)", 50.0, 5000.0)]


# [mohammadpour_2015 Table A4]
STEEL_MOHAMMADPOUR_2015 = Solid(
    youngs_modulus=210e9,
    poisson_ratio=0.3,
    density=7850.0,
    conductivity=46.0,
    heat_capacity=470.0,
)


def contact_modulus(solid_1: Solid, solid_2: Solid) -> float:
    """Return E* of Hertz: 1/E* = (1 - nu1^2)/E1 + (1 - nu2^2)/E2 [Pa]."""
    compliance = sum((1.0 - s.poisson_ratio**2) / s.youngs_modulus for s in (solid_1, solid_2))
    return 1.0 / compliance


def reduced_modulus(solid_1: Solid, solid_2: Solid) -> float:
    """Return E' = 2 E*, the modulus of elastohydrodynamic load and speed groups [Pa]."""
    return 2.0 * contact_modulus(solid_1, solid_2)


def pi_contact_modulus(solid_1: Solid, solid_2: Solid) -> float:
    """Return Er = pi E*, the modulus of the groups in [mohammadpour_2015 (22)] [Pa]."""
    return math.pi * contact_modulus(solid_1, solid_2)


def solid_parameters(solid_1: Solid, solid_2: Solid) -> SolidParameters:
    """Return the tuple for the kernels: E* of the pair and the mean thermal data."""
    return SolidParameters(
        contact_modulus=contact_modulus(solid_1, solid_2),
        conductivity=0.5 * (solid_1.conductivity + solid_2.conductivity),
        density=0.5 * (solid_1.density + solid_2.density),
        heat_capacity=0.5 * (solid_1.heat_capacity + solid_2.heat_capacity),
    )
