"""A mesh table at one torque and its derivatives by settings, reliefs and misalignments."""

from __future__ import annotations

import hashlib
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path

import numpy as np

from gearlube_core.checks import check_within
from gearlube_core.hypoid_contact.loaded_contact import LoadedSettings, MeshPosition
from gearlube_core.hypoid_contact.mesh_cycle import PAIRS_BESIDE
from gearlube_core.hypoid_contact.pair import FlankPair
from gearlube_core.hypoid_contact.placement import ALIGNED, Misalignment
from gearlube_core.hypoid_contact.refusal import check_pair
from gearlube_core.hypoid_contact.sensitivity.loaded_rates import loaded_rates
from gearlube_core.hypoid_contact.sensitivity.parameter import (
    Parameter,
    Variations,
    usual_parameters,
)
from gearlube_core.hypoid_contact.tooth_body import pair_stiffness
from gearlube_core.hypoid_geometry.flank.flank import Side
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from gearlube_core.progress import Progress, no_progress
from gearlube_core.storage.process_pool import single_threaded
from gearlube_core.storage.resumable import Record
from gearlube_core.tooth_compliance.tooth_body import ToothBodySettings
from gearlube_core.tooth_contact.coupled_strips import PairStiffness
from gearlube_core.tooth_contact.mesh_cycle import compute_positions, stack_records
from gearlube_core.tooth_contact.series_rates import (
    KEPT,
    SeriesRates,
    series_of_records,
    torques_about,
)

SIDE: Side = "drive"
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
        Number of mesh phases in a period, 4 to 400; `orders_kept` is how many orders the series
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
        return torques_about(self.torque)


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
    for name in KEPT:
        record[name] = np.array([getattr(one.value, name) for one in found])
        record[f"{name}_rate"] = np.array([getattr(one.rate, name) for one in found])
    return record


def assembled(
    file: HypoidGearFile,
    parameters: tuple[Parameter, ...],
    records: Record,
    settings: SeriesSettings,
) -> SeriesRates:
    """Return the table and rates of N positions' records, see `series_of_records`."""
    teeth = file.pinion.teeth, file.gear.teeth
    return series_of_records(file, teeth, parameters, records, settings.torque)


def _key(
    file: HypoidGearFile, settings: SeriesSettings, variations: Variations, stiffness: PairStiffness
) -> str:
    digest = hashlib.sha256(f"series rates {_FORMAT}".encode())
    digest.update(file.model_dump_json().encode())
    digest.update(repr((settings, [one.name for one in variations.parameters])).encode())
    for part in (stiffness.pinion, stiffness.gear):
        digest.update(np.ascontiguousarray(part.image).tobytes())
    return digest.hexdigest()[:16]
