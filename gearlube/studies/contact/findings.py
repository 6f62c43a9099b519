"""Findings of a tooth contact analysis: main numbers, warnings about its gear file, sentences."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import xarray as xr

from gearlube.report.numbers import quantity_text
from gearlube.report.parts import GOOD, NOTE, WARNING, Finding, Number
from gearlube.studies.contact.figures.flank_maps import loaded_error
from gearlube_core.hypoid_contact.mesh_cycle import SIDES
from gearlube_core.hypoid_contact.refusal import check_pair, pair_warnings
from gearlube_core.hypoid_geometry.flank.flank import Role
from gearlube_core.hypoid_geometry.flank.tooth_form import tooth_form
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from gearlube_core.tooth_contact.sharp_edge import EDGE_PRESSURE, edges_that_carry

_ROLES: tuple[Role, Role] = ("pinion", "gear")
_TOUCHES = 1e-3  # share of the torque above which a pair counts as in contact
_NEAR_EDGE = 0.02  # of face or height, within which a loaded pattern reaches an edge


class ContactSummary(NamedTuple):
    """Means over the mesh of one side at one torque, in SI units."""

    side: str
    torque: float  # on the pinion [N.m]
    secant_stiffness: float  # [N/m]
    tangent_stiffness: float  # [N/m]
    pinion_arm: float  # of the mesh force [m]
    pairs: float  # in contact [-]
    highest_pressure: float  # [Pa], not a mean


def contact_summary(contact: xr.Dataset) -> list[ContactSummary]:
    """Return the main numbers of each side and torque."""
    rows = []
    for side in SIDES:
        for torque in contact["torque"].values:
            state = contact.sel(side=side, torque=torque)
            rows.append(
                ContactSummary(
                    side,
                    float(torque),
                    float(state["k_m"].mean()),
                    float(state["k_t"].mean()),
                    float(state["R_p"].mean()),
                    float((state["share"] > _TOUCHES).sum("pair").mean()),
                    float(state["pressure_max"].max()),
                )
            )
    return rows


def edge_warnings(contact: xr.Dataset) -> list[str]:
    """Return at which edges the highest pressure lies, each from the least torque on."""
    said: dict[tuple[str, str], str] = {}
    for side in SIDES:
        for torque in contact["torque"].values:
            found = contact["pressure_map"].sel(side=side, torque=torque).values
            for edge, pressure in edges_that_carry(found).items():
                said.setdefault(
                    (side, edge),
                    f"{side} flanks: from {torque:g} N.m on a sharp edge carries, at the {edge}, "
                    f"with {1e-9 * pressure:.2f} GPa that rises with finer cells. More relief there"
                    f" ({_CURES[edge].format(side=side)}) removes it.",
                )
    return list(said.values())


_CURES = {
    "gear tip": "gear.{side}_flank.tip_relief_um",
    "pinion tip": "pinion.{side}_flank.tip_relief_um",
    "toe": "toe_relief_um of both {side} flanks",
    "heel": "heel_relief_um of both {side} flanks",
}


def gear_file_warnings(file: HypoidGearFile) -> list[str]:
    """Return warnings about the machine settings and the teeth, one sentence each.

    Raises
    ------
    ParameterError
        The flanks do not meet.
    """
    check_pair(file)
    return pair_warnings(file) + [
        line for role in _ROLES for line in tooth_form(file, role).report()
    ]


def findings(contact: xr.Dataset) -> list[Finding]:
    """Return the findings of a contact analysis, the answer first.

    Examples
    --------
    >>> findings(xr.load_dataset("gearlube_contact/contact.nc"))[0].headline  # doctest: +SKIP
    'The first mesh order of the loaded transmission error, ...'
    """
    patterns = [_pattern(contact.sel(side=side), side) for side in SIDES]
    return [_error(contact), _edges(contact), *patterns, _stiffness(contact)]


def edge_torque(part: xr.Dataset) -> float:
    """Return the least torque [N·m] at which a side has pressures of edges; NaN if at none."""
    over = (part["pressure_max"] > EDGE_PRESSURE).any(("phase", "pair")).values
    return float(part["torque"].values[over][0]) if over.any() else float("nan")


def _edges(contact: xr.Dataset) -> Finding:
    from_torque = {side: edge_torque(contact.sel(side=side)) for side in SIDES}
    top, limit = float(contact["torque"][-1]), f"{1e-9 * EDGE_PRESSURE:g} GPa"
    pressed = [side for side in SIDES if not np.isnan(from_torque[side])]
    if not pressed:
        highest = 1e-9 * float(contact["pressure_max"].max())
        return Finding(
            GOOD,
            f"No sharp edge presses with more than {limit} up to {top:g} N·m: the highest pressure "
            f"is {quantity_text(highest, 'GPa')}.",
            "Higher pressures would be those of edges. The command names edges that carry less.",
        )
    where = " and ".join(f"{side} flanks from {from_torque[side]:g} N·m on" for side in pressed)
    middle = " and ".join(
        quantity_text(1e-9 * _middle(contact.sel(side=side)), "GPa", 2) for side in pressed
    )
    return Finding(
        WARNING,
        f"Sharp edges press into the {where}, with more than {limit}.",
        "The pressure of an edge is no number to use, because it rises with finer cells. Where a "
        f"pair carries most load, {top:g} N·m give {middle}. Relief of tips and ends in the gear "
        "file removes edge contact; the command names the edges.",
    )


def _middle(part: xr.Dataset) -> float:
    """Return the highest pressure [Pa] of a pair where it carries most, at the highest torque."""
    state = part.isel(torque=-1)
    most = int(np.argmax(np.nan_to_num(state["share"].values)))
    return float(state["pressure_max"].values.ravel()[most])


def _pressure(part: xr.Dataset) -> float:
    """Return the highest pressure [Pa], where edges press that of the pair that carries most."""
    return float(part["pressure_max"].max()) if np.isnan(edge_torque(part)) else _middle(part)


def first_order(part: xr.Dataset) -> np.ndarray:
    """Return the first mesh order of the loaded transmission error [µm], shape (torques,)."""
    errors = [loaded_error(part.sel(torque=torque)) for torque in part["torque"].values]
    return np.asarray(2.0 * np.abs(np.fft.rfft(errors)[:, 1]) / part.sizes["phase"])


def _error(contact: xr.Dataset) -> Finding:
    largest, others, torque = [], [], contact["torque"].values
    for side in SIDES:
        part = contact.sel(side=side)
        first = first_order(part)
        most, least = int(np.argmax(first)), int(np.argmin(first))
        largest.append(f"{quantity_text(first[most], 'µm')} ({side}, at {torque[most]:g} N·m)")
        others.append(
            f"On {side} flanks it is least at {torque[least]:g} N·m, "
            f"{quantity_text(first[least], 'µm')}; the error without load is "
            f"{quantity_text(_unloaded(part), 'µm')} peak to peak."
        )
    return Finding(
        NOTE,
        "The first mesh order of the loaded transmission error, which excites the whine, is at "
        f"most {' and '.join(largest)}.",
        " ".join(others),
    )


def _unloaded(part: xr.Dataset) -> float:
    """Return the unloaded transmission error of a side, peak to peak [µm]."""
    return 1e6 * float(part["R_p"].mean() * np.ptp(part["error"].values))


def _pattern(part: xr.Dataset, side: str) -> Finding:
    cells, torque = np.asarray(part["pressure_map"].values > 0.0), part["torque"].values
    along = np.asarray(cells.any(axis=1))
    places = part["map_t"].values
    half = 0.5 * float(places[1] - places[0])
    spans = [(places[row].min() - half, places[row].max() + half) for row in along if row.any()]
    toe, heel = spans[-1]
    reached = [name for name, gap in (("toe", toe), ("heel", 1.0 - heel)) if gap < _NEAR_EDGE]
    text = (
        f"At {torque[0]:g} N·m it covers {100.0 * (spans[0][1] - spans[0][0]):.0f} % of the face."
    )
    span = f"{100.0 * toe:.0f} to {100.0 * heel:.0f} % of the face (toe 0, heel 100)"
    if reached:
        return Finding(
            WARNING,
            f"At {torque[-1]:g} N·m the {side} pattern runs off the {' and the '.join(reached)}: "
            f"{span}.",
            f"{text} Lengthwise crowning, or another position of the contact, keeps it inside.",
        )
    return Finding(
        GOOD, f"At {torque[-1]:g} N·m the {side} pattern stays on the face: {span}.", text
    )


def _stiffness(contact: xr.Dataset) -> Finding:
    part = contact.sel(side="drive")
    low, high = (1e-6 * float(part["k_m"].isel(torque=k).mean()) for k in (0, -1))
    pairs = (part["share"].isel(torque=-1) > _TOUCHES).sum("pair")
    torque = part["torque"].values
    return Finding(
        NOTE,
        f"The mean mesh stiffness (drive, secant) is {quantity_text(low, 'N/µm')} at "
        f"{torque[0]:g} N·m and {quantity_text(high, 'N/µm')} at {torque[-1]:g} N·m.",
        f"At {torque[-1]:g} N·m {float(pairs.mean()):.1f} pairs carry load on average.",
    )


def numbers(contact: xr.Dataset) -> list[Number]:
    """Return the key numbers of a contact analysis, with the same names in every run."""
    found = []
    for side in SIDES:
        part = contact.sel(side=side)
        first = first_order(part)
        found += [
            Number(f"largest first order of the loaded error, {side}", float(first.max()), "µm"),
            Number(
                f"unloaded error, peak to peak, {side}",
                _unloaded(part),
                "µm",
            ),
            Number(
                f"highest pressure away from sharp edges, {side}", 1e-9 * _pressure(part), "GPa"
            ),
            Number(f"least torque with edge contact, {side}", edge_torque(part), "N·m"),
            Number(
                f"mean secant stiffness at the highest torque, {side}",
                1e-6 * float(part["k_m"].isel(torque=-1).mean()),
                "N/µm",
            ),
            Number(f"path of contact, {side}", float(part["path_contact_ratio"]), "mesh periods"),
        ]
    return found
