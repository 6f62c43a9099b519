"""An FMU parameter or an output is added by a line of the table and the file of its kernel."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass, fields, replace
from pathlib import Path
from typing import Annotated
from xml.etree import ElementTree

import numpy as np

from fmu_src.definition import Definition, Model
from fmu_src.hypoid_axle import DEFINITION
from fmu_src.model_description import model_description
from fmu_src.values import Values
from fmu_src.variable import declared_in, declared_outputs, in_order, output, parameter
from gearlube_core.dynamics.hypoid_axle import HypoidAxleParameters
from gearlube_core.number import Number, Output
from tests.helpers.each import each

FLOOR = parameter("mesh.frequency_floor", "Hz", "Lowest frequency of the mesh damping", start=50.0,
                  minimum=1.0, maximum=1e4, nominal=100.0, argument="frequency_floor")  # fmt: skip
NEW = output("mesh.new", "W", "Another output")
POWER = output("mesh.power", "W", "Power through the mesh", 1e3)
ROOT = Path(__file__).parents[2]
AXLE, PAIR = "gearlube_core/dynamics/hypoid_axle", "gearlube_core/dynamics/helical_pair/march"
MESH = "gearlube_core/dynamics/hypoid_mesh"
MODEL = "gearlube_core/dynamics/helical_model"
TABLES = ("variables", "helical_variables")
SNAPSHOT = Path(__file__).with_name("value_references.json")


class StandIn:
    """A model with one more output, and nothing to compile."""

    def __init__(self, arguments: dict[str, object], inputs: Sequence[float]) -> None:
        self.arguments = arguments
        self.outputs = np.arange(float(len(DEFINITION.output_names) + 1))

    def step(self, h: float, *inputs: float) -> None:
        pass

    def get_state(self) -> np.ndarray:
        return self.outputs

    def set_state(self, state: np.ndarray) -> None:
        pass


EXTENDED = replace(
    DEFINITION,
    variables=(*DEFINITION.variables, FLOOR, POWER),
    output_names=(*DEFINITION.output_names, POWER.name),
)


def defaults(definition: Definition) -> dict[str, object]:
    return {v.name: v.decoded(v.start or 0.0) for v in definition.variables if v.is_model_parameter}


def test_the_description_has_the_new_variables_behind_the_released_ones() -> None:
    root = ElementTree.fromstring(model_description(EXTENDED, "{0}"))
    found = {v.get("name"): v for v in root.iter("ScalarVariable")}
    for reference, name, _ in json.loads(SNAPSHOT.read_text()):
        assert found[name].get("valueReference") == str(reference)
    floor, power = found[FLOOR.name], found[POWER.name]
    assert (floor.get("causality"), power.get("causality")) == ("parameter", "output")
    assert (floor[0].get("start"), power[0].get("unit")) == ("50", "W")
    listed = [int(u.get("index", 0)) for u in root.find("ModelStructure/Outputs") or []]
    assert len(EXTENDED.variables) in listed  # counted from 1


def test_a_parameter_reaches_the_axle_by_the_name_of_its_field() -> None:
    assert FLOOR.argument in {field.name for field in fields(HypoidAxleParameters)}
    given = defaults(EXTENDED) | {FLOOR.name: 80.0}
    axle = EXTENDED.start_model(given, [60.0, 160.0, 313.15])
    assert axle.kernel_parameters.mesh.frequency_floor == 80.0  # type: ignore[attr-defined]
    plain = DEFINITION.start_model(defaults(DEFINITION), [60.0, 160.0, 313.15])
    assert plain.kernel_parameters.mesh.frequency_floor == 50.0  # type: ignore[attr-defined]


@dataclass(frozen=True, slots=True, kw_only=True)
class Sticky(HypoidAxleParameters):
    adhesion: Annotated[
        float, Number("N", 0.0, 9.0, text="Adhesion of the teeth", fmi="mesh.adhesion")
    ] = 0.25


def test_a_number_that_declares_an_fmi_name_is_a_parameter_without_a_line_of_the_table() -> None:
    known = {one.argument for one in DEFINITION.variables}
    assert declared_in(Sticky, known) == (
        parameter("mesh.adhesion", "N", "Adhesion of the teeth", start=0.25, minimum=0.0,
                  maximum=9.0, argument="adhesion"),
    )  # fmt: skip
    assert declared_in(Sticky, known | {"adhesion"}) == ()


def test_an_output_that_is_declared_beside_its_kernel_needs_no_line_of_the_table() -> None:
    declared = declared_outputs([Output("mesh.power", "W", "Power through the mesh", 1e3)])
    assert declared == (POWER,)
    # those of a release keep their order and places, whatever is declared before them later
    mixed = in_order(["mesh.power", "mesh.frequency_floor"], NEW, FLOOR, POWER)
    assert mixed == (POWER, FLOOR, NEW)


def test_an_output_of_the_model_lands_on_its_value_reference() -> None:
    definition = replace(EXTENDED, start=StandIn)
    model: Model = definition.start_model(defaults(definition), [60.0, 160.0, 313.15])
    values = Values(definition, lambda problem: None)
    values.store_outputs(model.outputs)
    assert values.array[definition.references[POWER.name]] == model.outputs[-1]


def naming(text: str, *folders: str) -> set[str]:
    """Return the source files that hold a text."""
    files = (path for folder in folders for path in (ROOT / folder).rglob("*.py"))
    return {path.relative_to(ROOT).as_posix() for path in files if text in path.read_text()}


@each(
    ("folder", "table", "name", "kernel"),
    [
        (AXLE, "variables", '"mesh.stiffness"', "output_names"),
        (AXLE, "variables", '"axle.efficiency"', "output_names"),
        (AXLE, "variables", "roller_load_min", "output_names"),
        (MODEL, "helical_variables", '"mesh.coast_contact"', "outputs"),
        (MODEL, "helical_variables", '"pair.efficiency"', "outputs"),
        (PAIR, "helical_variables", "film_thickness_mean", "line_outputs"),
    ],
)
def test_an_output_is_named_in_the_table_and_beside_its_kernel_only(
    folder: str, table: str, name: str, kernel: str
) -> None:
    in_tables = naming(name, "fmu_src")  # both FMUs may have an output of one name
    assert f"fmu_src/{table}.py" in in_tables <= {f"fmu_src/{t}.py" for t in TABLES}
    assert naming(name, folder) == {f"{folder}/{kernel}.py"}


def test_a_number_of_the_mesh_force_is_declared_in_the_file_of_its_kernel_only() -> None:
    assert naming(str(FLOOR.argument), "fmu_src", "gearlube_core") == {f"{MESH}/mesh_force.py"}
