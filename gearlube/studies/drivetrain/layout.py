"""Picture of a drivetrain: where its shafts, gears and bearings are."""

from __future__ import annotations

import cmath
import math
from collections.abc import Sequence
from typing import Any, NamedTuple

from gearlube.plotting.style import SERIES, house_style, new_figure
from gearlube_core.dynamics.train.elements.gear_mesh import GearMesh
from gearlube_core.dynamics.train.elements.half_shaft import HalfShaft
from gearlube_core.dynamics.train.elements.helical_mesh import HelicalMesh
from gearlube_core.dynamics.train.elements.housing_motion import CarriedInterface
from gearlube_core.dynamics.train.elements.orbit import Orbit
from gearlube_core.dynamics.train.elements.shaft_motion import CarriedNodes
from gearlube_core.dynamics.train.model import Train
from gearlube_core.dynamics.train.part import GROUND

_BEVEL = 1e-6  # rad, cone angle of a gear that has none
_GAP = 0.02  # m, between shafts that are drawn one above the other
_COAXIAL = 1e-4  # m, of axes
_RIM, _BESIDE = 1.08, 0.75  # of a ring over its pitch circle; of a carrier beside half a planet


class Gear(NamedTuple):
    """A gear on a parallel axis, in one mesh."""

    mesh: str
    body: str  # as listed
    radius: float  # [m]
    width: float
    z: float  # of its middle, in the axis of its body
    ring: bool
    teeth: int
    module: float  # normal, and height of the tip over the pitch circle [m]

    @property
    def key(self) -> tuple[str, int, float]:
        """Its data in all meshes."""
        return self.body, self.teeth, self.z


class _Pair(NamedTuple):
    first: Gear
    second: Gear
    way: complex  # from the centre of the first to that of the second one


class _Seat(NamedTuple):
    name: str
    z: float  # in the axis of its body [m]


class Layout(NamedTuple):
    """Axes of a drivetrain in the plane x + i y [m], by body, and what stands on them."""

    centres: dict[str, complex]
    gears: tuple[Gear, ...]
    sections: dict[str, tuple[tuple[float, float, float, float], ...]]  # start, end, radii
    seats: dict[str, tuple[_Seat, ...]]  # of what else acts on nodes
    shifts: dict[str, float]  # of z between bodies, so that gears in mesh face each other
    housing: dict[str, tuple[complex, float]]  # nodes of housings, and where they are: x + i y, z
    carriers: dict[str, str]  # of planets

    def pairs(self) -> list[tuple[Gear, Gear]]:
        """Return the gears of each mesh."""
        return list(zip(self.gears[::2], self.gears[1::2], strict=True))

    def groups(self) -> list[list[str]]:
        """Return the bodies that meshes connect: where these stand along z is known."""
        found = dict.fromkeys(gear.body for gear in self.gears)
        members = {body: [body] for body in found}
        for one, two in self.pairs():
            if members[one.body] is not members[two.body]:
                joined = members[one.body] + members[two.body]
                members |= dict.fromkeys(joined, joined)
        return list({id(one): one for one in members.values()}.values())

    def drawn(self) -> Layout:
        """Return the layout with groups side by side along z that would stand in each other."""
        shifts, reached = dict(self.shifts), -math.inf
        for group in self.groups():
            own = [gear for gear in self.gears if gear.body in group]
            start = min(gear.z + self.shifts[gear.body] - gear.width for gear in own)
            moved = max(0.0, reached - start)
            shifts |= {body: self.shifts[body] + moved for body in group}
            reached = max(gear.z + shifts[gear.body] + gear.width for gear in own)
        return self._replace(shifts=shifts)

    def alike(self) -> dict[str, list[str]]:
        """Return the bodies with gears, equal planets of one carrier under the first of them."""
        kinds: dict[Any, list[str]] = {}
        for body in dict.fromkeys(gear.body for gear in self.gears):
            teeth = {(gear.teeth, gear.z) for gear in self.gears if gear.body == body}
            carrier = self.carriers.get(body)
            kind = body if carrier is None else (carrier, frozenset(teeth))
            kinds.setdefault(kind, []).append(body)
        return {bodies[0]: bodies for bodies in kinds.values()}


