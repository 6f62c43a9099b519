"""Friction of the oil film along the contact lines of a mesh period, and over speed."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import xarray as xr

from gearlube.report.films import film_model_attributes
from gearlube.studies.helical.operating_point import Variables
from gearlube.studies.helical.settings import HelicalSettings
from gearlube_core.arrays import Array
from gearlube_core.friction.line_integrals import LineFrictionCycle
from gearlube_core.friction.line_points import LinePoints, line_points, table_line_load
from gearlube_core.mesh_table.line_mesh import LineMesh
from gearlube_core.units import kelvin_to_celsius, labelled

PHASES, NODES = 96, 16
_FEW = 16, 4  # phases and nodes where only a share is asked for
SPEED_STEPS = (0.1, 4.0, 17)  # of the operating point's speed, geometric

# name: attribute of the cycle, unit, long name
_POINTS = {
    "line_load": ("N/m", "normal load per length of line, static"),
    "coefficient": ("1", "coefficient of friction, negative before the pitch line"),
    "central_film": ("m", "central film thickness"),
    "minimum_film": ("m", "minimum film thickness"),
    "film_ratio": ("1", "central film thickness over composite roughness"),
    "temperature_rise": ("K", "mean rise of the film over the oil"),
    "mean_pressure": ("Pa", "mean Hertz pressure"),
    "entrainment": ("m/s", "mean surface speed across the line"),
    "sliding": ("m/s", "sliding speed, negative before the pitch line"),
}


def film_dataset(
    settings: HelicalSettings, mesh: LineMesh, observe: Callable[[float], None] = lambda share: None
) -> xr.Dataset:
    """Return film and friction at the points of all lines, their sums, and means over speed.

    Parameters
    ----------
    settings : HelicalSettings
    mesh : LineMesh
        Whose static line loads press.
    observe : callable
        Called with the share that is done [-].

    Returns
    -------
    xarray.Dataset
        Dimensions (friction_phase, friction_line, point) and film_speed. `friction_force` is that
        on the pinion off the line of action; `friction_force_constant` has the constant
        coefficient that loses the same power.
    """
    points = line_points(settings.file.helical_pair(), PHASES, NODES)
    load = table_line_load(points, mesh, settings.pinion_torque)
    cycle = _cycle(settings, points, load, settings.pinion_speed)
    valid = points.length > 0.0
    place = ("friction_phase", "friction_line", "point")
    variables: Variables = {
        name: labelled(place, np.where(valid, getattr(cycle, name), np.nan), unit, words)
        for name, (unit, words) in _POINTS.items()
    }
    for name, values, unit, words in (
        ("x", points.x, "m", "along the line of action from the pinion's tangent point"),
        ("z", points.z, "m", "along the axis from mid-face"),
        ("length", points.length, "m", "length of line that a point stands for"),
    ):
        variables[name] = labelled(
            place, np.where(valid, values, np.nan if name != "length" else 0.0), unit, words
        )
    pressed = load * points.length
    side = np.sign(points.x - points.pair.pitch_point)
    force = (cycle.coefficient * pressed).sum(axis=(1, 2))
    constant = cycle.mean_coefficient * (side * pressed).sum(axis=(1, 2))
    for name, values, unit, words in (
        ("friction_force", force, "N", "friction on the pinion off the line of action"),
        ("friction_force_constant", constant, "N", "the same with the mean coefficient"),
        ("power_loss", cycle.power_loss, "W", "friction power of all lines"),
    ):
        variables[name] = (("friction_phase",), values, {"units": unit, "long_name": words})
    speeds = settings.pinion_speed * np.geomspace(*SPEED_STEPS)
    swept = []
    for speed in speeds:
        swept.append(_cycle(settings, points, load, float(speed)))
        observe(len(swept) / speeds.size)
    for name, means, unit, words in (
        (
            "mean_coefficient",
            [c.mean_coefficient for c in swept],
            "1",
            "constant coefficient of friction that loses the same power",
        ),
        ("mean_power_loss", [c.mean_power_loss for c in swept], "W", "mean friction power"),
        ("efficiency", [c.efficiency for c in swept], "1", "efficiency, sliding friction alone"),
        (
            "smallest_film",
            [c.smallest_film.thickness for c in swept],
            "m",
            "smallest film, Dowson 1968",
        ),
        (
            "film_share_outside",
            [c.share_outside for c in swept],
            "1",
            "load outside the domain of the film model; above 0.05 all is by formulas",
        ),
    ):
        variables[name] = (("film_speed",), np.array(means), {"units": unit, "long_name": words})
    dataset = xr.Dataset(
        variables,
        coords={
            "friction_phase": labelled("friction_phase", points.phase, "1", "mesh phase"),
            "film_speed": ("film_speed", speeds, {"units": "rad/s", "long_name": "pinion speed"}),
        },
    )
    dataset.attrs |= {
        "oil": settings.film().oil.name,
        "oil_data_high_degc": kelvin_to_celsius(settings.film().oil.temperature_high),
        "film_model": settings.film().film,
        **film_model_attributes(settings.film().film_models),
        "oil_temperature": settings.oil_temperature,
        "oil_temperature_units": "K",
        "roughness_rms": settings.roughness_rms,
        "roughness_rms_units": "m",
        "pitch_point": points.pair.pitch_point,
        "pitch_point_units": "m",
        "loss_factor": cycle.loss_factor,
        "loss_factor_units": "1",
        "operating_mean_coefficient": cycle.mean_coefficient,
        "operating_mean_coefficient_units": "1",
        "operating_power_loss": cycle.mean_power_loss,
        "operating_power_loss_units": "W",
        "operating_power_loss_bound": cycle.power_loss_bound,
        "operating_power_loss_bound_units": "W",
        "operating_efficiency_bound": cycle.power_loss_bound
        / (settings.pinion_torque * settings.pinion_speed),
        "operating_share_outside": cycle.share_outside,
        "loads": "static; dynamic loads of `response.nc` differ",
    }
    return dataset


def share_outside(settings: HelicalSettings, mesh: LineMesh, speeds: Array) -> Array:
    """Return the share of the static load outside the film model at pinion speeds [rad/s]."""
    points = line_points(settings.file.helical_pair(), *_FEW)
    load = table_line_load(points, mesh, settings.pinion_torque)
    film, torque = settings.film(), settings.pinion_torque
    return np.array([film.cycle(points, load, float(one), torque).share_outside for one in speeds])


def _cycle(
    settings: HelicalSettings, points: LinePoints, load: Array, speed: float
) -> LineFrictionCycle:
    return settings.film().covered_cycle(points, load, speed, settings.pinion_torque)
