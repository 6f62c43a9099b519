"""Damage of a helical pair over bins, beside its mesh loss, closed forms and the standards."""

import json
import math
from dataclasses import replace
from functools import partial

import numpy as np
import pytest
import xarray as xr

from drivetrain.axle_file.read_axle import read_axle
from gearlube.damage.flank import flank_damage
from gearlube.damage.pair import helical_teeth, is_pair, pair_settings, solved_face
from gearlube.damage.permissible_film import permissible_line_ratio
from gearlube.damage.report import damage_report, findings
from gearlube.damage.run import run_damage
from gearlube.damage.settings import DamageSettings, rated_gears
from gearlube.studies.helical.pair_losses import losses_dataset
from gearlube.studies.helical.settings import quick_settings
from gearlube_core.contact.dang_van import FatigueLimits
from gearlube_core.dynamics.helical_pair.flank_states import face_load
from gearlube_core.errors import ParameterError
from gearlube_core.helical_geometry.gear_file import HelicalGearFile
from gearlube_core.rating.flank_load import FlankLoad, FlankOil
from gearlube_core.rating.gears import LoadFactors
from gearlube_core.rating.iso_6336 import cylindrical_rating
from gearlube_core.rating.life import miner_sum
from gearlube_core.rating.micropitting import TEST_POINT
from gearlube_core.rating.scuffing import flash_rating
from gearlube_core.rating.spectrum import DutyBins
from gearlube_core.rating.subsurface import CaseHardening
from tests.helpers.helical_contact_cases import even_contact

K_WEAR = 5e-18  # 1/Pa
FACTORS = LoadFactors(face=1.2)
GEARS = rated_gears("case_hardened", 1500.0, 430.0)
FILE = HelicalGearFile.named("he_2007")
PAIR = FILE.helical_pair()


def bins_of(*rows):
    """Torque [N.m], speed [rad/s], temperature [K], hours."""
    torque, speed, temperature, hours = np.array(rows).T
    return DutyBins(torque, speed, temperature, 3600.0 * hours)


BINS = bins_of((300.0, 262.0, 363.0, 2000.0), (450.0, 157.0, 363.0, 500.0))
COAST = bins_of((-200.0, 262.0, 353.0, 500.0))


def teeth_of(bins=BINS, file=FILE, film_model=None, **given):
    """Return teeth on which all lines have one stiffness, so that their load is known."""
    settings = pair_settings(file, bins, film_model=film_model)
    return settings, helical_teeth(settings, even_contact(settings.constant_mesh()), **given)


def damage_of(bins=BINS, teeth=None, **given):
    return DamageSettings(
        pair=teeth or teeth_of(bins, load_stage=12.0)[1], bins=bins, gears=GEARS, factors=FACTORS,
        **given,
    )  # fmt: skip


@pytest.fixture(scope="module")
def whole():
    return run_damage(damage_of(wear_coefficient=K_WEAR))


@pytest.mark.parametrize("film", ["formula", "solved"])
@pytest.mark.parametrize("torque", [300.0, -200.0])
def test_friction_of_the_flanks_is_the_mesh_loss(torque, film):
    bins = bins_of((torque, 262.0, 363.0, 1.0))
    settings, teeth = teeth_of(bins, film_model=film)
    lost = losses_dataset(
        replace(settings, parts="losses", torques=(abs(torque),), speeds=(262.0,), draws=0),
        settings.constant_mesh(),
    )
    found = teeth.states(torque, 262.0, 363.0)
    # 96 phases and 96 strips beside 48 phases and 16 Gauss points of each line
    expected = float(lost["loss"].sel(part="sliding").squeeze())
    assert found.friction_power == pytest.approx(expected, rel=2e-3)


def test_strips_carry_the_torque_under_the_pressure_of_hertz():
    states = teeth_of()[1].states(300.0, 262.0, 363.0)
    force = 300.0 / (PAIR.pinion_base_radius * math.cos(PAIR.base_helix_angle))
    # rigid bodies: every phase carries the whole force
    assert states.load.sum() * states.share_of_time == pytest.approx(force, rel=1e-9)
    # Hertz: p = (w E'/(2 pi R))^(1/2), with E'/2 = E/(1 - nu^2)/2 of equal steels and
    # R = r1 r2/(r1 + r2)/cos(beta_b) of the transverse radii
    i = int(states.pressure.argmax())
    r1 = PAIR.contact_start + states.place[i, 1]
    R = r1 * (PAIR.tangent_length - r1) / PAIR.tangent_length / math.cos(PAIR.base_helix_angle)
    solid = teeth_of()[1].solid
    E = float(solid.youngs_modulus) / (1.0 - float(solid.poisson_ratio) ** 2) / 2.0
    expected = math.sqrt(states.line_load[i] * E / (math.pi * R))
    assert states.pressure[i] == pytest.approx(expected, rel=1e-9)
    assert ((states.place >= 0.0) & (states.place <= [PAIR.face_width, 0.0135])).all()


