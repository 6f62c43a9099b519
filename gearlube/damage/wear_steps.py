"""Wear in steps: each lays its depth on the flanks, and the contact is solved again."""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from gearlube.damage.flank import HIGH, WIDE, contact_lines
from gearlube.damage.settings import DamageSettings
from gearlube.damage.teeth import Teeth, axle_teeth
from gearlube.output.toml_text import toml_text
from gearlube.report.cycle import variables_of
from gearlube_core.arrays import Array
from gearlube_core.friction.flank_states import FlankStates
from gearlube_core.hypoid_contact.contact_dataset import ContactSettings, analyse_contact
from gearlube_core.hypoid_contact.contact_table import contact_table
from gearlube_core.hypoid_contact.mesh_cycle import SIDES, CycleSettings
from gearlube_core.hypoid_geometry.flank.correction import WORN_GRID, worn_splines
from gearlube_core.hypoid_geometry.flank.flank import Flank
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from gearlube_core.mesh_table.netcdf import write_mesh_table
from gearlube_core.progress import Progress, no_progress
from gearlube_core.storage.atomic_file import write_text

POSITIONS = "positions"  # folder of finished positions, in that of the results
_POSITIONS, _TORQUES, _LOWEST = 12, 4, 0.03  # of a step's contact; lowest torque over the highest
_PHASES = np.linspace(-1.5, 1.5, 61)  # mesh periods, of a pressure profile
_AREA_GRID = (49, 97)
_FORM = ("step", "side")
_SHOWN = {
    "worn_life": (("step",), "1", "share of the life that is done"),
    "worn_depth": ((*_FORM, "member"), "um", "wear depth at the worst place"),
    "worn_rate": ((*_FORM, "member"), "um", "depth of a whole life at the rate of now"),
    "worn_pressure": (_FORM, "GPa", "largest Hertz pressure of the bins"),
    "worn_error": (_FORM, "um", "loaded transmission error at the highest torque, peak to peak"),
    "worn_profile": ((*_FORM, "worn_phase"), "GPa", "Hertz pressure at the highest torque"),
    "worn_map": (("side", "member", "up", "along"), "um", "wear depth after the last step"),
}


def wear_in_steps(
    settings: DamageSettings,
    *,
    contact: ContactSettings | None = None,
    folder: Path | None = None,
    jobs: int | None = None,
    progress: Progress = no_progress,
) -> xr.Dataset:
    """Return the wear of an axle's flanks over its life, the contact solved again on the way.

    Parameters
    ----------
    settings
        With gear file, wear coefficient, most steps and the depth of one.
    contact
        Positions and torques of each analysis of the contact; None: those that the bins span.
    folder
        Keeps finished positions, so that the same call goes on after a stop, and the worn gears:
        worn.toml, a gear file, and worn.nc, its mesh table. None: nothing is written.
    jobs, progress
        As in `run_contact`.

    Raises
    ------
    ParameterError
        The gear file or the wear coefficient is missing, or a bin is out of range.
    ConvergenceError
        The worn flanks find no equilibrium.

    Notes
    -----
    Step 0 is the new flank, analysed like the worn ones. A step ends where both members together
    have lost `wear_step` at the worst place. The volume of a bin is k times its load times its
    sliding distance, [archard_1953]. It lies on contact lines as long as the Hertz ellipse; what an
    edge of the tooth cuts off lies on the rest of the line. Splines smooth it over about 1 mm and
    keep the volume. Both depths are laid on the gear's flank: to first order the contact feels
    their sum alone, which opens the gap.
    """
    (car, file), most = settings.worn, settings.wear_steps
    contact = contact or _contact_of(settings)
    store = None if folder is None else folder / POSITIONS
    areas = np.array([[spline_areas(Flank.from_file(file, "gear", side))] for side in SIDES])
    lost, life = np.zeros((2, 2, *WORN_GRID)), 0.0
    rows: list[dict[str, Any]] = []
    while True:
        worn = worn_gears(file, lost.sum(axis=1))
        listed = partial(_reported, progress, len(rows), most)
        found = analyse_contact(worn, contact, store=store, jobs=jobs, progress=listed)
        table = contact_table(worn, found)
        teeth = axle_teeth(replace(car, axle=replace(car.axle, mesh=table)), None)
        volumes, pressure, profile = _worn_volumes(settings, teeth, table.pinion_teeth)
        rate = volumes / areas
        swing = np.ptp(found["rotation"].values[..., -1], axis=1)  # at the highest torque
        rows.append({
            "worn_life": life, "worn_pressure": 1e-9 * pressure, "worn_profile": 1e-9 * profile,
            "worn_error": 1e6 * swing * found["R_p"].values[..., -1].mean(axis=1),
            "worn_depth": 1e6 * depths(lost).max(axis=(-2, -1)),
            "worn_rate": 1e6 * depths(rate).max(axis=(-2, -1)),
        })  # fmt: skip
        if len(rows) > most or life >= 1.0:
            break
        fastest, left = float(depths(rate.sum(axis=1)).max()), 1.0 - life
        step = left if fastest * left <= settings.wear_step else settings.wear_step / fastest
        lost, life = lost + step * rate, 1.0 if step == left else life + step
    if folder is not None:
        write_text(toml_text(worn.model_dump(exclude_defaults=True)), folder / "worn.toml")
        write_mesh_table(table, folder / "worn.nc")
    values = {name: np.array([row[name] for row in rows]) for name in rows[0]}
    values["worn_map"] = 1e6 * depths(lost)
    one: dict[str, tuple[Any, ...]] = {
        name: (dims, values[name], *words) for name, (dims, *words) in _SHOWN.items()
    }
    return xr.Dataset(variables_of(one), coords={"worn_phase": _PHASES})


