"""Operating points and stripped-down axles that several tests share."""

from dataclasses import replace
from inspect import signature

import numpy as np

from gearlube_core.dynamics.hypoid_axle import OUTPUT_INDEX, HypoidAxle, mohammadpour_2015_axle

OIL = 368.15  # K, the temperature at which Table A4 is taken to hold
TYRE_RADIUS = 0.320  # m
RATIO = 36 / 13
# Ring gear torque of the paper's road load, N.m
WHEEL_TORQUE = {20: 72.0, 40: 85.0, 60: 106.0, 80: 137.0, 100: 176.0}


def operating_point(speed_kmh, efficiency=0.96):
    """Pinion speed [rad/s], pinion torque and wheel torque [N.m] at a vehicle speed."""
    wheel_torque = WHEEL_TORQUE[speed_kmh]
    return (speed_kmh / 3.6 / TYRE_RADIUS * RATIO, wheel_torque / RATIO / efficiency, wheel_torque)


def running_axle(speed_kmh, parameters=None, efficiency=0.96):
    """An initialised axle and its constant torques."""
    axle = HypoidAxle(parameters or mohammadpour_2015_axle())
    speed, pinion_torque, wheel_torque = operating_point(speed_kmh, efficiency)
    axle.initialise(
        pinion_speed=speed,
        pinion_torque=pinion_torque,
        wheel_torque=wheel_torque,
        oil_temperature=OIL,
    )
    return axle, pinion_torque, wheel_torque


def axle_with(**settings):
    """Parameters of the paper's axle with arguments of its own and fields replaced, by name."""
    own = signature(mohammadpour_2015_axle).parameters
    axle = mohammadpour_2015_axle(**{name: settings.pop(name) for name in own if name in settings})
    return replace(axle, **settings)


def conservative(parameters, **changes):
    """The same axle without damping, friction, drag and roller films."""
    bearing = replace(parameters.bearing, loss=0.0, film="off")
    stripped = replace(
        parameters, bearing=bearing, hysteretic_loss=0.0, friction="off", bearing_torque_loss="none"
    )
    return replace(stripped, **changes)


def output(axle, name):
    return float(axle.outputs[OUTPUT_INDEX[name]])


def record(axle, torques, names, duration, h=1e-4):
    """Outputs by name against time, shape (len(names), steps)."""
    columns = [OUTPUT_INDEX[name] for name in names]
    rows = []
    for _ in range(round(duration / h)):
        axle.step(h, *torques, OIL)
        rows.append(axle.outputs[columns])
    return np.array(rows).T


def drive_only(table):
    """The table without its coast levels: the drive flanks' data serve both sides."""
    drive = table.torque > 0.0
    return replace(
        table,
        torque=table.torque[drive],
        series={key: values[drive] for key, values in table.series.items()},
        windows={key: values[drive] for key, values in table.windows.items()},
    )


def plain(table, level=50.0):
    """The drive flanks with radii, normal and e as at `level` [N.m], radii and n at their means.

    One stiffness for tangent and secant: the table for which motions are known in closed form.
    """
    table = drive_only(table)
    at = int(np.argmin(np.abs(table.torque - level)))
    series = dict(table.series)
    for key in ("R_p", "R_g", "n_x", "n_y", "n_z", "e"):
        series[key] = np.repeat(table.series[key][at : at + 1], table.torque.size, axis=0)
        if key != "e":
            series[key][:, 1:] = 0.0
    series["R_g"] = table.ratio * series["R_p"]
    series["k_t"] = series["k_m"]
    return replace(table, series=series)


def with_coast_flanks(table, R_p=1.03, k_m=0.9, e=1.6):
    """The table with coast levels of its own: radii, stiffness and e scaled, n mirrored in y."""
    table = drive_only(table)
    scale = {"k_m": k_m, "k_t": k_m, "R_p": R_p, "R_g": R_p, "n_y": -1.0, "e": e}
    coast = {key: scale.get(key, 1.0) * values[::-1] for key, values in table.series.items()}
    windows = {key: np.concatenate([v[::-1], v]) for key, v in table.windows.items()}
    return replace(
        table,
        torque=np.concatenate([-table.torque[::-1], table.torque]),
        series={key: np.concatenate([coast[key], v]) for key, v in table.series.items()},
        windows=windows,
    )


def with_shaft_errors(table, seed=4):
    """The table with errors of some micrometres that repeat with pinion and gear, by load."""
    rng = np.random.default_rng(seed)
    levels = table.torque.size
    return replace(
        table,
        shaft_error={
            "pinion": 2e-6 * rng.normal(size=(levels, 14, 2)),
            "gear": 1e-6 * rng.normal(size=(levels, 37, 2)),
        },
    )
