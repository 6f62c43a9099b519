"""Temperatures of a film and of the two moving surfaces that bound it, on one grid."""

from __future__ import annotations

import math

import numpy as np
import scipy.fft
from scipy.sparse.linalg import LinearOperator, gmres
from scipy.special import erf

from gearlube_core.arrays import Array
from gearlube_core.checks import check_finite, check_positive
from gearlube_core.contact.solid import Solid
from gearlube_core.ehl.line.energy import FilmFields, fill_thermal_oil
from gearlube_core.ehl.point.level import PointLevel
from gearlube_core.ehl.point.problem import PointContactProblem
from gearlube_core.ehl.point.terms.state import FilmState
from gearlube_core.ehl.point.thermal.energy import (
    PointFilm,
    PointHeat,
    PointMotion,
    add_surface_change,
    fill_heat,
    heat_balance,
    sweep_film,
)
from gearlube_core.oil.roelands_1966 import GLASS_TEMPERATURE

_POINTS = 4  # of Gauss and Legendre between two times
_GROWTH = 1.6  # of the times where nothing else divides them
_FIRST = 1e-4  # of the time in which heat crosses a cell by conduction
_LAST = 1e7  # of the time in which it crosses the grid
_SMEARED = 4.0  # diffusion lengths (4 kappa t)^(1/2) behind the grid at which heat has left it
_SURFACES_TOLERANCE = 0.02  # of one solution for the surfaces: others follow
_SURFACES_STEPS = 30
_SWEEPS = 3  # forth and back: oil that whirls in the inlet warms slowly
_BREAKING = 1e-6  # of the largest dry pressure, where half of the film counts as broken
_MIXED = 8  # turns
# temperatures of an iteration stay within, over that of the oil less the glass's at zero
_COLDEST, _HOTTEST = 0.3, 20.0


class AndersonMixing:
    """Next value of x = g(x) from the last ones: what the least change of x = g(x) asks for.

    Parameters
    ----------
    depth
        Turns that are mixed, besides the last one.

    Notes
    -----
    x_next = g_k - sum over j of gamma_j (g_j+1 - g_j), where the sum of gamma_j (f_j+1 - f_j) is
    nearest to f_k = g_k - x_k. Source: [anderson_1965]; [walker_ni_2011], type II.
    """

    def __init__(self, depth: int) -> None:
        self._depth = depth
        self._values: list[Array] = []
        self._misses: list[Array] = []

    def __call__(self, before: Array, after: Array) -> Array:
        """Return the next value from the one before a turn and the one after it."""
        self._values.append(after.copy())
        self._misses.append(after - before)
        del self._values[: -self._depth - 1], self._misses[: -self._depth - 1]
        miss = self._misses[-1]
        changes = [later - earlier for earlier, later in zip(self._misses, self._misses[1:],
                                                             strict=False)]  # fmt: skip
        if not changes:
            return after
        table = np.array([[np.vdot(a, b) for b in changes] for a in changes])
        right = np.array([np.vdot(a, miss) for a in changes])
        # equations as they are scaled: old turns are larger by orders of magnitude
        scale = 1.0 / np.sqrt(np.maximum(np.diag(table), 1e-300))
        share = np.linalg.lstsq(table * np.outer(scale, scale), right * scale, rcond=1e-12)[0]
        mixed = after.copy()
        for weight, earlier, later in zip(share * scale, self._values, self._values[1:],
                                          strict=False):  # fmt: skip
            mixed -= weight * (later - earlier)
        return np.asarray(mixed)


def _times(steps: tuple[float, float], counts: tuple[int, int], velocity: tuple[float, float],
           diffusivity: float) -> Array:  # fmt: skip
    """Return times [s] between which the temperature of every cell is smooth, from zero on.

    Heat of a cell reaches and leaves the others where edges meet: those times are among them.
    """
    extent = max(step * count for step, count in zip(steps, counts, strict=True))
    first = _FIRST * min(steps) ** 2 / diffusivity
    last = _LAST * extent**2 / diffusivity
    edges: list[Array] = [np.zeros(1)]
    for step, count, speed in zip(steps, counts, velocity, strict=True):
        if speed == 0.0:
            continue
        # behind the grid by several diffusion lengths: |u| t = extent + s (4 kappa t)^(1/2)
        smear = _SMEARED * math.sqrt(4.0 * diffusivity)
        root = (smear + math.sqrt(smear**2 + 4.0 * abs(speed) * step * count)) / (2.0 * abs(speed))
        last = min(last, root * root)
        edges.append(np.asarray((np.arange(count) + 0.5) * step / abs(speed)))
    number = max(2, math.ceil(math.log(last / first) / math.log(_GROWTH)))
    edges.append(np.asarray(np.geomspace(first, last, number)))
    times = np.unique(np.concatenate(edges))
    return times[times <= last]


