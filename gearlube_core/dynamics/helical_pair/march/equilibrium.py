"""Static equilibrium and natural frequencies of the marching model: kernels."""

from __future__ import annotations

import math
from typing import TypeAlias

from gearlube_core.arrays import Array
from gearlube_core.dynamics.helical_pair.march.flanks import (
    FLANK_POINTS,
    N_FRICTION,
    MarchConstants,
    MotionConstants,
)
from gearlube_core.dynamics.helical_pair.march.line_points import refresh_friction
from gearlube_core.dynamics.helical_pair.march.mesh_data import (
    LEAST_OFFSET,
    MeshFields,
    largest_offset,
    laws_of_oil,
    mean_density,
    mesh_at_torque,
)
from gearlube_core.dynamics.helical_pair.march.rates import march_rates
from gearlube_core.dynamics.helical_pair.march.state import (
    LOAD_TORQUE,
    MU,
    N_LATERAL,
    N_ODE,
    N_STATE,
    PSI,
    REFRESHED,
    U_P,
    V_P,
    W_G,
    W_P,
    pair_motion,
)
from gearlube_core.kernels.array_part import part
from gearlube_core.kernels.damped_newton import damped_newton, newton_work_size
from gearlube_core.kernels.flat_tuples import tuple_from_array
from gearlube_core.kernels.jit import kernel
from gearlube_core.kernels.spectral_radius import spectral_radius
from gearlube_core.oil.lubricant import lubricant_state

OK = 0
NO_EQUILIBRIUM = 1
NO_FREQUENCIES = 2

MAX_UNKNOWNS = 1 + N_LATERAL  # relative rotation, displacements and tilts
# m and rad per compression: what matters; a difference of a thousandth does not end contact
_SHARE = 0.1
_LEAST_SCALE = 1e-12  # m and rad
_FILM_PASSES = 4  # friction of the film depends on the loads, weakly
_DIFFERENCE = 1e-8  # m and rad: small against micrometres of deflection
_OUT_OF_BALANCE = 1e-6  # of the mesh force
_FULL_CONTACT = 1e-5  # m, compression at which all lines touch

# pair data, state, rates of change, places of the unknowns, forces per rate, pinion torque [N.m]
Equilibrium: TypeAlias = tuple[Array, Array, Array, Array, Array, float]


@kernel
def row_of(place: int) -> int:
    """Return the place of the acceleration that belongs to a displacement at `place`."""
    return W_P if place == PSI else place + (V_P - U_P)


@kernel
def free_places(motion: MotionConstants, places: Array, forces: Array) -> int:
    """Write what is free and the force per acceleration of each; return how many there are.

    First the relative rotation, then the displacements and tilts that are not held.
    """
    p = motion.pinion
    g = motion.gear
    mobilities = (
        p.mobility, p.mobility, p.mobility_z, p.mobility_a, p.mobility_a,
        g.mobility, g.mobility, g.mobility_z, g.mobility_a, g.mobility_a,
    )  # fmt: skip
    places[0] = PSI
    forces[0] = 1.0 / (p.mobility_r * motion.flanks.plane.r_bp)
    n = 1
    for i in range(N_LATERAL):
        if mobilities[i] > 0.0:
            places[n] = U_P + i
            forces[n] = 1.0 / mobilities[i]
            n += 1
    return n


@kernel
def unbalanced(u: Array, problem: Equilibrium, out: Array) -> None:
    """Write the forces out of balance [N, N.m] at displacements `u` [m, rad], put into the state.

    That of the relative rotation acts along the line of action.
    """
    data, s, slope, places, forces, torque = problem
    for i in range(u.size):
        s[int(places[i])] = u[i]
    march_rates(s, torque, 0.0, data, slope)
    for i in range(u.size):
        out[i] = forces[i] * slope[row_of(int(places[i]))]


_solve = damped_newton(unbalanced)

