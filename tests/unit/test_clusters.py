"""Studies on a Dask cluster."""

from __future__ import annotations

import signal
import threading
import time
from concurrent.futures import Future, ThreadPoolExecutor
from importlib import metadata

import pytest
import xarray as xr

from gearlube.studies.film_model.plan import FilmPlan
from gearlube.studies.film_model.solves import pool_of, train
from gearlube.studies.sweep.run import SweepModel, run_sweep
from gearlube.studies.sweep.settings import SweepSettings
from gearlube.variation.design import Axis, Design
from gearlube.variation.run import run_variation
from gearlube.variation.store import open_variation
from gearlube_core.errors import GearLubeError, ParameterError
from gearlube_core.storage import dask_pool
from gearlube_core.storage.resumable import ARRAYS, ResultStore, resumable_results
from tests.helpers import sweep_stand_in as stand_in
from tests.helpers.dask_cluster import dask_cluster
from tests.helpers.variation_stand_in import AreaStudy

# six films; rollers are the cheapest
PLAN = FilmPlan(
    contact="roller", box=2, visited=1, edge=1, calibration=1, fresh=1,
    fine_box=0, fine_visited=0, fine_edge=0, fine_fresh=0,
)  # fmt: skip


@pytest.mark.slow
def test_films_of_a_cluster_are_those_of_this_machine(tmp_path):
    with dask_cluster(tmp_path) as (address, _):
        far = train(PLAN, tmp_path / "far", pool=pool_of(None, address))
    here = train(PLAN, tmp_path / "here", pool=pool_of(1, None))
    assert len(here.rows) == PLAN.solves == 6
    assert far.rows.keys() == here.rows.keys()
    for key, row in here.rows.items():
        other = far.rows[key]
        assert row.solved.converged
        assert (other.task, other.failure) == (row.task, row.failure)
        for one, two, name in zip(other.solved, row.solved, row.solved._fields, strict=True):
            if name != "seconds":
                # sums in another order, in a process with other threads
                assert one == pytest.approx(two, rel=1e-9, nan_ok=True), name
    # a second run has nothing left to solve: no cluster is asked
    again = train(PLAN, tmp_path / "far", pool=pool_of(1, None))
    took = {key: row.solved.seconds for key, row in far.rows.items()}
    assert {key: row.solved.seconds for key, row in again.rows.items()} == took


def test_processors_of_this_machine_and_a_cluster_are_not_mixed():
    with pytest.raises(ParameterError, match="--jobs must be left out beside --scheduler"):
        pool_of(2, "tcp://127.0.0.1:8786")


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
    grid = {"speeds_kmh": [20.0, 30.0, 40.0, 50.0, 60.0, 70.0], "preloads": [2500.0, 6000.0]}
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


WIDTHS = tuple(float(w) for w in range(1, 25))
DESIGN = Design(axes=(Axis("width_mm", WIDTHS),))


@pytest.mark.slow  # starts a scheduler and two workers
def test_nothing_is_lost_when_a_worker_dies_and_nothing_is_computed_twice_after(tmp_path):
    killed = threading.Event()
    study = AreaStudy(seconds=0.1, fails_at=20.0)
    with dask_cluster(tmp_path) as (address, workers):

        def kill_one_worker_after_a_quarter(share, sentence):
            if share >= 0.25 and not killed.is_set():
                workers["first"].send_signal(signal.SIGKILL)
                killed.set()

        done = run_variation(
            study,
            DESIGN,
            out=tmp_path / "out",
            scheduler=address,
            block=2,
            progress=kill_one_worker_after_a_quarter,
        )
        assert workers["first"].wait(timeout=10.0) == -signal.SIGKILL
    assert (done.computed, done.failed, done.lost) == (24, 1, 0)
    found = open_variation(tmp_path / "out")
    assert found["area"].values[:19].tolist() == [2.0 * w for w in WIDTHS[:19]]
    assert found["message"].values[19] == b"no tooth is 20 mm wide"
    # no cluster is left: were a point missing, this would fail
    again = run_variation(study, DESIGN, out=tmp_path / "out", scheduler=address)
    assert again.computed == 0


