from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from fmpy import extract
from fmu_host import Host

from fmu_src.build import build_hypoid_axle


@pytest.fixture(scope="session")
def fmu_path(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return build_hypoid_axle(tmp_path_factory.mktemp("fmu"))


@pytest.fixture(scope="session")
def fmu_folder(fmu_path: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    return Path(extract(str(fmu_path), str(tmp_path_factory.mktemp("extracted"))))


@pytest.fixture
def new_host(fmu_folder: Path) -> Iterator[Callable[[], Host]]:
    hosts: list[Host] = []

    def make() -> Host:
        hosts.append(Host(fmu_folder))
        return hosts[-1]

    yield make
    for host in hosts:
        host.close()


@pytest.fixture
def host(new_host: Callable[[], Host]) -> Host:
    return new_host()
