"""A train over a drive cycle: the energy that each element loses."""

from __future__ import annotations

from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import xarray as xr

from drivetrain.cycle.demand import Demand, felt_mass, shaft_demand
from drivetrain.cycle.loss_field import LossField, speed_nodes, torque_nodes
from drivetrain.cycle.traces import DriveCycle
from drivetrain.train.train_file import TrainCase
from gearlube.output.csv_text import csv_text
from gearlube.plotting.cycle import cycle_panels
from gearlube.plotting.style import PARTS, house_style
from gearlube.report.cycle import (
    KJ,
    Variable,
    energy,
    energy_lost,
    energy_table,
    step_rows,
    steps_dataset,
    variables_of,
)
from gearlube.report.numbers import quantity_text
from gearlube.report.parts import GOOD, WARNING, Finding, Number, Table
from gearlube.report.result import Result
from gearlube.studies.drivetrain.losses import largest, map_losses, point_losses, source_name
from gearlube.studies.drivetrain.operation import Operation
from gearlube_core.arrays import Array
from gearlube_core.checks import check_within
from gearlube_core.errors import ParameterError
from gearlube_core.progress import Progress, no_progress, part_of
from gearlube_core.storage.atomic_file import write_dataset, write_text
from gearlube_core.units import ZERO_CELSIUS, rads_to_rpm, rpm_to_rads

FILE = "cycle.nc"
_N_SPEEDS, _N_TORQUES = 12, 18  # of the map
_SLOWEST = 1e-3  # of the speed of the start, below which a map has no points
_RESERVE = 0.1  # of the largest torque, and of that of the start, for the train's own losses
_FRESH = 10  # steps that run by themselves
_GOOD, _BALANCED = 0.02, 1e-6  # shares of the energy lost, and of that put in


class CyclePlan(NamedTuple):
    """Demands of a cycle on a train, and the map that covers them."""

    operation: Operation
    cycle: DriveCycle
    demand: Demand
    speeds: Array  # rad/s
    torques: Array  # N.m


def plan_cycle(case: TrainCase, cycle: DriveCycle, regeneration: float = 1.0) -> CyclePlan:
    """Return the plan of a cycle; arguments and errors are those of `train_cycle`."""
    check_within("regeneration", regeneration, 0.0, 1.0, "", "A half is 0.5.")
    if case.car is None:
        raise ParameterError(
            f"A drive cycle needs a vehicle, got none in {case.name}. Give the train file the "
            "sections [vehicle] with mass_kg, drag_area_m2, rolling_coefficient, "
            "wheel_inertia_kg_m2, and [tyre] with size."
        )
    operation = Operation.of(case)
    demand = shaft_demand(
        cycle, case.car, ratio=operation.ratio, coast_torque=0.0, regeneration=regeneration
    )
    fastest = float(demand.shaft_speed.max())
    if fastest <= 0.0:
        raise ParameterError(f"The car must move in {cycle.name}, got no speed above 0. Check it.")
    speeds = speed_nodes(_N_SPEEDS, fastest)
    if (short := _SLOWEST * operation.speed / float(speeds[0])) > 1.0:
        kmh = 3.6 * float(demand.speed.max())
        raise ParameterError(
            f"The highest speed of {cycle.name} must be at least {short * kmh:.3g} km/h for "
            f"{case.name}, got {kmh:.3g} km/h. Take a faster trace, or lower start.speed_rpm."
        )
    reach = _RESERVE * (float(np.abs(demand.torque).max()) + operation.torque)
    ends = float(demand.torque.min()) - reach, float(demand.torque.max()) + reach
    torques = torque_nodes(_N_TORQUES, min(ends[0], -reach), max(ends[1], reach))
    # without torque flanks do not touch, and there is no equilibrium
    return CyclePlan(operation, cycle, demand, speeds, torques[torques != 0.0])


