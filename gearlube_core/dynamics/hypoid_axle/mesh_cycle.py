"""Mean losses over one mesh period of an axle that turns steadily, without a march in time.

Every angle is a state of rest of the teeth: the mesh force that the pinion's torque asks for, the
shafts at their displacements under the mean force, and a gear that turns so that the deflection
stays. The powers are those of the right-hand side that the march integrates.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import cache
from typing import NamedTuple

from gearlube_core.arrays import Array
from gearlube_core.bearings.bearing_type import RollerFilms, ShaftBearings
from gearlube_core.bearings.followed_shaft import PALMGREN
from gearlube_core.dynamics.hypoid_axle.integrate import OK, step_inputs
from gearlube_core.dynamics.hypoid_axle.output_names import (
    BEARING_SHARE_OUTSIDE,
    DRAG_LOSS_BOUND,
    FLANKS,
    LOSS_BOUND,
    RANGES,
    SHARE_OUTSIDE,
)
from gearlube_core.dynamics.hypoid_axle.outputs import (
    write_outputs,
)
from gearlube_core.dynamics.hypoid_axle.rhs import SCRATCH, StepInputs, axle_raceways, axle_rhs
from gearlube_core.dynamics.hypoid_axle.start import N_FREE, REST_WORK, rest_under
from gearlube_core.dynamics.hypoid_axle.state import (
    LOAD_TORQUE,
    N_ENERGIES,
    N_ODE,
    PHI_P,
    PINION_WORK,
    SIDE,
    U_G,
    U_P,
    UM,
    V_G,
    V_P,
    W_G,
    W_P,
    X,
)
from gearlube_core.dynamics.hypoid_mesh.flank_outputs import (
    FILM_RATIO,
    LOAD,
    N_FLANK_QUANTITIES,
    TEMPERATURE,
)
from gearlube_core.dynamics.hypoid_mesh.kernel_parameters import AxleParameters
from gearlube_core.dynamics.hypoid_mesh.mesh_at_load import (
    MeshAtLoad,
    MeshFields,
    MeshLevels,
    blend_mesh,
    mesh_levels,
    place_at_load,
)
from gearlube_core.dynamics.hypoid_mesh.step_parts import MICRO
from gearlube_core.dynamics.packed_mesh import N_CHANNELS
from gearlube_core.friction.flank_law import FlankLaw
from gearlube_core.kernels.flat_tuples import tuple_from_array
from gearlube_core.kernels.jit import kernel
from gearlube_core.mesh_table.kernels import N_SERIES, mesh_series
from gearlube_core.mesh_table.table import PAIRS
from gearlube_core.oil.lubricant import LubricantState, lubricant_state

NO_BALANCE = 6  # beside the statuses of `start.rest`
FIRST_LOSS = 2  # of the energies; before it the work at pinion and wheel
N_LOSSES = N_ENERGIES - FIRST_LOSS
N_EXTREMES = 7
_EXTREME_ANGLES = 4  # of a mesh period, where outputs are looked at
_MOST_BALANCES = 40
_RESTS = 2  # of them that find the shafts' displacements anew; later ones change nothing
_BALANCED = 1e-6  # of the torques on the pinion
_LEAST_TORQUE = 1e-3  # N.m, of which this share is taken at least

_AT_SLOPE = SCRATCH
_AT_MEAN = _AT_SLOPE + N_ODE
_AT_REST = _AT_MEAN + N_ODE
_AT_PUSH = _AT_REST + REST_WORK
_AT_SERIES = _AT_PUSH + N_FREE


def cycle_work(n_orders: int, n_nodes: int) -> int:
    """Return the length of the work array of `mesh_cycle`."""
    return _AT_SERIES + N_SERIES * (2 * n_orders + 1) + (n_nodes + 1) * N_CHANNELS


@kernel
def quasi_static_state(
    s: Array, torque: float, speed: float, data: MeshAtLoad, p: AxleParameters
) -> None:
    """Write deflection and gear speed at the angle s[PHI_P], at rest along the line of action.

    The teeth carry `torque` [N.m] at the pinion; the deflection does not change at the pinion's
    `speed` [rad/s].
    """
    m = mesh_series(data.series, data.n_orders, p.mesh.z_p, s[PHI_P])
    arm = m.R_p - m.de
    arm += m.dn_x * (s[U_P] - s[U_G]) * UM
    arm += m.dn_y * (s[U_P + 1] - s[U_G + 1]) * UM
    arm += m.dn_z * (s[U_P + 2] - s[U_G + 2]) * UM
    deflection = torque / arm / m.k_m
    s[X] = MICRO * (deflection if torque >= 0.0 else deflection - p.mesh.backlash)
    s[W_P] = speed
    s[W_G] = arm * speed / m.R_g


@kernel
def mean_rates(
    s: Array,
    torque: float,
    speed: float,
    angles: int,
    inputs: StepInputs,
    data: MeshAtLoad,
    oil: LubricantState,
    p: AxleParameters,
    work: Array,
) -> None:
    """Write the mean of the rates over a mesh period, teeth carrying `torque`, into its place."""
    scratch = work[0:_AT_SLOPE]
    slope = work[_AT_SLOPE:_AT_MEAN]
    mean = work[_AT_MEAN:_AT_REST]
    for i in range(N_ODE):
        mean[i] = 0.0
    for k in range(angles):
        s[PHI_P] = 2.0 * math.pi * k / (angles * p.mesh.z_p)
        quasi_static_state(s, torque, speed, data, p)
        axle_rhs(s, inputs, data, oil, p, 1.0, 1.0, scratch, slope)
        for i in range(N_ODE):
            mean[i] += slope[i] / angles


@kernel
def mesh_cycle(
    s: Array,
    speed: float,
    torque: float,
    oil_temperature: float,
    angles: int,
    table: MeshLevels,
    p: AxleParameters,
    lossless: AxleParameters,
    work: Array,
    losses: Array,
) -> tuple[int, float]:
    """Write the mean powers lost over a mesh period; return a status and the torque of the teeth.

    Parameters
    ----------
    s : ndarray of shape (N_STATE,)
        On return the state at the last angle.
    speed : float
        Of the pinion, above 0 [rad/s].
    torque : float
        On the pinion from outside, below 0 where the wheels drive [N.m].
    oil_temperature : float
        [K]
    angles : int
        Equal parts of a mesh period.
    table : MeshLevels
    p, lossless : AxleParameters
        As it is, and without losses for the state of rest.
    work : ndarray of shape (>= cycle_work(n_orders, n_nodes),)
    losses : ndarray of shape (N_LOSSES,)
        In the order of the energies of the state [W].

    Returns
    -------
    tuple of (int, float)
        OK, a status of `start.rest`, or NO_BALANCE; the torque that the teeth carry at the
        pinion [N.m]: `torque` less friction and drag on the pinion.
    """
    at_window = _AT_SERIES + N_SERIES * (2 * table.n_orders + 1)
    data = place_at_load(table, work[_AT_SERIES:at_window], work[at_window:])
    mean = work[_AT_MEAN:_AT_REST]
    oil = lubricant_state(p.oil, oil_temperature, table.laws)
    # drag that takes the load of each roller feels the last hundredth of a micrometre
    rests = _RESTS + 1 if p.drag > PALMGREN else _RESTS
    push = work[_AT_PUSH:_AT_SERIES]
    for i in range(N_FREE):
        push[i] = 0.0
    for i in range(N_ODE):
        mean[i] = 0.0
    carried = torque
    missing = math.inf
    inputs = StepInputs(torque, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    for balance in range(_MOST_BALANCES):
        if balance < rests:
            # after the first time under the mean of what friction and the varying mesh push with
            for i in range(3):
                push[i] += p.m_p * mean[V_P + i]
                push[3 + i] += p.m_g * mean[V_G + i]
            status, worst = rest_under(
                s, speed, carried, oil_temperature, table, lossless, push, work[_AT_REST:_AT_PUSH]
            )
            if status != OK:
                return status, worst
            s[LOAD_TORQUE] = abs(torque)
            blend_mesh(s[LOAD_TORQUE], s[SIDE], table, data)
            exact = RollerFilms(table.roller_model, work[0:0], 0.0)
            inputs = step_inputs(s, torque, 0.0, oil, p, axle_raceways(s, oil, p, exact))
        mean_rates(s, carried, speed, angles, inputs, data, oil, p, work)
        missing = p.I_p * mean[W_P]
        if abs(missing) <= _BALANCED * max(abs(torque), abs(carried), _LEAST_TORQUE):
            break
        carried += missing
    else:
        return NO_BALANCE, missing
    for i in range(N_LOSSES):
        losses[i] = mean[PINION_WORK + FIRST_LOSS + i]
    return OK, carried


@kernel
def flank_extremes(out: Array, found: Array) -> None:
    """Keep in `found` what the outputs exceed, and means of what tells about a film model.

    Parameters
    ----------
    out : ndarray of shape (N_OUTPUTS,)
    found : ndarray of shape (N_EXTREMES,)
        Least film ratio [-], highest temperature [K], sum of `range.exceeded`; means of the bound
        of the friction loss [W] and of the share of load outside the model's domain [-], and of
        the same two of the bearings.
    """
    for pair in range(PAIRS):
        here = FLANKS + pair * N_FLANK_QUANTITIES
        if out[here + LOAD] > 0.0:
            found[0] = min(found[0], out[here + FILM_RATIO])
            found[1] = max(found[1], out[here + TEMPERATURE])
    found[2] = float(int(found[2]) | int(out[RANGES]))
    found[3] += out[LOSS_BOUND] / _EXTREME_ANGLES
    found[4] += out[SHARE_OUTSIDE] / _EXTREME_ANGLES
    found[5] += out[DRAG_LOSS_BOUND] / _EXTREME_ANGLES
    found[6] += out[BEARING_SHARE_OUTSIDE] / _EXTREME_ANGLES


class CycleKernels(NamedTuple):
    """Compiled functions of an axle with one type of bearing and one law of flank friction."""

    losses_along_torque: Callable[..., int]


@cache
def cycle_kernels(bearing: type[ShaftBearings], law: type[FlankLaw]) -> CycleKernels:
    """Return the compiled mesh cycle of an axle with these bearings and flanks."""

    @kernel
    def losses_along_torque(
        speed: float,
        torques: Array,
        oil_temperature: float,
        angles: int,
        extremes: bool,
        mesh: MeshFields,
        parameters: Array,
        lossless: Array,
        works: tuple[Array, Array, Array, Array, Array],
        losses: Array,
        carried: Array,
        found: Array,
        statuses: Array,
    ) -> int:
        """Write the mean losses at every torque; return how many torques failed.

        Parameters
        ----------
        speed, oil_temperature, angles
            As in `mesh_cycle`.
        torques : ndarray of shape (n,)
            On the pinion [N.m].
        extremes
            Whether `found` is written.
        mesh : tuple
            Fields of `MeshLevels`.
        parameters, lossless : ndarray
            Flattened AxleParameters.
        works : tuple of ndarray
            Work space: state (N_STATE,), `cycle_work`, `integrate.work_size`, (ROLLERS_MAX,),
            outputs (N_OUTPUTS,).
        losses : ndarray of shape (n, N_LOSSES)
            [W]
        carried, statuses : ndarray of shape (n,)
            Torque of the teeth [N.m]; OK or what failed.
        found : ndarray of shape (n, N_EXTREMES)
            See `flank_extremes`.
        """
        table = mesh_levels(*mesh)
        p: AxleParameters = tuple_from_array(parameters, AxleParameters, bearing, law)
        without: AxleParameters = tuple_from_array(lossless, AxleParameters, bearing, law)
        s, work, output_work, rollers, out = works
        failed = 0
        for k in range(torques.size):
            status, carried[k] = mesh_cycle(
                s, speed, torques[k], oil_temperature, angles, table, p, without, work, losses[k]
            )
            statuses[k] = status
            if status != OK:
                failed += 1
            elif extremes:
                found[k, 0] = math.inf
                found[k, 1] = oil_temperature
                found[k, 2] = 0.0
                for i in range(3, N_EXTREMES):
                    found[k, i] = 0.0
                at_window = _AT_SERIES + N_SERIES * (2 * table.n_orders + 1)
                data = place_at_load(table, work[_AT_SERIES:at_window], work[at_window:])
                torque = (torques[k], 0.0)
                for j in range(_EXTREME_ANGLES):
                    s[PHI_P] = 2.0 * math.pi * j / (_EXTREME_ANGLES * p.mesh.z_p)
                    quasi_static_state(s, carried[k], speed, data, p)
                    write_outputs(s, torque, oil_temperature, table, p, output_work, rollers, out)
                    flank_extremes(out, found[k])
        return failed

    return CycleKernels(losses_along_torque)
