"""The mesh table: its files, its refusals, its kernels, and the table that ships."""

import math
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace

import numpy as np
import pytest
import xarray as xr

from gearlube_core.errors import TableError
from gearlube_core.mesh_table.kernels import (
    N_SERIES,
    E,
    blend_levels,
    load_bracket,
    mesh_series,
    pair_channels,
    transmission_error,
)
from gearlube_core.mesh_table.netcdf import read_mesh_table, shipped_mesh_table, write_mesh_table
from gearlube_core.mesh_table.table import SERIES_UNITS, TOOTH_UNITS, WINDOW_UNITS, Provenance
from tests.helpers.axle_cases import drive_only, with_coast_flanks
from tests.helpers.each import each

SHIPPED = shipped_mesh_table("mohammadpour_2015")
TABLE = drive_only(SHIPPED)
LEVELS = TABLE.torque.size
Z_P = 13
KEYS = (*SERIES_UNITS, *WINDOW_UNITS, *TOOTH_UNITS)


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
    assert (read.name, read.pinion_teeth, read.gear_teeth) == ("varied", Z_P, 36)
    assert read.contact_ratio == TABLE.contact_ratio
    assert read.provenance == varied.provenance
    assert (read.source, read.settings) == (varied.source, settings)
    assert read.tooth_size == TABLE.tooth_size
    np.testing.assert_array_equal(read.torque, TABLE.torque)
    for key in KEYS:
        np.testing.assert_array_equal(data(read, key), data(TABLE, key))
    assert [path.name for path in (tmp_path / "sub").iterdir()] == ["table.nc"]


def test_a_table_may_lack_places_on_the_tooth_and_refuses_a_tooth_without_size(tmp_path):
    windows = {key: values for key, values in TABLE.windows.items() if key not in TOOTH_UNITS}
    bare = replace(TABLE, windows=windows, tooth_size=None)
    read = read_mesh_table(write_mesh_table(bare, tmp_path / "bare.nc"))
    assert (read.has_tooth_places, read.tooth_size) == (False, None)
    assert TABLE.has_tooth_places
    with pytest.raises(TableError, match="tooth_size must be face width and height above 0 m"):
        replace(TABLE, tooth_size=(0.03, 0.0))


def test_every_datum_in_a_file_carries_its_unit(tmp_path):
    with xr.open_dataset(write_mesh_table(TABLE, tmp_path / "table.nc")) as dataset:
        units = {key: dataset[key].attrs["units"] for key in KEYS}
    assert units == {**SERIES_UNITS, **WINDOW_UNITS, **TOOTH_UNITS}


@each("key", KEYS)
def test_a_missing_datum_is_named(key):
    with pytest.raises(TableError, match=f"lacks '{key}'"):
        replace(TABLE, **without_datum(key))


@each("key", KEYS)
def test_a_datum_that_is_not_finite_is_named(key):
    for bad in (math.nan, math.inf):
        values = data(TABLE, key).copy()
        values.flat[-1] = bad
        with pytest.raises(TableError, match=f"'{key}' holds a NaN or an infinity"):
            replace(TABLE, **with_datum(key, values))


@each("key", KEYS)
def test_a_datum_with_fewer_load_levels_is_named(key):
    with pytest.raises(TableError, match=f"'{key}' has shape .* {LEVELS} load levels first"):
        replace(TABLE, **with_datum(key, data(TABLE, key)[1:]))


@pytest.mark.parametrize("key", ["R_p", "e", "R_x", "xi_z"])
def test_a_datum_of_another_length_than_the_first_is_named(key):
    with pytest.raises(TableError, match=f"'{key}' has shape"):
        replace(TABLE, **with_datum(key, data(TABLE, key)[:, 1:]))


@each("key", KEYS)
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
    with pytest.raises(TableError, match=f"needs 3 n nodes, got {TABLE.nodes - 1}"):
        replace(TABLE, windows=windows)


@pytest.mark.parametrize("contact_ratio", [3.01, 0.9, math.nan])
def test_a_contact_ratio_beyond_three_pairs_is_refused(contact_ratio):
    with pytest.raises(TableError, match="contact_ratio must be within 1 to 3, got"):
        replace(TABLE, contact_ratio=contact_ratio)


@each(
    "torque",
    [
        TABLE.torque[::-1],
        np.append(TABLE.torque[:-1], math.nan),
        np.append(TABLE.torque[:-1], math.inf),
        np.append(TABLE.torque[0], TABLE.torque[:-1]),
        np.array([]),
        np.array(50.0),
    ],
)
def test_load_levels_must_rise_and_be_finite(torque):
    with pytest.raises(TableError, match="torque must be a rising list"):
        replace(TABLE, torque=torque)


@pytest.mark.parametrize("torque", [-TABLE.torque[::-1], np.arange(LEVELS) - 3.0])
def test_the_drive_flanks_need_data_and_no_level_stands_at_zero(torque):
    with pytest.raises(TableError, match=r"a level above 0 N\.m and none at 0 N\.m"):
        replace(TABLE, torque=torque)


@each("key", ["k_m", "R_p", "R_g", "k_t", "R_x", "R_y"])
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


