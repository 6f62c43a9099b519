"""Temperatures of a film and of the two moving surfaces that bound it, on one grid."""

from __future__ import annotations

import math

import numpy as np
from scipy.sparse.linalg import LinearOperator, gmres

from gearlube_core.arrays import Array
from gearlube_core.contact.solid import Solid
from gearlube_core.ehl.line.energy import FilmFields, fill_thermal_oil
from gearlube_core.ehl.point.level import PointLevel
from gearlube_core.ehl.point.problem import PointContactProblem
from gearlube_core.ehl.point.terms.state import FilmState
from gearlube_core.ehl.point.thermal.anderson_mixing import AndersonMixing
from gearlube_core.ehl.point.thermal.energy import (
    PointFilm,
    PointHeat,
    PointMotion,
    add_surface_change,
    fill_heat,
    heat_balance,
    sweep_film,
)
from gearlube_core.ehl.point.thermal.moving_heat import MovingHeat
from gearlube_core.oil.roelands_1966 import GLASS_TEMPERATURE

_SURFACES_TOLERANCE = 0.02  # of one solution for the surfaces: others follow
_SURFACES_STEPS = 30
_SWEEPS = 3  # forth and back: oil that whirls in the inlet warms slowly
_BREAKING = 1e-6  # of the largest dry pressure, where half of the film counts as broken
_MIXED = 8  # turns
# temperatures of an iteration stay within, over that of the oil less the glass's at zero
_COLDEST, _HOTTEST = 0.3, 20.0


