"""The mesh table: its files, its refusals, its kernels, and the table that ships."""

import math
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace

import numpy as np
import pytest
import xarray as xr
from axle_cases import with_coast_flanks

from gearlube_core.blank.hypoid_blank import HypoidBlank
from gearlube_core.contact.elliptical_hertz import hertz_ellipse
from gearlube_core.errors import TableError
from gearlube_core.materials.solid import STEEL_MOHAMMADPOUR_2015, contact_modulus
from gearlube_core.mesh_table.kernels import (
    N_SERIES,
    E,
    blend_levels,
    load_bracket,
    mesh_series,
    pair_channels,
    transmission_error,
)
from gearlube_core.mesh_table.netcdf import read_mesh_table, write_mesh_table
from gearlube_core.mesh_table.table import SERIES_UNITS, WINDOW_UNITS, MeshTable, Provenance
from gearlube_core.tooth_contact.inferred_table import inferred_mesh_table

TABLE = MeshTable.named("mohammadpour_2015")
Z_P, Z_G = 13, 36
MODULUS = contact_modulus(STEEL_MOHAMMADPOUR_2015, STEEL_MOHAMMADPOUR_2015)
KEYS = (*SERIES_UNITS, *WINDOW_UNITS)


def data(table, key):
    return table.series[key] if key in SERIES_UNITS else table.windows[key]


def with_datum(key, values):
    group = "series" if key in SERIES_UNITS else "windows"
    return {group: {**getattr(TABLE, group), key: values}}


def without_datum(key):
    group = "series" if key in SERIES_UNITS else "windows"
    return {group: {k: v for k, v in getattr(TABLE, group).items() if k != key}}


def test_a_table_written_and_read_is_the_same_table_to_the_bit(tmp_path):
    kinds = ("table", "inferred", "completed")
    settings = {"positions": 31, "base_depth": 2.5e-3, "tool": "Gleason 9 in", "note-1.a": ""}
    varied = replace(
        TABLE,
        name="varied",
        source="rear axle, größer.toml",
        settings=settings,
        provenance={key: Provenance(kinds[i % 3], f"eq. ({i})") for i, key in enumerate(KEYS)},
    )
    read = read_mesh_table(write_mesh_table(varied, tmp_path / "sub" / "table.nc"))
    assert (read.name, read.pinion_teeth, read.gear_teeth) == ("varied", Z_P, Z_G)
    assert read.contact_ratio == TABLE.contact_ratio
    assert read.provenance == varied.provenance
    assert (read.source, read.settings) == (varied.source, settings)
    np.testing.assert_array_equal(read.torque, TABLE.torque)
    for key in KEYS:
        np.testing.assert_array_equal(data(read, key), data(TABLE, key))
    assert [path.name for path in (tmp_path / "sub").iterdir()] == ["table.nc"]


def test_every_datum_in_a_file_carries_its_unit(tmp_path):
    with xr.open_dataset(write_mesh_table(TABLE, tmp_path / "table.nc")) as dataset:
        units = {key: dataset[key].attrs["units"] for key in KEYS}
    assert units == {**SERIES_UNITS, **WINDOW_UNITS}


@pytest.mark.parametrize("key", KEYS)
def test_a_missing_datum_is_named(key):
    with pytest.raises(TableError, match=f"lacks '{key}'"):
        replace(TABLE, **without_datum(key))


@pytest.mark.parametrize("key", KEYS)
def test_a_datum_that_is_not_finite_is_named(key):
    for bad in (math.nan, math.inf):
        values = data(TABLE, key).copy()
        values.flat[-1] = bad
        with pytest.raises(TableError, match=f"'{key}' holds a NaN or an infinity"):
            replace(TABLE, **with_datum(key, values))


@pytest.mark.parametrize("key", KEYS)
def test_a_datum_with_fewer_load_levels_is_named(key):
    with pytest.raises(TableError, match=f"'{key}' has shape .* 7 load levels first"):
        replace(TABLE, **with_datum(key, data(TABLE, key)[1:]))


@pytest.mark.parametrize("key", ["R_p", "e", "R_x", "xi_z"])
def test_a_datum_of_another_length_than_the_first_is_named(key):
    with pytest.raises(TableError, match=f"'{key}' has shape"):
        replace(TABLE, **with_datum(key, data(TABLE, key)[:, 1:]))


