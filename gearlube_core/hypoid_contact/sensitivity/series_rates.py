"""A mesh table at one torque and its derivatives by settings, reliefs and misalignments."""

from __future__ import annotations

import hashlib
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.checks import check_within
from gearlube_core.hypoid_contact.contact_table import fourier, orders_kept
from gearlube_core.hypoid_contact.loaded_contact import LoadedSettings, MeshPosition
from gearlube_core.hypoid_contact.mesh_cycle import PAIRS_BESIDE
from gearlube_core.hypoid_contact.pair import FlankPair
from gearlube_core.hypoid_contact.placement import ALIGNED, Misalignment
from gearlube_core.hypoid_contact.refusal import check_pair
from gearlube_core.hypoid_contact.sensitivity.loaded_rates import loaded_rates
from gearlube_core.hypoid_contact.sensitivity.parameter import Parameter, usual_parameters
from gearlube_core.hypoid_contact.sensitivity.variations import Variations
from gearlube_core.hypoid_contact.tooth_body import pair_stiffness
from gearlube_core.hypoid_geometry.flank.flank import Side
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from gearlube_core.mesh_table.table import (
    PAIRS,
    SERIES_UNITS,
    WINDOW_UNITS,
    MeshTable,
    Provenance,
)
from gearlube_core.progress import Progress, no_progress
from gearlube_core.storage.process_pool import single_threaded
from gearlube_core.storage.result_store import Record
from gearlube_core.tooth_compliance.tooth_body import ToothBodySettings
from gearlube_core.tooth_contact.coupled_strips import PairStiffness
from gearlube_core.tooth_contact.mesh_cycle import compute_positions, stack_records

HALF_WIDTH = 0.1  # of the torque: the tangent stiffness is that between 0.9 and 1.1 of it
SIDE: Side = "drive"
_KEPT = ("rotation", "touching", "gear_torque", "force")
_FORMAT = 1  # raise with every change of the model that changes results


@dataclass(frozen=True, slots=True, kw_only=True)
class SeriesSettings:
    """Parameters by which the mesh table is differentiated in `run_whine`, and at which load.

    Parameters
    ----------
    parameters : tuple of str
        As in `SensitivitySettings`; empty: all misalignments, settings and reliefs of the file.
    torque : float
        Torque on the pinion [N.m], 0.01 to 1e5.
    positions : int
        Number of mesh phases in a period, 4 to 400; `orders_kept` tells how many orders the series
        then have.
    misalignment : Misalignment
    loaded : LoadedSettings
    body : ToothBodySettings

    Examples
    --------
    >>> [round(one, 3) for one in SeriesSettings(torque=45.0).torques]
    [40.5, 49.5]
    """

    parameters: tuple[str, ...] = ()
    torque: float = 50.0
    positions: int = 16
    misalignment: Misalignment = ALIGNED
    loaded: LoadedSettings = field(default_factory=LoadedSettings)
    body: ToothBodySettings = field(default_factory=ToothBodySettings)

    def __post_init__(self) -> None:
        check_within("torque", self.torque, 1e-2, 1e5, "N.m", "The pinion's torque.")
        check_within("positions", self.positions, 4, 400, "", "Positions over the mesh period.")

    @property
    def torques(self) -> tuple[float, float]:
        """The torques between which the mesh is a spring [N.m]."""
        return (1.0 - HALF_WIDTH) * self.torque, (1.0 + HALF_WIDTH) * self.torque


@dataclass(frozen=True, slots=True)
class SeriesRates:
    """A mesh table of one level and the derivatives of its series by P parameters.

    Parameters
    ----------
    table : MeshTable
        Its windows are empty: of use where flank friction is off.
    parameters : tuple of Parameter
    rates : mapping of str to ndarray of shape (P, H + 1, 2)
        Of k_m, k_t, R_p, R_g and e, per unit of each parameter. The normal is held.
    rotation : ndarray of shape (N,)
        Loaded transmission error over the mesh phases [rad].
    rotation_rate : ndarray of shape (P, N)
        [rad/unit]
    """

    table: MeshTable
    parameters: tuple[Parameter, ...]
    rates: Mapping[str, Array]
    rotation: Array
    rotation_rate: Array


def series_rates(
    file: HypoidGearFile,
    settings: SeriesSettings,
    *,
    store: Path | None = None,
    cache: Path | None = None,
    jobs: int | None = None,
    progress: Progress = no_progress,
) -> SeriesRates:
    """Return the drive flanks' mesh table at one torque and its derivatives by settings.

    Parameters
    ----------
    file : HypoidGearFile
    settings : SeriesSettings
    store : Path, optional
        Folder that keeps finished positions, so that an interrupted analysis goes on.
    cache, jobs, progress
        As in `contact_sensitivity`.

    Raises
    ------
    ParameterError
        When the flanks do not meet or a parameter has no derivative; it says why.
    ConvergenceError
        When a position finds no equilibrium.
    """
    progress(0.0, "checking the gear file")
    check_pair(file, settings.misalignment)
    pair = FlankPair.from_file(file, SIDE, settings.misalignment)
    variations = Variations.of(file, pair, settings.parameters or usual_parameters(file))
    progress(0.0, "elastic teeth")
    stiffness = pair_stiffness(file, settings.body, cache=cache, jobs=jobs)[SIDE]
    phases = (np.arange(settings.positions) / settings.positions).tolist()
    with single_threaded():
        found = compute_positions(
            phases,
            partial(position_record, variations, stiffness, settings),
            key=_key(file, settings, variations, stiffness),
            folder=store,
            label=lambda phase: (f"{phase:.6f}", f"mesh phase {phase:.2f}"),
            jobs=jobs,
            progress=progress,
        )
    records = stack_records(found[phase] for phase in phases)
    return assembled(file, variations.parameters, records, settings)


