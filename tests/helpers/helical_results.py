"""Datasets of a study of a helical pair, of numbers that are easily followed."""

import numpy as np
import xarray as xr

RPM = np.pi / 30.0
SPEEDS, TEETH = np.array([1000.0, 2000.0, 3000.0]), 30  # rpm; mesh at 500, 1000, 1500 Hz


def sweep(natural=(4000.0,), film=True, margin=0.5, runs_at=2000.0):
    """Order 2 is largest at 2000 rpm, 2 kHz: 1.5 um with the film and 0.7 um at mu 0.1."""
    amplitude = np.full((3, 3), 0.1e-6)
    amplitude[1, 1] = 1.5e-6
    constant = np.full((2, 3, 3), 0.2e-6)
    constant[1, 2, 0] = 0.7e-6
    constant[0, 0, 0] = 9e-6  # at mu 0, not shown
    data = {
        "delta_z_harmonic": (("mu", "speed", "harmonic"), constant),
        "mesh_frequency": ("speed", SPEEDS / 60.0 * TEETH),
        "natural_frequency": ("mode", np.array(natural)),
        "stability_margin": (("mu", "speed"), np.full((2, 3), margin)),
    }
    if film:
        data["film_delta_z_harmonic"] = (("speed", "harmonic"), amplitude)
    return xr.Dataset(
        data,
        coords={"mu": [0.0, 0.1], "speed": SPEEDS * RPM, "harmonic": [1, 2, 3]},
        attrs={"pinion_speed": runs_at * RPM},
    )


def response(natural):
    """Order 2 is largest with the film, the last case: 0.3 um; order 1 at mu 0.1: 0.9 um."""
    return xr.Dataset(
        {
            "natural_frequency": ("mode", np.array(natural)),
            "delta_z_harmonic": (
                ("case", "harmonic"),
                np.array([[0.9e-6, 0.2e-6, 0.0], [0.1e-6, 0.3e-6, 0.2e-6]]),
            ),
        },
        coords={"case": ["0.1", "film"], "harmonic": [1, 2, 3]},
        attrs={"mesh_frequency": 500.0, "pinion_speed": 1000.0 * RPM},
    )


def separation(share, runs_at=5000.0):
    return xr.Dataset(
        {
            "separation_share": (("damping", "row"), np.array([[0.0, share, 0.0]])),
            "speed": (("damping", "row"), np.array([[4000.0, 5000.0, 6000.0]]) * RPM),
            "special_kind": (("damping", "special"), np.array([["fold", "fold", ""]])),
        },
        coords={"damping": [0.05]},
        attrs={"mesh_damping_ratio": 0.05, "pinion_speed": runs_at * RPM},
    )


def contact(pressure):
    peaks = np.array([[[1.0e9]], [[1.2e9]]]) * np.ones((2, 2, 1))
    peaks[0, 1, 0] = pressure
    return xr.Dataset(
        {
            "pressure_max": (("phase", "torque", "line"), peaks),
            "K": (("phase", "torque"), np.array([[1.0, 4e8], [1.0, 6e8]])),
            "transmission_error_ptp": ("torque", np.array([9.0, 0.4e-6])),
        },
        coords={"torque": [10.0, 200.0]},
        attrs={"pinion_torque": 200.0},
    )


def stability(unstable_from):
    factor = np.array([0.0, 1.0, 2.0, 3.0])
    growth = np.where(factor[:, None] >= unstable_from, [1.0, -1.0], -1.0)
    return xr.Dataset(
        {"growth_variation": (("variation", "mesh_frequency"), growth)},
        coords={"variation": factor, "mesh_frequency": [1e3, 2e3]},
    )


def film(ratio, rise=20.0):
    return xr.Dataset(
        {
            "film_ratio": ("point", np.array([4.0, ratio, 0.1])),
            "line_load": ("point", np.array([1.0, 1.0, 0.0])),  # the last carries nothing
            "temperature_rise": ("point", np.array([rise, 20.0, 0.0])),
        },
        attrs={
            "operating_mean_coefficient": 0.04,
            "operating_power_loss": 150.0,
            "roughness_rms": 5e-7,
            "oil_temperature": 353.15,
            "oil_data_high_degc": 150.0,
        },
    )


def losses(outside=None):
    """Two torques, speeds and temperatures; the largest loss is at the last of each."""
    dims = ("temperature", "torque", "speed")
    power = np.array([[[11.0, 13.0], [17.0, 19.0]], [[23.0, 29.0], [31.0, 60.0]]])
    data = {
        "loss": (("part", *dims), np.stack([0.75 * power, 0.25 * power])),
        "temperature_rise": (dims, 5.0 * np.ones_like(power)),
        "efficiency": (dims, 1.0 - power / np.outer([100.0, 200.0], [1000.0 * RPM, 3000.0 * RPM])),
    }
    if outside is not None:
        data["share_outside"] = (dims, outside)
        data["loss_bound"] = (dims, 0.02 * power * (1.0 + (power == 60.0)))
        data["by_formulas"] = (dims, np.asarray(outside) > 0.05)
    return xr.Dataset(
        data,
        coords={
            "part": ["sliding", "rolling"],
            "temperature": [40.0, 90.0],
            "torque": [100.0, 200.0],
            "speed": [1000.0, 3000.0],
        },
        attrs={
            "not_modelled": "windage",
            "film_model_line": "mine",
            "pinion_torque": 200.0,
            "pinion_speed": 3000.0 * RPM,
            "loads": "static, of the mesh of the pair",
        },
    )


def everything():
    return {
        "response": response([3000.0]),
        "sweep": sweep(),
        "contact": contact(1.4e9),
        "separation": separation(0.25),
        "stability": stability(2.0),
        "film": film(1.3),
        "losses": losses(),
    }
