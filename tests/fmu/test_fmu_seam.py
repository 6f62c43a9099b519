"""An FMU parameter and an output are added by a line of the table and what the model has."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import fields, replace
from pathlib import Path
from xml.etree import ElementTree

import numpy as np

from fmu_src.definition import Definition, Model
from fmu_src.hypoid_axle import DEFINITION
from fmu_src.model_description import model_description
from fmu_src.values import Values
from fmu_src.variable_kinds import output, parameter
from gearlube_core.dynamics.hypoid_axle import HypoidAxleParameters

LOSS = parameter("mesh.hysteretic_loss", "1", "Coefficient of the mesh damping", start=0.009,
                 minimum=0.0, maximum=0.5, nominal=0.01, argument="hysteretic_loss")  # fmt: skip
POWER = output("mesh.power", "W", "Power through the mesh", 1e3)
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
    variables=(*DEFINITION.variables, LOSS, POWER),
    output_names=(*DEFINITION.output_names, POWER.name),
)


def defaults(definition: Definition) -> dict[str, object]:
    return {
        v.name: v.decoded(v.start or 0.0)
        for v in definition.variables
        if v.causality == "parameter"
    }


def test_the_description_has_the_new_variables_behind_the_released_ones() -> None:
    root = ElementTree.fromstring(model_description(EXTENDED, "{0}"))
    found = {v.get("name"): v for v in root.iter("ScalarVariable")}
    for reference, name, _ in json.loads(SNAPSHOT.read_text()):
        assert found[name].get("valueReference") == str(reference)
    loss, power = found[LOSS.name], found[POWER.name]
    assert (loss.get("causality"), power.get("causality")) == ("parameter", "output")
    assert (loss[0].get("start"), power[0].get("unit")) == ("0.009", "W")
    listed = [int(u.get("index", 0)) for u in root.find("ModelStructure/Outputs") or []]
    assert len(EXTENDED.variables) in listed  # counted from 1


def test_a_parameter_reaches_the_axle_by_the_name_of_its_field() -> None:
    assert LOSS.argument in {field.name for field in fields(HypoidAxleParameters)}
    given = defaults(EXTENDED) | {LOSS.name: 0.02}
    axle = EXTENDED.start_model(given, [60.0, 160.0, 313.15])
    assert axle.kernel_parameters.loss == 0.02  # type: ignore[attr-defined]
    plain = DEFINITION.start_model(defaults(DEFINITION), [60.0, 160.0, 313.15])
    assert plain.kernel_parameters.loss == 0.009  # type: ignore[attr-defined]


def test_an_output_of_the_model_lands_on_its_value_reference() -> None:
    definition = replace(EXTENDED, start=StandIn)
    model: Model = definition.start_model(defaults(definition), [60.0, 160.0, 313.15])
    values = Values(definition, lambda problem: None)
    values.store_outputs(model.outputs)
    assert values.array[definition.references[POWER.name]] == model.outputs[-1]
