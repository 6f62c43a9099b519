"""What solved films cost the axle: `python -m benchmarks.bench_solved_film`.

Processor time of communication steps by formula and by the film model, turn by turn in one process.
Each turn starts from the same state: with less friction an axle speeds up and takes more steps.
"""

from __future__ import annotations

import logging
import statistics
import sys
import time
from dataclasses import replace

from gearlube_core.dynamics.hypoid_axle import HypoidAxle, mohammadpour_2015_axle

_LOGGER = logging.getLogger("bench_solved_film")
_OIL = 368.15  # K
_POINT = 240.4, 66.2, 176.0  # rad/s, N.m, N.m: 100 km/h
_SIMULATED = 0.05  # s
_TURNS = 25


def running(film: str) -> HypoidAxle:
    """Return an axle at 100 km/h that has run in."""
    axle = HypoidAxle(replace(mohammadpour_2015_axle(), film=film))
    speed, torque, load = _POINT
    axle.initialise(
        pinion_speed=speed, pinion_torque=torque, wheel_torque=load, oil_temperature=_OIL
    )
    for _ in range(20):
        axle.step(1e-3, torque, load, _OIL)
    return axle


def cpu_time(axle: HypoidAxle, h: float) -> float:
    """Return what steps of `h` [s] over the simulated time took [s]."""
    state = axle.get_state()
    begin = time.process_time()
    for _ in range(round(_SIMULATED / h)):
        axle.step(h, *_POINT[1:], _OIL)
    taken = time.process_time() - begin
    axle.set_state(state)
    return taken


def main() -> None:
    """Compare the two at two communication steps."""
    axles = [running(film) for film in ("formula", "solved")]
    for h in (1e-4, 1e-3):
        turns = [[cpu_time(axle, h) for axle in axles] for _ in range(_TURNS)]
        formula, solved = (min(one[k] for one in turns) for k in (0, 1))
        ratio = statistics.median(one[0] / one[1] for one in turns)
        _LOGGER.info(
            "%g s: %.1f simulated seconds a second by formula, %.1f solved; ratio %.3f of the "
            "least times, %.3f of the median turn",
            h, _SIMULATED / formula, _SIMULATED / solved, formula / solved, ratio,
        )  # fmt: skip


if __name__ == "__main__":
    logging.basicConfig(level=logging.INFO, format="%(message)s", stream=sys.stderr)
    main()
