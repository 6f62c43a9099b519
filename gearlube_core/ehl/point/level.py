"""One grid of a point contact with its film: gap, residual and derivatives from composed terms."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace

import numpy as np

from gearlube_core.arrays import Array, Flags
from gearlube_core.ehl.point.equations.grid import PointGrid
from gearlube_core.ehl.point.equations.stencil import Grading, StencilParameters
from gearlube_core.ehl.point.problem import PointContactProblem
from gearlube_core.ehl.point.scaling import PointScales
from gearlube_core.ehl.point.settings import WEDGE_WEIGHTS
from gearlube_core.ehl.point.terms.boundary import AmbientBorder
from gearlube_core.ehl.point.terms.differences import Differences
from gearlube_core.ehl.point.terms.elements import Elements
from gearlube_core.ehl.point.terms.film_terms import FilmTerms
from gearlube_core.ehl.point.terms.linearisation import Linearisation
from gearlube_core.ehl.point.terms.state import Balance, FilmState
from gearlube_core.kernels.row_workers import RowWorkers

Scheme = Differences | Elements
DISCRETE: dict[str, Callable[[PointGrid], Scheme]] = {
    "differences": Differences,
    "elements": Elements,
}


class PointLevel:
    """Grid of shape (ny, nx) with the discrete equations of a problem.

    Parameters
    ----------
    problem, scales, shape
        Contact, its units, rows and columns without copied rows.
    wedge
        Stencil of the wedge.
    grading
        Of the spacing along x, for entrainment along x; None: uniform.
    scheme
        Makes the discrete Reynolds equation of a grid.
    cavitation
        Cavitation model: "reynolds" or "mass_conserving".

    Attributes
    ----------
    shape : tuple
        Rows, copied ones included, and columns.
    grid : PointGrid
        Nodes, cells and deflection.
    terms : FilmTerms
        What acts in the film.
    stencil : StencilParameters
        Constants of the discrete equation, those of a continuation included.
    gap : ndarray, shape (ny, nx)
        Of the undeformed solids [-].
    load : float
        Integral of the pressure that balances the load [-].
    half_width : float
        Of the dry contact across the entrainment [-].
    """

    def __init__(
        self,
        problem: PointContactProblem,
        scales: PointScales,
        shape: tuple[int, int],
        wedge: str,
        grading: Grading | None = None,
        *,
        scheme: Callable[[PointGrid], Scheme] = Differences,
        cavitation: str = "reynolds",
    ) -> None:
        self.scales, self.load = scales, scales.load
        self.grid = grid = PointGrid(problem, scales, shape, grading)
        self.shape = grid.shape
        x, y = grid.x, grid.y
        gap = np.broadcast_to(problem.gap(x[:, None], y[None, :]), (x.size, y.size))
        gap = scales.inward(np.asarray(gap, dtype=np.float64) / scales.film)
        self.gap = grid.sides.extended(gap)
        u, v = (abs(component) / scales.speed for component in problem.entrainment)
        semi_x, semi_y, _ = problem.hertz_contact
        if scales.swap:
            u, v, semi_x, semi_y = v, u, semi_y, semi_x
        self.half_width = math.hypot(u * semi_y, v * semi_x) / scales.length
        self._scheme = scheme(grid)
        self._weights = here, upstream, downstream = WEDGE_WEIGHTS[self._scheme.wedge(wedge)]
        least, most = self._scheme.face_limits
        self.stencil = StencilParameters(
            poiseuille_x=scales.mobility / grid.dx**2,
            poiseuille_y=scales.mobility / grid.dy**2,
            wedge_x=u / grid.dx,
            wedge_y=v / grid.dy,
            here=here,
            upstream=upstream,
            downstream=downstream,
            squeeze=0.0,
            least=least,
            most=most,
        )
        sliding = None if problem.sliding is None else scales.along_axes(problem.sliding)
        self.terms = FilmTerms.of(problem, scales, grid, sliding, cavitation)

    @property
    def flow_rate(self) -> float:
        """Return the flow through a cell over its film [-]."""
        return self.stencil.wedge_x + self.stencil.wedge_y

    def set_boundary(self, boundary: AmbientBorder) -> None:
        """Set where the oil is held at ambient pressure."""
        self.terms = replace(self.terms, boundary=boundary)

    def set_thermal_factors(self, viscosity: Array, density: Array) -> None:
        """Set the factors of viscosity and density by heat, of shape (ny, nx) [-]."""
        oil, shear = self.terms.oil.heated(viscosity, density), self.terms.shear.heated(viscosity)
        self.terms = replace(self.terms, oil=oil, shear=shear)

    def set_inlet_layer(self, layer: float) -> None:
        """Set the film on the upstream border [-]; infinite: full."""
        cavitation = self.terms.cavitation.with_inlet_layer(layer)
        self.terms = replace(self.terms, cavitation=cavitation)

    def set_workers(self, workers: RowWorkers) -> None:
        """Set who share the work on rows; results do not depend on it."""
        self.grid.set_workers(workers)
        self.terms = replace(self.terms, shear=self.terms.shear.with_workers(workers))

    def set_load(self, load: float) -> None:
        """Set the integral of the pressure that balances the load [-]."""
        self.load = load

    def set_continuation(self, mobility: float, order: float) -> None:
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
        self.set_boundary(self.terms.boundary.with_viscosity(1.0 / mobility))
        self.stencil = self.stencil._replace(
            poiseuille_x=poiseuille / self.grid.dx**2,
            poiseuille_y=poiseuille / self.grid.dy**2,
            here=here + 1.0 - order,
            upstream=upstream,
            downstream=downstream,
        )

    # [jamali_2015 (3.2)] [jamali_2015 (3.15)]
    def film(self, pressure: Array, approach: float) -> Array:
        """Return h = h_0 + h_u + deflection, shape (ny, nx) [-]."""
        return self.grid.deflection(pressure) + self.gap + approach

    def state(self, pressure: Array, approach: float, film: Array | None = None) -> FilmState:
        """Return the state at a pressure, not counted on the border, and an approach.

        Parameters
        ----------
        pressure : ndarray, shape (ny, nx)
            p [-].
        approach
            h_0 [-].
        film : ndarray, shape (ny, nx), or None
            Given where it is known [-].
        """
        terms = self.terms
        pressure = terms.boundary.impose(pressure, approach)
        load = self.load - terms.boundary.load(approach)[0]
        if film is None:
            film = self.film(pressure, approach)
        contact = terms.solids.share(pressure, film, self.flow_rate)
        eta, eta_slope, density, density_slope = terms.oil.properties(contact.oil)
        cubic = density * np.maximum(film, 0.0) ** 3
        fluidity = 1.0 / eta
        shear = terms.shear.factors(contact.oil, film, fluidity)
        state = FilmState(
            pressure=pressure,
            approach=approach,
            film=film,
            mass=density * film,
            density=density,
            fluidity=fluidity,
            density_slope=density_slope,
            viscosity_slope=eta_slope * fluidity,
            cubic=cubic,
            cubic_x=shear.cubic_x(cubic),
            cubic_y=shear.cubic_y(cubic),
            log_viscosity=np.log(eta),
            residual=np.empty(self.shape),
            load_error=(load - self.grid.integral(pressure)) / self.load,
            shear=shear,
            boundary=terms.boundary,
            contact=contact,
            ruptured=terms.cavitation.full,
        )
        carried = terms.entrainment.carried(state.mass)
        self._scheme.residual(self.stencil, state, carried, terms.storage.released(state.mass))
        terms.cavitation.add_residual(state, self._balance(self.stencil))
        return state

    def linearise(
        self, state: FilmState, squeeze: float = 0.0, rows: Flags | None = None
    ) -> Linearisation:
        """Return the derivatives of the residual at a state.

        Parameters
        ----------
        state
            Pressure and film state.
        squeeze
            Rate of rho h that is added, which the residual does not contain [-].
        rows : ndarray of bool, shape (ny, nx), or None
            Nodes whose equations are wanted; None: those where pressure is free.

        Notes
        -----
        The derivatives are complete: flow factors depend on the slopes of pressure along and
        across sliding, on viscosity, on the film and on the limiting stress. Which of two rules
        holds at a face, a limit or a side of the upwinding, is taken as it is.
        """
        terms = self.terms
        free = state.free if rows is None else rows
        entrainment = terms.entrainment
        density = entrainment.carried(state.density), entrainment.carried(state.density_slope)
        stencil = self.stencil._replace(squeeze=self.stencil.squeeze + squeeze)
        offsets, by_pressure, by_film = self._scheme.derivatives(
            stencil,
            state,
            density,
            terms.cavitation.rows(free, state),
            entrainment.rows,
            terms.storage,
        )
        linear = Linearisation(
            offsets,
            by_pressure,
            by_film,
            by_approach=np.empty(self.shape),
            free=free,
            right=np.where(free, -state.residual, 0.0),
            result=np.empty(self.shape),
            centre=self._scheme.centre,
            sides=self.grid.sides,
            workers=self.grid.workers,
        )
        terms.cavitation.add_derivatives(linear, state, self._balance(stencil))
        state.contact.add_derivatives(linear, state.residual)
        linear.sum_by_approach()
        terms.boundary.add_derivatives(linear, state.approach, self.grid, self.load)
        return linear

    def _balance(self, stencil: StencilParameters) -> Balance:
        return Balance(stencil, self.terms.entrainment.rows, self.terms.storage.rate)

    def apply(
        self,
        linear: Linearisation,
        pressure: Array,
        approach: float,
        deflection: Callable[[Array], Array] | None = None,
    ) -> Array:
        """Return the change of the residual under changes of pressure and approach, (ny, nx).

        `deflection` may be a rougher one. The result is overwritten by the next call with the
        same `linear`.
        """
        return linear.apply(pressure, approach, deflection or self.grid.deflection)
