"""Steps of spur pairs that end where lines come, go and turn their friction: against DOP853."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from gearlube_core.dynamics.helical_model.model import HelicalPairModel
from gearlube_core.dynamics.helical_pair.march.gear_file_march import helical_march_parameters
from gearlube_core.dynamics.helical_pair.march.jumps import time_to_jump
from gearlube_core.helical_geometry.gear_file import HelicalGearFile
from tests.helpers import pair_motions as at

FILE = HelicalGearFile.named("he_2007").varied({"pair.helix_angle_deg": 0.0})
SPUR = replace(helical_march_parameters(FILE), friction="constant")
PLANE, SPEED, TORQUE, KELVIN = SPUR.pair.plane, 104.7, 226.0, 333.15
LOADS = TORQUE, TORQUE * SPUR.pair.ratio, KELVIN
DURATION = 4e-3  # s, two mesh periods
# shares of a mesh period after which the lines change: one enters, one leaves, one passes the pitch
JUMPS = sorted(((X - PLANE.A) / PLANE.pitch) % 1.0 for X in (PLANE.A, PLANE.D, PLANE.P))


def started(steps: int) -> HelicalPairModel:
    model = HelicalPairModel(replace(SPUR, steps_per_highest_period=steps))
    model.initialise(pinion_speed=SPEED, pinion_torque=TORQUE, wheel_torque=LOADS[1],
                     oil_temperature=KELVIN)  # fmt: skip
    return model


def exact() -> np.ndarray:
    """Return the relative rotation after DURATION by another integrator, jump after jump."""
    model = started(8)
    model.step(1e-9, *LOADS)  # the torques are those of the last step
    s, time = model.continuous, 1e-9
    turned = PLANE.r_bp / PLANE.pitch
    while time < DURATION:
        phase = turned * s[at.PHI_P]
        ahead = [at_jump - phase % 1.0 for at_jump in (*JUMPS, 1.0 + JUMPS[0])]
        goal = phase + min(one for one in ahead if one > 1e-9)

        def reached(t: float, y: np.ndarray, goal: float = goal) -> float:
            return turned * y[at.PHI_P] - goal + 1e-10

        reached.terminal, reached.direction = True, 1.0  # type: ignore[attr-defined]
        found = solve_ivp(lambda t, y: model.derivative(y), (time, DURATION), s, "DOP853",
                          rtol=1e-11, atol=1e-16, events=reached)  # fmt: skip
        s, time = found.y[:, -1], found.t[-1]
        if time < DURATION:  # over the jump
            short = 2e-10 / (turned * SPEED)
            s, time = s + short * model.derivative(s), time + short
    return s


@pytest.fixture(scope="module")
def wanted() -> np.ndarray:
    return exact()


def test_error_of_a_spur_pair_falls_with_the_order_of_the_step(wanted):
    model = started(8)
    swing = []
    for _ in range(40):
        model.step(1e-4, *LOADS)
        swing.append(model.continuous[at.PSI])
    errors = []
    for steps in (8, 16, 32):
        model = started(steps)
        model.step(DURATION, *LOADS)
        errors.append(abs(model.continuous[at.PSI] - wanted[at.PSI]) / np.ptp(swing))
    # without ends at the jumps they are 2e-2 to 5e-3, and halve with the step
    assert errors[0] < 4e-3
    # fourth order is 16 times; friction and separation bend the forces, too
    assert errors[1] < errors[0] / 8.0
    assert errors[2] < errors[1] / 8.0


def test_time_to_a_jump_is_that_of_the_phase():
    flanks = SPUR.constants().flanks
    still = at.pair_motion(np.zeros(at.N_MOTION))._replace(psi=2e-5, w_p=SPEED)
    rate = PLANE.r_bp * SPEED / PLANE.pitch
    for phase in np.linspace(3.01, 3.99, 23):
        pressed = still._replace(phi_p=phase * PLANE.pitch / PLANE.r_bp)
        ahead = min((jump - phase) % 1.0 for jump in JUMPS)
        assert time_to_jump(pressed, 0.0, flanks) == pytest.approx((ahead - 2e-5) / rate)
        back = min((phase - jump) % 1.0 for jump in JUMPS)
        found = time_to_jump(pressed._replace(w_p=-SPEED), 0.0, flanks)
        assert found == pytest.approx((back - 2e-5) / rate)
    # near a jump, then at it, then over it
    for ahead, way in ((1.5e-5, 1.5e-5 - 1e-7), (1e-7, 2e-7)):
        close = still._replace(phi_p=(4.0 - ahead) * PLANE.pitch / PLANE.r_bp)
        assert time_to_jump(close, 0.0, flanks) == pytest.approx(way / rate, rel=1e-4)
    assert time_to_jump(still._replace(w_p=0.0), 0.0, flanks) == math.inf
    helical = flanks._replace(plane=flanks.plane._replace(sin_b=0.1))
    assert time_to_jump(still, 0.0, helical) == math.inf
