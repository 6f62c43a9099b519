"""Train files: what they make of their fields, and what they say of wrong ones."""

import math
import random
import re
import tomllib
from contextlib import suppress
from copy import deepcopy

import numpy as np
import pytest

from drivetrain.train.part_section import section_of
from drivetrain.train.train_file import TrainFile
from fmu_src.model_description import UNITS
from gearlube_core.dynamics.hypoid_axle import mohammadpour_2015_axle
from gearlube_core.dynamics.hypoid_axle.as_train import hypoid_axle
from gearlube_core.dynamics.train.contact_stations import contact_fields
from gearlube_core.dynamics.train.elements.drag import Churning
from gearlube_core.dynamics.train.elements.port import Port
from gearlube_core.dynamics.train.part import ELEMENTS
from gearlube_core.errors import ParameterError
from gearlube_core.helical_geometry.gear_file import HelicalGearFile
from gearlube_core.input_file.field_notes import field_notes
from gearlube_core.kernels.flat_tuples import flatten
from gearlube_core.mesh_table.line_mesh_file import named_line_mesh
from tests.helpers.coulomb_brake import CoulombBrake
from tests.helpers.each import each

TEXT = TrainFile.shipped_text("e_axle")


def read(*changes):
    text = TEXT
    for old, new in changes:
        assert old in text
        text = text.replace(old, new, 1)
    return TrainFile.from_data(tomllib.loads(text), "my.toml")


def test_fields_are_taken_in_the_units_of_their_names():
    train = read().case().train
    by_name = {one.name: one for one in train.elements}
    assert by_name["motor_bearings"].K_xx == 4e8  # 400 N/um
    assert by_name["stage_1"].gear_arm == -0.03  # -30 mm
    assert by_name["stage_1"].angle == pytest.approx(np.radians(17.0), rel=1e-15)
    assert train.bodies[3].mobility.tolist() == [0.0] * 5 + [1.0]  # held but for its turning


def test_the_start_is_in_rpm_newton_metres_and_degrees_celsius():
    case = read().case()
    assert case.speeds["left_hub"] == pytest.approx(-1951.0 * np.pi / 30.0, rel=1e-15)
    assert case.torques == {"motor_torque": 120.0, "left_wheel": 91.0, "right_wheel": 91.0}
    assert case.oil_temperature == pytest.approx(333.15)


def test_a_port_without_a_torque_has_none():
    case = read((", right_wheel = 91.0", "")).case()
    assert case.torques["right_wheel"] == 0.0


def test_a_vehicle_has_the_fields_of_an_axle_file_and_a_train_without_one_has_none():
    car = read(("drag_area_m2 = 0.6", "frontal_area_m2 = 2.0\ndrag_coefficient = 0.3")).case().car
    assert car.road_load.vehicle.mass == 600.0
    assert car.road_load.vehicle.drag_area == pytest.approx(0.5 * 1.22 * 0.6, rel=1e-12)
    assert car.wheel_inertia == 1.0
    assert car.rolling_radius == pytest.approx(3.05 * 2.0 * 0.27855 / (2.0 * np.pi), rel=1e-12)
    data = tomllib.loads(TEXT)
    del data["vehicle"], data["tyre"]
    assert TrainFile.from_data(data, "my.toml").case().car is None


def test_a_section_like_another_has_its_fields_but_for_its_own():
    springs = """
[elements.first]
kind = "spring_support"
body = "motor"
K_xx_n_per_um = 1.0
K_yy_n_per_um = 2.0

[elements.second]
like = "first"
K_yy_n_per_um = 3.0

[elements.third]
like = "second"
body = "counter"
"""
    found = TrainFile.from_data(tomllib.loads(TEXT + springs), "my.toml").case().train.elements
    of_springs = [(one.body, one.K_xx, one.K_yy) for one in found[-3:]]
    assert of_springs == [("motor", 1e6, 2e6), ("motor", 1e6, 3e6), ("counter", 1e6, 3e6)]


