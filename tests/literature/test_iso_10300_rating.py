"""Pitting and breakage of bevel and hypoid gears against ISO/TR 10300-30:2024, samples 1 and 2."""

from __future__ import annotations

import math
from dataclasses import replace

import pytest

from gearlube_core.errors import ParameterError
from gearlube_core.hypoid_geometry.blank.pitch_cones import PitchCones
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from gearlube_core.rating.bevel_mesh import BevelMesh
from gearlube_core.rating.gears import LoadFactors, RatedGear, StrengthRating
from gearlube_core.rating.iso_10300 import bevel_rating

CASE = RatedGear(treatment="case_hardened", contact_limit=1.5e9, bending_limit=4.8e8, modulus=210e9)
MM = 1e-3


def rad(degrees: float) -> float:
    return math.radians(degrees)


def cones(
    teeth: tuple[int, int], offset: float, diameters: tuple[float, float],
    pitch: tuple[float, float], spiral: tuple[float, float],
) -> PitchCones:  # fmt: skip
    """Lengths in mm, angles in degrees."""
    return PitchCones(
        pinion_teeth=teeth[0],
        gear_teeth=teeth[1],
        offset=offset * MM,
        shaft_angle=rad(90.0),
        pinion_pitch_angle=rad(pitch[0]),
        gear_pitch_angle=rad(pitch[1]),
        pinion_mean_cone_distance=0.5 * MM * diameters[0] / math.sin(rad(pitch[0])),
        gear_mean_cone_distance=0.5 * MM * diameters[1] / math.sin(rad(pitch[1])),
        pinion_spiral_angle=rad(spiral[0]),
        gear_spiral_angle=rad(spiral[1]),
    )


SPIRAL_BEVEL = BevelMesh(
    cones=cones((14, 39), 0.0, (54.918, 152.987), (19.747, 70.253), (35.0, 35.0)),
    face_width=25.4 * MM,
    addendum=(4.837 * MM, 1.590 * MM),
    dedendum=(2.393 * MM, 5.640 * MM),
    thickness_shift=(0.036, -0.055),
    cutter_radius=114.3 * MM,
    tool_radius=(0.8 / 3.213, 1.2 / 3.213),
)
HYPOID = BevelMesh(
    cones=cones((13, 42), 15.0, (53.384, 141.877), (21.291, 68.321), (50.0, 38.610)),
    face_width=30.0 * MM,
    addendum=(3.432 * MM, 1.848 * MM),
    dedendum=(2.508 * MM, 4.092 * MM),
    thickness_shift=(0.038, -0.062),
    cutter_radius=63.5 * MM,
    tool_radius=(0.8 / 2.640, 1.2 / 2.640),
)


def rated(mesh: BevelMesh, torque: float, pitch_deviation: float, **changes) -> StrengthRating:
    gear = replace(
        CASE, pitch_deviation=pitch_deviation, flank_roughness=8e-6, root_roughness=16e-6
    )
    return bevel_rating(
        **{
            "mesh": mesh,
            "gears": (gear, gear),
            "factors": LoadFactors(application=1.1, face=1.65),
            "pinion_torque": torque,
            "pinion_speed": 1200.0 * math.pi / 30.0,
            "cycles": (5e7, 5e7),
            "oil_viscosity": 150e-6,
            **changes,
        }
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
        ("K_Ha", 1.161), ("K_F0", 1.0), ("sigma_H0", 1168.5), ("Y_F", (2.033, 2.480)),
        ("Y_S", (2.022, 1.706)), ("Y_BS", 1.054), ("sigma_F0", (316.5, 325.9)),
    ],
)  # fmt: skip
def test_factors_of_sample_1_are_the_printed_ones(bevel, name, printed):
    assert bevel.factors[name] == pytest.approx(printed, rel=1.2e-3)  # angles to 0.001 deg


