"""Wear in steps: volume against Archard's integral, and what worn flanks do to the contact."""

import json
from dataclasses import replace

import numpy as np
import pytest
import xarray as xr

from drivetrain.axle_file.read_axle import gear_file_of, read_axle
from gearlube.damage import wear_steps
from gearlube.damage.report import damage_report
from gearlube.damage.run import run_damage
from gearlube.damage.settings import DamageSettings
from gearlube.damage.wear_steps import (
    depths,
    spline_areas,
    spread,
    wear_in_steps,
    worn_gears,
)
from gearlube_core.dynamics.hypoid_axle.flank_states import flank_states
from gearlube_core.errors import ParameterError
from gearlube_core.hypoid_contact.contact_dataset import ContactSettings
from gearlube_core.hypoid_contact.loaded_contact import LoadedSettings
from gearlube_core.hypoid_contact.mesh_cycle import CycleSettings
from gearlube_core.hypoid_contact.strips import StripSettings
from gearlube_core.hypoid_geometry.flank.correction import WORN_GRID, worn_splines
from gearlube_core.hypoid_geometry.flank.flank import Flank
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from gearlube_core.mesh_table.netcdf import read_mesh_table
from gearlube_core.rating.spectrum import DutyBins

K = 5e-18  # 1/Pa
HEIGHT, WIDTH = 7.6e-3, 30e-3
# 15 h at 350 N.m, 600 rpm, 90 degC: some 3 um of all load at the worst place of both members
BIN = DutyBins(*(np.array([one]) for one in (350.0, 62.8, 363.15, 15.0 * 3600.0)))
COARSE = ContactSettings(
    cycle=CycleSettings(
        positions=8, torques=(200.0, 350.0),
        loaded=LoadedSettings(strips=StripSettings(cells_across=16, cells_along=32)),
    )
)  # fmt: skip


@pytest.fixture(scope="module")
def car():
    return read_axle("mohammadpour_2015")


@pytest.fixture(scope="module")
def gears():
    return gear_file_of("mohammadpour_2015")


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("wear")  # positions of the new flank are solved once


@pytest.fixture(scope="module")
def wears(car, gears, folder):
    def made(**given):
        usual = {"wear_coefficient": K, "wear_of_all_load": True, "wear_steps": 9}
        settings = DamageSettings(car=car, bins=BIN, gear_file=gears, **(usual | given))
        return wear_in_steps(settings, contact=COARSE, folder=folder, jobs=1)

    return made


@pytest.fixture(scope="module")
def worn(wears):
    return wears(wear_step=2e-6)


@pytest.fixture(scope="module")
def worn_table(worn, folder):
    table = read_mesh_table(folder / "worn.nc")
    assert HypoidGearFile.from_toml(folder / "worn.toml").gear.drive_flank is not None
    return table


def test_volume_is_archards_whatever_the_edges_cut_off(car, gears):
    """The gear's flank loses k times load times sliding: the friction energy over mu, times k."""
    states = flank_states(car.axle, torque=350.0, speed=62.8, temperature=363.15)
    period = 2.0 * np.pi / (62.8 * gears.pinion.teeth)
    rubbed = (states.load * states.sliding).sum() * states.share_of_time * period  # N.m in a pass
    area = spline_areas(Flank.from_file(gears, "gear", "drive"))
    volumes = K * states.load * states.sliding * states.share_of_time * period
    coefficients = spread(states, volumes, car.axle.mesh.tooth_size) / area
    # independent of splines: depth on fine cells times the area of the flank under each
    s, t = (np.arange(n) + 0.5 for n in (200, 400))
    r = Flank.from_file(gears, "gear", "drive").grid(s / 200.0, t / 400.0).r
    cell = np.linalg.norm(np.cross(np.gradient(r, axis=0), np.gradient(r, axis=1)), axis=-1)
    up, along = worn_splines(s / 200.0, WORN_GRID[0]), worn_splines(t / 400.0, WORN_GRID[1])
    lost = float((up @ coefficients @ along.T * cell).sum())
    # both areas are sums over cells of a smooth flank
    assert lost == pytest.approx(K * rubbed, rel=2e-3)


