"""Line friction refuses wrong input with the reason and the cure."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from gearlube_core.contact.greenwood_tripp_1971 import SurfaceParameters
from gearlube_core.contact.solid import STEEL_MOHAMMADPOUR_2015, solid_parameters
from gearlube_core.errors import ParameterError
from gearlube_core.friction.line_integrals import friction_along_lines
from gearlube_core.friction.line_points import line_points, table_line_load, uniform_line_load
from gearlube_core.mesh_table.line_mesh import uniform_line_mesh
from gearlube_core.oil.lubricant import Lubricant
from tests.helpers.named_pairs import named_pair

HE = named_pair("he_2007")
POINTS = line_points(HE, 4, 2)
TABLE = uniform_line_mesh(
    name="uniform",
    source="test",
    pinion_teeth=25,
    gear_teeth=31,
    base_pitch=HE.base_pitch,
    lines=3,
    density=1.3e10,
)
GOOD: dict[str, Any] = {
    "pinion_speed": 100.0,
    "pinion_torque": 200.0,
    "lubricant": Lubricant.named("jamali_2015"),
    "oil_temperature": 353.15,
    "surface": SurfaceParameters(0.5e-6, 0.055, 0.001),
    "solid": solid_parameters(STEEL_MOHAMMADPOUR_2015, STEEL_MOHAMMADPOUR_2015),
}


@pytest.mark.parametrize(
    ("name", "value", "message"),
    [
        ("pinion_speed", 0.0, "pinion_speed must be above 0 rad/s"),
        ("pinion_torque", -5.0, "pinion_torque must be above 0 N.m"),
        ("oil_temperature", 80.0, "oil_temperature must be within 273.15 to 423.15 K"),
    ],
)
def test_an_operating_point_out_of_range_is_refused(name: str, value: float, message: str) -> None:
    load = uniform_line_load(POINTS, 200.0)
    with pytest.raises(ParameterError, match=message):
        friction_along_lines(POINTS, load, **(GOOD | {name: value}))


def test_line_loads_of_other_points_are_refused() -> None:
    load = uniform_line_load(line_points(HE, 4, 3), 200.0)
    with pytest.raises(ParameterError, match=r"line_load must be .* \(4, 3, 4\).* \(4, 3, 6\)"):
        friction_along_lines(POINTS, load, **GOOD)
    with pytest.raises(ParameterError, match="line_load must be finite"):
        friction_along_lines(POINTS, np.full(POINTS.x.shape, np.nan), **GOOD)


def test_a_table_of_another_pair_is_refused() -> None:
    with pytest.raises(ParameterError, match="must be of the pair he_2007"):
        table_line_load(POINTS, replace(TABLE, gear_teeth=32), 200.0)
    with pytest.raises(ParameterError, match="must be of the pair he_2007"):
        table_line_load(POINTS, replace(TABLE, base_pitch=1.01 * HE.base_pitch), 200.0)
    short = replace(TABLE, density=TABLE.density[:, :, :2], offset=TABLE.offset[:, :, :2])
    with pytest.raises(ParameterError, match="must hold the 3 lines"):
        table_line_load(POINTS, short, 200.0)


def test_a_torque_outside_a_table_of_levels_is_refused() -> None:
    twice = replace(
        TABLE,
        torque=np.array([50.0, 100.0]),
        density=np.repeat(TABLE.density, 2, axis=0),
        offset=np.repeat(TABLE.offset, 2, axis=0),
    )
    with pytest.raises(ParameterError, match=r"pinion_torque must be within 50 to 100 N\.m"):
        table_line_load(POINTS, twice, 200.0)


def test_a_table_without_stiffness_is_refused() -> None:
    soft = replace(TABLE, density=np.zeros_like(TABLE.density))
    with pytest.raises(ParameterError, match="density above zero at every phase"):
        table_line_load(POINTS, soft, 200.0)


@pytest.mark.parametrize(("phases", "nodes"), [(0, 4), (4, 0)])
def test_a_period_without_points_is_refused(phases: int, nodes: int) -> None:
    with pytest.raises(ParameterError, match="must be within 1 to"):
        line_points(HE, phases, nodes)
