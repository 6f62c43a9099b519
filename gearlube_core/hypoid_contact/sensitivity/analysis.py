"""Sensitivity of a hypoid pair's contact, unloaded and loaded, to settings and misalignments."""

from __future__ import annotations

import hashlib
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from gearlube_core.arrays import Array
from gearlube_core.checks import check_within
from gearlube_core.errors import ParameterError
from gearlube_core.hypoid_contact.contact_kinematics import path_kinematics
from gearlube_core.hypoid_contact.contact_path import ContactPath, contact_path
from gearlube_core.hypoid_contact.loaded_contact import LoadedSettings, MeshPosition
from gearlube_core.hypoid_contact.mesh_cycle import PAIRS_BESIDE, SIDES
from gearlube_core.hypoid_contact.pair import FlankPair
from gearlube_core.hypoid_contact.placement import ALIGNED, Misalignment
from gearlube_core.hypoid_contact.refusal import check_pair
from gearlube_core.hypoid_contact.sensitivity.loaded_rates import (
    QUANTITIES,
    LoadedQuantities,
    loaded_rates,
)
from gearlube_core.hypoid_contact.sensitivity.parameter import Variations, usual_parameters
from gearlube_core.hypoid_contact.sensitivity.sensitivity_dataset import sensitivity_dataset
from gearlube_core.hypoid_contact.sensitivity.unloaded_rates import (
    PathRates,
    angle_rates,
    ease_off_rates,
    path_rates,
)
from gearlube_core.hypoid_contact.tooth_body import pair_stiffness
from gearlube_core.hypoid_contact.unloaded_error import UnloadedError, unloaded_error
from gearlube_core.hypoid_geometry.flank.flank import Side
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from gearlube_core.progress import Progress, no_progress, part_of
from gearlube_core.storage.process_pool import single_threaded
from gearlube_core.storage.resumable import Record
from gearlube_core.tooth_compliance.tooth_body import ToothBodySettings
from gearlube_core.tooth_contact.coupled_strips import PairStiffness
from gearlube_core.tooth_contact.mesh_cycle import compute_positions, stack_records


@dataclass(frozen=True, slots=True)
class _ErrorRates:
    """Derivatives of the unloaded mesh over a period, per unit of each of P parameters.

    Parameters
    ----------
    gear_angle : ndarray of shape (N,)
        From handover to handover [rad].
    transmission_error : ndarray of shape (P, N)
        Of the pair in contact, at fixed gear angle [rad/unit].
    peak_to_peak : ndarray of shape (P,)
        Of the error between its extreme and the handover [rad/unit].
    handover_angle, extreme_angle : ndarray of shape (P,)
        Gear angles of the first handover and of the extreme [rad/unit].
    s, t : ndarray of shape (P,)
        Of the mean contact on the gear flank: where the error is extreme [1/unit].
    path : PathRates
        Of the contacts.
    """

    gear_angle: Array
    transmission_error: Array
    peak_to_peak: Array
    handover_angle: Array
    extreme_angle: Array
    s: Array
    t: Array
    path: PathRates


EASE_S, EASE_T = np.linspace(0.2, 1.0, 9), np.linspace(0.0, 1.0, 13)
_ERROR_POSITIONS = 33
_FORMAT = 1  # raise with every change of the model that changes results


@dataclass(frozen=True, slots=True, kw_only=True)
class SensitivitySettings:
    """Parameters by which `run_sensitivity` differentiates the contact, and at which load.

    Parameters
    ----------
    parameters : tuple of str
        Dotted fields of the gear file with a length, an angle or a ratio, and "misalignment."
        with pinion_offset (E), pinion_axial (P), gear_axial (G) or shaft_angle. Empty: all
        misalignments, machine settings and cutter dimensions.
    torque : float
        Torque on the pinion, for either flank [N.m], 0.01 to 1e5.
    positions : int
        Number of mesh phases in a period, 4 to 400.
    misalignment : Misalignment
        Misalignment at which the derivatives are taken.
    loaded : LoadedSettings
    body : ToothBodySettings

    Examples
    --------
    >>> SensitivitySettings(torque=100.0, parameters=("misalignment.pinion_axial",)).positions
    8
    """

    parameters: tuple[str, ...] = ()
    torque: float = 50.0
    positions: int = 8
    misalignment: Misalignment = ALIGNED
    loaded: LoadedSettings = field(default_factory=LoadedSettings)
    body: ToothBodySettings = field(default_factory=ToothBodySettings)

    def __post_init__(self) -> None:
        check_within("torque", self.torque, 1e-2, 1e5, "N.m", "The pinion's torque.")
        check_within("positions", self.positions, 4, 400, "", "Positions over the mesh period.")

    @property
    def phases(self) -> Array:
        """Mesh phases [mesh periods], (positions,)."""
        return np.arange(self.positions) / self.positions


