"""Outputs and friction of the axle's flanks against sums by hand over three tooth pairs."""

from types import SimpleNamespace

import numpy as np
import pytest

from gearlube_core.dynamics.hypoid_mesh import flank_outputs, flanks, tooth_pair
from gearlube_core.dynamics.hypoid_mesh.mesh_force import MeshMotion
from gearlube_core.dynamics.hypoid_mesh.node_films import N_FILMS
from gearlube_core.dynamics.packed_mesh import N_CHANNELS
from gearlube_core.dynamics.ranges import LEAST_FILM_RATIO
from gearlube_core.film.groups import point_contact_groups
from gearlube_core.friction.flank_data import FlankState
from gearlube_core.friction.flank_film import NO_MODEL_FILM, BoundedFlank
from gearlube_core.oil.lubricant_state import LubricantState
from tests.helpers.source_of import source_of

OIL = LubricantState(0.02, 1.8e-8, 0.04, 2.5e-5, 3e6, 0.0, 0.07, 0.14, 350.0, 1.74e6, 1.8e-8)
OIL_TEMPERATURE = 350.0
FORCE = -2000.0  # N, on the coast flanks
SHARES = np.array([0.3, 0.0, 0.7])
FIRST = 4  # place of the first output
# the rows are share, R_e, side flow, pressure, entrainment arm, arms, direction of sliding, and of
# the line that rolls radius, length over load^(1/3) and arm of the entrainment across it; then the
# ellipse: its other radius, ellipticity, angles of entrainment and of sliding from there
PAIRS = np.array(
    [
        [0.3, 0.011, 0.9, 2.1e7, -0.021, 0.012, 0.035, 0.6, -0.48, 0.64, 0.010, 1.1e-3, 0.013,
         0.51, 13.0, 0.7, 0.2],
        [0.0, 0.013, 0.7, 2.3e7, 0.023, 0.017, 0.031, 0.8, 0.36, 0.48, 0.011, 1.2e-3, 0.015,
         0.52, 14.0, 0.8, 0.3],
        [0.7, 0.017, 0.8, 2.7e7, 0.029, -0.019, 0.041, -0.36, 0.8, 0.48, 0.012, 1.3e-3, -0.018,
         0.53, 15.0, 0.9, 0.4],
    ]
)  # fmt: skip
NO_MODEL = np.zeros(0)
WINDOW = np.concatenate([PAIRS, PAIRS[:1]]).ravel()


def moving():
    """A motion at pinion angle zero, where pair i is at node i of the window."""
    return MeshMotion(0.0, 0.0, 150.0, 60.0, 0.0, 0.0, 0.0, 0.7, -1.2, 0.9)


def parameters(friction=1.0, rolling=0.0):
    return SimpleNamespace(
        mesh=SimpleNamespace(z_p=13.0), friction=friction, reduced_modulus=2.3e11, flank_law="law",
        rolling=rolling, ratio=2.4,
    )  # fmt: skip


def sliding_of(row):
    """Speed of the pinion's surface over the gear's along xi."""
    return row[5] * 150.0 - row[6] * 60.0 + row[7:10] @ np.array([0.7, -1.2, 0.9])


def flank_under(load, film_ratio=2.0):
    """Made-up film and friction that tell the loads apart; f = 0.05 F viscous, 0.01 F boundary.

    Half of a load above 1 kN lies outside the film model's domain.
    """
    state = FlankState(
        3e-10 * load, film_ratio, 0.05 * load, 0.01 * load, 0.06, 0.01 * load, 5e5 * load
    )
    return BoundedFlank(state, 0.5 if load > 1e3 else 0.0, 0.02, 0.03)


def with_made_up_flanks(monkeypatch):
    monkeypatch.setattr(tooth_pair, "pair_friction", lambda s, load, *_: flank_under(load))
    monkeypatch.setattr(flanks, "flank_coefficients", source_of(tooth_pair.flank_coefficients))


