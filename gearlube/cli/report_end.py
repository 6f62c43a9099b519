"""What a command says at its end: the first findings, and where the report is."""

from __future__ import annotations

import logging
import shlex
import sys
from collections.abc import Sequence
from pathlib import Path

from gearlube.report.parts import WARNING, Finding, ranked

_LOGGER = logging.getLogger("gearlube")
_MOST = 5


def tell_findings(findings: Sequence[Finding], report: Path) -> None:
    """Log the first findings and the path of the report.

    Warnings are all logged, as warnings.
    """
    for number, one in enumerate(ranked(findings)):
        if one.level == WARNING:
            _LOGGER.warning("%s", one.headline)
        elif number < _MOST:
            _LOGGER.info("%s", one.headline)
    _LOGGER.info("Report: %s", report)


def command_line() -> str:
    """Return the command as it was typed, for the report."""
    return shlex.join(["gearlube", *sys.argv[1:]])
