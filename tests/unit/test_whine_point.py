"""Whine of a built axle: lines of an order record, levels at the ear, tables as built."""

import numpy as np
import pytest

from drivetrain.axle_file.read_axle import gear_file_of
from gearlube.studies.sound.transfer_path import AXLE_FORCES, TransferPath
from gearlube.studies.sweep.recording import Recording
from gearlube.variation.point_study import point_study
from gearlube.variation.points.contact import teeth_of
from gearlube.variation.points.whine import levels, lines, order_pressures, table_as_built
from gearlube_core.errors import ParameterError
from gearlube_core.hypoid_contact.contact_dataset import contact_dataset
from gearlube_core.hypoid_contact.contact_table import contact_table
from gearlube_core.hypoid_contact.mesh_cycle import SIDES, CycleSettings, run_cycle
from gearlube_core.hypoid_contact.placement import Misalignment
from gearlube_core.tooth_compliance.tooth_body import ToothBodySettings

TEETH = 13, 36


def _record(force, orders):
    """A record at 20 turns a second in which one bearing force has these complex orders."""
    time = np.arange(0.0, 0.6, 1e-4)
    angle = 2.0 * np.pi * 20.0 * time
    channels = ["pinion.angle", *(f"bearing[{j}].force.{a}" for j in (1, 2, 3, 4) for a in "xyz")]
    values = np.zeros((time.size, len(channels)))
    values[:, 0] = angle
    values[:, 1] = 500.0 + np.real(np.exp(1j * np.outer(angle, orders)) @ force)
    return Recording(
        time=time, channels=tuple(channels), values=values, torques=np.zeros((time.size, 2)),
        step=1e-4, steps_per_mesh_period=38, teeth=TEETH[0], revolutions=12, vehicle_speed=10.0,
    )  # fmt: skip


def _path(response):
    frequency = np.array([20.0, 16000.0])
    flat = {name: np.full(2, response, complex) for name in AXLE_FORCES}
    return TransferPath(source="flat", frequency=frequency, responses=flat)


def test_each_line_of_a_force_is_heard_with_its_height_and_phase():
    orders = lines(*TEETH)
    force = np.arange(1.0, orders.size + 1.0) * np.exp(0.3j * np.arange(orders.size))
    heard = order_pressures(_record(force, orders), _path(2e-3), orders)
    # exact lines: least squares find them to the rounding of a well-posed problem
    assert heard == pytest.approx(2e-3 * force, rel=1e-6)


def test_a_stiffer_case_moves_its_response_up_by_the_root_of_the_stiffness():
    orders = lines(*TEETH)
    record = _record(np.ones(orders.size), orders)
    frequency = np.geomspace(20.0, 16000.0, 4001)
    slope = {name: frequency.astype(complex) for name in AXLE_FORCES}  # H = f
    path = TransferPath(source="slope", frequency=frequency, responses=slope)
    stiffer = order_pressures(record, path, orders, stiffness=1.21)
    # H(f / 1.1); between points of the path logarithms are taken, 1e-6
    assert stiffer.real == pytest.approx(20.0 * orders / 1.1, rel=1e-5)


def test_levels_are_those_of_pure_tones():
    frequency = np.r_[np.full(5, 1000.0), np.full(5, 2000.0)]
    pressure = np.zeros(10, complex)
    pressure[0], pressure[1] = 0.02 * np.sqrt(2.0), 0.002j * np.sqrt(2.0)
    found = levels(pressure, frequency, 60.0)
    quieter = levels(pressure, frequency, 50.0)
    assert found[2] == pytest.approx(60.0)  # 0.02 Pa
    assert found[4] == pytest.approx(40.0)  # its sideband
    assert found[0] == pytest.approx(10.0 * np.log10(1e6 + 1e4), abs=0.01)  # A(1 kHz) is 0 dB
    assert quieter[1] - found[1] == pytest.approx(10.0)  # less noise, clearer tone


def test_an_axle_without_a_gear_file_is_refused():
    with pytest.raises(ParameterError, match=r"gear file of the axle's .* got 'own.nc'"):
        gear_file_of("mohammadpour_2015", "own.nc")


@pytest.mark.slow
def test_errors_of_teeth_make_sidebands_and_misalignment_moves_the_mesh_order():
    """Loads a hypoid pair and marches an axle three times: half a minute."""
    study = point_study("whine", quick=True)
    names = [one.name for one in study.quantities]

    def at(point):
        return dict(zip(names, study.compute(point), strict=True))

    sound = at({})
    round_off = at({"runout.gear_um": 20.0})
    moved = at({"misalignment.pinion_axial_um": 30.0})
    louder = at({"case.transfer_db": 3.0})
    assert round_off["level_beside_1"] > sound["level_beside_1"] + 30.0  # without: numerical noise
    assert abs(moved["level_mesh_1"] - sound["level_mesh_1"]) > 0.1
    assert louder["whine_level"] == pytest.approx(sound["whine_level"] + 3.0, abs=1e-9)


@pytest.mark.slow
def test_a_table_as_built_is_that_of_the_whole_contact_analysis():
    """Analyses a hypoid pair out of place, both flanks: a quarter of a minute."""
    study = point_study("whine", quick=True)
    file, torque = study.gears, 50.0
    place = Misalignment(pinion_axial=30e-6, shaft_angle=2e-4)
    settings = CycleSettings(torques=(torque,), positions=8, misalignment=place)
    stiffness = {
        side: teeth_of(file.model_dump_json(), ToothBodySettings())[side] for side in SIDES
    }
    cycle = run_cycle(file, stiffness, settings, jobs=1)
    whole = contact_table(file, contact_dataset(file, settings, cycle))
    built = table_as_built(study.axle.car_axle({}).axle.mesh, torque, cycle["drive"])
    for name in ("k_t", "R_p", "R_g", "n_x", "n_y", "n_z"):
        assert built.series[name][0] == pytest.approx(whole.series[name][-1], abs=1e-9, rel=1e-9)
    # the first touch at 8 places of the mesh, and at 64: orders above 4 fold
    size = np.abs(whole.series["e"][-1, 1:]).max()
    assert built.series["e"][0, 1:3] == pytest.approx(whole.series["e"][-1, 1:3], abs=0.1 * size)
    assert built.series["k_m"][0] == pytest.approx(whole.series["k_m"][-1], rel=1e-2, abs=5e5)
