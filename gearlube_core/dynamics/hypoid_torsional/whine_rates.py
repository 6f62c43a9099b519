"""Mesh orders of a periodic motion, and their derivatives by what changes the mesh table."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from gearlube_core.arrays import Array
from gearlube_core.dynamics.hypoid_torsional.parameters import HypoidTorsionalParameters
from gearlube_core.dynamics.hypoid_torsional.period_problem import Orbit, PeriodProblem
from gearlube_core.dynamics.packed_mesh import PackedMesh, pack_series
from gearlube_core.errors import ParameterError
from gearlube_core.mesh_table.table import MeshTable
from gearlube_core.periodic.shooting import solve_periodic

Amplitudes = NDArray[np.complex128]
# central differences of the discrete map: the mesh data move by this part of themselves
_STEP = 1e-4


@dataclass(frozen=True, slots=True)
class WhineRates:
    """Complex amplitudes of K mesh orders, and their derivatives by P parameters.

    Parameters
    ----------
    orders : tuple of int
    transmission_error : ndarray of complex, shape (K,)
        Of the pinion's rotation beyond the teeth ratio [rad].
    force : ndarray of complex, shape (K,)
        Of the mesh force [N].
    transmission_error_rate, force_rate : ndarray of complex, shape (P, K)
        Per unit of each parameter.
    unknowns : ndarray of shape (n,)
        Of the motion, see `PeriodProblem`: where the search at a speed nearby may start.
    stable : bool
    """

    orders: tuple[int, ...]
    transmission_error: Amplitudes
    force: Amplitudes
    transmission_error_rate: Amplitudes
    force_rate: Amplitudes
    unknowns: Array
    stable: bool

    def amplitudes(self, name: str) -> tuple[Array, Array]:
        """Return the amplitudes (K,) of a quantity and their rates (P, K)."""
        value, rate = getattr(self, name), getattr(self, f"{name}_rate")
        size = np.abs(value)
        return size, np.real(np.conj(value) * rate) / size


def whine_rates(
    parameters: HypoidTorsionalParameters,
    rates: Mapping[str, Array],
    speed: float,
    *,
    orders: Sequence[int] = (1, 2, 3),
    start: Array | None = None,
    steps_per_mesh_period: int = 256,
) -> WhineRates:
    """Return the mesh orders of the periodic motion at a speed and their derivatives.

    With the periodic motion r(z, p) = 0 of the shooting, dz/dp = -(dr/dz)^-1 dr/dp, and an order
    c(z, p) of its samples moves by dc/dz dz/dp + dc/dp.

    Parameters
    ----------
    parameters : HypoidTorsionalParameters
        Of two degrees of freedom. The mesh table has one level, that of the pinion's torque.
    rates : mapping of str to ndarray of shape (P, H + 1, 2)
        Derivatives of series of the mesh table, in its units per unit of each parameter; the
        series that are not named, and the windows, stay.
    speed : float
        Mean pinion speed [rad/s].
    orders : sequence of int
        Orders of the mesh frequency.
    start : ndarray, optional
        Unknowns to start from, as those of a speed nearby; absent: static deflection.
    steps_per_mesh_period : int

    Raises
    ------
    ParameterError
        The table has several levels, or the pair one degree of freedom.
    ConvergenceError
        No periodic motion is found.

    Notes
    -----
    Everything that the model takes from the table follows: stiffness, radii, error, equivalent
    mass, damping of the mode, load torque. Derivatives of the discrete map by the parameters are
    central differences of its marches over 2e-4 of the mesh data, those by the state are the
    shooting's. Where a motion turns back over the speed (a fold) there is no derivative.

    Examples
    --------
    >>> from dataclasses import replace
    >>> from gearlube_core.dynamics.hypoid_torsional.parameters import karagiannis_2012_pair
    >>> from gearlube_core.dynamics.hypoid_torsional.synthetic_mesh import synthetic_mesh
    >>> mesh = synthetic_mesh()
    >>> stiffer = {"k_t": 0.01 * mesh.series["k_t"], "k_m": 0.01 * mesh.series["k_m"]}
    >>> found = whine_rates(karagiannis_2012_pair(mesh), stiffer, 100.0)
    >>> found.amplitudes("force")[1].shape
    (1, 3)
    """
    table = parameters.mesh
    if table.torque.size != 1 or parameters.form != "two_dof":
        raise ParameterError(
            "Derivatives of whine must have a mesh table of one level and form 'two_dof', got "
            f"{table.torque.size} levels and {parameters.form!r}. Take `SeriesRates.table`."
        )
    problem = PeriodProblem(parameters, steps_per_mesh_period=steps_per_mesh_period)
    packed = problem.model.packed
    guess = problem.initial_guess(speed) if start is None else start
    motion = solve_periodic(problem.equations(), guess, speed)
    z = motion.unknowns
    _, jacobian, _, _ = problem.residual(z, speed)

    def with_mesh(change: float, k: int) -> PeriodProblem:
        moved = {
            name: table.series[name] + change * np.asarray(rate)[k : k + 1]
            for name, rate in rates.items()
        }
        return _changed(parameters, table, moved, packed, steps_per_mesh_period)

    te, force = _orders(problem.orbit(z, speed), table, orders)
    count = len(next(iter(rates.values()))) if rates else 0
    te_rate = np.zeros((count, te.size), complex)
    force_rate = np.zeros_like(te_rate)
    for k in range(count):
        step = _step(problem, rates, k)
        if step == 0.0:
            continue
        ends = [with_mesh(way * step, k) for way in (1.0, -1.0)]
        high, low = (end.residual(z, speed)[0] for end in ends)
        moved = -np.linalg.solve(jacobian, (high - low) / (2.0 * step))
        high_orders, low_orders = (
            _orders(end.orbit(z + way * step * moved, speed), table, orders)
            for end, way in zip(ends, (1.0, -1.0), strict=True)
        )
        te_rate[k], force_rate[k] = (
            (high - low) / (2.0 * step) for high, low in zip(high_orders, low_orders, strict=True)
        )
    return WhineRates(tuple(orders), te, force, te_rate, force_rate, z, motion.stable)


def _changed(
    parameters: HypoidTorsionalParameters,
    table: MeshTable,
    series: Mapping[str, Array],
    packed: PackedMesh,
    steps: int,
) -> PeriodProblem:
    """Return the problem with other series of its mesh table; windows stay packed."""
    moved = replace(table, series={**table.series, **series})
    values = pack_series(moved, parameters.radii, parameters.mesh_stiffness)
    return PeriodProblem(
        replace(parameters, mesh=moved),
        steps_per_mesh_period=steps,
        packed=replace(packed, series=values),
    )


def _step(problem: PeriodProblem, rates: Mapping[str, Array], k: int) -> float:
    """Return the change of parameter k that moves the mesh data by `_STEP` of themselves."""
    series = problem.model.parameters.mesh.series
    # an error counts by the static deflection
    scale = {"e": problem.model.static_deflection}
    moved = max(
        float(np.abs(rate[k]).max()) / scale.get(name, max(abs(float(series[name][0, 0, 0])), 1e-3))
        for name, rate in rates.items()
    )
    return _STEP / moved if moved > 0.0 else 0.0


def _orders(orbit: Orbit, table: MeshTable, orders: Sequence[int]) -> tuple[Amplitudes, Amplitudes]:
    """Return the complex amplitudes of transmission error [rad] and force [N], (K,) each.

    d(phi_p - phi_g z_g/z_p)/dphi_p = 1 - (z_g/z_p) w_g/w_p; an order of the error is that of its
    slope over i k z_p.
    """
    number = np.array(orders)
    wave = np.exp(-1j * table.pinion_teeth * np.outer(number, orbit.angle))
    wave *= 2.0 / orbit.angle.size
    slope = 1.0 - table.ratio * orbit.gear_speed / orbit.pinion_speed
    error = wave @ slope / (1j * table.pinion_teeth * number)
    return error, np.asarray(wave @ orbit.force, np.complex128)