def _reported(progress: Progress, step: int, most: int, share: float, words: str) -> None:
    progress((step + share) / (most + 1), f"wear step {step} of {most}: {words}")


def _contact_of(settings: DamageSettings) -> ContactSettings:
    """Return few torques that the bins span."""
    torque = np.abs(settings.bins.torque)
    high = float(torque.max())
    low = float(np.clip(torque.min(), _LOWEST * high, 0.5 * high))
    torques = tuple(float(f"{one:.3g}") for one in np.geomspace(low, high, _TORQUES))
    return ContactSettings(cycle=CycleSettings(positions=_POSITIONS, torques=torques))


def worn_gears(file: HypoidGearFile, lost: Array) -> HypoidGearFile:
    """Return a gear file with depths [m] of wear on the gear's flanks, (2, *WORN_GRID).

    They are coefficients of splines, of the drive and the coast flank; nothing lost: the same file.
    """
    changes: dict[str, Any] = {}
    for side, depth in zip(SIDES, lost, strict=True):
        if depth.any():
            before = np.array(file.correction("gear", side).worn or 0.0)
            total = np.round(1e6 * (before + depth.ravel()), 6)
            changes[f"gear.{side}_flank.worn_um"] = tuple(total.tolist())
    return file.varied(changes) if changes else file


def depths(coefficients: Array) -> Array:
    """Return depths on the cells of a map, (..., HIGH, WIDE), of splines' (..., *WORN_GRID)."""
    up, along = (
        worn_splines((np.arange(cells) + 0.5) / cells, count)
        for cells, count in zip((HIGH, WIDE), WORN_GRID, strict=True)
    )
    return np.asarray(up @ coefficients @ along.T)


def spline_areas(flank: Flank) -> Array:
    """Return the integral of each spline over a flank, `WORN_GRID` [m2]."""
    s, t = (np.linspace(0.0, 1.0, count) for count in _AREA_GRID)
    r = flank.grid(s, t).r
    area = np.linalg.norm(np.cross(np.gradient(r, s, axis=0), np.gradient(r, t, axis=1)), axis=-1)
    area = np.where(np.isfinite(area), area, np.nanmean(area))
    area[[0, -1]] *= 0.5
    area[:, [0, -1]] *= 0.5
    up, along = (worn_splines(one, n) for one, n in zip((s, t), WORN_GRID, strict=True))
    return np.asarray(up.T @ area @ along) / ((s.size - 1) * (t.size - 1))


def spread(states: FlankStates, volumes: Array, size: tuple[float, float]) -> Array:
    """Return volumes at phases (N,) as shares of each spline, `WORN_GRID`, with the same sum.

    Each lies along a contact line of the drawn tooth of a `size` [m], between its phases too.
    """
    lines = contact_lines(states, size)
    weight = np.where(lines.inside, lines.profile, 0.0)  # of Archard's law under a Hertz ellipse
    weight *= lines.between(volumes) / weight.sum(axis=1, keepdims=True)
    weight = weight[lines.inside] * (volumes.sum() / max(weight.sum(), 1e-300))
    along, up = (one[lines.inside] for one in lines.at)
    rows = worn_splines(up, WORN_GRID[0]) * weight[:, None]
    return np.asarray(rows.T @ worn_splines(along, WORN_GRID[1]))


def _worn_volumes(
    settings: DamageSettings, teeth: Teeth, pinion_teeth: int
) -> tuple[Array, Array, Array]:
    """Return what a whole life takes off the flanks of now, largest pressures and a profile.

    Volumes are shares of splines, (side, member, *WORN_GRID) [m3]; those of the pinion are its
    depths over the area of the gear that it touches. Pressures in Pa, (side,) and (side, phases).
    """
    bins, k = settings.bins, settings.wear_coefficient or 0.0
    lost, profile = np.zeros((2, 2, *WORN_GRID)), np.zeros((2, _PHASES.size))
    pressure, highest = np.zeros(2), np.zeros(2)
    for torque, speed, temperature, turns in zip(*bins[:3], bins.revolutions, strict=True):
        states = teeth.states(float(torque), float(speed), float(temperature))
        i = int(states.carried < 0.0)
        share = 1.0 if settings.wear_of_all_load else states.asperity_share
        seconds = states.share_of_time * 2.0 * np.pi / (float(speed) * pinion_teeth)
        volumes = k * share * states.load * states.sliding * seconds
        slower = states.gear_speed / states.pinion_speed  # the pinion's depth over that of the gear
        lost[i, 0] += turns * spread(states, slower * volumes, teeth.drawn_size)
        lost[i, 1] += turns / teeth.ratio * spread(states, volumes, teeth.drawn_size)
        pressure[i] = max(pressure[i], states.pressure.max())
        if abs(torque) > highest[i]:
            highest[i] = abs(torque)
            profile[i] = np.interp(_PHASES, states.phase, states.pressure, left=0.0, right=0.0)
    return lost, pressure, profile
