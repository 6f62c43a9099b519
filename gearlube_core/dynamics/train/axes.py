"""Where the axes of bodies stand from each other, as meshes and shafts of a train say."""

from __future__ import annotations

from collections.abc import Sequence

from gearlube_core.dynamics.train.part import Body, Element, Node
from gearlube_core.errors import ParameterError

_NEAR = 1e-3  # of the longest distance: numbers of files are rounded


def check_axes(bodies: Sequence[Body], elements: Sequence[Element]) -> None:
    """Raise ParameterError where a loop of meshes and shafts does not close.

    The last mesh of a split drive, or of one whose output is coaxial with its input, then has
    gears that do not touch.
    """
    nodes = {one.name: one.name.partition(".")[0] for one in bodies if isinstance(one, Node)}
    left = [(element, found) for element in elements if (found := element.between_axes())]
    while left:
        first = left[0][1][0]
        places, reached = {nodes.get(first, first): 0.0j}, True
        while reached:
            reached = False
            for one in list(left):
                element, (start, end, step) = one
                a, b = nodes.get(start, start), nodes.get(end, end)
                if a in places and b in places:
                    _check_closed(element, (start, end), step, places[b] - places[a])
                elif a in places:
                    places[b] = places[a] + step
                elif b in places:
                    places[a] = places[b] - step
                else:
                    continue
                left.remove(one)
                reached = True


def _check_closed(element: Element, names: tuple[str, str], step: complex, there: complex) -> None:
    """Raise ParameterError unless both distances are the same."""
    if abs(step - there) > _NEAR * max(abs(step), abs(there)):
        wanted, got = (f"{1e3 * one.real:.6g}, {1e3 * one.imag:.6g} mm" for one in (step, there))
        raise ParameterError(
            f"{element.name} needs the axis of {names[1]} at x, y = {wanted} from that of "
            f"{names[0]}, but the other meshes and shafts between them put it at {got}: gears do "
            "not touch. Correct an azimuth or angle, a distance, a module or a number of teeth."
        )
