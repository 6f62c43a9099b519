"""The mesh stiffness does not depend on the cells of the contact strips."""

import numpy as np
import pytest

from gearlube_core.hypoid_contact.loaded_contact import LoadedSettings, MeshPosition
from gearlube_core.hypoid_contact.strips import StripSettings
from tests.helpers.contact_cases import shipped_pair
from tests.helpers.loaded_cases import stiffness

TEETH = stiffness()


@pytest.mark.parametrize(("phase", "torque"), [(0.1, 200.0), (0.6, 20.0)])
def test_closing_changes_by_less_than_one_percent_on_refined_cells(phase, torque):
    position = MeshPosition.at(shipped_pair("drive"), phase)
    coarse = position.load(torque, TEETH, LoadedSettings())
    fine = position.load(
        torque, TEETH, LoadedSettings(strips=StripSettings(cells_across=72, cells_along=96))
    )
    closing = [s.rotation - position.unloaded_rotation for s in (coarse, fine)]
    assert closing[0] == pytest.approx(closing[1], rel=0.01)


@pytest.mark.slow
def test_stiffness_over_the_mesh_is_smooth():
    # neighbouring positions differ by the true change plus the noise of newly cut cells; the
    # second difference of a smooth curve at 18 positions stays below a sixth of its range
    phases = np.arange(18) / 18
    positions = [MeshPosition.at(shipped_pair("coast"), float(k)) for k in phases]
    rotation = np.array([p.load(20.0, TEETH, LoadedSettings()).rotation for p in positions])
    second = np.roll(rotation, 1) - 2.0 * rotation + np.roll(rotation, -1)
    assert np.median(np.abs(second)) < 0.16 * np.ptp(rotation)
