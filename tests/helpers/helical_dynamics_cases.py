"""Helical pairs of the tests, and routes to their forces that share nothing with the kernels."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from gearlube_core.dynamics.helical_pair.gear_file_pair import constant_density_mesh
from gearlube_core.dynamics.helical_pair.kernel_parameters import (
    MeshArrays,
    PairConstants,
    SupportArrays,
)
from gearlube_core.dynamics.helical_pair.mesh.contact_points import (
    LENGTH,
    LOAD,
    N_COLUMNS,
    X,
    Z,
    constant_friction,
    contact_points,
    point_capacity,
)
from gearlube_core.dynamics.helical_pair.mesh.mesh_wrench import mesh_strain, wrench_of_sums
from gearlube_core.dynamics.helical_pair.parameters import HelicalPairParameters
from gearlube_core.dynamics.helical_pair.supports import Bearing, ShaftEnds, ShaftSupport
from gearlube_core.kernels.jit import kernel
from tests.helpers.he_2007 import he_2007_pair
from tests.helpers.helical_accelerations import pair_accelerations
from tests.helpers.helical_mesh_points import line_loads, load_sums
from tests.helpers.named_pairs import named_pair

SPEED = 1000.0 * math.pi / 30.0  # rad/s


def spur_pair(mu: float) -> HelicalPairParameters:
    """Return the pair of He et al. 2007 with helix angle zero and the same transverse profile."""
    helical = named_pair("he_2007")
    spur = replace(
        helical,
        name="spur",
        helix_angle=0.0,
        normal_module=helical.transverse_module,
        normal_pressure_angle=helical.transverse_pressure_angle,
    )
    return he_2007_pair(mu, spur)


def estimated_pair(mu: float) -> HelicalPairParameters:
    """Return the pair of He et al. 2007 with 1.316e10 N/m2, estimated with a rack of 1.2 modules.

    The expected numbers were computed with it, apart from this code.
    """
    pair = he_2007_pair(mu)
    return replace(pair, mesh=constant_density_mesh(pair.pair, 1.316e10, "estimated"))


def symmetric_support(
    *, K_xx: float, K_yy: float, K_zz: float, distance: float, shaft: ShaftEnds | None = None
) -> ShaftSupport:
    """Return two equal bearings at +-`distance` [m] that share the totals K [N/m] evenly."""
    halves = {"K_xx": 0.5 * K_xx, "K_yy": 0.5 * K_yy, "K_zz": 0.5 * K_zz}
    return ShaftSupport(
        first=Bearing(position=distance, **halves),
        second=Bearing(position=-distance, **halves),
        shaft=shaft,
    )


def random_state(rng: np.random.Generator) -> np.ndarray:
    """Return displacements of some micrometres and rotations that move teeth as far, (12,)."""
    scale = np.array([1e-6] * 3 + [3e-5] * 3)
    return rng.normal(size=12) * np.tile(scale, 2)


def loaded_points(
    parameters: HelicalPairParameters, phase: float, q: np.ndarray
) -> tuple[np.ndarray, np.ndarray, float]:
    """Return contact points with loads, the mesh's forces (12,) and k_m."""
    c, mesh = parameters.kernel_parameters(), parameters.mesh_arrays()
    points = np.zeros((point_capacity(mesh), N_COLUMNS))
    n = contact_points(phase, SPEED, c.plane, mesh, points)
    k_m = line_loads(*mesh_strain(q, c.plane), c, points, n)
    constant_friction(parameters.mu, points, n)
    sums, wrench = np.zeros(5), np.zeros(12)
    load_sums(c, points, n, sums)
    wrench_of_sums(sums, c.plane, wrench)
    return points[:n], wrench, k_m


def summed_wrench(parameters: HelicalPairParameters, points: np.ndarray) -> np.ndarray:
    """Return forces and moments on both members by vectors: force times arm, point by point."""
    plane = parameters.pair.plane
    normal = np.array([-plane.cos_b, 0.0, plane.sin_b])
    gear_centre = np.array([plane.x_g, plane.r_bp + plane.r_bg, 0.0])
    total = np.zeros(12)
    for point in points:
        place = np.array([point[X], plane.r_bp, point[Z]])
        load = point[LOAD] * point[LENGTH]
        friction = parameters.mu * load * np.sign(point[X] - plane.P)
        force = load * normal + np.array([0.0, friction, 0.0])
        total[:3] += force
        total[3:6] += np.cross(place, force)
        total[6:9] -= force
        total[9:] -= np.cross(place - gear_centre, force)
    return total


@kernel
def state_rates(
    phase: float,
    state: np.ndarray,
    mu: float,
    c: PairConstants,
    mesh: MeshArrays,
    supports: SupportArrays,
    points: np.ndarray,
    work: np.ndarray,
) -> np.ndarray:
    """Return the rates of (q, v), for integrators of others; `work` has shape (3, 12)."""
    q, v = state[:12], state[12:]
    n = contact_points(phase, 1.0, c.plane, mesh, points)
    y0, y1 = mesh_strain(q, c.plane)
    line_loads(y0, y1, c, points, n)
    constant_friction(mu, points, n)
    rates = np.empty(24)
    pair_accelerations(q, v, c.T_p, c.T_g, c, supports, points, n, work[0], work[1][:5], work[2])
    rates[:12] = v
    rates[12:] = work[2]
    return rates
