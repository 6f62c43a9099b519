"""Random and extreme calls on the axle and the pair: no crash, no NaN with OK, no lost state."""

from __future__ import annotations

import gc
import math
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.helpers.fmu_cases import CASES, Case
from tests.helpers.native_fmus import native_library
from tests.helpers.native_library import DISCARD, OK, WARNING, NativeInstance, NativeLibrary
from tests.helpers.native_walk import MODELS, walk
from tests.helpers.watching_library import COMPILER, NO_COMPILER

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
    for kind in ("start 0", "steps 0", "step 0", "step 2", "step 3", "get 0", "damaged 3",
                 "freed_again 3", "forged 0", "forged 3", "set_states 0", "set_states 2", "array 0",
                 "array 2", "differentiate 0", "differentiate 2", "update 0"):  # fmt: skip
        assert counts.get(kind, 0) > 0, (kind, counts)


def test_random_sequences_of_calls_never_break_an_fmu(library: NativeLibrary) -> None:
    _all_kinds_of_answers_came(walk(library, sequences=150, seed=1))


@pytest.mark.slow
def test_ten_thousand_sequences_never_break_an_fmu(library: NativeLibrary) -> None:
    _all_kinds_of_answers_came(walk(library, sequences=10_000, seed=2))


@pytest.mark.slow
@pytest.mark.skipif(COMPILER is None, reason=NO_COMPILER)
@pytest.mark.parametrize("model", MODELS)
def test_no_call_leaves_its_memory_or_overflows(model: str) -> None:
    command = [sys.executable, "-m", "tests.helpers.native_walk", "--sanitize", "--model", model]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    assert done.returncode == 0, (done.stdout + done.stderr)[-5000:]
    assert done.stdout.count("1000 sequences") == 2
    assert "steps 0" in done.stdout


@pytest.fixture
def turning(library: NativeLibrary) -> Iterator[NativeInstance]:
    """An instance in continuous-time mode."""
    instance = NativeInstance(library, exchange=True)
    assert instance.start() == OK
    assert instance.update()[0] == OK
    assert instance.call("EnterContinuousTimeMode") == OK
    yield instance
    instance.close()


@pytest.mark.parametrize("angle", [1.1e9, -2.9e16, 1e19, 1.4e19, -1e100, 1.7e308])
def test_angles_beyond_the_precision_of_the_mesh_phase_are_refused(
    turning: NativeInstance, angle: float
) -> None:
    names = [v.rate_of for v in turning.library.variables.values() if v.rate_of]
    states = turning.get_array("GetContinuousStates", len(names))[1]
    _, before = turning.get_array("GetDerivatives", len(names))
    for name in ("pinion.angle", "wheel.angle"):
        extreme = [angle if one == name else x for one, x in zip(names, states, strict=True)]
        assert turning.set_states(extreme) == OK
        reference = [turning.library.references["mesh.dte"]]
        asked = (
            turning.get_array("GetDerivatives", len(names))[0],
            turning.get_array("GetEventIndicators", 3)[0],
            turning.complete()[0],
            turning.get_raw("Real", reference, 1)[0],
            turning.differentiate(["mesh.dte"], ["pinion.angle"], [1.0])[0],
        )
        assert asked == 5 * (DISCARD,)
        assert "an angle of a shaft or cage is beyond 1e+09 rad" in turning.log[-1][2]
    assert turning.set_states([1e9 if one == "wheel.angle" else x
                               for one, x in zip(names, states, strict=True)]) == OK  # fmt: skip
    assert turning.get_array("GetDerivatives", len(names))[0] == OK
    assert turning.set_states(states) == OK
    assert turning.get_array("GetDerivatives", len(names)) == (OK, before)


def test_extreme_states_and_seeds_give_finite_numbers_or_a_refusal(turning: NativeInstance) -> None:
    names = [v.rate_of for v in turning.library.variables.values() if v.rate_of]
    rates = [name for name, v in turning.library.variables.items() if v.rate_of]
    states = turning.get_array("GetContinuousStates", len(names))[1]
    for place, name in enumerate(names):
        for extreme in (1e305, -1e308):
            status, found = turning.differentiate(rates, [name], [extreme])
            assert status == OK or (status, found) == (DISCARD, len(names) * [0.0])
            assert all(map(math.isfinite, found))
            wild = [extreme if i == place else x for i, x in enumerate(states)]
            known = turning.get_array("GetContinuousStates", len(names))[1]
            status = turning.set_states(wild)
            after = turning.get_array("GetContinuousStates", len(names))[1]
            assert (status, after) in ((OK, wild), (DISCARD, known))
            assert all(map(math.isfinite, turning.get_array("GetDerivatives", len(names))[1]))
        assert turning.set_states(states) == OK


@pytest.mark.parametrize("h", [1e-15, 1e-12, 2e-308, 5e-324])
def test_a_step_too_short_for_a_mean_keeps_losses_and_efficiencies(
    library: NativeLibrary, h: float
) -> None:
    instance = NativeInstance(library)
    assert instance.start(start=60.0) == OK
    means = [name for name in library.variables if "power_loss" in name or "efficiency" in name]
    assert instance.step(h) == OK  # before any mean: the powers of that moment
    assert 0.9 < instance.get("efficiency") < 1.0
    instance.time = 60.0
    assert instance.step(1e-3) == OK
    before = [instance.get(name) for name in means]
    assert instance.step(h) == OK
    assert [instance.get(name) for name in means] == pytest.approx(before, rel=1e-9)
    assert all(math.isfinite(instance.get(name)) for name in library.names("output")
               if library.counts[name] == 1)  # fmt: skip
    instance.close()


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

    def close(count: int) -> None:
        for i in range(count):
            made().close()
            if i % 100 == 0:
                gc.collect()  # what Python leaves, 8 objects for each, is no leak of the library

    close(300)  # what the C library keeps for itself
    before = _memory()
    close(2000)
    assert _memory() - before < 200  # 0.1 kB each: a leak of one state would be 10 kB each
    many = [made() for _ in range(2000)]
    assert len({instance.get("mesh.dte") for instance in many}) == 1
    for instance in many:
        instance.close()
