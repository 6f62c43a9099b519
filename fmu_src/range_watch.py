"""What left the range of its formula or table in a run: said once, counted every step."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

from fmu_src.definition import Model

EXCEEDED = "range.exceeded"  # output: 0 while all is within its range


class RangeWatch:
    """Steps of one run that ended outside a range.

    Parameters
    ----------
    output_names : sequence of str
        Of the model; without `EXCEEDED` nothing is watched.
    """

    def __init__(self, output_names: Sequence[str]) -> None:
        self._at = output_names.index(EXCEEDED) if EXCEEDED in output_names else -1
        self._steps: Counter[str] = Counter()
        self._all = 0

    def warnings(self, model: Model | None, time: float) -> list[str]:
        """Count the present outputs; return a sentence for each range left for the first time."""
        self._all += 1
        if self._at < 0 or model is None or model.outputs[self._at] == 0.0:
            return []
        exceeded = model.exceeded()
        new = [sentence for name, sentence in exceeded.items() if not self._steps[name]]
        self._steps.update(exceeded.keys())
        return [f"{sentence} First at t = {time:g} s; said once a run." for sentence in new]

    def counts(self) -> list[str]:
        """Return a sentence for each range that was left."""
        return [
            f"{name} was outside its range at {steps} of {self._all} communication points."
            for name, steps in self._steps.items()
        ]
