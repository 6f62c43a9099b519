"""Mesh tables made of a contact dataset: phase, windows, signs, and what does not fit."""

import numpy as np
import pytest
import xarray as xr

from gearlube_core.errors import TableError
from gearlube_core.hypoid_contact.contact_path import contact_path
from gearlube_core.hypoid_contact.contact_table import contact_table, levels_left_out
from gearlube_core.hypoid_contact.pair import FlankPair
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from gearlube_core.mesh_table.kernels import mesh_series, pair_channels, transmission_error
from gearlube_core.mesh_table.netcdf import shipped_mesh_table
from gearlube_core.mesh_table.table import PAIRS, fourier
from tests.helpers.each import each

FILE = HypoidGearFile.named("mohammadpour_2015")
Z_P = 13
POSITIONS = 12
START = -1.5  # mesh phase at pinion angle zero, as docs of the table say: pair 0 mid-window
SIDES = ("drive", "coast")
TORQUES = np.array([20.0, 50.0])
PAIR = np.arange(-2, 3)
ROUND_OFF = 1e-12  # a dozen operations on numbers of order one
SCALE = {"k_m": 3e8, "k_t": 4e8, "R_p": 0.02, "R_g": 0.056, "n_x": 0.5, "n_y": 0.6, "n_z": -0.3}


def hump(p, centre, reach=1.0):
    """Shares over 2 reach mesh periods that sum to one over all pairs, for whole reach."""
    x = np.asarray(p) - centre
    inside = np.abs(x) < reach - 1e-9  # round-off must not make a share of 1e-33 of an end
    return np.where(inside, np.cos(0.5 * np.pi * x / reach) ** 2 / reach, 0.0)


def wave(name, side, torque, phase):
    """A smooth function of the mesh phase, its own for every datum, side and torque."""
    lag = 0.3 if side == "drive" else 1.1
    angle = 2.0 * np.pi * np.asarray(phase)
    ripple = 0.1 * np.cos(angle - lag) + 0.02 * torque / 50.0 * np.sin(3.0 * angle)
    return SCALE[name] * (1.0 + torque / 500.0 + ripple)


def error(side, phase):
    """Unloaded error [m] with an offset that must not matter."""
    angle = 2.0 * np.pi * np.asarray(phase)
    return 4e-6 + (1e-6 if side == "drive" else -2e-6) * (1.0 - np.cos(angle - 0.7))


def place_value(p):
    """A datum of a pair that follows its position."""
    return 0.012 + 1e-3 * np.asarray(p)


def dataset(centre=0.0, reach=1.0, positions=POSITIONS, share=None):
    phase = np.arange(positions) / positions
    state, pairs = ("side", "phase", "torque"), ("side", "phase", "torque", "pair")
    p = phase[:, None] + PAIR
    shape = (len(SIDES), positions, TORQUES.size, PAIR.size)
    share = hump(p, centre, reach) if share is None else share
    share = np.broadcast_to(share[:, None, :], shape)
    where = np.broadcast_to(p[:, None, :], shape)

    def over(name):
        waves = [[wave(name, side, t, phase) for t in TORQUES] for side in SIDES]
        return np.moveaxis(np.array(waves), 1, 2)

    def at_pairs(values):
        return (pairs, np.where(share > 0.0, values, np.nan))

    fine = np.arange(64) / 64
    variables = {name: (state, over(name)) for name in ("k_m", "k_t", "R_p", "R_g")}
    variables["n"] = ((*state, "axis"), np.stack([over(f"n_{a}") for a in "xyz"], axis=-1))
    variables["e"] = (("side", "fine_phase"), np.array([error(s, fine) for s in SIDES]))
    variables["share"] = (pairs, share)
    for name in ("R_x", "R_y", "psi", "entrainment_arm", "friction_arm_p", "friction_arm_g"):
        variables[name] = at_pairs(place_value(where))
    variables["chi"] = at_pairs(place_value(where))
    variables["pressure_max"] = at_pairs(1e9 * place_value(where))
    axis = np.stack([np.where(share > 0.0, place_value(where), np.nan)] * 3, axis=-1)
    variables["xi"] = ((*pairs, "axis"), axis)
    variables["path_contact_ratio"] = (("side",), np.array([1.8, 1.7]))
    return xr.Dataset(
        variables,
        coords={
            "side": list(SIDES),
            "phase": phase,
            "torque": TORQUES,
            "pair": PAIR,
            "axis": ["x", "y", "z"],
        },
    )


def level(table, side, torque):
    return int(np.flatnonzero(table.torque == (torque if side == "drive" else -torque))[0])


