"""Line meshes: files, interpolation and made-up ones."""

from __future__ import annotations

import math

import numpy as np
import pytest
import xarray as xr

from gearlube_core.dynamics.helical_pair import supports
from gearlube_core.dynamics.helical_pair.march import mesh_data
from gearlube_core.dynamics.helical_pair.march.mesh_data import LEAST_OFFSET, LEVEL
from gearlube_core.dynamics.helical_pair.supports import Bearing, ShaftSupport
from gearlube_core.dynamics.hypoid_torsional.synthetic_mesh import synthetic_mesh
from gearlube_core.errors import ParameterError, TableError
from gearlube_core.friction.line_points import line_points
from gearlube_core.friction.thermal_eyring_flank import bracketed_secant_step
from gearlube_core.helical_geometry.contact_line import clip_line, line_position
from gearlube_core.mesh_table.line_mesh import LineMesh
from gearlube_core.mesh_table.line_mesh_file import read_line_mesh, write_line_mesh
from tests.helpers.each import each
from tests.helpers.named_pairs import named_pair
from tests.helpers.source_of import interpret, source_of


@pytest.fixture
def mesh():
    rng = np.random.default_rng(5)
    shape = (2, 6, 3, 4)
    return LineMesh(
        name="any",
        source="random numbers",
        pinion_teeth=25,
        gear_teeth=31,
        base_pitch=9.04e-3,
        torque=np.array([50.0, 225.0]),
        phase=np.arange(6) / 6,
        station=(np.arange(4) + 0.5) / 4,
        density=1e10 * rng.random(shape),
        offset=1e-6 * rng.standard_normal(shape),
        provenance={"density": "computed: at random", "offset": "computed: at random"},
    )


def test_a_line_mesh_comes_back_bit_by_bit(mesh, tmp_path):
    back = read_line_mesh(write_line_mesh(mesh, tmp_path / "new" / "mesh.nc"))
    for name in ("torque", "phase", "station", "density", "offset"):
        np.testing.assert_array_equal(getattr(back, name), getattr(mesh, name))
    for name in ("name", "source", "pinion_teeth", "gear_teeth", "base_pitch", "provenance"):
        assert getattr(back, name) == getattr(mesh, name)
    assert [p.name for p in (tmp_path / "new").iterdir()] == ["mesh.nc"]


def test_every_datum_has_unit_and_name(mesh, tmp_path):
    with xr.open_dataset(write_line_mesh(mesh, tmp_path / "mesh.nc"), engine="scipy") as dataset:
        for name in ("torque", "phase", "station", "density", "offset"):
            assert dataset[name].attrs["units"]
            assert dataset[name].attrs["long_name"]
        assert dataset["density"].attrs["provenance"] == "computed: at random"


def test_files_that_are_no_line_mesh_are_refused(mesh, tmp_path):
    with pytest.raises(TableError, match=r"line mesh absent\.nc was not found in "):
        read_line_mesh(tmp_path / "absent.nc")
    text = tmp_path / "text.nc"
    text.write_text("torque 1 2 3")
    with pytest.raises(TableError, match="not a readable NetCDF 3"):
        read_line_mesh(text)
    whole = write_line_mesh(mesh, tmp_path / "whole.nc").read_bytes()
    cut = tmp_path / "cut.nc"
    cut.write_bytes(whole[: len(whole) // 2])
    with pytest.raises(TableError, match="not a readable NetCDF 3"):
        read_line_mesh(cut)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda d: d.attrs.pop("gearlube_line_mesh"), "not a gearlube line mesh"),
        (lambda d: d.attrs.update(gearlube_line_mesh=0), "an older gearlube"),
        (lambda d: d.attrs.update(gearlube_line_mesh=99), "a newer gearlube"),
        (lambda d: d.attrs.pop("base_pitch"), "lacks base_pitch"),
        (lambda d: d["offset"].attrs.update(units="mm"), "offset must be in m, got mm"),
        (lambda d: d["density"].values.__setitem__((0, 0, 0, 0), -1.0), "density must not be"),
        (lambda d: d["offset"].values.__setitem__((0, 0, 0, 0), np.nan), "offset must be finite"),
    ],
)
def test_contradictions_are_named(mesh, tmp_path, change, message):
    dataset = xr.load_dataset(write_line_mesh(mesh, tmp_path / "mesh.nc"), engine="scipy")
    change(dataset)
    dataset.to_netcdf(tmp_path / "bad.nc", engine="scipy")
    with pytest.raises(TableError, match=message):
        read_line_mesh(tmp_path / "bad.nc")


