from __future__ import annotations

import math
import shutil
from collections.abc import Callable
from pathlib import Path

import pytest

from tests.helpers.fmu_cases import CASES, Case
from tests.helpers.fmu_host import DISCARD, FATAL, OK, Host

NAN, INF = float("nan"), float("inf")


@pytest.mark.parametrize(
    ("name", "value", "limit"),
    [
        ("pinion__torque", NAN, "pinion.torque must be within -{0:g} to {0:g} N.m, got nan"),
        ("pinion__torque", INF, "got inf"),
        ("wheel__torque", -INF, "wheel.torque must be within -{1:g} to {1:g} N.m, got -inf"),
        ("pinion__torque", 1e9, "got 1000000000.0"),
        ("oil__temperature", 20.0, "oil.temperature must be within 273.15 to 423.15 K, got 20.0"),
        ("oil__temperature", NAN, "got nan"),
    ],
)
def test_an_impossible_input_is_logged_and_the_step_discarded(
    case: Case, host: Host, name: str, value: float, limit: str
) -> None:
    limit = limit.format(*case.torque_limits)
    host.start()
    host.step(count=2)
    before, good = host.outputs(), host.get(name.replace("__", "."))[0]
    host.set(**{name: value})
    assert limit in host.messages("logStatusError")
    assert host.step() == DISCARD
    assert limit in host.messages("logStatusDiscard")
    assert host.outputs() == before
    host.set(**{name: good})
    assert host.step() == OK


@pytest.mark.parametrize("h", [0.0, -1e-3, 0.2, NAN, INF, -INF])
def test_an_impossible_step_is_discarded_and_nothing_moves(host: Host, h: float) -> None:
    host.start()
    before = host.outputs()
    assert host.step(h) == DISCARD
    assert "communicationStepSize must be above 0 and at most 0.1 s" in host.messages(
        "logStatusDiscard"
    )
    assert host.outputs() == before
    assert host.step() == OK


def test_a_late_step_begins_where_the_last_ended_to_rounding(host: Host) -> None:
    host.start(1e6)
    assert host.step() == OK
    end = host.time
    host.time = end + 2.0**-13  # an eighth of a step
    assert host.step() == DISCARD
    host.time = math.nextafter(end, math.inf)  # as a difference of such times may come out
    assert host.step(math.nextafter(end + 0.1, math.inf) - end) == OK


@pytest.mark.parametrize("time", [0.5, -1.0, NAN])
def test_a_step_from_another_time_is_discarded(host: Host, time: float) -> None:
    host.start()
    host.step()
    end, host.time = host.time, time
    assert host.step() == DISCARD
    assert "currentCommunicationPoint must be" in host.messages("logStatusDiscard")
    host.time = end
    assert host.step() == OK


def test_a_step_before_initialisation_is_discarded(host: Host) -> None:
    assert host.step() == DISCARD
    assert "must be in state STEPPING, is in INSTANTIATED" in host.messages("logStatusDiscard")


@pytest.mark.slow
@pytest.mark.parametrize(
    ("case", "name", "value", "limit"),
    [
        (case, *bad)
        for case in CASES
        for bad in [*case.bad_parameters, ("pinion.torque", NAN, "pinion.torque must be within")]
    ],
)
def test_an_impossible_parameter_stops_the_initialisation(
    extracted: Callable[[Case], Path],
    host_of: Callable[[Path], Host],
    case: Case,
    name: str,
    value: float,
    limit: str,
) -> None:
    host = host_of(extracted(case))
    assert host.start(**{name: value}) == FATAL
    assert limit in host.messages("logStatusError")
    assert limit in host.messages("logStatusFatal")
    assert host.step() == DISCARD


def test_a_parameter_can_be_corrected_before_initialisation_ends(case: Case, host: Host) -> None:
    host.set(**{case.real: -1.0})
    assert host.start(**{case.real: case.changed[case.real]}) == OK
    assert host.step() == OK


def test_contradicting_parameters_stop_the_initialisation(
    host_of: Callable[[Path], Host], axle_folder: Path
) -> None:
    host = host_of(axle_folder)
    assert host.start(mesh__damping=2, mesh__modal_loss_factor=0.0) == FATAL
    assert "modal_loss_factor must be above 0" in host.messages("logStatusFatal")


def test_no_output_can_be_read_after_a_failed_initialisation(case: Case, host: Host) -> None:
    assert host.start(**{case.real: -1.0}) == FATAL
    assert host.status("getReal", [host.variables["mesh.dte"].valueReference]) == FATAL


