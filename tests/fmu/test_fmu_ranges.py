"""The FMUs say once a run what left the range of its formula or table, and refuse nonsense."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from tests.helpers.fmu_host import DISCARD, OK, Host


def test_a_torque_beyond_the_table_is_warned_of_once_and_counted(
    host_of: Callable[[Path], Host], axle_folder: Path
) -> None:
    host = host_of(axle_folder)
    assert host.start(pinion__torque=450.0, wheel__torque=1246.0, oil__temperature=368.15) == OK
    assert host.step(count=5) == OK
    warnings = host.messages("logStatusWarning")
    assert warnings.count("pair: range.torque: ") == 1
    assert "should be within -400 to 400 N.m, got 45" in warnings
    assert int(host.get("range.exceeded")[0]) & 1
    host.slave.terminate()
    events = host.messages("logEvents")
    assert "range.torque was outside its range at 6 of 6 communication points" in events


def test_a_usual_run_says_nothing_of_ranges(
    host_of: Callable[[Path], Host], axle_folder: Path
) -> None:
    host = host_of(axle_folder)
    host.start(oil__temperature=353.15)
    host.step(count=5)
    host.slave.terminate()
    assert "range." not in host.messages("logStatusWarning") + host.messages("logEvents")


def test_a_torque_without_meaning_is_discarded_and_the_axle_goes_on(
    host_of: Callable[[Path], Host], axle_folder: Path
) -> None:
    host = host_of(axle_folder)
    host.start()
    host.set(pinion__torque=5000.0)
    assert host.step() == DISCARD
    assert "pinion.torque must be within -600 to 600 N.m, got 5000 N.m" in host.messages(
        "logStatusDiscard"
    )
    host.set(pinion__torque=60.0)
    assert host.step() == OK


def test_a_shaft_that_runs_away_is_discarded(host: Host) -> None:
    host.start()
    host.set(pinion__torque=590.0, wheel__torque=-1600.0)
    status, steps = OK, 0
    while status == OK and steps < 100:
        status = host.step(2.0**-5)
        steps += 1
    assert status == DISCARD
    assert "a shaft turns faster than 5000 rad/s" in host.messages("logStatusDiscard")
    assert abs(host.get("pinion.speed")[0]) <= 5000.0
