"""Numbers of the kernels that models and FMUs call, to compare compiled code with interpreted.

In a process without compilation all that these kernels call is interpreted as well.
"""

from __future__ import annotations

import json
import sys
from dataclasses import fields, replace

import numpy as np

from gearlube_core.bearings import roller_loads, shaft_expansion, standalone, tapered_roller_kernels
from gearlube_core.bearings.ball_rings import ball_rings
from gearlube_core.bearings.bearing_type import ShaftMotion
from gearlube_core.bearings.cylinder_rings import cylinder_rings
from gearlube_core.bearings.losses import catalogue, laws, physical_loss, race_rolling
from gearlube_core.bearings.ring_loads import RingMotion
from gearlube_core.bearings.tapered_roller_bearing import TaperedRollerBearing
from gearlube_core.dynamics.helical_pair.separation.problem import SeparationProblem
from gearlube_core.dynamics.hypoid_axle import HypoidAxle
from gearlube_core.dynamics.hypoid_axle.linearise import linearise
from gearlube_core.dynamics.hypoid_axle.losses import axle_losses
from gearlube_core.dynamics.hypoid_axle.output_names import MOTION_OUTPUTS, N_OUTPUTS, OUTPUT_INDEX
from gearlube_core.dynamics.hypoid_axle.state import N_ODE, PHI_P, U_P, W_G, X
from gearlube_core.dynamics.hypoid_axle.train_outputs import (
    gather_motion,
    gather_rates,
    output_places,
)
from gearlube_core.dynamics.hypoid_torsional import (
    kernel_parameters,
    mode_march,
    period_map,
    time_sweep,
)
from gearlube_core.dynamics.hypoid_torsional.model import HypoidTorsional
from gearlube_core.dynamics.hypoid_torsional.parameters import karagiannis_2012_pair
from gearlube_core.dynamics.train.march import EVENT, EXCHANGE, work_size
from gearlube_core.dynamics.train.plan import AT, FIRST_ROW, N_PLACES
from gearlube_core.errors import StepError
from gearlube_core.kernels.flat_tuples import flatten
from gearlube_core.mesh_table.line_mesh_file import named_line_mesh
from gearlube_core.oil.lubricant import Lubricant
from gearlube_core.oil.lubricant_state import lubricant_state
from tests.helpers.axle_cases import (
    OIL,
    axle_with,
    operating_point,
    with_coast_flanks,
    with_shaft_errors,
)
from tests.helpers.bearing_32216 import BEARING
from tests.helpers.helical_march_cases import TORQUE, he_march, started
from tests.helpers.separation_cases import crowned_mesh, separating_pair
from tests.helpers.torsional_cases import reconstructed

H = 1e-5  # s: two or three steps of the axle


class Record:
    """Results by name, each an array of all that a kernel has returned and written."""

    def __init__(self):
        self.numbers = {}

    def keep(self, name, *parts):
        self.numbers[name] = np.concatenate([np.ravel(part) for part in parts]).tolist()

    def call(self, name, kernel, *arguments, written=()):
        """Keep what a kernel returns and the arrays in `written`."""
        found = kernel(*arguments)
        parts = [] if found is None else [flatten(found if isinstance(found, tuple) else (found,))]
        self.keep(name, *parts, *written)


def axles():
    """Axles with every term of the equations in one of them, by name."""
    plain = axle_with()
    own_coast = replace(plain, mesh=with_coast_flanks(plain.mesh))
    points = replace(plain.bearing, exponent=1.2)  # no line contact: sums for any exponent
    return {
        "plain": plain,
        "printed": axle_with(
            equations="as_printed", friction="as_printed", mesh_damping="modal", radii="paper",
            bearing_approach="as_printed",
        ),
        "solved": axle_with(film="solved", bearing_torque_loss="solved_films"),
        "two flanks": replace(own_coast, bearing_torque_loss="biboulet_houpert_2010"),
        "rolling": replace(
            plain, bearing=points, bearing_torque_loss="zhou_hoeprich_1991",
            rolling="biboulet_houpert_2010",
        ),
        "shaft errors": replace(
            plain, mesh=with_shaft_errors(plain.mesh), bearing_torque_loss="palmgren_loaded"
        ),
        "skf": axle_with(bearing_torque_loss="skf_2013"),
    }  # fmt: skip


