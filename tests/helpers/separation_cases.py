"""Pairs with tooth separation for tests: that of He et al. 2007, helical and made spur."""

from dataclasses import replace

import numpy as np

from gearlube_core.dynamics.helical_pair.parameters import HelicalPairParameters
from gearlube_core.dynamics.helical_pair.separation.problem import SeparationProblem
from gearlube_core.helical_geometry.pair import HelicalPair
from gearlube_core.mesh_table.line_mesh import LineMesh
from gearlube_core.periodic.shooting import PeriodicMotion, solve_periodic
from tests.helpers.he_2007 import he_2007_pair
from tests.helpers.named_pairs import named_pair


def spur_geometry() -> HelicalPair:
    """The transverse section of the helical pair as a spur pair."""
    pair = named_pair("he_2007")
    return replace(
        pair,
        name="spur",
        helix_angle=0.0,
        normal_module=pair.transverse_module,
        normal_pressure_angle=pair.transverse_pressure_angle,
    )


def separating_pair(
    *, zeta: float = 0.02, mu: float = 0.0, pair: HelicalPair | None = None, **changes: object
) -> HelicalPairParameters:
    """The pair at 2000 lbf in with one damping ratio for all motions, 0.1 mm of backlash."""
    return replace(
        he_2007_pair(mu, pair),
        contact="one_sided",
        mesh_damping_ratio=zeta,
        support_damping_ratio=zeta,
        **changes,
    )


def separated_motion(
    parameters: HelicalPairParameters, ratio: float = 0.95, **options: int
) -> tuple[SeparationProblem, float, PeriodicMotion]:
    """The motion with separation below resonance, reached by slowing down from above it."""
    problem = SeparationProblem(parameters, **options)
    z = problem.initial_guess()
    for speed in np.array([1.02, 1.0, 0.98, 0.96, ratio]) * problem.natural_speed:
        z = problem.march(z, speed, periods=60)
    speed = ratio * problem.natural_speed
    return problem, speed, solve_periodic(problem.over_speed(), z, speed)


def crowned_mesh(pair: HelicalPair, *, crown: float, torque: tuple[float, ...]) -> LineMesh:
    """Lines with parabolic offsets that open by `crown` [m] at both ends, softer at low torque."""
    station = np.linspace(0.0, 1.0, 5)
    gap = crown * (2.0 * station - 1.0) ** 2
    stiffness = 1.3e10 * (np.asarray(torque) / max(torque)) ** 0.1
    slack = np.linspace(1.0, 0.9, len(torque))
    shape = (len(torque), 1, 3, station.size)
    return LineMesh(
        name="crowned",
        source="made up",
        pinion_teeth=pair.pinion_teeth,
        gear_teeth=pair.gear_teeth,
        base_pitch=pair.base_pitch,
        torque=np.asarray(torque),
        phase=np.zeros(1),
        station=station,
        density=np.broadcast_to(stiffness[:, None, None, None], shape),
        offset=gap * np.broadcast_to(slack[:, None, None, None], shape),
    )
