"""One number per quantity of a recorded point."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from gearlube.report.films import covered_alone
from gearlube.studies.sweep.operating_point import AXES, BEARINGS, FLANKS, LOSSES
from gearlube.studies.sweep.recording import Recording
from gearlube_core.arrays import Array
from gearlube_core.spectra import AngleWindow, extremes

NONE, SINGLE_SIDED, DOUBLE_SIDED = 0, 1, 2
_REFINE = 4  # points read between samples of smooth signals: 5 samples a cycle become 20
_CONTACT = 1e-3  # a flank counts as loaded above this share of its largest load

Variables = dict[str, Any]


def separation_class(dte_min: float, dte_max: float, backlash: float) -> int:
    """Return the class of contact loss: 0 none, 1 single-sided, 2 double-sided impacts.

    With the drive flank in contact for x > 0 and the coast flank for x < -2b:
    single-sided when max >= 0 and -2b < min < 0, double-sided when min <= -2b and max >= 0.

    Parameters
    ----------
    dte_min, dte_max : float
        Extremes of the dynamic transmission error [m].
    backlash : float
        Total normal backlash 2b [m].

    Notes
    -----
    Mirrored for coasting: contact with the coast flank throughout (max <= -2b) is class 0.
    Teeth that float in the gap for the whole record (-2b < x < 0) count as single-sided.
    Source: [mohammadpour_2015 (3)], classes after [karagiannis_2012 sec. 3].
    """
    if dte_min >= 0.0 or dte_max <= -backlash:
        return NONE
    if dte_min <= -backlash and dte_max >= 0.0:
        return DOUBLE_SIDED
    return SINGLE_SIDED


def radial_displacement(recording: Recording) -> Array:
    """Return the pinion's distance from its preloaded rest position across its axis [m].

    r = sqrt(y^2 + z^2), shape (n,). Not taken about the mean, so that its extremes show the
    static deflection too and its spectrum has the frequencies of the motion, not their doubles.
    """
    y, z = recording["pinion.displacement.y"], recording["pinion.displacement.z"]
    return np.hypot(y, z)


def scalars(recording: Recording, window: AngleWindow, *, backlash: float) -> Variables:
    """Return the scalar results of a point as xarray variables."""
    return {
        **_operation(recording, window),
        **_mesh(recording, backlash),
        **_displacements(recording),
        **_bearings(recording),
        **_power(recording),
        **_films(recording),
    }


def _slope(recording: Recording, channel: str) -> float:
    """Return the mean rate of change of a cumulative channel over the whole record."""
    values = recording[channel]
    return float((values[-1] - values[0]) / (recording.time[-1] - recording.time[0]))


def _operation(recording: Recording, window: AngleWindow) -> Variables:
    per_turn = 1.0 / (2.0 * math.pi)
    pinion, wheel = _slope(recording, "pinion.angle"), _slope(recording, "wheel.angle")
    return {
        "vehicle_speed": recording.vehicle_speed,
        "pinion_speed": pinion,
        "pinion_torque": float(np.mean(recording.torques[:, 0])),
        "wheel_torque": float(np.mean(recording.torques[:, 1])),
        "mesh_frequency": recording.teeth * pinion * per_turn,
        "pinion_frequency": pinion * per_turn,
        "wheel_frequency": wheel * per_turn,
        "pinion_cage_frequency": _slope(recording, "bearing[1].cage.angle") * per_turn,
        "wheel_cage_frequency": _slope(recording, "bearing[3].cage.angle") * per_turn,
        "record_revolutions": window.revolutions,
        "communication_step": recording.step,
        "oil_temperature": recording.oil_temperature,
    }


def _mesh(recording: Recording, backlash: float) -> Variables:
    dte = recording["mesh.dte"]
    x = extremes(dte, _REFINE)
    force = extremes(recording["mesh.force"])
    return {
        "dte_min": x.minimum,
        "dte_max": x.maximum,
        "dte_mean": x.mean,
        "dte_pp": x.peak_to_peak,
        "dte_rms": float(np.std(dte)),
        "separation": separation_class(x.minimum, x.maximum, backlash),
        "separated_fraction": float(np.mean(dte <= 0.0)),
        "mesh_force_min": force.minimum,
        "mesh_force_max": force.maximum,
        "mesh_force_mean": force.mean,
        "dynamic_factor": force.maximum / force.mean if force.mean else math.nan,
    }


def _displacements(recording: Recording) -> Variables:
    radial = extremes(radial_displacement(recording), _REFINE)
    pinion = extremes(recording["pinion.displacement.x"], _REFINE)
    wheel = extremes(recording["wheel.displacement.z"], _REFINE)
    return {
        "radial_min": radial.minimum,
        "radial_max": radial.maximum,
        "radial_mean": radial.mean,
        "radial_pp": radial.peak_to_peak,
        "axial_pp": pinion.peak_to_peak,
        "wheel_axial_pp": wheel.peak_to_peak,
    }


def _bearings(recording: Recording) -> Variables:
    roller = extremes(recording["bearing[1].roller[1].load"])
    forces = [
        [extremes(recording[f"bearing[{j}].force.{axis}"], _REFINE) for axis in AXES]
        for j in BEARINGS
    ]
    least = [float(np.min(recording[f"bearing[{j}].roller_load_min"])) for j in BEARINGS]
    most = [float(np.max(recording[f"bearing[{j}].roller_load_max"])) for j in BEARINGS]
    both = ("bearing", "axis")
    return {
        "roller_load_min": roller.minimum,
        "roller_load_max": roller.maximum,
        "roller_load_mean": roller.mean,
        "bearing_roller_load_min": ("bearing", least),
        "bearing_roller_load_max": ("bearing", most),
        "bearing_force_mean": (both, [[force.mean for force in row] for row in forces]),
        "bearing_force_pp": (both, [[force.peak_to_peak for force in row] for row in forces]),
    }


def _power(recording: Recording) -> Variables:
    """Split the input power with the cumulative energies over the record.

    Closure: P_in - P_out - sum of losses - d(stored)/dt, relative to P_in; zero for an exact
    time integration.
    """
    power_in = _slope(recording, "energy.pinion_work")
    power_out = _slope(recording, "energy.wheel_work")
    loss = {name: _slope(recording, f"energy.{name}") for name in LOSSES}
    total = sum(loss.values())
    open_power = power_in - power_out - total - _slope(recording, "energy.stored")
    friction = loss["friction_viscous"] + loss["friction_boundary"]
    means = {
        one: float(np.mean(recording[one]))
        for one in ("film.share_outside", "bearing.share_outside")
    }
    bound, drag_bound = (
        float(covered_alone(float(np.mean(recording[f"{of}.power_loss_bound"])), means[share]))
        for of, share in zip(("friction", "bearing"), means, strict=True)
    )
    return {
        "friction_loss_bound": bound,
        "efficiency_bound": bound / power_in if power_in > 0.0 else math.nan,
        "share_outside": means["film.share_outside"],
        "drag_bound": drag_bound,
        "rollers_outside": means["bearing.share_outside"],
        "power_in": power_in,
        "loss": ("source", list(loss.values())),
        "efficiency_mesh": 1.0 - friction / power_in if power_in > 0.0 else math.nan,
        "efficiency_axle": 1.0 - total / power_in if power_in > 0.0 else math.nan,
        "energy_closure_error": open_power / power_in if power_in else math.nan,
    }


def _films(recording: Recording) -> Variables:
    thinnest, ratio, hottest = math.inf, math.inf, -math.inf
    for i in FLANKS:
        load = recording[f"flank[{i}].load"]
        loaded = load > _CONTACT * max(float(np.max(load)), 1e-9)
        if not np.any(loaded):
            continue
        thinnest = min(thinnest, float(np.min(recording[f"flank[{i}].film_thickness"][loaded])))
        ratio = min(ratio, float(np.min(recording[f"flank[{i}].film_ratio"][loaded])))
        hottest = max(hottest, float(np.max(recording[f"flank[{i}].temperature"][loaded])))
    found = math.isfinite(thinnest)
    return {
        "film_thickness_min": thinnest if found else math.nan,
        "film_ratio_min": ratio if found else math.nan,
        "flank_temperature_max": hottest if found else math.nan,
    }
