"""A real Dask scheduler with two worker processes on this machine."""

import os
import subprocess
import sys
import time
from contextlib import contextmanager
from pathlib import Path

DEADLINE = 120.0  # s, for anything that has to come up; a busy machine takes most of it


def _start(*arguments):
    environment = os.environ | {"PYTHONPATH": str(Path(__file__).parents[2])}
    return subprocess.Popen(
        [sys.executable, "-m", "distributed.cli." + arguments[0], *arguments[1:]],
        env=environment,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )


def _wait_for(condition, what):
    limit = time.monotonic() + DEADLINE
    while not condition():
        assert time.monotonic() < limit, f"waited {DEADLINE} s for {what}"
        time.sleep(0.05)


@contextmanager
def dask_cluster(folder):
    """Yield the address of the scheduler and the worker processes "first" and "second"."""
    from distributed import Client

    address_file = folder / "scheduler.json"
    processes = [
        _start(
            "dask_scheduler",
            *("--host", "127.0.0.1", "--port", "0", "--no-dashboard"),
            *("--scheduler-file", str(address_file)),
        )
    ]
    workers = {}
    try:
        _wait_for(lambda: address_file.exists() and address_file.stat().st_size > 0, "scheduler")
        for name in ("first", "second"):
            workers[name] = _start(
                "dask_worker",
                *("--scheduler-file", str(address_file), "--host", "127.0.0.1"),
                *("--nthreads", "1", "--no-nanny", "--no-dashboard", "--name", name),
                *("--local-directory", str(folder / name)),
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