def axle_entries(record, *, of_fmus=True):
    """Start, steps, outputs, rates and modes of the axle; `of_fmus`: also what FMUs alone call."""
    speed, torque, wheel_torque = operating_point(60)
    torques = torque, wheel_torque
    for name, parameters in axles().items():
        axle = HypoidAxle(parameters)
        for pinion in (-torque, torque):
            axle.initialise(
                pinion_speed=speed,
                pinion_torque=pinion,
                wheel_torque=wheel_torque,
                oil_temperature=OIL,
            )
            record.keep(f"{name} start {pinion:g}", axle.get_state(), axle.step_control)
        if name in ("plain", "printed"):
            linear = linearise(axle, OIL, torque)
            record.keep(f"{name} linear", linear.stiffness, linear.damping, linear.circulatory)
        for place, start in states_of_axle(axle.get_state(), name).items():
            axle.set_state(start)
            try:
                axle.step(H, *torques, OIL)
            except StepError as refusal:
                record.numbers[f"{name} {place}"] = [float(len(str(refusal)))]
                continue
            record.keep(f"{name} {place}", axle.get_state(), axle.outputs)
            axle.step(5e-8, *torques, OIL)  # so short that means are kept
            record.keep(f"{name} {place} short", axle.get_state(), axle.outputs)
            record.keep(f"{name} {place} rates", axle.derivative(axle.get_state()[:N_ODE]))
            if of_fmus:
                fmu_entries(record, f"{name} {place}", axle, start)


def states_of_axle(rest, name):
    """States from which a step is taken: rolling on, teeth apart, on the other flanks, refused."""
    moved = rest.copy()
    moved[U_P : U_P + 3] += 0.5e-6
    changes = {"rolling": (X, moved[X]), "coasting": (X, -155e-6), "crossed": (X, -100e-6)}
    if name in ("plain", "printed"):
        changes |= {"apart": (X, -3e-6), "diverged": (X, -0.2), "fast": (W_G, -5001.0),
                    "far": (PHI_P, 1.1e9)}  # fmt: skip
    states = {place: moved.copy() for place in changes}
    for place, (index, value) in changes.items():
        states[place][index] = value
    return states


BAND = 0.1 * np.sin(np.arange(64.0))  # any sensitivities of losses


def fmu_entries(record, name, axle, start):
    """The kernels by which FMUs write the motion after a step, rates and events."""
    given, made, out = axle.parameters, axle.assembly, np.zeros(N_OUTPUTS)
    mesh, p, places = given.packed_mesh(), axle.kernel_parameters, output_places(made)
    numbers, memory, plan = made.numbers, made.memory, made.plan
    work, s = np.zeros(work_size(made.sizes)), start[: made.sizes.states].copy()
    row = FIRST_ROW + sum(AT + plan[FIRST_ROW + i * (AT + 3) + N_PLACES] for i in range(2))
    at = tuple(plan[row + AT : row + AT + plan[row + N_PLACES]].tolist())
    motion = np.array([OUTPUT_INDEX[one] for one in MOTION_OUTPUTS])
    series = np.zeros(mesh.series_size)
    table = numbers, made.sizes, work, places, BAND, motion
    gather_motion(s, p.mesh, at, memory, series, *table, out)
    record.keep(f"{name} motion", out)
    axle.operate(EXCHANGE, s, OIL, numbers, memory, plan, 0.0, 0.0, work)
    gather_rates(s, work, places, out)
    axle.operate(EVENT, s, OIL, numbers, memory, plan, 0.0, 0.0, work)
    record.keep(f"{name} continuous", s, out)


def loss_map_entries(record):
    """Mean losses of the axle over a mesh cycle, driving and coasting."""
    speed, torque, _ = operating_point(60)
    for name in ("plain", "printed", "solved", "rolling"):
        found = axle_losses(
            axles()[name],
            torques=np.array([torque, -torque]),
            speeds=np.array([speed]),
            temperatures=np.array([OIL]),
            angles=4,
        )
        record.keep(name, *(getattr(found, field.name) for field in fields(found)))


