"""Held positions of a hypoid pair."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from scipy.linalg import block_diag

from gearlube_core.arrays import Array
from gearlube_core.flank_optimisation.held_position import (
    HeldPosition,
    HeldStrip,
    LoadedMeasures,
    StripGaps,
)
from gearlube_core.flank_optimisation.problem import unchecked
from gearlube_core.hypoid_contact.ease_off import mean_point_slopes
from gearlube_core.hypoid_contact.loaded_contact import LoadedSettings, LoadedState, MeshPosition
from gearlube_core.hypoid_contact.mesh_cycle import PAIRS_BESIDE
from gearlube_core.hypoid_contact.pair import FlankPair
from gearlube_core.hypoid_contact.sensitivity.frozen_cells import (
    CellGeometry,
    FrozenCells,
    sliding_arm,
)
from gearlube_core.hypoid_contact.strips import Strip
from gearlube_core.hypoid_geometry.flank.correction import FlankCorrection
from gearlube_core.hypoid_geometry.flank.flank import CURVES, Side
from gearlube_core.hypoid_geometry.flank.machine_frames import (
    gear_cut,
    pinion_cut,
    reference_plane_distance,
)
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from gearlube_core.tooth_contact.coupled_strips import PairStiffness
from gearlube_core.tooth_contact.held_contact import Mask, frozen_compliance

ROLES = ("pinion", "gear")
_REACH = 1.5  # closing of the held strips over that of the contact as the flanks stand
_WIDTH = 1.25  # their width likewise


class VariedCorrection(NamedTuple):
    """Corrections a step below and above one parameter, of one member."""

    role: str
    step: float  # between both ends [unit]
    lower: FlankCorrection
    upper: FlankCorrection


class HypoidFlanks(NamedTuple):
    """Corrections of both members, how they vary, and moves of machine settings."""

    corrections: dict[str, FlankCorrection]
    varied: dict[int, VariedCorrection]  # by the number of the parameter
    moves: Array  # (P,) of the settings from where the cells were cut; else zero [unit]

    @classmethod
    def of(
        cls,
        file: HypoidGearFile,
        side: Side,
        ends: Sequence[tuple[str, float, float]],
        moves: Array,
    ) -> HypoidFlanks:
        """Return the flanks of a file with each field at two ends: (name, lower, upper)."""
        varied = {}
        for k, (name, low, high) in enumerate(ends):
            role, _, rest = name.partition(".")
            if not rest.startswith(f"{side}_flank."):
                continue
            lower, upper = (
                unchecked(file, {name: one}).correction(role, side) for one in (low, high)
            )
            varied[k] = VariedCorrection(role, high - low, lower, upper)
        return cls({role: file.correction(role, side) for role in ROLES}, varied, moves)


@dataclass(frozen=True, slots=True)
class _Cells:
    """Cells of a strip and their places s, t on both flanks of `pair`."""

    pair: FlankPair
    places: dict[str, tuple[Array, Array]]
    bare: Array  # gap without corrections [m], (n,)
    bare_rate: Array  # by machine settings [m/unit], (P, n)
    arm: Array
    arm_rate: Array

    def removal(self, role: str, correction: FlankCorrection) -> Array:
        if correction.is_none:
            return np.zeros_like(self.bare)
        region = getattr(self.pair, role).region
        s, t = self.places[role]
        return correction.bends(s, t, region.whole_height, region.face_width).value

    def gaps(self, flanks: HypoidFlanks) -> StripGaps:
        gap = self.bare + flanks.moves @ self.bare_rate
        for role, correction in flanks.corrections.items():
            gap = gap + self.removal(role, correction)
        rate = self.bare_rate.copy()
        for k, one in flanks.varied.items():
            upper, lower = (self.removal(one.role, end) for end in (one.upper, one.lower))
            rate[k] = (upper - lower) / one.step
        return StripGaps(gap, rate, self.arm + flanks.moves @ self.arm_rate, self.arm_rate)


def held_position(
    pair: FlankPair,
    settings_ends: dict[int, tuple[float, FlankPair, FlankPair]],
    count: int,
    phase: float,
    torque: float,
    stiffness: PairStiffness,
    settings: LoadedSettings,
    edge_band: float,
) -> HeldPosition:
    """Return a position whose strips hold the contact of a pair, and some more.

    Parameters
    ----------
    pair : FlankPair
    settings_ends : dict
        Of parameters that are machine settings, by their number: the step between two pairs
        [unit], the lower and the upper one.
    count : int
        P, of all parameters.
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
    position = MeshPosition.at(pair, phase, PAIRS_BESIDE)
    state = position.load(torque, stiffness, settings)
    image = block_diag(stiffness.pinion.image, stiffness.gear.image)
    strips, cells = [], []
    for pair_phase, strip in _wide_strips(position, state, torque, stiffness, settings):
        there = strip.usable & (strip.arm > 0.0)
        if not there.any():
            continue
        frozen, here, rates = _geometry(
            pair, pair_phase, strip, there, settings_ends, count, stiffness
        )
        sound = np.isfinite(here.gap) & np.isfinite(rates).all(axis=(0, 1))
        if not sound.all():  # a changed flank ends before such a cell
            there[there] = sound
            frozen, here, rates = _geometry(
                pair, pair_phase, strip, there, settings_ends, count, stiffness
            )
        if not there.any():
            continue
        places = _places(pair, strip, there)
        removed = pair.gear.removal(pair.gear.sample_parameters(strip.gear_parameters[there]).r)
        removed += pair.pinion.removal(
            pair.pinion.sample_parameters(strip.pinion_parameters[there]).r
        )
        strips.append(
            HeldStrip(
                compliance=frozen_compliance(
                    *(frozen.row, frozen.column, strip.cell, here.weights, image),
                    stiffness.contact_modulus,
                ),
                arm=here.arm,
                area=here.area,
                sliding=here.sliding,
                at_edge=_at_edge(places, edge_band),
                start=_start(state, pair_phase, frozen),
            )
        )
        cells.append(_Cells(pair, places, here.gap - removed, rates[0], here.arm, rates[1]))
    return HeldPosition(torque, strips, lambda flanks: [one.gaps(flanks) for one in cells])


