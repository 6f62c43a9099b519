"""The axle file: what each field sets in the models, what is assumed, what is refused."""

import math
import re
import tomllib
from dataclasses import replace
from functools import reduce
from pathlib import Path

import numpy as np
import pytest

from drivetrain.axle_file.axle_file import AxleFile
from drivetrain.axle_file.read_axle import read_axle
from drivetrain.driveline.parameters import DrivelineParameters
from drivetrain.road_load import mohammadpour_2015_road_load
from gearlube_core.dynamics.hypoid_axle import mohammadpour_2015_axle
from gearlube_core.errors import ParameterError, TableError
from gearlube_core.input_file.field_notes import field_notes
from gearlube_core.kernels.flat_tuples import flatten
from gearlube_core.mesh_table.netcdf import write_mesh_table
from tests.helpers.axle_files import BARE, MESH, car_axle
from tests.helpers.each import each

EXAMPLE = Path(__file__).parents[2] / "examples" / "my_axle.toml"

# field: value there, place in the models, value there in SI
NUMBERS = {
    "gear_set.backlash_um": (83.7, "axle.backlash", 83.7e-6),
    "gear_set.roughness_rms_um": (0.83, "axle.roughness_rms", 0.83e-6),
    "gear_set.modal_loss_factor": (0.11, "axle.modal_loss_factor", 0.11),
    "gear_set.hysteretic_loss": (0.02, "axle.hysteretic_loss", 0.02),
    "gear_set.frequency_floor_hz": (20.0, "axle.frequency_floor", 20.0),
    "gear_set.radii": ("mean", "axle.radii", "mean"),
    "gear_set.mesh_stiffness": ("secant", "axle.mesh_stiffness", "secant"),
    "gear_set.mesh_damping": ("modal", "axle.mesh_damping", "modal"),
    "pinion.mass_kg": (9.0, "axle.pinion_mass", 9.0),
    "pinion.inertia_kg_m2": (2e-3, "axle.pinion_inertia", 2e-3),
    "gear.mass_kg": (31.0, "axle.gear_mass", 31.0),
    "gear.inertia_kg_m2": (0.09, "axle.gear_inertia", 0.09),
    "steel.youngs_modulus_gpa": (206.0, "axle.solid.youngs_modulus", 206e9),
    "steel.poisson_ratio": (0.28, "axle.bearing.solid.poisson_ratio", 0.28),
    "steel.density_kg_m3": (7800.0, "axle.solid.density", 7800.0),
    "steel.conductivity_w_m_k": (50.0, "axle.solid.conductivity", 50.0),
    "steel.heat_capacity_j_kg_k": (460.0, "axle.solid.heat_capacity", 460.0),
    "oil.name": ("karagiannis_2012", "axle.oil.name", "karagiannis_2012"),
    "oil.density_kg_m3": (900.0, "axle.oil.density", 900.0),
    "oil.alpha_per_gpa": (18.5, "axle.oil.alpha", 18.5e-9),
    "oil.alpha_is": ("mean", "axle.oil.alpha_is", "mean"),
    "oil.alpha_pressure_gpa": (0.3, "axle.oil.alpha_pressure", 3e8),
    "oil.alpha_temperature_degc": (40.0, "axle.oil.alpha_temperature", 313.15),
    "oil.eyring_stress_mpa": (5.5, "axle.oil.eyring_stress", 5.5e6),
    "oil.limiting_shear_stress_mpa": (3.5, "axle.oil.limiting_shear_stress", 3.5e6),
    "oil.boundary_friction": (0.1, "axle.oil.boundary_friction", 0.1),
    "oil.conductivity_w_m_k": (0.13, "axle.oil.conductivity", 0.13),
    "oil.conductivity_temperature_degc": (20.0, "axle.oil.conductivity_temperature", 293.15),
    "oil.conductivity_slope_w_m_k2": (-1e-4, "axle.oil.conductivity_slope", -1e-4),
    "film.model": ("solved", "axle.film", "solved"),
    "film.limiting_slope": (0.05, "axle.film_limiting_slope", 0.05),
    "film.bulk_resistance_k_w": (0.02, "axle.flank_bulk_resistance", 0.02),
    "oil.heat_capacity_j_kg_k": (1900.0, "axle.oil.heat_capacity", 1900.0),
    "oil.temperature_low_degc": (-10.0, "axle.oil.temperature_low", 263.15),
    "oil.temperature_high_degc": (160.0, "axle.oil.temperature_high", 433.15),
    "housing.churning": ("boness_1989", "axle.churning", "boness_1989"),
    "housing.ring_diameter_mm": (201.7, "axle.ring_diameter", 0.2017),
    "housing.ring_width_mm": (33.3, "axle.ring_width", 0.0333),
    "housing.immersion_mm": (41.7, "axle.immersion", 0.0417),
    "housing.oil_volume_l": (1.43, "axle.oil_volume", 1.43e-3),
    # ISO/TR 14179-1: 3.737e-3 N.m for each mm; two seals at the wheels
    "seals.pinion_diameter_mm": (45.0, "axle.pinion_seal_torque", 3.737e-3 * 45.0),
    "seals.wheel_diameter_mm": (35.0, "axle.wheel_seal_torque", 2 * 3.737e-3 * 35.0),
    "seals.pinion_torque_n_m": (0.21, "axle.pinion_seal_torque", 0.21),
    "seals.wheel_torque_n_m": (0.37, "axle.wheel_seal_torque", 0.37),
    "seals.hub_torque_n_m": (0.83, "axle.hub_torque", 0.83),
    "model.equations": ("as_printed", "axle.equations", "as_printed"),
    "model.friction": ("off", "axle.friction", "off"),
    "model.flank_rolling": ("biboulet_houpert_2010", "axle.rolling", "biboulet_houpert_2010"),
    "model.bearing_torque_loss": ("none", "axle.bearing_torque_loss", "none"),
    "model.bearing_approach": ("as_printed", "axle.bearing.approach", "as_printed"),
    "model.steps_per_mesh_period": (72, "axle.steps_per_mesh_period", 72),
    "model.steps_per_highest_period": (20, "axle.steps_per_highest_period", 20),
    "vehicle.mass_kg": (1999.0, "driveline.road_load.vehicle.mass", 1999.0),
    # up to the largest that is allowed; half the air's density of the paper times it
    "vehicle.drag_area_m2": (20.0, "driveline.road_load.vehicle.drag_area", 0.5 * 1.22 * 20.0),
    "vehicle.frontal_area_m2": (2.5, "driveline.road_load.vehicle.frontal_area", 2.5),
    "vehicle.drag_coefficient": (0.28, "driveline.road_load.vehicle.drag_coefficient", 0.28),
    "vehicle.rolling_coefficient": (0.01, "driveline.road_load.vehicle.rolling_coefficient", 0.01),
    "vehicle.air_density_kg_m3": (1.1, "driveline.road_load.vehicle.air_density", 1.1),
    "vehicle.grade": (0.05, "driveline.road_load.vehicle.grade", 0.05),
    "vehicle.gravity_m_s2": (9.78, "driveline.road_load.vehicle.gravity", 9.78),
    # 235 mm wide, 55 % high, 17 inch; the rolling circumference is 3.05 diameters
    "tyre.size": (
        "235/55R17",
        "driveline.rolling_radius",
        3.05 * (17 * 0.0254 + 2 * 0.235 * 0.55) / (2 * math.pi),
    ),
    "tyre.rolling_radius_mm": (305.0, "driveline.rolling_radius", 0.305),
    "tyre.unladen_radius_mm": (333.0, "driveline.road_load.tyre.unladen_radius", 0.333),
    "gearbox.ratios": ([4.0, 2.0, 1.0], "driveline.gearbox.ratios", (4.0, 2.0, 1.0)),
    "gearbox.lowest_cruising_speed_rpm": (
        1700.0,
        "driveline.gearbox.lowest_cruising_speed_rpm",
        1700.0,
    ),
    "engine.kind": ("electric_motor", "driveline.engine.kind", "electric_motor"),
    "engine.primary_inertia_kg_m2": (0.2, "driveline.engine.primary_inertia", 0.2),
    "engine.secondary_inertia_kg_m2": (0.05, "driveline.engine.secondary_inertia", 0.05),
    "engine.flywheel_stiffness_n_m_per_rad": (500.0, "driveline.engine.flywheel_stiffness", 500.0),
    "engine.flywheel_damping_n_m_s_per_rad": (1.1, "driveline.engine.flywheel_damping", 1.1),
    "engine.idle_speed_rpm": (700.0, "driveline.engine.idle_speed_rpm", 700.0),
    "engine.highest_speed_rpm": (5000.0, "driveline.engine.highest_speed_rpm", 5000.0),
    "driveline.propshaft_inertia_kg_m2": (0.02, "driveline.propshaft_inertia", 0.02),
    "driveline.propshaft_stiffness_n_m_per_rad": (2e4, "driveline.propshaft_stiffness", 2e4),
    "driveline.propshaft_damping_n_m_s_per_rad": (0.5, "driveline.propshaft_damping", 0.5),
    "driveline.half_shaft_stiffness_n_m_per_rad": (9e3, "driveline.half_shaft_stiffness", 9e3),
    "driveline.half_shaft_damping_n_m_s_per_rad": (2.0, "driveline.half_shaft_damping", 2.0),
    "driveline.wheel_inertia_kg_m2": (1.2, "driveline.wheel_inertia", 1.2),
    "driveline.tyre_slip_stiffness_n": (1e5, "driveline.tyre_slip_stiffness", 1e5),
    "driveline.tyre_relaxation_length_mm": (250.0, "driveline.tyre_relaxation_length", 0.25),
    "driveline.speed_control_frequency_hz": (0.2, "driveline.speed_control_frequency", 0.2),
}
# of the bearings of either shaft
BEARING = {
    "bore_diameter_mm": (35.0, "bore_diameter", 0.035),
    "outside_diameter_mm": (90.7, "outside_diameter", 0.0907),
    # races at the pitch diameter less and plus 12.7 mm cos 15 deg
    "pitch_diameter_mm": (70.0, "inner_race_diameter", 0.07 - 0.0127 * math.cos(math.pi / 12)),
    "rollers": (11, "n_rollers", 11),
    "roller_diameter_mm": (12.1, "roller_diameter", 0.0121),
    # Q = (d/3.84e-5)^(10/9) l^(8/9) with half the approach at either contact [mm, N]
    "roller_length_mm": (
        18.0,
        "stiffness_constant",
        (0.5 * 1e3 / 3.84e-5) ** (10 / 9) * 18.0 ** (8 / 9),
    ),
    # C = 1.1 f_c (l cos a)^(7/9) Z^(3/4) D^(29/27), ISO 281; f_c 88.7 at D cos a / 62.7 mm = 0.196
    "dynamic_load_rating_kn": (
        80.0,
        "stiffness_constant",
        pytest.approx(
            (0.5 * 1e3 / 3.84e-5) ** (10 / 9)
            * (
                (80e3 / (1.1 * 88.7 * 12**0.75 * 12.7 ** (29 / 27))) ** (9 / 7)
                / math.cos(math.pi / 12)
            )
            ** (8 / 9),
            rel=1e-3,
        ),
    ),
    "contact_angle_deg": (20.0, "contact_angle", math.pi / 9),
    "stiffness_constant": (7e8, "stiffness_constant", 7e8),
    "exponent": (1.1, "exponent", 1.1),
    "preload_n": (3333.0, "preload", 3333.0),
    # F = N kn d^n sin L, Mohammadpour et al. 2015
    "interference_um": (10.0, "preload", 12 * 5e8 * 1e-5 ** (10 / 9) * math.sin(math.pi / 12)),
    "loss": (0.02, "loss", 0.02),
    "film": ("steady", "film", "steady"),
    "f0": (3.0, "f0", 3.0),
    "f1": (7e-4, "f1", 7e-4),
    "series": ("303", "series", "303"),
    "rib_height_mm": (2.5, "rib_height", 0.0025),
    "rib_boundary_friction": (0.1, "rib_boundary_friction", 0.1),
    "rib_roughness_um": (0.1, "rib_roughness", 1e-7),
}
for _role, _place in (("pinion", "bearing"), ("gear", "gear_bearing")):
    for _key, (_value, _name, _si) in BEARING.items():
        NUMBERS[f"{_role}.bearing.{_key}"] = (_value, f"axle.{_place}.{_name}", _si)
