"""Flank surfaces: derivatives, export and STEP files."""

import math
import sys

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from gearlube_core.errors import ParameterError
from gearlube_core.hypoid_geometry.flank.cutting_motion import cut_state
from gearlube_core.hypoid_geometry.flank.flank import Flank
from gearlube_core.hypoid_geometry.flank.surface_point import CONVERGED, locate, surface_point
from gearlube_core.hypoid_geometry.flank.tooth import Tooth
from gearlube_core.hypoid_geometry.flank.tooth_solid import (
    gear_solid,
    mirror_image,
    tooth_solid,
    write_flank_csv,
    write_solid,
)
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile

FILE = HypoidGearFile.named("mohammadpour_2015")
BENT = FILE.varied(
    {
        "pinion.machine.modified_roll_2c": 0.08,
        "pinion.machine.modified_roll_6d": -0.3,
        "pinion.machine.helical_motion_mm_per_rad": 6.0,
        # rolls on its pitch cone
        "gear.machine.ratio_of_roll": 1.0 / math.sin(math.radians(FILE.gear.pitch_angle_deg)),
    }
)
MEMBERS = [
    (name, role, side)
    for name in ("shipped", "bent")
    for role in ("pinion", "gear")
    for side in ("drive", "coast")
]


@pytest.fixture(scope="module", params=MEMBERS, ids="-".join)
def flank(request):
    name, role, side = request.param
    return Flank.from_file({"shipped": FILE, "bent": BENT}[name], role, side)


@pytest.mark.parametrize("angle", [-0.2, 0.3])
def test_modified_roll_turns_the_work_less_and_helical_motion_shifts_the_cutter(angle):
    """The point of the plain motion, shifted and turned by hand."""
    plain, bent = (Flank.from_file(file, "pinion", "drive").motion for file in (FILE, BENT))
    bent = bent._replace(cos_offset=plain.cos_offset, sin_offset=plain.sin_offset)
    here = np.array(cut_state(plain, 1e-3, 0.1, angle).r)
    ratio, axis = plain.roll_ratio, np.array(plain.work_axis)
    index = FILE.pinion.cutter.blade_groups / FILE.pinion.teeth
    # the work stands at -(index 0.1 + ratio angle): from its axes to the machine's, and back
    to_machine = Rotation.from_rotvec(-(index * 0.1 + ratio * angle) * axis)
    shifted = to_machine.apply(here - plain.work_point) + 6e-3 * angle * np.array(plain.cradle_axis)
    less = 0.08 * angle**2 / 2.0 - 0.3 * angle**3 / 6.0
    back = Rotation.from_rotvec((index * 0.1 + ratio * (angle - less)) * axis)
    expected = back.apply(shifted) + plain.work_point
    np.testing.assert_allclose(cut_state(bent, 1e-3, 0.1, angle).r, expected, atol=1e-14)


def test_a_generated_gear_is_convex_along_its_profile_as_its_virtual_spur_gear():
    """On the pitch cone rho = r / cos(d) sin(a) / cos^2(b); a form-cut flank is straight there.

    Involute of the virtual gear: mean radius r, pitch angle d, spiral angle b, blade angle a.
    """
    straight = {"gear.cutter.blade_edge_radius_mm": None, "gear.cutter.blade_offset_angle_deg": 0.0}
    single = {"gear.cutter.blade_groups": 0, "pinion.cutter.blade_groups": 0}
    file = BENT.varied(straight | single)
    cutter, member = file.gear.cutter, file.blank().gear
    virtual = member.mean_cone_distance * math.tan(member.pitch_angle)
    for side, angle in (
        ("drive", cutter.convex_flank_blade_angle_deg),
        ("coast", cutter.concave_flank_blade_angle_deg),
    ):
        flank = Flank.from_file(file, "gear", side)
        pitch = flank.region.root_depth / (flank.region.root_depth + flank.region.addendum)
        here = flank.sample(np.array(pitch), np.array(0.5))
        radius = virtual * math.sin(math.radians(angle)) / math.cos(member.spiral_angle) ** 2
        # the cutter's curvature along the tooth adds a tenth, as both are hollow or not
        assert -here.curvature[0, 0] * radius == pytest.approx(1.0, abs=0.15)
        formed = Flank.from_file(file.varied({"gear.machine.ratio_of_roll": None}), "gear", side)
        flat = formed.sample(np.array(pitch), np.array(0.5)).curvature[0, 0]
        assert flat == pytest.approx(0.0, abs=1e-9)


