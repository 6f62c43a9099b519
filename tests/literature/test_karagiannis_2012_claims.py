"""Statements on Karagiannis et al. 2012 in docs/resonance.md that other files do not test.

Coexisting motions, claims with the load of the periodic motion, and claims that do not hold: those
are asserted as found, so that a change is noticed.
"""

import functools
from dataclasses import replace

import numpy as np
import pytest

from gearlube.studies.resonance.flank_cycle import flank_cycle
from gearlube.studies.resonance.response import motion_near
from gearlube_core.dynamics.hypoid_torsional.mode_march import MARCH_WORK, N_RECORD, march
from gearlube_core.dynamics.hypoid_torsional.model import HypoidTorsional
from gearlube_core.dynamics.hypoid_torsional.parameters import karagiannis_2012_pair
from gearlube_core.dynamics.hypoid_torsional.period_problem import PeriodProblem
from gearlube_core.dynamics.hypoid_torsional.time_sweep import settle_load, time_sweep
from gearlube_core.periodic import follow
from tests.helpers.each import each
from tests.helpers.torsional_cases import periodic_orbit, reconstructed

WORK = np.zeros(MARCH_WORK)


@functools.cache
def shipped(ratio, **options):
    """The motion of the analysed mesh that Newton's method finds from static deflection."""
    return periodic_orbit(replace(karagiannis_2012_pair(), **options), ratio)


def settled_from(parameters, x_0, ratio, periods=600, steps=256):
    """x [m] over the mesh period that a start at x_0 [m] leads to."""
    model = HypoidTorsional(parameters)
    rows, p = model.rows(steps), model.kernel_parameters
    speed = model.pinion_speed(ratio * model.natural_frequency)
    y = model.initial_state(speed)
    y[0] = 1e6 * x_0
    record = np.zeros((steps, N_RECORD))
    march(y, 0, periods, model.mean_load_torque, speed, rows, p, record[:0], WORK)
    march(y, periods, 1, model.mean_load_torque, speed, rows, p, record, WORK)
    return 1e-6 * record[:, 1]


@pytest.mark.slow
@each("mismatch", [0.002, 0.003, 0.004])
def test_5_a_start_in_the_middle_of_the_backlash_parts_the_teeth_at_065(mismatch):
    # the paper's x = 0 is the middle of the backlash; fig. 8b has teeth apart
    parameters = reconstructed(mismatch)
    middle = settled_from(parameters, -75e-6, 0.65)
    loaded = settled_from(parameters, HypoidTorsional(parameters).static_deflection, 0.65)
    assert np.mean(middle < 0.0) > 0.5
    assert loaded.min() > 0.0


def test_5_constant_radii_have_one_motion_at_065_whatever_the_start():
    swings = [np.ptp(settled_from(reconstructed(), x_0, 0.65)) for x_0 in (-75e-6, 0.0, 5e-6)]
    assert swings == pytest.approx([swings[0]] * 3, rel=1e-3)


def test_5_a_sweep_down_stays_apart_where_a_sweep_up_is_in_contact():
    parameters = reconstructed(0.002)
    natural = HypoidTorsional(parameters).natural_frequency
    ratios = np.array([0.6, 0.65, 0.7, 0.75, 0.8, 0.85])
    up = time_sweep(parameters, natural * ratios, "up", steps_per_mesh_period=128)
    down = time_sweep(parameters, natural * ratios, "down", steps_per_mesh_period=128)
    assert up.separation_share[1] == 0.0
    assert down.separation_share[::-1][1] > 0.5


