"""Inputs of the torsional pair that are refused, and what is said about them."""

import dataclasses

import numpy as np
import pytest

from gearlube_core.dynamics.hypoid_torsional.model import HypoidTorsional
from gearlube_core.dynamics.hypoid_torsional.parameters import karagiannis_2012_pair
from gearlube_core.dynamics.hypoid_torsional.synthetic_mesh import synthetic_mesh
from gearlube_core.dynamics.hypoid_torsional.time_sweep import time_sweep
from gearlube_core.errors import ParameterError, StepError
from tests.helpers.each import each
from tests.helpers.torsional_cases import reconstructed

PAIR = karagiannis_2012_pair()


@each(
    ("change", "says"),
    [
        ({"pinion_torque": -50.0}, "driven by its pinion"),
        ({"backlash": 150.0}, "1.5e-4 m"),
        ({"form": "three_dof"}, "one_dof, two_dof|two_dof, one_dof"),
        ({"friction": "dry"}, "thermal_eyring"),
        ({"form": "one_dof", "friction": "evans_johnson"}, "choose form 'two_dof'"),
        ({"torque_ripple": 10.0}, "0.1"),
        ({"pinion_inertia": 0.0}, "kg m2"),
        ({"damping": -1.0}, "N s/m"),
        ({"oil_temperature": 40.0}, "oil_temperature"),
        ({"film": "thick"}, "as_printed"),
        ({"radii": "own"}, "paper"),
    ],
)
def test_refused_with_limit_and_cure(change, says):
    with pytest.raises(ParameterError, match=says):
        dataclasses.replace(PAIR, **change)


def test_sweep_refuses_what_it_cannot_run():
    with pytest.raises(ParameterError, match="up, down"):
        time_sweep(PAIR, [500.0], "sideways")
    with pytest.raises(ParameterError, match="rad/s"):
        time_sweep(PAIR, [1e6], "up")
    with pytest.raises(ParameterError, match="256"):
        time_sweep(PAIR, [500.0], "up", steps_per_mesh_period=3)


def test_sweep_names_the_frequency_that_fails():
    """Undamped, coarse steps at low speed are unstable: 16 a mesh period is 0.1 a mode period."""
    with pytest.raises(StepError, match="10 Hz"):
        time_sweep(reconstructed(damping=0.0), [10.0], "up", steps_per_mesh_period=16, periods=900)


@pytest.mark.parametrize(
    ("change", "says"),
    [
        ({"stiffness": 0.0}, "N/m"),
        ({"radius_mismatch": 2.0}, "0.002"),
        ({"contact_ratio": 4.0}, "contact_ratio"),
    ],
)
def test_synthetic_mesh_refuses(change, says):
    with pytest.raises(ParameterError, match=says):
        synthetic_mesh(**change)


def test_synthetic_mesh_is_what_was_asked_for():
    model = HypoidTorsional(
        reconstructed(0.003, mesh={"stiffness_harmonics": ((0.05, 0.01),), "contact_ratio": 2.2})
    )
    phi = 0.123
    K, _, R_p, R_g, de = model.row(phi)[0, :5]
    c, s = np.cos(13 * phi), np.sin(13 * phi)
    assert pytest.approx(4.55e8 * (1.0 + 0.05 * c + 0.01 * s)) == K
    assert R_p == pytest.approx(21.1e-3 * (1.0 + 0.003 * c))
    assert R_g == pytest.approx(21.1e-3 * 36 / 13)
    assert de == pytest.approx(-13 * 0.96e-6 * s)