def layout(train: Train) -> Layout:
    """Return where the shafts of a train are: meshes place each from the one before.

    The first body of the first mesh stands at the origin. Bevel gears and what no mesh, half shaft
    or orbit reaches are left out.

    Examples
    --------
    >>> from drivetrain.train.train_file import TrainFile
    >>> found = layout(TrainFile.named("e_axle_elastic").case().train)
    >>> [f"{name} {1e3 * abs(centre):.1f}" for name, centre in found.centres.items()][:3]
    ['input 0.0', 'counter 81.5', 'output 221.7']
    """
    carriers = [one for one in train.elements if isinstance(one, CarriedNodes)]
    sections = {
        one.body: tuple(
            (part.start, part.end, 0.5 * part.inner_diameter, 0.5 * part.outer_diameter)
            for part in one.sections
        )
        for one in carriers
    }
    along: dict[str, float] = {}
    for one in carriers:
        first = next(i for i, body in enumerate(train.bodies) if body.name == one.nodes)
        names = [body.name for body in train.bodies[first : first + one.motion.arms.size]]
        along |= dict(zip(names, (one.motion.arms + one.motion.centre).tolist(), strict=True))
    pairs = [pair for one in train.elements if (pair := _pair(one, along))]
    centres: dict[str, complex] = {}
    shifts: dict[str, float] = {}
    if pairs:
        centres[pairs[0].first.body], shifts[pairs[0].first.body] = 0.0j, 0.0
    beside = [
        (one.first.partition(".")[0], one.second.partition(".")[0], 0.0j)
        for one in train.elements
        if isinstance(one, HalfShaft)
    ]
    beside += [
        (one.carrier, one.body, cmath.rect(one.radius, one.azimuth))
        for one in train.elements
        if isinstance(one, Orbit)
    ]
    for _ in range(len(pairs) + len(beside)):
        for first_gear, second_gear, way in pairs:
            for a, b, step in ((first_gear, second_gear, way), (second_gear, first_gear, -way)):
                if a.body in centres and b.body not in centres:
                    centres[b.body] = centres[a.body] + step
                    shifts[b.body] = shifts[a.body] + a.z - b.z
        for start, end, step in beside:
            for here, there, by in ((start, end, step), (end, start, -step)):
                if here in centres and there not in centres:
                    centres[there], shifts[there] = centres[here] + by, shifts[here]
    gears = tuple(gear for pair in pairs for gear in pair[:2] if gear.body in centres)
    of_meshes = {one.name for one in train.elements if isinstance(one, GearMesh | HelicalMesh)}
    seats: dict[str, list[_Seat]] = {}
    housings = {
        place.second: (carrier, place)
        for carrier in train.elements
        if isinstance(carrier, CarriedInterface)
        for place in carrier.places
    }
    housing: dict[str, tuple[complex, float]] = {}
    for element in train.elements:
        if element.name in of_meshes or not {"force.x", "force.y"} & {
            output.name for output in element.outputs
        }:
            continue
        for field in element.on:
            node = getattr(element, field)
            body = node.partition(".")[0]
            if node not in along or body not in centres or body == GROUND:
                continue
            z = along[node] + getattr(element, "arm", 0.0)
            seats.setdefault(body, []).append(_Seat(element.name, z))
            for other in element.on:
                seated = housings.get(getattr(element, other))
                if seated is None or seated[1].second in housing:
                    continue
                for place in seated[0].places:
                    at = centres[body] + place.step - seated[1].step
                    level = z + shifts[body] + place.along - seated[1].along
                    housing[place.second] = at, level
    return Layout(
        centres,
        gears,
        {name: one for name, one in sections.items() if name in centres},
        {name: tuple(one) for name, one in seats.items()},
        shifts,
        housing,
        {one.body: one.carrier for one in train.elements if isinstance(one, Orbit)},
    )


