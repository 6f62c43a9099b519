"""A ratio error of the radii is a transmission error: claim 14."""

import numpy as np
import pytest

from gearlube_core.dynamics.hypoid_torsional.model import HypoidTorsional
from gearlube_core.dynamics.hypoid_torsional.time_sweep import time_sweep
from tests.helpers.each import each
from tests.helpers.torsional_cases import periodic_orbit, reconstructed

R_P0, TEETH, D = 21.1e-3, 13, 0.002
# R_p = R_p0 (1 + d cos z phi) moves x by int R_p0 d cos(z phi) dphi = R_p0 d/z sin(z phi)
ERROR = {"error_harmonics": ((0.96e-6, -R_P0 * D / TEETH),)}


@each("ratio", [0.3, 0.5, 0.65])
def test_a_radius_mismatch_is_an_error_of_its_integral(ratio):
    with_radii = periodic_orbit(reconstructed(D), ratio)
    with_error = periodic_orbit(reconstructed(radii="mean", mesh=ERROR), ratio)
    # the pinion's arm is R_p - e' in both: the same equations but for rounding
    assert with_error.x == pytest.approx(with_radii.x, abs=1e-15)
    reduced = periodic_orbit(reconstructed(form="one_dof", mesh=ERROR), ratio)
    # the reduction leaves out that the mesh torque swings by d and the pinion's speed by as much
    # as in claim 3, with its tolerance
    assert np.ptp(reduced.x) == pytest.approx(np.ptp(with_radii.x), rel=0.02)


def test_the_same_holds_at_resonance_where_teeth_separate():
    frequency = [HypoidTorsional(reconstructed()).natural_frequency]
    with_radii = time_sweep(reconstructed(D), frequency, "up")
    reduced = time_sweep(reconstructed(form="one_dof", mesh=ERROR), frequency, "up")
    assert with_radii.separation_share[0] > 0.2
    assert reduced.peak_to_peak[0] == pytest.approx(with_radii.peak_to_peak[0], rel=0.01)


def test_radii_that_vary_together_hardly_matter():
    """1 % of both radii, no ratio error, against 1 % of one, which is 16 um of error (claim 10)."""
    constant = np.ptp(periodic_orbit(reconstructed(), 0.5).x)
    together = np.ptp(periodic_orbit(reconstructed(mesh={"radius_modulation": 0.01}), 0.5).x)
    one = np.ptp(periodic_orbit(reconstructed(0.01), 0.5).x)
    # 1 % of both arms moves the super-harmonic at half the natural frequency: some ten times 1 %
    assert together == pytest.approx(constant, rel=0.15)
    assert one > 1.5 * constant