def flat_series(table, index):
    """Coefficients of a load level as `mesh_series` takes them: by order, cosine before sine."""
    names = ("k_m", "R_p", "R_g", "n_x", "n_y", "n_z", "e")
    stacked = np.stack([table.series[name][index] for name in names], axis=-1)
    return np.ascontiguousarray(stacked.reshape(-1, len(names))[[0, *range(2, 2 * len(stacked))]])


def flat_window(table, index):
    """Share and sliding direction of a load level, the first node repeated at the end."""
    channels = np.stack([table.windows[name][index] for name in ("share", "xi_x")], axis=-1)
    return np.vstack([channels, channels[:1]]).ravel()


def test_coast_levels_carry_negative_torque_in_rising_order():
    np.testing.assert_array_equal(contact_table(FILE, dataset()).torque, [-50, -20, 20, 50])


@pytest.mark.parametrize("side", SIDES)
@pytest.mark.parametrize("torque", TORQUES)
def test_kernels_give_back_the_samples_at_their_pinion_angles(side, torque):
    table = contact_table(FILE, dataset())
    index = level(table, side, torque)
    coefficients = flat_series(table, index).ravel()
    # at a phase between the samples too: the waves' highest order, 3, is below 12 / 2
    for phase in (0.0, 1.0 / POSITIONS, 7.0 / POSITIONS, 0.413):
        angle = 2.0 * np.pi * (phase - START) / Z_P
        found = mesh_series(coefficients, table.orders, float(Z_P), angle)
        for name in ("k_m", "R_p", "R_g", "n_x", "n_y", "n_z"):
            expected = wave(name, side, torque, phase)
            assert getattr(found, name) == pytest.approx(expected, rel=ROUND_OFF)
        order = np.arange(table.orders + 1)
        cosine, sine = table.series["k_t"][index].T
        total = cosine @ np.cos(order * Z_P * angle) + sine @ np.sin(order * Z_P * angle)
        assert total == pytest.approx(wave("k_t", side, torque, phase), rel=ROUND_OFF)


@pytest.mark.parametrize(("side", "tightest"), [("drive", min), ("coast", max)])
def test_error_is_zero_where_the_flanks_are_tightest(side, tightest):
    """Drive flanks touch first where the gear lags least, coast flanks where it lags most."""
    table = contact_table(FILE, dataset())
    coefficients = flat_series(table, level(table, side, 50.0)).ravel()
    phases = np.arange(64) / 64
    own = error(side, phases)
    for phase, value in zip(phases, own, strict=True):
        angle = 2.0 * np.pi * (phase - START) / Z_P
        found = transmission_error(coefficients, table.orders, float(Z_P), angle)
        assert found == pytest.approx(value - tightest(own), abs=ROUND_OFF * 1e-6)


def test_orders_that_positions_do_not_resolve_are_zero():
    coefficients = fourier(np.array([1.0, 2.0, 4.0, 3.0]), orders=5)
    # with four samples the second order is seen by its cosine alone, so it is left out
    assert np.all(coefficients[2:] == 0.0)
    assert coefficients[0, 0] == pytest.approx(2.5)


# centre of a pair's contact [mesh periods]: mid-window, before it, and so late or early that the
# contact runs over the window's end; all at a position of the dataset
CENTRES = (0.0, -5.0 / POSITIONS, 1.0, -11.0 / POSITIONS, 0.75)


@each("centre", CENTRES)
def test_a_pair_is_found_at_its_own_phase_wherever_the_window_begins(centre):
    table = contact_table(FILE, dataset(centre=centre))
    window = flat_window(table, level(table, "drive", 50.0))
    out = np.zeros(2)
    for position in range(PAIRS * POSITIONS):
        turned = position / POSITIONS  # mesh periods since pinion angle zero
        angle = 2.0 * np.pi * turned / Z_P
        total = 0.0
        for pair in range(PAIRS):
            pair_channels(window, table.nodes, float(Z_P), angle, pair, 2, out)
            total += out[0]
            # the same pair comes back after PAIRS periods, so its phase is known up to them
            phases = turned + pair + START + PAIRS * np.arange(-3, 3)
            expected = hump(phases, centre)
            # 1e-9: pair_channels rounds the angle to a place between two nodes
            assert out[0] == pytest.approx(expected.sum(), abs=1e-9)
            if expected.max() > 1e-6:
                here = place_value(phases[np.argmax(expected)])
                assert out[1] == pytest.approx(here, rel=1e-9)
        assert total == pytest.approx(1.0, abs=1e-9)