NEWTON_WORK = newton_work_size(MAX_UNKNOWNS)
_SLOPE = 0  # places in the work array
_PLACES = _SLOPE + N_ODE
_FORCES = _PLACES + MAX_UNKNOWNS
_UNKNOWNS = _FORCES + MAX_UNKNOWNS
_SCALES = _UNKNOWNS + MAX_UNKNOWNS
_OUT = _SCALES + MAX_UNKNOWNS
_NEWTON = _OUT + MAX_UNKNOWNS
EQUILIBRIUM_WORK = _NEWTON + max(NEWTON_WORK, 2 * MAX_UNKNOWNS**2)


@kernel
def settle(
    s: Array,
    pinion_torque: float,
    pinion_speed: float,
    oil_temperature: float,
    mesh: MeshFields,
    data: Array,
    work: Array,
) -> tuple[int, float]:
    """Put a state into static equilibrium under a pinion torque, turning.

    Parameters
    ----------
    s : ndarray of shape (N_STATE,)
        State whose load level is that of the mesh.
    pinion_torque, pinion_speed, oil_temperature
        [N.m], [rad/s], [K]; the wheel bears what the pinion gives.
    mesh, data
        As in `integrate.advance`.
    work : ndarray of shape (EQUILIBRIUM_WORK,)

    Returns
    -------
    tuple of (int, float)
        OK or NO_EQUILIBRIUM, and the largest force out of balance [N].

    Notes
    -----
    Friction of the film is computed anew after each of a few solutions. Without torque any place
    between the flanks is an equilibrium; the one found is where the drive flanks just touch, or
    the middle of a backlash below twice that distance.
    """
    p: MarchConstants = tuple_from_array(data, MarchConstants)
    motion = p.motion
    flanks = motion.flanks
    plane = flanks.plane
    slope = work[_SLOPE:_PLACES]
    places = work[_PLACES:_FORCES]
    forces = work[_FORCES:_UNKNOWNS]
    n = free_places(motion, places, forces)
    u = work[_UNKNOWNS : _UNKNOWNS + n]
    scales = work[_SCALES : _SCALES + n]
    out = work[_OUT : _OUT + n]
    s[W_P] = pinion_speed
    s[W_G] = pinion_speed * plane.r_bp / plane.r_bg
    mesh_at_torque(s[LOAD_TORQUE], mesh, data)
    force = pinion_torque / plane.r_bp
    # pressed until all lines touch: outside contact the forces have no slope to follow
    pressed = 2.0 * abs(force) / (plane.W * mean_density(mesh)) + largest_offset(mesh)
    for i in range(n):
        u[i] = 0.0
        scales[i] = max(_LEAST_SCALE, _SHARE * pressed)
    u[0] = pressed / plane.cos_b
    if pinion_torque == 0.0:
        u[0] = max(data[LEAST_OFFSET], -0.5 * flanks.backlash) / plane.cos_b
    if pinion_torque < 0.0:
        u[0] = -u[0] - flanks.backlash / plane.cos_b
    problem = (data, s, slope, places, forces, pinion_torque)
    oil = lubricant_state(p.oil, oil_temperature, laws_of_oil(*mesh))
    worst = math.inf
    for _ in range(_FILM_PASSES if p.friction_form > 0.0 else 1):
        _solve(u, scales, problem, work[_NEWTON:])
        unbalanced(u, problem, out)
        worst = 0.0
        for i in range(n):
            worst = max(worst, abs(out[i])) if abs(out[i]) < math.inf else math.inf
        if p.friction_form > 0.0:
            s[REFRESHED] = -1.0
            refresh_friction(pair_motion(s), part(s, REFRESHED, N_FRICTION), data, oil)
    if worst <= _OUT_OF_BALANCE * max(abs(force), 1.0):
        return OK, worst
    return NO_EQUILIBRIUM, worst


