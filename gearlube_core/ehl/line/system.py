"""A line contact on one grid: film from pressure, balances, and one Newton correction."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.linalg.lapack import dgetrf, dgetrs

from gearlube_core.ehl.line.deflection import LineDeflection
from gearlube_core.ehl.line.oil_beyond import NOTHING, oil_beyond
from gearlube_core.ehl.line.problem import LineProblem
from gearlube_core.ehl.line.rows import fill_jacobian, fill_rows, local_rows
from gearlube_core.ehl.line.scaling import line_scales, row_coefficients

LOAD = 0.5 * np.pi  # integral of the Hertz pressure over p_H b


@dataclass(slots=True)
class LineState:
    """Pressure and void share (n,), approach H0; dimensionless."""

    P: np.ndarray
    void: np.ndarray
    H0: float

    def copy(self) -> LineState:
        """Return a deep copy of the state."""
        return LineState(self.P.copy(), self.void.copy(), self.H0)


@dataclass(slots=True)
class Factors:
    """Factorised Jacobian and the nodes and unknowns it belongs to."""

    lu: np.ndarray
    pivots: np.ndarray
    rows: np.ndarray  # scaling of each row
    nodes: np.ndarray
    voids: np.ndarray
    touching: np.ndarray  # of the nodes, where the film is held and not the balance


class LineSystem:
    """Equations of a line contact on a uniform grid.

    Parameters
    ----------
    problem : LineProblem
        Contact.
    nodes : int
        Of the grid.
    stencil : str
        Of the wedge.
    mass_conserving : bool
        True: void shares are unknowns where the film is broken.
    """

    def __init__(
        self, problem: LineProblem, nodes: int, stencil: str, mass_conserving: bool
    ) -> None:
        self.problem = problem
        self.scales = line_scales(problem)
        self.mass_conserving = mass_conserving
        first, last = problem.extent()
        self.x = np.linspace(first, last, nodes)
        self.X = self.x / self.scales.length
        step = (last - first) / (nodes - 1) / self.scales.length
        self.gap = problem.undeformed_gap(self.x) / self.scales.film
        self.deflection = LineDeflection(step, nodes)
        self.coefficients = row_coefficients(problem, self.scales, step, stencil, mass_conserving)
        self.rows = local_rows(nodes)
        self.oil = problem.lubricant
        self.cooling = np.ones(nodes)
        self.dilation = np.ones(nodes)
        self.source = np.zeros(nodes)
        self.load = LOAD
        self.H = np.zeros(nodes)
        self._inlet = 0 if problem.entrainment_speed >= 0.0 else -1
        self.set_beyond(problem)
        # film at which solids touch, and where they do; 0: nowhere
        self.least = 0.0
        self.touching = np.zeros(nodes, dtype=np.bool_)

    @property
    def step(self) -> float:
        """Node spacing over the Hertz half width [-]."""
        return self.coefficients.step

    def set_beyond(self, now: LineProblem) -> None:
        """Set what the oil beyond the domain does at the surface speeds of a problem."""
        self.beyond = NOTHING
        if self.problem.flooded_beyond:
            ends = float(self.x[0]), float(self.x[-1])
            self.beyond = oil_beyond(self.problem, ends, now.speed_1, now.speed_2)

    def film(self, state: LineState) -> np.ndarray:
        """Return the film H (n,) [-]; [jamali_2015 (3.2)] [jamali_2015 (3.15)]."""
        return state.H0 + self.gap + self.deflection(state.P)

    def evaluate(self, state: LineState) -> None:
        """Fill film and balances of a state, and its pressure on the upstream border."""
        state.P[self._inlet] = self.beyond.pressure / self.scales.pressure
        self.H = self.film(state)
        fill_rows(
            state.P,
            np.maximum(self.H, self.least),
            state.void,
            self.cooling,
            self.dilation,
            self.source,
            self.coefficients,
            self.oil,
            self.rows,
        )

    def load_error(self, state: LineState) -> float:
        """Return the relative error of the load [-]; [jamali_2015 (4.5)]."""
        scales = self.scales
        outside = self.beyond.load / (scales.pressure * scales.length)
        inside = self.step * (state.P.sum() - 0.5 * state.P[self._inlet])
        return float((inside + outside) / self.load - 1.0)

    def factorise(self, nodes: np.ndarray, voids: np.ndarray) -> Factors:
        """Return the factorised Jacobian of the last evaluated state."""
        m = nodes.size
        J = np.empty((m + 1, m + 1), order="F")
        fill_jacobian(self.rows, self.deflection.influence, nodes, voids, J)
        J[m, :m] = np.where(voids, 0.0, self.step / self.load)
        J[m, m] = 0.0
        scale = np.empty(m + 1)
        scale[:m] = 1.0 / np.maximum(np.abs(self.rows.by_pressure[nodes, 2]), 1.0)
        scale[m] = 1.0
        J *= scale[:, None]
        touching = self.touching[nodes]
        for a in np.flatnonzero(touching):
            J[a, :m] = np.where(voids, 0.0, self.deflection.influence[np.abs(nodes - nodes[a])])
            J[a, m] = scale[a] = 1.0
        lu, pivots, _ = dgetrf(J, overwrite_a=True)
        return Factors(lu, pivots, scale, nodes, voids, touching)

    def solve(self, factors: Factors, load_error: float) -> tuple[np.ndarray, np.ndarray, float]:
        """Return the Newton correction: dP (n,), dvoid (n,), dH0."""
        right = np.empty(factors.nodes.size + 1)
        held = self.least - self.H[factors.nodes]
        right[:-1] = np.where(factors.touching, held, -self.rows.residual[factors.nodes])
        right[-1] = -load_error
        right *= factors.rows
        change, _ = dgetrs(factors.lu, factors.pivots, right)
        dP, dvoid = np.zeros(self.x.size), np.zeros(self.x.size)
        full = ~factors.voids
        dP[factors.nodes[full]] = change[:-1][full]
        dvoid[factors.nodes[factors.voids]] = change[:-1][factors.voids]
        return dP, dvoid, float(change[-1])
