"""A part of a line contact between sides that are closed, as a point contact."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.checks import check_positive
from gearlube_core.ehl.point.problem import EllipticParaboloid, Gap, PointContactProblem
from gearlube_core.errors import ParameterError
from gearlube_core.oil.film_oil import FilmOil

DOMAIN = (-2.5, 1.5)  # half widths of the dry contact, as [jamali_2015] section 7.5 has them
_REPEATS = 1e-3  # of the range of heights, that may lie between both sides
_FLAT = 1e6  # m, radius along y that the scales of a closed film do not see


@dataclass(frozen=True, slots=True)
class Cylinder:
    """Gap x^2/(2 R_x) of two cylinders with parallel axes along y.

    Parameters
    ----------
    R_x
        Relative radius of curvature [m].
    """

    R_x: float

    def __post_init__(self) -> None:
        check_positive("R_x", self.R_x, "m")

    goes_on: ClassVar[bool] = True  # beyond any domain

    def __call__(self, x: Array, y: Array) -> Array:
        """Return the gap [m] at points (x, y) [m]."""
        return np.asarray(x * x / (2.0 * self.R_x) + 0.0 * y)

    @property
    def paraboloid(self) -> EllipticParaboloid:
        """Return the paraboloid that sets the scales: of the same radius, straight along y."""
        return EllipticParaboloid(self.R_x, _FLAT)


def check_repeats(heights: Gap, section: PointContactProblem) -> None:
    """Refuse heights that do not repeat over the length of a section.

    Parameters
    ----------
    heights
        Of x and y [m].
    section
        With closed sides.

    Raises
    ------
    ParameterError
        Heights at both sides differ by more than a thousandth of their range.
    """
    x, sides = section.x, section.y_limits
    first, last = (heights(x, np.full_like(x, y)) for y in sides)
    jump = float(np.abs(last - first).max())
    most = _REPEATS * float(np.ptp(heights(x[:, None], section.y[None, :])))
    if jump > most:
        raise ParameterError(
            f"heights must repeat over the length of {1e3 * (sides[1] - sides[0]):.4g} mm within "
            f"{1e6 * most:.3g} um, got a jump of {1e6 * jump:.3g} um between both sides. Take a "
            "length of whole waves along y, a lay that closes, or crests along x or y."
        )


def line_section(
    *,
    R_x: float,
    length: float,
    line_load: float,
    speed_1: float,
    speed_2: float,
    contact_modulus: float,
    lubricant: FilmOil,
    nodes: tuple[int, int] = (401, 32),
    domain: tuple[float, float] = DOMAIN,
    sides: str = "cyclic",
) -> PointContactProblem:
    """Return a part of a smooth line contact as a point-contact problem.

    Roughness that also varies along the line can be added to it.

    Parameters
    ----------
    R_x
        Radius of relative curvature [m].
    length
        Length of the part along y [m].
    line_load
        w [N/m].
    speed_1, speed_2
        Surface speeds along x [m/s]; their mean is above zero.
    contact_modulus
        E* [Pa].
    lubricant
        Oil of the film.
    nodes
        Number of columns along x, with the border, and of rows along y, an even number.
    domain
        First and last x, in half widths of the dry contact [-].
    sides : {"cyclic", "no_flow"}
        Condition at both ends along y, see `Sides`.

    Returns
    -------
    PointContactProblem
        With y from 0 to `length`.

    Notes
    -----
    Pressure beside a line contact falls only with the square of distance. The approach of the
    solids has no absolute meaning here, because the deflection under a line
    load has no finite limit. The approaches of two films can be compared.

    Examples
    --------
    >>> from gearlube_core.oil.film_oil_data import film_oil
    >>> part = line_section(R_x=0.014, length=1e-3, line_load=3.6e5, speed_1=7.9, speed_2=5.5,
    ...     contact_modulus=1.1375e11, lubricant=film_oil(eta0=0.00625, alpha=13.3e-9))
    >>> round(1e-9 * part.hertz_contact[2], 3), round(1e6 * part.spacing[1], 2)  # GPa, um
    (0.965, 31.25)
    """
    check_positive("length", length, "m", "Give metres, not millimetres.")
    check_positive("line_load", line_load, "N/m", "360 N/mm is 3.6e5 N/m.")
    check_positive("contact_modulus", contact_modulus, "Pa")
    cylinder = Cylinder(R_x)
    half_width = math.sqrt(4.0 * line_load * R_x / (math.pi * contact_modulus))
    return PointContactProblem(
        gap=cylinder,
        entrainment=(0.5 * (speed_1 + speed_2), 0.0),
        load=line_load * length,
        contact_modulus=contact_modulus,
        lubricant=lubricant,
        x_limits=(domain[0] * half_width, domain[1] * half_width),
        y_limits=(0.0, length),
        nodes=nodes,
        hertz=cylinder.paraboloid,
        sliding=(speed_2 - speed_1, 0.0),
        sides=sides,
    )
