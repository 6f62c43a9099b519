"""What transmission errors make a drivetrain do: forces over frequency, and resonant speeds."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import xarray as xr

from drivetrain.train.train_file import TrainCase
from gearlube.plotting.style import SERIES, house_style, new_figure
from gearlube_core.dynamics.train.elements.gear_mesh import GearMesh
from gearlube_core.dynamics.train.model import Train
from gearlube_core.dynamics.train.response import frequency_response
from gearlube_core.units import rads_to_rpm

DAMPING_RATIO = 0.02  # of all modes; 1 to 3 % is usual of gearboxes
_LOWEST, _POINTS = 50.0, 400  # Hz
_HARMONICS = (1, 2, 3)
_FAINTEST = 1e-6  # of the largest force that a mesh makes, as drawn
_FORCE, _LOAD = ".force.", ".load"


def mean_train(case: TrainCase) -> Train:
    """Return the train at its start with the mean stiffness of its meshes."""
    elements = [one.steady() if isinstance(one, GearMesh) else one for one in case.train.elements]
    if all(one is other for one, other in zip(elements, case.train.elements, strict=True)):
        return case.train
    train = Train(
        case.train.bodies,
        elements,
        case.train.oil,
        steps_per_highest_period=case.train.steps_per_highest_period,
        driver=case.train.driver,
    )
    return replace(case, train=train).start()


def excited_meshes(train: Train) -> list[str]:
    """Return the meshes whose transmission error excites the train."""
    own = [name for name in train.state_names if name.endswith(".rotation")]
    return [name.removesuffix(".rotation") for name in own]


def responses(train: Train, highest: float) -> dict[str, Any]:
    """Return the amplitudes of mesh loads and bearing forces over transmission errors [N/m].

    Parameters
    ----------
    train : Train
        At its start.
    highest : float
        Frequency up to which modes are those of the drivetrain [Hz].

    Returns
    -------
    dict
        Variables and coordinates of a dataset; none without a mesh.
    """
    meshes = excited_meshes(train)
    names = [one.name for one in train.output_records]
    forces = [name for name in names if _FORCE in name]
    loads = [f"{mesh}{_LOAD}" for mesh in meshes if f"{mesh}{_LOAD}" in names]
    bearings = list(dict.fromkeys(name.partition(_FORCE)[0] for name in forces))
    bearings = [name for name in bearings if name not in meshes]
    if not meshes or highest <= _LOWEST:
        return {}
    frequencies = np.geomspace(_LOWEST, highest, _POINTS)
    wanted = [*loads, *(f"{name}{_FORCE}{c}" for name in bearings for c in "xyz")]
    amplitudes = np.empty((len(meshes), len(loads) + len(bearings), _POINTS))
    for i, mesh in enumerate(meshes):
        found = np.abs(frequency_response(train, mesh, wanted, frequencies, DAMPING_RATIO)).T
        of_bearings = found[len(loads) :].reshape(len(bearings), 3, _POINTS)
        amplitudes[i] = [*found[: len(loads)], *np.sqrt((of_bearings**2).sum(axis=1))]
    parts = [one.removesuffix(_LOAD) for one in loads] + bearings
    words = "amplitude of a force over that of a transmission error"
    dims = ("excited", "part", "response_frequency")
    return {
        "response": xr.DataArray(
            amplitudes,
            dims=dims,
            coords={
                "excited": meshes,
                "part": parts,
                "response_frequency": ("response_frequency", frequencies, {"units": "Hz"}),
            },
            attrs={"units": "N/m", "long_name": words},
        )
    }


def _by_frequency(dataset: xr.Dataset) -> dict[float, list[str]]:
    """Return meshes by their frequency at the start [Hz]; those of equal planets share one."""
    found: dict[float, list[str]] = {}
    for mesh in dataset["excited"].values.tolist():
        frequency = abs(float(dataset[f"{mesh}.frequency"].values[0]))
        found.setdefault(round(frequency, 6), []).append(mesh)
    return found


def response_figure(dataset: xr.Dataset) -> Any:
    """Draw the forces over frequency, a panel for the first mesh of each frequency."""
    meshes = dataset["excited"].values.tolist()
    drawn_meshes = [names[0] for names in _by_frequency(dataset).values()]
    with house_style():
        figure = new_figure(7.2, 1.4 + 2.3 * len(drawn_meshes))
        panels = figure.subplots(len(drawn_meshes), 1, squeeze=False, sharex=True).ravel()
        for ax, mesh in zip(panels, drawn_meshes, strict=True):
            highest = 1e-6 * float(dataset["response"].sel(excited=mesh).max())
            for i, part in enumerate(dataset["part"].values.tolist()):
                drawn = 1e-6 * dataset["response"].sel(excited=mesh, part=part)
                style = "-" if part in meshes else "--"
                look = {"color": SERIES[i % len(SERIES)], "ls": style if i < len(SERIES) else ":"}
                ax.loglog(drawn["response_frequency"], drawn, label=part.replace("_", " "), **look)
            ax.set(title=f"error of {mesh.replace('_', ' ')}", ylabel="force [N/µm]")
            ax.set_ylim(_FAINTEST * highest, 2.0 * highest)
        panels[-1].set_xlabel("frequency [Hz]")
        handles, labels = panels[0].get_legend_handles_labels()
        figure.legend(handles, labels, ncols=4, loc="outside lower center")
    return figure


def campbell_figure(dataset: xr.Dataset) -> Any:
    """Draw natural frequencies over speed with the frequencies of the meshes."""
    body = str(dataset.attrs["reference"])
    now = abs(float(rads_to_rpm(dataset[f"{body}.speed"].values[0])))
    speeds = np.linspace(0.0, 2.0 * now, 2)
    with house_style():
        figure = new_figure(7.2, 4.2)
        ax = figure.subplots()
        for frequency in dataset["frequency"].values:
            ax.axhline(frequency, color="0.75", lw=0.8, zorder=0)
        together = _by_frequency(dataset)
        for i, (at_start, meshes) in enumerate(together.items()):
            more = f" and {len(meshes) - 1} more" if len(meshes) > 1 else ""
            for k in _HARMONICS:
                look = {"color": SERIES[i % len(SERIES)], "lw": 2.0 if k == 1 else 1.0}
                label = meshes[0].replace("_", " ") + more if k == 1 else None
                ax.plot(speeds, k * at_start * speeds / now, label=label, **look)
        ax.axvline(now, color="black", lw=1.0, ls=":")
        ax.set(
            xlabel=f"speed of {body.replace('_', ' ')} [rpm]",
            ylabel="frequency [Hz]",
            xlim=(0.0, 2.0 * now),
            ylim=(0.0, 2.0 * _HARMONICS[-1] * max(together)),
        )
        ax.legend(loc="upper left")
    return figure


def deflection(dataset: xr.Dataset) -> tuple[list[list[Any]], list[list[Any]]]:
    """Return what meshes and bearings carry at the start, a row for each.

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
    carried = dict.fromkeys(name.partition(_FORCE)[0] for name in names if _FORCE in name)
    of_bearings = []
    for bearing in carried:
        forces = [value(f"{bearing}{_FORCE}{c}") for c in "xyz"]
        if bearing not in meshes and None not in forces:
            x, y, z = (float(one or 0.0) for one in forces)
            of_bearings.append([bearing, float(np.hypot(x, y)), z])
    return of_meshes, of_bearings
