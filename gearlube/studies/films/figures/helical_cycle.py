"""Pressure, film and load of a contact line over its meshing cycle."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

from gearlube.plotting.style import BLUE, GREEN, SERIES, VERMILLION, house_style, new_figure
from gearlube.studies.films.figures.parts import film_contours, pressure_contours

_PANELS = (
    ("pressure_max", 1e-9, "largest pressure [GPa]", BLUE),
    ("minimum_film", 1e6, "smallest film [µm]", VERMILLION),
    ("load", 1e-3, "load [kN]", GREEN),
    ("loaded_length", 1e3, "loaded length [mm]", GREEN),
)
_THICK = 3.0  # smallest films of the cycle that have contours
_DASHES = ("-", "--", ":", "-.")


def cycle_curves(dataset: xr.Dataset) -> Any:
    """Return largest pressure, smallest film, load and loaded length over the steps.

    Steps that did not converge are marked, and so is the line at rest where it was solved.
    """
    with house_style():
        figure = new_figure(8.6, 9.0)
        step = dataset["step"].values
        failed = dataset["converged"].values == 0.0
        axes = figure.subplots(len(_PANELS), 1, sharex=True)
        for ax, (name, factor, label, colour) in zip(axes, _PANELS, strict=True):
            values = factor * dataset[name].values
            ax.plot(step, values, color=colour, label="marching" if ax is axes[0] else None)
            if failed.any():
                ax.plot(step[failed], values[failed], "x", color="black")
            if f"steady_{name}" in dataset:
                at_rest = factor * dataset[f"steady_{name}"].values
                ax.plot(step, at_rest, "s", color="black", mfc="none", label="line at rest")
                values = np.append(values, at_rest)
            ax.set(ylabel=label, ylim=(0.0, 1.12 * max(float(np.nanmax(values)), 1e-12)))
        if "steady_minimum_film" in dataset:
            axes[0].legend(loc="lower left", ncols=2)
        _position_scale(axes[0], dataset)
        axes[-1].set_xlabel("step of the meshing cycle")
        figure.suptitle(_title(dataset), fontsize=11.5)
    return figure


def cycle_map(dataset: xr.Dataset) -> Any:
    """Return contours of pressure and film along the line over the steps.

    Of each section across the line its largest pressure and its smallest film.
    """
    with house_style():
        figure = new_figure(9.4, 7.4)
        top, bottom = figure.subplots(2, 1, sharex=True, sharey=True)
        places = (dataset["step"].values, 1e3 * dataset["y"].values)
        pressure = 1e-9 * dataset["line_pressure"].values.T
        film = 1e6 * dataset["line_film"].values.T
        pressure_contours(top, places, pressure)
        top.set_title("largest pressure across the line")
        lowest = float(np.nanmin(film))
        film_contours(bottom, places, film, (lowest, max(_THICK * lowest, 0.05)))
        bottom.set_title("smallest film across the line")
        for ax in (top, bottom):
            ax.set_ylabel("along the line, y [mm]")
            ax.grid(visible=False)
        bottom.set_xlabel("step of the meshing cycle")
        figure.suptitle(_title(dataset), fontsize=11.5)
    return figure


def compared_cycles(cycles: dict[str, xr.Dataset], film_exponent: float = 0.0) -> Any:
    """Return largest pressures and smallest films of several marches over their steps.

    Beside them the differences from the first march, at the steps that both have.

    Parameters
    ----------
    cycles
        Marches by the names that the legend shows.
    film_exponent
        Films are divided by the pinion speed, over that of the first march, to this power.
    """
    from matplotlib.ticker import MaxNLocator

    with house_style():
        figure = new_figure(11.0, 6.8)
        axes = figure.subplots(2, 2, sharex=True)
        first = next(iter(cycles.values()))
        for k, (label, cycle) in enumerate(cycles.items()):
            look: dict[str, Any] = {
                "color": SERIES[k % len(SERIES)],
                "ls": _DASHES[k % len(_DASHES)],
                "lw": 1.6,
            }
            failed = cycle["converged"].values == 0.0
            for row, (values, reference) in enumerate(
                zip(_shown(cycle, first, film_exponent), _shown(first, first, 0.0), strict=True)
            ):
                ax, beside = axes[row]
                ax.plot(cycle["step"], values, label=label if row == 0 else None, **look)
                ax.plot(cycle["step"][failed], values[failed], "x", color=look["color"])
                if k:
                    difference = 100.0 * (values / reference - 1.0)
                    beside.plot(difference["step"], difference, **look)
        for ax, what in zip(axes[:, 0], _quantities(film_exponent), strict=True):
            highest = max(float(np.nanmax(line.get_ydata(), initial=0.0)) for line in ax.lines)
            ax.set(ylabel=what, ylim=(0.0, 1.12 * max(highest, 1e-12)))
        for ax in axes[:, 1]:
            ax.axhline(0.0, color="black", lw=0.8)
            ax.set_ylabel(f"difference from {next(iter(cycles))} [%]")
        for ax in axes[1]:
            ax.set_xlabel("step of the meshing cycle")
            ax.xaxis.set_major_locator(MaxNLocator(integer=True))
        figure.legend(ncols=min(len(cycles), 4), loc="outside lower center")
        failures = sum(int(cycle.attrs["failures"]) for cycle in cycles.values())
        state = f", {failures} steps NOT CONVERGED (crosses)" if failures else ""
        names = dict.fromkeys(cycle.attrs["name"] for cycle in cycles.values())
        figure.suptitle(f"{', '.join(names)}{state}", fontsize=11.5)
    return figure


def _quantities(film_exponent: float) -> tuple[str, str]:
    divided = f" over (speed ratio)$^{{{film_exponent:g}}}$" if film_exponent else ""
    return "largest pressure [GPa]", f"smallest film{divided} [µm]"


def _shown(
    cycle: xr.Dataset, first: xr.Dataset, film_exponent: float
) -> tuple[xr.DataArray, xr.DataArray]:
    """Return largest pressures [GPa] and smallest films [µm] over the steps, as drawn."""
    scale = (cycle.attrs["pinion_speed"] / first.attrs["pinion_speed"]) ** film_exponent
    return 1e-9 * cycle["pressure_max"], 1e6 * cycle["minimum_film"] / scale


def _position_scale(ax: Any, dataset: xr.Dataset) -> None:
    """Draw the position of the line above the steps."""
    step, position = dataset["step"].values, 1e3 * dataset["position"].values
    if step.size < 2:
        return
    slope = (position[-1] - position[0]) / (step[-1] - step[0])
    above = ax.secondary_xaxis(
        "top",
        functions=(
            lambda n: position[0] + slope * (n - step[0]),
            lambda s: step[0] + (s - position[0]) / slope,
        ),
    )
    above.set_xlabel("position of the line $s_i$ [mm]")


def _title(dataset: xr.Dataset) -> str:
    of = dataset.attrs
    state = f"{of['failures']} steps NOT CONVERGED (crosses), " if of["failures"] else ""
    return (
        f"{of['name']}: {state}line through its cycle, {dataset.sizes['step']} steps, "
        f"{of['torque']:.4g} N·m"
    )
