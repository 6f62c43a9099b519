"""Losses of a pair alone over torque, speed and oil temperature, with error bars."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace

import numpy as np
import xarray as xr

from gearlube.output.csv_text import csv_text
from gearlube.report.films import film_model_attributes
from gearlube.studies.helical.settings import RPM, HelicalSettings
from gearlube_core.arrays import Array
from gearlube_core.contact.hertz import line_mean_pressure
from gearlube_core.dynamics.helical_pair.mesh.film_friction import FilmFriction
from gearlube_core.dynamics.helical_uncertain import uncertain_of
from gearlube_core.dynamics.hypoid_axle.uncertain import Uncertain
from gearlube_core.film.biboulet_houpert_2010 import biboulet_houpert_force
from gearlube_core.film.groups import inlet_heating_number
from gearlube_core.film.zhu_cheng_1989 import zhu_cheng_heating
from gearlube_core.film_model.model import MOST_OUTSIDE
from gearlube_core.friction.line_integrals import LineFrictionCycle
from gearlube_core.friction.line_points import LinePoints, line_points, table_line_load
from gearlube_core.helical_geometry.contact_line import ContactPlane, line_kinematics
from gearlube_core.kernels.jit import kernel
from gearlube_core.mesh_table.line_mesh import LineMesh
from gearlube_core.oil.lubricant_state import LubricantState
from gearlube_core.units import ZERO_CELSIUS, kelvin_to_celsius, labelled

PARTS_OF_LOSS = ("sliding", "rolling")
NOT_MODELLED = "bearings, seals, churning and squeezing of oil, windage"
GRID = ("temperature", "torque", "speed")
SPEED_STEPS = (0.2, 0.3, 0.45, 0.65, 1.0, 1.4, 2.0)  # of the operating point's speed
_FINE, _COARSE = (48, 8), (16, 4)  # phases and nodes: of the values, of the draws
_LARGEST_OVER_MEAN = 4.0 / math.pi  # pressure of a Hertz line
_BOUNDS = (2.5, 97.5)  # percent


@kernel
def _rolling_powers(
    x: Array,
    line_load: Array,
    speed: float,
    plane: ContactPlane,
    oil: LubricantState,
    contact_modulus: float,
    powers: Array,
) -> None:
    """Write the power that rolling takes per length at each point [W/m]."""
    for j in range(x.size):
        powers[j] = 0.0
        if line_load[j] > 0.0:
            motion = line_kinematics(x[j], speed, plane)
            u, modulus = motion.entrainment, 2.0 * contact_modulus
            force, _ = biboulet_houpert_force(
                motion.R, line_load[j], modulus, oil.eta0, oil.alpha, u
            )
            pressure = _LARGEST_OVER_MEAN * line_mean_pressure(
                line_load[j], motion.R, contact_modulus
            )
            heat = inlet_heating_number(oil.eta0, oil.beta, u, oil.conductivity)
            factor = zhu_cheng_heating(heat, pressure / modulus, abs(motion.slide_roll))
            powers[j] = 2.0 * force * u * factor


def losses_dataset(
    settings: HelicalSettings, mesh: LineMesh, observe: Callable[[float], None] = lambda share: None
) -> xr.Dataset:
    """Return the mean losses of a mesh period, static loads on the lines.

    Parameters
    ----------
    settings : HelicalSettings
        `load_steps` [N.m], `speeds` [rad/s] (empty: 0.2 to 2 times that of the operating point) and
        `oil_temperatures` [K] are the grid, `draws` and `seed` the error bars.
    mesh : LineMesh
        Whose static line loads press.
    observe : callable
        Called with the share that is done [-].

    Returns
    -------
    xarray.Dataset
        Over temperature [degC], torque [N.m] and speed [rpm] of the pinion; `loss` [W] by part,
        `loss_torque` [N.m] at the pinion with the bounds of 95 % of the draws.

    Notes
    -----
    Sliding: `line_friction` at every point, or the film model. Rolling: 2 F u per length by
    [biboulet_houpert_2010], flooded, lowered by inlet heating [zhu_cheng_1989]. Loads are static.
    A point with more than `MOST_OUTSIDE` of its load outside the film model is by the formulas,
    with their error bar and no `loss_bound`; `by_formulas` marks it. A draw that leaves the film
    model changes the loss by the ratio that the formulas give.
    """
    torques = np.array(settings.load_steps)
    speeds = np.array(settings.speeds)
    if speeds.size == 0:
        speeds = settings.pinion_speed * np.array(SPEED_STEPS)
    temperatures = np.array(settings.oil_temperatures or (settings.oil_temperature,))
    pair = settings.file.helical_pair()
    fine, coarse = line_points(pair, *_FINE), line_points(pair, *_COARSE)
    shape = temperatures.size, torques.size, speeds.size
    loss = np.empty((*shape, len(PARTS_OF_LOSS)))
    film, thinnest, heat = np.empty(shape), np.empty(shape), np.empty(shape)
    low, high = np.empty(shape), np.empty(shape)
    error, outside = np.empty(shape), np.empty(shape)
    uncertain = uncertain_of(settings.film().oil, settings.film().asperities)
    normals = np.random.default_rng(settings.seed).standard_normal((settings.draws, len(uncertain)))
    for j, torque in enumerate(torques):
        loads = [table_line_load(points, mesh, float(torque)) for points in (fine, coarse)]
        for i, temperature in enumerate(temperatures):
            observe((j * temperatures.size + i) / (torques.size * temperatures.size))
            base = replace(settings.film(), oil_temperature=float(temperature))
            for k, speed in enumerate(speeds):
                point = float(torque), float(speed)
                cycle, loss[i, j, k] = _losses(fine, loads[0], point, base)
                film[i, j, k] = cycle.film_ratio[cycle.line_load > 0.0].min()
                error[i, j, k], outside[i, j, k] = cycle.power_loss_bound, cycle.share_outside
                thinnest[i, j, k] = cycle.smallest_film.thickness
                heat[i, j, k] = cycle.temperature_rise[cycle.line_load > 0.0].max()
                if settings.draws:
                    used = base.formulas if cycle.by_formulas else base
                    ends = _spread(normals, uncertain, coarse, loads[1], point, used)
                    low[i, j, k], high[i, j, k] = ends * loss[i, j, k].sum()
    total = loss.sum(axis=-1)
    variables = {
        "loss": ((*GRID, "part"), loss, "W", "mean power lost"),
        "loss_torque": (GRID, total / speeds, "N.m", "loss torque at the pinion"),
        "efficiency": (
            GRID,
            1.0 - total / (torques[:, None] * speeds),
            "1",
            "efficiency of the mesh",
        ),
        "film_ratio": (GRID, film, "1", "least central film over roughness"),
        "film_min": (GRID, thinnest, "m", "smallest film thickness, Dowson 1968"),
        "temperature_rise": (GRID, heat, "K", "largest mean rise of the film over the oil"),
    }
    if settings.film().film == "solved":
        variables |= {
            "loss_bound": (GRID, error, "W", "bound of the sliding loss by the film model, 95 %"),
            "efficiency_bound": (
                GRID,
                error / (torques[:, None] * speeds),
                "1",
                "the same of the efficiency",
            ),
            "share_outside": (GRID, outside, "1", "load outside the domain of the film model"),
            "by_formulas": (
                GRID,
                1.0 * (outside > MOST_OUTSIDE),
                "1",
                f"1: by formulas, as more than {MOST_OUTSIDE:g} is outside; 0: solved films",
            ),
        }
    if settings.draws:
        variables |= {
            "loss_torque_low": (GRID, low / speeds, "N.m", "2.5 % of draws are below"),
            "loss_torque_high": (GRID, high / speeds, "N.m", "97.5 % of draws are below"),
        }
    return xr.Dataset(
        {
            name: (dims, values, {"units": unit, "long_name": words})
            for name, (dims, values, unit, words) in variables.items()
        },
        coords={
            "temperature": labelled(
                "temperature", temperatures - ZERO_CELSIUS, "degC", "oil temperature"
            ),
            "torque": ("torque", torques, {"units": "N.m", "long_name": "pinion torque"}),
            "speed": labelled("speed", speeds * 30.0 / math.pi, "rpm", "pinion speed"),
            "part": ("part", np.array(PARTS_OF_LOSS), {"units": "", "long_name": "kind of loss"}),
        },
        attrs={
            "not_modelled": NOT_MODELLED,
            "pinion_torque": settings.pinion_torque,
            "pinion_speed": settings.pinion_speed,
            "oil": settings.film().oil.name,
            "oil_data_high_degc": kelvin_to_celsius(settings.film().oil.temperature_high),
            "film_model": settings.film().film,
            **film_model_attributes(settings.film().film_models),
            "draws": settings.draws,
            "seed": settings.seed,
            "uncertain": "; ".join(
                f"{one.name}: factor {one.factor:g} (k = 2), {one.why}" for one in uncertain
            ),
            "loads": "static, of the mesh " + mesh.name,
        },
    )


def _losses(
    points: LinePoints,
    load: Array,
    point: tuple[float, float],
    film: FilmFriction,
    raw: bool = False,
) -> tuple[LineFrictionCycle, Array]:
    """Return the friction of a mesh period and its mean powers, sliding and rolling [W].

    `point` is torque [N.m] and speed [rad/s]; `raw` without formulas standing in for solved films.
    """
    torque, speed = point
    constants = film.constants()
    cycle = (film.cycle if raw else film.covered_cycle)(points, load, speed, torque)
    powers = np.empty(load.size)
    _rolling_powers(
        points.x.ravel(),
        np.ascontiguousarray(load).ravel(),
        speed,
        points.pair.plane,
        film.oil.state(film.oil_temperature),
        constants.solid.contact_modulus,
        powers,
    )
    rolling = (powers.reshape(load.shape) * points.length).sum(axis=(1, 2)).mean()
    return cycle, np.array([cycle.mean_power_loss, rolling])


def _spread(
    normals: Array,
    uncertain: tuple[Uncertain, ...],
    points: LinePoints,
    load: Array,
    point: tuple[float, float],
    film: FilmFriction,
) -> Array:
    """Return the ends of 95 % of the draws over the loss itself, on coarse points [-]."""
    own = _losses(points, load, point, film, raw=True)[1]
    formulas = _losses(points, load, point, film.formulas)[1]
    totals = []
    for row in normals:
        changed, by = _drawn(row, uncertain, film)
        cycle, powers = _losses(points, load, point, changed, raw=True)
        if cycle.by_formulas:
            powers = own * _losses(points, load, point, changed.formulas)[1] / formulas
        totals.append(by["sliding"] * powers[0] + by["rolling"] * powers[1])
    return np.asarray(np.percentile(totals, _BOUNDS) / own.sum())


def _drawn(
    normals: Array, uncertain: tuple[Uncertain, ...], film: FilmFriction
) -> tuple[FilmFriction, dict[str, float]]:
    """Return the film with the uncertain data at these standard normals, and all multipliers."""
    by = {
        one.name: one.multiplier(float(normal))
        for one, normal in zip(uncertain, normals, strict=True)
    }
    oil = film.oil
    ends = ZERO_CELSIUS + 40.0, ZERO_CELSIUS + 100.0
    nu = [by["viscosity"] * oil.dynamic_viscosity(end) / oil.density for end in ends]
    oil = replace(
        oil.with_two_viscosities(nu[0], ends[0], nu[1], ends[1], name=oil.name),
        eyring_stress=oil.eyring_stress * by["eyring_stress"],
        eyring_slope=oil.eyring_slope * by["eyring_stress"],
        alpha=oil.alpha * by["alpha"],
    ).with_high_pressure(by.get("high_pressure", 1.0))
    law = film.asperities
    if law is not None:
        law = replace(law, **{name: value * by[name] for name, value in law.numbers.items()})
    roughness = film.roughness_rms * by["roughness"]
    return replace(film, oil=oil, roughness_rms=roughness, asperities=law), by


def in_operation(losses: xr.Dataset) -> xr.Dataset:
    """Return the point of the losses next to the operating point, in the first oil temperature."""
    own = {"torque": losses.attrs["pinion_torque"], "speed": losses.attrs["pinion_speed"] / RPM}
    return losses.isel(temperature=0).sel(own, method="nearest")


def loss_band(one: xr.Dataset) -> tuple[float, float] | None:
    """Return between which powers [W] 95 % of the draws of the uncertain data lie, if drawn."""
    if "loss_torque_low" not in one:
        return None
    low, high = (float(one[f"loss_torque_{end}"]) for end in ("low", "high"))
    return low * float(one["speed"]) * RPM, high * float(one["speed"]) * RPM


def efficiency_band(one: xr.Dataset) -> tuple[float, float] | None:
    """Return the efficiencies [%] of `loss_band`, the lower first."""
    band = loss_band(one)
    if band is None:
        return None
    power = float(one["torque"]) * float(one["speed"]) * RPM
    return 100.0 - 100.0 * band[1] / power, 100.0 - 100.0 * band[0] / power


def losses_csv(dataset: xr.Dataset) -> str:
    """Return the losses as a table with a row for each point, units in the names of columns."""
    columns = {
        "loss_torque": "loss_torque_n_m",
        "loss_torque_low": "loss_torque_low_n_m",
        "loss_torque_high": "loss_torque_high_n_m",
        "efficiency": "efficiency",
        "efficiency_bound": "efficiency_bound",
        "loss_bound": "loss_bound_w",
        "share_outside": "share_outside",
        "by_formulas": "by_formulas",
        "film_ratio": "film_ratio",
        "temperature_rise": "temperature_rise_k",
    }
    columns = {name: column for name, column in columns.items() if name in dataset}
    parts = [str(one) for one in dataset["part"].values]
    head = (
        "oil_temperature_degc",
        "pinion_torque_n_m",
        "pinion_speed_rpm",
        *columns.values(),
        *(f"loss_{one}_w" for one in parts),
    )
    grid = [dataset[name].values for name in GRID]
    rows = []
    for place in np.ndindex(*(one.size for one in grid)):
        where = [one[i] for one, i in zip(grid, place, strict=True)]
        values = [dataset[name].values[place] for name in columns]
        rows.append([f"{x:.7g}" for x in (*where, *values, *dataset["loss"].values[place])])
    return csv_text(head, rows)
