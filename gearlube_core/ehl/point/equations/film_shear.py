"""Flow factors of a shear-thinning film on a uniform grid, for sliding at any angle to its axes."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from gearlube_core.arrays import Array, Flags
from gearlube_core.checks import check_finite, check_positive
from gearlube_core.ehl.point.equations.factor_fields import (
    FactorWork,
    ShearUnits,
    fill_factor_slopes,
    fill_shear_factors,
)
from gearlube_core.ehl.point.equations.shear_factors import (
    AlignedFactors,
    NewtonianFactors,
    ObliqueFactors,
)
from gearlube_core.ehl.point.equations.stencil import NodeSlopes, TensorSlopes
from gearlube_core.ehl.point.settings import AMBIENT, Sides
from gearlube_core.errors import ParameterError
from gearlube_core.kernels.row_workers import ALONE, RowWorkers
from gearlube_core.oil.film_oil import FilmOil, fill_stress_ratios

ALIGNED = 1.0e-12  # product of cosine and sine: flow along an axis feels no slope along the other
_EVEN = 1.0e-9  # spread of sliding along x over sliding along y


@dataclass(frozen=True, slots=True)
class FilmShear:
    """Constants of a film with a shear law on one grid; build it with `of`."""

    oil: FilmOil  # in SI
    pressure: float  # unit of the arrays [Pa]
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
    workers: RowWorkers = ALONE  # who share the rows
    cooling: Array | None = None  # `cooling_factor` of the film, (ny, nx) [-]; None: 1

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
            Boundary conditions along y.

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
            oil=lubricant,
            pressure=pressure,
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

    def with_workers(self, workers: RowWorkers) -> FilmShear:
        """Return the film whose rows these share."""
        return replace(self, workers=workers)

    def heated(self, cooling: Array) -> FilmShear:
        """Return the film at other temperatures; cooling factor of the law, (ny, nx) [-]."""
        return replace(self, cooling=cooling)

    def factors(self, pressure: Array, film: Array, fluidity: Array) -> AlignedFactors:
        """Return the factors at pressure, film and 1/eta in the units of `of`, (rows, nx)."""
        ratio, ratio_slope = np.ones(pressure.shape), np.zeros(pressure.shape)
        if self.oil.eyring_slope > 0.0:
            cooling = ratio.copy() if self.cooling is None else self.cooling
            fill_stress_ratios(self.oil, self.pressure, pressure, cooling, ratio, ratio_slope)
        units = ShearUnits(
            self.couette,
            self.sigma_x * (np.ones(pressure.shape[1]) if self.central is None else self.central),
            self.sigma_y,
            self.cosine,
            self.sine,
            self.limit,
            self.limit_slope,
            ratio,
            ratio_slope,
        )
        ny, nx = pressure.shape
        along, across = np.empty((2, ny, nx))
        stress = np.empty((2, ny, nx))
        fields = self.oil.shear, pressure, film, fluidity
        self.workers.share(
            lambda part: fill_shear_factors(
                *fields, units, part, FactorWork.empty(nx), along, across, stress
            ),
            ny,
            nx,
        )
        for one in (along, across):
            self.sides.fill(one)
        c, s = self.cosine, self.sine

        def rates(thickening: Array, rows: Flags | None = None) -> TensorSlopes:
            by = np.empty((2, 4, ny, nx))
            wanted = self._beside(rows, (ny, nx))
            given = *fields, thickening, units, stress, wanted
            self.workers.share(
                lambda part: fill_factor_slopes(*given, part, FactorWork.empty(nx), *by), ny, nx
            )
            for one in by:
                for k in range(3):
                    self.sides.fill(one[k])
                self.sides.fill_rises(one[3])
            return self._turned(*by)

        if abs(c * s) >= ALIGNED:
            return ObliqueFactors(
                xx=c * c * along + s * s * across,
                yy=s * s * along + c * c * across,
                rates=rates,
                xy=c * s * (along - across),
            )
        if abs(c) > abs(s):
            return AlignedFactors(along, across, rates)
        return AlignedFactors(across, along, rates)

    def _beside(self, rows: Flags | None, shape: tuple[int, int]) -> Flags:
        """Return nodes and those beside them, with the rows that copied ones are taken from."""
        if rows is None:
            return np.ones(shape, dtype=np.bool_)
        wanted = rows.copy()
        wanted[1:] |= rows[:-1]
        wanted[:-1] |= rows[1:]
        across = wanted.copy()
        wanted[:, 1:] |= across[:, :-1]
        wanted[:, :-1] |= across[:, 1:]
        own = self.sides.own_rows(shape[0])
        for end in (0, -1):
            wanted[own[end]] |= wanted[end]
        return wanted

    def _turned(self, along: Array, across: Array) -> TensorSlopes:
        c, s = self.cosine, self.sine
        if abs(c * s) < ALIGNED:
            none = NodeSlopes(*(np.zeros(along.shape[1:]),) * 4)
            if abs(c) < abs(s):
                along, across = across, along
            return TensorSlopes(NodeSlopes(*along), none, NodeSlopes(*across))
        return TensorSlopes(
            NodeSlopes(*(c * c * along + s * s * across)),
            NodeSlopes(*(c * s * (along - across))),
            NodeSlopes(*(s * s * along + c * c * across)),
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

    def with_workers(self, workers: RowWorkers) -> NewtonianShear:
        """Return the same."""
        return self

    def heated(self, cooling: Array) -> NewtonianShear:
        """Return the same."""
        return self

    def factors(self, pressure: Array, film: Array, fluidity: Array) -> NewtonianFactors:
        """Return the factors, all 1."""
        return self.ones
