"""A line contact problem: contact, speeds, load, oil, domain, accuracy."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from scipy.optimize import brentq

from gearlube_core.checks import check_finite, check_option, check_positive, check_within
from gearlube_core.ehl.grid_error import twice_as_wide
from gearlube_core.ehl.line.rows import STENCILS
from gearlube_core.errors import ParameterError
from gearlube_core.film.groups import LineGroups, line_groups
from gearlube_core.film.line_film import central_film_group
from gearlube_core.oil.film_oil import FilmOil, pressure_viscosity

CAVITATION = ("reynolds", "mass_conserving")
MOST_NODES = 20001
Gap = Callable[[np.ndarray], np.ndarray]

# gap over film where the domain begins and ends, and least distance in half widths
_INLET_GAP, _OUTLET_GAP = 150.0, 4.0
_INLET_LEAST, _OUTLET_LEAST = 2.0, 1.3


def hertz_gap(X: np.ndarray) -> np.ndarray:
    """Return the gap h R/b^2 [-] beside a dry contact at distances X = x/b from 1 on."""
    return np.asarray(0.5 * (X * np.sqrt(X * X - 1.0) - np.arccosh(X)))


def _hertz_distance(gap: float) -> float:
    # x/b where `hertz_gap` is `gap`
    def excess(X: float) -> float:
        return float(hertz_gap(np.array(X))) - gap

    return float(brentq(excess, 1.0, math.sqrt(2.0 * gap) + 3.0, rtol=1e-6))


@dataclass(frozen=True, slots=True, kw_only=True)
class LineProblem:
    """Steady lubricated line contact of two elastic bodies, for `solve_line`; plane strain.

    Parameters
    ----------
    lubricant
        Oil of the film.
    radius
        Radius of relative curvature R [m]; if `gap` is given, it only sets scales and the start.
    line_load
        w, load per unit length [N/m].
    reduced_modulus
        E' = 2 E* [Pa].
    speed_1, speed_2
        Surface speeds along x [m/s]; body 1 is below the film, body 2 above. In a steady problem
        their sum must not be zero.
    gap
        Undeformed gap h_u(x) [m] at positions (n,) [m], up to a constant; default: x^2/(2 R).
    domain
        First and last x [m]; default: chosen from load, film and direction of entrainment.
    inlet_fill
        Share of the gap at the inlet that is filled with oil, above 0 to 1; below 1 needs
        mass-conserving cavitation.
    oil_beyond
        True: there is oil upstream of the domain, between the parabolas of `radius`; its pressure
        acts on the border, and it carries its share of the load. False: ambient pressure on the
        border. None: True on the default domain of two flooded parabolas.

    Notes
    -----
    The bodies are half-spaces. They are smooth, or their surface features are long compared with
    the film (Reynolds' equation).

    Examples
    --------
    >>> from gearlube_core.oil.film_oil_data import film_oil
    >>> line = LineProblem(
    ...     lubricant=film_oil(eta0=0.04, alpha=2e-8), radius=0.01, line_load=2e5,
    ...     reduced_modulus=2.3e11, speed_1=2.0, speed_2=2.0,
    ... )
    >>> round(1e-9 * line.hertz_pressure, 2)  # GPa
    0.86
    """

    lubricant: FilmOil
    radius: float
    line_load: float
    reduced_modulus: float
    speed_1: float
    speed_2: float
    gap: Gap | None = None
    domain: tuple[float, float] | None = None
    inlet_fill: float = 1.0
    oil_beyond: bool | None = None

    def __post_init__(self) -> None:
        check_positive("radius", self.radius, "m", "Give metres, not millimetres.")
        check_positive("line_load", self.line_load, "N/m", "100 N/mm is 1e5 N/m.")
        check_within("reduced_modulus", self.reduced_modulus, 1e4, 1e13, "Pa", "E' = 2 E*.")
        check_finite("speed_1", self.speed_1, "m/s")
        check_finite("speed_2", self.speed_2, "m/s")
        check_within("inlet_fill", self.inlet_fill, 1e-6, 1.0)
        if self.oil_beyond and self.inlet_fill < 1.0:
            raise ParameterError(
                f"inlet_fill is {self.inlet_fill:g}, but oil_beyond floods the inlet. Give one of "
                "them."
            )
        if self.domain is not None and not self.domain[0] < self.domain[1]:
            raise ParameterError(
                f"domain must run from its smaller to its larger x, got {self.domain[0]:g} to "
                f"{self.domain[1]:g} m."
            )

    @property
    def flooded_beyond(self) -> bool:
        """Tell whether there is oil upstream of the domain."""
        if self.oil_beyond is not None:
            return self.oil_beyond
        return self.domain is None and self.gap is None and self.inlet_fill == 1.0

    @property
    def entrainment_speed(self) -> float:
        """Mean surface speed u = (u1 + u2)/2 [m/s]."""
        return 0.5 * (self.speed_1 + self.speed_2)

    @property
    def half_width(self) -> float:
        """Hertz half width b = [8 w R/(pi E')]^(1/2) [m]."""
        return math.sqrt(8.0 * self.line_load * self.radius / (math.pi * self.reduced_modulus))

    @property
    def hertz_pressure(self) -> float:
        """Largest Hertz pressure 2 w/(pi b) [Pa]."""
        return 2.0 * self.line_load / (math.pi * self.half_width)

    def groups(self) -> LineGroups:
        """Return the dimensionless groups, with the amount of the entrainment speed."""
        return line_groups(
            viscosity=self.lubricant.eta0,
            pressure_viscosity=pressure_viscosity(self.lubricant),
            entrainment_speed=abs(self.entrainment_speed),
            line_load=self.line_load,
            radius=self.radius,
            reduced_modulus=self.reduced_modulus,
        )

    def film_guess(self) -> float:
        """Return an estimate of the film [m], for the domain and the initial values."""
        g = self.groups()
        return self.radius * math.sqrt(2.0 * g.U) * central_film_group(g.M, g.L)

    def extent(self) -> tuple[float, float]:
        """Return first and last x [m]: as given, or wide enough for a flooded inlet."""
        if self.domain is not None:
            return self.domain
        b = self.half_width
        film = self.film_guess() * self.radius / (b * b)
        ahead = b * max(_INLET_LEAST, _hertz_distance(_INLET_GAP * film))
        behind = b * max(_OUTLET_LEAST, _hertz_distance(_OUTLET_GAP * film))
        if self.entrainment_speed < 0.0:
            return -behind, ahead
        return -ahead, behind

    def widened(self, nodes: int) -> tuple[LineProblem, int] | None:
        """Return the problem on about twice the domain and nodes that keep those of its grid.

        None: gap or oil may not go on beyond the domain.
        """
        if self.gap is not None or self.inlet_fill < 1.0:
            return None
        limits, count = twice_as_wide(self.extent(), nodes)
        return replace(self, domain=limits, oil_beyond=self.flooded_beyond), count

    def undeformed_gap(self, x: np.ndarray) -> np.ndarray:
        """Return h_u [m] at x [m]."""
        if self.gap is None:
            return x * x / (2.0 * self.radius)
        return np.asarray(self.gap(x), dtype=float)


@dataclass(frozen=True, slots=True, kw_only=True)
class LineSettings:
    """How `solve_line` solves a line contact: grid, difference formula, tolerance.

    Parameters
    ----------
    nodes
        Number of nodes of the finest grid.
    stencil
        Difference formula of the wedge term: "upwind-2" (default), "central", "upwind-1", or
        "galerkin" for the finite elements of [jamali_2015 (3.14)].
    cavitation
        "reynolds": pressure and its gradient are zero where the film breaks. "mass_conserving":
        the void share of [jakobsson_floberg_1957] and [olsson_1965] is solved too.
    tolerance
        Largest sum of unbalanced flows over the flow through the contact, and largest relative
        error of the load [-]. Rounding errors limit what can be reached.
    max_iterations
        Largest number of Newton steps on each grid.
    coarsest
        Fewest nodes of the coarsest grid of the nest.
    contact_film
        Film [m] at which solids touch in a march in time, where the oil alone finds no film; 0:
        never.

    Examples
    --------
    >>> LineSettings(nodes=401).stencil
    'upwind-2'
    """

    nodes: int = 1001
    stencil: str = "upwind-2"
    cavitation: str = "reynolds"
    tolerance: float = 1e-8
    max_iterations: int = 40
    coarsest: int = 100
    contact_film: float = 1e-9

    def __post_init__(self) -> None:
        check_within("nodes", self.nodes, 17, MOST_NODES)
        check_option("stencil", self.stencil, STENCILS)
        check_option("cavitation", self.cavitation, CAVITATION)
        check_within("tolerance", self.tolerance, 1e-13, 1e-2)
        check_within("max_iterations", self.max_iterations, 1, 10000)
        check_within("coarsest", self.coarsest, 9, 5000)
        check_within("contact_film", self.contact_film, 0.0, 1e-6, "m")
        if self.stencil == "galerkin" and self.cavitation == "mass_conserving":
            raise ParameterError(
                "stencil galerkin cannot be combined with mass-conserving cavitation, which needs "
                "fluxes between nodes. Take upwind-2."
            )
