"""Compile a model before its first real step, so that no simulation step waits for it."""

from __future__ import annotations

from functools import cache

from fmu_src.definition import Definition
from gearlube_core.errors import GearLubeError

_SHORT_STEP = 1e-6  # s


@cache
def compile_ahead(definition: Definition) -> str:
    """Run a temporary model for one step, once per process; return an error text, or ''."""
    table = definition.variables
    parameters = {v.name: v.decoded(v.start or 0.0) for v in table if v.is_model_parameter}
    inputs = [v.start or 0.0 for v in table if v.causality == "input"]
    try:
        definition.start_model(parameters, inputs).step(_SHORT_STEP, *inputs)
    except GearLubeError as error:
        return f"The model could not be run ahead of the simulation. {error}"
    return ""
