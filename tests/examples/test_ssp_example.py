"""The car and its axle as native FMUs in SSP archives compute what the coupled models compute."""

from __future__ import annotations

from pathlib import Path

import pytest

from examples.ssp import run
from examples.ssp.system import write_ssp, write_ssv
from tests.helpers.fmu_cases import HYPOID_AXLE
from tests.helpers.native_fmus import native_fmus

STEPS = 200


@pytest.fixture(scope="module")
def fmus(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    return {
        "car": run.build_driveline(tmp_path_factory.mktemp("ssp")),
        "axle": native_fmus(HYPOID_AXLE).fmi2,
    }


@pytest.mark.parametrize("oil", run.OILS)
def test_ecos_and_libcosim_couple_both_fmus_as_python_does(
    fmus: dict[str, Path], tmp_path: Path, oil: str
) -> None:
    sets = run.parameter_sets(run.driveline(), oil)
    archive = write_ssp(tmp_path / "car_and_axle.ssp", fmus["car"], fmus["axle"], sets)
    expected = run.in_python(oil, STEPS)
    # the FMU starts between two starts of its table: 1e-6 of the torques
    found = run.in_ecos(archive, oil, STEPS)
    assert found == pytest.approx(expected, rel=1e-5)
    assert run.in_libcosim(archive, fmus, STEPS) == pytest.approx(found, rel=1e-12)


@pytest.mark.slow
def test_fmpy_runs_the_archive_with_a_system_connector(
    fmus: dict[str, Path], tmp_path: Path
) -> None:
    paths = fmus["car"], fmus["axle"]
    archive = write_ssp(tmp_path / "whole.ssp", *paths, [], system_connectors=True)
    oil = "mohammadpour"
    values = write_ssv(tmp_path / "start.ssv", run.parameter_sets(run.driveline(), oil)[:2])
    found = run.in_fmpy(archive, values, 2000)
    # its first step has all connected signals at 0; the jerk changes the speed by 1e-6 of it
    assert found == pytest.approx(run.in_python(oil, 2000)[0], rel=1e-6)
