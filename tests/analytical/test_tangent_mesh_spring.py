"""The mesh as a spring tangent at its load: same static error, stiffness of the load."""

import numpy as np
import pytest

from gearlube_core.dynamics.packed_mesh import N_CHANNELS, ROLL, pack_mesh
from gearlube_core.mesh_table.kernels import K_M, N_SERIES, R_P, E
from gearlube_core.mesh_table.netcdf import shipped_mesh_table
from tests.helpers.each import each

TABLE = shipped_mesh_table("mohammadpour_2015")
ANGLE = 2.0 * np.pi * np.arange(240) / 240  # of the mesh period


def series(stiffness, level, column):
    """A packed series over the mesh period, summed here from its coefficients."""
    packed = pack_mesh(TABLE, 115.4e9, "consistent", stiffness)
    c = packed.series.reshape(TABLE.torque.size, -1, N_SERIES)[level, :, column]
    order = np.arange(1, TABLE.orders + 1)
    return (
        c[0] + np.cos(np.outer(ANGLE, order)) @ c[1::2] + np.sin(np.outer(ANGLE, order)) @ c[2::2]
    )


def summed(key, level):
    c = TABLE.series[key][level]
    order = np.outer(ANGLE, np.arange(c.shape[0]))
    return np.cos(order) @ c[:, 0] + np.sin(order) @ c[:, 1]


def cut(values):
    """The part of `values` that the table's orders can hold."""
    spectrum = np.fft.rfft(values)
    spectrum[TABLE.orders + 1 :] = 0.0
    return np.fft.irfft(spectrum, values.size)


@each("level", range(TABLE.torque.size))
def test_static_error_under_the_level_is_that_of_the_secant(level):
    """F/k_t + e of one spring and F/k_m + e of the other differ by a constant only."""
    force = TABLE.torque[level] / series("secant", level, R_P)
    errors = [
        cut(force / series(stiffness, level, K_M) + series(stiffness, level, E))
        for stiffness in ("tangent", "secant")
    ]
    difference = errors[0] - errors[1]
    # the quotients are sampled at 48 points: what lies above order 43 folds back, 1e-4 of the swing
    swing = np.ptp(force / summed("k_m", level))
    assert np.ptp(difference) < 1e-3 * swing


@each("level", range(TABLE.torque.size))
def test_each_spring_has_its_own_stiffness_and_the_mean_error_of_the_table(level):
    for stiffness, key in (("tangent", "k_t"), ("secant", "k_m")):
        found = series(stiffness, level, K_M)
        np.testing.assert_allclose(found, summed(key, level), rtol=1e-12)
        mean = TABLE.series["e"][level, 0, 0]
        assert series(stiffness, level, E).mean() == pytest.approx(mean, rel=1e-9, abs=1e-15)


def test_loaded_flanks_are_stiffer_than_their_secant():
    # a Hertz point alone would give 3/2, a line 1 and more; pairs that join add to it
    ratio = TABLE.series["k_t"][:, 0, 0] / TABLE.series["k_m"][:, 0, 0]
    assert np.all((ratio > 1.4) & (ratio < 1.7))


def test_the_line_that_rolls_has_the_entrainment_along_the_minor_axis():
    """The entrainment stands at psi from that axis: its part there is that of a turned vector."""
    packed = pack_mesh(TABLE, 115.4e9, "consistent", "tangent")
    rolls = packed.windows.reshape(TABLE.torque.size, -1, N_CHANNELS)[:, :-1, ROLL]
    arm, psi = TABLE.windows["entrainment_arm"], TABLE.windows["psi"]
    assert np.ptp(np.cos(psi)) > 0.01
    assert rolls == pytest.approx((arm * np.exp(1j * psi)).real, rel=1e-12)