@pytest.mark.parametrize("key", KEYS)
def test_a_datum_without_origin_is_named(key):
    others = {k: v for k, v in TABLE.provenance.items() if k != key}
    for origin in ({}, {key: Provenance("inferred", "")}, {key: Provenance("guessed", "so")}):
        with pytest.raises(TableError, match=f"'{key}' needs a provenance"):
            replace(TABLE, provenance={**others, **origin})


def test_shares_that_do_not_sum_to_one_are_refused():
    share = TABLE.windows["share"].copy()
    share[2, 20] += 1e-6
    with pytest.raises(TableError, match="load shares must sum to 1, off by 1e-06"):
        replace(TABLE, **with_datum("share", share))


def test_a_window_that_three_pairs_cannot_divide_is_refused():
    windows = {key: values[:, :-1] for key, values in TABLE.windows.items()}
    with pytest.raises(TableError, match="needs 3 n nodes, got 191"):
        replace(TABLE, windows=windows)


@pytest.mark.parametrize("contact_ratio", [3.01, 0.9, math.nan])
def test_a_contact_ratio_beyond_three_pairs_is_refused(contact_ratio):
    with pytest.raises(TableError, match="contact_ratio must be within 1 to 3, got"):
        replace(TABLE, contact_ratio=contact_ratio)


@pytest.mark.parametrize(
    "torque",
    [
        TABLE.torque[::-1],
        np.append(TABLE.torque[:-1], math.nan),
        np.append(TABLE.torque[:-1], math.inf),
        TABLE.torque[[0, 0, 1, 2, 3, 4, 5]],
        np.array([]),
        np.array(50.0),
    ],
    ids=["falling", "nan", "inf", "repeated", "empty", "scalar"],
)
def test_load_levels_must_rise_and_be_finite(torque):
    with pytest.raises(TableError, match="torque must be a rising list"):
        replace(TABLE, torque=torque)


@pytest.mark.parametrize("torque", [-TABLE.torque[::-1], np.arange(-3.0, 4.0)])
def test_the_drive_flanks_need_data_and_no_level_stands_at_zero(torque):
    with pytest.raises(TableError, match=r"a level above 0 N\.m and none at 0 N\.m"):
        replace(TABLE, torque=torque)


@pytest.mark.parametrize("key", ["k_m", "R_p", "R_g", "k_t", "R_x", "R_y"])
def test_what_must_be_positive_is_told_with_its_load(key):
    values = data(TABLE, key).copy()
    values[2, 0] *= -1.0
    with pytest.raises(TableError, match=rf"'{key}' must be above 0, got -.* at 20 N\.m"):
        replace(TABLE, **with_datum(key, values))


