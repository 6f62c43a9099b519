"""How the commands `gearlube ehl` end: messages and exit codes."""

from __future__ import annotations

import logging
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import typer

from fmu_src.exit_codes import BAD_ARGUMENT, FAILED, INTERRUPTED
from gearlube_core.errors import GearLubeError, ParameterError

logger = logging.getLogger("gearlube")


def verdict(outcome: str) -> None:
    """End with a failure where a solution did not converge, `outcome` its reason."""
    if outcome:
        logger.error("%s", outcome)
        raise typer.Exit(FAILED)


@contextmanager
def told(out: Path) -> Iterator[None]:
    """Turn errors into messages and exit codes."""
    try:
        yield
    except KeyboardInterrupt:
        logger.warning("Stopped; %s may be incomplete. Run the same command again.", out)
        raise typer.Exit(INTERRUPTED) from None
    except ParameterError as error:
        logger.error("%s", error)
        raise typer.Exit(BAD_ARGUMENT) from None
    except (GearLubeError, OSError) as error:
        logger.error("%s", error)
        raise typer.Exit(FAILED) from None
