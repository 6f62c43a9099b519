"""Reliefs in a hypoid gear file: what is read, and what is refused with which words."""

import pytest

from gearlube_core.errors import ParameterError
from gearlube_core.hypoid_contact.pair import FlankPair
from gearlube_core.hypoid_geometry.flank.correction import EdgeRelief
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from tests.helpers.each import each

FILE = HypoidGearFile.named("mohammadpour_2015")


def with_fields(**fields):
    return FILE.varied({f"pinion.coast_flank.{name}": value for name, value in fields.items()})


def test_fields_become_metres_on_their_own_flank_alone():
    file = with_fields(
        root_relief_um=12.0, root_relief_depth_mm=1.5, end_edge_radius_mm=0.4, twist_um=-5.0
    )
    found = file.correction("pinion", "coast")
    assert found.reliefs[0] == EdgeRelief(edge="root", amount=12e-6, extent=1.5e-3)
    assert [(one.edge, one.extent) for one in found.reliefs[1:]] == [
        ("toe", pytest.approx(0.4e-3)),
        ("heel", pytest.approx(0.4e-3)),
    ]
    assert found.twist == pytest.approx(-5e-6)
    assert file.correction("pinion", "drive").is_none
    assert file.correction("gear", "coast").is_none


@each(
    ("fields", "parts"),
    [
        ({"tip_relief_um": -5.0}, ["tip_relief_um must be a number, 0 to 500 um, got -5"]),
        ({"tip_relief_um": 20.0}, ["tip_relief_depth_mm is missing"]),
        (
            {"tip_relief_um": 20.0, "tip_relief_depth_mm": -1.0},
            ["tip_relief_depth_mm must be a number, above 0 to 200 mm, got -1"],
        ),
        (
            {"tip_relief_um": 0.02, "tip_relief_depth_mm": 2.0},
            ["tip_relief_um must be 0 or 0.5 to 500 um, got 0.02 um", "0.02 mm is 20 um"],
        ),
        ({"lead_crown_um": -0.01}, ["lead_crown_um must be 0 or 0.5", "0.01 mm is 10 um"]),
        (
            {"tip_relief_um": 20.0, "tip_relief_depth_mm": 9.0},
            # whole depth 7.615 mm: working depth 6.769 mm and an eighth of it
            ["pinion.coast_flank: the reliefs must fit", "7.615 mm, got tip_relief_depth_mm 9 mm"],
        ),
        (
            {
                "toe_relief_um": 20.0, "toe_relief_length_mm": 20.0, "heel_relief_um": 20.0,
                "heel_relief_length_mm": 20.0,
            },
            ["at most pinion.face_width_mm", "toe_relief_length_mm 20 mm and heel_relief"],
        ),
        (
            {"tip_relief_um": 200.0, "tip_relief_depth_mm": 1.0},
            ["tip_relief_um must be at most 10 % of tip_relief_depth_mm, 100 um, got 200 um"],
        ),
        ({"tip_edge_radius_mm": 30.0}, ["tip_edge_radius_mm must be a number, 0 to 2 mm, got 30"]),
    ],
)  # fmt: skip
def test_a_wrong_relief_is_refused_with_value_limit_and_cure(fields, parts):
    with pytest.raises(ParameterError) as caught:
        with_fields(**fields)
    for part in parts:
        assert part in str(caught.value), str(caught.value)


def test_derivatives_of_the_unloaded_contact_are_refused_for_corrected_flanks():
    pair = FlankPair.from_file(with_fields(twist_um=5.0), "coast")
    with pytest.raises(ParameterError, match=r"corrected coast flanks\. Take `pair\.uncorrected"):
        pair.check_uncorrected()
    pair.uncorrected().check_uncorrected()
