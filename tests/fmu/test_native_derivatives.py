"""Derivatives of the native gear models: their tangent against differences of eighth order."""

from __future__ import annotations

import numpy as np
import pytest

from fmu_src.native.model import Operation
from fmu_src.native.models import native_model
from tests.helpers.fmu_cases import CASES, HYPOID_AXLE
from tests.helpers.high_differences import difference
from tests.helpers.object_code import LoadedModel, NativeRun

PAIR = CASES[1]
TIMES = (0.0031, 0.0069, 0.0113, 0.0162, 0.0217, 0.0278)  # s, some places in a mesh period
ENTRIES = 25_000


@pytest.fixture(
    scope="module",
    params=[HYPOID_AXLE, pytest.param(PAIR, marks=pytest.mark.slow)],
    ids=lambda case: case.name,
)
def loaded(request: pytest.FixtureRequest) -> LoadedModel:
    return LoadedModel(native_model(request.param.definition))


def started(loaded: LoadedModel, values: dict[str, str]) -> NativeRun:
    inputs = [v.start for v in loaded.model.definition.variables if v.causality == "input"]
    run = loaded.instance(values, inputs)
    assert run(Operation.START) == 0
    return run


def knowns(run: NativeRun) -> list[tuple[int, float]]:
    """Return place in the state and typical size there of continuous states and inputs."""
    definition, exchange = run.model.definition, run.model.exchange
    assert exchange
    sizes = {v.name: v.nominal or 1.0 for v in definition.variables}
    inputs = [v.name for v in definition.variables if v.causality == "input"]
    of_states = zip(exchange.states, exchange.places, strict=True)
    return [(place, sizes[name]) for name, place in of_states] + [
        (exchange.inputs_at + i, sizes[name]) for i, name in enumerate(inputs)
    ]


def real_outputs(run: NativeRun) -> np.ndarray:
    kinds = {v.name: v.type for v in run.model.definition.variables}
    names = run.model.definition.output_names
    return np.array([i for i, name in enumerate(names) if kinds[name] == "Real"])


def outputs_at(run: NativeRun, state: np.ndarray) -> np.ndarray:
    before = run.state.copy()
    run.state[:] = state
    assert run(Operation.OUTPUTS) == 0
    run.state[:] = before
    return run.outputs.copy()


def jacobians(run: NativeRun) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return derivatives of all Reals by the tangent and by differences, and the latter's error.

    Each is over the largest of its row. The error is infinite where the differences of another
    step do not confirm them.
    """
    here, reals = run.state.copy(), real_outputs(run)
    found, wanted, errors = [], [], []
    for place, size in knowns(run):
        along = np.zeros_like(here)
        along[place] = size
        best, error = difference(lambda h, along=along: outputs_at(run, here + h * along)[reals])
        found.append(run.changes(Operation.OUTPUTS, along)[reals])
        wanted.append(best)
        errors.append(error)
    rows = np.abs(wanted).max(axis=0)
    rows[rows == 0.0] = 1.0
    return np.array(found) / rows, np.array(wanted) / rows, np.array(errors) / rows


@pytest.mark.slow
def test_derivatives_are_exact_to_one_part_in_a_billion(loaded: LoadedModel) -> None:
    run, last = started(loaded, {}), 0.0
    entries, confirmed, typical = 0, 0, []
    for time in TIMES:
        assert run.step(time - last) == 0
        last = time
        assert run(Operation.EVENT) == 0
        found, wanted, error = jacobians(run)
        apart = np.abs(found - wanted)
        known = error < 3e-10
        assert apart[known].max() < 1e-9
        # what rounding of the differences hides: rows of derivatives that are almost 0
        assert np.all(apart[~known] <= error[~known])
        entries, confirmed = entries + known.size, confirmed + known.sum()
        typical.append(np.median(apart[known & (wanted != 0.0)]))
    assert entries > ENTRIES
    # what the reference can judge; of the pair, with rows near 0, it is 98 %
    assert confirmed > 0.97 * entries
    assert max(typical) < 1e-12


def test_a_direction_knows_nothing_of_those_before(loaded: LoadedModel) -> None:
    options = (
        {} if loaded.model.definition.name == "HypoidAxle" else {"stiffness_model": "line_mesh"}
    )
    run = started(loaded, options)
    assert run.step(0.0047) == 0
    rng = np.random.default_rng(4)
    here, sizes = run.state.copy(), np.zeros_like(run.state)
    for place, size in knowns(run):
        sizes[place] = size
    directions = rng.uniform(-1.0, 1.0, (5, here.size)) * sizes
    alone = []
    for along in directions:
        run.of_work[:] = 0.0
        alone.append(run.changes(Operation.OUTPUTS, along))
    for along in directions:  # each after one elsewhere
        run.state[:] = here + 1e-3 * sizes
        run.changes(Operation.DERIVATIVES, along)
        run.state[:] = here
        np.testing.assert_array_equal(run.changes(Operation.OUTPUTS, along), alone.pop(0))
