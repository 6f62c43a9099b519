from __future__ import annotations

import json
import subprocess
import sys
import zipfile
from pathlib import Path
from xml.etree import ElementTree

import fmpy
import pytest
from lxml import etree

from fmu_src.check import fmpy_problems, fmutool_problems
from fmu_src.documentation import variables_markdown
from tests.helpers.fmu_cases import CASES, Case

ROOT = Path(__file__).parents[2]

# exponents of kg, m, s, K, rad, written down from the definitions of the units
DIMENSIONS = {
    "1": (0, 0, 0, 0, 0),
    "m": (0, 1, 0, 0, 0),
    "rad": (0, 0, 0, 0, 1),
    "rad/s": (0, 0, -1, 0, 1),
    "rad/s2": (0, 0, -2, 0, 1),
    "m/s": (0, 1, -1, 0, 0),
    "m/s2": (0, 1, -2, 0, 0),
    "Hz": (0, 0, -1, 0, 0),
    "kg": (1, 0, 0, 0, 0),
    "kg.m2": (1, 2, 0, 0, 0),
    "m3": (0, 3, 0, 0, 0),
    "N": (1, 1, -2, 0, 0),
    "N/m": (1, 0, -2, 0, 0),
    "N/m2": (1, -1, -2, 0, 0),
    "N.m": (1, 2, -2, 0, 0),
    "N.m.s/rad": (1, 2, -1, 0, -1),
    "s": (0, 0, 1, 0, 0),
    "N.m/s": (1, 2, -3, 0, 0),
    "Pa": (1, -1, -2, 0, 0),
    "J": (1, 2, -2, 0, 0),
    "W": (1, 2, -3, 0, 0),
    "K": (0, 0, 0, 1, 0),
}


@pytest.fixture(scope="module")
def description(fmu_folder: Path) -> ElementTree.Element:
    return ElementTree.parse(fmu_folder / "modelDescription.xml").getroot()


def test_the_description_obeys_the_schema_of_the_standard(fmu_folder: Path) -> None:
    schema = Path(fmpy.__file__).parent / "schema" / "fmi2" / "fmi2ModelDescription.xsd"
    validator = etree.XMLSchema(etree.parse(str(schema)))
    validator.validate(etree.parse(str(fmu_folder / "modelDescription.xml")))
    assert list(validator.error_log) == []


@pytest.mark.slow
def test_fmpy_finds_no_problem(fmu_path: Path) -> None:
    assert fmpy_problems(fmu_path) == []


def test_fmutool_finds_no_problem(fmu_path: Path) -> None:
    assert fmutool_problems(fmu_path) == []