@pytest.mark.parametrize("name", ["u", "th", "ph"])
def test_derivatives_are_those_of_the_points_and_normals(flank, name):
    at = flank.start + np.array([0.7e-3, 0.08, -0.05 * flank.motion.generated])
    step = np.zeros(3)
    step[("u", "th", "ph").index(name)] = h = 1e-6
    if name == "ph" and not flank.motion.generated:
        # a form-cut flank has no cradle motion: its equation of meshing is ph = 0
        turned = cut_state(flank.motion, *(at + 0.3 * step / h))
        assert (turned.meshing, turned.meshing_ph) == (0.3, 1.0)
        assert turned.r_ph == (0.0, 0.0, 0.0)
        return
    state = cut_state(flank.motion, *at)
    ahead, behind = cut_state(flank.motion, *(at + step)), cut_state(flank.motion, *(at - step))

    def difference(field):
        return (np.array(getattr(ahead, field)) - np.array(getattr(behind, field))) / (2.0 * h)

    # rounding 2e-16 x 0.1 m / 1e-6 = 2e-11; truncation h^2 times third derivatives of order 0.1
    np.testing.assert_allclose(difference("r"), getattr(state, f"r_{name}"), atol=1e-10)
    np.testing.assert_allclose(difference("normal"), getattr(state, f"normal_{name}"), atol=1e-10)
    assert difference("meshing") == pytest.approx(getattr(state, f"meshing_{name}"), abs=1e-10)


def test_normal_is_that_of_the_surface_through_neighbouring_points(flank):
    s, t, h = np.array([0.4, 0.6, 0.8]), np.array([0.3, 0.5, 0.8]), 1e-4
    along_s = flank.sample(s + h, t).r - flank.sample(s - h, t).r
    along_t = flank.sample(s, t + h).r - flank.sample(s, t - h).r
    across = np.cross(along_s, along_t)
    across /= np.linalg.norm(across, axis=-1, keepdims=True)
    normal = flank.sample(s, t).normal
    # central differences over 3 um of a surface of 10 mm radius: (1e-4)^2
    np.testing.assert_allclose(np.abs(np.sum(across * normal, axis=-1)), 1.0, atol=1e-7)


def test_shape_operator_is_the_turning_of_the_normal(flank):
    """Dn = -K dr along both directions of the flank, in the tangents of the sample."""
    s, t, h = np.array([0.4, 0.6, 0.8]), np.array([0.3, 0.5, 0.8]), 1e-4
    here = flank.sample(s, t)
    tangents = np.stack([here.tangent_1, here.tangent_2], axis=-2)
    for ds, dt in ((h, 0.0), (0.0, h)):
        ahead, behind = flank.sample(s + ds, t + dt), flank.sample(s - ds, t - dt)
        dr = np.einsum("nij,nj->ni", tangents, ahead.r - behind.r)
        dn = np.einsum("nij,nj->ni", tangents, ahead.normal - behind.normal)
        predicted = -np.einsum("nij,nj->ni", here.curvature, dr)
        # truncation of the difference, h^2 = 1e-8 of third-order terms a hundred times the second
        np.testing.assert_allclose(predicted, dn, atol=2e-6 * np.abs(dn).max())


def test_a_plane_through_three_neighbours_touches_the_flank(flank):
    """Second order: the flank leaves its tangent plane by half the normal curvature."""
    s, t, h = np.array([0.6]), np.array([0.5]), 5e-3
    here = flank.sample(s, t)
    near = flank.sample(s + h, t + h).r - here.r
    back = flank.sample(s - h, t - h).r - here.r
    x = np.array([near[0] @ here.tangent_1[0], near[0] @ here.tangent_2[0]])
    sag = 0.5 * float((near[0] + back[0]) @ here.normal[0])
    # r = ... + n (x K x) / 2; 4th order terms are (h x face width)^2 / R^2 = 1e-4 of it, ten times
    # as much on a pinion cut with strongly modified roll
    assert sag == pytest.approx(0.5 * x @ here.curvature[0] @ x, rel=4e-3)


