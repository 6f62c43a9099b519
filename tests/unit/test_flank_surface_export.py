"""Files of flanks and gears, read back."""

import sys

import numpy as np
import pytest

from gearlube_core.errors import ParameterError
from gearlube_core.hypoid_geometry.flank.tooth import Tooth
from gearlube_core.hypoid_geometry.flank.tooth_solid import (
    gear_solid,
    mirror_image,
    tooth_solid,
    write_flank_csv,
    write_solid,
)
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile

trimesh = pytest.importorskip("trimesh")

FILE = HypoidGearFile.named("mohammadpour_2015")


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