def train_cycle(
    case: TrainCase,
    cycle: DriveCycle,
    *,
    regeneration: float = 1.0,
    folder: Path | None = None,
    progress: Progress = no_progress,
) -> Result:
    """Return the energy that each element of a train loses over a drive cycle.

    The loads drive the wheels of the car. Each step is a steady one at the speed and torque in its
    middle, at the oil temperature of the case; its losses are read from `map_losses` over the
    speeds and torques of the cycle. Ten steps also run by themselves.

    Parameters
    ----------
    case : TrainCase
        With its car.
    cycle : DriveCycle
        `pinion_speed` and `pinion_torque` are those of the driven shaft.
    regeneration : float
        Share of the braking that goes through the train, 0 to 1; friction brakes do the rest.
    folder : Path, optional
        Folder for FILE, tables and the map, which a stopped cycle goes on from.
    progress : callable, optional
        Receives the share done [-] and a sentence.

    Returns
    -------
    xarray.Dataset
        Over `step`: speeds, torques, `loss` [W] of each `source`, `filled`. `energy_lost` and
        `energy_lost_braking` [kJ] by source, `energy_in` from either side; `map_error`, see Notes.

    Raises
    ------
    ParameterError
        The case has no car, nothing drives it, the cycle is too slow, or the map lacks equilibria.

    Notes
    -----
    Between points of the map the loss torque is linear in speed and torque; through torque 0 it
    goes on as a line from either side. `filled` is the share of the points around a step that have
    no equilibrium and take the losses of their neighbours. `map_error` is by how much the map is
    above the ten steps, which are spread over the energy lost, `map_error_largest` that of the
    worst of them. The motor's own inertia is left out, as its power passes no mesh.

    Examples
    --------
    >>> from drivetrain.train.train_file import TrainFile
    >>> cruise = DriveCycle(name="cruise", time=np.arange(60.0), speed=np.full(60, 20.0))  # m/s
    >>> found = train_cycle(TrainFile.named("hypoid_axle").case(), cruise)  # doctest: +SKIP
    >>> round(found["efficiency"].item(), 3)  # doctest: +SKIP
    0.961
    """
    plan = plan_cycle(case, cycle, regeneration)
    losses = map_losses(
        case,
        speeds=plan.speeds,
        torques=plan.torques,
        folder=folder,
        progress=part_of(progress, 0.0, 0.95),
    )
    return cycle_losses(plan, losses, folder, part_of(progress, 0.95, 1.0))


def cycle_losses(
    plan: CyclePlan,
    losses: xr.Dataset,
    folder: Path | None = None,
    progress: Progress = no_progress,
) -> Result:
    """Return the result of `train_cycle` from the map of its plan."""
    demand, operation = plan.demand, plan.operation
    field, without = _field(losses)
    moves = demand.shaft_speed > 0.0
    speed = demand.shaft_speed[moves]
    torque, lost = demand.torque.copy(), np.zeros((moves.size, losses.sizes["source"]))
    filled = np.zeros(moves.size)
    if not demand.measured:
        cure = "The losses are large beside the torque: check seals and oil."
        torque[moves] = field.with_losses(speed, torque[moves], cure)
    lost[moves] = field.lost(speed, torque[moves])
    filled[moves] = field.between(without, speed, torque[moves])
    total = lost.sum(axis=1)
    put_in = torque * demand.shaft_speed
    dataset = steps_dataset(
        plan.cycle,
        demand,
        torque,
        lost,
        losses["source"].values,
        shaft="shaft",
        ratio=operation.ratio,
    )
    braking = KJ * (np.where(torque < 0.0, demand.steps, 0.0) @ lost)
    found: dict[str, Variable] = {
        "filled": (("step",), filled, "1", "share of points of the map without equilibrium"),
        "energy_lost_braking": (("source",), braking, "kJ", "energy lost while the shaft brakes"),
        "energy_lost_filled": ((), energy(total * (filled > 0.0), demand), "kJ", "with `filled`"),
        "energy_back": ((), energy(np.maximum(-put_in, 0.0), demand), "kJ", "back to the shaft"),
        "energy_road": ((), energy(demand.road, demand), "kJ", "to air, road and slope"),
        **_fresh(operation, demand, torque, total, folder, progress),
    }
    dataset = dataset.assign(variables_of(found)).assign_attrs(
        name=operation.case.name,
        shaft=operation.title,
        oil_temperature_degc=operation.case.oil_temperature - ZERO_CELSIUS,
    )
    cycle, car = plan.cycle, operation.case.car
    if cycle.speed is not None and car is not None:
        gained = 0.5 * felt_mass(car) * (cycle.speed[-1] ** 2 - cycle.speed[0] ** 2)
        used = energy(total + demand.road + demand.brakes, demand) + KJ * gained
        imbalance = abs(energy(put_in, demand) - used) / float(dataset["energy_in"])
        dataset.attrs["imbalance"] = imbalance
    dataset = Result.of(dataset, "train cycle")
    if folder is not None:
        write_dataset(dataset, folder / FILE)
        write_text(csv_text(*step_rows(dataset, "shaft", {"filled": filled})), folder / "cycle.csv")
    return dataset


