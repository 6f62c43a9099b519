"""Loaded contact of helical and spur pairs against Hertz, statics and symmetry."""

import math
from dataclasses import replace

import numpy as np
import pytest

from gearlube_core.helical_contact.loaded_contact import LoadedSettings, MeshPosition
from gearlube_core.helical_contact.strips import StripSettings
from gearlube_core.helical_contact.tooth_body import pair_stiffness
from gearlube_core.helical_geometry.contact_line import line_kinematics
from gearlube_core.helical_geometry.modification import ModifiedPair
from gearlube_core.tooth_compliance.flank_compliance import CondensationSettings
from gearlube_core.tooth_compliance.tooth_mesh import MeshDensity
from tests.helpers.each import each
from tests.helpers.helical_contact_cases import (
    COARSE_BODY,
    EQUAL,
    HE_2007,
    SPUR,
    TORQUE,
    coarse_stiffness,
    relieved,
    stiff_teeth,
)

MODULUS = 113.6e9  # Pa, steel on steel
FEW_HATS = replace(
    COARSE_BODY,
    condensation=CondensationSettings(
        profile_hats=3,
        lengthwise_hats=5,
        density=MeshDensity(profile=4, lengthwise=8, thickness=2, fillet=2, slot=1, rim=1),
    ),
)
HELICAL, STRAIGHT = ModifiedPair(pair=HE_2007), ModifiedPair(pair=SPUR)


@pytest.mark.parametrize("pair", [SPUR, HE_2007])
def test_on_stiff_teeth_a_line_is_hertz_line_contact(pair):
    # one line in the middle of the plane of contact. Its ends are 16 mm from its middle, where
    # the half-width is 0.2 mm: end effects on the pressure there are below a hundredth, and so
    # is the error of the 41 cells across.
    number = 1 if pair is HE_2007 else 0
    position = MeshPosition.at(ModifiedPair(pair=pair), 0.7)
    alone = MeshPosition(position.modified, 0.7, {number: position.gaps[number]})
    settings = LoadedSettings(strips=StripSettings(cells_across=41, cells_along=64), tolerance=1e-6)
    line = alone.load(TORQUE, stiff_teeth(MODULUS), settings).lines[0]
    rows = slice(24, 40)
    x = float(line.strip.x[rows].mean())
    radius = line_kinematics(x, 1.0, pair.plane).R
    load = float(line.line_load[rows].mean())
    hertz = math.sqrt(load * MODULUS / (math.pi * radius))
    assert float(line.pressure[:, rows].max(axis=0).mean()) == pytest.approx(hertz, rel=0.01)
    half_width = math.sqrt(4.0 * load * radius / (math.pi * MODULUS))
    loaded = (line.forces[:, rows] > 0.0).sum(axis=0).mean() * line.strip.cell[0]
    assert loaded == pytest.approx(2.0 * half_width, abs=line.strip.cell[0])


@each("phase", [0.0, 0.35, 0.8])
def test_torques_balance_to_rounding(phase):
    state = MeshPosition.at(HELICAL, phase).load(
        TORQUE, coarse_stiffness(HE_2007), LoadedSettings()
    )
    assert sum(line.torque for line in state.lines) == pytest.approx(TORQUE, rel=1e-12)
    # tip edges turn the force that they carry by up to 0.03 rad: their share of 6 % times that
    assert state.gear_torque == pytest.approx(HE_2007.ratio * TORQUE, rel=5e-3)


def test_tip_relief_frees_the_corners_and_the_gear_torque_follows_the_teeth():
    modified = relieved(HE_2007, 40e-6, 1.0e-3)
    state = MeshPosition.at(modified, 0.8).load(TORQUE, coarse_stiffness(HE_2007), LoadedSettings())
    assert state.gear_torque == pytest.approx(HE_2007.ratio * TORQUE, rel=1e-12)


def test_corner_contact_carries_more_the_more_the_teeth_deflect():
    corner = []
    for torque in (50.0, 200.0, 600.0):
        state = MeshPosition.at(HELICAL, 0.0).load(
            torque, coarse_stiffness(HE_2007), LoadedSettings()
        )
        entering = state.lines[0]
        assert entering.strip.line == 0
        assert entering.strip.x.max() < HE_2007.contact_start  # before A altogether
        corner.append(entering.torque / torque)
    assert 0.0 < corner[0] < corner[1] < corner[2] < 0.1


def test_energy_is_the_integral_of_torque_over_rotation():
    position = MeshPosition.at(HELICAL, 0.4)
    torque = np.linspace(150.0, 250.0, 5)
    settings = LoadedSettings(tolerance=1e-7)
    states = [position.load(float(t), coarse_stiffness(HE_2007), settings) for t in torque]
    rotation = np.array([s.rotation for s in states])
    work = np.trapezoid(torque, rotation)
    # strips are cut again for each torque, which moves rotations by some 1e-4 of themselves
    stored = states[-1].strain_energy - states[0].strain_energy
    assert stored == pytest.approx(work, rel=2e-3)
    slope = (torque[3] - torque[1]) / (rotation[3] - rotation[1])
    assert states[2].tangent == pytest.approx(slope, rel=0.01)


@pytest.mark.slow
def test_equal_members_mesh_alike_from_either_end():
    # turned end for end, line X becomes the line at A + D + W tan(b) - X of the same mesh, so
    # phase p becomes eps_gamma - p. Without corners the answer is the same but for the strips'
    # samples; with teeth meshed alike on either member.
    modified = relieved(EQUAL, 40e-6, 1.0e-3)
    # teeth alike do it, whatever their stiffness: half the hats
    teeth = pair_stiffness(EQUAL, FEW_HATS, jobs=1)
    states = [
        MeshPosition.at(modified, phase).load(TORQUE, teeth, LoadedSettings())
        for phase in (0.15, EQUAL.total_contact_ratio - 0.15)
    ]
    assert states[0].rotation == pytest.approx(states[1].rotation, rel=1e-4)
    shares = [sorted(line.torque / TORQUE for line in state.lines) for state in states]
    np.testing.assert_allclose(shares[0], shares[1], atol=2e-4)


def test_spur_teeth_carry_evenly_about_mid_face_and_alone_in_single_contact():
    teeth = pair_stiffness(SPUR, FEW_HATS, jobs=1)  # even and alone, whatever their stiffness
    state = MeshPosition.at(STRAIGHT, 0.75).load(100.0, teeth, LoadedSettings())
    carrying = [line for line in state.lines if line.torque > 1e-6]
    assert len(carrying) == 1
    load = carrying[0].line_load
    np.testing.assert_allclose(load, load[::-1], rtol=1e-3)
    double = MeshPosition.at(STRAIGHT, 0.2).load(100.0, teeth, LoadedSettings())
    assert sum(line.torque > 10.0 for line in double.lines) == 2
    assert double.rotation < 0.75 * state.rotation


def test_a_light_load_leaves_relief_open_and_a_heavy_one_enters_it():
    modified = relieved(HE_2007, 20e-6, 1.2e-3)
    position = MeshPosition.at(modified, 0.35)
    lengths = []
    for torque in (5.0, 100.0, 800.0):
        state = position.load(torque, coarse_stiffness(HE_2007), LoadedSettings())
        middle = next(line for line in state.lines if line.strip.line == 1)
        low, high = middle.loaded_extent
        lengths.append(high - low)
    assert lengths[0] < lengths[1] < lengths[2]