@pytest.mark.parametrize(
    ("name", "printed"),
    [
        ("eps_va", 1.010), ("eps_vb", 2.096), ("l_bm", 13.397), ("rho_rel", 17.926),
        ("Z_MB", 0.963), ("Z_LS", 0.703), ("Z_Hyp", 0.952), ("F_n", 15298.7), ("K_v", 1.016),
        ("K_Ha", 1.0), ("K_F0", 1.060), ("Y_F", (2.047, 2.403)), ("Y_S", (1.903, 1.690)),
        ("Y_BS", 1.909),
    ],
)  # fmt: skip
def test_factors_of_sample_2_are_the_printed_ones(hypoid, name, printed):
    assert hypoid.factors[name] == pytest.approx(printed, rel=1.2e-3)


def test_safety_against_pitting_of_sample_1_is_the_printed_one(bevel):
    assert bevel.contact_stress[0] == pytest.approx(1712.8e6, rel=1e-3)
    assert bevel.contact_strength[0] == pytest.approx(1617.8e6, rel=1e-3)
    assert bevel.contact_safety[0] == pytest.approx(0.944, abs=1e-3)
    assert bevel.bending_stress == pytest.approx((680.1e6, 700.1e6), rel=1.2e-3)


def test_strengths_of_the_samples_are_the_printed_ones(bevel, hypoid):
    # at a life factor of 1, that bending has at 3e6 cycles
    bent = rated(SPIRAL_BEVEL, 300.0, 26e-6, cycles=(3e6, 3e6))
    assert bent.bending_strength == pytest.approx((942.0e6, 929.8e6), rel=1e-3)
    bent = rated(HYPOID, 250.0, 23.5e-6, cycles=(3e6, 3e6))
    assert bent.bending_strength == pytest.approx((936.4e6, 929.0e6), rel=1e-3)
    # calculated by the formulas, not printed
    assert hypoid.contact_stress[0] == pytest.approx(1407.2e6, rel=1e-3)
    assert hypoid.contact_strength[0] == pytest.approx(1548.9e6, rel=1e-3)


def test_limits_of_the_method_are_said_and_within_them_nothing(bevel):
    assert bevel.outside == ()
    steep = replace(
        SPIRAL_BEVEL,
        cones=replace(SPIRAL_BEVEL.cones, pinion_spiral_angle=0.85, gear_spiral_angle=0.85),
        face_width=45.0 * MM,
    )
    said = " ".join(rated(steep, 300.0, 26e-6).outside)
    assert "mean spiral angle up to 45 deg, got 48.7 deg" in said
    assert "face width up to 13 normal modules, got 1" in said
    assert "coast flank" in " ".join(rated(replace(HYPOID, flank="coast"), 250.0, 23.5e-6).outside)


def test_a_straight_bevel_gear_is_the_limit_of_small_spiral_angles():
    def factors(spiral: float) -> dict:
        small = replace(SPIRAL_BEVEL.cones, pinion_spiral_angle=spiral, gear_spiral_angle=spiral)
        return rated(replace(SPIRAL_BEVEL, cones=small), 300.0, 26e-6).factors

    straight, near = factors(0.0), factors(1e-6)
    assert straight["sigma_H0"] == pytest.approx(near["sigma_H0"], rel=1e-4)
    assert straight["Y_eps"] == pytest.approx(0.25 + 0.75 / straight["eps_va"], rel=1e-12)


def test_the_coast_flank_of_gears_without_offset_is_as_the_drive_flank(bevel):
    coast = rated(replace(SPIRAL_BEVEL, flank="coast"), 300.0, 26e-6)
    # the printed spiral angles leave a limit angle of 2e-4 degrees
    assert coast.contact_stress[0] == pytest.approx(bevel.contact_stress[0], rel=1e-4)


def test_a_blank_gives_the_mesh_of_its_cones():
    blank = HypoidGearFile.named("mohammadpour_2015").blank()
    mesh = BevelMesh.of_blank(blank)
    assert mesh.cones.normal_module == pytest.approx(blank.mean_normal_module, rel=1e-12)
    assert mesh.diameters[0] == pytest.approx(2e3 * blank.pinion.mean_pitch_radius, rel=1e-9)
    assert sum(mesh.addendum) == pytest.approx(blank.working_depth)


def test_heights_in_millimetres_are_refused():
    with pytest.raises(ParameterError, match="addendum of the pinion in normal modules must be"):
        replace(SPIRAL_BEVEL, addendum=(4.837, 1.590))
