"""The native axle: object code that needs nothing but libm and computes what Python computes."""

from __future__ import annotations

import copy
import math
import re
from dataclasses import replace

import numpy as np
import pytest

from drivetrain.axle_file.read_axle import read_axle
from fmu_src.hypoid_axle import DEFINITION, definition_with_axle, definition_with_table, start_axle
from fmu_src.native.axle_data import N_SIZES, DataSizes, data_ends
from fmu_src.native.build import ENTRY
from fmu_src.native.hypoid_axle import MODAL_WITHOUT_LOSS, PRINTED_FILM, REFUSALS, native_model
from fmu_src.native.model import OK, Group, Operation
from fmu_src.native.parameter_map import KernelClasses, place_of_each
from gearlube_core.bearings.tapered_roller_kernels import TaperedRollerParameters
from gearlube_core.dynamics.hypoid_axle.model import torque_limits
from gearlube_core.dynamics.hypoid_axle.output_names import (
    BEARING_FILMS,
    PINION_ACCELERATION,
    RATES,
    STATE_NAMES,
)
from gearlube_core.dynamics.hypoid_axle.train_outputs import N_BAND
from gearlube_core.dynamics.hypoid_mesh.kernel_parameters import AxleParameters, without_losses
from gearlube_core.dynamics.ranges import MAX_SPEED, RANGE_OUTPUTS
from gearlube_core.dynamics.train.march import MAX_STEPS, TOO_MANY_STEPS
from gearlube_core.dynamics.train.rest_search import NO_REST
from gearlube_core.errors import ParameterError
from gearlube_core.film_model.net import N_ARRAY, UNITS
from gearlube_core.friction.flank_film import N_FLANK_MODEL
from gearlube_core.friction.flank_friction import friction_law
from gearlube_core.friction.flank_laws import MixedFlankFriction
from gearlube_core.kernels.flat_tuples import count_floats, flatten
from gearlube_core.mesh_table.netcdf import shipped_mesh_table, write_mesh_table
from tests.helpers.axle_cases import with_coast_flanks, with_shaft_errors
from tests.helpers.drawn_axles import drawn, drivable, in_python
from tests.helpers.object_code import FREESTANDING, LIBM, LoadedModel, symbols, undefined_in_object
from tests.helpers.own_film_models import altered

KINDS = (TaperedRollerParameters, MixedFlankFriction)
N = count_floats(AxleParameters, *KINDS)
CURRENT = [60.0, 150.0, 333.15, 150.0]  # N.m, N.m, K, rad/s


@pytest.fixture(scope="module")
def native():
    return LoadedModel(native_model(DEFINITION))


def test_the_entry_needs_nothing_but_libm(native):
    wanted = undefined_in_object(native.code)
    assert wanted <= LIBM | FREESTANDING
    assert native.declared >= wanted - FREESTANDING - LIBM
    assert ENTRY in {symbol.name for symbol in symbols(native.code)}


@pytest.mark.parametrize("count", [100, pytest.param(1000, marks=pytest.mark.slow)])
def test_parameters_are_packed_bit_for_bit_as_in_python(native, count):
    rng = np.random.default_rng(count)
    for _ in range(count):
        values = drawn(rng)
        run = native.instance(values, CURRENT)
        status = run(Operation.RESUME)
        if values["mesh_damping"] == "modal" and values["modal_loss_factor"] == 0.0:
            assert status == MODAL_WITHOUT_LOSS
            with pytest.raises(ParameterError) as refusal:
                in_python(values)
            assert REFUSALS[status] == str(refusal.value)
            continue
        axle = in_python(values)
        if values["film"] == "solved" and not friction_law(values["friction"]).solved_film:
            assert status == PRINTED_FILM
            with pytest.raises(ParameterError, match=re.escape(REFUSALS[status])):
                axle.film_model()
            continue
        assert status == OK
        parameters = axle.kernel_parameters()
        np.testing.assert_array_equal(run.work[:N], flatten(parameters), str(values))
        at_ranges = native.model.ranges_at
        limits = [end for one in axle.ranges for end in (one.low, one.high)]
        assert run.work[at_ranges : at_ranges + len(limits)].tolist() == limits
        torques = torque_limits(axle)
        at_limits = native.model.limits_at
        assert run.work[at_limits : at_limits + 8].tolist() == [
            torques.pinion_low,
            torques.pinion_high,
            -torques.wheel,
            torques.wheel,
            axle.oil.temperature_low,
            axle.oil.temperature_high,
            -MAX_SPEED,
            MAX_SPEED,
        ]


