"""The options of `gearlube contact` that write the animation of flank films."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from gearlube.cli.oil_option import oil_kelvin
from gearlube.plotting.animation import save_animation
from gearlube.plotting.drawn_tooth import DrawnTooth, ellipse
from gearlube.plotting.style import BLUE, VERMILLION, house_style, new_figure
from gearlube.studies.contact.flank_films import (
    PAPERS_AXLE,
    SPEED_RANGE,
    FilmRequest,
    FlankFilms,
    axle_around,
    flank_films,
)
from gearlube.studies.contact.run import ContactResults
from gearlube_core.arrays import Array
from gearlube_core.checks import check_within
from gearlube_core.errors import ParameterError
from gearlube_core.mesh_table.shipped import shipped_mesh_table
from gearlube_core.oil.oil_file import read_oil
from gearlube_core.progress import Progress, no_progress
from gearlube_core.units import kelvin_to_celsius, rads_to_rpm, rpm_to_rads

ANIMATION = "flank_films.gif"

_RINGS = 14  # of equal pressure in an ellipse
_DEGC = 90.0


def film_request(
    rpm: float | None, oil: str | None, degc: float | None, axle: str | None = None
) -> FilmRequest | None:
    """Return what is asked for, None without a speed; errors name the options.

    Wrong axle files are found here, before the contact is analysed.
    """
    if rpm is None:
        for option, value in (("--axle", axle), ("--oil", oil), ("--oil-temperature", degc)):
            if value is not None:
                raise ParameterError(
                    f"{option} {value} is only for --films-rpm, which is missing. Give both, or "
                    "none: without films the contact is dry."
                )
        return None
    check_within("--films-rpm", rpm, *SPEED_RANGE, "rpm")
    around = axle_around(axle or PAPERS_AXLE, shipped_mesh_table(PAPERS_AXLE))
    lubricant = around.oil if oil is None else read_oil(oil).lubricant
    degc = _DEGC if degc is None else degc
    return FilmRequest(
        speed=rpm_to_rads(rpm),
        oil=lubricant,
        oil_temperature=oil_kelvin(degc, lubricant),
        axle=axle or PAPERS_AXLE,
    )


def write_films(results: ContactResults, request: FilmRequest, folder: Path) -> Path:
    """Write the animation of an analysis into its folder; return the file."""
    films = flank_films(results.contact, results.mesh_table, request)
    return animate_films(films, DrawnTooth.of_dataset(results.contact), folder)


def _film_picture(films: FlankFilms, tooth: DrawnTooth, frame: int = 0) -> Any:
    """Return pressure and film on the tooth at a time, and both over the engagement of a pair."""
    from matplotlib import colormaps
    from matplotlib.cm import ScalarMappable
    from matplotlib.colors import Normalize

    asked = films.request
    pressure, film = 1e-9 * films.pressure, 1e6 * films.film
    maps = (
        ("pressure [GPa]", Normalize(0.0, float(np.nanmax(pressure))), colormaps["magma_r"]),
        ("central film [µm]", Normalize(0.0, float(np.nanmax(film))), colormaps["viridis"]),
    )
    with house_style():
        figure = new_figure(9.2, 7.4)
        axes = figure.subplots(3, 1, height_ratios=(1.0, 1.0, 0.8))
        for ax, (label, scale, colours) in zip(axes[:2], maps, strict=True):
            tooth.draw(ax)
            figure.colorbar(ScalarMappable(scale, colours), ax=ax, label=label, shrink=0.9)
        axes[0].set_xlabel("")
        for pair in np.flatnonzero(np.isfinite(films.pressure[frame])):
            place = (films, tooth, frame, int(pair))
            _, scale, colours = maps[0]
            for ring in np.linspace(1.0, 1.0 / _RINGS, _RINGS):
                value = pressure[frame, pair] * np.sqrt(max(1.0 - ring**2, 0.0))
                axes[0].fill(*_ellipse(*place, ring), color=colours(scale(value)), lw=0.0)
            _, scale, colours = maps[1]
            axes[1].fill(*_ellipse(*place), color=colours(scale(film[frame, pair])), lw=0.0)
            for ax in axes[:2]:
                ax.plot(*_ellipse(*place), color="black", lw=0.9)
        _course(axes[2], films, frame)
        figure.suptitle(
            f"Flank films, drive side: {films.torque:g} N·m, {rads_to_rpm(asked.speed):.0f} rpm, "
            f"{asked.oil.name} at {kelvin_to_celsius(asked.oil_temperature):.0f} °C, "
            f"axle {Path(asked.axle).stem}",
            fontsize=10.5,
        )
    return figure


def animate_films(
    films: FlankFilms, tooth: DrawnTooth, folder: Path | str, progress: Progress = no_progress
) -> Path:
    """Write pressure and films over a mesh period as FOLDER/flank_films.gif; return the file.

    Examples
    --------
    >>> animate_films(films, DrawnTooth.of_dataset(contact), "my_gear")  # doctest: +SKIP
    """
    highest = int(np.unravel_index(np.nanargmax(films.pressure), films.pressure.shape)[0])
    return save_animation(
        lambda frame: _film_picture(films, tooth, frame),
        films.phase.shape[0],
        Path(folder) / ANIMATION,
        first=highest,
        per_second=8,
        dots_per_inch=75,
        progress=progress,
    )


def _ellipse(
    films: FlankFilms, tooth: DrawnTooth, frame: int, pair: int, size: float = 1.0
) -> tuple[Array, Array]:
    """Return the outline of a contact on the drawn tooth [mm], `size` times the semi-axes."""
    parts = (films.centre[frame, pair], films.minor[frame, pair], films.major[frame, pair])
    t, s = ellipse(*parts, size)
    return tooth.along(t), tooth.up(s)


def _course(ax: Any, films: FlankFilms, frame: int) -> None:
    """Draw largest pressure and film of a tooth pair from entry to exit, and where pairs are."""
    other = ax.twinx()
    order = np.argsort(films.phase, axis=None)
    for one, values, colour, label in (
        (ax, 1e-9 * films.pressure, BLUE, "largest pressure [GPa]"),
        (other, 1e6 * films.film, VERMILLION, "central film [µm]"),
    ):
        one.plot(films.phase.ravel()[order], values.ravel()[order], color=colour)
        one.plot(films.phase[frame], values[frame], "o", color=colour, ms=7)
        one.set_ylabel(label, color=colour)
        one.set_ylim(0.0, 1.1 * float(np.nanmax(values)))
    other.grid(visible=False)
    ax.set_xlabel("from entry to exit of a tooth pair [mesh periods]; dots: now")
