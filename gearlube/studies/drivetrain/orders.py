"""Orders of a train: which meshes and motors excite it, and the forces that each makes."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
import xarray as xr

from gearlube.plotting.style import GREY, PARTS, house_style, name_levels, new_figure
from gearlube.report.parts import Column, Table
from gearlube.studies.drivetrain.operation import Operation
from gearlube_core.arrays import Array
from gearlube_core.dynamics.train.elements.motor import Motor
from gearlube_core.dynamics.train.elements.orbit import Orbit
from gearlube_core.dynamics.train.model import Train
from gearlube_core.dynamics.train.response import (
    excited_meshes,
    frequency_response,
    mesh_loads,
    order_response,
)
from gearlube_core.units import rads_to_rpm, rpm_to_rads

DAMPING_RATIO = 0.02  # of all modes; 1 to 3 % is usual of gearboxes
HARMONICS = 3
_MANY = 12  # rows that are shown at once
_SAME = 1e-6  # relative, of orders of meshes
LEAST = 1e-3  # N, of an order that is drawn
_SHOWN = 1e-5  # of the largest force
FORCE = ".force."


class Order(NamedTuple):
    """Cycles per turn of the driven shaft, and the meshes or the motor that make them."""

    name: str
    order: float
    harmonic: int  # of the mesh; 0: of a motor
    sources: tuple[str, ...]


class Parts(NamedTuple):
    """Outputs that are forces of meshes, bearings and supports."""

    meshes: dict[str, str]  # output that is the load of each
    bearings: list[str]

    @property
    def names(self) -> list[str]:
        """Names of all, meshes first."""
        return [*self.meshes, *self.bearings]

    @property
    def outputs(self) -> list[str]:
        """Outputs of all: the load of each mesh, three forces of each other part."""
        return [
            *self.meshes.values(),
            *(f"{name}{FORCE}{c}" for name in self.bearings for c in "xyz"),
        ]

    def sizes(self, values: Any) -> Array:
        """Return the size of each force from `outputs`, which are the last axis."""
        n = len(self.meshes)
        of_bearings = np.abs(values[..., n:]).reshape(*values.shape[:-1], len(self.bearings), 3)
        both = np.abs(values[..., :n]), np.sqrt((of_bearings**2).sum(axis=-1))
        return np.concatenate(both, axis=-1)


def parts_of(train: Train) -> Parts:
    """Return the forces among the outputs of a train."""
    names = [one.name for one in train.output_records]
    meshes = mesh_loads(train)
    carrying = dict.fromkeys(name.partition(FORCE)[0] for name in names if FORCE in name)
    # a set of bearings has a force of its own, beside those of each
    whole = [one for one in carrying if one.rpartition(".")[0] not in carrying]
    return Parts(meshes, [one for one in whole if one not in meshes])


def orders_of(operation: Operation) -> list[Order]:
    """Return the orders of all meshes with their harmonics, and of the ripple of all motors.

    Meshes of one order, as those of planets, are one.
    """
    train, turn = operation.case.train, operation.speed / (2.0 * math.pi)
    now, found = train.outputs(), list[Order]()
    first: dict[str, float] = {
        name.removesuffix(".dte"): abs(now[f"{name.removesuffix('.dte')}.frequency"]) / turn
        for name in now
        if name.endswith(".dte")
    }
    while first:
        name, order = next(iter(first.items()))
        alike = [one for one, other in first.items() if math.isclose(other, order, rel_tol=_SAME)]
        first = {one: other for one, other in first.items() if one not in alike}
        words = name.replace("_", " ") + (f" and {len(alike) - 1} more" if alike[1:] else "")
        if order > 0.0:
            found += [
                Order(f"{words}, {'' if k == 1 else f'{k} x '}{order:.5g}", k * order, k, (*alike,))
                for k in range(1, HARMONICS + 1)
            ]
    for motor in (one for one in train.elements if isinstance(one, Motor)):
        ripple = motor.ripple_at(operation.speed, operation.torque)
        words = motor.name.replace("_", " ")
        found += [Order(f"{words}, {o:g}", o, 0, (motor.name,)) for o in sorted(ripple)]
    return found


def forces_by_order(
    operation: Operation, train: Train, orders: Sequence[Order], speeds: Array
) -> Array:
    """Return the amplitude of each force by each order [N], shape (speeds, orders, parts).

    Parameters
    ----------
    operation
    train : Train
        Its train with mean stiffness and without ripple, at rest at its torque.
    orders : sequence of Order
        Those of bodies on carriers are left out: NaN.
    speeds : ndarray of shape (n,)
        Of the shaft [rad/s].

    Notes
    -----
    Flanks stay in contact, and forces swing as at the torque of the start, see `order_response`.
    """
    parts, whole = parts_of(train), operation.case.train
    motors = {one.name: one for one in whole.elements if isinstance(one, Motor)}
    orbits = any(isinstance(one, Orbit) for one in whole.elements)
    found = np.full((len(speeds), len(orders), len(parts.names)), math.nan)
    meshes = {one.sources[0] for one in orders if one.harmonic}
    factors = speeds / operation.speed
    made = {
        mesh: order_response(whole, mesh, parts.outputs, factors, HARMONICS)
        for mesh in (() if orbits else meshes & set(excited_meshes(whole)))
    }
    for j, one in enumerate(orders):
        source = one.sources[0]
        if source in made:
            found[:, j] = parts.sizes(made[source][:, one.harmonic - 1])
        if source in motors:
            ripple = [motors[source].ripple_at(float(w), operation.torque) for w in speeds]
            frequencies = one.order * speeds / (2.0 * math.pi)
            per_torque = frequency_response(train, source, parts.outputs, frequencies, None)
            size = np.array([abs(by_order.get(one.order, 0.0)) for by_order in ripple])
            found[:, j] = size[:, None] * parts.sizes(per_torque)
    return found


def crossings(
    orders: Sequence[Order], frequencies: Array, low: float, high: float
) -> list[tuple[float, float, str]]:
    """Return where orders meet natural frequencies: speed [rad/s], frequency [Hz], order.

    Speeds lie within `low` and `high` [rad/s], rising.

    Examples
    --------
    >>> motor = Order("motor, 24", 24.0, 0, ("motor",))
    >>> ((speed, frequency, name),) = crossings([motor], np.array([400.0, 4000.0]), 50.0, 600.0)
    >>> round(speed, 2), frequency, name
    (104.72, 400.0, 'motor, 24')
    """
    found = [
        (2.0 * math.pi * float(f) / one.order, float(f), one.name)
        for one in orders
        for f in frequencies
    ]
    return sorted(one for one in found if low <= one[0] <= high)


def resonant_speeds(dataset: xr.Dataset) -> list[Table]:
    """Return the table of speeds at which orders that excite meet natural frequencies.

    Those with the largest forces stand first, and no more than `_MANY`.
    """
    if "order_force" not in dataset:
        return []
    excited = dataset["line"].values[~(_largest(dataset) <= LEAST)]
    forces = dataset["order_force"].max("part")
    orders = [Order(str(one), float(dataset["order"].sel(line=one)), 0, ()) for one in excited]
    low, high = (float(rpm_to_rads(dataset["order_speed"].values[i])) for i in (0, -1))
    frequency, share = dataset["frequency"].values, dataset["share"].values
    bodies = dict(zip(frequency, dataset["body"].values[share.argmax(axis=1)], strict=True))
    rows: list[list[Any]] = []
    for speed, f, name in crossings(orders, frequency, low, high):
        rpm = float(rads_to_rpm(speed))
        force = float(np.interp(rpm, dataset["order_speed"], forces.sel(line=name)))
        rows.append([rpm, name, f, str(bodies[f]), None if math.isnan(force) else force])
    if not rows:
        return []
    rows.sort(key=lambda row: row[-1] or 0.0, reverse=True)
    columns = [
        Column(f"speed of {dataset.attrs['shaft']}", "rpm", 4),
        Column("order"),
        Column("natural frequency", "Hz", 4),
        Column("body that moves most"),
        Column("largest force by the order", "N", 3),
    ]
    title = "Resonant speeds"
    if len(rows) > _MANY:
        title += f", {_MANY} of {len(rows)}" + (", by force" if rows[0][-1] else "")
    return [Table(title=title, columns=columns, rows=rows[:_MANY])]


def order_forces(operation: Operation, train: Train, speeds: Array) -> dict[str, Any]:
    """Return `forces_by_order` at speeds [rad/s] as variables of a dataset."""
    orders = orders_of(operation)
    if not orders:
        return {}
    sizes = forces_by_order(operation, train, orders, speeds)
    rpm = ("order_speed", rads_to_rpm(1.0) * speeds, {"units": "rpm"})
    return {
        "order": ("line", [one.order for one in orders], {"units": "1"}),
        "order_force": xr.DataArray(
            sizes,
            dims=("order_speed", "line", "part"),
            coords={
                "line": [one.name for one in orders],
                "part": parts_of(train).names,
                "order_speed": rpm,
            },
            attrs={"units": "N", "long_name": "amplitude of a force by one order, by frequency"},
        ),
    }


def _largest_of_parts(dataset: xr.Dataset) -> Array:
    """Return the largest force of each order on each part [N], shape (lines, parts)."""
    found = dataset["order_force"].max("order_speed").values
    if "order_track" in dataset:
        found = np.fmax(found, dataset["order_track"].max("block").values)
    return np.asarray(found)


def _largest(dataset: xr.Dataset) -> Array:
    """Return the largest force of each order [N], in time or by frequency; NaN: not known."""
    return np.asarray(np.fmax.reduce(_largest_of_parts(dataset), axis=1))


def order_figure(dataset: xr.Dataset) -> Any:
    """Draw the forces of meshes and bearings over speed, one panel each, a line for each order."""
    forces = dataset["order_force"]
    tracks = dataset.get("order_track")
    largest = _largest_of_parts(dataset)
    tops = np.nan_to_num(largest).max(axis=0)
    drawn = (largest > np.maximum(LEAST, 10.0 * _SHOWN * tops)).any(axis=1)
    lines = forces["line"].values[drawn].tolist()
    parts = [str(one) for one in dataset["part"].values]
    rows = -(-len(parts) // 2)
    with house_style():
        figure = new_figure(9.4, 1.6 + 2.0 * rows)
        axes = figure.subplots(rows, 2, squeeze=False, sharex=True).ravel()
        for ax in axes[len(parts) :]:
            ax.set_visible(False)
        for ax, part in zip(axes, parts, strict=False):
            for i, line in enumerate(lines):
                look = {"color": PARTS[i % len(PARTS)], "lw": 1.1}
                found = forces.sel(line=line, part=part)
                if tracks is not None:
                    ran = tracks.sel(line=line, part=part)
                    ax.semilogy(rads_to_rpm(1.0) * dataset["block_speed"], ran, label=line, **look)
                    look |= {"ls": ":"}
                ax.semilogy(
                    found["order_speed"], found, label=line if tracks is None else None, **look
                )
            ax.set(title=part.replace("_", " "), ylabel="force [N]")
            top = ax.get_ylim()[1]
            ax.set_ylim(max(ax.get_ylim()[0], _SHOWN * top), top)
        for ax in axes[max(0, len(parts) - 2) : len(parts)]:
            ax.tick_params(labelbottom=True)
            ax.set_xlabel(f"speed of {dataset.attrs['shaft']} [rpm]")
        handles, labels = axes[0].get_legend_handles_labels()
        figure.legend(handles, labels, ncols=4, loc="outside lower center")
    return figure


def campbell_figure(dataset: xr.Dataset) -> Any:
    """Draw natural frequencies over speed with the orders of meshes and motors."""
    speeds = dataset["order_speed"].values
    ends = np.array([0.0, speeds[-1]])
    excited = dataset["order"].values[~(_largest(dataset) <= LEAST)]
    with house_style():
        figure = new_figure(8.4, 4.6)
        ax = figure.subplots()
        for frequency in dataset["frequency"].values:
            ax.axhline(frequency, color="0.75", lw=0.8, zorder=0)
        kinds = dict.fromkeys(str(one).rpartition(", ")[0] for one in dataset["line"].values)
        colours = dict(zip(kinds, PARTS, strict=False))
        for name, order in zip(dataset["line"].values, dataset["order"].values, strict=True):
            colour = colours.get(str(name).rpartition(", ")[0], GREY)
            ax.plot(ends, order * ends / 60.0, color=colour, lw=2.0 if order in excited else 0.8)
        ax.axvline(dataset.attrs["shaft_rpm"], color="black", lw=1.0, ls=":")
        ax.set(
            xlabel=f"speed of {dataset.attrs['shaft']} [rpm]",
            ylabel="frequency [Hz]",
            xlim=ends,
            ylim=(0.0, 1.05 * float(dataset["order"].max()) * ends[1] / 60.0),
        )
        tops = dataset["order"].values * ends[1] / 60.0
        name_levels(ax, dict(zip(dataset["line"].values.tolist(), tops, strict=True)))
    return figure