# One step of the Newton iteration beyond rounding is all that the two may differ by: positions of
# 1e-16 of themselves, forces on stiff bearings that cancel from 1 kN to 10 N, 1e-13. The highest
# frequency comes from differences over 1 nm: 1e-12 (printed equations, ill-conditioned: 2e-11).
def assert_start_agrees(run, axle):
    exchange, control = run.model.exchange, run.model.control_at
    states = np.array(exchange.units) * run.state[list(exchange.places)]
    expected = [axle.output(name) for name in STATE_NAMES]
    # displacements of micrometres, as of outputs
    assert states == pytest.approx(expected, rel=1e-11, abs=1e-15)
    assert run.state[control - 4 : control].tolist() == run.inputs.tolist()
    assert run.state[control:] == pytest.approx(list(axle.step_control), rel=1e-10)
    assert_outputs_agree(run, axle, 1e-11)


def assert_outputs_agree(run, axle, limit):
    # a sum of bearing forces that cancel is as good as the largest of them
    of_force = limit * float(np.abs(axle.outputs[force_outputs()]).max())
    for name, one, two in zip(axle.output_names, run.outputs, axle.outputs, strict=True):
        # m and m/s, rounding of 1 um and of a few um/s that have died down
        floor = 1e-15 if "displacement" in name or "velocity" in name else 0.0
        if "bearing" in name and "loss" not in name:
            floor = of_force
        if "acceleration" in name:
            floor = of_force / 1e-3  # of forces on an arm of 0.05 m over 1e-3 kg m2
        assert one == pytest.approx(two, rel=limit, abs=floor), name


def force_outputs():
    return [i for i, name in enumerate(DEFINITION.output_names) if ".force" in name]


def test_starts_and_outputs_agree_with_python_for_all_options(native):
    rng = np.random.default_rng(1)
    for _ in range(20):
        values, inputs = drivable(rng)
        run = native.instance(values, inputs)
        assert run(Operation.START) == OK
        assert_start_agrees(run, start_axle(values, inputs))


def test_steps_continue_as_in_python_and_outputs_of_a_restored_state_are_the_same(native):
    values = {"oil": "karagiannis_2012", "friction": "printed_traction_circular"}
    values["pinion_speed"] = 150.0
    run = native.instance(values, CURRENT)
    assert run(Operation.START) == OK
    axle = start_axle(values, CURRENT)
    for k in range(20):
        torque = 60.0 + k
        run.inputs[0] = torque
        assert run.step(1e-3) == OK
        axle.step(1e-3, torque, *CURRENT[1:])
    # other instructions on another processor type: roundings grow over 20 ms to below 1e-9
    assert_outputs_agree(run, axle, 1e-9)
    assert run.state[native.model.exchange.inputs_at :][:4].tolist() == [79.0, *CURRENT[1:]]
    other = native.instance(values, [0.0, 0.0, 300.0, 0.0])
    assert other(Operation.RESUME) == OK
    other.state[:] = run.state
    assert other(Operation.OUTPUTS) == OK
    np.testing.assert_array_equal(other.outputs, run.outputs)
    run.inputs[:] = other.inputs[:] = CURRENT
    assert run(Operation.STEP, 1e-3) == other(Operation.STEP, 1e-3) == OK
    np.testing.assert_array_equal(other.state, run.state)


def test_solved_films_are_those_of_python(native):
    values = {"film": "solved", "bearing_torque_loss": "solved_films", "pinion_speed": 150.0}
    run = native.instance(values, CURRENT)
    assert run(Operation.START) == OK
    axle = start_axle(values, CURRENT)
    for k in range(20):
        torque = 60.0 + k
        run.inputs[0] = torque
        assert run.step(1e-3) == OK
        axle.step(1e-3, torque, *CURRENT[1:])
    run(Operation.OUTPUTS)
    assert_outputs_agree(run, axle, 1e-9)  # as above
    assert 0.0 < axle.output("efficiency_bound") < 0.02
    loaded = np.array([axle.output(f"flank[{i}].load") for i in (1, 2, 3)]) > 0.0
    bounds = np.array([axle.output(f"flank[{i}].friction_bound") for i in (1, 2, 3)])
    np.testing.assert_array_equal(bounds > 0.0, loaded)
    assert 0.0 < axle.output("bearing.power_loss_bound") < 0.02 * axle.output("bearing.power_loss")
    # rates are the same whether they are read alone or after all outputs
    of_all = run.outputs[RATES:].copy()
    run(Operation.DERIVATIVES)
    np.testing.assert_array_equal(run.outputs[RATES:], of_all)
    speed = STATE_NAMES.index("pinion.speed")
    assert of_all[speed] == run.outputs[PINION_ACCELERATION] != 0.0