def test_a_share_below_zero_is_refused_even_where_the_sum_is_one():
    share = TABLE.windows["share"].copy()
    share[0, 10] -= 2.0
    share[0, 10 + TABLE.nodes // 3] += 2.0
    with pytest.raises(TableError, match="load shares must not be below 0, got -"):
        replace(TABLE, **with_datum("share", share))


@pytest.mark.parametrize("teeth", [{"pinion_teeth": 0}, {"gear_teeth": -36}])
def test_a_gear_without_teeth_is_refused(teeth):
    with pytest.raises(TableError, match="numbers of teeth must be at least 1"):
        replace(TABLE, **teeth)


@pytest.mark.parametrize("settings", [{"a b": 1.0}, {"": "x"}, {"a": [1.0]}, {"a/b": 1.0}])
def test_a_setting_that_no_file_can_hold_is_refused(settings):
    with pytest.raises(TableError, match="a setting must be a text or a number"):
        replace(TABLE, settings=settings)


def test_beyond_its_contact_a_pair_holds_the_nearest_loaded_value():
    """Else the first interval of contact would be interpolated from nothing."""
    share = TABLE.windows["share"][0]
    loaded = np.flatnonzero(share > 0.0)
    for key in set(WINDOW_UNITS) - {"share"}:
        values = TABLE.windows[key].T
        first, last = loaded[0], loaded[-1]
        # contact ends between two of 155 nodes: the value there differs by that much at most
        limit = 0.05 * np.ptp(values) + 1e-15
        np.testing.assert_allclose(values[:first] - values[first], 0.0, rtol=0, atol=limit)
        np.testing.assert_allclose(values[last + 1 :] - values[last], 0.0, rtol=0, atol=limit)


def test_highest_pressure_is_that_of_hertz_under_the_share_of_the_load():
    ellipse = hertz_ellipse(
        TABLE.windows["R_x"][3, 70], TABLE.windows["R_y"][3, 70], MODULUS,
        TABLE.windows["share"][3, 70] * 50.0 / TABLE.mean("R_p", 50.0),
    )  # fmt: skip
    # peak over mean pressure of an ellipse: 3/2
    assert TABLE.windows["pressure_max"][3, 70] == pytest.approx(1.5 * ellipse[2], rel=1e-12)


def test_an_unknown_table_is_refused_with_the_names_that_ship():
    with pytest.raises(TableError, match=r"called 'no_such'\. Shipped: mohammadpour_2015"):
        MeshTable.named("no_such")


def spoiled(path, change):
    """The shipped table, changed by `change(dataset)`, as a file."""
    write_mesh_table(TABLE, path)
    with xr.open_dataset(path) as dataset:
        changed = change(dataset.load())
    changed.to_netcdf(path, engine="scipy")
    return path


def without_attribute(name):
    def change(dataset):
        del dataset.attrs[name]
        return dataset

    return change


def of_format(number):
    def change(dataset):
        dataset.attrs["gearlube_mesh_table"] = number
        return dataset

    return change


def without_origin(dataset):
    del dataset["R_y"].attrs["provenance"]
    return dataset


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda d: d.drop_vars(["psi"]), "lacks psi"),
        (lambda d: d.drop_vars(["torque"]), "lacks torque"),
        (without_attribute("contact_ratio"), "lacks contact_ratio"),
        (without_attribute("gearlube_mesh_table"), "is not a gearlube mesh table"),
        (of_format("two"), "is not a gearlube mesh table"),
        (of_format(1), "older gearlube: .* format 1, .* format 2. Run `gearlube contact` again"),
        (of_format(3), "newer gearlube: .* format 3, .* format 2. Install that version"),
        (without_origin, "'R_y' needs a provenance"),
    ],
    ids=["window", "torque", "attribute", "format", "word", "older", "newer", "provenance"],
)
def test_an_incomplete_file_says_what_it_lacks(tmp_path, change, message):
    with pytest.raises(TableError, match=message):
        read_mesh_table(spoiled(tmp_path / "table.nc", change))


def test_a_file_that_is_no_netcdf_is_refused(tmp_path):
    path = tmp_path / "table.nc"
    path.write_text("not a table", encoding="utf-8")
    with pytest.raises(TableError, match=r"table\.nc is not a readable NetCDF 3 file"):
        read_mesh_table(path)


def test_a_file_that_is_not_there_is_told_with_its_name_and_who_writes_one(tmp_path):
    for name in (tmp_path / "absent.nc", tmp_path):
        with pytest.raises(TableError, match=rf"No mesh table .* {name}: .*`gearlube contact`"):
            read_mesh_table(name)


def test_the_shipped_table_is_the_one_inferred_from_the_blank():
    again = inferred_mesh_table(HypoidBlank.named("mohammadpour_2015"))
    assert again.provenance == TABLE.provenance
    np.testing.assert_array_equal(again.torque, TABLE.torque)
    for key in KEYS:
        stored = data(TABLE, key)
        # another libm may round differently; coefficients that vanish are rounding of the largest
        limit = 1e-12 * np.abs(stored).max()
        np.testing.assert_allclose(data(again, key), stored, rtol=1e-12, atol=limit)


def test_every_datum_of_the_shipped_table_is_inferred_and_says_how():
    assert set(TABLE.provenance) == set(KEYS)
    for origin in TABLE.provenance.values():
        assert origin.kind == "inferred"
        assert len(origin.derivation) > 20


def test_mean_transmission_error_is_that_of_the_paper():
    """0.96 um, Karagiannis et al. 2012, at every load: it is the unloaded one."""
    # 512 samples of a parabola with a kink: 2/512^2 = 8e-6 of the mean
    np.testing.assert_allclose(TABLE.series["e"][:, 0, 0], 0.96e-6, rtol=1e-5)