def contact_sensitivity(
    file: HypoidGearFile,
    settings: SensitivitySettings,
    *,
    store: Path | None = None,
    cache: Path | None = None,
    jobs: int | None = None,
    progress: Progress = no_progress,
) -> xr.Dataset:
    """Return how contact and transmission error change with settings and misalignments.

    Parameters
    ----------
    file : HypoidGearFile
    settings : SensitivitySettings
    store : Path, optional
        Folder that keeps finished positions, so that an interrupted analysis goes on.
    cache : Path, optional
        Folder of tooth compliances; default: the user's cache.
    jobs : int, optional
        Processes; default: all processors.
    progress : callable, optional
        Called with the share of positions that is done [-] and a sentence on what runs.

    Returns
    -------
    xarray.Dataset
        Values and their rates, named `..._rate`, per unit of each parameter; see
        `sensitivity_dataset`.

    Raises
    ------
    ParameterError
        When the flanks do not meet or a parameter has no derivative; it says why.
    ConvergenceError
        When a position finds no equilibrium.

    Notes
    -----
    The teeth's compliance and the loaded cells are held (`loaded_rates`).

    Examples
    --------
    >>> file = HypoidGearFile.named("mohammadpour_2015")
    >>> found = contact_sensitivity(file, SensitivitySettings())  # doctest: +SKIP
    >>> found["te_pp_rate"].sel(parameter="misalignment.pinion_axial")  # doctest: +SKIP
    """
    progress(0.0, "checking the gear file")
    check_pair(file, settings.misalignment)
    names = settings.parameters or usual_parameters(file)
    variations: dict[Side, Variations] = {}
    for side in SIDES:
        pair = FlankPair.from_file(file, side, settings.misalignment)
        variations[side] = Variations.of(file, pair, names)
    progress(0.0, "elastic teeth")
    stiffness = pair_stiffness(file, settings.body, cache=cache, jobs=jobs)
    progress(0.0, "loaded contact")
    with single_threaded():
        positions = compute_positions(
            [(side, float(phase)) for side in SIDES for phase in settings.phases],
            partial(_position, variations, stiffness, settings),
            key=_key(file, settings, stiffness),
            folder=store,
            label=_label,
            jobs=jobs,
            progress=part_of(progress, 0.0, 0.9),
        )
        progress(0.9, "unloaded contact")
        parts = {
            side: {
                **stack_records(positions[side, float(phase)] for phase in settings.phases),
                **_unloaded(variations[side]),
            }
            for side in SIDES
        }
    parameters, grid = variations["drive"].parameters, (EASE_S, EASE_T)
    found = sensitivity_dataset(file, parameters, parts, settings.phases, grid, settings.torque)
    progress(1.0, "done")
    return found


def _unloaded(variations: Variations) -> Record:
    """Return derivatives without load; NaN where teeth meet at edges or flanks are corrected."""
    count = len(variations.parameters)
    names = ("unloaded_pp", "unloaded_s", "unloaded_t")
    found: Record = {name: np.array(np.nan) for name in names}
    found |= {f"{name}_rate": np.full(count, np.nan) for name in names}
    empty = np.full((EASE_S.size, EASE_T.size), np.nan)
    found |= {"ease_off": empty, "ease_off_rate": np.full((count, *empty.shape), np.nan)}
    if variations.pair.is_corrected:
        return found
    ease = ease_off_rates(variations, EASE_S, EASE_T)
    found |= {"ease_off": ease.gap, "ease_off_rate": ease.rate}
    try:
        error = unloaded_error(variations.pair, _ERROR_POSITIONS)
    except ParameterError:  # teeth that hand over at edges: there is no parabola
        return found
    rates = error_rates(variations, error)
    mean = rates.path.path
    values = (abs(error.angular[0]), mean.gear_s[-1], mean.gear_t[-1])
    slopes = (rates.peak_to_peak, rates.s, rates.t)
    for name, value, slope in zip(names, values, slopes, strict=True):
        found[name], found[f"{name}_rate"] = np.array(value), slope
    return found


