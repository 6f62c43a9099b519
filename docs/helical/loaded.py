"""Loaded contact: the pair of He et al. 2007 with plain and crowned flanks, and a spur pair."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import xarray as xr

from docs.helical.cases import HE, LINE_LOAD, SPUR
from gearlube_core.dynamics.helical_pair.he_2007 import PINION_TORQUE
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
from gearlube_core.helical_geometry.pair import HelicalPair
from gearlube_core.mesh_table.line_mesh import LineMesh
from gearlube_core.tooth_compliance.flank_compliance import CondensationSettings
from gearlube_core.tooth_compliance.tooth_mesh import MeshDensity

C_M = 0.8  # of ISO 6336-1: measured over calculated stiffness
PLAIN = ModifiedPair(pair=HE)
CROWN = 4e-6  # m, on both members
CROWNED_TORQUES = (25.0, 50.0, 100.0, PINION_TORQUE, 450.0)  # N.m
SPUR_TORQUES = (25.0, 50.0, 100.0, 160.0, PINION_TORQUE, 300.0)
NEAR_TORQUES = (160.0, PINION_TORQUE, 300.0)
RELIEF, RELIEF_EXTENT = 15e-6, 1.5e-3  # m
COARSE = CondensationSettings(
    profile_hats=4,
    lengthwise_hats=7,
    density=MeshDensity(profile=6, lengthwise=12, thickness=3, growth=1.8, fillet=3, slot=1, rim=2),
)
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


def table_of_torques(
    pair: HelicalPair, condensation: CondensationSettings, store: Path
) -> LineMesh:
    """Return the line mesh of a pair with plain flanks, at torques around that of the paper."""
    modified = ModifiedPair(pair=pair)
    settings = CycleSettings(torques=NEAR_TORQUES, positions=16)
    teeth = pair_stiffness(pair, HelicalBodySettings(condensation=condensation))
    return line_mesh(modified, settings, run_cycle(modified, teeth, settings, store=store))


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


@dataclass(frozen=True, slots=True)
class Finer:
    """Stiffness [N/m] along the line of action and largest share, means of three phases."""

    words: str
    secant: float
    tangent: float
    share: float


def bodies() -> list[Finer]:
    """Return stiffness with the elastic body ending elsewhere."""
    return [
        _stiffness(words, body, LoadedSettings())
        for words, body in (
            ("default: base 3 modules deep, 1 pitch of rim", HelicalBodySettings()),
            ("base 2 modules deep", HelicalBodySettings(base_depth_modules=2.0)),
            ("base 4 modules deep", HelicalBodySettings(base_depth_modules=4.0)),
            ("1.5 pitches of rim beside the tooth", HelicalBodySettings(neighbour_pitches=1.5)),
        )
    ]


def refinements() -> list[Finer]:
    """Return stiffness with finer cells, elements and hats."""
    default = HelicalBodySettings()
    cells = LoadedSettings(strips=StripSettings(cells_across=61, cells_along=96))
    c = default.condensation
    finer = {
        "9 hats from root to tip, 16 elements": replace(
            c, profile_hats=9, density=MeshDensity(profile=16)
        ),
        "coarse: 4 x 7 hats": COARSE,
    }
    rows = [
        _stiffness("default: 31 x 48 cells, 7 x 13 hats", default, LoadedSettings()),
        _stiffness("61 x 96 cells", default, cells),
    ]
    rows += [
        _stiffness(words, replace(default, condensation=settings), LoadedSettings())
        for words, settings in finer.items()
    ]
    return rows


def _stiffness(words: str, body: HelicalBodySettings, settings: LoadedSettings) -> Finer:
    teeth = pair_stiffness(HE, body)
    rows = []
    for phase in _PHASES:
        state = MeshPosition.at(PLAIN, phase).load(PINION_TORQUE, teeth, settings)
        largest = max(line.torque for line in state.lines) / PINION_TORQUE
        rows.append((PINION_TORQUE / state.rotation, state.tangent, largest))
    secant, tangent, share = np.mean(rows, axis=0)
    arm = HE.pinion_base_radius
    return Finer(words, float(secant / arm**2), float(tangent / arm**2), float(share))


@dataclass(frozen=True, slots=True)
class Sharing:
    """One tooth pair on a stretch of its way: its share of torque and of length [-]."""

    words: str
    share: float
    length_share: float
    extreme: float  # of the difference
    at: float  # mesh periods since the line enters


def sharing(contact: xr.Dataset) -> list[Sharing]:
    """Return where shares of torque and of length differ; means over the stretches."""
    age = contact["line"].values[None, :] + contact["phase"].values[:, None]
    share, length = contact["share"].values, contact["length_share"].values
    carries = (share > 0.0) | (length > 0.0)
    plane = HE.plane
    full = plane.W * plane.sin_b / plane.cos_b / plane.pitch  # line across the whole face
    leaving = (plane.D - plane.A) / plane.pitch
    end = leaving + full
    stretches = (
        ("before it enters: tip corner", -1.0, -1e-9),
        ("entering", -1e-9, full),
        ("across the whole face", full, leaving),
        ("leaving", leaving, end),
        ("after it left: tip corner", end, age.max() + 1.0),
    )
    found = []
    for words, low, high in stretches:
        rows = carries & (age >= low) & (age < high)
        if not rows.any():
            continue
        off = (share - length)[rows]
        worst = int(np.abs(off).argmax())
        found.append(
            Sharing(
                words,
                float(share[rows].mean()),
                float(length[rows].mean()),
                float(off[worst]),
                float(age[rows][worst]),
            )
        )
    return found
