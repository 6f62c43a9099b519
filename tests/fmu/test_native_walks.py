"""Random sequences of calls on the axle and the pair: no crash, no NaN with OK, no lost state."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from fmu_src.native.models import native_model
from tests.helpers.fmu_cases import CASES, Case
from tests.helpers.native_library import WARNING, NativeInstance, NativeLibrary
from tests.helpers.native_walk import native_library, walk
from tests.helpers.watching_library import COMPILER, watching_environment, watching_library

ROOT = Path(__file__).parents[2]


@pytest.fixture(scope="module", params=[2, 3], ids=["FMI 2", "FMI 3"])
def version(request: pytest.FixtureRequest) -> int:
    return int(request.param)


@pytest.fixture(
    scope="module",
    params=[CASES[0], pytest.param(CASES[1], marks=pytest.mark.slow)],
    ids=lambda case: case.name,
)
def library(
    request: pytest.FixtureRequest, version: int, tmp_path_factory: pytest.TempPathFactory
) -> NativeLibrary:
    case: Case = request.param
    return native_library(case, version, tmp_path_factory.mktemp(f"{case.name}_{version}"))


def _all_kinds_of_answers_came(counts: dict[str, int]) -> None:
    for kind in ("start 0", "steps 0", "step 0", "step 2", "step 3", "get 0", "damaged 3"):
        assert counts.get(kind, 0) > 0, (kind, counts)


def test_random_sequences_of_calls_never_break_an_fmu(library: NativeLibrary) -> None:
    _all_kinds_of_answers_came(walk(library, sequences=100, seed=1))


@pytest.mark.slow
def test_ten_thousand_sequences_never_break_an_fmu(library: NativeLibrary) -> None:
    _all_kinds_of_answers_came(walk(library, sequences=10_000, seed=2))


@pytest.mark.slow
@pytest.mark.skipif(COMPILER is None, reason="no gcc, whose run-time library does the watching")
@pytest.mark.parametrize("case", CASES, ids=lambda case: case.name)
def test_no_call_leaves_its_memory_or_overflows(case: Case, version: int, tmp_path: Path) -> None:
    library = watching_library(native_model(case.definition), tmp_path)
    numbers = [str(n) for n in (CASES.index(case), version, 2000)]
    command = [sys.executable, "-m", "tests.helpers.native_walk", str(library), *numbers]
    done = subprocess.run(
        command, cwd=ROOT, env=watching_environment(), capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, (done.stdout + done.stderr)[-5000:]
    assert "steps 0" in done.stdout


def _memory() -> int:
    """Memory of this process [kB]."""
    return int(Path("/proc/self/statm").read_text().split()[1]) * 4


@pytest.mark.slow
@pytest.mark.skipif(not Path("/proc/self/statm").is_file(), reason="memory is read as Linux has it")
def test_instances_leave_no_memory_behind_and_do_not_disturb_each_other(
    library: NativeLibrary,
) -> None:
    def made() -> NativeInstance:
        instance = NativeInstance(library, logging=False)
        assert max(instance.start(), instance.step(1e-3)) <= WARNING
        return instance

    for _ in range(200):  # what the C library keeps for itself
        made().close()
    before = _memory()
    for _ in range(2000):
        made().close()
    assert _memory() - before < 200  # 0.1 kB each: a leak of one state would be 10 kB each
    many = [made() for _ in range(2000)]
    assert len({instance.get("mesh.dte") for instance in many}) == 1
    for instance in many:
        instance.close()
