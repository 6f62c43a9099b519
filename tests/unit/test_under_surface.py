"""Under the surface of flanks, and the film of the test gear, in a damage run."""

import json
import math
from dataclasses import replace

import numpy as np
import pytest

from drivetrain.axle_file.read_axle import read_axle
from gearlube.damage.permissible_film import permissible_ratio
from gearlube.damage.report import damage_report, findings
from gearlube.damage.run import run_damage
from gearlube.damage.settings import DamageSettings, together
from gearlube_core.contact.dang_van import FatigueLimits
from gearlube_core.errors import ParameterError
from gearlube_core.rating.spectrum import DutyBins
from gearlube_core.rating.subsurface import CaseHardening, line_shear_amplitude

SURFACE, CORE, DEPTH = 720.0, 342.0, 0.8e-3
CASE = CaseHardening(SURFACE, CORE, DEPTH)
LIMITS = FatigueLimits(bending=640e6, torsion=400e6)
BINS = DutyBins(
    np.array([300.0, -60.0]), np.array([100.0, 200.0]), np.array([363.15, 353.15]),
    np.array([3.6e5, 3.6e5]),
)  # fmt: skip


@pytest.fixture(scope="module")
def car():
    return read_axle("mohammadpour_2015")


@pytest.fixture(scope="module")
def run(car):
    def made(axle=car.axle, bins=BINS, **given):
        return run_damage(DamageSettings(car=replace(car, axle=axle), bins=bins, **given))

    return made


@pytest.fixture(scope="module")
def smooth(run, car):
    """The run without friction."""
    return run(replace(car.axle, friction="off"), case=CASE, fatigue=LIMITS)


def johnson_amplitude(depth):
    """Greatest amplitude of shear over planes, under a line load with p0 = 1 and a = 1.

    Stresses of [johnson_1985 (4.49)], in closed form.
    """
    x, z = np.linspace(-40.0, 40.0, 40_001), depth
    part = 1.0 - x * x + z * z
    root = np.sqrt(part * part + 4.0 * x * x * z * z)
    m, n = np.sqrt(0.5 * (root + part)), np.sign(x) * np.sqrt(0.5 * (root - part))
    share = (z * z + n * n) / (m * m + n * n)
    xx, zz = -(m * (1.0 + share) - 2.0 * z), -m * (1.0 - share)
    xz = n * (m * m - z * z) / (m * m + n * n)
    turned = np.linspace(0.0, math.pi, 361)[:, None]
    return 0.5 * np.ptp(0.5 * (zz - xx) * np.sin(turned) + xz * np.cos(turned), axis=1).max()


def test_a_line_load_has_its_greatest_shear_where_hertz_has_it(smooth):
    """0.300 p0 at 0.786 a, and the amplitude on planes along the flank 0.250 p0 at 0.5 a."""
    z = smooth["depth"].values
    for side in ("drive", "coast"):
        of_side = smooth.sel(side=side)
        for name, of, share, at in (
            ("greatest_shear", "fatigue", 0.300, 0.786),
            ("shear_amplitude", "fracture", 0.250, 0.5),
        ):
            p, a = 1e3 * float(of_side[f"{of}_pressure"]), float(of_side[f"{of}_half_width"])
            # planes of 2 degrees and a grid of a/24: 0.5 %; depths are 4 % apart
            assert float(of_side[name].max()) == pytest.approx(share * p, rel=0.005)
            found = z[np.nanargmax(of_side[name].values)]
            assert found == pytest.approx(at * a, abs=0.06 * a)