def test_a_missing_or_transposed_datum_is_named(mesh, tmp_path):
    dataset = xr.load_dataset(write_line_mesh(mesh, tmp_path / "mesh.nc"), engine="scipy")
    dataset.drop_vars("density").to_netcdf(tmp_path / "less.nc", engine="scipy")
    with pytest.raises(TableError, match="lacks density"):
        read_line_mesh(tmp_path / "less.nc")
    turned = dataset.transpose("phase", "torque", "line", "station")
    turned.to_netcdf(tmp_path / "turned.nc", engine="scipy")
    with pytest.raises(TableError, match="must have the dimensions"):
        read_line_mesh(tmp_path / "turned.nc")


RNG = np.random.default_rng(13)


@each("count", [1, 2, 4])
@each("torque", [-5.0, 10.0, 13.0, 30.0, 44.0, 61.0, 75.0, 900.0])
def test_mesh_is_linear_in_torque_between_levels_and_constant_beyond(count: int, torque: float):
    levels = np.array([10.0, 30.0, 60.0, 75.0])[:count]
    densities, offsets = RNG.random((2, count, 6))
    data = np.full(LEAST_OFFSET + 20, np.nan)
    source_of(mesh_data.mesh_at_torque)(torque, (levels, densities, offsets), data)

    def at(values: np.ndarray) -> list[float]:
        return [float(np.interp(torque, levels, column)) for column in values.T]

    assert data[-12:-6] == pytest.approx(at(densities))
    assert data[-6:] == pytest.approx(at(offsets))
    assert data[LEAST_OFFSET] == pytest.approx(min(at(offsets)))
    assert data[LEVEL] == torque
    untouched = np.delete(data[:-12], [LEAST_OFFSET, LEVEL])
    assert np.isnan(untouched).all()


def test_points_lie_on_their_lines_and_know_their_station():
    pair = named_pair("jamali_2015_a")
    found = line_points(pair, phases=5, nodes=3)
    plane, seen = pair.plane, 0
    for n in range(5):
        assert found.phase[n] == pytest.approx(n / 5)
        for i in range(found.x.shape[1]):
            X = line_position(n / 5, i, plane)
            segment = clip_line(X, plane)
            width = segment.z_high - segment.z_low
            total = found.length[n, i].sum() * plane.cos_b
            assert total == pytest.approx(max(width, 0.0), abs=1e-15)
            if width <= 0.0:
                assert (found.x[n, i] == plane.P).all()
                continue
            seen += 1
            z = found.z[n, i]
            # midpoint of the line by its Gauss points, on either side of the pitch line
            middle = (found.length[n, i] * z).sum() / found.length[n, i].sum()
            assert middle == pytest.approx(0.5 * (segment.z_low + segment.z_high), abs=1e-12)
            assert found.station[n, i] == pytest.approx((z - segment.z_low) / width)
            assert found.x[n, i] == pytest.approx(
                X - (0.5 * plane.W - z) * plane.sin_b / plane.cos_b
            )
            # no segment lies on both sides of the pitch line
            has_length = found.length[n, i] > 1e-12
            before, after = has_length[:3], has_length[3:]
            assert (found.x[n, i, :3][before] <= plane.P + 1e-12).all()
            assert (found.x[n, i, 3:][after] >= plane.P - 1e-12).all()
    assert seen > 5


def test_secant_steps_hit_the_zero_of_a_line_and_stay_in_the_bracket():
    step = source_of(bracketed_secant_step)
    # g = 3 (x - 0.4)
    assert step(0.7, 0.9, 0.5, 0.3, 0.0, 1.0) == pytest.approx(0.4)
    assert step(0.7, 0.9, 0.5, 0.3, 0.45, 0.9) == pytest.approx(0.5 * (0.45 + 0.9))
    assert step(0.7, 0.9, 0.5, 0.3, 0.1, 0.3) == pytest.approx(0.2)
    assert step(0.7, 0.9, 0.5, 0.9, 0.1, 0.8) == pytest.approx(0.45)


def test_printed_support_is_two_bearings_seen_from_the_gear(monkeypatch):
    matrices = {}
    for position in (0.03, -0.05):
        K = RNG.random((6, 6))
        matrices[position] = K + K.T
    monkeypatch.setattr(
        supports, "bearing_matrix", lambda bearing, shaft: matrices[bearing.position]
    )
    first, second = (
        Bearing(K_xx=1e8, K_yy=1e8, K_zz=1e8, position=position) for position in matrices
    )
    found = supports.printed_support_stiffness(ShaftSupport(first=first, second=second))
    expected = np.zeros((6, 6))
    for lever, K in matrices.items():
        # displacement of the bearing under (u_x, u_y, u_z, th_x, th_y), and its own tilt
        x = np.array([1.0, 0.0, 0.0, 0.0, lever])
        y = np.array([0.0, 1.0, 0.0, -lever, 0.0])
        force_x = K[0, 0] * x + K[0, 4] * np.eye(5)[4]
        force_y = K[1, 1] * y + K[1, 3] * np.eye(5)[3]
        expected[0, :5] += force_x
        expected[1, :5] += force_y
        expected[2, 2] += K[2, 2]
        # the moments are printed with the distance, not with the side
        expected[3, :5] -= abs(lever) * force_y
        expected[4, :5] += abs(lever) * force_x
    assert found == pytest.approx(expected)


