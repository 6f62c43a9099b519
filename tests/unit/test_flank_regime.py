"""Regimes of flanks, and nominal points of films."""

import math

import numpy as np
import pytest

from gearlube_core.errors import ParameterError
from gearlube_core.friction import traction_regime as module
from gearlube_core.friction.thermal_eyring_data import ThermalEyringOil, ThermalFlankState
from gearlube_core.friction.traction_regime import EYRING, NEWTONIAN, PLASTIC
from gearlube_core.hypoid_geometry.flank.flank import Flank
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from gearlube_core.hypoid_geometry.measured.measured_flanks import (
    COLUMNS,
    check_nominal_points,
    fit_points,
    read_measured_flanks,
)
from tests.helpers.source_of import interpret, source_of

OIL = ThermalEyringOil(7.0, 360.0, 1.1, 0.55, 2.5e6, 0.0, 0.1, 0.14)
STATE = ThermalFlankState(
    4e-7, 1.1, 6e8, 0.03, 2.0, 9e6, 2e7, 40.0, 30.0, 12.0, 1e-7, 1e-9, 3.0, 20.0, 2.0, 0.05, -1.7,
    5.3, 0.0,
)  # fmt: skip
GLASS, BARUS = 138.0, 9.67  # K, of the law of Houpert


def place(state=STATE, limiting=1e9, modulus=1e8):
    return source_of(module.flank_regime)(state, OIL, limiting, modulus, 2.5e-4)


def test_flank_stands_where_its_film_at_the_surfaces_temperature_does(monkeypatch):
    interpret(monkeypatch, module)
    found = place()
    hot = 360.0 + 12.0  # the surfaces, not the oil
    inlet = 7.0 * ((hot - GLASS) / (360.0 - GLASS)) ** -1.1
    pressed = inlet * (1.0 + 5.1e-9 * 6e8) ** 0.55
    beta = 1.1 * pressed / (hot - GLASS)
    assert found.pressure_number == pytest.approx(pressed - inlet, rel=1e-9)
    film = math.log(2.0 * 0.14 / (beta * (2.5e6 * 4e-7) ** 2)) + inlet - BARUS
    assert found.film_number == pytest.approx(film, rel=1e-9)
    eta = math.exp(pressed - BARUS)
    newtonian = eta * 1.7 / (2.5e6 * 4e-7)
    assert found.slip_number == pytest.approx(newtonian, rel=1e-9)
    # heat takes what the isothermal film would have beyond 9 MPa
    loss = 1.0 - 9e6 / 2.5e6 / math.asinh(newtonian)
    assert found.thermal_loss == pytest.approx(loss, rel=1e-9)
    assert found.thermal == (1.0 if loss > 0.1 else 0.0)
    assert found.deborah_number == pytest.approx(eta * 5.3 / (1e8 * 2.5e-4), rel=1e-9)
    s = found.largest_stress_ratio
    # s sinh s = 4 X*^2 exp(L), X*^2 = 0.4392
    L = found.pressure_number + found.film_number
    assert s * math.sinh(s) == pytest.approx(4.0 * 0.43922884 * math.exp(L), rel=1e-7)
    assert (found.limit, found.state) == (EYRING, EYRING)


def test_film_yields_where_it_reaches_the_limiting_stress(monkeypatch):
    interpret(monkeypatch, module)
    largest = place().largest_stress_ratio * 2.5e6
    assert (place(limiting=1.001 * largest).limit, place(limiting=0.999 * largest).limit) == (
        EYRING,
        PLASTIC,
    )
    assert (place(limiting=8.99e6).state, place(limiting=9.01e6).state) == (PLASTIC, EYRING)


@pytest.mark.parametrize(("slip", "state"), [(1e-6, NEWTONIAN), (1.7, EYRING), (0.0, NEWTONIAN)])
def test_slow_sliding_leaves_a_film_newtonian(monkeypatch, slip, state):
    interpret(monkeypatch, module)
    found = place(STATE._replace(sliding_speed=slip, shear_stress=1e3))
    assert found.state == state
    assert found.limit == EYRING
    if slip == 0.0:
        assert found.thermal_loss == found.thermal == 0.0


FILE = HypoidGearFile.named("mohammadpour_2015")
S, T = np.linspace(0.27, 0.92, 5), np.linspace(0.08, 0.92, 9)


