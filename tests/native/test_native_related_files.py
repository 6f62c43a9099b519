"""What a native FMU says about itself is complete, valid, repeatable and true."""

from __future__ import annotations

import csv
import hashlib
import io
import posixpath
import re
import zipfile
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from lxml import etree

from fmu_src.check import fmpy_problems
from fmu_src.native import build
from fmu_src.native.build import NativeOptions, build_native, fmi2_content
from fmu_src.native.related_files import FOLDER, MANIFEST, META_DATA, STANDARD, Run, described
from tests.helpers.schemas import FMI_3, SSP_1, SSP_2, complaints, srmd_complaints
from tests.helpers.small_native_builds import LINUX, MODEL

NAMES = MODEL.definition.output_names
ROLES = (
    "document|requirement|model|parameter|experiment/(smoke-test|uncertainty-analysis)|testcase|"
    "result|report|meta-data"
)
LS = "{http://fmi-standard.org/fmi-ls-manifest}"


def run_with(**outputs: float) -> Run:
    """Return three rows of inputs at their start and outputs of 1, some of them others."""
    found = np.ones((3, len(NAMES)))
    for name, value in outputs.items():
        found[1, NAMES.index(name.replace("__", "."))] = value
    return Run(1e-3 * np.arange(3), np.tile([3.0, 1.0, 313.15], (3, 1)), found)


def table(content: bytes) -> list[dict[str, str]]:
    return list(csv.DictReader(io.StringIO(content.decode())))


ARCHIVE = fmi2_content(MODEL, {})
FILES = described(MODEL, ARCHIVE, run_with())


def test_the_same_model_gives_the_same_bytes() -> None:
    assert described(MODEL, dict(ARCHIVE), run_with()) == FILES
    assert described(MODEL, ARCHIVE, run_with(pinion__speed=2.0)) != FILES