@pytest.mark.slow
def test_utilisation_is_that_of_a_hand_calculation(smooth):
    of_side = smooth.sel(side="drive")
    p, a = 1e9 * float(of_side["fracture_pressure"]), 1e-3 * float(of_side["fracture_half_width"])
    for wanted in (1.0e-3, 2.0e-3):
        i = int(np.abs(1e-3 * smooth["depth"].values - wanted).argmin())
        z = 1e-3 * float(smooth["depth"][i])
        x = z / DEPTH
        HV = CORE + (SURFACE - CORE) * 10.0 ** (-0.0381 * x - 0.2662 * x * x)
        expected = p * johnson_amplitude(z / a) / (0.4e6 * HV) + 0.04
        # planes of 2 degrees and a grid of a/24
        assert float(of_side["fracture_profile"][i]) == pytest.approx(expected, rel=0.005)


@pytest.mark.slow
def test_deep_below_the_shear_is_that_of_a_narrow_load():
    """As 1/depth. At 8 half widths the width is still felt, by 1 %, and the grid is 0.3 % off."""
    for depth in (10.0, 15.0, 20.0):
        found = float(line_shear_amplitude(np.array(depth), np.array(1.0), np.array(1.0)))
        assert found == pytest.approx(johnson_amplitude(depth), rel=0.015)


def test_flank_fracture_needs_the_depth_of_the_contact(smooth):
    of_side = smooth.sel(side="drive")
    above = smooth["depth"] < of_side["fracture_half_width"]
    assert np.isnan(of_side["fracture_profile"].values[above.values]).all()
    assert np.isfinite(of_side["fracture_profile"].values[~above.values]).all()


def test_the_worst_of_bins_profile_and_map_is_one_number(smooth):
    # depths are 4 % apart and the top is flat, and cells of the map lie between lines: 1 %
    for name, profile in (("fracture", "fracture_profile"), ("fatigue", "fatigue_bound_profile")):
        for k, side in enumerate(("drive", "coast")):
            of_bin = float(smooth[name][k])
            assert float(smooth[profile].sel(side=side).max()) == pytest.approx(of_bin, rel=0.01)
            assert float(smooth[f"{name}_map"].sel(side=side).max()) == pytest.approx(
                of_bin, rel=0.01
            )


def test_a_shallower_case_uses_up_more_of_the_strength(run):
    used = [
        float(run(case=CASE._replace(case_depth=depth))["fracture"].max())
        for depth in (1.2e-3, 0.8e-3, 0.4e-3)
    ]
    assert used[0] < used[1] < used[2]


def test_dang_van_without_compression_is_the_amplitude_of_shear_over_the_limit(smooth, run):
    p = smooth["fatigue_pressure"].values
    bound = smooth["fatigue_bound_profile"].max("depth").values
    np.testing.assert_allclose(bound, 0.250 * 1e9 * p / 400e6, rtol=0.01)
    helped = smooth["fatigue_profile"].max("depth").values
    assert (helped < 0.7 * bound).all()
    # friction acts on the surface: deep below, it raises the number by little
    rubbed = run(fatigue=LIMITS)
    raised = rubbed["fatigue_bound_profile"].max("depth") / rubbed["fatigue_pressure"] * p / bound
    assert (raised.values > 1.0).all()
    assert (raised.values < 1.01).all()


def test_rows_have_the_safety_of_stress(smooth):
    rows = {row[0]: row for row in json.loads(smooth.attrs["summary"])}
    used = float(smooth["fracture_profile"].sel(side="drive").max())
    row = rows["flank fracture, drive: A_FF"]
    assert float(row[3]) == pytest.approx(0.96 / (used - 0.04), rel=5e-3)  # three digits
    assert (row[2], row[5]) == ("1", "fails")
    assert row[1].endswith("mm deep")
    assert rows["fatigue under the surface, coast: compression does not help"][5] == "safe"


def test_without_hardness_and_limits_nothing_is_said_of_the_depth(run):
    found = run()
    assert "depth" not in found.dims
    assert not any("fracture" in str(name) or "fatigue" in str(name) for name in found.data_vars)
    said = next(one for one in findings(found) if "damage under the surface" in one.headline)
    for option in ("--surface-hv", "--core-hv", "--case-depth-mm", "--torsion-limit-mpa"):
        assert option in said.detail


