"""The pairs on which the statements are judged, and their steady vibration."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cache

import numpy as np
import xarray as xr

from gearlube_core.arrays import Array
from gearlube_core.dynamics.helical_pair.gear_file_pair import constant_density_mesh
from gearlube_core.dynamics.helical_pair.linear.periodic_response import (
    PeriodicResponse,
    harmonics,
    periodic_response,
)
from gearlube_core.dynamics.helical_pair.mesh.contact_points import (
    N_COLUMNS,
    constant_friction,
    contact_points,
    point_capacity,
)
from gearlube_core.dynamics.helical_pair.mesh.mesh_wrench import mesh_strain, wrench_of_sums
from gearlube_core.dynamics.helical_pair.parameters import Form, HelicalPairParameters
from gearlube_core.helical_geometry.contact_line import (
    clip_line,
    line_count,
    line_position,
    segment_length,
)
from gearlube_core.helical_geometry.iso_6336_stiffness import rack_dedendum_of
from gearlube_core.helical_geometry.pair import HelicalPair
from tests.helpers.he_2007 import PINION_SPEED, PINION_TORQUE, he_2007_pair
from tests.helpers.helical_mesh_points import line_loads, load_sums
from tests.helpers.named_pairs import named_pair

HE = named_pair("he_2007")
LOW, HIGH = 0.01, 0.1  # mu of He et al. 2007, figures 6 to 8
ORDERS = 15


@dataclass(frozen=True, slots=True)
class Evidence:
    """What statements are judged by besides the steady vibration, which `steady` keeps.

    Parameters
    ----------
    contact : xr.Dataset
        Loaded contact of the pair of He et al. at its torque.
    """

    contact: xr.Dataset


def with_helix(angle: float) -> HelicalPair:
    """Return the pair with another helix angle [rad] and the same transverse section."""
    tan_t = math.tan(HE.transverse_pressure_angle)
    return replace(
        HE,
        name=f"helix {math.degrees(angle):g} deg",
        helix_angle=angle,
        normal_module=HE.transverse_module * math.cos(angle),
        normal_pressure_angle=math.atan(tan_t * math.cos(angle)),
    )


SPUR = replace(with_helix(0.0), name="spur")


@cache
def steady(mu: float, form: Form = "twelve_dof") -> PeriodicResponse:
    """Return the response at 1000 rpm and 2000 lbf in."""
    return periodic_response(replace(he_2007_pair(mu), form=form), PINION_SPEED)


@cache
def steady_with_helix(mu: float, angle: float) -> PeriodicResponse:
    """Return the same with another helix angle [rad] and the same stiffness density."""
    pair = with_helix(angle)
    mesh = constant_density_mesh(pair, density(), "He et al. 2007 eq. (2)")
    return periodic_response(replace(he_2007_pair(mu, pair), mesh=mesh), PINION_SPEED)


def growth(name: str, rate: bool = False) -> Array:
    """Return harmonics 1 to 15 of a signal at mu = 0.1 over those at 0.01."""
    read = PeriodicResponse.signal_rate if rate else PeriodicResponse.signal
    high, low = (harmonics(read(steady(mu), name), ORDERS) for mu in (HIGH, LOW))
    return np.asarray(high / low)


def at_orders(values: Array, *orders: int) -> Array:
    """Return the values of mesh orders."""
    return values[[n - 1 for n in orders]]


def pressed_points(
    parameters: HelicalPairParameters, phase: float, q: Array
) -> tuple[Array, Array]:
    """Return contact points with their loads, and forces and moments on both members (12,)."""
    c, mesh = parameters.kernel_parameters(), parameters.mesh_arrays()
    points = np.zeros((point_capacity(mesh), N_COLUMNS))
    n = contact_points(phase, PINION_SPEED, c.plane, mesh, points)
    line_loads(*mesh_strain(q, c.plane), c, points, n)
    constant_friction(parameters.mu, points, n)
    sums, wrench = np.zeros(5), np.zeros(12)
    load_sums(c, points, n, sums)
    wrench_of_sums(sums, c.plane, wrench)
    return points[:n], wrench


def random_state(rng: np.random.Generator) -> Array:
    """Return displacements of micrometres and rotations that move teeth as far, (12,)."""
    scale = np.array([1e-6] * 3 + [3e-5] * 3)
    return rng.normal(size=12) * np.tile(scale, 2)


def line_lengths(phase: Array, lines: int | None = None) -> Array:
    """Return the lengths of the contact lines at mesh phases [m], (phases, lines)."""
    plane = HE.plane
    count = int(line_count(plane)) if lines is None else lines
    return np.array(
        [
            [
                segment_length(clip_line(line_position(float(p), i, plane), plane), plane)
                for i in range(count)
            ]
            for p in phase
        ]
    )


def density() -> float:
    """Return the stiffness density of the pair's contact lines [N/m2]."""
    return float(he_2007_pair(0.0).mesh.density.mean())


def own_density() -> tuple[str, str, str]:
    """Return the density of `he_2007_pair`, and how deep the roots of both members are."""
    return (f"{1e-9 * density():.2f}", *(f"{one:.3f}" for one in rack_dedendum_of(HE)))


LINE_LOAD = PINION_TORQUE / HE.pinion_base_radius / HE.face_width  # N/m of face width