def torsional_entries(record):
    """Marches, sweeps and period maps of the torsional pair in each mode of contact."""
    pair = karagiannis_2012_pair()
    models = {
        "hot": replace(pair, friction="thermal_eyring", torque_ripple=0.1),
        "along": replace(pair, friction="thermal_eyring", entrainment="along_sliding"),
        "cold": replace(pair, friction="evans_johnson"),
        "printed": reconstructed(
            0.003, equations="as_printed", damping_gate="as_printed", load_torque="instantaneous"
        ),
        "reduced": reconstructed(form="one_dof", torque_ripple=0.1),
    }
    load, speed, work = 138.0, 905.0, np.zeros(mode_march.MARCH_WORK)
    per_speed = np.zeros(2), np.zeros(2)
    for name, parameters in models.items():
        model = HypoidTorsional(parameters)
        mesh = model._series, model._orders, model._window, model._nodes, 13.0
        table = np.zeros((8, kernel_parameters.N_ROW))
        record.call(f"{name} rows", kernel_parameters.mesh_rows, *mesh, table, written=[table])
        p, rows = model.kernel_parameters, model.rows(16)
        start = model.initial_state(speed)
        for x in (None, 3.0, 0.2, -20.0, -153.0, 2e5):  # um; the last diverges
            place, here, orbits = f"{name} {x}", start.copy(), np.zeros((32, 5))
            if x is not None:
                here[0] = x
            y = here.copy()
            record.call(
                f"{place} march", mode_march.march, y, 1, 2, load, speed, rows, p, orbits, work,
                written=[y, orbits],
            )  # fmt: skip
            if x not in (None, 2e5):
                continue
            y, by_start = here.copy(), np.zeros((4, 5))
            record.call(
                f"{place} map", period_map.period_map, y, by_start, load, speed, 1, rows, p,
                np.zeros(period_map.WORK), written=[y, by_start],
            )  # fmt: skip
            y, speeds, waves = here.copy(), np.array([speed, 910.0]), np.zeros((2, 16, 5))
            record.call(
                f"{place} sweep", time_sweep.sweep_kernel, y, speeds, 1, 1, 1, load, rows, p,
                waves, *per_speed, work, written=[y, waves, *per_speed],
            )  # fmt: skip
            y = here.copy()
            record.call(f"{place} load", time_sweep.settle_load, y, 2, load, speed, rows, p, work)


def bearing_entries(record):
    """Forces, loads and films of rollers, motion of a rotor, and losses."""
    bearing = TaperedRollerBearing.mohammadpour_2015().with_preload(2500.0)
    oil, generator = (0.0171, 2.383e-8), np.random.default_rng(7)
    p = bearing.parameters()
    for i in range(20):
        p = p._replace(n=(10.0 / 9.0, 1.2)[i % 2])
        u, v = generator.normal(size=3) * 4e-6, generator.normal(size=3) * 3e-3
        motion = ShaftMotion(*u.tolist(), *v.tolist(), generator.uniform(0, 6), 145.0)
        shaft, loads = (motion, 300.0, *oil, p), np.zeros(12)
        record.call(f"forces {i}", tapered_roller_kernels.shaft_bearing_forces, *shaft)
        record.call(f"other {i}", roller_loads.bearing_forces, *shaft, -1.0)
        record.call(f"loads {i}", roller_loads.roller_loads, *shaft, 1.0, loads, written=[loads])
        record.call(f"films {i}", roller_loads.roller_films, motion, *oil, p, 1.0, loads,
                    written=[loads])  # fmt: skip
        record.call(f"energy {i}", shaft_expansion.shaft_bearing_energy, *motion[:3], 0.3, 145.0,
                    *oil, p)  # fmt: skip
    record.call("drag", catalogue.drag_torque, 150.0, 2500.0, 0.0, 19e-6, p)
    ring_entries(record, generator)
    state, states, loads = np.array([1e-6, 0, 0, 1e-3, 0, 0]), np.zeros((5, 6)), np.zeros((5, 12))
    rotor = standalone.Rotor(50.0, 1500.0, 209.0, 159.0, *oil, p)
    record.call("rotor", standalone.rotor_history, state, 1e-5, 2, rotor, states, loads,
                np.zeros((5, 6)), written=[states, loads])  # fmt: skip
    loss_entries(record)


