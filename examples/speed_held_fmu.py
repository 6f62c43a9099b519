"""A gear FMU on a test bench in FMPy: losses at speeds and loads, and orders over a run-up."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
from fmpy import simulate_fmu
from numpy.typing import NDArray

IMPOSED = 3  # of speed.hold.number


def gears(fmu: Path) -> tuple[int, float]:
    """Return the teeth of the pinion, and its speed over that of the wheel."""
    names = ["pinion.speed", "wheel.speed", "mesh.frequency"]
    found = simulate_fmu(str(fmu), stop_time=1e-3, output=names)
    pinion, wheel, mesh = (float(found[name][0]) for name in names)
    return round(2.0 * np.pi * mesh / pinion), pinion / wheel


def loss_map(
    fmu: Path, speeds: list[float], loads: list[float], oil: float = 333.15
) -> NDArray[np.float64]:
    """Return pinion torque [N.m], speed [rad/s] and power lost [W] at each point, shape (n, 3).

    `speeds` are those of the pinion [rad/s], `loads` torques of the wheel [N.m], `oil` is in K.
    """
    works, rows = ["energy.pinion_work", "energy.wheel_work", "pinion.angle"], []
    ratio = gears(fmu)[1]
    for speed, load in ((v, t) for v in speeds for t in loads):
        given = {"speed.hold.number": IMPOSED, "speed.reference": speed, "oil.temperature": oil}
        torques = {"pinion.torque": load / ratio, "wheel.torque": load}  # the holder adds losses
        begin = {"pinion.speed_start": speed, **given, **torques}
        found = simulate_fmu(
            str(fmu), stop_time=0.4, output_interval=0.1, start_values=begin, output=works
        )
        put_in, taken, angle = (found[name][-1] - found[name][2] for name in works)
        rows.append((put_in / angle, speed, (put_in - taken) * speed / angle))
    return np.array(rows)


def order_track(
    fmu: Path, order: float | None = None, seconds: float = 2.0
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return speeds [rad/s] and amplitudes of the transmission error at an order [m].

    The order is in turns of the pinion; by default its teeth.
    """
    order = gears(fmu)[0] if order is None else order
    ramp = np.array([(0.0, 50.0), (seconds, 250.0)], [("time", float), ("speed.reference", float)])
    begin = {"speed.hold.number": IMPOSED, "pinion.speed_start": 50.0, "speed.reference": 50.0}
    names = ["pinion.angle", "pinion.speed", "mesh.dte"]
    found = simulate_fmu(
        str(fmu), stop_time=seconds, output_interval=1e-4, start_values=begin, input=ramp,
        output=names,
    )  # fmt: skip
    angle, speed, error = (found[name] for name in names)
    turns = np.arange(angle[0], angle[-1], 2.0 * np.pi)  # the window is two turns
    even = np.linspace(0.0, 4.0 * np.pi, 2048, endpoint=False)
    waves = [np.interp(start + even, angle, error) @ np.exp(1j * order * even) for start in turns]
    return np.interp(turns[:-2], angle, speed), 2.0 * np.abs(waves[:-2]) / even.size


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit("Usage: python speed_held_fmu.py HypoidAxle.fmu (or HelicalPair.fmu)")
    for torque, speed, loss in loss_map(Path(sys.argv[1]), [50.0, 200.0], [100.0, 300.0]):
        print(f"{torque:6.1f} N.m {speed:6.1f} rad/s {loss:7.1f} W")
    for speed, error in zip(*order_track(Path(sys.argv[1])), strict=True):
        print(f"{speed:6.1f} rad/s {1e6 * error:7.3f} um")