@pytest.mark.parametrize("other", ["nothing", "second", "counter_bearings", 3, ["a"]])
def test_a_section_is_like_one_above_it_alone(other):
    data = tomllib.loads(TEXT)
    parts = data["elements"]
    data["elements"] = {"motor_torque": parts["motor_torque"], "second": {"like": other}, **parts}
    with pytest.raises(ParameterError, match=r"second\.like must name a section of elements above"):
        TrainFile.from_data(data, "my.toml")


def test_a_file_that_a_section_like_another_names_counts_from_the_train_file():
    data = tomllib.loads(TEXT)
    assert data["elements"]["stage_1"]["kind"] == "helical_mesh"
    data["elements"]["stage_2"] = {"like": "stage_1", "gear_file": "mine.toml"}
    assert "elements.stage_2.gear_file" in TrainFile.file_fields(data)


def test_every_kind_of_element_has_fields_in_a_file():
    kinds = ELEMENTS.known()
    assert set(kinds) >= {"port", "helical_mesh", "hypoid_mesh", "spring_support", "half_shaft",
                          "opposed_bearings", "seal", "churning"}  # fmt: skip
    for kind, part in kinds.items():
        assert field_notes(section_of(part))["kind"].limits == kind


def test_the_hypoid_axle_as_a_file_is_its_list():
    """The file written by hand has the elements of the builder, number by number."""
    bodies, elements = hypoid_axle(paper := mohammadpour_2015_axle())
    train = TrainFile.named("hypoid_axle").case().train
    assert train.bodies == tuple(bodies)
    assert train.steps_per_highest_period == paper.steps_per_highest_period
    sump = elements.pop()  # of the builder alone, for any law
    assert isinstance(sump, Churning)
    assert sump.law == "none"
    elements = [one for one in elements if one.name != "wheel hubs"]  # likewise
    elements[0] = Port(name="input", body="pinion")  # whose speed the builder alone can hold
    for one, other in zip(train.elements, elements, strict=True):
        assert (type(one), one.sizes()) == (type(other), other.sizes())
        np.testing.assert_allclose(flatten(one.numbers()), flatten(other.numbers()), rtol=1e-12)
        np.testing.assert_array_equal(one.memory(), other.memory())


def test_an_element_from_outside_the_package_has_a_section():
    data = tomllib.loads(TEXT)
    data["elements"]["brake"] = {"kind": "coulomb_brake", "body": "motor", "torque_n_m": 5.0}
    train = TrainFile.from_data(data, "my.toml").case().train
    assert train.elements[-1] == CoulombBrake(name="brake", body="motor", torque=5.0)


