"""Rewrite the table of communication steps in docs/fmu.md: python -m docs.fmu_hosts.coupling.

The axle and a car with a smooth engine exchange torques, angles and speeds: both from the other's
outputs at the start of the step, as SSP hosts do it, or in turn, the car first, so that the axle
gets the torques of the same step. A twist of the propshaft is let go; what it changes rings in the
mode of the axle on the propshaft. Its frequency and damping at each step are compared with those
at the shortest step in turn.
"""

from __future__ import annotations

import math
from dataclasses import replace
from typing import NamedTuple

import numpy as np
from scipy.linalg import hankel, svd

from docs.page import Page
from drivetrain.driveline.equations import INDEX
from drivetrain.driveline.model import Driveline
from drivetrain.driveline.modes import driveline_modes
from drivetrain.driveline.parameters import DrivelineParameters
from drivetrain.road_load import mohammadpour_2015_road_load
from gearlube_core.arrays import Array
from gearlube_core.dynamics.hypoid_axle import HypoidAxle, mohammadpour_2015_axle
from gearlube_core.errors import GearLubeError

SPEED, OIL = 20.0, 333.15  # m/s, K
STIFFNESSES = (3e3, 1e4, 3e4, 1e5)  # N.m/rad
STEPS = (1e-5, 2e-5, 5e-5, 1e-4, 2e-4, 5e-4, 1e-3)  # s
SHORTEST = 5e-6  # s
PERIODS = 8
TWISTED = 5.0  # N.m in the propshaft that is let go
MODE = "axle on propshaft"
SIGNALS = ("pinion.angle", "pinion.speed", "wheel.angle", "wheel.speed")
GOOD = 0.01  # of the damping ratio, absolute, and of the frequency, relative


class Ringing(NamedTuple):
    """Frequency [Hz] and damping ratio of the mode."""

    frequency: float
    damping: float


def car(stiffness: float) -> Driveline:
    """Return the car with a propshaft of a stiffness, whose mode keeps its damping ratio."""
    base = DrivelineParameters(road_load=mohammadpour_2015_road_load())
    damping = base.propshaft_damping * math.sqrt(stiffness / base.propshaft_stiffness)
    smooth = replace(base.engine, orders=())
    shaft = {"propshaft_stiffness": stiffness, "propshaft_damping": damping}
    return Driveline(replace(base, engine=smooth, **shaft), SPEED)


def speeds(stiffness: float, h: float, stop: float, twist: float, in_turn: bool) -> Array:
    """Return the speed of the pinion after each step, the propshaft twisted by more at first."""
    driveline, axle = car(stiffness), HypoidAxle(mohammadpour_2015_axle())
    steady = driveline.steady
    torques = steady.pinion_torque, steady.wheel_torque
    axle.initialise(
        pinion_speed=steady.pinion_speed,
        pinion_torque=torques[0],
        wheel_torque=torques[1],
        oil_temperature=OIL,
    )
    state = driveline.get_state()
    state[INDEX["propshaft_twist"]] += twist
    driveline.set_state(state)
    found = []
    for _ in range(round(stop / h)):
        before = [axle.output(name) for name in SIGNALS]
        after = driveline.step(h, *before)
        axle.step(h, *(after if in_turn else torques), OIL)
        torques = after
        found.append(axle.output("pinion.speed"))
    return np.array(found)


def ringing(stiffness: float, h: float, in_turn: bool) -> Ringing | None:
    """Return the mode at a step; None where the axle refuses the torques that grow."""
    modes = {one.name: one for one in driveline_modes(car(stiffness))}
    expected = modes[MODE].frequency
    stop = PERIODS / expected
    try:
        runs = [speeds(stiffness, h, stop, twist, in_turn) for twist in (0.0, TWISTED / stiffness)]
    except GearLubeError:  # torques beyond all limits
        return None
    rate = poles(runs[1] - runs[0], h)
    near = rate[np.argmin(np.abs(np.abs(rate.imag) / (2.0 * np.pi) - expected))]
    return Ringing(abs(near) / (2.0 * math.pi), -near.real / abs(near))


def poles(signal: Array, h: float, order: int = 8) -> Array:
    """Return the rates [1/s] of the exponentials in a signal, by the matrix pencil."""
    n = len(signal)
    skip = max(1, n // 400)  # as many samples as the pencil needs
    signal = signal[::skip]
    columns = len(signal) // 2
    matrix = hankel(signal[: len(signal) - columns + 1], signal[len(signal) - columns :])
    basis = svd(matrix, full_matrices=False)[2][:order].T
    z = np.linalg.eigvals(np.linalg.lstsq(basis[:-1], basis[1:], rcond=None)[0])
    return np.log(z[np.abs(z) > 1e-3].astype(complex)) / (skip * h)


def rows() -> list[list[str]]:
    """Return the rows of the table."""
    found = []
    for stiffness in STIFFNESSES:
        exact = ringing(stiffness, SHORTEST, in_turn=True)
        assert exact is not None
        for in_turn, words in ((False, "both at once"), (True, "car first")):
            grows, best = "–", "below 10 us"
            for h in STEPS:
                one = ringing(stiffness, h, in_turn)
                if one is None or one.damping < 0.0:
                    grows = f"{1e6 * h:.0f} us"
                    break
                off = one.damping - exact.damping
                shift = one.frequency / exact.frequency - 1.0
                if abs(off) < GOOD and abs(shift) < GOOD:
                    best = f"{1e6 * h:.0f} us"
            head = [f"{stiffness:.0f}", f"{exact.frequency:.0f}", f"{exact.damping:.3f}", words]
            found.append([*head, grows, best])
    return found


def main() -> None:
    """Measure and write the table."""
    found = rows()
    page = Page("fmu")
    page.rows("Stiffness", found)
    page.write()


if __name__ == "__main__":
    main()
