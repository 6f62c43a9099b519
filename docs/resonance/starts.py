"""Where starts at 0.65 of the natural frequency lead."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from docs.resonance.cases import MISMATCHES, reconstructed
from gearlube_core.dynamics.hypoid_torsional.angle_march import N_RECORD, march
from gearlube_core.dynamics.hypoid_torsional.model import HypoidTorsional
from gearlube_core.dynamics.hypoid_torsional.rates import MICRO, UM

RELATIVE, PERIODS, STEPS = 0.65, 600, 256


@dataclass(frozen=True, slots=True)
class Start:
    """A start and the motion it leads to."""

    mismatch: float
    name: str
    peak_to_peak: float  # m


def starts() -> list[Start]:
    """Return the motions of the last of `PERIODS` mesh periods from three places, x' = 0."""
    found = []
    for mismatch in MISMATCHES:
        model = HypoidTorsional(reconstructed(mismatch))
        rows, p = model.rows(STEPS), model.kernel_parameters
        speed = model.pinion_speed(RELATIVE * model.natural_frequency)
        for name, x in (
            ("static deflection", model.static_deflection),
            ("first contact", 0.0),
            ("middle of the backlash", -0.5 * p.backlash),
        ):
            y = model.initial_state(speed)
            y[0] = MICRO * x
            record = np.zeros((STEPS, N_RECORD))
            march(y, 0, PERIODS, model.mean_load_torque, speed, rows, p, record[:0])
            march(y, PERIODS, 1, model.mean_load_torque, speed, rows, p, record)
            found.append(Start(mismatch, name, float(np.ptp(record[:, 1])) * UM))
    return found
