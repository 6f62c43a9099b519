"""Spectra, waveforms and mesh cycles of a recorded point."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from gearlube.studies.sweep.operating_point import FLANK_QUANTITIES, FLANKS
from gearlube.studies.sweep.recording import Recording
from gearlube.studies.sweep.scalars import radial_displacement
from gearlube_core.arrays import Array
from gearlube_core.spectra import AngleWindow, order_spectrum, resample

HIGHEST_FREQUENCY = 4000.0  # Hz, end of the stored spectra: 0.8 of the Nyquist frequency
WAVE_POINTS_PER_MESH = 64
MESH_PHASES = 64
CAGE_SECTORS = 120

Variables = dict[str, Any]


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
    return {
        "frequency": ("bin", spectrum.frequency),
        "order": ("bin", spectrum.order),
        **columns,
    }


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
