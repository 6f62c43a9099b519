"""Loss map of a train: what each element loses over speed and torque of the driven shaft."""

from __future__ import annotations

import hashlib
import math
from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from drivetrain.train.train_file import TrainCase
from gearlube.output.csv_text import csv_text, number_text
from gearlube.plotting.style import PARTS, house_style, label_contours, new_figure
from gearlube.report.parts import NOTE, WARNING, Finding
from gearlube.report.result import Result
from gearlube.studies.drivetrain.operation import Operation
from gearlube_core import __version__
from gearlube_core.arrays import Array
from gearlube_core.checks import check_within
from gearlube_core.errors import ParameterError
from gearlube_core.progress import Progress, no_progress
from gearlube_core.storage.atomic_file import write_dataset, write_text
from gearlube_core.storage.process_pool import ProcessPool
from gearlube_core.storage.resumable import ARRAYS, Finished, Record, ResultStore, resumable_results
from gearlube_core.units import rads_to_rpm

FILE = "loss_map.nc"
_SPEEDS = (0.1, 0.25, 0.5, 0.75, 1.0, 1.25)  # over that of the start
_TORQUES = (-0.5, -0.25, -0.1, 0.1, 0.25, 0.5, 0.75, 1.0, 1.25)  # likewise; 0 has no rest
_PERIODS, _SHORTEST, _LONGEST = 4.0, 2e-3, 0.25  # of the slowest mesh; s, of the mean
_STEPS = 8  # of a settling, and of a mean
_MOST_POINTS = 5000
_MOST_DRIFT = 0.2  # of the mean speed from the wanted one
_LEAST_KEPT = 0.5  # share of the input, below which no efficiency is stated
_SHOWN, _LEAST_SHARE = 7, 2e-3  # losses by name, and of their sum
_SAME = 0.1  # %, of efficiencies
_LEAST_DRAWN = 25.0  # % of the points, whose efficiency is below the lowest line


def map_losses(
    case: TrainCase,
    *,
    speeds: Array | None = None,
    torques: Array | None = None,
    folder: Path | None = None,
    progress: Progress = no_progress,
) -> Result:
    """Return the losses of each element of a train over speed and torque of its driven shaft.

    Each point runs in time from its equilibrium; the loads take what losses leave.

    Parameters
    ----------
    case : TrainCase
    speeds, torques : ndarray, optional
        Of the shaft, rising [rad/s], [N.m]; torques below 0 brake. Default: 6 speeds and 9
        torques about those of the start.
    folder : Path, optional
        Folder for FILE and a CSV table; points are kept in its folder parts, so that a stopped map
        goes on from there.
    progress : callable, optional

    Returns
    -------
    xarray.Dataset
        `loss` [W] over `speed` [rpm], `torque` [N.m] and `source`, an element and its kind of loss;
        `efficiency` and `load_torque`. A point without equilibrium is NaN; `failure` says why.

    Raises
    ------
    ParameterError
        A number is out of range, or nothing drives the train.

    Examples
    --------
    >>> from drivetrain.train.train_file import TrainFile
    >>> axle = TrainFile.named("hypoid_axle").case()
    >>> found = map_losses(axle, speeds=np.array([200.0]), torques=np.array([50.0]))
    >>> round(100.0 * found["efficiency"].item(), 1)  # %
    96.2
    """
    operation = Operation.of(case)
    speeds = operation.speed * np.array(_SPEEDS) if speeds is None else speeds
    torques = operation.torque * np.array(_TORQUES) if torques is None else torques
    for name, values in (("speeds", speeds), ("torques", torques)):
        if values.ndim != 1 or values.size == 0 or np.any(np.diff(values) <= 0.0):
            raise ParameterError(f"{name} of the map must be rising numbers, got {values}.")
    check_within("points of the map", speeds.size * torques.size, 1, _MOST_POINTS)
    check_within("lowest speed of the map", float(speeds[0]), 1e-3 * operation.speed, 1e5, "rad/s")
    tasks = [(float(w), float(t)) for w in speeds for t in torques]
    sources, results = point_losses(operation, tasks, folder)
    shape = speeds.size, torques.size
    lost, load = np.full((*shape, len(sources)), math.nan), np.full(shape, math.nan)
    failure = np.full(shape, "", dtype=object)
    for k, (task, found, _) in enumerate(results):
        at = np.unravel_index(tasks.index(task), shape)
        failure[at] = str(found["failure"])
        if not failure[at]:
            lost[at], load[at] = found["lost"], float(found["load"])
        rpm = float(rads_to_rpm(task[0]))
        progress((k + 1) / len(tasks), f"loss map, {rpm:.4g} rpm and {task[1]:.4g} N.m")
    dataset = _dataset(operation, speeds, torques, sources, lost, load, failure)
    dataset = Result.of(dataset, "train map")
    if folder is not None:
        write_dataset(dataset, folder / FILE)
        head = ["speed_rpm", "torque_n_m", "load_torque_n_m", "efficiency", *sources]
        rows = [
            [
                number_text(float(one))
                for one in (rads_to_rpm(w), t, load[i, j], dataset["efficiency"][i, j], *lost[i, j])
            ]
            for i, w in enumerate(speeds)
            for j, t in enumerate(torques)
        ]
        write_text(csv_text(head, rows), folder / "loss_map.csv")
    return dataset


