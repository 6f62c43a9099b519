"""Pinion settings by least squares: both flanks at once against their wanted gaps."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from scipy.optimize import least_squares

from gearlube_core.arrays import Array
from gearlube_core.errors import ParameterError
from gearlube_core.hypoid_contact.pair import FlankPair
from gearlube_core.hypoid_design.blank_file import BlankMachine
from gearlube_core.hypoid_design.conjugate_flank import ConjugateFlank, PinionGap, conjugate_flank
from gearlube_core.hypoid_design.flank_target import (
    FlankTarget,
    MeanContact,
    path_places,
    target_gap,
)
from gearlube_core.hypoid_geometry.flank.flank import CURVES, Side
from gearlube_core.hypoid_geometry.flank.machine_frames import (
    ReferenceCut,
    other_flank,
    pinion_cut,
    reference_plane_distance,
)
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile

SIDES: tuple[Side, Side] = ("drive", "coast")
MICRON = 1e-6
_PLANE = 0.02e-3  # m, a reference plane so far off counts as a micrometre of gap
_BACKLASH = 0.1  # of a micrometre of gap
_RIDGE = 0.01  # um per unit of a move
_MEAN, _PATH = 10.0, 10.0  # weights of the neighbourhood of the design point and of the path
_WEIGHTS: dict[Side, float] = {"drive": 1.0, "coast": 0.3}  # of the whole flank
_STEP = 0.01  # of a unit, for differences
_LOST = 1e3  # um, where the pinion has no flank
_MEAN_REACH = (0.12, 0.10)  # of s and t
_FLATTEST = 1e6  # mm, of an edge that counts as straight
_EVALUATIONS = 30


class Setting(NamedTuple):
    """A setting that the fit may move, and the size of one unit of its move in the file."""

    field: str
    unit: float


TILT, SWIVEL = "pinion.machine.tilt_angle_deg", "pinion.machine.basic_swivel_angle_deg"
# tilt and swivel move as a vector, the tilt along and across its first direction: tilt may be zero
MACHINE = (
    Setting("pinion.machine.sliding_base_mm", 0.1),
    Setting("pinion.machine.blank_offset_mm", 0.1),
    Setting("pinion.machine.machine_root_angle_deg", 0.1),
    Setting("pinion.machine.machine_center_to_back_mm", 0.1),
    Setting("pinion.machine.radial_setting_mm", 0.1),
    Setting(TILT, 0.1),
    Setting(SWIVEL, 0.1),
    Setting("pinion.machine.ratio_of_roll", 0.005),
    Setting("pinion.cutter.point_radius_mm", 0.1),
    Setting("pinion.cutter.concave_flank_blade_angle_deg", 0.1),
    Setting("pinion.cutter.convex_flank_blade_angle_deg", 0.1),
)
# curvature of the blades' edges, 1/mm: the file has their radius
EDGES: tuple[Setting, ...] = tuple(
    Setting(f"pinion.cutter.{CURVES['pinion', side]}_flank_edge_radius_mm", 2e-4) for side in SIDES
)
_FIRST_EDGE = 2.0  # units: a radius of 2.5 m
MODIFIED_ROLL = (
    Setting("pinion.machine.modified_roll_2c", 0.005),
    Setting("pinion.machine.modified_roll_6d", 0.02),
)
HELICAL_MOTION = (Setting("pinion.machine.helical_motion_mm_per_rad", 0.2),)


@dataclass(frozen=True)
class SideProblem:
    """One side of the fit: places, wanted gaps and weights.

    Parameters
    ----------
    pair : FlankPair
        Of the start; its pinion is exchanged.
    gap : PinionGap
        At the places; the first is the design point.
    wanted : ndarray of shape (n,)
        [m], zero at the design point.
    weight : ndarray of shape (n,)
        [-].
    """

    pair: FlankPair
    gap: PinionGap
    wanted: Array
    weight: Array

    def misfit(self, cut: ReferenceCut) -> tuple[Array, float]:
        """Return gap less wanted gap [um], and what the pinion closes before it touches [m]."""
        start = np.array([0.0, cut.cutter_angle, cut.cradle_angle])
        flank = self.gap.conjugate
        pinion = replace(self.pair.pinion, motion=cut.motion, start=start)
        gap = self.gap.of(replace(self.pair, pinion=pinion))
        closed = gap - gap[0] / flank.arm[0] * flank.arm
        return np.nan_to_num((closed - self.wanted) / MICRON, nan=_LOST), float(gap[0])


@dataclass(frozen=True, slots=True)
class Fit:
    """Result of a fit.

    Parameters
    ----------
    file : HypoidGearFile
    moves : ndarray of shape (n,)
        Of the settings, in their units.
    rms : dict of str to float
        Of the gap from the wanted one over the flank, each side [m].
    backlash : float
        At the design point, along the normal [m].
    evaluations : int
    """

    file: HypoidGearFile
    moves: Array
    rms: dict[Side, float]
    backlash: float
    evaluations: int


def places_and_weights(
    pair: FlankPair, target: FlankTarget, mean: MeanContact
) -> tuple[Array, Array, Array]:
    """Return s, t and weights [-]: design point, its neighbourhood, wanted path, whole flank."""
    whole = _WEIGHTS[pair.side]
    a, b = _MEAN_REACH
    near = [(i * a, j * b) for i in (-1, 0, 1) for j in (-1, 0, 1) if (i, j) != (0, 0)]
    places = np.array([(0.0, 0.0), *near]) + np.array([target.s, target.t])
    angles = np.array([-1.0, -0.5, 0.5, 1.0]) * 0.5 * pair.gear_pitch
    along = np.stack(path_places(pair, target, mean, angles), axis=1)
    s, t = np.meshgrid(np.linspace(0.2, 0.95, 7), np.linspace(0.05, 0.95, 9), indexing="ij")
    grid = np.stack([s.ravel(), t.ravel()], axis=1)
    groups = ((places, _MEAN), (along, _PATH), (grid, whole))
    weights = [np.full(len(one), weight / np.sqrt(len(one))) for one, weight in groups]
    s, t = np.concatenate([one for one, _ in groups]).T
    return s, t, np.concatenate(weights)


def side_problem(file: HypoidGearFile, target: FlankTarget, side: Side) -> SideProblem:
    """Return the problem of one side, for the gear of a file."""
    pair = FlankPair.from_file(file, side)
    mean = MeanContact.at(pair, target.s, target.t)
    s, t, weight = places_and_weights(pair, target, mean)
    flank = conjugate_flank(pair, s, t)
    wanted = target_gap(target, mean, flank, file.gear.teeth)
    sound = np.isfinite(wanted)
    flank = ConjugateFlank(*(getattr(flank, name)[sound] for name in ConjugateFlank.__slots__))
    gap = PinionGap.from_pair(pair, flank)
    return SideProblem(pair, gap, wanted[sound], weight[sound])


def fit_pinion(
    start: HypoidGearFile,
    targets: dict[Side, FlankTarget],
    *,
    freedoms: BlankMachine,
    first: Array | None = None,
) -> Fit:
    """Return the pinion settings that bring the gaps of both sides nearest to the wanted ones.

    Least squares in a trust region, derivatives by differences. The settings move as little as
    they can (ridge): singular values span four powers of ten.

    Parameters
    ----------
    start : HypoidGearFile
        Its gear stays; its pinion is nearly conjugate.
    targets : dict of str to FlankTarget
        Of both sides.
    freedoms : BlankMachine
        Which settings may move besides those that every machine has.
    first : ndarray, optional
        Moves to begin with.

    Raises
    ------
    ParameterError
        When a target asks for what the mesh does not have.
    """
    problems = {side: side_problem(start, targets[side], side) for side in SIDES}
    machine = (
        *MACHINE,
        *(MODIFIED_ROLL if freedoms.modified_roll else ()),
        *(HELICAL_MOTION if freedoms.helical_motion else ()),
    )
    values = np.array([start_value(start, one.field) for one in machine])
    fields = [one.field for one in machine]
    swivel = values[fields.index(SWIVEL)]
    values[fields.index(SWIVEL)] = 0.0
    units = np.array([one.unit for one in machine])
    count = [0]

    def file_at(x: Array) -> HypoidGearFile:
        moved = values + units * x[: units.size]
        changes = {one.field: float(v) for one, v in zip(machine, moved, strict=True)}
        changes |= _tilted(changes[TILT], changes[SWIVEL], swivel)
        for one, bend in zip(EDGES, x[units.size :], strict=False):
            changes[one.field] = 1.0 / max(one.unit * float(bend), 1.0 / _FLATTEST)
        return start.varied(changes)

    def misfits(file: HypoidGearFile) -> tuple[dict[Side, tuple[Array, float]], float]:
        cut = pinion_cut(file, CURVES["pinion", "drive"])
        found = {
            side: problem.misfit(other_flank(cut, file.pinion, CURVES["pinion", side]))
            for side, problem in problems.items()
        }
        return found, reference_plane_distance(cut, file.blank())

    def residual(x: Array) -> Array:
        count[0] += 1
        try:
            found, plane = misfits(file_at(x))
        except ParameterError:
            lost = sum(one.wanted.size for one in problems.values()) + 2 + x.size
            return np.full(lost, _LOST)
        rows = [problems[side].weight * found[side][0] for side in SIDES]
        backlash = sum(closing for _, closing in found.values())
        others = np.array([plane / _PLANE, _BACKLASH * backlash / MICRON])
        return np.concatenate([*rows, others, _RIDGE * x])

    def jacobian(x: Array) -> Array:
        at = residual(x)
        steps = _STEP * np.eye(x.size)
        return np.stack([(residual(x + step) - at) / _STEP for step in steps], axis=1)

    size = units.size + (len(EDGES) if freedoms.curved_blades else 0)
    low = np.full(size, -np.inf)
    low[units.size :] = 0.0
    begin = np.where(np.isinf(low), 0.0, _FIRST_EDGE) if first is None else first
    solved = least_squares(
        residual,
        np.maximum(begin, low + 1e-3),
        jac=jacobian,
        bounds=(low, np.inf),
        xtol=1e-5,
        ftol=1e-5,
        max_nfev=_EVALUATIONS,
    )
    file = file_at(solved.x)
    found, _ = misfits(file)
    rms = {side: MICRON * float(np.sqrt(np.mean(found[side][0] ** 2))) for side in SIDES}
    backlash = sum(closing for _, closing in found.values())
    return Fit(file, solved.x, rms, backlash, count[0])


def _tilted(along: float, across: float, swivel: float) -> dict[str, float]:
    """Return tilt and swivel angle [deg] of a tilt with two components [deg] from a swivel angle.

    The cutter axis leans to the azimuth q - j - 90 deg, so the swivel angle j counts backwards.
    """
    turn = math.degrees(math.atan2(across, along))
    return {TILT: math.hypot(along, across), SWIVEL: swivel + turn}


def start_value(file: HypoidGearFile, field: str) -> float:
    """Return the number in a dotted field of a gear file."""
    value: object = file
    for part in field.split("."):
        value = getattr(value, part)
    return float(value)  # type: ignore[arg-type]