def moving_heat_coefficients(
    solid: Solid, velocity: tuple[float, float], steps: tuple[float, float], counts: tuple[int, int]
) -> Array:
    """Return the rise of a surface at all offsets from a cell with unit heat per area.

    dT(x, y) = integral over t > 0 of dt/(rho c (pi kappa t)^(1/2)) X(t) Y(t),
    X = [erf((x + a - u t)/s) - erf((x - a - u t)/s)]/2,  s = (4 kappa t)^(1/2), Y alike

    Parameters
    ----------
    solid
        Density, conductivity, heat capacity.
    velocity
        Of the surface along x and y against the cells [m/s], any sign, zero included.
    steps
        Sides 2a and 2b of a cell along x and y [m].
    counts
        Cells along x and y.

    Returns
    -------
    ndarray, shape (2 ny - 1, 2 nx - 1)
        [K m2/W]; entry (ny - 1 + j, nx - 1 + i) at the centre of the cell i steps along x and j
        along y from the heated one.

    Notes
    -----
    Steady, in the frame of the cells, and exact for any Peclet number: conduction along the
    surface is contained. The integrand is a product of functions of x and of y, so that all
    offsets follow from one product of matrices; quadrature between the times where edges of
    cells meet leaves less than 1e-6 of the largest rise. At rest, what comes after 1e7 crossing
    times is left out, 1e-4 of a plate's. Source: [carslaw_jaeger_1959 sec. 10.3]
    [carslaw_jaeger_1959 sec. 10.7].
    """
    for axis, speed, step in zip("xy", velocity, steps, strict=True):
        check_finite(f"velocity along {axis}", speed, "m/s")
        check_positive(f"d{axis}", step, "m")
    diffusivity = solid.conductivity / (solid.density * solid.heat_capacity)
    roots = np.sqrt(_times(steps, counts, velocity, diffusivity))
    nodes, weights = np.polynomial.legendre.leggauss(_POINTS)
    half = 0.5 * np.diff(roots)
    root = (half[:, None] * nodes + (0.5 * (roots[1:] + roots[:-1]))[:, None]).ravel()
    weight = (half[:, None] * weights).ravel()
    # dt/t^(1/2) = 2 d(t^(1/2))
    weight *= 2.0 / (solid.density * solid.heat_capacity * math.sqrt(math.pi * diffusivity))
    parts = []
    for speed, step, count in zip(velocity, steps, counts, strict=True):
        edge = (np.arange(2 * count) - count + 0.5) * step
        passed = erf((edge - speed * root[:, None] ** 2) / (math.sqrt(4.0 * diffusivity)
                                                           * root[:, None]))  # fmt: skip
        parts.append(0.5 * np.diff(passed, axis=1))
    along, across = parts
    return np.asarray((weight[:, None] * across).T @ along)


class MovingHeat:
    """Rise of a moving surface under heat on a grid, by FFT.

    Parameters
    ----------
    solid, velocity, steps, counts
        As in `moving_heat_coefficients`.
    """

    def __init__(
        self,
        solid: Solid,
        velocity: tuple[float, float],
        steps: tuple[float, float],
        counts: tuple[int, int],
    ) -> None:
        nx, ny = counts
        coefficients = moving_heat_coefficients(solid, velocity, steps, counts)
        self.total = float(coefficients.sum())
        self._padded = tuple(scipy.fft.next_fast_len(2 * n - 1, real=True) for n in (ny, nx))
        self._first = (ny - 1, nx - 1)
        self._transfer = scipy.fft.rfft2(coefficients, self._padded)

    def __call__(self, flux: Array) -> Array:
        """Return the rise [K] under a flux into the body [W/m2], both of shape (ny, nx)."""
        ny, nx = flux.shape
        spectrum = scipy.fft.rfft2(flux, self._padded)
        spectrum *= self._transfer
        rise = scipy.fft.irfft2(spectrum, self._padded)
        # cyclic: the offset of the middle is turned back to zero
        j, i = self._first
        return np.ascontiguousarray(np.roll(rise, (-j, -i), axis=(0, 1))[:ny, :nx])


class FilmTemperature:
    """Temperatures on one grid, in the solver's order and in SI.

    Parameters
    ----------
    problem
        Contact with its `sliding`.
    solids
        Body 1 and body 2.
    level
        Grid level with its equations.
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
        """Return the inputs of the balance from a state."""
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
        """Return surface temperatures by heat less the present ones, (2, n) [K]."""
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
