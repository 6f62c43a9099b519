"""Parts of a shaft: cylindrical sections, discs on it, its material."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated

from gearlube_core.errors import ParameterError
from gearlube_core.helical_geometry.gear_body import INERTIA, MASS, POSITION
from gearlube_core.number import Number, check_fields

_DIAMETER = Number("m", 0.0, 10.0, "Give metres, not millimetres.", shown="mm")
_MODULUS = Number("Pa", 1e7, 2e12, "Steel has 2.1e11 and 8e10.", shown="GPa")


@dataclass(frozen=True, slots=True, kw_only=True)
class ShaftMaterial:
    """An elastic material; steel by default.

    Parameters
    ----------
    E, G : float
        Moduli of elasticity and of shear [Pa].
    density : float
        [kg/m3]

    Examples
    --------
    >>> round(ShaftMaterial().poisson, 3)
    0.301
    """

    E: Annotated[float, Number("Pa", 1e8, 2e12, text="Modulus of elasticity", shown="GPa")] = (
        2.06e11
    )
    G: Annotated[float, Number("Pa", 1e7, 1e12, text="Shear modulus", shown="GPa")] = 7.92e10
    density: Annotated[float, Number("kg/m3", 100.0, 3e4, text="Density")] = 7850.0

    def __post_init__(self) -> None:
        check_fields(self)
        if not 0.0 < self.poisson < 0.5:
            raise ParameterError(
                f"E / 2 G - 1, which is Poisson's ratio, must be between 0 and 0.5, got "
                f"{self.poisson:.3g}. Check E and G."
            )

    @property
    def poisson(self) -> float:
        """Poisson's ratio [-]."""
        return 0.5 * self.E / self.G - 1.0


@dataclass(frozen=True, slots=True, kw_only=True)
class ShaftSection:
    """A hollow or solid cylinder from `start` to `end` along z [m].

    Parameters
    ----------
    start, end : float
        Places along z [m].
    outer_diameter, inner_diameter : float
        [m]; inner 0: solid.

    Examples
    --------
    >>> tube = ShaftSection(start=0.0, end=0.1, outer_diameter=0.04, inner_diameter=0.01)
    >>> round(1e6 * tube.area, 1)  # mm2
    1178.1
    """

    start: Annotated[float, POSITION._replace(text="Where it begins along z", shown="mm")]
    end: Annotated[float, POSITION._replace(text="Where it ends along z", shown="mm")]
    outer_diameter: Annotated[float, _DIAMETER._replace(text="Outer diameter")]
    inner_diameter: Annotated[float, _DIAMETER._replace(text="Inner diameter; 0: solid")] = 0.0

    def __post_init__(self) -> None:
        check_fields(self)
        if not self.end > self.start:
            raise ParameterError(
                f"end of a section must be above its start, {1e3 * self.start:g} mm, got "
                f"{1e3 * self.end:g} mm."
            )
        if not self.outer_diameter > self.inner_diameter:
            raise ParameterError(
                "outer_diameter must be above inner_diameter, "
                f"{1e3 * self.inner_diameter:g} mm, got {1e3 * self.outer_diameter:g} mm."
            )

    @property
    def area(self) -> float:
        """Cross section [m2]."""
        return 0.25 * math.pi * (self.outer_diameter**2 - self.inner_diameter**2)

    @property
    def second_moment(self) -> float:
        """Second moment of area about a diameter [m4]."""
        return math.pi / 64.0 * (self.outer_diameter**4 - self.inner_diameter**4)


@dataclass(frozen=True, slots=True, kw_only=True)
class ShaftDisc:
    """A rigid mass on a shaft, such as a rotor or a gear blank.

    Parameters
    ----------
    position : float
        Of its centre along z [m].
    mass : float
        [kg]
    inertia, polar_inertia : float
        About a diameter and about the axis [kg m2].

    Examples
    --------
    >>> ShaftDisc(position=0.1, mass=16.0, inertia=0.055, polar_inertia=0.04).mass
    16.0
    """

    position: Annotated[float, POSITION._replace(text="Centre along z", shown="mm")]
    mass: Annotated[float, MASS]
    inertia: Annotated[float, INERTIA._replace(text="Moment of inertia about a diameter")]
    polar_inertia: Annotated[float, INERTIA._replace(text="Moment of inertia about the axis")]

    def __post_init__(self) -> None:
        check_fields(self)
        if self.polar_inertia > 2.0 * self.inertia * (1.0 + 1e-9):
            raise ParameterError(
                f"polar_inertia of a disc must be at most twice its inertia about a diameter, "
                f"{2.0 * self.inertia:g} kg m2, got {self.polar_inertia:g} kg m2. A thin disc has "
                "twice, all others less."
            )

    @classmethod
    def ring(
        cls,
        position: float,
        outer_diameter: float,
        inner_diameter: float,
        width: float,
        density: float = 7850.0,
    ) -> ShaftDisc:
        """Return a rigid ring, such as a gear blank; lengths in [m], density in [kg/m3].

        Examples
        --------
        >>> round(ShaftDisc.ring(0.0, 0.05776, 0.04, 0.03).mass, 4)
        0.3211
        """
        outer, inner = 0.5 * outer_diameter, 0.5 * inner_diameter
        mass = density * math.pi * width * (outer**2 - inner**2)
        polar = 0.5 * mass * (outer**2 + inner**2)
        return cls(
            position=position,
            mass=mass,
            inertia=0.5 * polar + mass * width**2 / 12.0,
            polar_inertia=polar,
        )
