"""The car and its axle as native FMUs in SSP archives compute what the coupled models compute."""

from __future__ import annotations

import zipfile
from collections.abc import Callable
from pathlib import Path

import pytest
from lxml import etree

from drivetrain.driveline.model import Driveline
from examples.ssp import run
from examples.ssp.system import (
    CAR_AND_AXLE,
    CAR_AND_E_AXLE,
    ParameterSet,
    System,
    write_ssp,
    write_ssv,
)
from tests.helpers.fmu_cases import HYPOID_AXLE
from tests.helpers.native_fmus import native_fmus
from tests.helpers.schemas import SSP_1, SSP_2, complaints

STEPS = 200


@pytest.fixture(scope="module")
def fmus(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    return {
        "car": run.build_driveline(tmp_path_factory.mktemp("ssp")),
        "axle": native_fmus(HYPOID_AXLE).fmi2,
    }


@pytest.mark.slow
@pytest.mark.parametrize("oil", run.OILS)
def test_ecos_and_libcosim_couple_both_fmus_as_python_does(
    fmus: dict[str, Path], tmp_path: Path, oil: str
) -> None:
    sets = run.parameter_sets(run.driveline(), oil)
    archive = write_ssp(tmp_path / "car_and_axle.ssp", CAR_AND_AXLE, fmus, sets)
    expected = run.in_python(oil, STEPS)
    # the FMU starts between two starts of its table: 1e-6 of the torques
    found = run.in_ecos(archive, oil, STEPS)
    assert found == pytest.approx(expected, rel=1e-5)
    assert run.in_libcosim(archive, fmus, STEPS) == pytest.approx(found, rel=1e-12)


@pytest.mark.slow
def test_fmpy_runs_the_archive_with_a_system_connector(
    fmus: dict[str, Path], tmp_path: Path
) -> None:
    archive = write_ssp(tmp_path / "whole.ssp", CAR_AND_AXLE, fmus, [], system_connectors=True)
    oil = "mohammadpour"
    values = write_ssv(tmp_path / "start.ssv", run.parameter_sets(run.driveline(), oil)[:2])
    found = run.in_fmpy(archive, values, 2000)
    # its first step has all connected signals at 0; the jerk changes the speed by 1e-6 of it
    assert found == pytest.approx(run.in_python(oil, 2000)[0], rel=1e-6)


@pytest.mark.parametrize("version", ["1.0", "2.0"])
@pytest.mark.parametrize("connectors", [False, True])
@pytest.mark.parametrize(
    ("system", "car", "sets"),
    [
        (CAR_AND_AXLE, run.driveline, lambda car: run.parameter_sets(car, "mohammadpour")),
        (CAR_AND_E_AXLE, run.electric_car, run.e_parameter_sets),
    ],
)
def test_both_systems_obey_the_schemas_of_both_versions(
    tmp_path: Path,
    version: str,
    connectors: bool,
    system: System,
    car: Callable[[], Driveline],
    sets: Callable[[Driveline], list[ParameterSet]],
) -> None:
    archive = write_ssp(
        tmp_path / "any.ssp", system, {}, sets(car()), system_connectors=connectors,
        version=version,
    )  # fmt: skip
    with zipfile.ZipFile(archive) as files:
        found = files.read("SystemStructure.ssd")
    ssd = "SystemStructureDescription.xsd"
    assert complaints(SSP_2 / ssd, found) == []
    assert (complaints(SSP_1 / ssd, found) == []) == (version == "1.0")
    root = etree.fromstring(found)
    for connection in root.iter("{*}Connection"):
        del connection.attrib["endConnector"]
    assert complaints(SSP_2 / ssd, etree.tostring(root)) != []


@pytest.mark.slow
def test_the_electric_car_moves_in_the_hosts_as_in_python(tmp_path: Path) -> None:
    """The FMU's table of starts is exact enough for a smooth motor: 2e-12 was found."""
    found = run.electric(tmp_path, STEPS)
    expected = found.pop("Python, electric")
    assert sorted(found) == ["Ecos, SSP 1.0", "libcosim, SSP 1.0", "libcosim, SSP 2.0"]
    for values in found.values():
        assert values == pytest.approx(expected, rel=1e-9)
    assert found["libcosim, SSP 2.0"] == found["libcosim, SSP 1.0"]
