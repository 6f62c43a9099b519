from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from gearlube_core.errors import ParameterError
from tests.helpers.each import each
from tests.helpers.fmu_cases import CASES, Case, H
from tests.helpers.fmu_host import OK, Host


@pytest.mark.slow
def test_the_fmu_gives_the_numbers_of_the_model_bit_for_bit(case: Case, host: Host) -> None:
    pinion, wheel = case.torques
    torques = [(pinion + 5.0 * np.sin(k), wheel + 10.0 * np.cos(k)) for k in range(20)]
    host.start(
        **case.changed, oil__temperature=333.15,
        pinion__torque=torques[0][0], wheel__torque=torques[0][1],
    )  # fmt: skip
    for pinion, wheel in torques:
        host.set(pinion__torque=pinion, wheel__torque=wheel)
        assert host.step(H) == OK
    speed = case.changed["pinion.speed_start"]
    literals = dict(case.enumerations())
    settings = {
        case.arguments[name]: literals[name][int(value) - 1] if name in literals else value
        for name, value in case.changed.items()
        if name in case.arguments
    }
    assert host.outputs() == case.direct(20, speed=speed, torques=torques, **settings)


@pytest.mark.slow
def test_each_literal_of_an_option_selects_the_option_of_the_model(
    case: Case, new_host: Callable[[], Host]
) -> None:
    for variable, literals in case.enumerations():
        for value, literal in enumerate(literals, start=1):
            if literal == "custom":  # needs a gear file, see test_fmu_gear_file
                continue
            host = new_host()
            host.set_named({variable: value})
            host.start(oil__temperature=333.15)
            assert host.step(H) == OK
            assert host.outputs() == case.direct(1, **{case.arguments[variable]: literal})


@each(
    ("case", "variable"),
    [
        (case, v.name)
        for case in CASES
        for v in case.definition.variables
        if v.name in case.arguments and v.type != "Enumeration"
    ],
)
def test_ranges_in_the_table_are_those_of_the_model(case: Case, variable: str) -> None:
    entry = case.definition.variables[case.definition.references[variable]]
    argument = case.arguments[variable]
    kind = int if entry.type == "Integer" else float
    low, high = (kind(limit) for limit in entry.range)
    case.parameters(**{argument: low})
    case.parameters(**{argument: high})
    for outside in (low - abs(low) * 0.1 - 1e-12, high * 1.1 + 1e-12):
        value = kind(np.floor(outside) if outside < low else np.ceil(outside)) if (
            kind is int
        ) else outside  # fmt: skip
        with pytest.raises(ParameterError):
            case.parameters(**{argument: value})


def test_the_start_equilibrium_is_read_before_the_first_step(case: Case, host: Host) -> None:
    host.start(oil__temperature=333.15)
    assert host.outputs() == case.direct(0)


@pytest.mark.slow
def test_results_do_not_depend_on_the_communication_step(
    case: Case, new_host: Callable[[], Host]
) -> None:
    end = 0.03125  # s
    results = []
    for h in (2.0**-13, 2.0**-10, 2.0**-7):
        host = new_host()
        host.start()
        assert host.step(h, round(end / h)) == OK
        results.append(host.get("pinion.speed", "mesh.dte", "bearing[1].force.x", case.load))
    finest = np.array(results[0])
    for result in results[1:]:
        # RK4 with a few steps in the shortest period: the step rounds to fit the communication step
        np.testing.assert_allclose(result, finest, rtol=2e-4)