@pytest.mark.slow
@pytest.mark.parametrize(
    ("call", "name", "value", "reason"),
    [
        ("getReal", None, (), "value reference must be within 0 to"),
        ("getReal", "oil.name", (), "oil.name must be accessed as Integer, got Real"),
        ("getInteger", "pinion.torque", (), "must be accessed as Real, got Integer"),
        ("getBoolean", "pinion.torque", (), "must be accessed as Real, got Boolean"),
        ("setString", "pinion.torque", ("a",), "must be accessed as Real, got String"),
        ("getString", "pinion.torque", (), "must be accessed as Real, got String"),
        ("setReal", "pinion.angle", (0.0,), "pinion.angle must not be set"),
        ("setReal", "mesh.backlash", (1e-4,), "mesh.backlash must not be set in this phase"),
        ("setInteger", "oil.name", (2,), "oil.name must not be set in this phase"),
        ("setBoolean", "pinion.torque", (True,), "must be accessed as Real, got Boolean"),
    ],
)
def test_a_call_that_makes_no_sense_is_fatal_but_never_a_crash(
    host: Host, call: str, name: str | None, value: tuple, reason: str
) -> None:
    host.start()
    reference = 100000 if name is None else host.variables[name].valueReference
    for _ in range(20):
        assert host.status(call, [reference], *([v] for v in value)) == FATAL
    assert reason in host.messages("logStatusFatal")
    # after fmi2Fatal a host should stop; one that goes on must not be hurt
    assert host.step() == OK


def test_initialising_twice_is_fatal_and_the_model_stays_ready(host: Host) -> None:
    assert host.status("exitInitializationMode") == FATAL
    host.start()
    assert host.status("enterInitializationMode") == FATAL
    assert "must be in state INSTANTIATED, is in STEPPING" in host.messages("logStatusFatal")
    assert host.step() == OK


def test_terminating_what_was_never_initialised_is_an_error(host: Host) -> None:
    assert host.status("terminate") == FATAL
    assert "must be in state STEPPING, is in INSTANTIATED" in host.messages("logStatusFatal")
    assert host.start() == OK
    assert host.step() == OK


def test_terminating_twice_is_an_error(host: Host) -> None:
    host.start()
    assert host.status("terminate") == OK
    assert host.status("terminate") == FATAL
    assert "must be in state STEPPING, is in TERMINATED" in host.messages("logStatusFatal")


def test_a_start_time_after_the_start_is_an_error_and_changes_nothing(host: Host) -> None:
    host.start()
    host.step()
    assert host.status("setupExperiment", startTime=7.0) == FATAL
    assert "must be in state INSTANTIATED, is in STEPPING" in host.messages("logStatusFatal")
    assert host.step() == OK  # at the old time


def test_nothing_can_be_set_after_the_end(host: Host) -> None:
    host.start()
    host.slave.terminate()
    assert host.status("setReal", [host.variables["pinion.torque"].valueReference], [1.0]) == FATAL
    assert "pinion.torque must not be set in this phase" in host.messages("logStatusFatal")


def test_a_call_for_strings_without_references_is_legal(host: Host) -> None:
    host.start()
    assert host.status("getString", []) == OK


def test_a_host_without_logging_reads_on_standard_error_why_no_instance_was_made(
    fmu_folder: Path, tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    folder = tmp_path / "other"
    shutil.copytree(fmu_folder, folder)
    identity = folder / "resources" / "gearlube_identity.txt"
    identity.write_text("0" * 64 + "\n" + identity.read_text().split()[1] + "\n")
    with pytest.raises(Exception, match="instantiate"):
        Host(folder, logging_on=False)
    assert "it was built from another version. Rebuild it" in capfd.readouterr().err


def test_a_start_time_that_is_no_number_is_fatal(host: Host) -> None:
    assert host.status("setupExperiment", startTime=NAN) == FATAL
    assert "start time must be finite" in host.messages("logStatusFatal")


def test_every_output_is_finite_after_a_wild_ride(host: Host) -> None:
    host.start()
    for torque in (1e4, -1e4, 0.0, 1e4):
        host.set(pinion__torque=torque, wheel__torque=-3.0 * torque)
        if host.step(0.05) != OK:
            break
        assert all(math.isfinite(value) for value in host.outputs())
    assert all(math.isfinite(value) for value in host.outputs())


def test_freeing_an_instance_that_was_only_made_leaves_the_next_one_sound(
    fmu_folder: Path, host: Host
) -> None:
    host.start()
    for _ in range(20):
        Host(fmu_folder).close()
    assert host.step(1e-4) == OK
    after = Host(fmu_folder)
    after.start()
    assert after.step(1e-4) == OK
    assert after.outputs() == host.outputs()
    after.close()


def test_errors_reach_python_logging_when_the_host_logs_nothing(
    fmu_folder: Path, caplog: pytest.LogCaptureFixture
) -> None:
    host = Host(fmu_folder, logging_on=False)
    host.set(pinion__torque=NAN)
    assert host.log == []
    assert "pinion.torque must be within" in caplog.text
    host.close()
