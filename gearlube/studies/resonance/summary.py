"""The main numbers of a resonance study, from its dataset."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from gearlube_core.arrays import Array
from gearlube_core.dynamics.hypoid_torsional.period_problem import Orbit

_MOST_LISTED = 6
_WRINKLE = 2e-3  # two folds in a row that are closer than this are one wrinkle
_IN_RANGE = 2e-3  # of the range: a branch that ends closer to its limit has reached it


def mesh_harmonics(x: Array, periods: int, count: int) -> Array:
    """Return the amplitudes of mesh orders 1 to `count` [unit of x], shape (count,).

    Parameters
    ----------
    x : ndarray of shape (n,)
        Samples at equal angles over one period of the motion, `periods` mesh periods long.
    """
    amplitude = 2.0 * np.abs(np.fft.rfft(x)) / x.size
    return np.asarray(amplitude[periods * np.arange(1, count + 1)])


def rate_over_period(orbit: Orbit) -> Array:
    """Return x' [m/s] of a periodic motion, shape (samples,).

    Differentiated as a Fourier series; x has continuous second derivatives where the damping is
    gated and continuous first ones otherwise.
    """
    size = orbit.x.size
    span = size * (orbit.angle[1] - orbit.angle[0])
    order = np.fft.rfftfreq(size, 1.0 / size) * (2.0 * math.pi / span)
    spectrum = 1j * order * np.fft.rfft(orbit.x)
    if size % 2 == 0:
        spectrum[-1] = 0.0  # the sign of the highest order is not known from the samples
    return np.asarray(np.fft.irfft(spectrum, size) * orbit.pinion_speed)


@dataclass(frozen=True, slots=True, kw_only=True)
class ModelSummary:
    """Main numbers of one response; frequencies are mesh over natural frequency [-].

    Parameters
    ----------
    model : str
        See `MODELS`.
    special : list of (str, float)
        Kind and frequency of folds and bifurcations of motions of one mesh period, along the
        branches.
    peak, peak_at : float
        Largest peak-to-peak transmission error of a stable motion [m], and where.
    separated_up, separated_down : list of (float, float)
        Where slow sweeps along stable motions lose contact and where they regain it.
    remarks : list of str
        What a reader should know about branches that ended early.
    """

    model: str
    special: list[tuple[str, float]]
    peak: float
    peak_at: float
    separated_up: list[tuple[float, float]]
    separated_down: list[tuple[float, float]]
    remarks: list[str]


def summaries(dataset: xr.Dataset) -> list[ModelSummary]:
    """Return the main numbers of every model of a `resonance_dataset`."""
    models: Array | list[str] = dataset["model"].values if "model" in dataset else []
    return [_summary(dataset, str(model)) for model in models]


def _summary(dataset: xr.Dataset, model: str) -> ModelSummary:
    part = dataset.sel(model=model)
    size = np.where(part["stable"].values > 0.5, part["peak_to_peak"].values, -np.inf)
    top = int(np.argmax(size))
    branches = single_branches(part)
    path = path_over_range(branches)
    special = _special(part)
    remarks = [
        f"branch {int(branch['segment'][0]) + 1} was followed no further than {place:.3f} of the "
        "natural frequency."
        for branch in branches
        if _ends_within(place := float(branch["relative_frequency"][-1]), dataset.attrs)
        and not dataset.attrs["interrupted"]
    ]
    if len(special) > _MOST_LISTED:
        remarks.append(f"{len(special)} folds and bifurcations, the first {_MOST_LISTED} listed.")
    return ModelSummary(
        model=model,
        special=special[:_MOST_LISTED],
        peak=float(size[top]),
        peak_at=float(part["relative_frequency"][top]),
        separated_up=separated_ranges(path, "up"),
        separated_down=separated_ranges(path, "down"),
        remarks=remarks,
    )


def single_branches(part: xr.Dataset) -> list[xr.Dataset]:
    """Return the branches of one model whose motions repeat every mesh period."""
    numbers = np.where(part["periods"].values == 1.0, part["segment"].values, np.nan)
    return [
        part.isel(row=np.flatnonzero(numbers == number))
        for number in np.unique(numbers[np.isfinite(numbers)])
    ]


def path_over_range(branches: list[xr.Dataset]) -> xr.Dataset:
    """Return one path over the range: the branch from its start, then that to its end."""
    if len(branches) == 1:
        return branches[0]
    back = branches[1].isel(row=slice(None, None, -1))
    return xr.concat(
        [branches[0], back], "row", data_vars="minimal", coords="minimal", compat="override"
    )


def _special(part: xr.Dataset) -> list[tuple[str, float]]:
    single = {float(branch["segment"][0]) for branch in single_branches(part)}
    kept = part.isel(special=main_special(part))
    return [
        (str(kind), float(place))
        for kind, place, number in zip(
            kept["special_kind"].values,
            kept["special_relative_frequency"].values,
            kept["special_segment"].values,
            strict=True,
        )
        if float(number) in single
    ]


def main_special(part: xr.Dataset) -> NDArray[np.intp]:
    """Return the special points of a model without exchanges and without narrow pairs of folds.

    Where impacts pass from one step of the integrator to the next, a branch near a fold has
    wrinkles: two folds in a row at nearly one frequency.
    """
    kinds = part["special_kind"].values
    places = part["special_relative_frequency"].values
    kept: list[int] = []
    for number in np.flatnonzero((kinds != "") & (kinds != "exchange")):
        last = kept[-1] if kept else number
        pair = kinds[last] == kinds[number] == "fold"
        if kept and pair and abs(places[number] - places[last]) < _WRINKLE:
            kept.pop()
        else:
            kept.append(int(number))
    return np.array(kept, dtype=np.intp)


def _ends_within(place: float, limits: dict[str, float]) -> bool:
    reach = _IN_RANGE * (limits["last"] - limits["first"])
    return limits["first"] + reach < place < limits["last"] - reach


def visited(relative: Array, stable: Array, direction: str) -> NDArray[np.intp]:
    """Return the rows of a branch that a slow sweep visits, in its order.

    A sweep follows stable rows and jumps at folds to the next stable row ahead of it.

    Parameters
    ----------
    relative, stable : ndarray of shape (n,)
        Frequency and stability, in the order of the branch.
    direction : {"up", "down"}

    Examples
    --------
    A branch that turns back at 3 and forward again at 1:

    >>> frequency = np.array([0.0, 2.0, 3.0, 2.0, 1.0, 2.0, 3.5])
    >>> stable = np.array([1.0, 1.0, 1.0, 0.0, 1.0, 1.0, 1.0])
    >>> visited(frequency, stable, "up").tolist(), visited(frequency, stable, "down").tolist()
    ([0, 1, 2, 6], [6, 5, 4, 0])
    """
    sign = 1.0 if direction == "up" else -1.0
    rows = np.arange(relative.size)
    if sign * (relative[-1] - relative[0]) < 0.0:
        rows = rows[::-1]
    reached, kept = -np.inf, []
    for row in rows:
        if stable[row] > 0.5 and sign * relative[row] > reached:
            kept.append(row)
            reached = sign * relative[row]
    return np.array(kept, dtype=np.intp)


def separated_ranges(branch: xr.Dataset, direction: str) -> list[tuple[float, float]]:
    """Return where a slow sweep along a branch loses and regains contact, in sweep order."""
    relative = branch["relative_frequency"].values
    rows = visited(relative, branch["stable"].values, direction)
    apart = branch["separation_share"].values[rows] > 0.0
    edges = np.flatnonzero(np.diff(np.concatenate([[0], apart.astype(int), [0]])))
    return [
        (float(relative[rows[first]]), float(relative[rows[last - 1]]))
        for first, last in edges.reshape(-1, 2)
    ]