def test_mean_stiffness_at_fifty_newton_metres_follows_from_the_printed_damping():
    """c = 2278.1 N s/m = 2 zeta sqrt(k0 m_eq), zeta = 0.03, Karagiannis et al. 2012."""
    R_p = TABLE.mean("R_p", 50.0)
    R_g = R_p * Z_G / Z_P
    inertance = R_p**2 / 1.734e-3 + R_g**2 / 5.81e-2
    k0 = (2278.1 / (2 * 0.03)) ** 2 * inertance
    # 512 samples of engagements with a kink in the slope: about 1/512^3
    assert TABLE.mean("k_m", 50.0) == pytest.approx(k0, rel=1e-7)


def test_stiffness_rises_with_load_but_slower_than_a_hertzian_point():
    k = TABLE.series["k_m"][:, 0, 0]
    slope = np.diff(np.log(k)) / np.diff(np.log(TABLE.torque))
    assert np.all(slope > 0.0)
    assert np.all(slope < 1 / 3)


def series_at(key, phi, level=0):
    c = TABLE.series[key][level]
    angle = np.outer(phi, Z_P * np.arange(c.shape[0]))
    return np.cos(angle) @ c[:, 0] + np.sin(angle) @ c[:, 1]


def test_transmission_error_is_the_integral_of_the_ratio_mismatch():
    """e(phi) - e(0) = integral of R_p - R_g z_p/z_g, by the trapezoidal rule."""
    phi = np.linspace(0.0, 2 * np.pi / Z_P, 20001)
    mismatch = series_at("R_p", phi) - series_at("R_g", phi) * Z_P / Z_G
    steps = 0.5 * (mismatch[1:] + mismatch[:-1]) * np.diff(phi)
    e = series_at("e", phi)
    # trapezoidal error of the fifth order: (10 pi/20000)^2/12 = 2e-7 of the swing
    np.testing.assert_allclose(np.cumsum(steps), e[1:] - e[0], rtol=0, atol=1e-6 * np.ptp(e))


def test_between_two_and_three_pairs_carry_load_over_the_contact_ratio():
    share = TABLE.windows["share"][0]
    loaded = (share > 0.0).reshape(3, -1).sum(axis=0)
    assert loaded.min() == math.floor(TABLE.contact_ratio)
    assert loaded.max() == math.ceil(TABLE.contact_ratio) <= 3
    # nodes 1/64 of a pitch apart; a share of exactly zero at the window's first node
    assert loaded.mean() == pytest.approx(TABLE.contact_ratio, abs=1 / 64)


def direct_sum(coefficients, orders, phi):
    """Values and slopes of all series from the definition, shape (N_SERIES,) each."""
    c = coefficients.reshape(2 * orders + 1, N_SERIES)
    value, slope = c[0].copy(), np.zeros(N_SERIES)
    for h in range(1, orders + 1):
        w = h * Z_P
        value += c[2 * h - 1] * math.cos(w * phi) + c[2 * h] * math.sin(w * phi)
        slope += w * (c[2 * h] * math.cos(w * phi) - c[2 * h - 1] * math.sin(w * phi))
    return value, slope


@pytest.mark.parametrize("orders", [0, 1, 5, 12])
@pytest.mark.parametrize("phi", [0.0, 0.1234, -0.4, 40.0])
def test_series_and_slopes_are_those_of_the_fourier_sum(orders, phi):
    coefficients = np.random.default_rng(orders).normal(size=N_SERIES * (2 * orders + 1))
    found = mesh_series(coefficients, orders, float(Z_P), phi)
    value, slope = direct_sum(coefficients, orders, phi)
    # recurrence over at most 12 orders, angle of 520 rad: 12 x 520 roundings of order 1
    atol = 1e-12 * (1 + orders)
    np.testing.assert_allclose(found[:6], value[:6], rtol=0, atol=atol)
    np.testing.assert_allclose(found[6:], slope[[0, 3, 4, 5, 6]], rtol=0, atol=200 * atol)


def test_slopes_are_the_finite_differences_of_the_values():
    coefficients = np.random.default_rng(3).normal(size=N_SERIES * 11)
    h = 1e-6
    low, middle, high = (
        mesh_series(coefficients, 5, float(Z_P), 0.3 + d * h) for d in (-1.0, 0.0, 1.0)
    )
    for name in ("k_m", "n_x", "n_y", "n_z"):
        difference = (getattr(high, name) - getattr(low, name)) / (2 * h)
        # third derivative (65/rad)^3 h^2/6 = 5e-8; rounding 1e-16/h = 1e-10; ten terms of order 1
        assert getattr(middle, f"d{name}") == pytest.approx(difference, abs=1e-6)


