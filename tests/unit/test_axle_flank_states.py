"""Flanks of an axle through their engagement, beside its losses and closed forms."""

import math
from dataclasses import replace

import numpy as np
import pytest

from gearlube.damage.flank import flank_damage, tooth_maps
from gearlube_core.dynamics.hypoid_axle.flank_states import flank_states
from gearlube_core.dynamics.hypoid_axle.losses import LOSS_SOURCES, axle_losses
from gearlube_core.dynamics.hypoid_axle.mohammadpour_2015 import mohammadpour_2015_axle
from gearlube_core.errors import ParameterError
from gearlube_core.hypoid_contact.contact_kinematics import path_kinematics
from gearlube_core.hypoid_contact.contact_path import contact_migration, contact_path
from gearlube_core.hypoid_contact.pair import FlankPair
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile

SPEED, OIL, K = 209.4, 353.15, 5e-18
RUBBING = [LOSS_SOURCES.index(one) for one in ("friction_viscous", "friction_boundary")]


@pytest.fixture(scope="module")
def axle():
    return mohammadpour_2015_axle()


@pytest.fixture(scope="module")
def states(axle):
    return flank_states(axle, torque=100.0, speed=SPEED, temperature=OIL)


@pytest.mark.parametrize("torque", [-60.0, 20.0, 300.0])
@pytest.mark.parametrize("film", ["formula", "solved"])
def test_friction_of_the_flanks_is_the_mesh_loss(axle, torque, film):
    axle = replace(axle, film=film)
    found = flank_states(axle, torque=torque, speed=SPEED, temperature=OIL)
    lost = axle_losses(
        axle, torques=np.array([torque]), speeds=np.array([SPEED]), temperatures=np.array([OIL])
    )
    # 20 angles of the mesh period beside 32: both are near the mean
    assert found.friction_power == pytest.approx(lost.power[0, 0, 0, RUBBING].sum(), rel=2e-3)


def test_warm_flanks_lose_what_the_axle_loses_with_them(axle):
    warm = replace(axle, flank_bulk_resistance=0.05)
    found = flank_states(warm, torque=100.0, speed=SPEED, temperature=OIL)
    lost = axle_losses(
        warm, torques=np.array([100.0]), speeds=np.array([SPEED]), temperatures=np.array([OIL])
    )
    assert found.bulk > OIL + 5.0
    assert found.friction_power == pytest.approx(lost.power[0, 0, 0, RUBBING].sum(), rel=5e-3)


def test_loads_carry_the_torque_and_stay_on_the_tooth(axle, states):
    mesh = axle.mesh
    # the mean force is the torque over its mean arm; the arm varies by about a per cent
    force = states.load.sum() * states.share_of_time
    assert force == pytest.approx(states.carried / mesh.mean("R_p", 100.0), rel=0.02)
    assert (np.diff(states.phase) > 0.0).all()
    width, height = mesh.tooth_size
    assert ((states.place >= 0.0) & (states.place <= [width, height])).all()


@pytest.mark.parametrize(("side", "torque"), [("drive", 5.0), ("coast", -5.0)])
def test_flanks_pass_the_moving_contact_as_those_in_tangency_do(axle, side, torque):
    """The light contact follows the path of rigid flanks, whose migration is exact."""
    pair = FlankPair.from_file(HypoidGearFile.named("mohammadpour_2015"), side)
    path = contact_path(pair, np.linspace(-0.6, 0.6, 25) * pair.gear_pitch)
    exact, moves = path_kinematics(path), contact_migration(path)
    found = flank_states(axle, torque=torque, speed=SPEED, temperature=OIL)
    face = found.place[:, 0] / axle.mesh.tooth_size[0]
    order = np.argsort(face)
    both = (path.gear_t > face.min() + 0.01) & (path.gear_t < face.max() - 0.01) & path.inside
    assert both.sum() > 10
    for speeds, of_flank in (
        (found.gear_speed, exact.velocity_g), (found.pinion_speed, exact.velocity_p),
    ):  # fmt: skip
        expected = SPEED * np.einsum("ni,ni->n", of_flank - moves, exact.minor_axis)[both]
        got = np.interp(path.gear_t[both], face[order], speeds[order])
        # the table has 20 nodes in a period; past a point at rest flanks are 10 to 30 % slower
        np.testing.assert_allclose(got, expected, rtol=0.015)


def test_engagement_that_passes_the_end_of_the_window_stays_whole(axle):
    high = flank_states(axle, torque=400.0, speed=SPEED, temperature=OIL)
    step = np.linalg.norm(np.diff(high.place, axis=0), axis=1)
    assert step.max() < 2e-3  # m: no jump from heel to toe


def test_rise_of_temperature_is_bloks(axle, states):
    found, i = flank_damage(states, axle.solid, K), int(states.load.argmax())
    solid = axle.solid
    b = math.sqrt(solid.conductivity * solid.density * solid.heat_capacity)
    roots = math.sqrt(states.pinion_speed[i]) + math.sqrt(states.gear_speed[i])
    power = states.friction[i] * states.sliding[i] / states.load[i] * states.line_load[i]
    blok = 0.786 * power / (b * roots * math.sqrt(states.semi_minor[i]))
    assert found.flash[i] == pytest.approx(blok, rel=0.01)


def test_wear_of_members_is_inverse_to_their_speeds_and_never_zero(axle, states):
    found = flank_damage(states, axle.solid, K)
    np.testing.assert_allclose(
        found.pinion_wear / found.gear_wear, states.gear_speed / states.pinion_speed
    )
    across = states.pinion_speed - states.gear_speed
    assert across.min() < 0.0 < across.max()  # the slip across vanishes on the way
    # that along the contact line does not: the axle's own sliding holds both
    assert (states.sliding > np.abs(across)).all()
    load = states.line_load * states.asperity_share
    still = int(np.abs(across).argmin())
    assert found.gear_wear[still] * states.gear_speed[still] > K * load[still] * 1.0  # m/s


def test_wear_of_all_load_leaves_out_the_share_of_asperities(axle, states):
    found = flank_damage(states, axle.solid, K)
    bound = flank_damage(states, axle.solid, K, all_load=True)
    np.testing.assert_allclose(bound.pinion_wear * states.asperity_share, found.pinion_wear)


def test_maps_hold_what_the_lines_have(axle, states):
    found = flank_damage(states, axle.solid, K)
    maps = tooth_maps(states, found, axle.mesh.tooth_size)
    assert maps["pressure"].max() == pytest.approx(found.pressure.max(), rel=1e-2)
    assert maps["pressure"].max() <= found.pressure.max()
    film = maps["film"][maps["film"] > 0.0]
    assert film.min() >= found.film.min() - 1e-12


def test_no_places_no_states(axle):
    windows = {name: one for name, one in axle.mesh.windows.items() if "tooth" not in name}
    windows = {
        name: one for name, one in windows.items() if not name.startswith(("minor", "major"))
    }
    bare = replace(axle, mesh=replace(axle.mesh, windows=windows, tooth_size=None))
    with pytest.raises(ParameterError, match="gearlube contact"):
        flank_states(bare, torque=50.0, speed=SPEED, temperature=OIL)
