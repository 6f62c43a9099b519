"""The table of a sensitivity analysis on the terminal."""

from __future__ import annotations

import math
from collections.abc import Sequence

from rich.table import Table

from gearlube.plotting.parameter_words import parameter_words, tolerance_words
from gearlube.studies.contact.sensitivity import SensitivityRow

_COLUMNS = (
    ("TE without\nload [µrad]", "unloaded_pp", 1e6),
    ("TE loaded\n[µrad]", "te_1", 1e6),
    ("force,\nheight [%]", "s", 1e2),
    ("force,\nface [%]", "t", 1e2),
)


def sensitivity_table(name: str, torque: float, rows: Sequence[SensitivityRow]) -> Table:
    """Return a line a parameter, the largest change of the loaded error's first order on top.

    Errors at the pinion, without load peak to peak; force: its centre on the gear.
    """
    table = Table(title=f"{name}: what small errors change at {torque:g} N·m, drive / coast")
    table.add_column("what grows by how much")
    for heading, *_ in _COLUMNS:
        table.add_column(heading, justify="right", no_wrap=True)
    pairs = list(zip(rows[::2], rows[1::2], strict=True))
    for pair in sorted(pairs, key=lambda pair: -max(abs(one.te_1) for one in pair)):
        table.add_row(
            parameter_words(pair[0].parameter)
            + f", {tolerance_words(pair[0].tolerance, pair[0].unit)}",
            *(
                "/".join(_shown(scale * getattr(one, field)) for one in pair)
                for _, field, scale in _COLUMNS
            ),
        )
    return table


def _shown(change: float) -> str:
    return "-" if math.isnan(change) else f"{change:+.2f}"