def points(file=FILE, role="gear", side="drive", rotation=0.7, shift=11e-3):
    """Points of a flank in a frame turned and shifted from that of the pair, z along the axis."""
    flank = Flank.from_file(file, role, side)
    r = flank.grid(S, T).r - flank.axis_point
    # the pinion's axis is x of the pair, the gear's z; both away from the crossing point
    x, y, z = (r[..., k] for k in ((1, 2, 0) if role == "pinion" else (0, 1, 2)))
    c, s = np.cos(rotation), np.sin(rotation)
    return np.stack([c * x - s * y, s * x + c * y, z - shift], axis=-1)


@pytest.fixture
def csv(tmp_path):
    def write(grid, role="gear", side="drive", skip=None):
        lines = [",".join(COLUMNS)]
        for (i, j), _ in np.ndenumerate(grid[..., 0]):
            if (i, j) != skip:
                place = ",".join(f"{1e3 * value:.6f}" for value in grid[i, j])
                lines.append(f"{role},{side},{i + 1},{j + 1},{place}")
        path = tmp_path / "nominal.csv"
        path.write_text("\n".join(lines))
        return path

    return write


@pytest.mark.parametrize(("role", "side"), [("gear", "drive"), ("pinion", "coast")])
def test_points_are_found_on_their_flank_after_a_rotation_and_a_shift(csv, role, side):
    fit = fit_points(Flank.from_file(FILE, role, side), points(role=role, side=side))
    assert fit.rms < 1e-12  # points of the surface itself: roundings of a decimetre
    assert fit.shift == pytest.approx(11e-3, abs=1e-10)
    found = check_nominal_points(csv(points(role=role, side=side), role, side), FILE)[role, side]
    # written to a nanometre
    np.testing.assert_allclose(found.s, S, atol=1e-5)
    np.testing.assert_allclose(found.t, T, atol=1e-5)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (lambda p: p * [1.0, -1.0, 1.0], "Their mirror image fits: set pair.pinion_hand to left"),
        (lambda p: p * [1.0, -1.0, -1.0], "They fit with z the other way round"),
        (lambda p: p / 25.4, "They fit as inches"),
        (lambda p: points(side="coast"), "They fit the coast flank"),
    ],
)
def test_wrong_points_are_named(csv, change, words):
    with pytest.raises(ParameterError, match=words):
        check_nominal_points(csv(change(points())), FILE)


def test_points_of_a_left_handed_pair_are_those_of_the_mirror_image(csv):
    left = FILE.varied({"pair.pinion_hand": "left"})
    found = check_nominal_points(csv(points() * [1.0, -1.0, 1.0]), left)["gear", "drive"]
    np.testing.assert_allclose(found.s, S, atol=1e-5)
    with pytest.raises(ParameterError, match=r"set pair\.pinion_hand to right"):
        check_nominal_points(csv(points()), left)


def test_points_of_other_machine_settings_are_refused_with_how_far_they_are_off(csv):
    tilt = FILE.pinion.machine.tilt_angle_deg + 0.1
    other = points(FILE.varied({"pinion.machine.tilt_angle_deg": tilt}), "pinion")
    with pytest.raises(ParameterError, match=r"within 2 um .* up to 9\.\d+ um off\. Check the"):
        check_nominal_points(csv(other, "pinion"), FILE)


def test_missing_points_and_rows_from_the_tip_down_are_refused(csv):
    with pytest.raises(ParameterError, match=r"all 5 x 9 nominal points .* 1 are missing"):
        check_nominal_points(csv(points(), skip=(2, 3)), FILE)
    with pytest.raises(ParameterError, match=r"rows .* must rise from root to tip"):
        check_nominal_points(csv(points()[::-1]), FILE)


def test_deviations_need_no_described_grid_beside_nominal_points(csv):
    folder = csv(points()).parent
    lines = [f"gear,drive,1,{i + 1},{j + 1},{j - 4.0}" for i in range(5) for j in range(9)]
    head = "member,flank,tooth,row,column,deviation_um"
    (folder / "deviations.csv").write_text("\n".join([head, *lines]))
    (folder / "one.toml").write_text(
        'name = "one"\nsource = "made"\ngear_file = "mohammadpour_2015"\n'
        'deviations = "deviations.csv"\nnominal_points = "nominal.csv"\n'
    )
    found = read_measured_flanks(folder / "one.toml").gear_file().correction("gear", "drive")
    # a slope of 8 um over the columns
    removed = found.bends(np.array([0.5, 0.5]), T[[0, -1]], 1.0, 1.0).value
    np.testing.assert_allclose(removed, [4e-6, -4e-6], atol=1e-9)
