"""The e-axle in its case, against the finite elements from which the case was reduced."""

from __future__ import annotations

import tomllib
from functools import cache

import numpy as np
import pytest

from drivetrain.train.train_file import TrainFile
from examples.e_axle_case import PANELS, WholeCase, factors, free_modes, whole_case
from gearlube_core.dynamics.train.response import frequency_response
from gearlube_core.housings.housing_modes import housing_motion
from gearlube_core.housings.model_files import read_reduced_model
from tests.helpers.elastic_e_axle import case
from tests.helpers.whole_e_axle import WholeAxle, whole_axle

MODEL = read_reduced_model("e_axle_case")
HIGHEST = 5e3  # Hz
ROAD = 669.745 + 520.913  # N.m, of both wheels


def test_mounts_bear_the_torque_of_the_wheels():
    """Forces of the mounts add up to nothing, their moments to that torque."""
    given = case("e_axle_case")
    given.start()
    found = given.train.outputs()
    places = {one.name: np.array(one[1:]) for one in MODEL.nodes if one.name.startswith("mount")}
    forces = [np.array([found[f"{name}.force.{c}"] for c in "xyz"]) for name in places]
    assert abs(sum(forces)).max() < 1e-6 * abs(np.array(forces)).max()  # rest is found to 1e-9
    moment = sum(np.cross(at, force) for at, force in zip(places.values(), forces, strict=True))
    # the case of 4 mm deflection on arms of 0.3 m: their change is left out
    assert moment[2] == pytest.approx(ROAD, rel=1e-5)


@cache
def whole() -> tuple[WholeCase, WholeAxle]:
    data = tomllib.loads(TrainFile.shipped_text("e_axle_case"))
    found = whole_case()
    return found, whole_axle(data, found)


@pytest.mark.slow
def test_unit_loads_at_nodes_bend_the_case_as_its_finite_elements():
    """Elastic deflection under forces and moments at all nodes, for modes up to any limit."""
    found, _ = whole()
    n = found.owner.size
    loads = np.eye(found.mass.shape[0])[:, -n:]
    rigid = _rigid(found)
    loads = loads - found.mass @ rigid @ (rigid.T @ loads)  # inertia bears what does not balance
    held = np.ones(len(loads), bool)
    held[np.flatnonzero(found.owner == 7) - n] = False  # one mount
    moved = np.zeros_like(loads)
    moved[held] = factors(found.stiffness[held][:, held].tocsc()).solve(loads[held])
    moved -= rigid @ (rigid.T @ (found.mass @ moved))
    for limit in (HIGHEST, 1e6):
        motion = housing_motion(MODEL, True, limit)
        elastic = motion.stiffness > 0.0
        shapes = motion.shapes[elastic][:, found.owner, found.direction]
        ours = shapes.T @ (shapes / motion.stiffness[elastic][:, None])
        scale = 1.0 / np.sqrt(np.diag(moved[-n:]))  # metres and radians alike
        error = (ours - moved[-n:]) * np.outer(scale, scale)
        assert abs(error).max() < 1e-6  # rounding of stiffness from 1e5 to 1e12 N/m


def _rigid(found: WholeCase) -> np.ndarray:
    """Return six rigid motions of modal mass 1."""
    return free_modes(found, 6)[1]


@pytest.mark.slow
def test_shafts_in_the_reduced_case_have_the_frequencies_of_the_whole_model():
    """To 1e-4 below 5 kHz with all modes that the reduced model keeps, of shafts as well."""
    _, axle = whole()
    fake = WholeCase(axle.stiffness, axle.mass, (), np.zeros(0), np.zeros(0))
    expected = np.sqrt(abs(free_modes(fake, 110)[0])) / (2.0 * np.pi)
    below = (expected > 1.0) & (expected < HIGHEST)
    assert below.sum() == 93
    given = case("e_axle_case", highest_frequency_hz=1e6)
    given.start()
    found = given.train.modes()[0][: below.size]
    np.testing.assert_allclose(found[below], expected[below], rtol=2e-4)
    slow = below & (expected < 0.5 * HIGHEST)
    np.testing.assert_allclose(found[slow], expected[slow], rtol=5e-6)
    # as it ships: modes of the case to 7.5 kHz, of the shafts to 10 kHz
    given = case("e_axle_case")
    given.start()
    found = given.train.modes()[0][: below.size]
    np.testing.assert_allclose(found[below], expected[below], rtol=1e-3)


@pytest.mark.slow
def test_panels_answer_a_transmission_error_as_in_the_whole_model():
    """Near resonances, at 1 kHz; the same complex stiffness damps both."""
    _, axle = whole()
    given = case("e_axle_case", highest_frequency_hz=1e6)
    given.start()
    ways = [f"case.{name}.displacement.{c}" for name, c in zip(PANELS, "yxz", strict=True)]
    found = frequency_response(given.train, "stage_1", ways, [1000.0], 0.02)[0]
    complex_share = 1.0 + 0.04j  # of all stiffness, that of the mesh with the error too
    dynamic = complex_share * axle.stiffness - (2e3 * np.pi) ** 2 * axle.mass
    moved = factors(dynamic.tocsc()).solve(complex_share * axle.pushes["stage_1"])
    expected = np.array([moved[axle.first[f"case.{name}"]] for name in PANELS])
    assert abs(found - expected).max() < 1e-3 * abs(expected).max()  # differences of 1e-9 m
