from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from fmu_host import OK, Host

from fmu_src.hypoid_axle import ARGUMENTS, DEFINITION
from gearlube_core.dynamics.hypoid_axle import OUTPUT_NAMES, HypoidAxle, mohammadpour_2015_axle
from gearlube_core.errors import ParameterError

H = 2.0**-10  # s; exact in binary, so that t + h is exact too


def _direct(steps: int, speed: float, torques: list[tuple[float, float]], **settings: float):
    axle = HypoidAxle(mohammadpour_2015_axle(**settings))
    axle.initialise(
        pinion_speed=speed,
        pinion_torque=torques[0][0],
        wheel_torque=torques[0][1],
        oil_temperature=333.15,
    )
    for k in range(steps):
        axle.step(H, *torques[k], 333.15)
    return axle.outputs.tolist()


def test_the_fmu_gives_the_numbers_of_the_model_bit_for_bit(host: Host) -> None:
    torques = [(80.0 + 5.0 * np.sin(k), 200.0 + 10.0 * np.cos(k)) for k in range(20)]
    host.start(
        bearing__preload=4000.0, oil__name=2, pinion__speed_start=150.0, oil__temperature=333.15,
        pinion__torque=torques[0][0], wheel__torque=torques[0][1],
    )  # fmt: skip
    for pinion, wheel in torques:
        host.set(pinion__torque=pinion, wheel__torque=wheel)
        assert host.step(H) == OK
    expected = _direct(20, 150.0, torques, bearing_preload=4000.0, oil="karagiannis_2012")
    assert host.outputs() == expected


@pytest.mark.parametrize(
    ("variable", "argument", "literals"),
    [
        (v.name, ARGUMENTS[v.name], v.literals)
        for v in DEFINITION.variables
        if v.type == "Enumeration"
    ],
)
def test_each_literal_of_an_option_selects_the_option_of_the_model(
    new_host: Callable[[], Host], variable: str, argument: str, literals: tuple[str, ...]
) -> None:
    for value, literal in enumerate(literals, start=1):
        host = new_host()
        host.set_named({variable: value})
        host.start(oil__temperature=333.15, pinion__torque=60.0, wheel__torque=160.0)
        assert host.step(H) == OK
        assert host.outputs() == _direct(1, 200.0, [(60.0, 160.0)], **{argument: literal})


@pytest.mark.parametrize(
    ("variable", "argument"),
    [
        (v.name, argument)
        for v in DEFINITION.variables
        if (argument := ARGUMENTS.get(v.name)) and v.type != "Enumeration"
    ],
)
def test_ranges_in_the_table_are_those_of_the_model(variable: str, argument: str) -> None:
    entry = DEFINITION.variables[DEFINITION.references[variable]]
    kind = int if entry.type == "Integer" else float
    low, high = (kind(limit) for limit in entry.range)
    mohammadpour_2015_axle(**{argument: low})
    mohammadpour_2015_axle(**{argument: high})
    for outside in (low - abs(low) * 0.1 - 1e-12, high * 1.1 + 1e-12):
        value = kind(np.floor(outside) if outside < low else np.ceil(outside)) if (
            kind is int
        ) else outside  # fmt: skip
        with pytest.raises(ParameterError):
            mohammadpour_2015_axle(**{argument: value})


def test_the_start_equilibrium_is_read_before_the_first_step(host: Host) -> None:
    host.start(pinion__torque=60.0, wheel__torque=160.0, oil__temperature=333.15)
    axle = HypoidAxle(mohammadpour_2015_axle())
    axle.initialise(
        pinion_speed=200.0, pinion_torque=60.0, wheel_torque=160.0, oil_temperature=333.15
    )
    assert host.outputs() == axle.outputs.tolist()
    assert len(host.outputs()) == len(OUTPUT_NAMES)


def test_results_do_not_depend_on_the_communication_step(new_host: Callable[[], Host]) -> None:
    end = 0.03125  # s
    results = []
    for h in (2.0**-13, 2.0**-10, 2.0**-7):
        host = new_host()
        host.start(pinion__torque=60.0, wheel__torque=160.0)
        assert host.step(h, round(end / h)) == OK
        results.append(host.get("pinion.speed", "mesh.dte", "mesh.force", "bearing[1].force.x"))
    finest = np.array(results[0])
    for result in results[1:]:
        # RK4 at 22 steps in the shortest period: the step rounds to fit the communication step
        np.testing.assert_allclose(result, finest, rtol=2e-4)
