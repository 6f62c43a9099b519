"""Relief of designed flanks: as given, or as much as keeps the load off the edges."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gearlube_core.arrays import Array
from gearlube_core.errors import GearLubeError
from gearlube_core.hypoid_contact.loaded_contact import (
    LoadedPair,
    LoadedSettings,
    LoadedState,
    MeshPosition,
)
from gearlube_core.hypoid_contact.pair import FlankPair
from gearlube_core.hypoid_contact.strips import StripSettings
from gearlube_core.hypoid_contact.tooth_body import pair_stiffness
from gearlube_core.hypoid_design.designed_blank import DesignedBlank
from gearlube_core.hypoid_design.pinion_fit import SIDES
from gearlube_core.hypoid_geometry.flank.flank import Role, Side
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from gearlube_core.progress import Progress, no_progress
from gearlube_core.tooth_compliance.tooth_body import ToothBodySettings
from gearlube_core.tooth_contact.coupled_strips import PairStiffness
from gearlube_core.units import MILLIMETRE

Mask = NDArray[np.bool_]
_NEIGHBOURS = [(i, j) for i in range(3) for j in range(3)]
ROLES: tuple[Role, Role] = ("pinion", "gear")
LEAST = {"pinion tip": 20.0, "gear tip": 20.0, "ends": 30.0}  # um, of a relief that is chosen
MOST = 200.0  # um
_STEEPEST = 0.09  # amount over extent; gear files take up to 0.1
_TEETH = 0.7  # of the time
_RISE = 1.25  # of an amount whose edge still carries
POSITIONS = 12  # of the mesh
# coarse cells do: relief is deepest at the edge, so finer cells there stand farther off
_CELLS = LoadedSettings(strips=StripSettings(cells_across=24, cells_along=36))

Amounts = dict[str, float]


def loaded_edges(pair: FlankPair, state: LoadedState) -> dict[str, float]:
    """Return the highest pressure [Pa] at each edge that the loaded contact reaches.

    An edge is reached where a loaded cell lies beside one that a tooth does not cover. There the
    pressure follows the cells, as that of a sharp edge does.

    Parameters
    ----------
    pair : FlankPair
        Whose contact it is.
    state : LoadedState

    Returns
    -------
    dict of str to float
        Out of "pinion tip", "pinion toe", "pinion heel", and the same of the gear: the edge that
        is nearest to such a cell. Empty where the contact ends before all edges.

    Examples
    --------
    >>> state = MeshPosition.at(pair, 0.5).load(300.0, teeth, LoadedSettings())  # doctest: +SKIP
    >>> loaded_edges(pair, state)  # doctest: +SKIP
    {'gear tip': 2.1e9}
    """
    found: dict[str, float] = {}
    for one in state.pairs:
        reached = (one.forces > 0.0) & beside_edge(one.strip.usable)
        if not reached.any():
            continue
        distances = _distances(pair, one, reached)
        names = list(distances)
        nearest = np.argmin(np.array(list(distances.values())), axis=0)
        for number, pressure in zip(nearest, one.pressure[reached], strict=True):
            name = names[number]
            found[name] = max(found.get(name, 0.0), float(pressure))
    return found


def beside_edge(usable: Mask) -> Mask:
    """Return which cells have a neighbour that is not usable, as booleans of shape (nx, ny).

    The ends of the strip itself are no edges.
    """
    rows, columns = usable.shape
    padded = np.pad(usable, 1, constant_values=True)
    inside = np.all([padded[i : i + rows, j : j + columns] for i, j in _NEIGHBOURS], axis=0)
    return np.asarray(usable & ~inside)


def _distances(pair: FlankPair, one: LoadedPair, cells: Mask) -> dict[str, Array]:
    """Return the distances [m] of cells from the edges of both teeth."""
    found = {}
    for role, flank, parameters in (
        ("pinion", pair.pinion, one.strip.pinion_parameters),
        ("gear", pair.gear, one.strip.gear_parameters),
    ):
        s, t = flank.position(flank.sample_parameters(parameters[cells]).r)
        height, width = flank.region.whole_height, flank.region.face_width
        found[f"{role} tip"] = (1.0 - s) * height
        found[f"{role} toe"] = t * width
        found[f"{role} heel"] = (1.0 - t) * width
    return found


@dataclass(frozen=True, slots=True, kw_only=True)
class ChosenRelief:
    """Relief of both sides of a pair.

    Parameters
    ----------
    torque : float
        Of the pinion, for which it was chosen [N.m].
    amounts : dict
        Of each side: relief of "pinion tip", "gear tip" and "ends" of the pinion [um].
    edges : dict
        Of each side: highest pressure [Pa] at the edges that carry all the same at that torque.
    pressure : dict
        Of each side: highest pressure at that torque [Pa]; NaN where it was not computed.
    unchecked : str
        Why the loaded contact was not computed; empty where it was.
    """

    torque: float
    amounts: dict[Side, Amounts]
    edges: dict[Side, dict[str, float]]
    pressure: dict[Side, float]
    unchecked: str = ""

    def warnings(self) -> list[str]:
        """Return warnings about the relief, as sentences."""
        if self.unchecked:
            return [
                f"The relief was not chosen for a torque, as the loaded contact could not be "
                f"computed: {self.unchecked}"
            ]
        found = []
        for side, edges in self.edges.items():
            if edges:
                listed = ", ".join(f"{edge} {1e-9 * one:.1f} GPa" for edge, one in edges.items())
                found.append(
                    f"At {self.torque:.0f} N.m edges of the {side} flanks carry: {listed}. "
                    "Take more or wider ones (relief.tip_relief_share, relief.end_relief_share), a "
                    "shorter contact.ellipse_length_mm, or a smaller relief.torque_n_m."
                )
        return found


def relief_torque(designed: DesignedBlank) -> float:
    """Return the pinion torque [N.m] for which relief is chosen: as given, else by the size.

    Without a given torque the gear's is 0.2 N/mm2 times the cube of its outer diameter.
    """
    given = designed.file.relief.torque_n_m
    if given is not None:
        return given
    gear = designed.blank.gear
    diameter = 2.0 * gear.outer_cone_distance * math.sin(gear.pitch_angle)
    torque = 0.2e6 * diameter**3 * designed.blank.pinion.teeth / gear.teeth
    return float(f"{torque:.2g}")


def chosen_relief(
    designed: DesignedBlank,
    file: HypoidGearFile,
    progress: Progress = no_progress,
    jobs: int | None = 1,
) -> ChosenRelief:
    """Return the relief of a designed pair.

    Amounts that the blank file gives stay. Those that it leaves open begin with 20 um at the tips
    and 30 um at the ends, and rise by a quarter while the loaded contact reaches their edge at
    one of twelve positions of the mesh. Where the file gives all amounts and no torque, nothing is
    computed.

    Parameters
    ----------
    designed : DesignedBlank
    file : HypoidGearFile
        Machine settings and cutters; its reliefs do not matter.
    progress : callable, optional
        Called with the share that is done [-] and a sentence on what runs.
    jobs : int, optional
        Processes for the elastic teeth, two at most; None: all processors.
    """
    asked, torque = designed.file.relief, relief_torque(designed)
    given = {
        "pinion tip": asked.tip_relief_um,
        "gear tip": asked.tip_relief_um,
        "ends": asked.end_relief_um,
    }
    most = _most_amounts(designed)
    amounts = {
        name: min(LEAST[name], most[name]) if one is None else one for name, one in given.items()
    }
    free = {name: most[name] for name, one in given.items() if one is None}
    sides: dict[Side, Amounts] = {side: dict(amounts) for side in SIDES}
    edges: dict[Side, dict[str, float]] = {side: {} for side in SIDES}
    pressure = dict.fromkeys(SIDES, math.nan)
    unchecked = ""
    if not free and asked.torque_n_m is None:
        return ChosenRelief(torque=torque, amounts=sides, edges=edges, pressure=pressure)
    try:
        progress(0.0, "elastic teeth")
        teeth = pair_stiffness(file, ToothBodySettings(), jobs=jobs)
        for number, side in enumerate(SIDES):
            progress(_TEETH + 0.25 * number, f"relief of the {side} flanks")
            found = _risen(designed, file, side, dict(amounts), free, torque, teeth[side])
            sides[side], edges[side], pressure[side] = found
    except GearLubeError as reason:
        unchecked = str(reason)
    return ChosenRelief(
        torque=torque, amounts=sides, edges=edges, pressure=pressure, unchecked=unchecked
    )


def _risen(
    designed: DesignedBlank,
    file: HypoidGearFile,
    side: Side,
    amounts: Amounts,
    free: Amounts,
    torque: float,
    teeth: PairStiffness,
) -> tuple[Amounts, dict[str, float], float]:
    """Return amounts, edges that carry and the highest pressure of one side.

    `free`: how far the amounts that may rise do so [um].
    """
    while True:
        flanks = {f"{role}.{side}_flank": relief_fields(designed, role, amounts) for role in ROLES}
        pair = FlankPair.from_file(file.varied({k: v or None for k, v in flanks.items()}), side)
        states = [
            MeshPosition.at(pair, k / POSITIONS).load(torque, teeth, _CELLS)
            for k in range(POSITIONS)
        ]
        edges: dict[str, float] = {}
        for state in states:
            for edge, one in loaded_edges(pair, state).items():
                edges[edge] = max(edges.get(edge, 0.0), one)
        reached = map(_relief_of, edges)
        rising = {name for name in reached if name in free and amounts[name] < free[name]}
        if not rising:
            highest = max(float(one.pressure.max()) for state in states for one in state.pairs)
            return amounts, edges, highest
        for name in rising:
            amounts[name] = min(float(np.ceil(_RISE * amounts[name])), free[name])


def _relief_of(edge: str) -> str:
    return edge if edge.endswith("tip") else "ends"


def relief_fields(designed: DesignedBlank, role: Role, amounts: Amounts) -> dict[str, float]:
    """Return the relief of a flank of a member as a gear file has it; empty without.

    Parameters
    ----------
    designed : DesignedBlank
        Says over which share of height and face each relief falls to 0.
    role : str
    amounts : dict
        As in `ChosenRelief` [um].
    """
    tip, end = _extents(designed)
    found: dict[str, float] = {}
    if amounts[f"{role} tip"] and tip:
        found["tip_relief_um"] = amounts[f"{role} tip"]
        found["tip_relief_depth_mm"] = tip
    if role == "pinion" and amounts["ends"] and end:
        for place in ("toe", "heel"):
            found[f"{place}_relief_um"] = amounts["ends"]
            found[f"{place}_relief_length_mm"] = end
    return found


def _extents(designed: DesignedBlank) -> tuple[float, float]:
    """Return how far reliefs of tips and of the pinion's ends reach [mm]; 0: none."""
    asked, blank = designed.file.relief, designed.blank
    # the edge that carries is the gear's end, where the pinion goes on
    beyond = max(0.5 * (blank.pinion.face_width - blank.gear.face_width), 0.0)
    end = asked.end_relief_share * blank.gear.face_width
    tip = asked.tip_relief_share * blank.whole_depth
    return tip / MILLIMETRE, (end + beyond) / MILLIMETRE if end else 0.0


def _most_amounts(designed: DesignedBlank) -> Amounts:
    """Return how much each relief may be [um]."""
    tip, end = (min(MOST, math.floor(1e3 * _STEEPEST * one)) for one in _extents(designed))
    return {"pinion tip": tip, "gear tip": tip, "ends": end}