def position_record(
    variations: Variations, stiffness: PairStiffness, settings: SeriesSettings, phase: float
) -> Record:
    """Return the loaded quantities at one phase and both torques (2,), and rates (2, P)."""
    mesh = MeshPosition.at(variations.pair, phase, PAIRS_BESIDE)
    found = [
        loaded_rates(variations, mesh.load(torque, stiffness, settings.loaded), stiffness)
        for torque in settings.torques
    ]
    record: Record = {}
    for name in _KEPT:
        record[name] = np.array([getattr(one.value, name) for one in found])
        record[f"{name}_rate"] = np.array([getattr(one.rate, name) for one in found])
    return record


def assembled(
    file: HypoidGearFile,
    parameters: tuple[Parameter, ...],
    records: Record,
    settings: SeriesSettings,
) -> SeriesRates:
    """Return the table and rates of N positions' records.

    With theta and F the means of both torques, c = d theta/dT between them and T in the middle

    R_p = T/F,  R_g = T_g/F,  k_t = 1/(c R_p^2),  k_m = T/((theta - touching) R_p^2),
    e = touching times the mean of R_p
    """
    low, high = settings.torques
    torque = 0.5 * (low + high)
    values = {name: records[name].T for name in _KEPT}  # (2, N)
    # (N, 2, P) to (2, P, N)
    rates = {name: np.moveaxis(records[f"{name}_rate"], 0, 2) for name in _KEPT}

    def middle(of: Mapping[str, Array], name: str) -> Array:
        return np.asarray(0.5 * (of[name][0] + of[name][1]))

    theta, touching, force, gear = (
        middle(values, name) for name in ("rotation", "touching", "force", "gear_torque")
    )
    d_theta, d_touching, d_force, d_gear = (
        middle(rates, name) for name in ("rotation", "touching", "force", "gear_torque")
    )
    soft = (values["rotation"][1] - values["rotation"][0]) / (high - low)
    d_soft = (rates["rotation"][1] - rates["rotation"][0]) / (high - low)
    arm, closing = torque / force, theta - touching
    d_arm = -arm * d_force / force
    twice = 2.0 * d_arm / arm
    k_t, k_m = 1.0 / (soft * arm**2), torque / (closing * arm**2)
    samples = {
        "k_t": (k_t, -k_t * (d_soft / soft + twice)),
        "k_m": (k_m, -k_m * ((d_theta - d_touching) / closing + twice)),
        "R_p": (arm, d_arm),
        "R_g": (gear / force, (d_gear - gear / force * d_force) / force),
        "e": (
            arm.mean() * touching,
            arm.mean() * d_touching + d_arm.mean(axis=1, keepdims=True) * touching,
        ),
    }
    orders = orders_kept(settings.positions)
    series = {name: fourier(value, orders)[None] for name, (value, _) in samples.items()}
    for axis in ("n_x", "n_y", "n_z"):
        series[axis] = np.zeros((1, orders + 1, 2))
    series["n_z"][0, 0, 0] = 1.0
    moved = {
        name: np.array([fourier(one, orders) for one in rate]).reshape(-1, orders + 1, 2)
        for name, (_, rate) in samples.items()
    }
    return SeriesRates(_table(file, settings.torque, series), parameters, moved, theta, d_theta)


def _table(file: HypoidGearFile, torque: float, series: Mapping[str, Array]) -> MeshTable:
    windows = {name: np.ones((1, PAIRS)) for name in WINDOW_UNITS}
    windows["share"] = np.full((1, PAIRS), 1.0 / PAIRS)
    origin = Provenance("inferred", "loaded contact between two torques, for derivatives")
    empty = Provenance("completed", "no flank friction: not read")
    return MeshTable(
        name=file.name,
        pinion_teeth=file.pinion.teeth,
        gear_teeth=file.gear.teeth,
        torque=np.array([torque]),
        contact_ratio=1.0,
        series=series,
        windows=windows,
        provenance={
            **dict.fromkeys(SERIES_UNITS, origin),
            **dict.fromkeys(WINDOW_UNITS, empty),
        },
        source=file.source,
    )


def _key(
    file: HypoidGearFile,
    settings: SeriesSettings,
    variations: Variations,
    stiffness: PairStiffness,
) -> str:
    digest = hashlib.sha256(f"series rates {_FORMAT}".encode())
    digest.update(file.model_dump_json().encode())
    digest.update(repr((settings, [one.name for one in variations.parameters])).encode())
    for part in (stiffness.pinion, stiffness.gear):
        digest.update(np.ascontiguousarray(part.image).tobytes())
    return digest.hexdigest()[:16]
