"""Results kept in a folder: found by their key, and never taken for another's."""

import errno
import multiprocessing.queues
import os
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import psutil
import pytest
import xarray as xr
from threadpoolctl import threadpool_info, threadpool_limits

import gearlube
from gearlube_core.errors import ConvergenceError, FileError
from gearlube_core.storage import folders, process_pool
from gearlube_core.storage.atomic_file import atomic_write, read_arrays, write_arrays, write_figure
from gearlube_core.storage.process_pool import ProcessPool, on_one_thread
from gearlube_core.storage.resumable import ARRAYS, DATASETS, ResultStore, resumable_results

ONE, OTHER = {"force": np.array([1.0, 2.0])}, {"force": np.array([3.0])}
HERE = ProcessPool(jobs=1)


def dataset(value):
    return xr.Dataset({"force": ("speed", [value]), "message": "text of any length"})


def test_arrays_come_back_bit_for_bit_and_without_the_key(tmp_path):
    store = ResultStore(tmp_path / "made", ARRAYS)
    assert store.read("a") is None
    store.keep("a", ONE)
    found = store.read("a")
    assert found.keys() == ONE.keys()
    np.testing.assert_array_equal(found["force"], ONE["force"])


def test_datasets_come_back_bit_for_bit(tmp_path):
    store = ResultStore(tmp_path, DATASETS)
    store.keep("a", dataset(0.1))
    xr.testing.assert_equal(store.read("a"), dataset(0.1))