@pytest.mark.slow
def test_smooth_wear_is_deep_where_the_new_flank_wears(car, worn):
    """Beside the depth of the lines, which no spline smooths: k w s over the speed of the flank."""
    states = flank_states(car.axle, torque=350.0, speed=62.8, temperature=363.15)
    passes = float(BIN.revolutions[0]) / car.axle.mesh.ratio
    sharp = K * states.line_load * states.sliding / states.gear_speed * passes
    first = float(worn["worn_rate"][0, 0, 1])
    # splines of 0.8 x 1.4 mm flatten the ridge of a contact 10 mm long by some per cent, and lines
    # that an edge of the tooth cuts off are deeper than the ellipse
    assert first == pytest.approx(1e6 * sharp.max(), rel=0.15)


@pytest.mark.slow
def test_worn_flanks_spread_the_load(car, worn, worn_table):
    """Less pressure by the ellipse of the worn flank, and by the cells of its solved contact."""
    profile = worn["worn_profile"].values[[0, -1], 0]
    assert profile[1].max() < profile[0].max()
    assert (worn["worn_depth"].values[:, 1] == 0.0).all()  # no coast bins
    at = {"torque": 350.0, "speed": 62.8, "temperature": 363.15}
    new = flank_states(car.axle, **at)
    found = flank_states(replace(car.axle, mesh=worn_table), **at)
    inside = np.linspace(0.3, 0.6, 7)  # mesh periods in which no edge of a tooth presses

    def mean(states, values):
        return np.interp(inside, states.phase, values).mean()

    cells = mean(found, found.table_pressure)
    assert cells < mean(new, new.table_pressure)
    # the ellipse has the curvature of one point, cells that of the whole line: on the new flank
    # both differ by 3 %
    assert mean(found, found.pressure) == pytest.approx(cells, rel=0.08)


@pytest.mark.slow
def test_no_step_takes_more_than_it_may_and_all_end_with_the_life(worn):
    life, rate = worn["worn_life"].values, worn["worn_rate"].values[:, 0]
    assert life[0] == 0.0
    assert life[-1] == 1.0
    steps = np.diff(life)[:, None] * rate[:-1]
    # the worst place of the sum is at most the sum of the worst places
    assert (steps.max(axis=1) <= 2.0).all()
    assert 2 <= steps.shape[0] <= 4
    np.testing.assert_allclose(np.diff(worn["worn_depth"].values[:, 0], axis=0), steps, rtol=0.05)


@pytest.mark.slow
def test_half_the_step_gives_the_same_depth(wears, worn):
    half = wears(wear_step=1e-6)
    assert half.sizes["step"] > worn.sizes["step"]
    # the rate falls by some per cent in a step, and the depth errs by half of that
    np.testing.assert_allclose(
        half["worn_depth"].values[-1, 0], worn["worn_depth"].values[-1, 0], rtol=0.02
    )


@pytest.mark.slow
def test_without_wear_a_step_changes_nothing(wears):
    found = wears(wear_coefficient=0.0, wear_steps=1)
    assert found.sizes["step"] == 2
    for name in ("worn_pressure", "worn_error", "worn_profile", "worn_depth"):
        np.testing.assert_array_equal(found[name][0], found[name][1])


@pytest.mark.slow
def test_steps_that_do_not_reach_the_end_say_so(wears):
    found = wears(wear_step=2e-6, wear_steps=1)
    life = float(found["worn_life"][-1])
    assert 0.0 < life < 1.0
    both = life * found["worn_rate"].values[0, 0].sum()
    assert both == pytest.approx(2.0, rel=0.1)  # worst places of both members are not the same


