"""Outputs of the marching model: their names, which are the FMU's contract, and their kernels."""

from __future__ import annotations

import math

from gearlube_core.arrays import Array
from gearlube_core.dynamics.helical_pair.march.continuous import (
    EVENT_INDICATORS,
    RATE_NAMES,
    STATE_NAMES,
    write_event_indicators,
    write_rates,
)
from gearlube_core.dynamics.helical_pair.march.flanks import (
    FLANK_POINTS,
    MarchConstants,
    SupportConstants,
    coast_view,
    drive_view,
    friction_direction,
)
from gearlube_core.dynamics.helical_pair.march.given_pair import BEARING_FIELDS, N_BEARINGS
from gearlube_core.dynamics.helical_pair.march.line_outputs import (
    LINE_BOUNDS,
    LINE_OUTPUTS,
    write_lines,
)
from gearlube_core.dynamics.helical_pair.march.line_sums import line_sums
from gearlube_core.dynamics.helical_pair.march.mesh_data import (
    MeshFields,
    laws_of_oil,
    mesh_at_torque,
)
from gearlube_core.dynamics.helical_pair.march.pair_forces import flank_wrench, turned_wrench
from gearlube_core.dynamics.helical_pair.march.rates import march_rates
from gearlube_core.dynamics.helical_pair.march.state import (
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
    pair_motion,
)
from gearlube_core.dynamics.mean_power import mean_power
from gearlube_core.dynamics.ranges import RANGE_EXCEEDED, RANGE_OUTPUTS, write_ranges
from gearlube_core.kernels.flat_tuples import tuple_from_array
from gearlube_core.kernels.jit import kernel
from gearlube_core.number import Output
from gearlube_core.oil.lubricant import lubricant_state

BEARING_QUANTITIES = ("force.x", "force.y", "force.z")

_OUTPUTS: tuple[str, ...] = (
    "pinion.angle",
    "wheel.angle",
    "pinion.speed",
    "wheel.speed",
    "pinion.acceleration",
    "wheel.acceleration",
    "mesh.dte",
    "mesh.load",
    "mesh.force.x",
    "mesh.force.y",
    "mesh.force.z",
    "mesh.separated",
    "mesh.coast_contact",
    "mesh.stiffness",
    "mesh.frequency",
    "mesh.film_thickness_min",
    "film.share_outside",
    "friction.power_loss_bound",
    "efficiency_bound",
    *LINE_BOUNDS,
    *LINE_OUTPUTS,
    "friction.power_loss",
    "damping.power_loss",
    "bearing.power_loss",
    "efficiency",
    "pair.efficiency",
    *(
        f"{member}.{quantity}.{c}"
        for member in ("pinion", "wheel")
        for quantity, axes in (("displacement", "xyz"), ("tilt", "xy"))
        for c in axes
    ),
    *(f"bearing[{j}].{q}" for j in range(1, N_BEARINGS + 1) for q in BEARING_QUANTITIES),
    "energy.pinion_work",
    "energy.wheel_work",
    "energy.friction",
    "energy.mesh_damping",
    "energy.bearing_damping",
    "energy.stored",
    *RANGE_OUTPUTS,
)
# outputs that the table of the FMU's variables takes from here, with unit and text
OWN_OUTPUTS: tuple[Output, ...] = ()
# for another integrator: the other states, the rates of all, and the event indicators
_OTHER_STATES = tuple(name for name in STATE_NAMES if name not in _OUTPUTS)
OUTPUT_NAMES = (
    *_OUTPUTS,
    *_OTHER_STATES,
    *RATE_NAMES,
    *EVENT_INDICATORS,
    *(one.name for one in OWN_OUTPUTS),
)
OUTPUT_INDEX = {name: index for index, name in enumerate(OUTPUT_NAMES)}
N_OUTPUTS = len(OUTPUT_NAMES)

