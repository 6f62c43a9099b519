"""What solved films cost where the load jumps: `python -m benchmarks.bench_load_changes`.

Processor time of an axle at 100 km/h by formulas and by solved films, turn by turn in one process,
from the same state: under a constant torque, over a tip-in, over a reversal, and under a torque
that is another one every millisecond, so that almost every node of the flanks is evaluated again.
The wheel torque is in balance with the pinion's, so that the speed stays.
"""

from __future__ import annotations

import argparse
import logging
import statistics
import sys
import time
from dataclasses import replace

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.dynamics.hypoid_axle import HypoidAxle, mohammadpour_2015_axle

_LOGGER = logging.getLogger("bench_load_changes")
_OIL = 368.15  # K
_SPEED, _RATIO = 240.4, 36.0 / 13.0  # rad/s at the pinion: 100 km/h
_SIMULATED, _AT = 0.05, 0.01  # s, and when the torque jumps
_TURNS = 9


def torques(course: str) -> Array:
    """Return the torque on the pinion in each millisecond [N.m]."""
    time_ms = np.arange(round(1e3 * _SIMULATED))
    later = time_ms >= round(1e3 * _AT)
    if course == "tip-in":
        return np.where(later, 250.0, 20.0)
    if course == "reversal":
        return np.where(later, -80.0, 100.0)
    if course == "another every ms":
        return np.random.default_rng(20).uniform(20.0, 250.0, time_ms.size)
    return np.full(time_ms.size, 100.0)


def running(first: float, **choices: str) -> HypoidAxle:
    """Return an axle that has run in under its first torque."""
    axle = HypoidAxle(replace(mohammadpour_2015_axle(), **choices))
    axle.initialise(
        pinion_speed=_SPEED,
        pinion_torque=first,
        wheel_torque=_RATIO * first,
        oil_temperature=_OIL,
    )
    for _ in range(20):
        axle.step(1e-3, first, _RATIO * first, _OIL)
    return axle


def cpu_time(axle: HypoidAxle, course: Array, h: float) -> float:
    """Return what steps of `h` [s] along the course took [s]."""
    state = axle.get_state()
    each = round(1e-3 / h)
    begin = time.process_time()
    for torque in course.tolist():
        for _ in range(each):
            axle.step(h, torque, _RATIO * torque, _OIL)
    taken = time.process_time() - begin
    axle.set_state(state)
    return taken


def main() -> None:
    """Compare flanks by formulas and solved, and all contacts solved, with each law of drag."""
    argparse.ArgumentParser(description=__doc__).parse_args()
    kinds = {
        "formula": {},
        "flanks solved": {"film": "solved"},
        "formula, rollers too": {"bearing_torque_loss": "biboulet_houpert_2010"},
        "all solved": {"film": "solved", "bearing_torque_loss": "solved_films"},
    }
    for course in ("constant", "tip-in", "reversal", "another every ms"):
        along = torques(course)
        axles = {name: running(float(along[0]), **kind) for name, kind in kinds.items()}
        for h in (1e-4, 1e-3):
            turns = [[cpu_time(axle, along, h) for axle in axles.values()] for _ in range(_TURNS)]
            speeds = [_SIMULATED / min(one) for one in zip(*turns, strict=True)]
            flanks = statistics.median(one[0] / one[1] for one in turns)
            whole = statistics.median(one[2] / one[3] for one in turns)
            words = [f"{one} {speed:.1f}" for one, speed in zip(kinds, speeds, strict=True)]
            _LOGGER.info(
                "%s, %g ms: simulated seconds a second %s; flanks %.2f, all %.2f of the formulas'",
                course, 1e3 * h, ", ".join(words), flanks, whole,
            )  # fmt: skip


if __name__ == "__main__":
    logging.basicConfig(level=logging.INFO, format="%(message)s", stream=sys.stderr)
    main()