# what comes in groups has tests of its own below
GROUPS = {"oil.viscosity_40_degc_mm2_s", "oil.viscosity_100_degc_mm2_s", "oil.walther_a"}
GROUPS |= {"oil.walther_b", "engine.orders", "engine.order_amplitudes", "engine.order_phases_deg"}
GROUPS |= {f"{role}.bearing.{side}_race_diameter_mm" for role in ("pinion", "gear")
           for side in ("inner", "outer")}  # fmt: skip
GROUPS |= {f"{role}.frusta_{one}_mm" for role in ("pinion", "gear")
           for one in ("lengths", "first_diameters", "last_diameters", "bores")}  # fmt: skip
WORDS = {"name", "source", "gear_set.mesh_table", "gear_set.asperity_table", "oil.file"}
WORDS |= {"film.flank_model", "film.roller_model", "model.friction_numbers"}
WORDS |= {f"{role}.bearing.type" for role in ("pinion", "gear")}
WORDS |= {"seals.oil_temperature_degc", "seals.wheel_factor"}
WORDS |= {"seals.material", "tolerances", "gear_set.gear_file", "gear_set.contact_torques_n_m"}


def fingerprint(made):
    """All that the kernels of the axle and the driveline can see, and what mean losses add."""
    axle = made.axle
    options = (axle.radii, axle.mesh_stiffness, axle.steps_per_mesh_period)
    options += (axle.steps_per_highest_period, axle.flank_bulk_resistance)
    options += (axle.friction_law.pressure,)
    packed = flatten(axle.kernel_parameters()).tolist()
    return packed, options, made.driveline


