"""Limits in which the 8-DOF axle becomes a smaller model, written here from its equations."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from gearlube_core.dynamics.hypoid_axle.state import X
from gearlube_core.mesh_table.netcdf import shipped_mesh_table
from tests.helpers.axle_cases import (
    axle_with,
    conservative,
    operating_point,
    plain,
    record,
    running_axle,
)

MESH = plain(shipped_mesh_table("mohammadpour_2015"))
I_P, I_G = 1734e-6, 5.81e-2  # kg m2, Mohammadpour et al. 2015, Table 1
Z_P = 13


def series(mesh, key, phi, torque):
    """Sum the stored Fourier series directly at load `torque`."""
    coefficients = np.array(
        [
            [np.interp(torque, mesh.torque, mesh.series[key][:, h, part]) for part in (0, 1)]
            for h in range(mesh.orders + 1)
        ]
    )
    h = np.arange(mesh.orders + 1)
    return coefficients[:, 0] @ np.cos(h * Z_P * phi) + coefficients[:, 1] @ np.sin(h * Z_P * phi)


def error_slope(mesh, phi):
    c = mesh.series["e"][0]
    h = np.arange(mesh.orders + 1) * Z_P
    return float(-(h * c[:, 0]) @ np.sin(h * phi) + (h * c[:, 1]) @ np.cos(h * phi))


def stiff_bearings(parameters, factor):
    bearing = replace(parameters.bearing, stiffness_constant=5e8 * factor)
    return replace(parameters, bearing=bearing)


@pytest.mark.slow
def test_axle_on_rigid_bearings_is_the_two_dof_pair():
    """I_p w_p' = T_p - (R_p - e') F - k' f^2/2, I_g w_g' = -T_g + R_g F, by DOP853 from here."""
    speed, pinion_torque, wheel_torque = operating_point(60, efficiency=0.99)
    differences = []
    for factor in (1e3, 1e5):
        parameters = stiff_bearings(
            conservative(axle_with(mesh=MESH, steps_per_highest_period=30)), factor
        )
        axle, *torques = running_axle(60, parameters, efficiency=0.99)
        start = axle.get_state()[X]
        full = record(axle, torques, ["mesh.dte"], 0.01)[0]
        mesh = parameters.mesh
        R_p = mesh.series["R_p"][0, 0, 0]

        def slope(t, y, mesh=mesh, R_p=R_p, torque=pinion_torque):
            x, w_p, w_g, phi = y
            h = 1e-6
            k = series(mesh, "k_m", phi, torque)
            dk = (series(mesh, "k_m", phi + h, torque) - series(mesh, "k_m", phi - h, torque)) / (
                2 * h
            )
            f = max(x, 0.0)
            arm = R_p - error_slope(mesh, phi)
            return [
                arm * w_p - R_p * 36 / 13 * w_g,
                (pinion_torque - arm * k * f - 0.5 * dk * f * f) / I_P,
                (-wheel_torque + R_p * 36 / 13 * k * f) / I_G,
                w_p,
            ]

        times = np.arange(1, 101) * 1e-4
        pair = solve_ivp(
            slope,
            (0.0, 0.01),
            [start, speed, speed * 13 / 36, 0.0],
            method="DOP853",
            rtol=1e-9,
            atol=[1e-13, 1e-9, 1e-9, 1e-9],
            t_eval=times,
        )
        differences.append(np.max(np.abs(full - pair.y[0])) / np.ptp(pair.y[0]))
    # compliance of the bearings against the mesh falls as 1/factor: 4e8/(1e5 x 2e8)
    assert differences[1] < 5e-3
    assert differences[0] > 3.0 * differences[1]


def test_two_dof_pair_on_mean_radii_swings_at_the_natural_frequency_of_the_one_dof_pair():
    """w_n = sqrt(k (R_p^2/I_p + R_g^2/I_g)), Karagiannis et al. 2012 eq. (30)."""
    weight = np.where(np.arange(MESH.orders + 1) > 0, 0.15, 1.0)[:, None]
    faint = {key: MESH.series[key] * weight for key in ("k_m", "k_t")}
    mesh = replace(MESH, series=MESH.series | faint)
    axle = axle_with(mesh=mesh, steps_per_highest_period=60, radii="mean")
    parameters = stiff_bearings(conservative(axle), 1e4)
    axle, pinion_torque, wheel_torque = running_axle(20, parameters, efficiency=1.0)
    # a kick: ten per cent more torque than the static deflection balances
    data = record(axle, (1.1 * pinion_torque, wheel_torque), ["mesh.dte"], 0.05, h=2e-5)[0]
    spectrum = np.abs(np.fft.rfft((data - data.mean()) * np.hanning(data.size), 16 * data.size))
    frequency = np.fft.rfftfreq(16 * data.size, 2e-5)
    R_p = parameters.mesh.series["R_p"][0, 0, 0]
    k = parameters.mesh.mean("k_t", 1.1 * pinion_torque)
    expected = np.sqrt(k * (R_p**2 / I_P + (R_p * 36 / 13) ** 2 / I_G)) / (2 * np.pi)
    window = frequency > 0.7 * expected
    peak = frequency[window][np.argmax(spectrum[window])]
    # 6 % variation of the stiffness shifts the mean frequency by its square
    assert peak == pytest.approx(expected, rel=0.01)