def _pair(element: Any, along: dict[str, float]) -> _Pair | None:
    """Return the gears of a mesh on parallel shafts, or None."""
    if isinstance(element, GearMesh):
        if max(element.cone_angle_1, element.cone_angle_2) > _BEVEL:
            return None
        radii, ring, width = element.radii, element.ring, element.face_width
        on, angle = (element.first, element.second), element.azimuth
        arms, teeth = (element.arm_1, element.arm_2), (element.teeth_1, element.teeth_2)
        module = element.normal_module
    elif isinstance(element, HelicalMesh):
        pair = element.parameters.pair
        plane, module, ring = pair.plane, pair.normal_module, False
        teeth = pair.pinion_teeth, pair.gear_teeth
        # pitch radii over base radii: both gears have the working pressure angle
        slope = math.hypot(plane.x_g, plane.r_bp + plane.r_bg) / (plane.r_bp + plane.r_bg)
        radii = plane.r_bp * slope, plane.r_bg * slope
        width, angle = plane.W, element.angle
        on, arms = (element.pinion, element.gear), (element.pinion_arm, element.gear_arm)
    else:
        return None
    first, second = (
        Gear(
            element.name,
            node.partition(".")[0],
            radius,
            width,
            along.get(node, 0.0) + arm,
            ring and i == 1,
            count,
            module,
        )
        for i, (node, radius, arm, count) in enumerate(zip(on, radii, arms, teeth, strict=True))
    )
    distance = first.radius - second.radius if ring else first.radius + second.radius
    return _Pair(first, second, cmath.rect(distance, angle))


def layout_figure(found: Layout) -> Any:
    """Draw a drivetrain from its end, and unfolded along its shafts.

    Planets of one kind have one colour. Groups of bodies whose places along z are not known to each
    other stand side by side.
    """
    found, alike = found.drawn(), found.alike()
    colours = {
        body: SERIES[i % len(SERIES)] for i, each in enumerate(alike.values()) for body in each
    }
    with house_style():
        figure = new_figure(7.2, 4.4)
        end, side = figure.subplots(1, 2)
        for gear in found.gears:
            centre, colour = found.centres[gear.body], colours[gear.body]
            place = 1e3 * centre.real, 1e3 * centre.imag
            style = "--" if gear.ring else "-"
            end.add_patch(
                _circle(place, 1e3 * gear.radius, fill=False, edgecolor=colour, ls=style, lw=1.6)
            )
            end.plot(*place, "+", color=colour)
        end.autoscale_view()
        end.set(title="seen against z", xlabel="x [mm]", ylabel="y [mm]", aspect="equal")
        groups = found.groups()
        for group in groups:
            _draw_group(side, found, [one for one in group if one in alike], colours)
        for name, each in alike.items():
            more = f" and {len(each) - 1} more" if len(each) > 1 else ""
            side.plot([], [], color=colours[name], label=f"{name.replace('_', ' ')}{more}")
        if found.carriers:
            side.plot([], [], color="0.4", lw=4.0, label="carrier")
            side.set_aspect("equal")
        if found.seats:
            side.plot([], [], "x", color="black", ls="none", label="bearing or support")
        side.autoscale_view()
        title = "stages side by side" if len(groups) > 1 else "shafts one above the other"
        side.set(title=title, xlabel="z [mm]", ylabel="mm")
        figure.legend(ncols=4, loc="outside lower center")
    return figure


