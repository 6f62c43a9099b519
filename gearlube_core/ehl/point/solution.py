"""Result of a point contact with its convergence status."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.ehl.grid_error import FilmError, FilmNumbers, formal_order
from gearlube_core.ehl.point.equations.stencil import StencilParameters, face_weights
from gearlube_core.ehl.point.level import PointLevel
from gearlube_core.ehl.point.newton.newton import NewtonRecord, flow_residual
from gearlube_core.ehl.point.problem import PointContactProblem
from gearlube_core.ehl.point.settings import PointSolverSettings, Sides
from gearlube_core.ehl.point.solid_contact import SolidLoad
from gearlube_core.ehl.point.terms.state import FilmState
from gearlube_core.ehl.point.traction import point_traction
from gearlube_core.ehl.thin_film import thin_film_sentence
from gearlube_core.kernels.jit import kernel

_CURE = "Take more nodes where the film is thin, upwind-1 to start from, or a lower load first."
_LIMITED = 0.01  # share of first-order faces worth a word


@kernel
def limited_faces(
    parameters: StencilParameters, pressure: np.ndarray, mass: np.ndarray
) -> tuple[int, int]:
    """Return how many faces next to pressure are limited, and how many there are.

    Parameters
    ----------
    parameters
        Equation parameters of the grid.
    pressure, mass : ndarray, shape (ny, nx)
        p and rho h [-].

    Returns
    -------
    tuple of int
        Faces across the entrainment along x and, where oil is carried along y, those along y.
    """
    ny, nx = pressure.shape
    limited, total = 0, 0
    for j in range(1, ny - 1):
        for i in range(1, nx - 1):
            if pressure[j, i] <= 0.0:
                continue
            for along in (True, False):
                if not along and parameters.wedge_y == 0.0:
                    continue
                jj, ii = (j, i - 1) if along else (j - 1, i)
                far = mass[j, max(i - 2, 0)] if along else mass[max(j - 2, 0), i]
                near, there = mass[jj, ii], mass[j, i]
                plain = parameters.here * near + parameters.upstream * far
                plain += parameters.downstream * there
                index = i - 1 if along else j - 1
                w0, w1, w2 = face_weights(parameters, index, far, near, there)
                total += 1
                value = w0 * near + w1 * far + w2 * there
                limited += index > 0 and value != plain
    return limited, total


@dataclass(frozen=True, slots=True)
class PointOutcome:
    """Residual, load, film and complementarity together.

    Parameters
    ----------
    converged
        All four within their limits.
    residual
        Unbalanced flow over the flow through the dry width [-], flow that gathers where there
        is no pressure included.
    load_error
        Missing share of the load [-].
    smallest_film
        Over the domain [m]; above zero if sound.
    wedge
        Stencil of the answer.
    limited
        Share of the faces under pressure where rho h falls by more than a factor of 2 in a cell
        or so and the stencil is limited to first order [-]; 0 on grids that resolve the inlet.
    sentence
        What happened and what to do, also where the domain cuts the contact or thin-film theory
        has ended.
    touch
        How far the solids touch.
    beyond
        Share of the load that oil beyond the domain carries [-]; 0 where there is none.
    """

    converged: bool
    residual: float
    load_error: float
    smallest_film: float
    wedge: str
    limited: float
    sentence: str
    touch: SolidLoad
    beyond: float = 0.0

    @classmethod
    def of(
        cls,
        level: PointLevel,
        state: FilmState,
        record: NewtonRecord,
        settings: PointSolverSettings,
        problem: PointContactProblem,
    ) -> PointOutcome:
        """Return the judgement on a state."""
        residual = flow_residual(level, state)
        scales = level.scales
        smallest = float(state.film.min()) * scales.film
        touch = SolidLoad.of(
            problem.solids,
            level.grid.sides.inner(state.film) * scales.film,
            level.grid.cells * scales.length**2,
            problem.load,
        )
        sound = bool(np.isfinite(state.pressure).all())
        checks = (
            (sound, "the pressure is not finite"),
            (residual <= settings.tolerance, f"the flow residual is {residual:.1e}"),
            (
                abs(state.load_error) <= settings.load_tolerance,
                f"the load is {100.0 * state.load_error:.1e} % off",
            ),
            (smallest > 0.0, "the film vanishes"),
        )
        failed = [text for good, text in checks if not good]
        steps = len(record.residuals)
        wedge = "upwind-1" if record.first_order else settings.wedge
        limited, faces = limited_faces(level.stencil, state.pressure, state.mass)
        share = limited / max(faces, 1)
        good = f"Converged in {steps} steps."
        if share > _LIMITED:
            good += f" {100.0 * share:.1f} % of the faces are of first order: too few nodes at"
            good += " the inlet or the sides for this film; take more."
        good += record.fallen_back(settings.wedge) + touch.sentence
        boundary = level.terms.boundary
        outside = boundary.load(state.approach)[0] / level.load
        good += boundary.sentence(outside)
        cut = boundary.border_pressure(state.pressure, state.film, state.approach, scales.outward)
        sentence = (
            good
            if not failed
            else f"Not converged after {steps} steps: {' and '.join(failed)}. {_CURE}"
        )
        inner = level.grid.sides.inner
        pressure = scales.outward(inner(state.pressure))
        film = scales.outward(inner(state.film)) * scales.film
        sentence += cut.sentence
        sentence += thin_film_sentence(pressure, film, (problem.x, problem.y), problem.radii)
        return cls(
            not failed, residual, state.load_error, smallest, wedge, share, sentence, touch, outside
        )


@dataclass(frozen=True, slots=True, kw_only=True)
class PointSolution:
    """Film of a point contact; arrays of shape (nx, ny) over `problem.x` and `problem.y`."""

    problem: PointContactProblem
    pressure: Array  # of oil and solids [Pa]
    film: Array  # [m]
    fill: Array  # share of the gap that holds oil [-]; 1 where cavitation conserves no mass
    approach: float  # h_0 [m]
    outcome: PointOutcome
    residuals: tuple[float, ...]  # of every Newton step on all grids [-]
    krylov_steps: int
    seconds: float
    coarser: tuple[PointSolution, ...] = ()  # the film on coarser grids, finest first
    wider: PointSolution | None = None  # the last of them on twice the domain

    @property
    def converged(self) -> bool:
        """Tell whether residual, load, film and complementarity all hold."""
        return self.outcome.converged

    @property
    def nodes(self) -> tuple[int, ...]:
        """Return the number of nodes along x and y."""
        return self.problem.nodes

    @property
    def axes(self) -> tuple[Array, ...]:
        """Return the places of the nodes along x and y [m]."""
        return self.problem.x, self.problem.y

    @property
    def formal_order(self) -> float:
        """Return the order of the grid."""
        return formal_order(self.outcome.wedge)

    @property
    def numbers(self) -> FilmNumbers:
        """Return films, largest pressure and friction."""
        friction = self.friction_coefficient
        return FilmNumbers(self.central_film, self.minimum_film, self.maximum_pressure, friction)

    @property
    def error(self) -> FilmError:
        """Return the estimated errors of grid and domain."""
        return FilmError.of(self)

    def with_words(self, more: str, seconds: float) -> PointSolution:
        """Return the solution with more to say and more time [s] spent."""
        outcome = replace(self.outcome, sentence=self.outcome.sentence + more)
        return replace(self, outcome=outcome, seconds=self.seconds + seconds)

    @property
    def central_film(self) -> float:
        """Return the film in the centre of the dry contact, by linear interpolation [m].

        With closed sides: at x = 0 half way along y.
        """
        x, y = self.problem.x, self.problem.y
        middle = self.problem.middle
        column = np.array([np.interp(middle, y, row) for row in self.film])
        return float(np.interp(0.0, x, column))

    @property
    def minimum_film(self) -> float:
        """Return the smallest film [m]."""
        return float(self.film.min())

    @property
    def maximum_pressure(self) -> float:
        """Return the largest pressure [Pa]."""
        return float(self.pressure.max())

    @property
    def friction_coefficient(self) -> float:
        """Return the mid-film shear force along `problem.sliding` over the load [-].

        Zero without sliding. Shear of solids that touch is not counted.
        """
        problem = self.problem
        if problem.sliding is None:
            return 0.0
        return (
            point_traction(
                problem.x,
                problem.y,
                self.pressure,
                self.film,
                problem.sliding,
                problem.lubricant,
                self.fill,
                closed=Sides(problem.sides).closed,
            ).force
            / problem.load
        )

    @property
    def solid_pressure(self) -> Array:
        """Return the share of the pressure that touching solids carry [Pa], shape (nx, ny)."""
        solids = self.problem.solids
        return np.zeros(self.film.shape) if solids is None else solids(self.film)

    @property
    def load(self) -> float:
        """Return the load that the pressure carries [N], that beyond the domain included."""
        x, y = self.problem.x, self.problem.y
        inside = float(self.pressure.sum() * (x[1] - x[0]) * (y[1] - y[0]))
        return inside + self.outcome.beyond * self.problem.load
