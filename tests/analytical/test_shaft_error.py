"""Errors that repeat with a shaft: their series, their force on the axle, their file."""

from dataclasses import replace

import numpy as np
import pytest
import xarray as xr

from gearlube_core.dynamics.hypoid_axle import mohammadpour_2015_axle
from gearlube_core.dynamics.hypoid_torsional.parameters import karagiannis_2012_pair
from gearlube_core.errors import ParameterError, TableError
from gearlube_core.mesh_table.kernels import (
    mesh_series,
    shaft_error,
    shaft_error_rate,
    transmission_error,
)
from gearlube_core.mesh_table.netcdf import read_mesh_table, shipped_mesh_table, write_mesh_table
from tests.helpers.axle_cases import OIL, conservative, output, record, running_axle
from tests.helpers.each import each

TABLE = shipped_mesh_table("mohammadpour_2015")
LEVELS = TABLE.torque.size


def alike(**members):
    """The table with these (orders, 2) coefficients [m] at every load."""
    return replace(
        TABLE,
        shaft_error={
            name: np.tile(np.asarray(values, float), (LEVELS, 1, 1))
            for name, values in members.items()
        },
    )


def axle_of(table, **changes):
    return conservative(replace(mohammadpour_2015_axle(), mesh=table), **changes)


def test_series_is_the_sum_of_both_members_turns_and_its_slope_is_its_derivative():
    rng = np.random.default_rng(1)
    pinion, gear = rng.normal(size=(4, 2)), rng.normal(size=(10, 2))
    tail = np.concatenate([[4.0, 10.0, 13 / 36], pinion.ravel(), gear.ravel()])

    def direct(phi):
        return sum(
            a * np.cos(k * angle) + b * np.sin(k * angle)
            for part, angle in ((pinion, phi), (gear, 13 / 36 * phi))
            for k, (a, b) in enumerate(part, 1)
        )

    for phi in (0.0, 0.7, -3.0, 400.0):
        error, slope = shaft_error(tail, phi), shaft_error_rate(tail, phi)
        # the recurrence of cosines adds a rounding for each order; 400 rad has 1e-13 of its own
        assert error == pytest.approx(direct(phi), abs=1e-11)
        h = 1e-5
        assert slope == pytest.approx((direct(phi + h) - direct(phi - h)) / (2 * h), abs=1e-6)
    series = np.concatenate([np.zeros(7), tail])
    assert transmission_error(series, 0, 13.0, 0.7) == shaft_error(tail, 0.7)
    assert mesh_series(series, 0, 13.0, 0.7).de == shaft_error_rate(tail, 0.7)


def test_teeth_without_errors_leave_every_bit_as_it_was():
    states = []
    for table in (TABLE, alike(pinion=np.zeros((3, 2)), gear=np.zeros((2, 2)))):
        axle, *torques = running_axle(60, replace(mohammadpour_2015_axle(), mesh=table))
        for _ in range(30):
            axle.step(1e-4, *torques, OIL)
        states.append((axle.get_state(), axle.outputs.copy()))
    np.testing.assert_array_equal(states[0][0], states[1][0])
    np.testing.assert_array_equal(states[0][1], states[1][1])


def test_an_axle_with_shaft_errors_conserves_energy():
    rng = np.random.default_rng(2)
    table = alike(pinion=2e-6 * rng.normal(size=(14, 2)), gear=2e-6 * rng.normal(size=(38, 2)))
    axle, *torques = running_axle(60, axle_of(table, steps_per_highest_period=250), 0.99)
    start = output(axle, "energy.stored")
    names = ["energy.pinion_work", "energy.wheel_work", "energy.stored"]
    put_in, taken_out, stored = record(axle, torques, names, 0.05)
    imbalance = put_in - taken_out - (stored - start)
    # as without them: the error of RK4 at 250 steps a period, of the energy that passed
    assert np.max(np.abs(imbalance)) < 1e-8 * put_in[-1]


def test_a_slow_error_of_a_shaft_makes_the_force_that_accelerates_the_inertias():
    """Far below the mesh mode the deflection does not change: x'' = 0 with constant torques gives
    F = m_eq (T_p e' / I_p - w^2 e''), primes by pinion angle; 23 Hz of the pinion, 16 of the gear.
    """
    amplitude = 10e-6
    table = alike(pinion=[[amplitude, 0.0]], gear=[[0.0, 0.0], [0.0, amplitude]])
    forces = []
    for one in (TABLE, table):
        parameters = replace(
            mohammadpour_2015_axle(), mesh=one, friction="off", bearing_torque_loss="none"
        )
        axle, *torques = running_axle(60, parameters, efficiency=1.0)
        forces.append(record(axle, torques, ["mesh.force", "pinion.angle"], 0.30, h=2e-4))
    change = forces[1][0] - forces[0][0]
    angle = forces[1][1]
    late = angle > angle[-1] - 3 * np.pi * 36 / 13  # 1.5 turns of the gear, free of the start
    angle, change = angle[late], change[late]
    turns = 13 / 36 * angle
    waves = [f(a) for a in (angle, 2 * turns) for f in (np.cos, np.sin)]
    terms = np.stack([*waves, np.ones_like(angle)], axis=1)
    found = np.linalg.lstsq(terms, change, rcond=None)[0]
    speed, order = 60 / 3.6 / 0.320 * 36 / 13, 2 * 13 / 36  # of the gear's, by pinion angle
    axle = mohammadpour_2015_axle()
    turning = torques[0] / axle.pinion_inertia
    expected = (
        amplitude
        * axle.equivalent_mass
        * np.array([speed**2, -turning, order * turning, order**2 * speed**2])
    )
    # the mean arm of the table for that at 38 N.m, and what rings from the start: 1 %
    assert found[:4] == pytest.approx(expected, abs=0.02 * np.abs(expected).max())


def test_shaft_errors_go_through_the_file_and_an_older_gearlube_refuses_it(tmp_path):
    table = alike(gear=[[1e-6, 2e-6], [3e-6, 4e-6]])
    path = write_mesh_table(table, tmp_path / "one.nc")
    read = read_mesh_table(path)
    assert set(read.shaft_error) == {"gear"}
    np.testing.assert_array_equal(read.shaft_error["gear"], table.shaft_error["gear"])
    with xr.open_dataset(path, engine="scipy") as dataset:
        assert dataset.attrs["gearlube_mesh_table"] == 3
    plain = write_mesh_table(read.without_shaft_error(), tmp_path / "plain.nc")
    assert read_mesh_table(plain).shaft_error == {}
    with xr.open_dataset(plain, engine="scipy") as dataset:
        assert dataset.attrs["gearlube_mesh_table"] == 2


@each(
    ("errors", "words"),
    [
        ({"wheel": np.zeros((LEVELS, 2, 2))}, "of pinion or gear, got 'wheel'"),
        ({"gear": np.zeros((2, LEVELS, 2))}, "load levels first"),
        ({"gear": np.full((LEVELS, 2, 2), np.nan)}, "a NaN"),
    ],
)
def test_wrong_shaft_errors_are_refused(errors, words):
    with pytest.raises(TableError, match=words):
        replace(TABLE, shaft_error=errors)


def test_the_torsional_pair_which_seeks_the_mesh_period_refuses_them():
    with pytest.raises(ParameterError, match=r"without_shaft_error\(\)"):
        karagiannis_2012_pair(alike(gear=[[1e-6, 0.0]]))
