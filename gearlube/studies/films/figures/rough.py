"""Rough films in motion: what they do over time, how films and pressures are distributed."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import xarray as xr

from gearlube.plotting.style import SERIES, house_style, new_figure
from gearlube.studies.films.figures.parts import film_colours
from gearlube_core.arrays import Array
from gearlube_core.errors import ParameterError

_MICROMETRE, _NANOMETRE, _MILLIMETRE, _GIGAPASCAL = 1e-6, 1e-9, 1e-3, 1e9
_LEAST_FILM = 1.0  # nm, end of logarithmic film scales: a film is a continuum no thinner
_DASHES = ("-", "--", "-.", ":")
_EDGE = 0.02  # of the load, under which a curve of pressure is not shown
Runs = Mapping[str, xr.Dataset]


def rough_history(runs: Runs, time_step: float | None = None) -> Any:
    """Draw largest pressure, smallest film, contact and load of solids of runs over time.

    Parameters
    ----------
    runs
        Statistics of `RoughFilmStatistics` by label.
    time_step
        [s]; with it the axis counts time steps.

    Returns
    -------
    matplotlib.figure.Figure
        As [jamali_2015 Fig. 7.18, 7.24, 7.25] for the pressure.
    """
    from matplotlib.ticker import LogFormatter

    _check(runs)
    with house_style():
        figure = new_figure(8.0, 8.4)
        axes = figure.subplots(4, 1, sharex=True)
        for k, (label, run) in enumerate(runs.items()):
            scale = time_step or _MICROMETRE
            at = run["time"].values / scale
            line = {"color": SERIES[k % len(SERIES)], "lw": 1.0, "label": label}
            axes[0].plot(at, run["pressure_max"] / _GIGAPASCAL, **line)
            axes[1].semilogy(at, np.maximum(run["film_min"] / _NANOMETRE, _LEAST_FILM / 2), **line)
            limit = run["threshold"].values[-1]
            axes[2].plot(at, 100.0 * run["contact_share"].sel(threshold=limit), **line)
            axes[3].plot(at, 100.0 * run["solid_share"], **line)
        axes[1].yaxis.set_major_formatter(LogFormatter())
        axes[1].yaxis.set_minor_formatter(LogFormatter(minor_thresholds=(1.5, 0.5)))
        words = f"{next(iter(runs.values()))['threshold'].values[-1] / _NANOMETRE:g} nm"
        for ax, name in zip(
            axes,
            (
                "largest pressure\n[GPa]",
                "smallest film\n[nm]",
                f"Hertz zone with\na film below {words} [%]",
                "load on solids\n[%]",
            ),
            strict=True,
        ):
            ax.set_ylabel(name)
            ax.margins(x=0.0)
        for ax in (axes[0], axes[2], axes[3]):
            ax.set_ylim(bottom=0.0)
        axes[-1].set_xlabel("time [µs]" if time_step is None else "time step")
        if len(runs) > 1:
            axes[0].legend(ncols=min(len(runs), 4), loc="lower right")
        axes[0].set_title("Rough film while the roughness comes into the contact")
        _mark_rough(axes, next(iter(runs.values())), time_step or _MICROMETRE)
    return figure


def rough_distributions(runs: Runs) -> Any:
    """Draw the distribution functions of film and pressure in the Hertz zone over all times.

    Returns
    -------
    matplotlib.figure.Figure
        As [jamali_2015 Fig. 7.29, 7.31]: the share of the zone with a film below, and with a
        pressure above, a value.
    """
    _check(runs)
    with house_style():
        figure = new_figure(9.0, 4.2)
        left, right = figure.subplots(1, 2)
        for k, (label, run) in enumerate(runs.items()):
            line = {"color": SERIES[k % len(SERIES)], "ls": _DASHES[k % len(_DASHES)]}
            film, share = run["film_edge"].values / _MICROMETRE, run["film_function"].values
            left.plot(film, 100.0 * share, label=label, **line)
            pressure = run["pressure_edge"].values / _GIGAPASCAL
            above = 1.0 - run["pressure_function"].values
            right.semilogy(pressure, 100.0 * np.where(above > 0.0, above, np.nan), **line)
        left.set_xlim(0.0, _end(runs, "film", 0.999) / _MICROMETRE)
        right.set_xlim(0.0, _end(runs, "pressure", 1.0 - 1e-6) / _GIGAPASCAL)
        left.set(xlabel="film [µm]", ylabel="Hertz zone with a thinner film [%]", ylim=(0.0, 100.0))
        right.set(xlabel="pressure [GPa]", ylabel="Hertz zone with a higher pressure [%]")
        right.set_ylim(1e-4, 100.0)
        if len(runs) > 1:
            left.legend()
        figure.suptitle("How films and pressures are distributed in the Hertz zone, over all times")
    return figure


def rough_thin_films(runs: Runs) -> Any:
    """Draw which share of the Hertz zone has which film below 25 nm, over all times.

    Returns
    -------
    matplotlib.figure.Figure
        As [jamali_2015 Fig. 7.30].
    """
    _check(runs)
    with house_style():
        figure = new_figure(8.0, 4.2)
        ax = figure.subplots()
        width = 0.8 / len(runs)
        for k, (label, run) in enumerate(runs.items()):
            edges = run["film_edge"].values / _NANOMETRE
            thin = np.flatnonzero(edges[1:] <= 25.0 * (1.0 + 1e-9))
            middle = 0.5 * (edges[thin] + edges[thin + 1]) + (k - 0.5 * (len(runs) - 1)) * width
            shares = 100.0 * run["film_histogram"].values[thin]
            ax.bar(middle, shares, width, color=SERIES[k % len(SERIES)], label=label)
        ax.set(xlabel="film [nm]", ylabel="share of the Hertz zone [%]", xlim=(0.0, 25.0))
        ax.set_title("How thin the films of the Hertz zone are, over all times, in bins of 1 nm")
        if len(runs) > 1:
            ax.legend()
    return figure


def rough_frame(
    frame: xr.Dataset, highest: float | None = None, thickest: float | None = None
) -> Any:
    """Draw film and pressure of one moment as maps, with the middle row below.

    Parameters
    ----------
    frame
        `film` [m] and `pressure` [Pa] over `x` and `y` [m], with the coordinate `time` [s].
    highest
        Pressure at the end of the colours [Pa]; None: the largest of the frame.
    thickest
        Film at the end of the colours [m]; None: `loaded_film` of the frame.
    """
    x, y = frame["x"].values / _MILLIMETRE, frame["y"].values / _MILLIMETRE
    film = frame["film"].transpose("y", "x").values
    pressure = frame["pressure"].transpose("y", "x").values
    with house_style():
        figure = new_figure(8.5, 7.0)
        axes = figure.subplots(3, 1, sharex=True, height_ratios=(1.0, 1.0, 1.1))
        top = (float(pressure.max()) if highest is None else highest) / _GIGAPASCAL
        colours = axes[0].pcolormesh(
            x, y, pressure / _GIGAPASCAL, vmin=0.0, vmax=top, cmap="inferno", shading="nearest"
        )
        figure.colorbar(colours, ax=axes[0], label="pressure [GPa]", pad=0.01)
        limit = (loaded_film(film, pressure) if thickest is None else thickest) / _MICROMETRE
        colours = axes[1].pcolormesh(
            x, y, film / _MICROMETRE, vmin=0.0, vmax=limit, cmap=film_colours(), shading="nearest"
        )
        figure.colorbar(
            colours, ax=axes[1], label="film [µm], grey: thicker", extend="max", pad=0.01
        )
        for ax in axes[:2]:
            ax.set_ylabel("y [mm]")
            ax.grid(visible=False)
        j = y.size // 2
        for ax, colour in ((axes[0], "white"), (axes[1], "black")):
            ax.axhline(y[j], color=colour, lw=0.9, ls=":")
        row = loaded_film(film[j], pressure[j]) if thickest is None else thickest
        _section(axes[2], x, film[j], pressure[j], top, 2.0 * row / _MICROMETRE)
        axes[2].set_title(f"dotted row, y = {y[j]:.3g} mm", loc="left", fontsize=9)
        axes[2].set_xlabel("x [mm], along the motion")
        if "time" in frame.coords:
            axes[0].set_title(f"Rough contact at {float(frame['time']) / _MICROMETRE:.4g} µs")
    return figure


def _mark_rough(axes: Any, run: xr.Dataset, scale: float) -> None:
    """Mark the time [s, over `scale`] from which the whole contact is rough."""
    if "rough_time" not in run.attrs:
        return
    at = float(run.attrs["rough_time"]) / scale
    for ax in axes:
        ax.axvline(at, color="0.4", lw=0.8, ls="--")
    axes[-1].annotate(
        "rough everywhere", (at, 1.0), xytext=(-4, -2), textcoords="offset points",
        xycoords=("data", "axes fraction"), ha="right", va="top", color="0.3", fontsize=8.5,
    )  # fmt: skip


def _section(ax: Any, x: Array, film: Array, pressure: Array, top: float, thickest: float) -> None:
    (line,) = ax.plot(x, pressure / _GIGAPASCAL, color=SERIES[1], lw=1.1, label="pressure")
    ax.set(ylabel="pressure [GPa]", ylim=(0.0, 1.05 * top))
    right = ax.twinx()
    right.spines["right"].set_visible(True)
    right.grid(visible=False)
    (other,) = right.plot(x, film / _MICROMETRE, color=SERIES[0], lw=1.1, label="film")
    right.set(ylabel="film [µm]", ylim=(0.0, thickest))
    ax.legend(handles=[line, other], loc="upper left")


def loaded_film(film: Array, pressure: Array) -> float:
    """Return a film that 95 % of the loaded nodes stay below [m]."""
    loaded = film[pressure > _EDGE * pressure.max()]
    return float(np.percentile(loaded, 95.0)) if loaded.size else float(film.max())


def _end(runs: Runs, quantity: str, share: float) -> float:
    """Return the value below which all runs have that share of the zone."""
    ends = []
    for run in runs.values():
        function = run[f"{quantity}_function"].values
        reached = np.searchsorted(function, share * function[-1])
        ends.append(run[f"{quantity}_edge"].values[min(int(reached) + 1, function.size - 1)])
    return float(max(ends))


def _check(runs: Runs | Sequence[object]) -> None:
    if not isinstance(runs, Mapping) or not runs:
        raise ParameterError('runs must be statistics by label, such as {"crossed": dataset}.')
