"""Outputs of the marching model from its state: kernels."""

from __future__ import annotations

import math

from gearlube_core.arrays import Array
from gearlube_core.dynamics.helical_pair.march import output_names as at
from gearlube_core.dynamics.helical_pair.march.constants import MarchConstants, SupportConstants
from gearlube_core.dynamics.helical_pair.march.flank_views import (
    coast_view,
    drive_view,
    friction_direction,
)
from gearlube_core.dynamics.helical_pair.march.flank_wrench import flank_wrench, turned_wrench
from gearlube_core.dynamics.helical_pair.march.line_outputs import write_lines
from gearlube_core.dynamics.helical_pair.march.line_sums import line_sums
from gearlube_core.dynamics.helical_pair.march.mesh_data import MeshFields, mesh_at_torque
from gearlube_core.dynamics.helical_pair.march.rates import march_rates
from gearlube_core.dynamics.helical_pair.march.state import (
    FLANK_POINTS,
    LOAD_TORQUE,
    MU,
    N_ENERGIES,
    N_LATERAL,
    N_ODE,
    PHI_G,
    PHI_P,
    PINION_WORK,
    PSI,
    TIME_IN_STEP,
    U_G,
    U_P,
    V_G,
    V_P,
    W_G,
    W_P,
    WORK_MARK,
)
from gearlube_core.dynamics.mean_power import mean_power
from gearlube_core.kernels.flat_tuples import tuple_from_array
from gearlube_core.kernels.jit import kernel
from gearlube_core.oil.lubricant_state import lubricant_state

BEARING_FIELDS = 8  # of one bearing: K_x, K_x_ay, K_y, K_y_ax, K_z, c_x, c_y, c_z
_IDLE_WORK = 1e-12  # J; no efficiency is stated for less work


@kernel
def member_energy(s: Array, u: int, v: int, k: SupportConstants) -> float:
    """Return kinetic energy of translation and tilt plus elastic energy of the support [J]."""
    x, y, z, a_x, a_y = s[u], s[u + 1], s[u + 2], s[u + 3], s[u + 4]
    elastic = k.K_xx * x * x + k.K_yy * y * y + k.K_zz * z * z
    elastic += k.K_ax * a_x * a_x + k.K_ay * a_y * a_y
    elastic += 2.0 * (k.K_x_ay * x * a_y + k.K_y_ax * y * a_x)
    kinetic = (s[v] * s[v] + s[v + 1] * s[v + 1] + s[v + 2] * s[v + 2]) / k.mobility
    if k.mobility_a > 0.0:
        kinetic += (s[v + 3] * s[v + 3] + s[v + 4] * s[v + 4]) / k.mobility_a
    return 0.5 * (elastic + kinetic)


@kernel
def write_bearings(s: Array, bearings: Array, out: Array) -> None:
    """Write the forces of the four bearings on their shafts."""
    for j in range(at.N_BEARINGS):
        u = U_P if j < 2 else U_G
        v = V_P if j < 2 else V_G
        b = bearings[j * BEARING_FIELDS : (j + 1) * BEARING_FIELDS]
        first = at.BEARINGS + j * at.N_BEARING_QUANTITIES
        out[first] = -(b[0] * s[u] + b[1] * s[u + 4] + b[5] * s[v])
        out[first + 1] = -(b[2] * s[u + 1] + b[3] * s[u + 3] + b[6] * s[v + 1])
        out[first + 2] = -(b[4] * s[u + 2] + b[7] * s[v + 2])


@kernel
def write_losses(s: Array, rates: Array, out: Array) -> None:
    """Write powers lost and efficiencies, averaged over the last communication step.

    Before the first step: instantaneous. Efficiency is 1 - loss/input with the work put in at the
    side that drives; 0 where no work is put in.
    """
    duration = s[TIME_IN_STEP]
    pinion = mean_power(s, rates, PINION_WORK, WORK_MARK, duration)
    wheel = mean_power(s, rates, PINION_WORK + 1, WORK_MARK + 1, duration)
    friction = mean_power(s, rates, PINION_WORK + 2, WORK_MARK + 2, duration)
    mesh = mean_power(s, rates, PINION_WORK + 3, WORK_MARK + 3, duration)
    bearings = mean_power(s, rates, PINION_WORK + 4, WORK_MARK + 4, duration)
    out[at.FRICTION_LOSS] = friction
    out[at.DAMPING_LOSS] = mesh
    out[at.BEARING_LOSS] = bearings
    out[at.EFFICIENCY] = 0.0
    out[at.PAIR_EFFICIENCY] = 0.0
    idle_power = _IDLE_WORK * (1.0 / duration) if duration > 0.0 else _IDLE_WORK
    put_in = pinion if pinion > 0.0 else -wheel
    if put_in > idle_power:
        out[at.EFFICIENCY] = 1.0 - friction / put_in
        out[at.PAIR_EFFICIENCY] = 1.0 - (friction + mesh + bearings) / put_in


