"""Figures of a drivetrain, and the losses and errors of a run that they draw."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from gearlube.plotting.style import SERIES, house_style, new_figure
from gearlube.report.pictures import save_picture
from gearlube.studies.drivetrain.cycle import CYCLE_FIGURE
from gearlube.studies.drivetrain.layout import layout, layout_figure
from gearlube.studies.drivetrain.losses import loss_figure
from gearlube.studies.drivetrain.orders import (
    DAMPING_RATIO,
    LEAST,
    campbell_figure,
    order_figure,
)
from gearlube.studies.drivetrain.ramp import waterfall_figure
from gearlube.studies.drivetrain.vibration import response_figure
from gearlube_core.dynamics.train.model import Train

_DIGITS = 9  # behind the point, of a loss in W
_LEAST_SHARE = 1e-3  # of the losses, that is drawn
_MOST_MODES = 30  # in the figure
_SHOWN = 0.1  # last part of the run, of which the transmission errors are drawn
_DTE, _LOSS = ".dte", ".power_loss"


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
    meshes = list(transmission_errors(dataset))
    with house_style():
        figure = new_figure(7.2, 0.6 + 2.0 * len(meshes))
        axes = figure.subplots(len(meshes), 1, squeeze=False, sharex=True).ravel()
        for ax, mesh in zip(axes, meshes, strict=True):
            ax.plot(1e3 * end["time"], 1e6 * end[mesh + _DTE])
            ax.set(title=mesh, ylabel="transmission error [µm]")
        axes[-1].set_xlabel("time [ms]")
    return figure


def power_figure(dataset: xr.Dataset) -> Any:
    """Return the power lost by kind, mean of the second half of a run."""
    found = losses(dataset)
    least = _LEAST_SHARE * sum(found.values())
    found = {name.replace("_", " "): one for name, one in found.items() if one > least}
    with house_style():
        figure = new_figure(7.2, 1.2 + 0.35 * len(found))
        ax = figure.subplots()
        ax.barh(list(found), list(found.values()), color=SERIES[0])
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


FIGURES: dict[str, tuple[Callable[[Any], Any], str, str]] = {
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
        "Mean of the second half of the run, summed over all elements. Kinds below 0.1 % of it are "
        "left out.",
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


OF_STUDIES: dict[str, tuple[Callable[[Any], Any], str, str]] = {
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
    for name, (draw, *_) in FIGURES.items():
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
        save_picture(draw(found if name == "layout" else dataset), files[name])
    for name, (draw, *_) in OF_STUDIES.items():
        study = {"loss_map": loss_map, "cycle": cycle}.get(name, runup)
        if study is not None:
            files[name] = folder / f"{name}.png"
            save_picture(draw(study), files[name])
    return files
