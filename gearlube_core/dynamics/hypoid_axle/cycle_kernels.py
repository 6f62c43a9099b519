"""Mean losses along torques, with what is exceeded: the kernel that studies call."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import cache
from typing import NamedTuple

from gearlube_core.arrays import Array
from gearlube_core.bearings.bearing_type import ShaftBearings
from gearlube_core.dynamics.hypoid_axle.mesh_cycle import (
    AT_CHANNELS,
    AT_EXPANSION,
    AT_FORCES,
    AT_FRICTION,
    AT_MEANS,
    AT_SERIES,
    AT_SHOWN,
    AT_U,
    BOUNDS_SHOWN,
    RANGES_SHOWN,
    Drag,
    Turning,
    drag_at,
    mesh_cycle,
    turning_at,
)
from gearlube_core.dynamics.hypoid_axle.shafts_at_rest import OK
from gearlube_core.dynamics.hypoid_mesh.flank_outputs import (
    FILM_RATIO,
    LOAD,
    N_FLANK_QUANTITIES,
    TEMPERATURE,
    write_flanks,
)
from gearlube_core.dynamics.hypoid_mesh.flanks import BOUND_POWER, FILMS, N_FRICTION, flank_sum
from gearlube_core.dynamics.hypoid_mesh.kernel_parameters import AxleParameters
from gearlube_core.dynamics.hypoid_mesh.mesh_at_load import (
    MeshAtLoad,
    MeshFields,
    mesh_levels,
    place_at_load,
)
from gearlube_core.dynamics.hypoid_mesh.mesh_force import mesh_force
from gearlube_core.dynamics.hypoid_mesh.tooth_pair import EXACT
from gearlube_core.dynamics.packed_mesh import N_CHANNELS
from gearlube_core.dynamics.ranges import write_ranges
from gearlube_core.friction.flank_law import FlankLaw
from gearlube_core.kernels.flat_tuples import tuple_from_array
from gearlube_core.kernels.jit import kernel
from gearlube_core.mesh_table.kernels import R_P
from gearlube_core.mesh_table.table import PAIRS
from gearlube_core.oil.lubricant_state import LubricantState, lubricant_state

N_EXTREMES = 8
_EXTREME_ANGLES = 4  # of a mesh period, where outputs are looked at


@kernel
def _add_extremes(
    here: Turning,
    torque: float,
    drag: Drag,
    data: MeshAtLoad,
    oil: LubricantState,
    p: AxleParameters,
    work: Array,
    found: Array,
) -> None:
    """Keep in `found` the ranges that an angle exceeds, and means of the film model's outputs.

    Parameters
    ----------
    torque : float
        On the pinion from outside, below 0 with the coast flanks' data [N.m].
    found : ndarray of shape (N_EXTREMES,)
        Least film ratio [-], highest temperature [K], sum of `range.exceeded`; means of the bound
        of the friction loss [W] and of the share of load outside the model's domain [-], and of
        the same two of the bearings; the mean drag loss of the pinion's bearings [W].
    """
    friction, channels = work[AT_FRICTION:AT_CHANNELS], work[AT_CHANNELS:AT_EXPANSION]
    out = work[AT_SHOWN:AT_MEANS]
    m = here.mesh
    force = mesh_force(m, data.series, data.n_orders, p.mesh).force
    window, nodes, model = data.window, data.n_nodes, data.film_model
    flank_sum(m, force, window, nodes, oil, p, EXACT, friction, channels, model)
    most_loaded = write_flanks(
        m,
        force,
        window,
        nodes,
        oil.temperature,
        oil,
        p,
        model,
        EXACT,
        friction[FILMS:N_FRICTION],
        0,
        BOUNDS_SHOWN,
        channels,
        out,
    )
    of_teeth = max(abs(torque), abs(force) * data.series[R_P])
    write_ranges(
        -of_teeth if torque < 0.0 else of_teeth,
        most_loaded.film_load,
        most_loaded.film_material,
        most_loaded.traction,
        most_loaded.temperature,
        most_loaded.pressure,
        p.ranges,
        RANGES_SHOWN,
        out,
    )
    for pair in range(PAIRS):
        flank = pair * N_FLANK_QUANTITIES
        if out[flank + LOAD] > 0.0:
            found[0] = min(found[0], out[flank + FILM_RATIO])
            found[1] = max(found[1], out[flank + TEMPERATURE])
    found[2] = float(int(found[2]) | int(out[RANGES_SHOWN]))
    one, two = drag.raceways_p, drag.raceways_g
    bound = one.torque_bound * abs(m.w_p) + two.torque_bound * abs(m.w_g)
    load = one.load + two.load
    found[3] += friction[BOUND_POWER] / _EXTREME_ANGLES
    found[4] += most_loaded.outside / _EXTREME_ANGLES
    found[5] += bound / _EXTREME_ANGLES
    found[7] += drag.bearings_p * m.w_p / _EXTREME_ANGLES
    if load > 0.0:
        found[6] += (one.load_outside + two.load_outside) / load / _EXTREME_ANGLES


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
        without: Array,
        work: Array,
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
        parameters, without : ndarray
            Flattened AxleParameters, as they are and without losses.
        work : ndarray
            Of `cycle_work`.
        losses : ndarray of shape (n, N_LOSSES)
            [W]
        carried, statuses : ndarray of shape (n,)
            Torque of the teeth [N.m]; OK or what failed.
        found : ndarray of shape (n, N_EXTREMES)
            See `_add_extremes`.
        """
        table = mesh_levels(*mesh)
        p: AxleParameters = tuple_from_array(parameters, AxleParameters, bearing, law)
        lossless: AxleParameters = tuple_from_array(without, AxleParameters, bearing, law)
        oil = lubricant_state(p.oil, oil_temperature, table.laws)
        at_window = work.size - (table.n_nodes + 1) * N_CHANNELS
        data = place_at_load(table, work[AT_SERIES:at_window], work[at_window:])
        failed = 0
        for k in range(torques.size):
            torque = torques[k]
            status, carried[k], side, drag = mesh_cycle(
                speed, torque, oil_temperature, angles, table, p, lossless, work, losses[k]
            )
            statuses[k] = status
            if status != OK:
                failed += 1
            elif extremes:
                found[k, 0], found[k, 1] = math.inf, oil_temperature
                for i in range(2, N_EXTREMES):
                    found[k, i] = 0.0
                u = work[AT_U:AT_FORCES]
                for j in range(_EXTREME_ANGLES):
                    angle = 2.0 * math.pi * j / (_EXTREME_ANGLES * p.mesh.z_p)
                    here = turning_at(angle, carried[k], speed, u, data, p)
                    drag = drag_at(u, speed, here.mesh.w_g, oil, table, p)
                    _add_extremes(here, side * abs(torque), drag, data, oil, p, work, found[k])
        return failed

    return CycleKernels(losses_along_torque)
