"""The native FMUs compute in every host what the model computes in Python."""

from __future__ import annotations

import shutil
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import fmpy
import numpy as np
import pytest
from fmpy import simulate_fmu
from fmpy.fmi1 import FMICallException

from docs.fmu_hosts import hosts
from docs.fmu_hosts.hosts import Job
from fmu_src.native.models import native_model
from tests.helpers.fmu_cases import CASES, HYPOID_AXLE, Case
from tests.helpers.host_floats import SETTINGS, under
from tests.helpers.native_fmus import NativeFmus, native_fmus
from tests.helpers.native_library import OK, NativeInstance, NativeLibrary
from tests.helpers.reference_run import check_reference

PAIR = CASES[1]
FMI2: dict[str, Callable[[Job, Path], list[float]]] = {
    "libcosim": lambda job, folder: hosts.in_libcosim(job),
    "Ecos": lambda job, folder: hosts.in_ecos(job),
    "C": hosts.in_c_host,
}
FMI3: dict[str, Callable[[Job], list[float]]] = {"FMPy": hosts.in_fmpy, "Ecos": hosts.in_ecos}


@pytest.fixture(
    scope="module",
    params=[HYPOID_AXLE, pytest.param(PAIR, marks=pytest.mark.slow)],
    ids=lambda case: case.name,
)
def native_case(request: pytest.FixtureRequest) -> Case:
    return request.param


@pytest.fixture(scope="module")
def fmus(native_case: Case) -> NativeFmus:
    return native_fmus(native_case)


@pytest.fixture(scope="module")
def job(native_case: Case, fmus: NativeFmus) -> Job:
    """All Reals that are no elements of an array in FMI 3, with an option set by its number."""
    outputs = [v for v in native_case.definition.variables if v.causality == "output"]
    return Job(
        fmu=fmus.fmi2,
        reals=native_case.reals,
        integers=native_case.integers | {"oil.name.number": 2},
        names=[v.name for v in outputs if v.type == "Real" and "[" not in v.name],
    )


@pytest.fixture(scope="module")
def in_fmpy(job: Job) -> list[float]:
    return hosts.in_fmpy(job)


def test_fmpy_gives_the_numbers_of_the_model(
    native_case: Case, job: Job, in_fmpy: list[float]
) -> None:
    expected = hosts.in_python(job, native_case.definition)
    for name, found, wanted in zip(job.names, in_fmpy, expected, strict=True):
        # other instructions on another processor type: roundings grow over 31 ms to below 1e-9;
        # accelerations and range quantities that are 0 in theory are compared with 1
        assert found == pytest.approx(wanted, rel=1e-9, abs=1e-9 if "acc" in name else 1e-15), name


@pytest.mark.parametrize("host", FMI2)
def test_a_host_of_fmi_2_gives_the_numbers_of_fmpy(
    job: Job, in_fmpy: list[float], host: str, tmp_path: Path
) -> None:
    assert FMI2[host](job, tmp_path) == in_fmpy


@pytest.mark.parametrize("host", FMI3)
def test_a_host_of_fmi_3_gives_the_numbers_of_fmi_2(
    fmus: NativeFmus, job: Job, in_fmpy: list[float], host: str
) -> None:
    assert FMI3[host](replace(job, fmu=fmus.fmi3)) == in_fmpy


@pytest.mark.slow
@pytest.mark.parametrize("settings", SETTINGS.values(), ids=SETTINGS)
def test_floats_as_a_host_sets_them_change_no_bit_of_a_gear(
    native_case: Case, fmus: NativeFmus, settings: tuple[int, int], tmp_path: Path
) -> None:
    folder = Path(fmpy.extract(str(fmus.fmi2), str(tmp_path)))
    library = NativeLibrary(
        folder / "binaries" / "linux64" / f"{native_case.name}.so",
        native_model(native_case.definition),
        fmpy.read_model_description(str(folder)).guid,
        2,
    )

    def ride(library: NativeLibrary) -> list[bytes]:
        one = NativeInstance(library)
        assert one.start() == one.step(1e-3 / 3.0) == one.step(1e-3 / 3.0) == OK
        seen = [one.content(), repr(one.outputs()).encode()]
        one.close()
        return seen

    assert ride(under(library, settings)) == ride(library)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("kind", "h"),
    [
        *(("CoSimulation", h) for h in (None, 1e-5, 1e-3, 0.1)),
        # FMPy allows CVODE 500 steps between outputs, and 10 ms may take more
        *(("ModelExchange", h) for h in (None, 1e-5, 1e-3)),
    ],
)
def test_fmpy_runs_to_the_end_by_defaults_and_in_steps_of_its_own(
    fmus: NativeFmus, kind: str, h: float | None
) -> None:
    stop = None if h is None else max(3 * h, 2e-3)  # three of 0.1 s are one bit too long
    for fmu in fmus:
        result = simulate_fmu(str(fmu), fmi_type=kind, output_interval=h, stop_time=stop)
        assert result["time"][-1] == pytest.approx(stop or 0.1, rel=1e-9)
        assert all(np.isfinite(result[name]).all() for name in result.dtype.names)


