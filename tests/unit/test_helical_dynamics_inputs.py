"""Inputs of the helical pair's dynamics: what is refused, packed meshes, compiled kernels."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from gearlube.studies.helical.sweep_grid import QUANTITIES, harmonic_grid
from gearlube_core.dynamics.helical_pair.linear.periodic_response import (
    harmonics,
    periodic_response,
)
from gearlube_core.dynamics.helical_pair.mesh.packed_lines import pack_lines
from gearlube_core.dynamics.helical_pair.supports import Bearing, ShaftSupport
from gearlube_core.errors import ParameterError
from tests.helpers.each import each
from tests.helpers.he_2007 import he_2007_pair
from tests.helpers.helical_dynamics_cases import SPEED
from tests.helpers.named_pairs import named_pair


@each(
    ("field", "value", "message"),
    [
        ("pinion_mass", 0.0, "pinion_mass must be above 0 kg"),
        ("friction_coefficient", 1.5, "friction_coefficient must be within 0 to 1"),
        ("friction", "dry", "friction must be one of"),
        ("pair", named_pair("jamali_2015_a"), "mesh must belong to the pair of 33 and 34"),
        ("line_divisions", 0, "line_divisions must be within 1 to 64"),
        ("form", "three_dof", "form must be one of"),
    ],
)
def test_bad_parameters_are_refused_with_their_limit(
    field: str, value: object, message: str
) -> None:
    with pytest.raises(ParameterError, match=message):
        replace(he_2007_pair(0.1), **{field: value})


def test_a_bearing_that_gives_energy_away_is_refused() -> None:
    with pytest.raises(ParameterError, match="K_x_theta_y must be within"):
        Bearing(position=0.05, K_xx=1e8, K_yy=1e8, K_zz=1e8, K_x_theta_y=1e5)
    bearing = Bearing(position=0.05, K_xx=1e8, K_yy=1e8, K_zz=1e8)
    with pytest.raises(ParameterError, match="bearing 2 at z = -l2"):
        ShaftSupport(first=bearing, second=bearing)


def test_line_mesh_is_read_between_torques_and_refused_beyond() -> None:
    base = he_2007_pair(0.1).mesh
    shape = (2, 1, base.lines, 2)
    density = np.broadcast_to(np.array([1e10, 2e10])[:, None, None, None], shape)
    offset = np.broadcast_to(np.array([0.0, 4e-6]), shape)
    mesh = replace(
        base, torque=np.array([100.0, 300.0]), station=np.array([0.25, 0.75]), density=density,
        offset=offset,
    )  # fmt: skip
    packed = pack_lines(mesh, 150.0, 2)
    assert np.allclose(packed.station, [0.0, 0.25, 0.5, 0.75, 1.0])
    assert np.allclose(packed.density, 1.25e10)
    assert np.allclose(packed.offset, [0.0, 0.0, 2e-6, 4e-6, 4e-6])
    with pytest.raises(ParameterError, match="pinion_torque must be within 100 to 300"):
        pack_lines(mesh, 301.0, 1)


def test_finer_lines_do_not_change_linear_contact() -> None:
    coarse = periodic_response(he_2007_pair(0.1), SPEED)
    fine = periodic_response(replace(he_2007_pair(0.1), line_divisions=5), SPEED)
    # two points a part are exact already: rounding through some thousand steps
    swing = np.ptp(coarse.displacement, axis=0)
    assert np.all(np.abs(fine.displacement - coarse.displacement).max(axis=0) < 1e-7 * swing)


def test_speed_must_be_positive() -> None:
    with pytest.raises(ParameterError, match="pinion_speed must be above 0 rad/s"):
        periodic_response(he_2007_pair(0.1), 0.0)


def test_grid_holds_the_single_responses() -> None:
    mu, speed = [0.0, 0.1], [80.0, SPEED]
    grid = harmonic_grid(he_2007_pair(0.0), mu, speed, count=6)
    response = periodic_response(he_2007_pair(0.1), SPEED)
    for i, name in enumerate(QUANTITIES):
        expected = harmonics(response.signal(name), 6)
        assert np.allclose(grid.displacement[1, 1, i], expected, rtol=1e-12, atol=0.0)
    assert np.allclose(grid.bearing_force[1, 1], harmonics(response.bearing_force, 6).T)
    assert np.allclose(grid.mean_bearing_force[1, 1], response.bearing_force.mean(axis=0))
    assert grid.friction_torque[1, 1] == response.friction_torque
    assert grid.stability_margin.shape == (2, 2)
    assert (grid.stability_margin > 0.0).all()