def written(monkeypatch, friction=1.0, film_ratio=2.0, shares=SHARES, force=FORCE):
    """Outputs behind and before the flanks', and the most loaded flank."""

    def pair_friction(s, load, sliding, channels, oil, law, film, film_model):
        i = int(np.argmin(np.abs(PAIRS[:, 1] - channels[1])))
        assert load == pytest.approx(abs(force) * shares[i], rel=1e-14)
        assert sliding == pytest.approx(sliding_of(PAIRS[i]), rel=1e-12)
        return flank_under(load, film_ratio)

    monkeypatch.setattr(flank_outputs, "pair_friction", pair_friction)
    monkeypatch.setattr(flank_outputs, "flank_film", source_of(tooth_pair.flank_film))
    out = np.full(FIRST + 22, -7.0)
    window = np.concatenate([PAIRS, PAIRS[:1]])
    window[:3, 0], window[3, 0] = shares, shares[0]
    found = source_of(flank_outputs.write_flanks)(
        moving(), force, window.ravel(), 3, OIL_TEMPERATURE, OIL, parameters(friction), NO_MODEL,
        tooth_pair.EXACT, np.zeros(N_FILMS), FIRST, FIRST + 16, np.zeros(N_CHANNELS), out,
    )  # fmt: skip
    assert np.all(out[:FIRST] == -7.0)
    assert out[FIRST + 15] == -7.0
    on = out[FIRST : FIRST + 15 : 5] > 0.0
    bounds = out[FIRST + 16 :].reshape(3, 2)
    np.testing.assert_array_equal(bounds, np.outer(on, [0.02, 0.03 * friction]))
    return out[FIRST : FIRST + 15].reshape(3, 5), found


def test_outputs_of_every_flank(monkeypatch):
    names = [name for name in flank_outputs.FLANK_OUTPUTS if name.endswith("].load")]
    assert names == ["flank[1].load", "flank[2].load", "flank[3].load"]
    rows, found = written(monkeypatch)
    for row, load in zip(rows, (600.0, 0.0, 1400.0), strict=True):
        on = load > 0.0
        temperature = OIL_TEMPERATURE + 0.01 * load
        np.testing.assert_allclose(
            row, [load, 3e-10 * load, 2.0 * on, 0.06 * on, temperature], rtol=1e-14
        )
    assert found.temperature == pytest.approx(OIL_TEMPERATURE + 14.0, rel=1e-14)
    assert found.outside == pytest.approx(0.5 * 1400.0 / 2000.0, rel=1e-14)


@pytest.mark.parametrize("shares", [SHARES, np.array([0.6, 0.4, 0.0]), np.array([0.2, 0.5, 0.3])])
def test_ranges_are_those_of_the_flank_with_most_load(monkeypatch, shares):
    rows, found = written(monkeypatch, shares=shares)
    most = int(np.argmax(shares))
    load = 2000.0 * shares[most]
    groups = point_contact_groups(
        viscosity=OIL.eta0,
        pressure_viscosity=OIL.alpha,
        entrainment_speed=abs(PAIRS[most, 4]) * 150.0,
        load=load,
        radius=PAIRS[most, 1],
        reduced_modulus=2.3e11,
    )
    assert found.film_load == pytest.approx(groups.M, rel=1e-12)
    assert found.film_material == pytest.approx(groups.L, rel=1e-12)
    film, pressure = 3e-10 * load, 5e5 * load
    # L of Evans and Johnson: alpha p + ln 2 K eta0/(beta (tau0 h)^2)
    traction = 1.8e-8 * pressure + np.log(2.0 * 0.14 * 0.02 / (0.04 * (3e6 * film) ** 2))
    assert found.traction == pytest.approx(traction, rel=1e-12)
    assert found.pressure == pytest.approx(1.5 * pressure, rel=1e-14)  # of Hertz' ellipse
    assert found.temperature == rows[most, 4]


def test_axle_without_friction_has_films_at_the_oil_temperature(monkeypatch):
    rows, found = written(monkeypatch, friction=0.0)
    np.testing.assert_allclose(rows[:, 1], [1.8e-7, 0.0, 4.2e-7], rtol=1e-14)
    assert np.all(rows[:, 3] == 0.0)
    assert np.all(rows[:, 4] == OIL_TEMPERATURE)
    assert found.traction == 0.0
    assert found.temperature == OIL_TEMPERATURE
    assert found.film_load > 0.0


