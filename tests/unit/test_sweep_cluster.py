"""The same sweep on a real Dask cluster of two worker processes, one of which is killed."""

import os
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import pytest
import xarray as xr

from gearlube.studies.sweep.run import SweepModel, run_sweep
from gearlube.studies.sweep.settings import SweepSettings
from tests.helpers import sweep_stand_in as stand_in

DEADLINE = 60.0  # s, for anything that has to come up


def start(*arguments):
    environment = os.environ | {"PYTHONPATH": str(Path(__file__).parent)}
    return subprocess.Popen(
        [sys.executable, "-m", "distributed.cli." + arguments[0], *arguments[1:]],
        env=environment,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )


def wait_for(condition, what):
    limit = time.monotonic() + DEADLINE
    while not condition():
        assert time.monotonic() < limit, f"waited {DEADLINE} s for {what}"
        time.sleep(0.05)


@pytest.fixture
def cluster(tmp_path):
    """Scheduler address and the worker processes by name."""
    from distributed import Client

    address_file = tmp_path / "scheduler.json"
    processes = [
        start(
            "dask_scheduler",
            *("--host", "127.0.0.1", "--port", "0", "--no-dashboard"),
            *("--scheduler-file", str(address_file)),
        )
    ]
    workers = {}
    try:
        wait_for(lambda: address_file.exists() and address_file.stat().st_size > 0, "scheduler")
        for name in ("first", "second"):
            workers[name] = start(
                "dask_worker",
                *("--scheduler-file", str(address_file), "--host", "127.0.0.1"),
                *("--nthreads", "1", "--no-nanny", "--no-dashboard", "--name", name),
                *("--local-directory", str(tmp_path / name)),
            )
            processes.append(workers[name])
        with Client(scheduler_file=str(address_file), set_as_default=False) as client:
            client.wait_for_workers(2, timeout=DEADLINE)
            address = client.scheduler.address
        yield address, workers
    finally:
        for process in reversed(processes):
            process.terminate()
        for process in processes:
            try:
                process.wait(timeout=10.0)
            except subprocess.TimeoutExpired:
                process.kill()


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