def _field(losses: xr.Dataset) -> tuple[LossField, Array]:
    """Return the losses of a map with torque 0, and 1 at its points without equilibrium."""
    speeds, torques = rpm_to_rads(1.0) * losses["speed"].values, losses["torque"].values
    power = losses["loss"].values.copy()
    bad = ~np.isfinite(power).all(axis=-1)
    zero = np.zeros((speeds.size, 1, power.shape[-1]))
    for i, row in enumerate(power):
        for side in (torques < 0.0, torques > 0.0):
            good = np.flatnonzero(side & ~bad[i])
            if good.size < 2:
                raise ParameterError(
                    "A cycle needs two points of the map at each speed that drive and two that "
                    f"brake, got {good.size} at {float(losses['speed'][i]):.4g} rpm: "
                    f"{losses['failure'].values[i][side & bad[i]][0]}"
                )
            for one in row.T:
                one[side] = np.interp(torques[side], torques[good], one[good])
            first, second = sorted(np.flatnonzero(side), key=lambda k: abs(torques[k]))[:2]
            share = torques[first] / (torques[second] - torques[first])
            zero[i, 0] += 0.5 * np.maximum(row[first] - share * (row[second] - row[first]), 0.0)
    at = int(np.searchsorted(torques, 0.0))
    field = LossField(
        speeds=speeds,
        torques=np.insert(torques, at, 0.0),
        power=np.concatenate([power[:, :at], zero, power[:, at:]], axis=1),
    )
    return field, np.insert(bad.astype(float), at, 0.0, axis=1)


def _fresh(
    operation: Operation,
    demand: Demand,
    torque: Array,
    total: Array,
    folder: Path | None,
    progress: Progress,
) -> dict[str, Variable]:
    """Return losses of single steps that run by themselves, beside those of the map."""
    run = np.cumsum(total * demand.steps)
    at = np.unique(np.searchsorted(run, run[-1] * (np.arange(_FRESH) + 0.5) / _FRESH))
    tasks = [(float(demand.shaft_speed[i]), float(torque[i])) for i in at]
    own = dict.fromkeys(tasks, np.nan)
    for task, found, _ in point_losses(operation, tasks, folder)[1]:
        progress(0.5, f"{rads_to_rpm(task[0]):.4g} rpm and {task[1]:.4g} N.m by itself")
        own[task] = float(found["lost"].sum()) if not str(found["failure"]) else np.nan
    direct = np.array([own[task] for task in tasks])
    error = total[at] / direct - 1.0
    error = error[np.isfinite(error)]
    mean, most = (error.mean(), error[np.abs(error).argmax()]) if error.size else (np.nan,) * 2
    return {
        "fresh_loss": (("fresh",), direct, "W", "power lost in steps that run by themselves"),
        "fresh_of_map": (("fresh",), total[at], "W", "power lost there by the map"),
        "map_error": ((), float(mean), "1", "map above those runs, mean"),
        "map_error_largest": ((), float(most), "1", "map above those runs, largest"),
    }


