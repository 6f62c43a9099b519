"""Figures of the films of a hypoid flank: contours of one film, and curves over a cycle."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

from gearlube.plotting.style import (
    BLUE,
    GREEN,
    GREY,
    ORANGE,
    PURPLE,
    VERMILLION,
    house_style,
    new_figure,
)
from gearlube.studies.films.figures.parts import dry_outline, film_contours, pressure_contours

_SIDE = 1.45  # semi-axes of the largest contact that are shown
_INSET = (0.0, 0.0, 0.3, 0.42)  # of a panel: left, bottom, width, height
_THICK = 1.8  # central films that have contours
_FORMULAS = {
    "central_film": (
        ("chittenden_central", "Chittenden at the entrainment's angle (axle)", VERMILLION, "-"),
        ("component_central", "Chittenden, minor-axis component", GREEN, "-"),
        ("grubin", "Grubin", PURPLE, "-"),
    ),
    "minimum_film": (
        ("chittenden_minimum", "Chittenden at the entrainment's angle (axle)", VERMILLION, "-"),
        ("component_minimum", "Chittenden, minor-axis component", GREEN, "-"),
    ),
    "pressure_max": (("hertz_pressure", "Hertz", ORANGE, "--"),),
    "traction_heated": (
        ("steady_traction_eyring", "Eyring, isothermal", GREEN, "--"),
        ("evans_johnson", "Evans-Johnson, Chittenden's film", VERMILLION, "-"),
        ("evans_johnson_roelands", "Evans-Johnson, solved film and viscosity", PURPLE, "-"),
        ("axle_friction", "axle, with asperities", ORANGE, "--"),
    ),
}
_PANELS = (
    ("central_film", 1e6, "central film [µm]"),
    ("minimum_film", 1e6, "smallest film [µm]"),
    ("pressure_max", 1e-9, "largest pressure [GPa]"),
    ("traction_heated", 1.0, "coefficient of friction [-]"),
)
_RATIOS = (
    ("chittenden_central", "steady_central_film", "Chittenden, central", VERMILLION, "-"),
    ("chittenden_minimum", "steady_minimum_film", "Chittenden, smallest", VERMILLION, "--"),
    ("component_central", "steady_central_film", "minor-axis component, central", GREEN, "-"),
    ("component_minimum", "steady_minimum_film", "minor-axis component, smallest", GREEN, "--"),
    ("grubin", "steady_central_film", "Grubin", PURPLE, "-"),
)
_SQUEEZE = (
    ("squeeze_central_film", "central film", BLUE, "-"),
    ("squeeze_minimum_film", "smallest film", BLUE, "--"),
    ("squeeze_pressure_max", "largest pressure", ORANGE, "-"),
)


def hypoid_contours(dataset: xr.Dataset) -> Any:
    """Return contours of pressure and film at the stored instants, with the dry contact dashed.

    The minor axis is drawn upwards and stretched; an inset with equal scales has the directions of
    entrainment and sliding.
    """
    with house_style():
        count = dataset.sizes["instant"]
        figure = new_figure(10.4, 2.5 * count + 0.8)
        axes = figure.subplots(count, 2, sharex=True, sharey=True, squeeze=False)
        place = (1e3 * dataset["y"].values, 1e3 * dataset["x"].values)
        reach = [_SIDE * 1e3 * float(dataset[f"semi_axis_{axis}"].max()) for axis in ("y", "x")]
        for row, (left, right) in enumerate(axes):
            one = dataset.isel(instant=row)
            position = int(one["instant_position"])
            pressure, film = 1e-9 * one["pressure"].values, 1e6 * one["film"].values
            central = 1e6 * float(dataset["steady_central_film"][position])
            pressure_contours(left, place, pressure)
            film_contours(right, place, film, (float(film.min()), _THICK * central), 0.3)
            phase = float(dataset["steady_phase"][position])
            load = float(dataset["steady_load"][position])
            psi, chi = (float(dataset[f"steady_{name}"][position]) for name in ("psi", "chi"))
            left.set_title(
                f"phase {phase:.2f}, {load:.0f} N, entrainment {np.degrees(psi):.0f}°, "
                f"sliding {np.degrees(chi):.0f}°"
            )
            right.set_title(f"central {central:.3f} µm, smallest {film.min():.3f} µm")
            for ax in (left, right):
                _plan(ax, one, reach)
            _directions(left, psi, chi)
            left.set_ylabel("minor axis [mm]")
        for ax in axes[-1]:
            ax.set_xlabel("major axis [mm]")
        stretch = _stretch(axes[0, 0], figure)
        figure.suptitle(
            f"{dataset.attrs['name']}: steady films along the engagement, dry contact dashed\n"
            f"the minor axis is stretched {stretch:.0f} times; arrows have equal "
            "scales: black entrainment, orange sliding",
            fontsize=10.5,
        )
    return figure


def _stretch(ax: Any, figure: Any) -> float:
    """Return how many times longer a millimetre is drawn upwards than sideways."""
    figure.draw_without_rendering()
    box = ax.get_window_extent()
    (left, right), (low, high) = ax.get_xlim(), ax.get_ylim()
    return float(box.height / (high - low) / (box.width / (right - left)))


def _plan(ax: Any, one: xr.Dataset, reach: list[float]) -> None:
    dry_outline(ax, (float(one["semi_axis_y"]), float(one["semi_axis_x"])), "black", 0.9)
    low, high = (1e3 * float(one["y"][end]) for end in (0, -1))
    ax.set(xlim=(max(low, -reach[0]), min(high, reach[0])), ylim=(-1.9 * reach[1], reach[1]))
    ax.grid(visible=False)


def _directions(ax: Any, psi: float, chi: float) -> None:
    """Draw the directions of entrainment and sliding in an inset with equal scales.

    Angles are from the minor axis, which points up, to the major axis.
    """
    inset = ax.inset_axes(_INSET)
    inset.set(xlim=(-1.15, 1.15), ylim=(-1.15, 1.15), aspect="equal")
    inset.axis("off")
    inset.axhline(0.0, color=GREY, lw=0.7)
    inset.axvline(0.0, color=GREY, lw=0.7)
    for angle, colour in ((psi, "black"), (chi, VERMILLION)):
        inset.annotate(
            "",
            (np.sin(angle), np.cos(angle)),
            (0.0, 0.0),
            arrowprops={"arrowstyle": "->", "color": colour, "lw": 1.4, "shrinkA": 0, "shrinkB": 0},
        )


def hypoid_curves(dataset: xr.Dataset) -> Any:
    """Return film, pressure and friction over the phase, steady and in time, with formulas.

    Films that did not converge are crossed out.
    """
    with house_style():
        figure = new_figure(9.6, 10.4)
        for ax, (name, factor, label) in zip(
            figure.subplots(len(_PANELS), 1, sharex=True), _PANELS, strict=True
        ):
            place = dataset["steady_phase"].values
            steady = factor * dataset[f"steady_{name}"].values
            for formula, text, colour, line in _FORMULAS[name]:
                values = factor * dataset[formula].values
                ax.plot(place, values, color=colour, ls=line, lw=1.2, label=text)
            if "phase" in dataset:
                ax.plot(
                    dataset["phase"], factor * dataset[name], color=GREY, lw=3.0, label="in time"
                )
            ax.plot(place, steady, "o", color=BLUE, ms=3.8, label="solution, steady")
            failed = dataset["steady_converged"].values == 0.0
            ax.plot(place[failed], steady[failed], "kx", ms=9.0)
            ax.set(ylabel=label, ylim=(0.0, None))
            ax.legend(loc="center left", bbox_to_anchor=(1.01, 0.5), fontsize=8)
        ax.set_xlabel("phase of the pair [mesh periods]")
        figure.suptitle(_title(dataset), fontsize=11.5)
    return figure


def hypoid_ratios(dataset: xr.Dataset) -> Any:
    """Return formulas over solutions, and films in time over steady ones, along the phase."""
    with house_style():
        panels = 3 if "squeeze_central_film" in dataset else 2
        figure = new_figure(8.8, 2.9 * panels)
        axes = figure.subplots(panels, 1, sharex=True)
        place = dataset["steady_phase"].values
        for name, solved, text, colour, line in _RATIOS:
            axes[0].plot(place, dataset[name] / dataset[solved], color=colour, ls=line, label=text)
        axes[0].set_ylabel("formula over solution [-]")
        if panels == 3:
            for name, text, colour, line in _SQUEEZE:
                axes[1].plot(place, dataset[name], color=colour, ls=line, label=text)
            axes[1].set_ylabel("in time over steady [-]")
        for ax in axes[:-1]:
            ax.axhline(1.0, color=GREY, lw=0.8)
            ax.legend(loc="center left", bbox_to_anchor=(1.01, 0.5), fontsize=8)
        load, angle = axes[-1], axes[-1].twinx()
        load.plot(place, 1e-3 * dataset["steady_load"], color=BLUE)
        load.set(ylabel="load [kN]", ylim=(0.0, None), xlabel="phase of the pair [mesh periods]")
        load.yaxis.label.set_color(BLUE)
        low, high = 0.0, 90.0
        for name, text, line in (("psi", "entrainment", "-"), ("chi", "sliding", "--")):
            degrees = np.degrees(dataset[f"steady_{name}"])
            angle.plot(place, degrees, color=VERMILLION, ls=line, label=text)
            low, high = min(low, float(degrees.min())), max(high, float(degrees.max()))
        angle.set(ylabel="from the minor axis [°]", ylim=(low, 1.05 * high))
        angle.legend(loc="center left", bbox_to_anchor=(1.12, 0.5), fontsize=8)
        angle.yaxis.label.set_color(VERMILLION)
        angle.grid(visible=False)
        figure.suptitle(_title(dataset), fontsize=11.5)
    return figure


def _title(dataset: xr.Dataset) -> str:
    of = dataset.attrs
    state = f"{of['failures']} films NOT CONVERGED, " if of["failures"] else ""
    rpm = of["pinion_speed"] * 30.0 / np.pi
    return (
        f"{of['name']}: {state}{of['flank']} flank, {of['pinion_torque']:.4g} N·m, {rpm:.0f} rpm, "
        f"{of['oil_temperature'] - 273.15:.0f} °C"
    )
