"""Pitting and breakage of cylindrical gears against published worked examples of ISO 6336:2006."""

from __future__ import annotations

import math

import pytest

from gearlube_core.helical_geometry.pair import HelicalPair
from gearlube_core.rating.iso_6336 import (
    GearMaterial,
    LoadFactors,
    StrengthRating,
    ToothQuality,
    cylindrical_rating,
)

CASE = GearMaterial(treatment="case_hardened", contact_limit=1.5e9, bending_limit=4.3e8)


def helical(
    teeth: tuple[int, int], m_n: float, helix: float, x: tuple[float, float], a: float, b: float,
    tips: tuple[float, float], dedendum: float, fillet: float,
) -> HelicalPair:  # fmt: skip
    """Lengths in mm, helix in degrees, dedendum and fillet in modules."""
    m_t = m_n / math.cos(math.radians(helix))
    roots = [z * m_t - 2.0 * m_n * (dedendum - s) for z, s in zip(teeth, x, strict=True)]
    return HelicalPair(
        name="sample",
        pinion_teeth=teeth[0],
        gear_teeth=teeth[1],
        normal_module=1e-3 * m_n,
        normal_pressure_angle=math.radians(20.0),
        helix_angle=math.radians(helix),
        centre_distance=1e-3 * a,
        pinion_tip_radius=5e-4 * tips[0],
        gear_tip_radius=5e-4 * tips[1],
        pinion_root_radius=5e-4 * roots[0],
        gear_root_radius=5e-4 * roots[1],
        face_width=1e-3 * b,
        profile_shift=x,
        fillet_factor=fillet,
    )


@pytest.fixture(scope="module")
def example_1() -> StrengthRating:
    """ISO/TR 6336-30:2017, example 1; its dynamic, face and transverse factors are given."""
    quality = ToothQuality(flank_roughness=6e-6)
    turns = 60.0 * 360.0 * 50_000.0
    return cylindrical_rating(
        helical((17, 103), 8.0, 15.8, (0.145, 0.0), 500.0, 100.0, (159.66, 872.35), 1.4, 0.39),
        pinion_torque=9000.0,
        pinion_speed=360.0 * math.pi / 30.0,
        cycles=(turns, turns * 17 / 103),
        materials=(CASE, CASE),
        quality=(quality, quality),
        oil_viscosity=320e-6,
        factors=LoadFactors(dynamic=1.003, face=1.16, transverse=1.0, transverse_root=1.0),
    )


@pytest.mark.parametrize(
    ("name", "printed"),
    [
        ("F_t", 127352.0), ("v", 2.664), ("c'", 12.37047), ("c_ga", 17.46485), ("K_Fb", 1.12803),
        ("Z_H", 2.39533), ("Z_E", 189.8117), ("Z_beta", 1.01944), ("Z_L", 1.04739),
        ("Z_v", 0.96911), ("Z_R", 0.96599), ("Z_NT", (0.910, 0.962)), ("sigma_H0", 1206.582),
    ],
)  # fmt: skip
def test_factors_of_example_1_are_the_printed_ones(example_1, name, printed):
    # tip diameters to 0.01 mm, so contact ratios to 1e-3
    assert example_1.factors[name] == pytest.approx(printed, rel=1e-3)


def test_safety_of_example_1_is_the_printed_one(example_1):
    assert example_1.contact_stress[0] == pytest.approx(1301.353e6, rel=1e-3)
    assert example_1.contact_strength == pytest.approx((1338.481e6, 1414.526e6), rel=1e-4)
    assert example_1.contact_safety == pytest.approx((1.02853, 1.08696), rel=1e-3)


@pytest.fixture(scope="module")
def stage_3() -> StrengthRating:
    """Third stage of the NREL 5 MW gearbox by a commercial report of 2017."""
    quality = (
        ToothQuality(
            pitch_deviation=13.1e-6, profile_deviation=18e-6, flank_roughness=4.8e-6,
            root_roughness=20e-6,
        ),
        ToothQuality(
            pitch_deviation=15.9e-6, profile_deviation=22e-6, flank_roughness=4.8e-6,
            root_roughness=20e-6,
        ),
    )  # fmt: skip
    turns = 60.0 * 1165.9 * 175_200.0
    return cylindrical_rating(
        helical(
            (24, 95), 14.0, 10.0, (0.48, 0.6691), 861.0, 360.0, (380.747, 1395.376), 1.25, 0.38
        ),
        pinion_torque=40953.0,
        pinion_speed=1165.9 * math.pi / 30.0,
        cycles=(turns, turns * 24 / 95),
        materials=(CASE, CASE),
        quality=quality,
        oil_viscosity=220e-6,
        factors=LoadFactors(
            application=1.25, face=1.15, dynamic=1.092, transverse=1.069, transverse_root=1.069
        ),
    )


@pytest.mark.parametrize(
    ("name", "printed"),
    [
        ("eps_a", 1.463), ("eps_b", 1.421), ("F_t", 240064.0), ("K_Fb", 1.136), ("Z_H", 2.307),
        ("Z_eps", 0.827), ("Z_beta", 1.008), ("sigma_H0", 570.79), ("Z_L", 1.020), ("Z_v", 1.022),
        ("Z_R", 1.007), ("Z_NT", (0.850, 0.881)), ("Y_F", (1.18, 1.24)), ("Y_S", (2.28, 2.35)),
        ("Y_beta", 0.917), ("sigma_F0", (117.92, 127.69)), ("Y_NT", (0.850, 0.870)),
        ("Y_RrelT", (0.957, 0.957)), ("Y_X", (0.910, 0.910)), ("sigma_FG", (637.15, 654.72)),
    ],
)  # fmt: skip
def test_factors_of_the_third_stage_are_the_printed_ones(stage_3, name, printed):
    # printed with three digits; forms of teeth differ by 0.1 %, Y_S by 0.3
    assert stage_3.factors[name] == pytest.approx(printed, rel=4e-3)


def test_safety_of_the_third_stage_is_the_printed_one(stage_3):
    assert stage_3.contact_stress[0] == pytest.approx(739.61e6, rel=1e-3)
    assert stage_3.contact_strength == pytest.approx((1338.30e6, 1387.31e6), rel=1e-4)
    assert stage_3.contact_safety == pytest.approx((1.81, 1.88), abs=0.006)
    assert stage_3.bending_safety == pytest.approx((3.26, 3.09), abs=0.006)
