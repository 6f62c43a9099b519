"""Show the progress of a study as a bar on the terminal."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from rich.console import Console

from gearlube.cli.progress_bar import progress_bar
from gearlube_core.progress import Progress


@contextmanager
def progress_on(console: Console, name: str, parts: int = 1000) -> Iterator[Progress]:
    """Yield a callback that shows the share done [-] as a bar of `parts`, with a sentence."""
    with progress_bar(console) as bar:
        task = bar.add_task(name, total=parts)

        def report(share: float, sentence: str) -> None:
            bar.update(task, completed=int(parts * share + 1e-9), description=sentence)

        yield report
