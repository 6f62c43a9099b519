"""The native entry of the helical pair against the model in Python, for any parameters."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from fmu_src.helical_pair import DEFINITION, pair_parameters
from fmu_src.helical_variables import HELICAL_PAIR
from fmu_src.native.helical_cases import GIVEN_FLOATS, HEAD_FLOATS
from fmu_src.native.helical_pair import native_model
from fmu_src.native.helical_parameters import (
    BEARINGS_AT,
    COUPLING_TOO_LARGE,
    DENSITY_WITH_LINE_MESH,
    GIVEN_AT,
    INPUT_OUT_OF_RANGE,
    MISSING_CASE,
    NO_EQUILIBRIUM,
)
from fmu_src.native.model import OK, NativeModel, Operation
from fmu_src.variable import taken_holder
from gearlube_core.dynamics.helical_model.model import HelicalPairModel
from gearlube_core.dynamics.helical_model.outputs import (
    LOAD_TORQUE,
    MARKS,
    PINION,
    PSI,
    SENSES,
    STATE_PLACES,
    WHEEL,
)
from gearlube_core.dynamics.helical_model.pair import bearing_shares, helical_pair
from gearlube_core.dynamics.helical_pair.march.given_pair import GivenPair
from gearlube_core.dynamics.helical_pair.march.mesh_data import FILM_AT
from gearlube_core.dynamics.ranges import TOO_FAR, range_limits
from gearlube_core.dynamics.train.assemble import assemble
from gearlube_core.dynamics.train.element import RZ, W
from gearlube_core.dynamics.train.elements.helical_mesh_kernels import pair_data_at
from gearlube_core.dynamics.train.march import MAX_STEPS, NOT_FINITE, TOO_FAST, TOO_MANY_STEPS
from gearlube_core.dynamics.train.plan import OF_TABLES
from gearlube_core.dynamics.train.stepped_model import REVERSED
from gearlube_core.errors import GearLubeError, ParameterError
from gearlube_core.film_model.net import N_NUMBERS
from tests.helpers.native_helical_values import (
    PARAMETERS,
    accepts,
    check_train,
    own_gear,
    places_of,
    python_model,
    random_values,
    usual_values,
    values_of,
)
from tests.helpers.object_code import (
    FREESTANDING,
    LIBM,
    LoadedModel,
    NativeRun,
    undefined_in_object,
)
from tests.helpers.own_film_models import altered

OUTPUTS = {v.name: v for v in HELICAL_PAIR if v.is_computed}
NOMINAL = np.array([OUTPUTS[name].nominal or 1.0 for name in DEFINITION.output_names])
INPUTS = [v.start or 0.0 for v in HELICAL_PAIR if v.causality == "input"]
STEP = 1e-4  # s
OWN_OIL = """name = "own"\nbase_oil = "mineral"\ndensity_kg_m3 = 880.0
viscosity_40_degc_mm2_s = 120.0\nviscosity_100_degc_mm2_s = 12.0\n"""
OWN_FILM = '[film]\nmodel = "solved"\nline_model = "line.json"\noil_file = "oil.toml"\n'
# The same kernels, but for a processor without fused products: roundings, of the value or of the
# nominal value of its output, where the value is the small difference of large ones
CLOSE = 1e-11


@pytest.fixture(scope="module")
def shipped() -> LoadedModel:
    return LoadedModel(native_model(DEFINITION))


def instance(
    loaded: LoadedModel, values: list[float], inputs: list[float], other: NativeModel | None = None
) -> NativeRun:
    """Return an instance of the shipped pairs, or of a model with the same entry and other data."""
    model = other or loaded.model
    assert model.entry is loaded.model.entry
    return replace(
        loaded.instance({}, inputs),
        model=model,
        parameters=np.array(values),
        work=np.zeros(model.work_size),
    )


def check_packed(loaded: LoadedModel, seed: int, count: int) -> None:
    rng = np.random.default_rng(seed)
    model = loaded.model
    for _ in range(count):
        values = random_values(rng)
        native = instance(loaded, values, INPUTS)
        assert native(Operation.RESUME) == OK
        given = {v.argument: v.decoded(x) for v, x in zip(PARAMETERS, values, strict=True)}
        del given["pinion_speed"]
        holder = taken_holder(given)
        parameters = pair_parameters(given)
        check_train(native, assemble(*helical_pair(parameters, holder), parameters.oil))
        shares = native.work[BEARINGS_AT:GIVEN_AT]
        np.testing.assert_array_equal(shares, bearing_shares(parameters))
        ranges = native.work[model.ranges_at : model.ranges_at + 2 * len(model.ranges)]
        np.testing.assert_array_equal(ranges, range_limits(parameters.ranges))


def check_starts(loaded: LoadedModel, seed: int, count: int) -> None:
    """Start and three steps; the same starts are refused."""
    rng = np.random.default_rng(seed)
    model = loaded.model
    refused = 0
    for _ in range(count):
        values = usual_values(rng)
        values[1] = rng.uniform(-500.0, 500.0)  # rad/s
        torque = rng.choice([-1.0, 1.0]) * 10.0 ** rng.uniform(0.0, 3.0)
        inputs = [torque, torque, rng.uniform(290.0, 400.0), values[1] * rng.uniform(0.9, 1.1)]
        native = instance(loaded, values, inputs)
        status = native(Operation.START)
        try:
            pair = python_model(model, values, inputs)
        except GearLubeError as error:
            kind = INPUT_OUT_OF_RANGE if isinstance(error, ParameterError) else NO_EQUILIBRIUM
            assert status == kind
            refused += 1
            continue
        assert status == OK
        assert_close(native, pair)
        for _ in range(3):
            pair.step(STEP, *inputs)
            assert native.step(STEP) == OK
            assert_close(native, pair)
    assert refused < count / 2


def assert_close(native: NativeRun, pair: HelicalPairModel) -> None:
    scale = np.maximum(np.abs(pair.outputs), NOMINAL)
    apart = np.abs(native.outputs - pair.outputs) / scale
    worst = int(np.argmax(apart))
    assert apart[worst] <= CLOSE, (pair.output_names[worst], apart[worst])
    control = pair.get_state()[-3:]
    np.testing.assert_allclose(native.state[-3:], control, rtol=CLOSE)


def test_packed_parameters_are_those_of_python_bit_for_bit(shipped: LoadedModel) -> None:
    check_packed(shipped, 1, 200)


@pytest.mark.slow
def test_a_thousand_packed_parameters_are_those_of_python(shipped: LoadedModel) -> None:
    check_packed(shipped, 2, 1000)


def test_start_and_steps_are_those_of_python(shipped: LoadedModel) -> None:
    check_starts(shipped, 3, 20)


@pytest.mark.slow
def test_five_hundred_starts_are_those_of_python(shipped: LoadedModel) -> None:
    check_starts(shipped, 4, 500)


def test_the_entry_needs_nothing_but_libm(shipped: LoadedModel) -> None:
    assert undefined_in_object(shipped.code) <= LIBM | FREESTANDING
    assert shipped.declared <= LIBM | FREESTANDING
    assert len(shipped.code) < 700_000  # 0.14 MB when this was written; inlining can multiply it


def test_a_state_of_python_continues_natively(shipped: LoadedModel) -> None:
    values = values_of(mesh__stiffness_model="line_mesh")
    pair = python_model(shipped.model, values, INPUTS)
    for _ in range(5):
        pair.step(STEP, 100.0, 120.0, 340.0)
    native = instance(shipped, values, INPUTS)
    native.state[:] = pair.get_state()
    assert native(Operation.RESUME) == OK
    assert native(Operation.OUTPUTS) == OK
    assert_close(native, pair)
    pair.step(STEP, *INPUTS)
    assert native.step(STEP) == OK
    assert_close(native, pair)


REFUSED = [
    ({"gear__name": "custom"}, {}, MISSING_CASE + 6),
    ({"gear__name": "custom", "mesh__stiffness_model": "line_mesh"}, {}, MISSING_CASE + 7),
    ({"gear__name": "jamali_2015_a", "mesh__stiffness_model": "line_mesh"}, {}, MISSING_CASE + 3),
    (
        {"mesh__stiffness_model": "line_mesh", "mesh__stiffness_density": 1e10},
        {},
        DENSITY_WITH_LINE_MESH,
    ),
    ({"mesh__stiffness_model": "line_mesh"}, {0: 700.0}, INPUT_OUT_OF_RANGE),  # mesh to 450 N.m
    ({"mesh__stiffness_model": "line_mesh"}, {1: -900.0}, INPUT_OUT_OF_RANGE),  # 1.5 * 1.24 * 450
    ({}, {0: math.nan}, INPUT_OUT_OF_RANGE),
    ({}, {2: 200.0}, INPUT_OUT_OF_RANGE),
    ({}, {3: 5001.0}, INPUT_OUT_OF_RANGE),
    ({}, {3: -5001.0}, INPUT_OUT_OF_RANGE),
    ({"speed__hold": "imposed"}, {3: -100.0}, REVERSED),
    # shafts that give way by more than their radius
    ({"support__radial_stiffness": 1.0, "friction__model": "off"}, {0: 8e4}, NO_EQUILIBRIUM),
]


@pytest.mark.parametrize(("settings", "changed", "status"), REFUSED)
def test_what_python_refuses_is_refused_with_the_same_meaning(
    shipped: LoadedModel, settings: dict[str, float | str], changed: dict[int, float], status: int
) -> None:
    values = values_of(**settings)
    inputs = [changed.get(place, value) for place, value in enumerate(INPUTS)]
    native = instance(shipped, values, inputs)
    native.state[:] = 1.0
    assert native(Operation.START) == status
    assert (native.state == 1.0).all()
    with pytest.raises(GearLubeError) as refusal:
        python_model(shipped.model, values, inputs)
    words = shipped.model.refusals[status]
    if status not in (INPUT_OUT_OF_RANGE, NO_EQUILIBRIUM):  # Python's name input or force
        assert words in str(refusal.value)


def test_a_refused_step_changes_nothing(shipped: LoadedModel) -> None:
    values = values_of(solver__steps_per_mesh_period=4096, pinion__speed_start=5000.0)
    native = instance(shipped, values, INPUTS)
    assert native(Operation.START) == OK
    before = native.state.copy()
    assert native(Operation.STEP, 0.1) == TOO_MANY_STEPS
    native.inputs[0] = 1e6
    assert native(Operation.STEP, STEP) == INPUT_OUT_OF_RANGE
    np.testing.assert_array_equal(native.state, before)
    assert "Shorten the communication step" in shipped.model.refusals[TOO_MANY_STEPS]


def test_updates_of_the_friction_leave_fewer_steps(shipped: LoadedModel) -> None:
    speed = 2000.0
    often = {"solver__steps_per_mesh_period": 4096, "friction__updates_per_mesh_period": 4096}
    for friction, expected in (("off", OK), ("film", TOO_MANY_STEPS)):
        values = values_of(friction__model=friction, pinion__speed_start=speed, **often)
        native = instance(shipped, values, INPUTS)
        assert native(Operation.START) == OK
        before = native.state.copy()
        period = 2.0 * math.pi / (28 * speed)  # the teeth of He et al. 2007
        # an update in each step costs as much as the step
        assert native(Operation.STEP, 0.7 * MAX_STEPS * period / 4096.0) == expected
        if expected != OK:
            np.testing.assert_array_equal(native.state, before)


def test_every_status_has_words(shipped: LoadedModel, tmp_path: Path) -> None:
    told = {*range(1, COUPLING_TOO_LARGE + 1), TOO_FAR, REVERSED}
    assert set(shipped.model.refusals) == told | {MISSING_CASE + i for i in (3, 5, 6, 7)}
    carried = own_gear(tmp_path, str)
    assert set(carried.refusals) == told | {MISSING_CASE + i for i in (3, 5, 7)}


def test_more_oils_than_the_constants_hold_are_refused(shipped: LoadedModel) -> None:
    native = instance(shipped, values_of(), INPUTS)
    assert accepts(native)
    assert not accepts(native, oil=9)  # a case would begin among the oils
    assert not accepts(native, oil=0)
    assert not accepts(native, friction=3)


def test_film_model_and_oil_of_a_gear_file_are_those_of_python(
    shipped: LoadedModel, tmp_path: Path
) -> None:
    altered("helical_line", film=1.2, friction=0.9).write(tmp_path / "line.json")
    (tmp_path / "oil.toml").write_text(OWN_OIL)
    own = own_gear(tmp_path, lambda text: text + OWN_FILM)
    parameters = [v for v in own.definition.variables if v.is_model_parameter]
    values = [float(v.start or 0.0) for v in parameters]
    for gear, name in ((values[0], "altered"), (1.0, "helical_line")):  # custom, he_2007
        values[0] = gear
        native = instance(shipped, values, INPUTS, own)
        assert accepts(native)
        assert native(Operation.START) == OK
        given = {v.name: v.decoded(x) for v, x in zip(parameters, values, strict=True)}
        pair = own.definition.start_model(given, INPUTS)
        assert isinstance(pair, HelicalPairModel)
        found = pair.parameters
        assert found.line_film_model is not None
        assert (found.line_film_model.name, found.oil.name) == (name, "own")
        made = assemble(*helical_pair(found), found.oil)
        films = pair_data_at(*made.plan[np.array(made.shape) == OF_TABLES][2:4])
        check_train(native, made, films + FILM_AT + N_NUMBERS)
        for _ in range(20):
            pair.step(STEP, *INPUTS)
            assert native.step(STEP) == OK
        assert_close(native, pair)


def test_a_bearing_made_too_soft_for_its_coupling_is_refused(
    shipped: LoadedModel, tmp_path: Path
) -> None:
    def coupled(text: str) -> str:
        old = "[gear.bearing_1]\ndistance_mm = 50.8\n"
        assert old in text
        return text.replace(old, old + "tilt_y_knm_per_rad = 50.0\ncoupling_x_kn_per_rad = 5e3\n")

    model = own_gear(tmp_path, coupled)
    values = values_of(gear__name="custom")
    native = instance(shipped, values, INPUTS, model)
    assert native(Operation.START) == OK
    assert_close(native, python_model(model, values, INPUTS))
    # 5e6 N/rad against the root of 5e8 N/m and 5e4 N.m/rad, then of 5e7 N/m
    for radial, status in ((1.1e9, OK), (1e8, COUPLING_TOO_LARGE)):
        values = values_of(gear__name="custom", support__radial_stiffness=radial)
        assert instance(shipped, values, INPUTS, model)(Operation.START) == status
    with pytest.raises(ParameterError, match="K_x_theta_y must be within"):
        python_model(model, values, INPUTS)


def test_rates_are_how_the_state_changes_and_events_renew_friction_alone(
    shipped: LoadedModel,
) -> None:
    run = instance(shipped, values_of(), INPUTS)
    assert run(Operation.START) == OK
    for _ in range(3):
        assert run(Operation.STEP, 1e-3) == OK
    assert run(Operation.EVENT) == OK  # what a step would begin with
    before = run.state.copy()
    assert run(Operation.EVENT) == OK
    np.testing.assert_array_equal(run.state, before)  # nothing is due any more
    assert run(Operation.DERIVATIVES) == OK
    np.testing.assert_array_equal(run.state, before)
    first = DEFINITION.output_names.index("der(mesh.rotation)")
    rates = run.outputs[first : first + STATE_PLACES.size].copy()
    assert rates[-1] == 0.0
    h = 1e-7
    slopes = []
    for step in (h, 2.0 * h):
        run.state[:] = before
        assert run(Operation.STEP, step) == OK
        slopes.append(SENSES * (run.state - before)[STATE_PLACES] / step)
    # Richardson's; third derivatives at 5 kHz leave 3e-6, roundings of 100 rad/s 1e-7 rad/s2
    slope = 2.0 * slopes[0] - slopes[1]
    nominal = NOMINAL[first : first + STATE_PLACES.size]
    assert np.all(np.abs(slope - rates) < 1e-5 * np.maximum(np.abs(rates), nominal))

    run.state[:] = before
    run.state[LOAD_TORQUE] -= 10.0  # behind the torque by so much, with 20 ms
    assert run(Operation.DERIVATIVES) == OK
    assert run.outputs[first + STATE_PLACES.size - 1] == pytest.approx(500.0, rel=1e-12)
    run.state[:] = before
    run.state[PINION + RZ] -= 2.0 * math.pi / 25 / 16  # of 25 teeth: to the next update
    assert run(Operation.EVENT) == OK
    changed = np.flatnonzero(run.state != before)
    assert changed[0] == PINION + RZ
    assert changed[1] == LOAD_TORQUE + 1  # when friction was last computed, then its coefficients
    assert LOAD_TORQUE + 2 <= changed[2] <= changed[-1] < MARKS
    run.state[WHEEL + W] = -5001.0
    assert run(Operation.DERIVATIVES) == TOO_FAST
    run.state[:] = before
    run.state[PSI] = 0.2
    assert run(Operation.DERIVATIVES) == NOT_FINITE


def test_constants_are_taken_only_if_every_size_and_place_in_them_fits(
    shipped: LoadedModel,
) -> None:
    """So a damaged file is never read past."""
    data, work = shipped.model.data, shipped.model.work_size
    assert shipped.takes(data, work)
    assert not shipped.takes(data[:-1].copy(), work)
    assert not shipped.takes(data, work - 1)
    case = int(data[1])  # he_2007 with its line mesh: the longest
    given = case + HEAD_FLOATS
    lines = GivenPair._fields.index("lines")
    places = [0, 1, case, case + 1, case + 2]
    places += [given + int(one) for one in places_of(GivenPair)[lines : lines + 3]]
    for place in places:
        for value in (np.nan, np.inf, -1.0, 0.5, 1e5, 1e300):
            damaged = data.copy()
            damaged[place] = value
            assert not shipped.takes(damaged, work), (place, value)
    for place in (case + HEAD_FLOATS + GIVEN_FLOATS, data.size - 1):
        damaged = data.copy()
        damaged[place] = np.nan
        assert not shipped.takes(damaged, work)