def test_film_formulas_are_out_of_use_where_roughness_carries(monkeypatch):
    found = written(monkeypatch, film_ratio=0.9 * LEAST_FILM_RATIO)[1]
    assert found[:3] == (0.0, 0.0, 0.0)
    assert found.pressure == pytest.approx(1.5 * 5e5 * 1400.0, rel=1e-14)


def test_flanks_that_hardly_touch_have_films_and_ranges_too(monkeypatch):
    rows, found = written(monkeypatch, force=-0.1)
    np.testing.assert_allclose(rows[:, 1], [9e-12, 0.0, 2.1e-11], rtol=1e-14)
    assert found.pressure == pytest.approx(1.5 * 5e5 * 0.07, rel=1e-14)


def test_no_flank_stands_out_without_load(monkeypatch):
    rows, found = written(monkeypatch, shares=np.zeros(3))
    assert found == (0.0,) * 6
    np.testing.assert_array_equal(rows, [[0.0, 0.0, 0.0, 0.0, OIL_TEMPERATURE]] * 3)


def test_law_meets_load_speeds_and_geometry_of_its_flank(monkeypatch):
    met = []
    monkeypatch.setattr(tooth_pair, "bounded_flank", lambda *arguments: met.append(arguments))
    monkeypatch.setattr(tooth_pair, "model_film", lambda *arguments: met.append(arguments))
    arguments = moving(), 600.0, -0.7, PAIRS[0], OIL, "law"
    source_of(tooth_pair.pair_friction)(*arguments, NO_MODEL_FILM, NO_MODEL)
    source_of(tooth_pair.pair_film)(*arguments, NO_MODEL)
    for law, load, entrainment, sliding, geometry, _, oil, model in met:
        assert (law, load, sliding, oil, model is NO_MODEL) == ("law", 600.0, -0.7, OIL, True)
        assert entrainment == pytest.approx(-0.021 * 150.0, rel=1e-14)
        assert tuple(geometry) == (0.011, 0.9, 2.1e7)
    assert met[0][5] is NO_MODEL_FILM
    assert tuple(met[1][5]) == (0.010, 0.51, 13.0, 0.7, 0.2)


@pytest.mark.parametrize("force", [FORCE, 0.1])
@pytest.mark.parametrize("fresh", [1.0, 0.0])
def test_friction_of_all_flanks_is_the_sum_of_forces_against_sliding(monkeypatch, fresh, force):
    with_made_up_flanks(monkeypatch)
    # viscous and boundary of each flank, then what rolls, which is off
    kept = np.zeros(flanks.N_FRICTION)
    kept[:9] = 0.02, 0.04, 0.03, 0.05, 0.07, 0.11, 9.0, 9.0, 9.0
    kept[flanks.BOUND : flanks.BOUND + 3] = 0.001, 0.002, 0.003
    mu = kept[:6].reshape(3, 2) if fresh == 0.0 else np.array([[0.05, 0.01]] * 3)
    s = moving()
    found = source_of(flanks.flank_sum)(
        s, force, WINDOW, 3, OIL, parameters(), fresh, kept, np.zeros(N_CHANNELS), NO_MODEL
    )
    expected = np.zeros(8)
    for row, load, coefficients in zip(PAIRS, abs(force) * SHARES, mu, strict=True):
        sliding = sliding_of(row)
        f = np.sign(sliding) * coefficients.sum() * load
        expected[:2] += -f * row[5], f * row[6]
        expected[2:5] -= f * row[7:10]
        expected[5:7] += coefficients * load * abs(sliding)
    np.testing.assert_allclose(found, expected, rtol=1e-12)
    # the work of torques and forces is what is lost
    given = found.torque_p * 150.0 + found.torque_g * 60.0
    given += np.array(found[2:5]) @ np.array([0.7, -1.2, 0.9])
    assert given == pytest.approx(-found.viscous_power - found.boundary_power, rel=1e-12)
    # one flank slides forward and one backward, or the signs would not count
    assert sliding_of(PAIRS[0]) * sliding_of(PAIRS[2]) < 0.0
    if fresh != 0.0:
        np.testing.assert_allclose(kept[:6], [0.05, 0.01, 0.0, 0.0, 0.05, 0.01], rtol=1e-14)
    bounds = [0.03 * 0.06] * 3 if fresh != 0.0 else [0.001, 0.002, 0.003]
    lost = [
        bound * abs(force) * share * abs(sliding_of(row))
        for bound, share, row in zip(bounds, SHARES, PAIRS, strict=True)
    ]
    assert kept[flanks.BOUND_POWER] == pytest.approx(sum(lost), rel=1e-12)