def test_the_reference_results_inside_come_out_again(
    native_case: Case, fmus: NativeFmus, tmp_path: Path
) -> None:
    # the files have seven digits; another processor's roundings grow to 1e-9 in this time
    expected = check_reference(fmus.fmi2, tmp_path, more=1e-9)
    assert len(expected.dtype.names) > 30
    assert np.ptp(expected["mesh.dte"]) > 0.0


@pytest.mark.slow
def test_several_instances_packed_into_one_fmu_give_the_numbers_of_one(
    native_case: Case, job: Job, in_fmpy: list[float], tmp_path: Path
) -> None:
    other = replace(job, reals={**job.reals, "pinion.torque": 70.0})
    found = hosts.in_container([job, other, job], tmp_path)
    assert found == [in_fmpy, hosts.in_fmpy(other), in_fmpy]
    assert found[1] != in_fmpy


@pytest.mark.parametrize("host", ["libcosim", "Ecos"])
def test_an_option_by_number_does_what_its_enumeration_does(
    native_case: Case, job: Job, in_fmpy: list[float], host: str, tmp_path: Path
) -> None:
    off = dict(native_case.enumerations())["friction.model"].index("off") + 1
    by_number = replace(job, integers={**job.integers, "friction.model.number": off})
    found = dict(zip(job.names, FMI2[host](by_number, tmp_path), strict=True))
    assert found["friction.power_loss"] == 0.0 < in_fmpy[job.names.index("friction.power_loss")]
    by_name = replace(job, integers={**job.integers, "friction.model": off})
    assert list(found.values()) == hosts.in_fmpy(by_name)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("platform", "machine"),
    [("x86_64-windows", hosts.WINDOWS), ("aarch64-linux", hosts.ARM64)],
)
def test_the_library_of_another_machine_runs_in_a_host_in_c(
    native_case: Case,
    job: Job,
    in_fmpy: list[float],
    platform: str,
    machine: hosts.Machine,
    tmp_path: Path,
) -> None:
    if shutil.which(machine.runner[0]) is None:
        pytest.skip(f"no {machine.runner[0]} to run a program of {platform}")
    other = native_fmus(native_case, platform)
    found = hosts.in_c_host(replace(job, fmu=other.fmi2), tmp_path, machine)
    # another C library: its exp and log differ in the last bit
    assert found == pytest.approx(in_fmpy, rel=1e-9, abs=1e-12)


def test_casadi_integrates_the_equations_to_the_states_of_the_model(
    native_case: Case, job: Job, tmp_path: Path
) -> None:
    if native_case is PAIR:
        pytest.skip("friction is that of the last completed step, and casadi completes none")
    short = replace(job, names=["pinion.speed", "wheel.speed", "mesh.dte"], step_size=2.0**-12)
    found = hosts.in_casadi(short, tmp_path)
    # CVODE keeps 1e-8 of a state in each of some hundred steps
    assert found == pytest.approx(hosts.in_fmpy(short, "ModelExchange"), rel=1e-6)


def test_a_step_that_the_model_refuses_ends_the_run(job: Job, tmp_path: Path) -> None:
    # Ecos goes on: docs/fmu_hosts.md
    beyond = replace(job, step_size=0.125, steps=2)
    with pytest.raises(RuntimeError, match="a step was refused"):
        hosts.in_libcosim(beyond)
    with pytest.raises(RuntimeError, match=r"must be above 0 and at most 0\.1 s, got 0\.125 s"):
        hosts.in_c_host(beyond, tmp_path)


def test_fmpy_ends_with_fmi_2_where_the_last_step_ended(fmus: NativeFmus) -> None:
    result = simulate_fmu(str(fmus.fmi2), stop_time=0.5, output_interval=0.125, timeout=20.0)
    assert set(result["time"].tolist()) == {0.0}


def test_fmpy_ends_with_fmi_3_at_a_step_that_the_model_refuses(fmus: NativeFmus, job: Job) -> None:
    with pytest.raises(FMICallException, match="fmi3DoStep"):
        hosts.in_fmpy(replace(job, fmu=fmus.fmi3, step_size=0.125, steps=2))


def test_fmpy_reaches_the_stop_time_in_steps_longer_by_rounding(fmus: NativeFmus) -> None:
    """Differences of k 0.1 s reach 0.10000000000000003 s, above the longest step by rounding."""
    for fmu in fmus:
        result = simulate_fmu(str(fmu), stop_time=1.0, output_interval=0.1, timeout=20.0)
        assert result["time"] == pytest.approx(np.arange(11) * 0.1, rel=1e-12)
        assert all(np.isfinite(result[name]).all() for name in result.dtype.names)