def test_located_point_stands_at_the_radius_and_height_asked_for(flank):
    radius, axial = flank.region.section(np.array(0.7), np.array(0.4))
    parameters = flank.start.copy()
    assert locate(flank.motion, float(radius), float(axial), parameters) == CONVERGED
    state = cut_state(flank.motion, *parameters)
    w = np.array(state.r) - flank.axis_point
    # Newton stops at steps of 1e-11 of 2 mm and 0.1 rad
    assert w @ flank.axis == pytest.approx(axial, abs=1e-12)
    assert np.linalg.norm(np.cross(flank.axis, w)) == pytest.approx(radius, abs=1e-12)
    assert state.meshing == pytest.approx(0.0, abs=1e-12)


def test_places_far_from_the_cutter_are_not_located():
    flank = Flank.from_file(FILE, "gear", "drive")
    assert locate(flank.motion, 1.0, 0.0, flank.start.copy()) != CONVERGED


def test_compiled_kernels_equal_their_python_source(flank):
    compiled = surface_point(flank.motion, *flank.start, flank.outward)
    plain = surface_point.py_func(flank.motion, *flank.start, flank.outward)
    for a, b in zip(compiled, plain, strict=True):
        # same operations up to fused multiply-adds
        np.testing.assert_allclose(np.array(a), np.array(b), rtol=1e-9, atol=1e-11)


def test_normals_of_both_flanks_leave_the_tooth():
    """Convex and concave flank of a tooth face apart: normals oppose along the circumference."""
    for role in ("pinion", "gear"):
        swings = []
        for side in ("drive", "coast"):
            flank = Flank.from_file(FILE, role, side)
            point = flank.sample_parameters(flank.start)
            swing = np.cross(flank.axis, point.r - flank.axis_point)
            swings.append(float(point.normal @ swing) / float(np.linalg.norm(swing)))
        assert swings[0] * swings[1] < 0.0
        # cos(spiral) cos(pressure) of the printed angles, 46 and 27.6 deg, is 0.63 to 0.86
        assert min(map(abs, swings)) > 0.55
        assert max(map(abs, swings)) < 0.9


def test_region_maps_section_and_position_back_and_forth():
    region = Flank.from_file(FILE, "pinion", "drive").region
    s, t = np.array([-0.1, 0.0, 0.3, 1.0]), np.array([0.0, 1.2, 0.5, 1.0])
    back = region.position(*region.section(s, t))
    np.testing.assert_allclose(back, (s, t), atol=1e-13)
    radius, axial = region.section(np.array(0.0), np.array([0.0, 1.0]))
    # root line parallel to the pitch cone: rise over run is the tangent of the pitch angle
    assert np.diff(radius) / np.diff(axial) == pytest.approx(math.tan(math.radians(29.056)))


trimesh = pytest.importorskip("trimesh")


@pytest.fixture(scope="module")
def gear():
    return Tooth.from_file(FILE, "gear")


def test_flank_file_holds_points_normals_and_curvatures_in_millimetres(gear, tmp_path):
    path = write_flank_csv(gear.drive, tmp_path / "flank.csv", 4, 5)
    lines = path.read_text(encoding="utf-8").splitlines()
    assert lines[0].startswith("# gear drive flank, 4 rows")
    names = lines[2].split(",")
    table = np.loadtxt(path, delimiter=",", skiprows=3)
    assert table.shape == (20, len(names)) == (20, 10)
    s, t = np.meshgrid(np.linspace(0, 1, 4), np.linspace(0, 1, 5), indexing="ij")
    sample = gear.drive.sample(s, t)
    # nine digits are written
    np.testing.assert_allclose(table[:, 0], s.ravel(), rtol=1e-8)
    np.testing.assert_allclose(table[:, 2:5], 1e3 * sample.r.reshape(-1, 3), rtol=1e-8)
    np.testing.assert_allclose(table[:, 5:8], sample.normal.reshape(-1, 3), rtol=1e-8)
    k = np.linalg.eigvalsh(sample.curvature).reshape(-1, 2) * 1e-3
    np.testing.assert_allclose(table[:, 8], k[:, 0] * k[:, 1], rtol=1e-7)
    np.testing.assert_allclose(table[:, 9], 0.5 * (k[:, 0] + k[:, 1]), rtol=1e-7)


