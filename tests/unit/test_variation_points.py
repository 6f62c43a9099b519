"""A point of a variation is what the study's own call gives for the changed axle or bearing."""

import math
from dataclasses import replace

import numpy as np
import pytest

from gearlube.variation.file_variants import AxleVariants
from gearlube.variation.point_study import point_study
from gearlube.variation.points.bearing import BearingPoint
from gearlube.variation.points.cycle import CyclePoint
from gearlube.variation.points.losses import LossPoint
from gearlube.variation.points.march import MarchPoint
from gearlube_core.bearings.bearing_file import BearingFile
from gearlube_core.bearings.losses.loss import LossModel, bearing_loss
from gearlube_core.dynamics.hypoid_axle.losses import LOSS_SOURCES, axle_losses
from gearlube_core.dynamics.hypoid_axle.mohammadpour_2015 import mohammadpour_2015_axle
from gearlube_core.errors import ParameterError, TableError
from gearlube_core.oil.oil_file import read_oil
from tests.helpers.each import each

PAPER = AxleVariants.read("mohammadpour_2015")


def numbers(study, point):
    names = [one.name for one in study.quantities]
    return dict(zip(names, study.compute(point), strict=True))


def test_losses_at_a_point_are_those_of_the_axle_with_that_preload_and_roughness():
    axle = mohammadpour_2015_axle(bearing_preload=4000.0, roughness_rms=0.8e-6)
    direct = axle_losses(
        axle,
        torques=np.array([120.0]),
        speeds=np.array([1500.0 * math.pi / 30.0]),
        temperatures=np.array([333.15]),
    )
    point = {
        "pinion.bearing.preload_n": 4000.0, "gear_set.roughness_rms_um": 0.8,
        "pinion.torque_n_m": 120.0, "pinion.speed_rpm": 1500.0, "oil.temperature_degc": 60.0,
    }  # fmt: skip
    found = numbers(LossPoint(axle=PAPER), point)
    expected = direct.power[0, 0, 0]
    # the same call; 60 degC and 333.15 K differ by a rounding
    assert [found[f"loss_{name}"] for name in LOSS_SOURCES] == pytest.approx(expected, rel=1e-9)
    assert found["loss"] == pytest.approx(expected.sum(), rel=1e-9)
    assert found["efficiency"] == pytest.approx(
        1.0 - expected.sum() / (120.0 * 50.0 * math.pi), rel=1e-9
    )


def test_a_parameter_of_the_fmu_and_the_field_of_the_file_are_the_same():
    study = LossPoint(axle=PAPER)
    by_file = study.compute({"gear_set.roughness_rms_um": 0.8, "model.friction": "as_printed"})
    by_fmu = study.compute({"flank.roughness_rms": 0.8e-6, "friction.model": "as_printed"})
    assert list(by_file) == pytest.approx(list(by_fmu), rel=1e-12, nan_ok=True)


def test_a_bearing_at_a_point_is_that_of_the_law():
    file = BearingFile.named("wingertszahn_2023")
    study = BearingPoint(file=file).with_oils(())
    point = {"bearing.rollers": 18, "load.axial_n": 4000.0, "law": "palmgren"}
    direct = bearing_loss(
        replace(file.geometry(), n_rollers=18),
        read_oil("fva_3").lubricant,
        LossModel(law="palmgren"),
        speed=2000.0 * math.pi / 30.0,
        axial_load=4000.0,
        radial_load=0.0,
        temperature=333.15,
    )
    assert numbers(study, point)["torque"] == pytest.approx(direct.torque, rel=1e-9)


@each(
    ("study", "point", "said"),
    [
        ("map", {"pinion.torque_n_m": 5000.0}, "pinion.torque_n_m must be within -600 to 600 N.m"),
        ("map", {"oil.temperature_degc": 200.0}, "oil.temperature must be within"),
        ("map", {"gear_set.backlash_um": -1.0}, "gear_set.backlash_um must be a number, 0 to 2000"),
        ("map", {"bearing.preload": 2e6}, "bearing.preload must be within 0 to 100000 N"),
        ("map", {"gear_set.mesh_table": "no_such"}, "No mesh table is called"),
        ("sweep", {"vehicle.speed_kmh": 300.0, "vehicle.grade": 0.4}, "The road load must be"),
        ("sweep", {"driver": "me"}, "driver must be one of vehicle, hold"),
        ("cycle", {"vehicle.mass_kg": 1.0}, "vehicle.mass_kg must be a number, 100 to 100000 kg"),
        ("cycle", {"vehicle.mass_kg": 50_000.0}, "torque"),
        ("cycle", {"cycle": "no_such"}, "nedc"),
        ("bearing", {"bearing.rollers": 20}, "The rollers overlap"),
        ("bearing", {"load.axial_n": 0.0}, "axial_load must be within"),
        ("bearing", {"law": "mine"}, "law must be one of"),
    ],
)
def test_a_wrong_point_is_refused_by_its_check(study, point, said):
    with pytest.raises((ParameterError, TableError), match=said):
        point_study(study).check(point)


def test_a_march_and_a_cycle_are_checked_where_all_is_right():
    points = {MarchPoint: ("gear_set.backlash_um", 100.0), CyclePoint: ("vehicle.mass_kg", 1500.0)}
    for study, (key, value) in points.items():
        assert study(axle=PAPER).check({key: value}) is None  # no refusal


@pytest.mark.slow  # drives a cycle: two seconds
def test_a_heavier_car_loses_more_over_a_cycle():
    study = CyclePoint(axle=PAPER)
    usual, heavy = numbers(study, {}), numbers(study, {"vehicle.mass_kg": 2000.0})
    assert heavy["energy_lost"] > usual["energy_lost"]
    assert heavy["energy_in"] > usual["energy_in"]
