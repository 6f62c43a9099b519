from __future__ import annotations

import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from fmu_src.identity import guid_of
from tests.helpers.fmu_cases import Case
from tests.helpers.fmu_host import FATAL, OK, Host


@pytest.fixture(params=["default", "changed", "last"])
def settings(case: Case, request: pytest.FixtureRequest) -> dict[str, float]:
    """Options by their defaults, away from them, and each at its last legal literal."""
    if request.param == "default":
        return {}
    if request.param == "changed":
        return case.changed
    last = {name: len(literals) for name, literals in case.enumerations()}
    # the last pair needs a gear file, and only the first has a line mesh
    return last | {"gear.name": 1} if "gear.name" in last else last


@pytest.mark.slow
def test_a_restored_state_continues_bit_for_bit(
    case: Case, host: Host, settings: dict[str, float]
) -> None:
    host.start(**settings)
    host.step(count=5)
    state, time, outputs = host.save(), host.time, host.outputs()
    host.set(pinion__torque=90.0)
    host.step(count=5)
    expected = host.outputs()
    assert host.restore(state, time) == OK
    assert host.outputs() == outputs
    assert host.get("pinion.torque") == [case.torques[0]]
    host.set(pinion__torque=90.0)
    host.step(count=5)
    assert host.outputs() == expected
    host.slave.freeFMUstate(state)


# the test above restores each setting in one process; what crosses over is the same record
@pytest.mark.slow
@pytest.mark.parametrize(
    "settings",
    [
        pytest.param("default", marks=pytest.mark.slow),
        "changed",
        pytest.param("last", marks=pytest.mark.slow),
    ],
    indirect=True,
)
def test_a_state_saved_in_one_process_continues_in_another(
    host: Host, fmu_folder: Path, tmp_path: Path, settings: dict[str, float]
) -> None:
    host.start(start_time=2.0, **settings)
    host.step(count=5)
    (tmp_path / "state").write_bytes(host.slave.serializeFMUstate(host.save()))
    code = (
        f"import sys; sys.path.insert(0, {str(Path(__file__).parents[2])!r});"
        "from tests.helpers.fmu_host import Host; from pathlib import Path;"
        f"host = Host({str(fmu_folder)!r});"
        f"state = host.slave.deSerializeFMUstate(Path({str(tmp_path / 'state')!r}).read_bytes());"
        f"assert host.restore(state, {host.time!r}) == 0, host.log;"
        "assert host.step(count=5) == 0, host.log;"
        "print(*map(repr, host.outputs()))"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert host.step(count=5) == OK
    assert done.stdout.split() == [repr(value) for value in host.outputs()]


def test_a_state_moves_to_an_instance_with_other_parameters(
    case: Case, new_host: Callable[[], Host]
) -> None:
    first, second = new_host(), new_host()
    first.start(**case.changed)
    first.step(count=3)
    second.start()
    state = second.slave.deSerializeFMUstate(first.slave.serializeFMUstate(first.save()))
    assert second.restore(state, first.time) == OK
    assert second.get(*case.changed) == list(case.changed.values())
    first.step(count=3)
    second.step(count=3)
    assert second.outputs() == first.outputs()


def test_a_state_saved_before_initialisation_can_still_be_initialised(
    case: Case, host: Host
) -> None:
    host.set(**case.changed)
    state = host.save()
    host.start()
    host.step(count=2)
    expected = host.outputs()
    assert host.restore(state, 0.0) == OK
    assert host.start() == OK
    host.step(count=2)
    assert host.outputs() == expected


def _damaged(content: bytes) -> bytes:
    return content[:-1] + bytes([content[-1] ^ 1])


@pytest.mark.slow
@pytest.mark.parametrize(
    ("spoil", "reason"),
    [
        (_damaged, "damaged"),
        (lambda content: content[:20], "not written by a gearlube FMU"),
        (lambda content: b"x" + content, "not written by a gearlube FMU"),
        (lambda content: content[:8] + b"\x63" + content[9:], "must have format 1, got 99"),
    ],
)
def test_a_spoilt_state_is_refused_and_nothing_changes(
    case: Case, host: Host, spoil: Callable[[bytes], bytes], reason: str
) -> None:
    host.start(**case.changed)
    host.step(count=2)
    _refused(host, spoil(host.slave.serializeFMUstate(host.save())), reason)


def test_a_state_of_another_fmu_is_refused_and_nothing_changes(case: Case, host: Host) -> None:
    host.start(**case.changed)
    host.step(count=2)
    content = host.slave.serializeFMUstate(host.save())
    guid = guid_of(case.definition).bytes
    assert guid in content
    _refused(host, content.replace(guid, bytes(16)), "must come from the FMU with GUID")


def _refused(host: Host, content: bytes, reason: str) -> None:
    before = host.outputs()
    assert host.restore(host.slave.deSerializeFMUstate(content), host.time) == FATAL
    assert reason in host.messages("logStatusFatal")
    assert host.outputs() == before
    assert host.step() == OK
