"""Natural modes of the driveline: with a rigid axle, and together with its linearised axle."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from drivetrain.driveline.equations import INDEX, STATES
from drivetrain.driveline.model import Driveline
from drivetrain.driveline.steady_state import GEAR_INERTIA, PINION_INERTIA, rigid_axle_jacobian
from gearlube_core.arrays import Array
from gearlube_core.dynamics.hypoid_axle.linearise import COORDINATES, LinearAxle

_SCALE = 1e3  # rad/s
_STILL = 0.1  # rad/s, below which a motion is one of a rigid body
LOWEST = 100.0  # Hz, modes of the car below it lie below the mesh frequencies
AXLE_SPRINGS = ("mesh", "bearings")  # springs that are not in the car
# moving parts of the axle, with their coordinates
_MOVING = {
    "pinion turning": (0,),
    "gear turning": (1,),
    "pinion axial": (2,),
    "pinion radial": (3, 4),
    "gear axial": (7,),
    "gear radial": (5, 6),
}


@dataclass(frozen=True, slots=True, kw_only=True)
class DrivelineMode:
    """One oscillating mode.

    Parameters
    ----------
    eigenvalue : complex
        s [1/s], imaginary part positive.
    motion : dict of str, float
        Share of every moving part in the kinetic energy of the mode [-].
    strain : dict of str, float
        Share of every spring in the potential energy [-].
    shape : array, optional
        Of the axle's COORDINATES [rad], [m], where the mode of all moving parts has modal mass 1,
        at the instant of its largest motion.
    """

    eigenvalue: complex
    motion: dict[str, float]
    strain: dict[str, float]
    shape: Array | None = None

    @property
    def frequency(self) -> float:
        """Undamped natural frequency abs(s) / (2 pi) [Hz]."""
        return abs(self.eigenvalue) / (2.0 * np.pi)

    @property
    def damping_ratio(self) -> float:
        """-Re(s) / abs(s) [-]."""
        return -self.eigenvalue.real / abs(self.eigenvalue)

    @property
    def car_strain(self) -> float:
        """Share of the potential energy in the springs of the car [-]; the rest is in the axle."""
        return sum(share for name, share in self.strain.items() if name not in AXLE_SPRINGS)

    @property
    def name(self) -> str:
        """The part that moves most; "on" the spring strained most, if that is one of the car."""
        moving = max(self.motion, key=self.motion.__getitem__)
        spring = max(self.strain, key=self.strain.__getitem__)
        if spring not in AXLE_SPRINGS:
            return f"{moving} on {spring}"
        turning = sum(share for name, share in self.motion.items() if name.endswith("turning"))
        return "mesh" if turning >= self.motion[moving] else moving


def numbered(names: Sequence[str]) -> list[str]:
    """Return names with a number behind those that come more than once.

    >>> numbered(["mesh", "gear radial", "gear radial"])
    ['mesh', 'gear radial 1', 'gear radial 2']
    """
    return [
        f"{name} {names[: i + 1].count(name)}" if names.count(name) > 1 else name
        for i, name in enumerate(names)
    ]


def driveline_modes(
    driveline: Driveline, pinion_inertia: float = PINION_INERTIA, gear_inertia: float = GEAR_INERTIA
) -> tuple[DrivelineMode, ...]:
    """Return the oscillating modes, highest frequency first.

    Parameters
    ----------
    driveline : Driveline
        At its steady state, which sets gear and tyre damping.
    pinion_inertia, gear_inertia : float
        Of the rigid axle [kg m2]; by default [mohammadpour_2015 Table 1].

    Notes
    -----
    From the exact Jacobian, speed controller included. Non-oscillating modes are left out.
    """
    parameters, steady = driveline.parameters, driveline.steady
    jacobian = rigid_axle_jacobian(parameters, steady, pinion_inertia, gear_inertia)
    axle = pinion_inertia + gear_inertia / parameters.axle_ratio**2
    moving, springs = _parts(driveline)
    return tuple(
        DrivelineMode(
            eigenvalue=value,
            motion=_shares(
                {"axle": 0.5 * axle * abs(vector[-1]) ** 2, **_energies(moving, vector)}
            ),
            strain=_shares(_energies(springs, vector)),
        )
        for value, vector in reversed(_oscillating(jacobian))
    )


def coupled_modes(linear: LinearAxle, driveline: Driveline | None) -> tuple[DrivelineMode, ...]:
    """Return the oscillating modes of a linearised axle in its car, lowest frequency first.

    M q'' + C q' + (K + N) q = (T_p, -T_w, 0, ..., 0);  y', T_p, T_w = f(y, q_1', q_2')

    Parameters
    ----------
    linear : LinearAxle
        The axle about a static state.
    driveline : Driveline, optional
        The car at its steady state, at the speed and torque of the axle. None: free flanges.

    Notes
    -----
    The car's Jacobian is exact, its engine orders are off. Non-oscillating modes are left out.
    The mesh is the only spring that the rotations strain, so row 1 of K gives its own stiffness:
    K_mesh = K_1 K_1' / K_11.
    """
    axle, mass = len(COORDINATES), np.diag(linear.mass)
    states = 0 if driveline is None else len(STATES) - 1
    moving, springs = ({}, {}) if driveline is None else _parts(driveline)
    # states: w q, q', y with a fixed w, so that all rates are of one size; the car takes the
    # two speeds of rotation
    system = np.zeros((2 * axle + states, 2 * axle + states))
    q, speeds, rest = np.split(np.arange(len(system)), [axle, 2 * axle])
    system[q, speeds] = _SCALE
    system[np.ix_(speeds, q)] = -(linear.stiffness + linear.circulatory) / mass[:, None] / _SCALE
    system[np.ix_(speeds, speeds)] = -linear.damping / mass[:, None]
    if driveline is not None:
        car = _car_jacobian(driveline)
        taken = np.concatenate([speeds[:2], rest])
        onto = np.array([1.0, -1.0]) / mass[:2]
        system[np.ix_(speeds[:2], taken)] += onto[:, None] * car[states:]
        system[np.ix_(rest, taken)] = car[:states]
    mesh = np.outer(linear.stiffness[0], linear.stiffness[0]) / linear.stiffness[0, 0]
    found = []
    for value, vector in _oscillating(system):
        shape, motion, at_car = vector[q] / _SCALE, vector[speeds], vector[rest]
        strained = {
            name: 0.5 * float((shape.conj() @ matrix @ shape).real)
            for name, matrix in zip(AXLE_SPRINGS, (mesh, linear.stiffness - mesh), strict=True)
        }
        turned = {
            name: 0.5 * float(sum(mass[i] * abs(motion[i]) ** 2 for i in places))
            for name, places in _MOVING.items()
        }
        energy = {**turned, **_energies(moving, at_car)}
        largest = shape[np.argmax(np.abs(motion) * np.sqrt(mass))]
        turned_real = (shape * abs(largest) / largest).real
        found.append(
            DrivelineMode(
                eigenvalue=value,
                motion=_shares(energy),
                strain=_shares({**strained, **_energies(springs, at_car)}),
                shape=turned_real * abs(value) / np.sqrt(2.0 * sum(energy.values())),
            )
        )
    return tuple(found)


def _car_jacobian(driveline: Driveline) -> Array:
    """Return the derivatives of (y', T_p, T_w) by (pinion speed, wheel speed, y)."""
    import casadi as ca

    steady, size = driveline.steady, len(STATES) - 1
    y, u = ca.MX.sym("y", size), ca.MX.sym("u", 2)
    inputs = [float(steady.state[INDEX["vehicle_speed"]]), steady.engine_torque, 0.0]
    rates, torques, _, _ = driveline.equations(ca.vertcat(0.0, y), u, inputs)
    derivatives = ca.jacobian(ca.vertcat(rates[1:], torques), ca.vertcat(u, y))
    at = [steady.state[1:], [steady.pinion_speed, steady.wheel_speed]]
    return np.array(ca.Function("jacobian", [y, u], [derivatives])(*at))


def _oscillating(system: Array) -> list[tuple[complex, NDArray[np.complex128]]]:
    """Return the eigenvalues with positive imaginary part, by frequency, and their vectors."""
    values, vectors = np.linalg.eig(system)
    pairs = [
        (complex(value), vector)
        for value, vector in zip(values, vectors.T, strict=True)
        if value.imag > 1e-6 * abs(value) and abs(value) > _STILL
    ]
    return sorted(pairs, key=lambda pair: abs(pair[0]))


def _parts(driveline: Driveline) -> tuple[dict[str, tuple[int, float]], ...]:
    """Return the moving parts and the springs of the car: place of the state, inertia or stiffness.

    States are counted without the crank angle.
    """
    a, engine = driveline.parameters, driveline.parameters.engine
    motor = engine.kind == "electric_motor"
    inertias = {
        "rotor" if motor else "crankshaft": ("crank_speed", engine.primary_inertia),
        "gearbox": ("gearbox_speed", a.gearbox_input_inertia(driveline.gear_ratio)),
        "wheels": ("hub_speed", 2.0 * a.wheel_inertia),
        "vehicle": ("vehicle_speed", a.translating_mass),
    }
    springs = {
        "motor shaft" if motor else "flywheel springs": (
            "flywheel_twist",
            engine.flywheel_stiffness,
        ),
        "propshaft": ("propshaft_twist", a.propshaft_stiffness),
        "half-shafts": ("half_shaft_twist", a.half_shaft_stiffness),
        "tyres": ("tyre_deflection", a.tyre_stiffness),
    }
    return tuple(
        {name: (INDEX[state] - 1, size) for name, (state, size) in parts.items()}
        for parts in (inertias, springs)
    )


def _energies(
    parts: dict[str, tuple[int, float]], vector: NDArray[np.complex128]
) -> dict[str, float]:
    return {name: 0.5 * size * abs(vector[at]) ** 2 for name, (at, size) in parts.items()}


def _shares(energy: dict[str, float]) -> dict[str, float]:
    total = sum(energy.values())
    return {name: float(value / total) for name, value in energy.items()}
