"""Equations of motion of the axle's mesh and bearings, with made-up forces."""

from types import SimpleNamespace

import numpy as np
import pytest

from gearlube_core.dynamics.hypoid_axle.state import (
    BEARING_DAMPING,
    BEARING_TORQUE,
    BOUNDARY,
    CAGE_G,
    CAGE_P,
    FRICTION_BOUND,
    LOAD_TORQUE,
    MESH_DAMPING,
    N_ODE,
    PHI_G,
    PHI_P,
    PINION_TORQUE,
    ROLLING,
    U_G,
    U_P,
    V_G,
    V_P,
    VISCOUS,
    W_G,
    W_P,
    X,
)  # fmt: skip
from gearlube_core.dynamics.hypoid_mesh.flanks import BOUND_POWER, N_FRICTION, FlankSum
from gearlube_core.dynamics.hypoid_mesh.mesh_force import MeshForce
from gearlube_core.dynamics.packed_mesh import N_CHANNELS
from gearlube_core.dynamics.train.elements import (
    hypoid_mesh_kernels,
    hypoid_mesh_places,
    opposed_bearings,
)
from gearlube_core.dynamics.train.elements.hypoid_mesh_places import TABLE
from gearlube_core.mesh_table.kernels import N_SERIES
from tests.helpers.source_of import interpret, source_of

FRICTION = FlankSum(-3.0, 4.5, 20.0, -30.0, 45.0, 60.0, 7.0, 2.5)
NORMAL = np.array([0.6, 0.48, 0.64])
MESH = MeshForce(2500.0, 0.02, -80.0, 190.0, 1.7, 3e8, *NORMAL)
BOUND = 0.8  # W
LEVELS, ORDERS, NODES = 3, 2, 4
SERIES = N_SERIES * (2 * ORDERS + 1)
AT_MESH = (
    0, 12, X, VISCOUS, BOUNDARY, ROLLING, MESH_DAMPING, FRICTION_BOUND, LOAD_TORQUE, PINION_TORQUE,
    LEVELS, ORDERS, NODES, SERIES, 0,
)  # fmt: skip


def state():
    s = 1e-6 * np.random.default_rng(8).normal(size=N_ODE + 8)
    s[[W_P, W_G, PHI_P, PHI_G]] = 150.0, 55.0, 0.3, 0.1
    return s


@pytest.mark.parametrize(("consistent", "lateral_sign"), [(1.0, 1.0), (0.0, -1.0)])
def test_the_mesh_pushes_both_members_apart_and_pays_in_energies(
    monkeypatch, consistent, lateral_sign
):
    module = hypoid_mesh_kernels
    interpret(monkeypatch, module, hypoid_mesh_places)
    s, size = state(), (NODES + 1) * N_CHANNELS
    memory = np.zeros(TABLE + LEVELS + (LEVELS + 1) * (SERIES + size) + N_FRICTION + N_CHANNELS)
    seen = []

    def flank_sum(motion, force, window, nodes, oil, p, asked, friction, channels, film_model):
        assert (force, nodes, oil, window.size) == (2500.0, NODES, "oil", size)
        assert (friction.size, channels.size, film_model.size) == (N_FRICTION, N_CHANNELS, 0)
        friction[BOUND_POWER] = BOUND
        seen.append((motion, asked))
        return FRICTION

    monkeypatch.setattr(module, "mesh_force", lambda *_: MESH)
    monkeypatch.setattr(module, "flank_sum", flank_sum)
    mesh = SimpleNamespace(mesh=SimpleNamespace(consistent=consistent), lateral_sign=lateral_sign)
    ds = np.zeros(N_ODE)
    for stage in (0, 3):
        ds[:] = 0.0
        source_of(module.HypoidMeshKernels.add_forces)(mesh, AT_MESH, memory, s, "oil", stage, ds)
    friction = consistent * np.array([20.0, -30.0, 45.0])
    normal = lateral_sign * 2500.0 * NORMAL
    np.testing.assert_allclose(ds[V_P : V_P + 3], friction - normal, rtol=1e-12)
    np.testing.assert_allclose(ds[V_G : V_G + 3], normal - friction, rtol=1e-12)
    expected = {
        W_P: -80.0 - 3.0, W_G: 190.0 + 4.5, X: 0.02, VISCOUS: 60.0, BOUNDARY: 7.0, ROLLING: 2.5,
        MESH_DAMPING: 1.7, FRICTION_BOUND: BOUND,
    }  # fmt: skip
    for place, value in expected.items():
        assert ds[place] == pytest.approx(value, rel=1e-14)
    assert np.count_nonzero(ds) == 6 + len(expected)
    apart, moving = s[U_P : U_P + 3] - s[U_G : U_G + 3], s[V_P : V_P + 3] - s[V_G : V_G + 3]
    motion, asked = seen[0]
    np.testing.assert_allclose(motion, [0.3, s[X], 150.0, 55.0, *apart, *moving], rtol=1e-14)
    # exact alone in a state by itself; tractions of the last middle stage serve the next one
    assert [one for _, one in seen] == [asked, 0.0] != [0.0, 0.0]