@pytest.mark.slow
def test_a_build_repeats_its_bytes_and_describes_both_versions(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(build, "reference_run", lambda definition: run_with())
    built = [
        build_native(MODEL, tmp_path / name, NativeOptions(platforms=[LINUX.name]))
        for name in ("first", "second")
    ]
    for first, second in zip(*built, strict=True):
        assert first.read_bytes() == second.read_bytes()
        with zipfile.ZipFile(first) as archive:
            assert {*FILES} <= {*archive.namelist()}
        assert fmpy_problems(first) == []
    options = NativeOptions(platforms=[LINUX.name], fmi=["2"], reference=False)
    (plain,) = build_native(MODEL, tmp_path / "plain", options)
    with zipfile.ZipFile(plain) as archive:
        assert not {*FILES} & {*archive.namelist()}


def test_the_manifest_names_every_file_of_its_folder_and_no_other_that_is_missing() -> None:
    root = etree.fromstring(FILES[MANIFEST])
    named = [posixpath.normpath(f"{FOLDER}/{one.get('source')}") for one in root]
    assert len(named) == len(set(named))
    assert set(named) <= {*ARCHIVE, *FILES}
    assert {*FILES} - {*named} == {MANIFEST}
    assert all(re.fullmatch(ROLES, one.get("role")) and one.get("description") for one in root)
    roles = {one.get("role") for one in root}
    assert {"experiment/smoke-test", "testcase", "result", "parameter", "requirement", "report",
            "meta-data", "document"} <= roles  # fmt: skip


def test_the_manifest_says_which_layered_standard_it_obeys() -> None:
    """The three attributes that FMI 3.0 asks for, with the values of FMI-LS-REF."""
    root = etree.fromstring(FILES[MANIFEST])
    schema = etree.parse(str(FMI_3 / "fmi3LayeredStandardManifest.xsd"))
    names = {one.get("name") for one in schema.getroot().iterfind("{*}attribute")}
    assert {f"{LS}{name}" for name in names} == set(root.attrib)
    assert root.get(f"{LS}fmi-ls-name") == "org.fmi-standard.fmi-ls-ref"
    assert root.get(f"{LS}fmi-ls-version") == STANDARD == "1.0.0-beta.1"


@pytest.mark.parametrize("folder", [SSP_1, SSP_2])
def test_parameter_sets_obey_the_schemas_of_ssp_1_and_2(folder) -> None:  # type: ignore[no-untyped-def]
    schema = folder / "SystemStructureParameterValues.xsd"
    sets = {path: content for path, content in FILES.items() if path.endswith(".ssv")}
    assert list(sets) == [f"{FOLDER}/default.ssv"]
    for content in sets.values():
        assert complaints(schema, content) == []
        assert complaints(schema, content.replace(b"<ssv:Real value", b"<ssv:Real vale")) != []


def test_the_default_set_holds_every_parameter_at_its_start() -> None:
    root = etree.fromstring(FILES[f"{FOLDER}/default.ssv"])
    found = {one.get("name"): one[0].get("value") for one in root.iter("{*}Parameter")}
    assert found == {
        "mass.inertia": "0.5", "drag.coefficient": "0.25", "pinion.speed_start": "2",
        "solver.substeps": "16", "drag.braked": "false", "drag.law.number": "1",
    }  # fmt: skip


@pytest.mark.slow
def test_meta_data_obey_the_schema_of_srmd() -> None:
    assert srmd_complaints(FILES[META_DATA]) == []
    assert srmd_complaints(FILES[META_DATA].replace(b"keyword=", b"key=")) != []


def test_every_file_but_the_meta_data_has_its_checksum() -> None:
    """SHA3-256 of FIPS 202, as SRMD 1.0 asks for."""
    root = etree.fromstring(FILES[META_DATA])
    found = {
        posixpath.normpath(f"{FOLDER}/{one.get('{http://www.w3.org/1999/xlink}href')}"): one.text
        for one in root.iter("{*}ClassificationEntry")
        if one.get("keyword") == "SHA3-256"
    }
    files = {**ARCHIVE, **FILES}
    del files[META_DATA]
    assert found == {name: hashlib.sha3_256(data).hexdigest() for name, data in files.items()}


def test_requirements_are_the_limits_of_the_variables_and_of_the_model() -> None:
    rows = {one["id"]: one for one in table(FILES[f"{FOLDER}/requirements.csv"])}
    limits = {name: (one["low"], one["high"], one["unit"]) for name, one in rows.items()}
    assert limits["step"] == ("0", "0.1", "s")
    assert limits["input.oil.temperature"] == ("273.15", "423.15", "K")
    assert limits["validity.range.torque"] == ("-30", "30", "N.m")
    assert limits["reference"] == ("0", "1e-06", "1")


def test_the_report_says_which_requirement_was_not_met() -> None:
    def report(run: Run) -> dict[str, dict[str, str]]:
        content = described(MODEL, ARCHIVE, run)[f"{FOLDER}/report.csv"]
        return {one["id"]: one for one in table(content)}

    assert {one["met"] for one in report(run_with()).values()} == {"yes"}
    found = report(run_with(range__torque=-31.0, range__pressure=31.0, range__film_load=0.0))
    unmet = [name for name, one in found.items() if one["met"] != "yes"]
    assert unmet == ["validity.range.torque", "validity.range.pressure"]
    # 0: not in use at that moment
    assert found["validity.range.film_load"]["lowest"] == "1"


@pytest.mark.parametrize(
    ("work", "heat", "stored", "met"),
    [(100.0, 60.0, 40.0, "yes"), (100.0, 60.0, 40.01, "no"), (0.0, 0.0, 0.0, "not in use")],
)
def test_the_report_counts_the_energy_that_is_missing(
    work: float, heat: float, stored: float, met: str
) -> None:
    energies = {"energy.pinion_work": work, "energy.friction": heat, "energy.stored": stored}
    names = (*NAMES, *energies)
    model = replace(MODEL, definition=replace(MODEL.definition, output_names=names))
    time, inputs, outputs = run_with()
    more = np.outer([0.0, 0.5, 1.0], [*energies.values()])
    run = Run(time, inputs, np.hstack([outputs, more]))
    rows = {one["id"]: one for one in table(described(model, ARCHIVE, run)[f"{FOLDER}/report.csv"])}
    assert rows["energy"]["met"] == met