def test_a_scheduler_that_is_not_there_is_named(tmp_path, monkeypatch):
    monkeypatch.setattr("gearlube_core.storage.dask_pool._CONNECT_TIMEOUT", 0.5)
    with pytest.raises(GearLubeError, match=r"No Dask scheduler answered at tcp://127\.0\.0\.1:1"):
        run_variation(AreaStudy(), DESIGN, out=tmp_path, scheduler="tcp://127.0.0.1:1")


class StandInClient:
    """A client whose cluster has its worker, of a version of the package, after a time."""

    version: object = "0.1.0"
    worker_from = 0.0
    status = "running"

    def __init__(self, address, **_):
        self.began = time.monotonic()

    def scheduler_info(self):
        late = time.monotonic() - self.began < self.worker_from
        return {"workers": {} if late else {"tcp://worker:1": {}}}

    def run(self, function, *arguments, on_error):
        assert (function, arguments) == (metadata.version, ("gearlube",))
        return {"tcp://worker:1": self.version}

    def get_executor(self, **_):
        return ThreadPoolExecutor(1)

    def register_plugin(self, plugin, name):
        pass

    unregister_worker_plugin = close = lambda self, *_: None


@pytest.fixture
def pool(monkeypatch):
    plugin = dask_pool.NamedPlugin()
    plugin.name = "none"
    monkeypatch.setattr(dask_pool, "_POLL", 0.01)
    monkeypatch.setattr(dask_pool, "_PATIENCE", 0.05)
    monkeypatch.setattr(dask_pool, "__version__", "0.1.0")
    monkeypatch.setattr(dask_pool, "Client", StandInClient)
    return dask_pool.DaskPool("tcp://host:8786", plugin)


@pytest.mark.parametrize(("worker_from", "said"), [(0.0, 0), (0.3, 1)])
def test_a_cluster_without_workers_is_said_once_and_waited_for(
    pool, monkeypatch, caplog, worker_from, said
):
    monkeypatch.setattr(StandInClient, "worker_from", worker_from)
    with pool.open(1) as executor:
        assert executor.submit(int, "3").result() == 3
    assert caplog.text.count("tcp://host:8786 has no workers. Start one with") == said


class DroppingExecutor(ThreadPoolExecutor):
    """What a client without its scheduler makes of tasks."""

    def submit(self, *_arguments, **_named):
        task = Future()
        task.cancel()
        task.set_running_or_notify_cancel()
        return task


def test_a_scheduler_that_ends_is_named_and_what_is_finished_stays(pool, monkeypatch):
    monkeypatch.setattr(StandInClient, "get_executor", lambda self, **_: DroppingExecutor(1))
    tasks = resumable_results(
        [1, 2], str, abs, ResultStore(None, ARRAYS), pool, failed=lambda task, error: {}
    )
    with pytest.raises(GearLubeError, match=r"tcp://host:8786 has ended.* command again"):
        list(tasks)
    monkeypatch.setattr(StandInClient, "worker_from", 60.0)
    monkeypatch.setattr(StandInClient, "status", "closed")
    with pytest.raises(GearLubeError, match="has ended"), pool.open(1):
        pass


@pytest.mark.parametrize(
    ("version", "got"), [(metadata.PackageNotFoundError("gearlube"), "none"), ("0.0.9", "0.0.9")]
)
def test_a_worker_without_this_package_is_refused_with_the_cure(pool, monkeypatch, version, got):
    monkeypatch.setattr(StandInClient, "version", version)
    words = rf"gearlube 0\.1\.0, got {got} at tcp://worker:1\. Install it .*`pip install gearlube`"
    with pytest.raises(GearLubeError, match=words), pool.open(1):
        pass