def cycle_figure(dataset: xr.Dataset) -> Any:
    """Draw speed, torque and the power lost by element over a cycle."""
    energy, powers = dataset["energy_lost"].values, dataset["loss"].values.T
    parts = largest(powers, energy, dataset["source"].values)
    with house_style():
        lost = [(*one, colour) for one, colour in zip(parts, PARTS, strict=False)]
        figure, _ = cycle_panels(dataset, "shaft_torque", lost)
        figure.axes[-1].set(xlabel="time [s]", xlim=dataset["step"].values[[0, -1]])
        figure.suptitle(
            f"Cycle {dataset.attrs['cycle']}: {quantity_text(float(energy.sum()), 'kJ')} lost, "
            f"{100.0 * float(energy.sum() / dataset['energy_in']):.2f} % of what is put in"
        )
    return figure


CYCLE_FIGURE = (
    cycle_figure,
    "Power lost over the drive cycle",
    "Areas add up. Each step is a steady run at its speed and torque, read from the map. "
    "Below 0 N·m the shaft brakes. The rotor's own inertia is left out.",
)


def of_cycle(dataset: xr.Dataset | None) -> list[Finding]:
    """Return the findings of a cycle, the most important first."""
    if dataset is None:
        return []
    lost, error = float(dataset["energy_lost"].sum()), float(dataset["map_error"])
    braking = 100.0 * float(dataset["energy_lost_braking"].sum()) / lost
    oil = f"{dataset.attrs['oil_temperature_degc']:.4g} °C"
    detail = f"{braking:.0f} % of it is lost while braking. The oil stays at {oil}."
    found = [
        energy_lost(dataset, "The drivetrain", source_name, detail),
        Finding(
            GOOD if abs(error) < _GOOD else WARNING,
            f"Steps of the cycle that run by themselves lose {100.0 * abs(error):.2g} % "
            f"{'less' if error > 0.0 else 'more'} than the map says.",
            f"{np.isfinite(dataset['fresh_loss']).sum().item()} steps over the energy lost; the "
            f"largest difference is {100.0 * abs(float(dataset['map_error_largest'])):.2g} %.",
        ),
    ]
    filled = float(dataset["energy_lost_filled"]) / lost
    if filled > 0.0:
        words = "of the energy is lost between points of the map that have no equilibrium."
        cure = "Their losses are those of the points beside them, see loss_map.csv."
        found.append(Finding(WARNING, f"{100.0 * filled:.2g} % {words}", cure))
    missing = float(dataset.attrs.get("imbalance", 0.0))
    if missing >= _BALANCED:
        words = f"Shaft, losses, road and brakes balance only within {100.0 * missing:.1g} %."
        found.append(Finding(WARNING, words))
    return found + [Finding(WARNING, one) for one in dataset.attrs["trace_notes"].splitlines()]


def cycle_numbers(dataset: xr.Dataset | None) -> list[Number]:
    """Return the key numbers of a cycle."""
    if dataset is None:
        return []
    return [Number("energy lost in the cycle", float(dataset["energy_lost"].sum()), "kJ")]


def cycle_tables(dataset: xr.Dataset | None) -> list[Table]:
    """Return the energy lost by element."""
    if dataset is None:
        return []
    put_in, back = float(dataset["energy_in_shaft"]), float(dataset["energy_back"])
    caption = f"The shaft puts in {put_in:.4g} kJ and takes back {back:.4g} kJ."
    return [energy_table(dataset, source_name, caption)]
