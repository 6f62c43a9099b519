"""Friction by the film model between nodes of the mesh table, and when nodes are renewed."""

import numpy as np
import pytest

from gearlube_core.dynamics.hypoid_axle import HypoidAxle
from gearlube_core.dynamics.hypoid_mesh import flanks, node_films, tooth_pair
from gearlube_core.dynamics.hypoid_mesh.mesh_at_load import (
    MeshAtLoad,
    MeshLevels,
    blend_mesh,
)
from gearlube_core.dynamics.hypoid_mesh.mesh_force import MeshMotion
from gearlube_core.dynamics.packed_mesh import N_CHANNELS
from gearlube_core.oil.lubricant_state import lubricant_state
from tests.helpers.axle_cases import OIL, axle_with
from tests.helpers.each import each

FORCE, SPEED, TORQUE, TEETH = 2500.0, 145.0, 60.0, 13


class Flanks:
    """All flanks of the shipped axle with solved films under a given mesh force and speed."""

    def __init__(self):
        axle = HypoidAxle(axle_with(film="solved"))
        mesh, self.p = axle.parameters.packed_mesh(), axle.kernel_parameters
        window = np.zeros(mesh.window_size)
        levels = MeshLevels(mesh.levels, mesh.series, mesh.orders, mesh.windows, mesh.nodes)
        at_load = MeshAtLoad(np.zeros(mesh.series_size), mesh.orders, window, mesh.nodes)
        blend_mesh(TORQUE, 1.0, levels, at_load)
        self.window, self.nodes = window, mesh.nodes
        self.model = axle.parameters.film_model()
        self.kept = np.zeros(flanks.N_FRICTION)

    def losses(self, phase, refresh, force=FORCE, speed=SPEED, oil=OIL):
        """Viscous and boundary power [W], bound of their sum [W]; phase in windows."""
        angle = phase * 2.0 * np.pi * 3.0 / TEETH
        motion = MeshMotion(angle, 0.0, speed, speed * TEETH / 36.0, *6 * (0.0,))
        found = flanks.flank_sum(
            motion, force, self.window, self.nodes,
            lubricant_state(self.p.oil, oil), self.p, refresh, self.kept, np.zeros(N_CHANNELS),
            self.model,
        )  # fmt: skip
        return found.viscous_power, found.boundary_power, self.kept[flanks.BOUND_POWER]


@pytest.fixture
def axle():
    return Flanks()


def test_friction_between_nodes_is_near_that_at_the_contact_itself(axle):
    phases = np.random.default_rng(3).uniform(0.0, 1.0, 100)
    exact = np.array([axle.losses(x, tooth_pair.EXACT) for x in phases])
    between = np.array([axle.losses(x, tooth_pair.BETWEEN_NODES) for x in phases])
    error = between / exact - 1.0
    # a pair's friction goes from 0 to its height and back over some 40 nodes: a line misses
    # (pi/40)^2/8 = 8e-4 of a half sine, several times that near the border of the model's domain
    crosses = abs(error[:, 2]) > 0.05  # a flank goes over the border within one interval
    assert abs(error[~crosses, :2]).max() < 8e-3
    assert crosses.mean() < 0.05
    # such a flank carries little
    assert abs(between[:, :2].sum(axis=1) / exact[:, :2].sum(axis=1) - 1.0).max() < 5e-3
    assert abs(error[:, :2].mean(axis=0)).max() < 1e-3
    # over that border the bound rises from 1 % to that of the formulas
    assert np.median(abs(error[:, 2])) < 0.01


def test_at_a_node_friction_is_that_at_the_contact_itself(axle):
    for node in range(0, axle.nodes, 7):
        phase = (node + 1e-9) / axle.nodes
        at_node = axle.losses(phase, tooth_pair.BETWEEN_NODES)
        # what lies in 1e-9 of an interval
        assert at_node == pytest.approx(axle.losses(phase, tooth_pair.EXACT), rel=1e-7)


@pytest.mark.parametrize(
    ("now", "holds"),
    [
        ({"force": 1.02 * FORCE}, True),
        ({"force": 1.04 * FORCE}, False),
        ({"force": -FORCE}, False),
        ({"speed": 1.02 * SPEED}, True),
        ({"speed": 0.96 * SPEED}, False),
        ({"oil": OIL + 0.05}, True),
        ({"oil": OIL + 0.2}, False),
    ],
)
def test_nodes_are_evaluated_fresh_when_force_speed_or_oil_have_changed(axle, now, holds):
    axle.losses(0.3, tooth_pair.BETWEEN_NODES)
    before = axle.kept[flanks.FILMS :].copy()
    found = axle.losses(0.3, tooth_pair.BETWEEN_NODES, **now)
    assert np.array_equal(axle.kept[flanks.FILMS :], before) == holds
    if not holds:
        # as by an axle that keeps nothing
        assert found == Flanks().losses(0.3, tooth_pair.BETWEEN_NODES, **now)


