"""Parameter sets, uncertain data and report inside HypoidAxle.fmu fit the FMU around them."""

from __future__ import annotations

import csv
import io
import zipfile
from pathlib import Path

import fmpy
import pytest
from fmpy.ssp.ssd import read_ssv

from fmu_src.hypoid_axle import DEFINITION
from fmu_src.native.related_files import FOLDER
from gearlube_core.dynamics.hypoid_axle.mohammadpour_2015 import mohammadpour_2015_axle
from gearlube_core.dynamics.hypoid_axle.uncertain import uncertain_of
from tests.helpers.fmu_cases import HYPOID_AXLE
from tests.helpers.native_fmus import native_fmus

(OIL,) = (v for v in DEFINITION.variables if v.name == "oil.name")


@pytest.fixture(scope="module")
def fmu() -> Path:
    return native_fmus(HYPOID_AXLE).fmi2


def inside(fmu: Path, name: str) -> bytes:
    with zipfile.ZipFile(fmu) as archive:
        return archive.read(f"{FOLDER}/{name}")


def table(fmu: Path, name: str) -> list[dict[str, str]]:
    return list(csv.DictReader(io.StringIO(inside(fmu, name).decode())))


def friction(fmu: Path, **start: object) -> float:
    found = fmpy.simulate_fmu(
        str(fmu), stop_time=0.01, output_interval=1e-3, output=["friction.power_loss"],
        start_values={name.replace("__", "."): value for name, value in start.items()},
    )  # fmt: skip
    return float(found["friction.power_loss"][-1])


@pytest.mark.parametrize("oil", OIL.literals)
def test_each_oil_has_a_parameter_set_that_a_host_applies(fmu: Path, oil: str) -> None:
    values = read_ssv(io.BytesIO(inside(fmu, f"oil_{oil}.ssv"))).parameters
    found = friction(fmu, **{one.name: one.value for one in values})
    by_number = [friction(fmu, oil__name=i) for i in range(1, len(OIL.literals) + 1)]
    assert found == by_number[OIL.literals.index(oil)]
    assert len(set(by_number)) == len(by_number)


def test_the_default_set_changes_nothing(fmu: Path) -> None:
    values = read_ssv(io.BytesIO(inside(fmu, "default.ssv"))).parameters
    assert {one.name for one in values} == {
        v.name for v in DEFINITION.variables
        if v.causality == "parameter" and v.type != "Enumeration"
    }  # fmt: skip
    assert friction(fmu, **{one.name: one.value for one in values}) == friction(fmu)


def test_uncertain_data_are_those_of_the_error_bars(fmu: Path) -> None:
    rows = {one["datum"]: one for one in table(fmu, "uncertainty.csv")}
    expected = {one.name: f"{one.factor:g}" for one in uncertain_of(mohammadpour_2015_axle())}
    assert {name: one["factor"] for name, one in rows.items()} == expected
    held = {name: one["parameter"] for name, one in rows.items() if one["parameter"]}
    assert held == {"roughness": "flank.roughness_rms", "preload": "bearing.preload"}


def test_the_reference_experiment_meets_the_requirements(fmu: Path) -> None:
    report = {one["id"]: one for one in table(fmu, "report.csv")}
    assert {one["met"] for one in report.values()} == {"yes"}
    # the page of the FMU: the work equals heat and stored energy within 2e-6
    assert float(report["energy"]["highest"]) < 2e-6
