"""A lubricated point contact: gap, motion, load, oil, solids and the domain of the film."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.checks import check_finite, check_positive, check_within
from gearlube_core.contact.hertz import hertz_ellipse
from gearlube_core.ehl.grid_error import twice_as_wide
from gearlube_core.ehl.point.far_field import FarField
from gearlube_core.ehl.point.settings import Sides
from gearlube_core.ehl.point.solid_contact import SolidContact
from gearlube_core.errors import ParameterError
from gearlube_core.film.groups import line_groups
from gearlube_core.film.line_film import central_film_group
from gearlube_core.film.point_film import central_film_thickness, film_geometry, regime_films
from gearlube_core.oil.film_oil import FilmOil, pressure_viscosity

Gap = Callable[[Array, Array], Array]

MOST_NODES = 2049  # along one side; 2049 x 2049 need about 3 GiB


@dataclass(frozen=True, slots=True)
class EllipticParaboloid:
    """Gap of two solids with principal radii along x and y.

    h_u = x^2/(2 R_x) + y^2/(2 R_y)

    Parameters
    ----------
    R_x, R_y
        Relative radii of curvature [m], positive.
    """

    R_x: float
    R_y: float

    def __post_init__(self) -> None:
        check_positive("R_x", self.R_x, "m")
        check_positive("R_y", self.R_y, "m")

    goes_on: ClassVar[bool] = True  # beyond any domain

    def __call__(self, x: Array, y: Array) -> Array:
        """Return the gap [m] at points (x, y) [m]."""
        return np.asarray(x * x / (2.0 * self.R_x) + y * y / (2.0 * self.R_y))


@dataclass(frozen=True, slots=True, kw_only=True)
class PointContactProblem:
    """Steady film between two solids over a rectangle, for `solve_point_contact`.

    div(rho h^3/(12 eta) S grad p) = d(u rho h)/dx + d(v rho h)/dy,
    h = h_0 + h_u(x, y) + 1/(pi E*) int p/r,  int p = W,  p >= 0

    S is 1, or the tensor of flow factors of an Eyring film. The border has ambient pressure.

    Parameters
    ----------
    gap
        Gap h_u(x, y) [m] of the undeformed solids, up to a constant; a function that takes arrays
        and returns an array.
    entrainment
        Mean surface velocity (u, v) [m/s] along x and y; not both zero.
    load
        W [N].
    contact_modulus
        E* [Pa]; half of E' = 2 E*.
    lubricant
        Oil of the film. If `sliding` is given, its Eyring stress acts on the flow; so does the
        limiting stress of an oil that has both: above it the film slips. In a Newtonian film slip
        changes the traction, but not the flow by pressure.
    x_limits, y_limits
        Limits of the domain [m].
    nodes
        Number of nodes along x and along y, with the border: 17 to 2049.
    hertz
        Paraboloid that sets the scales and the start, if the gap is close to one.
    sliding
        Difference of the surface velocities (u_2 - u_1, v_2 - v_1) [m/s] along x and y, for an
        oil with an Eyring stress; None: the oil flows as a Newtonian one.
    solids
        Law by which touching solids carry load where the film vanishes; None: only the oil
        carries load.
    oil_beyond
        True: there is oil beyond the domain, between the paraboloids `hertz` around zero. Its
        pressure acts on the border, and it carries its share of the load.
    inlet_layer
        Thickness of the oil that both surfaces together carry to the upstream border [m], for
        mass-conserving cavitation; None: the gap is full there.
    sides : {"ambient", "cyclic", "no_flow"}
        Condition at both limits of y, see `Sides`. The last two are for a part of a line contact,
        whose scales follow from `hertz.R_x` alone.

    Raises
    ------
    ParameterError
        An input is out of range.

    Examples
    --------
    `elliptical_contact` builds that of two smooth solids, `line_section` a part of a line's.

    >>> from gearlube_core.ehl.point.contact_domain import elliptical_contact
    >>> from gearlube_core.oil.film_oil_data import film_oil
    >>> oil = film_oil(eta0=0.04, alpha=2e-8)
    >>> ball = elliptical_contact(R_x=0.01, R_y=0.01, entrainment=(2.0, 0.0), load=20.0,
    ...                           contact_modulus=1.15e11, lubricant=oil)
    >>> round(1e-9 * ball.hertz_contact[2], 2)  # GPa
    0.8
    """

    gap: Gap
    entrainment: tuple[float, float]
    load: float
    contact_modulus: float
    lubricant: FilmOil
    x_limits: tuple[float, float]
    y_limits: tuple[float, float]
    nodes: tuple[int, int]
    hertz: EllipticParaboloid
    sliding: tuple[float, float] | None = None
    solids: SolidContact | None = None
    oil_beyond: bool = False
    inlet_layer: float | None = None
    sides: str = "ambient"

    def __post_init__(self) -> None:
        for axis, speed in zip("xy", self.entrainment, strict=True):
            check_finite(f"entrainment along {axis}", speed, "m/s")
        check_positive("entrainment", math.hypot(*self.entrainment), "m/s", "Squeeze needs time.")
        for axis, speed in zip("xy", self.sliding or (), strict=False):
            check_finite(f"sliding along {axis}", speed, "m/s")
        check_positive("load", self.load, "N")
        check_within(
            "contact_modulus", self.contact_modulus, 1e5, 1e13, "Pa", "115 GPa is 1.15e11 Pa."
        )
        if self.inlet_layer is not None:
            check_within("inlet_layer", self.inlet_layer, 1e-10, 1.0, "m")
            if self.oil_beyond:
                raise ParameterError(
                    f"inlet_layer is {self.inlet_layer:g} m, but oil_beyond floods the border. "
                    "Give one of them."
                )
        for axis, limits in (("x", self.x_limits), ("y", self.y_limits)):
            low = check_finite(f"{axis}_limits[0]", limits[0], "m")
            check_positive(f"{axis}_limits[1] - {axis}_limits[0]", limits[1] - low, "m")
            if self.oil_beyond and not low < 0.0 < limits[1]:
                raise ParameterError(
                    f"{axis}_limits must be on both sides of 0 m if there is oil beyond them, got "
                    f"{low:.4g} to {limits[1]:.4g} m."
                )
        sides = Sides(self.sides)
        if sides.closed:
            beyond = self.oil_beyond or self.inlet_layer is not None
            sides.check_goes_with(self.nodes[1], self.entrainment[1], self.sliding, beyond)
        for axis, count in zip("x" if sides.closed else "xy", self.nodes, strict=False):
            if not 17 <= count <= MOST_NODES:
                wanted = f"within 17 to {MOST_NODES}"
                raise ParameterError(f"nodes along {axis} must be {wanted}, got {count}.")

    @property
    def x(self) -> Array:
        """Return the nodes along x [m], shape (nx,)."""
        return np.linspace(*self.x_limits, self.nodes[0])

    @property
    def y(self) -> Array:
        """Return the nodes along y [m], shape (ny,)."""
        return Sides(self.sides).rows(self.y_limits, self.nodes[1])

    @property
    def spacing(self) -> tuple[float, float]:
        """Return the spacing along x, as if uniform, and along y [m]."""
        (x0, x1), (y0, y1), (nx, ny) = self.x_limits, self.y_limits, self.nodes
        return (x1 - x0) / (nx - 1), (y1 - y0) / Sides(self.sides).intervals(ny)

    @property
    def middle(self) -> float:
        """Return y of the centre of the dry contact [m]: 0, or half way between closed sides."""
        return 0.5 * sum(self.y_limits) if Sides(self.sides).closed else 0.0

    @property
    def line_load(self) -> float:
        """Return the load over the length along y [N/m]."""
        return self.load / float(np.diff(self.y_limits)[0])

    @property
    def hertz_contact(self) -> tuple[float, float, float]:
        """Return the dry semi-axes along x and y (of a line half its length) [m], p_max [Pa]."""
        if Sides(self.sides).closed:
            a, pressure = hertz_line(self.hertz.R_x, self.contact_modulus, self.line_load)
            return a, 0.5 * (self.y_limits[1] - self.y_limits[0]), pressure
        a_x, a_y, mean = hertz_ellipse(
            self.hertz.R_x, self.hertz.R_y, self.contact_modulus, self.load
        )
        return a_x, a_y, 1.5 * mean

    def far_field(self, margins: tuple[float, float] = (0.0, 0.0)) -> FarField:
        """Return the oil outside the domain and margins along x and y [m]."""
        (x0, x1), (y0, y1), (dx, dy) = self.x_limits, self.y_limits, margins
        return FarField(
            R_x=self.hertz.R_x,
            R_y=self.hertz.R_y,
            entrainment=self.entrainment,
            load=self.load,
            contact_modulus=self.contact_modulus,
            lubricant=self.lubricant,
            x_limits=(x0 - dx, x1 + dx),
            y_limits=(y0 - dy, y1 + dy),
        )

    @property
    def radii(self) -> tuple[float, float]:
        """Return the relative radii along x and y [m]; infinite along a line."""
        return self.hertz.R_x, math.inf if Sides(self.sides).closed else self.hertz.R_y

    def with_nodes(self, nx: int, ny: int) -> PointContactProblem:
        """Return the same problem on another grid."""
        return replace(self, nodes=(nx, ny))

    def widened(self) -> PointContactProblem | None:
        """Return the problem on twice the domain, nodes kept; None: it may not go on."""
        closed, (x, y) = Sides(self.sides).closed, (self.x_limits, self.y_limits)
        inside = x[0] < 0.0 < x[1] and (closed or y[0] < 0.0 < y[1])
        if not (inside and getattr(self.gap, "goes_on", False)) or self.inlet_layer is not None:
            return None
        (x, nx), (ny, wide_y) = twice_as_wide(x, self.nodes[0]), (self.nodes[1], y)
        if not closed:
            wide_y, ny = twice_as_wide(y, ny)
        return replace(self, x_limits=x, y_limits=wide_y, nodes=(nx, ny))


def expected_film(problem: PointContactProblem) -> float:
    """Return a central film [m] to start from: the largest of elastic and rigid estimates.

    Not thinner than touching solids under the largest dry pressure.
    Elastic: [chittenden_1985] and the isoviscous limit of `regime_films`. Rigid: [kapitza_1955],
    p = -12 eta u x/[(3 + 2 R_x/R_y) h^2] where it is positive, so
    W = 12 pi eta u R_x/(3 + 2 R_x/R_y) (2 R_y/h)^(1/2).
    Of a part of a line contact: `central_film_group`.
    """
    touching = 0.0 if problem.solids is None else problem.solids.film(problem.hertz_contact[2])
    if Sides(problem.sides).closed:
        R, modulus, speed = problem.hertz.R_x, problem.contact_modulus, problem.entrainment[0]
        film = line_film(R, modulus, problem.line_load, problem.lubricant, abs(speed))
        return max(film, touching)
    R_x, R_y = problem.hertz.R_x, problem.hertz.R_y
    u, v = (abs(speed) for speed in problem.entrainment)
    psi = math.atan2(v, u)
    if R_x > R_y:
        R_x, R_y, psi = R_y, R_x, 0.5 * math.pi - psi
    R_e, side_flow = film_geometry(R_x, R_y, psi)
    oil, speed = problem.lubricant, math.hypot(u, v)
    alpha = max(pressure_viscosity(oil), 2.0 / problem.contact_modulus)
    elastic = central_film_thickness(
        R_e, side_flow, oil.eta0, alpha, speed, problem.load, 2.0 * problem.contact_modulus
    )
    R_s = R_x * R_y / R_e
    slope = 12.0 * oil.eta0 * speed / (3.0 + 2.0 * R_e / R_s)
    rigid = 2.0 * R_s * (math.pi * slope * R_e / problem.load) ** 2
    modulus = 2.0 * problem.contact_modulus
    U = oil.eta0 * speed / (modulus * R_e)
    M = problem.load / (modulus * R_e**2) * (2.0 * U) ** -0.75
    films = regime_films(M, 0.0, min(1.0, max(0.01, R_e / R_s)))
    # that of light loads bounds the elastic film; the rigid one is above it there
    soft = min(films.elastic_isoviscous, films.light_load) * R_e * math.sqrt(2.0 * U)
    return max(elastic, rigid, soft if R_e <= R_s else 0.0, touching)


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