def test_wear_vanishes_at_the_pitch_point_and_goes_inversely_with_the_speeds():
    teeth = teeth_of()[1]
    states = teeth.states(300.0, 262.0, 363.0)
    found = flank_damage(states, teeth.solid, K_WEAR)
    # the faster surface passes the contact sooner: h_1/h_2 = u_2/u_1 = r_2/(u r_1)
    r1 = PAIR.contact_start + states.place[:, 1]
    expected = (PAIR.tangent_length - r1) / PAIR.ratio / r1
    np.testing.assert_allclose(found.pinion_wear / found.gear_wear, expected, rtol=1e-9)
    away = np.abs(r1 - PAIR.pitch_point)
    # sliding rises from zero in proportion to the way from the pitch point: 1 % of the path
    near = away < 0.01 * (PAIR.contact_end - PAIR.contact_start)
    assert near.any()
    assert found.pinion_wear[near].max() < 0.03 * found.pinion_wear.max()


def test_stress_and_damage_are_those_of_the_standard(whole):
    nu = float(damage_of().teeth.oil.state(313.15).nu)
    for i, (torque, speed, _, time) in enumerate(zip(*BINS, strict=True)):
        rating = cylindrical_rating(
            PAIR, GEARS, FACTORS, pinion_torque=torque, pinion_speed=speed, cycles=(1.0, 1.0),
            oil_viscosity=nu,
        )  # fmt: skip
        expected = 1e-6 * np.array(rating.contact_stress)
        np.testing.assert_allclose(whole["contact_stress"].values[i], expected, rtol=1e-9)
        turns = speed * time / (2.0 * math.pi)
        for member, cycles in enumerate((turns, turns * 25.0 / 31.0)):
            line, stress = rating.contact_lines[member], rating.contact_stress[member]
            expected = float(miner_sum(line, stress, cycles))
            assert whole["contact_damage"].values[i, member] == pytest.approx(expected, rel=1e-9)
    assert float(whole["contact_damage"].sum()) > 0.0
    row = next(one for one in json.loads(whole.attrs["summary"]) if one[0].startswith("pitting"))
    assert row[6].startswith("ISO 6336-1, -2, -3:2006, method B")
    newer = damage_of(teeth=teeth_of(edition="2019")[1])
    assert newer.teeth.standard.startswith("ISO 6336-1, -2, -3:2019")


def test_scuffing_is_that_of_the_standard_at_the_worst_bin(whole):
    rows = {row[0]: row for row in json.loads(whole.attrs["summary"])}
    settings = damage_of()
    safety = []
    for torque, speed, temperature in zip(*BINS[:3], strict=True):
        oil = FlankOil.of(settings.teeth.oil, temperature=temperature, load_stage=12.0)
        load = FlankLoad.of(settings.rate(torque, speed, temperature), PAIR, GEARS, oil)
        safety.append(flash_rating(load, friction=load.mean_friction).safety)
    row = rows["scuffing: flash temperature"]
    assert float(row[3]) == pytest.approx(min(safety), rel=5e-3)  # three digits
    assert row[6].startswith("ISO/TS 6336-20:2017")
    assert "scuffing: integral temperature" in rows
    assert rows["micropitting: specific film of the standard"][5] == "no limit given"
    assert any("torque of the load stage" in one.headline for one in findings(whole))
    first = findings(whole)[0]
    assert first.headline.startswith(("It lasts", "It does not last"))
    # no verdict is good where the standard does not hold
    assert first.level != "good" or not whole.attrs["outside"]


def test_what_is_missing_is_withheld_in_words():
    def verdicts(settings):
        return {row[0]: row[5] for row in json.loads(run_damage(settings).attrs["summary"])}

    found = verdicts(damage_of(teeth=teeth_of()[1]))
    assert "load stage" in found["scuffing: flash temperature"]
    found = verdicts(DamageSettings(pair=teeth_of(load_stage=12.0)[1], bins=BINS))
    assert "limits" in found["scuffing: integral temperature"]
    assert not any(one.startswith(("pitting", "breakage", "bearing")) for one in found)


def test_short_teeth_have_no_rating_but_all_else():
    short = FILE.varied({"pinion.tip_diameter_mm": 82.2, "gear.tip_diameter_mm": 101.3})
    settings = damage_of(teeth=teeth_of(file=short, load_stage=12.0)[1])
    assert settings.rate is None
    found = run_damage(settings)
    assert float(found["pressure"].min()) > 0.0
    assert "contact_damage" not in found
    told = [one.headline for one in findings(found) if one.level == "warning"]
    assert any("transverse contact ratio must be within 1 to 4, got 0.699" in one for one in told)


