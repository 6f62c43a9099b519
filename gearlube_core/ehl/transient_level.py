"""One grid of a film whose gap, load and surface speeds change in time and along the contact."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from gearlube_core.checks import check_positive, check_within
from gearlube_core.ehl.eyring_flow import eyring_flow_factor
from gearlube_core.ehl.flow_factors import eyring_flow
from gearlube_core.ehl.lubricant import fill_properties
from gearlube_core.ehl.point_level import FilmState, Linearisation, PointLevel
from gearlube_core.ehl.point_stencil import CENTRE, reynolds_residual
from gearlube_core.ehl.problem import PointContactProblem
from gearlube_core.ehl.scaling import PointScales
from gearlube_core.errors import ParameterError
from gearlube_core.jit import kernel

Array = np.ndarray[Any, np.dtype[np.float64]]
Flags = np.ndarray[Any, np.dtype[np.bool_]]

# below, an Eyring film flows as a Newtonian one to 1e-4: S = 1 + (Sigma^2 + 5 a^2)/10
_NEWTONIAN = 1.0e-2
_STEEPEST = 20.0  # of entrainment against x


@dataclass(frozen=True, slots=True)
class FilmConditions:
    """What acts on a film at one time, on the nodes of one grid.

    Parameters
    ----------
    gap : ndarray, shape (nx, ny)
        Of the undeformed solids [m], finite, up to a constant.
    load : float
        W [N].
    speed_1, speed_2 : ndarray, shape (ny,)
        Surface speeds along x [m/s]; their mean is above zero. They may vary across the motion,
        not along it.
    slope : float
        Entrainment along y over that along x [1], not below zero; sliding along y is left out.
    """

    gap: Array
    load: float
    speed_1: Array
    speed_2: Array
    slope: float = 0.0


# (x, y, time) to what acts then: nodes [m], shapes (nx,) and (ny,); time [s]
Conditions = Callable[[Array, Array, float], FilmConditions]


@kernel
def fill_shear_factors(
    pressure: np.ndarray,
    film: np.ndarray,
    fluidity: np.ndarray,
    couette: np.ndarray,
    sigma_x: float,
    sigma_y: float,
    factor_x: np.ndarray,
    factor_y: np.ndarray,
    steepness: np.ndarray,
    stiffness: np.ndarray,
) -> None:
    """Fill the flow factors of an Eyring film that slides along x, by rows of other sliding.

    Parameters
    ----------
    pressure, film, fluidity : ndarray, shape (ny, nx)
        p, h and 1/eta [1].
    couette : ndarray, shape (ny,)
        Shear stress of sliding over tau0, times film and fluidity, of every row [1].
    sigma_x, sigma_y
        Stress drop over half the film over tau0, over film and difference of pressure between the
        nodes on both sides [1].
    factor_x, factor_y : ndarray, shape (ny, nx)
        Result [1]; 1 on the border.
    steepness, stiffness : ndarray, shape (ny, nx)
        d ln(flow)/d ln(dp/dx) and -d ln(flow)/d ln(eta) along x, as without dp/dy [1]; 1 where the
        film is Newtonian.
    """
    ny, nx = pressure.shape
    factor_x[:] = 1.0
    factor_y[:] = 1.0
    steepness[:] = 1.0
    stiffness[:] = 1.0
    for j in range(1, ny - 1):
        for i in range(1, nx - 1):
            h = film[j, i]
            if h <= 0.0:
                continue
            along = sigma_x * h * (pressure[j, i + 1] - pressure[j, i - 1])
            across = sigma_y * h * (pressure[j + 1, i] - pressure[j - 1, i])
            a = couette[j] / (h * fluidity[j, i])
            if max(abs(along), abs(across), abs(a)) < _NEWTONIAN:
                continue
            flow = eyring_flow(along, across, a, math.inf)
            factor_x[j, i] = flow.along
            factor_y[j, i] = flow.across
            S, by_sigma, by_a = eyring_flow_factor(along, a)
            steepness[j, i] = 1.0 + along * by_sigma / S
            stiffness[j, i] = 1.0 - a * by_a / S


@dataclass(slots=True)
class MovingState(FilmState):
    """State of a film that is open in places, with what flow factors add to its slopes."""

    closed: Flags | None = None  # where oil may be above ambient pressure
    steepness: Array | None = None  # d ln(flow)/d ln(dp/dx) [1]
    stiffness: Array | None = None  # -d ln(flow)/d ln(eta) [1]

    @property
    def free(self) -> Flags:
        """Return where the Reynolds equation holds: pressure, or a residual that calls for it."""
        free = (self.pressure > 0.0) | (self.residual > 0.0)
        return free if self.closed is None else free & self.closed


class MovingLevel(PointLevel):
    """Grid with surface speeds that vary across the motion, storage of oil and an Eyring film.

    The equation of a row is divided by nothing: its wedge is its own share of the speed of the
    scales. Entrainment points to larger x and not to smaller y.
    """

    def __init__(
        self,
        problem: PointContactProblem,
        scales: PointScales,
        shape: tuple[int, int],
        wedge: str,
    ) -> None:
        if scales.swap or scales.flip_x or problem.entrainment[1] != 0.0:
            raise ParameterError(
                "a film that changes in time must be entrained along x towards larger x, got "
                f"{problem.entrainment} m/s. Turn the axes."
            )
        super().__init__(problem, scales, shape, wedge)
        ny, nx = shape
        self.x: Array = np.linspace(*problem.x_limits, nx)
        self.y: Array = np.linspace(*problem.y_limits, ny)
        self.rate = np.ones((ny, 1))  # entrainment over the speed of the scales
        self.couette = np.zeros(ny)
        self.storage = np.zeros(shape)  # factor of rho h, per time of the scales
        tau0 = problem.lubricant.tau0
        self.closed: Flags | None = None
        self._shear = 0.0 if tau0 == 0.0 else scales.speed / (tau0 * scales.film)
        self._shear *= problem.lubricant.eta0
        drop = 0.0 if tau0 == 0.0 else scales.film * scales.pressure / (4.0 * tau0)
        self._sigma = drop / (self.dx * scales.length), drop / (self.dy * scales.length)

    def impose(self, conditions: FilmConditions) -> None:
        """Set gap, load and speeds; storage is kept."""
        check_positive("load", conditions.load, "N")
        mean = 0.5 * (conditions.speed_1 + conditions.speed_2)
        if not (mean > 0.0).all():
            raise ParameterError(
                "the mean of both surface speeds must be above 0 m/s on every row, got "
                f"{mean.min():.4g} m/s. Turn the x axis."
            )
        check_within("slope", conditions.slope, 0.0, _STEEPEST, "", "Turn the y axis or the axes.")
        scales = self.scales
        unit = scales.pressure * scales.length**2
        self.scales = replace(scales, load=conditions.load / unit)
        # of a row's own speed along x
        self.stencil = self.stencil._replace(wedge_y=conditions.slope / self.dy)
        self.flow_rate = self.stencil.wedge_x + self.stencil.wedge_y
        self.gap = np.ascontiguousarray(conditions.gap.T / scales.film)
        self.rate = (mean / scales.speed)[:, None]
        sliding = (conditions.speed_2 - conditions.speed_1) / scales.speed
        self.couette = self._shear * sliding

    def open_where_thicker(self, film: Array, limit: float) -> None:
        """Hold ambient pressure where a film [m over the unit of films] passes a limit [m]."""
        self.closed = film <= limit / self.scales.film

    def keep(self, storage: Array | float, source: Array | float) -> None:
        """Set storage and what earlier times give, both in units of the scales."""
        self.storage = np.broadcast_to(np.asarray(storage, dtype=np.float64), self.shape)
        self.source = np.ascontiguousarray(
            np.broadcast_to(np.asarray(source, dtype=np.float64), self.shape)
        )

    def state(self, pressure: Array, approach: float, film: Array | None = None) -> FilmState:
        """Return the state at a pressure, zero on the border, and an approach."""
        if self.closed is not None:
            pressure = np.where(self.closed, pressure, 0.0)
        if film is None:
            film = self.film(pressure, approach)
        viscosity, viscosity_slope, density, density_slope = np.empty((4, *self.shape))
        fill_properties(
            self.oil,
            pressure.ravel(),
            viscosity.ravel(),
            viscosity_slope.ravel(),
            density.ravel(),
            density_slope.ravel(),
        )
        mass = density * film
        cubic_x = density * np.maximum(film, 0.0) ** 3
        cubic_y = cubic_x
        fluidity, log_viscosity = 1.0 / viscosity, np.log(viscosity)
        steepness, stiffness = None, None
        if self._shear > 0.0:
            factor_x, factor_y, steepness, stiffness = np.empty((4, *self.shape))
            fill_shear_factors(
                pressure,
                film,
                fluidity,
                self.couette,
                *self._sigma,
                factor_x,
                factor_y,
                steepness,
                stiffness,
            )
            cubic_x, cubic_y = cubic_x * factor_x, cubic_x * factor_y
        residual = np.empty(self.shape)
        reynolds_residual(
            self.stencil,
            pressure,
            self.rate * mass,
            cubic_x,
            cubic_y,
            fluidity,
            log_viscosity,
            self.source,
            residual,
        )
        residual[1:-1, 1:-1] -= (self.storage * mass)[1:-1, 1:-1]
        load_error = (self.scales.load - self.cell * float(pressure.sum())) / self.scales.load
        return MovingState(
            pressure=pressure,
            approach=approach,
            film=film,
            mass=mass,
            density=density,
            fluidity=fluidity,
            density_slope=density_slope,
            viscosity_slope=viscosity_slope * fluidity,
            cubic_x=cubic_x,
            cubic_y=cubic_y,
            log_viscosity=log_viscosity,
            residual=residual,
            load_error=load_error,
            closed=self.closed,
            steepness=steepness,
            stiffness=stiffness,
        )

    def linearise(self, state: FilmState, squeeze: float = 0.0) -> Linearisation:
        """Return the derivatives of the residual at a state.

        Flow factors answer to slopes of pressure and to viscosity, not to the film.
        """
        assert isinstance(state, MovingState)
        carried = replace(
            state,
            density=self.rate * state.density,
            density_slope=self.rate * state.density_slope,
        )
        if carried.steepness is not None and carried.stiffness is not None:
            carried.cubic_x = state.cubic_x * carried.steepness
            carried.viscosity_slope = state.viscosity_slope * carried.stiffness
        linear = super().linearise(carried, squeeze)
        kept = np.where(linear.free, self.storage, 0.0)
        kept[[0, -1]] = 0.0
        kept[:, [0, -1]] = 0.0
        linear.by_pressure[CENTRE] -= kept * state.density_slope * state.film
        linear.by_film[CENTRE] -= kept * state.density
        linear.by_approach[:] = linear.by_film.sum(axis=0)
        return linear

    def outflow(self, state: FilmState) -> Array:
        """Return what flows into every node without storage and source."""
        return np.asarray(state.residual - self.source + self.storage * state.mass)