def test_an_unknown_table_is_refused_with_the_names_that_ship():
    with pytest.raises(TableError, match=r"called 'no_such'\. Shipped: mohammadpour_2015"):
        shipped_mesh_table("no_such")


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


@each(
    ("change", "message"),
    [
        (lambda d: d.drop_vars(["psi"]), "lacks psi"),
        (lambda d: d.drop_vars(["torque"]), "lacks torque"),
        (without_attribute("contact_ratio"), "lacks contact_ratio"),
        (without_attribute("gearlube_mesh_table"), "is not a gearlube mesh table"),
        (of_format("two"), "is not a gearlube mesh table"),
        (of_format(1), "older gearlube: .* format 1, .* formats 2 and 3. Run `gearlube contact`"),
        (of_format(4), "newer gearlube: .* format 4, .* formats 2 and 3. Install that version"),
        (without_origin, "'R_y' needs a provenance"),
    ],
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
    absent = rf"mesh table absent\.nc was not found in {tmp_path}\. .*`gearlube contact`"
    with pytest.raises(TableError, match=absent):
        read_mesh_table(tmp_path / "absent.nc")
    with pytest.raises(TableError, match=rf"mesh table {tmp_path} .*folder.*`gearlube contact`"):
        read_mesh_table(tmp_path)


def test_every_datum_of_the_shipped_table_says_where_it_is_from():
    assert set(SHIPPED.provenance) == set(KEYS)
    for origin in SHIPPED.provenance.values():
        # no tooth contact is printed; some settings that shape it had to be completed
        assert origin.kind == "completed"
        assert len(origin.derivation) > 20
    assert SHIPPED.has_coast_levels


@each("level", range(SHIPPED.torque.size))
def test_beyond_its_contact_a_pair_holds_the_nearest_loaded_value(level):
    """Else the first interval of contact would be interpolated from nothing."""
    share = SHIPPED.windows["share"][level]
    loaded = np.flatnonzero(share > 0.0)
    for i in np.flatnonzero(share == 0.0):
        away = np.abs(loaded - i)
        away = np.minimum(away, share.size - away)
        near = loaded[away == away.min()]
        for key in set(WINDOW_UNITS) - {"share"}:
            values = SHIPPED.windows[key][level]
            assert values[i] in values[near]


def test_one_period_on_each_pair_stands_where_the_next_one_stood():
    share = np.append(TABLE.windows["share"][3], TABLE.windows["share"][3, 0])
    out = np.zeros(1)

    def at(periods, pair):
        pair_channels(share, TABLE.nodes, float(Z_P), periods * 2 * math.pi / Z_P, pair, 1, out)
        return out[0]

    for periods in np.linspace(0.0, 3.0, 13):
        # periods known to 1e-15 times 60 nodes and a share below 1
        assert at(periods, 1) == pytest.approx(at(periods + 1.0, 0), abs=1e-12)
    assert at(1.5, 0) > 0.4  # mid-window, mid-contact


def series_at(key, phi, level=0):
    c = TABLE.series[key][level]
    angle = np.outer(phi, Z_P * np.arange(c.shape[0]))
    return np.cos(angle) @ c[:, 0] + np.sin(angle) @ c[:, 1]


def direct_sum(coefficients, orders, phi):
    """Values and slopes of all series from the definition, shape (N_SERIES,) each."""
    c = coefficients.reshape(2 * orders + 1, N_SERIES)
    value, slope = c[0].copy(), np.zeros(N_SERIES)
    for h in range(1, orders + 1):
        w = h * Z_P
        value += c[2 * h - 1] * math.cos(w * phi) + c[2 * h] * math.sin(w * phi)
        slope += w * (c[2 * h] * math.cos(w * phi) - c[2 * h - 1] * math.sin(w * phi))
    return value, slope


@each("orders", [0, 1, 5, 12])
@each("phi", [0.0, 0.1234, -0.4, 40.0])
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


@each("torque", [0.0, 3.0, 5.0, 7.5, 10.0, 49.9, 123.0, 400.0, 900.0, -123.0])
def test_between_load_levels_data_are_linear_and_outside_held(torque):
    packed = np.random.default_rng(1).normal(size=(LEVELS, 4))
    out = np.empty(4)
    bracket = load_bracket(torque, math.copysign(1.0, torque), TABLE.torque, LEVELS)
    blend_levels(packed.ravel(), 4, bracket, out)
    expected = [np.interp(abs(torque), TABLE.torque, column) for column in packed.T]
    # rounding of one linear interpolation of numbers of order 1
    np.testing.assert_allclose(out, expected, rtol=0, atol=1e-14)
    assert TABLE.mean("k_m", torque) == np.interp(
        abs(torque), TABLE.torque, TABLE.series["k_m"][:, 0, 0]
    )


@each("torque", [-900.0, -400.0, -123.0, -5.0, -1.0, 0.0, 1.0, 49.9, 900.0])
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


def test_tables_can_be_read_by_several_threads_at_once():
    def read(_):
        return shipped_mesh_table(TABLE.name).contact_ratio

    # eight at a time, often: a library that must not be entered twice crashes the process
    with ThreadPoolExecutor(8) as pool:
        ratios = list(pool.map(read, range(80)))
    assert set(ratios) == {TABLE.contact_ratio}
