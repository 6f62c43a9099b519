"""Show the progress of a study as a bar on the terminal."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from rich import progress as rich_progress
from rich.console import Console

from gearlube_core.progress import Progress


@contextmanager
def progress_on(console: Console, name: str, parts: int = 1000) -> Iterator[Progress]:
    """Yield a callback that shows the share done [-] as a bar of `parts`, with a sentence."""
    columns = (
        rich_progress.TextColumn("{task.description}"),
        rich_progress.BarColumn(),
        rich_progress.MofNCompleteColumn(),
        rich_progress.TimeElapsedColumn(),
        rich_progress.TimeRemainingColumn(),
    )
    with rich_progress.Progress(*columns, console=console) as bar:
        task = bar.add_task(name, total=parts)

        def report(share: float, sentence: str) -> None:
            bar.update(task, completed=int(parts * share + 1e-9), description=sentence)

        yield report