class FilmTemperature:
    """Temperatures on one grid, in the solver's order and in SI.

    Parameters
    ----------
    problem
        Contact with its `sliding`.
    solids
        Body 1 and body 2.
    level
        Grid.
    heights
        Points across the film.

    Attributes
    ----------
    T : ndarray, shape (n, heights)
        [K], n nodes in rows.
    flux : ndarray, shape (2, n)
        Into body 1 and body 2 [W/m2].
    heat : PointHeat
        Of shear.
    balance : float
        Heat that is not balanced over the heat made [-].
    """

    def __init__(
        self,
        problem: PointContactProblem,
        solids: tuple[Solid, Solid],
        level: PointLevel,
        heights: int,
    ) -> None:
        self.level, self.oil = level, problem.lubricant
        scales, (ny, nx) = level.scales, level.shape
        self.steps = level.grid.dx * scales.length, level.grid.dy * scales.length
        u, v = scales.along_axes(problem.entrainment)
        su, sv = scales.along_axes(problem.sliding or (0.0, 0.0))
        self.speed, self.sliding = scales.speed, math.hypot(su, sv)
        self.motion = PointMotion(
            u - 0.5 * su, v - 0.5 * sv, u + 0.5 * su, v + 0.5 * sv, *self.steps,
            problem.lubricant.temperature,
        )  # fmt: skip
        size = (su / self.sliding, sv / self.sliding) if self.sliding > 0.0 else None
        self.direction = size or (u / self.speed, v / self.speed)
        m = self.motion
        self.bodies = tuple(
            MovingHeat(solid, velocity, self.steps, (nx, ny))
            for solid, velocity in zip(solids, ((m.u_1, m.v_1), (m.u_2, m.v_2)), strict=True)
        )
        n = ny * nx
        self.T = np.full((n, heights), problem.lubricant.temperature)
        self.flux = np.zeros((2, n))
        self.heat = PointHeat(np.zeros((n, heights)), np.zeros(n), np.zeros(n), np.zeros(n))
        self.balance = math.inf
        self._mixing = AndersonMixing(_MIXED)
        self._conductance, self._shape = np.empty((3, n)), np.empty((2, n, heights))

    def film(self, state: FilmState) -> PointFilm:
        """Return what the balance takes from a state."""
        scales, oil = self.level.scales, self.oil
        p = state.oil * scales.pressure
        h = np.maximum(state.film * scales.film, 1e-12)
        p_y, p_x = (np.asarray(s) for s in np.gradient(p, self.steps[1], self.steps[0]))
        c, s = self.direction
        flow = state.film_flow
        mobility = h * h / (12.0 * oil.eta0)
        u, v = -mobility * flow.fluidity_x * p_x, -mobility * flow.fluidity_y * p_y
        u, v = state.shear.with_cross_velocity((u, v), mobility, state.fluidity, (p_x, p_y))
        # oil is not pumped back faster than it is carried in; where the grid says so it is coarse
        size = np.maximum(np.hypot(u, v) / self.speed, 1.0)
        rho = np.asarray(state.density * oil.rho0)
        along, across = np.asarray(c * p_x + s * p_y), np.asarray(c * p_y - s * p_x)
        # smooth where the film breaks: a node that turns dry and wet again would never settle
        wet = (p / (p + _BREAKING * scales.pressure)).ravel()
        return PointFilm(
            FilmFields(p.ravel(), along.ravel(), h.ravel(), rho.ravel(), wet, wet),
            across.ravel(),
            p_x.ravel(),
            p_y.ravel(),
            (u / size).ravel(),
            (v / size).ravel(),
        )

    def judge(self, film: PointFilm, everywhere: bool = False) -> None:
        """Set the heat of shear at these temperatures and how far it is balanced."""
        fill_heat(film, self.T, self.sliding, everywhere, self.oil, self.heat)
        nx = self.level.shape[1]
        lacking, made = heat_balance(film, self.motion, self.oil, self.heat, self.T, nx, self.flux)
        wrong = np.abs(self._surface_error()).sum(axis=1)
        lacking += sum(one / body.total for one, body in zip(wrong, self.bodies, strict=True))
        self.balance = lacking / made if made > 0.0 else math.inf

    def _rise(self, flux: Array) -> Array:
        """Return the surfaces' rise under heat into them, both (2, n), [K] and [W/m2]."""
        shape = self.level.shape
        pairs = zip(self.bodies, flux, strict=True)
        return np.array([body(q.reshape(shape)).ravel() for body, q in pairs])

    def _surface_error(self) -> Array:
        """Return what the surfaces' heat makes of them less their temperature, (2, n) [K]."""
        return np.asarray(self._rise(self.flux) + self.motion.temperature - self.T[:, [0, -1]].T)

    def turn(self, film: PointFilm) -> None:
        """Solve film and surfaces once, with the heat of `judge`, and mix with earlier turns."""
        before = self.T.copy()
        self._solve(film)
        self.T[:] = self._mixing(before, self.T)
        span = self.motion.temperature - GLASS_TEMPERATURE
        low, high = (GLASS_TEMPERATURE + share * span for share in (_COLDEST, _HOTTEST))
        np.clip(self.T, low, high, out=self.T)

    def _solve(self, film: PointFilm) -> None:
        nx = self.level.shape[1]
        for way in (False, True) * _SWEEPS:
            sweep_film(
                film, self.motion, self.oil, self.heat, nx, way, way, self.T, self.flux,
                self._conductance, self._shape,
            )  # fmt: skip
        error = self._surface_error()

        def applied(change: Array) -> Array:
            one, two = change.reshape(2, -1)
            own_1, both, own_2 = self._conductance
            flux = np.array((own_1 * one - both * two, own_2 * two - both * one))
            return np.asarray(change + self._rise(flux).ravel())

        change, _ = gmres(
            LinearOperator((error.size, error.size), matvec=applied, dtype=np.float64),
            error.ravel(),
            rtol=_SURFACES_TOLERANCE,
            restart=_SURFACES_STEPS,
            maxiter=1,
        )
        add_surface_change(change.reshape(2, -1), self._shape, self.T)

    def factors(self, film: PointFilm) -> tuple[Array, Array]:
        """Return the thermal factors of viscosity and density, both (ny, nx) [-]."""
        cooling, dilation = np.empty((2, *self.level.shape))
        p = film.along.p
        fill_thermal_oil(
            p, self.T, self.heat.viscosity, self.oil, cooling.ravel(), dilation.ravel()
        )
        return cooling, dilation