def point_losses(
    operation: Operation, tasks: Sequence[tuple[float, float]], folder: Path | None
) -> tuple[list[str], Iterator[Finished[tuple[float, float], Record]]]:
    """Return what loses power, and the losses at speeds and torques as they are found.

    A result has `lost` [W], `load` [N.m] and `failure`, empty where there is an equilibrium. Points
    are kept in `folder`.
    """
    case = operation.case
    train = case.train.changed(losses_by_element=True)
    operation = replace(operation, case=replace(case, train=train))
    whole = _key(operation)
    results = resumable_results(
        tasks,
        lambda task: f"{whole}_{task[0]:.9g}_{task[1]:.9g}",
        partial(_point, operation),
        ResultStore(None if folder is None else folder / "parts", ARRAYS),
        ProcessPool(jobs=1),
        failed=_failed,
    )
    return list(train.assembly.losses), results


def _key(operation: Operation) -> str:
    """Return a hash of the train, before it moves, and of what it starts from."""
    made, case = operation.case.train.assembly, operation.case
    given = (__version__, made.names, dict(case.speeds), dict(case.torques), case.oil_temperature)
    found = hashlib.sha256(repr(given).encode())
    for one in (made.numbers, made.memory, made.plan):
        found.update(np.ascontiguousarray(one).tobytes())
    return found.hexdigest()[:20]


def _point(operation: Operation, task: tuple[float, float]) -> Record:
    """Return the mean losses at a speed and torque, and the torque of the loads.

    Torques balance at the start of a mesh cycle, over a whole one not quite: a slow train gains or
    loses speed. Its losses are taken over the mean speed, and stand for the wanted one.
    """
    case = operation.at(*task)
    train, found = case.train, case.train.outputs()
    meshes = [abs(v) for name, v in found.items() if name.endswith(".frequency") and v]
    slowest = min(meshes, default=math.inf)
    time = min(max(_PERIODS / slowest, _SHORTEST), _LONGEST)
    for _ in range(_STEPS):  # what swings at the start
        train.step(time / _STEPS, case.torques, case.oil_temperature)
    before, turned = np.array(list(train.lost.values())), []
    for _ in range(_STEPS):
        turned.append(train.outputs()[f"{operation.shaft}.speed"])
        train.step(time / _STEPS, case.torques, case.oil_temperature)
    turned.append(train.outputs()[f"{operation.shaft}.speed"])
    speed = operation.turns * float(np.mean(0.5 * (np.array(turned[1:]) + turned[:-1])))
    if not abs(speed / task[0] - 1.0) <= _MOST_DRIFT:
        drift = (
            f"The mean speed of {operation.title} drifts to {rads_to_rpm(speed):.4g} rpm, where "
            f"{rads_to_rpm(task[0]):.4g} rpm are wanted: at so low a speed the loads of one mesh "
            "cycle do not balance. Take a higher speed."
        )
        return _failed(task, ParameterError(drift))
    lost = (np.array(list(train.lost.values())) - before) / time * task[0] / speed
    load = task[1] - float(lost.sum()) / task[0]
    return {"lost": lost, "load": np.array(load), "failure": np.array("")}


def _failed(_task: tuple[float, float], reason: Exception) -> Record:
    return {"lost": np.zeros(0), "load": np.zeros(()), "failure": np.array(str(reason))}


def _dataset(
    operation: Operation,
    speeds: Array,
    torques: Array,
    sources: list[str],
    lost: Array,
    load: Array,
    failure: Any,
) -> xr.Dataset:
    total = lost.sum(axis=-1)
    driven = speeds[:, None] * np.where(torques > 0.0, torques, -load)  # what is put in
    kept = 1.0 - total / np.where(driven > 0.0, driven, math.nan)
    grid = ("speed", "torque")
    return xr.Dataset(
        {
            "loss": ((*grid, "source"), lost, {"units": "W", "long_name": "mean power lost"}),
            "efficiency": (
                grid,
                np.where(kept > _LEAST_KEPT, kept, math.nan),
                {"units": "1", "long_name": "efficiency"},
            ),
            "load_torque": (
                grid,
                load,
                {"units": "N.m", "long_name": "torque of all loads at the driven shaft"},
            ),
            "failure": (grid, failure.astype(str), {"long_name": "why a point failed"}),
        },
        coords={
            "speed": ("speed", rads_to_rpm(1.0) * speeds, {"units": "rpm"}),
            "torque": ("torque", torques, {"units": "N.m"}),
            "source": sources,
        },
        attrs={"name": operation.case.name, "shaft": operation.title},
    )


