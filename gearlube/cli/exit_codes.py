"""What the command `gearlube` returns to the shell."""

from __future__ import annotations

import logging
from collections.abc import Iterator
from contextlib import contextmanager

import typer

from gearlube_core.errors import GearLubeError, ParameterError, TableError

BAD_ARGUMENT, FAILED, INTERRUPTED = 2, 1, 130

_LOGGER = logging.getLogger("gearlube")


@contextmanager
def told(when_stopped: str) -> Iterator[None]:
    """Log what ends the command, `when_stopped` for the keyboard, and exit with its code."""
    try:
        yield
    except KeyboardInterrupt:
        _LOGGER.warning("%s", when_stopped)
        raise typer.Exit(INTERRUPTED) from None
    except (ParameterError, TableError) as error:
        _LOGGER.error("%s", error)
        raise typer.Exit(BAD_ARGUMENT) from None
    except (GearLubeError, OSError) as error:
        _LOGGER.error("%s", error)
        raise typer.Exit(FAILED) from None
