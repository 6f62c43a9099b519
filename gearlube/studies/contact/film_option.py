"""The options of `gearlube contact` that write the animation of flank films."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from drivetrain.axle_file.axle_file import AxleFile
from gearlube.cli.oil_option import oil_kelvin
from gearlube.plotting.drawn_tooth import DrawnTooth, ellipse
from gearlube.plotting.figure_files import save_animation
from gearlube.plotting.style import BLUE, VERMILLION, house_style, new_figure
from gearlube.studies.contact.run import ContactResults
from gearlube_core.arrays import Array
from gearlube_core.checks import check_within
from gearlube_core.contact.hertz import hertz_ellipse
from gearlube_core.contact.solid import contact_modulus
from gearlube_core.dynamics.hypoid_axle.model import HypoidAxle
from gearlube_core.dynamics.hypoid_mesh.parameters import HypoidAxleParameters
from gearlube_core.errors import ParameterError
from gearlube_core.hypoid_contact.contact_table import drawn_axes
from gearlube_core.hypoid_contact.pair import FlankPair
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from gearlube_core.mesh_table.netcdf import shipped_mesh_table
from gearlube_core.mesh_table.table import PAIRS, ZERO_PHASE, MeshTable
from gearlube_core.oil.lubricant import Lubricant
from gearlube_core.oil.oil_file import read_oil
from gearlube_core.progress import Progress, no_progress
from gearlube_core.units import kelvin_to_celsius, rads_to_rpm, rpm_to_rads

SPEED_RANGE = (10.0, 20000.0)  # rpm

_PAPERS_AXLE = "mohammadpour_2015"
_LEAST_PICTURES = 8
_SETTLING = 10  # mesh periods
_LARGEST_OVER_MEAN = 1.5  # pressure of a Hertz ellipse


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class FilmRequest:
    """Speed of the pinion and oil of films to show.

    Parameters
    ----------
    speed : float
        [rad/s]; 10 to 20000 rpm.
    oil : Lubricant
    oil_temperature : float
        [K], in the range of the oil's data.
    axle : str
        Axle file, or the name of a shipped one: masses, bearings and laws of the axle around the
        pair. Its own gears are not used.

    Raises
    ------
    ParameterError
        Speed or temperature is out of range.
    """

    speed: float
    oil: Lubricant
    oil_temperature: float
    axle: str = _PAPERS_AXLE

    def __post_init__(self) -> None:
        check_within("speed of the pinion", rads_to_rpm(self.speed), *SPEED_RANGE, "rpm")
        check_within(
            "oil_temperature",
            self.oil_temperature,
            self.oil.temperature_low,
            self.oil.temperature_high,
            "K",
        )


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _FlankFilms:
    """Contacts on the drawn gear tooth at N times of a mesh period, P tooth pairs.

    Parameters
    ----------
    phase : ndarray, shape (N, P)
        Of each tooth pair [mesh periods], 0 where it meets at the mean point.
    load, pressure, film, temperature : ndarray, shape (N, P)
        Force [N], largest Hertz pressure [Pa], central film [m] and film temperature [K]; NaN
        without load.
    centre, minor, major : ndarray, shape (N, P, 2)
        Centre of force and semi-axes of the ellipse, as parts of face width (from the toe) and of
        tooth height (from the root).
    torque : float
        Of the pinion [N.m].
    request : FilmRequest
    """

    phase: Array
    load: Array
    pressure: Array
    film: Array
    temperature: Array
    centre: Array
    minor: Array
    major: Array
    torque: float
    request: FilmRequest


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
    around = axle_around(axle or _PAPERS_AXLE, shipped_mesh_table(_PAPERS_AXLE))
    lubricant = around.oil if oil is None else read_oil(oil).lubricant
    degc = _DEGC if degc is None else degc
    return FilmRequest(
        speed=rpm_to_rads(rpm),
        oil=lubricant,
        oil_temperature=oil_kelvin(degc, lubricant),
        axle=axle or _PAPERS_AXLE,
    )


def write_films(results: ContactResults, request: FilmRequest, folder: Path) -> Path:
    """Write the animation of an analysis into its folder; return the file."""
    films = flank_films(results.contact, results.mesh_table, request)
    return animate_films(films, DrawnTooth.of_dataset(results.contact), folder)


def _film_picture(films: _FlankFilms, tooth: DrawnTooth, frame: int = 0) -> Any:
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
    films: _FlankFilms, tooth: DrawnTooth, folder: Path | str, progress: Progress = no_progress
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
    films: _FlankFilms, tooth: DrawnTooth, frame: int, pair: int, size: float = 1.0
) -> tuple[Array, Array]:
    """Return the outline of a contact on the drawn tooth [mm], `size` times the semi-axes."""
    parts = (films.centre[frame, pair], films.minor[frame, pair], films.major[frame, pair])
    t, s = ellipse(*parts, size)
    return tooth.along(t), tooth.up(s)


def _course(ax: Any, films: _FlankFilms, frame: int) -> None:
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


def flank_films(
    dataset: xr.Dataset, mesh: MeshTable, request: FilmRequest, pictures: int = 24
) -> _FlankFilms:
    """Return the films of a pair's drive flanks over a mesh period at its largest torque.

    The axle of the request with this pair and this oil runs at the torque; load, film and
    temperature are its outputs. Place and direction of the ellipses are those of the loaded
    contact.

    Parameters
    ----------
    dataset : xarray.Dataset
        Of `run_contact`.
    mesh : MeshTable
        Of the same analysis.
    request : FilmRequest
    pictures : int
        Times over the mesh period, 8 at least.

    Raises
    ------
    ParameterError
        The number of pictures is too small, or the dataset has no directions.
    ConvergenceError
        The axle finds no state of rest.

    Examples
    --------
    >>> oil = Lubricant.named("mohammadpour_2015")
    >>> request = FilmRequest(speed=200.0, oil=oil, oil_temperature=363.15)
    >>> flank_films(contact, table, request).film.max()  # doctest: +SKIP
    """
    if pictures < _LEAST_PICTURES:
        raise ParameterError(f"pictures must be at least {_LEAST_PICTURES}, got {pictures}.")
    if "minor_axis" not in dataset:
        raise ParameterError(
            "The contact data must have the directions of the ellipses (minor_axis); those of an "
            "earlier version lack them. Run `gearlube contact` again with --overwrite."
        )
    part = dataset.sel(side="drive").isel(torque=-1)
    torque = float(part["torque"])
    speed, oil_temperature = request.speed, request.oil_temperature
    parameters = replace(axle_around(request.axle, mesh), oil=request.oil)
    axle = HypoidAxle(parameters)
    load_torque = torque * mesh.gear_teeth / mesh.pinion_teeth
    axle.initialise(
        pinion_speed=speed,
        pinion_torque=torque,
        wheel_torque=load_torque,
        oil_temperature=oil_temperature,
    )
    period = 2.0 * math.pi / (speed * mesh.pinion_teeth)
    shape = (pictures, PAIRS)
    phase, load, film, temperature = (np.full(shape, np.nan) for _ in range(4))
    # few periods of a mesh that turns at nearly this speed: what friction takes slows it little
    for k in range(-_SETTLING * pictures, pictures):
        axle.step(period / pictures, torque, load_torque, oil_temperature)
        if k < 0:
            continue
        turned = axle.output("pinion.angle") * mesh.pinion_teeth / (2.0 * math.pi)
        for pair in range(PAIRS):
            phase[k, pair] = math.fmod(turned + pair, PAIRS) + ZERO_PHASE
            flank = f"flank[{pair + 1}]"
            carried = axle.output(f"{flank}.load")
            if carried > 0.0:
                load[k, pair] = carried
                film[k, pair] = axle.output(f"{flank}.film_thickness")
                temperature[k, pair] = axle.output(f"{flank}.temperature")
    places = _places(part)
    phase = _as_analysed(phase, places["phase"])
    at = {
        name: np.stack([np.interp(phase, places["phase"], column) for column in values.T], -1)
        for name, values in places.items()
        if name != "phase"
    }
    modulus = contact_modulus(parameters.solid, parameters.solid)
    axes = np.full((*shape, 3), np.nan)
    for index in zip(*np.nonzero(load > 0.0), strict=True):
        R_x, R_y = at["radii"][index]
        axes[index] = hertz_ellipse(R_x, R_y, modulus, load[index])
    return _FlankFilms(
        phase=phase,
        load=load,
        pressure=_LARGEST_OVER_MEAN * axes[..., 2],
        film=film,
        temperature=temperature,
        centre=at["centre"],
        minor=at["minor"] * axes[..., :1],
        major=at["major"] * axes[..., 1:2],
        torque=torque,
        request=request,
    )


def axle_around(path: str, mesh: MeshTable) -> HypoidAxleParameters:
    """Return the axle of an axle file, or of a shipped one, with other gears.

    Raises
    ------
    ParameterError
        The file is missing or wrong.
    """
    file, folder = AxleFile.given(path), Path(path).parent
    return file.car_axle(mesh, file.asperities(folder), file.described_oil(folder)).axle


def _as_analysed(phase: Array, known: Array) -> Array:
    """Return phases moved by whole windows to where the analysis knows the pair."""
    middle = 0.5 * (known[0] + known[-1])
    return np.asarray(phase - PAIRS * np.round((phase - middle) / PAIRS))


def _places(part: xr.Dataset) -> dict[str, Array]:
    """Return data of a loaded tooth pair at rising phases: centre, radii and axes per metre."""
    pair = FlankPair.from_file(HypoidGearFile.model_validate_json(part.attrs["gear_file"]), "drive")
    life = part["phase"].values[:, None] + part["pair"].values
    row, column = np.nonzero(np.isfinite(part["gear_s"].values))
    order = np.argsort(life[row, column])
    at = {
        "phase": xr.DataArray(row[order], dims="at"),
        "pair": xr.DataArray(column[order], dims="at"),
    }
    one = part.isel(at)
    phase = life[row, column][order]
    s, t = one["gear_s"].values, one["gear_t"].values
    minor, major = drawn_axes(pair, phase, s, t, one["minor_axis"].values)
    return {
        "phase": phase,
        "centre": np.stack([t, s], 1),
        "radii": np.stack([one["R_x"].values, one["R_y"].values], 1),
        "minor": minor,
        "major": major,
    }
