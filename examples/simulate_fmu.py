"""Run HypoidAxle.fmu in FMPy: pull away from a steady speed and watch efficiency and mesh force."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from fmpy import simulate_fmu
from numpy.typing import NDArray

import gearlube as gl

STEP = 1e-3  # s, communication step
OUTPUTS = ["pinion.speed", "efficiency", "axle.efficiency", "mesh.force"]
LOAD = 160.0  # N.m, wheel
TIMES = np.array([0.0, 0.05, 0.15, 0.2])  # s
TORQUES = np.array([60.0, 60.0, 90.0, 90.0])  # N.m, pinion


def simulate(fmu: Path) -> NDArray[np.void]:
    """Return time and `OUTPUTS` while the pinion torque rises from 60 N.m to 90 N.m."""
    names = ("time", "pinion.torque", "wheel.torque", "oil.temperature")
    inputs = np.zeros(len(TIMES), dtype=[(name, float) for name in names])
    inputs["time"], inputs["pinion.torque"] = TIMES, TORQUES
    inputs["wheel.torque"], inputs["oil.temperature"] = LOAD, gl.celsius_to_kelvin(60.0)
    return simulate_fmu(
        str(fmu),
        stop_time=float(TIMES[-1]),
        output_interval=STEP,
        start_values={"bearing.preload": 2500.0, "pinion.speed_start": gl.rpm_to_rads(1900.0)},
        input=inputs,
        output=OUTPUTS,
    )


def main() -> NDArray[np.void]:
    """Run the axle FMU of this installation; the first time it is built."""
    return simulate(gl.cached_hypoid_axle())


if __name__ == "__main__":
    import matplotlib.pyplot as plt

    result = main()
    figure, axes = plt.subplots(2, sharex=True)
    axes[0].plot(result["time"], 100.0 * result["efficiency"], label="gear mesh")
    axes[0].plot(result["time"], 100.0 * result["axle.efficiency"], label="with all losses")
    axes[0].set_ylabel("efficiency [%]")
    axes[0].legend()
    axes[1].plot(result["time"], result["mesh.force"] / 1e3)
    axes[1].set(xlabel="time [s]", ylabel="mesh force [kN]")
    plt.show()
