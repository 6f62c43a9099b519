"""Mesh between levels of torque, points on contact lines, steps of searches."""

from __future__ import annotations

import numpy as np
import pytest

from gearlube_core.dynamics.helical_pair import supports
from gearlube_core.dynamics.helical_pair.march import mesh_data
from gearlube_core.dynamics.helical_pair.march.mesh_data import LEAST_OFFSET, LEVEL
from gearlube_core.dynamics.helical_pair.supports import Bearing, ShaftSupport
from gearlube_core.friction.line_points import line_points
from gearlube_core.friction.thermal_eyring_flank import bracketed_secant_step
from gearlube_core.helical_geometry.contact_line import clip_line, line_position
from tests.helpers.each import each
from tests.helpers.named_pairs import named_pair
from tests.helpers.source_of import interpret, source_of

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