WRONG = {
    "a misspelt field": (
        ("stiffness_n_m_per_rad = 8000.0", "stifness_n_m_per_rad = 8000.0"),
        "elements.left_shaft.stifness_n_m_per_rad is not a field of this file; is it "
        "stiffness_n_m_per_rad?",
    ),
    "another unit": (
        ("K_xx_n_per_um = 400.0", "K_xx_n_per_um = 4e8"),
        "elements.motor_bearings.K_xx_n_per_um must be a number, 0 to 1e+08 N/um, got "
        "400000000.0. Stiffness along x. Is it in N/m? 4e+08 N/m is 400 N/um.",
    ),
    "an unknown kind": (
        ('kind = "half_shaft"', 'kind = "halfshaft"'),
        "got 'halfshaft'. Is it half_shaft?",
    ),
    "a misspelt body": (('body = "motor"', 'body = "moter"'), "right_hub. Is it motor?"),
    "a misspelt port": (("motor_torque = 120.0", "motor_torqe = 1.0"), "Is it motor_torque?"),
    "a misspelt section": (("[vehicle]", "[vehicel]"), "is it vehicle?"),
    "a misspelt section that is needed": (
        ("[start]", "[strat]"),
        "strat is not a field of this file; is it start?",
    ),
    "a drag coefficient alone": (
        ("drag_area_m2 = ", "drag_coefficient = "),
        "got no vehicle.frontal_area_m2.",
    ),
    "a tyre of another form": (("155/65R14", "155-65 R14"), "tyre: The tyre size must read"),
    "no kind": (('kind = "seal"\n', ""), "elements.seal.kind must be one of"),
    "a body that is not there": (
        ('second = "left_hub"', 'second = "hub"'),
        "left_shaft names 'hub', which is not among the bodies of the train. There are: motor,",
    ),
    "a name with a blank": (
        ("[elements.seal]", '[elements."my seal"]'),
        "elements.my seal must have a name of letters, digits and _",
    ),
    "a name of the FMU": (("[elements.seal]", "[elements.oil]"), "elements.oil must have a name"),
    "one name twice": (("[elements.seal]", "[elements.motor]"), "has the name of a body"),
    "a gear file that is not there": (
        ('gear_file = "he_2007"', 'gear_file = "nope.toml"'),
        "elements.stage_1: The gear file nope.toml was not found",
    ),
    "one body for both ends": (
        ('second = "left_hub"', 'second = "differential"'),
        "left_shaft must act on 2 different bodies, got differential, differential.",
    ),
    "a shaft as a port": (
        ("drives_forward = true", 'torque_of = "left_shaft"'),
        "stage_2 names 'left_shaft', which is not among the ports of the train. There are: "
        "motor_torque, left_wheel, right_wheel.",
    ),
    "a body without a section": (
        ("[bodies.motor]\n", "[bodies]\nmotor = 3\n[bodies.other]\n"),
        "bodies.motor must be a section [bodies.motor], got 3.",
    ),
    "a film model of other contacts": (
        (
            "[elements.seal]",
            '[elements.pair]\nkind = "opposed_bearings"\nbody = "motor"\n'
            'torque_loss = "solved_films"\nfilm_model = "hypoid_flank"\n'
            "[elements.pair.bearing]\n[elements.seal]",
        ),
        "elements.pair: film_model must be a film model of rollers on races",
    ),
    "an axis twice": (
        (
            "[elements.seal]",
            '[elements.pair]\nkind = "opposed_bearings"\nbody = "motor"\naxes = [0, 0, 7]\n'
            "[elements.pair.bearing]\n[elements.seal]",
        ),
        "axes of pair must be 0, 1 and 2, each once, got [0, 0, 7].",
    ),
    "a sign": (("sign = -1.0", "sign = 0.5"), "sign of motor_torque must be 1 or -1, got 0.5."),
    "a torque of no port": (
        ("motor_torque = 120.0", "seal = 120.0"),
        "start.torque_n_m.seal names nothing of the train. There are: motor_torque, left_wheel",
    ),
    "a torque out of range": (
        ("motor_torque = 120.0", "motor_torque = 1e9"),
        "start.torque_n_m.motor_torque must be within -1e+07 to 1e+07 N.m, got 1e+09 N.m.",
    ),
    "a speed out of range": (
        ("left_hub = -1951.0", "left_hub = 1e6"),
        "start.speed_rpm.left_hub must be within -47746.5 to 47746.5 rpm, got 1e+06 rpm.",
    ),
    "oil that is too cold": (
        ("oil_temperature_degc = 60.0", "oil_temperature_degc = -50.0"),
        "start.oil_temperature_degc, in K, must be within 273.15 to 423.15 K, got 223.15 K.",
    ),
    "no speed": (("left_hub = -1951.0", ""), "start.speed_rpm must name a body with its speed"),
    "a mass as a text": (
        ("mass_kg = 3.0", 'mass_kg = "3"'),
        "bodies.motor.mass_kg must be a number, 0.0001 to 1e+06 kg, got '3'.",
    ),
    "no tyre": (
        ('[tyre]\nsize = "155/65R14"\n', ""),
        "wheel_inertia_kg_m2, tyre.size; got no tyre.size.",
    ),
    "a light vehicle": (("mass_kg = 600.0", "mass_kg = 60.0"), "vehicle.mass_kg must be"),
    "a section of another file": (("[bodies.motor]", "[bodis.motor]"), "is it bodies?"),
}


