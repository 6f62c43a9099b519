"""Stiffness, damping and modes of the axle about a static state."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from gearlube_core.arrays import Array
from gearlube_core.dynamics.hypoid_axle.kernel_parameters import AxleParameters
from gearlube_core.dynamics.hypoid_axle.mesh_at_load import MeshAtLoad
from gearlube_core.dynamics.hypoid_axle.parameters import HypoidAxleParameters
from gearlube_core.dynamics.hypoid_axle.rhs import SCRATCH, StepInputs, axle_rhs
from gearlube_core.dynamics.hypoid_axle.state import MICRO, N_ODE, U_G, U_P, V_G, V_P, W_G, W_P, X
from gearlube_core.dynamics.packed_mesh import STIFFNESS_SERIES, PackedMesh
from gearlube_core.oil.lubricant_state import lubricant_state

ANGLE_STEP = 1e-8  # rad, of the central differences
LENGTH_STEP = 1e-9  # m
SPEED_STEP = 1e-5  # rad/s or m/s
# generalised coordinates: pinion and gear rotation, then their displacements
COORDINATES = ("phi_p", "phi_g", "x_p", "y_p", "z_p", "x_g", "y_g", "z_g")


class AxleInState(Protocol):
    """What of an axle is linearised."""

    parameters: HypoidAxleParameters
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
    elastic = p._replace(
        mesh=p.mesh._replace(hysteretic_loss=0.0),
        bearing_p=p.bearing_p.without_loss(),
        bearing_g=p.bearing_g.without_loss(),
    )
    masses = np.array([p.I_p, p.I_g] + 3 * [p.m_p] + 3 * [p.m_g])
    mesh = axle.packed
    spring = STIFFNESS_SERIES[axle.parameters.mesh_stiffness]
    levels = np.array([axle.parameters.mesh.mean(key, torque) for key in (spring, "R_p")])
    series = np.zeros(mesh.series_size)
    series[0] = levels[0]
    series[1] = levels[1]
    series[2] = levels[1] * axle.parameters.mesh.ratio
    for column, key in ((3, "n_x"), (4, "n_y"), (5, "n_z")):
        series[column] = axle.parameters.mesh.mean(key, torque)
    oil = lubricant_state(p.oil, oil_temperature)
    base = np.array(axle.state_view)
    inputs = StepInputs(0.0, 0.0, 0.0, 0.0)
    at_load = MeshAtLoad(series, mesh.orders, mesh.windows, mesh.nodes)
    scratch = np.zeros(SCRATCH)
    slope = np.zeros(N_ODE)
    rows = np.r_[W_P, W_G, V_P : V_P + 3, V_G : V_G + 3]

    def generalised_force(state: Array, p: AxleParameters) -> Array:
        axle_rhs(state, inputs, at_load, oil, p, 1.0, 1.0, scratch, slope)
        return masses * slope[rows]

    normal = series[3:6]
    # change of the scaled transmission error per unit of each coordinate
    to_x = MICRO * np.concatenate([[series[1], -series[2]], normal, -normal])
    places = [None, None, *range(U_P, U_P + 3), *range(U_G, U_G + 3)]
    stiffness = np.zeros((8, 8))
    with_losses = np.zeros((8, 8))
    damping = np.zeros((8, 8))
    for j in range(8):
        shift = np.zeros_like(base)
        step = ANGLE_STEP if j < 2 else LENGTH_STEP
        shift[X] = step * to_x[j]
        if places[j] is not None:
            shift[places[j]] = step * MICRO
        for matrix, constants in ((stiffness, elastic), (with_losses, p)):
            change = generalised_force(base + shift, constants)
            change -= generalised_force(base - shift, constants)
            matrix[:, j] = -change / (2.0 * step)
        shift = np.zeros_like(base)
        shift[rows[j]] = SPEED_STEP
        change = generalised_force(base + shift, p) - generalised_force(base - shift, p)
        damping[:, j] = -change / (2.0 * SPEED_STEP)
    return LinearAxle(np.diag(masses), damping, stiffness, with_losses - stiffness)


def modes(axle: AxleInState, oil_temperature: float, torque: float) -> dict[str, float]:
    """Return the natural frequencies [Hz] of the axle by name.

    A mode is named after the coordinate that carries most of its kinetic energy: `pinion axial`,
    `pinion radial 1`, `gear axial`, `gear radial 1`, ..., `mesh`.

    Parameters as in `linearise`.
    """
    linear = linearise(axle, oil_temperature, torque)
    frequencies, _, shapes = linear.modes()
    energy = np.abs(shapes) ** 2 * np.diag(linear.mass)[:, None]
    energy /= energy.sum(axis=0)
    groups = {
        "mesh": energy[0] + energy[1],
        "pinion axial": energy[2],
        "pinion radial": energy[3] + energy[4],
        "gear axial": energy[7],
        "gear radial": energy[5] + energy[6],
    }
    names = list(groups)
    table = np.array([groups[name] for name in names])
    result: dict[str, float] = {}
    counts: dict[str, int] = {}
    for m, frequency in enumerate(frequencies):
        name = names[int(np.argmax(table[:, m]))]
        counts[name] = counts.get(name, 0) + 1
        result[f"{name} {counts[name]}"] = float(frequency)
    return {
        (name[:-2] if counts[name[:-2]] == 1 else name): value for name, value in result.items()
    }
