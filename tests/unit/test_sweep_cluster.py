"""The same sweep on a real Dask cluster of two worker processes, one of which is killed."""

import signal
import threading

import pytest
import xarray as xr

from gearlube.studies.sweep.run import SweepModel, run_sweep
from gearlube.studies.sweep.settings import SweepSettings
from tests.helpers import sweep_stand_in as stand_in
from tests.helpers.dask_cluster import dask_cluster


@pytest.fixture
def cluster(tmp_path):
    """Scheduler address and the worker processes by name."""
    with dask_cluster(tmp_path) as found:
        yield found


def model_of(point):
    return SweepModel(point=point, compile_first=None, natural_frequencies=None)


@pytest.mark.slow  # local processes that die are in the default run
def test_nothing_is_lost_when_a_worker_dies_and_the_result_equals_the_local_run(cluster, tmp_path):
    address, workers = cluster
    fmu = stand_in.write_fmu(tmp_path / "axle.fmu")
    grid = {
        "speeds_kmh": [20.0, 30.0, 40.0, 50.0, 60.0, 70.0],
        "preloads": [2500.0, 6000.0],
    }
    killed = threading.Event()

    def kill_one_worker_after_two_points(share, sentence):
        if share >= 2 / 12 and not killed.is_set():
            workers["first"].send_signal(signal.SIGKILL)
            killed.set()

    settings = SweepSettings()
    remote = run_sweep(
        settings,
        fmu=fmu,
        out=tmp_path / "remote",
        scheduler=address,
        progress=kill_one_worker_after_two_points,
        model=model_of(stand_in.slow_point),
        **grid,
    )
    assert killed.is_set()
    assert workers["first"].wait(timeout=10.0) == -signal.SIGKILL
    assert int(remote["status"].sum()) == 12

    local = run_sweep(
        settings,
        fmu=fmu,
        out=tmp_path / "local",
        jobs=1,
        model=model_of(stand_in.small_point),
        **grid,
    )
    xr.testing.assert_identical(remote.drop_attrs(), local.drop_attrs())
