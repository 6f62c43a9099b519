"""The pair of the papers designed from its blank: against the ease-off of the printed settings.

Karagiannis et al. 2012, Table 1; its blank is method 1 of ISO 23509 with round numbers
(test_iso_23509_shipped_pair.py).
"""

import numpy as np
import pytest

from gearlube_core.hypoid_contact.ease_off import ease_off
from gearlube_core.hypoid_contact.pair import FlankPair
from gearlube_core.hypoid_design.blank_file import BlankFile
from gearlube_core.hypoid_design.design import nearest_fit
from gearlube_core.hypoid_design.designed_blank import DesignedBlank
from gearlube_core.hypoid_design.flank_target import FlankTarget, measured_contact
from gearlube_core.hypoid_design.start_settings import image_pair
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile

PAPER = HypoidGearFile.named("mohammadpour_2015")
SIDES = ("drive", "coast")
BLANK = BlankFile.named("hypoid_13_42").varied(
    {
        "pair.gear_teeth": 36,
        "pair.offset_mm": 24.0,
        "pair.outer_pitch_diameter_mm": 165.0,
        "pair.pinion_spiral_angle_deg": 46.0,
        "cutter.radius_mm": 64.0,
        "cutter.blade_groups": 11,
    }
)


def normal_gap(file, side):
    return ease_off(FlankPair.from_file(file, side), s_count=11, t_count=21).normal_gap()


@pytest.mark.slow
def test_its_blank_and_mean_contact_give_back_the_ease_off_of_the_paper():
    targets = {}
    for side in SIDES:
        found = measured_contact(PAPER, side)
        names = ("s", "t", "error", "length", "path_angle")
        targets[side] = FlankTarget(**{name: getattr(found, name) for name in names})
    designed = DesignedBlank.from_file(BLANK)
    design = nearest_fit(designed, image_pair(designed), targets).fit.file
    for side in SIDES:
        paper, made = normal_gap(PAPER, side), normal_gap(design, side)
        seen = np.isfinite(paper) & np.isfinite(made)
        assert seen.mean() > 0.65
        difference = made - paper
        # the three second-order numbers are asked for, nothing else: third order is left, 4 % of
        # the range over the flank and 1.5 um where the contact is
        assert np.sqrt(np.mean(difference[seen] ** 2)) < 0.05 * np.nanmax(paper)
        near = seen & (paper < 30e-6)
        assert np.sqrt(np.mean(difference[near] ** 2)) < 2e-6
