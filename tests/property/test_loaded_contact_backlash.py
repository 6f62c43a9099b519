"""Loaded contact of flanks that stand apart: the way to first touch must not matter."""

import numpy as np
import pytest

from gearlube_core.hypoid_contact.loaded_contact import LoadedSettings, MeshPosition
from gearlube_core.hypoid_contact.pair import FlankPair
from tests.helpers.contact_cases import shipped_file
from tests.helpers.loaded_cases import stiffness

# the printed blade angles with another pinion swivel mesh too, after 0.1 mm of backlash a side
APART = shipped_file().varied(
    {
        "pinion.cutter.convex_flank_angle_correction_deg": 0.0,
        "pinion.cutter.concave_flank_angle_correction_deg": 0.0,
        "pinion.machine.basic_swivel_angle_deg": -33.425,
    }
)
TEETH = stiffness()


@pytest.mark.parametrize("phase", [0.0, 0.75])
def test_closing_under_load_does_not_hang_on_the_first_guess_of_it(phase):
    position = MeshPosition.at(FlankPair.from_file(APART, "drive"), phase)
    arm = float(np.nanmedian(position.maps[len(position.maps) // 2].arm))
    assert arm * position.unloaded_rotation > 80e-6
    closing = [
        position.load(50.0, TEETH, LoadedSettings(), guess).rotation - position.unloaded_rotation
        for guess in (0.0, 30e-6)
    ]
    # 1 %: the wider guess cuts longer strips into the same number of cells; a strip too short for
    # one of the two pairs would close half as much again
    assert closing[0] == pytest.approx(closing[1], rel=0.01)
