"""Stiffness, damping and modes of the axle about a static state."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gearlube_core.arrays import Array
from gearlube_core.dynamics.hypoid_axle.as_train import memory_of_means, numbers_at_rest
from gearlube_core.dynamics.hypoid_axle.model import HypoidAxle
from gearlube_core.dynamics.hypoid_axle.state import (
    LOAD_TORQUE,
    SIDE,
    U_G,
    U_P,
    V_G,
    V_P,
    W_G,
    W_P,
    X,
)
from gearlube_core.dynamics.train.march import RATES, RENEW, work_size

# generalised coordinates: pinion and gear rotation, then their displacements
COORDINATES = ("phi_p", "phi_g", "x_p", "y_p", "z_p", "x_g", "y_g", "z_g")
_RATES = np.array([W_P, W_G, *range(V_P, V_P + 3), *range(V_G, V_G + 3)])
_DISPLACEMENTS = np.array([*range(U_P, U_P + 3), *range(U_G, U_G + 3)])
_ANGLE_STEP = 1e-8  # rad, of the central differences
_LENGTH_STEP = 1e-9  # m
_SPEED_STEP = 1e-5  # rad/s or m/s


@dataclass(frozen=True, slots=True)
class LinearAxle:
    """Linearised axle M q'' + C q' + (K + N) q = 0 in the coordinates COORDINATES.

    Parameters
    ----------
    mass, damping, stiffness, circulatory : ndarray of shape (8, 8)
        SI: kg m2 or kg; N m s/rad, N s/m; N m/rad, N/m. `circulatory` is what the hysteresis of
        orbiting rollers adds to the stiffness: damping in a rotating frame.
    """

    mass: Array
    damping: Array
    stiffness: Array
    circulatory: Array

    def modes(self) -> tuple[Array, Array, Array]:
        """Return undamped frequencies [Hz], damping ratios [-] and shapes (8, m), rigid mode out.

        Damping ratios are those of the diagonal of the modal damping matrix.
        """
        eigenvalues, shapes = np.linalg.eig(np.linalg.solve(self.mass, self.stiffness))
        order = np.argsort(eigenvalues.real)[1:]
        omega = np.sqrt(np.maximum(eigenvalues[order].real, 0.0))
        shapes = shapes[:, order].real
        modal_mass = np.einsum("im,ij,jm->m", shapes, self.mass, shapes)
        modal_damping = np.einsum("im,ij,jm->m", shapes, self.damping, shapes)
        ratios = modal_damping / (2.0 * modal_mass * omega)
        return omega / (2.0 * np.pi), ratios, shapes

    def eigenvalues(self) -> NDArray[np.complex128]:
        """Return the 16 eigenvalues of the damped linear axle [1/s]."""
        n = self.mass.shape[0]
        inverse = np.linalg.inv(self.mass)
        upper = np.hstack([np.zeros((n, n)), np.eye(n)])
        stiffness = self.stiffness + self.circulatory
        lower = np.hstack([-inverse @ stiffness, -inverse @ self.damping])
        return np.linalg.eigvals(np.vstack([upper, lower])).astype(np.complex128)


def linearise(axle: HypoidAxle, oil_temperature: float, torque: float) -> LinearAxle:
    """Return the axle linearised about its present state at constant pinion angle.

    Central differences of the rates of its train, with the periodic data held at their means and
    without friction and drag.

    Parameters
    ----------
    axle : HypoidAxle
    oil_temperature : float
        [K]
    torque : float
        Pinion torque at which the mesh table is read [N.m].
    """
    made = axle.assembly
    work, memory = np.zeros(work_size(made.sizes)), memory_of_means(made)
    state = np.array(axle.state_view)
    state[LOAD_TORQUE], state[SIDE] = abs(torque), -1.0 if torque < 0.0 else 1.0
    given = axle.parameters
    masses = np.array(
        [given.pinion_inertia, given.gear_inertia] + 3 * [given.pinion_mass] + 3 * [given.gear_mass]
    )

    def rates(s: Array, numbers: Array) -> Array:
        for operation in (RENEW, RATES):
            axle.operate(operation, s, oil_temperature, numbers, memory, made.plan, 0.0, 0.0, work)
        return work[: made.sizes.integrated].copy()

    def forces(s: Array, numbers: Array) -> Array:
        return masses * rates(s, numbers)[_RATES]

    without, undamped = (
        numbers_at_rest(axle.elements, made, given.oil, hysteresis=one, cages=True)
        for one in (True, False)
    )
    # how much each coordinate moves the transmission error
    still = state.copy()
    still[_RATES] = 0.0
    moves = np.zeros(len(COORDINATES))
    for j, place in enumerate(_RATES):
        turning = still.copy()
        turning[place] = 1.0
        moves[j] = rates(turning, without)[X]

    def over_coordinates(numbers: Array) -> Array:
        found = np.zeros((len(COORDINATES), len(COORDINATES)))
        for j in range(len(COORDINATES)):
            step = _ANGLE_STEP if j < 2 else _LENGTH_STEP
            for side in (1.0, -1.0):
                s = state.copy()
                s[X] += side * step * moves[j]
                if j >= 2:
                    s[_DISPLACEMENTS[j - 2]] += side * step
                found[:, j] -= side * forces(s, numbers) / (2.0 * step)
        return found

    def over_speeds(numbers: Array) -> Array:
        found = np.zeros((len(COORDINATES), len(COORDINATES)))
        for j, place in enumerate(_RATES):
            for side in (1.0, -1.0):
                s = state.copy()
                s[place] += side * _SPEED_STEP
                found[:, j] -= side * forces(s, numbers) / (2.0 * _SPEED_STEP)
        return found

    stiffness = over_coordinates(undamped)
    circulatory = over_coordinates(without) - stiffness
    return LinearAxle(np.diag(masses), over_speeds(without), stiffness, circulatory)


@dataclass(frozen=True, slots=True)
class AxleMode:
    """One natural mode of the axle.

    Parameters
    ----------
    name : str
        After the coordinate that carries most of its kinetic energy: `pinion axial`,
        `pinion radial 1`, `gear axial`, `gear radial 1`, ..., `mesh`.
    frequency : float
        Undamped natural frequency [Hz].
    damping_ratio : float
        Of critical damping [-].
    shape : ndarray of shape (8,)
        In the order of COORDINATES [rad], [m], of modal mass 1 kg: shape.M.shape = 1.
    """

    name: str
    frequency: float
    damping_ratio: float
    shape: Array


def named_modes(axle: HypoidAxle, oil_temperature: float, torque: float) -> tuple[AxleMode, ...]:
    """Return the natural modes of the axle, lowest frequency first.

    Parameters as in `linearise`.
    """
    linear = linearise(axle, oil_temperature, torque)
    frequencies, ratios, shapes = linear.modes()
    energy = np.abs(shapes) ** 2 * np.diag(linear.mass)[:, None]
    shapes = shapes / np.sqrt(energy.sum(axis=0))
    energy /= energy.sum(axis=0)
    groups = {
        "mesh": energy[0] + energy[1],
        "pinion axial": energy[2],
        "pinion radial": energy[3] + energy[4],
        "gear axial": energy[7],
        "gear radial": energy[5] + energy[6],
    }
    names = list(groups)
    largest = np.argmax(np.array([groups[name] for name in names]), axis=0)
    found = []
    for m, frequency in enumerate(frequencies):
        same = np.flatnonzero(largest == largest[m])
        name = names[int(largest[m])]
        if same.size > 1:
            name += f" {int(np.searchsorted(same, m)) + 1}"
        found.append(AxleMode(name, float(frequency), float(ratios[m]), shapes[:, m]))
    return tuple(found)
