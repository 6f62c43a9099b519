"""Bookkeeping of a sweep: nothing computed twice, nothing lost, failures are rows."""

import shutil
import signal
import threading
from contextlib import nullcontext
from typing import ClassVar

import numpy as np
import pytest
import xarray as xr

from gearlube.studies.sweep.datasets import load_sweep, merge
from gearlube.studies.sweep.peaks import peak_orders
from gearlube.studies.sweep.run import SweepModel, run_sweep
from gearlube.studies.sweep.settings import SweepSettings
from gearlube_core.errors import GearLubeError, InterruptedRunError, ParameterError
from gearlube_core.storage.process_pool import ProcessPool
from gearlube_core.storage.resumable import deferred_interrupts
from tests.helpers import sweep_stand_in as stand_in

SETTINGS = SweepSettings()
SPEEDS = (20.0, 40.0, 60.0)
MANY = (20.0, 40.0, 60.0, 61.0, 62.0, 63.0, 64.0, 65.0, 66.0)


@pytest.fixture
def fmu(tmp_path):
    return stand_in.write_fmu(tmp_path / "axle.fmu")


def sweep(fmu, out, point, **options):
    seen = []
    arguments = {"speeds_kmh": SPEEDS, "preloads": (2500.0, 6000.0), "jobs": 1} | options
    dataset = run_sweep(
        SETTINGS,
        fmu=fmu,
        out=out,
        progress=lambda share, sentence: seen.append((share, sentence)),
        model=SweepModel(point=point, compile_first=None, natural_frequencies=None),
        **arguments,
    )
    return dataset, seen


@pytest.fixture
def in_this_process(monkeypatch):
    """Points of tests that are not about processes are computed without one: it takes a second."""
    monkeypatch.setattr("gearlube.studies.sweep.run.ProcessPool", _NoProcess)


class _NoProcess(ProcessPool):
    opened: ClassVar[list[int]] = []

    def open(self, tasks):
        self.opened.append(tasks)
        return nullcontext()


def computed(seen):
    """Return the points that were not taken from the folder; the first sentence is of none."""
    return [sentence for _, sentence in seen[1:] if not sentence.endswith("(stored)")]


@pytest.fixture(scope="module")
def finished(tmp_path_factory):
    """A finished sweep: its folder, FMU, dataset and messages; tests change copies of it."""
    folder = tmp_path_factory.mktemp("finished")
    fmu = stand_in.write_fmu(folder / "axle.fmu")
    out = folder / "out"
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("gearlube.studies.sweep.run.ProcessPool", _NoProcess)
        return out, fmu, *sweep(fmu, out, stand_in.small_point)


@pytest.fixture
def copied(finished, tmp_path):
    """Folder, FMU and dataset of a finished sweep, to go on from."""
    out, fmu, dataset, _ = finished
    return shutil.copytree(out, tmp_path / "out"), fmu, dataset


def resonance(fmu, speed_kmh, preload, settings):
    """One mesh order of the transmission error that rings at 51.6 km/h with 3 % of damping."""
    ratio = speed_kmh / 51.6
    amplitude = 1e-6 * abs(ratio**2 / (1.0 - ratio**2 + 0.06j * ratio))
    still = stand_in.small_point(fmu, speed_kmh, preload, settings)
    lines = {
        "mesh_frequency": 5.0 * speed_kmh,
        "frequency": ("bin", [0.0, 5.0 * speed_kmh]),
        "dte_spectrum": ("bin", [0.0, amplitude]),
    }
    return still.drop_vars(lines, errors="ignore").assign(lines)


@pytest.mark.slow
def test_speeds_are_added_around_the_largest_order_until_its_neighbours_are_near(
    fmu, tmp_path, in_this_process
):
    coarse, fine = range(20, 101, 5), range(20, 101)
    _NoProcess.opened.clear()
    options = {"preloads": (2500.0,)}
    dataset, seen = sweep(
        fmu, tmp_path / "out", resonance, speeds_kmh=coarse, peak_step_kmh=1.0, **options
    )
    assert _NoProcess.opened == [len(coarse)]  # workers stay for the points around the peaks
    whole, _ = sweep(fmu, None, resonance, speeds_kmh=fine, **options)
    top, expected = (peak_orders(one)[0] for one in (dataset, whole))
    assert top == expected
    assert top.speed_kmh == 52.0
    # of the four speeds on each side of a speed of the grid fewer are run than all
    assert len(computed(seen)) <= 17 + 5
    assert set(dataset["speed_kmh"].values) > set(map(float, coarse))
    again, seen = sweep(
        fmu, tmp_path / "out", resonance, speeds_kmh=coarse, peak_step_kmh=1.0, **options
    )
    assert computed(seen) == []
    xr.testing.assert_equal(again["dte_spectrum"], dataset["dte_spectrum"])


def test_points_are_laid_out_over_preload_and_speed_with_ragged_spectra_padded(finished):
    _, _, dataset, seen = finished
    assert dataset["dte_pp"].dims == ("preload", "speed")
    assert dataset["dte_pp"].sel(preload=6000.0).values == pytest.approx([26e-9, 46e-9, 66e-9])
    spectrum = dataset["dte_spectrum"]
    assert spectrum.shape == (2, 3, 60)
    np.testing.assert_array_equal(np.isfinite(spectrum).sum("bin"), [[20, 40, 60]] * 2)
    assert [share for share, _ in seen] == [k / 6 for k in range(7)]


