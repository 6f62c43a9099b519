"""Parts shared by all studies of drive cycles: steps, energies, and findings for a report."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from typing import Any

import numpy as np
import xarray as xr

from drivetrain.cycle.demand import Demand
from drivetrain.cycle.traces import DriveCycle
from gearlube.output.csv_text import number_text
from gearlube.plotting.words import largest_losses
from gearlube.report.numbers import quantity_text
from gearlube.report.parts import NOTE, Cell, Column, Finding, Table
from gearlube_core.arrays import Array
from gearlube_core.units import rads_to_rpm

Variable = tuple[tuple[str, ...], Any, str, str]  # dimensions, values, unit, words
KJ, WH = 1e-3, 1.0 / 3.6  # kJ in a joule, Wh in a kJ
_NOTHING = 1e-6  # kJ
_LEAST_SHARE = 1e-4  # of the sum, shown in a table


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
    shown = np.where(energy > _LEAST_SHARE * total, energy, 0.0)
    names = [words(str(name)) for name in dataset["source"].values]
    each = [*zip(names, shown, strict=True), ("all", energy.sum())]
    rows: list[list[Cell]] = [
        [name, float(one), WH * float(one), 100.0 * float(one) / total] for name, one in each
    ]
    return Table(
        title="Energy lost by source",
        columns=[
            Column("source"),
            Column("energy", "kJ"),
            Column("energy", "Wh"),
            Column("share", "%"),
        ],
        rows=rows,
        caption=f"{caption} 0: less than 0.01 % of the sum.",
    )


def variables_of(given: Mapping[str, Variable]) -> dict[str, tuple[Any, ...]]:
    """Return variables as a dataset takes them."""
    return {
        name: (dims, values, {"units": unit, "long_name": words})
        for name, (dims, values, unit, words) in given.items()
    }


def steps_dataset(
    cycle: DriveCycle,
    demand: Demand,
    torque: Array,
    power: Array,
    sources: Iterable[str],
    *,
    shaft: str,
    ratio: float,
) -> xr.Dataset:
    """Return demand, losses and energies of a cycle, with the name of the shaft in variables.

    Torques are those of the shaft with the losses [N.m], `power` has a column for each source [W];
    the ratio is the speed of the shaft over that of the wheels.
    """
    turning = demand.shaft_speed
    put_in = torque * turning  # W at the shaft; below 0 it takes
    given_out = put_in - power.sum(axis=-1)  # W at the wheels
    at_wheels = given_out / np.where(turning > 0.0, turning, 1.0) * ratio
    lost = KJ * (power * demand.steps[:, None]).sum(axis=0)
    driving = np.maximum(put_in, 0.0)
    energy_in = energy(driving + np.maximum(-given_out, 0.0), demand)
    step = ("step",)
    found: dict[str, Variable] = {
        "duration": (step, demand.steps, "s", "duration of the step"),
        "vehicle_speed": (step, 3.6 * demand.speed, "km/h", "vehicle speed"),
        f"{shaft}_speed": (step, rads_to_rpm(1.0) * turning, "rpm", f"{shaft} speed"),
        f"{shaft}_torque": (step, torque, "N.m", f"torque on the {shaft}; < 0: it brakes"),
        "wheel_torque": (
            step,
            np.where(turning > 0.0, at_wheels, 0.0),
            "N.m",
            "torque of all driven wheels together",
        ),
        "brake_power": (step, demand.brakes, "W", "power of the friction brakes"),
        "loss": (("step", "source"), power, "W", "power lost"),
        "energy_in": ((), energy_in, "kJ", "energy put in, from either side"),
        f"energy_in_{shaft}": ((), energy(driving, demand), "kJ", f"by the {shaft}"),
        "energy_lost": (("source",), lost, "kJ", "energy lost"),
        "energy_brakes": ((), energy(demand.brakes, demand), "kJ", "to the friction brakes"),
        "efficiency": (
            (),
            1.0 - lost.sum() / energy_in if energy_in > 0.0 else np.nan,
            "1",
            "efficiency over the cycle",
        ),
    }
    middle = 0.5 * (cycle.time[1:] + cycle.time[:-1])
    return xr.Dataset(
        variables_of(found),
        coords={
            "step": ("step", middle, {"units": "s", "long_name": "time, middle of the step"}),
            "source": ("source", np.array([*sources]), {"long_name": "kind of loss"}),
        },
        attrs={"cycle": cycle.name, "trace_notes": "\n".join(cycle.notes)},
    )


def energy(power: Array, demand: Demand) -> float:
    """Return the energy of a power over a cycle [kJ]."""
    return KJ * float(power @ demand.steps)


def step_rows(
    dataset: xr.Dataset, shaft: str, more: Mapping[str, Array]
) -> tuple[Sequence[str], Iterator[list[str]]]:
    """Return the names of the columns and a row for each step, at its middle.

    Those in `more` come behind the losses.
    """
    columns = {
        "duration": "step_s",
        "vehicle_speed": "vehicle_speed_kmh",
        f"{shaft}_speed": f"{shaft}_speed_rpm",
        f"{shaft}_torque": f"{shaft}_torque_n_m",
        "wheel_torque": "wheel_torque_n_m",
        "brake_power": "brake_power_w",
    }
    losses = [f"loss_{one}_w" for one in dataset["source"].values]
    head = "time_s", *columns.values(), *losses, *more
    variables = (dataset[name].values for name in columns)
    values = [dataset["step"].values, *variables, *dataset["loss"].values.T, *more.values()]
    # no -0
    rows = ([number_text(float(one) + 0.0) for one in row] for row in zip(*values, strict=True))
    return head, rows
