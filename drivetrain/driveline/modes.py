"""Natural modes of the driveline."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from drivetrain.driveline.equations import INDEX
from drivetrain.driveline.model import Driveline
from drivetrain.driveline.steady_state import GEAR_INERTIA, PINION_INERTIA, rigid_axle_jacobian


@dataclass(frozen=True, slots=True, kw_only=True)
class DrivelineMode:
    """One oscillating mode.

    Parameters
    ----------
    eigenvalue : complex
        s [1/s], imaginary part positive.
    motion : dict of str, float
        Share of every inertia in the kinetic energy of the mode [-].
    strain : dict of str, float
        Share of every spring in the potential energy [-].
    """

    eigenvalue: complex
    motion: dict[str, float]
    strain: dict[str, float]

    @property
    def frequency(self) -> float:
        """Undamped natural frequency abs(s) / (2 pi) [Hz]."""
        return abs(self.eigenvalue) / (2.0 * np.pi)

    @property
    def damping_ratio(self) -> float:
        """-Re(s) / abs(s) [-]."""
        return -self.eigenvalue.real / abs(self.eigenvalue)

    @property
    def name(self) -> str:
        """The inertia that moves most, on the spring that is strained most."""
        inertia = max(self.motion, key=self.motion.__getitem__)
        spring = max(self.strain, key=self.strain.__getitem__)
        return f"{inertia} on {spring}"


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
    eigenvalues, vectors = np.linalg.eig(jacobian)
    a, engine = parameters, parameters.engine
    axle = pinion_inertia + gear_inertia / a.axle_ratio**2
    motor = engine.kind == "electric_motor"
    inertias = {
        "rotor" if motor else "crankshaft": (INDEX["crank_speed"] - 1, engine.primary_inertia),
        "gearbox": (INDEX["gearbox_speed"] - 1, a.gearbox_input_inertia(steady.gear_ratio)),
        "axle": (len(jacobian) - 1, axle),
        "wheels": (INDEX["hub_speed"] - 1, 2.0 * a.wheel_inertia),
        "vehicle": (INDEX["vehicle_speed"] - 1, a.translating_mass),
    }
    springs = {
        "motor shaft" if motor else "flywheel springs": (
            INDEX["flywheel_twist"] - 1,
            engine.flywheel_stiffness,
        ),
        "propshaft": (INDEX["propshaft_twist"] - 1, a.propshaft_stiffness),
        "half-shafts": (INDEX["half_shaft_twist"] - 1, a.half_shaft_stiffness),
        "tyres": (INDEX["tyre_deflection"] - 1, a.tyre_stiffness),
    }
    modes = [
        DrivelineMode(
            eigenvalue=complex(value),
            motion=_shares(inertias, vector),
            strain=_shares(springs, vector),
        )
        for value, vector in zip(eigenvalues, vectors.T, strict=True)
        if value.imag > 1e-6 * abs(value)
    ]
    return tuple(sorted(modes, key=lambda mode: -mode.frequency))


def _shares(
    elements: dict[str, tuple[int, float]], vector: NDArray[np.complex128]
) -> dict[str, float]:
    energy = {name: size * abs(vector[index]) ** 2 for name, (index, size) in elements.items()}
    total = sum(energy.values())
    return {name: float(value / total) for name, value in energy.items()}