def test_every_field_has_an_expectation_here():
    assert NUMBERS.keys() | GROUPS | WORDS == field_notes(AxleFile).keys()


@each("field", NUMBERS)
def test_a_field_sets_its_number_of_the_model_and_reaches_the_kernels(field):
    value, place, expected = NUMBERS[field]
    # a loss factor acts with modal damping alone
    beside = {"gear_set.mesh_damping": "modal"} if field.endswith("modal_loss_factor") else {}
    # the pressure of a mean slope, with a mean slope alone
    beside |= {"oil.alpha_is": "mean"} if field == "oil.alpha_pressure_gpa" else {}
    made = car_axle(beside | {field: value})
    found = reduce(getattr, place.split("."), made)
    if isinstance(expected, float):
        assert found == pytest.approx(expected, rel=1e-12)  # roundings of a unit or a power
    else:
        assert found == expected
    changed = fingerprint(made) != fingerprint(car_axle(beside))
    assert changed
    note = next(note for note in made.inputs if note.field == field)
    # lists are tuples once they are read
    assert (note.origin, note.value) == (
        "given",
        tuple(value) if isinstance(value, list) else value,
    )


def test_decimals_of_other_units_are_exact():
    made = car_axle({"gear_set.backlash_um": 83.7, "pinion.bearing.roller_diameter_mm": 12.7})
    assert made.axle.backlash == 83.7e-6
    assert made.axle.bearing.roller_diameter == 0.0127