@pytest.mark.parametrize("on_cage", [1.0, 0.0])
@pytest.mark.parametrize("gear", [False, True])
def test_bearings_push_their_shaft_and_brake_it(monkeypatch, on_cage, gear):
    module = opposed_bearings
    interpret(monkeypatch, module)
    forces, lost, drag, error = np.array([900.0, -400.0, 250.0]), 0.3, 0.9, 0.05
    axes = (0, 1, 2) if gear else (2, 1, 0)  # the pinion's shaft lies along x, and z comes first
    u, v, w, cage = (U_G, V_G, W_G, CAGE_G) if gear else (U_P, V_P, W_P, CAGE_P)
    s, seen = state(), []

    def expanded_forces(bearings, motion, expansion):
        seen.append(motion)
        return (*forces[list(axes)], lost)

    monkeypatch.setattr(module, "expanded_forces", expanded_forces)
    memory = np.zeros(module._MEMORY)
    memory[module._DRAG], memory[module._BOUND] = drag, error
    at = (u, cage, BEARING_DAMPING, BEARING_TORQUE, N_ODE - 1, N_ODE, *axes, 0)
    pair = SimpleNamespace(bearings=SimpleNamespace(cage_ratio=0.43), on_cage=on_cage)
    ds = np.zeros(N_ODE)
    source_of(module._OpposedBearings.add_forces)(pair, at, memory, s, "oil", 2, ds)
    np.testing.assert_allclose(ds[v : v + 3], forces, rtol=1e-14)
    # rollers push back on the cages that carry them; the pinion turns about -x, the gear about z
    moment = np.cross(s[u : u + 3], -forces)
    of_cage = on_cage * 0.43 * (moment[2] if gear else -moment[0])
    assert ds[w] == pytest.approx(of_cage - drag, rel=1e-12)
    assert ds[cage] == pytest.approx(0.43 * s[w], rel=1e-14)
    powers = ds[BEARING_DAMPING], ds[BEARING_TORQUE], ds[N_ODE - 1]
    assert powers == pytest.approx((lost, drag * s[w], error), rel=1e-14)
    shown = [*s[u : u + 3][list(axes)], *s[v : v + 3][list(axes)], s[cage], s[w]]
    np.testing.assert_array_equal(seen[0], shown)


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_the_force_after_a_step_reads_all_orders_of_the_mesh_between_levels(monkeypatch, side):
    """Levels and coefficients of either side; linear in the load between them."""
    module = hypoid_mesh_places
    interpret(monkeypatch, module)
    levels = np.array([-80.0, -20.0, 30.0, 90.0])
    coefficients = np.random.default_rng(4).normal(size=(levels.size, SERIES))
    seen = []
    monkeypatch.setattr(
        module, "mesh_force", lambda m, series, orders, p: seen.append((series.copy(), orders, p))
    )
    s = state()
    s[LOAD_TORQUE], s[LOAD_TORQUE + 1] = 50.0, side
    size = (NODES + 1) * N_CHANNELS
    memory = np.full(TABLE + 4 + 5 * (SERIES + size) + N_FRICTION + N_CHANNELS, 7.0)
    memory[TABLE : TABLE + 4] = levels
    memory[TABLE + 4 :][: 4 * SERIES] = coefficients.ravel()
    before, at = memory.copy(), (*AT_MESH[:10], 4, *AT_MESH[11:])
    source_of(module.force_at_load)("p", at, memory, s, np.zeros(SERIES))
    series, orders, p = seen[0]
    expected = [np.interp(50.0 * side, levels, column) for column in coefficients.T]
    np.testing.assert_allclose(series, expected, rtol=1e-13)
    assert (orders, p) == (ORDERS, "p")
    np.testing.assert_array_equal(memory, before)
