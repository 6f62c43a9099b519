"""Figures and report of a drivetrain."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from gearlube.plotting.style import SERIES, house_style, new_figure
from gearlube.report.numbers import quantity_text
from gearlube.report.parts import (
    GOOD,
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
from gearlube.studies.drivetrain.cycle import CYCLE_FIGURE, cycle_numbers, cycle_tables, of_cycle
from gearlube.studies.drivetrain.layout import layout, layout_figure
from gearlube.studies.drivetrain.losses import loss_figure, of_map
from gearlube.studies.drivetrain.orders import (
    DAMPING_RATIO,
    LEAST,
    campbell_figure,
    order_figure,
    resonant_speeds,
)
from gearlube.studies.drivetrain.ramp import loudest, waterfall_figure
from gearlube.studies.drivetrain.vibration import carried, response_figure
from gearlube_core.dynamics.train.model import Train
from gearlube_core.rexs.stage import ExchangeNote
from gearlube_core.storage.atomic_file import write_figure
from gearlube_core.units import rads_to_rpm

_BALANCED = 1e-3  # share of the energy that may be missing before the report warns
_DIGITS = 9  # behind the point, of a loss in W
_STEADY = 0.02  # change of a speed in a run, over the speed
_AT_REST = 0.05  # speed that counts as none [rad/s]
_NO_LOSS = 1e-9  # W, rounding
_LEAST_SWING = 1e-12  # m, of a transmission error; below is rounding
_ROUNDING = 1e-14  # of energies, below which nothing is missing
_MOST_MODES = 30  # in the figure
_SHOWN = 0.1  # last part of the run, of which the transmission errors are drawn
_DTE, _LOSS = ".dte", ".power_loss"
_LIMITS = (
    "Bodies are rigid but for those of the kinds shaft and housing; bearings that name no housing "
    "stand on ground.",
    "The run begins at a static equilibrium with the friction of its first moment; what swings at "
    "first is the passage to the steady motion. Numbers are those of the second half of the run.",
)


def settled(dataset: xr.Dataset) -> xr.Dataset:
    """Return the second half of a run."""
    return dataset.isel(time=slice(dataset.sizes["time"] // 2, None))


def losses(dataset: xr.Dataset) -> dict[str, float]:
    """Return the mean losses in the second half of a run by name, the largest first [W]."""
    half = settled(dataset)
    found = {
        str(name).removesuffix(_LOSS): float(half[name].mean().round(_DIGITS))
        for name in half.data_vars
        if str(name).endswith(_LOSS) and "." not in str(name).removesuffix(_LOSS)
    }
    return dict(sorted(found.items(), key=lambda one: -one[1]))


def efficiency(dataset: xr.Dataset) -> float:
    """Return the mean efficiency of the second half [-]; NaN if more is lost than driven."""
    found = float(settled(dataset)["efficiency"].mean())
    return found if found > 0.0 else math.nan


def transmission_errors(dataset: xr.Dataset) -> dict[str, float]:
    """Return peak-to-peak transmission errors of all meshes in the second half of a run [m]."""
    half = settled(dataset)
    return {
        str(name).removesuffix(_DTE): float(half[name].max() - half[name].min())
        for name in half.data_vars
        if str(name).endswith(_DTE)
    }


def _motion_figure(dataset: xr.Dataset) -> Any:
    end = dataset.isel(time=slice(-max(2, int(_SHOWN * dataset.sizes["time"])), None))
    names = [str(name) for name in end.data_vars if str(name).endswith(_DTE)]
    with house_style():
        figure = new_figure(7.2, 0.6 + 2.0 * len(names))
        panels = figure.subplots(len(names), 1, squeeze=False, sharex=True).ravel()
        for ax, name in zip(panels, names, strict=True):
            ax.plot(1e3 * end["time"], 1e6 * end[name])
            ax.set(title=name.removesuffix(_DTE), ylabel="transmission error [µm]")
        panels[-1].set_xlabel("time [ms]")
    return figure


def power_figure(dataset: xr.Dataset) -> Any:
    """Return the power lost by kind, mean of the second half of a run."""
    found = {name: value for name, value in losses(dataset).items() if value > 0.0}
    with house_style():
        figure = new_figure(7.2, 1.2 + 0.35 * len(found))
        ax = figure.subplots()
        ax.barh([one.replace("_", " ") for one in found], list(found.values()), color=SERIES[0])
        ax.invert_yaxis()
        ax.set(xlabel="mean power lost [W]")
    return figure


def _mode_figure(dataset: xr.Dataset) -> Any:
    found = len(dataset["frequency"])
    dataset = dataset.isel(mode=slice(_MOST_MODES))
    frequency = dataset["frequency"].values
    with house_style():
        figure = new_figure(7.2, 1.4 + 0.24 * len(frequency))
        ax = figure.subplots()
        left = np.zeros(len(frequency))
        for i, body in enumerate(dataset["body"].values):
            share = dataset["share"].values[:, i]
            look = {"color": SERIES[i % len(SERIES)], "hatch": "" if i < len(SERIES) else "//"}
            ax.barh(range(len(frequency)), share, left=left, label=str(body), **look)
            left += share
        ax.set_yticks(range(len(frequency)), [f"{one:.4g} Hz" for one in frequency])
        ax.set_ylim(len(frequency) - 0.5, -0.5)
        ax.set(xlabel="share in the kinetic energy [-]", xlim=(0.0, 1.0))
        if found > len(frequency):
            ax.set_title(f"the lowest {len(frequency)} of {found}")
        figure.legend(ncols=min(5, dataset.sizes["body"]), loc="outside lower center")
    return figure


_FIGURES: dict[str, tuple[Callable[[Any], Any], str, str]] = {
    "layout": (
        layout_figure,
        "Where shafts, gears and bearings are",
        "Pitch circles of gears on parallel axes, dashed: rings. On the right a section through "
        "the unfolded axes, with what acts on their nodes; rings are hatched. Stages stand side by "
        "side where the file does not say how far apart they are.",
    ),
    "transmission_error": (
        _motion_figure,
        "Transmission error of every mesh",
        "Last tenth of the run. A mesh that swings far more than the others is near a resonance.",
    ),
    "losses": (
        power_figure,
        "Where the power goes",
        "Mean of the second half of the run; losses of one kind are summed over all elements.",
    ),
    "modes": (
        _mode_figure,
        "Natural frequencies, and which bodies move",
        "Undamped, about the state at the start, with the meshes in contact. A bar of one colour "
        "is a mode of one body on its bearings. The table below has all modes.",
    ),
    "response": (
        response_figure,
        "Forces that a transmission error or a motor's ripple makes",
        "Amplitude over that of a sinusoidal error of a mesh, the first of equal ones, or of a "
        f"torque, with mean stiffness and {100.0 * DAMPING_RATIO:g} % damping of all modes; solid: "
        "meshes, others: bearings. Flanks stay in contact.",
    ),
    "orders": (
        order_figure,
        "Forces by order",
        "Amplitude over speed, by frequency: the meshes with the swing of their stiffness and gaps "
        "at the torque of the start, the motor with its table of ripple. Flanks stay in contact.",
    ),
    "campbell": (
        campbell_figure,
        "Speeds at which orders meet natural frequencies",
        "Lines from the origin: orders of meshes and motors, thin ones are not excited; grey: "
        "natural frequencies; dotted: the speed of this run.",
    ),
}


_OF_STUDIES: dict[str, tuple[Callable[[Any], Any], str, str]] = {
    "waterfall": (
        waterfall_figure,
        "Waterfall of the run-up",
        "Spectra in time, with flanks that may open: all forces of bearings and supports, or the "
        "velocity of a housing, mean over its nodes. Dotted: orders of meshes and motors.",
    ),
    "runup_orders": (
        order_figure,
        "Orders of the run-up",
        "Solid: in time. Dotted: by frequency, with flanks in contact; where both part, flanks "
        "open, swings are large, or the ramp is too fast for a resonance to build up.",
    ),
    "loss_map": (
        loss_figure,
        "Losses over speed and torque",
        "Means of runs in time, each from its equilibrium; the loads take what losses leave. "
        "Torques below 0 brake; without torque there is no equilibrium.",
    ),
    "cycle": CYCLE_FIGURE,
}


def save_figures(
    dataset: xr.Dataset,
    train: Train,
    folder: Path,
    runup: xr.Dataset | None = None,
    loss_map: xr.Dataset | None = None,
    cycle: xr.Dataset | None = None,
) -> dict[str, Path]:
    """Draw every figure of a run of a train into `folder` as PNG; return the files by name."""
    found = layout(train)
    folder.mkdir(parents=True, exist_ok=True)
    files = {}
    for name, (draw, *_) in _FIGURES.items():
        if name == "transmission_error" and not transmission_errors(dataset):
            continue
        if name == "layout" and not found.gears:
            continue
        if name == "response" and not {"response", "torque_response"} & set(dataset):
            continue
        if name in ("orders", "campbell") and "order_force" not in dataset:
            continue
        if name == "orders" and not float(dataset["order_force"].max()) > LEAST:
            continue
        files[name] = folder / f"{name}.png"
        write_figure(draw(found if name == "layout" else dataset), files[name])
    for name, (draw, *_) in _OF_STUDIES.items():
        study = {"loss_map": loss_map, "cycle": cycle}.get(name, runup)
        if study is not None:
            files[name] = folder / f"{name}.png"
            write_figure(draw(study), files[name])
    return files


def findings(dataset: xr.Dataset) -> list[Finding]:
    """Return the findings of a run, the most important first."""
    found = [*_warnings(str(dataset.attrs["exceeded"]).splitlines()), *_drift(dataset)]
    lost = losses(dataset)
    share_kept = efficiency(dataset)
    if (total := sum(lost.values())) > _NO_LOSS:
        name, most = next(iter(lost.items()))
        share = "" if np.isnan(share_kept) else f", {100.0 * share_kept:.2f} % efficiency"
        found.append(
            Finding(
                NOTE,
                f"The drivetrain loses {quantity_text(total, 'W')} at the file's speed and torque"
                f"{share}.",
                f"Most is {name.replace('_', ' ')}: {quantity_text(most, 'W')}.",
            )
        )
    for mesh, swing in transmission_errors(dataset).items():
        words = f"swings by {1e6 * swing:.3g} µm" if swing > _LEAST_SWING else "does not swing"
        found.append(Finding(NOTE, f"The transmission error of {mesh} {words}."))
    missing = float(dataset.attrs["imbalance"])
    share = f"{100.0 * missing:.2g} %" if missing > _ROUNDING else "nothing"
    words = f"{share} of the energy that passed through is unaccounted for."
    if missing > _BALANCED:
        found.append(Finding(WARNING, words, "Take more steps_per_highest_period."))
    else:
        found.append(Finding(GOOD, f"The energy balance closes: {words}"))
    return found


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
            *_warnings(clashes),
            *of_cycle(cycle),
            *findings(dataset),
            *loudest(runup),
            *of_map(loss_map),
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
        figures=[
            *views,
            *(
                Figure(name=name, title=title, caption=words, picture=figures[name].read_bytes())
                for name, (_, title, words) in (_FIGURES | _OF_STUDIES).items()
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
