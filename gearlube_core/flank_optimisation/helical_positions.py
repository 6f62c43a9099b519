"""Held positions of a helical pair."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from scipy.linalg import block_diag

from gearlube_core.arrays import Array, Indices
from gearlube_core.flank_optimisation.held_position import (
    HeldPosition,
    HeldStrip,
    LoadedMeasures,
    StripGaps,
)
from gearlube_core.flank_optimisation.problem import unchecked
from gearlube_core.helical_contact.loaded_contact import LoadedSettings, MeshPosition, coupled_strip
from gearlube_core.helical_contact.strips import LineStrip, normal_gap
from gearlube_core.helical_contact.tooth_body import flank_position, tooth_form
from gearlube_core.helical_geometry.gear_file import HelicalGearFile
from gearlube_core.helical_geometry.modification import ModifiedPair
from gearlube_core.tooth_contact.coupled_strips import PairStiffness
from gearlube_core.tooth_contact.held_contact import Mask, frozen_compliance

MEMBERS = ("pinion", "gear")
_REACH = 1.5  # closing of the held strips over that of the contact as the flanks stand
_WIDTH = 1.25  # their width likewise


class VariedFlank(NamedTuple):
    """Modified pairs a step below and above one parameter, of one member."""

    member: str
    step: float  # between both ends [unit]
    lower: ModifiedPair
    upper: ModifiedPair


class HelicalFlanks(NamedTuple):
    """Flanks of a pair as they stand and varied by each of P parameters."""

    modified: ModifiedPair
    varied: tuple[VariedFlank, ...]

    @classmethod
    def of(cls, file: HelicalGearFile, ends: Sequence[tuple[str, float, float]]) -> HelicalFlanks:
        """Return the flanks of a file with each field at two ends: (name, lower, upper)."""
        return cls(
            file.modified_pair(),
            tuple(
                VariedFlank(
                    name.partition(".")[0],
                    high - low,
                    unchecked(file, {name: low}).modified_pair(),
                    unchecked(file, {name: high}).modified_pair(),
                )
                for name, low, high in ends
            ),
        )


@dataclass(frozen=True, slots=True)
class _Cells:
    """Cells of a strip: gap without modifications, and their places on both members."""

    bare: Array  # [m]
    cosine: float  # removal along the normal per transverse removal
    z: Array
    rolls: dict[str, Array]
    arm: Array

    @classmethod
    def of(cls, modified: ModifiedPair, strip: LineStrip, row: Indices, column: Indices) -> _Cells:
        y, z = strip.y[row, column], strip.z[column]
        rolls = {"pinion": strip.pinion_roll[row, column], "gear": strip.gear_roll[row, column]}
        bare = normal_gap(ModifiedPair(pair=modified.pair), strip.X, y, z)
        return cls(bare, modified.pair.plane.cos_b, z, rolls, strip.arm[column])

    def removal(self, modified: ModifiedPair, member: str) -> Array:
        transverse = getattr(modified, f"{member}_removal")(self.rolls[member], self.z)
        return np.asarray(self.cosine * transverse)

    def gaps(self, flanks: HelicalFlanks) -> StripGaps:
        gap = self.bare + sum(self.removal(flanks.modified, member) for member in MEMBERS)
        rates = [
            (self.removal(one.upper, one.member) - self.removal(one.lower, one.member)) / one.step
            for one in flanks.varied
        ]
        rate = np.array(rates) if rates else np.empty((0, gap.size))
        return StripGaps(gap, rate, self.arm, None)


def held_position(
    modified: ModifiedPair,
    phase: float,
    torque: float,
    stiffness: PairStiffness,
    settings: LoadedSettings,
    edge_band: float,
) -> HeldPosition:
    """Return a position whose strips hold the contact of a pair, and some more.

    Parameters
    ----------
    modified : ModifiedPair
    phase : float
        [mesh periods]
    torque : float
        On the pinion [N.m].
    stiffness : PairStiffness
    settings : LoadedSettings
        Cells of the strips.
    edge_band : float
        Border of the flanks in parts of height and face width [-].

    Raises
    ------
    ConvergenceError
        The position finds no equilibrium.
    """
    position = MeshPosition.at(modified, phase)
    state = position.load(torque, stiffness, settings)
    closing = _REACH * (state.rotation - state.unloaded_rotation)
    nx = settings.strips.cells_across
    half = _WIDTH * max(0.5 * nx * line.strip.cell[0] for line in state.lines)
    loaded = {line.strip.line: line for line in state.lines}
    strips, cells = [], []
    image = block_diag(stiffness.pinion.image, stiffness.gear.image)
    for strip in position.strips(closing, half, settings.strips):
        row, column = np.nonzero(strip.usable)
        if not row.size:
            continue
        weights = coupled_strip(modified.pair, strip, stiffness).weights
        y, z = strip.y[row, column], strip.z[column]
        strips.append(
            HeldStrip(
                compliance=frozen_compliance(
                    *(row, column, strip.cell, weights[strip.usable.ravel()].toarray(), image),
                    stiffness.contact_modulus,
                ),
                arm=strip.arm[column],
                area=np.full(row.size, strip.cell[0] * strip.cell[1]),
                sliding=strip.sliding_arm(modified.pair)[column],
                at_edge=at_edge(modified, strip, edge_band)[row, column],
                start=_start(loaded[strip.line].strip, loaded[strip.line].forces, y, z)
                if strip.line in loaded
                else np.zeros(row.size, bool),
            )
        )
        cells.append(_Cells.of(modified, strip, row, column))
    return HeldPosition(torque, strips, lambda flanks: [one.gaps(flanks) for one in cells])


def plain_measures(
    modified: ModifiedPair,
    phase: float,
    torque: float,
    stiffness: PairStiffness,
    settings: LoadedSettings,
    edge_band: float,
) -> LoadedMeasures:
    """Return the measures of a position as the plain analysis finds it; as `held_position`."""
    state = MeshPosition.at(modified, phase).load(torque, stiffness, settings)
    slide = sum(
        float(np.sum(line.forces * line.strip.sliding_arm(modified.pair))) for line in state.lines
    )
    total = sum(float(line.forces.sum()) for line in state.lines)
    edge = sum(
        float(np.sum(line.forces * at_edge(modified, line.strip, edge_band)))
        for line in state.lines
    )
    pressure = max(float(line.pressure.max()) for line in state.lines)
    return LoadedMeasures(state.rotation, pressure, slide / torque, edge / total, total)


def at_edge(modified: ModifiedPair, strip: LineStrip, band: float) -> Array:
    """Return 1 for cells in the border of either flank, else 0, (nx, ny)."""
    pair = modified.pair
    t = 0.5 + strip.z / pair.face_width
    found = np.broadcast_to((t < band) | (t > 1.0 - band), strip.gap.shape).copy()
    for member, roll in (("pinion", strip.pinion_roll), ("gear", strip.gear_roll)):
        found |= flank_position(tooth_form(pair, member), np.nan_to_num(roll)) > 1.0 - band
    return found.astype(float)


def _start(strip: LineStrip, forces: Array, y: Array, z: Array) -> Mask:
    """Return which places (n,) lie in cells of another strip that carry."""
    i = np.rint((y - np.interp(z, strip.z, strip.y[0])) / strip.cell[0]).astype(int)
    j = np.rint((z - strip.z[0]) / (strip.z[1] - strip.z[0])).astype(int)
    inside = (i >= 0) & (i < forces.shape[0]) & (j >= 0) & (j < forces.shape[1])
    found = np.zeros(y.size, bool)
    found[inside] = forces[i[inside], j[inside]] > 0.0
    return found