def test_coast_flanks_bear_as_drive_flanks_do():
    coast, drive = (
        run_damage(damage_of(COAST._replace(torque=sign * COAST.torque))) for sign in (1.0, -1.0)
    )
    assert float(coast["pressure_map"].sel(side="drive").max()) == 0.0
    both = coast["pressure_map"].sel(side="coast"), drive["pressure_map"].sel(side="drive")
    np.testing.assert_array_equal(*both)


def test_lines_pass_every_place_of_the_plane_of_contact(whole):
    """All places have pressure, heat vanishes in the row of the pitch point."""
    assert float(whole["pressure_map"].sel(side="drive").min()) > 0.0
    up, heat = whole["up"].values, whole["heat_map"].sel(side="drive")
    row = int(np.abs(up - 1e3 * (PAIR.pitch_point - PAIR.contact_start)).argmin())
    assert float(heat[row].max()) < 0.1 * float(heat.max())


def test_solved_line_loads_give_their_own_face_factor():
    """Even lines have the factor 1, a linear load from 0.8 to 1.2 along the face has 1.2."""
    states = teeth_of()[1].states(300.0, 262.0, 363.0)
    tilt = 0.8 + 0.4 * states.place[:, 0] / PAIR.face_width
    assert face_load(PAIR, states)[0] == pytest.approx(1.0, rel=1e-9)
    face, _ = face_load(PAIR, states._replace(load=states.load * tilt))
    # 1.198 in the middle of the last strip; lines near an end are short and have its load alone
    assert face == pytest.approx(1.198, rel=0.03)
    # a third of the face that bears nothing: the rest carries 3/2 of the mean, at the same force
    bears = states.place[:, 0] > PAIR.face_width / 3.0
    load = np.where(bears, states.load, 0.0) * states.load.sum() / states.load[bears].sum()
    assert face_load(PAIR, states._replace(load=load))[0] == pytest.approx(1.5, rel=0.03)


@pytest.mark.slow
def test_files_figures_and_report(tmp_path):
    found = run_damage(damage_of(wear_coefficient=K_WEAR), folder=tmp_path)
    assert {path.stem for path in (tmp_path / "figures").iterdir()} == {"maps_drive", "bins"}
    kept = xr.load_dataset(tmp_path / "damage.nc")
    assert "bearing" not in kept.dims
    report = damage_report(found, tmp_path / "figures")
    assert report.title == "Damage of he_2007"
    assert "plane of contact" in report.figures[0].caption
    assert any("K_Hβ is 1.20 in the standard and 1.00" in one.headline for one in report.findings)
    assert not any("hypoid" in one for one in report.limits)


C_GF = """
name = "c_gf"
source = "test"
pair = {normal_module_mm = 4.5, normal_pressure_angle_deg = 20.0, helix_angle_deg = 0.0,
  centre_distance_mm = 91.5, face_width_mm = 14.0}
pinion = {teeth = 16, tip_diameter_mm = 82.46, profile_shift_coefficient = 0.182}
gear = {teeth = 24, tip_diameter_mm = 118.36, profile_shift_coefficient = 0.172}
"""


@pytest.mark.slow
def test_test_gears_have_the_speeds_and_load_of_the_standard_at_the_start(tmp_path):
    """TEST_POINT of ISO/TS 6336-22: FZG C at 2250 1/min and 265.1 N.m, point A."""
    path = tmp_path / "c_gf.toml"
    path.write_text(C_GF.replace(",\n  ", ", "))
    settings = pair_settings(HelicalGearFile.from_toml(path), bins_of((265.1, 235.62, 363.0, 1.0)))
    states = helical_teeth(quick_settings(settings), jobs=1).states(265.1, 235.62, 363.0)
    first = states.place[:, 1] < states.place[:, 1].min() + 1e-5
    _, speeds, load, _ = TEST_POINT
    found = states.pinion_speed[first].mean(), states.gear_speed[first].mean()
    np.testing.assert_allclose(found, speeds, rtol=0.02)  # tip diameters have tolerances
    # the standard's share of unmodified teeth, 0.42, beside elastic teeth
    mean = states.load[first].sum() / (2.0 * states.semi_major[first]).sum()
    assert mean == pytest.approx(265.1 * load, rel=0.1)


@pytest.mark.slow
def test_a_torque_between_two_solved_ones_has_the_loads_of_its_own_solution():
    settings = quick_settings(pair_settings(FILE, BINS))
    between = helical_teeth(settings, jobs=2).states(260.0, 262.0, 363.0)
    own = replace(settings, torques=(260.0, 450.0))
    exact = helical_teeth(own, jobs=2).states(260.0, 262.0, 363.0)
    assert between.friction_power == pytest.approx(exact.friction_power, rel=0.01)
    # the load along a line bends with the torque, little between two levels
    assert float(between.pressure.max()) == pytest.approx(float(exact.pressure.max()), rel=0.03)


