"""`gearlube ehl rough`: runs, resumes to the bit, keeps films, tells what is wrong."""

from __future__ import annotations

import errno
import shutil
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from PIL import Image

from gearlube.cli.exit_codes import BAD_ARGUMENT, FAILED, INTERRUPTED
from gearlube.studies.films.rough import files, run
from gearlube.studies.films.rough.files import frame_files, read_frames
from gearlube.studies.films.rough.run import run_rough, statistics_again
from gearlube_core.ehl.case.rough_case import RoughCase
from gearlube_core.ehl.transient.history import MarchRecord
from gearlube_core.ehl.transient.march import FilmMarch
from gearlube_core.errors import ConvergenceError, ParameterError
from tests.helpers.ehl_command import run as command

WAVES = """
name = "waves"
source = "made up"
radius_mm = 14.0
load_n_per_mm = 200.0
length_mm = 0.4
speed_1_m_s = 7.9
speed_2_m_s = 5.5
reduced_modulus_gpa = 227.5
[oil]
viscosity_pa_s = 0.00625
pressure_viscosity_per_gpa = 13.3
eyring_stress_mpa = 10.0
[surface_1]
amplitude_um = 0.15
period_um = 100.0
turns = 1
[surface_2]
amplitude_um = 0.1
period_um = 80.0
turns = -1
[times]
steps_per_half_width = 40
until_rough = 0.2
rough = 0.2
feed = "in_place"
[solver]
nodes_x = 81
rows = 16
[frames]
every = 5
record_every = 4
"""


@pytest.fixture
def case(tmp_path) -> Path:
    path = tmp_path / "waves.toml"
    path.write_text(WAVES)
    return path


@pytest.fixture
def undrawn(monkeypatch):
    """No figures: those of the march without a stop are looked at."""
    monkeypatch.setattr(files, "write_figure", lambda *_: None)


@pytest.fixture(scope="module")
def whole(tmp_path_factory) -> Path:
    """A march without a stop; 20 steps of 81 x 16 nodes."""
    folder = tmp_path_factory.mktemp("whole")
    (folder / "waves.toml").write_text(WAVES)
    run_rough(RoughCase.from_toml(folder / "waves.toml"), folder=folder / "out")
    return folder / "out"


def test_a_march_writes_statistics_films_and_figures(whole):
    with xr.open_dataset(whole / "rough.nc", engine="scipy") as found:
        # 0.2 a in 8 steps of the faster surface, of the slower one 1.436 times as many
        assert found.sizes["time"] == 1 + 12 + 8
        assert found["converged"].values.all()
        assert found.attrs["gathered_films"] == 9
        load = found["film_load"].values
        rough = found["pressure_max"].values
    # 200 N/mm over 0.4 mm, to the tolerance of the load
    assert load == pytest.approx(np.full(21, 80.0), rel=1.1e-4)
    # waves of 0.25 um under a film of 0.26 um
    assert rough[-1] > 1.1 * rough[0]
    steps = [int(path.stem[-6:]) for path in frame_files(whole)]
    assert steps == [0, 5, 10, 15, 20]
    names = {path.name for path in (whole / "figures").iterdir()}
    assert {"history.png", "distributions.png", "thin_films.png", "step_000020.png"} <= names
    assert "largest pressure, rough" in (whole / "summary.csv").read_text()


def test_statistics_again_come_from_kept_films_alone(whole, case, monkeypatch):
    monkeypatch.setattr(run, "FilmMarch", None)  # nothing is marched
    found = statistics_again(RoughCase.from_toml(case), whole)
    with xr.open_dataset(whole / "rough.nc", engine="scipy") as first:
        every = first.isel(time=[0, 5, 10, 15, 20])
        # films are kept in single precision, 24 bits
        for name in ("film_min", "pressure_max", "film_mean", "friction_coefficient"):
            assert found[name].values == pytest.approx(every[name].values, rel=1e-6)
    assert (whole / "frames.nc").exists()


@pytest.mark.slow
@pytest.mark.usefixtures("undrawn")
def test_the_animation_shows_every_kept_film_of_a_finished_run(whole, case, tmp_path, monkeypatch):
    out = tmp_path / "out"
    shutil.copytree(whole, out)
    monkeypatch.setattr(run, "FilmMarch", None)  # nothing is marched
    given = ("rough", str(case), "--out", str(out), "--overwrite", "--statistics")
    assert command(*given, "--animation").exit_code == 0
    with Image.open(out / "animation.gif") as animation:
        assert animation.n_frames == 5


def test_an_animation_without_kept_films_is_refused_before_the_march(case, tmp_path, caplog):
    # films are kept at step 0 and at 5, 10, 15, 20
    given = ("rough", str(case), "--out", str(tmp_path / "out"), "--animation", "--steps", "4")
    assert command(*given).exit_code == BAD_ARGUMENT
    assert "at least 2 films for an animation, got 1 up to step 4" in caplog.text
    assert not (tmp_path / "out").exists()