def _geometry(
    pair: FlankPair,
    phase: float,
    strip: Strip,
    there: Mask,
    settings_ends: dict[int, tuple[float, FlankPair, FlankPair]],
    count: int,
    stiffness: PairStiffness,
) -> tuple[FrozenCells, CellGeometry, Array]:
    """Return cells with their geometry, and rates of gap and arm by settings (2, P, n)."""
    frozen = FrozenCells.of_strip(pair, phase, strip, there)
    rates = np.zeros((2, count, frozen.row.size))
    for k, (step, lower, upper) in settings_ends.items():
        ends = [frozen.geometry(one, stiffness) for one in (lower, upper)]
        with np.errstate(invalid="ignore"):  # inf less inf
            rates[0, k] = (ends[1].gap - ends[0].gap) / step
            rates[1, k] = (ends[1].arm - ends[0].arm) / step
    return frozen, frozen.geometry(pair, stiffness), rates


def plain_measures(
    pair: FlankPair,
    phase: float,
    torque: float,
    stiffness: PairStiffness,
    settings: LoadedSettings,
    edge_band: float,
) -> LoadedMeasures:
    """Return the measures of a position as the plain analysis finds it; as `held_position`."""
    state = MeshPosition.at(pair, phase, PAIRS_BESIDE).load(torque, stiffness, settings)
    slide = edge = total = pressure = 0.0
    for one in state.pairs:
        there = one.forces > 0.0
        if not there.any():
            continue
        forces, strip = one.forces[there], one.strip
        slide += float(forces @ sliding_arm(pair, strip.point[there], strip.normal[there]))
        edge += float(forces @ _at_edge(_places(pair, strip, there), edge_band))
        total += float(forces.sum())
        pressure = max(pressure, float(one.pressure.max()))
    return LoadedMeasures(state.rotation, pressure, slide / torque, edge / total, total)


def side_slopes(file: HypoidGearFile, side: Side) -> Array:
    """Return the slopes between the flanks of a side at the mean point (2,) [rad].

    Along the tooth and over its height, see `mean_point_slopes`.

    Raises
    ------
    ParameterError
        A cutter does not reach the tooth.
    """
    gear, pinion = gear_cut(file, CURVES["gear", side]), pinion_cut(file, CURVES["pinion", side])
    return np.array(mean_point_slopes(gear, pinion, file.blank()))


def plane_distance(file: HypoidGearFile) -> float:
    """Return how far the pinion cutter's reference plane misses mid-depth [m]."""
    return reference_plane_distance(pinion_cut(file, CURVES["pinion", "drive"]), file.blank())


def _wide_strips(
    position: MeshPosition,
    state: LoadedState,
    torque: float,
    stiffness: PairStiffness,
    settings: LoadedSettings,
) -> list[tuple[float, Strip]]:
    """Return strips that are longer and wider than those of the loaded state."""
    arm = torque / float(np.linalg.norm(state.force))
    closing = _REACH * arm * (state.rotation - state.unloaded_rotation)
    plain = dict(position.strips(torque / arm, closing, 1.0, stiffness, settings))
    wider = max(
        (one.strip.cell[0] / plain[one.phase].cell[0] for one in state.pairs if one.phase in plain),
        default=1.0,
    )
    return position.strips(torque / arm, closing, _WIDTH * max(wider, 1.0), stiffness, settings)


def _places(pair: FlankPair, strip: Strip, there: Mask) -> dict[str, tuple[Array, Array]]:
    return {
        role: flank.position(flank.sample_parameters(parameters[there]).r)
        for role, flank, parameters in (
            ("pinion", pair.pinion, strip.pinion_parameters),
            ("gear", pair.gear, strip.gear_parameters),
        )
    }


def _at_edge(places: dict[str, tuple[Array, Array]], band: float) -> Array:
    found = np.zeros(places["gear"][0].size, bool)
    for s, t in places.values():
        found |= (s > 1.0 - band) | (t < band) | (t > 1.0 - band)
    return found.astype(float)


def _start(state: LoadedState, phase: float, cells: FrozenCells) -> Mask:
    """Return which cells lie in cells of the loaded state that carry."""
    found = np.zeros(cells.row.size, bool)
    for one in state.pairs:
        if one.phase != phase:
            continue
        frame, cell, (nx, ny) = one.strip.frame, one.strip.cell, one.forces.shape
        away = cells.origin - frame.centre
        i = np.rint(away @ frame.across / cell[0] + 0.5 * (nx - 1)).astype(int)
        j = np.rint(away @ frame.along / cell[1] + 0.5 * (ny - 1)).astype(int)
        inside = (i >= 0) & (i < nx) & (j >= 0) & (j < ny)
        found[inside] = one.forces[i[inside], j[inside]] > 0.0
    return found
