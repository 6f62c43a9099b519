"""Exit codes of the command `gearlube`, and the terminal to which it writes."""

from __future__ import annotations

import errno
import logging
from collections.abc import Iterator
from concurrent.futures import BrokenExecutor
from contextlib import contextmanager

import typer
from rich.console import Console

from gearlube_core.errors import GearLubeError, InterruptedRunError, ParameterError, TableError

# no markup: it would take "[mm]" in a heading for a style
console = Console(stderr=True, markup=False)
BAD_ARGUMENT, FAILED, INTERRUPTED = 2, 1, 130

_LOGGER = logging.getLogger("gearlube")
_COMPILER = "gearlube_core.kernels.dispatcher"


class WarningsOnce(logging.Filter):
    """Lets each warning pass once; a command may read the same file several times.

    That a kernel is compiled, for which a Python session has no other sign, is no warning here.
    """

    def __init__(self) -> None:
        super().__init__()
        self._shown: set[str] = set()

    def filter(self, record: logging.LogRecord) -> bool:
        """Return whether a record is shown."""
        if record.name == _COMPILER:
            record.levelno, record.levelname = logging.INFO, logging.getLevelName(logging.INFO)
        text = record.getMessage()
        known = record.levelno == logging.WARNING and text in self._shown
        self._shown.add(text)
        return not known


@contextmanager
def exit_on_error(when_stopped: str = "Stopped.") -> Iterator[None]:
    """Log an error that ends a command, and exit with the code of its kind.

    Parameters
    ----------
    when_stopped
        What is logged after Ctrl-C, unless the error itself says what is kept.
    """
    try:
        yield
    except KeyboardInterrupt:
        _LOGGER.warning("%s", when_stopped)
        raise typer.Exit(INTERRUPTED) from None
    except InterruptedRunError as error:
        _LOGGER.warning("%s", error)
        raise typer.Exit(INTERRUPTED) from None
    except (ParameterError, TableError) as error:
        _LOGGER.error("%s", error)
        raise typer.Exit(BAD_ARGUMENT) from None
    except GearLubeError as error:
        _LOGGER.error("%s", error)
        raise typer.Exit(FAILED) from None
    except (MemoryError, RuntimeError) as error:
        if not isinstance(error, MemoryError | BrokenExecutor) and "new thread" not in str(error):
            raise
        _LOGGER.error(
            "There is too little memory for this: %s. Take fewer --jobs or free some memory, then "
            "run the same command again; what is finished is kept.",
            str(error).rstrip(".") or "none is left",
        )
        raise typer.Exit(FAILED) from None
    except BrokenPipeError:  # head and its like have read enough; typer ends without a word
        raise
    except OSError as error:
        _LOGGER.error("%s", _file_error(error))
        raise typer.Exit(FAILED) from None


def _file_error(error: OSError) -> str:
    """Return an error of the file system as a sentence, without its number."""
    if error.strerror is None:
        return str(error)
    where = f" at {error.filename}" if error.filename is not None else ""
    if error.errno in (errno.ENOSPC, errno.EDQUOT):
        return f"The disk is full{where}. Free some space, then run the same command again."
    return f"The file system refused{where}: {error.strerror.lower()}. Check path and permissions."


def exit_if_failed(reason: str) -> None:
    """Log `reason` and exit with the code of a failure; do nothing if it is empty."""
    if reason:
        _LOGGER.error("%s", reason)
        raise typer.Exit(FAILED)
