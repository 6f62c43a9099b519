"""Flow by pressure over its Newtonian value: of a Newtonian film, and of an Eyring film."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from gearlube_core.arrays import Array, Flags
from gearlube_core.ehl.point.equations.cross_flow import CrossFlow
from gearlube_core.ehl.point.equations.stencil import FilmFlow, FlowSlopes, NodeSlopes, TensorSlopes


class NoCrossFlow:
    """Pressure drives no oil across its slope."""

    @property
    def cross(self) -> CrossFlow | None:
        """Factors of the flow across the slope of pressure, or None."""
        return None

    def cubic_xy(self, cubic: Array) -> Array:
        """Return rho h^3 times the flow factor along x by dp/dy, (ny, nx)."""
        return np.zeros_like(cubic)

    def with_cross_velocity(
        self,
        velocity: tuple[Array, Array],
        mobility: Array,
        fluidity: Array,
        gradient: tuple[Array, Array],
    ) -> tuple[Array, Array]:
        """Return mean velocities (u, v) as they are."""
        return velocity


class NewtonianFactors(NoCrossFlow):
    """All factors are 1.

    Parameters
    ----------
    shape
        Numbers of rows and columns.
    """

    sheared = False  # the factors depend on the rise of pressure across their node

    def __init__(self, shape: tuple[int, int]) -> None:
        self._zero = np.zeros(shape)
        self._none = NodeSlopes(*(self._zero,) * 4)

    def cubic_x(self, cubic: Array) -> Array:
        """Return rho h^3 times the flow factor along x, (ny, nx)."""
        return cubic

    def cubic_y(self, cubic: Array) -> Array:
        """Return rho h^3 times the flow factor along y, (ny, nx)."""
        return cubic

    def cubic_xy(self, cubic: Array) -> Array:
        """Return rho h^3 times the flow factor along x by dp/dy, (ny, nx)."""
        return self._zero

    def flow(self, cubic_x: Array, fluidity: Array, log_viscosity: Array) -> FilmFlow:
        """Return the conductance of pressure-driven flow along x and y."""
        return FilmFlow(cubic_x, fluidity, fluidity, log_viscosity, log_viscosity)

    def slopes(self, dense: Array, thickening: Array, rows: Flags | None = None) -> FlowSlopes:
        """Return the derivatives of the flow, from d ln(rho)/dp and d ln(eta)/dp.

        They are right at the nodes `rows` and beside them; None: everywhere.
        """
        x = self._none._replace(by_pressure=-thickening)
        return FlowSlopes(dense, x, x, self._none, self._none)

    def tensor_slopes(self, mobility: Array, dense: Array, thickening: Array) -> TensorSlopes:
        """Return the derivatives of the factors times a mobility rho h^3/eta."""
        even = self._none._replace(
            by_pressure=mobility * (dense - thickening), by_film=3.0 * mobility
        )
        return TensorSlopes(even, self._none, even)


@dataclass(frozen=True, slots=True)
class AlignedFactors(NoCrossFlow):
    """Flow factors of a film that slides along an axis of its grid; arrays (ny, nx) [-].

    flow = -rho h^3/(12 eta) [xx dp/dx, yy dp/dy]
    """

    xx: Array
    yy: Array
    # derivatives of the factors, from d ln(eta)/dp and the nodes whose equations want them
    rates: Callable[..., TensorSlopes]

    sheared = True

    def cubic_x(self, cubic: Array) -> Array:
        """Return rho h^3 times the flow factor along x, (ny, nx)."""
        return cubic * self.xx

    def cubic_y(self, cubic: Array) -> Array:
        """Return rho h^3 times the flow factor along y, (ny, nx)."""
        return cubic * self.yy

    def flow(self, cubic_x: Array, fluidity: Array, log_viscosity: Array) -> FilmFlow:
        """Return the conductance of pressure-driven flow along x and y."""
        return FilmFlow(
            cubic_x / self.xx,
            fluidity * self.xx,
            fluidity * self.yy,
            log_viscosity - np.log(self.xx),
            log_viscosity - np.log(self.yy),
        )

    def _cross_slopes(self, rates: TensorSlopes) -> tuple[NodeSlopes, NodeSlopes]:
        return rates.xy, rates.xy

    def slopes(self, dense: Array, thickening: Array, rows: Flags | None = None) -> FlowSlopes:
        """Return the derivatives of the flow, from d ln(rho)/dp and d ln(eta)/dp.

        They are right at the nodes `rows` and beside them; None: everywhere.
        """
        rates = self.rates(thickening, rows)
        x, y = (
            NodeSlopes(*(rate / own for rate in part))
            for part, own in ((rates.xx, self.xx), (rates.yy, self.yy))
        )
        cross = self._cross_slopes(rates)
        x, y = (part._replace(by_pressure=part.by_pressure - thickening) for part in (x, y))
        return FlowSlopes(dense, x, y, *cross)

    def tensor_slopes(self, mobility: Array, dense: Array, thickening: Array) -> TensorSlopes:
        """Return the derivatives of the factors times a mobility rho h^3/eta."""
        rates = self.rates(thickening)
        own = self.xx, self.cubic_xy(np.ones_like(mobility)), self.yy
        grown = (
            part._replace(
                by_pressure=part.by_pressure + factor * (dense - thickening),
                by_film=part.by_film + 3.0 * factor,
            )
            for part, factor in zip(rates, own, strict=True)
        )
        return TensorSlopes(*(NodeSlopes(*(mobility * rate for rate in part)) for part in grown))


@dataclass(frozen=True, slots=True)
class ObliqueFactors(AlignedFactors):
    """Flow factors of a film that slides at an angle to the axes; arrays (ny, nx) [-].

    flow = -rho h^3/(12 eta) [[xx, xy], [xy, yy]] grad p
    """

    xy: Array

    def cubic_xy(self, cubic: Array) -> Array:
        """Return rho h^3 times the flow factor along x by dp/dy, (ny, nx)."""
        return cubic * self.xy

    def _cross_slopes(self, rates: TensorSlopes) -> tuple[NodeSlopes, NodeSlopes]:
        x, y = (
            NodeSlopes(
                *(
                    (turned - self.xy / own * rate) / own
                    for turned, rate in zip(rates.xy, part, strict=True)
                )
            )
            for part, own in ((rates.xx, self.xx), (rates.yy, self.yy))
        )
        return x, y

    @property
    def cross(self) -> CrossFlow:
        """Factors of the flow across the slope of pressure."""
        return CrossFlow(self.xy / self.xx, self.xy / self.yy)

    def with_cross_velocity(
        self,
        velocity: tuple[Array, Array],
        mobility: Array,
        fluidity: Array,
        gradient: tuple[Array, Array],
    ) -> tuple[Array, Array]:
        """Return mean velocities with those across the slope of pressure, (ny, nx).

        Parameters
        ----------
        velocity : tuple of ndarray
            u and v by the flow straight down the slope [m/s].
        mobility, fluidity : ndarray
            h^2/(12 eta0) [m^2/(Pa s)] and eta0/eta [-].
        gradient : tuple of ndarray
            dp/dx and dp/dy [Pa/m].
        """
        cross = mobility * fluidity * self.xy
        return velocity[0] - cross * gradient[1], velocity[1] - cross * gradient[0]


ShearFactors = NewtonianFactors | AlignedFactors | ObliqueFactors