def paper():
    return mohammadpour_2015_axle(), DrivelineParameters(road_load=mohammadpour_2015_road_load())


def every_field(text):
    """The shipped file with its remarks at work too."""
    uncommented = re.sub(r"^# (\w+ = )", r"\1", text, flags=re.MULTILINE)
    data = tomllib.loads(uncommented)
    data["oil"] = {"name": "mohammadpour_2015"}  # its data there are another oil's, to copy
    for name in ("asperity_table", "gear_file", "contact_torques_n_m"):
        del data["gear_set"][name]  # files that do not ship
    for name in ("flank_model", "roller_model"):
        del data["film"][name]  # refused beside the formulas that are the default
    del data["pinion"]["bearing"]["rib_height_mm"]  # 0.15 of 12.7 mm, a rounding apart
    return data


def test_the_shipped_file_is_the_papers_axle_to_the_last_bit():
    text = AxleFile.shipped_text("mohammadpour_2015")
    axle, driveline = paper()
    for data in (tomllib.loads(text), every_field(text), BARE):
        made = AxleFile.from_data(data, "it").car_axle()
        np.testing.assert_array_equal(
            flatten(made.axle.kernel_parameters()), flatten(axle.kernel_parameters())
        )
        assert made.driveline == driveline
        for name in ("bearing", "gear_bearing", "oil", "solid", "radii", "friction"):
            assert getattr(made.axle, name) == getattr(axle, name)