@kernel
def rest(
    s: Array,
    pinion_torque: float,
    pinion_speed: float,
    oil_temperature: float,
    mesh: MeshFields,
    data: Array,
    work: Array,
) -> tuple[int, float]:
    """Write the equilibrium at mesh phase zero into a state; return as `settle` does."""
    p: MarchConstants = tuple_from_array(data, MarchConstants)
    for i in range(N_STATE):
        s[i] = 0.0
    s[LOAD_TORQUE] = abs(pinion_torque)
    for i in range(2 * FLANK_POINTS):
        s[MU + i] = p.mu
    s[REFRESHED] = -1.0
    return settle(s, pinion_torque, pinion_speed, oil_temperature, mesh, data, work)


@kernel
def stiffness_over_mass(s: Array, mesh: MeshFields, data: Array, work: Array, matrix: Array) -> int:
    """Write M^-1 K about a state, row by row [rad2/s2]; return its number of rows.

    Its eigenvalues are the squares of the natural frequencies.

    Parameters
    ----------
    s : ndarray of shape (N_STATE,)
        Velocities in it are left out; displaced and put back.
    mesh, data
        As in `integrate.advance`.
    work : ndarray of shape (EQUILIBRIUM_WORK,)
    matrix : ndarray of shape (MAX_UNKNOWNS**2,)
    """
    motion: MotionConstants = tuple_from_array(data, MotionConstants)
    plane = motion.flanks.plane
    slope = work[_SLOPE:_PLACES]
    places = work[_PLACES:_FORCES]
    n = free_places(motion, places, work[_FORCES:_UNKNOWNS])
    mesh_at_torque(s[LOAD_TORQUE], mesh, data)
    for i in range(N_LATERAL):
        s[V_P + i] = 0.0
    s[W_G] = s[W_P] * plane.r_bp / plane.r_bg
    for j in range(n):
        place = int(places[j])
        here = s[place]
        for i in range(n):
            matrix[i * n + j] = 0.0
        for side in range(2):
            sign = 1.0 - 2.0 * side
            s[place] = here + sign * _DIFFERENCE
            march_rates(s, 0.0, 0.0, data, slope)
            factor = -sign / (2.0 * _DIFFERENCE)
            matrix[j] += factor * (plane.r_bp * slope[W_P] - plane.r_bg * slope[W_G])
            for i in range(1, n):
                matrix[i * n + j] += factor * slope[row_of(int(places[i]))]
        s[place] = here
    return n


@kernel
def highest_frequency(
    s: Array,
    pinion_torque: float,
    oil_temperature: float,
    mesh: MeshFields,
    data: Array,
    work: Array,
) -> tuple[int, float]:
    """Return a status and the highest natural frequency [Hz] with all lines in contact.

    Parameters
    ----------
    s : ndarray of shape (N_STATE,)
        In equilibrium under the pinion torque [N.m]; changed.
    oil_temperature
        [K]
    mesh, data, work
        As in `settle`.

    Returns
    -------
    tuple of (int, float)
        OK, NO_EQUILIBRIUM or NO_FREQUENCIES, and the frequency; without equilibrium the force out
        of balance [N].
    """
    motion: MotionConstants = tuple_from_array(data, MotionConstants)
    plane = motion.flanks.plane
    pressed = plane.r_bp * plane.W * mean_density(mesh) * _FULL_CONTACT
    if abs(pinion_torque) < pressed:
        least = -pressed if pinion_torque < 0.0 else pressed
        status, worst = settle(s, least, s[W_P], oil_temperature, mesh, data, work)
        if status != OK:
            return status, worst
    matrix = work[_NEWTON : _NEWTON + MAX_UNKNOWNS**2]
    n = stiffness_over_mass(s, mesh, data, work, matrix)
    square = spectral_radius(matrix, n, work[_NEWTON + MAX_UNKNOWNS**2 : EQUILIBRIUM_WORK])
    return OK if square < math.inf else NO_FREQUENCIES, math.sqrt(square) / (2.0 * math.pi)
