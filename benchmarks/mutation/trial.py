"""Tests in a process of their own: forked from one that has imported everything but the project."""

from __future__ import annotations

import contextlib
import ctypes
import importlib
import json
import os
import signal
import sys
import time
from collections.abc import Generator, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, NoReturn

import pytest

_IMPORTED_ONCE = """
numba scipy.optimize scipy.integrate scipy.interpolate scipy.sparse.linalg scipy.signal scipy.stats
xarray netCDF4 pydantic typer rich skfem hypothesis matplotlib.pyplot fmpy pythonfmu jinja2 casadi
pyfftw trimesh dask distributed
"""
_OPTIONS = """
-o addopts= -p no:xdist -p no:cacheprovider -p no:benchmark -q --doctest-modules --strict-markers
--hypothesis-seed=0
"""
_END_WITH_PARENT = 1  # prctl's PR_SET_PDEATHSIG
_SLOW = 1.0  # [s] tests that take longer come last
_TICK = 0.05  # [s]
_PER_SECOND = os.sysconf("SC_CLK_TCK")


@dataclass(frozen=True)
class Plan:
    """What to run, in which order, and for how long."""

    files: Sequence[str]  # nearest first
    compiled: bool
    seconds: dict[str, float] = field(default_factory=dict)  # of known tests, unchanged code
    left_out: frozenset[str] = frozenset()  # tests that fail on unchanged code
    known_only: bool = False
    budget: float = float("inf")  # [s] of unchanged tests
    limit: float = 120.0  # [s] of processor time
    keep_going: bool = False
    each: float = 0.0  # [s] after which a test is stopped; 0: never


@dataclass(frozen=True)
class Result:
    """How it ended."""

    ended: str  # "passed", "failed", "too long", "limit"
    test: str  # that failed or was too long
    seconds: float  # of processor time
    passed: dict[str, float]  # seconds of each


def import_all() -> None:
    """Import what tests need besides the project."""
    for name in _IMPORTED_ONCE.split():
        with contextlib.suppress(ImportError):
            importlib.import_module(name)


def run_tests(plan: Plan, place: Path, environment: dict[str, str], allowance: float) -> Result:
    """Run tests of the copy at `place`; a test may take five times its time and `allowance`."""
    report = place.parent / "report.jsonl"
    report.write_text("")
    child = os.fork()
    if child == 0:
        _run_here(plan, place, report, environment)
    ended, test, begin, read = "", "", 0.0, 0
    passed: dict[str, float] = {}
    wall = time.monotonic()
    while not ended:
        time.sleep(_TICK)
        gone, status, usage = os.wait4(child, os.WNOHANG)
        used = usage.ru_utime + usage.ru_stime if gone else _processor_time(child)
        lines = report.read_text().splitlines(keepends=True)
        whole = [line for line in lines if line.endswith("\n")]
        for line in whole[read:]:
            what, name, seconds = json.loads(line)
            if what == "start":
                test, begin = name, used
            elif what == "passed":
                passed[name] = seconds
            else:
                ended = ended or ("" if plan.keep_going else "failed")
                test = name
        read = len(whole)
        if gone:
            code = os.waitstatus_to_exitcode(status)
            ended = ended or ("passed" if code in (0, 5) or plan.keep_going else "failed")
            return Result(ended, test if ended == "failed" else "", used, passed)
        longest = 5.0 * plan.seconds.get(test, 1.0) + allowance
        if test and used - begin > longest:
            ended = "too long"
        elif used > plan.limit or time.monotonic() - wall > 8.0 * plan.limit:
            ended = "limit"
    os.killpg(child, signal.SIGKILL)
    os.wait4(child, 0)
    return Result(ended, test, used, passed)


def _processor_time(process: int) -> float:
    parts = Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()
    return sum(map(int, parts[11:15])) / _PER_SECOND


def _run_here(plan: Plan, place: Path, report: Path, environment: dict[str, str]) -> NoReturn:
    code = 1
    try:
        os.setsid()
        ctypes.CDLL(None).prctl(_END_WITH_PARENT, signal.SIGKILL)
        os.environ.update(environment, PYTHONPATH=str(place))
        os.chdir(place)
        sys.path.insert(0, str(place))
        sys.dont_write_bytecode = not plan.keep_going
        _set_numba(plan.compiled)
        log = os.open(place.parent / "log.txt", os.O_WRONLY | os.O_CREAT | os.O_TRUNC)
        os.dup2(log, 1)
        os.dup2(log, 2)
        first_only = [] if plan.keep_going else ["-x"]
        arguments = [*_OPTIONS.split(), *first_only, "-m", "not slow", *plan.files]
        code = int(pytest.main(arguments, plugins=[_Watch(plan, report)]))
        sys.stdout.flush()
    finally:
        os._exit(code)


def _set_numba(compiled: bool) -> None:
    from numba.core import config

    config.CACHE_DIR = os.environ["NUMBA_CACHE_DIR"]
    config.DISABLE_JIT = int(not compiled)
    os.environ["NUMBA_DISABLE_JIT"] = str(config.DISABLE_JIT)


class _Watch:
    """Puts the tests in order, leaves out what is not wanted and reports what happens."""

    def __init__(self, plan: Plan, report: Path) -> None:
        self._plan = plan
        self._report = report
        self._took: dict[str, float] = {}

    def _say(self, what: str, test: str, seconds: float = 0.0) -> None:
        with self._report.open("a") as file:
            file.write(json.dumps((what, test, seconds)) + "\n")

    @pytest.hookimpl(trylast=True)
    def pytest_collection_modifyitems(self, config: pytest.Config, items: list[Any]) -> None:
        plan, ranks = self._plan, {}
        for rank, file in enumerate(plan.files):
            ranks[file.partition("::")[0]] = rank

        def order(item: Any) -> tuple[bool, int]:
            slow = plan.seconds.get(item.nodeid, 0.0) > _SLOW
            return slow, ranks.get(item.nodeid.partition("::")[0], 0)

        wanted, spent = [], 0.0
        for item in sorted(items, key=order):
            known = item.nodeid in plan.seconds
            if item.nodeid in plan.left_out or (plan.known_only and not known):
                continue
            spent += plan.seconds.get(item.nodeid, 0.03)
            if spent <= plan.budget:
                wanted.append(item)
        config.hook.pytest_deselected(items=[item for item in items if item not in wanted])
        items[:] = wanted

    def pytest_runtest_logstart(self, nodeid: str) -> None:
        self._say("start", nodeid)

    @pytest.hookimpl(wrapper=True)
    def pytest_runtest_call(self, item: Any) -> Generator[None, Any, Any]:
        if not self._plan.each:
            return (yield)
        signal.signal(signal.SIGVTALRM, _stop)
        signal.setitimer(signal.ITIMER_VIRTUAL, self._plan.each)
        try:
            return (yield)
        finally:
            signal.setitimer(signal.ITIMER_VIRTUAL, 0.0)

    def pytest_runtest_logreport(self, report: Any) -> None:
        self._took[report.nodeid] = self._took.get(report.nodeid, 0.0) + report.duration
        if report.failed:
            self._say("failed", report.nodeid)
            self._took[report.nodeid] = float("inf")
        elif report.when == "teardown" and self._took[report.nodeid] < float("inf"):
            self._say("passed", report.nodeid, round(self._took[report.nodeid], 3))

    def pytest_collectreport(self, report: Any) -> None:
        if report.failed:
            self._say("failed", report.nodeid)


def _stop(*_: object) -> None:
    raise TimeoutError("this test takes too long without compilation")
