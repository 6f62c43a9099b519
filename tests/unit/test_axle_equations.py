"""Equations of motion of the axle and its mesh between levels, with made-up forces."""

from types import SimpleNamespace

import numpy as np
import pytest

from gearlube_core.bearings.followed_shaft import N_FORCES
from gearlube_core.dynamics.hypoid_axle import outputs, rhs
from gearlube_core.dynamics.hypoid_axle.state import (
    BEARING_DAMPING,
    BEARING_TORQUE,
    BOUNDARY,
    CAGE_G,
    CAGE_P,
    CHURNING,
    LOAD_TORQUE,
    MESH_DAMPING,
    N_ODE,
    N_STATE,
    PHI_G,
    PHI_P,
    PINION_WORK,
    ROLLING,
    SEALS,
    SIDE,
    U_G,
    U_P,
    V_G,
    V_P,
    VISCOUS,
    W_G,
    W_P,
    WHEEL_WORK,
    X,
)
from gearlube_core.dynamics.hypoid_mesh.flanks import FlankSum
from gearlube_core.dynamics.hypoid_mesh.mesh_at_load import MeshAtLoad, MeshLevels
from gearlube_core.dynamics.hypoid_mesh.mesh_force import MeshForce
from gearlube_core.mesh_table.kernels import N_SERIES
from tests.helpers.source_of import interpret, source_of

FRICTION = FlankSum(-3.0, 4.5, 20.0, -30.0, 45.0, 60.0, 7.0, 2.5)
NORMAL = np.array([0.6, 0.48, 0.64])
MESH = MeshForce(2500.0, 0.02, -80.0, 190.0, 1.7, 3e8, *NORMAL)
# forces on the shafts by axis of the axle, and the power lost
ON_PINION, ON_GEAR = np.array([900.0, -400.0, 250.0]), np.array([-700.0, 150.0, 500.0])
LOST_P, LOST_G = 0.3, 0.4
INPUTS = rhs.StepInputs(85.0, 170.0, 0.9, 1.3, 0.21, 0.32, 0.43)
SPEED_P, SPEED_G = 150.0, 55.0


def axle(consistent, lateral_sign=1.0):
    return SimpleNamespace(
        ratio=36.0 / 13.0, I_p=0.006, I_g=0.09, m_p=5.0, m_g=28.0, lateral_sign=lateral_sign,
        mesh=SimpleNamespace(consistent=consistent, z_p=13.0, frequency_floor=50.0),
        bearing_p=SimpleNamespace(cage_ratio=0.43), bearing_g=SimpleNamespace(cage_ratio=0.46),
    )  # fmt: skip


def state():
    s = np.random.default_rng(8).normal(size=N_STATE)
    s[[W_P, W_G]] = SPEED_P, SPEED_G
    return s


def rates(monkeypatch, s, p, tractions=1.0, bearings=1.0):
    """ds/dt, and which bearings were expanded about which motion."""
    interpret(monkeypatch, rhs)
    expanded = []

    def flank_sum(s, force, window, nodes, oil, p, fresh, friction, channels, film_model):
        assert (force, window, nodes, oil, fresh) == (2500.0, "window", 3, "oil", tractions)
        assert film_model == "film model"
        assert (friction.size, channels.size) == (rhs.N_FRICTION, rhs.AT_EXPANSION - rhs.N_FRICTION)
        return FRICTION

    def expand_about(bearing, motion, f_ref, oil, expansion):
        # each by the mesh frequency of its own shaft
        turning = 13.0 * SPEED_P if bearing is p.bearing_p else 36.0 * SPEED_G
        assert f_ref == pytest.approx(turning / (2.0 * np.pi), rel=1e-14)
        expansion[:] = bearing.cage_ratio
        expanded.append((bearing, motion))

    def expanded_forces(bearing, motion, expansion):
        if bearings != 0.0:
            assert np.all(expansion == bearing.cage_ratio)
        assert expansion.size == N_FORCES
        if bearing is p.bearing_p:  # its shaft lies along x, and z comes first
            return (*ON_PINION[::-1], LOST_P)
        return (*ON_GEAR, LOST_G)

    for name, stand_in in (
        ("mesh_force", lambda *_: MESH), ("flank_sum", flank_sum),
        ("expand_about", expand_about), ("expanded_forces", expanded_forces),
    ):  # fmt: skip
        monkeypatch.setattr(rhs, name, stand_in)
    ds = np.full(N_ODE, np.nan)
    mesh = MeshAtLoad("series", 2, "window", 3, "film model")
    force = source_of(rhs.axle_rhs)(
        s, INPUTS, mesh, "oil", p, tractions, bearings, np.zeros(rhs.SCRATCH), ds
    )
    assert force == 2500.0
    return ds, expanded


