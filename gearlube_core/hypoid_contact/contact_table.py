"""The mesh table that a tooth contact analysis writes."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import xarray as xr
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from gearlube_core.arrays import Array
from gearlube_core.errors import TableError
from gearlube_core.hypoid_contact.pair import FlankPair
from gearlube_core.hypoid_geometry.flank.flank import tooth_region
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from gearlube_core.mesh_table.table import (
    PAIRS,
    TOOTH_UNITS,
    ZERO_PHASE,
    MeshTable,
    Provenance,
    fourier,
    orders_kept,
)

_STEP = 1e-3  # of the flank's parameters, for its tangents
_FLATTEST = 20.0  # m, R_y where the ellipse is longer than any tooth
_LOST = 0.02  # largest share of a pair outside its window that is dropped


def drawn_axes(
    pair: FlankPair, life: Array, s: Array, t: Array, minor_axis: Array
) -> tuple[Array, Array]:
    """Return minor and major axis of contact ellipses on the drawn gear tooth, (N, 2) each [1/m].

    A step of one metre along the axis is a step of so many face widths, from toe to heel, and of
    so many tooth heights, from root to tip.

    Parameters
    ----------
    pair : FlankPair
    life : ndarray of shape (N,)
        Mesh phase of the tooth pair [mesh periods], 0 where it meets at the mean point.
    s, t : ndarray of shape (N,)
        Centre on the gear flank: root 0 to tip 1, toe 0 to heel 1 [-].
    minor_axis : ndarray of shape (N, 3)
        Unit vector in the fixed frame [-].

    Notes
    -----
    The drawn tooth is the gear's axial section: both surfaces' tangents are taken from the flank.
    """
    gear, step = pair.gear, _STEP
    up = (gear.sample(s + step, t).r - gear.sample(s - step, t).r) / (2.0 * step)
    along = (gear.sample(s, t + step).r - gear.sample(s, t - step).r) / (2.0 * step)
    turn = Rotation.from_rotvec(pair.gear_turn(life * pair.gear_pitch)[:, None] * gear.axis)
    along, up = turn.apply(along), turn.apply(up)
    normal = np.cross(along, up)
    normal /= np.linalg.norm(normal, axis=1)[:, None]
    major = np.cross(normal, minor_axis)
    # least squares of direction = a along + b up: of normal equations two by two
    aa, ab, bb = (np.einsum("ni,ni->n", *two) for two in ((along, along), (along, up), (up, up)))
    found = []
    for direction in (minor_axis, major):
        a, b = (np.einsum("ni,ni->n", one, direction) for one in (along, up))
        parts = np.stack([bb * a - ab * b, aa * b - ab * a], 1)
        found.append(parts / (aa * bb - ab * ab)[:, None])
    return found[0], found[1]


def contact_table(file: HypoidGearFile, dataset: xr.Dataset) -> MeshTable:
    """Return the mesh table of a dataset from `contact_dataset`.

    On either side it ends below the torque of which `levels_left_out` says that it does not fit.

    Raises
    ------
    TableError
        When more than `PAIRS` tooth pairs carry at a time, at any torque of the drive flanks.

    Notes
    -----
    Levels of the coast flanks carry negative torque. The loaded positions are those of the gear
    angle; over a period they differ from the pinion angle by the transmission error alone, below
    1e-3 of the period.
    """
    fitting, reasons = _fitting(dataset)
    if not fitting["drive"]:
        raise TableError(reasons[0])
    levels = [("coast", t) for t in fitting["coast"][::-1]]
    levels += [("drive", t) for t in fitting["drive"]]
    region = tooth_region(file.blank(), "gear")
    pairs = _pairs_to_draw(file, dataset)
    series: dict[str, list[Array]] = {}
    windows: dict[str, list[Array]] = {}
    for side, torque in levels:
        state = dataset.sel(side=side, torque=torque)
        for key, values in _series(state).items():
            series.setdefault(key, []).append(values)
        state = state.assign(_on_tooth(state, pairs[side])) if pairs else state
        for key, values in _windows(state, f"{side} {torque:g} N.m").items():
            windows.setdefault(key, []).append(values)
    loaded = np.stack(windows["share"]) > 0.0
    return MeshTable(
        name=file.name,
        pinion_teeth=file.pinion.teeth,
        gear_teeth=file.gear.teeth,
        torque=np.array([-t if side == "coast" else t for side, t in levels]),
        contact_ratio=float(np.clip(loaded[-1].sum() / loaded.shape[1] * PAIRS, 1.0, PAIRS)),
        series={key: np.stack(values) for key, values in series.items()},
        windows={key: np.stack(values) for key, values in windows.items()},
        provenance=_provenance(file),
        source=file.source,
        settings={
            "positions": float(dataset.sizes["phase"]),
            "path_contact_ratio": float(dataset["path_contact_ratio"].sel(side="drive")),
        },
        tooth_size=(region.face_width, region.whole_height) if pairs else None,
    )


def levels_left_out(dataset: xr.Dataset) -> list[str]:
    """Return why levels of a dataset are not in its mesh table, a sentence for each side."""
    return _fitting(dataset)[1]


def _fitting(dataset: xr.Dataset) -> tuple[dict[str, list[float]], list[str]]:
    """Return the torques [N.m] of each side that fit into a table, and why one ends where."""
    fitting: dict[str, list[float]] = {}
    reasons = []
    for side in ("drive", "coast"):
        fitting[side] = []
        for torque in dataset["torque"].values:
            try:
                _windows(dataset.sel(side=side, torque=torque), f"{side} {torque:g} N.m")
            except TableError as reason:
                reasons.append(str(reason))
                break
            fitting[side].append(float(torque))
    return fitting, reasons


def _series(state: xr.Dataset) -> dict[str, Array]:
    orders = orders_kept(state.sizes["phase"])
    values = {key: fourier(state[key].values, orders) for key in ("k_m", "R_p", "R_g", "k_t")}
    for axis in ("x", "y", "z"):
        values[f"n_{axis}"] = fourier(state["n"].sel(axis=axis).values, orders)
    values["e"] = fourier(state["e"].values, orders)
    # zero where the flanks are tightest: only its change is felt
    side = 1.0 if str(state["side"].values) == "drive" else -1.0
    values["e"][0, 0] -= side * float(np.min(side * state["e"].values))
    return values


_WINDOW_SOURCES: dict[str, Callable[[xr.Dataset], xr.DataArray]] = {
    "R_x": lambda d: d["R_x"],
    "R_y": lambda d: d["R_y"].where((d["R_y"] > 0.0) & (d["R_y"] < _FLATTEST), _FLATTEST),
    "psi": lambda d: d["psi"],
    "entrainment_arm": lambda d: d["entrainment_arm"],
    "friction_arm_p": lambda d: d["friction_arm_p"],
    "friction_arm_g": lambda d: d["friction_arm_g"],
    "xi_x": lambda d: d["xi"].sel(axis="x"),
    "xi_y": lambda d: d["xi"].sel(axis="y"),
    "xi_z": lambda d: d["xi"].sel(axis="z"),
    "chi": lambda d: d["chi"],
    "pressure_max": lambda d: d["pressure_max"],
}


def _pairs_to_draw(file: HypoidGearFile, dataset: xr.Dataset) -> dict[str, FlankPair]:
    """Return the flanks of both sides; none where the dataset has no direction of the ellipses."""
    if "minor_axis" not in dataset:  # of an earlier version
        return {}
    return {side: FlankPair.from_file(file, side) for side in ("drive", "coast")}


def _on_tooth(state: xr.Dataset, pair: FlankPair) -> dict[str, xr.DataArray]:
    """Return the windows of `TOOTH_UNITS` over phase and pair, NaN where a pair carries nothing."""
    region = pair.gear.region
    size = np.array([region.face_width, region.whole_height])
    s, t = state["gear_s"].values, state["gear_t"].values
    known = np.isfinite(s)
    life = (state["phase"].values[:, None] + state["pair"].values)[known]
    axes = drawn_axes(pair, life, s[known], t[known], state["minor_axis"].values[known])
    columns = [size * np.stack([t[known], s[known]], 1), *(size * one for one in axes)]
    full = np.full((*s.shape, len(TOOTH_UNITS)), np.nan)
    full[known] = np.concatenate(columns, axis=1)
    return {
        key: state["gear_s"].copy(data=full[..., i]).drop_attrs()
        for i, key in enumerate(TOOTH_UNITS)
    }


def _windows(state: xr.Dataset, where: str) -> dict[str, Array]:
    positions = state.sizes["phase"]
    nodes = PAIRS * positions
    phase = state["phase"].values[:, None] + state["pair"].values
    node = np.rint((phase - ZERO_PHASE) * positions).astype(int)
    share = state["share"].values
    first = _window_start(node, share, nodes, where)
    inside = (node >= first) & (node < first + nodes)
    kept = np.where(inside, share, 0.0)
    kept /= kept.sum(axis=1, keepdims=True)
    place = np.mod(node[inside], nodes)
    result = {"share": np.zeros(nodes)}
    result["share"][place] = kept[inside]
    loaded = np.zeros(nodes, dtype=bool)
    loaded[place] = (kept > 0.0)[inside] & np.isfinite(state["R_x"].values)[inside]
    sources = {key: source(state) for key, source in _WINDOW_SOURCES.items()}
    sources |= {key: state[key] for key in TOOTH_UNITS if key in state}
    for key, source in sources.items():
        values = np.zeros(nodes)
        values[place] = source.values[inside]
        result[key] = _held(values, loaded)
    return result


def _window_start(node: NDArray[np.int_], share: Array, nodes: int, where: str) -> int:
    """Return the first of the `nodes` consecutive nodes with the most load."""
    carried = np.bincount(
        (node - node.min()).ravel(), share.ravel(), minlength=int(np.ptp(node)) + 1
    )
    within = np.convolve(carried, np.ones(nodes), "valid")
    best = int(np.argmax(within))
    outside = (node - node.min() < best) | (node - node.min() >= best + nodes)
    lost = float(np.max(np.where(outside, share, 0.0)))
    if lost > _LOST:
        raise TableError(
            f"{where}: a tooth pair still carries {lost:.1%} of the torque more than {PAIRS} mesh "
            "periods after another position. A mesh table can hold only that many pairs, so it "
            "ends below this torque; contact.nc has all torques. Give tips and ends some relief, "
            "as real gears have, to reach higher torques."
        )
    return int(node.min()) + best


def _held(values: Array, loaded: NDArray[np.bool_]) -> Array:
    """Return values; unloaded nodes get the value of the nearest loaded node of the window."""
    count = values.size
    index = np.flatnonzero(loaded)
    distance = np.abs(np.arange(count)[:, None] - index[None, :])
    distance = np.minimum(distance, count - distance)
    return values[index[np.argmin(distance, axis=1)]]


_LOADED = (
    "loaded contact of flanks cut from the machine settings: unilateral contact of half-space "
    "cells on the true gap, finite-element teeth, torque equilibrium"
)
_AT_CENTRE = "at each pair's centre of force: " + (
    "shape operators and rigid rotation of the flanks cut from the machine settings"
)
_DERIVATIONS = {
    "k_m": f"secant, torque over closing and squared arm; {_LOADED}",
    "k_t": f"tangent at fixed contact area; {_LOADED}",
    "R_p": f"pinion torque over the resultant of the normal forces; {_LOADED}",
    "R_g": f"gear torque over the resultant of the normal forces; {_LOADED}",
    "n_x": f"direction of the resultant of the normal forces; {_LOADED}",
    "n_y": f"direction of the resultant of the normal forces; {_LOADED}",
    "n_z": f"direction of the resultant of the normal forces; {_LOADED}",
    "e": "first touch of the unloaded flanks times the mean arm; its size follows the blade edge "
    "radius, which was chosen for it",
    "share": f"part of the pinion torque; {_LOADED}",
    "pressure_max": f"highest cell pressure; sharp edges unless relieved; {_LOADED}",
}


def _provenance(file: HypoidGearFile) -> dict[str, Provenance]:
    """Return the origin of each datum: `completed` if any completed setting affects it."""
    kind = "completed" if file.completed else "inferred"
    keys = (*_DERIVATIONS, *_WINDOW_SOURCES, *TOOTH_UNITS)
    return {key: Provenance(kind, _DERIVATIONS.get(key, _AT_CENTRE)) for key in keys}  # type: ignore[arg-type]
