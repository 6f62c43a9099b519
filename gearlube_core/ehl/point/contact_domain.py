"""Contacts to solve on a grid: an ellipse, and a section of a line contact."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.checks import check_positive
from gearlube_core.ehl.point.problem import (
    EllipticParaboloid,
    Gap,
    PointContactProblem,
    expected_film,
)
from gearlube_core.errors import ParameterError
from gearlube_core.oil.film_oil import FilmOil

_FLOODED = 20.0  # films of gap at the inlet
_FLOODED_MORE = 15.0  # times as many more under thick films with no oil beyond the border
_LOAD_BEYOND = 0.002  # share of the load that may lie beyond an ambient border
DOMAIN = (-2.5, 1.5)  # half widths of the dry contact, as [jamali_2015] section 7.5 has them
_REPEATS = 1e-3  # of the range of heights, that may lie between both sides
_FLAT = 1e6  # m, radius along y that the scales of a closed film do not see


@dataclass(frozen=True, slots=True)
class ContactDomain:
    """Size of the domain of a point contact's film, in semi-axes of the dry contact.

    Parameters
    ----------
    inlet, outlet, side
        Distance upstream, downstream and to each side, in semi-axes along the same axis [-]; None:
        as far as the film needs.

    Examples
    --------
    >>> ContactDomain(inlet=4.0).outlet is None
    True
    """

    inlet: float | None = None
    outlet: float | None = None
    side: float | None = None


_AS_NEEDED = ContactDomain()


def elliptical_contact(
    *,
    R_x: float,
    R_y: float,
    entrainment: tuple[float, float],
    load: float,
    contact_modulus: float,
    lubricant: FilmOil,
    nodes: tuple[int, int] = (129, 129),
    sliding: tuple[float, float] | None = None,
    domain: ContactDomain = _AS_NEEDED,
    oil_beyond: bool | None = None,
    inlet_layer: float | None = None,
) -> PointContactProblem:
    """Return the problem of two smooth solids in point contact, on a domain with a flooded inlet.

    Parameters
    ----------
    R_x, R_y
        Radii of relative curvature along x and y [m].
    entrainment, load, contact_modulus, lubricant, nodes, sliding
        As in `PointContactProblem`.
    domain
        Size of the domain; default: as far as the film needs.
    oil_beyond
        As in `PointContactProblem`. None: True on the default domain if it is flooded and oil
        outside would carry more than 0.2 % of the load: very slender or heavily loaded contacts
        converge better without.
    inlet_layer
        As in `PointContactProblem`.

    Returns
    -------
    PointContactProblem
        Centred on the dry contact.

    Notes
    -----
    The default inlet begins where the undeformed gap is 20 central films, at least 2.5 semi-axes
    from the centre; sides and outlet are chosen in the same way. Larger domains change the central
    film by about 0.1 %. Without oil beyond the border films of flattened solids come out 0.5 to 1 %
    too thin and their friction up to 10 % too high, because the load that oil outside carries
    presses inside. Isoviscous films, and films that are thicker than the solids flatten, are up to
    a fifth too thin on a domain of 320 films. The reason is that pressure falls only with the third
    power of distance.

    Examples
    --------
    >>> from gearlube_core.oil.film_oil_data import film_oil
    >>> ball = elliptical_contact(
    ...     R_x=0.01, R_y=0.01, entrainment=(2.0, 0.0), load=20.0, contact_modulus=1.15e11,
    ...     lubricant=film_oil(eta0=0.04, alpha=2e-8),
    ...     domain=ContactDomain(inlet=4.0, outlet=2.0, side=3.0),
    ... )
    >>> a_x, a_y, _ = ball.hertz_contact
    >>> [round(x / a_x, 6) for x in ball.x_limits], [round(y / a_y, 6) for y in ball.y_limits]
    ([-4.0, 2.0], [-3.0, 3.0])
    """
    shape = EllipticParaboloid(R_x, R_y)
    problem = PointContactProblem(
        gap=shape,
        entrainment=entrainment,
        load=load,
        contact_modulus=contact_modulus,
        lubricant=lubricant,
        x_limits=(-1.0, 1.0),
        y_limits=(-1.0, 1.0),
        nodes=nodes,
        hertz=shape,
        sliding=sliding,
        inlet_layer=inlet_layer,
    )
    film = expected_film(problem)
    near = _on_domain(problem, film, domain, 0.0)
    if oil_beyond is None:
        own = inlet_layer is None and domain == _AS_NEEDED
        oil_beyond = own and near.far_field().load(film)[0] > _LOAD_BEYOND * load
    if oil_beyond:
        return replace(near, oil_beyond=True)
    return _on_domain(problem, film, domain, _FLOODED_MORE)


def _on_domain(
    problem: PointContactProblem, film: float, domain: ContactDomain, more: float
) -> PointContactProblem:
    """Return the problem with the limits for a film [m].

    `more` times the films of gap on top at the inlet where it is thicker than solids flatten.
    """
    inlet, outlet, side = domain.inlet, domain.outlet, domain.side
    R_x, R_y = problem.hertz.R_x, problem.hertz.R_y
    a_x, a_y, _ = problem.hertz_contact
    entrainment = problem.entrainment
    speed = math.hypot(*entrainment)
    # films thicker than the solids flatten carry load far to the sides
    thickness = min(1.0, film * min(R_x, R_y) / min(a_x, a_y) ** 2)
    breadth = 0.6 + 0.4 * thickness
    flooded_films = _FLOODED * (1.0 + more * thickness**4)
    limits = []
    for component, radius, semi_axis in ((entrainment[0], R_x, a_x), (entrainment[1], R_y, a_y)):
        flooded = (
            semi_axis + math.sqrt(2.0 * radius * flooded_films * film) if inlet is None else 0.0
        )
        upstream = max(2.5 * semi_axis, flooded) if inlet is None else inlet * semi_axis
        spread = max(2.0 * semi_axis, breadth * flooded) if side is None else side * semi_axis
        exit_reach = max(1.5 * semi_axis, 0.3 * flooded) if outlet is None else outlet * semi_axis
        share = component / speed  # 0: across the motion, 1: along it
        along = (-upstream, exit_reach) if share > 0.0 else (-exit_reach, upstream)
        weight = min(1.0, 2.0 * abs(share))
        low, high = along
        limits.append(
            (weight * low - (1.0 - weight) * spread, weight * high + (1.0 - weight) * spread)
        )
    return replace(problem, x_limits=limits[0], y_limits=limits[1])


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
        Section of a case with closed sides.

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
