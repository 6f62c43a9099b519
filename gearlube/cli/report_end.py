"""The end of a study's command: its report, the findings, and where the report is."""

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


def finish_with_report(report: Report, out: Path, seconds: float | None = None) -> Path:
    """Write OUT/report.html with the command and the seconds it took; log the findings."""
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
    """Log all findings, warnings first and with their details, and the path of the report."""
    read = ranked(findings)
    for one in read:
        if one.level == WARNING:
            _LOGGER.warning("%s", f"{one.headline} {one.detail}".strip())
        else:
            _LOGGER.info("%s", one.headline)
    _LOGGER.info("Report: %s", report)
