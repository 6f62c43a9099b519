"""Loaded contact: the pair of He et al. 2007 with plain and crowned flanks, and a spur pair."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import xarray as xr

from docs.helical.cases import HE, LINE_LOAD, SPUR, line_lengths
from gearlube_core.helical_contact.contact_dataset import contact_dataset, line_mesh
from gearlube_core.helical_contact.loaded_contact import LoadedSettings, MeshPosition
from gearlube_core.helical_contact.mesh_cycle import CycleSettings, run_cycle
from gearlube_core.helical_contact.strips import StripSettings
from gearlube_core.helical_contact.tooth_body import HelicalBodySettings, pair_stiffness
from gearlube_core.helical_geometry.iso_6336_stiffness import IsoStiffness, iso_stiffness
from gearlube_core.helical_geometry.modification import (
    Crown,
    FlankModification,
    ModifiedPair,
    TipRelief,
)
from gearlube_core.mesh_table.line_mesh import LineMesh
from gearlube_core.tooth_compliance.flank_compliance import CondensationSettings
from gearlube_core.tooth_compliance.tooth_mesh import MeshDensity
from tests.helpers.he_2007 import PINION_TORQUE

C_M = 0.8  # of ISO 6336-1: measured over calculated stiffness
PLAIN = ModifiedPair(pair=HE)
CROWN = 4e-6  # m, on both members
CROWNED_TORQUES = (25.0, 50.0, 100.0, PINION_TORQUE, 450.0)  # N.m
SPUR_TORQUES = (25.0, 50.0, 100.0, 160.0, PINION_TORQUE, 300.0)
RELIEF, RELIEF_EXTENT = 15e-6, 1.5e-3  # m
COARSE = CondensationSettings(
    profile_hats=4,
    lengthwise_hats=7,
    density=MeshDensity(profile=6, lengthwise=12, thickness=3, growth=1.8, fillet=3, slot=1, rim=2),
)
_LOWER, _UPPER = 0.08, 0.05  # scatter of the fit of ISO 6336-1
_PHASES = (0.05, 0.45, 0.85)


def iso() -> IsoStiffness:
    """Return the ISO 6336-1 stiffness with the pair's own roots and its steel."""
    solid = HelicalBodySettings().solid
    return iso_stiffness(HE, line_load=LINE_LOAD, modulus=(solid.youngs_modulus,) * 2)


def crowned(store: Path) -> tuple[xr.Dataset, LineMesh]:
    """Return loaded contact and line mesh of the pair with crowns on both members."""
    flank = FlankModification(crown=Crown(amount=CROWN, start=0.0))
    modified = ModifiedPair(pair=HE, pinion=flank, gear=flank)
    settings = CycleSettings(torques=CROWNED_TORQUES, positions=12)
    record = run_cycle(modified, pair_stiffness(HE, HelicalBodySettings()), settings, store=store)
    return contact_dataset(modified, settings, record), line_mesh(modified, settings, record)


def spur_harris(store: Path) -> dict[str, xr.Dataset]:
    """Return loaded contact of the spur pair with plain and with relieved tips, coarse teeth."""
    teeth = pair_stiffness(SPUR, HelicalBodySettings(condensation=COARSE))
    cells = LoadedSettings(strips=StripSettings(cells_along=16))
    settings = CycleSettings(torques=SPUR_TORQUES, positions=16, stations=2, loaded=cells)
    relief = FlankModification(tip_relief=TipRelief(amount=RELIEF, extent=RELIEF_EXTENT, k=0.0))
    pairs = {
        "plain": ModifiedPair(pair=SPUR),
        "relieved": ModifiedPair(pair=SPUR, pinion=relief, gear=relief),
    }
    return {
        name: contact_dataset(modified, settings, run_cycle(modified, teeth, settings, store=store))
        for name, modified in pairs.items()
    }


Stiffness = tuple[float, float, float]  # secant, tangent [N/m], largest share [-]


def bodies() -> list[Stiffness]:
    """Return stiffness with the elastic body as by default, and ending elsewhere."""
    return [
        _stiffness(body, LoadedSettings())
        for body in (
            HelicalBodySettings(),
            HelicalBodySettings(base_depth_modules=2.0),
            HelicalBodySettings(base_depth_modules=4.0),
            HelicalBodySettings(neighbour_pitches=1.5),
        )
    ]


def _stiffness(body: HelicalBodySettings, settings: LoadedSettings) -> Stiffness:
    """Return means of three phases, along the line of action."""
    teeth = pair_stiffness(HE, body)
    rows = []
    for phase in _PHASES:
        state = MeshPosition.at(PLAIN, phase).load(PINION_TORQUE, teeth, settings)
        largest = max(line.torque for line in state.lines) / PINION_TORQUE
        rows.append((PINION_TORQUE / state.rotation, state.tangent, largest))
    secant, tangent, share = np.mean(rows, axis=0)
    arm = HE.pinion_base_radius
    return float(secant / arm**2), float(tangent / arm**2), float(share)


def torque_rows(contact: xr.Dataset) -> list[list[str]]:
    """Return what load does to the plain pair, and ISO 6336-1 beside it."""
    standard = iso().mesh * HE.face_width
    rows = []
    for torque in contact["torque"].values:
        at = contact.sel(torque=torque)
        mean = float(at["K"].mean())
        off = at["share"] - at["length_share"]
        rows.append(
            [
                f"{torque:.0f}",
                f"{1e-6 * mean:.0f}",
                f"{1e-6 * float(at['K_tangent'].mean()):.0f}",
                f"{mean / standard:.3f}",
                f"{C_M * mean / standard:.3f}",
                f"{1e6 * float(at['transmission_error_ptp']):.2f}",
                f"{100.0 * float(np.abs(off.values).max()):.1f}",
            ]
        )
    return rows


def iso_words(
    contact: xr.Dataset, torque: float, found: Sequence[Stiffness]
) -> tuple[str, str, str, str]:
    """Return how far the mean stiffness at a torque is from the standard's."""
    spread = max(abs(secant / found[0][0] - 1.0) for secant, _, _ in found)
    mean = float(contact["K"].sel(torque=torque, method="nearest").mean())
    ratio = C_M * mean / (iso().mesh * HE.face_width)
    within = 1.0 - _LOWER - spread <= ratio <= 1.0 + _UPPER + spread
    where = "within" if within else "outside"
    return f"{ratio / C_M:.3f}", f"{ratio:.3f}", where, f"{100.0 * spread:.1f}"


def error_rows(datasets: Sequence[xr.Dataset]) -> list[list[str]]:
    """Return the range of the transmission error [um] against torque, unloaded first."""
    torques = sorted({float(t) for data in datasets for t in data["torque"].values})
    rows = []
    for data in datasets:
        cells = [f"{1e6 * float(np.ptp(data['unloaded_error'].values)):.2f}"]
        for torque in torques:
            at = int(np.argmin(np.abs(data["torque"].values - torque)))
            there = abs(data["torque"].values[at] - torque) < 1e-6 * torque
            value = 1e6 * float(data["transmission_error_ptp"].values[at])
            cells.append(f"{value:.2f}" if there else "-")
        rows.append(cells)
    return rows


def table_density(mesh: LineMesh, torque: float) -> float:
    """Return the mean tangent density of a line mesh at one of its torques [N/m2]."""
    level = int(np.argmin(np.abs(mesh.torque - torque)))
    lengths = line_lengths(mesh.phase, mesh.lines)
    part = lengths[..., None] / mesh.station.size
    return float((mesh.density[level] * part).sum() / lengths.sum())