def _draw_group(ax: Any, found: Layout, bodies: Sequence[str], colours: dict[str, str]) -> None:
    """Draw bodies in a plane through their axes.

    The axis of a planetary set is level, with its planets above and below; other axes follow one
    below the other.
    """
    from matplotlib.colors import to_rgba

    heights: dict[str, tuple[float, ...]] = {}
    height = 0.0
    of_set = [one for one in bodies if one in found.carriers]
    axis = next((one for one in bodies if one not in of_set), bodies[0])
    for name in bodies:
        away = abs(found.centres[name] - found.centres[axis])
        if name in of_set:
            heights[name] = (away, -away)
        elif of_set and away < _COAXIAL:
            heights[name] = (0.0,)
        else:
            largest = max(gear.radius for gear in found.gears if gear.body == name)
            height -= largest if heights else 0.0
            heights[name] = (height,)
            height -= largest + _GAP
    for name, levels in heights.items():
        shift, colour = found.shifts[name], colours[name]
        for y in levels:
            for start, stop, inner, outer in found.sections.get(name, ()):
                for sign in (1.0, -1.0):
                    low = y + (inner if sign > 0.0 else -outer)
                    ax.add_patch(
                        _box(start + shift, low, stop - start, outer - inner, facecolor=colour,
                             alpha=0.35, edgecolor="none")
                    )  # fmt: skip
        named, drawn = set[float](), set[tuple[float, float]]()
        for gear in found.gears:
            if gear.body != name or (gear.radius, gear.z) in drawn:
                continue
            drawn.add((gear.radius, gear.z))
            z = gear.z + shift - 0.5 * gear.width
            look = {"lw": 1.6, "edgecolor": colour, "facecolor": to_rgba(colour, 0.2)}
            lows, height = [y - gear.radius for y in levels], 2.0 * gear.radius
            if gear.ring:
                lows = [levels[0] + gear.radius, levels[0] - _RIM * gear.radius]
                height *= 0.5 * (_RIM - 1.0)
                look["hatch"] = "////"
            for low in lows:
                ax.add_patch(_box(z, low, gear.width, height, **look))
            if gear.z in named or of_set:
                continue
            named.add(gear.z)
            ax.annotate(
                gear.mesh.replace("_", " "),
                (1e3 * (gear.z + shift), 1e3 * (levels[0] + gear.radius)),
                fontsize=7,
                ha="center",
                va="bottom",
            )
        for seat in found.seats.get(name, ()):
            ax.plot(1e3 * (seat.z + shift), 1e3 * levels[0], "x", color="black", ms=7, mew=1.6)
        if name in of_set:
            _draw_carrier(ax, found, name, levels)
    if of_set:
        sun = next(one for one in found.gears if one.body == axis)
        z = sun.z + found.shifts[axis]
        ends = 1e3 * (z + 0.5 * sun.width), 1e3 * (z + sun.width)
        ax.plot(ends, (0.0, 0.0), color=colours[axis], lw=4.0, solid_capstyle="butt")


def _draw_carrier(ax: Any, found: Layout, planet: str, levels: tuple[float, ...]) -> None:
    """Draw the pins of a planet, the plate that holds them and the end of its shaft."""
    gear = next(one for one in found.gears if one.body == planet)
    z = gear.z + found.shifts[planet]
    plate, beyond = z - _BESIDE * gear.width, z + 0.6 * gear.width
    lines = [((plate, beyond), (y, y)) for y in levels]
    lines += [((plate, plate), (levels[0], levels[-1])), ((z - gear.width, plate), (0.0, 0.0))]
    for places, heights in lines:
        ax.plot([1e3 * one for one in places], [1e3 * one for one in heights], color="0.4", lw=4.0,
                solid_capstyle="butt", zorder=0.5)  # fmt: skip


def _circle(place: tuple[float, float], radius: float, **look: Any) -> Any:
    from matplotlib.patches import Circle

    return Circle(place, radius, **look)


def _box(x: float, y: float, width: float, height: float, **look: Any) -> Any:
    from matplotlib.patches import Rectangle

    return Rectangle((1e3 * x, 1e3 * y), 1e3 * width, 1e3 * height, **look)