# places of the outputs that the kernels write by name
PINION_ANGLE = OUTPUT_INDEX["pinion.angle"]
WHEEL_ANGLE = OUTPUT_INDEX["wheel.angle"]
PINION_SPEED = OUTPUT_INDEX["pinion.speed"]
WHEEL_SPEED = OUTPUT_INDEX["wheel.speed"]
PINION_ACCELERATION = OUTPUT_INDEX["pinion.acceleration"]
WHEEL_ACCELERATION = OUTPUT_INDEX["wheel.acceleration"]
DTE = OUTPUT_INDEX["mesh.dte"]
MESH_LOAD = OUTPUT_INDEX["mesh.load"]
SEPARATED = OUTPUT_INDEX["mesh.separated"]
COAST_CONTACT = OUTPUT_INDEX["mesh.coast_contact"]
MESH_STIFFNESS = OUTPUT_INDEX["mesh.stiffness"]
MESH_FREQUENCY = OUTPUT_INDEX["mesh.frequency"]
THINNEST_FILM = OUTPUT_INDEX["mesh.film_thickness_min"]
FRICTION_LOSS = OUTPUT_INDEX["friction.power_loss"]
DAMPING_LOSS = OUTPUT_INDEX["damping.power_loss"]
BEARING_LOSS = OUTPUT_INDEX["bearing.power_loss"]
EFFICIENCY = OUTPUT_INDEX["efficiency"]
PAIR_EFFICIENCY = OUTPUT_INDEX["pair.efficiency"]
STORED_ENERGY = OUTPUT_INDEX["energy.stored"]

SHARE_OUTSIDE = OUTPUT_INDEX["film.share_outside"]
LOSS_BOUND = OUTPUT_INDEX["friction.power_loss_bound"]
EFFICIENCY_BOUND = OUTPUT_INDEX["efficiency_bound"]

# first place of a group of outputs of one kind
MESH_FORCE = OUTPUT_INDEX["mesh.force.x"]
LINES = OUTPUT_INDEX[LINE_OUTPUTS[0]]
BOUNDS = OUTPUT_INDEX[LINE_BOUNDS[0]]
DISPLACEMENTS = OUTPUT_INDEX["pinion.displacement.x"]  # in the order of the state
BEARINGS = OUTPUT_INDEX["bearing[1].force.x"]
ENERGIES = OUTPUT_INDEX["energy.pinion_work"]  # in the order of the state
RANGES = OUTPUT_INDEX[RANGE_EXCEEDED]
RELATIVE_ROTATION = OUTPUT_INDEX["mesh.rotation"]
VELOCITIES = OUTPUT_INDEX["pinion.velocity.x"]  # in the order of the state
LOAD_LEVEL = OUTPUT_INDEX["mesh.load_torque"]
RATES = OUTPUT_INDEX[RATE_NAMES[0]]  # ditto
EVENTS = OUTPUT_INDEX[EVENT_INDICATORS[0]]
N_BEARING_QUANTITIES = len(BEARING_QUANTITIES)

# what follows from the state alone
MOTION_OUTPUTS: tuple[str, ...] = (
    *OUTPUT_NAMES[:PINION_ACCELERATION],
    OUTPUT_NAMES[DTE],
    OUTPUT_NAMES[MESH_FREQUENCY],
    *OUTPUT_NAMES[FRICTION_LOSS : PAIR_EFFICIENCY + 1],
    *OUTPUT_NAMES[DISPLACEMENTS : DISPLACEMENTS + N_LATERAL],
    *OUTPUT_NAMES[BEARINGS : BEARINGS + N_BEARINGS * N_BEARING_QUANTITIES],
    *OUTPUT_NAMES[ENERGIES : ENERGIES + N_ENERGIES],
    *_OTHER_STATES,
)
# of these, what an input changes at once while no step has been taken
POWERS = frozenset(OUTPUT_NAMES[FRICTION_LOSS : PAIR_EFFICIENCY + 1])

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
    for j in range(N_BEARINGS):
        u = U_P if j < 2 else U_G
        v = V_P if j < 2 else V_G
        b = bearings[j * BEARING_FIELDS : (j + 1) * BEARING_FIELDS]
        first = BEARINGS + j * N_BEARING_QUANTITIES
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
    out[FRICTION_LOSS] = friction
    out[DAMPING_LOSS] = mesh
    out[BEARING_LOSS] = bearings
    out[EFFICIENCY] = 0.0
    out[PAIR_EFFICIENCY] = 0.0
    idle_power = _IDLE_WORK * (1.0 / duration) if duration > 0.0 else _IDLE_WORK
    put_in = pinion if pinion > 0.0 else -wheel
    if put_in > idle_power:
        out[EFFICIENCY] = 1.0 - friction / put_in
        out[PAIR_EFFICIENCY] = 1.0 - (friction + mesh + bearings) / put_in