def test_of_many_kept_films_an_even_choice_is_animated(whole, case):
    key = RoughCase.from_toml(case).key()
    assert [one.attrs["step"] for one in read_frames(whole, key, 3)] == [0, 10, 20]


@pytest.mark.slow
@pytest.mark.usefixtures("undrawn")
def test_a_stopped_march_goes_on_to_the_bit(case, tmp_path, whole):
    out = tmp_path / "out"
    given = ("rough", str(case), "--out", str(out))
    assert command(*given, "--steps", "8").exit_code == 0
    assert command(*given).exit_code == 0
    with (
        xr.open_dataset(out / "rough.nc", engine="scipy") as found,
        xr.open_dataset(whole / "rough.nc", engine="scipy") as first,
    ):
        for name in set(first.data_vars) - {"seconds"}:
            assert np.array_equal(found[name].values, first[name].values, equal_nan=True), name
    for one, other in zip(frame_files(out), frame_files(whole), strict=True):
        assert one.read_bytes() == other.read_bytes()


def test_control_c_keeps_the_last_record(case, tmp_path, monkeypatch, caplog):
    out, taken = tmp_path / "out", FilmMarch.step

    def stopped(self, **given):
        if self.steps == 6:
            raise KeyboardInterrupt
        return taken(self, **given)

    monkeypatch.setattr(FilmMarch, "step", stopped)
    assert command("rough", str(case), "--out", str(out)).exit_code == INTERRUPTED
    (record,) = out.glob("march_*.npz")
    assert MarchRecord.read(record).steps == 4
    assert "it continues from step 4 in" in caplog.text


def test_a_full_disk_is_told_and_the_last_record_stays(case, tmp_path, monkeypatch, caplog):
    out, saved = tmp_path / "out", FilmMarch.save

    def full(self, path, *given):
        if self.steps == 8:
            raise OSError(errno.ENOSPC, "No space left on device", str(path))
        saved(self, path, *given)

    monkeypatch.setattr(FilmMarch, "save", full)
    ended = command("rough", str(case), "--out", str(out))
    assert ended.exit_code == FAILED
    assert "Step 8 could not be written" in caplog.text
    assert "the disk is full" in caplog.text
    (record,) = out.glob("march_*.npz")
    assert MarchRecord.read(record).steps == 4


def test_too_small_a_disk_is_told_before_the_march(case, tmp_path, monkeypatch, caplog):
    usage = shutil.disk_usage(tmp_path)._replace(free=1_000_000)
    monkeypatch.setattr(run.shutil, "disk_usage", lambda _: usage)
    ended = command("rough", str(case), "--out", str(tmp_path / "out"))
    assert ended.exit_code == BAD_ARGUMENT
    assert "MB free space, got 1 MB. Keep fewer films" in caplog.text


def test_the_disk_need_bounds_what_is_written(whole, case):
    need = run.disk_need(RoughCase.from_toml(case), whole)
    written = sum(path.stat().st_size for path in whole.rglob("*") if path.is_file())
    # the estimate is no less, and kept films are counted to the byte but for their headers
    assert need.total > written
    assert need.frames - 5 * 300_000 == pytest.approx(5 * 81 * 18 * 8)


def test_records_of_another_case_and_damaged_ones_are_refused(case, tmp_path, whole, caplog):
    out = tmp_path / "out"
    shutil.copytree(whole, out)
    given = ("rough", str(case), "--out", str(out), "--overwrite")
    ended = command(*given, "--rows", "18")
    assert ended.exit_code == BAD_ARGUMENT
    assert "from another case" in caplog.text
    (record,) = out.glob("march_*.npz")
    record.write_bytes(record.read_bytes()[:1000])
    ended = command(*given)
    assert ended.exit_code == BAD_ARGUMENT
    assert "must be the record of a march" in caplog.text


def test_kept_films_of_another_case_and_none_are_refused(case, tmp_path, whole):
    other = RoughCase.from_toml(case).varied({"load_n_per_mm": 210.0})
    with pytest.raises(ParameterError, match="must be a film of this case"):
        statistics_again(other, whole)
    with pytest.raises(ParameterError, match="must hold kept films, got none"):
        statistics_again(other, tmp_path)


def test_a_march_that_has_lost_its_film_stops(case, monkeypatch):
    taken = FilmMarch.step

    def lost(self, **given):
        return replace(taken(self, **given), converged=False)

    monkeypatch.setattr(FilmMarch, "step", lost)
    with pytest.raises(ConvergenceError, match="Steps 1 to 10 did not converge"):
        run_rough(RoughCase.from_toml(case))


def test_the_example_is_a_case(tmp_path):
    shown = command("rough", "--example")
    path = tmp_path / "case.toml"
    path.write_text(shown.output)
    assert RoughCase.from_toml(path) == RoughCase.named("jamali_2015_a")
