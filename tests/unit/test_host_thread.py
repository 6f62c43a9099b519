"""What a slave holds of its host's thread."""

import ctypes
import threading
from types import SimpleNamespace

import pytest

from fmu_src.wrapper import HostThread

LOCKED = 0


@pytest.fixture
def calls(monkeypatch):
    """Calls of Python's C interface."""
    seen = []
    fake = SimpleNamespace(
        PyGILState_Ensure=lambda: seen.append("ensure"),
        PyGILState_Release=lambda state: seen.append(("release", state)),
    )
    monkeypatch.setattr(ctypes, "pythonapi", fake)
    return seen


def elsewhere(function):
    thread = threading.Thread(target=function)
    thread.start()
    thread.join()


def test_a_state_is_held_once_and_given_back_once(calls):
    host = HostThread()
    host.hold()
    host.hold()
    host.release()
    host.release()
    assert calls == ["ensure", ("release", LOCKED)]


def test_a_thread_gives_back_no_state_but_its_own(calls):
    host = HostThread()
    elsewhere(host.hold)
    # as a rule with the number of the thread that has ended
    elsewhere(host.release)
    assert calls == ["ensure"]


def test_a_slave_may_be_held_anew_in_another_thread(calls):
    host = HostThread()
    host.hold()
    host.release()
    elsewhere(lambda: (host.hold(), host.release()))
    assert calls == 2 * ["ensure", ("release", LOCKED)]