@pytest.mark.parametrize("torque", [0.0, 3.0, 5.0, 7.5, 10.0, 49.9, 123.0, 400.0, 900.0, -123.0])
def test_between_load_levels_data_are_linear_and_outside_held(torque):
    packed = np.random.default_rng(1).normal(size=(7, 4))
    out = np.empty(4)
    bracket = load_bracket(torque, math.copysign(1.0, torque), TABLE.torque, 7)
    blend_levels(packed.ravel(), 4, bracket, out)
    expected = [np.interp(abs(torque), TABLE.torque, column) for column in packed.T]
    # rounding of one linear interpolation of numbers of order 1
    np.testing.assert_allclose(out, expected, rtol=0, atol=1e-14)
    assert TABLE.mean("k_m", torque) == np.interp(
        abs(torque), TABLE.torque, TABLE.series["k_m"][:, 0, 0]
    )


@pytest.mark.parametrize("torque", [-900.0, -400.0, -123.0, -5.0, -1.0, 0.0, 1.0, 49.9, 900.0])
def test_levels_of_the_other_sign_are_never_read(torque):
    """Between the smallest levels of either side nothing is interpolated."""
    both = with_coast_flanks(TABLE)
    own = np.sign(both.torque) == (-1.0 if torque < 0.0 else 1.0)
    bracket = load_bracket(torque, math.copysign(1.0, torque), both.torque, both.torque.size)
    out = np.empty(1)
    for key in ("k_m", "R_p", "e"):
        means = np.ascontiguousarray(both.series[key][:, 0, 0])
        blend_levels(means, 1, bracket, out)
        expected = np.interp(abs(torque), *_rising(np.abs(both.torque[own]), means[own]))
        # rounding of one linear interpolation
        assert out[0] == pytest.approx(expected, rel=1e-14)
        assert both.mean(key, torque) == pytest.approx(expected, rel=1e-14)


def _rising(x, y):
    order = np.argsort(x)
    return x[order], y[order]


def test_transmission_error_is_the_series_that_is_stored():
    phi = np.linspace(-1.0, 3.0, 11)
    coefficients = np.zeros((2 * TABLE.orders + 1, N_SERIES))
    e = TABLE.series["e"][0]
    coefficients[0, E], coefficients[1::2, E], coefficients[2::2, E] = e[0, 0], e[1:, 0], e[1:, 1]
    found = [transmission_error(coefficients.ravel(), TABLE.orders, float(Z_P), p) for p in phi]
    # recurrence over five orders, angles of 40 rad
    np.testing.assert_allclose(found, series_at("e", phi), rtol=0, atol=1e-12 * 3e-6)


def test_a_single_load_level_serves_every_load():
    for torque in (0.0, 50.0, 500.0):
        for side in (1.0, -1.0):
            assert load_bracket(torque, side, np.array([50.0]), 1) == (0, 0, 0.0)


def test_a_pair_enters_contact_at_phase_zero_and_leaves_after_the_contact_ratio():
    share = np.append(TABLE.windows["share"][0], TABLE.windows["share"][0, 0])
    out = np.zeros(1)

    def at(periods, pair):
        pair_channels(share, TABLE.nodes, float(Z_P), periods * 2 * math.pi / Z_P, pair, 1, out)
        return out[0]

    assert at(0.0, 0) == 0.0
    assert at(0.1, 0) > 0.0
    assert at(TABLE.contact_ratio - 0.1, 0) > 0.0
    # one node, 1/64 period, of linear interpolation past the end
    assert at(TABLE.contact_ratio + 1 / 64, 0) == 0.0
    # pair 1 stands where pair 0 will stand one period on
    assert at(0.3, 1) == pytest.approx(at(1.3, 0), rel=1e-12)


def test_tables_can_be_read_by_several_threads_at_once():
    def read(_):
        return MeshTable.named(TABLE.name).contact_ratio

    # eight at a time, often: a library that must not be entered twice crashes the process
    with ThreadPoolExecutor(8) as pool:
        ratios = list(pool.map(read, range(200)))
    assert set(ratios) == {TABLE.contact_ratio}
