"""Reduction of a recorded point: one number per quantity, spectra, waveforms, mesh cycles."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from gearlube.report.films import covered_alone
from gearlube.studies.sweep.recording import (
    AXES,
    BEARINGS,
    FLANK_QUANTITIES,
    FLANKS,
    LOSSES,
    Recording,
)
from gearlube_core.arrays import Array
from gearlube_core.spectra import AngleWindow, extremes, order_spectrum, resample

NONE, SINGLE_SIDED, DOUBLE_SIDED = 0, 1, 2
_REFINE = 4  # points read between samples of smooth signals: 5 samples a cycle become 20
_CONTACT = 1e-3  # a flank counts as loaded above this share of its largest load

Variables = dict[str, Any]
HIGHEST_FREQUENCY = 4000.0  # Hz, end of the stored spectra: 0.8 of the Nyquist frequency
WAVE_POINTS_PER_MESH = 64
MESH_PHASES = 64
CAGE_SECTORS = 120


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


def spectra(recording: Recording, window: AngleWindow) -> Variables:
    """Return the angle-locked amplitude spectra up to `HIGHEST_FREQUENCY`."""
    signals = {
        "dte_spectrum": recording["mesh.dte"],
        "radial_spectrum": radial_displacement(recording),
        "axial_spectrum": recording["pinion.displacement.x"],
        "bearing_force_spectrum": recording["bearing[1].force.y"],
        "roller_load_spectrum": recording["bearing[1].roller[1].load"],
    }
    stacked = np.stack(list(signals.values()), axis=1)
    samples = resample(recording["pinion.angle"], stacked, window)
    spectrum = order_spectrum(samples, window).below(HIGHEST_FREQUENCY)
    columns = {name: ("bin", spectrum.amplitude[:, i]) for i, name in enumerate(signals)}
    return {"frequency": ("bin", spectrum.frequency), "order": ("bin", spectrum.order), **columns}


def waves(recording: Recording, window: AngleWindow) -> Variables:
    """Return waveforms over the last pinion revolution that starts at a multiple of 2 pi."""
    angle = recording["pinion.angle"]
    turn = 2.0 * math.pi
    one_turn = AngleWindow(
        start=turn * math.floor(angle[-1] / turn - 1.0),
        revolutions=1,
        samples_per_revolution=recording.teeth * WAVE_POINTS_PER_MESH,
        mean_speed=window.mean_speed,
    )
    signals = {
        "dte_wave": recording["mesh.dte"],
        "mesh_force_wave": recording["mesh.force"],
        "pinion_y_wave": recording["pinion.displacement.y"],
        "pinion_z_wave": recording["pinion.displacement.z"],
        "roller_load_wave": recording["bearing[1].roller[1].load"],
    }
    samples = resample(angle, np.stack(list(signals.values()), axis=1), one_turn)
    # A record of hardly more than one turn may not contain a whole turn from a multiple of 2 pi.
    samples[one_turn.angle < angle[0]] = np.nan
    columns = {name: ("pinion_angle", samples[:, i]) for i, name in enumerate(signals)}
    return {"pinion_angle": ("pinion_angle", one_turn.angle - one_turn.start), **columns}


def mesh_cycle(recording: Recording) -> Variables:
    """Return the flank quantities while a tooth pair passes the mesh, mean over all passages.

    Each of the flanks carries one tooth pair after another. Its quantities repeat with as many
    mesh periods as there are flanks, counted from pinion angle zero.
    """
    angle = recording["pinion.angle"]
    cycles = len(FLANKS)
    pitch = 2.0 * math.pi / recording.teeth
    passage = cycles * pitch
    first, last = math.ceil(angle[0] / passage), math.floor(angle[-1] / passage)
    phase = np.arange(cycles * MESH_PHASES) / MESH_PHASES
    at = passage * np.arange(first, last)[:, None] + pitch * phase[None, :]
    result: Variables = {"mesh_phase": ("mesh_phase", phase)}
    for quantity in FLANK_QUANTITIES:
        means = [
            np.mean(np.interp(at, angle, recording[f"flank[{i}].{quantity}"]), axis=0)
            for i in FLANKS
        ]
        result[f"flank_{quantity}"] = (("flank", "mesh_phase"), np.array(means))
    return result


def roller_zone(recording: Recording) -> Variables:
    """Return the load of roller 1 against cage angle: its loaded zone."""
    turn = 2.0 * math.pi
    cage, load = recording["bearing[1].cage.angle"], recording["bearing[1].roller[1].load"]
    sector = np.floor(np.mod(cage, turn) / turn * CAGE_SECTORS).astype(np.int64) % CAGE_SECTORS
    count = np.bincount(sector, minlength=CAGE_SECTORS)
    total = np.bincount(sector, weights=load, minlength=CAGE_SECTORS)
    low: Array = np.full(CAGE_SECTORS, np.inf)
    high: Array = np.full(CAGE_SECTORS, -np.inf)
    np.minimum.at(low, sector, load)
    np.maximum.at(high, sector, load)
    empty = count == 0
    mean = np.where(empty, np.nan, total / np.maximum(count, 1))
    return {
        "cage_angle": ("cage_angle", turn * (np.arange(CAGE_SECTORS) + 0.5) / CAGE_SECTORS),
        "roller_zone_mean": ("cage_angle", mean),
        "roller_zone_min": ("cage_angle", np.where(empty, np.nan, low)),
        "roller_zone_max": ("cage_angle", np.where(empty, np.nan, high)),
    }