@pytest.mark.parametrize(
    ("file_format", "result"), [(ARRAYS, ONE), (DATASETS, dataset(1.0))], ids=["arrays", "datasets"]
)
@pytest.mark.parametrize("damage", [b"", b"of another kind", None], ids=["empty", "foreign", "cut"])
def test_a_damaged_file_counts_as_missing(tmp_path, file_format, result, damage):
    store = ResultStore(tmp_path, file_format)
    store.keep("a", result)
    (path,) = tmp_path.iterdir()
    path.write_bytes(path.read_bytes()[: path.stat().st_size // 2] if damage is None else damage)
    assert store.read("a") is None
    store.keep("a", result)
    assert store.read("a") is not None


@pytest.mark.parametrize(
    ("file_format", "result"), [(ARRAYS, ONE), (DATASETS, dataset(1.0))], ids=["arrays", "datasets"]
)
def test_a_file_renamed_to_another_key_counts_as_missing(tmp_path, file_format, result):
    store = ResultStore(tmp_path, file_format)
    store.keep("a", result)
    (path,) = tmp_path.iterdir()
    path.rename(path.with_stem("b"))
    assert store.read("b") is None


def test_arrays_without_a_checksum_count_as_missing(tmp_path, caplog):
    np.savez(tmp_path / "a.npz", gearlube_key="a", **ONE)
    assert ResultStore(tmp_path, ARRAYS).read("a") is None
    assert "a.npz has no checksum at its end" in caplog.text
    assert "computed again" in caplog.text


def test_a_dataset_without_a_key_counts_as_missing(tmp_path):
    dataset(1.0).to_netcdf(tmp_path / "a.nc", engine="netcdf4")
    assert ResultStore(tmp_path, DATASETS).read("a") is None


def write_half(path):
    path.write_bytes(b"half")
    raise OSError("the disk is full")


def test_a_write_that_fails_leaves_the_older_file_and_nothing_else(tmp_path):
    path = tmp_path / "a.npz"
    write_arrays(path, ONE)
    with pytest.raises(OSError, match="full"), atomic_write(path) as partial:
        write_half(partial)
    np.testing.assert_array_equal(read_arrays(path)["force"], ONE["force"])
    assert list(tmp_path.iterdir()) == [path]


@pytest.mark.skipif(sys.platform == "win32", reason="no limit on the size of files")
def test_a_full_disk_is_named_by_the_library_that_does_not_say_it(tmp_path):
    import resource
    import signal

    big = xr.Dataset({"noise": ("x", np.random.default_rng(1).random(100_000))})
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    handler = signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    resource.setrlimit(resource.RLIMIT_FSIZE, (100_000, before[1]))
    try:
        with pytest.raises(OSError, match="File too large") as refused:
            DATASETS.write(tmp_path / "big.nc", "key", big)
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)
        signal.signal(signal.SIGXFSZ, handler)
    assert refused.value.errno == errno.EFBIG
    assert list(tmp_path.iterdir()) == []


def test_without_a_home_a_temporary_folder_is_taken_and_said_once(tmp_path, monkeypatch, caplog):
    (tmp_path / "file").touch()
    monkeypatch.delenv(folders.FOLDER_VARIABLE, raising=False)
    for home in (Path("~") / "cache", tmp_path / "file" / "cache"):
        caplog.clear()
        monkeypatch.setattr("platformdirs.user_cache_path", lambda name, home=home: home)
        monkeypatch.setattr(os, "access", lambda path, mode: path.is_dir())
        found = folders.cache_folder("contact")
        assert folders.cache_folder("contact") == found
        found.mkdir(parents=True)
        assert not found.is_relative_to(home)
        assert caplog.text.count(f"{home} cannot be written") == 1


def test_a_damaged_file_is_named_wherever_the_damage_is(tmp_path):
    # zip, deflate and npy each have an error of their own for it
    path, force = tmp_path / "a.npz", np.arange(2000.0)
    write_arrays(path, {"force": force}, compress=True)
    whole, told = path.read_bytes(), 0
    for place in range(40, 400):
        damaged = bytearray(whole)
        damaged[place] ^= 0xFF
        path.write_bytes(damaged)
        try:
            found = read_arrays(path)
        except FileError as error:
            told += "a.npz is damaged" in str(error)
        else:  # bytes that nothing depends on
            np.testing.assert_array_equal(found["force"], force)
    assert told > 300


def square(x):
    if x < 0.0:
        raise ConvergenceError(f"{x:g} has no root")
    return {"square": np.array(x * x)}


def test_stored_results_come_first_and_are_not_computed_again(tmp_path):
    store = ResultStore(tmp_path, ARRAYS)
    list(resumable_results([2.0], str, square, store, HERE))
    seen = list(resumable_results([1.0, 2.0], str, square, store, HERE))
    assert [(done.task, float(done.result["square"]), done.stored) for done in seen] == [
        (2.0, 4.0, True),
        (1.0, 1.0, False),
    ]


def test_an_error_ends_the_run_and_what_was_finished_is_kept(tmp_path):
    store = ResultStore(tmp_path, ARRAYS)
    with pytest.raises(ConvergenceError, match="-1 has no root"):
        list(resumable_results([3.0, -1.0, 4.0], str, square, store, HERE))
    assert [path.stem for path in tmp_path.iterdir()] == ["3.0"]


def test_an_error_can_be_a_result_which_is_tried_again_in_the_next_run(tmp_path):
    store = ResultStore(tmp_path, ARRAYS)
    for _ in range(2):
        seen = resumable_results(
            [-1.0, 4.0],
            str,
            square,
            store,
            HERE,
            failed=lambda task, error: {"message": np.array(str(error))},
            worth_keeping=lambda result: "square" in result,
        )
        results = {done.task: done for done in seen}
        assert str(results[-1.0].result["message"]) == "-1 has no root"
        assert not results[-1.0].stored
    assert results[4.0].stored


def test_a_pool_without_its_thread_ends_and_leaves_no_worker(monkeypatch):
    def no_thread(self):
        raise RuntimeError("can't start new thread")

    monkeypatch.setattr(multiprocessing.queues.Queue, "_start_thread", no_thread)
    monkeypatch.setattr("threading.excepthook", lambda arguments: None)
    tasks = resumable_results([1, 2], str, abs, ResultStore(None, ARRAYS), ProcessPool(jobs=2))
    with pytest.raises(MemoryError, match="start no thread"):
        list(tasks)
    limit = time.monotonic() + 20.0
    while multiprocessing.active_children() and time.monotonic() < limit:
        time.sleep(0.05)
    assert multiprocessing.active_children() == []


PARENT = """
import time
from gearlube_core.storage.process_pool import ProcessPool
if __name__ == "__main__":
    with ProcessPool(jobs=2).open(2) as pool:
        tasks = [pool.submit(time.sleep, 60.0) for _ in range(2)]
        print(*pool._processes, flush=True)
        tasks[0].result()
"""


def test_workers_end_with_a_parent_that_is_killed(tmp_path):
    (tmp_path / "parent.py").write_text(PARENT)
    command = [sys.executable, str(tmp_path / "parent.py")]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as parent:
        assert parent.stdout is not None
        workers = [psutil.Process(int(pid)) for pid in parent.stdout.readline().split()]
        assert len(workers) == 2
        time.sleep(2.0)  # they have begun
        parent.kill()
    _, left = psutil.wait_procs(workers, timeout=10.0)
    for worker in left:
        worker.kill()
    assert left == []


def test_without_a_folder_nothing_is_kept():
    store = ResultStore(None, ARRAYS)
    store.keep("a", ONE)
    assert store.read("a") is None


class _Executor:
    """Takes down what an executor of processes is asked for."""

    def __init__(self, workers, *, mp_context, initializer, initargs):
        self.workers, self.initargs, self.closed = workers, initargs, None
        self.start = mp_context.get_start_method()

    def shutdown(self, *, wait, cancel_futures):
        self.closed = (wait, cancel_futures)


@pytest.mark.parametrize(
    ("given", "tasks", "workers"),
    [
        ({"jobs": 3}, 8, 3),
        ({"jobs": 3}, 2, 2),
        ({"jobs": 3}, 1, None),
        ({"jobs": 1}, 8, None),
        ({"jobs": 1, "always_spawn": True}, 8, 1),
        ({"jobs": 3, "always_spawn": True}, 0, 1),
        ({}, 9, 5),
        ({}, 2, 2),
    ],
)
def test_pool_has_as_many_processes_as_jobs_and_no_more_than_tasks(
    monkeypatch, given, tasks, workers
):
    monkeypatch.setattr(process_pool, "ProcessPoolExecutor", _Executor)
    monkeypatch.setattr(process_pool, "processors", lambda: 5)
    told = []
    pool = ProcessPool(
        prepare=told.append, arguments=("ready",), before=lambda: told.append("first"), **given
    )
    with pool.open(tasks) as executor:
        if workers is None:
            assert executor is None
            assert told == ["first", "ready"]
        else:
            assert executor.workers == workers
            assert executor.start == "spawn"
            assert executor.initargs == (pool.prepare, ("ready",))
            # others are prepared in their own process
            assert told == ["first"]
            assert executor.closed is None
    assert workers is None or executor.closed == (True, True)


class FullDisk:
    """A figure whose file is cut off."""

    def savefig(self, path, **options):
        Path(path).write_bytes(b"half")
        raise OSError(errno.ENOSPC, "no space")


def test_a_picture_that_is_not_finished_leaves_the_older_one(tmp_path):
    path = tmp_path / "a.png"
    path.write_bytes(b"older")
    with pytest.raises(OSError, match="no space"):
        write_figure(FullDisk(), path)
    assert [(one.name, one.read_bytes()) for one in tmp_path.iterdir()] == [("a.png", b"older")]


def test_every_picture_is_written_by_the_same_function():
    package = Path(gearlube.__file__).parent
    places = [
        line
        for file in package.rglob("*.py")
        for line in file.read_text(encoding="utf-8").splitlines()
        if ".savefig(" in line and ".savefig(buffer" not in line and ".plot().savefig(" not in line
    ]
    assert places == []


def test_linear_algebra_of_a_function_on_one_thread_runs_on_one():
    def threads():
        return {one["num_threads"] for one in threadpool_info() if one["user_api"] == "blas"}

    with threadpool_limits(2):
        assert on_one_thread(threads)() == {1}
        assert threads() == {2}
