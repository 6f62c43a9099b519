"""Form of a tooth: thickness, topland, root and undercut, as numbers and as sentences."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.checks import check_within
from gearlube_core.hypoid_geometry.flank.flank import Role, Side
from gearlube_core.hypoid_geometry.flank.tooth import FlankRootLimit, Tooth
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from gearlube_core.units import MILLIMETRE

THIN_TOPLAND = 0.3  # of the mean normal module; this package's limit for a remark, not a standard's
_STATIONS = 33


@dataclass(frozen=True, slots=True, kw_only=True)
class ToothForm:
    """Form of one tooth along the face.

    Widths are arcs about the member's axis, times the cosine of the tooth's spiral angle there.

    Parameters
    ----------
    role : {"pinion", "gear"}
    t : ndarray of shape (n,)
        Face positions [-], 0 at the toe, 1 at the heel.
    topland : ndarray of shape (n,)
        Normal width of the top [m]; negative where the flanks meet below the tip.
    thickness : ndarray of shape (n,)
        Normal circular tooth thickness on the pitch cone [m].
    slot : ndarray of shape (n,)
        Normal width of the slot on the root cone [m], flanks extended down to it.
    drive, coast : FlankRootLimit
        Where the flanks end towards the root.
    active : float
        Profile position s to which the tip of the mate reaches [-].
    normal_module : float
        Mean normal module [m].
    """

    role: Role
    t: Array
    topland: Array
    thickness: Array
    slot: Array
    drive: FlankRootLimit
    coast: FlankRootLimit
    active: float
    normal_module: float

    def report(self) -> list[str]:
        """Return warnings about the tooth, one sentence each; empty for a regular tooth."""
        return [*self._tip(), *self._root(), *self._undercut("drive"), *self._undercut("coast")]

    def _tip(self) -> list[str]:
        least = int(np.argmin(self.topland))
        width, where = self.topland[least], self._where(least)
        if width <= 0.0:
            pointed = self.t[self.topland <= 0.0]
            return [
                f"{self.role} tooth is pointed: its flanks meet below the tip from face position "
                f"{pointed[0]:.2f} to {pointed[-1]:.2f} (0 toe, 1 heel). Reduce the addendum or "
                "the blade angles."
            ]
        if width < THIN_TOPLAND * self.normal_module:
            return [
                f"{self.role} topland is thin: {width / MILLIMETRE:.2f} mm {where}, below "
                f"{THIN_TOPLAND:g} of the normal module ({self.normal_module / MILLIMETRE:.2f} mm)."
            ]
        return []

    def _root(self) -> list[str]:
        least = int(np.argmin(self.slot))
        if self.slot[least] > 0.0:
            return []
        return [
            f"{self.role} slot closes above the root cone {self._where(least)}: the two blades "
            "overlap. Reduce the clearance or the blade angles."
        ]

    def _undercut(self, side: Side) -> list[str]:
        limit = self.drive if side == "drive" else self.coast
        if not limit.undercut.any():
            return []
        deepest = int(np.argmax(np.where(limit.undercut, limit.s, -1.0)))
        reach = (
            f"the tip of the mate reaches down to s = {self.active:.2f}, so contact is lost there"
            if limit.s[deepest] > self.active
            else f"below the reach of the mate, s = {self.active:.2f}"
        )
        spread = self.t[limit.undercut]
        return [
            f"{self.role} {side} flank is undercut below s = {limit.s[deepest]:.2f} "
            f"{self._where(deepest)}, on face positions {spread[0]:.2f} to {spread[-1]:.2f}; "
            f"{reach}."
        ]

    def _where(self, i: int) -> str:
        if i == 0:
            return "at the toe"
        return "at the heel" if i == self.t.size - 1 else f"at face position {self.t[i]:.2f}"


def tooth_form(file: HypoidGearFile, role: Role, stations: int = _STATIONS) -> ToothForm:
    """Return the form of a member's tooth at `stations` face positions from toe to heel.

    Raises
    ------
    ParameterError
        When the cutter leaves no flank, or none that is sound at mid profile.

    Examples
    --------
    >>> tooth_form(HypoidGearFile.named("mohammadpour_2015"), "pinion").report()  # doctest: +SKIP
    """
    count = int(check_within("stations", stations, 2, 1000))
    tooth = Tooth.from_file(file, role)
    region = tooth.drive.region
    depth = region.root_depth + region.addendum
    t = np.linspace(0.0, 1.0, count)
    s = np.array([0.0, region.root_depth / depth, 1.0])
    angle, share = tooth.thickness_angle(s, t), tooth.normal_shares(s, t)
    widths = angle * share
    return ToothForm(
        role=role,
        t=t,
        topland=widths[2],
        thickness=widths[1],
        slot=(tooth.pitch - angle[0]) * share[0],
        drive=tooth.limit("drive", t),
        coast=tooth.limit("coast", t),
        active=tooth.blank.root_clearance / depth,
        normal_module=tooth.blank.mean_normal_module,
    )


def tooth_grids(
    file: HypoidGearFile, role: Role, m: int, n: int, s_low: float = 0.0
) -> tuple[Array, Array]:
    """Return the two flanks of one tooth as grids of points, complete down to `s_low`.

    The drive flank stands as the member at rotation zero; the coast flank is that of the same
    tooth. Below an undercut the flanks go on smoothly (`Tooth.angles`); `tooth_form(...).report()`
    names the undercut.

    Parameters
    ----------
    file : HypoidGearFile
    role : {"pinion", "gear"}
    m, n : int
        Rows from `s_low` to the tip, columns from toe to heel.
    s_low : float
        Profile position of the first row [-], 0 on the root cone; -0.1 to 0.9.

    Returns
    -------
    drive, coast : ndarray of shape (m, n, 3)
        [m], fixed frame of the pair.
    """
    rows = int(check_within("m", m, 2, 10_000))
    columns = int(check_within("n", n, 2, 10_000))
    low = check_within("s_low", s_low, -0.1, 0.9)
    tooth = Tooth.from_file(file, role)
    s, t = np.linspace(low, 1.0, rows), np.linspace(0.0, 1.0, columns)
    drive, coast = (tooth.points(tooth.angles(k, s, t)[0], s, t) for k in ("drive", "coast"))  # type: ignore[arg-type]
    return drive, coast
