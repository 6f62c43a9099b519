from __future__ import annotations

import threading
import time
from collections.abc import Callable
from pathlib import Path

import pytest

from tests.helpers.fmu_cases import Case
from tests.helpers.fmu_host import DISCARD, OK, Host


def test_reset_gives_a_fresh_instance(case: Case, new_host: Callable[[], Host]) -> None:
    used, fresh = new_host(), new_host()
    used.start(**case.changed, pinion__torque=90.0)
    used.step(count=4)
    used.slave.reset()
    names = [*case.changed, "pinion.torque"]
    assert used.get(*names) == [case.start(name) for name in names]
    for host in (used, fresh):
        assert host.start() == OK
        assert host.step(count=4) == OK
    assert used.outputs() == fresh.outputs()


def test_reset_heals_an_instance_that_failed(host: Host) -> None:
    host.start()
    host.set(pinion__torque=float("nan"))
    assert host.step() == DISCARD
    host.slave.reset()
    assert host.start() == OK
    assert host.step() == OK


@pytest.mark.slow
def test_two_instances_in_turn_equal_two_alone(case: Case, new_host: Callable[[], Host]) -> None:
    settings = ({}, case.changed)
    alone = []
    for values in settings:
        host = new_host()
        host.start(**values)
        host.step(count=6)
        alone.append(host.outputs())
    pair = [new_host(), new_host()]
    for host, values in zip(pair, settings, strict=True):
        host.start(**values)
    for _ in range(6):
        for host in pair:
            host.step()
    assert [host.outputs() for host in pair] == alone
    assert alone[0] != alone[1]


def test_two_threads_do_not_disturb_each_other(new_host: Callable[[], Host]) -> None:
    settings = ({"pinion__torque": 50.0}, {"pinion__torque": 75.0})
    alone = []
    for values in settings:
        host = new_host()
        host.start(**values)
        host.step(count=50)
        alone.append(host.outputs())
    pair = [new_host(), new_host()]

    def run(host: Host, values: dict[str, float]) -> None:
        host.start(**values)
        host.step(count=50)

    threads = [
        threading.Thread(target=run, args=arguments)
        for arguments in zip(pair, settings, strict=True)
    ]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert [host.outputs() for host in pair] == alone


def test_a_simulation_may_start_at_any_time(new_host: Callable[[], Host]) -> None:
    at_zero, later = new_host(), new_host()
    at_zero.start()
    later.start(start_time=1000.0)
    assert later.step(count=4) == OK
    at_zero.step(count=4)
    assert later.outputs() == at_zero.outputs()


def test_parameters_may_be_set_inside_initialisation_mode(
    case: Case, new_host: Callable[[], Host]
) -> None:
    before, inside = new_host(), new_host()
    changed = {case.real: case.changed[case.real]}
    before.start(**changed)
    inside.slave.setupExperiment()
    inside.slave.enterInitializationMode()
    assert inside.get("bearing[1].force.x") != before.get("bearing[1].force.x")
    inside.set(**changed)
    assert inside.get("bearing[1].force.x") == before.get("bearing[1].force.x")
    inside.slave.exitInitializationMode()
    assert inside.outputs() == before.outputs()


def test_outputs_hold_until_the_next_step(host: Host) -> None:
    host.start()
    host.step()
    held = host.outputs()
    host.set(pinion__torque=81.0)
    assert host.outputs() == held
    assert host.step() == OK
    assert host.outputs() != held


def test_the_first_step_does_not_wait_for_a_compiler(host: Host) -> None:
    host.start()
    begin = time.perf_counter()
    host.step(1e-4)
    # a step takes some 0.1 ms; compiling the kernels takes seconds
    assert time.perf_counter() - begin < 0.1


def test_the_log_tells_what_the_model_was_initialised_with(case: Case, host: Host) -> None:
    host.start(**{case.option: 2})
    event = host.messages("logEvents")
    literals = dict(case.enumerations())[case.option]
    assert f"{case.option} = {literals[1]}" in event
    assert f"{case.real} = {case.start(case.real)}" in event


def test_outputs_stay_readable_after_terminate(host: Host) -> None:
    host.start()
    host.step()
    outputs = host.outputs()
    host.slave.terminate()
    assert host.outputs() == outputs
    assert host.step() == DISCARD


@pytest.mark.slow
def test_three_hundred_instances_in_a_row_are_alike(fmu_folder: Path) -> None:
    results = set()
    for _ in range(300):
        host = Host(fmu_folder)
        host.start()
        host.step()
        results.add(tuple(host.outputs()))
        host.close()
    assert len(results) == 1
