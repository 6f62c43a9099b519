"""The line mesh stands for the static state that it was taken from."""

import math

import numpy as np
import pytest

from gearlube_core.helical_contact.contact_dataset import line_mesh
from gearlube_core.helical_contact.loaded_contact import LoadedSettings, MeshPosition
from gearlube_core.helical_contact.mesh_cycle import CycleSettings, run_cycle
from gearlube_core.helical_geometry.contact_line import clip_line, line_position, segment_length
from gearlube_core.helical_geometry.modification import ModifiedPair
from tests.helpers.helical_contact_cases import HE_2007, coarse_stiffness, relieved

ARM = HE_2007.pinion_base_radius * math.cos(HE_2007.base_helix_angle)
SETTINGS = CycleSettings(torques=(140.0, 200.0), positions=24, stations=12)


def carried(mesh, level, phase, closing):
    """Return torque and tangent of the rigid gears closed by `closing` [m] at any mesh phase.

    Summed over the lines with twelve strips each; linear in phase between the mesh's, a line
    going on as the next when the period is over.
    """
    n = mesh.phase.size
    before = math.floor(phase * n)
    share = phase * n - before
    total = stiff = 0.0
    for line in range(mesh.lines):
        fields = []
        for values in (mesh.density, mesh.offset):
            here = values[level, before, line]
            if before + 1 < n:
                there = values[level, before + 1, line]
            else:
                there = values[level, 0, min(line + 1, mesh.lines - 1)]
            fields.append((1.0 - share) * here + share * there)
        k, e = fields
        plane = HE_2007.plane
        length = segment_length(clip_line(line_position(phase, line, plane), plane), plane)
        load = np.maximum(k * (closing - e), 0.0)
        total += ARM * load.sum() * length / k.size
        stiff += ARM**2 * k[load > 0.0].sum() * length / k.size
    return total, stiff


@pytest.fixture(scope="module", params=["plain", pytest.param("relieved", marks=pytest.mark.slow)])
def case(request):
    modified = (
        ModifiedPair(pair=HE_2007) if request.param == "plain" else relieved(HE_2007, 20e-6, 1.2e-3)
    )
    cycle = run_cycle(modified, coarse_stiffness(HE_2007), SETTINGS, jobs=1)
    return modified, cycle, line_mesh(modified, SETTINGS, cycle)


def closing_of(cycle, rotation):
    """Return the normal closing since first contact of the whole mesh [m]."""
    return ARM * (rotation - cycle["unloaded_rotation"].min())


@pytest.mark.slow
def test_at_its_own_phases_it_carries_the_torque_at_the_static_closing(case):
    _, cycle, mesh = case
    for n, phase in enumerate(SETTINGS.phases):
        for level, torque in enumerate(SETTINGS.torques):
            closing = closing_of(cycle, cycle["rotation"][n, level])
            total, stiff = carried(mesh, level, float(phase), closing)
            assert total == pytest.approx(torque, rel=1e-9)
            assert stiff == pytest.approx(cycle["tangent"][n, level], rel=1e-9)


@pytest.mark.slow
def test_between_its_phases_the_closing_is_within_two_percent(case):
    # entry, exit and their corners are kinks, which straight lines between phases cut: half of a
    # step of 1/24 is 2 % of a period, over which a line takes up 2 % of the load
    modified, cycle, mesh = case
    misfits = []
    for n in range(0, SETTINGS.positions, 2):
        phase = (n + 0.5) / SETTINGS.positions
        state = MeshPosition.at(modified, phase).load(
            200.0, coarse_stiffness(HE_2007), LoadedSettings()
        )
        closing = closing_of(cycle, state.rotation)
        total, stiff = carried(mesh, 1, phase, closing)
        misfits.append(ARM * (total - 200.0) / stiff / closing)
    assert np.abs(misfits).max() < 0.02
    assert abs(np.mean(misfits)) < 0.005


@pytest.mark.slow
def test_between_its_torques_the_springs_meet_the_contact(case):
    # tangents at 200 N.m unloaded to 140 N.m: contact softens by the logarithm of the load, 2 %
    # of the closing here, more where relief comes free
    _, cycle, mesh = case
    for n in range(0, SETTINGS.positions, 4):
        closing = closing_of(cycle, cycle["rotation"][n, 0])
        total, _ = carried(mesh, 1, float(SETTINGS.phases[n]), closing)
        assert total == pytest.approx(140.0, rel=0.04)


def test_offsets_of_loaded_stations_lie_below_the_closing(case):
    _, cycle, mesh = case
    closing = closing_of(cycle, cycle["rotation"]).T
    loaded = mesh.density > 0.0
    closed = np.broadcast_to(closing[:, :, None, None], mesh.offset.shape)
    assert loaded.any()
    assert (mesh.offset[loaded] < closed[loaded]).all()
