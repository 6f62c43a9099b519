"""Tip relief, crown and slopes against their closed forms."""

from dataclasses import replace

import numpy as np
import pytest

from gearlube_core.helical_geometry.modification import (
    Crown,
    FlankModification,
    ModifiedPair,
    PowerTipRelief,
    TipRelief,
)
from tests.helpers.each import each
from tests.helpers.named_pairs import named_pair

TIP, EXTENT, AMOUNT = 0.083305, 2e-3, 70e-6
START = TIP - EXTENT
RADII = np.linspace(START, TIP, 401)


def relief(k):
    return TipRelief(amount=AMOUNT, extent=EXTENT, k=k)


@each("k", [0.1, 0.3, 0.5, 0.9])
def test_relief_joins_parabola_and_line_without_a_step_in_slope(k):
    r_ce, d = START + k * EXTENT, 1e-9
    below, at, above = relief(k).removal([r_ce - d, r_ce, r_ce + d], TIP)
    # one-sided differences: the parabola's second derivative times d, plus rounding
    assert (above - at) / d == pytest.approx((at - below) / d, rel=1e-5)
    assert at == pytest.approx(relief(k).parabola_end_removal, rel=1e-9)
    start = relief(k).removal([START, START + d], TIP)
    assert start[0] == 0.0
    assert (start[1] - start[0]) / d < 1e-5 * AMOUNT / EXTENT / k


@each("k", [0.0, 0.1, 0.5, 1.0])
def test_relief_reaches_its_amount_at_the_tip_with_the_stated_slope(k):
    d = 1e-9
    before, tip, past = relief(k).removal([TIP - d, TIP, TIP + d], TIP)
    assert tip == pytest.approx(AMOUNT, rel=1e-12)
    # rounding of radii: 1e-17/1e-9
    assert (past - tip) / d == pytest.approx(relief(k).tip_slope, rel=1e-5)
    assert (tip - before) / d == pytest.approx(relief(k).tip_slope, rel=1e-5)


def test_relief_is_a_line_without_and_a_parabola_with_full_blend():
    depth = (RADII - START) / EXTENT
    # rounding of radii, 1e-17 m of 2 mm
    assert relief(0.0).removal(RADII, TIP) == pytest.approx(AMOUNT * depth, abs=1e-17)
    assert relief(1.0).removal(RADII, TIP) == pytest.approx(AMOUNT * depth**2, abs=1e-17)
    for beta, k in ((1.0, 0.0), (2.0, 1.0)):
        power = PowerTipRelief(amount=AMOUNT, extent=EXTENT, beta=beta)
        assert power.removal(RADII, TIP) == pytest.approx(relief(k).removal(RADII, TIP), abs=1e-17)


def test_blended_relief_tends_to_linear_relief_in_proportion_to_k():
    errors = [
        np.max(np.abs(relief(k).removal(RADII, TIP) - relief(0.0).removal(RADII, TIP)))
        for k in (0.02, 0.01, 0.005)
    ]
    # the line starts k/2 of the extent later: first order in k
    assert errors[0] / errors[1] == pytest.approx(2.0, rel=0.02)
    assert errors[1] / errors[2] == pytest.approx(2.0, rel=0.02)


def test_higher_powers_remove_less_everywhere_but_at_the_tip():
    inner = RADII[1:-1]
    removed = [
        PowerTipRelief(amount=AMOUNT, extent=EXTENT, beta=b).removal(inner, TIP) for b in (1, 2, 3)
    ]
    assert np.all(removed[0] > removed[1])
    assert np.all(removed[1] > removed[2])


def test_crown_is_a_parabola_between_its_start_and_the_face_edges():
    W = 44e-3
    crown = Crown(amount=8e-6, start=0.25 * W)
    z = np.array([-0.5, -0.375, -0.25, 0.0, 0.2, 0.25, 0.375, 0.5]) * W
    expected = 8e-6 * np.array([1.0, 0.25, 0.0, 0.0, 0.0, 0.0, 0.25, 1.0])
    assert crown.removal(z, W) == pytest.approx(expected, abs=1e-18)


def test_slopes_act_where_and_as_much_as_stated():
    pair = named_pair("jamali_2015_b")
    W = pair.face_width
    lead = ModifiedPair(pair=pair, pinion=FlankModification(lead_slope=12e-6))
    assert lead.removal(pair.pitch_point, [-0.5 * W, 0.0, 0.5 * W]) == pytest.approx(
        [-6e-6, 0.0, 6e-6], abs=1e-18
    )
    on_gear = ModifiedPair(pair=pair, gear=FlankModification(lead_slope=12e-6))
    x, z = np.linspace(pair.contact_start, pair.contact_end, 7)[:, None], np.linspace(-W, W, 5)
    assert on_gear.removal(x, z) == pytest.approx(lead.removal(x, z), abs=1e-18)
    profile = FlankModification(profile_slope=10e-6)
    ends = [pair.contact_start, 0.5 * (pair.contact_start + pair.contact_end), pair.contact_end]
    # the pinion's tip is at the end of contact, the gear's at its start
    at_pinion = ModifiedPair(pair=pair, pinion=profile).removal(ends, 0.0)
    at_gear = ModifiedPair(pair=pair, gear=profile).removal(ends, 0.0)
    assert at_pinion == pytest.approx([-5e-6, 0.0, 5e-6], abs=1e-17)
    assert at_gear == pytest.approx(-at_pinion, abs=1e-17)


def test_removals_of_both_members_add():
    pair = named_pair("jamali_2015_a")
    one = FlankModification(tip_relief=relief(0.5), crown=Crown(amount=8e-6, start=0.0))
    both = ModifiedPair(pair=pair, pinion=one, gear=one)
    x = np.linspace(pair.contact_start, pair.contact_end, 31)[:, None]
    z = np.linspace(-0.5, 0.5, 9) * pair.face_width
    total = both.pinion_removal(x, z) + both.gear_removal(pair.tangent_length - x, z)
    assert both.removal(x, z) == pytest.approx(total, abs=1e-18)
    alone = ModifiedPair(pair=pair, pinion=replace(one, tip_relief=None), gear=one)
    assert alone.contact_end == pytest.approx(pair.contact_end, rel=1e-14)
    assert alone.contact_start == pytest.approx(both.contact_start, rel=1e-14)