@pytest.mark.parametrize(("force", "friction"), [(0.0, 1.0), (FORCE, 0.0)])
@pytest.mark.parametrize("fresh", [1.0, 0.0])
def test_no_friction_without_force_or_with_friction_off(force, friction, fresh):
    kept = np.full(flanks.N_FRICTION, 0.05)
    found = source_of(flanks.flank_sum)(
        moving(), force, WINDOW, 3, OIL, parameters(friction), fresh, kept, np.zeros(N_CHANNELS),
        NO_MODEL,
    )  # fmt: skip
    assert found == (0.0,) * 8
    # a touch before the next refresh uses what stands there
    np.testing.assert_array_equal(kept[: flanks.BOUND_POWER], 0.0 if fresh else 0.05)
    assert kept[flanks.BOUND_POWER] == 0.0


@pytest.mark.parametrize("friction", [0.0, 1.0])
@pytest.mark.parametrize("turning", [1.0, -1.0])
@pytest.mark.parametrize("fresh", [1.0, 0.0])
def test_rolling_takes_two_forces_times_the_entrainment_across_the_line(
    monkeypatch, fresh, turning, friction
):
    met = []

    def force_of(load, rolling, sliding, *_):
        met.append((load, rolling, sliding))
        return 2e-3 * load

    monkeypatch.setattr(flanks, "pair_rolling", force_of)
    with_made_up_flanks(monkeypatch)
    motion = moving()._replace(w_p=150.0 * turning, w_g=60.0 * turning)
    kept = np.zeros(flanks.N_FRICTION)
    kept[6:9] = 1.2, 7.0, 2.8
    arguments = motion, FORCE, WINDOW, 3, OIL
    with_it, without = (
        source_of(flanks.flank_sum)(
            *arguments, parameters(friction, rolling), fresh, kept, np.zeros(N_CHANNELS), NO_MODEL
        )
        for rolling in (1.0, 0.0)
    )
    found = np.subtract(with_it, without)
    # mean of both shafts' entrainment, 0.5 (150 + 2.4 60) rad/s of the pinion
    mean = 0.5 * (150.0 + 2.4 * 60.0)
    forces = 2e-3 * 600.0, 2e-3 * 1400.0
    lost = sum(2.0 * F * arm * mean for F, arm in zip(forces, (0.013, 0.018), strict=True))
    # roundings of friction powers of 1 kW
    assert found[7] == pytest.approx(lost, rel=1e-10)
    np.testing.assert_allclose(found[2:7], 0.0, atol=1e-10)
    assert (found[0] * 150.0 + found[1] * 60.0) * turning == pytest.approx(-lost, rel=1e-10)
    assert found[0] * turning < 0.0
    if fresh != 0.0:
        assert [(load, abs(rolling)) for load, rolling, _ in met] == [
            (600.0, pytest.approx(0.013 * mean)), (1400.0, pytest.approx(0.018 * mean)),
        ]  # fmt: skip
        assert kept[7] == 0.0


def test_sliding_speed_has_the_relative_velocity_along_the_direction_of_sliding():
    for row in PAIRS:
        found = source_of(tooth_pair.sliding_speed)(moving(), row)
        assert found == pytest.approx(sliding_of(row), rel=1e-13)