@pytest.fixture
def rigid(car, monkeypatch):
    """The contact stays that of the new flank, whatever wears."""
    found = xr.Dataset({
        "rotation": (("side", "phase", "torque"), np.zeros((2, 4, 1))),
        "R_p": (("side", "phase", "torque"), np.ones((2, 4, 1))),
    })  # fmt: skip
    monkeypatch.setattr(wear_steps, "analyse_contact", lambda *given, **named: found)
    monkeypatch.setattr(wear_steps, "contact_table", lambda *given: car.axle.mesh)


@pytest.mark.slow
@pytest.mark.parametrize(("most", "step"), [(1, 1e-4), (40, 0.4e-6)])
def test_with_the_same_contact_steps_add_up_to_the_rate_of_the_new_flank(
    car, gears, rigid, most, step
):
    settings = DamageSettings(
        car=car, bins=BIN, gear_file=gears, wear_coefficient=K, wear_of_all_load=True,
        wear_steps=most, wear_step=step,
    )  # fmt: skip
    found = wear_in_steps(settings)
    assert float(found["worn_life"][-1]) == 1.0
    np.testing.assert_allclose(found["worn_depth"][-1], found["worn_rate"][0], rtol=1e-9)
    np.testing.assert_allclose(found["worn_map"].max(("up", "along")), found["worn_depth"][-1])


@pytest.mark.slow
def test_run_with_steps_has_rows_words_figure_and_worn_gears(car, gears, rigid, tmp_path):
    settings = DamageSettings(
        car=car, bins=BIN, gear_file=gears, wear_coefficient=K, wear_of_all_load=True,
        wear_steps=2,
    )  # fmt: skip
    found = run_damage(settings, folder=tmp_path)
    life = float(found["worn_life"][-1])
    assert 0.0 < life < 1.0
    rows = {row[0]: row for row in json.loads(found.attrs["summary"])}
    assert rows["wear, pinion"][5] == "see the steps"
    assert rows["wear after 2 steps, gear"][5] == f"{100.0 * life:.0f} % of the life"
    report = damage_report(found, tmp_path / "figures")
    assert "wear_steps" in [one.name for one in report.figures]
    told = next(one for one in report.findings if one.headline.startswith("After 2 steps"))
    assert told.level == "warning"
    assert f"about {2.0 / life:.0f} steps" in told.detail
    worn = HypoidGearFile.from_toml(tmp_path / "worn.toml").correction("gear", "drive")
    places = np.random.default_rng(0).uniform(0.0, 1.0, (2, 500))
    # 2 um of both at the worst place, which these places may miss
    assert 1.8e-6 < worn.bends(*places, HEIGHT, WIDTH).value.max() < 2.01e-6
    assert read_mesh_table(tmp_path / "worn.nc").name == car.axle.mesh.name


def test_worn_gears_are_a_gear_file_that_wears_on(gears):
    lost = np.zeros((2, *WORN_GRID))
    assert worn_gears(gears, lost) is gears
    lost[0] += 1e-6
    once = worn_gears(gears, lost)
    twice = worn_gears(once, lost)
    assert once.correction("gear", "coast").is_none
    places = np.random.default_rng(0).uniform(0.0, 1.0, (2, 20))
    for file, depth in ((once, 1e-6), (twice, 2e-6)):
        bends = file.correction("gear", "drive").bends(*places, HEIGHT, WIDTH)
        np.testing.assert_allclose(bends.value, depth, rtol=1e-9)
    np.testing.assert_allclose(depths(lost)[0], 1e-6)


def test_bad_wear_is_refused(car, gears):
    with pytest.raises(ParameterError, match="got mohammadpour_2015, None and 5e-18"):
        DamageSettings(car=car, bins=BIN, wear_coefficient=K, wear_steps=2)
    with pytest.raises(ParameterError, match="mohammadpour_2015 and None"):
        DamageSettings(car=car, bins=BIN, gear_file=gears, wear_steps=2)
