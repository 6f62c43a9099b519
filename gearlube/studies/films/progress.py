"""How a run says how far it is."""

from __future__ import annotations

from collections.abc import Callable

Progress = Callable[[float, str], None]  # share done from 0 to 1, and what is done now


def silent(share: float, sentence: str) -> None:
    """Say nothing."""


def counted(progress: Progress, films: int) -> Progress:
    """Return a `Progress` that takes the number of films solved, of `films` in all.

    Files and figures count as much as one more film.
    """
    return lambda solved, sentence: progress(solved / (films + 1), sentence)
