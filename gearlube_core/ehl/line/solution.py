"""Result of a line contact solution in SI units, with its convergence status."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from gearlube_core.ehl.grid_error import FilmError, FilmNumbers, formal_order
from gearlube_core.ehl.line.newton import NewtonRecord
from gearlube_core.ehl.line.oil_beyond import OilBeyond, beyond_sentence
from gearlube_core.ehl.line.problem import LineProblem, LineSettings
from gearlube_core.ehl.line.system import LineState, LineSystem
from gearlube_core.ehl.line.traction import fill_mean_stress
from gearlube_core.ehl.thin_film import thin_film_sentence


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class LineSolution:
    """Film, pressure and traction of a line contact.

    Arrays are (n,) on `x` [m], if no other shape is given. `outcome` is one sentence; `converged`
    says whether residual, load, film and complementarity all hold.
    """

    problem: LineProblem
    settings: LineSettings
    x: np.ndarray
    pressure: np.ndarray  # [Pa]
    film: np.ndarray  # [m]
    void: np.ndarray  # share of the gap without oil [-]; 0 where cavitation conserves no mass
    streaks: np.ndarray  # share of the gap that is sheared [-]: 1 but behind ruptures
    viscosity: np.ndarray  # [Pa s]
    density: np.ndarray  # [kg/m3]
    mean_stress: np.ndarray  # at mid-film [Pa]
    contact: np.ndarray  # True where solids touch
    contact_flow: float  # oil made where a touching film is held open [kg/(m s)]
    mass_flow: np.ndarray  # (n - 1,) between nodes [kg/(m s)]
    beyond: OilBeyond  # oil outside the domain
    approach: float  # h - h_u - deflection [m], deflection up to a constant
    residual: float  # unbalanced flow over flow through the contact [-]
    load_error: float  # [-]
    records: tuple[tuple[int, NewtonRecord], ...]  # (nodes, iteration) of each grid tried
    converged: bool
    outcome: str
    coarser: tuple[LineSolution, ...] = ()  # the film on coarser grids, finest first
    wider: LineSolution | None = None  # the last of them on twice the domain
    time_error: float = math.nan  # estimated, of the smallest film by time steps [-]; at rest: nan

    @property
    def nodes(self) -> tuple[int, ...]:
        """Number of nodes."""
        return (self.x.size,)

    @property
    def axes(self) -> tuple[np.ndarray, ...]:
        """Places of the nodes [m]."""
        return (self.x,)

    @property
    def formal_order(self) -> float:
        """Return the order of the grid."""
        return formal_order(self.settings.stencil)

    @property
    def numbers(self) -> FilmNumbers:
        """Films, largest pressure and friction."""
        friction = self.friction_coefficient
        return FilmNumbers(self.central_film, self.minimum_film, self.maximum_pressure, friction)

    @property
    def error(self) -> FilmError:
        """Estimated errors of grid and domain; not known after a step in time."""
        return FilmError.of(self)

    @property
    def maximum_pressure(self) -> float:
        """Largest pressure, of the parabola through the largest nodal values [Pa]."""
        return -_parabola_lowest(self.x, -self.pressure)

    @property
    def minimum_film(self) -> float:
        """Smallest film, of the parabola through the smallest nodal values [m]."""
        return _parabola_lowest(self.x, self.film)

    @property
    def central_film(self) -> float:
        """Film at x = 0, of the cubic through four nodes [m]."""
        i = int(np.clip(np.searchsorted(self.x, 0.0) - 2, 0, self.x.size - 4))
        scale = self.x[i + 3] - self.x[i]
        part = np.polyfit((self.x[i : i + 4]) / scale, self.film[i : i + 4], 3)
        return float(part[-1])

    @property
    def stress_1(self) -> np.ndarray:
        """Shear stress that the film exerts on body 1, below, along x (n,) [Pa]."""
        return self.mean_stress - 0.5 * self.film * np.gradient(self.pressure, self.x)

    @property
    def stress_2(self) -> np.ndarray:
        """Shear stress that the film exerts on body 2, above, along x (n,) [Pa]."""
        return -self.mean_stress - 0.5 * self.film * np.gradient(self.pressure, self.x)

    @property
    def rolling_force(self) -> float:
        """Force int h/2 dp/dx dx of either surface, oil upstream of the domain included [N/m]."""
        inside = 0.5 * _integral(self.x, self.film * np.gradient(self.pressure, self.x))
        return inside + math.copysign(self.beyond.rolling_force, self.problem.entrainment_speed)

    @property
    def friction(self) -> tuple[float, float]:
        """Force of the film along x on body 1 and on body 2 per length of line [N/m]."""
        shear, rolling = self.shear_force, self.rolling_force
        return shear - rolling, -shear - rolling

    @property
    def shear_force(self) -> float:
        """Mid-film shear force along x, with the sign of u2 - u1, oil beyond included [N/m]."""
        return _integral(self.x, self.mean_stress) + self.beyond.shear_force

    @property
    def friction_coefficient(self) -> float:
        """Mid-film shear force over load, with the sign of u2 - u1 [-]."""
        return self.shear_force / self.problem.line_load

    @property
    def mass_balance(self) -> float:
        """Spread of the flow between full nodes over its mean [-]; 0 without flow."""
        full = (self.pressure[1:] > 0.0) & (self.pressure[:-1] > 0.0)
        flow = self.mass_flow[full]
        mean = float(np.abs(flow).mean()) if flow.size else 0.0
        return float(np.ptp(flow)) / mean if mean > 0.0 else 0.0


def _integral(x: np.ndarray, y: np.ndarray) -> float:
    return float(np.trapezoid(y, x))


def _parabola_lowest(x: np.ndarray, y: np.ndarray) -> float:
    i = int(np.argmin(y))
    if i in (0, y.size - 1):
        return float(y[i])
    bend = y[i + 1] - 2.0 * y[i] + y[i - 1]
    slope = 0.5 * (y[i + 1] - y[i - 1])
    return float(y[i] - 0.5 * slope * slope / bend) if bend > 0.0 else float(y[i])


def void_behind_ruptures(p: np.ndarray, mass: np.ndarray, speed: float) -> np.ndarray:
    """Return the share of the gap (n,) [-] that streaks of oil behind a rupture leave empty.

    Parameters
    ----------
    p, mass
        Pressure [Pa] and density times film [kg/m2], (n,).
    speed
        Of entrainment [m/s].

    Notes
    -----
    A film that breaks by Reynolds' condition goes on with the oil that passed the rupture, in
    streaks that fill a share of the gap ([jakobsson_floberg_1957]): only they are sheared.
    """
    way = slice(None, None, -1 if speed < 0.0 else 1)
    loaded = p[way] > 0.0
    last = np.maximum.accumulate(np.where(loaded, np.arange(p.size), -1))
    carried = np.where(loaded | (last < 0), mass[way], mass[way][last])
    return np.asarray(1.0 - np.minimum(carried / mass[way], 1.0)[way])


def build_solution(
    system: LineSystem,
    state: LineState,
    settings: LineSettings,
    records: tuple[tuple[int, NewtonRecord], ...],
    problem: LineProblem,
) -> LineSolution:
    """Return the solution in SI units of the state that was evaluated last."""
    system.evaluate(state)
    scales, oil = system.scales, system.oil
    p, h = state.P * scales.pressure, system.H * scales.film
    eta, rho = system.rows.eta * oil.eta0, system.rows.rho * oil.rho0
    tau = np.empty(p.size)
    slope = np.gradient(p, system.x)
    sliding = problem.speed_2 - problem.speed_1
    void = state.void.copy()
    if settings.cavitation == "reynolds":
        void = void_behind_ruptures(p, rho * h, problem.entrainment_speed)
    fill_mean_stress(p, slope, h, void, eta, sliding, oil, tau)
    last = records[-1][1]
    made = float(system.rows.residual[system.touching].sum())
    return LineSolution(
        problem=problem,
        settings=settings,
        x=system.x.copy(),
        pressure=p,
        film=h,
        void=state.void.copy(),
        streaks=1.0 - void,
        viscosity=eta,
        density=rho,
        mean_stress=tau,
        contact=system.touching.copy(),
        contact_flow=made * oil.rho0 * scales.film * scales.speed,
        mass_flow=system.rows.flux * oil.rho0 * scales.film * scales.speed,
        beyond=system.beyond,
        approach=state.H0 * scales.film,
        residual=last.residual[-1],
        load_error=system.load_error(state),
        records=records,
        converged=last.converged,
        outcome=_outcome(last, system, state)
        + thin_film_sentence(p, h, (system.x,), (problem.radius,))
        + beyond_sentence(system.problem, problem, system.beyond),
    )


def _outcome(record: NewtonRecord, system: LineSystem, state: LineState) -> str:
    if record.converged:
        touching = int(system.touching.sum())
        contact = f", solids touch at {touching} nodes" if touching else ""
        return (
            f"Converged on {system.x.size} nodes: unbalanced flow {record.residual[-1]:.1e}, "
            f"load error {record.load_error[-1]:.1e}{contact}."
        )
    least = float(system.H.min()) * system.scales.film
    return (
        f"Not converged on {system.x.size} nodes: {record.reason}; unbalanced flow "
        f"{record.residual[-1]:.1e}, smallest film {least:.2e} m. Take more nodes, a narrower "
        f"domain or the stencil upwind-1."
    )