def test_stations_of_a_mesh_have_both_ends(monkeypatch):
    interpret(monkeypatch, mesh_data)
    # two lines of three stations: moments up to each, what heads a line, density and offset
    of_moments = 6 * mesh_data.N_MOMENTS + 2 * mesh_data.LINE_HEAD
    at = mesh_data.STATIONS_AT
    assert mesh_data.data_size(3, 6) == at + 3 + of_moments + 12
    densities, offsets = RNG.random((2, 2, 6))
    data = np.full(mesh_data.data_size(3, 6), np.nan)
    levels = np.array([10.0, 30.0])
    mesh_data.place_mesh(np.array([0.0, 0.4, 1.0]), (levels, densities, offsets), data)
    assert data[at : at + 3] == pytest.approx([0.0, 0.4, 1.0])
    assert mesh_data.density_at(3, 6) == at + 3 + of_moments
    assert data[-12:-6] == pytest.approx(densities[0])
    assert data[-6:] == pytest.approx(offsets[0])
    assert data[LEAST_OFFSET] == offsets[0].min()
    # other densities at the same level take the place of those that were there
    mesh_data.place_mesh(np.array([0.0, 0.4, 1.0]), (levels, 2.0 * densities, offsets), data)
    assert data[-12:-6] == pytest.approx(2.0 * densities[0])


MESH = synthetic_mesh(
    stiffness=3e8, pinion_radius=0.02, stiffness_harmonics=((0.1, 0.02), (-0.03, 0.04)),
    error_harmonics=((1e-6, -2e-6),), radius_mismatch=0.01, radius_modulation=0.03,
    contact_ratio=2.2, pinion_teeth=11, gear_teeth=33, torque=70.0,
)  # fmt: skip


def value(key, angle):
    """Sum of a series at a mesh angle."""
    coefficients = MESH.series[key][0]
    return sum(
        a * math.cos(h * angle) + b * math.sin(h * angle) for h, (a, b) in enumerate(coefficients)
    )


@pytest.mark.parametrize("angle", [0.0, 0.7, 2.5])
def test_series_are_those_of_the_docstring(angle):
    c, s = math.cos(angle), math.sin(angle)
    c2, s2 = math.cos(2.0 * angle), math.sin(2.0 * angle)
    k = 3e8 * (1.0 + 0.1 * c + 0.02 * s - 0.03 * c2 + 0.04 * s2)
    expected = {
        "k_m": k, "k_t": k, "R_p": 0.02 * (1.0 + 0.04 * c), "R_g": 0.06 * (1.0 + 0.03 * c),
        "e": 1e-6 * c - 2e-6 * s, "n_x": 1.0, "n_y": 0.0, "n_z": 0.0,
    }  # fmt: skip
    for key, number in expected.items():
        assert value(key, angle) == pytest.approx(number, rel=1e-13, abs=1e-20), key
    assert (MESH.pinion_teeth, MESH.gear_teeth, MESH.torque.tolist()) == (11, 33, [70.0])


@pytest.mark.parametrize("contact_ratio", [1.01, 1.7, 2.2, 3.0])
def test_shares_are_half_sines_over_the_length_of_contact_that_add_up_to_one(contact_ratio):
    mesh = synthetic_mesh(contact_ratio=contact_ratio)
    share = mesh.windows["share"][0]
    assert share.size == 60

    def weight(position):  # mesh periods from the middle of the window
        away = np.abs(position)
        return np.where(away < 0.5 * contact_ratio, np.cos(np.pi * away / contact_ratio), 0.0)

    position = np.arange(60) / 20.0 - 1.5
    # its neighbours stand a period before and after it, and there are no more within reach
    total = sum(weight(position + n) for n in range(-3, 4))
    np.testing.assert_allclose(share, weight(position) / total, atol=1e-12)
    assert share.reshape(3, 20).sum(axis=0) == pytest.approx(np.ones(20), rel=1e-14)
    assert mesh.contact_ratio == contact_ratio


def test_contact_that_ends_where_the_next_begins_is_refused():
    with pytest.raises(ParameterError, match=r"contact_ratio must be within 1\.01 to 3"):
        synthetic_mesh(contact_ratio=1.0)
