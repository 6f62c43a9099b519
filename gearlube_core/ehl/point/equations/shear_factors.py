"""Flow by pressure over its Newtonian value: of a Newtonian film, and of an Eyring film."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from gearlube_core.arrays import Array, Flags
from gearlube_core.ehl.point.equations.cross_flow import (
    CrossFlow,
    add_cross_derivatives,
    add_cross_flow,
)
from gearlube_core.ehl.point.equations.stencil import (
    CROSS_NEIGHBOURS,
    NEIGHBOURS,
    FilmFlow,
    FlowSlopes,
    MeshMetric,
    StencilParameters,
)


class NoCrossFlow:
    """Pressure drives no oil across its slope."""

    neighbours = NEIGHBOURS  # of a node in the derivatives

    def cubic_xy(self, cubic: Array) -> Array:
        """Return rho h^3 times the flow factor along x by dp/dy, (ny, nx)."""
        return np.zeros_like(cubic)

    def add_cross_flow(
        self,
        stencil: StencilParameters,
        metric: MeshMetric,
        pressure: Array,
        flow: FilmFlow,
        residual: Array,
    ) -> None:
        """Leave the residual as it is."""

    def add_cross_derivatives(
        self,
        stencil: StencilParameters,
        metric: MeshMetric,
        pressure: Array,
        flow: FilmFlow,
        viscosity_slope: Array,
        film: Array,
        slopes: FlowSlopes,
        free: Flags,
        by_pressure: Array,
        by_film: Array,
    ) -> None:
        """Leave the derivatives as they are."""

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
        Rows and columns.
    """

    def __init__(self, shape: tuple[int, int]) -> None:
        self._film_power, self._stiffness = np.full(shape, 3.0), np.ones(shape)
        self._zero = np.zeros(shape)

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
        """Return what pressure along x and y drives oil with."""
        return FilmFlow(cubic_x, fluidity, fluidity, log_viscosity, log_viscosity)

    def slopes(
        self, cubic: Array, log_density_slope: Array, log_viscosity_slope: Array
    ) -> FlowSlopes:
        """Return the derivatives of the flow, from d ln(rho)/dp and d ln(eta)/dp."""
        return FlowSlopes(
            cubic, cubic, self._zero, log_density_slope, self._film_power, self._stiffness
        )

    def relative(self, slopes: FlowSlopes) -> FlowSlopes:
        """Return slopes whose `slope_x` and `slope_y` are over their flow factors."""
        return slopes


@dataclass(frozen=True, slots=True)
class AlignedFactors(NoCrossFlow):
    """Flow factors of a film that slides along an axis of its grid; arrays (ny, nx) [-].

    flow = -rho h^3/(12 eta) [xx dp/dx, yy dp/dy]
    """

    xx: Array
    yy: Array
    slope_xx: Array  # flow factor of a change of dp/dx
    slope_yy: Array
    stiffness: Array  # -d ln(flow)/d ln(eta) along sliding
    film_power: Array  # d ln(flow)/d ln(h) along sliding

    def cubic_x(self, cubic: Array) -> Array:
        """Return rho h^3 times the flow factor along x, (ny, nx)."""
        return cubic * self.xx

    def cubic_y(self, cubic: Array) -> Array:
        """Return rho h^3 times the flow factor along y, (ny, nx)."""
        return cubic * self.yy

    def flow(self, cubic_x: Array, fluidity: Array, log_viscosity: Array) -> FilmFlow:
        """Return what pressure along x and y drives oil with."""
        return FilmFlow(
            cubic_x / self.xx,
            fluidity * self.xx,
            fluidity * self.yy,
            log_viscosity - np.log(self.xx),
            log_viscosity - np.log(self.yy),
        )

    def _slope_xy(self, cubic: Array) -> Array:
        return np.zeros_like(cubic)

    def slopes(
        self, cubic: Array, log_density_slope: Array, log_viscosity_slope: Array
    ) -> FlowSlopes:
        """Return the derivatives of the flow, from d ln(rho)/dp and d ln(eta)/dp."""
        return FlowSlopes(
            cubic * self.slope_xx,
            cubic * self.slope_yy,
            self._slope_xy(cubic),
            log_density_slope + (1.0 - self.stiffness) * log_viscosity_slope,
            self.film_power,
            self.stiffness,
        )

    def relative(self, slopes: FlowSlopes) -> FlowSlopes:
        """Return slopes whose `slope_x` and `slope_y` are over their flow factors."""
        return slopes._replace(slope_x=slopes.slope_x / self.xx, slope_y=slopes.slope_y / self.yy)


@dataclass(frozen=True, slots=True)
class ObliqueFactors(AlignedFactors):
    """Flow factors of a film that slides at an angle to the axes; arrays (ny, nx) [-].

    flow = -rho h^3/(12 eta) [[xx, xy], [xy, yy]] grad p
    """

    xy: Array
    slope_xy: Array  # flow factor along x of a change of dp/dy

    neighbours = CROSS_NEIGHBOURS

    def cubic_xy(self, cubic: Array) -> Array:
        """Return rho h^3 times the flow factor along x by dp/dy, (ny, nx)."""
        return cubic * self.xy

    def _slope_xy(self, cubic: Array) -> Array:
        return cubic * self.slope_xy

    def _cross(self) -> CrossFlow:
        return CrossFlow(
            self.xy / self.xx, self.xy / self.yy, self.slope_xy / self.xx, self.slope_xy / self.yy
        )

    def add_cross_flow(
        self,
        stencil: StencilParameters,
        metric: MeshMetric,
        pressure: Array,
        flow: FilmFlow,
        residual: Array,
    ) -> None:
        """Add the flow across the slope of pressure to the residual, (ny, nx)."""
        add_cross_flow(stencil, metric, pressure, flow, self._cross(), residual)

    def add_cross_derivatives(
        self,
        stencil: StencilParameters,
        metric: MeshMetric,
        pressure: Array,
        flow: FilmFlow,
        viscosity_slope: Array,
        film: Array,
        slopes: FlowSlopes,
        free: Flags,
        by_pressure: Array,
        by_film: Array,
    ) -> None:
        """Add the derivatives of that flow, by pressure and film of 11 neighbours."""
        add_cross_derivatives(
            stencil,
            metric,
            pressure,
            flow,
            self._cross(),
            viscosity_slope,
            film,
            slopes,
            free,
            by_pressure,
            by_film,
        )

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
