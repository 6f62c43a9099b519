"""Parameters of the helical pair as its FMU takes them: by name, drawn, and in Python."""

from __future__ import annotations

from collections.abc import Callable
from importlib.resources import files
from pathlib import Path
from typing import Any

import numpy as np

from fmu_src.helical_pair import definition_with
from fmu_src.helical_variables import HELICAL_PAIR
from fmu_src.native.helical_pair import native_model
from fmu_src.native.model import NativeModel
from gearlube_core.dynamics.helical_model.model import HelicalPairModel

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
