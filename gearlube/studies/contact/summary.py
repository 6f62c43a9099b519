"""Main numbers of a tooth contact analysis, and warnings about its gear file."""

from __future__ import annotations

from typing import NamedTuple

import xarray as xr

from gearlube_core.hypoid_contact.mesh_cycle import SIDES
from gearlube_core.hypoid_contact.refusal import check_pair, pair_warnings
from gearlube_core.hypoid_geometry.flank.flank import Role
from gearlube_core.hypoid_geometry.flank.tooth_form import tooth_form
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from gearlube_core.tooth_contact.sharp_edge import edges_that_carry

_ROLES: tuple[Role, Role] = ("pinion", "gear")
_TOUCHES = 1e-3  # share of the torque above which a pair counts as in contact


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
