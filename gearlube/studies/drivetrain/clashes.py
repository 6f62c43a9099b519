"""Gears and shafts of a drivetrain that run through each other."""

from __future__ import annotations

from itertools import combinations

from gearlube.studies.drivetrain.layout import Gear, Layout

_NEAR = 1e-4  # m, of what touches


def clashes(found: Layout) -> list[str]:
    """Return sentences on gears and shafts of a drivetrain that run through each other.

    Only where their places along z are known from meshes: of a body with two gears in one plane,
    these are not drawn yet.
    """
    planes: dict[tuple[str, float], set[int]] = {}
    for gear in found.gears:
        planes.setdefault((gear.body, gear.z), set()).add(gear.teeth)
    flat = {body for (body, _), teeth in planes.items() if len(teeth) > 1}
    said = []
    for group in found.groups():
        if flat & set(group):
            continue
        solids: dict[tuple[str, int, float], tuple[str, Gear]] = {}
        for gear in found.gears:
            if gear.body in group:
                solids.setdefault(gear.key, (f"{gear.body} in {gear.mesh}", gear))
        met = {frozenset((one.key, two.key)) for one, two in found.pairs()}
        for body in group:
            for k, (start, end, _, radius) in enumerate(found.sections.get(body, ())):
                part = Gear("", body, radius, end - start, 0.5 * (start + end), False, -k, 0.0)
                solids[part.key] = f"the shaft {body}", part
        for (words, one), (others, two) in combinations(solids.values(), 2):
            if one.body == two.body or frozenset((one.key, two.key)) in met:
                continue
            places = [(found.shifts[gear.body] + gear.z, 0.5 * gear.width) for gear in (one, two)]
            low, high = max(z - half for z, half in places), min(z + half for z, half in places)
            apart = abs(found.centres[one.body] - found.centres[two.body])
            limit = _least_distance(one, two, apart)
            if high - low > _NEAR and limit > apart + _NEAR:
                said.append(
                    f"{words} and {others} run through each other. Their axes must be at least "
                    f"{1e3 * limit:.5g} mm apart, the sum of their outer radii, got "
                    f"{1e3 * apart:.5g} mm, while both have z = {1e3 * low:.5g} to "
                    f"{1e3 * high:.5g} mm. Correct an arm or a node, a width, or an azimuth."
                )
    return said


def _least_distance(one: Gear, two: Gear, apart: float) -> float:
    """Return how far apart the axes of two gears must be at least [m]; a ring may be around."""
    for gear, other in ((one, two), (two, one)):
        if gear.ring and (other.ring or apart + _tip(other) < _tip(gear)):
            return 0.0
    return _tip(one) + _tip(two)


def _tip(gear: Gear) -> float:
    return gear.radius + (-gear.module if gear.ring else gear.module)
