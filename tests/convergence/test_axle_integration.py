"""The axle's integrator: order, accuracy, agreement with another integrator."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from gearlube_core.bearings.bearing_type import (
    N_EXPANSION,
    NO_RACEWAYS,
    ShaftMotion,
    expanded_forces,
    shaft_forces,
)
from gearlube_core.bearings.followed_shaft import (
    N_FOLLOWED,
    N_FORCES,
    STEP_PARTS,
    drag_near,
    drag_of_shaft,
    follow_forces,
    moving_parts,
)
from gearlube_core.dynamics.hypoid_axle import HypoidAxle, mohammadpour_2015_axle
from gearlube_core.dynamics.hypoid_axle.state import N_ODE, U_G, U_P, X, gear_motion, pinion_motion
from gearlube_core.dynamics.hypoid_mesh.step_parts import CONTACT_PARTS, contact_parts
from gearlube_core.oil.lubricant_state import lubricant_state
from tests.helpers.axle_cases import (
    OIL,
    axle_with,
    conservative,
    operating_point,
    output,
    record,
    running_axle,
)

STEP = 1e-4  # s, communication step


def dte(speed_kmh, parameters, duration):
    axle, *torques = running_axle(speed_kmh, parameters)
    return record(axle, torques, ["mesh.dte"], duration)[0]


def test_step_halving_shows_fourth_order():
    # mean radii and no friction: the table's windows, linear between nodes, then play no part
    errors = []
    runs = {
        n: dte(
            100,
            conservative(mohammadpour_2015_axle(), steps_per_highest_period=n, radii="mean"),
            0.01,
        )
        for n in (21, 42, 84, 336)
    }
    for n in (21, 42, 84):
        errors.append(np.max(np.abs(runs[n] - runs[336])))
    orders = np.log2(np.array(errors[:-1]) / np.array(errors[1:]))
    # steps are whole fractions of the communication step (5.04 -> 6, 10.1 -> 11, 20.2 -> 21)
    expected = 4.0 * np.log2([11 / 6, 21 / 11])
    np.testing.assert_allclose(orders, expected, atol=0.5)


@pytest.mark.parametrize(
    ("speed_kmh", "film"), [(20, "formula"), (60, "formula"), (100, "formula"), (100, "solved")]
)
def test_default_steps_are_accurate_to_a_ten_thousandth_of_the_oscillation(speed_kmh, film):
    default = dte(speed_kmh, axle_with(film=film), 0.25)[1000:]
    fine = axle_with(film=film, steps_per_highest_period=160, steps_per_mesh_period=320)
    reference = dte(speed_kmh, fine, 0.25)[1000:]
    # the documented accuracy; 160 steps are another (22/160)^4 = 4e-4 of the error away
    assert np.max(np.abs(default - reference)) <= 1e-4 * np.ptp(reference)


@pytest.mark.slow
@pytest.mark.parametrize("film", ["formula", "solved"])
def test_result_does_not_depend_on_the_communication_step(film):
    def run(h, turn):
        axle, torque, load = running_axle(100, axle_with(film=film))
        for k in range(round(0.04 / h)):
            sign = 1.0 if k * h < turn - 1e-9 else -0.7
            axle.step(h, sign * torque, sign * load, OIL)
            if (k + 1) % round(1e-3 / h) == 0:
                yield [axle.output(n) for n in ("mesh.dte", "mesh.force", "pinion.displacement.y")]

    def runs(turn):
        return [np.array(list(run(h, turn))) for h in (1e-3, 1e-4)]

    # documented: 5e-5 of the value, with solved rollers. A slope that is left out of the expanded
    # bearing forces makes 4e-4
    steady = runs(1.0)
    assert np.max(np.abs(steady[0] / steady[1] - 1.0)) < 2e-5
    # teeth part and meet on the other side; documented as 1e-3 of the transmission error's swing.
    # The phase at which they meet decides: 2e-4 to 5e-4 for the formulas
    for turn in (0.005, 0.010, 0.011):
        reversed_ = [one[:, 0] for one in runs(turn)]
        swing = np.ptp(reversed_[1])
        assert np.max(np.abs(reversed_[0] - reversed_[1])) < 1e-3 * swing
        assert swing > 1e-4  # m


def test_the_drag_that_is_kept_is_that_of_the_rollers_now():
    law = "biboulet_houpert_2010"
    axle, torque, load = running_axle(60, axle_with(bearing_torque_loss=law))
    p, errors, evaluated = axle.kernel_parameters, [], 0
    oil = lubricant_state(p.oil, OIL)
    places = [axle.assembly.kept[f"{one} bearings"] for one in ("pinion", "gear")]
    before = None

    def exact(state, law):
        pinion, gear = pinion_motion(state), gear_motion(state)
        return (
            drag_of_shaft(p.bearing_p, pinion, p.preload_p, law, oil, NO_RACEWAYS).torque,
            drag_of_shaft(p.bearing_g, gear, p.preload_g, law, oil, NO_RACEWAYS).torque,
        )

    for k in range(40):  # 1 to 1.8 times the torque in 40 ms
        share = 1.0 + 0.02 * k
        axle.step(1e-3, share * torque, share * load, OIL)
        state = np.array(axle.state_view)
        kept = np.array([state[at : at + N_FOLLOWED] for at in places])
        motions = pinion_motion(state), gear_motion(state)
        near = [drag_near(one, own).torque for one, own in zip(motions, kept, strict=True)]
        errors.append(np.array(near) / exact(state, p.drag) - 1.0)
        evaluated += before is not None and not np.array_equal(before, kept)
        before = kept
    # within the reach of 0.3 um of 15 um of approach: 1e-4 of second order, and as much by slopes
    assert np.max(np.abs(errors)) < 3e-4
    assert 2 < evaluated < 40
    assert exact(state, 0.0)[0] == 0.0 < exact(state, p.drag)[0]


def test_flanks_that_meet_or_part_within_a_step_take_it_in_parts():
    gap = 150.0  # um
    for x, change, meets in (
        (-0.1, 0.2, True),  # onto the drive flanks
        (0.1, -0.2, True),  # off them
        (-149.9, -0.2, True),  # onto the coast flanks
        (-150.2, 0.3, True),
        (-0.4, 0.2, False),  # not as far in this step
        (7.0, 0.5, False),  # loaded
        (-80.0, 5.0, False),  # in the gap
        (0.01, 0.02, False),  # hardly moves
    ):
        assert (contact_parts(x, change, gap) == CONTACT_PARTS) == meets, x
        assert contact_parts(x, change, gap) in (1, CONTACT_PARTS)


def test_shafts_that_are_thrown_across_their_bearings_are_followed():
    """Torques change sign: teeth part, meet on the coast flanks, and the pinion leaps by 80 um."""

    def leap(**steps):
        axle, *_ = running_axle(60, axle_with(**steps))
        found = []
        for k in range(300):
            sign = 1.0 if k < 100 else -1.0
            axle.step(STEP, 300.0 * sign, 945.0 * sign, OIL)
            found.append(axle.output("pinion.displacement.z"))
        return np.array(found)

    fine = leap(steps_per_highest_period=160, steps_per_mesh_period=320)
    error = leap() - fine
    # 1.1e-4 was found; steps of the leap that are not divided err ten times as much
    assert np.sqrt(np.mean(error**2)) < 3e-4 * np.ptp(fine)


def test_a_step_is_divided_where_a_shaft_leaps_and_forces_are_expanded_where_it_goes():
    still = ShaftMotion(1e-6, -2e-6, 3e-6, 0.0, 0.0, 0.0, 0.3, 200.0)
    for name in ("v1", "v2", "v_axial"):
        for v, parts in ((0.02, 1), (-0.02, 1), (0.06, STEP_PARTS), (-0.06, STEP_PARTS)):
            # 1e-5 s: 0.2 or 0.6 um
            assert moving_parts(still._replace(**{name: v}), 1e-5) == parts
    p = mohammadpour_2015_axle().bearing.parameters()
    oil = lubricant_state(mohammadpour_2015_axle().oil.parameters(), OIL)
    kept, reach, h = np.zeros(N_FORCES), 0.07e-6, 1e-5
    places = []
    for k in range(30):
        motion = still._replace(r2=still.r2 + 1e-9 * k, v2=1e-4)
        follow_forces(p, motion, 500.0, oil, h, reach, kept)
        places.append(kept[N_EXPANSION + 2])
    # again after twelve steps, about the middle of these
    changes = [k for k in range(1, 30) if places[k] != places[k - 1]]
    assert changes == [12, 24]
    for k in (0, 12, 24):
        assert places[k] == pytest.approx(still.r2 + 1e-9 * (k + 6), rel=1e-9)
    # and at once where the shaft leaves the reach; where it is half of a step later
    motion = still._replace(axial=still.axial + 1e-6, v_axial=0.04)
    follow_forces(p, motion, 500.0, oil, h, reach, kept)
    assert kept[N_EXPANSION + 3] == pytest.approx(motion.axial + 0.5 * h * 0.04, rel=1e-9)
    found = expanded_forces(p, motion, kept[:N_EXPANSION])
    exact = shaft_forces(p, motion, 500.0, oil)
    # linear over 0.2 um of some 15 um of approach
    assert found[2] == pytest.approx(exact[2] + exact[5], rel=1e-3)


@pytest.mark.parametrize("speed_kmh", [20, 100])
def test_rk4_agrees_with_dop853_on_the_same_right_hand_side(speed_kmh):
    axle, *torques = running_axle(speed_kmh, axle_with(bearing_torque_loss="none"))
    record(axle, torques, ["mesh.dte"], 0.05)
    # lengths in micrometres: numbers of order 1, as the solver's tolerances expect
    size = np.ones(N_ODE)
    size[[*range(U_P, U_P + 3), *range(U_G, U_G + 3), X]] = 1e6
    start = axle.get_state()[:N_ODE]
    times = np.arange(1, 101) * STEP
    solution = solve_ivp(
        lambda t, y: size * axle.derivative(y / size),
        (0.0, times[-1]),
        size * start,
        method="DOP853",
        rtol=1e-9,
        atol=1e-9,
        t_eval=times,
    )
    assert solution.success
    rk4 = record(axle, torques, ["mesh.dte"], times[-1])[0]
    reference = solution.y[X] * 1e-6
    # documented accuracy of the fixed steps; DOP853 at 1e-9 is exact beside it
    assert np.max(np.abs(rk4 - reference)) <= 1e-4 * np.ptp(reference)


def test_separating_teeth_converge_at_the_order_of_a_kink():
    """At light load the transmission error lifts the flanks off: the force stays continuous."""
    load = (1.2, 1.2 * 36 / 13)

    def run(steps):
        parameters = axle_with(
            steps_per_highest_period=steps, bearing_torque_loss="none", friction="off"
        )
        axle = HypoidAxle(parameters)
        axle.initialise(
            pinion_speed=operating_point(100)[0],
            pinion_torque=load[0],
            wheel_torque=load[1],
            oil_temperature=OIL,
        )
        return record(axle, load, ["mesh.dte", "mesh.separated"], 0.05)

    default, separated = run(22)
    fine = run(88)[0]
    reference = run(400)[0]
    assert 0.0 < separated.mean() < 1.0
    scale = np.ptp(reference)
    # the slope of the force jumps by k_m inside a step: (k_m/m_eq) x' h^3/6 = 0.6 nm a crossing at
    # x' = 5 mm/s and h = 17 us; forty crossings add like a random walk to 2.5e-3 of 1.7 um; twice
    assert np.max(np.abs(default - reference)) < 5e-3 * scale
    # and it falls with the step
    assert np.max(np.abs(fine - reference)) < 0.5 * np.max(np.abs(default - reference))


def test_state_continues_bit_exactly():
    axle, *torques = running_axle(60)
    record(axle, torques, ["mesh.dte"], 0.01)
    saved = axle.get_state()
    first = record(axle, torques, ["mesh.dte", "bearing[1].roller[1].load"], 0.01)
    axle.set_state(saved)
    second = record(axle, torques, ["mesh.dte", "bearing[1].roller[1].load"], 0.01)
    np.testing.assert_array_equal(first, second)
    other, *_ = running_axle(60)
    other.set_state(saved)
    third = record(other, torques, ["mesh.dte", "bearing[1].roller[1].load"], 0.01)
    np.testing.assert_array_equal(first, third)


def test_outputs_are_finite_before_the_first_step():
    axle, *_ = running_axle(60)
    assert np.all(np.isfinite(axle.outputs))
    assert output(axle, "pinion.speed") > 0.0
    assert pytest.approx(output(axle, "flank[3].temperature"), abs=100.0) == OIL