@pytest.mark.slow
@pytest.mark.parametrize("form", ["two_dof", "one_dof"])
def test_analysed_mesh_is_bistable_below_resonance_by_loss_of_contact(form):
    problem = PeriodProblem(replace(karagiannis_2012_pair(), form=form), steps_per_mesh_period=256)
    model = problem.model
    unit = model.pinion_speed(model.natural_frequency)
    branch = follow(
        problem.equations(),
        problem.initial_guess(0.7 * unit),
        0.7 * unit,
        limits=(0.7 * unit, 1.1 * unit),
        at=np.array([0.9 * unit]),
    )
    upper, lower = (point.parameter / unit for point in branch.of_kind("fold"))
    # softening: the peak leans to lower frequency
    assert 0.75 < lower < 0.9 < upper < 1.0
    rows = branch.at(0.9 * unit)
    assert list(branch.stable[rows]) == [True, False, True]
    orbits = [problem.orbit(branch.unknowns[row], branch.parameter[row]) for row in rows]
    shares = [orbit.separation_share for orbit in orbits]
    assert shares[0] == 0.0 < shares[1] < shares[2]


def test_4_6_8_10_consistent_radii_do_not_aggravate():
    """Not found: the analysed radii vary below 2 % but consistently with the error."""
    for ratio in (0.3, 0.65, 1.0, 1.3):
        two, one = shipped(ratio), shipped(ratio, form="one_dof")
        spectra = [np.abs(np.fft.rfft(orbit.x))[1:5] for orbit in (two, one)]
        assert np.ptp(two.x) < np.ptp(one.x), ratio  # claims 4, 10
        assert spectra[1][0] / spectra[0][0] > 0.95, ratio  # claim 6 has 0.5
        assert spectra[0][3] < 1.1 * spectra[1][3], ratio  # claim 8 has 2


def test_radii_beside_the_error_that_holds_them_count_twice():
    for ratio in (0.3, 0.65, 1.3):
        once, twice = shipped(ratio), shipped(ratio, radii="paper")
        assert np.ptp(twice.x) > 1.05 * np.ptp(once.x)


def test_7_22_analysed_mesh_parts_for_a_quarter_of_the_period_in_both_models():
    """A third is printed for 2-DOF and hardly any for 1-DOF; not found."""
    two, one = shipped(1.0), shipped(1.0, form="one_dof")
    for orbit in (two, one):
        assert 0.2 < orbit.separation_share < 0.25
    # claim 7 for 1-DOF asks for an error of about half the size
    half = {"error_harmonics": ((0.48e-6, 0.0),)}
    assert periodic_orbit(reconstructed(form="one_dof", mesh=half), 1.0).separation_share < 0.15


def test_9_third_order_peaks_near_a_third_for_constant_radii_too():
    ratios = (0.29, 0.31, 0.33, 0.35, 0.37)
    orbits = [shipped(ratio, form="one_dof") for ratio in ratios]
    third = [np.abs(np.fft.rfft(orbit.x))[3] for orbit in orbits]
    assert ratios[np.argmax(third)] == 0.33


@functools.cache
def lubricated(ratio, temperature=313.15):
    """Flank contacts and motion with the paper's choices for the film."""
    parameters = replace(
        karagiannis_2012_pair(),
        friction="thermal_eyring",
        film="as_printed",
        film_temperature="effective",
        oil_temperature=temperature,
    )
    problem = PeriodProblem(parameters, steps_per_mesh_period=128)
    speed = problem.model.pinion_speed(ratio * problem.model.natural_frequency)
    motion = motion_near("two_dof_lubricated", problem, problem.initial_guess(speed), ratio)
    return flank_cycle(motion, parameters).values, motion.orbit


def loaded(values, name):
    """A quantity where a pair carries more than a tenth of the static load."""
    load = np.nan_to_num(values["load"])
    return values[name][load > 0.1 * 50.0 / 21.1e-3]


@pytest.mark.slow
def test_11_oil_hardly_changes_the_swing_where_teeth_part():
    # fig. 17: almost identical; also the one motion there, so no jump of branch
    assert np.ptp(lubricated(1.0)[1].x) == pytest.approx(np.ptp(shipped(1.0).x), rel=0.02)


def test_31_friction_at_100_degc_is_no_statement_of_the_model():
    """Not reproducible: +0.5 % is printed; the load torque shows what the losses do."""
    losses = []
    for temperature in (313.15, 373.15):
        orbit = lubricated(0.3, temperature)[1]
        balance = HypoidTorsional(karagiannis_2012_pair()).mean_load_torque
        losses.append(1.0 - orbit.load_torque / balance)
    # what viscous friction loses boundary friction gains: a few per cent, not a half
    assert 0.005 < losses[1] / losses[0] - 1.0 < 0.2


