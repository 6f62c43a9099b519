from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import cache
from pathlib import Path

import pytest
from fmpy import extract

from tests.helpers.fmu_cases import CASES, HYPOID_AXLE, Case
from tests.helpers.fmu_host import Host


@pytest.fixture(scope="session", params=CASES, ids=lambda case: case.name)
def case(request: pytest.FixtureRequest) -> Case:
    """Each FMU in turn: the checklist is the same for all."""
    return request.param


@pytest.fixture(scope="session")
def built(tmp_path_factory: pytest.TempPathFactory) -> Callable[[Case], Path]:
    return cache(lambda case: case.build(tmp_path_factory.mktemp("fmu")))


@pytest.fixture(scope="session")
def extracted(
    built: Callable[[Case], Path], tmp_path_factory: pytest.TempPathFactory
) -> Callable[[Case], Path]:
    def folder(case: Case) -> Path:
        return Path(extract(str(built(case)), str(tmp_path_factory.mktemp("extracted"))))

    return cache(folder)


@pytest.fixture(scope="session")
def fmu_path(built: Callable[[Case], Path], case: Case) -> Path:
    return built(case)


@pytest.fixture(scope="session")
def fmu_folder(extracted: Callable[[Case], Path], case: Case) -> Path:
    return extracted(case)


@pytest.fixture(scope="session")
def axle_path(built: Callable[[Case], Path]) -> Path:
    """HypoidAxle.fmu, for what only an axle does."""
    return built(HYPOID_AXLE)


@pytest.fixture(scope="session")
def axle_folder(extracted: Callable[[Case], Path]) -> Path:
    return extracted(HYPOID_AXLE)


@pytest.fixture
def host_of() -> Iterator[Callable[[Path], Host]]:
    hosts: list[Host] = []

    def make(folder: Path) -> Host:
        hosts.append(Host(folder))
        return hosts[-1]

    yield make
    for host in hosts:
        host.close()


@pytest.fixture
def new_host(host_of: Callable[[Path], Host], fmu_folder: Path) -> Callable[[], Host]:
    return lambda: host_of(fmu_folder)


@pytest.fixture
def host(new_host: Callable[[], Host]) -> Host:
    return new_host()


# what these look at is plumbing that both FMUs share, in processes of their own that cost seconds
_ONE_MODEL_BY_DEFAULT = {
    "test_a_state_saved_in_one_process_continues_in_another",
    "test_ecos_gives_the_numbers_of_the_model",
    "test_the_check_reports_an_output_missing_from_the_structure",
    "test_the_check_reports_an_output_without_unit",
    "test_ecos_runs_the_fmu_and_ends_well",
    "test_libcosim_gives_the_numbers_of_the_model",
    "test_every_output_is_finite_after_a_wild_ride",
    "test_the_guid_covers_every_file_that_an_fmu_loads",
    "test_the_library_has_nothing_left_to_release_before_its_destructors_run",
    "test_two_builds_in_different_processes_are_equal_bit_for_bit",
}


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Leave the second FMU's cases of costly tests to the slow run."""
    for item in items:
        name = getattr(item, "originalname", "")
        if name in _ONE_MODEL_BY_DEFAULT and "HelicalPair" in item.name:
            item.add_marker(pytest.mark.slow)
