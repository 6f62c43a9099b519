"""A line contact on one grid: film from pressure, balances, and one Newton correction."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from scipy.fft import irfft, next_fast_len, rfft
from scipy.linalg.lapack import dgetrf, dgetrs

from gearlube_core.ehl.line.oil_beyond import NOTHING, oil_beyond
from gearlube_core.ehl.line.problem import LineProblem
from gearlube_core.ehl.line.rows import (
    STENCILS,
    RowCoefficients,
    fill_jacobian,
    fill_rows,
    local_rows,
)

# from here on the series of the hat's moments is exact to 1e-13
_FAR = 10
# Hertz pressures; the film's order is lost only where the pressure is of this size
_BLEND = 1e-3
LOAD = 0.5 * np.pi  # integral of the Hertz pressure over p_H b


def hat_coefficients(step: float, count: int) -> np.ndarray:
    """Return the integral of ln abs(x) over a unit hat, at multiples of the spacing.

    G_d = integral of (1 - abs(s)/D) ln abs(d D - s) ds over abs(s) < D

    Parameters
    ----------
    step : float
        Half width of the hat and node spacing D [any length].
    count : int
        How many d = 0, 1, ... [-].

    Returns
    -------
    numpy.ndarray
        (count,), of the unit of `step`, with lengths inside the logarithm in that unit.

    Notes
    -----
    Closed form by the second antiderivative x^2/2 ln x - 3 x^2/4 nearby, moments of the hat far
    away, where the closed form would lose digits.
    """
    d = np.arange(count, dtype=float)
    far = np.maximum(d, 1.0) ** -2
    G = np.log(np.maximum(d, 1.0)) - far * (
        1.0 / 12.0 + far * (1.0 / 60.0 + far * (1.0 / 168.0 + far * (1.0 / 360.0 + far / 660.0)))
    )
    near = np.arange(-1.0, min(count, _FAR) + 1.0)
    square = near * near
    second = square * (0.5 * np.log(np.where(near == 0.0, 1.0, abs(near))) - 0.75)
    G[:_FAR] = (second[2:] - 2.0 * second[1:-1] + second[:-2])[: min(count, _FAR)]
    return step * (G + math.log(step))


class LineDeflection:
    """Deflection on a uniform grid, H = -(1/pi) sum G P; dimensionless as in `line_scaling`.

    Parameters
    ----------
    step : float
        Node spacing over the Hertz half width [-].
    count : int
        Number of grid nodes.

    Notes
    -----
    Pressure is linear between nodes and zero outside the grid. Exact linear convolution: the
    transform is padded to 2 count - 1 at least.
    """

    def __init__(self, step: float, count: int) -> None:
        self.influence = -hat_coefficients(step, count) / math.pi
        self._length = next_fast_len(2 * count - 1, real=True)
        kernel = np.zeros(self._length)
        kernel[:count] = self.influence
        kernel[-count + 1 :] = self.influence[:0:-1]
        self._transform = rfft(kernel)
        self._count = count

    def __call__(self, P: np.ndarray) -> np.ndarray:
        """Return the deflection [-] under nodal pressures (count,) [-]."""
        spectrum = rfft(P, self._length) * self._transform
        return irfft(spectrum, self._length)[: self._count]


class LineScales(NamedTuple):
    """Units of the dimensionless form."""

    length: float  # b [m]
    pressure: float  # p_H [Pa]
    film: float  # b^2/R [m]
    speed: float  # reference speed [m/s]

    @property
    def time(self) -> float:
        """Unit of time, length over speed [s]."""
        return self.length / self.speed


def line_scales(problem: LineProblem) -> LineScales:
    """Return the units of a problem; the speed is the largest of mean and surface speeds."""
    b = problem.half_width
    speed = max(abs(problem.entrainment_speed), abs(problem.speed_1), abs(problem.speed_2))
    return LineScales(b, problem.hertz_pressure, b * b / problem.radius, speed or 1.0)


def row_coefficients(
    problem: LineProblem, scales: LineScales, step: float, stencil: str, mass_conserving: bool
) -> RowCoefficients:
    """Return the numbers of a steady balance on a grid of spacing `step` [Hertz half widths].

    1/lambda = H-scale^3 p_H/(12 eta0 b) over the flow scale u_ref b^2/R
    """
    oil = problem.lubricant
    tau0 = oil.shear.tau0
    flow = scales.film**2 * scales.pressure / (12.0 * oil.eta0 * scales.length)
    sliding = problem.speed_2 - problem.speed_1
    return RowCoefficients(
        step=step,
        speed=problem.entrainment_speed / scales.speed,
        mobility=flow / scales.speed,
        pressure=scales.pressure,
        sigma=scales.film * scales.pressure / (2.0 * tau0 * scales.length) if tau0 else 0.0,
        shear=oil.eta0 * sliding / (scales.film * tau0) if tau0 else 0.0,
        weight=1.0,
        storage=0.0,
        stencil=STENCILS[stencil],
        blend=_BLEND if mass_conserving else 0.0,
    )


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
        Number of grid nodes.
    stencil : str
        Difference stencil of the wedge term.
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
