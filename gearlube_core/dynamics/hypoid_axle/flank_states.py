"""State of a pair of flanks through its engagement, in steady running at one load."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from functools import cache

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.bearings.bearing_type import ShaftBearings, bearing_loads
from gearlube_core.bearings.parameters import ROLLERS_MAX
from gearlube_core.contact.hertz import hertz_ellipse
from gearlube_core.contact.solid import solid_parameters
from gearlube_core.dynamics.hypoid_axle.losses import FAILURES, axle_losses
from gearlube_core.dynamics.hypoid_axle.mesh_cycle import (
    AT_CHANNELS,
    AT_EXPANSION,
    AT_FORCES,
    AT_FRICTION,
    AT_SERIES,
    AT_U,
    N_LOSSES,
    cycle_work,
    mesh_cycle,
    turning_at,
)
from gearlube_core.dynamics.hypoid_axle.shafts_at_rest import OK, gear_motion, pinion_motion
from gearlube_core.dynamics.hypoid_mesh.flanks import FILMS, N_FRICTION
from gearlube_core.dynamics.hypoid_mesh.kernel_parameters import AxleParameters, without_losses
from gearlube_core.dynamics.hypoid_mesh.mesh_at_load import MeshFields, mesh_levels, place_at_load
from gearlube_core.dynamics.hypoid_mesh.mesh_force import mesh_force, reference_frequency
from gearlube_core.dynamics.hypoid_mesh.parameters import HypoidAxleParameters
from gearlube_core.dynamics.hypoid_mesh.tooth_pair import (
    EXACT,
    flank_film,
    pair_friction,
    sliding_speed,
)
from gearlube_core.dynamics.packed_mesh import LINE_RADIUS, N_CHANNELS, R_Y, SHARE
from gearlube_core.ehl.gears.hypoid_film import pair_contact
from gearlube_core.errors import ParameterError
from gearlube_core.friction.flank_law import FlankLaw
from gearlube_core.friction.flank_laws import MixedFlankFriction
from gearlube_core.friction.flank_states import BearingStates, FlankStates, asperity_shares
from gearlube_core.kernels.flat_tuples import flatten, tuple_from_array
from gearlube_core.kernels.jit import kernel
from gearlube_core.mesh_table.kernels import load_bracket, pair_channels
from gearlube_core.mesh_table.table import PAIRS
from gearlube_core.oil.lubricant_state import lubricant_state

_COLUMNS = 8
_ROLLERS = 4  # place of the rollers behind forces and film of a bearing
# of the speed past a point at rest; less where an edge of the tooth holds the centre of the force
_HELD = 0.5
_LEAST_LOAD = 1e-6  # of the largest, above what rounding leaves


@cache
def _flank_kernel(
    bearing: type[ShaftBearings], law: type[FlankLaw]
) -> Callable[..., tuple[int, float]]:
    """Return the kernel that writes the flanks of an axle with these bearings and this law."""

    @kernel
    def flanks_at_torque(
        speed: float,
        torque: float,
        temperature: float,
        angles: int,
        mesh: MeshFields,
        parameters: Array,
        without: Array,
        work: Array,
        losses: Array,
        out: Array,
        bearings: Array,
    ) -> tuple[int, float]:
        """Write the states of all pairs, (PAIRS, angles, _COLUMNS); return status and torque.

        And the bearings, (4, 4 + ROLLERS_MAX): their forces, film and rollers.

        Other arguments as in `cycle_kernels.losses_along_torque`.
        """
        table = mesh_levels(*mesh)
        p: AxleParameters = tuple_from_array(parameters, AxleParameters, bearing, law)
        lossless: AxleParameters = tuple_from_array(without, AxleParameters, bearing, law)
        oil = lubricant_state(p.oil, temperature, table.laws)
        at_window = work.size - (table.n_nodes + 1) * N_CHANNELS
        data = place_at_load(table, work[AT_SERIES:at_window], work[at_window:])
        status, carried, _, drag = mesh_cycle(
            speed, torque, temperature, angles, table, p, lossless, work, losses
        )
        if status != OK:
            return status, carried
        channels = work[AT_CHANNELS:AT_EXPANSION]
        films = work[AT_FRICTION:AT_CHANNELS][FILMS:N_FRICTION]
        u, window, n = work[AT_U:AT_FORCES], data.window, data.n_nodes
        still, w_g = reference_frequency(p.mesh, 0.0), speed / p.ratio
        for i in range(2):  # first and second bearing of each shaft
            one, two, side = bearings[i], bearings[2 + i], 1.0 - 2.0 * i
            of = bearing_loads(
                p.bearing_p, pinion_motion(u, speed), still, oil, side, one[_ROLLERS:]
            )
            one[0], one[1], one[2] = of[0], of[1], of[2]
            of = bearing_loads(p.bearing_g, gear_motion(u, w_g), still, oil, side, two[_ROLLERS:])
            two[0], two[1], two[2] = of[0], of[1], of[2]
        bearings[0, 3] = drag.raceways_p.first_film
        bearings[1, 3] = drag.raceways_p.second_film
        bearings[2, 3] = drag.raceways_g.first_film
        bearings[3, 3] = drag.raceways_g.second_film
        for k in range(angles):
            angle = 2.0 * math.pi * k / (angles * p.mesh.z_p)
            m = turning_at(angle, carried, speed, u, data, p).mesh
            force = mesh_force(m, data.series, data.n_orders, p.mesh).force
            for pair in range(PAIRS):
                pair_channels(window, n, p.mesh.z_p, angle, pair, N_CHANNELS, channels)
                load = abs(force) * channels[SHARE]
                row = out[pair, k]
                row[0] = load
                if load <= 0.0:
                    continue
                slide = sliding_speed(m, channels)
                film = flank_film(
                    pair, m, load, force, slide, channels, window, n, oil, p.mesh.z_p,
                    p.flank_law, data.film_model, EXACT, films,
                )  # fmt: skip
                found = pair_friction(
                    m, load, slide, channels, oil, p.flank_law, film, data.film_model
                )
                flank = found.state
                row[1], row[2] = channels[LINE_RADIUS], channels[R_Y]
                row[3] = flank.film_ratio
                row[4] = p.friction * (flank.viscous_friction + flank.boundary_friction)
                row[5], row[6], row[7] = abs(slide), found.outside, flank.mean_pressure
        return status, carried

    return flanks_at_torque


def flank_states(
    parameters: HypoidAxleParameters, *, torque: float, speed: float, temperature: float
) -> FlankStates:
    """Return the flanks of a pair through its engagement.

    Parameters
    ----------
    parameters
        The axle; its mesh table must have the places on the tooth, as one of contact analysis.
    torque, speed, temperature
        As in `axle_losses`: torque on the pinion, below 0 for the coast flanks [N.m]; speed of
        the pinion [rad/s]; oil [K].

    Raises
    ------
    ParameterError
        A number is out of range, the axle finds no balance, or the table has no places.

    Notes
    -----
    Film and friction are those of `axle_losses`, and so is their power. A law of friction without
    asperities does not know what they carry: the share is 1 then.

    Examples
    --------
    >>> from gearlube_core.dynamics.hypoid_axle.mohammadpour_2015 import mohammadpour_2015_axle
    >>> axle = mohammadpour_2015_axle()
    >>> found = flank_states(axle, torque=50.0, speed=209.4, temperature=333.15)
    >>> round(1e-9 * float(found.pressure.max()), 1), round(found.friction_power)  # GPa, W
    (0.8, 226)
    """
    mesh = parameters.mesh.without_shaft_error()
    if not mesh.has_tooth_places:
        raise ParameterError(
            f"The mesh table {mesh.name} must have the places of contact on the tooth, got none. "
            "Run `gearlube contact` with the gear file and name its table in the axle file."
        )
    oil = np.array([temperature])
    lost = axle_losses(
        parameters, torques=np.array([torque]), speeds=np.array([speed]), temperatures=oil,
        angles=8, extremes=False,
    )  # fmt: skip
    bulk = float(lost.bulk_temperature[0, 0, 0])
    status, carried, angles = int(lost.status[0, 0, 0]), 0.0, mesh.nodes // PAIRS
    out, bearings = np.zeros((PAIRS, angles, _COLUMNS)), np.zeros((4, _ROLLERS + ROLLERS_MAX))
    p = parameters.kernel_parameters()
    if status == OK:
        packed = replace(parameters, mesh=mesh).packed_mesh()
        models = parameters.film_model(), parameters.roller_model(), *parameters.oil.own_laws()
        status, carried = _flank_kernel(type(p.bearing_p), type(p.flank_law))(
            speed, torque, bulk, angles, (*packed.fields, *models), flatten(p),
            flatten(without_losses(p)), np.zeros(cycle_work(packed.series_size, packed.nodes)),
            np.zeros(N_LOSSES), out, bearings,
        )  # fmt: skip
    if status != OK:
        raise ParameterError(
            f"The flanks at {torque:g} N.m, {speed:g} rad/s and {temperature:g} K must be found, "
            f"but {FAILURES[status]}"
        )
    table = out.reshape(-1, _COLUMNS)
    bracket = load_bracket(abs(torque), carried, mesh.torque, mesh.torque.size)
    loaded = np.flatnonzero(table[:, 0] > _LEAST_LOAD * table[:, 0].max())

    def placed(*names: str) -> Array:
        both = (mesh.windows[name][[bracket.lower, bracket.upper]] for name in names)
        return np.stack([low + bracket.weight * (high - low) for low, high in both], -1)[loaded]

    # the engagement may pass the end of the window: it begins behind the way from exit to entry
    there = placed("tooth_along", "tooth_up")
    way = np.linalg.norm(np.diff(there, axis=0, append=there[:1]), axis=1)
    loaded = np.roll(loaded, -1 - int(way.argmax()))
    turns = np.cumsum(np.diff(loaded, prepend=loaded[0]) < 0)
    phase = loaded / angles + PAIRS * (turns - 0.5)
    phase -= PAIRS * np.round(phase.mean() / PAIRS)
    rows = table[loaded]
    load, (film_ratio, friction, sliding, outside, mean) = rows[:, 0], rows[:, 3:].T
    solid, law = solid_parameters(parameters.solid, parameters.solid), p.flank_law
    E = solid.contact_modulus
    a, b, _ = np.array([hertz_ellipse(x, y, E, F) for F, x, y in rows[:, :3]]).T
    of_pair = pair_contact(mesh, math.copysign(torque, carried), phase)
    share = np.ones(load.size)
    if isinstance(law, MixedFlankFriction):
        share = asperity_shares(load, mean, film_ratio, law.surface, solid, int(law.form))
    across, half = speed * of_pair.entrainment[:, 0], 0.5 * speed * of_pair.sliding[:, 0]
    still = np.stack([across + half, across - half])
    # the contact moves over the gear tooth, so flanks pass it faster than they pass a point at rest
    place, major = placed("tooth_along", "tooth_up"), placed("major_along", "major_up")
    axes = np.stack([placed("minor_along", "minor_up"), major], -1)
    periods = speed * mesh.pinion_teeth / (2.0 * math.pi)
    moved = np.linalg.solve(axes, periods * np.gradient(place, phase, axis=0)[..., None])
    pinion_speed, gear_speed = still + np.maximum(
        np.abs(moved[:, 0, 0]) - still[1], -_HELD * still.min(axis=0)
    )
    return FlankStates(
        phase=phase,
        load=load,
        pressure=1.5 * load / (math.pi * a * b),
        line_load=0.75 * load / b,
        semi_minor=a,
        semi_major=b,
        film_ratio=film_ratio,
        friction=friction,
        asperity_share=share,
        outside=outside,
        sliding=sliding,
        pinion_speed=pinion_speed,
        gear_speed=gear_speed,
        table_pressure=placed("pressure_max")[:, 0],
        place=place,
        major=major,
        share_of_time=1.0 / angles,
        bulk=bulk,
        carried=float(carried),
        bearings=BearingStates(
            radial=np.hypot(bearings[:, 0], bearings[:, 1]),
            axial=np.abs(bearings[:, 2]),
            rollers=bearings[:, _ROLLERS:],
            film=bearings[:, 3],
        ),
    )