@pytest.mark.slow
@each(("ratio", "temperature"), [(1.0, 313.15), (0.3, 373.15)])
def test_12_13_friction_brakes_the_pinion_a_little_on_every_flank(ratio, temperature):
    torque = lubricated(ratio, temperature)[0]["torque_pinion"]
    assert np.nanmax(torque) <= 0.0
    assert np.nansum(torque, axis=0).min() > -0.04 * 50.0


@pytest.mark.slow
def test_23_film_peaks_near_a_micrometre_where_the_load_is_small():
    values, _ = lubricated(1.0)
    film = loaded(values, "film_thickness")
    assert 0.7e-6 < film.max() < 1.2e-6
    # where the load is highest half of that: the peaks flank the losses of contact
    hardest = np.unravel_index(np.nanargmax(values["load"]), values["load"].shape)
    assert values["film_thickness"][hardest] < 0.7 * film.max()


def test_24_entrainment_triples():
    fast, slow = (loaded(lubricated(r)[0], "entrainment_speed").max() for r in (1.0, 0.3))
    # 1/0.3 by kinematics; almost three times is printed
    assert 2.7 < fast / slow < 3.4


def test_25_film_at_resonance_warms_by_a_fifth_but_thins_by_more_than_a_third():
    fast, slow = (lubricated(r)[0] for r in (1.0, 0.3))
    assert 0.12 < loaded(fast, "rise_effective").max() / 313.15 < 0.25
    # not found: a third is printed, 20 to 60 % would do
    viscosity = [loaded(values, "effective_viscosity").max() for values in (fast, slow)]
    assert viscosity[0] / viscosity[1] < 0.4


def test_29_30_hot_oil_is_much_less_viscous_than_printed_and_stays_near_the_oil_temperature():
    """Not reproducible: 145 degC and a third of the viscosity are printed."""
    hot, cold = (lubricated(0.3, T)[0] for T in (373.15, 313.15))
    assert loaded(hot, "rise_centre").max() < 10.0
    viscosity = [loaded(values, "effective_viscosity").max() for values in (hot, cold)]
    # eq. (16) with Table 2 alone: eta0 falls to a sixth, the effect of 0.6 GPa to a quarter
    assert 0.04 < viscosity[0] / viscosity[1] < 0.15


def test_18_the_cold_film_is_warmer_than_the_41_degc_printed():
    """1 to 3 % of 40 degC are 41 degC; of 313 K they are 43 to 49 degC, which is found."""
    rise = loaded(lubricated(0.3)[0], "rise_effective")
    assert np.all((rise > 0.005 * 313.15) & (rise < 0.05 * 313.15))
    assert rise.max() > 5.0


def test_with_a_mismatch_motions_of_two_mesh_periods_coexist_at_resonance():
    """From the paper's x = 0 the pair does not settle on the motion that repeats with the mesh."""
    parameters = reconstructed(0.002)
    model = HypoidTorsional(parameters)
    rows, p = model.rows(256), model.kernel_parameters
    speed = model.pinion_speed(model.natural_frequency)
    y = model.initial_state(speed)
    y[0] = -75.0
    load = settle_load(y, 40, model.mean_load_torque, speed, rows, p, WORK)
    record = np.zeros((4 * 256, N_RECORD))
    march(y, 0, 600, load, speed, rows, p, record[:0], WORK)
    march(y, 600, 4, load, speed, rows, p, record, WORK)
    periods = record[:, 1].reshape(4, 256)
    swing = np.ptp(periods)
    assert np.max(np.abs(periods[2:] - periods[:2])) < 0.01 * swing
    assert np.max(np.abs(periods[1:] - periods[:-1])) > 0.1 * swing
    assert swing > 2e6 * np.ptp(periodic_orbit(parameters, 1.0).x)
