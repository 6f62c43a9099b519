"""Points on the contact lines of a helical pair over a mesh period, and their loads."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.checks import check_positive, check_within
from gearlube_core.contact.greenwood_tripp_1971 import SurfaceParameters
from gearlube_core.contact.hertz import line_mean_pressure
from gearlube_core.contact.solid import SolidParameters
from gearlube_core.errors import ParameterError
from gearlube_core.film.line_film import line_film_thickness
from gearlube_core.friction.flank_data import CONSISTENT
from gearlube_core.friction.mixed_friction import SPEED_FLOOR, mixed_friction
from gearlube_core.helical_geometry.contact_line import (
    clip_line,
    line_count,
    line_position,
    pitch_crossing,
)
from gearlube_core.helical_geometry.pair import HelicalPair
from gearlube_core.kernels.jit import kernel
from gearlube_core.mesh_table.line_mesh import LineMesh
from gearlube_core.oil.lubricant_state import LubricantState

LINE_LOAD_FLOOR = 1.0  # N/m, film and pressure of an unloaded line are those at this floor
# Round source with the mean rise of a resting strip of length 200 half widths b: radius 4.7 b.
# Of a strip the rise grows with the logarithm of its length: 50 b to 1000 b are -22 to +26 %.
STILL_AREA_OVER_WIDTH_SQUARED = math.pi * (0.5 * 4.7) ** 2
_SAME_PITCH = 1e-6  # relative; tables print the base pitch with fewer digits than a pair has


class LineState(NamedTuple):
    """Film and friction at one point of a contact line; all floats, SI."""

    film_thickness: float  # central film [m]
    film_ratio: float  # film over composite roughness [-]
    viscous_friction: float  # [N/m], not negative
    boundary_friction: float  # [N/m], not negative
    friction_coefficient: float  # total friction over line load [-], not negative
    signed_coefficient: float  # the same with the sign of the sliding speed [-]
    temperature_rise: float  # mean of the film over the oil [K]
    mean_pressure: float  # [Pa]


@kernel
def line_friction(
    line_load: float,
    R: float,
    entrainment_speed: float,
    sliding_speed: float,
    lubricant: LubricantState,
    surface: SurfaceParameters,
    solid: SolidParameters,
) -> LineState:
    """Return film, friction and temperature at a point of a contact line.

    f_v = mu (w - w_a),  f_b = tau_l0 A_a + gamma w_a,  0 <= w_a <= w,  per unit length

    Parameters
    ----------
    line_load
        w, normal load per unit length of the line [N/m]; not positive: no friction.
    R
        Relative radius of curvature across the line [m].
    entrainment_speed
        Mean surface speed across the line (u_1 + u_2)/2 [m/s], either sign.
    sliding_speed
        u_1 - u_2 across the line [m/s], either sign.
    lubricant
        Lubricant at oil temperature.
    surface
        Roughness of the pair.
    solid
        Elastic and thermal data of the pair.

    Returns
    -------
    LineState
        `signed_coefficient` times line load is the friction on surface 2 along its motion, and
        minus that on surface 1. Of a helical pair, 1 the pinion: the force on the pinion along
        the y of He et al. 2007, as mu sgn(x - x_p) is there.

    Notes
    -----
    Range: that of `line_film_thickness`, `line_mean_pressure`, `plateau_stress_ratio` and
    `asperity_load`. The signed coefficient passes through zero with the sliding speed: traction
    over micrometres per second, as the isothermal Eyring film does, boundary friction over
    `BOUNDARY_SPEED`. Flanks on parallel axes do not slide along the line. Heat at rest is that of
    a strip of length 200 half widths.
    Source: [dowson_toyoda_1979] for the film; `mixed_friction` for the
    rest, with the notes of `flank_friction`.
    """
    w = max(line_load, 0.0)
    w_film = max(w, LINE_LOAD_FLOOR)
    speed = max(abs(entrainment_speed), SPEED_FLOOR)
    p = line_mean_pressure(w_film, R, solid.contact_modulus)
    h = line_film_thickness(
        R, lubricant.eta0, lubricant.alpha, speed, w_film, 2.0 * solid.contact_modulus
    )
    width = w_film / p
    friction = mixed_friction(
        w,
        w_film,
        p,
        h,
        speed,
        abs(sliding_speed),
        R,
        STILL_AREA_OVER_WIDTH_SQUARED * width * width,
        lubricant,
        surface,
        solid,
        CONSISTENT,
    )
    mu = friction.friction_coefficient
    return LineState(
        h,
        friction.film_ratio,
        friction.viscous_friction,
        friction.boundary_friction,
        mu,
        -mu if sliding_speed < 0.0 else mu,
        friction.temperature_rise,
        p,
    )


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class LinePoints:
    """Gauss points on all lines of a mesh period, on either side of the pitch line.

    Parameters
    ----------
    pair : HelicalPair
        The gears.
    phase : ndarray of shape (N,)
        Mesh phases [mesh periods], equally spaced from 0.
    x, z : ndarray of shape (N, lines, M)
        Along the line of action and the axis [m].
    length : ndarray of shape (N, lines, M)
        Weight of a point: length of line it stands for [m]; zero on an empty line.
    station : ndarray of shape (N, lines, M)
        Along the line's segment, 0 at its low z to 1 [-].
    """

    pair: HelicalPair
    phase: Array
    x: Array
    z: Array
    length: Array
    station: Array

    @property
    def total_length(self) -> Array:
        """Total length of all lines at each phase [m], shape (N,)."""
        return np.asarray(self.length.sum(axis=(1, 2)))


def line_points(pair: HelicalPair, phases: int = 48, nodes: int = 12) -> LinePoints:
    """Return the points of a mesh period.

    Parameters
    ----------
    pair : HelicalPair
        Helical or spur gears.
    phases : int
        Number of mesh phases.
    nodes : int
        Gauss points of a segment on either side of the pitch line.

    Returns
    -------
    LinePoints
        With M = 2 nodes points a line. Integrals over a line are exact for polynomials of degree
        2 nodes - 1 times the magnitude of sliding; the mean over phases of a helical pair
        converges with 1/phases^2, of spur gears, whose lines come and go at once, with 1/phases.
    """
    check_within("phases", phases, 1, 100_000)
    check_within("nodes", nodes, 1, 200)
    plane = pair.plane
    lines = line_count(plane)
    phase = np.arange(phases) / phases
    points, weights = np.polynomial.legendre.leggauss(nodes)
    x, z, length, station = (np.zeros((phases, lines, 2 * nodes)) for _ in range(4))
    for n in range(phases):
        for i in range(lines):
            X = line_position(float(phase[n]), i, plane)
            segment = clip_line(X, plane)
            pitch_z = pitch_crossing(X, segment, plane)
            for part, (low, high) in enumerate(
                ((segment.z_low, pitch_z), (pitch_z, segment.z_high))
            ):
                where = (n, i, slice(part * nodes, (part + 1) * nodes))
                z[where] = 0.5 * (low + high) + 0.5 * (high - low) * points
                length[where] = 0.5 * (high - low) * weights / plane.cos_b
            x[n, i] = X - (0.5 * plane.W - z[n, i]) * plane.sin_b / plane.cos_b
            width = segment.z_high - segment.z_low
            if width > 0.0:
                station[n, i] = (z[n, i] - segment.z_low) / width
            else:
                x[n, i] = plane.P
    return LinePoints(pair=pair, phase=phase, x=x, z=z, length=length, station=station)


def normal_force(pair: HelicalPair, pinion_torque: float) -> float:
    """Return the total force of all lines, normal to the flanks [N].

    F_n = T_p/(r_bp cos b)

    Notes
    -----
    Without friction, whose moment is below mu times the contact length over the base radius.
    """
    check_positive("pinion_torque", pinion_torque, "N.m", "Give the magnitude.")
    return pinion_torque / (pair.pinion_base_radius * math.cos(pair.base_helix_angle))


def uniform_line_load(points: LinePoints, pinion_torque: float) -> Array:
    """Return one load per length on all lines of a phase.

    w = F_n/sum of L

    Returns
    -------
    ndarray of shape (N, lines, M)
        [N/m]; zero on empty lines. He et al. 2007 with rigid, parallel bodies.
    """
    load = normal_force(points.pair, pinion_torque) / points.total_length
    return np.where(points.length > 0.0, load[:, None, None], 0.0)


def table_line_load(points: LinePoints, mesh: LineMesh, pinion_torque: float) -> Array:
    """Return the loads of a table of elastic contact lines.

    w = max[k (delta - e), 0] with delta such that the lines carry F_n together

    Parameters
    ----------
    points : LinePoints
        Of the pair that the table is for.
    mesh : LineMesh
        Interpolated linearly in torque, in phase (period 1) and along the station.
    pinion_torque : float
        [N.m], within the torques of a table of several levels.

    Returns
    -------
    ndarray of shape (N, lines, M)
        [N/m]. Rigid parallel bodies: one compression delta for all lines of a phase.

    Raises
    ------
    ParameterError
        Another pair's table, or a torque outside it.
    """
    force = normal_force(points.pair, pinion_torque)
    pair = points.pair
    if (mesh.pinion_teeth, mesh.gear_teeth) != (pair.pinion_teeth, pair.gear_teeth) or abs(
        mesh.base_pitch / pair.base_pitch - 1.0
    ) > _SAME_PITCH:
        raise ParameterError(
            f"mesh must be of the pair {pair.name} ({pair.pinion_teeth}/{pair.gear_teeth} teeth, "
            f"base pitch {pair.base_pitch:.7g} m), got {mesh.name} "
            f"({mesh.pinion_teeth}/{mesh.gear_teeth}, {mesh.base_pitch:.7g} m). Use the mesh of "
            "this pair."
        )
    if mesh.lines < points.x.shape[1]:
        raise ParameterError(
            f"mesh must hold the {points.x.shape[1]} lines of {pair.name}, got {mesh.lines}."
        )
    density, offset = _at_torque(mesh, pinion_torque)
    k, e = _at_points(mesh, density, points), _at_points(mesh, offset, points)
    load = np.zeros_like(k)
    for n in range(points.phase.size):
        load[n] = _pressed(k[n], e[n], points.length[n], force)
    return load


def _at_torque(mesh: LineMesh, torque: float) -> tuple[Array, Array]:
    """Return density and offset at a torque, shape (phases, lines, stations)."""
    if mesh.torque.size == 1:
        return mesh.density[0], mesh.offset[0]
    low, high = float(mesh.torque[0]), float(mesh.torque[-1])
    check_within("pinion_torque", torque, low, high, "N.m", f"The table {mesh.name} ends there.")
    i = min(int(np.searchsorted(mesh.torque, torque, side="right")) - 1, mesh.torque.size - 2)
    t = (torque - mesh.torque[i]) / (mesh.torque[i + 1] - mesh.torque[i])
    return (
        (1.0 - t) * mesh.density[i] + t * mesh.density[i + 1],
        (1.0 - t) * mesh.offset[i] + t * mesh.offset[i + 1],
    )


def _at_points(mesh: LineMesh, values: Array, points: LinePoints) -> Array:
    """Return values of the table at the points; the end values beyond the outer stations.

    Past the last phase a line is followed into the next period, where its number is one higher.
    """
    N, lines = mesh.phase.size, points.x.shape[1]
    result = np.empty_like(points.x)
    for n, phase in enumerate(points.phase):
        position = phase * N
        first = int(position) % N
        t = position - int(position)
        for i in range(lines):
            here = np.interp(points.station[n, i], mesh.station, values[first, i])
            if t > 0.0:
                wraps = first + 1 == N
                line = i + 1 if wraps else i
                if line < mesh.lines:  # the oldest one has left by the next period
                    after = values[0 if wraps else first + 1, line]
                    later = np.interp(points.station[n, i], mesh.station, after)
                    here = (1.0 - t) * here + t * later
            result[n, i] = here
    return result


def _pressed(k: Array, e: Array, length: Array, force: float) -> Array:
    """Return the loads max[k (delta - e), 0] [N/m] that add up to a force."""
    stiffness = k * length
    active = stiffness > 0.0
    while active.any():
        delta = (force + (stiffness * e)[active].sum()) / stiffness[active].sum()
        still = active & (e < delta)
        if (still == active).all():
            return np.where(active, k * (delta - e), 0.0)
        active = still
    raise ParameterError(
        "mesh must have a line with density above zero at every phase, got none. Check the table."
    )
