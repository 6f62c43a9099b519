"""Where the involute begins above the fillet of a hob: against the rolling tool itself."""

import math

import numpy as np
import pytest

from gearlube_core.helical_geometry.tooth_limits import (
    RackTool,
    involute_start,
    largest_fillet,
    tip_thickness,
)
from tests.helpers.each import each


def inside_tool(u, depth, tool):
    """Whether points lie in a tooth of the rack; u from its flank at the pitch line, transverse.

    The normal section of the rack is stretched by 1/cos(beta) along the pitch line.
    """
    tangent, u = math.tan(tool.pressure_angle), u * math.cos(tool.helix_angle)
    centre = tool.depth - tool.fillet
    middle = centre * tangent + tool.fillet / math.cos(tool.pressure_angle)
    end = centre + tool.fillet * math.sin(tool.pressure_angle)
    straight = (depth <= end) & (u > depth * tangent)
    corner = (
        (depth > end)
        & (depth < tool.depth)
        & ((u > middle) | (np.hypot(u - middle, depth - centre) < tool.fillet))
    )
    return straight | corner


def is_cut(roll, tool):
    """Whether some position of the rolling rack covers the involute's point at a roll length."""
    alpha = math.atan(math.tan(tool.pressure_angle) / math.cos(tool.helix_angle))
    base = tool.radius * math.cos(alpha)
    radius = math.hypot(base, roll)
    place = (roll / base - math.atan(roll / base)) - (math.tan(alpha) - alpha)
    turned = np.linspace(-1.2, 1.2, 400_001)  # rad, of the gear
    angle = place + turned
    depth = tool.radius - radius * np.cos(angle)
    # the rack moves with the reference circle; a point 1e-9 r deep in it counts
    u = tool.radius * turned - radius * np.sin(angle)
    return bool(inside_tool(u - 1e-9 * tool.radius, depth, tool).any())


@each(
    ("teeth", "pressure_angle", "helix_angle", "depth", "fillet", "undercut"),
    [
        (24, 14.5, 0.0, 1.25, 0.275, True),
        (24, 14.5, 0.0, 1.25, 0.38, True),
        (10, 20.0, 0.0, 1.25, 0.25, True),
        (9, 20.0, 30.0, 1.1, 0.3, True),
        (14, 20.0, 15.0, 1.4, 0.39, True),
        (17, 20.0, 15.0, 1.05, 0.38, False),
        (40, 20.0, 0.0, 1.25, 0.38, False),
        (30, 25.0, 25.0, 1.35, 0.2, False),
    ],
)
def test_the_involute_begins_where_no_position_of_the_hob_cuts_it(
    teeth, pressure_angle, helix_angle, depth, fillet, undercut
):
    helix = math.radians(helix_angle)
    tool = RackTool(
        0.5 * teeth / math.cos(helix), math.radians(pressure_angle), helix, depth, fillet
    )
    start = involute_start(tool)
    assert start.undercut == undercut
    # 400,001 positions: 2e-5 modules of the path between two
    assert not is_cut(start.roll + 2e-3, tool)
    assert is_cut(start.roll - 2e-3, tool) == undercut
    if not undercut:  # the straight flank's end touches it, cos(alpha) of the path of contact
        end = depth - fillet * (1.0 - math.sin(tool.pressure_angle))
        alpha = math.atan(math.tan(tool.pressure_angle) / math.cos(helix))
        roll = tool.radius * math.sin(alpha) - end / math.sin(alpha)
        assert start.roll == pytest.approx(roll, rel=1e-12)


def test_a_round_tool_tip_has_the_largest_fillet():
    """Straight flanks pi/4 m apart from the middle, tangent to a circle about it: by its centre."""
    alpha, dedendum = math.radians(20.0), 1.25
    fillet = largest_fillet(1.0, alpha, dedendum)
    centre = dedendum - fillet
    beside = centre * math.tan(alpha) + fillet / math.cos(alpha)
    assert beside == pytest.approx(0.25 * math.pi, rel=1e-12)
    assert largest_fillet(1.0, alpha, 3.0) == 0.0


def test_a_tooth_is_pointed_where_its_two_involutes_meet():
    radius, alpha, thickness = 10.0, math.radians(20.0), 0.5 * math.pi
    base = radius * math.cos(alpha)
    half = thickness / 2.0 / radius + math.tan(alpha) - alpha
    meeting = next(a for a in np.linspace(0.5, 1.0, 500_001) if math.tan(a) - a >= half)
    tip = base / math.cos(meeting)
    assert tip_thickness(radius, thickness, tip, alpha) == pytest.approx(0.0, abs=1e-4)
    assert tip_thickness(radius, thickness, radius, alpha) == pytest.approx(thickness)