def test_an_axle_file_changes_constants_alone_and_is_the_axle_of_python_over_20_ms(
    native, tmp_path
):
    path = tmp_path / "axle.toml"
    path.write_text(
        '[gear_set]\nmesh_table = "mohammadpour_2015"\nfrequency_floor_hz = 30.0\n'
        "[pinion]\nmass_kg = 9.0\nbearing = { rollers = 13, preload_n = 3000.0, loss = 0.0 }\n"
        "[gear]\nbearing = { roller_length_mm = 18.0, contact_angle_deg = 20.0, f1 = 5e-4 }\n"
        '[oil]\nname = "karagiannis_2012"\n[model]\nfriction = "off"\n'
    )
    definition = definition_with_axle(path)
    of_file = native_model(definition)
    sizes = ("state_size", "control_at", "work_size", "limits_at", "ranges_at")
    assert of_file.data.size == native.model.data.size
    assert [getattr(of_file, name) for name in sizes] == [
        getattr(native.model, name) for name in sizes
    ]
    axle = start_axle(
        {"pinion_speed": 150.0, "friction": "consistent"}, CURRENT, read_axle(path).axle
    )
    loaded = copy.copy(native)
    loaded.model = of_file
    run = loaded.instance({"pinion_speed": 150.0, "friction": "consistent"}, CURRENT)
    assert run(Operation.START) == OK
    np.testing.assert_array_equal(run.work[:N], flatten(axle.parameters.kernel_parameters()))
    for _ in range(20):
        assert run.step(1e-3) == OK
        axle.step(1e-3, *CURRENT)
    assert_outputs_agree(run, axle, 1e-9)


@pytest.mark.slow
def test_film_models_of_ones_own_are_constants_and_change_the_films_as_in_python(native, tmp_path):
    altered("hypoid_flank", film=1.1, friction=0.9).write(tmp_path / "flank.json")
    altered("roller_race", film=1.3, friction=1.2).write(tmp_path / "roller.json")
    path = tmp_path / "axle.toml"
    path.write_text(
        '[gear_set]\nmesh_table = "mohammadpour_2015"\n'
        '[film]\nmodel = "solved"\nflank_model = "flank.json"\nroller_model = "roller.json"\n'
        '[model]\nbearing_torque_loss = "solved_films"\n'
    )
    loaded = copy.copy(native)
    loaded.model = native_model(definition_with_axle(path))
    axle = start_axle({"pinion_speed": 150.0}, CURRENT, read_axle(path).axle)
    shipped = start_axle(
        {"pinion_speed": 150.0, "film": "solved", "bearing_torque_loss": "solved_films"}, CURRENT
    )
    run = loaded.instance({"pinion_speed": 150.0}, CURRENT)
    assert run(Operation.START) == OK
    # at the start, before friction has moved anything
    for name, factor in (("flank[2].film_thickness", 1.1), ("bearing[1].film_thickness", 1.3)):
        assert axle.output(name) == pytest.approx(factor * shipped.output(name), rel=1e-9)
    for _ in range(5):
        assert run.step(1e-3) == OK
        axle.step(1e-3, *CURRENT)
    assert_outputs_agree(run, axle, 1e-9)  # as above


def outputs_of(run, operation, step=0.0):
    """What an operation writes."""
    run.outputs[:] = np.nan
    assert run(operation, step) == OK
    written = zip(DEFINITION.output_names, run.outputs.tolist(), strict=True)
    return {name: value for name, value in written if value == value}


@pytest.mark.parametrize("films", ["formula", "solved"])
def test_each_group_of_outputs_is_that_among_all_outputs(native, films):
    values = {"pinion_speed": 150.0, "film": films}
    if films == "solved":
        values["bearing_torque_loss"] = "solved_films"
    pairs = [(a, b) for a in Group for b in Group if a < b]
    sums = [(one,) for one in Group] + pairs + [tuple(Group)]
    run = native.instance(values, CURRENT)
    assert run(Operation.START) == OK
    for torque in (60.0, 90.0, -40.0):
        run.inputs[0] = torque
        assert run(Operation.STEP, 1e-3) == OK
        after_step = [outputs_of(run, Operation.SHOW, sum(groups)) for groups in sums]
        of_all = outputs_of(run, Operation.OUTPUTS)
        motion = run.motion()
        assert motion == {name: of_all[name] for name in motion}
        left = set(of_all) - set(motion)
        for groups, before in zip(sums, after_step, strict=True):
            alone = outputs_of(run, Operation.SHOW, sum(groups))
            assert alone == before == {name: of_all[name] for name in alone}
            assert all(native.model.groups[one] <= set(alone) for one in groups)
            left -= set(alone)
        assert after_step[0] == outputs_of(run, Operation.DERIVATIVES)
        # films of rollers are dear where they are solved, and come with all outputs
        assert left == {*BEARING_FILMS, "bearing.share_outside"}