@pytest.mark.parametrize(("consistent", "lateral_sign"), [(1.0, 1.0), (0.0, -1.0)])
def test_every_body_obeys_newton(monkeypatch, consistent, lateral_sign):
    s, p = state(), axle(consistent, lateral_sign)
    ds, expanded = rates(monkeypatch, s, p)
    drawn = 1e-6 * s[U_P : U_P + 3], 1e-6 * s[U_G : U_G + 3]
    # rollers push back on the cages that carry them; the pinion turns about -x, the gear about z
    cage_p = -np.cross(drawn[0], -ON_PINION)[0]
    cage_g = np.cross(drawn[1], -ON_GEAR)[2]
    on_pinion = 85.0 - 80.0 - 3.0 + consistent * 0.43 * cage_p - 0.9 - 0.32
    on_gear = -170.0 + 190.0 + 4.5 + consistent * 0.46 * cage_g - 1.3 - 0.21 - 0.43
    assert ds[W_P] == pytest.approx(on_pinion / 0.006, rel=1e-12)
    assert ds[W_G] == pytest.approx(on_gear / 0.09, rel=1e-12)
    friction = consistent * np.array([20.0, -30.0, 45.0])
    normal = lateral_sign * 2500.0 * NORMAL
    # flanks push pinion and gear apart
    np.testing.assert_allclose(5.0 * ds[V_P : V_P + 3], ON_PINION - normal + friction, rtol=1e-12)
    np.testing.assert_allclose(28.0 * ds[V_G : V_G + 3], ON_GEAR + normal - friction, rtol=1e-12)
    assert [bearing for bearing, _ in expanded] == [p.bearing_p, p.bearing_g]
    np.testing.assert_allclose(expanded[0][1][:3], drawn[0][::-1], rtol=1e-14)
    np.testing.assert_allclose(expanded[1][1][:3], drawn[1], rtol=1e-14)
    assert expanded[0][1][3:] == (*s[V_P : V_P + 3][::-1], s[CAGE_P], SPEED_P)
    assert expanded[1][1][3:] == (*s[V_G : V_G + 3], s[CAGE_G], SPEED_G)


def test_positions_follow_speeds_and_energies_follow_powers(monkeypatch):
    s = state()
    ds = rates(monkeypatch, s, axle(1.0))[0]
    assert ds[X] == pytest.approx(1e6 * 0.02, rel=1e-14)
    np.testing.assert_allclose(ds[U_P : U_P + 3], 1e6 * s[V_P : V_P + 3], rtol=1e-14)
    np.testing.assert_allclose(ds[U_G : U_G + 3], 1e6 * s[V_G : V_G + 3], rtol=1e-14)
    expected = {
        PHI_P: SPEED_P, PHI_G: SPEED_G, CAGE_P: 0.43 * SPEED_P, CAGE_G: 0.46 * SPEED_G,
        PINION_WORK: 85.0 * SPEED_P, WHEEL_WORK: 170.0 * SPEED_G, VISCOUS: 60.0, BOUNDARY: 7.0,
        MESH_DAMPING: 1.7, BEARING_DAMPING: 0.7, BEARING_TORQUE: 0.9 * SPEED_P + 1.3 * SPEED_G,
        CHURNING: 0.21 * SPEED_G, SEALS: 0.32 * SPEED_P + 0.43 * SPEED_G, ROLLING: 2.5,
    }  # fmt: skip
    for place, value in expected.items():
        assert ds[place] == pytest.approx(value, rel=1e-14)
    assert not np.isnan(ds).any()


def test_kept_expansions_are_not_made_anew(monkeypatch):
    assert rates(monkeypatch, state(), axle(1.0), tractions=0.0, bearings=0.0)[1] == []


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_outputs_after_a_step_read_all_orders_of_the_mesh_between_levels(monkeypatch, side):
    """Levels and coefficients of either side; linear in the load between them."""
    interpret(monkeypatch, outputs)
    orders, levels = 3, np.array([-80.0, -20.0, 30.0, 90.0])
    size = N_SERIES * (2 * orders + 1)
    coefficients = np.random.default_rng(4).normal(size=(levels.size, size))
    seen = []
    monkeypatch.setattr(
        outputs,
        "write_motion",
        lambda s, rates, _, __, series, *___: seen.append((rates, series.copy())),
    )
    s = np.zeros(N_STATE)
    s[LOAD_TORQUE], s[SIDE] = 50.0, side
    table = MeshLevels(levels, coefficients.ravel(), orders, np.zeros(0), 3)
    work = np.full(N_ODE + size + 5, 7.0)
    source_of(outputs.write_motion_after_step)(s, table, "p", work, "out")
    rates, series = seen[0]
    expected = [np.interp(50.0 * side, levels, column) for column in coefficients.T]
    np.testing.assert_allclose(series, expected, rtol=1e-13)
    # what else stands in the work array stays
    assert np.all(work[N_ODE + size :] == 7.0)
    assert np.all(rates == 7.0)
    assert rates.size == N_ODE
