"""Pitting and breakage of bevel and hypoid gears against ISO/TR 10300-30:2024, samples 1 and 2."""

from __future__ import annotations

import math

import pytest

from gearlube_core.rating.iso_6336 import GearMaterial, LoadFactors, StrengthRating, ToothQuality
from gearlube_core.rating.iso_10300 import BevelMesh, bevel_rating

CASE = GearMaterial(treatment="case_hardened", contact_limit=1.5e9, bending_limit=4.8e8)
MM = 1e-3


def rad(degrees: float) -> float:
    return math.radians(degrees)


SPIRAL_BEVEL = BevelMesh(
    teeth=(14, 39),
    face_width=25.4 * MM,
    normal_module=3.213 * MM,
    pitch_diameter=(54.918 * MM, 152.987 * MM),
    pitch_angle=(rad(19.747), rad(70.253)),
    spiral_angle=(rad(35.0), rad(35.0)),
    pressure_angle=rad(20.0),
    effective_angle=rad(20.0),
    addendum=(4.837 * MM, 1.590 * MM),
    dedendum=(2.393 * MM, 5.640 * MM),
    addendum_shift=0.505,
    thickness_shift=(0.036, -0.055),
    cutter_radius=114.3 * MM,
    tool_radius=(0.8 / 3.213, 1.2 / 3.213),
)
HYPOID = BevelMesh(
    teeth=(13, 42),
    face_width=30.0 * MM,
    normal_module=2.640 * MM,
    pitch_diameter=(53.384 * MM, 141.877 * MM),
    pitch_angle=(rad(21.291), rad(68.321)),
    spiral_angle=(rad(50.0), rad(38.610)),
    pressure_angle=rad(17.748),
    limit_angle=rad(-2.252),
    effective_angle=rad(20.0),
    addendum=(3.432 * MM, 1.848 * MM),
    dedendum=(2.508 * MM, 4.092 * MM),
    addendum_shift=0.30,
    thickness_shift=(0.038, -0.062),
    cutter_radius=63.5 * MM,
    tool_radius=(0.8 / 2.640, 1.2 / 2.640),
    offset=15.0 * MM,
    offset_angle=rad(11.390),
    axial_offset_angle=rad(10.603),
)


def rated(mesh: BevelMesh, torque: float, pitch_deviation: float) -> StrengthRating:
    quality = ToothQuality(
        pitch_deviation=pitch_deviation, flank_roughness=8e-6, root_roughness=16e-6
    )
    return bevel_rating(
        mesh,
        pinion_torque=torque,
        pinion_speed=1200.0 * math.pi / 30.0,
        cycles=(5e7, 5e7),
        materials=(CASE, CASE),
        quality=(quality, quality),
        oil_viscosity=150e-6,
        factors=LoadFactors(application=1.1, face=1.65),
        modulus=210e9,
    )


@pytest.fixture(scope="module")
def bevel() -> StrengthRating:
    return rated(SPIRAL_BEVEL, 300.0, 26e-6)


@pytest.fixture(scope="module")
def hypoid() -> StrengthRating:
    return rated(HYPOID, 250.0, 23.5e-6)


@pytest.mark.parametrize(
    ("name", "printed"),
    [
        ("eps_va", 1.165), ("eps_vb", 1.227), ("l_bm", 22.442), ("rho_rel", 12.459),
        ("Z_MB", 0.916), ("Z_LS", 0.935), ("Z_Hyp", 1.0), ("F_n", 14193.3), ("K_v", 1.020),
        ("K_Ha", 1.161), ("K_F0", 1.0), ("sigma_H0", 1168.5), ("Y_Fa", (2.033, 2.480)),
        ("Y_Sa", (2.022, 1.706)), ("Y_BS", 1.054), ("sigma_F0", (316.5, 325.9)),
        ("sigma_F", (680.1, 700.1)),
    ],
)  # fmt: skip
def test_factors_of_sample_1_are_the_printed_ones(bevel, name, printed):
    assert bevel.factors[name] == pytest.approx(printed, rel=1.2e-3)  # angles to 0.001 deg


@pytest.mark.parametrize(
    ("name", "printed"),
    [
        ("eps_va", 1.010), ("eps_vb", 2.096), ("l_bm", 13.397), ("rho_rel", 17.926),
        ("Z_MB", 0.963), ("Z_LS", 0.703), ("Z_Hyp", 0.952), ("F_n", 15298.7), ("K_v", 1.016),
        ("K_Ha", 1.0), ("K_F0", 1.060), ("Y_Fa", (2.047, 2.403)), ("Y_Sa", (1.903, 1.690)),
        ("Y_BS", 1.909),
    ],
)  # fmt: skip
def test_factors_of_sample_2_are_the_printed_ones(hypoid, name, printed):
    assert hypoid.factors[name] == pytest.approx(printed, rel=1.2e-3)


def test_safety_against_pitting_of_sample_1_is_the_printed_one(bevel):
    assert bevel.contact_stress[0] == pytest.approx(1712.8e6, rel=1e-3)
    assert bevel.contact_strength[0] == pytest.approx(1617.8e6, rel=1e-3)
    assert bevel.contact_safety[0] == pytest.approx(0.944, abs=1e-3)


def test_offset_lowers_strength_by_sliding_and_not_below_its_limit():
    plain = rated(SPIRAL_BEVEL, 300.0, 26e-6)
    assert plain.outside == ()
    assert rated(HYPOID, 250.0, 23.5e-6).factors["Z_Hyp"] < 1.0
