"""The end of a study's command: its report, the first findings, and where the report is."""

from __future__ import annotations

import logging
import shlex
import sys
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from gearlube.report.parts import WARNING, Finding, ranked

if TYPE_CHECKING:
    from gearlube.report.parts import Report

_LOGGER = logging.getLogger("gearlube")
_MOST = 5


def finish_with_report(report: Report, out: Path, seconds: float | None = None) -> Path:
    """Write OUT/report.html with the command and the seconds it took; log the first findings."""
    from gearlube.report.page import write_report

    facts = [("command", command_line()), *report.facts]
    if seconds is not None:
        facts.append(("time", f"{seconds:.1f} s"))
    path = write_report(replace(report, facts=facts), out)
    tell_findings(report.findings, path)
    return path


def command_line() -> str:
    """Return the command as it was typed."""
    return shlex.join(["gearlube", *sys.argv[1:]])


def tell_findings(findings: Sequence[Finding], report: Path) -> None:
    """Log the first findings and the path of the report.

    Warnings are all logged, as warnings.
    """
    read = ranked(findings)
    for one in [one for one in read if one.level == WARNING]:
        _LOGGER.warning("%s", one.headline)
    for one in [one for one in read if one.level != WARNING][:_MOST]:
        _LOGGER.info("%s", one.headline)
    _LOGGER.info("Report: %s", report)
