"""Surfaces from files of instruments, surfaces refused, and the model of running-in."""

from __future__ import annotations

import datetime
import math
import struct
import sys

import numpy as np
import pytest
import xarray as xr

from gearlube_core.errors import ParameterError
from gearlube_core.surface.files import read_surface, write_surface
from gearlube_core.surface.gaussian_filter import filtered, levelled, peaks_cut
from gearlube_core.surface.heights import (
    HeightMap,
    Profile,
    check_closed,
    check_plausible,
    evenly_spaced,
)
from gearlube_core.surface.measured_heights import MeasuredProfile, filled
from gearlube_core.surface.statistics import profile_statistics
from tests.helpers.each import each

HEIGHT = 1e-7 * np.random.default_rng(1).standard_normal((9, 6))  # (x, y)
STEPS = (1e-6, 2e-6)


@pytest.mark.parametrize("ending", ["csv", "npz"])
def test_written_surfaces_are_read_again(ending, tmp_path):
    path = tmp_path / f"surface.{ending}"
    if ending == "csv":
        surface = Profile(height=HEIGHT[:, 0], spacing=STEPS[0])
    else:
        surface = HeightMap(height=HEIGHT, spacing=STEPS)
    write_surface(surface, path)
    found = read_surface(path)
    # nine digits are written
    assert found.height == pytest.approx(surface.height, rel=1e-8)
    assert found.spacing == pytest.approx(surface.spacing, rel=1e-8)


def test_sdf_files_of_instruments_are_read_as_text_and_binary(tmp_path):
    sdfio = pytest.importorskip("sdfio")
    for kind in sdfio.FileFormat:
        path = tmp_path / f"{kind.name}.sdf"
        sdfio.write(path, HEIGHT.T, x_scale=STEPS[0], y_scale=STEPS[1], z_scale=1e-12, format=kind)
        found = read_surface(path)
        assert found.spacing == pytest.approx(STEPS)
        # whole picometres
        assert found.height == pytest.approx(HEIGHT, abs=5.1e-13)


def test_a_text_of_iso_25178_71_written_by_hand_is_read(tmp_path):
    """Independent of the package that reads it: the records as the standard prints them."""
    header = {
        "ManufacID": "HAND",
        "CreateDate": "010120260000",
        "ModDate": "010120260000",
        "NumPoints": 4,
        "NumProfiles": 1,
        "Xscale": 2e-6,
        "Yscale": 1e-6,
        "Zscale": 1e-9,
        "Zresolution": 1e-10,
        "Compression": 0,
        "DataType": 5,
        "CheckType": 0,
    }
    lines = ["aISO-1.0", *(f"{name} = {value}" for name, value in header.items()), "*"]
    path = tmp_path / "hand.sdf"
    path.write_bytes("\r\n".join([*lines, "100 -50 25 0", "*", "", "*", ""]).encode())
    pytest.importorskip("sdfio")
    found = read_surface(path)
    assert isinstance(found, Profile)
    assert found.spacing == pytest.approx(2e-6)
    assert found.height == pytest.approx([1e-7, -5e-8, 2.5e-8, 0.0], abs=1e-15)


def x3p_metadata(x3pio):
    return x3pio.Metadata(
        creator="gearlube",
        instrument=x3pio.Instrument("maker", "model", "1", "1"),
        probing_system=x3pio.ProbingSystem(x3pio.ProbingType.NON_CONTACTING, "confocal"),
        date=datetime.datetime(2026, 1, 1, tzinfo=datetime.UTC),
    )


def test_x3p_files_of_instruments_are_read(tmp_path):
    x3pio = pytest.importorskip("x3pio")
    path, line = tmp_path / "map.x3p", tmp_path / "line.x3p"
    metadata = x3p_metadata(x3pio)
    x3pio.write(path, HEIGHT.T, x_scale=STEPS[0], y_scale=STEPS[1], metadata=metadata)
    found = read_surface(path)
    assert isinstance(found, HeightMap)
    assert found.spacing == pytest.approx(STEPS)
    assert found.height == pytest.approx(HEIGHT, abs=1e-18)
    x3pio.Profile.from_array(HEIGHT[:, 0], x_scale=STEPS[0], metadata=metadata).save(line)
    profile = read_surface(line)
    assert isinstance(profile, Profile)
    assert profile.spacing == pytest.approx(STEPS[0])
    assert profile.height == pytest.approx(HEIGHT[:, 0], abs=1e-18)


def sur_file(heights, missing):
    """Return a Digital Surf file by its published layout: 512 bytes of header, whole nanometres."""
    nanometres = np.round(1e9 * heights.T).astype("<i4")
    low, high = int(nanometres.min()), int(nanometres.max())
    nanometres[missing.T] = low - 2
    texts = [text.encode().ljust(16) for text in ("X", "Y", "Z", *["um", "um", "nm"] * 2)]
    head = struct.pack(
        "<12s4H30s30s5H8xHiiiiIfff",
        b"DIGITAL SURF",
        0,
        1,
        1,
        2,
        b"",
        b"",
        0,
        0,
        0,
        1,
        1,
        32,
        low,
        high,
        *heights.shape,
        heights.size,
        1.0,
        2.0,
        1.0,
    )
    head += b"".join(texts) + struct.pack("<fff", 1.0, 1.0, 1.0)
    head = head.ljust(364, b"\0")  # then day 1, month 1, year 2026
    head = head[:342] + struct.pack("<6H", 0, 0, 0, 1, 1, 2026) + head[354:]
    return head.ljust(512, b"\0") + nanometres.tobytes()