def test_the_shipped_file_shows_every_field():
    text = AxleFile.shipped_text("mohammadpour_2015")
    for name in field_notes(AxleFile):
        assert re.search(rf"\b{name.rpartition('.')[2]}\b", text), name


def test_what_the_file_leaves_out_is_told_with_value_unit_and_reason():
    made = car_axle({"pinion.bearing.roller_length_mm": 20.0})
    notes = {note.field: note for note in made.assumed}
    assert made.inputs[0].origin == "given"
    mass = notes["vehicle.mass_kg"]
    assert mass == ("vehicle.mass_kg", 1300.0, "kg", "assumed", mass.why)
    assert "Mohammadpour" in mass.why
    stiffness = notes["pinion.bearing.stiffness_constant"]
    assert (stiffness.origin, stiffness.unit) == ("inferred", "N/m^n")
    assert stiffness.value_text == "1.15246e+09"
    assert "pinion.bearing.roller_length_mm" not in notes
    assert all(note.why for note in made.assumed)


def test_a_bearing_by_its_catalogue_gets_rollers_of_its_section_not_those_of_the_paper():
    # 32216, whose rollers are printed: 16 of 17 x 22.7 mm, Wingertszahn et al. 2023
    catalogue = {
        "bore_diameter_mm": 80.0,
        "outside_diameter_mm": 140.0,
        "contact_angle_deg": 15.64,
        "dynamic_load_rating_kn": 187.0,
    }
    made = car_axle({f"pinion.bearing.{key}": value for key, value in catalogue.items()})
    bearing = made.axle.bearing
    assert abs(bearing.n_rollers - 16) <= 1
    assert bearing.roller_diameter == pytest.approx(17e-3, rel=0.05)
    # Palmgren's two contacts, d = 2 * 3.84e-5 Q^0.9 / l^0.8 [mm, N], at an approach of 1 m
    length = (2 * 3.84e-5 * bearing.stiffness_constant**0.9 / 1e3) ** (1 / 0.8)
    assert length == pytest.approx(22.7, rel=0.1)
    notes = {note.field: note for note in made.assumed}
    assert notes["pinion.bearing.roller_length_mm"].why == "load rating, ISO 281"
    # half the section, half the rollers: they fit without a word on rollers
    small = car_axle(
        {"pinion.bearing.bore_diameter_mm": 41.275, "pinion.bearing.outside_diameter_mm": 73.431}
    ).axle.bearing
    assert small.roller_diameter < 0.6 * 0.5 * (73.431 - 41.275) * 1e-3
    assert small.n_rollers * small.roller_diameter < math.pi * 57.4e-3


@pytest.mark.parametrize("start", [BARE, tomllib.loads(EXAMPLE.read_text())])
def test_a_file_of_all_that_was_assumed_gives_the_same(start):
    made = AxleFile.from_data(start, "it").car_axle(MESH)
    given = {n.field: n.value for n in made.inputs if n.origin != "inferred" and n.value != ""}
    again = car_axle(given)
    assert fingerprint(again) == fingerprint(made)
    left = {n.field for n in again.assumed if n.origin == "assumed"}
    assert left <= {"gear.bearing"}


def test_bearings_of_the_gears_shaft_are_the_pinions_unless_given():
    made = car_axle({"pinion.bearing.preload_n": 3000.0})
    assert made.axle.gear_bearing is None
    made = car_axle({"pinion.bearing.preload_n": 3000.0, "gear.bearing.rollers": 10})
    assert made.axle.gear_bearing.preload == 3000.0
    assert (made.axle.bearing.n_rollers, made.axle.gear_bearing.n_rollers) == (12, 10)
    p = made.axle.kernel_parameters()
    assert (p.bearing_p.n_rollers, p.bearing_g.n_rollers) == (12.0, 10.0)
    made = car_axle({"gear.bearing.preload_n": 1000.0})
    p = made.axle.kernel_parameters()
    assert (p.preload_p, p.preload_g) == (2500.0, 1000.0)


def test_boundary_dimensions_alone_give_the_pitch_diameter():
    made = car_axle(
        {"pinion.bearing.bore_diameter_mm": 50, "pinion.bearing.outside_diameter_mm": 90.0}
    )
    races = made.axle.bearing.inner_race_diameter + made.axle.bearing.outer_race_diameter
    assert races == pytest.approx(0.14, rel=1e-12)  # twice the mean of 50 and 90 mm


