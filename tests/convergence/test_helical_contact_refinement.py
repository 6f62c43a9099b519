"""Stiffness and sharing of loaded helical contact do not depend on cells, stations or elements."""

import numpy as np
import pytest

from gearlube_core.helical_contact.contact_dataset import line_mesh
from gearlube_core.helical_contact.loaded_contact import LoadedSettings, MeshPosition
from gearlube_core.helical_contact.mesh_cycle import CycleSettings, run_cycle
from gearlube_core.helical_contact.strips import StripSettings
from gearlube_core.helical_contact.tooth_body import HelicalBodySettings, pair_stiffness
from gearlube_core.helical_geometry.modification import ModifiedPair
from gearlube_core.tooth_compliance.flank_compliance import CondensationSettings
from gearlube_core.tooth_compliance.tooth_mesh import MeshDensity
from tests.helpers.helical_contact_cases import (
    HE_2007,
    TEETH_CACHE,
    TORQUE,
    coarse_stiffness,
    relieved,
)

PLAIN = ModifiedPair(pair=HE_2007)
REFINED = LoadedSettings(strips=StripSettings(cells_across=61, cells_along=96))


def stiffnesses(modified, teeth, settings, phases):
    """Return secant and tangent stiffness and the largest share, (phases, 3)."""
    rows = []
    for phase in phases:
        state = MeshPosition.at(modified, phase).load(TORQUE, teeth, settings)
        share = max(line.torque for line in state.lines) / TORQUE
        rows.append((TORQUE / state.rotation, state.tangent, share))
    return np.array(rows)


@pytest.mark.parametrize(
    ("modified", "phases"),
    [
        (relieved(HE_2007, 20e-6, 1.2e-3), (0.45,)),
        pytest.param(PLAIN, (0.05, 0.45, 0.85), marks=pytest.mark.slow),
    ],
)
def test_twice_the_cells_change_stiffness_by_less_than_one_percent(modified, phases):
    teeth = coarse_stiffness(HE_2007)
    coarse = stiffnesses(modified, teeth, LoadedSettings(), phases)
    fine = stiffnesses(modified, teeth, REFINED, phases)
    np.testing.assert_allclose(coarse, fine, rtol=0.01)


@pytest.mark.slow
def test_stations_change_the_line_mesh_sums_not_at_all_and_its_moments_little():
    teeth, found = coarse_stiffness(HE_2007), []
    for stations in (8, 16):
        settings = CycleSettings(torques=(TORQUE,), positions=6, stations=stations)
        mesh = line_mesh(PLAIN, settings, run_cycle(PLAIN, teeth, settings, jobs=1))
        k = mesh.density[0, :, 1]
        found.append((k.mean(axis=1), (k * (mesh.station - 0.5)).mean(axis=1) / k.mean(axis=1)))
    np.testing.assert_allclose(found[0][0], found[1][0], rtol=1e-9)
    # centre of stiffness, in lengths of the line
    np.testing.assert_allclose(found[0][1], found[1][1], atol=2e-3)


@pytest.mark.slow
@pytest.mark.parametrize(
    "finer",
    [
        CondensationSettings(lengthwise_hats=17, density=MeshDensity(profile=12, lengthwise=32)),
        CondensationSettings(profile_hats=9, density=MeshDensity(profile=16)),
        CondensationSettings(density=MeshDensity(profile=18, thickness=5, growth=1.5, fillet=7)),
    ],
)
def test_finer_teeth_change_stiffness_by_less_than_one_percent(finer):
    phases = np.arange(6) / 6
    found = [
        stiffnesses(
            PLAIN,
            pair_stiffness(HE_2007, HelicalBodySettings(condensation=c), cache=TEETH_CACHE, jobs=2),
            LoadedSettings(),
            phases,
        )
        for c in (CondensationSettings(), finer)
    ]
    np.testing.assert_allclose(found[0], found[1], rtol=0.01)