def al3d_file(heights, missing):
    """Return an Alicona file: tags of 52 bytes, a comment, rows of floats filled up to 8 bytes."""
    nx, ny = heights.shape
    tags = {
        "Cols": nx,
        "Rows": ny,
        "DepthImageOffset": 1024,
        "PixelSizeXMeter": STEPS[0],
        "PixelSizeYMeter": STEPS[1],
        "InvalidPixelValue": -1.0,
    }
    named = {"Version": 1, "TagCount": len(tags), **tags}
    head = b"AliconaImaging\0\r\n" + b"".join(
        f"{name:\0<20}{value:\0<30}\r\n".encode()
        for name, value in ((name, str(value)) for name, value in named.items())
    )
    rows = np.zeros((ny, nx + nx % 2), dtype="<f4")
    rows[:, :nx] = np.where(missing, -1.0, heights).T
    return (head + b"\0" * 254 + b"\r\n").ljust(1024, b"\0") + rows.tobytes()


@pytest.mark.slow
@pytest.mark.parametrize(("ending", "write"), [("sur", sur_file), ("al3d", al3d_file)])
def test_files_of_digital_surf_and_alicona_are_read_with_gaps(ending, write, tmp_path, caplog):
    pytest.importorskip("SurfaceTopography")
    missing = np.zeros(HEIGHT.shape, dtype=bool)
    missing[4, 3] = True
    path = tmp_path / f"map.{ending}"
    path.write_bytes(write(HEIGHT, missing))
    found = read_surface(path)
    assert found.spacing == pytest.approx(STEPS)
    # whole nanometres; single precision is finer
    assert found.height[~missing] == pytest.approx(HEIGHT[~missing], abs=0.51e-9)
    around = (HEIGHT[3, 3] + HEIGHT[5, 3] + HEIGHT[4, 2] + HEIGHT[4, 4]) / 4.0
    assert found.height[4, 3] == pytest.approx(around, abs=0.51e-9)
    assert "1 of 54 points (1.9 %) were not measured and are filled" in caplog.text


@pytest.mark.parametrize("ending", ["sdf", "x3p", "npz", "nc"])
def test_points_that_were_not_measured_are_filled_and_said(ending, tmp_path, caplog):
    """A plane solves Laplace's equation, so that every hole inside it is filled exactly."""
    x, y = 1e-6 * np.arange(9.0), 2e-6 * np.arange(6.0)
    plane = 1e-3 * x[:, None] + 3e-3 * y
    holes = plane.copy()
    holes[2:5, 2:4] = math.nan
    holes[7, 1] = math.nan
    path = tmp_path / f"holes.{ending}"
    if ending == "sdf":
        sdfio = pytest.importorskip("sdfio")
        sdfio.write(path, holes.T, x_scale=1e-6, y_scale=2e-6, z_scale=1e-12)
    elif ending == "x3p":
        x3pio = pytest.importorskip("x3pio")
        x3pio.write(path, holes.T, x_scale=1e-6, y_scale=2e-6, metadata=x3p_metadata(x3pio))
    elif ending == "npz":
        np.savez(path, x=1e3 * x, y=1e3 * y, height=1e6 * holes)
    else:
        fields = {"height": (("x", "y"), 1e6 * holes)}
        xr.Dataset(fields, {"x": 1e3 * x, "y": 1e3 * y}).to_netcdf(path, engine="scipy")
    # whole picometres in SDF
    assert read_surface(path).height == pytest.approx(plane, abs=6e-13)
    assert "7 of 54 points (13 %) were not measured" in caplog.text


def test_gaps_of_a_profile_are_bridged_by_lines_and_too_many_are_refused():
    nan = math.nan
    given = np.array([nan, 1.0, nan, nan, 4.0, *[5.0] * 15])
    # a gap at the end has one neighbour; the long one lies on the line from 1 to 4
    assert filled(given, "p")[:5] == pytest.approx([1.0, 1.0, 2.0, 3.0, 4.0], rel=1e-12)
    given[5:7] = nan
    with pytest.raises(ParameterError, match=r"at most 20% .* missing, got 5 of 20"):
        filled(given, "p")


