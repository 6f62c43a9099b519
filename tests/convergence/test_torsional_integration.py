"""How exactly the torsional pair is integrated, and what loose tolerances do to it."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from gearlube_core.dynamics.hypoid_torsional.mode_march import MARCH_WORK, OK, march
from gearlube_core.dynamics.hypoid_torsional.model import HypoidTorsional
from gearlube_core.dynamics.hypoid_torsional.parameters import karagiannis_2012_pair
from tests.helpers.torsional_cases import periodic_orbit, reconstructed, time_rates


def marched(model, speed, steps, periods):
    y = model.initial_state(speed)
    status = march(
        y, 0, periods, model.mean_load_torque, speed, model.rows(steps), model.kernel_parameters,
        np.zeros((0, 5)), np.zeros(MARCH_WORK),
    )  # fmt: skip
    assert status == OK
    return y


@pytest.mark.parametrize("form", ["two_dof", "one_dof"])
def test_step_halving_is_of_fourth_order_while_the_teeth_touch(form):
    model = HypoidTorsional(reconstructed(form=form, torque_ripple=0.1))
    speed = model.pinion_speed(0.4 * model.natural_frequency)
    ends = [marched(model, speed, steps, 20) for steps in (32, 64, 128, 512)]
    errors = [abs(end[0] - ends[-1][0]) for end in ends[:3]]
    # RK4: 16 each; the reference at 512 steps shortens the last error by 1/256
    orders = np.log2(np.array(errors[:-1]) / errors[1:])
    assert orders == pytest.approx([4.0, 4.0], abs=0.35)


def test_impacts_do_not_cost_the_fourth_order():
    """A step ends where the slope of the force jumps: at contact, and at the layer of damping."""
    model = HypoidTorsional(reconstructed(0.01))
    speed = model.pinion_speed(0.9 * model.natural_frequency)
    fine = marched(model, speed, 2048, 4)[0]
    assert fine < -75.0  # um: well into the gap
    # a step across a jump would be exact to second order only, and by chance better
    errors = [abs(marched(model, speed, steps, 4)[0] - fine) for steps in (32, 64, 128, 256)]
    assert errors[-1] < 1e-8 * abs(fine)
    orders = np.log2(np.array(errors[:-1]) / errors[1:])
    assert orders == pytest.approx([4.0, 4.0, 4.0], abs=0.35)


@pytest.mark.parametrize(
    "parameters",
    [reconstructed(0.003), replace(karagiannis_2012_pair(), friction="thermal_eyring")],
    ids=["reconstructed", "shipped with friction"],
)
def test_steps_in_angle_agree_with_an_adaptive_integrator_in_time(parameters):
    model = HypoidTorsional(parameters)
    speed = model.pinion_speed(0.6 * model.natural_frequency)
    y = marched(model, speed, 512, 10)
    start = model.initial_state(speed) * [1e-6, 1.0, 1.0, 1.0]
    rates = time_rates(model, model.mean_load_torque, speed)
    s = solve_ivp(
        rates, (0.0, y[3]), [*start[:3], 0.0, 0.0], method="DOP853", rtol=1e-10, atol=1e-14,
        max_step=2e-5,
    ).y[:, -1]  # fmt: skip
    # 512 steps a period: 1e-8 of the swing of 5 um; flank data are linear between nodes, whose
    # kinks under friction cost more
    assert y[0] == pytest.approx(s[0] * 1e6, abs=2e-5)
    assert y[1:3] == pytest.approx(s[1:3], rel=1e-9)
    assert s[3] == pytest.approx(10 * 2.0 * np.pi / 13, rel=1e-9)


@pytest.mark.slow
def test_absolute_angles_at_default_tolerances_destroy_the_result():
    """The transmission error is 1e-9 of the angles after a second: rtol 1e-3 cannot see it.

    SciPy's RK45 is the pair of ode45, and rtol 1e-3, atol 1e-6 are the defaults of ode45, which
    Karagiannis et al. 2012 name without a tolerance.
    """
    parameters = reconstructed(radii="mean", hold_gain=0.0)
    model = HypoidTorsional(parameters)
    speed = model.pinion_speed(0.5 * model.natural_frequency)
    load = model.mean_load_torque
    R_p, R_g, error = 21.1e-3, 21.1e-3 * 36 / 13, 0.96e-6

    def absolute(_, s):
        phi_p, phi_g, w_p, w_g = s
        x = R_p * phi_p - R_g * phi_g - error * np.cos(13 * phi_p)
        r = model.pair_rates(x, w_p, w_g, phi_p, load, speed)
        return [w_p, w_g, r.w_p, r.w_g]

    y = model.initial_state(speed)
    start = [0.0, (-error - y[0] * 1e-6) / R_g, y[1], y[2]]

    def late_swing(rtol, atol):
        s = solve_ivp(absolute, (0.0, 0.2), start, method="RK45", rtol=rtol, atol=atol)
        phi_p, phi_g = s.y[:2, s.t > 0.1]
        return np.ptp(R_p * phi_p - R_g * phi_g - error * np.cos(13 * phi_p))

    exact = np.ptp(periodic_orbit(parameters, 0.5).x)  # 4.2 um, contact kept
    assert late_swing(1e-3, 1e-6) > 50.0 * exact  # several hundred um, both flanks hit
    # speeds drift without speed hold, by the losses of 0.2 s
    assert late_swing(1e-7, 1e-10) == pytest.approx(exact, rel=0.05)