def ring_entries(record, generator):
    """Loads and stiffness between the rings of a ball and of a cylindrical roller bearing."""
    sizes, modulus = (7, 11.5e-3, 43.5e-3), 1.15e11
    rollers, gaps = cylinder_rings(*sizes, 13.6e-3, modulus, laminae=7, flange=1e8)
    balls = ball_rings(*sizes, 0.52, 0.53, modulus)
    for name, rings in {"balls": balls, "rollers": rollers}.items():
        for i in range(6):
            u, v = generator.normal(size=5) * 1e-5, generator.normal(size=5) * 1e-3
            motion = RingMotion(*u.tolist(), *v.tolist(), generator.uniform(0, 6), 60.0)
            out = np.zeros(25)
            record.call(f"{name} {i}", type(rings).ring_loads, rings, motion, 1e-5, gaps)
            stiffness = type(rings).ring_stiffness
            record.call(f"{name} K {i}", stiffness, rings, motion, gaps, out, written=[out])


def loss_entries(record):
    """Losses of a bearing by all laws."""
    p, loads = BEARING.parameters(), np.linspace(2000.0, 0.0, 16)
    oil = lubricant_state(Lubricant.named("fva_3").parameters(), 323.15)
    model = race_rolling.roller_film_model("solved_films")
    for name, law in laws.RACE_LAWS.items():
        for heating in (0, 1) if law != laws.SOLVED_FILMS else (0,):
            for w in (0.0, 200.0):
                chosen = physical_loss.LossSettings(law, heating, 5e-6 * heating)
                record.call(f"{name} {heating} {w}", physical_loss.physical_loss, p, chosen, loads,
                            w, oil, model)  # fmt: skip
    record.call("ring", roller_loads.ring_loads, 6000.0, 6500.0, BEARING.dry_rollers(), loads,
                written=[loads])  # fmt: skip
    record.call("skf", catalogue.skf_torque, 200.0, 6000.0, 3000.0, 6e-5, BEARING.dry_rollers())


def helical_entries(record):
    """Start, steps and outputs of the marching helical pair; its linear and separating motions."""
    mesh = named_line_mesh("he_2007")
    for name, settings in {
        "film": {"friction": "film"},
        "lines": {"friction": "film", "line_mesh": mesh, "bearing_distance": 0.03},
        "printed": {"equations": "he_2007", "form": "six_dof", "friction_coefficient": 0.1},
    }.items():
        model = started(he_march(**settings))
        record.keep(f"{name} start", model.get_state(), model.step_control)
        for torque in (TORQUE, -0.5 * TORQUE):
            model.step(H, torque, torque, OIL)
            record.keep(f"{name} {torque:g}", model.get_state(), model.outputs)
    loose = replace(separating_pair().pair, backlash=8e-6)
    both = separating_pair(
        mu=0.08, zeta=0.05, pair=loose, line_divisions=3,
        mesh=crowned_mesh(loose, crown=4e-6, torque=(20.0, 300.0)),
    )  # fmt: skip
    problem = SeparationProblem(both, steps_per_mesh_period=16)
    random = np.random.default_rng(3).standard_normal((2, problem.size))
    for i, z in enumerate(problem.initial_guess() + 0.6 * problem.scales * random):
        flow = problem.flow(z, 0.7 * problem.natural_speed, 90.0)
        record.keep(f"map {i}", *(np.asarray(part) for part in flow))
        orbit = problem.orbit(z, problem.natural_speed)
        record.keep(f"orbit {i}", orbit.displacement)


FAMILIES = {
    "helical": helical_entries,
    "axle": axle_entries,
    "loss map": loss_map_entries,
    "torsional": torsional_entries,
    "bearing": bearing_entries,
}


def numbers(family, **settings):
    """The numbers of one family by name of the call."""
    record = Record()
    FAMILIES[family](record, **(settings if family == "axle" else {}))
    return record.numbers


def report():
    """Write the numbers of all entries as JSON."""
    sys.stdout.write(json.dumps({name: numbers(name) for name in FAMILIES}))
