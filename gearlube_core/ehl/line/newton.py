"""Semismooth Newton iteration of a line contact on one grid: film, load, rupture together."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from gearlube_core.ehl.line.system import Factors, LineState, LineSystem

# a film may shrink to this share of itself in one step
_SHRINK = 0.1
# an error of the load moves the flow about this much more than itself; it weighs the two where
# a step is judged, not where convergence is
_LOAD_WEIGHT = 100.0
# steps within which the smallest residual has to halve
_PATIENCE = 12
# largest change of ln(viscosity) and of pressure [Hertz pressures] in one step
_LARGEST_LOG, _LARGEST_RISE = 6.0, 0.6
# a factorisation is kept while it takes the residual down by this
_KEEP = 0.25
# from this many unknowns on it is worth keeping
_LARGE = 350
# rounding of the carried flows, summed over the nodes
_ROUNDING = 20.0 * np.finfo(float).eps


@dataclass(frozen=True, slots=True)
class NewtonRecord:
    """How an iteration went: residual (k,), load error (k,), verdict."""

    residual: tuple[float, ...]
    load_error: tuple[float, ...]
    converged: bool
    reason: str


def flow_residual(system: LineSystem, state: LineState, free: np.ndarray) -> float:
    """Return the sum of unbalanced flows over the flow through the contact [-].

    Counts what a full film gains or loses, and what a broken one would have to take in.
    """
    r = system.rows.residual[1:-1]
    inside = free[1:-1]
    exact = inside | system.mass_conserving
    touching = system.touching[1:-1]
    wrong = np.where(exact & ~touching, np.abs(r), np.maximum(-r, 0.0))
    wrong = wrong + np.where(touching, np.abs(system.H[1:-1] - system.least), 0.0)
    return float(wrong.sum() / flow_scale(system, state))


def flow_scale(system: LineSystem, state: LineState) -> float:
    """Return the flow through the loaded part [-], the scale of residuals."""
    P = state.P
    loaded = P - 0.3 * P.max() >= 0.0
    mean = float((system.rows.rho[loaded] * system.H[loaded]).mean())
    c = system.coefficients
    # without entrainment a film that closes within 1000 steps moves this much
    return max(abs(c.speed), 1e-3 * c.storage) * max(mean, 1e-300)


def rounding_floor(system: LineSystem, state: LineState) -> float:
    """Return the residual [-] that rounding errors of film, pressure and flow can cause."""
    rows, c = system.rows, system.coefficients
    carried = (abs(c.speed) + c.step * c.storage) * float((rows.rho * np.abs(system.H)).sum())
    pumped = float((np.abs(rows.by_pressure[:, 2]) * state.P).sum())
    return _ROUNDING * (carried + 0.1 * pumped) / flow_scale(system, state)


def _step_length(system: LineSystem, state: LineState, dP: np.ndarray, dH0: float) -> float:
    dH = dH0 + system.deflection(dP)
    falls = -dH / np.maximum(system.H, 1e-300)
    # a film that may touch is stopped by the contact, not by its step
    fastest = float(falls.max()) if system.least == 0.0 else 0.0
    length = min(1.0, (1.0 - _SHRINK) / max(fastest, 1e-300))
    steep = float(np.abs(dP * system.rows.eta_slope).max())
    length = min(length, _LARGEST_LOG / max(steep, 1e-300))
    return min(length, _LARGEST_RISE / max(float(np.abs(dP).max()), 1e-300))


def _advance(
    system: LineSystem,
    state: LineState,
    full: np.ndarray,
    change: tuple[np.ndarray, np.ndarray, float],
    s: float,
) -> tuple[LineState, np.ndarray]:
    dP, dvoid, dH0 = change
    P, void = state.P + s * dP, state.void + s * dvoid
    trial = LineState(np.maximum(P, 0.0), np.clip(void, 0.0, 1.0), state.H0 + s * dH0)
    meets = (system.film(trial) < system.least) & (system.least > 0.0)
    if system.mass_conserving:
        trial.void[meets] = 0.0
    system.evaluate(trial)
    stays = system.touching & (P > 0.0) & (system.rows.residual >= 0.0)
    system.touching = meets | (stays & (system.least > 0.0))
    system.touching[[0, -1]] = False
    if system.mass_conserving:
        full = np.where(full, P > 0.0, void < 0.0) | system.touching
        trial.void[1:-1][full[1:-1]] = 0.0
    else:
        full = (P > 0.0) | (system.rows.residual < 0.0) | system.touching
    full[[0, -1]] = False
    return trial, full


def newton(
    system: LineSystem, start: LineState, tolerance: float, max_iterations: int
) -> tuple[LineState, NewtonRecord]:
    """Return the solution on the grid of `system` and the record of its iteration.

    Parameters
    ----------
    system : LineSystem
        Equations.
    start : LineState
        Start, not changed.
    tolerance : float
        Of `flow_residual`; the load is held to the same number.
    max_iterations : int
        Largest number of Newton steps.

    Returns
    -------
    tuple of LineState, NewtonRecord

    Notes
    -----
    A node is full (its balance vanishes) or broken (its pressure vanishes). It breaks where a
    step would make its pressure negative, and fills again where its balance turns negative or,
    with mass conservation, its void share. Where `system.least` is above zero a film that falls to
    it is held there by what the solids carry; a node lets go where the oil alone would lift it.
    """
    state = start.copy()
    residuals: list[float] = []
    loads: list[float] = []
    factors: Factors | None = None
    system.touching = np.zeros(state.P.size, dtype=np.bool_)
    system.evaluate(state)
    if system.H.min() <= 0.0:
        # lift a start that cuts into itself
        state.H0 += 0.01 * float(np.ptp(system.H)) - float(system.H.min())
        system.evaluate(state)
    free = (state.P > 0.0) | ((state.void <= 0.0) & (system.rows.residual < 0.0))
    free[[0, -1]] = False
    interior = np.arange(1, state.P.size - 1)
    for _ in range(max_iterations + 1):
        residual, load = flow_residual(system, state, free), abs(system.load_error(state))
        residuals.append(residual)
        loads.append(load)
        if not np.isfinite(residual):
            return state, _record(residuals, loads, "the iteration left the range of numbers")
        if residual <= max(tolerance, rounding_floor(system, state)) and load <= tolerance:
            return state, _record(residuals, loads, "")
        if len(residuals) > _PATIENCE and _stagnant(residuals, loads):
            return state, _record(residuals, loads, "the iteration stagnates")
        nodes = interior if system.mass_conserving else np.flatnonzero(free)
        voids = ~free[nodes] if system.mass_conserving else np.zeros(nodes.size, dtype=np.bool_)
        if nodes.size == 0:
            return state, _record(residuals, loads, "no node carries pressure")
        if factors is None or not _still_good(
            factors, nodes, voids, system.touching[nodes], residuals, loads
        ):
            factors = system.factorise(nodes, voids)
        change = system.solve(factors, system.load_error(state))
        if not np.isfinite(change[2]):
            return state, _record(residuals, loads, "the Jacobian is singular")
        length = _step_length(system, state, change[0], change[2])
        state, free = _accept(system, state, free, change, length, residual + _LOAD_WEIGHT * load)
    return state, _record(residuals, loads, f"no convergence in {max_iterations} Newton steps")


def _stagnant(residuals: list[float], loads: list[float]) -> bool:
    total = [a + b for a, b in zip(residuals, loads, strict=True)]
    return min(total[-_PATIENCE:]) > 0.5 * min(total[:-_PATIENCE])


def _still_good(
    factors: Factors,
    nodes: np.ndarray,
    voids: np.ndarray,
    touching: np.ndarray,
    residuals: list[float],
    loads: list[float],
) -> bool:
    if nodes.size < _LARGE or len(residuals) < 2:
        return False
    if not np.array_equal(factors.nodes, nodes) or not np.array_equal(factors.voids, voids):
        return False
    if not np.array_equal(factors.touching, touching):
        return False
    return residuals[-1] + loads[-1] < _KEEP * (residuals[-2] + loads[-2])


def _accept(
    system: LineSystem,
    state: LineState,
    full: np.ndarray,
    change: tuple[np.ndarray, np.ndarray, float],
    length: float,
    merit: float,
) -> tuple[LineState, np.ndarray]:
    best, best_merit = None, np.inf
    before = touching = system.touching
    for _ in range(6):
        system.touching = before
        trial, trial_full = _advance(system, state, full, change, length)
        if system.least > 0.0 or np.all(system.H > 0.0):
            error = abs(system.load_error(trial))
            new = flow_residual(system, trial, trial_full) + _LOAD_WEIGHT * error
            if new < best_merit:
                best, best_merit, touching = (trial, trial_full), new, system.touching
            if new < (1.0 - 0.1 * length) * merit:
                return trial, trial_full
        length *= 0.5
    if best is None:
        best = _advance(system, state, full, change, length)
        touching = system.touching
    system.touching = touching
    system.evaluate(best[0])
    return best


def _record(residuals: list[float], loads: list[float], reason: str) -> NewtonRecord:
    return NewtonRecord(tuple(residuals), tuple(loads), not reason, reason)
