"""A small dataset with what the studies' datasets have: names, spectra, maps, unit spellings."""

import numpy as np
import xarray as xr

RATE = 1024.0  # Hz


def small_results() -> xr.Dataset:
    """Return forces over time, spectra with a frequency axis of each point, texts, a number."""
    random = np.random.default_rng(7)
    force = random.normal(size=(64, 2, 2)).astype(np.float32)
    frequency = np.array([[0.0, 1.5, 3.0], [0.0, 2.5, np.nan]])
    spectrum = np.where(np.isnan(frequency), np.nan, random.random((2, 3)))
    return xr.Dataset(
        {
            "bearing_force": (
                ("time", "bearing", "direction"),
                force,
                {"units": "N", "long_name": "force on the shaft"},
            ),
            "dte": ("time", 1e-6 * random.random(64), {"units": "m"}),
            "frequency": (("speed", "bin"), frequency, {"units": "Hz"}),
            "dte_spectrum": (("speed", "bin"), spectrum, {"units": "m", "long_name": "amplitude"}),
            "torque": ("speed", [80.0, 90.0], {"units": "N.m"}),
            "message": ("speed", np.array(["", "left, a range"])),
            "share": ((), 0.25),
        },
        {
            "time": ("time", np.arange(64) / RATE, {"units": "s"}),
            "speed": ("speed", [5.0, 10.0], {"units": "m s-1"}),
            "bearing": ["pinion", "gear"],
            "direction": ["axial", "radial 1"],
        },
        {"name": "small", "teeth": 13},
    )
