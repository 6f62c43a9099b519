"""Stiffness, damping and modes of the axle about a static state."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from gearlube_core.arrays import Array
from gearlube_core.dynamics.hypoid_axle.communication import axle_kernels
from gearlube_core.dynamics.hypoid_axle.force_derivatives import DERIVATIVES_WORK, N_COORDINATES
from gearlube_core.dynamics.hypoid_mesh.kernel_parameters import AxleParameters, without_losses
from gearlube_core.dynamics.hypoid_mesh.mesh_at_load import NO_FILM_MODEL, MeshFields
from gearlube_core.dynamics.packed_mesh import PackedMesh
from gearlube_core.kernels.flat_tuples import flatten

# generalised coordinates: pinion and gear rotation, then their displacements
COORDINATES = ("phi_p", "phi_g", "x_p", "y_p", "z_p", "x_g", "y_g", "z_g")


class AxleInState(Protocol):
    """What of an axle is linearised."""

    kernel_parameters: AxleParameters
    packed: PackedMesh
    state_view: Array  # shape (N_STATE,)


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


def linearise(axle: AxleInState, oil_temperature: float, torque: float) -> LinearAxle:
    """Return the axle linearised about its present state at constant pinion angle.

    Central differences of the right-hand side, with the periodic data held at their means, film
    and friction as they are.

    Parameters
    ----------
    axle : HypoidAxle
        Or any other object with what `AxleInState` names.
    oil_temperature : float
        [K]
    torque : float
        Pinion torque at which the mesh table is read [N.m].
    """
    p = axle.kernel_parameters._replace(friction=0.0)
    derivatives = axle_kernels(type(p.bearing_p), type(p.flank_law)).derivatives
    mesh = axle.packed
    fields: MeshFields = (*mesh.fields, NO_FILM_MODEL, NO_FILM_MODEL)
    state, work = np.array(axle.state_view), np.zeros(DERIVATIVES_WORK)

    def matrix(of_speeds: float, constants: AxleParameters) -> Array:
        found = np.zeros(N_COORDINATES**2)
        derivatives(
            state, of_speeds, torque, oil_temperature, fields, flatten(constants), work, found
        )
        return found.reshape(N_COORDINATES, N_COORDINATES)

    stiffness = matrix(0.0, without_losses(p))
    masses = np.array([p.I_p, p.I_g] + 3 * [p.m_p] + 3 * [p.m_g])
    return LinearAxle(np.diag(masses), matrix(1.0, p), stiffness, matrix(0.0, p) - stiffness)


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


def named_modes(axle: AxleInState, oil_temperature: float, torque: float) -> tuple[AxleMode, ...]:
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


def modes(axle: AxleInState, oil_temperature: float, torque: float) -> dict[str, float]:
    """Return the natural frequencies [Hz] of the axle by the names of `AxleMode`.

    Parameters as in `linearise`.
    """
    return {one.name: one.frequency for one in named_modes(axle, oil_temperature, torque)}
