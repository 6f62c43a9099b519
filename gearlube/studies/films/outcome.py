"""How the commands `gearlube ehl` end: messages and exit codes."""

from __future__ import annotations

import logging
from contextlib import AbstractContextManager
from pathlib import Path

import typer

from gearlube.cli import exit_codes

logger = logging.getLogger("gearlube")


def verdict(outcome: str) -> None:
    """End with a failure where a solution did not converge, `outcome` its reason."""
    if outcome:
        logger.error("%s", outcome)
        raise typer.Exit(exit_codes.FAILED)


def told(out: Path) -> AbstractContextManager[None]:
    """Turn errors into messages and exit codes; `out` is where results go."""
    return exit_codes.told(f"Stopped; {out} may be incomplete. Run the same command again.")
