"""Where the axes of bodies stand from each other, as meshes, shafts and bearings of a train say."""

from __future__ import annotations

from collections.abc import Sequence

from gearlube_core.dynamics.train.part import AxisPlace, Element
from gearlube_core.dynamics.train.supports import holds
from gearlube_core.errors import ParameterError

_NEAR = 1e-3  # of the longest distance: numbers of files are rounded
_LEAST = 1e-3  # m, of that distance


def check_axes(elements: Sequence[Element]) -> None:
    """Raise ParameterError where a loop of meshes, shafts and bearings does not close.

    The last mesh of a split drive, or of one whose output is coaxial with its input, then has
    gears that do not touch; or a bearing stands off the axis of its shaft. Meshes place what they
    reach first, so that a bearing is named where both disagree.
    """
    left = [(element, place) for element in elements for place in element.between_axes()]
    left.sort(key=lambda one: holds(one[0]))
    places: dict[str, complex] = {}
    while left:
        near = (i for i, (_, one) in enumerate(left) if one.first in places or one.second in places)
        element, one = left.pop(next(near, 0))
        start = places.get(one.second, 0.0j) - (one.step if one.second in places else 0.0j)
        there = places.setdefault(one.first, start)
        _check_closed(element, one, places.setdefault(one.second, there + one.step) - there)


def _check_closed(element: Element, place: AxisPlace, there: complex) -> None:
    """Raise ParameterError unless both distances are the same."""
    apart = abs(place.step - there)
    if apart <= _NEAR * max(abs(place.step), abs(there), _LEAST):
        return
    wanted, got = (
        f"{1e3 * one.real + 0.0:.6g}, {1e3 * one.imag + 0.0:.6g} mm" for one in (place.step, there)
    )
    if holds(element):
        fields = "radius and azimuth" if element.kind == "joint" else "housing_x and housing_y"
        raise ParameterError(
            f"{element.name} must stand on the axis of {place.second}, at x, y = {got} from "
            f"{place.first} by meshes, shafts and other bearings, got {wanted}, {1e3 * apart:.4g} "
            f"mm off. Correct {fields}, the node on which it acts, or a mesh."
        )
    raise ParameterError(
        f"{element.name} needs the axis of {place.second} at x, y = {wanted} from that of "
        f"{place.first}, but the other meshes and shafts between them put it at {got}: gears do "
        "not touch. Correct an azimuth or angle, a distance, a module or a number of teeth."
    )