@each("centre", CENTRES)
def test_nodes_without_load_hold_the_nearest_loaded_value(centre):
    table = contact_table(FILE, dataset(centre=centre))
    share = table.windows["share"][-1]
    loaded = np.flatnonzero(share > 0.0)
    held = table.windows["R_x"][-1]
    # contact lasts two of three periods: the first and the last loaded place are both held
    first, last = (centre + d * (1.0 - 1.0 / POSITIONS) for d in (-1.0, 1.0))
    empty = np.setdiff1d(np.arange(table.nodes), loaded)
    assert empty.size >= POSITIONS
    known = place_value([first, last])
    for node in empty:
        assert np.min(np.abs(held[node] - known)) < 1e-9
        away = np.abs(node - loaded)
        nearest = loaded[np.argmin(np.minimum(away, table.nodes - away))]
        assert held[node] == held[nearest]


def test_length_of_contact_is_counted_at_the_highest_torque():
    # 2 periods, less the two nodes at which the share is just zero
    ratio = contact_table(FILE, dataset()).contact_ratio
    assert ratio == pytest.approx(2.0 - 1.0 / POSITIONS, abs=1e-12)


def test_pairs_in_contact_over_more_than_the_window_are_refused():
    with pytest.raises(TableError, match="more than 3 mesh periods"):
        contact_table(FILE, dataset(reach=2.0))


def test_a_table_ends_below_the_torque_at_which_too_many_pairs_carry():
    low, high = dataset(), dataset(reach=2.0)
    both = xr.concat(
        [low.sel(torque=TORQUES[:1]), high.sel(torque=TORQUES[1:])], "torque", data_vars="minimal"
    )
    table = contact_table(FILE, both)
    np.testing.assert_array_equal(table.torque, [-TORQUES[0], TORQUES[0]])
    np.testing.assert_array_equal(
        table.windows["share"][1], contact_table(FILE, low).windows["share"][2]
    )
    said = levels_left_out(both)
    assert [one.split(":")[0] for one in said] == ["drive 50 N.m", "coast 50 N.m"]
    assert levels_left_out(low) == []


def test_a_share_too_small_to_matter_is_spread_over_the_other_pairs():
    phase = np.arange(POSITIONS) / POSITIONS
    share = hump(phase[:, None] + PAIR, 0.0)
    share[0, 0] = 0.01  # at phase -2, one per cent outside any window of three periods
    share[0] /= share[0].sum()
    windows = contact_table(FILE, dataset(share=share)).windows["share"]
    sums = windows.reshape(windows.shape[0], PAIRS, POSITIONS).sum(axis=1)
    np.testing.assert_allclose(sums, 1.0, atol=1e-12)


def test_a_flat_or_hollow_gap_along_the_ellipse_counts_as_very_long():
    hollow = dataset()
    hollow["R_y"] = -hollow["R_y"]
    table = contact_table(FILE, hollow)
    assert np.all(table.windows["R_y"] == table.windows["R_y"].flat[0])
    assert table.windows["R_y"].min() > 1.0  # m, longer than any tooth


def test_a_file_with_a_completed_setting_makes_completed_data():
    kinds = {origin.kind for origin in contact_table(FILE, dataset()).provenance.values()}
    assert kinds == {"completed"}
    bare = FILE.model_copy(update={"completed": ()})
    kinds = {origin.kind for origin in contact_table(bare, dataset()).provenance.values()}
    assert kinds == {"inferred"}


@pytest.mark.parametrize(("positions", "orders"), [(8, 5), (20, 5), (48, 12)])
def test_a_table_keeps_one_order_for_every_four_positions(positions, orders):
    """Of 20 positions, order 5 is the last that what folds down from above hardly touches."""
    table = contact_table(FILE, dataset(positions=positions))
    assert table.orders == orders


def test_under_a_light_load_a_pair_meets_on_its_unloaded_path():
    """The shipped table's centres of force against the equations of tangency, on both sides."""
    table = shipped_mesh_table("mohammadpour_2015")
    width, height = table.tooth_size
    life = START + PAIRS * np.arange(table.nodes) / table.nodes
    for side, torque in (("drive", 10.0), ("coast", -10.0)):
        at = int(np.flatnonzero(table.torque == torque)[0])
        pair = FlankPair.from_file(FILE, side)
        alone = table.windows["share"][at] > 0.99
        path = contact_path(pair, life[alone] * pair.gear_pitch)
        assert alone.sum() > 5
        # the ellipse is some mm long: skewness of the gap within it moves its centre by 0.1 mm
        for key, expected in (
            ("tooth_along", width * path.gear_t),
            ("tooth_up", height * path.gear_s),
        ):
            assert table.windows[key][at][alone] == pytest.approx(expected, abs=2e-4)
