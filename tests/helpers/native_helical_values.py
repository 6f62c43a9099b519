"""Parameters of the helical pair as its FMU takes them: by name, drawn, and in Python."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from importlib.resources import files
from pathlib import Path
from typing import Any, get_type_hints

import numpy as np

from fmu_src.helical_pair import definition_with
from fmu_src.helical_variables import HELICAL_PAIR
from fmu_src.native.helical_pair import native_model
from fmu_src.native.helical_parameters import MEMORY_AT, NUMBERS_AT, PLAN_AT, TRIAL_AT
from fmu_src.native.model import OK, NativeModel, Operation
from gearlube_core.dynamics.helical_model.model import HelicalPairModel
from gearlube_core.dynamics.train.assemble import Assembly
from gearlube_core.dynamics.train.elements.helical_mesh_kernels import TABLE
from gearlube_core.dynamics.train.plan import OF_TABLES
from gearlube_core.kernels.flat_tuples import count_floats
from tests.helpers.object_code import NativeRun

PARAMETERS = tuple(v for v in HELICAL_PAIR if v.is_model_parameter)
NOT_GIVEN_IF_0 = {
    "mesh.stiffness_density",
    "support.radial_stiffness",
    "support.axial_stiffness",
    "support.bearing_distance",
}


def values_of(**settings: float | str) -> list[float]:
    """Values of all FMI parameters in their order, by name with __ for the dot."""
    given = {name.replace("__", "."): value for name, value in settings.items()}
    values = []
    for variable in PARAMETERS:
        value = given.pop(variable.name, variable.start)
        literal = isinstance(value, str)
        values.append(1.0 + variable.literals.index(value) if literal else float(value))
    assert not given
    return values


def named(values: list[float]) -> dict[str, Any]:
    return {v.name: v.decoded(value) for v, value in zip(PARAMETERS, values, strict=True)}


def python_model(model: NativeModel, values: list[float], inputs: list[float]) -> HelicalPairModel:
    pair = model.definition.start_model(named(values), inputs)
    assert isinstance(pair, HelicalPairModel)
    return pair


def random_values(rng: np.random.Generator) -> list[float]:
    """Any legal parameters of a shipped pair; those of bearings given or not."""
    values: dict[str, float] = {}
    for variable in PARAMETERS:
        low, high = variable.range
        value = rng.uniform(low, high)
        if variable.literals or variable.type == "Integer":
            value = float(rng.integers(low, high + 1.0))
        if variable.name in NOT_GIVEN_IF_0:
            value *= float(rng.integers(0, 2))
        values[variable.name] = value
    values["gear.name"] = float(rng.integers(1, 4))  # no gear file, no custom pair
    if values["gear.name"] > 1.0:
        values["mesh.stiffness_model"] = 1.0
    if values["mesh.stiffness_model"] == 2.0:
        values["mesh.stiffness_density"] = 0.0
    return list(values.values())


def usual_values(rng: np.random.Generator) -> list[float]:
    """The same with stiffness, backlash and roughness of gears, so that there is a start."""
    values = dict(zip((v.name for v in PARAMETERS), random_values(rng), strict=True))
    for variable in PARAMETERS:
        if variable.nominal is not None and values[variable.name] != 0.0:
            low, high = variable.range
            value = variable.nominal * 10.0 ** rng.uniform(-1.0, 1.0)
            values[variable.name] = min(max(value, low), high)
    return list(values.values())


def own_gear(folder: Path, edit: Callable[[str], str]) -> NativeModel:
    """Return the native model with the gear file of he_2007, edited."""
    shipped = files("gearlube_core.helical_geometry") / "data" / "he_2007.toml"
    path = folder / "own.toml"
    path.write_text(edit(shipped.read_text()))
    return native_model(definition_with(path))


def check_train(native: NativeRun, made: Assembly, memory: int | None = None) -> None:
    """Numbers, plan and memory in the work array, so much of it, are those of a train in Python."""
    np.testing.assert_array_equal(native.work[NUMBERS_AT:PLAN_AT], made.numbers)
    plan, by_table = native.work[PLAN_AT:TRIAL_AT].view(np.int64), np.array(made.shape) == OF_TABLES
    np.testing.assert_array_equal(plan[by_table], made.plan[by_table])
    end = made.memory[:-1].size if memory is None else memory
    found = native.work[MEMORY_AT + TABLE : MEMORY_AT + end]  # behind what a step leaves
    np.testing.assert_array_equal(found, made.memory[TABLE:end])


def accepts(run: NativeRun, **literals: int) -> bool:
    """Whether the library takes the constants, as it asks when the FMU is loaded."""
    counts = {v.argument: len(v.literals) for v in run.model.definition.variables
              if v.is_model_parameter}  # fmt: skip
    lengths = np.array([run.model.data.size, run.model.work_size], dtype=float)
    options = np.array([*(counts | literals).values()], dtype=float)
    return replace(run, parameters=lengths, inputs=options)(Operation.CHECK) == OK


def places_of(kind: type) -> list[int]:
    """Return where each field of a tuple class begins among its floats."""
    sizes = [1 if part is float else count_floats(part) for part in get_type_hints(kind).values()]
    return [sum(sizes[:i]) for i in range(len(sizes))]
