"""A kernel that takes long to compile says so, once."""

from __future__ import annotations

import logging

import pytest

from gearlube.cli.exit_codes import WarningsOnce
from gearlube_core.kernels.dispatcher import logger
from gearlube_core.kernels.jit import announced, kernel


def test_words_are_logged_before_a_compilation_alone(caplog: pytest.LogCaptureFixture):
    made: dict[str, object] = {}
    exec("def twice(x):\n    return 2.0 * x", made)  # without a file nothing is on disk
    twice = announced(kernel(made["twice"]), "Compiling: about 1 s.")  # type: ignore[type-var]
    with caplog.at_level(logging.WARNING):
        assert (twice(1.0), twice(2.0)) == (2.0, 4.0)  # type: ignore[operator]
    assert caplog.messages == ["Compiling: about 1 s."]


def test_in_a_command_these_words_are_no_warning():
    shown = {}
    for name in (logger.name, "gearlube"):
        record = logging.LogRecord(name, logging.WARNING, "", 0, "words", (), None)
        WarningsOnce().filter(record)
        shown[name] = record.levelname
    assert shown == {logger.name: "INFO", "gearlube": "WARNING"}
