"""The report of a drivetrain."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import xarray as xr

from gearlube.report.numbers import quantity_text
from gearlube.report.parts import (
    NOTE,
    WARNING,
    Cell,
    Column,
    Figure,
    Finding,
    Input,
    Number,
    Report,
    Table,
)
from gearlube.report.pictures import kept_figure
from gearlube.studies.drivetrain.cycle import cycle_numbers, cycle_tables, of_cycle
from gearlube.studies.drivetrain.figures import (
    FIGURES,
    OF_STUDIES,
    losses,
    settled,
    transmission_errors,
)
from gearlube.studies.drivetrain.losses import of_map
from gearlube.studies.drivetrain.orders import resonant_speeds
from gearlube.studies.drivetrain.ramp import loudest
from gearlube.studies.drivetrain.vibration import carried
from gearlube_core.rexs.stage import ExchangeNote
from gearlube_core.units import rads_to_rpm

_BALANCED = 1e-3  # share of the energy that may be missing before the report warns
_STEADY = 0.02  # change of a speed in a run, over the speed
_AT_REST = 0.05  # speed that counts as none [rad/s]
_NO_LOSS = 1e-9  # W, rounding
_LEAST_SWING = 1e-12  # m, of a transmission error; below is rounding
_LEAST_MISSING = 1e-8  # of energies, below which only this is said
_MAIN = (
    "cycle", "loss_map", "runup_orders", "waterfall", "losses", "transmission_error", "campbell",
    "orders", "modes", "layout",
)  # fmt: skip
_LIMITS = (
    "Bodies are rigid but for those of the kinds shaft and housing; bearings that name no housing "
    "stand on ground.",
    "The run begins at a static equilibrium with the friction of its first moment; what swings at "
    "first is the passage to the steady motion. Numbers are those of the second half of the run.",
)


def efficiency(dataset: xr.Dataset) -> float:
    """Return the mean efficiency of the second half [-]; NaN if more is lost than driven."""
    found = float(settled(dataset)["efficiency"].mean())
    return found if found > 0.0 else math.nan


def findings(dataset: xr.Dataset) -> list[Finding]:
    """Return the findings of a run, the answer first."""
    lost, share_kept = losses(dataset), efficiency(dataset)
    missing = float(dataset.attrs["imbalance"])
    share = quantity_text(1e6 * missing, "ppm", 2) if missing > _LEAST_MISSING else "below 0.01 ppm"
    unknown = f"{share} of the energy that passed through is unaccounted for."
    found = []
    if (total := sum(lost.values())) > _NO_LOSS:
        name, most = next(iter(lost.items()))
        kept = "" if np.isnan(share_kept) else f", {100.0 * share_kept:.2f} % efficiency"
        found.append(
            Finding(
                NOTE,
                f"The drivetrain loses {quantity_text(total, 'W')} at the file's speed and torque"
                f"{kept}.",
                f"Most is {name.replace('_', ' ')}: {quantity_text(most, 'W')}. Energy balance: "
                f"{unknown} How well friction and oil are known is not in these numbers.",
            )
        )
    if swings := transmission_errors(dataset):
        words = ", ".join(
            f"{mesh} {quantity_text(1e6 * swing if swing > _LEAST_SWING else 0.0, 'µm')}"
            for mesh, swing in swings.items()
        )
        found.append(Finding(NOTE, f"Transmission errors, peak to peak: {words}."))
    if missing > _BALANCED:
        cure = "Take more steps_per_highest_period."
        found.append(Finding(WARNING, f"{unknown[0].upper()}{unknown[1:]}", cure))
    return [*found, *_warnings(str(dataset.attrs["exceeded"]).splitlines()), *_drift(dataset)]


def _warnings(sentences: Sequence[str]) -> list[Finding]:
    return [
        Finding(WARNING, f"{one.partition('. ')[0].rstrip('.')}.", one.partition(". ")[2])
        for one in sentences
    ]


def _turning(dataset: xr.Dataset) -> list[str]:
    """Return the bodies that turn: all but housings."""
    return [str(body) for body in dataset["body"].values if f"{body}.speed" in dataset]


def _drift(dataset: xr.Dataset) -> list[Finding]:
    """Return a warning if the torques drive the train away from its speed."""
    name = max(
        _turning(dataset),
        key=lambda body: float(abs(dataset[f"{body}.speed"][-1] - dataset[f"{body}.speed"][0])),
    )
    first, last = (float(rads_to_rpm(dataset[f"{name}.speed"].values[i])) for i in (0, -1))
    if abs(last - first) <= _STEADY * max(abs(first), float(rads_to_rpm(_AT_REST))):
        return []
    return [
        Finding(
            WARNING,
            f"The speed of {name} changes from {first:.4g} to {last:.4g} rpm.",
            "The torques do not balance. For a steady run give the load what the drive leaves "
            "after losses.",
        )
    ]


def _exchanged(notes: Sequence[ExchangeNote]) -> list[Table]:
    """Return the outcome of the numbers of a REXS file."""
    words = {"lacking": "assumed", "inferred": "follows", "left out": "left out"}
    rows = [[words[kind], what, why] for kind, what, why in notes if kind in words]
    if not rows:
        return []
    columns = [Column("", ""), Column("what"), Column("value, or why")]
    caption = "train.toml has it all: correct what matters there, and run it."
    return [Table(title="What the REXS file does not say", columns=columns, rows=rows,
                  caption=caption)]  # fmt: skip


def report(
    dataset: xr.Dataset,
    figures: dict[str, Path],
    inputs: Sequence[Input],
    notes: Sequence[ExchangeNote] = (),
    runup: xr.Dataset | None = None,
    loss_map: xr.Dataset | None = None,
    cycle: xr.Dataset | None = None,
    views: Sequence[Figure] = (),
    clashes: Sequence[str] = (),
) -> Report:
    """Return the report of a run, and of a run-up, a map and a cycle beside it.

    `notes` are those of a REXS file, `views` come before all figures; `clashes` are sentences.
    """
    half, lost = settled(dataset), losses(dataset)
    speeds = [(b, float(rads_to_rpm(half[f"{b}.speed"].values.mean()))) for b in _turning(dataset)]
    modes: list[Sequence[Cell]] = [
        [float(frequency), str(dataset["body"].values[np.argmax(share)]), float(share.max())]
        for frequency, share in zip(
            dataset["frequency"].values, dataset["share"].values, strict=True
        )
    ]
    end = 1e3 * float(dataset["time"][-1])
    return Report(
        study="drivetrain",
        title=str(dataset.attrs["name"]),
        subtitle=f"Modes, and a run of {end:.4g} ms from the static equilibrium.",
        findings=[
            *of_cycle(cycle),
            *of_map(loss_map),
            *loudest(runup),
            *findings(dataset),
            *_warnings(clashes),
        ],
        numbers=[
            *cycle_numbers(cycle),
            Number("power lost", sum(lost.values()), "W"),
            Number("efficiency", 100.0 * efficiency(dataset), "%", 4),
            *(
                Number(f"transmission error of {mesh}, peak to peak", 1e6 * swing, "µm")
                for mesh, swing in transmission_errors(dataset).items()
            ),
        ],
        main_figures=[one for one in _MAIN if one in figures][:7] + [one.name for one in views],
        figures=[
            *views,
            *(
                kept_figure(name, title, words, figures[name])
                for name, (_, title, words) in (FIGURES | OF_STUDIES).items()
                if name in figures
            ),
        ],
        tables=[
            Table(
                title="Speeds",
                columns=[Column("body"), Column("speed", "rpm", 5)],
                rows=speeds,
                caption="Mean of the second half of the run, about +z.",
            ),
            *cycle_tables(cycle),
            *_exchanged(notes),
            *carried(dataset),
            *resonant_speeds(dataset),
            Table(
                title="Modes",
                columns=[
                    Column("frequency", "Hz", 4),
                    Column("body that moves most"),
                    Column("its share in the kinetic energy", "", 2),
                ],
                rows=modes,
                folded=True,
            ),
        ],
        inputs=inputs,
        limits=_LIMITS,
        files=(
            "drivetrain.nc",
            *(["runup.nc"] if runup is not None else []),
            *(["loss_map.nc", "loss_map.csv"] if loss_map is not None else []),
            *(["cycle.nc", "cycle.csv"] if cycle is not None else []),
            "figures/",
            *(["train.toml"] if notes else []),
        ),
    )
