"""What a mesh table says of a pair's contact, and what a film's problem makes of it."""

from dataclasses import replace

import numpy as np
import pytest

from gearlube_core.ehl.gears.hypoid_flank import pair_contact, phase_of
from gearlube_core.errors import ParameterError
from gearlube_core.hypoid_contact.contact_kinematics import path_kinematics
from gearlube_core.hypoid_contact.contact_path import contact_path
from gearlube_core.hypoid_contact.pair import FlankPair
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from gearlube_core.mesh_table.netcdf import shipped_mesh_table
from gearlube_core.mesh_table.sliding_direction import sliding_direction
from tests.helpers.each import each
from tests.helpers.hypoid_film_cases import flank_cycle, hypoid_film

TABLE = shipped_mesh_table("mohammadpour_2015")


@each("true", np.radians([20.0, 80.0, 100.0, 170.0, -15.0, -120.0]))
def test_a_folded_angle_of_sliding_finds_its_quadrant(true):
    psi = np.radians([50.0])
    folded = np.arccos(np.abs(np.cos([true])))
    found = sliding_direction(psi, folded, np.cos(psi - true))
    assert np.cos(found[0] - true) == pytest.approx(1.0, abs=1e-12)


@pytest.mark.parametrize("torque", [50.0, -100.0])
def test_vectors_at_nodes_have_the_arms_of_the_table(torque):
    level = int(np.flatnonzero(TABLE.torque == torque)[0])
    w = {key: values[level] for key, values in TABLE.windows.items()}
    node = np.arange(0, TABLE.nodes, 7)
    found = pair_contact(TABLE, torque, 3.0 * node / TABLE.nodes - 1.5)
    speed = np.linalg.norm(found.entrainment, axis=1)
    slip = np.linalg.norm(found.sliding, axis=1)
    np.testing.assert_allclose(speed, w["entrainment_arm"][node], rtol=1e-12)
    # xi.v of either member is its arm
    half = 0.5 * found.sliding
    xi = found.sliding / slip[:, None]
    pinion = np.einsum("ni,ni->n", found.entrainment + half, xi)
    gear = np.einsum("ni,ni->n", found.entrainment - half, xi) * TABLE.ratio
    # chi is stored beside the arms, each interpolated: a few micrometres of 20 mm
    np.testing.assert_allclose(pinion, w["friction_arm_p"][node], rtol=3e-3)
    np.testing.assert_allclose(gear, w["friction_arm_g"][node], rtol=3e-3)


@pytest.mark.parametrize(("torque", "side"), [(50.0, "drive"), (-50.0, "coast")])
def test_vectors_are_those_of_the_flanks(torque, side):
    """Sliding along the minor axis changes its sign within the engagement; the table folds it."""
    pair = FlankPair.from_file(HypoidGearFile.named("mohammadpour_2015"), side)
    phase = np.linspace(-0.4, 0.5, 5)
    k = path_kinematics(contact_path(pair, phase * pair.gear_pitch))
    found = pair_contact(TABLE, torque, phase)
    for column, axis in enumerate((k.minor_axis, k.major_axis)):
        side_of = np.sign(np.einsum("ni,ni->n", k.entrainment, axis))
        for vectors, exact in ((found.entrainment, k.entrainment), (found.sliding, k.sliding)):
            expected = side_of * np.einsum("ni,ni->n", exact, axis)
            # the table holds the centre of force of loaded flanks, 1 mm from the unloaded point
            np.testing.assert_allclose(vectors[:, column], expected, atol=1e-3)
    if side == "drive":
        assert found.sliding[0, 0] < 0.0 < found.sliding[-1, 0]


def test_phase_counts_mesh_periods_from_the_middle_of_the_window():
    period = 2.0 * np.pi / TABLE.pinion_teeth
    np.testing.assert_allclose(phase_of(TABLE, period * np.array([0.0, 1.5, 2.9, 3.0])),
                               [-1.5, 0.0, 1.4, -1.5], atol=1e-12)  # fmt: skip


def test_conditions_hold_load_speeds_and_the_paraboloid_of_the_time():
    cycle = flank_cycle()
    film = hypoid_film(cycle)
    x, y = np.array([-1e-4, 0.0, 2e-4]), np.array([-2e-3, 1e-3])
    time = float(cycle.time[10])
    now = film.conditions(x, y, time)
    assert now.load == cycle.load[10]
    u, v = cycle.entrainment[10]
    assert now.slope == pytest.approx(v / u)
    np.testing.assert_allclose(0.5 * (now.speed_1 + now.speed_2), u)
    np.testing.assert_allclose(now.speed_2 - now.speed_1, cycle.sliding[10, 0])
    assert now.side_sliding == pytest.approx(cycle.sliding[10, 1])
    expected = x[:, None] ** 2 / (2 * cycle.R_x[10]) + y**2 / (2 * cycle.R_y[10])
    np.testing.assert_allclose(now.gap, expected)
    # the domain of the march holds the ellipse of every instant
    (x_low, x_high), (y_low, y_high) = film.domain()
    for instant in cycle.instants():
        a_x, a_y, _ = film.problem(instant).hertz_contact
        assert x_low < -2.4 * a_x
        assert 1.4 * a_x < x_high
        assert y_low < -a_y
        assert a_y < y_high


@pytest.mark.parametrize(
    ("change", "says"),
    [
        ({"load": lambda v: v - v.max()}, "load of a flank's cycle must be above 0 N"),
        ({"entrainment": lambda v: -v}, "entrainment of a flank's cycle must be above 0 m/s"),
        ({"time": lambda v: v[::-1]}, "time of a flank's cycle must rise"),
        ({"R_x": lambda v: v[:-1]}, "R_x of a flank's cycle must be finite and of shape"),
    ],
)
def test_a_cycle_that_makes_no_sense_is_refused(change, says):
    cycle = flank_cycle()
    with pytest.raises(ParameterError, match=says):
        replace(cycle, **{name: act(getattr(cycle, name)) for name, act in change.items()})
