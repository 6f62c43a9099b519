"""Where different starts lead."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from docs.resonance.cases import MISMATCHES, reconstructed
from gearlube_core.dynamics.hypoid_torsional.mode_march import MARCH_WORK, N_RECORD, march
from gearlube_core.dynamics.hypoid_torsional.model import HypoidTorsional
from gearlube_core.dynamics.hypoid_torsional.rates import MICRO, UM
from gearlube_core.dynamics.hypoid_torsional.time_sweep import settle_load

RELATIVES, REVOLUTIONS, PERIODS, STEPS = (0.3, 0.65, 1.0), 40, 600, 256
_MOST_PERIODS = 12
_SAME = 0.01


@dataclass(frozen=True, slots=True)
class Start:
    """A start and the motion it leads to."""

    relative: float
    mismatch: float
    name: str
    peak_to_peak: float  # m
    periods: int  # mesh periods after which it repeats, 0 for none up to 6


def starts() -> list[Start]:
    """Return the motions after the load has settled, from three places with x' = 0."""
    found = []
    for relative in RELATIVES:
        for mismatch in MISMATCHES:
            model = HypoidTorsional(reconstructed(mismatch))
            for name, x in (
                ("static deflection", model.static_deflection),
                ("first contact", 0.0),
                ("middle of the backlash", -0.5 * model.kernel_parameters.backlash),
            ):
                found.append(Start(relative, mismatch, name, *settled_from(model, relative, x)))
    return found


def settled_from(model: HypoidTorsional, relative: float, x: float) -> tuple[float, int]:
    """Return the peak-to-peak motion [m] and its mesh periods, 0 if it does not repeat in 12."""
    rows, p = model.rows(STEPS), model.kernel_parameters
    speed = model.pinion_speed(relative * model.natural_frequency)
    y = model.initial_state(speed)
    y[0] = MICRO * x
    work = np.zeros(MARCH_WORK)
    load = settle_load(y, REVOLUTIONS, model.mean_load_torque, speed, rows, p, work)
    record = np.zeros((_MOST_PERIODS * STEPS, N_RECORD))
    march(y, 0, PERIODS, load, speed, rows, p, record[:0], work)
    march(y, PERIODS, _MOST_PERIODS, load, speed, rows, p, record, work)
    periods = record[:, 1].reshape(_MOST_PERIODS, STEPS)
    swing = float(np.ptp(periods))
    for count in (1, 2, 3, 4, 6):
        if np.max(np.abs(periods[count:] - periods[:-count])) < _SAME * swing:
            return swing * UM, count
    return swing * UM, 0
