"""Arguments of every kernel of the axle, from an axle that runs."""

from functools import cache

import numpy as np

from gearlube_core.bearings import bearing_type, parameters, shaft_expansion
from gearlube_core.bearings.parameters import ROLLERS_MAX
from gearlube_core.dynamics import flank_force, mean_power
from gearlube_core.dynamics.hypoid_axle import (
    HypoidAxle,
    bearing_drag,
    communication,
    continuous,
    flank_outputs,
    flanks,
    force_derivatives,
    integrate,
    mesh_at_load,
    mesh_force,
    output_names,
    outputs,
    rhs,
    start,
    tooth_pair,
)
from gearlube_core.dynamics.hypoid_axle.kernel_parameters import without_losses
from gearlube_core.dynamics.hypoid_axle.mesh_at_load import MeshAtLoad, MeshLevels
from gearlube_core.dynamics.hypoid_axle.model import START_WORK
from gearlube_core.dynamics.hypoid_axle.output_names import (
    FIRST_FLANK_BOUND,
    FLANKS,
    N_OUTPUTS,
    PINION_BEARINGS,
)
from gearlube_core.dynamics.hypoid_axle.state import (
    CAGE_G,
    LOAD_TORQUE,
    N_CONTINUOUS,
    N_DRAG,
    N_FILMS,
    N_ODE,
    N_STATE,
    PHI_P,
    PINION_WORK,
    SIDE,
    TIME_IN_STEP,
    U_P,
    W_G,
    W_P,
    WORK_MARK,
    X,
)
from gearlube_core.dynamics.packed_mesh import N_CHANNELS, pack_mesh
from gearlube_core.mesh_table import kernels
from gearlube_core.oil.lubricant import lubricant_state
from tests.helpers.axle_cases import OIL, axle_with, running_axle, with_coast_flanks
from tests.helpers.axle_compiled_arguments import compiled_cases
from tests.helpers.axle_film_arguments import AxleFlank, film_cases
from tests.helpers.axle_raceway_arguments import raceway_cases


def zeros(size):
    return np.zeros(size)


def drag_cases(state, oil, p):
    """The kernels of what is kept of the drag by Biboulet and Houpert's law."""
    by_roller = p._replace(drag=float(bearing_drag.TORQUE_LOSSES.index("biboulet_houpert_2010")))
    films, kept = bearing_type.RollerFilms(zeros(0), zeros(0), 0.0), zeros(N_DRAG)
    bearing_drag.renew_drag(state, oil, by_roller, films, kept, zeros(N_STATE))
    moved = state.copy()
    moved[U_P : U_P + 3] += 0.5
    moved[W_P] *= 1.01
    return [
        *((bearing_drag._change, (moved, kept, shaft, i)) for shaft in (0, 1) for i in (1, 3)),
        *((bearing_drag._moved, (state, i, zeros(N_STATE))) for i in (1, 3)),
        *((bearing_drag.drag_holds, (one, oil.temperature, kept)) for one in (state, moved)),
        (bearing_drag.drag_near, (moved, kept)),
        *(
            (bearing_drag.renew_drag, (moved, oil, by_roller, films, one, zeros(N_STATE)))
            for one in (kept, zeros(N_DRAG))
        ),
    ]