@each(
    ("name", "content", "words"),
    [
        ("heights.xyz", "", "ends in one of .csv, .txt, .tsv, .npz, .nc, .sdf, .x3p, .sur, .al3d"),
        ("broken.sdf", "no header", "not a readable SDF file"),
        ("broken.x3p", "no archive", "not a readable X3P file"),
        ("broken.sur", "DIGITAL SURF", "not a readable SUR file"),
        ("broken.al3d", "AliconaImaging", "not a readable AL3D file"),
        ("no_size.al3d", al3d_file(HEIGHT, HEIGHT > 1.0).replace(b"Cols", b"Cola"), "'Cols'"),
        ("one.csv", "x_mm,height_um\n0,0\n", "at least 4 places"),
        ("hole.csv", "x_mm,height_um\n0,0\n1,nan\n2,0\n3,1\n4,0\n", "must be a finite number"),
        ("far.csv", "x_mm,height_um\n0,0\n2,1\n4,0\n6,1\n8,0\n", "1 um is 1e-6 m"),
        ("gap.csv", "x_mm,height_um\n0,0\n0.001,1\n0.5,0\n1,1\n", "more than 10 times as many"),
    ],
)
def test_wrong_files_are_refused(name, content, words, tmp_path):
    if name.endswith((".sdf", ".x3p")):
        pytest.importorskip(f"{name[-3:]}io")
    (tmp_path / name).write_bytes(content if isinstance(content, bytes) else content.encode())
    with pytest.raises(ParameterError) as refused:
        read_surface(tmp_path / name)
    assert words in str(refused.value)


def test_a_missing_package_is_named_with_its_extra(monkeypatch, tmp_path):
    monkeypatch.setitem(sys.modules, "sdfio", None)
    with pytest.raises(ParameterError, match=r"pip install 'gearlube\[surfaces\]'"):
        read_surface(tmp_path / "a.sdf")


def test_uneven_places_are_filled_by_the_spline():
    x = np.array([0.0, 1.0, 2.0, 3.5, 5.0, 6.0]) * 1e-6
    found = evenly_spaced(MeasuredProfile(x, 1e-7 * (1.0 + 2e5 * x) ** 3))
    assert isinstance(found, Profile)
    assert found.spacing == pytest.approx(1e-6)
    # a cubic spline is exact for cubics
    assert found.height == pytest.approx(1e-7 * (1.0 + 2e5 * found.x) ** 3, rel=1e-12)


def waves(amplitude, **more):
    x = np.arange(200) * 1e-6
    return Profile(height=amplitude * np.sin(2.0 * np.pi * x / 4e-5), spacing=1e-6, **more)


@each(
    ("check", "words"),
    [
        (lambda: check_plausible(waves(3e-10)), "at least 1 nm, got 0.212 nm"),
        (lambda: check_plausible(waves(3e-6)), "rms slope along x must be at most 0.2, got 0.33"),
        (lambda: check_closed(waves(3e-7)), "must be periodic"),
        (lambda: profile_statistics(Profile(height=np.ones(9), spacing=1e-6)), "a flat surface"),
        (lambda: Profile(height=np.zeros((3, 3)), spacing=1e-6), "must have 1 dimension"),
        (lambda: Profile(height=np.zeros(1), spacing=1e-6), "at least 4 points"),
        (lambda: Profile(height=np.full(5, math.inf), spacing=1e-6), "5 of 5 are not"),
        (lambda: HeightMap(height=HEIGHT, spacing=(1e-6, 2.0)), "spacing along y must be within"),
        (lambda: levelled(waves(1e-7), 9), "within 0 to 8, got 9"),
        (lambda: filtered(waves(1e-7), cutoff_long=1.5e-4), "at most half the length"),
        (lambda: filtered(waves(1e-7), cutoff_short=1e300), "cutoff_short must be at most half"),
        (lambda: filtered(waves(1e-7), cutoff_short=1e-6), "at least two spacings"),
        (lambda: filtered(waves(1e-7), cutoff_long=1e-5, cutoff_short=2e-5), "must exceed"),
        (lambda: filtered(waves(1e-7), cutoff_long=0.08e-4, ends="mirror"), "regression, cut"),
        (lambda: peaks_cut(waves(1e-7), -1e-8), "at most 50 % of the points"),
        (lambda: write_surface(waves(1e-7), "surface.npz"), "a file .csv"),
    ],
)
def test_wrong_surfaces_are_refused(check, words):
    with pytest.raises(ParameterError) as refused:
        check()
    assert words in str(refused.value)


def test_running_in_cuts_peaks_at_a_height_and_keeps_valleys():
    profile = waves(1e-6)
    cut = peaks_cut(profile, 0.5e-6)
    # a sine is above half its amplitude for a third of its length; 40 points a wave
    assert cut.share == pytest.approx(1.0 / 3.0, abs=0.026)
    # mean of what stood above: (sqrt(3)/2 - pi/6)/pi of the amplitude; order two in 40 points
    assert cut.removed == pytest.approx(1e-6 * (math.sqrt(3) / 2 - math.pi / 6) / math.pi, rel=0.02)
    assert cut.surface.height.mean() == pytest.approx(0.0, abs=1e-20)
    assert np.ptp(cut.surface.height) == pytest.approx(1.5e-6, rel=1e-9)
    assert profile_statistics(cut.surface).Rsk < -0.2
    assert peaks_cut(profile, 2e-6).share == 0.0
