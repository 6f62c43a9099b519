"""Gaps between the unloaded flanks: along contact lines and across one of them."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from gearlube.studies.helical.geometry_lines import (
    STATIONS,
    Part,
    Variables,
    relieved_lines_always_touch,
)
from gearlube_core.arrays import Array
from gearlube_core.contact.hertz import line_mean_pressure
from gearlube_core.helical_geometry.contact_line import line_kinematics
from gearlube_core.helical_geometry.involute import involute_flank
from gearlube_core.helical_geometry.lay_angle import equal_radius_line
from gearlube_core.helical_geometry.load_sharing import shared_load
from gearlube_core.helical_geometry.modification import (
    Crown,
    FlankModification,
    ModifiedPair,
    TipRelief,
)
from gearlube_core.helical_geometry.undeformed_gap import UndeformedGap, contact_line_gap
from gearlube_core.units import labelled

RELIEF_FORMS = (0.0, 0.5, 1.0)  # k of [jamali_2015 fig. 5.2] to 5.4
CROWN_STARTS = (0.0, 0.1, 0.25, 0.4, 0.45)  # F_o over F, [jamali_2015 sec. 4.6]
FACETS = (40, 60, 100)  # [jamali_2015 fig. 6.5]
SURFACE_CROWN_START = 0.25  # [jamali_2015 fig. 4.5c]
_RELIEF_LINES = 17
_ACROSS, _SURFACE = 601, (61, 89)
_EDGE_GAP = 12e-6  # m, of unmodified flanks at the edge of what is shown across a line


def gap_variables(modified: ModifiedPair, X: Array, torque: float, modulus: float) -> Part:
    """Return the gaps along the lines X, and crown, facets and relief about the middle one."""
    plane = modified.pair.plane
    middle = float(X[X.size // 2])
    y = np.linspace(-0.5, 0.5, STATIONS) * plane.W / plane.cos_b
    lag = plane.W * plane.sin_b / plane.cos_b
    at_mid_face = min(max(middle - 0.5 * lag, plane.A), plane.D)
    R = line_kinematics(at_mid_face, 1.0, plane).R
    x = np.linspace(-1.0, 1.0, _ACROSS) * math.sqrt(2.0 * R * _EDGE_GAP)
    variables: Variables = {
        "hertz_half_width": labelled(
            (), _half_width(modified, middle, torque, modulus, R), "m",
            "half-width of the middle line's contact under its shared load, dry",
        ),
    }  # fmt: skip
    coordinates: Variables = {
        "x": labelled(("x",), x, "m", "across the contact line, towards the pinion's root"),
    }
    for part in (
        _along_lines(modified, X, y),
        _crown_forms(modified, middle, x, y),
        _facets(modified, middle, x),
        _equal_relief(modified, X, y),
    ):
        variables |= part.variables
        coordinates |= part.coordinates
    return Part(variables, coordinates)


def _half_width(modified: ModifiedPair, X: float, torque: float, modulus: float, R: float) -> float:
    state = modified
    if not relieved_lines_always_touch(modified):
        state = ModifiedPair(pair=modified.pair)
    load = float(shared_load(X, state, torque).line_load)
    return load / (2.0 * line_mean_pressure(load, R, modulus)) if load > 0.0 else 0.0


def _along_lines(modified: ModifiedPair, X: Array, y: Array) -> Part:
    """Return the gaps along the shown lines, with relief as it is and in three forms."""
    plane = modified.pair.plane
    gaps = [contact_line_gap(modified, float(one), y) for one in X]
    on_line = X[:, None] - 0.5 * plane.W * plane.sin_b / plane.cos_b + y * plane.sin_b
    touching = (on_line >= plane.A) & (on_line <= plane.D)
    lines = ("shown", "y")
    variables: Variables = {
        "line_gap": labelled(
            lines, np.where(touching, [gap.gap for gap in gaps], np.nan), "m",
            "gap along a contact line, normal to the flanks",
        ),
        "crown_gap": labelled(("y",), gaps[0].crown, "m", "part of the gap due to crowns"),
    }  # fmt: skip
    coordinates: Variables = {}
    if plane.sin_b <= 0.0 or _relieved_members(modified) == []:
        return Part(variables, coordinates)
    for member in ("pinion", "gear"):
        starts = np.array([getattr(gap, f"{member}_relief_start") for gap in gaps])
        if member not in _relieved_members(modified):
            starts = np.full(X.size, np.nan)
        variables[f"{member}_relief_start"] = labelled(
            ("shown",), starts, "m", f"y on a shown line where the {member}'s tip relief starts"
        )
    forms = [
        [contact_line_gap(_with_relief_form(modified, k), float(one), y).gap for one in X]
        for k in RELIEF_FORMS
    ]
    variables["line_gap_by_form"] = labelled(
        ("k", *lines), np.where(touching, forms, np.nan), "m",
        "gap along a contact line with parabolic share k of the tip relief",
    )  # fmt: skip
    coordinates["k"] = labelled(
        ("k",), np.array(RELIEF_FORMS), "1", "tip relief: 0 linear, 1 parabolic"
    )
    return Part(variables, coordinates)


def _crown_forms(modified: ModifiedPair, X: float, x: Array, y: Array) -> Part:
    """Return one tooth's crown from five starts, and the gap of both teeth from one of them."""
    crown = modified.pinion.crown or modified.gear.crown
    if crown is None:
        return Part({}, {})
    plane = modified.pair.plane
    forms = [
        replace(crown, start=part * plane.W).removal(y * plane.cos_b, plane.W) * plane.cos_b
        for part in CROWN_STARTS
    ]
    across = x[:: (x.size - 1) // (_SURFACE[0] - 1)]
    along = y[:: (y.size - 1) // (_SURFACE[1] - 1)]
    started = _with_crown_start(modified, SURFACE_CROWN_START * plane.W)
    surface = UndeformedGap(modified=started).heights(across[:, None], along[None, :], X)
    on_line = X - 0.5 * plane.W * plane.sin_b / plane.cos_b + along * plane.sin_b
    touching = (on_line >= plane.A) & (on_line <= plane.D)
    return Part(
        {
            "crown_form": labelled(
                ("crown_start", "y"), np.array(forms), "m", "crown of one tooth, normal to it"
            ),
            "surface_gap": labelled(
                ("surface_x", "surface_y"), np.where(touching, surface, np.nan), "m",
                "gap about the middle line, crowns beginning at surface_crown_start",
            ),
            "surface_crown_start": labelled(
                (), SURFACE_CROWN_START, "1", "start of the crown over face width in surface_gap"
            ),
        },
        {
            "crown_start": labelled(
                ("crown_start",), np.array(CROWN_STARTS), "1", "start of the crown over face width"
            ),
            "surface_x": labelled(("surface_x",), across, "m", "across the contact line"),
            "surface_y": labelled(("surface_y",), along, "m", "along the contact line"),
        },
    )  # fmt: skip


def _facets(modified: ModifiedPair, X: float, x: Array) -> Part:
    """Return the distance of the pinion's faceted flank from the tangent plane at mid-face."""

    def heights(count: int) -> Array:
        faceted = replace(modified, pinion=replace(modified.pinion, facets=count))
        return UndeformedGap(modified=faceted).tooth_heights("pinion", x, 0.0, X)

    text = "distance of the pinion's flank from the tangent plane at mid-face of the middle line"
    return Part(
        {
            "smooth_height": labelled(("x",), heights(0), "m", f"{text}, smooth"),
            "faceted_height": labelled(
                ("facets", "x"), np.array([heights(n) for n in FACETS]), "m", f"{text}, faceted"
            ),
        },
        {"facets": labelled(("facets",), np.array(FACETS), "1", "facets over the profile")},
    )


def _equal_relief(modified: ModifiedPair, X: Array, y: Array) -> Part:
    """Return lines of equal tip relief, each member's about a line that it relieves."""
    pair = modified.pair
    if pair.base_helix_angle <= 0.0:
        return Part({}, {})
    cos_b = math.cos(pair.base_helix_angle)
    members, shown, removals, lines = [], [], [], []
    for member in _relieved_members(modified):
        number = _line_in_relief(modified, member, X, y)
        if number is None:
            continue
        relief, tip = getattr(modified, member).tip_relief, involute_flank(pair, member).tip_radius
        radii = tip - relief.extent * np.linspace(1.0, 0.0, _RELIEF_LINES)
        members.append(member)
        shown.append(number + 1)
        removals.append(relief.removal(radii, tip) * cos_b)
        lines.append(equal_radius_line(radii[:, None], y[None, :], float(X[number]), pair, member))
    if not members:
        return Part({}, {})
    levels = ("relieved", "level")
    return Part(
        {
            "relief_removal": labelled(levels, np.array(removals), "m", "tip relief, normal"),
            "relief_line": labelled(
                (*levels, "y"), np.array(lines), "m",
                "x of a line of equal tip relief on the tangent plane of relief_line_shown",
            ),
            "relief_line_shown": labelled(
                ("relieved",), np.array(shown), "1", "shown contact line that meets the relief"
            ),
        },
        {
            "relieved": labelled(("relieved",), members, "", "member with tip relief"),
            "level": labelled(
                ("level",), np.linspace(0.0, 1.0, _RELIEF_LINES), "1",
                "radial depth into the relief over its extent",
            ),
        },
    )  # fmt: skip


def _line_in_relief(modified: ModifiedPair, member: str, X: Array, y: Array) -> int | None:
    """Return the line nearest to the middle of the list that meets a member's relief."""
    for number in sorted(range(X.size), key=lambda n: abs(n - X.size // 2)):
        start = getattr(contact_line_gap(modified, float(X[number]), y), f"{member}_relief_start")
        if y[0] < start < y[-1]:
            return number
    return None


def _relieved_members(modified: ModifiedPair) -> list[str]:
    return [
        member for member in ("pinion", "gear") if getattr(modified, member).tip_relief is not None
    ]


def _with_relief_form(modified: ModifiedPair, k: float) -> ModifiedPair:
    def flank(given: FlankModification) -> FlankModification:
        relief = given.tip_relief
        if relief is None:
            return given
        return replace(given, tip_relief=TipRelief(amount=relief.amount, extent=relief.extent, k=k))

    return replace(modified, pinion=flank(modified.pinion), gear=flank(modified.gear))


def _with_crown_start(modified: ModifiedPair, start: float) -> ModifiedPair:
    def flank(given: FlankModification) -> FlankModification:
        if given.crown is None:
            return given
        return replace(given, crown=Crown(amount=given.crown.amount, start=start))

    return replace(modified, pinion=flank(modified.pinion), gear=flank(modified.gear))
