"""What every modification and every undeformed gap must obey."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from gearlube_core.helical_geometry.involute import relative_position, roll_at_tangent_distance
from gearlube_core.helical_geometry.modification import (
    Crown,
    FlankModification,
    ModifiedPair,
    PowerTipRelief,
    TipRelief,
)
from gearlube_core.helical_geometry.undeformed_gap import UndeformedGap
from tests.helpers.named_pairs import PAIRS, named_pair

reliefs = st.one_of(
    st.none(),
    st.builds(
        TipRelief, amount=st.floats(0.0, 1e-4), extent=st.floats(2e-4, 2e-3), k=st.floats(0.0, 1.0)
    ),
    st.builds(
        PowerTipRelief,
        amount=st.floats(0.0, 1e-4),
        extent=st.floats(2e-4, 2e-3),
        beta=st.floats(1.0, 4.0),
    ),
)
crowns = st.one_of(
    st.none(), st.builds(Crown, amount=st.floats(0.0, 5e-5), start=st.floats(0.0, 1e-2))
)
flanks = st.builds(FlankModification, tip_relief=reliefs, crown=crowns, facets=st.integers(0, 99))


def middle_line(pair):
    return pair.pitch_point + 0.5 * pair.face_width * math.tan(pair.base_helix_angle)


@settings(max_examples=60, deadline=None)
@given(name=st.sampled_from(PAIRS), pinion=flanks, gear=flanks)
def test_relief_crown_and_facets_only_remove_material(name, pinion, gear):
    pair = named_pair(name)
    modified = ModifiedPair(pair=pair, pinion=pinion, gear=gear)
    x = np.linspace(pair.contact_start, pair.contact_end, 41)[:, None]
    z = np.linspace(-0.5, 0.5, 11) * pair.face_width
    # rounding of a facet's chord at its ends: 1e-16 of 0.1 m
    assert modified.removal(x, z).min() >= -1e-16
    gap = UndeformedGap(modified=modified)
    plain = UndeformedGap(modified=ModifiedPair(pair=pair))
    grid = np.linspace(-2e-4, 2e-4, 9)[:, None], np.linspace(-1e-2, 1e-2, 7)[None, :]
    X = middle_line(pair)
    # removal shifts the section by sin(b) times itself, along which a flank varies by 1e-4
    assert np.all(gap.heights(*grid, X) >= plain.heights(*grid, X) * (1.0 - 1e-4) - 1e-16)


@pytest.mark.parametrize("crown", [0.0, 8e-6])
def test_gap_of_two_equal_gears_is_symmetric_about_the_pitch_line(crown):
    pair = named_pair("jamali_2015_a")
    pair = replace(
        pair,
        gear_teeth=33,
        gear_tip_radius=pair.pinion_tip_radius,
        gear_root_radius=pair.pinion_root_radius,
        centre_distance=0.158,
    )
    flank = FlankModification(
        tip_relief=TipRelief(amount=70e-6, extent=2e-3, k=0.5), crown=Crown(amount=crown, start=0.0)
    )
    gap = UndeformedGap(modified=ModifiedPair(pair=pair, pinion=flank, gear=flank))
    x = np.linspace(-4e-4, 4e-4, 33)[:, None]
    y = np.linspace(-1.0, 1.0, 41)[None, :] * 22e-3
    h = gap.heights(x, y, middle_line(pair))
    # half a turn about the line of action's middle swaps the members; the removals of both
    # shift the section oppositely, seen at the rounding of x_g - x
    assert h == pytest.approx(h[::-1, ::-1], rel=1e-9, abs=1e-16)


def test_lead_slope_tilts_the_gap_by_the_stated_amount():
    pair = named_pair("jamali_2015_a")
    slope, cos_b = 15e-6, math.cos(pair.base_helix_angle)
    y = np.array([-0.5, 0.0, 0.5]) * pair.face_width / cos_b
    for member, side in (("pinion", 1.0), ("gear", -1.0)):
        modified = ModifiedPair(pair=pair, **{member: FlankModification(lead_slope=slope)})
        h = UndeformedGap(modified=modified).heights(0.0, y, middle_line(pair))
        expected = slope * cos_b * np.array([-0.5, 0.0, 0.5])
        # the gap shifts its section along the line: its slope times sin(b), 1e-4 of itself
        assert h == pytest.approx(expected, rel=2e-4, abs=1e-15)
        rate = slope * cos_b / pair.face_width * math.sin(pair.base_helix_angle)
        assert h == pytest.approx(expected / (1.0 - side * rate), rel=1e-10, abs=1e-16)


def test_equal_slopes_of_opposite_sign_leave_the_gap_flat():
    pair = named_pair("he_2007")
    up, down = FlankModification(lead_slope=9e-6), FlankModification(lead_slope=-9e-6)
    modified = ModifiedPair(pair=pair, pinion=up, gear=down)
    x = np.linspace(pair.contact_start, pair.contact_end, 9)[:, None]
    z = np.linspace(-0.5, 0.5, 5) * pair.face_width
    assert np.abs(modified.removal(x, z)).max() < 1e-18


@settings(max_examples=100, deadline=None)
@given(r_b=st.floats(0.02, 0.5), share=st.floats(0.05, 0.6), t_share=st.floats(-0.4, 0.6))
def test_roll_at_a_tangent_distance_inverts_the_involute(r_b, share, t_share):
    roll = share * r_b
    t = 0.5 * t_share * roll * share  # the base circle is at -roll share/2
    other = roll_at_tangent_distance(roll, t, r_b)
    # two Newton steps: films need turns below 0.03 rad, this tries up to 0.3 rad
    assert relative_position(roll, other, r_b)[0] == pytest.approx(t, rel=1e-6, abs=1e-15)


def test_gap_is_infinite_where_no_involute_exists():
    pair = named_pair("jamali_2015_a")
    gap = UndeformedGap(modified=ModifiedPair(pair=pair))
    h = gap.heights(np.array([0.0, 3e-3]), 0.0, middle_line(pair))
    assert np.all(np.isfinite(h))
    # the pinion's involute ends 5.4 mm below its tangent at the pitch line
    assert np.isinf(gap.heights(8e-3, 0.0, middle_line(pair)))
    assert np.isinf(gap.heights(0.0, 0.0, middle_line(pair) - 1.1 * pair.pitch_point))