@pytest.mark.slow
def test_the_command_fmutool_check_is_content(fmu_path: Path) -> None:
    command = [str(Path(sys.executable).with_name("fmutool")), "-input", str(fmu_path), "-check"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    assert "compliant with FMI-2.0" in done.stdout + done.stderr


def test_names_and_value_references_are_those_of_the_first_release(case: Case) -> None:
    released = json.loads(Path(__file__).with_name(case.snapshot).read_text())
    table = case.definition.variables
    present = [[reference, v.name, v.type] for reference, v in enumerate(table)]
    assert present[: len(released)] == released
    assert len(present) == len(released), f"append the new variables to {case.snapshot}"


def test_every_output_of_the_model_is_an_output_of_the_fmu(case: Case) -> None:
    outputs = [v.name for v in case.definition.variables if v.is_computed]
    # younger variables stand at the end of the FMU's; each is found by its name
    assert sorted(outputs) == sorted(case.definition.output_names)
    assert len(outputs) == len(case.direct(0))


def test_every_real_has_a_unit_of_the_right_dimensions(
    description: ElementTree.Element, case: Case
) -> None:
    defined = {
        unit.get("name"): tuple(
            int(unit.find("BaseUnit").get(base, "0")) for base in ("kg", "m", "s", "K", "rad")
        )
        for unit in description.iter("Unit")
    }
    used = {name: DIMENSIONS[name] for name in DIMENSIONS if name not in case.units_unused}
    assert defined == used
    assert {real.get("unit") for real in description.iter("Real")} == set(used)


@pytest.mark.parametrize(
    ("unit", "display", "value", "shown"),
    [
        ("K", "degC", 273.15, 0.0),
        ("rad/s", "rpm", 104.71975511965977, 1000.0),  # 1000 rpm = 1000 * 2 pi / 60 rad/s
        ("rad", "deg", 3.141592653589793, 180.0),
        ("m", "um", 1e-6, 1.0),
        ("N", "kN", 2500.0, 2.5),
    ],
)
def test_display_units_convert_as_people_expect(
    description: ElementTree.Element, unit: str, display: str, value: float, shown: float
) -> None:
    element = description.find(f".//Unit[@name='{unit}']/DisplayUnit[@name='{display}']")
    converted = value * float(element.get("factor")) + float(element.get("offset", "0"))
    assert converted == pytest.approx(shown, rel=1e-14, abs=1e-12)  # rounding of the decimals


def test_quantities_are_shown_in_workshop_units(case: Case) -> None:
    shown = {v.name: v.display_unit for v in case.definition.variables}
    assert {name: shown[name] for name in case.display} == case.display


def test_every_variable_is_described_and_every_physical_range_is_closed(case: Case) -> None:
    table = case.definition.variables
    assert all(v.description for v in table)
    assert len({v.description for v in table}) == len(table)
    for variable in table:
        if not variable.is_computed:
            low, high = variable.range
            assert low <= variable.start <= high
            assert high < float("inf")


def test_sizes_and_the_default_run_are_round_numbers(case: Case) -> None:
    """One digit and a power of ten: sizes to scale with, a run to begin with."""
    definition = case.definition
    shown = {v.name: v.nominal for v in definition.variables if v.nominal is not None}
    shown |= {"stop time": definition.stop_time, "step size": definition.step_size}
    digits = {name: f"{value:.11e}".partition("e")[0] for name, value in shown.items()}
    rough = {name: text for name, text in digits.items() if float(text) not in (1, 2, 3, 5)}
    assert rough == {}
    # each output has a size above zero, in its own unit
    assert min(shown.values()) > 0.0
    assert definition.step_size < definition.stop_time


def test_outputs_do_not_feed_through_and_start_from_inputs_and_parameters(
    description: ElementTree.Element,
) -> None:
    variables = list(description.iter("ScalarVariable"))
    outputs = {str(i) for i, v in enumerate(variables, 1) if v.get("causality") == "output"}
    free = ("input", "parameter")
    known = {str(i) for i, v in enumerate(variables, 1) if v.get("causality") in free}
    structure = description.find("ModelStructure")
    for unknown in structure.find("Outputs"):
        assert unknown.get("dependencies") == ""
    for unknown in structure.find("InitialUnknowns"):
        assert set(unknown.get("dependencies").split()) == known
    for section in structure:
        assert {unknown.get("index") for unknown in section} == outputs


def test_the_capabilities_are_declared(description: ElementTree.Element) -> None:
    flags = description.find("CoSimulation").attrib
    for name in (
        "needsExecutionTool",
        "canHandleVariableCommunicationStepSize",
        "canGetAndSetFMUstate",
        "canSerializeFMUstate",
    ):
        assert flags[name] == "true"
    assert flags["canBeInstantiatedOnlyOncePerProcess"] == "false"
    assert description.find("DefaultExperiment") is not None


def test_the_archive_holds_documentation_licences_and_icon_but_no_physics(
    fmu_path: Path, case: Case
) -> None:
    with zipfile.ZipFile(fmu_path) as archive:
        names = set(archive.namelist())
        documentation = archive.read("documentation/index.html").decode()
    assert {"model.png", "modelDescription.xml", f"binaries/linux64/{case.name}.so"} <= names
    assert sum(name.startswith("documentation/licenses/") for name in names) == 2
    assert [name for name in names if name.endswith(".py")] == [f"resources/{case.script}"]
    assert all(variable.name in documentation for variable in case.definition.variables)


def test_no_path_of_the_building_machine_is_inside(fmu_path: Path) -> None:
    machine = {str(ROOT), str(Path.home()), str(fmu_path.parent), sys.prefix}
    with zipfile.ZipFile(fmu_path) as archive:
        content = b"".join(archive.read(name) for name in archive.namelist())
    assert [path for path in machine if path.encode() in content] == []


def test_the_page_about_the_fmu_shows_the_present_variables(case: Case) -> None:
    page = (ROOT / "docs" / "fmu.md").read_text()
    assert variables_markdown(case.definition).strip() in page
    numbers = [str(sum(bool(v.rate_of) for v in c.definition.variables)) for c in CASES]
    assert f"| continuous states | {' | '.join(numbers)} |" in page
