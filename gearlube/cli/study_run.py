"""Frame of a study in its command: messages, exit codes, folder, bar, report, findings."""

from __future__ import annotations

import logging
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from pathlib import Path
from threading import Event, Thread
from typing import TYPE_CHECKING, Any

import typer
from rich import progress as rich_progress
from rich.table import Table

from gearlube.cli.exit_codes import console, exit_on_error
from gearlube.cli.results_folder import results_folder
from gearlube.report.page import write_report
from gearlube.report.parts import WARNING, Finding, ranked
from gearlube_core.progress import Progress

if TYPE_CHECKING:
    from gearlube.report.parts import Report

_LOGGER = logging.getLogger("gearlube")
_PER_MILLE = 1000  # steps of a bar without parts of its own
_SILENCE = 30.0  # s; a line is written at the end of such a span that had none


@dataclass(frozen=True)
class StudyRun:
    """One run of a study; `study_run` makes it.

    Parameters
    ----------
    study : str
        The command as typed after `gearlube`.
    out : Path
        Folder of results.
    overwrite : bool
        Also write into a folder of another study, version or input.
    """

    study: str
    out: Path
    overwrite: bool
    began: float = field(default_factory=time.monotonic)  # [s]

    @property
    def seconds(self) -> float:
        """Time since the command began [s]."""
        return time.monotonic() - self.began

    @contextmanager
    def results(
        self, parts: int = _PER_MILLE, bar: str = "", *, by_parts: bool = False
    ) -> Iterator[Progress]:
        """Make and mark the folder of results; yield the callback of a bar with `parts`.

        See `results_folder` for `by_parts`.
        """
        with (
            results_folder(self.out, self.study, overwrite=self.overwrite, by_parts=by_parts),
            progress_on(bar or self.study, parts) as progress,
        ):
            yield progress

    def show(self, table: Table) -> None:
        """Print a table."""
        console.print(table)

    def written(self, *names: str | Path, note: str = "") -> None:
        """Log the time and the files in the folder of results; `note` follows the first."""
        _LOGGER.info("Computed in %.1f s.", self.seconds)
        first, *more = [str(self.out / name) for name in names] or [str(self.out)]
        _LOGGER.info("Results: %s", ", ".join([first + note, *more]))

    def finish(self, report: Report) -> Path:
        """Write report.html with the command and the time it took; log the findings."""
        facts = [*report.facts, ("time", f"{self.seconds:.1f} s")]
        path = write_report(replace(report, facts=facts), self.out)
        tell_findings(report.findings, path)
        return path


@contextmanager
def study_run(
    study: str, out: Path, *, overwrite: bool = False, stopped: str = ""
) -> Iterator[StudyRun]:
    """Yield the run of a study; turn its errors into messages and exit codes.

    `stopped` is logged after Ctrl-C; by default that OUT may be incomplete.
    """
    with exit_on_error(stopped or f"Stopped; {out} may be incomplete. Run the same command again."):
        yield StudyRun(study, out, overwrite)


@contextmanager
def progress_on(name: str, parts: int = _PER_MILLE) -> Iterator[Progress]:
    """Yield a callback that shows the share done [-] with a sentence and the time left.

    On a terminal this is a bar, with percent or, if given, the number of `parts`. Elsewhere it is
    a line for each step of preparation, each 10 %, and at least one a minute.
    """
    if not console.is_terminal:
        lines = _ProgressLines(name)
        Thread(target=lines.tell_in_silence, daemon=True).start()
        try:
            yield lines.report
        finally:
            lines.ended.set()
        return
    in_percent = parts == _PER_MILLE
    columns = (
        rich_progress.TextColumn("{task.description}"),
        rich_progress.BarColumn(),
        rich_progress.TaskProgressColumn() if in_percent else rich_progress.MofNCompleteColumn(),
        rich_progress.TimeElapsedColumn(),
        rich_progress.TimeRemainingColumn(),
    )
    with rich_progress.Progress(*columns, console=console) as bar:
        task = bar.add_task(name, total=parts)

        def report(share: float, sentence: str) -> None:
            bar.update(task, completed=int(parts * share + 1e-9), description=sentence)

        yield report


class _ProgressLines:
    """Progress as lines of text, for files and pipes: preparation, tenths of the work, silence.

    Time before the first share of the work, for preparation, does not count for the time left.
    """

    def __init__(self, name: str) -> None:
        self._name = name
        self._began = self._ready = time.monotonic()
        self._tenths = 0  # of the work, at the last line
        self._share, self._sentence = 0.0, ""
        self._silent = True
        self.ended = Event()

    def report(self, share: float, sentence: str) -> None:
        now, tenths = time.monotonic(), int(10.0 * share + 1e-9)
        new = share == 0.0 and sentence != self._sentence
        self._share, self._sentence = share, sentence
        if share == 0.0:
            self._ready = now
        if tenths > self._tenths or new:
            self._tenths = max(tenths, self._tenths)
            left = ""
            if 0.0 < share < 1.0:
                left = f", about {(now - self._ready) * (1.0 - share) / share:.0f} s left"
            self._tell(now, left)

    def tell_in_silence(self) -> None:
        """Tell what runs where no line was written for a while, until `ended` is set."""
        while not self.ended.wait(_SILENCE):
            if self._silent and self._sentence:
                self._tell(time.monotonic(), "")
            self._silent = True

    def _tell(self, now: float, left: str) -> None:
        self._silent = False
        place = self._name, 100.0 * self._share, now - self._began
        _LOGGER.info("%s %.0f %% after %.0f s%s: %s", *place, left, self._sentence)


def empty_table(title: str, *headings: str, **look: Any) -> Table:
    """Return a table for the terminal; columns whose heading begins with > stand to the right.

    >>> [one.justify for one in empty_table("Films", "quantity", ">value [m]").columns]
    ['left', 'right']
    """
    table = Table(title=title, **look)
    for heading in headings:
        right = heading.startswith(">")
        table.add_column(heading.removeprefix(">"), justify="right" if right else "left")
    return table


def tell_findings(findings: Sequence[Finding], report: Path) -> None:
    """Log all findings, ranked, warnings with their details, and the path of the report."""
    read = ranked(findings)
    for one in read:
        if one.level == WARNING:
            _LOGGER.warning("%s", f"{one.headline} {one.detail}".strip())
        else:
            _LOGGER.info("%s", one.headline)
    _LOGGER.info("Report: %s", report)


def run_next(context: typer.Context, name: str, arguments: Sequence[str]) -> None:
    """Run `gearlube NAME ARGUMENTS` from within another command; stop where that stops.

    Parameters
    ----------
    context : typer.Context
        Of the command that runs.
    name : str
    arguments : sequence of str

    Raises
    ------
    typer.Exit
        The other command ended with a code other than zero.
    """
    root: Any = context.find_root()
    command = root.command.get_command(root, name)
    code = command.main(list(arguments), prog_name=f"gearlube {name}", standalone_mode=False)
    if code:
        raise typer.Exit(code)