def test_bad_settings_are_refused():
    with pytest.raises(ParameterError, match="must not be 0"):
        pair_settings(FILE, bins_of((0.0, 157.0, 363.0, 1.0)))
    bounded = teeth_of()[1]._replace(torques=(-450.0, 450.0))
    with pytest.raises(ParameterError, match=r"torque of a bin .* got 500 N.m.*solved up to there"):
        DamageSettings(pair=bounded, bins=bins_of((500.0, 157.0, 363.0, 1.0)))
    with pytest.raises(ParameterError, match="got both"):
        DamageSettings(pair=bounded, car=read_axle("mohammadpour_2015"), bins=BINS)
    with pytest.raises(ParameterError, match="got neither"):
        DamageSettings(bins=BINS)
    with pytest.raises(ParameterError, match="edition"):
        teeth_of(edition="1996")
    with pytest.raises(ParameterError, match="load_stage"):
        teeth_of(load_stage=40.0)


def test_gear_files_of_pairs_are_known_from_axles(tmp_path):
    path = tmp_path / "mine.toml"
    path.write_text("[pair]\ncentre_distance_mm = 88.9\n")
    assert is_pair("he_2007")
    assert is_pair(str(path))
    path.write_text("[gear_set]\nmesh_table = 'a.nc'\n")
    assert not is_pair(str(path))
    assert not is_pair(str(tmp_path / "missing.toml"))


@pytest.mark.slow
def test_under_a_line_of_the_pair_is_the_stress_of_a_line_load():
    limits, case = FatigueLimits(bending=640e6, torsion=400e6), CaseHardening(720.0, 342.0, 0.8e-3)
    found = run_damage(damage_of(fatigue=limits, case=case))
    # the half width is small; the depths begin there all the same
    assert float(found["fracture_profile"].max()) == pytest.approx(
        float(found["fracture"].max()), rel=1e-6
    )
    p = 1e9 * found["fatigue_pressure"].values[0]
    assert p == pytest.approx(1e9 * found["pressure"].values.max(), rel=1e-6)
    # of a line load without friction; friction adds less than 1 %, strips have no thin ends
    assert float(found["fatigue"].max()) == pytest.approx(0.25 * p / 400e6, rel=0.01)
    assert float(found["fatigue_map"].sel(side="drive").max()) == pytest.approx(
        float(found["fatigue"].max()), rel=1e-6
    )


@pytest.mark.slow
@pytest.mark.parametrize("film", ["formula", "solved"])
def test_the_test_gear_has_the_film_of_lines_as_the_pair_has_it(film):
    settings, teeth = teeth_of(film_model=film)
    oil, R, u, w = settings.film().oil.state(363.15), 3.8998e-3, 2.91865, 236.3e3
    E = 2.0 * 210e9 / (2.0 * (1.0 - 0.3**2))  # E' of equal solids
    G, U, W = oil.alpha * E, oil.eta0 * u / (E * R), w / (E * R)
    dowson_toyoda = 3.06 * R * G**0.56 * U**0.69 * W**-0.10
    one = 1.4 * dowson_toyoda / (math.sqrt(math.pi) * 0.5e-6)
    # films that slide are hot and thinner: as solved, and as the usual law of friction takes them
    assert 0.6 * one < teeth.permissible(265.1, 363.15) < 0.95 * one
    if film == "formula":
        cold = permissible_line_ratio(replace(settings.film(), asperities=None), 265.1, 363.15)
        assert cold == pytest.approx(one, rel=1e-3)  # digits of the formula
    rows = json.loads(run_damage(damage_of(teeth=teeth, test_torque=265.1)).attrs["summary"])
    row = next(one for one in rows if one[0] == "micropitting: least film ratio")
    assert row[6].startswith(f"our own film on both ({film})")


def test_without_a_face_factor_the_standard_takes_that_of_the_solved_contact():
    """Lines that grow from 0.8 to 1.2 along the face; of even lines the factor is 1."""
    even = teeth_of()[1]

    def tilted(*at):
        states = even.states(*at)
        tilt = 0.8 + 0.4 * states.place[:, 0] / PAIR.face_width
        return states._replace(load=states.load * tilt)

    for states, face in ((even.states, 1.0), (tilted, 1.198)):
        teeth = even._replace(face=partial(solved_face, PAIR, states))
        found = DamageSettings(pair=teeth, bins=BINS, gears=GEARS)
        assert found.load_factors.face == pytest.approx(face, rel=0.03)
        # the stress goes with the root of the factor, K_H alpha and K_v with the line load
        rated = found.rate(300.0, 262.0, 363.0)
        assert rated.number("K_Hb") == found.load_factors.face