@cache
def all_cases():
    """Kernels with arguments; made by the first test, as collecting them would compile an axle."""
    axle, torque_p, torque_g = running_axle(60)
    for _ in range(20):
        axle.step(1e-4, torque_p, torque_g, OIL)
    state = axle.get_state()[:N_STATE]
    solved = HypoidAxle(axle_with(film="solved"))
    by_model, numbers = solved.kernel_parameters, solved.parameters.film_model()
    mesh = axle.packed
    p = axle.kernel_parameters
    printed = HypoidAxle(
        axle_with(
            equations="as_printed", friction="as_printed", mesh_damping="modal", radii="paper"
        )
    ).kernel_parameters
    state_of_oil = lubricant_state(p.oil, OIL)
    inputs = integrate.step_inputs(
        state, torque_p, torque_g, state_of_oil, p, bearing_drag.AxleRaceways()
    )
    series, window = np.zeros(mesh.series_size), np.zeros(mesh.window_size)
    table = MeshLevels(mesh.levels, mesh.series, mesh.orders, mesh.windows, mesh.nodes)
    mesh_data = MeshAtLoad(series, mesh.orders, window, mesh.nodes)
    mesh_at_load.blend_mesh(state[LOAD_TORQUE], 1.0, table, mesh_data)
    at_load = (mesh_data, state_of_oil)
    force = mesh_force.mesh_force(state, series, mesh.orders, p.mesh).force
    channels, friction = np.zeros(N_CHANNELS), np.zeros(rhs.N_FRICTION)
    kernels.pair_channels(window, mesh.nodes, p.mesh.z_p, state[PHI_P], 0, N_CHANNELS, channels)
    control = axle.step_control
    scratch = np.zeros(rhs.SCRATCH)
    slope = np.zeros(N_ODE)
    rhs.axle_rhs(state, inputs, *at_load, p, 1.0, 1.0, scratch, slope)
    flank = AxleFlank(
        state, force, window, mesh.nodes, state_of_oil, p, by_model, numbers, channels, friction
    )
    motion = bearing_type.ShaftMotion(3e-6, -1e-6, 0.5e-6, 1e-3, 2e-3, -1e-3, 0.3, 145.0)
    moved = bearing_type.ShaftMotion(3.1e-6, -1.2e-6, 0.6e-6, 2e-3, 1e-3, -2e-3, 0.31, 145.0)
    terms = parameters.ApproachTerms(10.0, 3.0, 1.0, 0.5, 20.0, -30.0, 5.0)
    loop = (12, terms, 0.7, 3e-5, 40.0, 3e-5, 0.0)
    expansion = np.zeros(bearing_type.N_EXPANSION)
    shaft_expansion.expand_shaft_bearings(motion, 300.0, 0.0171, 2.4e-8, p.bearing_p, expansion)
    separated = state.copy()
    separated[X] = -3.0
    coasting = state.copy()
    coasting[X] = -155.0
    both = pack_mesh(with_coast_flanks(axle.parameters.mesh), 115e9, "consistent", "tangent")
    both_sides = MeshLevels(both.levels, both.series, both.orders, both.windows, both.nodes)
    crossed, crossed_back = state.copy(), state.copy()
    crossed[X], crossed_back[X] = -100.0, -50.0
    crossed_back[SIDE] = -1.0
    no_good = [state.copy() for _ in range(3)]
    no_good[0][X], no_good[1][W_G], no_good[2][CAGE_G] = -2e5, -5001.0, 1.1e9
    at_start = state.copy()
    at_start[TIME_IN_STEP] = 0.0
    torques = (torque_p, torque_g)
    work = zeros(integrate.work_size(mesh.series_size, mesh.nodes))
    lossless = without_losses(p)
    at_rest = start.RestProblem(
        state,
        inputs,
        mesh_data,
        state_of_oil,
        lossless,
        zeros(1),
        np.linspace(-50.0, 40.0, start.N_FREE),
        zeros(rhs.SCRATCH),
        zeros(N_ODE),
    )
    stiffness = zeros(force_derivatives.N_COORDINATES**2)
    force_derivatives.force_derivatives(
        state, 0.0, 60.0, OIL, table, lossless, zeros(START_WORK), stiffness
    )
    tail = np.array([2.0, 2.0, 0.4, 3.0, -1.0, 0.5, 0.2, 2.0, 1.0, -0.3, 0.7])
    bracket = kernels.load_bracket(33.0, 1.0, mesh.levels, mesh.levels.size)
    write_shaft = (motion, 300.0, state_of_oil, p.bearing_p, PINION_BEARINGS, (2, 1, 0))
    found = [
        *(
            (kernels.load_bracket, (torque, side, levels, levels.size))
            for torque in (0.0, 33.0, 1e3)
            for side in (1.0, -1.0)
            for levels in (mesh.levels, both.levels)
        ),
        (kernels.blend_levels, (mesh.series, mesh.series_size, bracket, zeros(mesh.series_size))),
        (kernels.mesh_series, (series, mesh.orders, 13.0, 0.3)),
        (kernels.shaft_error, (tail, 0.3)),
        (kernels.shaft_error_rate, (tail, 0.3)),
        (
            kernels.mesh_series,
            (np.append(series, tail), mesh.orders, 13.0, 0.3),
        ),
        (mesh_at_load.series_size, (table,)),
        (kernels.transmission_error, (series, mesh.orders, 13.0, 0.3)),
        (kernels.pair_channels, (window, mesh.nodes, 13.0, 0.3, 1, N_CHANNELS, zeros(N_CHANNELS))),
        (shaft_expansion._sums_line, loop),
        (shaft_expansion._sums_general, (*loop, 1.3, zeros(bearing_type.N_EXPANSION))),
        (
            shaft_expansion.expand_shaft_bearings,
            (motion, 300.0, 0.0171, 2.4e-8, p.bearing_p, zeros(bearing_type.N_EXPANSION)),
        ),
        (
            shaft_expansion.expand_shaft_bearings,
            (
                motion,
                300.0,
                0.0171,
                2.4e-8,
                p.bearing_p._replace(n=1.2),
                zeros(bearing_type.N_EXPANSION),
            ),
        ),
        (
            shaft_expansion.expanded_shaft_forces,
            (moved, p.bearing_p, expansion),
        ),
        (flank_force.backlash_deflection, (3e-6, 150e-6)),
        (flank_force.backlash_deflection, (-3e-6, 150e-6)),
        (flank_force.backlash_deflection, (-153e-6, 150e-6)),
        (flank_force.gated_force, (900.0, 2278.0, -0.1, 3e-6)),
        (flank_force.gated_force, (-30.0, 2278.0, -0.1, -0.1e-6)),
        (mesh_force.reference_frequency, (p.mesh, 145.0)),
        (mesh_force.reference_frequency, (p.mesh, -1.0)),
        *(
            (mesh_force.mesh_force, (state, series, mesh.orders, one.mesh))
            for state in (state, separated, coasting)
            for one in (p, printed)
        ),
        *raceway_cases(state, state_of_oil, p),
        (
            integrate.inputs_with_drag,
            (state, 3.0, 5.0, bearing_drag.BearingDrag(0.2, 0.3), state_of_oil, p),
        ),
        (tooth_pair.sliding_speed, (state, channels)),
        (tooth_pair.contact_of, (channels,)),
        *film_cases(flank),
        (kernels.pair_node, (60, 13.0, 0.3, 1)),
        (mesh_at_load.place_at_load, (table, series, window)),
        (flanks.pair_rolling, (900.0, -2.0, 0.7, channels, state_of_oil, p)),
        (rhs.pinion_motion, (state,)),
        (rhs.gear_motion, (state,)),
        *(
            (rhs.axle_rhs, (state, inputs, *at_load, parameters, fresh, fresh, scratch, slope))
            for state in (state, separated, coasting)
            for parameters in (p, printed)
            for fresh in (1.0, 0.0)
        ),
        (start.mean_series, (33.0, table, zeros(kernels.N_SERIES))),
        (start.rest_forces, (np.array([1.0, 2.0, 3.0, -1.0, -2.0, 4.0]), at_rest, zeros(6))),
        *(
            (start.rest, (zeros(N_STATE), 145.0, torque, OIL, table, lossless, zeros(START_WORK)))
            for torque in (60.0, -60.0)
        ),
        (
            start.rest_under,
            (
                zeros(N_STATE),
                145.0,
                60.0,
                OIL,
                table,
                lossless,
                np.linspace(-50.0, 40.0, start.N_FREE),
                zeros(START_WORK),
            ),
        ),
        *((force_derivatives._rate_place, (j,)) for j in range(8)),
        *((force_derivatives.mass_of, (j, p)) for j in range(8)),
        *(
            (
                force_derivatives.force_derivatives,
                (state, of_speeds, 60.0, OIL, table, p, zeros(START_WORK), zeros(64)),
            )
            for of_speeds in (0.0, 1.0)
        ),
        (force_derivatives.highest_frequency, (stiffness, p, zeros(64))),
        (
            force_derivatives.write_step_control,
            (state, 64.0, 22.0, 60.0, OIL, table, lossless, zeros(START_WORK), zeros(5)),
        ),
        (mesh_force.modal_damping, (0.06, 5e8, 3.4)),
        (mesh_force.equivalent_mass, (0.021, 2.77, 1.7e-3, 0.058)),
        (integrate.step_limit, (p, control, 145.0, 5e8)),
        (integrate.step_limit, (printed, control, 145.0, 5e8)),
        *(
            (
                integrate.rk4_step,
                (
                    state,
                    2e-5,
                    first,
                    inputs,
                    *at_load,
                    p,
                    scratch,
                    zeros(N_STATE + 2 * N_ODE),
                ),
            )
            for first in (1.0, 0.0)
        ),
        (integrate.place_ahead, (state, 3e-5, p, zeros(N_STATE))),
        *((integrate.contact_parts, (x, -0.3, 150.0)) for x in (0.2, 3.0, -149.9, -80.0)),
        (rhs.expand_bearings, (state, state_of_oil, p, scratch)),
        (outputs.films_asked, (state,)),
        (outputs.films_asked, (at_start,)),
        (integrate.step_inputs, (state, 60.0, 100.0, state_of_oil, p, bearing_drag.AxleRaceways())),
        (
            integrate.step_inputs,
            (
                *(state, 60.0, 100.0, state_of_oil, p._replace(drag=0.0)),
                bearing_drag.AxleRaceways(),
            ),
        ),
        (integrate.displacements, (state, 1e-5)),
        (
            integrate.largest_change,
            ((1.0, 2.0, 3.0, 4.0, 5.0, 6.0), (1.5, 2.0, 0.0, 4.0, 5.0, 7.0)),
        ),
        (
            mesh_at_load.blend_mesh,
            (33.0, -1.0, both_sides, mesh_data),
        ),
        (
            mesh_at_load.lateral_and_unloaded,
            (state, kernels.mesh_series(series, mesh.orders, 13.0, 0.3), series, mesh.orders, 13.0),
        ),
        *(
            (mesh_at_load.follow_flank, (state, both_sides, parameters, mesh_data))
            for state in (state, separated, coasting, crossed, crossed_back)
            for parameters in (p.mesh, p.mesh._replace(backlash=0.0))
        ),
        *(
            (
                mesh_at_load.gap_rotation,
                (
                    one,
                    kernels.mesh_series(series, mesh.orders, 13.0, one[PHI_P]),
                    p.mesh,
                    series,
                    mesh.orders,
                ),
            )
            for one in (state, separated, coasting)
        ),
        (continuous.write_rates, (state, slope, -60.0, zeros(N_CONTINUOUS))),
        *(
            (continuous.write_event_indicators, (one, levels, mesh_data, p.mesh, zeros(3)))
            for one in (state, separated, coasting)
            for levels in (table, both_sides)
        ),
        *(
            (continuous.change_side, (one, levels, p.mesh, work))
            for one in (state, crossed, crossed_back)
            for levels in (table, both_sides)
        ),
        (outputs.write_derivatives, (state, torques, OIL, table, p, work, zeros(N_OUTPUTS))),
        *(
            (
                outputs._write_rates,
                (
                    *(one, torques, OIL, table, p, True, bearing_drag.AxleRaceways(), work),
                    zeros(N_OUTPUTS),
                ),
            )
            for one in (state, at_start)
        ),
        (outputs.raceways_of, (state, state_of_oil, p, zeros(0), scratch)),
        (
            outputs.write_flank_group,
            (state, force, OIL, state_of_oil, mesh_data, p, scratch, zeros(N_OUTPUTS)),
        ),
        (
            outputs.write_bearing_group,
            (state, 5e8, state_of_oil, p, zeros(ROLLERS_MAX), zeros(N_OUTPUTS)),
        ),
        *drag_cases(state, state_of_oil, p),
        (outputs.stored_energy, (state, 5e8, state_of_oil, p)),
        *(
            (
                flank_outputs.write_flanks,
                (
                    *(state, force, window, mesh.nodes, OIL, state_of_oil, one, model, asked),
                    *(zeros(N_FILMS), FLANKS, FIRST_FLANK_BOUND, channels),
                    zeros(N_OUTPUTS),
                ),
            )
            for one, model, asked in ((p, zeros(0), 1.0), (by_model, numbers, 2.0))
        ),
        (output_names.write_shaft, (*write_shaft, zeros(ROLLERS_MAX), zeros(N_OUTPUTS))),
        *((communication.state_status, (one,)) for one in (state, *no_good)),
        (mean_power.keep_means, (at_start, state, PINION_WORK, WORK_MARK, 10, TIME_IN_STEP)),
        *(
            (mean_power.mean_power, (state, slope, PINION_WORK, WORK_MARK, duration))
            for duration in (0.0, 1e-4)
        ),
        *(
            (output_names.write_losses, (state, slope, 7.0, 3.0, zeros(N_OUTPUTS)))
            for state in (state, at_start)
        ),
        *(
            (integrate.advance, (state, duration, torques, OIL, table, p, control, work))
            for duration in (1e-4, 1e9)
        ),
        *(
            (outputs.write_motion, (one, slope, 7.0, 3.0, series, mesh.orders, p, zeros(N_OUTPUTS)))
            for one in (state, at_start, separated)
        ),
        (outputs.write_motion_after_step, (state, table, p, work, zeros(N_OUTPUTS))),
        (
            outputs.write_outputs,
            (state, torques, OIL, table, p, work, zeros(ROLLERS_MAX), zeros(N_OUTPUTS)),
        ),
    ]
    return found + compiled_cases(
        state, torques, table, both_sides, p, lossless, control, work, crossed
    )


# sums over 24 rollers that may be taken in any order: 1e-12 of the largest
