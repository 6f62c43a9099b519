"""One grid of a point contact: its gap, deflection, residual and linearised operator."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.contact.half_space import HalfSpaceConvolution, love_coefficients
from gearlube_core.contact.half_space_graded import GradedConvolution, graded_coefficients
from gearlube_core.ehl.flow.film_properties import film_properties
from gearlube_core.ehl.point.border.open_border import OpenBorder
from gearlube_core.ehl.point.equations.cross_flow import add_cross_flow
from gearlube_core.ehl.point.equations.derivatives import flow_derivatives
from gearlube_core.ehl.point.equations.fill import BrokenFilm
from gearlube_core.ehl.point.equations.film_shear import FilmShear
from gearlube_core.ehl.point.equations.mesh import (
    Grading,
    cell_faces,
    central_metric,
    mesh_metric,
    x_nodes,
)
from gearlube_core.ehl.point.equations.solids import add_solids, solid_share
from gearlube_core.ehl.point.equations.state import FilmState, Flags, Linearisation, Offsets
from gearlube_core.ehl.point.equations.stencil import (
    CENTRE,
    FlowSlopes,
    MeshMetric,
    StencilParameters,
    apply_derivatives,
    reynolds_residual,
)
from gearlube_core.ehl.point.problem import PointContactProblem
from gearlube_core.ehl.point.scaling import PointScales
from gearlube_core.ehl.point.settings import WEDGE_WEIGHTS
from gearlube_core.ehl.point.solid_contact import SolidLayer
from gearlube_core.oil.film_oil import EhlLubricant

# rho h at a face over that of the node upstream of it; reached where the film halves in a cell
_LEAST_FACE = 0.5
_MOST_FACE = 2.0


class PointLevel:
    """Grid of shape (ny, nx) with the discrete equations of a problem.

    Parameters
    ----------
    problem, scales, shape
        Contact, its units, rows and columns.
    wedge
        Stencil of the wedge.
    grading
        Of the spacing along x, for entrainment along x; None: uniform.

    Attributes
    ----------
    dx, dy : float
        Spacing; the smallest along x.
    metric : MeshMetric
        Spacing along x against dx.
    cell : float
        dx dy.
    rate : ndarray, shape (ny, 1), or None
        Entrainment of every row over that of the problem; None: 1.
    storage : ndarray, shape (ny, nx), or None
        Rate at which rho h is stored, per time of the scales; None: 0.
    source : ndarray, shape (ny, nx)
        What is stored already.
    closed : ndarray of bool, shape (ny, nx), or None
        Where oil may be above ambient pressure; None: everywhere.
    shear : FilmShear or None
        Of an Eyring film.
    border : OpenBorder or None
        Where the oil goes on; None: ambient pressure on the border.
    warm : tuple of ndarray, shapes (ny, nx), or None
        Factors by heat, see `film_properties`; None: 1.
    solids : SolidLayer or None
        Of solids that touch where the film is thin; None: they never do.
    broken : BrokenFilm or None
        Of mass-conserving cavitation; None: broken film holds what its gap holds.
    """

    _centre = CENTRE  # of the neighbours

    def __init__(
        self,
        problem: PointContactProblem,
        scales: PointScales,
        shape: tuple[int, int],
        wedge: str,
        grading: Grading | None = None,
    ) -> None:
        self.shape = ny, nx = shape
        self.scales = scales
        nodes = (ny, nx) if scales.swap else (nx, ny)
        x = x_nodes(problem.x_limits, nodes[0], grading)
        y = np.linspace(*problem.y_limits, nodes[1])
        gap = np.broadcast_to(problem.gap(x[:, None], y[None, :]), nodes)
        self.gap = scales.inward(np.asarray(gap, dtype=np.float64) / scales.film)
        step_x, step_y = float(np.diff(x).min()) if grading else x[1] - x[0], y[1] - y[0]
        if scales.swap:
            step_x, step_y = step_y, step_x
        self.dx, self.dy = step_x / scales.length, step_y / scales.length
        u, v = (abs(component) / scales.speed for component in problem.entrainment)
        if scales.swap:
            u, v = v, u
        semi_x, semi_y, _ = problem.hertz_contact
        across = (
            math.hypot(u * semi_y, v * semi_x)
            if not scales.swap
            else math.hypot(u * semi_x, v * semi_y)
        )
        self.half_width = across / scales.length
        self.oil: EhlLubricant = scales.oil(problem.lubricant)
        self.modulus = problem.contact_modulus * scales.film / (scales.pressure * scales.length)
        self.positions = x / scales.length if grading else np.arange(nx) * self.dx
        self.graded = grading is not None
        if grading is not None:
            self.metric = mesh_metric(self.positions, self.dx)
            self.coefficients = graded_coefficients(
                cell_faces(self.positions), self.positions, self.dy, ny, self.modulus
            )
        else:
            self.metric = MeshMetric(np.ones(nx), np.ones(nx))
            self.coefficients = love_coefficients(self.dy, self.dx, ny, nx, 1.0) * (
                self.dx * self.dy / self.modulus
            )
        self.deflection = self.convolution()
        self._weights = here, upstream, downstream = WEDGE_WEIGHTS[wedge]
        self.stencil = StencilParameters(
            poiseuille_x=scales.mobility / self.dx**2,
            poiseuille_y=scales.mobility / self.dy**2,
            wedge_x=u / self.dx,
            wedge_y=v / self.dy,
            here=here,
            upstream=upstream,
            downstream=downstream,
            squeeze=0.0,
            least=_LEAST_FACE,
            most=_MOST_FACE,
        )
        self.rate: Array | None = None
        self.storage: Array | None = None
        self.source = np.zeros(shape)
        self.closed: Flags | None = None
        self.shear: FilmShear | None = None
        self.border: OpenBorder | None = None
        # powers of film and fluidity in the flow by pressure
        self._newtonian = np.full(shape, 3.0), np.ones(shape)
        self._aligned = np.zeros(shape)  # no cross flow
        if problem.lubricant.tau0 > 0.0 and problem.sliding is not None:
            self.shear = self._film_shear(problem, scales.turned(problem.sliding))
        self.warm: tuple[Array, Array] | None = None
        self.broken: BrokenFilm | None = None
        self.solids: SolidLayer | None = None
        if (solids := problem.solids) is not None:
            unit = scales.film, scales.pressure
            self.solids = SolidLayer(solids.thickness / unit[0], solids.pressure / unit[1])
        self.cell = self.dx * self.dy
        self.flow_rate = self.stencil.wedge_x + self.stencil.wedge_y
        self.cells = self.cell / self.metric.narrow
        self._dense: Array | None = None

    def open_border(self, border: OpenBorder) -> None:
        """Let the oil go on beyond the border."""
        self.border, self.closed = border, border.inside

    def convolution(self, single: bool = False) -> HalfSpaceConvolution | GradedConvolution:
        """Return the deflection under unit pressure, in float32 for preconditioners."""
        kind = GradedConvolution if self.graded else HalfSpaceConvolution
        return kind(self.coefficients, single=single)

    @property
    def own_deflection(self) -> Array:
        """Return the deflection of nodes under unit pressure on their own cell, (ny, nx)."""
        own = self.coefficients[0].diagonal() if self.graded else self.coefficients[0, 0]
        return np.broadcast_to(own, self.shape)

    def integral(self, values: Array) -> float:
        """Return the sum of values times the areas of their cells; shape (ny, nx)."""
        return float(values.sum(axis=0) @ self.cells)

    def _film_shear(self, problem: PointContactProblem, sliding: tuple[float, float]) -> FilmShear:
        """Return the constants of a film that slides along the axes of the grid [m/s]."""
        scales = self.scales
        return FilmShear.of(
            problem.lubricant,
            sliding,
            (self.dx * scales.length, self.dy * scales.length),
            self.shape[0],
            film=scales.film,
            pressure=scales.pressure,
            viscosity=problem.lubricant.eta0,
            central=central_metric(self.positions, self.dx) if self.graded else None,
        )

    def dense_deflection(self) -> Array:
        """Return the matrix of deflection per unit pressure, shape (ny nx, ny nx)."""
        if self._dense is None:
            rows, columns = (n.ravel() for n in np.indices(self.shape))
            apart = abs(columns[:, None] - columns)
            along = (columns[:, None], columns) if self.graded else (apart,)
            self._dense = self.coefficients[(abs(rows[:, None] - rows), *along)]
        return self._dense

    # film: [jamali_2015 (3.2)] [jamali_2015 (3.15)]
    def film(self, pressure: Array, approach: float) -> Array:
        """Return h = h_0 + h_u + deflection, shape (ny, nx)."""
        return self.deflection(pressure) + self.gap + approach

    def state(self, pressure: Array, approach: float, film: Array | None = None) -> FilmState:
        """Return the state at a pressure, not counted on the border, and an approach."""
        if self.closed is not None:
            pressure = np.where(self.closed, pressure, 0.0)
        load = self.scales.load
        if self.border is not None:
            pressure = self.border.impose(pressure, approach)
            load -= self.border.load(approach)[0]
        if film is None:
            film = self.film(pressure, approach)
        solids = solid_share(self.solids, pressure, film, self.flow_rate)
        oil = pressure if solids is None else solids.oil
        eta, eta_slope, density, density_slope = film_properties(self.oil, oil, self.warm)
        cubic = density * np.maximum(film, 0.0) ** 3
        fluidity, shear = 1.0 / eta, None
        cubic_x, cubic_xy, cubic_y = cubic, None, cubic
        if self.shear is not None:
            shear = self.shear.factors(oil, film, fluidity)
            cubic_x, cubic_y = cubic * shear.xx, cubic * shear.yy
            cubic_xy = None if shear.xy is None else cubic * shear.xy
        state = FilmState(
            pressure=pressure,
            approach=approach,
            film=film,
            mass=density * film,
            density=density,
            fluidity=fluidity,
            density_slope=density_slope,
            viscosity_slope=eta_slope * fluidity,
            cubic_x=cubic_x,
            cubic_y=cubic_y,
            log_viscosity=np.log(eta),
            residual=np.empty(self.shape),
            load_error=(load - self.integral(pressure)) / self.scales.load,
            cubic_xy=cubic_xy,
            shear=shear,
            closed=self.closed,
            solids=solids,
        )
        self._balance(state, state.mass if self.rate is None else self.rate * state.mass)
        if self.storage is not None:
            state.residual[1:-1, 1:-1] -= (self.storage * state.mass)[1:-1, 1:-1]
        if self.broken is not None:
            self.broken.settle(self.stencil, self.rate, self.storage, state)
        return state

    def _balance(self, state: FilmState, carried: Array) -> None:
        """Write the residual without storage; `carried` is rho h times the share of the speed."""
        flow, cross = state.film_flow, state.cross
        reynolds_residual(
            self.stencil, self.metric, state.oil, carried, flow, self.source, state.residual
        )
        if cross is not None:
            add_cross_flow(self.stencil, self.metric, state.oil, flow, cross, state.residual)

    def ease(self, mobility: float, order: float) -> None:
        """Set an easier problem of a continuation.

        Parameters
        ----------
        mobility
            Multiple of the problem's; below 1 the film is thicker [-].
        order
            1 the chosen wedge stencil, 0 the first-order one, linear between [-].
        """
        here, upstream, downstream = (order * weight for weight in self._weights)
        poiseuille = mobility * self.scales.mobility
        if self.border is not None:
            self.border.thickening = 1.0 / mobility
        self.stencil = self.stencil._replace(
            poiseuille_x=poiseuille / self.dx**2,
            poiseuille_y=poiseuille / self.dy**2,
            here=here + 1.0 - order,
            upstream=upstream,
            downstream=downstream,
        )

    def linearise(
        self, state: FilmState, squeeze: float = 0.0, rows: Flags | None = None
    ) -> Linearisation:
        """Return the derivatives of the residual at a state, where pressure is free or in `rows`.

        Flow factors answer to slopes of pressure along sliding, to viscosity and to the film.
        `squeeze` adds a rate of rho h that the residual does not contain.
        """
        free, told, shear = state.free if rows is None else rows, state, state.shear
        by_pressure, cubic = state.density_slope / state.density, state.cubic_x
        slopes = FlowSlopes(cubic, state.cubic_y, self._aligned, by_pressure, *self._newtonian)
        if shear is not None:
            cubic = state.density * np.maximum(state.film, 0.0) ** 3
            slopes = shear.slopes(cubic, by_pressure, state.viscosity_slope)
        if self.rate is not None:
            told = replace(
                state,
                density=self.rate * state.density,
                density_slope=self.rate * state.density_slope,
            )
        stencil = self.stencil._replace(squeeze=self.stencil.squeeze + squeeze)
        wanted = free if state.ruptured is None else free | state.ruptured
        offsets, by_pressure, by_film = self._derivatives(stencil, told, slopes, wanted)
        if self.storage is not None:
            kept = np.where(free, self.storage, 0.0)
            kept[[0, -1]] = 0.0
            kept[:, [0, -1]] = 0.0
            centre = self._centre
            by_pressure[centre] -= kept * state.density_slope * state.film
            by_film[centre] -= kept * state.density
        carriage = None
        if self.broken is not None:
            carriage = self.broken.linearise(
                stencil, self.rate, self.storage, state, free, by_pressure, by_film
            )
        right = np.where(free, -state.residual, 0.0)
        if state.solids is not None:
            free |= add_solids(
                state.solids,
                state.residual,
                offsets[: by_film.shape[0]],
                by_pressure,
                by_film,
                right,
                self._centre,
            )
        by_approach = by_film.sum(axis=0)
        if carriage is not None:
            carriage.pass_on(by_approach)
        result = np.empty(self.shape)
        linear = Linearisation(
            offsets, by_pressure, by_film, by_approach, free, right, result, carriage=carriage
        )
        if self.border is not None:
            rise = self.border.slope(state.approach)
            beyond = self.border.load(state.approach)[1]
            linear.load_by_approach = (self.integral(rise) + beyond) / self.scales.load
            linear.by_approach = by_approach + self.apply(linear, rise, 0.0)
        return linear

    def _derivatives(
        self, stencil: StencilParameters, state: FilmState, slopes: FlowSlopes, free: Flags
    ) -> tuple[Offsets, Array, Array]:
        """Return steps to the neighbours and derivatives with respect to pressure and film."""
        return flow_derivatives(stencil, self.metric, state, slopes, free)

    def apply(
        self,
        linear: Linearisation,
        pressure: Array,
        approach: float,
        deflection: Callable[[Array], Array] | None = None,
    ) -> Array:
        """Return the change of the residual under changes of pressure and approach.

        `deflection` may be a rougher one. The result is overwritten by the next call with the
        same `linear`.
        """
        apply_derivatives(
            linear.offsets,
            linear.by_pressure,
            linear.by_film,
            pressure,
            (deflection or self.deflection)(pressure),
            linear.result,
        )
        if linear.carriage is not None:
            linear.carriage.pass_on(linear.result)
        if approach != 0.0:
            linear.result += approach * linear.by_approach
        return linear.result