def test_a_side_without_load_has_no_row(run, tmp_path):
    bins = DutyBins(*(one[:1] for one in BINS))
    settings = DamageSettings(car=read_axle("mohammadpour_2015"), bins=bins, fatigue=LIMITS)
    found = run_damage(settings, folder=tmp_path)
    rows = [row[0] for row in json.loads(found.attrs["summary"])]
    assert [row for row in rows if row.startswith("fatigue")] == [
        "fatigue under the surface, drive: compression helps",
        "fatigue under the surface, drive: compression does not help",
    ]
    report = damage_report(found, tmp_path / "figures")
    assert [one.name for one in report.figures] == ["maps_drive", "under_surface"]


def test_the_film_of_the_test_gear_is_that_of_the_formula(car):
    """Chittenden's central film of a slender ellipse, at point A of the C-GF gear at stage 10."""
    oil, E = car.axle.oil.state(363.15), 210e9 / (2.0 * (1.0 - 0.3**2))  # E* of equal solids
    R, w, u = 3.8998e-3, 236.3e3, 0.5 * (1.0538 + 4.7835)
    a = math.sqrt(4.0 * w * R / (math.pi * E))
    F = 4.0 / 3.0 * w * 1.0339 * 100.0**0.636 * a  # Hamrock and Brewe: b/a within 6 %
    G, U, W = (2.0 * oil.alpha * E, oil.eta0 * u / (2.0 * E * R), F / (2.0 * E * R * R))
    film = 4.31 * R * U**0.68 * G**0.49 * W**-0.073
    expected = 1.4 * film / (math.sqrt(math.pi) * 0.5e-6)
    # 6 % of the load are 0.4 % of the film
    assert permissible_ratio(car.axle, 265.1, 363.15) == pytest.approx(expected, rel=0.01)


def test_a_solved_film_is_compared_with_a_solved_film_alone(car, run):
    solved = replace(car.axle, film="solved")
    at = (265.1, 363.15)
    assert permissible_ratio(solved, *at) < 0.95 * permissible_ratio(car.axle, *at)
    assert math.isnan(permissible_ratio(solved, 900.0, 363.15))  # 2.7 GPa
    found = run(solved, test_torque=900.0)
    row = next(row for row in json.loads(found.attrs["summary"]) if "micropitting" in row[0])
    assert (row[2], row[5]) == ("", "no limit given")
    assert any("outside the model of solved films" in one.headline for one in findings(found))


def test_safety_against_micropitting_is_the_least_film_over_the_permissible_one(run, car):
    def row(**given):
        found = run(**given)
        return found, next(one for one in json.loads(found.attrs["summary"]) if "film" in one[0])

    found, given = row(test_torque=265.1)
    least = float(found["film_ratio"].min()) / permissible_ratio(car.axle, 265.1, 363.15)
    assert float(given[3]) == pytest.approx(least, rel=5e-3)  # three digits
    assert given[6] == "our own film on both (formula), in the manner of ISO/TS 6336-22, method A"
    # a test with warmer flanks had a thinner film, which permits more
    assert float(row(test_torque=265.1, test_bulk=400.85)[1][3]) > 1.5 * float(given[3])
    none, given = row()
    assert given[2:6] == ["", "", "", "no limit given"]
    assert any("--micropitting-torque-nm" in one.detail for one in findings(none))


def test_some_numbers_without_the_others_are_refused(car):
    with pytest.raises(ParameterError, match=r"together, got --a 1.0, --b None\. Give"):
        together({"--a": 1.0, "--b": None}, "Give both.")
    assert together({"--a": None, "--b": None}, "") == []
    with pytest.raises(ParameterError, match="surface must be within 342 to 1200 HV"):
        DamageSettings(car=car, bins=BINS, case=CASE._replace(surface=200.0))
    with pytest.raises(ParameterError, match="test_bulk"):
        DamageSettings(car=car, bins=BINS, test_torque=265.1, test_bulk=800.0)
