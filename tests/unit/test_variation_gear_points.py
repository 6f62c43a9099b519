"""A point of a varied gear pair is what the study's own call gives for the changed pair."""

import math

import numpy as np
import pytest

from gearlube.studies.contact.settings import ContactSettings, CycleSettings, Misalignment
from gearlube.studies.helical.run import run_helical
from gearlube.studies.helical.settings import HelicalSettings, quick_settings
from gearlube.variation.point_study import point_study
from gearlube.variation.points.of_file import order_values
from gearlube_core.errors import ParameterError, TableError
from gearlube_core.helical_geometry.gear_file import HelicalGearFile
from gearlube_core.hypoid_contact.contact_dataset import analyse_contact
from gearlube_core.hypoid_contact.pair import FlankPair
from gearlube_core.hypoid_contact.unloaded_error import unloaded_error
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from tests.helpers.each import each

SHIFT = {"misalignment.pinion_offset_um": 40.0, "misalignment.shaft_angle_mrad": 0.2}
SHIFTED = Misalignment(pinion_offset=40e-6, shaft_angle=0.2e-3)


def numbers(study, point):
    names = [one.name for one in study.quantities]
    return dict(zip(names, study.compute(point), strict=True))


def test_orders_of_a_sum_of_cosines_are_its_amplitudes():
    phase = 2.0 * math.pi * np.arange(16) / 16
    found = order_values(5.0 + 2.0 * np.cos(phase) - 0.5 * np.sin(3.0 * phase))
    assert found[1:] == pytest.approx([2.0, 0.0, 0.5], abs=1e-12)


@pytest.mark.slow  # searches the touch at 64 positions: three seconds
def test_the_unloaded_error_of_a_displaced_pair_is_that_of_its_path_of_contact():
    file = HypoidGearFile.named("mohammadpour_2015")
    path = unloaded_error(FlankPair.from_file(file, "drive", SHIFTED))
    found = numbers(point_study("contact"), SHIFT | {"pinion.torque_n_m": 0.0})
    # 64 positions miss the kink at the handover by up to half a step; a parabola of range 1 falls
    # by 4 a period there: 3.1 %
    assert found["te_unloaded_pp"] == pytest.approx(np.ptp(path.angular), rel=0.032)
    assert math.isnan(found["te_pp"])


@pytest.mark.slow  # the teeth as finite elements: a minute
def test_a_displaced_pair_under_load_is_that_of_the_contact_study():
    file = HypoidGearFile.named("mohammadpour_2015").varied({"pinion.cutter.point_radius_mm": 63.8})
    cycle = CycleSettings(torques=(50.0,), positions=8, misalignment=SHIFTED)
    direct = analyse_contact(file, ContactSettings(cycle=cycle)).sel(side="coast", torque=50.0)
    point = SHIFT | {
        "pinion.cutter.point_radius_mm": 63.8, "side": "coast", "mesh.positions": 8,
    }  # fmt: skip
    found = numbers(point_study("contact"), point)
    error = float(direct["R_p"].mean()) * np.ptp(direct["rotation"].values)
    # the same numbers by the same kernels
    assert found["te_pp"] == pytest.approx(error, rel=1e-9)
    assert found["pressure_max"] == pytest.approx(float(direct["pressure_max"].max()), rel=1e-9)
    assert found["mesh_stiffness"] == pytest.approx(float(direct["k_m"].mean()), rel=1e-9)


@pytest.mark.slow  # the teeth as finite elements: half a minute
def test_a_varied_helical_pair_is_that_of_the_helical_study():
    file = HelicalGearFile.named("he_2007").varied({"pair.helix_angle_deg": 20.0})
    settings = HelicalSettings(
        file=file, pinion_torque=225.97, pinion_speed=100.0 * math.pi / 3.0, torques=(225.97,),
        speeds=(100.0 * math.pi / 3.0,), mu=(0.05,), oil_temperature=333.15, separation_speeds=0,
        stability_columns=2, stability_rows=2, draws=0, parts="all",
    )  # fmt: skip
    direct = run_helical(quick_settings(settings), jobs=1).datasets
    study = point_study("helical", quick=True)
    found = numbers(study, {"pair.helix_angle_deg": 20.0, "oil.temperature_degc": 60.0})
    moving = direct["response"].sel(case="film")
    expected = {
        "te_pp": direct["contact"]["transmission_error_ptp"][0],
        "dte_mesh_1": moving["delta_z_harmonic"].sel(harmonic=1),
        "F_xp_mesh_2": moving["F_xp_harmonic"].sel(harmonic=2),
        "loss": direct["losses"]["loss"].sum(),
        "film_min": direct["losses"]["film_min"].min(),
    }
    for name, value in expected.items():  # the same numbers by the same kernels
        assert found[name] == pytest.approx(float(value), rel=1e-9, abs=0.0), name


@each(
    ("study", "point", "said"),
    [
        ("helical", {"operation.pinion_torque_n_m": -5.0}, "operation.pinion_torque_n_m must be"),
        ("helical", {"friction": "dry"}, "friction must be one of film, constant"),
        ("helical", {"oil.temperature_degc": 240.0}, "oil_temperature"),
        ("helical", {"pinion.flank.tip_relief_um": 10.0}, "tip_relief_depth_mm is missing"),
        ("contact", {"side": "both"}, "side must be one of drive, coast"),
        ("contact", {"misalignment.pinion_axial_um": 6000.0}, "pinion_axial must be within"),
        ("contact", {"pinion.machine.tilt_angle_deg": 85.0}, "tilt_angle_deg must be a number"),
        ("resonance", {"pinion.torque_n_m": 5000.0}, "pinion_torque must be at most"),
        ("resonance", {"range.first": 1.6}, "range must rise"),
        ("resonance", {"mesh_table": "no_such"}, "No mesh table is called"),
    ],
)
def test_a_wrong_point_is_refused_by_its_check(study, point, said):
    with pytest.raises((ParameterError, TableError), match=said):
        point_study(study).check(point)


def test_what_a_study_does_not_read_cannot_be_varied():
    keys = point_study("helical").keys
    assert "pinion.flank.crown_um" in keys
    assert "oil.viscosity_pa_s" in keys  # of friction and losses
    assert "meshing_steps.step_mm" not in keys
    assert "operation.axial_n" not in point_study("bearing").keys


@pytest.mark.slow  # compiles the pair and follows it twice: seconds
def test_a_heavier_gear_resonates_lower_by_its_part_in_the_equivalent_mass():
    study = point_study("resonance", quick=True)
    usual = numbers(study, {})
    heavy = numbers(study, {"gear.inertia_kg_mm2": 2.0 * 58100.0})
    # m_eq = 1/(R_p^2/J_p + R_g^2/J_g) with R_g = 36/13 R_p
    mass = [1.0 / (1.0 / 1734.0 + (36.0 / 13.0) ** 2 / gear) for gear in (58100.0, 116200.0)]
    ratio = heavy["natural_frequency"] / usual["natural_frequency"]
    # the arms of the table are mean values over the period, R_g / R_p within 1e-3 of the teeth
    assert ratio == pytest.approx((mass[0] / mass[1]) ** 0.5, rel=1e-3)
    assert usual["folds"] == 2.0
    assert 0.8 < usual["dte_peak_at"] < usual["apart_rising"] < 1.0
    # nearly a sine: the second order has a tenth of the first
    assert 2.0 * usual["dte_peak_mesh_1"] == pytest.approx(usual["dte_peak"], rel=0.1)