def test_nodes_that_share_a_place_do_not_serve_one_another(axle):
    axle.losses(0.3, tooth_pair.BETWEEN_NODES)
    films = axle.kept[flanks.FILMS :]
    node = int(0.3 * axle.nodes)
    other = node + node_films.NODES_KEPT
    assert node_films.place_of_node(other) == node_films.place_of_node(node)
    assert node_films.still_holds(films, node, FORCE, SPEED, OIL)
    assert not node_films.still_holds(films, other, FORCE, SPEED, OIL)


@pytest.mark.parametrize("now", [{"force": 1.025 * FORCE}, {"speed": 0.975 * SPEED}])
def test_what_is_kept_follows_force_and_speed(axle, now):
    phases = np.arange(0.0, 1.0, 0.05)
    for phase in phases:
        axle.losses(phase, tooth_pair.BETWEEN_NODES)
    kept = np.array([axle.losses(phase, tooth_pair.BETWEEN_NODES, **now)[:2] for phase in phases])
    fresh = Flanks()
    exact = np.array([fresh.losses(phase, tooth_pair.BETWEEN_NODES, **now)[:2] for phase in phases])
    then = np.array([axle.losses(phase, tooth_pair.BETWEEN_NODES)[:2] for phase in phases])
    # friction power follows force and speed by 1 to 3 %; slopes are those over the next 2 %, so
    # that 0.025 (0.025 + 0.02)/2 = 6e-4 is left, times a curvature of about one
    assert abs(kept / exact - 1.0).max() < 1e-3
    assert abs(then / exact - 1.0).max() > 1e-2


def power_law(force, speed):
    # slopes over relative changes are the exponents times the value
    return node_films.NodeFlank(
        -15.0 - 0.07 * np.log(force) + 0.7 * np.log(speed),
        -3.0 + 0.3 * np.log(force) - 0.2 * np.log(speed),
        1e-3 * force**0.3 * speed**-0.2,
        1e-4 * force**-0.5 * speed**-1.5,
        0.0,
        0.01,
    )


def kept_after(*states):
    """Films of node 3 under forces and speeds that follow one another."""
    films = np.zeros(node_films.N_FILMS)
    more = 1.0 + node_films.NUDGE
    for k, (F, w) in enumerate(states):
        if k == 0:
            node_films.keep_flank(films, 3, F, w, OIL, power_law(F, w))
            node_films.keep_slopes(films, 3, power_law(more * F, w), False)
            node_films.keep_slopes(films, 3, power_law(F, more * w), True)
        else:
            assert node_films.tells_slopes(films, 3, F, w, OIL)
            node_films.follow_flank(films, 3, F, w, power_law(F, w))
    return films


@each("then", [(2000.0, 150.0), (2500.0, 130.0), (1800.0, 160.0)])
def test_renewed_slopes_give_back_the_values_before(then):
    films = kept_after(then, (FORCE, SPEED))
    before = node_films.flank_between(films, 3, 3, 0.0, *then)
    assert before[:4] == pytest.approx(power_law(*then)[:4], rel=1e-13)


def test_renewed_slopes_stay_across_the_change():
    films = kept_after((FORCE, SPEED), (1.1 * FORCE, SPEED))
    # only the force has changed: the slope over speed is the first one, a secant over NUDGE of
    # the values at the first force
    faster = node_films.flank_between(films, 3, 3, 0.0, 1.1 * FORCE, 1.02 * SPEED)
    now = power_law(1.1 * FORCE, SPEED)
    first, nudged = power_law(FORCE, SPEED), power_law(FORCE, 1.02 * SPEED)
    for k in range(4):
        assert faster[k] - now[k] == pytest.approx(nudged[k] - first[k], rel=1e-9)


def test_values_follow_a_force_that_goes_on_changing(axle):
    phases = np.arange(0.0, 1.0, 0.05)
    for force in (FORCE, 1.06 * FORCE):
        for phase in phases:
            axle.losses(phase, tooth_pair.BETWEEN_NODES, force=force)
    kept, exact = (
        np.array([one.losses(x, tooth_pair.BETWEEN_NODES, force=1.085 * FORCE)[:2] for x in phases])
        for one in (axle, Flanks())
    )
    # slopes over the last 6 %: 0.023 (0.023 + 0.06)/2 = 1e-3 is left, times a curvature of one
    assert abs(kept / exact - 1.0).max() < 1e-3


@each(
    ("now", "tells"),
    [
        ({"force": 2.4}, True),
        ({"force": 2.6}, False),
        ({"force": -1.0}, False),
        ({"speed": 0.5}, False),
        ({"oil": 0.2}, False),
    ],
)
def test_slopes_are_taken_from_nothing_after_large_changes(now, tells):
    films = kept_after((FORCE, SPEED))
    force, speed = (given * now.get(n, 1.0) for n, given in (("force", FORCE), ("speed", SPEED)))
    assert node_films.tells_slopes(films, 3, force, speed, OIL + now.get("oil", 0.0)) == tells