@each("change, words", WRONG.values())
def test_what_is_wrong_is_named_with_its_limit_and_a_cure(change, words):
    with pytest.raises(ParameterError) as caught:
        read(change)
    assert words in str(caught.value)
    assert str(caught.value).startswith("my.toml")


def test_all_that_is_wrong_is_said_at_once():
    with pytest.raises(ParameterError, match=r"my\.toml has 2 wrong field\(s\)") as caught:
        read(WRONG["another unit"][0], WRONG["a mass as a text"][0])
    assert "bodies.motor.mass_kg" in str(caught.value)


def test_any_value_in_any_place_is_taken_or_refused_in_words():
    """Nothing but a ParameterError comes of a wrong file."""
    values = (None, True, -1, 0, 1e300, math.nan, math.inf, "", "x" * 300, [], [1, 2], {},
              {"a": 1}, 10**17, ["x", "x"], "mohammadpour_2015", "../x.toml")  # fmt: skip
    chance = random.Random(3)
    for name in TrainFile.shipped():
        whole = tomllib.loads(TrainFile.shipped_text(name))
        sections = [whole, *whole.values(), *whole["bodies"].values(), *whole["elements"].values()]
        count = sum(isinstance(one, dict) for one in sections)
        for _ in range(40):
            data = deepcopy(whole)
            sections = [data, *data.values(), *data["bodies"].values(), *data["elements"].values()]
            section = [one for one in sections if isinstance(one, dict)][chance.randrange(count)]
            key, value = chance.choice(list(section)), chance.choice(values)
            section[key] = value
            if value is None:
                del section[key]
            with suppress(ParameterError):
                TrainFile.from_data(data, "my.toml")


def test_paths_count_from_the_folder_of_the_file(tmp_path):
    (tmp_path / "gears.toml").write_text(HelicalGearFile.shipped_text("he_2007"))
    path = tmp_path / "train.toml"
    path.write_text(TEXT.replace('"he_2007"', '"gears.toml"', 1))
    stage = TrainFile.from_toml(path).case().train.elements[3]
    assert stage.parameters.pair.ratio == pytest.approx(1.24)


SHAFT = """
kind = "shaft"
nodes_mm = { left = 0.0, gear = 60.0 }
sections = [{ start_mm = 0.0, end_mm = 120.0, outer_diameter_mm = 30.0 }]
material = { E_gpa = 210.0, G_gpa = 80.0 }
"""


def test_a_body_may_be_an_elastic_shaft_with_nodes():
    rigid = """
mass_kg = 3.0
inertia_kg_m2 = 0.004
polar_inertia_kg_m2 = 0.02
"""
    text = TrainFile.shipped_text("e_axle")
    assert text.count(rigid) == 1
    text = text.replace(rigid, SHAFT).replace('pinion = "motor"', 'pinion = "motor.gear"')
    train = TrainFile.from_data(tomllib.loads(text), "file").case().train
    names = [body.name for body in train.bodies]
    assert names[0] == "motor"
    assert {"motor.left", "motor.gear", "motor.modes_1"} <= set(names)
    mass = np.pi / 4.0 * 0.03**2 * 0.12 * 7850.0
    assert 1.0 / train.bodies[0].mobility[0] == pytest.approx(mass, rel=1e-12)


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        (
            "gear = 60.0",
            "gear = 160.0",
            "node gear of motor must lie on the shaft, 0 to 120 mm",
        ),
        ("outer_diameter_mm = 30.0", "outer_diameter_mm = -3.0", "outer_diameter"),
        ("end_mm = 120.0, ", "", "bodies.motor.sections"),
        ("left = 0.0", '"le.ft" = 0.0', "without a point"),
        ('kind = "shaft"', 'kind = "axle"', "bodies.motor.kind must be one of rigid, shaft"),
    ],
)
def test_a_wrong_shaft_is_refused_by_name(old: str, new: str, words: str):
    data = tomllib.loads(TrainFile.shipped_text("e_axle"))
    data["bodies"]["motor"] = tomllib.loads(SHAFT.replace(old, new))
    with pytest.raises(ParameterError, match=words):
        TrainFile.from_data(data, "file")


