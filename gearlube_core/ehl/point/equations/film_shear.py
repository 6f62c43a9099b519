"""Flow factors of a shear-thinning film on a uniform grid, for sliding at any angle to its axes."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.checks import check_finite, check_positive
from gearlube_core.ehl.point.equations.shear_factors import (
    AlignedFactors,
    NewtonianFactors,
    ObliqueFactors,
)
from gearlube_core.ehl.point.sides import AMBIENT, Sides
from gearlube_core.errors import ParameterError
from gearlube_core.kernels.jit import kernel
from gearlube_core.oil.film_oil import FilmOil
from gearlube_core.oil.shear_flow import shear_factors
from gearlube_core.oil.shear_law import rate_ratio
from gearlube_core.oil.sheared_film import flow_factor, mid_stress

# below, series to the second order are right to 1e-8
_SMALL_STRESS = 1.0e-2
# of the product of cosine and sine: flow along an axis does not feel the slope along the other
ALIGNED = 1.0e-12
_EVEN = 1.0e-9  # spread of sliding along x over sliding along y


class ShearUnits(NamedTuple):
    """Stresses over tau0 per unit of the fields, sliding, and the limiting stress."""

    couette: np.ndarray  # of sliding, times film and fluidity, of every row, shape (ny,) [-]
    # stress drop over half the film, over film and difference of pressure between the nodes on
    # both sides [-]; along x of every column, shape (nx,)
    sigma_x: np.ndarray
    sigma_y: float
    cosine: float  # of the angle from x to sliding
    sine: float
    limit: float  # limiting stress at ambient pressure [-]
    limit_slope: float  # its slope with pressure [-]; both 0: none


class FactorArrays(NamedTuple):
    """Flow factors of every node and their slopes; arrays of shape (ny, nx) [-]."""

    along: np.ndarray  # flow along sliding over its Newtonian value
    across: np.ndarray
    steepness: np.ndarray  # d ln(flow)/d ln(dp/ds) along sliding, as without dp/dr
    stiffness: np.ndarray  # -d ln(flow)/d ln(eta) along sliding, likewise


@kernel
def fill_shear_factors(
    law: Any,
    pressure: np.ndarray,
    film: np.ndarray,
    fluidity: np.ndarray,
    units: ShearUnits,
    factors: FactorArrays,
) -> None:
    """Fill the flow factors of a shear-thinning film, by rows of other sliding in one direction.

    Parameters
    ----------
    law
        Shear law.
    pressure, film, fluidity : ndarray, shape (ny, nx)
        p, h and 1/eta [-].
    units
        Stresses and sliding.
    factors
        Result; 1 on the border.

    Notes
    -----
    Pressure slopes are central. Small stresses: flow along grows by Sigma^2/10 + a^2/2, across
    by Sigma^2/10 + a^2/6, both times 6 dG/dq: the first terms of the series of `shear_flow`. A
    film that slips at the limiting stress has the flow of one that is sheared just so far.
    """
    ny, nx = pressure.shape
    couette, sigma_x, sigma_y, cosine, sine, limit, limit_slope = units
    along, across, steepness, stiffness = factors
    # of the series G = 1 + g q/6: Eyring's g is 1
    g = 6.0 * rate_ratio(law, 0.0)[1]
    along[:] = 1.0
    across[:] = 1.0
    steepness[:] = 1.0
    stiffness[:] = 1.0
    for j in range(1, ny - 1):
        for i in range(1, nx - 1):
            h = film[j, i]
            if h <= 0.0:
                continue
            x = sigma_x[i] * h * (pressure[j, i + 1] - pressure[j, i - 1])
            y = sigma_y * h * (pressure[j + 1, i] - pressure[j - 1, i])
            s, r = cosine * x + sine * y, cosine * y - sine * x
            a = couette[j] / (h * fluidity[j, i])
            most, slips = math.inf, False
            if limit + limit_slope > 0.0:
                most = limit + limit_slope * max(pressure[j, i], 0.0)
                slips = abs(mid_stress(law, s, a)) > most
            if max(abs(s), abs(r), abs(a)) < min(_SMALL_STRESS, most):
                pumped = 0.1 * g * (s * s + r * r)
                along[j, i] = 1.0 + pumped + 0.5 * g * a * a
                across[j, i] = 1.0 + pumped + g * a * a / 6.0
                steepness[j, i] = 1.0 + 0.2 * g * s * s
                stiffness[j, i] = 1.0 - g * a * a
                continue
            along[j, i], across[j, i] = shear_factors(law, s, r, a, most)
            if slips:
                # S = F cosh(limit): F alone depends on the slope of pressure, nothing on viscosity
                F, by_sigma, _ = flow_factor(law, s, 0.0)
                steepness[j, i] = 1.0 + s * by_sigma / F
                stiffness[j, i] = 1.0
                continue
            S, by_sigma, by_a = flow_factor(law, s, a)
            steepness[j, i] = 1.0 + s * by_sigma / S
            stiffness[j, i] = 1.0 - a * by_a / S


@dataclass(frozen=True, slots=True)
class FilmShear:
    """Constants of a film with a shear law on one grid; build it with `of`."""

    law: Any  # shear law
    unit: float  # shear stress over tau0 of sliding at 1 m/s, times film and fluidity [s/m]
    sigma_x: float  # stress drop over tau0, over film and pressure between the nodes beside
    sigma_y: float
    couette: Array  # shear stress of sliding over tau0, times film and fluidity, (rows,) [-]
    cosine: float  # of the angle from x to sliding
    sine: float
    central: Array | None = None  # spacing along x over that of every column, (nx,); None: 1
    limit: float = 0.0  # limiting stress over tau0 at ambient pressure
    limit_slope: float = 0.0  # its slope with pressure
    sides: Sides = AMBIENT  # of the rows

    @classmethod
    def of(
        cls,
        lubricant: FilmOil,
        sliding: tuple[float, float],
        steps: tuple[float, float],
        rows: int,
        *,
        film: float = 1.0,
        pressure: float = 1.0,
        viscosity: float = 1.0,
        central: Array | None = None,
        sides: Sides = AMBIENT,
    ) -> FilmShear:
        """Return the constants.

        Parameters
        ----------
        lubricant
            Oil with a shear law, in SI.
        sliding
            Difference of the surface velocities along x and y [m/s].
        steps
            Node spacing along x and y [m].
        rows
            Number of rows of nodes.
        film, pressure, viscosity
            Units of the arrays: [m], [Pa], [Pa s].
        central
            Spacing along x over half the distance between the neighbours of each column of
            nodes, shape (nx,) [-]; None: 1.
        sides
            Of the rows.

        Raises
        ------
        ParameterError
            An input is out of range, or the oil is Newtonian.
        """
        tau0 = check_positive(
            "lubricant.shear.tau0", lubricant.shear.tau0, "Pa", "A Newtonian film has factors 1."
        )
        for axis, component, step in zip("xy", sliding, steps, strict=True):
            check_finite(f"sliding along {axis}", component, "m/s")
            check_positive(f"d{axis}", step, "m")
        for name, value, si in (
            ("film", film, "m"),
            ("pressure", pressure, "Pa"),
            ("viscosity", viscosity, "Pa s"),
        ):
            check_positive(name, value, si)
        speed = math.hypot(*sliding)
        unit = viscosity / (tau0 * film)
        return cls(
            law=lubricant.shear,
            unit=unit,
            sigma_x=film * pressure / (4.0 * tau0 * steps[0]),
            sigma_y=film * pressure / (4.0 * tau0 * steps[1]),
            couette=np.full(rows, unit * speed),
            cosine=sliding[0] / speed if speed > 0.0 else 1.0,
            sine=sliding[1] / speed if speed > 0.0 else 0.0,
            central=central,
            limit=lubricant.tau_limit / tau0,
            limit_slope=lubricant.limit_slope * pressure / tau0,
            sides=sides,
        )

    def with_sliding(self, along: Array, across: float) -> FilmShear:
        """Return the film with other sliding.

        Parameters
        ----------
        along : ndarray, shape (rows,)
            Of the rows along x [m/s]; all the same where there is sliding along y.
        across
            Of all rows along y [m/s].

        Raises
        ------
        ParameterError
            Rows would slide in different directions.
        """
        across, spread = check_finite("side_sliding", across, "m/s"), float(np.ptp(along))
        if across == 0.0:
            return replace(self, cosine=1.0, sine=0.0, couette=self.unit * along)
        if spread > _EVEN * abs(across):
            raise ParameterError(
                f"sliding along x must not vary over the rows where side_sliding is {across:.4g} "
                f"m/s, got a spread of {spread:.4g} m/s. Turn the axes along sliding."
            )
        speed = math.hypot(float(along[0]), across)
        return replace(
            self,
            cosine=float(along[0]) / speed,
            sine=across / speed,
            couette=np.full(along.size, self.unit * speed),
        )

    def factors(self, pressure: Array, film: Array, fluidity: Array) -> AlignedFactors:
        """Return the factors at pressure, film and 1/eta in the units of `of`, (rows, nx)."""
        factors = FactorArrays(*np.empty((4, *pressure.shape)))
        units = ShearUnits(
            self.couette,
            self.sigma_x * (np.ones(pressure.shape[1]) if self.central is None else self.central),
            self.sigma_y,
            self.cosine,
            self.sine,
            self.limit,
            self.limit_slope,
        )
        fill_shear_factors(self.law, pressure, film, fluidity, units, factors)
        for one in factors:
            self.sides.fill(one)
        along, across, steepness, stiffness = factors
        c, s = self.cosine, self.sine
        slope = along * steepness
        film_power = 1.0 + steepness + stiffness
        if abs(c * s) < ALIGNED:
            if abs(c) > abs(s):
                return AlignedFactors(along, across, slope, across, stiffness, film_power)
            return AlignedFactors(across, along, across, slope, stiffness, film_power)
        return ObliqueFactors(
            xx=c * c * along + s * s * across,
            xy=c * s * (along - across),
            yy=s * s * along + c * c * across,
            slope_xx=c * c * slope + s * s * across,
            slope_xy=c * s * (slope - across),
            slope_yy=s * s * slope + c * c * across,
            stiffness=stiffness,
            film_power=film_power,
        )


@dataclass(frozen=True, slots=True)
class NewtonianShear:
    """Shear of a Newtonian film: its flow factors are 1 whatever the sliding."""

    ones: NewtonianFactors

    @classmethod
    def of(cls, shape: tuple[int, int]) -> NewtonianShear:
        """Return that of a grid with `shape` rows and columns."""
        return cls(NewtonianFactors(shape))

    def with_sliding(self, along: Array, across: float) -> NewtonianShear:
        """Return the same."""
        return self

    def factors(self, pressure: Array, film: Array, fluidity: Array) -> NewtonianFactors:
        """Return the factors, all 1."""
        return self.ones
