"""Loaded tooth contact against Hertz, statics and the energy it stores."""

import numpy as np
import pytest
from scipy.special import ellipk

from gearlube_core.contact.hertz import hertz_ellipse
from gearlube_core.hypoid_contact.contact_kinematics import path_kinematics
from gearlube_core.hypoid_contact.contact_path import contact_path
from gearlube_core.hypoid_contact.loaded_contact import LoadedSettings, MeshPosition
from gearlube_core.hypoid_contact.strips import StripSettings
from tests.helpers.contact_cases import shipped_pair
from tests.helpers.loaded_cases import MODULUS, stiffness

FINE = LoadedSettings(strips=StripSettings(cells_across=48, cells_along=64), tolerance=1e-7)
RIGID_TEETH = stiffness(0.0)
SOFT_TEETH = stiffness()


@pytest.mark.parametrize(("side", "phase"), [("drive", 0.5), ("coast", -0.25)])
def test_a_single_pair_of_rigid_teeth_is_hertz_contact(side, phase):
    # One pair at 2 N.m: the ellipse is 4 mm long, over which the flanks' third-order terms change
    # the gap by about a hundredth; the cells add a few thousandths. Hence 2 %.
    pair = shipped_pair(side)
    torque = 2.0
    state = MeshPosition.at(pair, phase, pairs=0).load(torque, RIGID_TEETH, FINE)
    path = contact_path(pair, np.array([phase * pair.gear_pitch]))
    k = path_kinematics(path)
    load = torque / float(k.R_p[0])
    b, a, mean_pressure = hertz_ellipse(float(k.R_x[0]), float(k.R_y[0]), MODULUS, load)
    # Johnson 1985, eq. (4.26): approach of an elliptical contact
    approach = 1.5 * load / (np.pi * a * MODULUS) * ellipk(1.0 - (b / a) ** 2)
    touching = pair.touching_sign * float(path.transmission_error[0])
    assert float(k.R_p[0]) * (state.rotation - touching) == pytest.approx(approach, rel=0.02)
    peak = state.pairs[0].pressure.max()
    assert peak == pytest.approx(1.5 * mean_pressure, rel=0.02)
    assert np.linalg.norm(state.force) == pytest.approx(load, rel=2e-3)


@pytest.mark.parametrize("side", ["drive", "coast"])
def test_forces_balance_the_torques_of_both_members(side):
    pair = shipped_pair(side)
    state = MeshPosition.at(pair, 0.25).load(120.0, SOFT_TEETH, LoadedSettings())
    on_gear, on_pinion = np.zeros(3), np.zeros(3)
    axis, origin = pair.pinion_axis_placed
    for loaded in state.pairs:
        there = loaded.forces > 0.0
        push = -loaded.forces[there][:, None] * loaded.strip.normal[there]
        on_gear += np.cross(loaded.strip.point[there], push).sum(axis=0)
        on_pinion += np.cross(loaded.strip.point[there] - origin, -push).sum(axis=0)
    # the gear is driven about +z, the pinion resists about its drive direction -x; the other way
    # round on coast. Tolerances: summation of some thousand cells.
    assert pair.touching_sign * on_gear[2] == pytest.approx(state.gear_torque, rel=1e-12)
    assert pair.touching_sign * on_pinion @ axis == pytest.approx(120.0, rel=1e-9)
    assert sum(p.torque for p in state.pairs) == pytest.approx(120.0, rel=1e-9)


@pytest.mark.slow
def test_work_of_the_torques_is_stored_as_strain_energy():
    # T_p dphi_p = T_g dphi_g + dU around the mesh at constant pinion torque. Arms are taken before
    # the pinion closes by `rotation`, so each side may be off by rotation times the work done;
    # that drift is even. What is left is the step's second order: 5 % of the exchange.
    pair, torque, count = shipped_pair("drive"), 60.0, 16
    states = [
        MeshPosition.at(pair, k / count).load(torque, SOFT_TEETH, LoadedSettings())
        for k in range(count + 1)
    ]
    rotation = np.array([s.rotation for s in states])
    gear_torque = np.array([s.gear_torque for s in states])
    energy = np.array([s.strain_energy for s in states])
    gear_step = pair.gear_pitch / count
    work = torque * (pair.ratio * gear_step + np.diff(rotation))
    work -= 0.5 * (gear_torque[1:] + gear_torque[:-1]) * gear_step
    stored = energy[1:] - energy[0]
    missing = np.cumsum(work) - stored
    drift = missing[-1] * np.arange(1, count + 1) / count
    assert abs(missing[-1]) < rotation.max() * torque * pair.pinion_pitch
    assert np.ptp(stored) > 1e-3  # J, so that something is exchanged
    np.testing.assert_allclose(missing - drift, 0.0, atol=0.05 * np.ptp(stored))


@pytest.mark.slow
def test_energy_is_the_integral_of_torque_over_closing():
    pair = shipped_pair("drive")
    position = MeshPosition.at(pair, 0.4)
    torque = np.linspace(40.0, 60.0, 5)
    states = [position.load(float(t), SOFT_TEETH, LoadedSettings(tolerance=1e-7)) for t in torque]
    rotation = np.array([s.rotation for s in states])
    energy = np.array([s.strain_energy for s in states])
    # strips are cut again for each torque, which moves rotations by some 1e-3 of themselves
    work = np.trapezoid(torque, rotation)
    assert energy[-1] - energy[0] == pytest.approx(work, rel=0.02)


@pytest.mark.slow
def test_tangent_stiffness_is_the_slope_of_torque_over_closing():
    position = MeshPosition.at(shipped_pair("coast"), 0.1)
    settings = LoadedSettings(strips=StripSettings(cells_across=48), tolerance=1e-7)
    low, middle, high = (position.load(t, SOFT_TEETH, settings) for t in (45.0, 50.0, 55.0))
    slope = 10.0 / (high.rotation - low.rotation)
    # each load has cells of its own, whose discrete edges move the closing by some 1e-3
    assert middle.tangent == pytest.approx(slope, rel=0.04)


def test_a_light_load_touches_where_the_unloaded_flanks_do():
    pair = shipped_pair("drive")
    state = MeshPosition.at(pair, 0.5).load(0.05, SOFT_TEETH, FINE)
    path = contact_path(pair, np.array([0.5 * pair.gear_pitch]))
    loaded = next(p for p in state.pairs if p.torque > 0.0)
    weights = loaded.forces / loaded.forces.sum()
    centre = np.einsum("ij,ijk->k", weights, np.nan_to_num(loaded.strip.point))
    # the ellipse is 1.5 mm long; its centre of force lies within a cell of the point of contact
    assert np.linalg.norm(centre - path.r[0]) < 0.1e-3


@pytest.mark.slow
def test_contact_shares_rise_to_a_maximum_and_fall():
    pair, phases = shipped_pair("coast"), np.arange(8) / 8
    share = {}
    for phase in phases:
        state = MeshPosition.at(pair, float(phase)).load(50.0, SOFT_TEETH, LoadedSettings())
        share |= {round(p.phase, 6): p.torque / 50.0 for p in state.pairs}
    values = np.array([share[k] for k in sorted(share)])
    peak = int(np.argmax(values))
    assert np.all(np.diff(values[: peak + 1]) > -1e-3)
    assert np.all(np.diff(values[peak:]) < 1e-3)
