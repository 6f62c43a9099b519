"""Progress reports of long calculations: the share that is done and a sentence."""

from __future__ import annotations

from collections.abc import Callable

Progress = Callable[[float, str], None]  # share done, 0 to 1 [-], and what runs now


def no_progress(share: float, sentence: str) -> None:
    """Report nothing."""


def part_of(progress: Progress, first: float, last: float) -> Progress:
    """Return the report for a part of the work between the shares `first` and `last` [-].

    >>> part_of(lambda share, sentence: print(f"{share:.2f} {sentence}"), 0.5, 0.9)(0.5, "teeth")
    0.70 teeth
    """

    def report(share: float, sentence: str) -> None:
        progress(first + share * (last - first), sentence)

    return report
