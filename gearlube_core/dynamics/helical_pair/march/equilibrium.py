"""Static equilibrium and natural frequencies of the marching model."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import root

from gearlube_core.arrays import Array
from gearlube_core.dynamics.helical_pair.march.constants import MarchConstants
from gearlube_core.dynamics.helical_pair.march.film_refresh import refresh_friction
from gearlube_core.dynamics.helical_pair.march.mesh_data import (
    MarchMesh,
    MeshFields,
    mesh_at_torque,
)
from gearlube_core.dynamics.helical_pair.march.rates import march_rates
from gearlube_core.dynamics.helical_pair.march.state import (
    LOAD_TORQUE,
    N_LATERAL,
    N_ODE,
    PSI,
    REFRESHED,
    U_P,
    V_P,
    W_G,
    W_P,
)
from gearlube_core.errors import ConvergenceError
from gearlube_core.oil.lubricant_state import lubricant_state

_MICRO = 1e-6  # m and rad per unknown
_FILM_PASSES = 4  # friction of the film depends on the loads, weakly
_DIFFERENCE = 1e-8  # m and rad: small against micrometres of deflection
_OUT_OF_BALANCE = 1e-6  # of the mesh force


class MarchRates:
    """Rates of change as a function of the state, for solvers outside the march.

    Parameters
    ----------
    constants : MarchConstants
    mesh : MarchMesh
    data : ndarray
        Pair data; the mesh in it follows the state.
    """

    def __init__(self, constants: MarchConstants, mesh: MarchMesh, data: Array) -> None:
        self.constants = constants
        self.mesh = mesh
        self._fields: MeshFields = (mesh.torque, mesh.density, mesh.offset)
        self._data = data
        motion = constants.motion
        mobilities = [
            value
            for k in (motion.pinion, motion.gear)
            for value in (k.mobility, k.mobility, k.mobility_z, k.mobility_a, k.mobility_a)
        ]
        self.free: NDArray[np.intp] = np.flatnonzero(np.array(mobilities) > 0.0)
        self.mobility: Array = np.array(mobilities)[self.free]

    def at(self, state: Array, pinion_torque: float, wheel_torque: float) -> Array:
        """Return d/dt of the integrated states, shape (N_ODE,), at a state of shape (N_STATE,)."""
        slope = np.zeros(N_ODE)
        mesh_at_torque(state[LOAD_TORQUE], self._fields, self._data)
        march_rates(state, pinion_torque, wheel_torque, self._data, slope)
        return slope

    def refresh(self, state: Array, oil_temperature: float) -> None:
        """Compute the film's friction coefficients in `state` anew."""
        if self.constants.friction_form > 0.0:
            state[REFRESHED] = -1.0
            oil = lubricant_state(self.constants.oil, oil_temperature)
            mesh_at_torque(state[LOAD_TORQUE], self._fields, self._data)
            refresh_friction(state, self._data, oil)


def settle(
    s: Array, pinion_torque: float, pinion_speed: float, oil_temperature: float, rates: MarchRates
) -> None:
    """Put `s` into static equilibrium under the pinion torque [N.m], turning [rad/s].

    Raises
    ------
    ConvergenceError
        When none is found.
    """
    flanks = rates.constants.motion.flanks
    plane = flanks.plane
    s[W_P] = pinion_speed
    s[W_G] = pinion_speed * plane.r_bp / plane.r_bg
    unknowns = np.r_[PSI, U_P + rates.free]
    rows = np.r_[W_P, V_P + rates.free]
    scale = 1.0 / np.r_[rates.constants.motion.pinion.mobility_r * plane.r_bp, rates.mobility]

    def residual(u: Array) -> Array:
        s[unknowns] = _MICRO * u
        return np.asarray(scale * rates.at(s, pinion_torque, 0.0)[rows])

    force = pinion_torque / plane.r_bp
    density = float(np.mean(rates.mesh.density))
    guess = np.zeros(unknowns.size)
    # pressed until all lines touch: outside contact the forces have no slope to follow
    pressed = 2.0 * abs(force) / (plane.W * density) + float(np.max(rates.mesh.offset))
    guess[0] = pressed / plane.cos_b / _MICRO
    if pinion_torque < 0.0:
        guess[0] = -guess[0] - flanks.backlash / plane.cos_b / _MICRO
    for _ in range(_FILM_PASSES if rates.constants.friction_form > 0.0 else 1):
        found = root(residual, guess, method="hybr", options={"xtol": 1e-13})
        guess = found.x
        worst = float(np.max(np.abs(residual(guess))))
        rates.refresh(s, oil_temperature)
    if not worst <= _OUT_OF_BALANCE * max(abs(force), 1.0):
        raise ConvergenceError(
            f"no static equilibrium at a pinion torque of {pinion_torque:g} N.m: forces are out "
            f"by {worst:g} N. Reduce the torque or stiffen the supports."
        )


def natural_frequencies(s: Array, rates: MarchRates) -> Array:
    """Return the undamped natural frequencies about a state [Hz], rising."""
    plane = rates.constants.motion.flanks.plane
    places = np.r_[PSI, U_P + rates.free]
    rows = np.r_[W_P, W_G, V_P + rates.free]
    base = s.copy()
    base[V_P : V_P + N_LATERAL] = 0.0
    base[W_G] = base[W_P] * plane.r_bp / plane.r_bg
    columns = []
    for place in places:
        high, low = base.copy(), base.copy()
        high[place] += _DIFFERENCE
        low[place] -= _DIFFERENCE
        columns.append((rates.at(high, 0.0, 0.0) - rates.at(low, 0.0, 0.0))[rows])
    slope = np.array(columns).T / (2.0 * _DIFFERENCE)
    relative = plane.r_bp * slope[0] - plane.r_bg * slope[1]
    squares = np.linalg.eigvals(-np.vstack([relative, slope[2:]]))
    return np.sort(np.sqrt(np.maximum(squares.real, 0.0))) / (2.0 * np.pi)