def loss_figure(dataset: xr.Dataset) -> Any:
    """Draw losses and efficiency over speed and torque, and the losses of elements over torque."""
    given = dataset["torque"].values
    if given[0] < 0.0 < given[-1] and 0.0 not in given:  # no line joins braking and driving
        dataset = dataset.reindex(torque=np.sort([*given, 0.0]))
    total = dataset["loss"].sum("source", skipna=False)
    shaft = dataset.attrs["shaft"]
    from matplotlib.ticker import MaxNLocator

    with house_style():
        figure = new_figure(10.0, 4.6)
        left, right = figure.subplots(1, 2)
        if min(total.shape) > 1:
            drawn = left.contourf(total["speed"], total["torque"], total.T, 12, cmap="cividis")
            figure.colorbar(drawn, ax=left, label="power lost [W]")
            points = (one.ravel() for one in np.meshgrid(total["speed"], given))
            left.plot(*points, "k.", ms=4, clip_on=False)
            title, share = "losses", 100.0 * dataset["efficiency"].T
            if np.isfinite(share).any() and float(share.max() - share.min()) > _SAME:
                # efficiency falls steeply near torque 0, where lines would hide all others
                ends = np.nanpercentile(share, _LEAST_DRAWN), float(share.max())
                levels = MaxNLocator(6).tick_values(*ends)
                lines = left.contour(share["speed"], share["torque"], share, levels, colors="white",
                                     linewidths=0.8)  # fmt: skip
                label_contours(left, lines, "%.4g %%")
                title = "losses, white: efficiency"
            left.set(title=title, xlabel=f"speed of {shaft} [rpm]", facecolor="0.8")
            left.set(ylabel=f"torque of {shaft} [N·m]")
        else:
            over, unit = ("torque", "N·m") if len(total) == 1 else ("speed", "rpm")
            left.plot(total[over], total.values.ravel(), marker="o")
            left.set(title="all losses", xlabel=f"{over} of {shaft} [{unit}]")
            left.set(ylabel="power lost [W]")
        middle = dataset.isel(speed=dataset.sizes["speed"] // 2)
        losses = middle["loss"].transpose("source", "torque")
        parts = largest(losses.values, losses.mean("torque").values, losses["source"].values)
        words, powers = [name for name, *_ in parts], [power for _, power, _ in parts]
        right.stackplot(losses["torque"], powers, labels=words, colors=PARTS, alpha=0.85)
        right.plot(losses["torque"], losses.sum("source", skipna=False), "k.", ms=4, clip_on=False)
        right.set(
            title=f"by element, at {float(middle['speed']):.4g} rpm",
            xlabel=f"torque of {shaft} [N·m]",
            ylabel="power lost [W]",
        )
        figure.legend(loc="outside lower center", ncols=3)
    return figure


def largest(powers: Array, means: Array, sources: Any) -> list[tuple[str, Array, float]]:
    """Return name, power and mean of the largest losses, and of all others together.

    Powers have a row for each source.
    """
    order = [i for i in np.argsort(-means) if means[i] > _LEAST_SHARE * means.sum()]
    named = [int(i) for i in order[:_SHOWN]]
    others = [i for i in range(means.size) if i not in named]
    found = [(source_name(str(sources[i])), powers[i], float(means[i])) for i in named]
    return [*found, ("all others", powers[others].sum(axis=0), float(means[others].sum()))]


def source_name(source: str) -> str:
    """Return the words for a source of loss: its element and kind."""
    element, _, kind = source.rpartition(".")
    text = element if element == kind else f"{element}: {kind}"
    return text.replace("_", " ").replace(".nodes", "")


def of_map(dataset: xr.Dataset | None) -> list[Finding]:
    """Return the findings of a map, the most important first."""
    if dataset is None:
        return []
    found = []
    share = dataset["efficiency"]
    if np.isfinite(share).any():
        best = {str(name): int(one) for name, one in share.argmax(...).items()}
        there = share[best]
        found.append(
            Finding(
                NOTE,
                f"The best efficiency of the map is {100.0 * float(there):.2f} %, at "
                f"{float(there['speed']):.4g} rpm and {float(there['torque']):.4g} N·m.",
            )
        )
    failed = dataset["failure"].values[dataset["failure"].values != ""]
    if failed.size:
        words = f"{failed.size} of {dataset['failure'].size} points of the map have no equilibrium."
        found.append(Finding(WARNING, words, str(failed[0])))
    return found