def test_file_tells_settings_version_and_fmu_and_can_be_read_by_speed_in_kmh(finished):
    out, *_ = finished
    dataset = load_sweep(out)
    assert dataset.attrs["fmu_guid"] == "{test}"
    assert dataset.attrs["command_line"] == ""  # not of a command
    assert dataset.attrs["setting_equations"] == "consistent"
    assert float(dataset["dte_pp"].sel(speed_kmh=40.0, preload=2500.0)) == pytest.approx(42.5e-9)
    assert (out / "summary.csv").read_text().startswith("preload [N],speed_kmh [km/h],")


def test_second_run_computes_nothing_and_gives_the_same_dataset(copied):
    out, fmu, first = copied
    second, seen = sweep(fmu, out, stand_in.refusing_point)
    assert len(seen) == 1 + 6
    assert not computed(seen)
    assert second.attrs["computed_points"] == 0
    xr.testing.assert_identical(first.drop_attrs(), second.drop_attrs())


def test_only_new_speeds_are_computed_when_the_grid_grows(copied, in_this_process):
    out, fmu, _ = copied
    _, seen = sweep(fmu, out, stand_in.small_point, speeds_kmh=(*SPEEDS, 80.0))
    assert sorted(computed(seen)) == ["80 km/h, 2500 N", "80 km/h, 6000 N"]


def test_a_damaged_point_file_is_computed_again(copied, in_this_process):
    out, fmu, first = copied
    victim = min((out / "points").iterdir())
    victim.write_bytes(victim.read_bytes()[:1000])
    second, seen = sweep(fmu, out, stand_in.small_point)
    assert len(computed(seen)) == 1
    xr.testing.assert_identical(first.drop_attrs(), second.drop_attrs())


def test_failed_points_are_rows_with_a_message_and_are_tried_again(fmu, tmp_path, request):
    dataset, _ = sweep(fmu, tmp_path / "out", stand_in.refusing_point)
    np.testing.assert_array_equal(dataset["status"], [[1, 0, 0]] * 2)
    assert dataset["message"].values[0, 1] == "the FMU refused the step"
    assert dataset["message"].values[1, 2] == "GearLubeError: unforeseen"
    assert np.isnan(dataset["dte_pp"].values[0, 1])
    request.getfixturevalue("in_this_process")
    again, seen = sweep(fmu, tmp_path / "out", stand_in.small_point)
    assert len(computed(seen)) == 4
    assert int(again["status"].sum()) == 6


@pytest.mark.slow
def test_a_point_whose_process_died_is_computed_by_another_process(fmu, tmp_path):
    directory = tmp_path / "unzipped"
    directory.mkdir()
    (directory / "modelDescription.xml").write_text('<fmiModelDescription guid="{test}"/>')
    dataset, _ = sweep(directory, tmp_path / "out", stand_in.dying_point)
    assert int(dataset["status"].sum()) == 6


def test_ctrl_c_keeps_finished_points_and_says_how_to_go_on(fmu, tmp_path, request):
    with pytest.raises(InterruptedRunError, match="Run the same command again"):
        sweep(
            fmu, tmp_path / "out", stand_in.interrupting_point, speeds_kmh=MANY, preloads=[2500.0]
        )
    kept = len(list((tmp_path / "out" / "points").iterdir()))
    # Two were finished; the third was under way and the queue of the process holds one or two
    # more: they are waited for. The others are cancelled.
    assert 3 <= kept < len(MANY)
    request.getfixturevalue("in_this_process")
    _, seen = sweep(fmu, tmp_path / "out", stand_in.small_point, speeds_kmh=MANY, preloads=[2500.0])
    assert len(seen[1:]) - len(computed(seen)) == kept


def test_ctrl_c_becomes_a_flag_first_and_an_exception_when_it_is_repeated():
    before = signal.getsignal(signal.SIGINT)  # ignored where a shell runs the tests beside itself
    with deferred_interrupts() as interrupt:
        assert not interrupt.requested
        signal.raise_signal(signal.SIGINT)
        assert interrupt.requested
        with pytest.raises(KeyboardInterrupt):
            signal.raise_signal(signal.SIGINT)
    assert signal.getsignal(signal.SIGINT) is before


def test_interrupts_are_left_alone_outside_the_main_thread():
    found = []

    def enter():
        with deferred_interrupts() as interrupt:
            found.append(interrupt.requested)

    thread = threading.Thread(target=enter)
    thread.start()
    thread.join()
    assert found == [False]


def test_missing_points_stay_nan_in_the_merged_dataset(fmu, tmp_path):
    lone = stand_in.small_point(tmp_path_with_description(tmp_path), 20.0, 2500.0, SETTINGS)
    dataset = merge([2500.0], [20.0, 40.0], {(20.0, 2500.0): lone})
    assert np.isnan(dataset["dte_pp"].values[0, 1])
    assert dataset["status"].values.tolist() == [[1, 0]]


def tmp_path_with_description(tmp_path):
    (tmp_path / "modelDescription.xml").write_text("<x/>")
    return tmp_path


def test_an_empty_grid_is_refused(fmu, tmp_path):
    with pytest.raises(ParameterError, match="at least one speed"):
        sweep(fmu, tmp_path / "out", stand_in.small_point, speeds_kmh=())


def test_a_file_that_is_no_fmu_is_refused_with_the_cure(tmp_path):
    with pytest.raises(ParameterError, match="build-fmu"):
        sweep(tmp_path / "missing.fmu", tmp_path / "out", stand_in.small_point)


def test_a_scheduler_that_does_not_answer_is_named(fmu, tmp_path, monkeypatch):
    monkeypatch.setattr("gearlube_core.storage.dask_pool._CONNECT_TIMEOUT", 0.5)
    with pytest.raises(GearLubeError, match=r"No Dask scheduler answered at tcp://127\.0\.0\.1:9"):
        sweep(fmu, tmp_path / "out", stand_in.small_point, scheduler="tcp://127.0.0.1:9")