OF_CONTACT = {
    "kind": "gear_mesh", "first": "motor", "second": "counter", "gear_file": "he_2007",
    "line_mesh": "he_2007", "contact_torque_n_m": 200.0, "stations": 5, "right_hand": True,
    "azimuth_deg": 90.0, "friction": 0.05,
}  # fmt: skip


def test_a_gear_file_with_its_line_mesh_gives_all_but_the_places_of_a_gear_mesh():
    data = tomllib.loads(TEXT)
    data["elements"]["stage_1"] = OF_CONTACT
    found = TrainFile.from_data(data, "my.toml").case().train
    mesh = next(one for one in found.elements if one.name == "stage_1")
    pair = HelicalGearFile.named("he_2007").helical_pair()
    gears = {"stations": 5, "right_hand": True}
    expected = contact_fields(pair, named_line_mesh("he_2007"), 200.0, **gears)
    assert {name: getattr(mesh, name) for name in expected} == expected
    assert (mesh.azimuth, mesh.friction) == (pytest.approx(math.pi / 2.0), 0.05)
    assert abs(mesh.centres) == pytest.approx(pair.centre_distance, rel=1e-12)


@each(
    "change, words",
    [
        ({"teeth_1": 25}, "stage_1.teeth_1 is not a field"),
        ({"line_mesh": "x"}, "No line mesh of the name 'x' is shipped"),
        ({"contact_torque_n_m": 1e3}, "contact torque must be within 25 to 450 N.m, got 1000"),
        ({"gear_file": "examples/gears/face_milled.toml"}, "of a hypoid pair.* Take a hypoid_mesh"),
    ],
)
def test_gears_whose_contact_does_not_serve_are_refused(change, words):
    data = tomllib.loads(TEXT)
    data["elements"]["stage_1"] = OF_CONTACT | change
    with pytest.raises(ParameterError, match=words):
        TrainFile.from_data(data, "my.toml")


def test_fmus_know_the_units_in_which_elements_show_their_outputs():
    """A display unit that the model description does not declare makes the FMU invalid."""
    wrong = [
        f"{kind}: {one.name} in {one.shown}"
        for kind, element in ELEMENTS.known().items()
        for one in (*element.outputs, *element.states)
        if one.shown and one.shown not in {shown.name for shown in UNITS[one.unit].display}
    ]
    assert not wrong


def test_errors_between_fields_name_them_as_the_file_does():
    data = tomllib.loads(TrainFile.shipped_text("e_axle"))
    tube = SHAFT.replace(
        "outer_diameter_mm = 30.0", "outer_diameter_mm = 30.0, inner_diameter_mm = 35.0"
    )
    data["bodies"]["motor"] = tomllib.loads(tube)
    words = (
        "bodies.motor: sections 1: outer_diameter must be above inner_diameter, 35 mm, got 30 mm. "
        "In the file: inner_diameter_mm, outer_diameter_mm."
    )
    with pytest.raises(ParameterError, match=re.escape(words)):
        TrainFile.from_data(data, "file")


def test_a_gap_without_its_second_brackets_is_told_what_it_must_be():
    data = tomllib.loads(TrainFile.shipped_text("planetary"))
    data["elements"]["sun_mesh_1"]["gap"] = [1e-6]
    words = "sun_mesh_1.gap must be a list of lists, got 1e-06 in it. Unloaded gap [m] of each"
    with pytest.raises(ParameterError, match=re.escape(words)):
        TrainFile.from_data(data, "file")