def test_a_pair_of_the_other_hand_is_exported_as_the_mirror_image(gear, tmp_path):
    tables = [
        np.loadtxt(
            write_flank_csv(gear.drive, tmp_path / "flank.csv", 4, 5, mirrored=mirrored),
            delimiter=",",
            skiprows=3,
        )
        for mirrored in (False, True)
    ]
    signs = np.ones(10)
    signs[[3, 6]] = -1.0  # y and the y of the normal
    np.testing.assert_array_equal(tables[1], signs * tables[0])
    solid = mirror_image(tooth_solid(gear, 6, 9))
    read = trimesh.load(write_solid(solid, tmp_path / "tooth.stl"), force="mesh")
    own = trimesh.load(write_solid(tooth_solid(gear, 6, 9), tmp_path / "own.stl"), force="mesh")
    # faces still look outward: a volume above zero, and the same
    assert read.volume == pytest.approx(own.volume, rel=1e-6)
    np.testing.assert_allclose(read.bounds[:, 1], -own.bounds[::-1, 1])


def test_undercut_places_are_left_out_of_the_flank_file(tmp_path):
    flank = Tooth.from_file(FILE, "pinion").drive
    table = np.loadtxt(write_flank_csv(flank, tmp_path / "p.csv", 11, 3), delimiter=",", skiprows=3)
    assert np.isfinite(table).all()
    # rows at s = 0 and 0.1 of the toe lie below the undercut at 0.15
    assert table[table[:, 1] == 0.0, 0].min() == pytest.approx(0.2)


@pytest.mark.parametrize(("suffix", "per_metre"), [("stl", 1e3), ("glb", 1.0)])
def test_written_tooth_is_closed_and_of_the_same_volume(gear, tmp_path, suffix, per_metre):
    solid = tooth_solid(gear, 6, 9)
    path = write_solid(solid, tmp_path / f"tooth.{suffix}")
    read = trimesh.load(path, force="mesh")
    assert read.is_watertight
    a, b, c = (solid.vertices[solid.faces[:, k]] for k in range(3))
    volume = np.sum(a * np.cross(b, c)) / 6.0
    # single precision in both formats: 6e-8 of 80 mm in a tooth of 5 mm
    assert read.volume / per_metre**3 == pytest.approx(volume, rel=1e-4)


def test_written_gear_is_closed(gear, tmp_path):
    path = write_solid(gear_solid(gear, 5, 6), tmp_path / "gear.stl")
    assert trimesh.load(path, force="mesh").is_watertight
    assert [one.name for one in tmp_path.iterdir()] == ["gear.stl"]


def test_unknown_formats_and_folders_are_refused(gear, tmp_path):
    solid = tooth_solid(gear, 3, 3)
    with pytest.raises(ParameterError, match="suffix must be one of stl, glb; got 'step'"):
        write_solid(solid, tmp_path / "gear.step")
    with pytest.raises(ParameterError, match=r"folder .* does not exist"):
        write_solid(solid, tmp_path / "nowhere" / "gear.stl")


def test_failed_writing_keeps_the_old_file_and_leaves_no_part(gear, tmp_path, monkeypatch):
    path = tmp_path / "gear.stl"
    path.write_text("old")

    def fail(self, *_, **__):
        raise OSError("disk full")

    monkeypatch.setattr(trimesh.Trimesh, "export", fail)
    with pytest.raises(OSError, match="disk full"):
        write_solid(tooth_solid(gear, 3, 3), path)
    assert path.read_text() == "old"
    assert len(list(tmp_path.iterdir())) == 1


def test_missing_trimesh_is_named(gear, tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "trimesh", None)
    with pytest.raises(ParameterError, match=r"pip install 'gearlube\[export\]'"):
        write_solid(tooth_solid(gear, 3, 3), tmp_path / "gear.stl")
