"""Table of speeds at which orders of a train meet its natural frequencies."""

from __future__ import annotations

import numpy as np
import pytest
import xarray as xr

from gearlube.studies.drivetrain.orders import resonant_speeds


def study(force_at_resonance: float) -> xr.Dataset:
    """Orders 10 and 20 of a shaft to 6000 rpm, one mode at 500 Hz."""
    speeds = np.array([0.0, 1500.0, 3000.0, 6000.0])  # rpm: 500 Hz at 3000 and 1500 rpm
    forces = np.zeros((4, 2, 1))
    forces[:, 0, 0], forces[:, 1, 0] = [1.0, 2.0, 40.0, 3.0], [1.0, force_at_resonance, 2.0, 90.0]
    return xr.Dataset(
        {
            "order": ("line", [10.0, 20.0]),
            "order_force": (("order_speed", "line", "part"), forces),
            "share": (("frequency", "body"), [[0.2, 0.8]]),
        },
        coords={
            "line": ["mesh, 10", "mesh, 2 x 10"],
            "part": ["mesh"],
            "order_speed": speeds,
            "frequency": [500.0],
            "body": ["input", "output"],
        },
        attrs={"shaft": "input"},
    )


@pytest.mark.parametrize(("second", "first_order"), [(50.0, "mesh, 2 x 10"), (30.0, "mesh, 10")])
def test_the_largest_force_where_an_order_meets_a_mode_stands_first(second, first_order):
    (table,) = resonant_speeds(study(second))
    assert table.title == "Resonant speeds"
    assert table.rows[0][1] == first_order
    of_first, of_second = sorted(table.rows, key=lambda row: -row[0])
    assert of_first == [pytest.approx(3000.0), "mesh, 10", 500.0, "output", pytest.approx(40.0)]
    assert of_second == [
        pytest.approx(1500.0),
        "mesh, 2 x 10",
        500.0,
        "output",
        pytest.approx(second),
    ]


def test_orders_whose_forces_are_not_known_keep_their_speeds():
    unknown = study(0.0)
    unknown["order_force"][:] = np.nan
    (table,) = resonant_speeds(unknown)
    assert [row[-1] for row in table.rows] == [None, None]


def test_a_long_table_ends_and_says_so():
    many = study(50.0).isel(frequency=np.zeros(30, int))
    many["frequency"] = np.linspace(400.0, 500.0, 30)
    (table,) = resonant_speeds(many)
    assert len(table.rows) == 12
    assert table.title == "Resonant speeds, 12 of 60, by force"
