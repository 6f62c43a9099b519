"""Response of a drivetrain to transmission errors and motors: forces over frequency."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np
import xarray as xr

from drivetrain.train.train_file import TrainCase
from gearlube.plotting.style import SERIES, house_style, new_figure
from gearlube.report.parts import Column, Table
from gearlube.studies.drivetrain.orders import DAMPING_RATIO, FORCE, parts_of
from gearlube_core.dynamics.train.elements.gear_mesh import GearMesh
from gearlube_core.dynamics.train.elements.motor import Motor
from gearlube_core.dynamics.train.model import Train
from gearlube_core.dynamics.train.part import Element
from gearlube_core.dynamics.train.response import excited_meshes, frequency_response

_LOAD = ".load"
_FAINTEST = 1e-6  # of the largest force, as drawn
_LOWEST, _POINTS = 50.0, 400  # Hz


def mean_train(case: TrainCase) -> Train:
    """Return the train at its start with the mean stiffness of its meshes and no ripple."""
    elements = [_steady(one) for one in case.train.elements]
    if all(one is other for one, other in zip(elements, case.train.elements, strict=True)):
        return case.train
    return replace(case, train=case.train.changed(elements=elements)).start()


def _steady(one: Element) -> Element:
    if isinstance(one, GearMesh):
        return one.steady()
    if isinstance(one, Motor) and one.ripple is not None:
        return replace(one, ripple=None)
    return one


def responses(train: Train, motors: Sequence[str], highest: float) -> dict[str, Any]:
    """Return the amplitudes of mesh loads and bearing forces over what excites them.

    Parameters
    ----------
    train : Train
        At its start.
    motors : sequence of str
        Those with a ripple.
    highest : float
        Frequency up to which modes are those of the drivetrain [Hz].

    Returns
    -------
    dict
        Variables and coordinates of a dataset: over transmission errors of meshes [N/m], and over
        torques of motors [N/(N.m)].
    """
    found, parts = dict[str, Any](), parts_of(train)
    if highest <= _LOWEST:
        return found
    frequencies = np.geomspace(_LOWEST, highest, _POINTS)
    words = "amplitude of a force over that of"
    for name, over, unit, what, sources in (
        ("response", "excited", "N/m", "a transmission error", excited_meshes(train)),
        ("torque_response", "motor", "N/(N.m)", "a torque", motors),
    ):
        if sources:
            made = [
                parts.sizes(
                    frequency_response(train, one, parts.outputs, frequencies, DAMPING_RATIO)
                ).T
                for one in sources
            ]
            at = ("response_frequency", frequencies, {"units": "Hz"})
            found[name] = xr.DataArray(
                np.array(made),
                dims=(over, "part", "response_frequency"),
                coords={over: [*sources], "part": parts.names, "response_frequency": at},
                attrs={"units": unit, "long_name": f"{words} {what}"},
            )
    return found


def _by_frequency(dataset: xr.Dataset) -> dict[float, list[str]]:
    """Return meshes by their frequency at the start [Hz]; those of equal planets share one."""
    found: dict[float, list[str]] = {}
    for mesh in dataset["excited"].values.tolist():
        frequency = abs(float(dataset[f"{mesh}.frequency"].values[0]))
        found.setdefault(round(frequency, 6), []).append(mesh)
    return found


def response_figure(dataset: xr.Dataset) -> Any:
    """Draw the forces over frequency: by the first mesh of each frequency, and by motors."""
    panels = []
    if "response" in dataset:
        first = [names[0] for names in _by_frequency(dataset).values()]
        panels += [("response", "excited", mesh) for mesh in first]
    if "torque_response" in dataset:
        panels += [("torque_response", "motor", one) for one in dataset["motor"].values.tolist()]
    with house_style():
        figure = new_figure(7.2, 1.4 + 2.3 * len(panels))
        axes = figure.subplots(len(panels), 1, squeeze=False, sharex=True).ravel()
        for ax, (name, over, source) in zip(axes, panels, strict=True):
            by_error = name == "response"
            highest = (1e-6 if by_error else 1.0) * float(dataset[name].sel({over: source}).max())
            for i, part in enumerate(dataset["part"].values.tolist()):
                drawn = (1e-6 if by_error else 1.0) * dataset[name].sel(
                    {over: source, "part": part}
                )
                style = "-" if f"{part}.dte" in dataset else "--"
                look = {"color": SERIES[i % len(SERIES)], "ls": style if i < len(SERIES) else ":"}
                ax.loglog(drawn["response_frequency"], drawn, label=part.replace("_", " "), **look)
            words = ("error of ", "force [N/µm]") if by_error else ("torque of ", "force [N/(N·m)]")
            ax.set(title=words[0] + source.replace("_", " "), ylabel=words[1])
            ax.set_ylim(_FAINTEST * highest, 2.0 * highest)
        axes[-1].set_xlabel("frequency [Hz]")
        handles, labels = axes[0].get_legend_handles_labels()
        figure.legend(handles, labels, ncols=4, loc="outside lower center")
    return figure


def deflection(dataset: xr.Dataset) -> tuple[list[list[Any]], list[list[Any]]]:
    """Return the loads of meshes and bearings at the start, a row for each.

    Of a mesh: load [N], misalignment [urad], loads of the end stations over the mean; of a bearing:
    radial and axial force [N].
    """
    first = dataset.isel(time=0)
    names = [str(name) for name in first.data_vars]

    def value(name: str) -> float | None:
        return float(first[name]) if name in names else None

    meshes = [name.removesuffix(_LOAD) for name in names if name.endswith(_LOAD)]
    meshes = [name for name in meshes if f"{name}.dte" in names]
    of_meshes = [
        [
            mesh,
            value(f"{mesh}{_LOAD}"),
            None if (tilt := value(f"{mesh}.tilt")) is None else 1e6 * tilt,
            value(f"{mesh}.share.low"),
            value(f"{mesh}.share.high"),
        ]
        for mesh in meshes
    ]
    carried = dict.fromkeys(name.partition(FORCE)[0] for name in names if FORCE in name)
    of_bearings = []
    for bearing in carried:
        forces = [value(f"{bearing}{FORCE}{c}") for c in "xyz"]
        if bearing not in meshes and None not in forces:
            x, y, z = (float(one or 0.0) for one in forces)
            of_bearings.append([bearing, float(np.hypot(x, y)), z])
    return of_meshes, of_bearings


def carried(dataset: xr.Dataset) -> list[Table]:
    """Return the tables of what meshes and bearings carry at the start."""
    meshes, bearings = deflection(dataset)
    tables = []
    if meshes:
        tables.append(
            Table(
                title="Meshes under load",
                columns=[
                    Column("mesh"),
                    Column("normal load", "N", 4),
                    Column("misalignment", "µrad", 3),
                    Column("load at low z", "", 3),
                    Column("load at high z", "", 3),
                ],
                rows=meshes,
                caption="At the start, with all shafts bent and bearings deflected; loads of the "
                "ends of the face are those over their mean.",
            )
        )
    if bearings:
        columns = [Column("part"), Column("radial force", "N", 4), Column("axial force", "N", 4)]
        tables.append(
            Table(
                title="Forces of bearings and supports",
                columns=columns,
                rows=bearings,
                caption="At the start, on the shaft.",
            )
        )
    return tables