@kernel
def write_outputs(
    s: Array,
    inputs: Array,
    mesh: MeshFields,
    data: Array,
    bearings: Array,
    work: Array,
    out: Array,
) -> None:
    """Write all outputs, in the order of OUTPUT_NAMES, into `out` of shape (N_OUTPUTS,).

    `bearings` has shape (N_BEARINGS * BEARING_FIELDS,); other arguments as in
    `integrate.advance`.
    """
    p: MarchConstants = tuple_from_array(data, MarchConstants)
    rates = work[0:N_ODE]
    oil_temperature = inputs[2]
    mesh_at_torque(s[LOAD_TORQUE], mesh, data)
    march_rates(s, inputs[0], inputs[1], data, rates)
    flanks = p.motion.flanks
    plane = flanks.plane
    drive = drive_view(s, flanks)
    coast = coast_view(s, flanks)
    on_drive = line_sums(drive.a, drive.tilt, drive.phase, data, s, MU)
    on_coast = line_sums(coast.a, coast.tilt, coast.phase, data, s, MU + FLANK_POINTS)
    direction = friction_direction(s[W_P])
    force = flank_wrench(on_drive, direction, plane)
    back = turned_wrench(flank_wrench(on_coast, -direction, plane), flanks)
    out[at.PINION_ANGLE] = s[PHI_P]
    out[at.WHEEL_ANGLE] = s[PHI_G]
    out[at.PINION_SPEED] = s[W_P]
    out[at.WHEEL_SPEED] = s[W_G]
    out[at.PINION_ACCELERATION] = rates[W_P]
    out[at.WHEEL_ACCELERATION] = rates[W_G]
    out[at.DTE] = s[PSI] + s[U_P] - s[U_G]
    out[at.MESH_LOAD] = on_drive.N - on_coast.N
    out[at.MESH_FORCE] = force.F_x + back.F_x
    out[at.MESH_FORCE + 1] = force.F_y + back.F_y
    out[at.MESH_FORCE + 2] = force.F_z + back.F_z
    out[at.SEPARATED] = 1.0 if on_drive.N == 0.0 and on_coast.N == 0.0 else 0.0
    out[at.COAST_CONTACT] = 1.0 if on_coast.N > 0.0 else 0.0
    touching = on_drive.stiffness + on_coast.stiffness
    out[at.MESH_STIFFNESS] = plane.cos_b * plane.cos_b * touching
    out[at.MESH_FREQUENCY] = p.teeth * s[W_P] / (2.0 * math.pi)
    oil = lubricant_state(p.oil, oil_temperature)
    view = drive if on_drive.N >= on_coast.N else coast
    mu_at = MU if on_drive.N >= on_coast.N else MU + FLANK_POINTS
    out[at.THINNEST_FILM] = write_lines(view, mu_at, s, oil_temperature, data, oil, p, out)
    write_losses(s, rates, out)
    for i in range(N_LATERAL):
        out[at.DISPLACEMENTS + i] = s[U_P + i]
    write_bearings(s, bearings, out)
    for i in range(N_ENERGIES):
        out[at.ENERGIES + i] = s[PINION_WORK + i]
    stored = 0.5 * s[W_P] * s[W_P] / p.motion.pinion.mobility_r
    stored += 0.5 * s[W_G] * s[W_G] / p.motion.gear.mobility_r
    stored += member_energy(s, U_P, V_P, p.motion.pinion) + member_energy(
        s, U_G, V_G, p.motion.gear
    )
    out[at.STORED_ENERGY] = stored + on_drive.energy + on_coast.energy