def test_races_of_a_file_are_taken_as_they_are():
    races = {"pinion.bearing.inner_race_diameter_mm": 52.1}
    races |= {"pinion.bearing.outer_race_diameter_mm": 77.7}
    bearing = car_axle(races).axle.bearing
    assert (bearing.inner_race_diameter, bearing.outer_race_diameter) == (0.0521, 0.0777)


def test_an_oil_of_a_data_sheet_has_its_two_viscosities():
    oil = car_axle(
        {"oil.viscosity_40_degc_mm2_s": 150.0, "oil.viscosity_100_degc_mm2_s": 16.0}
    ).axle.oil
    for T, nu in ((313.15, 150e-6), (373.15, 16e-6)):
        # double logarithms lose three digits
        assert oil.dynamic_viscosity(T) == pytest.approx(nu * oil.density, rel=1e-12)
    a, b = oil.walther_a, oil.walther_b
    assert car_axle({"oil.walther_a": a, "oil.walther_b": b}).axle.oil.walther_b == b


def test_the_engine_has_the_orders_of_the_file():
    lists = {"engine.orders": [3, 6], "engine.order_amplitudes": [1.0, 0.25]}
    engine = car_axle(lists | {"engine.order_phases_deg": [0.0, 90.0]}).driveline.engine
    # at 15 deg of the crank: cos 45 deg, and cos(90 + 90 deg)
    expected = 100.0 * (1.0 + math.cos(math.pi / 4) - 0.25)
    assert engine.torque(100.0, math.pi / 12) == pytest.approx(expected, rel=1e-12)
    none = {key: [] for key in (*lists, "engine.order_phases_deg")}
    assert car_axle(none).driveline.engine.orders == ()


def test_an_electric_motor_is_smooth_has_one_gear_and_runs_from_standstill():
    made = car_axle({"engine.kind": "electric_motor", "engine.primary_inertia_kg_m2": 0.08})
    engine, gearbox = made.driveline.engine, made.driveline.gearbox
    assert (engine.orders, engine.primary_inertia, gearbox.ratios) == ((), 0.08, (1.0,))
    assert engine.torque(100.0, 0.3) == 100.0
    assert gearbox.gear_for(0.2, engine) == gearbox.gear_for(1500.0, engine) == 1  # rad/s
    names = {note.field: note for note in made.inputs}
    assert (names["engine.orders"].value_text, names["engine.orders"].origin) == ("none", "assumed")
    geared = {"engine.kind": "electric_motor", "gearbox.ratios": [9.0, 3.0]}
    assert car_axle(geared).driveline.gearbox.ratios == (9.0, 3.0)


def test_the_assumed_height_of_the_rib_is_told():
    notes = {note.field: note for note in car_axle({}).assumed}
    # 0.15 of the paper's rollers of 12.7 mm
    assert notes["pinion.bearing.rib_height_mm"].value == pytest.approx(1.905, rel=1e-12)
    given = car_axle({"pinion.bearing.rib_height_mm": 2.5})
    assert "pinion.bearing.rib_height_mm" not in {note.field for note in given.assumed}


def test_a_mesh_table_lies_beside_the_file_and_gives_the_final_drive(tmp_path, monkeypatch):
    (tmp_path / "gears").mkdir()
    other = replace(MESH, name="own", pinion_teeth=11, gear_teeth=43)
    write_mesh_table(other, tmp_path / "gears" / "own.nc")
    path = tmp_path / "my.toml"
    path.write_text('[gear_set]\nmesh_table = "gears/own.nc"\n')
    made = read_axle(path)
    assert (made.axle.mesh.name, made.driveline.axle_ratio) == ("own", 43 / 11)
    path.write_text('[gear_set]\nmesh_table = "gears/none.nc"\n')
    with pytest.raises(ParameterError, match=r"none\.nc was not found in .*gears\. .*my\.toml na"):
        read_axle(path)
    path.write_text('[gear_set]\nmesh_table = "none"\n')
    with pytest.raises(TableError, match=r"No mesh table is called 'none'.*ends in \.nc"):
        read_axle(path)
