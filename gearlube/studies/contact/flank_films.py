"""Films on the drive flank over a mesh period: contact ellipses on the tooth, films of the axle."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import xarray as xr

from drivetrain.axle_file.axle_file import AxleFile
from gearlube_core.arrays import Array
from gearlube_core.checks import check_within
from gearlube_core.contact.elliptical_hertz import hertz_ellipse
from gearlube_core.contact.solid import contact_modulus
from gearlube_core.dynamics.hypoid_axle.model import HypoidAxle
from gearlube_core.dynamics.hypoid_axle.parameters import HypoidAxleParameters
from gearlube_core.errors import ParameterError
from gearlube_core.hypoid_contact.drawn_contact import drawn_axes
from gearlube_core.hypoid_contact.pair import FlankPair
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from gearlube_core.mesh_table.fourier import ZERO_PHASE
from gearlube_core.mesh_table.table import PAIRS, MeshTable
from gearlube_core.oil.lubricant import Lubricant
from gearlube_core.units import rads_to_rpm

SPEED_RANGE = (10.0, 20000.0)  # rpm
PAPERS_AXLE = "mohammadpour_2015"
LEAST_PICTURES = 8
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
    axle: str = PAPERS_AXLE

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
class FlankFilms:
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


def flank_films(
    dataset: xr.Dataset, mesh: MeshTable, request: FilmRequest, pictures: int = 24
) -> FlankFilms:
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
    if pictures < LEAST_PICTURES:
        raise ParameterError(f"pictures must be at least {LEAST_PICTURES}, got {pictures}.")
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
    return FlankFilms(
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
    """Return what a loaded tooth pair has at rising phases: centre, radii and axes per metre."""
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