@kernel
def write_motion(s: Array, rates: Array, teeth: float, bearings: Array, out: Array) -> None:
    """Write `MOTION_OUTPUTS`.

    Parameters
    ----------
    s : ndarray of shape (N_STATE,)
    rates : ndarray of shape (N_ODE,)
        Its rates; read before the first step only.
    teeth : float
        Of the pinion.
    bearings : ndarray
        As in `write_outputs`.
    """
    out[PINION_ANGLE] = s[PHI_P]
    out[WHEEL_ANGLE] = s[PHI_G]
    out[PINION_SPEED] = s[W_P]
    out[WHEEL_SPEED] = s[W_G]
    out[DTE] = s[PSI] + s[U_P] - s[U_G]
    out[MESH_FREQUENCY] = teeth * s[W_P] / (2.0 * math.pi)
    write_losses(s, rates, out)
    for i in range(N_LATERAL):
        out[DISPLACEMENTS + i] = s[U_P + i]
        out[VELOCITIES + i] = s[V_P + i]
    out[RELATIVE_ROTATION] = s[PSI]
    out[LOAD_LEVEL] = s[LOAD_TORQUE]
    write_bearings(s, bearings, out)
    for i in range(N_ENERGIES):
        out[ENERGIES + i] = s[PINION_WORK + i]


@kernel
def write_derivatives(
    s: Array, inputs: Array, mesh: MeshFields, data: Array, work: Array, out: Array
) -> None:
    """Write the rates of the continuous states and the event indicators.

    Arguments as in `write_outputs`.
    """
    p: MarchConstants = tuple_from_array(data, MarchConstants)
    rates = work[0:N_ODE]
    mesh_at_torque(s[LOAD_TORQUE], mesh, data)
    march_rates(s, inputs[0], inputs[1], data, rates)
    write_rates(s, rates, inputs[0], out[RATES:EVENTS])
    write_event_indicators(s, data, p, out[EVENTS:])


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
    write_derivatives(s, inputs, mesh, data, work, out)
    flanks = p.motion.flanks
    plane = flanks.plane
    m = pair_motion(s)
    drive = drive_view(m, flanks)
    coast = coast_view(m, flanks)
    on_drive = line_sums(drive.a, drive.tilt, drive.phase, data, s, MU)
    on_coast = line_sums(coast.a, coast.tilt, coast.phase, data, s, MU + FLANK_POINTS)
    direction = friction_direction(s[W_P])
    force = flank_wrench(on_drive, direction, plane)
    behind = turned_wrench(flank_wrench(on_coast, -direction, plane), flanks)
    write_motion(s, rates, p.teeth, bearings, out)
    out[PINION_ACCELERATION] = rates[W_P]
    out[WHEEL_ACCELERATION] = rates[W_G]
    out[MESH_LOAD] = on_drive.N - on_coast.N
    out[MESH_FORCE] = force.F_x + behind.F_x
    out[MESH_FORCE + 1] = force.F_y + behind.F_y
    out[MESH_FORCE + 2] = force.F_z + behind.F_z
    out[SEPARATED] = 1.0 if on_drive.N == 0.0 and on_coast.N == 0.0 else 0.0
    out[COAST_CONTACT] = 1.0 if on_coast.N > 0.0 else 0.0
    touching = on_drive.stiffness + on_coast.stiffness
    out[MESH_STIFFNESS] = plane.cos_b * plane.cos_b * touching
    oil = lubricant_state(p.oil, oil_temperature, laws_of_oil(*mesh))
    back = on_coast.N > on_drive.N
    view, mu_at = (coast, MU + FLANK_POINTS) if back else (drive, MU)
    found = write_lines(
        view, back, s, mu_at, s[W_P], oil_temperature, data, oil, p, LINES, BOUNDS, out
    )
    out[THINNEST_FILM] = found.thinnest_film
    bound = found.loss_bound
    out[SHARE_OUTSIDE] = found.outside
    out[LOSS_BOUND] = bound * abs(out[FRICTION_LOSS])
    out[EFFICIENCY_BOUND] = bound * (1.0 - out[EFFICIENCY]) if out[EFFICIENCY] > 0.0 else 0.0
    torque = max(abs(s[LOAD_TORQUE]), max(on_drive.N, on_coast.N) * plane.r_bp * plane.cos_b)
    write_ranges(
        torque if on_drive.N >= on_coast.N else -torque,
        found.film_load,
        found.film_material,
        found.traction,
        found.temperature,
        found.pressure,
        p.ranges,
        RANGES,
        out,
    )
    stored = 0.5 * s[W_P] * s[W_P] / p.motion.pinion.mobility_r
    stored += 0.5 * s[W_G] * s[W_G] / p.motion.gear.mobility_r
    stored += member_energy(s, U_P, V_P, p.motion.pinion) + member_energy(
        s, U_G, V_G, p.motion.gear
    )
    out[STORED_ENERGY] = stored + on_drive.energy + on_coast.energy
