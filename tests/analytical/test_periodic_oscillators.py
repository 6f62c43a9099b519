"""Forced oscillators whose periodic motions are known in closed form or by expansion."""

import math

import numpy as np
import pytest
from scipy.optimize import brentq
from scipy.special import mathieu_a, mathieu_b

from gearlube_core.periodic import ContinuationSettings, follow, solve_periodic
from tests.helpers.each import each
from tests.helpers.periodic_cases import Oscillator, oscillator_problem


def test_linear_oscillator_answers_as_its_complex_stiffness_says():
    w, d = 1.3, 0.2
    problem = oscillator_problem(Oscillator(damping=d, force=1.0), "frequency", steps=512)
    motion = solve_periodic(problem, np.zeros(2), w)
    x = 1.0 / (1.0 - w * w + 1j * w * d)  # x(t) = Re(x exp(i w t))
    # RK4 at 512 steps: (w h)^4/120 a period, about 1e-9
    assert motion.unknowns == pytest.approx([x.real, (1j * w * x).real], abs=1e-8)
    assert motion.iterations == 1
    root = -d / 2 + 1j * math.sqrt(1 - d * d / 4)
    expected = np.exp(root * 2 * math.pi / w)
    assert motion.multipliers[0] == pytest.approx(
        expected if expected.imag > 0 else expected.conjugate(), abs=1e-8
    )
    assert motion.margin == pytest.approx(1 - math.exp(-d * math.pi / w), abs=1e-8)


def test_linear_resonance_curve_peaks_at_its_exact_frequency_and_stays_stable():
    d = 0.1
    problem = oscillator_problem(Oscillator(damping=d, force=0.1), "frequency")
    values = np.linspace(0.3, 1.7, 15)
    branch = follow(problem, np.array([0.1, 0.0]), 0.25, limits=(0.25, 2.0), at=values)
    rows = [branch.at(w).item() for w in values]
    w = branch.parameter[rows]
    x = 0.1 / (1 - w * w + 1j * w * d)
    assert branch.unknowns[rows, 0] == pytest.approx(x.real, abs=1e-6)  # RK4 at 256 steps
    assert branch.unknowns[rows, 1] == pytest.approx((1j * w * x).real, abs=1e-6)
    assert branch.special == ()
    assert branch.stable.all()


@each(("force", "w"), [(0.0, 1.0), (0.3, 0.9), (0.5, 1.4)])
def test_product_of_multipliers_is_the_integral_of_the_divergence(force, w):
    # Liouville: constant divergence -d here, whatever the nonlinear motion
    oscillator = Oscillator(damping=0.15, force=force, cubic=0.4, stop=3.0, gap=0.1)
    motion = solve_periodic(oscillator_problem(oscillator, "frequency"), np.array([0.3, 0.0]), w)
    product = np.prod(motion.multipliers)
    # a kink inside an RK4 step costs order h^2, 6e-4 at 256 steps
    assert product == pytest.approx(math.exp(-0.15 * 2 * math.pi / w), abs=2e-4)


def test_mathieu_tongues_open_at_the_characteristic_values():
    # x'' + (a - 2 q cos 2t) x = 0: first tongue doubles the period, the second keeps it
    q = 0.1
    oscillator = Oscillator(frequency=2.0, parametric=-2.0 * q)
    problem = oscillator_problem(oscillator, "stiffness")
    doubled, crossed = (
        follow(
            problem,
            np.zeros(2),
            limits[0],
            limits=limits,
            # the trivial motion is a straight line: without a limit a step passes a whole tongue
            settings=ContinuationSettings(step=step, largest_step=step),
        ).special
        for limits, step in (((0.53, 1.4), 0.05), ((3.95, 4.05), 0.002))
    )
    assert [p.kind for p in doubled] == ["period doubling"] * 2
    assert [p.kind for p in crossed] == ["branch point"] * 2
    doubled, crossed = ([p.parameter for p in found] for found in (doubled, crossed))
    # RK4 with 256 steps shifts frequencies by about 1e-8 relative, Abramowitz and Stegun 20.2.25
    assert doubled == pytest.approx([mathieu_b(1, q), mathieu_a(1, q)], abs=1e-6)
    assert doubled == pytest.approx(
        [1 - q - q * q / 8 + q**3 / 64, 1 + q - q * q / 8 - q**3 / 64], abs=q**4
    )
    assert crossed == pytest.approx([mathieu_b(2, q), mathieu_a(2, q)], abs=1e-5)


def duffing_folds(k, d, b, f):
    """Return fold frequencies by one harmonic: ((k + 3 b y/4 - w^2)^2 + d^2 w^2) y = f^2, y = A^2.

    The cubic in y has a double root there: its discriminant changes sign.
    """

    def discriminant(w):
        u = k - w * w
        c3, c2, c1, c0 = 9 * b * b / 16, 1.5 * b * u, u * u + d * d * w * w, -f * f
        return (
            18 * c3 * c2 * c1 * c0
            - 4 * c2**3 * c0
            + (c2 * c1) ** 2
            - 4 * c3 * c1**3
            - 27 * (c3 * c0) ** 2
        )

    w = np.linspace(0.9, 2.5, 3201)
    signs = np.sign([discriminant(value) for value in w])
    ends = np.flatnonzero(np.diff(signs))
    return [brentq(discriminant, w[i], w[i + 1], xtol=1e-12) for i in ends]


def test_hardening_duffing_folds_where_one_harmonic_says():
    d, b, f = 0.06, 0.05, 0.12
    low, high = duffing_folds(1.0, d, b, f)
    problem = oscillator_problem(Oscillator(damping=d, cubic=b, force=f), "frequency")
    branch = follow(problem, np.array([0.15, 0.0]), 0.5, limits=(0.5, 1.8))
    folds = branch.of_kind("fold")
    # the third harmonic is b A^2/32 = 0.6 % of the first at A = 2 and counts with its square and
    # with b A^2/4 of stiffness: below 0.1 % of frequency
    assert [p.parameter for p in folds] == pytest.approx([high, low], rel=1e-3)
    assert [stable for _, stable in branch.runs()] == [True, False, True]
    at_fold = branch.multipliers[folds[0].index]
    assert at_fold[0] == pytest.approx(1.0, abs=1e-5)


def test_forced_van_der_pol_loses_entrainment_at_amplitude_root_two():
    # averaging: a pair leaves the unit circle where the mean of 1 - x^2 is 0, so A^2 = 2 and
    # F^2 = 2 ((1 - w^2)^2 + (mu w/2)^2); detuned enough for a complex pair
    mu, w = 0.1, 1.1
    expected = math.sqrt(2.0 * ((1 - w * w) ** 2 + (mu * w / 2) ** 2))
    oscillator = Oscillator(frequency=w, self_excitation=mu)
    problem = oscillator_problem(oscillator, "force")
    branch = follow(problem, np.array([-2.0, 0.0]), 0.45, limits=(0.2, 0.5), heading=-1.0)
    (point,) = branch.special
    assert point.kind == "Neimark-Sacker"
    assert point.parameter == pytest.approx(expected, rel=mu**2)  # averaging is of first order
    assert [stable for _, stable in branch.runs()] == [True, False]
    # independent of averaging: mean of 1 - x^2 over the period is exactly 0 there (Liouville)
    at = problem.residual(point.unknowns, point.parameter)[3]
    assert np.linalg.det(at) == pytest.approx(1.0, abs=1e-6)
