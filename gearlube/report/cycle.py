"""What all reports of drive cycles have: the energy lost by source, and the steps as a table."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence

import numpy as np
import xarray as xr

from gearlube.output.csv_text import number_text
from gearlube.plotting.words import largest_losses
from gearlube.report.numbers import quantity_text
from gearlube.report.parts import NOTE, Cell, Column, Finding, Table
from gearlube_core.arrays import Array

WH = 1.0 / 3.6  # Wh in a kJ
_NOTHING = 1e-6  # kJ


def energy_lost(
    dataset: xr.Dataset, whose: str, words: Callable[[str], str], detail: str
) -> Finding:
    """Return what a cycle costs; `whose` begins the sentence, `words` are those of a source."""
    energy = dataset["energy_lost"].values
    lost, put_in = float(energy.sum()), float(dataset["energy_in"])
    parts = largest_losses(dataset["source"].values, energy, words)
    share = f", {100.0 * lost / put_in:.1f} % of the energy put in" if put_in > 0.0 else ""
    return Finding(
        NOTE,
        f"{whose} loses {quantity_text(lost, 'kJ')} ({quantity_text(WH * lost, 'Wh')}) in the "
        f"cycle{share}{': ' + parts if parts else ''}.",
        detail,
    )


def energy_table(dataset: xr.Dataset, words: Callable[[str], str], caption: str) -> Table:
    """Return the energy lost by source."""
    energy = dataset["energy_lost"].values
    energy = np.where(energy > _NOTHING, energy, 0.0)
    total = max(float(energy.sum()), _NOTHING)
    each = [*zip(dataset["source"].values, energy, strict=True), ("all", energy.sum())]
    rows: list[list[Cell]] = [
        [words(str(name)), float(one), WH * float(one), 100.0 * float(one) / total]
        for name, one in each
    ]
    return Table(
        title="Energy lost by source",
        columns=[
            Column("source"),
            Column("energy", "kJ", 4),
            Column("energy", "Wh", 4),
            Column("share", "%"),
        ],
        rows=rows,
        caption=caption,
    )


def step_rows(
    dataset: xr.Dataset, columns: Mapping[str, str], more: Mapping[str, Array]
) -> tuple[Sequence[str], Iterator[list[str]]]:
    """Return the names of the columns and a row for each step, at its middle.

    `columns` are variables and their names in the table; those in `more` come behind the losses.
    """
    losses = [f"loss_{one}_w" for one in dataset["source"].values]
    head = "time_s", *columns.values(), *losses, *more
    variables = (dataset[name].values for name in columns)
    values = [dataset["step"].values, *variables, *dataset["loss"].values.T, *more.values()]
    rows = ([number_text(float(one)) for one in row] for row in zip(*values, strict=True))
    return head, rows