def test_what_is_refused_leaves_the_state_as_it_was(native):
    run = native.instance({}, CURRENT)
    assert run(Operation.START) == OK
    before = run.state.copy()
    assert run(Operation.STEP, 1e9) == TOO_MANY_STEPS
    np.testing.assert_array_equal(run.state, before)
    for values, status in (
        ({"mesh_damping": "modal", "modal_loss_factor": 0.0}, MODAL_WITHOUT_LOSS),
        # cylindrical rollers carry no axial force
        (
            {f"{role}_bearing_contact_angle": 1e-300 for role in ("pinion", "gear")},
            NO_REST,
        ),
    ):
        refused = native.instance(values, CURRENT)
        refused.state[:] = before
        assert refused(Operation.START) == status
        assert REFUSALS[status]
        np.testing.assert_array_equal(refused.state, before)


@pytest.mark.slow  # another half minute of compilation
def test_a_law_of_drag_that_costs_more_leaves_fewer_steps(native):
    for law, expected in (("palmgren", OK), ("biboulet_houpert_2010", TOO_MANY_STEPS)):
        values = {"bearing_torque_loss": law, "steps_per_highest_period": 4096}
        run = native.instance(values, CURRENT)
        assert run(Operation.START) == OK
        per_second = run.state[native.model.control_at]
        before = run.state.copy()
        # the first drag of all rollers, with its slopes, is five times RACEWAY_COST
        assert run(Operation.STEP, (MAX_STEPS - 20.0) / per_second) == expected
        if expected != OK:
            np.testing.assert_array_equal(run.state, before)
            assert run(Operation.STEP, (MAX_STEPS / 3.0) / per_second) == OK


@pytest.mark.slow
def test_another_mesh_table_is_the_one_that_counts(tmp_path):
    shipped = shipped_mesh_table("mohammadpour_2015")
    other = replace(with_coast_flanks(shipped), name="11_43", pinion_teeth=11, gear_teeth=43)
    other = with_shaft_errors(other)
    definition = definition_with_table(write_mesh_table(other, tmp_path / "other.nc"))
    model = native_model(definition)
    loaded = LoadedModel(model)
    inputs = [-40.0, -40.0 * 43 / 11, 350.0]
    for values in ({"radii": "paper"}, {"mesh_stiffness": "secant", "radii": "mean"}):
        run = loaded.instance(values, inputs)
        assert run(Operation.START) == OK
        values |= {"pinion_speed": 200.0}
        assert_start_agrees(run, definition.start(values, inputs))


def test_words_and_sizes_fit_the_contract(native):
    model = native.model
    assert [one.output for one in model.ranges] == list(RANGE_OUTPUTS[1:])
    assert all("mohammadpour" not in one.beyond for one in model.ranges)
    run = native.instance({}, CURRENT)
    assert run(Operation.START) == OK
    assert np.all(run.state[model.control_at :] > 0.0)
    assert np.all(np.isfinite(model.data[:N]))
    lossless = flatten(without_losses(in_python({}).kernel_parameters()))
    assert lossless.tolist() in np.lib.stride_tricks.sliding_window_view(run.work, N).tolist()


def test_constants_are_taken_only_if_every_size_and_place_in_them_fits(native):
    """So a damaged file is never read past; the values are those that kernels turn into places."""
    data, work = native.model.data, native.model.work_size
    assert native.takes(data, work)
    assert not native.takes(data[:-1].copy(), work)
    assert not native.takes(data, work - 1)
    sizes = DataSizes(*data[:N_SIZES])
    ends = data_ends(data.size, sizes)
    start = data.size - (ends.windows - data.size)  # where the options begin
    ends = data_ends(start, sizes)
    rollers = N_SIZES + int(place_of_each(KernelClasses(*KINDS)).bearing_p.n_rollers)
    band, film = start - 1, start - N_BAND - N_ARRAY + UNITS
    numbers = film - UNITS - N_FLANK_MODEL - 1  # the last one of the train
    places = [*range(N_SIZES), start, start + 1, ends.rows, ends.rows + 1, rollers, film, numbers]
    places.append(band)
    for place in (*places, ends.levels - 1, ends.windows - 1):
        for value in (math.nan, math.inf, -1.0, 0.5, 1e300):
            damaged = data.copy()
            damaged[place] = value
            mesh = place >= ends.numbers  # where any finite number may be
            allowed = mesh and (value == 0.5 or (value == -1.0 and place == ends.windows - 1))
            allowed = allowed or (place in (numbers, band) and abs(value) < 2.0)
            assert native.takes(damaged, work) == allowed, (place, value)
    for place, value in ((rollers, 41.0), (rollers, 2.0), (film, 25.0), (start + 1, 1e4)):
        damaged = data.copy()
        damaged[place] = value
        assert not native.takes(damaged, work)