def _position(
    variations: dict[Side, Variations],
    stiffness: dict[Side, PairStiffness],
    settings: SensitivitySettings,
    position: tuple[Side, float],
) -> Record:
    side, phase = position
    mesh = MeshPosition.at(variations[side].pair, phase, PAIRS_BESIDE)
    state = mesh.load(settings.torque, stiffness[side], settings.loaded)
    found = loaded_rates(variations[side], state, stiffness[side])
    where = [mesh.phases.index(one) for one in found.phases]

    def shares(quantities: LoadedQuantities) -> Array:
        whole = np.zeros((*quantities.share.shape[:-1], len(mesh.phases)))
        whole[..., where] = quantities.share
        return whole

    record: dict[str, Any] = {"share": shares(found.value), "share_rate": shares(found.rate)}
    for name in QUANTITIES:
        record[name] = np.array(getattr(found.value, name))
        record[f"{name}_rate"] = getattr(found.rate, name)
    return record


def _label(position: tuple[Side, float]) -> tuple[str, str]:
    side, phase = position
    return f"{side}_{phase:.6f}", f"{side} flanks, mesh phase {phase:.2f}"


def _key(
    file: HypoidGearFile, settings: SensitivitySettings, stiffness: dict[Side, PairStiffness]
) -> str:
    digest = hashlib.sha256(f"sensitivity {_FORMAT}".encode())
    digest.update(file.model_dump_json().encode())
    digest.update(repr(settings).encode())
    for side in SIDES:
        for part in (stiffness[side].pinion, stiffness[side].gear):
            digest.update(np.ascontiguousarray(part.image).tobytes())
    return digest.hexdigest()[:16]


def error_rates(variations: Variations, error: UnloadedError) -> _ErrorRates:
    """Return the derivatives of the unloaded transmission error by parameters.

    At the handover the errors e of the leaving and the entering pair are equal, and move the angle
    by -(e_p1 - e_p0) / (e'_1 - e'_0), with e_p at fixed angle and e' along the path. At the extreme
    R_g / R_p is the teeth ratio.

    Parameters
    ----------
    variations : Variations
        Of the error's pair.
    error : UnloadedError
    """
    pair = error.path.pair
    angles = np.append(error.gear_angle, error.extreme_angle)
    rates = path_rates(variations, contact_path(pair, angles))
    by_setting = rates.transmission_error
    k = error.kinematics
    slope = k.R_g / k.R_p - pair.ratio
    handover = -(by_setting[:, -2] - by_setting[:, 0]) / (slope[-1] - slope[0])
    at_handover = by_setting[:, 0] + slope[0] * handover
    extreme, (s, t) = _extreme(variations, rates)
    highest = error.angular[0] > 0.0
    return _ErrorRates(
        gear_angle=error.gear_angle,
        transmission_error=by_setting[:, :-1],
        peak_to_peak=(1.0 if highest else -1.0) * (at_handover - by_setting[:, -1]),
        handover_angle=handover,
        extreme_angle=extreme,
        s=s,
        t=t,
        path=rates,
    )


def _extreme(variations: Variations, rates: PathRates) -> tuple[Array, tuple[Array, Array]]:
    """Return how the angle of the extreme moves, the last of the path, and its place (s, t)."""
    lower, upper, angle = angle_rates(rates.path)

    def along(values: tuple[Array, Array]) -> float:
        return float((values[1][-1] - values[0][-1]) / (2.0 * angle))

    bend = along((_mismatch(lower), _mismatch(upper)))
    by_setting = variations.difference(
        np.array([_mismatch(one)[-1] for one in rates.lower]),
        np.array([_mismatch(one)[-1] for one in rates.upper]),
    )
    moved = -by_setting / bend
    return moved, (
        rates.gear_s[:, -1] + along((lower.gear_s, upper.gear_s)) * moved,
        rates.gear_t[:, -1] + along((lower.gear_t, upper.gear_t)) * moved,
    )


def _mismatch(path: ContactPath) -> Array:
    k = path_kinematics(path)
    return k.R_g / k.R_p - path.pair.ratio
